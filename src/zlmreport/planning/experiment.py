"""The next experiment: the plan that tells effects apart which a test leaves equal, or which it hides.

Plans are simulated with each of the effects as the truth: its parameters drawn about their estimates, the
noise that the test showed. An experiment decides where the evidence then has the true effect among those
that lead, and clearly before its rivals; the cheapest that will is advised.
"""

from __future__ import annotations

import contextlib
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial
from itertools import combinations

import numpy as np

from zlmreport.language import Words
from zlmreport.measurement.axis import Axis
from zlmreport.model import wording
from zlmreport.model.axis_model import AxisModel
from zlmreport.model.candidates import effects_to_try
from zlmreport.model.comparison import Comparison, Told, untold
from zlmreport.model.design import Design
from zlmreport.model.effect import Dimension, Effect
from zlmreport.model.evidence import MENTION, NAMED
from zlmreport.model.fit import Fit
from zlmreport.model.noise import NoiseSource
from zlmreport.model.report import listed
from zlmreport.planning.changes import Change, further_changes, together, within_travel
from zlmreport.planning.methods import RUN_BY_RUN
from zlmreport.planning.plan import Expected, Plan, beyond_travel
from zlmreport.planning.visibility import expected_design, logs_of
from zlmreport.quantities.arrays import FloatArray, read_only_floats

#: The probability from which on an experiment is taken to decide, and below which none is advised.
_ENOUGH, _NOT_WORTH_IT = 0.95, 0.5
#: Simulated tests of each truth: at a first look, and of the plans that looked best.
_SETS, _SETS_OF_THE_BEST = 24, 40
#: Plans that are simulated with all their rivals, and changes that are combined.
_BEST, _COMBINED = 3, 5
#: More readings are not simulated.
_MOST_READINGS = 1000
#: Of the test as it was, no more are repeated.
_MOST_TARGETS, _MOST_RUNS = 41, 10
_SECONDS_PER_MINUTE = 60.0
#: Share of the coefficients that shrinking must leave.
_STANDS_OUT = 0.5

_AS_IT_IS = Words(en="measure by the plan as it is", de="nach dem Plan messen, wie er ist")
_ADVICE = Words(
    en="To tell {effects} apart: {advice}. It takes about {minutes} min and decides with a probability of "
    "{decides} %.",
    de="Um {effects} zu unterscheiden: {advice}. Es dauert etwa {minutes} min und entscheidet mit einer "
    "Wahrscheinlichkeit von {decides} %.",
)
_LOG = Words(en="{advice}; log {logs}", de="{advice}; {logs} aufzeichnen")
_NONE = Words(
    en="None of the {count} plans that were simulated tells {effects} apart: the best decides with a "
    "probability of {decides} %.",
    de="Keiner der {count} simulierten Pläne unterscheidet {effects}: der beste entscheidet mit einer "
    "Wahrscheinlichkeit von {decides} %.",
)
_TAKEN = Words(
    en="{statement} The size of {effects} is not known: taken is {size} rms.",
    de="{statement} Die Größe von {effects} ist nicht bekannt: angenommen ist ein quadratisches Mittel von "
    "{size}.",
)
_INSTEAD = Words(en="{statement} Instead: {advice}.", de="{statement} Stattdessen: {advice}.")


