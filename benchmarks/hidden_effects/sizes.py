"""How large an effect is where it counts: in what the model of a job cannot imitate.

ρ is the root mean square of that part over σ, the repeatability of a single reading. Of raw amplitudes no
two positioning methods could be compared: what stands out in one test hides in another.
"""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from zlmreport.measurement.arrays import FloatArray
from zlmreport.model.effects.axis_model import Term
from zlmreport.model.effects.design import Design
from zlmreport.model.effects.effect import Effect
from zlmreport.model.effects.formula import OTHER

#: Directions of a base model shorter than this share of the longest are no directions of their own.
_DEPENDENT = 1e-9
#: A column of which a smaller share is left is imitated entirely.
_INVISIBLE = 1e-6


def base_columns(effects: Iterable[Effect], design: Design) -> FloatArray:
    """Return the columns of a model without searched parameters, side by side, shape (N, q)."""
    nothing = np.empty(0)
    return np.column_stack([effect.columns(design, nothing) for effect in effects])


def beyond(base: FloatArray, deviations: FloatArray) -> FloatArray:
    """Return what a base model cannot imitate of deviations, one column each, shape (N, k)."""
    lengths = np.linalg.norm(base, axis=0)
    left, singular, _ = np.linalg.svd(base / np.where(lengths > 0, lengths, 1.0), full_matrices=False)
    directions = left[:, singular > _DEPENDENT * singular[0]]
    return np.asarray(deviations - directions @ (directions.T @ deviations))


def scaled_effect(
    effect: Effect, design: Design, base: FloatArray, rms: float, random: np.random.Generator
) -> Term | None:
    """Return an effect drawn at random, of a stated size beyond the base model; None if it is not visible.

    Parameters
    ----------
    effect
        The effect, testable on the design.
    design
        The test.
    base : (N, q) array
        Columns of the base model.
    rms
        ρ·σ, m or rad.
    random
        Draws θ and the direction in the space of γ. Signs stay plausible: γ is not negative where it
        cannot be.
    """
    theta = drawn_theta(effect, design, random)
    columns = effect.columns(design, theta)
    gamma = random.standard_normal(len(effect.linear))
    lengths = np.linalg.norm(columns, axis=0)
    gamma = gamma / np.where(lengths > 0, lengths, 1.0)
    cannot_fall = [parameter.smallest is not None and parameter.smallest >= 0 for parameter in effect.linear]
    gamma = np.where(cannot_fall, np.abs(gamma), gamma)
    whole = columns @ gamma
    left = np.sqrt(np.mean(beyond(base, whole[:, np.newaxis]) ** 2))
    if left <= _INVISIBLE * np.sqrt(np.mean(whole**2)):
        return None
    gamma = gamma * rms / left
    values = dict(zip((each.name for each in effect.linear), gamma.tolist(), strict=True))
    values |= dict(zip((each.name for each in effect.searched), theta.tolist(), strict=True))
    return Term(effect, values)


def drawn_theta(effect: Effect, design: Design, random: np.random.Generator) -> FloatArray:
    """Return searched parameters drawn at random: a row of the grid, or a point between two of them.

    A pitch that is another than the stated one is one in use.
    """
    grid = effect.grid(design)
    row = int(random.integers(len(grid)))
    towards = grid[min(row + 1, len(grid) - 1)]
    is_in_use = OTHER in dict(effect.settings).values()
    is_between = np.array([each.is_refined and not is_in_use for each in effect.searched], dtype=np.float64)
    share = random.random(len(effect.searched)) * is_between
    return np.asarray(grid[row] + share * (towards - grid[row]))
