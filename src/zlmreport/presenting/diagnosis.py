"""A diagnosis as people read it: verdict, where the model fails, what it may lack, what the test hides."""

from __future__ import annotations

import json
import math
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass

from zlmreport.language import Language, Words
from zlmreport.measurement.measurement_set import CONDITION_NAMES
from zlmreport.model import wording
from zlmreport.model.diagnosis import Candidate, Diagnosis, Verdict
from zlmreport.model.effect import Effect
from zlmreport.model.report import serious_candidates, verdict_statement
from zlmreport.model.residuals import Failure
from zlmreport.presenting.model import ErrorRows, ParameterRow, deviation
from zlmreport.quantities.formatting import p_value, percentage

_EXTRAPOLATED = Words(en="{p} (extrapolated)", de="{p} (extrapoliert)")
_VISIBLE = Words(
    en="{share} % of it is visible beside this model",
    de="neben diesem Modell sind {share} % davon sichtbar",
)
_FOUND_FROM = Words(
    en="{share} % of it is visible beside this model; found from {size} rms on",
    de="neben diesem Modell sind {share} % davon sichtbar; gefunden ab {size} quadratischem Mittel",
)


@dataclass(frozen=True, slots=True)
class FailureRow:
    """A test of the residuals that failed."""

    #: statement and where: What the residuals do, and the place, time, run or condition that shows it.
    statement: str
    where: str
    p: str  #: The chance of such residuals if the model held.
    failure: Failure  #: The test.


@dataclass(frozen=True, slots=True)
class CandidateRow:
    """An effect that the model may lack."""

    #: effect, argument and title: Identifier; as a job names it, with its keys unless they are the usual
    #: ones; what it is called.
    effect: str
    argument: str
    title: str
    #: probability and p: Among all that were tried, in per cent without the sign; chance of so large a fall
    #: without it.
    probability: str
    p: str
    error: ErrorRows  #: Of the model with it.
    #: rms and left_out: Root mean square error with it, and at runs predicted from the others, without unit.
    rms: str
    left_out: str
    parameters: tuple[ParameterRow, ...]  #: As fitted.
    #: explains and tell_apart_by: What it explains; what would tell it from its equals, empty if it has none.
    explains: str
    tell_apart_by: str
    remedy: str  #: What to do about it; empty if nobody says.
    equals: tuple[str, ...]  #: Effects that these readings cannot tell from it.
    is_serious: bool  #: Whether it is worth a word: the first, one with equals, one that is not improbable.
    candidate: Candidate


@dataclass(frozen=True, slots=True)
class HiddenRow:
    """Effects that the test cannot see, or hardly, and why."""

    effects: tuple[str, ...]
    reason: str


@dataclass(frozen=True, slots=True)
class DiagnosisRows:
    """A diagnosis in one language."""

    statement: str  #: The verdict in a sentence.
    error: ErrorRows  #: Of the model.
    failures: tuple[FailureRow, ...]  #: Where it fails, the clearest first.
    candidates: tuple[CandidateRow, ...]  #: What it may lack, best first.
    implausible: tuple[CandidateRow, ...]  #: Where only impossible ones are left, these.
    hidden: tuple[HiddenRow, ...]  #: Effects that the plan of the test hides beside this model.
    not_tested: tuple[HiddenRow, ...]  #: Effects that could not be tried, reason by reason.
    not_excluded: tuple[str, ...]  #: Those among them that nothing speaks against.
    remarks: tuple[str, ...]  #: What was taken for granted.
    #: Whether the verdict is that the first candidate, or one of its equals, is missing.
    names_candidates: bool

    @property
    def leading(self) -> tuple[CandidateRow, ...]:
        """The first candidate and its equals, where the verdict names them; else none."""
        if not self.names_candidates:
            return ()
        first = self.candidates[0]
        return tuple(each for each in self.candidates if each is first or each.effect in first.equals)

    @classmethod
    def of(
        cls, diagnosis: Diagnosis, language: Language, titles: Mapping[str, Words] | None = None
    ) -> DiagnosisRows:
        """Return a diagnosis."""
        axis = diagnosis.fit.design.axis
        serious = serious_candidates(diagnosis)

        def rows(candidates: Iterable[Candidate]) -> tuple[CandidateRow, ...]:
            return tuple(
                _candidate(each, diagnosis, language, titles or {}, is_serious=each in serious)
                for each in candidates
            )

        return cls(
            statement=verdict_statement(diagnosis).in_language(language),
            error=ErrorRows.of(diagnosis.error, axis, language),
            failures=tuple(failure_row(each, language) for each in diagnosis.failures),
            candidates=rows(diagnosis.candidates),
            implausible=rows(diagnosis.implausible),
            hidden=tuple(_hidden(diagnosis, language)),
            not_tested=_not_tested(diagnosis, language),
            not_excluded=tuple(diagnosis.not_excluded),
            remarks=tuple(each.in_language(language) for each in diagnosis.remarks),
            names_candidates=diagnosis.verdict is Verdict.MISSING,
        )


