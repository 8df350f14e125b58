"""Candidates that a model may lack: what each explains, its questions, how to tell them apart."""

from __future__ import annotations

from collections.abc import Container, Iterable, Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from zlmreport.language import Words
from zlmreport.language.numbers import write_share
from zlmreport.measurement.axis import Axis
from zlmreport.model.diagnosis.error_numbers import ErrorNumbers, compute_error_numbers
from zlmreport.model.diagnosis.finding import ContestFinding, StandIn, fit_with_member
from zlmreport.model.effects import wording
from zlmreport.model.effects.design import Design
from zlmreport.model.effects.effect import Dimension, Effect, find_unit_on
from zlmreport.model.effects.model_error import ModelError
from zlmreport.model.effects.sizes import ask_of, find_usual_range
from zlmreport.model.fitting.estimate import ParameterEstimate
from zlmreport.model.fitting.fit import Fit

#: Share of the misfit from which on an effect explains it, and does not only contribute.
EXPLAINS = 0.75
#: Share by which a value must differ from what the job says to contradict it.
_CONTRADICTS = 0.01
#: Probability, with that of its equals, below which an effect that is named is no more than likely; and what
#: share of it a rival must have to be told beside it.
_SURE, _NEARLY = 2 / 3, 0.5
#: Share of the misfit below which nothing but rounding is explained.
_ROUNDING = 1e-9

_ASKED_ABOUT = Words("{effect}, {question}")
_EXPLAINS = Words("explains {share} % of what the noise leaves open")
_CONTRIBUTES = Words("contributes {share} % of what the noise leaves open; {left} remain")
_NOTHING = Words("explains nothing by itself of what the noise leaves open")
_NO_FLOOR = Words("takes the error from {before} to {after}")
_JOB_SAYS = Words("{name}: {fitted} fits, the job says {stated}.")
_JOB_SAYS_NOTHING = Words("{name}: {fitted} fits, the job states no axis.{key}.")
_BESIDE = Words("{name}: {fitted} fits beside the {stated} that the job states.")
#: Of a ratio, whose meaning is that of the expected value: "1: exactly one row off".
_NOT_AS_MEANT = Words("{effect}: a {name} of {fitted} fits ({meaning}).")
_AND = Words("{first}; {second}")


@dataclass(frozen=True, slots=True)
class EffectCandidate:
    """An effect that the model may lack."""

    effect: Effect  #: In the form that fits best.
    p_value: float  #: Chance of so high a likelihood ratio without the effect, its own search allowed for.
    p_value_is_extrapolated: bool  #: Whether it lies beyond what was simulated.
    #: That it is there, beside the others of its set and what has no name, and none of its equals instead.
    probability: float
    evidence: float  #: 2·ln of the odds for it against nothing in its place.
    error: ErrorNumbers  #: After adding it alone.
    #: Its own parameters: of one of the set beside the others of it, of any other after adding it alone.
    estimates: tuple[ParameterEstimate, ...]
    #: Of what the noise leaves unexplained, explained by it: 0 to 1; None without a noise floor.
    share: float | None
    explains: Words  #: The same in words.
    equals: tuple[str, ...]  #: Effects that the readings cannot tell from it.
    #: The measurement that would tell them; None where there is nothing to tell apart.
    discriminate_by: Words | None
    is_plausible: bool = True  #: Whether physics allows it.
    is_large: bool = False  #: Whether a parameter lies beyond what is usual.
    #: What is asked of one that does, or is said of one that the job contradicts; None of any other.
    question: Words | None = None

    @property
    def identifier(self) -> str:
        """As jobs name it."""
        return self.effect.identifier


def list_candidates(
    finding: ContestFinding, before: ErrorNumbers, complete: Fit
) -> Iterator[EffectCandidate]:
    """Yield the effects of a set, each with its equals behind it; where there is no set, the others.

    `complete`: The model with the whole set, in which the effects of the set have their values.
    """
    seen: set[str] = set()
    for each in finding.named:
        group = (each.leading, *each.equals)
        for one in group:
            if one.identifier not in seen:
                seen.add(one.identifier)
                rest = [other for other in group if other is not one]
                yield from _make_candidate(finding.fit, one, rest, before, complete)
    for each in finding.named:
        for other in each.behind:
            if other.identifier not in seen:
                seen.add(other.identifier)
                yield from _make_candidate(finding.fit, other, (), before, complete)
    for other in finding.others:
        yield from _make_candidate(finding.fit, other, (), before, complete)


