"""From effects in a file to effects with values in SI."""

from __future__ import annotations

import math

import pytest

from testing.exemplary_effect import ExemplaryEffect, ExemplaryOptions
from zlmreport.errors import Place
from zlmreport.job.choices import EffectChoice
from zlmreport.measurement.axis import AxisKind
from zlmreport.model.axis_model import Term, chosen_terms


def _chosen(kind: AxisKind, settings: ExemplaryOptions | None = None, **values: float) -> Term:
    choice = EffectChoice("exemplary-wave", settings or ExemplaryOptions(), values, Place("job.yaml"))
    (chosen,) = chosen_terms([choice], lambda _: ExemplaryEffect(), kind)
    return chosen


def test_values_become_metres_on_a_linear_axis() -> None:
    assert _chosen(AxisKind.LINEAR, height=3, wavelength=250).fixed == {"height": 3e-6, "wavelength": 0.25}


def test_values_become_radians_on_a_rotary_axis() -> None:
    values = _chosen(AxisKind.ROTARY, height=3, wavelength=90).fixed
    assert values["height"] == pytest.approx(3 * math.pi / 180 / 3600, rel=1e-14)
    assert values["wavelength"] == pytest.approx(math.pi / 2, rel=1e-14)


def test_effect_is_in_the_form_of_its_settings() -> None:
    chosen = _chosen(AxisKind.LINEAR, ExemplaryOptions(rectified=True))
    assert chosen.effect.settings == ExemplaryOptions(rectified=True)
    assert chosen.fixed == {}
