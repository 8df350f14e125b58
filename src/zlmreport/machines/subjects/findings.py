"""A diagnosis of a machine as people read it: verdict, what is missing or not, values, next run."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from zlmreport.document.blocks import Block, Cell, Column, Notice, Paragraph, RowGroup, Section, Table
from zlmreport.document.subjects.diagnosis import CANDIDATES, MARKS, VERDICT
from zlmreport.language import Words, list_alternatives, list_in_words, named
from zlmreport.language.formatting import write_percentage
from zlmreport.language.numbers import write_significant
from zlmreport.machines.choosing import add_form
from zlmreport.machines.comparison import ComparedTest
from zlmreport.machines.diagnosis import CircleCandidate, MachineDiagnosis, find_verdict_after_build
from zlmreport.machines.forms import make_plain_form
from zlmreport.machines.planning import NextRun
from zlmreport.machines.study import CircleStudy, EstimatedTerm, find_noise_of_both, list_said_estimates
from zlmreport.machines.subjects.saying import Sayer, make_plain_table, make_right_column
from zlmreport.machines.subjects.tests import lay_out_sizes, make_failure_notice
from zlmreport.measurement.units import MICROMETRE
from zlmreport.model.diagnosis.diagnosis import DiagnosisVerdict
from zlmreport.model.effects.circle_effect import CircleEffect

_MOST_CANDIDATES = 5


def say_verdict(diagnosis: MachineDiagnosis) -> Words:
    """Return the verdict in words."""
    if diagnosis.verdict is DiagnosisVerdict.ADEQUATE:
        return _ADEQUATE
    left = diagnosis.remainder
    if diagnosis.verdict is DiagnosisVerdict.UNEXPLAINED and left:
        return _UNEXPLAINED.given(shape=left.shape, size=_write_size(left.rms))
    if not diagnosis.found:
        first = diagnosis.candidates[0]
        equals = [
            first,
            *(
                each
                for each in diagnosis.candidates
                if each.effect.identifier in first.indistinguishable_from
            ),
        ]
        how = say_how_told(first, diagnosis)
        return _TIED.given(effects=list_alternatives([each.effect.title for each in equals]), how=how)
    by_name = {each.effect.identifier: each.effect for each in diagnosis.complete.effects}
    named = _MISSING.given(effects=list_in_words([by_name[each].title for each in diagnosis.found]))
    if left is None:
        return named
    beside = _BESIDE.given(shape=left.shape, size=_write_size(left.rms))
    return _TWO.given(one=named, other=beside)


def say_verdict_after_build(diagnosis: MachineDiagnosis) -> Words:
    """Return the verdict on the model as built: what was found is in it, what is tied is still missing."""
    if diagnosis.remainder:
        left = diagnosis.remainder
        return _UNEXPLAINED.given(shape=left.shape, size=_write_size(left.rms))
    if diagnosis.is_tied and diagnosis.found:
        return Words("Something is still missing: this plan cannot tell what, so nothing more is named.")
    return say_verdict(diagnosis) if diagnosis.is_tied else _ADEQUATE


def _write_size(rms: float) -> Words:
    return write_significant(MICROMETRE.from_si(rms), 2)


def say_how_told(candidate: CircleCandidate, diagnosis: MachineDiagnosis) -> Words:
    """Return what tells a candidate from the first of its equals: a run in which their laws part."""
    by_name = {each.effect.identifier: each.effect for each in diagnosis.candidates}
    one, other = candidate.effect, by_name[candidate.indistinguishable_from[0]]
    design = diagnosis.study.design
    if not design.has_both_senses and one.law.parity is not other.law.parity:
        return _SENSE
    if len(np.unique(np.round(design.feed, 9))) == 1 and one.law.feed != other.law.feed:
        return _FEED
    if len(np.unique(np.round(design.radius, 9))) == 1 and one.law.radius != other.law.radius:
        return _RADIUS
    return _REPEAT


@dataclass(frozen=True, slots=True)
class Absent:
    """An effect of which nothing is found, and how much of it there might be."""

    effect: str
    estimates: tuple[EstimatedTerm, ...]
    sentences: tuple[Words, ...]


def list_absent(study: CircleStudy, catalogue: Sequence[CircleEffect]) -> list[Absent]:
    """Return what effects that are asked for and not in a model would be beside it.

    A value beyond its U is not told: of it nobody can say that it is not there. Nor is one whose U is beyond
    all that physics allows: an arc in which no axis turns says nothing of play.
    """
    found = []
    for effect in catalogue:
        form = make_plain_form(effect, study.design)
        if effect.is_asked_for and effect.identifier not in study.names and form.terms:
            estimates = add_form(study, effect, form).list_estimates_of(effect.identifier)
            terms = tuple(each for each in estimates if _is_within_u(each))
            if not terms:
                continue
            found.append(Absent(effect.identifier, terms, tuple(effect.absence(list_said_estimates(terms)))))
    return found


def _is_within_u(found: EstimatedTerm) -> bool:
    term, u = found.term, found.expanded_uncertainty
    if term is None or u is None:
        return False
    return abs(found.value) <= u <= max(abs(term.low), abs(term.high))


def list_findings(study: CircleStudy) -> list[Words]:
    """Return what the parameters of a model mean, in sentences of its effects."""
    return [
        sentence
        for each in study.effects
        for sentence in each.effect.findings(
            list_said_estimates(study.list_estimates_of(each.effect.identifier))
        )
    ]


def lay_out_verdict(diagnosis: MachineDiagnosis, say: Sayer) -> Section:
    """Return the verdict, and what was found, in sentences."""
    return _lay_out_sentences(say_verdict(diagnosis), diagnosis.verdict, diagnosis, say)


def lay_out_verdict_after_build(diagnosis: MachineDiagnosis, say: Sayer) -> Section:
    """Return the verdict on the model as built, and what was found, in sentences."""
    verdict = find_verdict_after_build(diagnosis)
    return _lay_out_sentences(say_verdict_after_build(diagnosis), verdict, diagnosis, say)


def _lay_out_sentences(
    verdict: Words, kind: DiagnosisVerdict, diagnosis: MachineDiagnosis, say: Sayer
) -> Section:
    blocks: list[Block] = [Paragraph(say(verdict), MARKS[kind])]
    blocks += [Paragraph(_write_sentence(say(each))) for each in list_findings(diagnosis.complete)]
    return Section("verdict", say(VERDICT), tuple(blocks))


def lay_out_absence(diagnosis: MachineDiagnosis, say: Sayer) -> Section | None:
    """Return what was looked for and not found, with what of it there might be; None where nothing was.

    Beside something that is there and has no name yet, nothing is told: its share stands in every estimate.
    """
    if diagnosis.is_tied:
        return None
    sentences = [
        _write_sentence(say(one))
        for each in list_absent(diagnosis.complete, diagnosis.catalogue)
        for one in each.sentences
    ]
    if not sentences:
        return None
    return Section("absence", say(_NOT_FOUND), (Notice(say(_NOT_FOUND), tuple(sentences)),))


def _write_sentence(text: str) -> str:
    return f"{text[:1].upper()}{text[1:]}{'' if text.endswith('.') else '.'}"


def lay_out_candidates(diagnosis: MachineDiagnosis, say: Sayer) -> Section | None:
    """Return the effects that may be missing, best first; None where there is none."""
    if not diagnosis.candidates:
        return None
    rows: list[tuple[Cell, ...]] = []
    titles = {each.identifier: each.title for each in diagnosis.catalogue}
    for each in diagnosis.candidates[:_MOST_CANDIDATES]:
        note = "" if each.is_plausible else say(_IMPOSSIBLE)
        if each.indistinguishable_from:
            equals = [say(titles[name]) for name in each.indistinguishable_from]
            note = say(Words("not to be told from {effects}").given(effects=", ".join(equals)))
        rows.append(
            (
                say.explain_effect(each.effect),
                say.write_number(each.evidence, 1),
                say.write_micrometres(each.rms_after),
                note,
            )
        )
    columns = (
        Column(say(_EFFECT)),
        make_right_column(say(_EVIDENCE)),
        make_right_column(say(_RMS_AFTER), "µm"),
        Column(""),
    )
    blocks: list[Block] = [make_plain_table(say(CANDIDATES), columns, rows)]
    first = diagnosis.candidates[0]
    blocks.append(lay_out_parameters([first.effect], first.estimates, say))
    if first.indistinguishable_from:
        blocks.append(Paragraph(say(_TELL_APART.given(how=say_how_told(first, diagnosis)))))
    return Section("candidates", say(CANDIDATES), tuple(blocks))


def lay_out_model(study: CircleStudy, say: Sayer) -> Section:
    """Return the effects of a model with their parameters."""
    table = lay_out_parameters([each.effect for each in study.effects], study.estimates, say)
    return Section("model", say(_MODEL), (table, Paragraph(say(_COVERAGE))))


def lay_out_parameters(
    effects: Iterable[CircleEffect], estimates: Sequence[EstimatedTerm], say: Sayer
) -> Table:
    """Return the parameters of effects with their uncertainties, effect by effect."""
    columns = (Column(say(_PARAMETER)), make_right_column(say(_VALUE)), Column(say(_UNIT)))
    groups = tuple(
        RowGroup(
            tuple(_lay_out_estimate(each, say) for each in estimates if each.effect == effect.identifier),
            say(named(effect.identifier, effect.title)),
        )
        for effect in effects
    )
    return Table(say(_PARAMETERS), columns, groups)


def _lay_out_estimate(found: EstimatedTerm, say: Sayer) -> tuple[Cell, ...]:
    """Return a parameter with its uncertainty; one that was only tried at some values has none."""
    u = found.expanded_uncertainty
    value = (
        say.write_general(found.unit.from_si(found.value))
        if u is None
        else say.write_pair(found.value, u, found.unit)
    )
    return say(found.title), value, found.unit.symbol


def lay_out_steps(diagnosis: MachineDiagnosis, say: Sayer) -> Section | None:
    """Return how the error fell as the effects came in, one by one; None where none did."""
    by_name = {each.identifier: each for each in diagnosis.catalogue}
    rows: list[tuple[Cell, ...]] = [
        (
            say.explain_effect(by_name[each.effect]),
            *map(say.write_micrometres, (each.before, each.after, each.noise)),
        )
        for each in diagnosis.steps
    ]
    columns = (
        Column(say(_EFFECT)),
        *(make_right_column(say(each), "µm") for each in (_BEFORE, _AFTER, _NOISE)),
    )
    table = make_plain_table(say(_STEPS), columns, rows)
    return Section("steps", say(_STEPS), (table,)) if rows else None


def lay_out_change(before: CircleStudy, after: CircleStudy, say: Sayer) -> Section:
    """Return the error before and after a change of the model."""
    noise, _ = find_noise_of_both(before, after)
    sizes = [_write_size(each) for each in (before.rms, after.rms, noise)]
    names = list_in_words(after.names or [_NONE])
    said = _CHANGE.given(effects=names, before=sizes[0], after=sizes[1], noise=sizes[2])
    return Section("change", say(_CHANGED), (Paragraph(say(said)),))


def say_what_is_next(diagnosis: MachineDiagnosis, planned: NextRun) -> Words:
    """Return what to do next: the effect to add, the run that decides, where to look, or the document."""
    if diagnosis.found:
        first = diagnosis.steps[0]
        title = next(
            each.effect.title for each in diagnosis.candidates if each.effect.identifier == first.effect
        )
        before, after, noise = map(_write_size, (first.before, first.after, first.noise))
        return _NEXT_ADD.given(effect=title, before=before, after=after, noise=noise)
    if diagnosis.is_tied and planned.proposals:
        first_run = planned.proposals[0]
        return _NEXT_RUN.given(run=first_run.what, number=round(first_run.minutes))
    if diagnosis.verdict is DiagnosisVerdict.ADEQUATE:
        return Words("Next: nothing is missing; write the document.")
    return _NEXT_LOOK


def lay_out_diagnosis(
    found: MachineDiagnosis, before: Sequence[ComparedTest], say: Sayer
) -> Iterator[Section]:
    """Yield all that is said of a diagnosis, its tests behind the verdict.

    `before`: The circles with the model that was diagnosed.
    """
    failures = make_failure_notice(before, say)
    sizes = lay_out_sizes(before, say, found.noise_of_readings)
    yield lay_out_verdict(found, say)
    yield Section("tests", "Tests", (sizes, failures) if failures else (sizes,))
    for section in (lay_out_candidates(found, say), lay_out_absence(found, say)):
        if section:
            yield section


_NEXT_ADD = Words(
    "Next: add {effect}. The error falls from {before} µm to {after} µm; the noise is {noise} µm."
)
_NEXT_RUN = Words(
    "Next: run {run}, {number} minute; then one of them can be named.",
    plural="Next: run {run}, {number} minutes; then one of them can be named.",
)
_NEXT_LOOK = Words(
    "Next: repeat the run. If it comes again, look at the machine where the residual stands out: no "
    "effect of the catalogue has its shape."
)
_ADEQUATE = Words("Axes and effects describe the circles: nothing is left that the scatter does not explain.")
_MISSING = Words("Missing: {effects}.")
_TIED = Words("Missing: {effects}. This plan cannot tell them apart, so none of them is named: {how}.")
_UNEXPLAINED = Words("Something is left that no effect explains: {shape}, root mean square {size} µm.")
_BESIDE = Words("Beside it something without a name is left: {shape}, root mean square {size} µm.")
_TWO = Words("{one} {other}")
_SENSE = Words("run the circle in the other sense, too")
_FEED = Words("run the circle at a quarter or at four times the feed, too")
_RADIUS = Words("run the circle with a bar of another length, too")
_REPEAT = Words("repeat the run, at another feed and another radius")
_NOT_FOUND = Words("Looked for beyond what axes and effects make, and not found")
_EFFECT, _PARAMETER = Words("Effect"), Words("Parameter", context="model")
_EVIDENCE, _RMS_AFTER = Words("evidence"), Words("RMS after", context="machine")
_IMPOSSIBLE = Words("impossible values")
_TELL_APART = Words("To tell them apart: {how}.")
_MODEL = Words("Effects of drives and structure")
_PARAMETERS = Words("Parameters of the effects")
_VALUE, _UNIT = Words("Value"), Words("Unit")
_COVERAGE = Words("± is the expanded uncertainty, k = 2. Each value is that of all tests fitted together.")
_STEPS = Words("How the error fell, root mean square")
_BEFORE, _AFTER = Words("before"), Words("after")
_NOISE = Words("noise")
_CHANGED = Words("The error before and after")
_CHANGE = Words(
    "With the effects {effects} the root mean square of all circles, neighbouring readings averaged, goes "
    "from {before} µm to {after} µm; the noise is {noise} µm."
)
_NONE = Words("none")


def lay_out_plan(found: NextRun, say: Sayer) -> Section:
    """Return what is to be decided, the runs that do, and what these circles can see."""
    between = [each.title for each in found.between]
    heading = _NOTHING
    if between:
        heading = Words("To tell {effects} apart:").given(effects=list_in_words(between))
    runs: list[tuple[Cell, ...]] = [
        (
            say(each.what),
            say.write_number(each.minutes, 0),
            write_percentage(each.decides, say.language.decimal_sign) if between else "",
        )
        for each in found.proposals
    ]
    blocks: list[Block] = [Paragraph(say(heading))]
    columns = (Column(say(_RUN)), make_right_column(say(_MINUTES)), make_right_column(say(_DECIDES), "%"))
    blocks.append(make_plain_table(say(_NEXT), columns, runs))
    sizes: list[tuple[Cell, ...]] = [
        (
            each.effect,
            say(each.title),
            say.write_general(float(f"{each.unit.from_si(each.size):.2g}")),
            each.unit.symbol,
        )
        for each in found.visible
    ]
    headings = (
        Column(say(_EFFECT)),
        Column(say(_PARAMETER)),
        make_right_column(say(_SIZE)),
        Column(say(_UNIT)),
    )
    blocks += [Paragraph(say(_VISIBLE)), make_plain_table(say(_VISIBLE), headings, sizes)]
    return Section("plan", say(_NEXT), tuple(blocks))


_NEXT = Words("The next run")
_NOTHING = Words("Nothing is to be decided; runs that would add to this:")
_RUN, _MINUTES = Words("run"), Words("minutes")
_DECIDES = Words("decides")
_VISIBLE = Words("Smallest size that these circles show half of the time:")
_SIZE, _UNIT = Words("Size"), Words("Unit")
