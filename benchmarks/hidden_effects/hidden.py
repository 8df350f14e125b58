"""What is hidden in a test: effects of drawn parameters, of a stated size beyond the job's model."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np

from hidden_effects.sizes import beyond, drawn_theta
from zlmreport.measurement.arrays import FloatArray
from zlmreport.model.effects.axis_model import Term
from zlmreport.model.effects.design import Design
from zlmreport.model.effects.effect import Effect, Parameter

#: A deviation of which a smaller share is left is imitated entirely.
_INVISIBLE = 1e-6


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
    What would have to be physically impossible to be so large is not visible: no axis has it.
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
    """

    effect: Effect
    share: float
    parameters: int


def imitations(
    deviation: FloatArray, effects: Iterable[Effect], design: Design, base: FloatArray
) -> tuple[Imitation, ...]:
    """Return how well each effect, in each form, describes what a model leaves visible of a deviation.

    An effect that would need a parameter of the wrong sign describes nothing.
    """
    visible = beyond(base, deviation[:, np.newaxis])[:, 0]
    squares = float(visible @ visible)
    found = []
    for form in (form for effect in effects for form in effect.forms()):
        if form.untestable(design) is not None:
            continue
        grid = form.grid(design)
        share, parameters = 0.0, 0
        for theta in grid:
            columns = beyond(base, form.columns(design, theta))
            gamma, _, rank, _ = np.linalg.lstsq(columns, visible, rcond=_INVISIBLE)
            left = visible - columns @ gamma
            if _has_possible_signs(form, gamma):
                share = max(share, 1.0 - float(left @ left) / squares)
            parameters = max(parameters, int(rank))
        searched = len(form.searched) if len(grid) > 1 else 0
        found.append(Imitation(form, share, parameters + searched))
    return tuple(found)


def _has_possible_signs(effect: Effect, gamma: FloatArray) -> bool:
    if len(gamma) != 1:
        return True
    smallest = effect.linear[0].smallest
    return smallest is None or smallest < 0 or gamma[0] >= 0
