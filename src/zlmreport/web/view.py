"""All that the page shows of a job and of its diagnosis, as values for a browser."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from zlmreport.certificate.linked import failure_values, graphs
from zlmreport.job.job import Job
from zlmreport.language import Language, Words, same
from zlmreport.model.diagnosis import Diagnosis
from zlmreport.model.effect import Effect
from zlmreport.model.study import Study
from zlmreport.presenting.diagnosis import CandidateRow, DiagnosisRows
from zlmreport.web.bench import Bench, Loaded
from zlmreport.web.journal import UNDO, Entry, Journal, undoable
from zlmreport.web.panels import Panels, error_values, parameter_values

_READING = Words(en="{target} {arrow}, run {run}", de="{target} {arrow}, Durchlauf {run}")
_ARROWS = {"+": "↑", "-": "↓"}
_AXIS = Words(en="axis {axis}", de="Achse {axis}")
_STEPS = {
    "add": Words(en="{subject} added", de="{subject} hinzugefügt"),
    "remove": Words(en="{subject} removed", de="{subject} entfernt"),
    "fix": Words(en="{subject} fixed", de="{subject} festgehalten"),
    "free": Words(en="{subject} freed", de="{subject} freigegeben"),
    "exclude": Words(en="reading set aside: {subject}", de="Messwert beiseite gelegt: {subject}"),
    "include": Words(en="reading brought back: {subject}", de="Messwert zurückgeholt: {subject}"),
    "undo": Words(en="taken back: {subject}", de="zurückgenommen: {subject}"),
}
#: Steps that are shown; the file beside the job holds all of them.
_SHOWN = 30


def view(bench: Bench, loaded: Loaded, language: Language) -> dict[str, Any]:
    """Return the page of a job.

    Parameters
    ----------
    bench
        Where it lies.
    loaded
        As it was read.
    language
        Of the page.
    """
    history = bench.history(loaded)
    panels = Panels(loaded, bench.registry, history, language)
    entries = Journal.beside(bench.path).entries()
    last = undoable(entries, loaded.digest)
    return {
        "stamp": loaded.stamp,
        "digest": loaded.digest,
        "number": loaded.job.keys.certificate.number,
        "subject": _subject(loaded.job, language),
        "file": bench.path.name,
        "graphs": graphs(loaded.study, history[-1], language),
        "error": panels.error(),
        "effects": panels.effects(),
        "others": panels.others(),
        "fall": panels.fall(),
        "standards": panels.standards(),
        "moving": panels.moving(),
        "excluded": panels.excluded(),
        "steps": [step(each, language) for each in reversed(entries[-_SHOWN:])],
        "undo": None if last is None else step(last, language)["text"],
    }


def step(entry: Entry, language: Language) -> dict[str, str]:
    """Return a step as people read it: when, and what."""
    action, _, subject = (
        entry.subject.partition(" ") if entry.action == UNDO else (entry.action, "", entry.subject)
    )
    words = _done(action, subject)
    if entry.action == UNDO:
        words = _STEPS[UNDO].given(subject=words)
    return {"at": entry.at[11:19], "text": words.in_language(language)}


def _done(action: str, subject: str) -> Words:
    parts = subject.split(" ")
    if action in {"exclude", "include"} and len(parts) == len(("target", "direction", "run")):
        target, direction, run = parts
        named: str | Words = _READING.given(target=target, arrow=_ARROWS.get(direction, direction), run=run)
    else:
        named = subject
    return _STEPS.get(action, same("{subject}")).given(subject=named)


def _subject(job: Job, language: Language) -> str:
    machine = job.keys.machine
    named = " ".join(part for part in (machine.manufacturer, machine.model) if part)
    parts = (_AXIS.given(axis=job.axis.name).in_language(language), named, machine.serial or "")
    return ", ".join(part for part in parts if part)


def diagnosed(
    diagnosis: Diagnosis, study: Study, effects: Sequence[Effect], language: Language
) -> dict[str, Any]:
    """Return a diagnosis in one language."""
    rows = DiagnosisRows.of(diagnosis, language, {each.identifier: each.title for each in effects})
    return {
        "verdict": diagnosis.verdict.value,
        "statement": rows.statement,
        "failures": [failure_values(each, diagnosis, study) for each in rows.failures],
        "candidates": [_candidate(each, rows) for each in rows.candidates],
        "serious": sum(each.is_serious for each in rows.candidates),
        "hidden": [
            {"effects": list(each.effects), "reason": each.reason}
            for each in (*rows.hidden, *rows.not_tested)
        ],
        "notExcluded": list(rows.not_excluded),
        "remarks": list(rows.remarks),
    }


def _candidate(row: CandidateRow, diagnosed: DiagnosisRows) -> dict[str, Any]:
    return {
        "effect": row.effect,
        "title": row.title,
        "argument": row.argument,
        "probability": f"{row.probability} %",
        "share": row.candidate.probability,
        "p": row.p,
        "rmsBefore": diagnosed.error.rms,
        "rmsAfter": row.error.rms,
        "error": error_values(row.error),
        "parameters": [parameter_values(each) for each in row.parameters],
        "explains": row.explains,
        "equals": list(row.equals),
        "tell": row.tell_apart_by,
    }
