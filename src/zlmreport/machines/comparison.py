"""A test of a machine against what axes and effects predict: curves, sizes, numbers, where it fails."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from zlmreport.evaluation.evaluation import EvaluatedParameter
from zlmreport.machines.course import CircularTest, StraightTest
from zlmreport.machines.design import join_side_by_side
from zlmreport.machines.machine import MachineModel, TestPrediction, predict
from zlmreport.machines.measured_tests import MeasuredCircle
from zlmreport.machines.residual import (
    Stretch,
    centre,
    compute_root_mean_square,
    estimate_scatter_within,
    find_stretches,
    find_stretches_of_line,
)
from zlmreport.machines.study import CircleStudy
from zlmreport.measurement.arrays import FloatArray
from zlmreport.model.effects.circle_effect import CircleEffect
from zlmreport.plugin.registry import Registry

if TYPE_CHECKING:
    from zlmreport.machines.reading import MachineFile


@dataclass(frozen=True, slots=True)
class Sizes:
    """How large a test's deviations are, m: measured, as predicted by the axes, and what is left."""

    measured: float
    predicted: float
    left: float


@dataclass(frozen=True, slots=True)
class StandardNumbers:
    """The parameters of a standard of the measured, the predicted and the remaining deviations."""

    standard: str
    designation: str
    measured: tuple[EvaluatedParameter, ...]
    predicted: Mapping[str, float]  #: By symbol, m.
    left: Mapping[str, float]


@dataclass(frozen=True, slots=True)
class ComparedTest:
    """A test and its prediction; (N,) of its readings."""

    test: CircularTest | StraightTest  #: The circle or the line.
    prediction: TestPrediction  #: What the axes predict.
    #: What axes, and the effects of a model where there is one, leave of what was measured, m.
    left: FloatArray
    #: Root mean squares; of circles about the centre of each turn and, unless the bar is calibrated, without
    #: the mean radius, of lines without the mean.
    rms: Sizes
    of_axes: Mapping[str, float]  #: What each error makes of the test, RMS, m, by name.
    #: Each effect of the model with what it makes of the test, RMS, m.
    of_effects: tuple[tuple[CircleEffect, float], ...]
    numbers: tuple[StandardNumbers, ...]  #: Of the standards that the test's job names.
    fails: tuple[Stretch, ...]  #: Where what is left is beyond its band.

    @property
    def name(self) -> str:
        """The test's name."""
        return self.test.name


def compare_tests(
    file: MachineFile, registry: Registry, study: CircleStudy | None = None
) -> tuple[ComparedTest, ...]:
    """Return all tests against their prediction, circles against the effects of a study, too; lines last."""
    lines = (_compare_line(file.machine, each) for each in file.lines)
    return (*compare_circles(file, registry, study), *lines)


def compare_circles(
    file: MachineFile, registry: Registry, study: CircleStudy | None = None
) -> tuple[ComparedTest, ...]:
    """Return all circles against their prediction, and against the effects of a model if there is a study."""
    made = _compute_made_by_effects(file.circles, study)
    return tuple(
        _compare_circle(file.machine, each, index, registry, made) for index, each in enumerate(file.measured)
    )


def _compare_circle(
    machine: MachineModel,
    measured: MeasuredCircle,
    index: int,
    registry: Registry,
    made: Sequence[Sequence[tuple[CircleEffect, FloatArray]]],
) -> ComparedTest:
    circle, effects = measured.circle, made[index]
    prediction = predict(machine, circle.make_course())
    left = (
        circle.deviation
        - prediction.values
        - sum((curve for _, curve in effects), np.zeros(len(circle.angle)))
    )
    shown = centre(circle, left)
    standard = np.hypot(prediction.standard_uncertainty, estimate_scatter_within(circle, shown))
    numbers = tuple(
        StandardNumbers(
            own.standard,
            own.designation,
            own.parameters,
            {each.quantity.symbol: each.value for each in predicted.parameters},
            {each.quantity.symbol: each.value for each in rest.parameters},
        )
        for own, predicted, rest in zip(
            *(measured.evaluate(each, registry) for each in (circle.deviation, prediction.values, left)),
            strict=True,
        )
    )
    sizes = (circle.deviation, prediction.values, left)
    return ComparedTest(
        circle,
        prediction,
        left,
        Sizes(*(compute_root_mean_square(centre(circle, each)) for each in sizes)),
        {name: compute_root_mean_square(centre(circle, each)) for name, each in prediction.shares.items()},
        tuple((effect, compute_root_mean_square(curve)) for effect, curve in effects),
        numbers,
        find_stretches(circle, shown, standard),
    )


def _compute_made_by_effects(
    circles: Sequence[CircularTest], study: CircleStudy | None
) -> tuple[list[tuple[CircleEffect, FloatArray]], ...]:
    """Return what each effect of a study makes of each circle, at all of its readings, m."""
    found: tuple[list[tuple[CircleEffect, FloatArray]], ...] = tuple([] for _ in circles)
    if study is None:
        return found
    design = join_side_by_side(circles)
    for each in study.effects:
        values = {one.name: one.value for one in study.list_estimates_of(each.effect.identifier)}
        fitted = {term.name for term in each.form.terms}
        terms = each.effect.terms(design, each.form.searched)
        curve = sum(
            (values[term.name] * term.column for term in terms if term.name in fitted), np.zeros(design.count)
        )
        for index, own in enumerate(found):
            own.append((each.effect, curve[design.test == index]))
    return found


def _compare_line(machine: MachineModel, line: StraightTest) -> ComparedTest:
    """Return a line against its prediction."""
    prediction = predict(machine, line.course)
    left = line.deviation - prediction.values
    shown = left - left.mean()
    standard = np.hypot(prediction.standard_uncertainty, line.standard_uncertainty)
    sizes = (line.deviation, prediction.values, left)
    return ComparedTest(
        line,
        prediction,
        left,
        Sizes(*(compute_root_mean_square(each - each.mean()) for each in sizes)),
        {name: compute_root_mean_square(each - each.mean()) for name, each in prediction.shares.items()},
        (),
        (),
        find_stretches_of_line(line, shown, standard),
    )
