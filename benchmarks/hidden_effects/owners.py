"""Axes as owners know them: named faults of linear and rotary axes, each built from a constant alone.

Nothing is drawn of the faults; what is drawn is the test (targets, timing, weather) and the noise, σ = 0.7 µm
or ″, three runs of 21 targets by the linear method.
"""

from __future__ import annotations

import argparse
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import TypeAlias

import numpy as np

from hidden_effects.drawn_axes import drawn_linear_test, drawn_rotary_test
from hidden_effects.judge import INSTALLED
from hidden_effects.trial import EFFECTS, measured
from hidden_effects.weather import wandering
from zlmreport.language import Language
from zlmreport.measurement.arrays import FloatArray
from zlmreport.measurement.units import ARCSECOND, MICROMETRE
from zlmreport.model.diagnosis.building import Built, build
from zlmreport.model.diagnosis.contest import Told
from zlmreport.model.diagnosis.diagnosis import AxisDiagnosis, diagnose
from zlmreport.model.diagnosis.remainder import Remainder
from zlmreport.model.effects.axis_model import AxisModel, Term
from zlmreport.model.effects.design import Design
from zlmreport.model.fitting.observations import make_observations_of
from zlmreport.model.planning.methods import Method
from zlmreport.model.simulation.description import SimulatedNoise
from zlmreport.model.simulation.simulate import make_design_of

Fault: TypeAlias = Callable[[Design], FloatArray]  #: Deviations in µm, of a rotary axis in ″.

_SIGMA, _RUNS, _TARGETS = 0.7, 3, 21
_TURN = 2 * np.pi


def _place(design: Design) -> FloatArray:
    """Return the position as a share of the travel, 0 to 1."""
    return (design.position - design.span[0]) / design.length


def _moment(design: Design) -> FloatArray:
    """Return the time as a share of the test, 0 to 1."""
    return (design.time - design.time.min()) / design.duration


def _hump(where: FloatArray, middle: float, width: float) -> FloatArray:
    """Return a hump of height 1 and of a width at half its height."""
    return np.asarray(np.exp2(-((2 * (where - middle) / width) ** 2)), dtype=np.float64)


LINEAR: Mapping[str, Fault] = {
    "belt: lost motion of 800 µm, slope": lambda at: 12 * at.position + 400 * at.direction,
    "screw worn over half its length (−3, then −8 µm), slope": lambda at: (
        8 * at.position - at.direction * (1.5 + 2.5 * (_place(at) > 0.5))
    ),
    "screw worn on one flank from 550 mm on (3, then 8 µm), slope": lambda at: (
        8 * at.position + (at.direction < 0) * (3.0 + 5.0 * (_place(at) > 0.55))
    ),
    "a change of slope in one direction, slope, lost motion": lambda at: (
        5 * at.position
        - 1.5 * at.direction
        + 12 * (at.direction > 0) * np.maximum(0.0, _place(at) - 0.4) * at.length
    ),
    "axis that warms up by 7 µm, slope, lost motion": lambda at: (
        8 * at.position - 1.5 * at.direction + 7 * (1 - np.exp(-_moment(at) / 0.3))
    ),
    "growth of 8 µm/m from the far bearing, lost motion": lambda at: (
        8 * (at.position - at.span[1]) * (1 - np.exp(-_moment(at) / 0.4)) + 1.5 * at.direction
    ),
    "two joints (4, −6 µm), slope, lost motion": lambda at: (
        10 * at.position - 1.5 * at.direction + 4.0 * (_place(at) > 0.28) - 6.0 * (_place(at) > 0.72)
    ),
    "pitch of 3 µm, zone of 5 µm wider reversal, lost motion": lambda at: (
        3 * np.sin(_TURN * at.position / (at.axis.screw_pitch or 1.0))
        + at.direction * (1.0 + 2.5 * _hump(_place(at), 0.45, 0.25))
    ),
    "saw of 5 µm every 310 mm, lost motion": lambda at: 5 * (at.position / 0.31 % 1.0) + 1.5 * at.direction,
    "bump of 5 µm at 420 mm, slope, lost motion": lambda at: (
        8 * at.position + 1.5 * at.direction + 5 * _hump(_place(at), 0.42, 0.06)
    ),
    "sun from a third of the test on (6 µm), lost motion": lambda at: (
        1.5 * at.direction + 6 * _hump(_moment(at), 0.55, 0.3)
    ),
}
ROTARY: Mapping[str, Fault] = {
    "rotary: eccentricity 6″, lost motion 8″, relaxation 3″": lambda at: (
        6 * np.sin(at.position + 0.5) + at.direction * (4 + 3 * np.exp(-at.since_reversal / np.deg2rad(20)))
    ),
    "rotary: eccentricity 6″, worn zone of 4″": lambda at: (
        6 * np.sin(at.position + 0.5) + 4 * _hump(_place(at), 0.6, 0.28)
    ),
    "rotary: eccentricity 6″, ellipticity 3″, first run 3″, worn zone of 4″": lambda at: (
        6 * np.sin(at.position + 0.5)
        + 3 * np.sin(2 * at.position + 1)
        + 3 * (at.cycle == at.cycle.min())
        + 4 * _hump(_place(at), 0.6, 0.28)
    ),
    "rotary: gear mesh of 60 teeth, lost motion": lambda at: 3 * np.sin(60 * at.position) + 2 * at.direction,
}


