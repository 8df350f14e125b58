"""The next experiment: the plan that tells effects apart which a test leaves equal, or shows a hidden one.

Plans are simulated with each of the effects as the truth: its parameters drawn about their estimates, the
noise that the test showed. An experiment decides where the evidence then has the true effect among those
that lead, and clearly before its rivals; the cheapest that will is advised.
"""

from __future__ import annotations

import contextlib
import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial
from itertools import combinations

import numpy as np

from zlmreport.language import Words, list_in_words
from zlmreport.language.numbers import number_words
from zlmreport.measurement.arrays import FloatArray, read_only_floats
from zlmreport.measurement.axis import Axis, find_usual_overrun
from zlmreport.measurement.units import SECONDS_PER_MINUTE
from zlmreport.model.diagnosis.believing import MENTION, NAMED, TOLD_APART
from zlmreport.model.diagnosis.contest import Contest, Told, tell_nobody
from zlmreport.model.diagnosis.effects_to_try import list_effects_to_try
from zlmreport.model.diagnosis.families import PRICE
from zlmreport.model.diagnosis.likelihood import Amplitudes
from zlmreport.model.diagnosis.random_curves import PRICE as NAMELESS_PRICE
from zlmreport.model.diagnosis.trials import Trials, average_evidence
from zlmreport.model.effects import wording
from zlmreport.model.effects.design import Design
from zlmreport.model.effects.effect import Dimension, Effect
from zlmreport.model.planning.changes import (
    PlanChange,
    join_changes,
    keep_within_travel,
    list_further_changes,
)
from zlmreport.model.planning.methods import RUN_BY_RUN
from zlmreport.model.planning.plan import AxisPlan, ExpectedTest, find_beyond_travel
from zlmreport.model.planning.rivals import Question
from zlmreport.model.planning.targets import makes_whole_turns

#: The probability from which on an experiment is taken to decide, and below which none is advised.
_ENOUGH, _NOT_WORTH_IT = 0.95, 0.5
#: Simulated tests, shared out among the truths: at a first look, of the plans that looked best, and of what
#: is promised. The last are drawn anew: a plan chosen for what its tests showed shows less in others.
_SETS, _SETS_OF_THE_BEST, _SETS_OF_A_PROMISE = 40, 80, 120
#: Of a truth that is hardly likely, for its margin.
_FEWEST_SETS = 8
#: Plans that are simulated with all their rivals, and changes that are combined.
_BEST, _COMBINED = 2, 4
#: More readings are not simulated.
_MOST_READINGS = 1000
#: Of the test as it was, no more are repeated.
_MOST_TARGETS, _MOST_RUNS = 41, 10

_AS_IT_IS = Words("measure by the plan as it is")
_ADVICE = Words(
    "{aim}: {advice}. It takes about {minutes} min and decides with a probability of {decides} %."
)
_TO_TELL = Words("To tell {effects} apart")
_TO_SHOW = Words("To show {effects}")
_LOG = Words("{advice}; log {logs}")
_NONE = Words(
    "{aim}: none of the {count} plans that were simulated does; the best decides with a probability of "
    "{decides} %."
)
_LACKS = Words("{statement} {effect}: {reason}.")
_INSTEAD = Words("{statement} Instead: {advice}.")


@dataclass(frozen=True, slots=True)
class Experiment:
    """What to measure next."""

    effects: tuple[str, ...]  #: Identifiers of those that it tells apart, or of the one that it shows.
    plan: AxisPlan | None  #: The plan; None where none that was simulated decides more often than not.
    logs: tuple[str, ...]  #: Columns to log beside the readings.
    minutes: float  #: What it takes; 0 without a plan.
    decides: float  #: The probability that it decides.
    statement: Words  #: All this in a sentence or two.


@dataclass(frozen=True, slots=True)
class _Option:
    """A plan with what led to it, how often it decides, and by how much of evidence in nine of ten tests."""

    changes: tuple[PlanChange, ...]
    plan: AxisPlan
    decides: float = 0.0
    margin: float = -np.inf


@dataclass(frozen=True, slots=True)
class _Draws:
    """How many tests are simulated, and what they are drawn from."""

    sets: int
    seed: tuple[int, ...]


