"""Which effects a plan of a test can tell and which it hides; no readings are needed."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np

from zlmreport.language import Words
from zlmreport.measurement.arrays import FloatArray
from zlmreport.model.diagnosis.contest import Contest
from zlmreport.model.diagnosis.effects_to_try import list_effects_to_try
from zlmreport.model.diagnosis.families import Family
from zlmreport.model.diagnosis.likelihood import Reduced
from zlmreport.model.diagnosis.null_distribution import NullDistribution, simulate_null
from zlmreport.model.effects.axis_model import AxisModel
from zlmreport.model.effects.design import Design
from zlmreport.model.effects.effect import Effect, Parameter

#: Share of an effect that a plan sees, below which it hides it.
HIDDEN_SHARE = 0.1
#: Values of searched parameters that are looked at.
_VALUES = 12


@dataclass(frozen=True, slots=True)
class Visibility:
    """How much of an effect a plan can see."""

    effect: str  #: Its identifier.
    #: Root mean square of what the model cannot imitate, over that of the effect about its mean: 0 to 1.
    #: Where θ is searched, the median over its values. 0 for an effect that the plan cannot see at all.
    share: float
    #: Root mean square value over all readings of the smallest effect that is found half of the time, m or
    #: rad; infinite where it is never found.
    smallest_rms: float
    #: For an effect of one linear parameter, this and its smallest value found half of the time, SI.
    smallest: tuple[Parameter, float] | None = None
    reason: Words | None = None  #: Why it cannot be tested at all; None if it can.

    @property
    def is_hidden(self) -> bool:
        """Whether the model imitates all or nearly all of it."""
        return self.share < HIDDEN_SHARE


def plan_visibility(
    model: AxisModel, design: Design, effects: Iterable[Effect], sigma: float
) -> tuple[Visibility, ...]:
    """Return what a planned test can see beside a model, if single readings scatter independently by σ.

    `model`: The effects that are taken for granted; their searched parameters at the first of their values.
    `design`: The plan: a visit list with times and conditions as they are expected.
    `sigma`: Repeatability of a single reading, m or rad.
    """
    columns = [term.compute_some_columns(design) for term in model.terms]
    base = np.concatenate([np.empty((len(design.position), 0)), *columns], axis=1)
    entered = list_effects_to_try(model, design, effects)
    contest = Contest.of(design, base, entered.forms)
    null = simulate_null(contest, contest.quiet)
    missing = tuple(Visibility(each.effect, 0.0, np.inf, None, each.reason) for each in entered.not_testable)
    return (*judge_visibility(contest, null, contest.reduce_set(contest.quiet, []), sigma), *missing)


def judge_visibility(
    contest: Contest, null: NullDistribution, reduced: Reduced, sigma: float
) -> tuple[Visibility, ...]:
    """Return what a test can see, in the order of the contest; what it cannot see at all comes last.

    `reduced`: What stands beside, under the amplitudes of the noise.
    `sigma`: σ̂, m or rad.
    """
    found = []
    for index, forms in enumerate(contest.by_effect):
        needed = float(null.usual[index]) + null.threshold
        family = contest.families[forms[0]]
        lengths = [_compute_lengths(contest, reduced, family, theta) for theta in _try_some(family.thetas)]
        found.append(_judge_family(family, lengths, sigma * float(np.sqrt(needed))))
    return (*found, *(Visibility(effect.identifier, 0.0, np.inf) for effect in contest.invisible))


@dataclass(frozen=True, slots=True)
class _Lengths:
    """Of one block of columns: the root mean square, the visible share, and the length to the noise."""

    size: float
    share: float
    whitened: float


def _try_some(thetas: FloatArray) -> FloatArray:
    return thetas[:: 1 + len(thetas) // _VALUES]


def _compute_lengths(contest: Contest, reduced: Reduced, family: Family, theta: FloatArray) -> _Lengths:
    columns = family.effect.columns(contest.design, theta)
    contrasts = contest.space.of(columns)
    seen = contest.space.single.undo_whitening(contrasts)
    moving = float(np.linalg.norm(columns - columns.mean(axis=0)))
    squares = contest.compute_squares_beside(reduced, contest.columns.hold(contrasts))
    return _Lengths(
        float(np.sqrt(np.mean(columns**2))),
        float(np.linalg.norm(seen)) / (moving or 1.0),
        float(np.sqrt(np.mean(np.maximum(squares, 0.0)))),
    )


def _judge_family(family: Family, lengths: Sequence[_Lengths], needed: float) -> Visibility:
    """Return the visibility of a form; `needed` is the length that its whitened contrast must have."""
    amplitudes = [needed / each.whitened if each.whitened else np.inf for each in lengths]
    sizes = [amplitude * each.size for amplitude, each in zip(amplitudes, lengths, strict=True)]
    linear = family.effect.linear
    smallest = (linear[0], float(np.median(amplitudes))) if len(linear) == 1 else None
    share = min(1.0, float(np.median([each.share for each in lengths])))
    return Visibility(family.effect.identifier, share, float(np.median(sizes)), smallest)
