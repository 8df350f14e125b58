"""A diagnosis as people read it: verdict, where the model fails, what it may lack, what the test hides."""

from __future__ import annotations

import json
import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import partial

from zlmreport.document.blocks import (
    Align,
    Block,
    Cell,
    Column,
    ColumnKind,
    Explained,
    Facts,
    Mark,
    Notice,
    Paragraph,
    RowGroup,
    Section,
    Table,
)
from zlmreport.document.subjects.fit import (
    EFFECTS,
    ParameterRow,
    lay_out_parameters,
    list_choices,
    list_error_facts,
    write_deviation,
    write_in_a_sentence,
)
from zlmreport.document.writer import NOTHING
from zlmreport.job.effect_choices import part_number
from zlmreport.language import Language, Words, join_parts, named, same
from zlmreport.language.formatting import write_p_value, write_percentage
from zlmreport.measurement.measurand import STRAIGHTNESS
from zlmreport.measurement.measurement_set import CONDITION_NAMES
from zlmreport.model.diagnosis.candidate import EffectCandidate
from zlmreport.model.diagnosis.diagnosis import AxisDiagnosis, DiagnosisVerdict
from zlmreport.model.diagnosis.looking import look_for
from zlmreport.model.diagnosis.report import (
    list_further_faults,
    select_serious_candidates,
    write_verdict_statement,
)
from zlmreport.model.diagnosis.residuals import Failure
from zlmreport.model.effects import wording
from zlmreport.model.effects.effect import Effect
from zlmreport.model.fitting.fit import Fit
from zlmreport.model.planning.experiment import Experiment

#: Titles of what is said of a diagnosis.
VERDICT = Words("Verdict")
FAILURES = Words("Where the model fails")
CANDIDATES = Words("What may be missing")
HIDDEN = Words("What this test cannot see")
_CAN_SEE = Words("What this test can see")
LEFT = Words("What is left without a name")
REMEDY = Words("What to do if this is the cause")
_ACROSS_THE_MOTION = Words(
    "What is said below is on positions, and this test is on the displacement across the motion. There a gap "
    "between the directions is play of the guide, and a slope is how the reference was aligned: no backlash "
    "value and no pitch table of this axis removes either."
)
EXPERIMENT = Words("The next experiment")
NOT_TRIED = Words("Effects that this test could not try")
_ASSUMED = Words("Taken for granted")
_FAULTS = Words("The data look wrong")
_FAULT = Words("{statement}. Remedy: {remedy}.")
_NO_FAILURE = Words(
    "No test of the residuals fails: not that of the means against the repeats, nor those over direction, "
    "run, time and the logged conditions."
)
_NOT_EXCLUDED = Words("Not excluded in place of {first}, for this test could not try them: {effects}.")
_CANDIDATES = Words(
    "Effects that the model may lack, each with the probability that it is there, beside the others of "
    "the set and what has no name"
)
_VISIBILITY = Words(
    "What the plan of this test can see of effects that are not in the model: the share that the "
    "model does not imitate, and the smallest effect that is found half of the time (root mean "
    "square over all readings)"
)
_SHAPE = Words("Shape")
_WHERE = Words("Place")
_SIZE, _LARGEST = Words("Root mean square"), Words("Largest value")
_BESIDE_IT, _PART = Words("Beside it"), Words("{shape}, {where}; {size}")
_FORMULA = Words("Formula to try")
_LOOK = Words("Look at {at}. Measure {measure}.")
_IMPROBABLE = Words("Hardly missing")
_SENTENCES = ColumnKind.SENTENCES
MARKS = {
    DiagnosisVerdict.ADEQUATE: Mark.MET,
    DiagnosisVerdict.MISSING: Mark.OPEN,
    DiagnosisVerdict.UNEXPLAINED: Mark.NOT_MET,
}
_VISIBLE = Words("{share} % of it is visible beside this model")
_FOUND_FROM = Words("{share} % of it is visible beside this model; found from {size} rms on")


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
    error: Facts  #: Of the model with it.
    #: rms and left_out: Root mean square error with it, and at runs predicted from the others, without unit.
    rms: str
    left_out: str
    parameters: tuple[ParameterRow, ...]  #: As fitted.
    #: explains and tell_apart_by: What it explains; what would tell it from its equals, empty if it has none.
    explains: str
    tell_apart_by: str
    remedy: str  #: What to do about it; empty if nobody says.
    equals: tuple[str, ...]  #: Effects that these readings cannot tell from it.
    is_serious: bool  #: Whether it is worth a word: of the set, one with equals, one that is not improbable.
    is_named: bool  #: Whether the verdict names it.
    question: str  #: What is asked of a value beyond what is usual; empty if none is.
    candidate: EffectCandidate