def plan_next_experiment(  # noqa: PLR0913 - what is asked, what is known, what may be, and who is told
    question: Question,
    plan: AxisPlan,
    expected: ExpectedTest,
    effects: Sequence[Effect],
    seed: int,
    *,
    told: Told = tell_nobody,
) -> Experiment:
    """Return the cheapest plan that decides a question; the best one if none is sure to."""
    looked = partial(_judge_at_a_glance, question, expected, _Draws(_SETS, (seed, 0)))
    plan = keep_within_travel(question.axis, _make_moderate(question.axis, plan))
    period, goes_on = _find_longest_period(question), question.may_go_on
    changes = tuple(list_further_changes(question.axis, plan, seed, period, goes_on=goes_on))
    options: list[_Option] = []
    for each in _list_options(question, plan, [(), *((one,) for one in changes)]):
        options.append(looked(each))
        told(0.5 * len(options) / (1 + len(changes)))
    judged = partial(_judge_thoroughly, question, expected, effects, _Draws(_SETS_OF_THE_BEST, (seed, 0)))
    tried = list(_judge_options(judged, options)) if any(each.decides >= _ENOUGH for each in options) else []
    told(0.75)
    # The rivals alone look easier to tell apart than among all effects: then several changes together.
    if all(each.decides < _ENOUGH for each in tried):
        leading = sorted(options, key=rank_option)[:_COMBINED]
        single = [each.changes[0] for each in leading if each.changes]
        several = [each for count in (2, 3) for each in combinations(single, count)]
        apart = [each for each in several if len({change.of for change in each}) == len(each)]
        combined = [looked(each) for each in _list_options(question, plan, apart)]
        tried += _judge_options(judged, combined if tried else [*options, *combined])
        options += combined
    best = choose_option(tried) or _Option((), plan)
    if best.decides >= _NOT_WORTH_IT:
        best = _judge_thoroughly(question, expected, effects, _Draws(_SETS_OF_A_PROMISE, (seed, 1)), best)
    return _make_experiment(question, expected, best, len(options))


def _judge_options(judged: Callable[[_Option], _Option], options: Sequence[_Option]) -> Iterator[_Option]:
    """Yield the cheapest plan that promises enough and the surest ones, judged, until one decides."""
    promising = [each for each in options if each.decides >= _ENOUGH]
    cheapest = min(promising, key=lambda each: each.plan.duration, default=None)
    surest = [each for each in sorted(options, key=rank_option) if each is not cheapest]
    order = [*([cheapest] if cheapest else []), *surest]
    for option in order[: _BEST if order and order[0].decides >= _NOT_WORTH_IT else 1]:
        yield (found := judged(option))
        if found.decides >= _ENOUGH:
            return


def choose_option(tried: Sequence[_Option]) -> _Option | None:
    """Return the shortest of the plans that decide; else of those that do it as often as any.

    How often that is, so many simulated tests tell within their standard error.
    """
    most = max((each.decides for each in tried), default=0.0)
    error = math.sqrt(most * (1.0 - most) / _SETS_OF_THE_BEST)
    enough = _ENOUGH if most >= _ENOUGH else most - error
    as_sure = (each for each in tried if each.decides >= enough)
    return min(as_sure, key=lambda each: each.plan.duration, default=None)


def rank_option(option: _Option) -> tuple[float, float]:
    """Return what is least of the surest plan; by margin, where as many of the few simulated tests decide."""
    return -option.decides, -option.margin


def _make_moderate(axis: Axis, plan: AxisPlan) -> AxisPlan:
    """Return a plan of no more targets and runs than an experiment needs, spread as they were.

    An overrun for which the travel has no room is the usual one.
    """
    if axis.travel and not makes_whole_turns(axis) and 2 * plan.overrun >= axis.travel[1] - axis.travel[0]:
        plan = replace(plan, overrun=find_usual_overrun(axis))
    places = np.linspace(0, len(plan.targets) - 1, min(len(plan.targets), _MOST_TARGETS)).astype(np.int64)
    return replace(plan, targets=read_only_floats(plan.targets[places]), runs=min(plan.runs, _MOST_RUNS))


def _find_longest_period(question: Question) -> float | None:
    """Return the longest period of the effects in question, as estimated; None if they have none."""
    found = [
        float(value)
        for rival in question.rivals
        for parameter, value in zip(rival.effect.searched, rival.theta.tolist(), strict=False)
        if parameter.dimension is Dimension.POSITION and parameter.name == "period"
    ]
    return max(found, default=None)


def _list_options(
    question: Question, plan: AxisPlan, choices: Sequence[Sequence[PlanChange]]
) -> Iterator[_Option]:
    """Yield the plans that changes lead to: those that the axis can follow, and that are not too long."""
    before = 0 if question.first is None else len(question.first.deviation)
    for choice in choices:
        # targets that do not fit into the travel
        with contextlib.suppress(ValueError):
            changed = join_changes(choice).changed(plan) if choice else plan
            readings = changed.readings + (before if changed.after else 0)
            fits = readings <= _MOST_READINGS and len(changed.targets) > 1
            paused = changed.pause is None or changed.method in RUN_BY_RUN
            if fits and paused and find_beyond_travel(question.axis, changed) is None:
                yield _Option(tuple(choice), changed)


def _judge_at_a_glance(question: Question, expected: ExpectedTest, draws: _Draws, option: _Option) -> _Option:
    """Return how often a plan would decide if only the rivals were possible, and the noise known."""
    design = question.make_design(option.plan, expected)
    visible = [each.effect for each in question.rivals if each.effect.untestable(design) is None]
    if len(visible) < len(question.rivals):
        return option
    contest = Contest.of(design, question.compute_columns(design), visible, with_nameless=False)
    decides, margin = _compute_share_decided(
        question, contest, [contest.find_nearest_amplitudes(question.ratios)], draws
    )
    return replace(option, decides=decides, margin=margin)