@dataclass(frozen=True, slots=True)
class Rival:
    """An effect that may be the true one."""

    effect: Effect  #: In one form.
    probability: float  #: That it is.
    #: theta and gamma: (s,), (k,): Its searched and linear parameters, SI; empty γ where no readings tell
    #: them.
    theta: FloatArray
    gamma: FloatArray
    root: FloatArray  #: (k + s, k + s): A factor of their covariance.
    size: float = 0.0  #: Where no readings tell its parameters: its root mean square value, m or rad.
    kept: float = 1.0  #: What the shrinking left of its coefficients, 0 to 1.

    @property
    def stands_out(self) -> bool:
        """Whether its estimate is more than chance."""
        return self.kept > _STANDS_OUT

    @classmethod
    def fitted(cls, after: Fit, probability: float) -> Rival:
        """Return the last effect of a fitted model.

        What stands out little is overestimated where it was chosen for its size: its coefficients are
        shrunk as W. James and C. Stein have it, by 1 − k/χ².
        """
        index = len(after.model.terms) - 1
        term = after.model.terms[index]
        count = len(after.uncertainties.inverse)
        last = count - len(after.places)
        first = last - int(np.count_nonzero(term.is_solved))
        gamma = after.solution.coefficients[index]
        places = [(number, place.column) for number, place in enumerate(after.places) if place.term == index]
        own = np.array([*range(first, last), *(last + number for number, _ in places)], dtype=np.int64)
        covariance = after.uncertainties.sigma**2 * after.uncertainties.inverse[np.ix_(own, own)]
        values, vectors = np.linalg.eigh(covariance)
        rows = [*range(len(gamma)), *(len(gamma) + column for _, column in places)]
        root = np.zeros((len(gamma) + len(term.effect.searched), len(own)))
        root[rows] = vectors * np.sqrt(np.maximum(values, 0.0))
        kept = 1.0
        if not term.effect.contains:
            square = float(gamma @ np.linalg.pinv(covariance[: len(gamma), : len(gamma)]) @ gamma)
            kept = max(0.0, 1.0 - len(gamma) / square) if square else 0.0
        return cls(term.effect, probability, after.solution.thetas[index], kept * gamma, root, kept=kept)

    @classmethod
    def of_size(cls, effect: Effect, probability: float, size: float) -> Rival:
        """Return an effect of which nothing but its size can be said."""
        return cls(effect, probability, np.empty(0), np.empty(0), np.empty((0, 0)), size)

    def deviation(self, design: Design, grid: FloatArray, random: np.random.Generator) -> FloatArray:
        """Return what it would do in a test, drawn at random, shape (N,), m or rad."""
        if not self.gamma.size:
            columns = self.effect.columns(design, grid[random.integers(len(grid))])
            lengths = np.std(columns, axis=0)
            gamma = random.standard_normal(columns.shape[1]) / np.where(lengths > 0, lengths, 1.0)
            gamma = gamma * (self.size / (float(np.std(columns @ gamma)) or 1.0))
            return columns @ _possible(gamma, self.effect)
        drawn = self.root @ random.standard_normal(self.root.shape[1])
        theta = self.theta + drawn[len(self.gamma) :]
        extent = np.ptp(grid, axis=0)
        distances = (grid - theta) / np.where(extent > 0, extent, 1.0)
        nearest = grid[int(np.argmin(np.sum(distances**2, axis=1)))]
        return self.effect.columns(design, nearest) @ (self.gamma + drawn[: len(self.gamma)])


def _possible(gamma: FloatArray, effect: Effect) -> FloatArray:
    """Return coefficients with possible signs, all brought down until none is larger than is plausible."""
    share, signed = 1.0, gamma.copy()
    for index, parameter in enumerate(effect.linear):
        low = -np.inf if parameter.smallest is None else parameter.smallest
        high = np.inf if parameter.largest is None else parameter.largest
        if low >= 0 or high <= 0:
            signed[index] = abs(gamma[index]) * (1.0 if low >= 0 else -1.0)
        limit = high if signed[index] > 0 else -low
        share = min(share, limit / abs(signed[index])) if signed[index] else share
    return signed * share


@dataclass(frozen=True, slots=True)
class Question:
    """Which of several effects it is."""

    #: axis and model: The axis, and the effects beside which they stand.
    axis: Axis
    model: AxisModel
    base: Callable[[Design], FloatArray]  #: Returns what the model can imitate in a test, shape (N, p).
    rivals: tuple[Rival, ...]  #: The effects in question.
    #: sigma and degrees: Repeatability of single readings, m or rad, and how well it is known.
    sigma: float
    degrees: int
    ratios: Mapping[NoiseSource, float]  #: φ of the other sources of scatter.
    known: float = 0.0  #: Standard deviation of a noise of known size beside σ, m or rad.
    #: The travel on which the parameters hold, m or rad; None for that of each plan.
    span: tuple[float, float] | None = None
    #: Columns that were logged, with the last value of each; None for all that can be expected.
    logged: Mapping[str, float] | None = None

    @property
    def names(self) -> tuple[str, ...]:
        """Identifiers of the effects in question."""
        return tuple(rival.effect.identifier for rival in self.rivals)

    def design(self, plan: Plan, expected: Expected) -> Design:
        """Return a plan as effects see it, with the logs of the test and those that the rivals ask for."""
        design = expected_design(self.axis, plan, expected)
        if self.span:
            design = replace(design, span=self.span)
        if self.logged is None:
            return design
        kept = {*self.logged, *self.logs(design)}
        conditions = {name: log for name, log in design.conditions.items() if name in kept}
        for name, value in self.logged.items():
            if name not in conditions:
                conditions[name] = read_only_floats(np.full(len(design.position), value))
        return replace(design, conditions=conditions)

    def logs(self, design: Design) -> tuple[str, ...]:
        """Return the columns that the effects in question ask for."""
        asked = (name for rival in self.rivals for name in logs_of(rival.effect, design))
        return tuple(name for name in dict.fromkeys(asked) if name in design.conditions)