@dataclass(frozen=True, slots=True)
class HiddenRow:
    """Effects that the test cannot see, or hardly, and why."""

    effects: tuple[str, ...]
    reason: str


@dataclass(frozen=True, slots=True)
class DiagnosisRows:
    """A diagnosis in one language."""

    statement: str  #: The verdict in a sentence.
    error: Facts  #: Of the model.
    failures: tuple[FailureRow, ...]  #: Where it fails, the clearest first.
    candidates: tuple[CandidateRow, ...]  #: What it may lack, best first.
    not_excluded: tuple[str, ...]  #: Effects that could not be tried, and look like the first.
    faults: tuple[str, ...]  #: What looks wrong in the data, beside what the verdict states.
    remarks: tuple[str, ...]  #: What was taken for granted.
    #: Whether the verdict is that the first candidate, or one of its equals, is missing.
    names_candidates: bool
    #: What is left without a name, in names and values; none where it is noise.
    remainder: Facts | None

    @property
    def leading(self) -> tuple[CandidateRow, ...]:
        """The candidates that the verdict names: those of the set with their equals; else none."""
        return tuple(each for each in self.candidates if each.is_named and self.names_candidates)

    @classmethod
    def of(
        cls, diagnosis: AxisDiagnosis, language: Language, titles: Mapping[str, Words] | None = None
    ) -> DiagnosisRows:
        """Return a diagnosis."""
        axis = diagnosis.fit.design.axis
        serious = select_serious_candidates(diagnosis)

        def rows(candidates: Iterable[EffectCandidate]) -> tuple[CandidateRow, ...]:
            return tuple(
                _make_candidate_row(each, diagnosis, language, titles or {}, is_serious=each in serious)
                for each in candidates
            )

        return cls(
            statement=write_verdict_statement(diagnosis).in_language(language),
            error=list_error_facts(diagnosis.error, axis, language),
            failures=tuple(make_failure_row(each, language) for each in diagnosis.failures),
            candidates=rows(diagnosis.candidates),
            not_excluded=tuple(diagnosis.not_excluded),
            faults=tuple(
                _FAULT.given(statement=each.statement, remedy=each.remedy).in_language(language)
                for each in list_further_faults(diagnosis)
            ),
            remarks=tuple(each.in_language(language) for each in diagnosis.remarks),
            names_candidates=diagnosis.verdict is DiagnosisVerdict.MISSING,
            remainder=_lay_out_remainder(diagnosis, language),
        )