@dataclass(frozen=True, slots=True)
class Doubt:
    """An effect that is named and no more than likely, or one that is nearly as likely and not named."""

    names: tuple[str, ...]  #: It, and its equals.
    probability: float  #: Of all of them together.
    is_named: bool  #: Whether it is the one that is named.


def find_doubts(candidates: Sequence[EffectCandidate], named: Iterable[str]) -> tuple[Doubt, ...]:
    """Return the effects of a set that are no more than likely, then those that are nearly as likely."""
    known = {each.identifier: each.probability for each in candidates}
    equals = {each.identifier: (each.identifier, *each.equals) for each in candidates}
    groups = [equals[each] for each in named if each in equals]
    weighed = [Doubt(each, sum(known.get(name, 0.0) for name in each), is_named=True) for each in groups]
    doubted = [each for each in weighed if each.probability < _SURE]
    least = _NEARLY * min((each.probability for each in doubted), default=np.inf)
    told = {name for each in groups for name in each}
    rivals = [
        Doubt((name,), probability, is_named=False)
        for name, probability in known.items()
        if name not in told and probability >= least
    ]
    return (*doubted, *rivals)


def list_questions(fitted: Fit, effects: Container[str]) -> Iterator[Words]:
    """Yield what is asked of parameters of a model that are far from usual, or contradict the job.

    `effects`: Identifiers of those that are asked about.
    """
    own = [each for each in fitted.estimates if each.effect in effects]
    is_many = len({each.effect for each in own}) > 1
    for each in own:
        question = _say_question(each, fitted.design)
        contradiction = _say_contradiction(each, fitted.estimates, fitted.design)
        if question is not None:
            yield ask_about(each.effect, question) if is_many else question
        elif contradiction is not None:
            yield contradiction


def ask_about(effect: str, question: Words) -> Words:
    """Return a question with the effect that it is on, for where several are named."""
    return _ASKED_ABOUT.given(effect=effect, question=question)


def _make_candidate(
    base: Fit, rival: StandIn, equals: Sequence[StandIn], before: ErrorNumbers, complete: Fit
) -> Iterator[EffectCandidate]:
    """Yield an effect as a candidate, if the readings determine it beside the job's model."""
    try:
        after = fit_with_member(base, rival.member)
    except ModelError:
        return
    error = compute_error_numbers(after)
    share = _share((base, before), (after, error), before.noise_rms)
    own, alone = (
        tuple(each for each in fitted.estimates if each.effect == rival.identifier)
        for fitted in (complete, after)
    )
    estimates = own or alone
    question = next(filter(None, (_say_question(each, base.design) for each in estimates)), None)
    contradictions = (_say_contradiction(each, complete.estimates, base.design) for each in estimates)
    contradiction = next(filter(None, contradictions), None)
    values = {each.parameter.name: each.value for each in estimates}
    yield EffectCandidate(
        effect=rival.member.effect,
        p_value=rival.p_value.value,
        p_value_is_extrapolated=rival.p_value.is_extrapolated,
        probability=rival.probability,
        evidence=rival.evidence,
        error=error,
        estimates=estimates,
        share=share,
        explains=_say_explains(before.rms, error.rms, share, base.design.axis),
        equals=tuple(each.identifier for each in equals),
        discriminate_by=say_what_discriminates(rival.member.effect, [each.member.effect for each in equals]),
        is_plausible=rival.member.effect.forbids(base.design, values) is None,
        is_large=question is not None,
        question=question or contradiction,
    )


def _say_question(estimate: ParameterEstimate, design: Design) -> Words | None:
    """Return what is asked of a parameter that is beyond doubt far from usual; None of any other."""
    if design.time_is_counted and estimate.parameter.dimension is Dimension.TIME:
        return None
    low, high = find_usual_range(estimate.parameter, design.axis.kind)
    reach = estimate.expanded_uncertainty
    if estimate.value + reach >= low and estimate.value - reach <= high:
        return None
    return ask_of(estimate.parameter, estimate.value, design.axis)


