"""Which effects can be tried beside a model, and what each could add to it.

What they add depends on the plan of the test and on the model, not on what was measured; so it is made once,
and every set of deviations, measured or simulated, is held against the same.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from itertools import groupby
from typing import TypeAlias

import numpy as np

from zlmreport.language import Words
from zlmreport.model.axis_model import AxisModel, ModelError, refuse_collisions
from zlmreport.model.contrasts import Contrasts, Metric
from zlmreport.model.design import Design
from zlmreport.model.effect import Effect
from zlmreport.quantities.arrays import FloatArray, IntArray

_IMITATED = Words(
    en="at these targets {effect} imitates it entirely",
    de="an diesen Zielpositionen ahmt {effect} ihn vollständig nach",
)
_THE_MODEL = Words(en="the model", de="das Modell")
_SHOWN_BY = Words(
    en="{imitated}; what would show it: {measurement}", de="{imitated}; was ihn zeigen würde: {measurement}"
)
#: A form of an effect, and the values of its searched parameters that are tried, shape (g, s).
Entry: TypeAlias = tuple[Effect, FloatArray]


@dataclass(frozen=True, slots=True)
class NotTestable:
    """An effect that the test cannot show."""

    effect: str  #: Its identifier.
    reason: Words  #: What it needs, or that the model imitates it.


@dataclass(frozen=True, slots=True)
class EffectsToTry:
    """The effects that can be tried beside a model."""

    forms: tuple[Effect, ...]  #: Every form of every effect.
    not_testable: tuple[NotTestable, ...]  #: Effects that the test cannot show in any form.


def effects_to_try(model: AxisModel, design: Design, effects: Iterable[Effect]) -> EffectsToTry:
    """Return the effects that can be tried beside a model.

    An effect that is in the model already enters only with forms that have more parameters: a polynomial
    of higher order.
    """
    present = {term.effect.identifier: len(term.effect.linear) for term in model.terms}
    forms: list[Effect] = []
    not_testable = []
    for effect in effects:
        least = present.get(effect.identifier, 0)
        listed = [form for form in effect.forms() if len(form.linear) > least]
        reasons = [form.untestable(design) or _collision(model, design, form) for form in listed]
        forms.extend(form for form, reason in zip(listed, reasons, strict=True) if reason is None)
        if listed and None not in reasons:
            not_testable.append(NotTestable(effect.identifier, reasons[0] or _imitated(model, effect)))
    return EffectsToTry(tuple(forms), tuple(not_testable))


def _collision(model: AxisModel, design: Design, effect: Effect) -> Words | None:
    """Return that the model would not be determined with the effect in it; None if it is."""
    extended = model.with_effect(effect)
    columns = [term.columns(design, term.grid(design)[0])[0] for term in extended.terms]
    try:
        refuse_collisions(extended, columns)
    except ModelError:
        return _imitated(model, effect)
    return None


def _imitated(model: AxisModel, effect: Effect) -> Words:
    """Return what imitates an effect entirely, and the measurement that would show it."""
    for term in model.terms:
        if effect.identifier in term.effect.contains:
            return _IMITATED.given(effect=term.effect.identifier)
    alike = [each for each in effect.confusions if each.effect in model.identifiers]
    words = _IMITATED.given(effect=alike[0].effect if alike else _THE_MODEL)
    known = (*alike, *effect.confusions)
    return _SHOWN_BY.given(imitated=words, measurement=known[0].told_apart_by) if known else words


@dataclass(frozen=True, slots=True)
class Family:
    """A form of an effect with every value of its searched parameters at which the plan can see it."""

    effect: Effect  #: The effect, in this form.
    thetas: FloatArray  #: (g, s): Values of the searched parameters, one row for each block of columns.
    visible: FloatArray  #: (g,): Length of each block's visible part over that of the whole, 0 to 1.


@dataclass(frozen=True, slots=True)
class BlockGroup:
    """All blocks of one width, those of a family side by side."""

    width: int  #: Columns of a block.
    families: slice  #: Their families, as a range of all families.
    starts: IntArray  #: (families,) integer: The first block of each family, counted within the group.
    columns: slice  #: Their columns, as a range of all columns.
    ranks: FloatArray  #: (blocks,): Columns of each block that are not zero.

    @property
    def blocks(self) -> int:
        """How many there are."""
        return len(self.ranks)


@dataclass(frozen=True, slots=True)
class Bases:
    """What all effects together could add to a model."""

    #: Forms of effects that the plan can see, in the order of the widths of their blocks.
    families: tuple[Family, ...]
    by_effect: tuple[tuple[int, ...], ...]  #: For each effect, the places of its forms among the families.
    #: Effects of which it sees no form: all they would add, the model has already.
    invisible: tuple[Effect, ...]
    groups: tuple[BlockGroup, ...]  #: The blocks by width.
    columns: FloatArray  #: (N, K): Error contrasts, orthonormal within each block.

    def roots(self, metric: Metric, shared: FloatArray) -> tuple[FloatArray, ...]:
        """Return for each group the inverse roots of its blocks' Gram matrices, shape (blocks, k, k).

        `metric`: The inner product for one φ.
        `shared`, (r, K): ZᵀU, products of the noise's factors and the columns.
        """
        found = []
        coordinates = metric.coordinates(shared)
        for group in self.groups:
            block = coordinates[:, group.columns]
            if group.width == 1:
                squares = np.einsum("rg,rg->g", block, block)
                found.append(1.0 / np.sqrt(1.0 - squares[:, np.newaxis, np.newaxis]))
            else:
                block = block.reshape(-1, group.blocks, group.width)
                gram = np.eye(group.width) - np.einsum("rgi,rgj->gij", block, block)
                found.append(np.linalg.inv(np.linalg.cholesky(gram)))
        return tuple(found)


def bases_of(design: Design, space: Contrasts, entries: Iterable[Entry], least_visible: float) -> Bases:
    """Return what effects could add to a model.

    `entries`: Forms of effects that can be tested on the design, those of one effect share its identifier;
        and the values of their searched parameters that are tried.
    `least_visible`: Share of a block's length below which nothing is left of it but rounding.
    """
    found = [(effect, _visible(design, space, effect, thetas, least_visible)) for effect, thetas in entries]
    seen = sorted((each for _, each in found if each), key=lambda each: each.blocks.shape[2])
    identifiers = dict.fromkeys(each.family.effect.identifier for each in seen)
    return Bases(
        tuple(each.family for each in seen),
        tuple(
            tuple(place for place, each in enumerate(seen) if each.family.effect.identifier == identifier)
            for identifier in identifiers
        ),
        tuple(
            {
                effect.identifier: effect
                for effect, each in found
                if not each and effect.identifier not in identifiers
            }.values()
        ),
        _groups(seen),
        np.concatenate(
            [np.empty((len(design.position), 0)), *(_columns(each.blocks) for each in seen)], axis=1
        ),
    )


@dataclass(frozen=True, slots=True)
class _Visible:
    """A family with its blocks of orthonormal contrasts, shape (g, N, k), and their ranks."""

    family: Family
    blocks: FloatArray
    ranks: FloatArray


def _visible(
    design: Design, space: Contrasts, effect: Effect, thetas: FloatArray, least: float
) -> _Visible | None:
    """Return what of an effect the plan can see beside the model; None if nothing."""
    blocks = np.stack([effect.columns(design, theta) for theta in thetas])
    whole = np.linalg.norm(blocks, axis=(1, 2))
    contrasts = space.of(blocks.transpose(1, 0, 2)).transpose(1, 0, 2)
    shares = np.linalg.norm(contrasts, axis=(1, 2)) / np.where(whole > 0, whole, 1.0)
    seen = shares > least
    if not seen.any():
        return None
    lengths = np.linalg.norm(blocks[seen], axis=1, keepdims=True)
    scaled = contrasts[seen] / np.where(lengths > 0, lengths, 1.0)
    left, singular, _ = np.linalg.svd(scaled, full_matrices=False)
    independent = singular > least * singular[:, :1]
    return _Visible(
        Family(effect, thetas[seen], shares[seen]),
        left * independent[:, np.newaxis, :],
        independent.sum(axis=1).astype(np.float64),
    )


def _columns(blocks: FloatArray) -> FloatArray:
    """Return blocks (g, N, k) side by side, shape (N, g·k)."""
    return blocks.transpose(1, 0, 2).reshape(blocks.shape[1], -1)


def _groups(seen: Sequence[_Visible]) -> tuple[BlockGroup, ...]:
    groups = []
    first_family = first_column = 0
    for width, members in groupby(seen, key=lambda each: each.blocks.shape[2]):
        listed = list(members)
        ranks = np.concatenate([each.ranks for each in listed])
        starts = np.cumsum([0, *(len(each.ranks) for each in listed)])[:-1]
        groups.append(
            BlockGroup(
                width,
                slice(first_family, first_family + len(listed)),
                starts.astype(np.int64),
                slice(first_column, first_column + len(ranks) * width),
                ranks,
            )
        )
        first_family += len(listed)
        first_column += len(ranks) * width
    return tuple(groups)