def lay_out_diagnosis(
    diagnosis: AxisDiagnosis,
    language: Language,
    titles: Mapping[str, Words],
    experiment: Experiment | None = None,
) -> tuple[Section, ...]:
    """Return what is said of a diagnosis, whoever says it; what is not to be said is left out.

    The sections are ``verdict``, ``remainder``, ``faults``, ``assumed``, ``model``, ``failures``,
    ``candidates``, ``improbable``, ``remedy`` and ``experiment``.

    `titles`: What effects are called, by identifier.
    `experiment`: What to measure next; None where nothing is to be decided.
    """
    rows, fit = DiagnosisRows.of(diagnosis, language, titles), diagnosis.fit
    section, notice = partial(_make_section, language), partial(_make_notice, language)
    serious = [each for each in rows.candidates if each.is_serious]
    others = [each for each in rows.candidates if not each.is_serious]
    first = rows.candidates[0].effect if rows.candidates else ""
    excluded = _NOT_EXCLUDED.given(first=first, effects=", ".join(rows.not_excluded)).in_language(language)
    leads = bool(rows.candidates) and diagnosis.verdict is not DiagnosisVerdict.ADEQUATE
    is_across = any(each.remedy for each in rows.leading) and fit.design.axis.measurand == STRAIGHTNESS
    sections = (
        section("verdict", VERDICT, Paragraph(rows.statement, MARKS[diagnosis.verdict]), rows.error),
        section("remainder", LEFT, rows.remainder, _look(diagnosis, language)),
        section("faults", _FAULTS, notice(_FAULTS, rows.faults)),
        section("assumed", _ASSUMED, notice(_ASSUMED, rows.remarks)),
        section("model", EFFECTS, lay_out_parameters(fit, language) if fit.model.terms else None),
        section(
            "failures",
            FAILURES,
            notice(
                FAILURES,
                (
                    f"{each.statement} ({join_parts((each.where, each.p), language)})"
                    for each in rows.failures
                ),
            )
            or Paragraph(_NO_FAILURE.in_language(language)),
        ),
        section(
            "candidates",
            CANDIDATES,
            _lay_out_candidates(serious, fit, language),
            Paragraph(excluded) if leads and rows.not_excluded else None,
        ),
        section("improbable", _IMPROBABLE, _lay_out_candidates(others, fit, language)),
        section(
            "remedy",
            REMEDY,
            Paragraph(_ACROSS_THE_MOTION.in_language(language)) if is_across else None,
            notice(
                REMEDY,
                (
                    named(each.effect, each.remedy).in_language(language)
                    for each in rows.leading
                    if each.remedy
                ),
            ),
        ),
        section(
            "experiment",
            EXPERIMENT,
            notice(EXPERIMENT, [experiment.statement.in_language(language)] if experiment else []),
        ),
    )
    return tuple(each for each in sections if each.blocks)


def lay_out_unseen(
    diagnosis: AxisDiagnosis, language: Language, titles: Mapping[str, Words]
) -> tuple[Section, ...]:
    """Return what the test cannot see or try: the sections ``hidden``, ``not-tried`` and ``visibility``.

    `titles`: What effects are called, by identifier.
    """
    section, notice = partial(_make_section, language), partial(_make_notice, language)
    hidden, not_tested = list_hidden(diagnosis, language), list_not_tested(diagnosis, language)
    sections = (
        section("hidden", HIDDEN, notice(HIDDEN, (_write_reason(each, language) for each in hidden))),
        section(
            "not-tried", NOT_TRIED, notice(NOT_TRIED, (_write_reason(each, language) for each in not_tested))
        ),
        section("visibility", _CAN_SEE, _lay_out_visibility(diagnosis, language, titles)),
    )
    return tuple(each for each in sections if each.blocks)


def _make_section(language: Language, key: str, title: Words, *blocks: Block | None) -> Section:
    return Section(key, title.in_language(language), tuple(each for each in blocks if each))


def _make_notice(language: Language, title: Words, items: Iterable[str]) -> Notice | None:
    said = tuple(items)
    return Notice(title.in_language(language), said) if said else None


def _write_reason(row: HiddenRow, language: Language) -> str:
    return named(", ".join(row.effects), row.reason).in_language(language)