def failure_row(failure: Failure, language: Language) -> FailureRow:
    """Return a test that failed."""
    where = CONDITION_NAMES.get(failure.condition, failure.where)
    return FailureRow(
        failure.statement.in_language(language),
        where.in_language(language),
        p_value(failure.p_value, language.decimal_sign),
        failure,
    )


def argument(effect: Effect) -> str:
    """Return an effect as a job would name it, with its keys unless they are the usual ones."""
    settings = effect.settings.model_dump(mode="json", exclude_defaults=True)
    return f"{effect.identifier}: {json.dumps(settings)}" if settings else effect.identifier


def _candidate(
    candidate: Candidate,
    diagnosis: Diagnosis,
    language: Language,
    titles: Mapping[str, Words],
    *,
    is_serious: bool,
) -> CandidateRow:
    design, sign = diagnosis.fit.design, language.decimal_sign
    p = p_value(candidate.p_value, sign, is_extrapolated=candidate.p_value_is_extrapolated)
    if candidate.p_value_is_extrapolated:
        p = _EXTRAPOLATED.given(p=p).in_language(language)
    title, tell = titles.get(candidate.identifier), candidate.discriminate_by
    remedy = candidate.effect.remedy
    return CandidateRow(
        effect=candidate.identifier,
        argument=argument(candidate.effect),
        title=title.in_language(language) if title else "",
        probability=percentage(candidate.probability, sign),
        p=p,
        error=ErrorRows.of(candidate.error, design.axis, language),
        rms=deviation(candidate.error.rms, design.axis, language),
        left_out=deviation(candidate.error.cross_validated_rms, design.axis, language),
        parameters=tuple(ParameterRow.of(each, design, language) for each in candidate.estimates),
        explains=candidate.explains.in_language(language),
        tell_apart_by=tell.in_language(language) if tell else "",
        remedy=remedy.in_language(language) if remedy else "",
        equals=tuple(candidate.equals),
        is_serious=is_serious,
        candidate=candidate,
    )


def _hidden(diagnosis: Diagnosis, language: Language) -> Iterator[HiddenRow]:
    axis = diagnosis.fit.design.axis
    for each in diagnosis.visibility:
        if each.is_hidden:
            words = _FOUND_FROM if math.isfinite(each.smallest_rms) else _VISIBLE
            reason = words.given(
                share=percentage(each.share, language.decimal_sign),
                size=wording.deviation(axis, each.smallest_rms),
            )
            yield HiddenRow((each.effect,), reason.in_language(language))


def _not_tested(diagnosis: Diagnosis, language: Language) -> tuple[HiddenRow, ...]:
    by_reason: dict[str, list[str]] = {}
    for each in diagnosis.not_testable:
        by_reason.setdefault(each.reason.in_language(language), []).append(each.effect)
    return tuple(HiddenRow(tuple(effects), reason) for reason, effects in by_reason.items())
