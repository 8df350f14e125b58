"""What is hidden in a test: effects of drawn parameters, of a stated size beyond the job's model."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace

import numpy as np

from hidden_effects.sizes import beyond, drawn_theta
from zlmreport.measurement.arrays import FloatArray
from zlmreport.model.effects.axis_model import Term
from zlmreport.model.effects.design import Design
from zlmreport.model.effects.effect import Effect, Parameter

#: A deviation of which a smaller share is left is imitated entirely.
_INVISIBLE = 1e-6
#: Steps of a search between the values of a grid.
_ROUNDS = 30


def drawn_effect(
    effect: Effect, design: Design, base: FloatArray, rms: float, random: np.random.Generator
) -> Term | None:
    """Return an effect in a form and with parameters drawn at random; None if the test cannot show it.

    Parameters
    ----------
    effect
        The effect.
    design
        The test, with its true conditions.
    base : (N, q) array
        Columns of the job's model.
    rms
        Root mean square value of what the model cannot imitate, m or rad.
    random
        Where everything comes from. No parameter is drawn that can only be positive and is not.

    Notes
    -----
    What would have to be physically impossible to be so large is not visible: no axis has it. Impossible is
    also what its log forbids: growth by 460 µm on an axis that warms up by 3 K.
    """
    forms = [form for form in effect.forms() if form.untestable(design) is None]
    if not forms:
        return None
    form = forms[int(random.integers(len(forms)))]
    theta = drawn_theta(form, design, random)
    columns = form.columns(design, theta)
    lengths = np.linalg.norm(columns, axis=0)
    gamma = random.standard_normal(columns.shape[1]) / np.where(lengths > 0, lengths, 1.0)
    only_positive = [parameter.smallest is not None and parameter.smallest >= 0 for parameter in form.linear]
    gamma = np.where(only_positive, np.abs(gamma), gamma)
    scale = scale_to(columns @ gamma, base, rms)
    if scale is None:
        return None
    values = dict(zip((each.name for each in form.linear), (scale * gamma).tolist(), strict=True))
    if not all(_is_possible(each, values[each.name]) for each in form.linear):
        return None
    values |= dict(zip((each.name for each in form.searched), theta.tolist(), strict=True))
    if form.forbids(design, values) is not None:
        return None
    return Term(form, values)


def _is_possible(parameter: Parameter, value: float) -> bool:
    low, high = parameter.smallest, parameter.largest
    return (low is None or low <= value) and (high is None or value <= high)


def scale_to(deviation: FloatArray, base: FloatArray, rms: float) -> float | None:
    """Return the factor that brings what a model cannot imitate to a size; None if it imitates everything."""
    left = float(np.sqrt(np.mean(beyond(base, deviation[:, np.newaxis]) ** 2)))
    whole = float(np.sqrt(np.mean(deviation**2)))
    return rms / left if left > _INVISIBLE * whole else None


@dataclass(frozen=True, slots=True)
class Imitation:
    """How well an effect describes the visible part of a deviation.

    Attributes
    ----------
    effect
        In one of its forms.
    share
        R², for the best of the values of its searched parameters from which a search begins.
    parameters
        How many it takes: visible columns, and searched parameters.
    theta : (s,) array
        These values.
    """

    effect: Effect
    share: float
    parameters: int
    theta: FloatArray


def imitations(
    deviation: FloatArray, effects: Iterable[Effect], design: Design, base: FloatArray
) -> tuple[Imitation, ...]:
    """Return how well each effect, in each form, describes what a model leaves visible of a deviation.

    An effect that would need a parameter of the wrong sign describes nothing.
    """
    visible = beyond(base, deviation[:, np.newaxis])[:, 0]
    found = []
    for form in (form for effect in effects for form in effect.forms()):
        if form.untestable(design) is not None:
            continue
        grid = form.grid(design)
        share, best, parameters = 0.0, grid[0], 0
        for theta in grid:
            own, rank = _share_of(visible, form, beyond(base, form.columns(design, theta)))
            if own > share:
                share, best = own, theta
            parameters = max(parameters, rank)
        searched = len(form.searched) if len(grid) > 1 else 0
        found.append(Imitation(form, share, parameters + searched, best))
    return tuple(found)


def _share_of(visible: FloatArray, form: Effect, columns: FloatArray) -> tuple[float, int]:
    """Return which share of the squares of a deviation columns describe, and how many of them are seen."""
    gamma, _, rank, _ = np.linalg.lstsq(columns, visible, rcond=_INVISIBLE)
    left = visible - columns @ gamma
    is_possible = _has_possible_signs(form, gamma)
    return (1.0 - float(left @ left) / float(visible @ visible) if is_possible else 0.0), int(rank)


def _find_gap_at(value: float, values: FloatArray) -> float:
    """Return the distance of a value of a grid from the next."""
    place = int(np.clip(np.searchsorted(values, value), 1, len(values) - 1))
    return float(values[place] - values[place - 1])


def refined(imitation: Imitation, deviation: FloatArray, design: Design, base: FloatArray) -> Imitation:
    """Return an imitation with its searched parameters between the values from which a search begins."""
    form, grid = imitation.effect, imitation.effect.grid(design)
    visible = beyond(base, deviation[:, np.newaxis])[:, 0]
    share, theta = imitation.share, imitation.theta
    columns = [
        place for place, each in enumerate(form.searched) if each.is_refined and np.ptp(grid[:, place])
    ]
    steps = {place: _find_gap_at(theta[place], np.unique(grid[:, place])) / 2 for place in columns}
    for _ in range(_ROUNDS if columns else 0):
        near = [
            theta + sign * step * (np.arange(len(theta)) == place)
            for place, step in steps.items()
            for sign in (-1, 1)
        ]
        shares = [_share_of(visible, form, beyond(base, form.columns(design, each)))[0] for each in near]
        if max(shares) > share:
            share, theta = max(shares), near[int(np.argmax(shares))]
        else:
            steps = {place: step / 2 for place, step in steps.items()}
    return replace(imitation, share=share, theta=theta)


def _has_possible_signs(effect: Effect, gamma: FloatArray) -> bool:
    if len(gamma) != 1:
        return True
    smallest = effect.linear[0].smallest
    return smallest is None or smallest < 0 or gamma[0] >= 0
