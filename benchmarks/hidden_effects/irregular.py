"""How often axes that are irregular from target to target, with few targets, are given a wrong name.

Guideways, scales and screws are straight only so far: between targets that lie a tenth of the travel apart
one error says little of the next. Of few targets one effect or two pass through all of them by chance. Such
axes are drawn, linear and rotary ones, and diagnosed beside the model with which one begins, or what it
describes is hidden, too.
"""

from __future__ import annotations

import argparse
from collections import Counter
from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from hidden_effects.drawn_axes import drawn_linear_test, drawn_rotary_test
from hidden_effects.judge import INSTALLED
from hidden_effects.trial import EFFECTS, measured
from zlmreport.measurement.arrays import FloatArray
from zlmreport.measurement.units import MICROMETRE
from zlmreport.model.diagnosis.diagnosis import AxisDiagnosis, DiagnosisVerdict, diagnose
from zlmreport.model.effects.axis_model import AxisModel, Term
from zlmreport.model.effects.design import Design
from zlmreport.model.fitting.observations import make_observations_of
from zlmreport.model.planning.methods import Method
from zlmreport.model.simulation.description import SimulatedNoise
from zlmreport.model.simulation.simulate import make_design_of

_MODEL = ("offset", "scale-error", "backlash")
#: Of a hidden effect at its largest, in σ, and of what a slope is beside the geometry.
_HIDDEN = (2.0, 6.0)
_SIGMAS = (0.05, 0.3, 0.8, 3.0)  # µm; on a rotary axis as many µm at a radius of one metre
_SIZES = (3.0, 30.0)  # of the geometry, in σ
_RUNS, _TARGETS = (3, 5), (5, 6, 7, 9, 11)
_ROTARY_SHARE = 0.2
_SEED = 20_261_129


def diagnose_drawn_axis(number: int, targets: int, hidden: Sequence[str] = ()) -> AxisDiagnosis:
    """Return the diagnosis of an axis; the same number gives the same.

    `hidden`: Effects that are there and not in the model.
    """
    random = np.random.default_rng([_SEED, number, targets])
    draw = drawn_rotary_test if random.random() < _ROTARY_SHARE else drawn_linear_test
    method = (Method.LINEAR, Method.PENDULUM)[int(random.integers(2))]
    description = draw(random, method, targets, int(random.choice(_RUNS)))
    sigma = float(MICROMETRE.to_si(_SIGMAS[number % len(_SIGMAS)]))
    geometry = sigma * float(np.exp(random.uniform(*np.log(_SIZES))))
    description = replace(description, noise=SimulatedNoise(reading=sigma, position=geometry))
    design = make_design_of(description)
    nothing = np.zeros(len(design.position))
    causes = [
        float(random.uniform(*_HIDDEN)) * (sigma if name == "backlash" else geometry) * _scale(name, design)
        for name in hidden
    ]
    readings = measured(description, design, nothing, np.sum([nothing, *causes], axis=0)).measurements
    observed = make_observations_of(readings, overrun=description.plan.overrun)
    known = AxisModel(tuple(Term(EFFECTS[name]) for name in _MODEL if name not in hidden))
    return diagnose(known, observed, INSTALLED)


def _scale(name: str, design: Design) -> FloatArray:
    """Return what an effect makes of the readings, one at its largest, its mean left to the offset."""
    column = EFFECTS[name].columns(design, np.empty(0))[:, 0]
    column = column - column.mean()
    return np.asarray(column / np.abs(column).max())


def main(arguments: Sequence[str]) -> None:
    """Draw axes, diagnose them, and print how many of them were given another name than is there."""
    parser = argparse.ArgumentParser(
        prog="./run benchmark irregular",
        description="Diagnose axes that are irregular from target to target.",
    )
    parser.add_argument("--axes", type=int, default=40, help="how many of each (%(default)s)")
    parser.add_argument("--first", type=int, default=1000, help="number of the first (%(default)s)")
    parser.add_argument(
        "--hidden", nargs="+", default=[], choices=_MODEL[1:], help="what is there and not in the model"
    )
    parser.add_argument("--targets", type=int, nargs="+", default=list(_TARGETS), help="of the tests")
    asked = parser.parse_args(arguments)
    print(
        "| targets | axes | unexplained | adequate | hidden ones named | others named | by what |",
        "|---|---|---|---|---|---|---|",
        sep="\n",
    )
    for targets in asked.targets:
        found = [diagnose_drawn_axis(asked.first + each, targets, asked.hidden) for each in range(asked.axes)]
        verdicts = Counter(each.verdict for each in found)
        names = [{effect.identifier for effect in each.together} for each in found]
        others = [" and ".join(sorted(each - {*asked.hidden})) for each in names]
        cells = (
            targets,
            asked.axes,
            verdicts[DiagnosisVerdict.UNEXPLAINED],
            verdicts[DiagnosisVerdict.ADEQUATE],
            f"{sum(len(each & {*asked.hidden}) for each in names)} of {len(asked.hidden) * asked.axes}",
            sum(map(bool, others)),
            "; ".join(filter(None, others)) or "–",
        )
        print("|", " | ".join(map(str, cells)), "|", flush=True)
