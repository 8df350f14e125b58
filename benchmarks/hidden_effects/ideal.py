"""What an ideal observer tells of several causes at once, and of a stranger: the bound of a diagnosis.

The observer is told which causes act and with what values, that the noise is white and how large it is, and
of what kind the stranger beside them is, not which shape of that kind. Left is only the question whether a
cause is needed, and whether no other effect, at its best values, does the same beside the rest. What this
observer cannot tell, no diagnosis can: a cause of 3 σ by itself may be nothing beside the others, and a
stranger may have the shape of an installed effect, or of two together.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence

import numpy as np

from hidden_effects.hidden import Imitation, imitations, refined
from hidden_effects.sizes import beyond
from hidden_effects.strangers import Stranger
from zlmreport.measurement.arrays import FloatArray
from zlmreport.model.effects.axis_model import Term
from zlmreport.model.effects.design import Design
from zlmreport.model.effects.effect import Effect
from zlmreport.model.simulation.simulate import compute_deviation_by

#: Standard deviations of noise that the difference of two criteria must have at least, and the difference
#: that it must have where both describe the readings alike: then the one with fewer parameters is told.
_SURELY, _LEAST = 2.0, 4.0
#: Shapes of a stranger that are drawn to know its kind, and the share of their squares that is known.
_SHAPES, _KNOWN = 60, 0.99
#: Step of a searched parameter, as a share of its value, that shows what its uncertainty may do.
_STEP = 1e-3
#: Effects that a stranger is most like, beside each of which a second is tried.
_FIRST = 5
#: Share of the length of a cause below which the model imitates it.
_SEEN = 1e-6


def told_apart(
    causes: Sequence[Term], design: Design, sigma: float, effects: Iterable[Effect], beside: FloatArray
) -> tuple[str, ...]:
    """Return the causes that an ideal observer tells from nothing and from every other effect.

    Parameters
    ----------
    causes
        What acts, with its values.
    sigma
        Of a single reading, m or rad.
    effects
        All that are installed.
    beside : (N, q) array
        Columns of the job's model, and of the kind of the stranger.
    """
    listed = tuple(effects)
    found = []
    for number, cause in enumerate(causes):
        others = [each for place, each in enumerate(causes) if place != number]
        base = np.column_stack([beside, *(columns for each in others for columns in _columns(each, design))])
        if _is_told_apart(cause, design, base, sigma, listed):
            found.append(cause.effect.identifier)
    return tuple(found)


def kind_of(stranger: Stranger, design: Design, random: np.random.Generator) -> FloatArray:
    """Return columns that hold nearly every shape of a kind, (N, k)."""
    shapes = np.column_stack([stranger(design, random) for _ in range(_SHAPES)])
    shapes = shapes - shapes.mean(axis=0)
    shapes /= np.linalg.norm(shapes, axis=0)
    left, singular, _ = np.linalg.svd(shapes, full_matrices=False)
    share = np.cumsum(singular**2) / np.sum(singular**2)
    return np.asarray(left[:, : int(np.searchsorted(share, _KNOWN)) + 1])


def _is_told_apart(
    cause: Term, design: Design, base: FloatArray, sigma: float, effects: Sequence[Effect]
) -> bool:
    """Return whether a cause has the better criterion than nothing, and than every other effect.

    What they explain differs by d on the average and by 2·√d at random, in units of σ².
    """
    deviation = compute_deviation_by(cause.effect, design, cause.fixed)
    squares = float(np.sum(beyond(base, deviation[:, np.newaxis]) ** 2)) / sigma**2
    linear = _linear(cause, design)
    rank = int(np.linalg.matrix_rank(beyond(base, linear), tol=_SEEN * float(np.linalg.norm(linear))))
    own = rank + len(cause.effect.searched)
    rivals = [(squares, -own)]
    rivals += [
        (squares * (1.0 - each.share), each.parameters - own)
        for each in imitations(deviation, effects, design, base)
        if each.effect.identifier != cause.effect.identifier
    ]
    return _are_all_told_from(rivals, len(design.position))


def tells_stranger(  # noqa: PLR0913 - what acts, how it is measured, and what may be taken for it
    stranger: FloatArray,
    parameters: int,
    *,
    causes: Sequence[Term],
    design: Design,
    sigma: float,
    effects: Iterable[Effect],
    base: FloatArray,
) -> bool:
    """Return whether an ideal observer tells a stranger from each installed effect, and from each two.

    What two names describe as well as the kind that nobody knows, with fewer parameters, has these names.

    Parameters
    ----------
    stranger : (N,) array
        What it adds to each reading, m or rad.
    parameters
        How many numbers decide a shape of its kind.
    base : (N, q) array
        Columns of the job's model.
    """
    listed = tuple(effects)
    beside = np.column_stack([base, *(columns for each in causes for columns in _columns(each, design))])
    squares = float(np.sum(beyond(beside, stranger[:, np.newaxis]) ** 2)) / sigma**2
    rivals = [(squares, -parameters)]
    single = sorted(imitations(stranger, listed, design, beside), key=lambda each: -each.share)
    for first in (refined(each, stranger, design, beside) for each in single[:_FIRST]):
        rivals.append((squares * (1.0 - first.share), first.parameters - parameters))
        both = np.column_stack([beside, *_list_columns_of(first, stranger, design, beside)])
        left = squares * (1.0 - first.share)
        rivals += [
            (left * (1.0 - each.share), first.parameters + each.parameters - parameters)
            for each in imitations(stranger, listed, design, both)
        ]
    return _are_all_told_from(rivals, len(design.position))


def _list_columns_of(
    imitation: Imitation, deviation: FloatArray, design: Design, beside: FloatArray
) -> Iterator[FloatArray]:
    """Yield the columns of an imitation, and what shifts of its searched values change."""
    form, theta = imitation.effect, imitation.theta
    columns = form.columns(design, theta)
    gamma = np.linalg.lstsq(beyond(beside, columns), beyond(beside, deviation[:, np.newaxis])[:, 0])[0]
    values = dict(zip((each.name for each in form.linear), gamma.tolist(), strict=True))
    values |= dict(zip((each.name for each in form.searched), theta.tolist(), strict=True))
    yield from _columns(Term(form, values), design)


def _are_all_told_from(rivals: Iterable[tuple[float, int]], readings: int) -> bool:
    """Return whether the criterion of what acts is better than that of every rival, beyond doubt.

    `rivals`: By how much each describes the readings worse, in units of σ², and how many parameters more it
    takes.
    """
    penalty = math.log(readings)
    return all(
        differs + penalty * more >= max(_LEAST, 2.0 * _SURELY * math.sqrt(max(differs, 0.0)))
        for differs, more in rivals
    )


def _linear(cause: Term, design: Design) -> FloatArray:
    return cause.effect.columns(design, _theta(cause))


def _theta(cause: Term) -> FloatArray:
    return np.array([cause.fixed[each.name] for each in cause.effect.searched])


def _columns(cause: Term, design: Design) -> Iterator[FloatArray]:
    """Yield what a cause may do about its values: its columns, and what a shift of a searched value does."""
    yield _linear(cause, design)
    theta = _theta(cause)
    gamma = np.array([cause.fixed[each.name] for each in cause.effect.linear])
    for place, parameter in enumerate(cause.effect.searched):
        if parameter.is_refined:
            shift = np.where(np.arange(len(theta)) == place, _STEP * theta, 0.0)
            up, down = (cause.effect.columns(design, theta + each) for each in (shift, -shift))
            yield ((up - down) @ gamma)[:, np.newaxis]