def _judge_thoroughly(
    question: Question, expected: ExpectedTest, effects: Sequence[Effect], draws: _Draws, option: _Option
) -> _Option:
    """Return how often a plan decides among all effects and shapes, whatever the noise."""
    design = question.make_design(option.plan, expected)
    if any(each.effect.untestable(design) for each in question.rivals):
        return option
    others = list_effects_to_try(question.model, design, effects).forms
    own = [each.effect for each in question.rivals]
    forms = [*own, *(each for each in others if each.identifier not in question.names)]
    contest = Contest.of(design, question.compute_columns(design), forms)
    return replace(
        option,
        decides=_compute_share_decided(question, contest, list(contest.list_middling_amplitudes()), draws)[0],
    )


def _compute_share_decided(
    question: Question, contest: Contest, noises: Sequence[Amplitudes], draws: _Draws
) -> tuple[float, float]:
    """Return the share of tests that are decided rightly, truths as likely as they are; and the margin.

    By P. S. Laplace's rule of succession: what went well n times in n is not certain.
    """
    design, places = contest.design, {name: row for row, name in enumerate(contest.identifiers)}
    weight = sum(rival.probability for rival in question.rivals) or 1.0
    right, margin = 0.0, np.inf
    for rival in question.rivals:
        if rival.effect.identifier not in places:
            margin = -np.inf
            continue
        share = rival.probability / weight
        # The same noise for every truth and plan of so many readings: what differs is what they see.
        generator = np.random.default_rng([*draws.seed, len(design.position)])
        own = max(_FEWEST_SETS, round(share * draws.sets))
        readings = question.simulate_readings(design, contest.space.parts, rival, own, generator)
        evidence, nameless = average_evidence(
            [Trials(contest, each, [], readings, question.known) for each in noises]
        )
        lead = _measure_lead(evidence, nameless, places, rival.effect.identifier, question.names)
        right += share * float(np.mean(lead > 0))
        margin = min(margin, float(np.quantile(lead, 0.1)))
    return (draws.sets * right + 1) / (draws.sets + 2), margin


def _measure_lead(
    evidence: FloatArray, nameless: FloatArray, places: Mapping[str, int], truth: str, rivals: Sequence[str]
) -> FloatArray:
    """Return by how much more evidence than it needs the truth leads in each set.

    It must surpass its rivals as far as to be told from them, and no effect that nobody asks about may
    surpass it clearly.
    """
    own = evidence[places[truth]]
    margins = np.full(len(evidence), -MENTION)
    margins[[places[name] for name in rivals if name in places]] = TOLD_APART
    others = np.delete(evidence + margins[:, np.newaxis], places[truth], axis=0)
    shapes = nameless.max(axis=0, initial=-np.inf) + PRICE - NAMELESS_PRICE
    needed = np.maximum(others.max(axis=0, initial=-np.inf), shapes)
    return np.asarray(own - np.maximum(needed, PRICE + NAMED), dtype=np.float64)


def _make_experiment(question: Question, expected: ExpectedTest, best: _Option, count: int) -> Experiment:
    aim = (_TO_TELL if len(question.rivals) > 1 else _TO_SHOW).given(effects=list_in_words(question.names))
    share = number_words(100 * best.decides, 0)
    if best.decides < _NOT_WORTH_IT:
        none = _NONE.given(count=str(count), aim=aim, decides=share)
        statement = _add_way_out(question, question.make_next_design(best.plan, expected), none)
        return Experiment(question.names, None, (), 0.0, best.decides, _add_sizes(question, statement))
    logs = question.list_logs(question.make_design(best.plan, expected))
    advice = join_changes(best.changes).advice if best.changes else _AS_IT_IS
    if logs:
        advice = _LOG.given(advice=advice, logs=", ".join(logs))
    minutes = best.plan.duration / SECONDS_PER_MINUTE
    statement = _ADVICE.given(
        aim=aim, advice=advice, minutes=number_words(max(1.0, minutes), 0), decides=share
    )
    statement = _add_sizes(question, statement)
    return Experiment(question.names, best.plan, logs, minutes, best.decides, statement)


def _add_sizes(question: Question, statement: Words) -> Words:
    """Return a statement with what was taken for the size of effects that no readings tell."""
    taken = [rival for rival in question.rivals if not rival.gamma.size]
    if not taken:
        return statement
    size = wording.deviation(question.axis, max(rival.size for rival in taken))
    return Words("{statement} The size of {effects} is not known: taken is {size} rms.").given(
        statement=statement, effects=list_in_words([each.effect.identifier for each in taken]), size=size
    )


def _add_way_out(question: Question, design: Design, statement: Words) -> Words:
    """Return a statement with what an effect lacks, or the other measurement that its page names."""
    for rival in question.rivals:
        reason = rival.effect.untestable(design)
        if reason is not None:
            return _LACKS.given(statement=statement, effect=rival.effect.identifier, reason=reason)
    names = {*question.names, *question.model.identifiers}
    for rival in question.rivals:
        for confusion in rival.effect.confusions:
            if confusion.effect in names:
                return _INSTEAD.given(statement=statement, advice=confusion.told_apart_by)
    return statement