@dataclass(frozen=True, slots=True)
class _Told:
    built: Built
    sigma: float  #: m or rad.
    seconds: float  #: CPU of the whole way.


def build_model(fault: Fault, seed: int, sigma: float = _SIGMA, *, is_rotary: bool) -> _Told:
    """Return what following the advice comes to, from a constant alone.

    `sigma`: In µm, of a rotary axis ″.
    """
    random = np.random.default_rng([seed, is_rotary])
    draw, unit = (drawn_rotary_test, ARCSECOND) if is_rotary else (drawn_linear_test, MICROMETRE)
    noise = float(unit.to_si(sigma))
    description = draw(random, Method.LINEAR, _TARGETS, _RUNS)
    description = replace(description, noise=SimulatedNoise(reading=noise))
    design = wandering(make_design_of(description), random)
    deviation = np.asarray(unit.to_si(fault(design)), dtype=np.float64)
    readings = measured(description, design, np.zeros(len(deviation)), deviation).measurements
    observed = make_observations_of(readings, overrun=description.plan.overrun)

    def diagnosing(model: AxisModel, may_go: frozenset[str], told: Told) -> AxisDiagnosis:
        return diagnose(model, observed, INSTALLED, may_go=may_go, told=told)

    started = time.process_time()
    built = build(AxisModel((Term(EFFECTS["offset"]),)), diagnosing)
    return _Told(built, noise, time.process_time() - started)


def report(
    faults: Mapping[str, Fault], seeds: Sequence[int], sigma: float, *, is_rotary: bool
) -> Iterator[str]:
    """Yield the lines of a table: what is there, what is named, and what is left."""
    for name, fault in faults.items():
        for seed in seeds:
            told = build_model(fault, seed, sigma, is_rotary=is_rotary)
            last = told.built.last
            names = ", ".join(each for each in told.built.model.identifiers if each != "offset")
            left = f"{last.error.rms / told.sigma:.2f} | {told.seconds:.1f}"
            yield f"| {name} | {names or '–'} | {_describe(last.remainder)} | {left} |"


def _describe(remainder: Remainder | None) -> str:
    if remainder is None:
        return "–"
    shape, where = (words.in_language(Language.ENGLISH) for words in (remainder.shape, remainder.where))
    return f"{shape}, {where}"


def main(arguments: Sequence[str]) -> None:
    """Build the models of the named axes, and print what came of it."""
    parser = argparse.ArgumentParser(
        prog="./run benchmark owners", description="Build models of axes with named faults, from nothing."
    )
    parser.add_argument("--seeds", type=int, default=2, help="drawings of each (%(default)s)")
    parser.add_argument("--sigma", type=float, default=_SIGMA, help="noise, µm or ″ (%(default)s)")
    asked = parser.parse_args(arguments)
    print("| what is there | what is named | what is left without a name | left in σ | CPU in s |")
    print("|---|---|---|---|---|")
    for faults, is_rotary in ((LINEAR, False), (ROTARY, True)):
        for line in report(faults, range(1, asked.seeds + 1), asked.sigma, is_rotary=is_rotary):
            print(line, flush=True)
