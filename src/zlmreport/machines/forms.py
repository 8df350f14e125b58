"""The forms in which an effect of circles is tried: its searched values, groups of its terms."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import combinations

import numpy as np

from zlmreport.machines.design import ThinnedDesign
from zlmreport.measurement.arrays import FloatArray
from zlmreport.model.effects.circle_effect import CircleEffect, CircleTerm, Searched

#: What one unit of a cause makes of the deviation where the readings hold nothing of it, but for doubles: a
#: spike that has died away, where no axis turns in the measured arc.
_NOTHING = 1e-12


@dataclass(frozen=True, slots=True)
class CircleForm:
    """One shape of an effect: the values of its searched parameters, and the terms that are fitted."""

    searched: Searched
    terms: tuple[CircleTerm, ...]

    @property
    def columns(self) -> FloatArray:
        """The columns side by side, (N, k)."""
        return np.column_stack([each.column for each in self.terms])

    @property
    def groups(self) -> frozenset[str]:
        """The groups of its terms."""
        return frozenset(each.group or each.name for each in self.terms)

    def keep_groups(self, chosen: frozenset[str]) -> CircleForm:
        """Return the form with the terms of some groups alone."""
        return CircleForm(
            self.searched, tuple(each for each in self.terms if (each.group or each.name) in chosen)
        )


def make_whole_form(effect: CircleEffect, design: ThinnedDesign, searched: Searched) -> CircleForm:
    """Return an effect with all of its terms that a design can show."""
    terms = effect.terms(design.fine, searched)
    thin = (replace(each, column=design.thin(each.column)) for each in terms)
    return CircleForm(searched, tuple(each for each in thin if np.any(np.abs(each.column) > _NOTHING)))


def make_form_at(
    effect: CircleEffect, design: ThinnedDesign, searched: Searched, like: CircleForm
) -> CircleForm:
    """Return the terms of a form at other searched values."""
    by_name = {each.name: each for each in effect.terms(design.fine, searched)}
    terms = (by_name[each.name] for each in like.terms)
    return CircleForm(searched, tuple(replace(each, column=design.thin(each.column)) for each in terms))


def make_plain_form(effect: CircleEffect, design: ThinnedDesign) -> CircleForm:
    """Return an effect at the first values of its searched parameters; without terms if there are none."""
    grid = effect.grid(design.fine)
    return make_whole_form(effect, design, grid[0]) if grid else CircleForm((), ())


def split_parts_of(effect: CircleEffect, whole: CircleForm) -> tuple[CircleForm, ...]:
    """Return a form with each group of its terms by itself, and with all of them."""
    groups = sorted(whole.groups)
    sizes = {len(groups)} if effect.is_base else {1} if effect.is_single else {1, len(groups)}
    return tuple(
        whole.keep_groups(frozenset(chosen))
        for size in sorted(sizes - {0})
        for chosen in combinations(groups, size)
    )


def list_forms_of(effect: CircleEffect, design: ThinnedDesign) -> tuple[CircleForm, ...]:
    """Return the forms that a design can show: for each searched value, each group of terms and all."""
    return tuple(
        part
        for searched in effect.grid(design.fine)
        for part in split_parts_of(effect, make_whole_form(effect, design, searched))
    )


def find_best_of_kinds(
    effect: CircleEffect, forms: Sequence[CircleForm], worth: FloatArray
) -> list[CircleForm]:
    """Return the best form of each kind, best first: those of one differ by what is refined and by groups.

    `worth`, (forms,): how good each is.
    """
    found: dict[Searched, CircleForm] = {}
    for index in np.argsort(-worth, kind="stable").tolist():
        pairs = zip(effect.searched, forms[index].searched, strict=True)
        found.setdefault(tuple(value for each, value in pairs if not each.is_refined), forms[index])
    return list(found.values())
