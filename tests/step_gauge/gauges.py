"""Gauges and set-ups for tests."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from zlmreport.plugin import Place
from zlmreport_step_gauge.gauge import Face, Side, StepGauge
from zlmreport_step_gauge.set_up import GaugeSetUp

HERE = Place("job.yaml", 9, 1)
#: Departures of the faces of a gauge from their nominal places, µm.
DEPARTURES = (0.0, -0.4, 0.8, -0.3, -0.5, -1.4, -0.3, 1.7, 0.6, 1.6)


def gauge(
    departures: tuple[float, ...] = DEPARTURES,
    *,
    expanded_uncertainty: float = 0.2e-6,
    expansion: float | None = 11.5e-6,
    expansion_uncertainty: float | None = None,
) -> StepGauge:
    """Return a gauge of blocks of 10 mm, 20 mm apart."""
    faces = tuple(
        Face(
            number,
            Side.FRONT if number % 2 else Side.BACK,
            (number - 1) * 10e-3,
            (number - 1) * 10e-3 + departure * 1e-6,
            expanded_uncertainty,
        )
        for number, departure in enumerate(departures, 1)
    )
    return StepGauge(
        "SG", "7", "C-1", faces, expansion, expansion_uncertainty, 293.15, 20e-3, 15e-3, Place("gauge.yaml")
    )


def set_up(of: StepGauge, **stated: Any) -> GaugeSetUp:
    """Return a set-up with a tip of 2 mm, whose effective radius is to be determined; `stated` replaces."""
    plain = GaugeSetUp(
        gauge=of,
        located=None,
        tip_radius=2e-3,
        radius_is_corrected=False,
        effective_radius=None,
        probing_uncertainty=0.0,
        gauge_expansion=None,
        scale_expansion=None,
        files=(),
        place=HERE,
    )
    return replace(plain, **stated)
