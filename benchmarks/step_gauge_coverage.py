"""Whether stated intervals x ± U hold the true errors of a machine that a step gauge was measured on.

A machine with known errors is simulated: gauges drawn from their calibration lie along lines of all
directions in its working volume, are touched with a known scatter at another temperature than is believed,
and are evaluated as a job is.
"""

from __future__ import annotations

import argparse
import sys
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path

import numpy as np

from shares import Held, share_held
from zlmreport.errors import Place
from zlmreport.evaluation.evaluate import evaluate
from zlmreport.evaluation.uncertainty.budget import (
    Acts,
    Budget,
    Contribution,
    Distribution,
    compute_temperature_range,
    from_range,
)
from zlmreport.evaluation.uncertainty.expanded import compute_mean_uncertainty
from zlmreport.job.types import Options
from zlmreport.language import same
from zlmreport.measurement.axis import Axis
from zlmreport.measurement.measurement_set import MeasurementSet
from zlmreport.plugin.registry import find_plugins
from zlmreport_step_gauge.calibration import cut_section, read_calibration
from zlmreport_step_gauge.deviations import compute_deviations_of
from zlmreport_step_gauge.gauge import Side, StepGauge
from zlmreport_step_gauge.initial_points import InitialPoints
from zlmreport_step_gauge.location import locate
from zlmreport_step_gauge.measurements import Targets, make_measurement_set
from zlmreport_step_gauge.probed import ProbedPoint, arrange_on_grid
from zlmreport_step_gauge.set_up import Expansion, GaugeSetUp, StatedRadius
from zlmreport_step_gauge.uncertainty import list_gauge_contributions

sys.path.append(str(Path(__file__).parents[1] / "tests"))
from step_gauge.simulated_cmm import MachineErrors, Simulated, SimulatedTest, simulate

GAUGE = Path(__file__).parents[1] / "configs" / "step-gauge" / "gauge.yaml"
HERE = Place("simulated")
MACHINE = MachineErrors(
    scale=(18e-6, -9e-6, 12e-6),
    amplitude=(1.2e-6, 0.8e-6, 0.0),
    period=(0.12, 0.09, 0.1),
    lost_motion=(1.4e-6, 0.9e-6, 0.0),
    squareness=(15e-6, -8e-6, 4e-6),
)
#: Standard uncertainties: of the effective radius where it is stated, a touch, an initial point, m.
RADIUS, TOUCH, POINT = 0.2e-6, 0.3e-6, 2e-6
#: The gauge above its reference temperature, and the full range of the error of that, K.
DIFFERENCE, RANGE = 0.4, 0.2

_STANDARD = find_plugins().standard("step-gauge")
_GAUGE = cut_section(read_calibration(GAUGE).gauge, 2, 13, HERE)


@dataclass(frozen=True, slots=True)
class Coverage:
    """The share of true errors within x ± U, over all faces but the reference face, and by face."""

    all_faces: float
    lowest: float
    highest: float


def coverage(trials: int, *, radius_is_determined: bool, seed: int = 20260512) -> Coverage:
    """Return how many of the true errors the stated intervals hold.

    Parameters
    ----------
    trials
        Simulated calibrations.
    radius_is_determined
        Whether the effective radius comes from the blocks of the gauge (Eq. 1). The machine then has no lost
        motion, for it could not be told from the radius.
    seed
        Of everything random.
    """
    by_face = share_held(partial(_trial, radius_is_determined), trials, seed)
    return Coverage(sum(by_face.values()) / len(by_face), min(by_face.values()), max(by_face.values()))


def _trial(radius_is_determined: bool, generator: np.random.Generator) -> Held:  # noqa: FBT001 - as above
    direction = generator.normal(size=3) * (1.0, 1.0, 0.3)
    test = SimulatedTest(
        gauge=_GAUGE,
        begin=(0.3, 0.3, 0.2),
        direction=(float(direction[0]), float(direction[1]), float(direction[2])),
        point_uncertainty=POINT,
        touch_uncertainty=TOUCH,
        temperature_difference=DIFFERENCE,
        temperature_range=RANGE,
    )
    machine = replace(MACHINE, lost_motion=(0.0, 0.0, 0.0)) if radius_is_determined else MACHINE
    simulated = simulate(test, machine, generator)
    stated = None
    if not radius_is_determined:
        stated = StatedRadius(test.effective_radius + generator.normal(0.0, RADIUS), RADIUS)
    set_up = _set_up(test, simulated, stated)
    measurements = _measured(simulated, set_up)
    budget = Budget((*list_gauge_contributions(set_up, measurements), _temperature(_GAUGE)))
    evaluation = evaluate(_STANDARD, measurements, Options(), {})
    expanded = np.nanmax(compute_mean_uncertainty(evaluation, budget).by_approach, axis=0)
    found = np.nansum(evaluation.statistics.mean, axis=0)
    return dict(enumerate((np.abs(found - simulated.truth)[1:] <= expanded[1:]).tolist()))


def _set_up(test: SimulatedTest, simulated: Simulated, stated: StatedRadius | None) -> GaugeSetUp:
    points = InitialPoints(simulated.initial_points, HERE)
    return GaugeSetUp(
        gauge=test.gauge,
        located=locate(points, test.gauge, test.tip_radius, POINT),
        tip_radius=test.tip_radius,
        radius_is_corrected=False,
        effective_radius=stated,
        probing_uncertainty=TOUCH,
        gauge_expansion=Expansion(test.gauge.expansion_coefficient or 0.0, DIFFERENCE),
        scale_expansion=None,
        files=(),
        place=HERE,
    )


def _measured(simulated: Simulated, set_up: GaugeSetUp) -> MeasurementSet:
    points = [
        ProbedPoint(HERE, face.number, cycle + 1, tuple(point.tolist()))
        for face, of_face in zip(set_up.gauge.faces, simulated.coordinates, strict=True)
        for cycle, point in enumerate(of_face)
    ]
    probed = arrange_on_grid(points, set_up.gauge, tuple(Side), place=HERE)
    return make_measurement_set(
        probed,
        compute_deviations_of(probed, set_up, HERE, is_corrected=False),
        set_up,
        Axis("line"),
        targets=Targets.FACES,
        origin=0.0,
        source="step-gauge",
        files=(),
        place=HERE,
    )


def _temperature(gauge: StepGauge) -> Contribution:
    """Return the contribution that a job states as uncertainty.device_temperature."""
    length = gauge.faces[-1].nominal - gauge.faces[0].nominal
    full_range = compute_temperature_range(gauge.expansion_coefficient or 0.0, length, RANGE)
    size = from_range(full_range, Distribution.RECTANGULAR)
    return Contribution(
        same("temperature"), size, Acts.ALONG_THE_LENGTH, Distribution.RECTANGULAR, same(""), same("")
    )


def main(arguments: list[str]) -> None:
    """Print the shares of both ways to the effective radius."""
    parser = argparse.ArgumentParser(prog="./run benchmark step-gauge", description=__doc__)
    parser.add_argument("--trials", type=int, default=1000, help="simulated calibrations (%(default)s)")
    trials = parser.parse_args(arguments).trials
    for title, determined in (("stated", False), ("from the gauge (Eq. 1)", True)):
        found = coverage(trials, radius_is_determined=determined)
        print(
            f"effective radius {title}: {found.all_faces:.1%} of the true errors within x ± U "
            f"(by face {found.lowest:.1%} to {found.highest:.1%})"
        )