@dataclass(frozen=True, slots=True)
class Experiment:
    """What to measure next."""

    effects: tuple[str, ...]  #: Identifiers of those that it tells apart.
    plan: Plan | None  #: The plan; None where none that was simulated decides more often than not.
    logs: tuple[str, ...]  #: Columns to log beside the readings.
    minutes: float  #: What it takes; 0 without a plan.
    decides: float  #: The probability that it decides.
    statement: Words  #: All this in a sentence or two.


@dataclass(frozen=True, slots=True)
class _Option:
    """A plan with what led to it, how often it decides, and by how much of evidence in nine of ten tests."""

    changes: tuple[Change, ...]
    plan: Plan
    decides: float = 0.0
    margin: float = -np.inf


def next_experiment(  # noqa: PLR0913 - what is asked, what is known, what may be, and who is told
    question: Question,
    plan: Plan,
    expected: Expected,
    effects: Sequence[Effect],
    seed: int,
    *,
    told: Told = untold,
) -> Experiment:
    """Return the cheapest plan that decides a question; the best one if none is sure to."""
    looked = partial(_glance, question, expected, seed)
    plan = within_travel(question.axis, _of_moderate_size(plan))
    changes = tuple(further_changes(question.axis, plan, seed, _period(question)))
    options: list[_Option] = []
    for each in _options(question.axis, plan, [(), *((one,) for one in changes)]):
        options.append(looked(each))
        told(0.5 * len(options) / (1 + len(changes)))
    if all(each.decides < _ENOUGH for each in options):
        leading = sorted(options, key=_surest)[:_COMBINED]
        single = [each.changes[0] for each in leading if each.changes]
        several = [each for count in (2, 3) for each in combinations(single, count)]
        apart = [each for each in several if len({change.of for change in each}) == len(each)]
        options += [looked(each) for each in _options(question.axis, plan, apart)]
    promising = [each for each in options if each.decides >= _ENOUGH]
    surest = sorted(options, key=_surest)
    order = [*sorted(promising, key=lambda each: each.plan.duration)[:1], *surest]
    order = [each for number, each in enumerate(order) if each not in order[:number]]
    tried: list[_Option] = []
    told(0.75)
    for option in order[:_BEST] if order[0].decides >= _NOT_WORTH_IT else order[:1]:
        tried.append(_thorough(question, expected, effects, seed, option))
        if tried[-1].decides >= _ENOUGH:
            break
    best = max(tried, key=lambda each: each.decides)
    return _experiment(question, expected, best, len(options))


def _surest(option: _Option) -> tuple[float, float]:
    return -option.decides, -option.margin


def _of_moderate_size(plan: Plan) -> Plan:
    """Return a plan of no more targets and runs than an experiment needs, spread as they were."""
    places = np.linspace(0, len(plan.targets) - 1, min(len(plan.targets), _MOST_TARGETS)).astype(np.int64)
    return replace(plan, targets=read_only_floats(plan.targets[places]), runs=min(plan.runs, _MOST_RUNS))


def _period(question: Question) -> float | None:
    """Return the longest period of the effects in question, as estimated; None if they have none."""
    found = [
        float(value)
        for rival in question.rivals
        for parameter, value in zip(rival.effect.searched, rival.theta.tolist(), strict=False)
        if parameter.dimension is Dimension.POSITION and parameter.name == "period"
    ]
    return max(found, default=None)


def _options(axis: Axis, plan: Plan, choices: Sequence[Sequence[Change]]) -> Iterator[_Option]:
    """Yield the plans that changes lead to: those that the axis can follow, and that are not too long."""
    for choice in choices:
        # targets that do not fit into the travel
        with contextlib.suppress(ValueError):
            changed = together(choice).changed(plan) if choice else plan
            fits = changed.readings <= _MOST_READINGS and len(changed.targets) > 1
            paused = changed.pause is None or changed.method in RUN_BY_RUN
            if fits and paused and beyond_travel(axis, changed) is None:
                yield _Option(tuple(choice), changed)


def _glance(question: Question, expected: Expected, seed: int, option: _Option) -> _Option:
    """Return how often a plan would decide if only the rivals were possible, and the noise known."""
    design = question.design(option.plan, expected)
    visible = [each.effect for each in question.rivals if each.effect.untestable(design) is None]
    if len(visible) < len(question.rivals):
        return option
    comparison = Comparison.quick(design, question.base(design), visible, question.ratios)
    decides, margin = _decided(question, design, comparison, _SETS, seed)
    return replace(option, decides=decides, margin=margin)


