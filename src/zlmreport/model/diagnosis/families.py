"""What takes part in the contest: forms of installed effects and nameless ones, with all grid values.

What they could add depends on the plan of the test and on the model, not on what was measured; so it is made
once, and every set of deviations, measured or simulated, is held against the same.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np

from zlmreport.measurement.arrays import FloatArray, IntArray
from zlmreport.model.diagnosis.columns import Columns
from zlmreport.model.diagnosis.random_curves import PRICE as NAMELESS_PRICE
from zlmreport.model.effects.design import Design
from zlmreport.model.effects.effect import Dimension, Effect
from zlmreport.model.fitting.contrasts import Contrasts
from zlmreport.model.fitting.pauses import find_pauses
from zlmreport.model.fitting.repeats import number_cells

#: 2·ln of the odds against each installed effect, if nothing is known: of some thirty, one or two are there;
#: and against one without which hardly a machine is: beside a rarer one that does the same it leads.
PRICE, _PRICE_OF_COMMON = 6.0, 3.0
#: Root mean square value of columns, SI, below which they are rounding: all targets are whole increments.
_ROUNDING = 1e-14
#: A wave in time that the cells imitate but for a lesser share comes back with every run: a coincidence.
_LEAST_OWN = 0.01
#: Shares of a form without a name by which an installed effect has it, at one of its values, and at how many
#: of its values: known where most are had all but wholly, and nearly all but for a tenth.
_WHOLLY, _MOST = 0.95, 0.5
_NEARLY, _ALL = 0.9, 0.875
_LEAST_SEEN = 1e-6

#: A form of an effect, and the values of its searched parameters that are tried, shape (g, s).
Entry: TypeAlias = tuple[Effect, FloatArray]


@dataclass(frozen=True, slots=True)
class Family:
    """A form of an effect with every value of its searched parameters at which the plan can see it."""

    effect: Effect  #: The effect, in this form.
    thetas: FloatArray  #: (g, s): Values of the searched parameters, one row for each block of columns.
    blocks: IntArray  #: (g, k) integer: The places of each block's columns: orthonormal contrasts, or zero.
    ranks: IntArray  #: (g,) integer: Columns of each block that are not zero.
    log_weights: FloatArray  #: (g,): ln of the prior probability of each value.
    price: float  #: 2·ln of the odds against this form.
    is_named: bool  #: Whether it is an installed effect.

    @property
    def identifier(self) -> str:
        """As jobs name the effect."""
        return self.effect.identifier

    def find_columns(self, block: int) -> IntArray:
        """Return the places of the columns of a block that are not zero: they come first."""
        return self.blocks[block, : self.ranks[block]]


def list_families_of(
    design: Design,
    columns: Columns,
    entries: Iterable[Entry],
    least_visible: float,
    *,
    is_named: bool = True,
) -> tuple[tuple[Family, ...], tuple[Effect, ...]]:
    """Return the families that a plan can see, and the effects of which it sees nothing.

    `entries`: Forms of effects that can be tested on the design, and the values that are tried.
    `least_visible`: Share of a block's length below which nothing is left of it but rounding.
    """
    listed = list(entries)
    count = {effect.identifier: 0 for effect, _ in listed}
    for effect, _ in listed:
        count[effect.identifier] += 1
    found, unseen = [], {}
    for effect, thetas in listed:
        blocks, ranks, seen = make_orthonormal(columns.space, design, effect, thetas, least_visible)
        if not len(seen):
            unseen[effect.identifier] = effect
            continue
        width = blocks.shape[2]
        places = columns.add(np.ascontiguousarray(blocks.reshape(len(blocks), -1)))
        own = (_PRICE_OF_COMMON if effect.common else PRICE) if is_named else NAMELESS_PRICE
        price = own + 2.0 * float(np.log(count[effect.identifier]))
        found.append(
            Family(
                effect,
                thetas[seen],
                places.reshape(len(seen), width),
                ranks,
                _compute_log_weights(design, effect, thetas[seen]),
                price,
                is_named,
            )
        )
    known = {each.identifier for each in found}
    return tuple(found), tuple(each for name, each in unseen.items() if name not in known)


def make_orthonormal(
    space: Contrasts, design: Design, effect: Effect, thetas: FloatArray, least: float
) -> tuple[FloatArray, IntArray, IntArray]:
    """Return what of an effect is seen beside the model, for each of some values of its parameters.

    Orthonormal contrasts, (N, g, k), the last of them zero where columns depend on each other; how many are
    not zero, (g,); which of the values are seen at all, (g,).
    """
    blocks = np.stack([effect.columns(design, theta) for theta in thetas])
    with np.errstate(over="ignore", invalid="ignore"):  # what has no finite value is not seen
        whole = np.linalg.norm(blocks, axis=(1, 2))
        contrasts = space.of(blocks.transpose(1, 0, 2)).transpose(1, 0, 2)
        shares = np.linalg.norm(contrasts, axis=(1, 2)) / np.where(whole > 0, whole, 1.0)
    seen = np.flatnonzero((shares > least) & (whole > _ROUNDING * blocks.shape[1] ** 0.5))
    lengths = np.linalg.norm(blocks[seen], axis=1, keepdims=True)
    scaled = contrasts[seen] / np.where(lengths > 0, lengths, 1.0)
    left, singular, _ = np.linalg.svd(scaled, full_matrices=False)
    independent = singular > least * singular[:, :1]
    together = (left * independent[:, np.newaxis, :]).transpose(1, 0, 2)
    return together, independent.sum(axis=1).astype(np.int64), seen.astype(np.int64)


def _compute_log_weights(design: Design, effect: Effect, thetas: FloatArray) -> FloatArray:
    """Return ln of the prior probabilities of values: all alike, but for some in time.

    What happens at one moment happens in a long pause rather than between two readings. A wave in time whose
    period is that of a run does the same in every run: what it explains, position and direction explain as
    well, and theirs is the better story.
    """
    weights = np.ones(len(thetas))
    for column, each in enumerate(effect.searched):
        if each.dimension is Dimension.TIME and not each.is_refined and find_pauses(design).any():
            moments = np.unique(design.time)
            after = np.clip(np.searchsorted(moments, thetas[:, column]), 1, len(moments) - 1)
            weights *= moments[after] - moments[after - 1]
    is_time = [each.name == "period" and each.dimension is Dimension.TIME for each in effect.searched]
    cell = number_cells(design)
    count = np.bincount(cell)
    if any(is_time) and len(thetas) > 1 and count.max() > 1:
        for number, theta in enumerate(thetas):
            wave = effect.columns(design, theta)
            wave = wave - wave.mean(axis=0)
            means = np.stack([np.bincount(cell, weights=each) / count for each in wave.T], axis=1)
            whole = float(np.sum(wave**2)) or 1.0
            weights[number] = max(1.0 - float(np.sum(means[cell] ** 2)) / whole, _LEAST_OWN)
    return np.asarray(np.log(weights / weights.sum()), dtype=np.float64)


def is_known(form: Effect, design: Design, columns: Columns, families: Sequence[Family]) -> bool:
    """Return whether installed effects have a form already, at nearly all of its values: it is no rival.

    Many a late beginning is a step or a passing warmth; those between are neither.
    """
    thetas = form.grid(design)
    blocks, _, seen = make_orthonormal(columns.space, design, form, thetas, _LEAST_SEEN)
    searched, imitated = count_searched(thetas), np.zeros(len(seen))
    for each in families if len(seen) else ():
        if count_searched(each.thetas) >= searched:
            products = columns.select_columns(each.blocks.ravel()).T @ blocks.reshape(len(blocks), -1)
            squares = (products**2).reshape(*each.blocks.shape, len(seen), -1).sum(axis=(1, 3))
            imitated = np.maximum(imitated, squares.max(axis=0) / blocks.shape[2])
    wholly, nearly = (np.count_nonzero(imitated > share) for share in (_WHOLLY, _NEARLY))
    return bool(wholly > _MOST * len(seen) and nearly >= _ALL * len(seen)) or not len(seen)


def count_searched(thetas: FloatArray) -> int:
    """Return how many parameters differ between the values of a grid."""
    return int(np.count_nonzero(np.ptp(thetas, axis=0) > 0))


def group_forms_by_effect(families: Sequence[Family]) -> tuple[tuple[int, ...], ...]:
    """Return for each installed effect the places of its forms among some families."""
    by_effect: dict[str, list[int]] = {}
    for place, each in enumerate(families):
        if each.is_named:
            by_effect.setdefault(each.identifier, []).append(place)
    return tuple(tuple(each) for each in by_effect.values())