def _lay_out_candidates(candidates: Sequence[CandidateRow], fit: Fit, language: Language) -> Table | None:
    """Return effects that the model may lack, best first; None if there are none.

    The columns are ``effect``, ``probability``, ``rms``, ``left_out`` and ``p``, and of those worth a word
    ``equals``, ``tell``, ``parameters`` and ``explains``.
    """
    if not candidates:
        return None
    unit = fit.design.axis.deviation_unit.symbol

    def column(key: str, words: Words, unit: str = "", kind: ColumnKind = ColumnKind.VALUES) -> Column:
        align = Align.RIGHT if unit else Align.LEFT
        return Column(words.in_language(language), unit, align, key, kind)

    def cells(row: CandidateRow) -> tuple[Cell, ...]:
        known = Explained(row.effect, row.title), row.probability, row.rms, row.left_out, row.p
        if not row.is_serious:
            return known
        estimates = (write_in_a_sentence(each, language) for each in row.parameters)
        fitted = ", ".join((*list_choices(row.candidate.effect), *estimates))
        return (*known, ", ".join(row.equals) or NOTHING, row.tell_apart_by or NOTHING, fitted, row.explains)

    columns = (
        column("effect", Words("Effect")),
        column("probability", Words("Probability"), "%"),
        column("rms", Words("RMS after"), unit),
        column("left_out", Words("Runs left out"), unit),
        column("p", same("")),
        column("equals", Words("Not to be told from"), kind=_SENTENCES),
        column("tell", Words("Told apart by"), kind=_SENTENCES),
        column("parameters", same(""), kind=_SENTENCES),
        column("explains", same(""), kind=_SENTENCES),
    )
    rows = tuple(map(cells, candidates))
    return Table(_CANDIDATES.in_language(language), columns[: len(rows[0])], (RowGroup(rows),))


def _lay_out_visibility(diagnosis: AxisDiagnosis, language: Language, titles: Mapping[str, Words]) -> Table:
    """Return how much of each effect the plan of the test can see, the best hidden first."""
    axis = diagnosis.fit.design.axis
    columns = (
        Column(Words("Effect").in_language(language)),
        Column(Words("Title").in_language(language)),
        Column(Words("Visible").in_language(language), "%", Align.RIGHT),
        Column(
            Words("Found from").in_language(language),
            axis.deviation_unit.symbol,
            Align.RIGHT,
        ),
    )
    rows = tuple(
        (
            each.effect,
            _say_title(each.effect, titles, language),
            write_percentage(each.share, language.decimal_sign),
            write_deviation(each.smallest_rms, axis, language),
        )
        for each in sorted(diagnosis.visibility, key=lambda each: (each.share, each.effect))
    )
    return Table(_VISIBILITY.in_language(language), columns, (RowGroup(rows),), dense=True)


def make_failure_row(failure: Failure, language: Language) -> FailureRow:
    """Return a test that failed."""
    where = CONDITION_NAMES.get(failure.condition, failure.where)
    return FailureRow(
        failure.statement.in_language(language),
        where.in_language(language),
        write_p_value(failure.p_value, language.decimal_sign),
        failure,
    )


def write_effect_argument(effect: Effect) -> str:
    """Return an effect as a job would name it, with its keys unless they are the usual ones."""
    settings = effect.settings.model_dump(mode="json", exclude_defaults=True)
    return f"{effect.identifier}: {json.dumps(settings)}" if settings else effect.identifier


