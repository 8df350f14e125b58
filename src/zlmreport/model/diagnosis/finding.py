"""The outcome of a contest: effects with evidence of their own, in order, and what could replace each.

Whether anything is missing at all is held against chance. Then sets are searched; an effect is named where
the readings ask for it beside everything else, that which has no name included, and its rivals are named with
it where the odds between them are less than twenty to one.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence, Set as AbstractSet
from dataclasses import dataclass, replace

import numpy as np

from zlmreport.measurement.arrays import FloatArray
from zlmreport.model.diagnosis.believing import BEHIND, MENTION, TOLD_APART, believe_set
from zlmreport.model.diagnosis.contest import Contest, Told, tell_nobody
from zlmreport.model.diagnosis.effect_set import (
    EffectSet,
    SetMember,
    count_nameless,
    find_installed_name,
    list_names,
)
from zlmreport.model.diagnosis.effects_to_try import list_effects_to_try
from zlmreport.model.diagnosis.forms import list_unnamed_forms
from zlmreport.model.diagnosis.null_distribution import (
    LEVEL,
    PValue,
    Scores,
    compute_chances_of,
    simulate_null,
)
from zlmreport.model.diagnosis.remainder import Remainder, find_remainder_of
from zlmreport.model.diagnosis.set_members import make_members_of, renumber
from zlmreport.model.diagnosis.sets import SetSearch
from zlmreport.model.diagnosis.trials import Trials
from zlmreport.model.diagnosis.visibility import Visibility, judge_visibility
from zlmreport.model.effects.axis_model import AxisModel
from zlmreport.model.effects.design import Design
from zlmreport.model.effects.effect import Effect
from zlmreport.model.effects.model_error import ModelError
from zlmreport.model.fitting.fit import Fit, fit
from zlmreport.model.fitting.noise import Noise
from zlmreport.model.fitting.priors import PriorExpectation
from zlmreport.model.fitting.repeats import find_resolution
from zlmreport.model.fitting.search import Thetas

#: Share of a column that must be left beside the model: less, where its searched parameters are only known
#: within their uncertainty.
_LEAST_VISIBLE, _LEAST_VISIBLE_LATER = 1e-6, 1e-3
#: Share of what is to be explained, and of what the model explains, that no equation of a machine describes.
_INEXACT_MISFIT, _INEXACT_MODEL = 0.01, 0.002
#: Times over which single readings may be forgotten, in steps from one to the next, and what that must gain.
_MEMORIES, _REMEMBERS = (1.0, 2.0, 4.0), 10.0
#: Evidence beyond which odds are as good as certain.
_CERTAIN = 200.0


@dataclass(frozen=True, slots=True)
class StandIn:
    """An effect that may stand in the place of another, or beside a model where none has a name."""

    member: SetMember
    probability: float  #: Among all that may stand there, and nothing.
    evidence: float  #: 2·ln of the odds for it against nothing in this place.
    p_value: PValue  #: Of its likelihood ratio beside the job's model, its own search allowed for.

    @property
    def identifier(self) -> str:
        """As jobs name it."""
        return self.member.identifier


@dataclass(frozen=True, slots=True)
class NamedEffect:
    """An effect that belongs in."""

    leading: StandIn
    #: Effects that the readings do not tell from it, beside the others of the set.
    equals: tuple[StandIn, ...]
    behind: tuple[StandIn, ...]  #: Effects that might stand there as well, but are told from it; best first.

    @property
    def identifier(self) -> str:
        """As jobs name it."""
        return self.leading.identifier


@dataclass(frozen=True, slots=True)
class ContestFinding:
    """What a contest beside a model comes to."""

    fit: Fit  #: The model.
    noise: Noise  #: Held to what noise may be.
    p_value: PValue  #: Chance of such a contest where nothing is missing.
    named: tuple[NamedEffect, ...]  #: The effects that belong in, the one to add first first.
    others: tuple[StandIn, ...]  #: Those that explain most where none has evidence of its own, best first.
    makeshift: tuple[str, ...]  #: Effects of the model that others take the place of.
    remainder: Remainder | None  #: What is left without a name; None where it is noise.
    changes: float  #: Evidence of what changes in time, or from run to run, without a name.
    visible: tuple[Visibility, ...]  #: How much of each effect the plan can see beside the model.


def find(  # noqa: PLR0913 - what is known, what may be, and who is told
    fitted: Fit,
    effects: Iterable[Effect],
    expected: PriorExpectation | None = None,
    *,
    may_go: frozenset[str] = frozenset(),
    is_left: bool = False,
    told: Told = tell_nobody,
) -> ContestFinding:
    """Return what a contest of all effects beside a fitted model comes to.

    `expected`: What earlier tests say.
    `may_go`: Effects of the model that others may take the place of.
    `is_left`: Whether something is left in any case, whatever chance says of the contest.
    """
    stated = _Stated.of(fitted, effects, expected, may_go, is_left=is_left)
    first = _contest_effects(stated, 0.0, lambda share: told(0.8 * share))
    if first.found is None:
        return first.finding
    memory = _estimate_memory(stated, first.found)
    if memory:
        # Readings that forget slowly look like many a cause: all is held against that once more.
        again = _contest_effects(stated, memory, told)
        if again.found is None or again.found.score < first.found.score:
            return again.finding
    told(1.0)
    return first.finding


@dataclass(frozen=True, slots=True)
class _Stated:
    """What is asked: a model, the effects that are tried, and what may go."""

    fitted: Fit
    forms: tuple[Effect, ...]
    #: Second forms of effects that are looked for run by run: they may be there twice from the beginning.
    seconds: tuple[Effect, ...]
    expected: PriorExpectation | None
    may_go: frozenset[str]
    is_left: bool
    known: float
    least_visible: float

    @classmethod
    def of(
        cls,
        fitted: Fit,
        effects: Iterable[Effect],
        expected: PriorExpectation | None,
        may_go: frozenset[str],
        *,
        is_left: bool,
    ) -> _Stated:
        own = tuple(each for each in fitted.model.terms if each.effect.identifier not in may_go)
        effects = tuple(effects)
        entered = list_effects_to_try(AxisModel(own), fitted.design, effects).forms
        # Beside a joint that may go there may be a second, and that stays when the first goes.
        names = {each.identifier for each in (*entered, *(term.effect for term in own))}
        going = [term.effect for term in fitted.model.terms if term.effect.identifier in may_go]
        several = [each for each in effects if each.several]
        further = [
            *(form for each in going if each.several for form in each.forms()),
            *(list_effects_to_try(fitted.model, fitted.design, several).forms if going else ()),
        ]
        # A form with more harmonics came in once a plainer one stood there.
        tried = [(each.identifier, each.settings) for each in entered]
        richer = [each for each in going if (each.identifier, each.settings) not in tried]
        forms = (
            *entered,
            *(each for each in richer if each.identifier in names),
            *(each for each in further if each.identifier not in names),
        )
        is_linear = all(len(theta) == 0 for theta in fitted.solution.thetas)
        return cls(
            fitted,
            forms,
            tuple(_list_seconds(AxisModel(own), forms, fitted.design)),
            expected.in_units_of(fitted.noise.sigma) if expected else None,
            may_go,
            is_left,
            find_known_noise(fitted),
            _LEAST_VISIBLE if is_linear else _LEAST_VISIBLE_LATER,
        )

    @property
    def base(self) -> FloatArray:
        return self.fitted.compute_base(without=self.may_go)

    def contest(self, memory: float) -> Contest:
        """Return the contest of all, if readings are forgotten after a time."""
        return Contest.of(
            self.fitted.design,
            self.base,
            (*self.forms, *self.seconds),
            self.fitted.open_deviation,
            weights=self.fitted.noise.weights,
            memory=memory,
            forms=list_unnamed_forms(self.fitted.design),
            known=self.known,
            least_visible=self.least_visible,
            expected=self.expected,
        )

    def score(self, base: FloatArray, memory: float) -> float:
        """Return the score of a model by itself, if readings are forgotten after a time."""
        contest = Contest.of(
            self.fitted.design,
            base,
            (),
            self.fitted.open_deviation,
            weights=self.fitted.noise.weights,
            memory=memory,
            known=self.known,
            expected=self.expected,
        )
        return SetSearch(contest).make_bare_set().score


def _list_seconds(model: AxisModel, forms: Sequence[Effect], design: Design) -> list[Effect]:
    """Return a second form of each effect that is looked for run by run, and may be there several times.

    Of two displaced runs neither explains as much by itself as a curve that displaces all, so that a second
    which is looked for once the first is known comes too late. There are few runs: this costs little.
    """
    runs, names = len(np.unique(design.run)), {each.identifier for each in forms}
    seconds = [
        model.with_effect(each).take_next_of(each)
        for each in forms
        if each.several and len(each.searched) == 1 and len(each.grid(design)) <= runs
    ]
    return [each for each in seconds if each.identifier not in names]


@dataclass(frozen=True, slots=True)
class _Contested:
    """What came of a contest: the set, if anything is missing at all."""

    finding: ContestFinding
    found: EffectSet | None


def _contest_effects(stated: _Stated, memory: float, told: Told) -> _Contested:
    fitted, contest = stated.fitted, stated.contest(memory)
    told(0.05)
    search = SetSearch(contest)
    pairs = zip(fitted.model.terms, fitted.solution.thetas, strict=True)
    start = search.as_noise(
        make_members_of(
            search.contest,
            [(term.effect, at) for term, at in pairs if term.effect.identifier in stated.may_go],
        )
    )
    null = simulate_null(contest, start.amplitudes, start.columns)
    deviations = fitted.open_deviation[:, np.newaxis]
    observed = Trials(contest, start.amplitudes, start.columns, deviations, stated.known)
    p_value = null.compute_p_value(Scores(observed.ratios, observed.nameless))
    reduced = contest.reduce_set(start.amplitudes, start.columns)
    sigma = float(np.sqrt(reduced.squares / contest.space.degrees))
    noise = Noise(sigma, contest.list_noise_ratios(start.amplitudes), fitted.noise.weights)
    seconds = {each.identifier for each in stated.seconds}  # seen as well as the first
    visible = tuple(
        each for each in judge_visibility(contest, null, reduced, sigma) if each.effect not in seconds
    )
    told(0.2)
    most = max(float(each.max(initial=-np.inf)) for each in (observed.evidence, observed.nameless))
    if not stated.is_left and (p_value.value > LEVEL or most < MENTION):
        return _Contested(ContestFinding(fitted, noise, p_value, (), (), (), None, 0.0, visible), None)
    found = search.find_best(start.members, lambda share: told(0.2 + 0.6 * share))
    found = renumber(search.contest, believe_set(search, found, stated.may_go))
    named = tuple(_name_effects(search, found, [each.effect for each in start.members]))
    finding = ContestFinding(
        fit=fitted,
        noise=noise,
        p_value=p_value,
        named=named,
        others=() if named else tuple(_list_others(search, found)),
        makeshift=tuple(sorted(stated.may_go - {each.identifier for each in found.named})),
        remainder=find_remainder_of(search, found, fitted),
        changes=search.compute_evidence_of_changes(found),
        visible=visible,
    )
    told(1.0)
    return _Contested(finding, found)


def _estimate_memory(stated: _Stated, found: EffectSet) -> float:
    """Return the time over which a reading is forgotten beside a set; 0 where it is alone."""
    design = stated.fitted.design
    steps = np.diff(design.time)[np.diff(design.session) == 0]
    step = float(np.median(steps[steps > 0])) if np.any(steps > 0) else 0.0
    columns = [each.effect.columns(design, each.theta) for each in found.members]
    base = np.concatenate([stated.base, *columns], axis=1)
    scores = {share * step: stated.score(base, share * step) for share in (0.0, *(_MEMORIES if step else ()))}
    best = min(scores, key=scores.__getitem__)
    return best if scores[best] < scores[0.0] - _REMEMBERS else 0.0


def _put_in_order(contest: Contest, found: EffectSet) -> list[int]:
    """Return the named members of a set, always the one next that takes most of what is left."""
    values = contest.columns.select_columns
    open_ = [number for number, each in enumerate(found.members) if each.family.is_named]
    chosen: list[int] = []
    while open_:
        reduced = contest.reduce_set(contest.quiet, [found.members[each].columns for each in chosen])
        explained = {
            each: float(
                contest.explain_blocks(reduced, values(found.members[each].columns)[:, np.newaxis])[0]
            )
            for each in open_
        }
        chosen.append(max(open_, key=explained.__getitem__))
        open_.remove(chosen[-1])
    return chosen


def _name_effects(search: SetSearch, found: EffectSet, before: Iterable[Effect]) -> Iterator[NamedEffect]:
    """Yield the effects of a set that were not there before, the one to add first first."""
    before = tuple(before)
    known = [(each.identifier, each.settings) for each in before]
    # What others take the place of does not come back in the place of one of them.
    leading = {each.identifier for each in before}
    for number in _put_in_order(search.contest, found):
        effect = found.members[number].effect
        if (effect.identifier, effect.settings) not in known:
            named = _name_effect(search, found, number, leading)
            leading.add(named.identifier)
            yield named


def _name_effect(search: SetSearch, found: EffectSet, number: int, taken: AbstractSet[str]) -> NamedEffect:
    """Return an effect of a set with those that could stand in its place.

    `taken`: Names under which others of the set lead.
    """
    rest = search.without(found, number)
    member = found.members[number]
    sets = [found, *search.list_rivals(found, rest, BEHIND)]
    scores = np.array([rest.score, *(each.score for each in sets)])
    weights = np.exp(-0.5 * (scores - scores.min()))
    members = [member, *(each.members[-1] for each in sets[1:])]
    beside = [each.columns for place, each in enumerate(found.members) if place != number]
    chances = compute_chances_of(
        search.contest, found.amplitudes, beside, [each.identifier for each in members]
    )
    rivals = [
        StandIn(each, float(weight / weights.sum()), rest.score - whole.score, chances[each.identifier])
        for each, whole, weight in zip(members, sets, weights[1:], strict=True)
    ]
    design = search.contest.design
    # What takes the place of several at once, or asks for a curve beside it, leads in the place of none.
    others = list_names(found.named) - {find_installed_name(member.effect)}
    nameless = count_nameless(search.contest, found)
    near = [
        each
        for each, whole in zip(rivals, sets, strict=True)
        if each.evidence > rivals[0].evidence - MENTION
        and others < list_names(whole.named)
        and count_nameless(search.contest, whole) <= nameless
        and (each is rivals[0] or each.identifier not in taken)
    ]
    leading = min(
        near,
        key=lambda each: (
            _count_assumptions(each.member.effect, design),
            each is not rivals[0],
            -each.evidence,
        ),
    )
    # What contains it and explains no more is no other cause: its further terms do nothing. And what asks for
    # a curve beside it is no equal.
    behind = [
        (
            each,
            each.evidence > rivals[0].evidence - TOLD_APART
            and count_nameless(search.contest, whole) <= nameless,
        )
        for each, whole in zip(rivals, sets, strict=True)
        if each is not leading and leading.identifier not in each.member.effect.contains
    ]
    names = {each.identifier for each in found.members}
    return NamedEffect(
        leading,
        tuple(each for each, is_equal in behind if is_equal),
        tuple(
            each
            for each, is_equal in behind
            if not is_equal and each.evidence > 0 and each.identifier not in names
        ),
    )


def _count_assumptions(effect: Effect, design: Design) -> int:
    """Return how much an effect takes for granted: a log that it follows, parameters that are searched.

    A constant is a constant before it is the dead path of a beam in air that hardly changes.
    """
    follows_a_log = effect.untestable(replace(design, conditions={})) is not None
    searched = len(effect.searched) if len(effect.grid(design)) > 1 else 0
    return searched + follows_a_log


def _list_others(search: SetSearch, found: EffectSet) -> Iterator[StandIn]:
    """Yield the effects that explain most beside what has no name, where none has evidence of its own."""
    tried = search.look_ahead(found)
    names = [each.members[-1].identifier for each in tried]
    chances = compute_chances_of(search.contest, found.amplitudes, found.columns, names) if names else {}
    for name, each in zip(names, tried, strict=True):
        odds = float(np.exp(-0.5 * min(max(each.score - found.score, -_CERTAIN), _CERTAIN)))
        yield StandIn(each.members[-1], odds / (1.0 + odds), found.score - each.score, chances[name])


def find_known_noise(fitted: Fit) -> float:
    """Return the standard deviation of what repeats do not show and no effect is asked to explain, m or rad.

    Repeats share the rounding of the instrument, and no equation of a machine is exact: the wave of a screw
    is no pure sine. On a quiet machine both stand far above the scatter, and any irregular shape would
    surpass the cause that explains all but a hundredth. They are doubled, as irregular shares of the noise
    may have half the size of all of it (`noise`).
    """
    unit = fitted.design.axis.deviation_unit
    rounding = unit.to_si(find_resolution(unit.from_si(fitted.deviation))) / 12**0.5
    inexact = _INEXACT_MISFIT * float(np.std(fitted.residual)), _INEXACT_MODEL * float(np.std(fitted.fitted))
    return 2.0 * float(np.hypot(rounding, np.hypot(*inexact)))


def fit_with_member(fitted: Fit, member: SetMember) -> Fit:
    """Return the fit of a model with an effect, where a contest found it.

    Raises `ModelError` if the readings do not determine it.
    """
    model = fitted.model.with_effect(member.effect)
    before = dict(zip(fitted.model.identifiers, fitted.solution.thetas, strict=True))
    start: Thetas = tuple(
        member.theta if term.effect.identifier == member.identifier else before[term.effect.identifier]
        for term in model.terms
    )
    assumptions = replace(fitted.assumptions, weights=fitted.noise.weights)
    try:
        return fit(model, fitted.design, fitted.deviation, assumptions, start)
    except ModelError:
        # The first of two joints may stand where the second belongs; both are searched then.
        return fit(model, fitted.design, fitted.deviation, assumptions)
