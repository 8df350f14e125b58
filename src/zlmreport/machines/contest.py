"""The contest of a machine: which effect, or curve without a name, explains best what the model leaves.

Evidence is 2·ln of a Bayes factor against the model alone: the likelihood averaged over the sizes that an
effect may have, over its forms and searched values, and over the noise. A curve without a name is a random
curve of one amplitude, and not a series of waves with free coefficients: it then costs no more than the
readings make it, and a named effect that merely resembles what is there loses to it.

How large evidence becomes by chance is found by simulation: the same contest on deviations that hold nothing
but the noise that was found. A false alarm is an excess of any candidate over what it usually reaches.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import NamedTuple, TypeAlias

import numpy as np

from zlmreport.language import Words
from zlmreport.machines.design import ThinnedDesign
from zlmreport.machines.forms import CircleForm, find_best_of_kinds
from zlmreport.machines.noise import NoiseFound, NoiseModel, Whitened, bound_square
from zlmreport.measurement.arrays import BoolArray, FloatArray
from zlmreport.model.diagnosis.null_distribution import LEVEL, NullDistribution, PValue, Scores
from zlmreport.model.effects.circle_design import AXES
from zlmreport.model.effects.circle_effect import CircleEffect

#: Root mean squares that an effect may have, in units of σ.
SIZES = np.array([0.1, 0.2, 0.4, 0.8, 1.6, 3.2, 6.4, 12.8, 25.6, 100.0])
#: Simulated tests.
TRIALS = 200
#: Whole waves about a circle, alike in both senses, that are tried as lobes.
_LOBES = range(5, 13)
#: Of the largest evidence, what an effect must have for its searched values to be refined.
_WORTH_REFINING = 0.5
#: Of a column's length that the base model must leave, for the column to be seen.
_LEAST_VISIBLE = 1e-4
_LEAST = 1e-9


@dataclass(frozen=True, slots=True)
class Nameless:
    """A random curve without a name, as any cause might make it."""

    shape: Words
    columns: FloatArray  #: (N, f): Their random combination is the curve, mean variance one.
    is_locked: bool = False  #: Whether it follows the reversals of an axis.


def make_nameless_curves(design: ThinnedDesign) -> tuple[Nameless, ...]:
    """Return the curves without names: even, odd, lobes, locked to the reversals of axes, in time."""
    found = []
    for length in (40.0, 15.0):
        smooth = _smooth(design.angle, np.radians(length))
        found.append(Nameless(_EVEN, smooth))
        if design.has_both_senses:
            found.append(Nameless(_ODD, smooth * design.sense[:, np.newaxis]))
    for order in _LOBES:
        waves = order * design.angle
        found.append(Nameless(_LOBED, np.column_stack([np.cos(waves), np.sin(waves)])))
    locked = {AXES[axis]: _sample_bumps(design.since_reversal(axis)) for axis in design.axes}
    if len(locked) > 1:
        locked[", ".join(locked)] = np.concatenate([*locked.values()], axis=1)
    found += [Nameless(_REVERSAL.given(axis=axes), bumps, is_locked=True) for axes, bumps in locked.items()]
    travelled = [
        _smooth_line(design.travelled, 0.5) * (design.turn == turn)[:, np.newaxis] for turn in design.turns
    ]
    found.append(Nameless(_TIME, np.concatenate(travelled, axis=1)))
    return tuple(replace(each, columns=_weigh_one(each.columns)) for each in found)


def _weigh_one(columns: FloatArray) -> FloatArray:
    return np.asarray(columns / np.sqrt(np.mean(np.sum(columns**2, axis=1))))


def _smooth(angle: FloatArray, length: float) -> FloatArray:
    orders = np.arange(1, 32)
    size = np.exp(-0.25 * (orders * length) ** 2)
    kept = size > 1e-2
    waves = np.outer(angle, orders[kept])
    return np.concatenate([size[kept] * np.cos(waves), size[kept] * np.sin(waves)], axis=1)


def _sample_bumps(since: FloatArray) -> FloatArray:
    """Return a random shape locked to a reversal, dying away over some 30°; nothing of an axis at rest."""
    known, since = np.isfinite(since), np.nan_to_num(since)
    places = np.radians(np.arange(0.0, 48.0, 3.0))
    bumps = np.exp(-0.5 * ((since[:, np.newaxis] - places) / np.radians(3.0)) ** 2)
    return np.asarray(bumps * np.exp(-places / np.radians(20.0)) * known[:, np.newaxis])


def _smooth_line(travelled: FloatArray, length: float) -> FloatArray:
    places = np.arange(0.0, float(travelled.max()) + length, length)
    return np.asarray(np.exp(-0.5 * ((travelled[:, np.newaxis] - places) / length) ** 2))


_EVEN = Words("smooth over the angle, alike in both senses")
_ODD = Words("smooth over the angle, opposite in the two senses")
_LOBED = Words("lobes about the circle, alike in both senses")
_REVERSAL = Words("locked to the reversals of {axis}")
_TIME = Words("smooth along the path, each turn in its own way")


class Held(NamedTuple):
    """What the contest is about."""

    model: NoiseModel  #: The noise under the base model.
    noise: NoiseFound  #: What of it the readings show.
    deviation: FloatArray  #: (N,), m.


#: Refines the searched values of an effect's form, and says what share of a step of their grid, ln, they are
#: known to.
Refine: TypeAlias = Callable[[CircleEffect, CircleForm], tuple[CircleForm, float]]


@dataclass(frozen=True, slots=True)
class Contender:
    """An effect with the form that fits best."""

    effect: CircleEffect
    form: CircleForm
    evidence: float
    p_value: PValue
    usual: float


@dataclass(frozen=True, slots=True)
class CircleContest:
    """The outcome of a contest."""

    contenders: tuple[Contender, ...]  #: Best first.
    shape: Words | None  #: The best curve without a name.
    shape_evidence: float
    probabilities: tuple[float, ...]  #: Of the contenders, if each cause was as likely before the test.
    p_value: PValue  #: Of the largest excess of any: that of a false alarm.


def contest(
    held: Held,
    effects: Sequence[tuple[CircleEffect, tuple[CircleForm, ...]]],
    nameless: Sequence[Nameless],
    refine: Refine,
    seed: int = 0,
) -> CircleContest:
    """Hold all effects and curves against what the base model leaves of the deviations.

    Chance is judged by the forms of the grid. Where an effect explains much, the likelihood is narrower than
    a step of the grid: its evidence is then that of the refined form, by Laplace's method.
    """
    model, noise, deviation = held
    random = np.random.default_rng(seed)
    drawn = random.choice(len(noise.shapes), TRIALS, p=noise.weights)
    shapes = [noise.shapes[index] for index in drawn.tolist()]
    simulated = model.noise.simulate(shapes, model.known, random)
    together = np.column_stack([deviation / noise.sigma, simulated])
    arenas = [_Arena(model.whiten(each), together) for each in noise.shapes]
    null = np.array([arena.null for arena in arenas])
    weight = _compute_shares(null)
    by_effect, best = [], []
    for effect, forms in effects:
        terms = list({id(term): term for form in forms for term in form.terms}.values())
        place = {id(term): index for index, term in enumerate(terms)}
        subsets = [[place[id(term)] for term in form.terms] for form in forms]
        columns = np.column_stack([term.column for term in terms])
        found = np.array([arena.compute_evidence(columns, subsets) for arena in arenas])
        by_effect.append(_average(found, weight))
        weighed = _average_over_noises(found, weight)[:, 0]
        best.append((effect, find_best_of_kinds(effect, forms, weighed)))
    by_shape = [
        _average(np.array([[arena.compute_evidence_of_curve(each.columns)] for arena in arenas]), weight)
        for each in nameless
    ]
    named = 2.0 * np.array(by_effect).reshape(len(best), -1)
    curves = 2.0 * np.array(by_shape).reshape(len(nameless), -1)
    usual, usual_curves = (
        np.quantile(each[:, 1:], 1 - LEVEL, axis=1) if len(each) else np.zeros(0) for each in (named, curves)
    )
    chance = NullDistribution(named[:, 1:], curves[:, 1:], usual, usual_curves, 0.0)
    own = Scores(named[:, :1], curves[:, :1])
    contenders = []
    for index, (effect, kinds) in enumerate(best):
        value, form = float(named[index, 0]), kinds[0]
        p_value = chance.compute_p_value_of_effect(index, value)
        is_worth_it = value > max(_WORTH_REFINING * float(named[:, 0].max()), 0.0)
        for refined, share in (refine(effect, kind) for kind in kinds if is_worth_it):
            sharp = _weigh_refined(arenas, weight, refined, share - float(np.log(len(effects[index][1]))))
            form, value = (refined, sharp) if sharp > value else (form, value)
        contenders.append(Contender(effect, form, value, p_value, float(usual[index])))
    reached = np.array([each.evidence for each in contenders])
    all_of_them = np.concatenate([[0.0], reached, curves[:, 0]]) / 2.0
    shares = np.exp(all_of_them - all_of_them.max())
    shares /= shares.sum()
    order = np.argsort(-reached, kind="stable").tolist()
    leading = int(np.argmax(curves[:, 0])) if len(curves) else None
    return CircleContest(
        tuple(contenders[index] for index in order),
        None if leading is None else nameless[leading].shape,
        -np.inf if leading is None else float(curves[leading, 0]),
        tuple(float(shares[1 + index]) for index in order),
        chance.compute_p_value(own),
    )


def _weigh_refined(arenas: Sequence[_Arena], weight: FloatArray, form: CircleForm, prior: float) -> float:
    """Return the evidence of one form alone; `prior`: ln of the probability that it was given before."""
    whole = [list(range(len(form.terms)))]
    found = np.array([arena.compute_evidence(form.columns, whole) for arena in arenas])
    return float(2.0 * (_average_over_noises(found, weight)[0, 0] + prior))


class _Arena:
    """All deviations under one noise."""

    def __init__(self, whitened: Whitened, together: FloatArray) -> None:
        self._whitened = whitened
        own = whitened.whiten(together)
        self._left = own - whitened.taken @ (whitened.taken.T @ own)
        self._squares = bound_square(np.sum(own * self._left, axis=0), np.sum(own**2, axis=0))
        self._freedom = whitened.freedom
        self.null = -0.5 * whitened.log_determinant - 0.5 * self._freedom * np.log(self._squares)

    def compute_evidence(self, columns: FloatArray, subsets: Sequence[Sequence[int]]) -> FloatArray:
        """Return ln of the Bayes factor of subsets of columns, their size averaged over: (subsets, B)."""
        own = self._whitened.whiten(columns / np.sqrt(np.mean(columns**2, axis=0)))
        inside, products = self._whitened.taken.T @ own, own.T @ self._left
        lengths, gram = np.sum(own**2, axis=0), own.T @ own - inside.T @ inside
        found = np.zeros((len(subsets), len(self._squares)))
        for count in {len(each) for each in subsets}:
            alike = np.array([index for index, each in enumerate(subsets) if len(each) == count])
            chosen = np.array([subsets[index] for index in alike.tolist()])
            strengths, turn = np.linalg.eigh(gram[chosen[:, :, np.newaxis], chosen[:, np.newaxis, :]])
            kept = strengths > _LEAST_VISIBLE * lengths[chosen].max(axis=1, keepdims=True)
            turned = turn.swapaxes(1, 2) @ products[chosen]
            found[alike] = self._average_over_sizes(strengths, kept, turned)
        return found

    def _average_over_sizes(self, strengths: FloatArray, kept: BoolArray, products: FloatArray) -> FloatArray:
        """Return ln of the mean Bayes factor over the sizes; forms lead, (F, k) and (F, k, B)."""
        parts = np.divide(
            products**2, strengths[..., np.newaxis], out=np.zeros_like(products), where=kept[..., np.newaxis]
        )
        explained = np.minimum(parts.sum(axis=1) / self._squares, 1.0 - _LEAST)
        number = kept.sum(axis=1)
        worth = SIZES[:, np.newaxis] ** 2 * np.sum(strengths * kept, axis=1) / np.maximum(number, 1)
        inside = 1.0 - explained * (worth / (1.0 + worth))[..., np.newaxis]
        prior = -0.5 * number * np.log1p(worth)
        return _compute_log_mean(prior[..., np.newaxis] - 0.5 * self._freedom * np.log(inside))

    def compute_evidence_of_curve(self, columns: FloatArray) -> FloatArray:
        """Return the same of a random curve: its coefficients are averaged over, whatever their number."""
        own = self._whitened.whiten(columns)
        strengths, products = _make_independent(own, self._whitened.taken.T @ own, own.T @ self._left)
        logs = []
        for size in SIZES:
            shrunk = size**2 / (1.0 + size**2 * strengths)
            explained = np.sum(products**2 * shrunk[:, np.newaxis], axis=0) / self._squares
            inside = 1.0 - np.minimum(explained, 1.0 - _LEAST)
            logs.append(
                -0.5 * float(np.sum(np.log1p(size**2 * strengths))) - 0.5 * self._freedom * np.log(inside)
            )
        return _compute_log_mean(np.array(logs))


def _make_independent(
    own: FloatArray, inside: FloatArray, products: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Return strengths of independent combinations of columns, and their products with the deviations.

    `own`, (N, k): the whitened columns; `inside`, (r, k): their products with what the base takes out.
    """
    strengths, turn = np.linalg.eigh(own.T @ own - inside.T @ inside)
    kept = strengths > _LEAST_VISIBLE * float(np.sum(own**2, axis=0).max())
    return strengths[kept], turn[:, kept].T @ products


def _compute_shares(null: FloatArray) -> FloatArray:
    """Return the probability of each noise for each deviation, (noises, B)."""
    shares = np.exp(null - null.max(axis=0))
    return np.asarray(shares / shares.sum(axis=0))


def _average_over_noises(found: FloatArray, weight: FloatArray) -> FloatArray:
    """Return ln of the mean Bayes factor over the noises, (forms, B)."""
    most = found.max(axis=0)
    return np.asarray(most + np.log(np.sum(weight[:, np.newaxis] * np.exp(found - most), axis=0)))


def _average(found: FloatArray, weight: FloatArray) -> FloatArray:
    """Return ln of the mean Bayes factor over noises and forms, (B,)."""
    return _compute_log_mean(_average_over_noises(found, weight))


def _compute_log_mean(logs: FloatArray) -> FloatArray:
    most = logs.max(axis=0)
    return np.asarray(most + np.log(np.mean(np.exp(logs - most), axis=0)))