def _thorough(
    question: Question, expected: Expected, effects: Sequence[Effect], seed: int, option: _Option
) -> _Option:
    """Return how often a plan decides among all effects and shapes, whatever the noise."""
    design = question.design(option.plan, expected)
    if any(each.effect.untestable(design) for each in question.rivals):
        return option
    others = effects_to_try(question.model, design, effects).forms
    own = [each.effect for each in question.rivals]
    forms = [*own, *(each for each in others if each.identifier not in question.names)]
    comparison = Comparison.quick(design, question.base(design), forms)
    return replace(option, decides=_decided(question, design, comparison, _SETS_OF_THE_BEST, seed)[0])


def _decided(
    question: Question, design: Design, comparison: Comparison, sets: int, seed: int
) -> tuple[float, float]:
    """Return the share of tests that are decided rightly, truths as likely as they are; and the margin.

    By P. S. Laplace's rule of succession: what went well n times in n is not certain.
    """
    random = np.random.default_rng([seed, len(design.position)])
    sigma = question.sigma * np.sqrt(question.degrees / random.chisquare(question.degrees, sets))
    noise = random.standard_normal((len(design.position), sets))
    for part in comparison.space.parts:
        shared = random.standard_normal((part.factor.shape[1], sets))
        noise += part.factor @ (np.sqrt(question.ratios.get(part.source, 0.0)) * shared)
    bases = comparison.bases
    places = {bases.families[forms[0]].effect.identifier: row for row, forms in enumerate(bases.by_effect)}
    total = weight = 0.0
    margin = np.inf
    for rival in question.rivals:
        weight += rival.probability
        if rival.effect.identifier not in places:
            margin = -np.inf
            continue
        grid = rival.effect.grid(design)
        true = np.column_stack([rival.deviation(design, grid, random) for _ in range(sets)])
        evidence, nameless = comparison.evidence(true + sigma * noise, question.known)
        lead = _lead(evidence, nameless, places, rival.effect.identifier, question.names)
        total += rival.probability * (np.count_nonzero(lead > 0) + 1) / (sets + 2)
        margin = min(margin, float(np.quantile(lead, 0.1)))
    return (float(total / weight), margin) if weight else (0.0, -np.inf)


def _lead(
    evidence: FloatArray, nameless: FloatArray, places: Mapping[str, int], truth: str, rivals: Sequence[str]
) -> FloatArray:
    """Return by how much more evidence than it needs the truth leads in each set.

    It must surpass its rivals clearly, and no effect that nobody asks about may surpass it so.
    """
    own = evidence[places[truth]]
    margins = np.full(len(evidence), -MENTION)
    margins[[places[name] for name in rivals if name in places]] = MENTION
    others = np.delete(evidence + margins[:, np.newaxis], places[truth], axis=0)
    shapes = nameless.max(axis=0, initial=-np.inf) + NAMED
    needed = np.maximum(others.max(axis=0, initial=-np.inf), shapes)
    return np.asarray(own - np.maximum(needed, MENTION), dtype=np.float64)


def _experiment(question: Question, expected: Expected, best: _Option, count: int) -> Experiment:
    effects = listed(question.names)
    share = wording.number(100 * best.decides, 0)
    if best.decides < _NOT_WORTH_IT:
        none = _NONE.given(count=str(count), effects=effects, decides=share)
        known = _known_advice(question)
        statement = _INSTEAD.given(statement=none, advice=known) if known else none
        return Experiment(question.names, None, (), 0.0, best.decides, _with_sizes(question, statement))
    logs = question.logs(question.design(best.plan, expected))
    advice = together(best.changes).advice if best.changes else _AS_IT_IS
    if logs:
        advice = _LOG.given(advice=advice, logs=", ".join(logs))
    minutes = best.plan.duration / _SECONDS_PER_MINUTE
    statement = _ADVICE.given(
        effects=effects, advice=advice, minutes=wording.number(max(1.0, minutes), 0), decides=share
    )
    statement = _with_sizes(question, statement)
    return Experiment(question.names, best.plan, logs, minutes, best.decides, statement)


def _with_sizes(question: Question, statement: Words) -> Words:
    """Return a statement with what was taken for the size of effects that no readings tell."""
    taken = [rival for rival in question.rivals if not rival.gamma.size]
    if not taken:
        return statement
    size = wording.deviation(question.axis, max(rival.size for rival in taken))
    return _TAKEN.given(
        statement=statement, effects=listed([each.effect.identifier for each in taken]), size=size
    )


def _known_advice(question: Question) -> Words | None:
    """Return the other measurement that an effect's page names for one of its rivals."""
    names = {*question.names, *question.model.identifiers}
    for rival in question.rivals:
        for confusion in rival.effect.confusions:
            if confusion.effect in names:
                return confusion.told_apart_by
    return None
