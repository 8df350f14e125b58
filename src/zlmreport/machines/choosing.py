"""The best form of an effect for circles: its searched values, also between those of the grid."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import replace

import numpy as np

from zlmreport.machines.course import CircularTest
from zlmreport.machines.forms import (
    CircleForm,
    find_best_of_kinds,
    list_forms_of,
    make_form_at,
    make_whole_form,
)
from zlmreport.machines.machine import MachineModel
from zlmreport.machines.study import Chosen, CircleStudy, study_bare
from zlmreport.measurement.arrays import FloatArray
from zlmreport.model.effects.circle_effect import CircleEffect, Searched, SearchedParameter

#: Rounds of the search between two values of a grid, each with so many values.
_ROUNDS, _VALUES = 3, 9
#: Times that several searched values are refined one after the other.
_SWEEPS = 2
#: Of a searched value: the step by which the slope over it is taken.
_STEP = 1e-4
#: 2·ln of what each further term of a form must be worth.
_PRICE_OF_TERM = 2.0


def study_circles(
    machine: MachineModel, circles: Sequence[CircularTest], effects: Iterable[CircleEffect]
) -> CircleStudy:
    """Return the study of circles; effects that search for a value get the one that fits best."""
    study = study_bare(machine, circles)
    listed = list(effects)
    # What nothing is searched for comes first: the rest is searched beside it.
    for effect in sorted(listed, key=lambda each: bool(each.searched)):
        study = add_effect(study, effect)
    order = [each.identifier for each in listed]
    stated = sorted(study.effects, key=lambda each: order.index(each.effect.identifier))
    return replace(study, effects=tuple(stated))


def add_effect(study: CircleStudy, effect: CircleEffect, form: CircleForm | None = None) -> CircleStudy:
    """Return a study with one effect more, in the form that fits best or in that which is given.

    It comes in with all groups of its terms, unless it is one that has one at a time.
    """
    chosen = form or find_best_form(study, effect)
    if not effect.is_single:
        chosen = make_whole_form(effect, study.design, chosen.searched)
    return study.with_effect(Chosen(effect, chosen, _compute_tangents(study, effect, chosen)))


def add_form(study: CircleStudy, effect: CircleEffect, form: CircleForm) -> CircleStudy:
    """Return a study with one effect more, in just this form."""
    return study.with_effect(Chosen(effect, form, _compute_tangents(study, effect, form)))


class _Fit:
    """How well columns explain what a study leaves."""

    def __init__(self, study: CircleStudy) -> None:
        self._whitened = study.whitened
        read = self._whitened.whiten(study.deviation[:, np.newaxis])
        self._left = read - self._whitened.taken @ (self._whitened.taken.T @ read)
        self._variance = study.noise.sigma**2

    def compute_gain(self, form: CircleForm) -> float:
        """Return 2·ln of the likelihood ratio of a form, less the price of its terms."""
        columns = self._whitened.whiten(form.columns)
        matrix = self._whitened.multiply(columns, columns)
        products = (columns.T @ self._left)[:, 0]
        ratio = float(products @ np.linalg.pinv(matrix, rcond=1e-10) @ products) / self._variance
        return ratio - _PRICE_OF_TERM * len(form.terms)


def find_best_form(study: CircleStudy, effect: CircleEffect) -> CircleForm:
    """Return the form of an effect that fits best, its searched values refined."""
    fit = _Fit(study)
    forms = [form for form in list_forms_of(effect, study.design) if form.terms]
    worth = np.array([fit.compute_gain(form) for form in forms])
    kinds = [refine_form(study, effect, form) for form in find_best_of_kinds(effect, forms, worth)]
    return max(kinds, key=fit.compute_gain)


def refine_form(study: CircleStudy, effect: CircleEffect, form: CircleForm) -> CircleForm:
    """Return a form with those searched values refined between two of the grid that may be."""
    fit = _Fit(study)
    best = form.searched

    def of(searched: Searched) -> CircleForm:
        return make_form_at(effect, study.design, searched, form)

    values_of = _list_refined_values(study, effect)
    for place in [*values_of] * (_SWEEPS if len(values_of) > 1 else 1):
        values = values_of[place]
        nearest = int(np.argmin(np.abs(np.array(values) - best[place])))
        low, high = values[max(nearest - 1, 0)], values[min(nearest + 1, len(values) - 1)]
        for _ in range(_ROUNDS):
            tried = [_move_value(best, place, value) for value in np.linspace(low, high, _VALUES).tolist()]
            best = max(tried, key=lambda searched: fit.compute_gain(of(searched)))
            step = (high - low) / (_VALUES - 1)
            low, high = max(best[place] - step, low), min(best[place] + step, high)
    return of(best)


def measure_sharpness(study: CircleStudy, effect: CircleEffect, form: CircleForm) -> float:
    """Return ln of the share of a step of the grid to which refined searched values are known; 0 at most."""
    after = add_form(study, effect, form).list_estimates_of(effect.identifier)
    found = {each.name: each.expanded_uncertainty for each in after if each.term is None}
    total = 0.0
    for place, values in _list_refined_values(study, effect).items():
        expanded = found[effect.searched[place].name]
        if expanded and len(values) > 1:
            steps = np.gradient(np.array(values))
            step = float(np.interp(form.searched[place], values, steps))
            total += min(float(np.log(np.sqrt(2.0 * np.pi) * expanded / 2.0 / step)), 0.0)
    return total


def _list_refined_values(study: CircleStudy, effect: CircleEffect) -> dict[int, list[float]]:
    """Return the values of the grid of each searched parameter that is refined, by its place."""
    grid = list(effect.grid(study.design.fine))
    return {place: sorted({searched[place] for searched in grid}) for place in _find_refined_places(effect)}


def _find_refined_places(effect: CircleEffect) -> list[int]:
    return [place for place, parameter in enumerate(effect.searched) if parameter.is_refined]


def _move_value(searched: Searched, place: int, value: float) -> Searched:
    return tuple(value if index == place else each for index, each in enumerate(searched))


def _compute_tangents(
    study: CircleStudy, effect: CircleEffect, form: CircleForm
) -> tuple[tuple[SearchedParameter, FloatArray], ...]:
    """Return by how much Δr changes with each refined parameter, at the coefficients that fit."""
    places = _find_refined_places(effect)
    if not places:
        return ()
    base = study.base
    together = np.column_stack([base, form.columns])
    weights = np.linalg.lstsq(together, study.deviation, rcond=None)[0][base.shape[1] :]
    found = []
    for place in places:
        step = _STEP * abs(form.searched[place])
        ends = [
            make_form_at(
                effect,
                study.design,
                _move_value(form.searched, place, form.searched[place] + way * step),
                form,
            )
            for way in (-1.0, 1.0)
        ]
        low, high = (each.columns @ weights for each in ends)
        column = np.asarray((high - low) / (2.0 * step))
        if np.any(column):  # Of an effect of no size no value is determined.
            found.append((effect.searched[place], column))
    return tuple(found)
