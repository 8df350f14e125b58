"""What each positioning method makes of one and the same axis: drift in the results, and what a plan sees."""

from __future__ import annotations

from functools import cache
from pathlib import Path

import numpy as np
from markdown import code, table

from zlmreport import pipeline
from zlmreport.evaluation.evaluate import evaluate
from zlmreport.job.loading import load
from zlmreport.language.formatting import write_fixed_number
from zlmreport.measurement.approach import Approach
from zlmreport.measurement.arrays import read_only_floats
from zlmreport.measurement.measurement_set import MeasurementSet
from zlmreport.model.planning.methods import Method
from zlmreport.model.planning.planned_test import PlannedTest, describe_planned_test
from zlmreport.plugin.registry import find_plugins

_JOB = """\
schema: zlmreport/job/1
certificate: {{number: METHODS, kind: report}}
axis: {{name: X, travel: [0, 1000], screw_pitch: 10}}
measurement:
  method: {method}
  source: {{plugin: laser-csv, file: not-measured.csv}}
evaluate: ["iso230-2:2014"]
"""
#: Of the zero point, evenly from the first reading to the last, m.
_DRIFT = 10e-6
_PARAMETERS = ("B_mean", "R", "M", "E", "A")
_EFFECTS = (
    "thermal-growth",
    "thermal-drift",
    "scale-expansion",
    "reversal-relaxation",
    "backlash-gradient",
    "screw-pitch",
)
_NOT_DEFINED = "–"


def drift_text() -> str:
    """Return travel and time of a test by each method, and the parameters of an axis that only drifts."""
    heading = ("Method", "Travel, m", "Time, min", *(f"{code(symbol)}, µm" for symbol in _PARAMETERS))
    return table(heading, (_drift_row(method) for method in Method))


def sight_text() -> str:
    """Return the visible share of some effects by each method."""
    rows = ([code(effect), *(_share(method, effect) for method in Method)] for effect in _EFFECTS)
    return table(("Effect", *(method.value for method in Method)), rows)


def _drift_row(method: Method) -> list[str]:
    planned = _foreseen(method)
    values = _parameters_of_drift(planned)
    return [
        method.value,
        write_fixed_number(planned.travelled, 1),
        write_fixed_number(planned.duration / 60, 0),
        *(_micrometres(values.get(symbol, values.get(f"{symbol}_fwd"))) for symbol in _PARAMETERS),
    ]


def _micrometres(value: float | None) -> str:
    return _NOT_DEFINED if value is None else write_fixed_number(value * 1e6, 1)


def _parameters_of_drift(planned: PlannedTest) -> dict[str, float]:
    design = planned.design
    drifting = MeasurementSet(
        axis=design.axis,
        target_positions=planned.proposal.plan.targets,
        target=design.target,
        approach=np.array([int(Approach(round(sign))) for sign in design.direction]),
        run=design.run,
        deviation=read_only_floats(_DRIFT * design.time / design.duration),
    )
    standard = find_plugins().standard("iso230-2:2014")
    evaluation = evaluate(standard, drifting, standard.options(), {})
    return {parameter.quantity.symbol: parameter.value for parameter in evaluation.parameters}


def _share(method: Method, effect: str) -> str:
    for seen in _foreseen(method).seen_effects:
        if seen.effect.identifier == effect and seen.visibility.reason is None:
            return f"{write_fixed_number(100 * seen.visibility.share, 0)} %"
    return _NOT_DEFINED


@cache
def _foreseen(method: Method) -> PlannedTest:
    registry = find_plugins()
    job = load(Path("job.yaml"), registry, content=_JOB.format(method=method.value).encode())
    return describe_planned_test(job, pipeline.choose_standards(job, registry), registry.effects)