def _make_candidate_row(
    candidate: EffectCandidate,
    diagnosis: AxisDiagnosis,
    language: Language,
    titles: Mapping[str, Words],
    *,
    is_serious: bool,
) -> CandidateRow:
    design, sign = diagnosis.fit.design, language.decimal_sign
    p = write_p_value(candidate.p_value, sign, is_extrapolated=candidate.p_value_is_extrapolated)
    if candidate.p_value_is_extrapolated:
        p = Words("{p} (extrapolated)").given(p=p).in_language(language)
    tell, remedy = candidate.discriminate_by, candidate.effect.remedy
    return CandidateRow(
        effect=candidate.identifier,
        argument=write_effect_argument(candidate.effect),
        title=_say_title(candidate.identifier, titles, language),
        probability=write_percentage(candidate.probability, sign),
        p=p,
        error=list_error_facts(candidate.error, design.axis, language),
        rms=write_deviation(candidate.error.rms, design.axis, language),
        left_out=write_deviation(candidate.error.cross_validated_rms, design.axis, language),
        parameters=tuple(ParameterRow.of(each, design, language) for each in candidate.estimates),
        explains=candidate.explains.in_language(language),
        tell_apart_by=tell.in_language(language) if tell else "",
        remedy=remedy.in_language(language) if remedy else "",
        equals=tuple(candidate.equals),
        is_serious=is_serious,
        is_named=_is_named(candidate, diagnosis),
        question=candidate.question.in_language(language) if candidate.question else "",
        candidate=candidate,
    )


def _say_title(effect: str, titles: Mapping[str, Words], language: Language) -> str:
    """Return what an effect is called, a second joint as the first; empty where nobody says."""
    title = titles.get(effect) or titles.get(part_number(effect)[0])
    return title.in_language(language) if title else ""


def _is_named(candidate: EffectCandidate, diagnosis: AxisDiagnosis) -> bool:
    """Return whether a candidate is one of the set, or an equal of one."""
    names = {each.identifier for each in diagnosis.together}
    return candidate.identifier in names or bool(names & {*candidate.equals})


def _lay_out_remainder(diagnosis: AxisDiagnosis, language: Language) -> Facts | None:
    """Return what is left without a name: its shape, place, sizes, share and formula."""
    left = diagnosis.remainder
    if left is None:
        return None
    axis = diagnosis.fit.design.axis
    pairs = [
        (_SHAPE, left.shape.in_language(language)),
        (_WHERE, left.where.in_language(language)),
        (_SIZE, wording.deviation(axis, left.rms).in_language(language)),
        (_LARGEST, wording.deviation(axis, left.size).in_language(language)),
        (Words("Share of what the model leaves"), f"{write_percentage(left.share, language.decimal_sign)} %"),
        *(
            (
                _BESIDE_IT,
                _PART.given(
                    shape=each.shape, where=each.where, size=wording.deviation(axis, each.rms)
                ).in_language(language),
            )
            for each in left.further
        ),
    ]
    if left.formula is not None:
        pairs.append((_FORMULA, left.formula.formula))
    return Facts(tuple((name.in_language(language), value) for name, value in pairs))


def _look(diagnosis: AxisDiagnosis, language: Language) -> Paragraph | None:
    """Return where to look for what is left, and what to measure."""
    left = diagnosis.remainder
    if left is None:
        return None
    look = look_for(left, diagnosis.fit.design)
    return Paragraph(_LOOK.given(at=look.at, measure=look.measure).in_language(language))


def list_hidden(diagnosis: AxisDiagnosis, language: Language) -> Iterator[HiddenRow]:
    """Yield the effects that the plan of the test hides beside the model."""
    axis = diagnosis.fit.design.axis
    for each in diagnosis.visibility:
        if each.is_hidden:
            words = _FOUND_FROM if math.isfinite(each.smallest_rms) else _VISIBLE
            reason = words.given(
                share=write_percentage(each.share, language.decimal_sign),
                size=wording.deviation(axis, each.smallest_rms),
            )
            yield HiddenRow((each.effect,), reason.in_language(language))


def list_not_tested(diagnosis: AxisDiagnosis, language: Language) -> tuple[HiddenRow, ...]:
    """Return the effects that could not be tried, reason by reason."""
    by_reason: dict[str, list[str]] = {}
    for each in diagnosis.not_testable:
        by_reason.setdefault(each.reason.in_language(language), []).append(each.effect)
    return tuple(HiddenRow(tuple(effects), reason) for reason, effects in by_reason.items())