def _say_contradiction(
    estimate: ParameterEstimate, others: Iterable[ParameterEstimate], design: Design
) -> Words | None:
    """Return that the readings contradict a value that follows from the job; None if they do not.

    `others`: Those of the same model: beside one that has the value of the job it is a further one.
    """
    parameter = estimate.parameter
    if estimate.is_given or (estimate.expected is None and parameter.instead_of is None):
        return None
    if estimate.expected is None:
        fitted = wording.quantity(find_unit_on(design, parameter.dimension), estimate.value)
        return _JOB_SAYS_NOTHING.given(
            name=parameter.description, fitted=fitted, key=parameter.instead_of or ""
        )
    if _has_value(estimate, estimate.expected):
        return None
    if parameter.dimension is Dimension.RATIO:
        return _NOT_AS_MEANT.given(
            effect=estimate.effect,
            name=parameter.name,
            fitted=wording.quantity(find_unit_on(design, parameter.dimension), estimate.value),
            meaning=parameter.description,
        )
    alike = (each for each in others if each.parameter.dimension is parameter.dimension)
    sentence = _BESIDE if any(_has_value(each, estimate.expected) for each in alike) else _JOB_SAYS
    return _say_other_value(estimate, estimate.expected, design, sentence)


def _has_value(estimate: ParameterEstimate, expected: float) -> bool:
    """Return whether a parameter may have a value."""
    reach = max(estimate.expanded_uncertainty, _CONTRADICTS * abs(expected))
    return abs(estimate.value - expected) <= reach


def say_other_value(estimate: ParameterEstimate, stated: float, design: Design) -> Words:
    """Return what the readings say of a parameter beside the value that the job gives, with its effect."""
    return ask_about(estimate.effect, _say_other_value(estimate, stated, design))


def _say_other_value(
    estimate: ParameterEstimate, stated: float, design: Design, sentence: Words = _JOB_SAYS
) -> Words:
    parameter = estimate.parameter
    unit = find_unit_on(design, parameter.dimension)
    fitted, given = (wording.quantity(unit, value) for value in (estimate.value, stated))
    return sentence.given(fitted=fitted, stated=given, name=parameter.description)


def say_what_discriminates(effect: Effect, equals: Sequence[Effect]) -> Words | None:
    """Return the measurements that would tell an effect from its equals, as the effects' pages name them."""
    found: dict[str, Words] = {}
    for other in equals:
        words = _say_what_tells_apart(effect, other) or _say_what_tells_apart(other, effect)
        if words is not None:
            found.setdefault(other.identifier, words)
    if not found:
        return None
    phrases = list({words.en: words for words in found.values()}.values())
    together = phrases[0]
    for words in phrases[1:]:
        together = _AND.given(first=together, second=words)
    return together


def _say_what_tells_apart(one: Effect, other: Effect) -> Words | None:
    return next((each.told_apart_by for each in one.confusions if each.effect == other.identifier), None)


def _share(
    before: tuple[Fit, ErrorNumbers], after: tuple[Fit, ErrorNumbers], floor: float | None
) -> float | None:
    """Return the share of the misfit beyond the noise floor that an effect explains."""
    if floor is None:
        return None
    open_before, open_after = (
        fitted.degrees * (error.rms**2 - floor**2) for fitted, error in (before, after)
    )
    share = 1.0 - max(0.0, open_after) / open_before if open_before > 0 else 1.0
    return share if share > _ROUNDING else 0.0


def _say_explains(before: float, after: float, share: float | None, axis: Axis) -> Words:
    if share is None:
        return _NO_FLOOR.given(before=wording.deviation(axis, before), after=wording.deviation(axis, after))
    if share == 0:
        return _NOTHING
    percent = write_share(share)
    if share >= EXPLAINS:
        return _EXPLAINS.given(share=percent)
    return _CONTRIBUTES.given(share=percent, left=wording.deviation(axis, after))
