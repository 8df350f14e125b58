"""All values that the page of a job shows, collected; a built model as a staircase."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from zlmreport.document.figures.model_diagram import ModelDiagram
from zlmreport.document.subjects.diagnosis import CandidateRow, DiagnosisRows, list_hidden, list_not_tested
from zlmreport.document.subjects.fit import say_no_table_takes_away, write_deviation
from zlmreport.document.subjects.linked import collect_failure, collect_graphs, collect_model_curves
from zlmreport.errors import InputError, ZlmreportError
from zlmreport.job.job import Job
from zlmreport.language import Language, Said, Words, list_alternatives, same
from zlmreport.measurement.units import with_unit
from zlmreport.model.diagnosis.asking import list_lengths_asked
from zlmreport.model.diagnosis.diagnosis import AxisDiagnosis
from zlmreport.model.diagnosis.faults import DataFault
from zlmreport.model.diagnosis.study import Study
from zlmreport.model.effects.effect import Effect
from zlmreport.plugin.registry import Registry
from zlmreport.web.asked import collect_field, list_what_is_lacking, name_key
from zlmreport.web.bench import PLACE, Bench, Loaded
from zlmreport.web.commands import list_offered
from zlmreport.web.journal import REDO, UNDO, BenchJournal, JournalStep, find_redoable, find_undoable
from zlmreport.web.naming import Naming
from zlmreport.web.panels import Panels, collect_errors, collect_parameter

_RESHAPED = Words("{effect}, in another form")
_READING = Words("{target} {arrow}, run {run}")
_ARROWS = {"+": "↑", "-": "↓"}
_STEPS = {
    "add": Words("{subject} added"),
    "remove": Words("{subject} removed"),
    "fix": Words("{subject} fixed"),
    "free": Words("{subject} freed"),
    "exclude": Words("reading set aside: {subject}"),
    "include": Words("reading brought back: {subject}"),
    "state": Words("{subject} stated"),
    "undo": Words("taken back: {subject}"),
    "redo": Words("done again: {subject}"),
}
#: Steps that are shown; the file beside the job holds all of them.
_SHOWN = 30


def make_view(bench: Bench, loaded: Loaded, language: Language) -> dict[str, Any]:
    """Return the page of a job."""
    whole = bench.fit_whole(loaded)
    panels = Panels(language, loaded, bench.registry, whole)
    names = panels.naming
    return {
        "stamp": loaded.stamp,
        "digest": loaded.digest,
        "number": loaded.job.keys.certificate.number,
        "subject": _name_subject(loaded.job, language),
        "file": bench.path.name,
        "graphs": collect_graphs(loaded.study, whole, language),
        "error": panels.list_error(),
        "effects": panels.list_effects(),
        "others": panels.list_other_effects(),
        "excluded": panels.list_excluded(),
        "offered": list_offered(bench, loaded, language),
        "asked": [
            {
                "key": each.key,
                "name": each.name.in_language(language),
                "unit": each.unit,
                "effects": list(each.effects),
                "names": [names.name_in(effect) for effect in each.effects],
            }
            for each in list_lengths_asked(
                loaded.study.observed.design, loaded.study.model.identifiers, bench.registry.effects
            )
        ],
        **list_steps(bench.path, loaded.digest, names),
    }


def make_results(bench: Bench, loaded: Loaded, language: Language) -> dict[str, Any]:
    """Return what takes longer than the graphs: how the error fell, and what the standards say."""
    panels = Panels(language, loaded, bench.registry, bench.fit_whole(loaded))
    return {
        "stamp": loaded.stamp,
        "fall": panels.list_fall(bench.fit_history(loaded)),
        "standards": panels.list_standards(bench.evaluate(loaded)),
        "moving": say_no_table_takes_away(panels.whole.fit, language),
        "lacking": [collect_field(each, language) for each in list_what_is_lacking(loaded, bench.registry)],
    }


def collect_before_and_after(bench: Bench, loaded: Loaded, step: str, language: Language) -> dict[str, Any]:
    """Return what the graphs draw before and after a step of the model.

    `step`: The number of an effect of the model, from 1; or an effect that is not in it, as a job names it.

    Raises `InputError` if there is no such effect, or it cannot be fitted.
    """
    history = bench.fit_history(loaded)
    if step.isdecimal() and 0 < int(step) < len(history):
        fits = history[int(step) - 1], history[int(step)]
    else:
        fits = history[-1], bench.fit_with_effect(loaded, step)
    drawn = (collect_graphs(loaded.study, each, language) for each in fits)
    return {
        name: {"model": each["model"], "residual": each["readings"]["residual"]}
        for name, each in zip(("before", "after"), drawn, strict=True)
    }


def collect_closer(bench: Bench, loaded: Loaded, ends: tuple[float, float]) -> dict[str, Any]:
    """Return the curves of the model on a part of the travel, as finely as that part needs.

    `ends`: Of the part: positions in the unit of the page.

    Raises `InputError` if there is no such part.
    """
    whole, unit = bench.fit_whole(loaded), loaded.job.axis.position_unit
    first, last = whole.fit.design.span
    low, high = (min(max(unit.to_si(each), first), last) for each in ends)
    if not low < high:
        raise InputError.at(PLACE, "nothing was measured there")
    return {
        "stamp": loaded.stamp,
        "model": collect_model_curves(ModelDiagram(whole.fit, whole.error, (low, high))),
    }


def list_steps(path: Path, digest: str, names: Naming) -> dict[str, Any]:
    """Return what was done on a page, the last first, and what an undo and a redo would take back."""
    entries = BenchJournal.of(path).read_entries()
    back = {UNDO: find_undoable(entries, digest), REDO: find_redoable(entries, digest)}
    return {
        "steps": [_list_step(each, names) for each in reversed(entries[-_SHOWN:])],
        **{
            name: entry and names.name_in(_say_done_by(entry).in_language(names.language))
            for name, entry in back.items()
        },
    }


def _list_step(entry: JournalStep, names: Naming) -> dict[str, str]:
    """Return a step as people read it: when, and what."""
    words = _say_done_by(entry)
    if entry.action in {UNDO, REDO}:
        words = _STEPS[entry.action].given(subject=words)
    return {"at": entry.at[11:19], "text": names.name_in(words.in_language(names.language))}


@dataclass(frozen=True, slots=True)
class _StatedKeys:
    """Keys of a job that were stated: as they stand on a page in English, by their names on any other."""

    keys: tuple[str, ...]

    def in_language(self, language: Language) -> str:
        """Return the keys in one language, parted by commas."""
        if language is Language.ENGLISH:
            return ", ".join(self.keys)
        return ", ".join((name_key(key) or same(key)).in_language(language) for key in self.keys)


def _say_done_by(entry: JournalStep) -> Words:
    """Return what a step did; of one that took another back or brought it back, what that did."""
    action, subject = entry.action, entry.subject
    if action in {UNDO, REDO}:
        action, _, subject = subject.partition(" ")
    parts = subject.split(" ")
    if action in {"exclude", "include"} and len(parts) == len(("target", "direction", "run")):
        target, direction, run = parts
        named: str | Said = _READING.given(target=target, arrow=_ARROWS.get(direction, direction), run=run)
    elif action == "state":
        named = _StatedKeys(tuple(subject.split(", ")))
    else:
        named = subject
    return _STEPS.get(action, same("{subject}")).given(subject=named)


def _name_subject(job: Job, language: Language) -> str:
    machine = job.keys.machine
    parts = (job.axis.heading.in_language(language), machine.type, machine.serial)
    return ", ".join(part for part in parts if part)


def collect_diagnosed(
    diagnosis: AxisDiagnosis, study: Study, effects: Sequence[Effect], language: Language
) -> dict[str, Any]:
    """Return a diagnosis in one language."""
    rows = DiagnosisRows.of(diagnosis, language, {each.identifier: each.title for each in effects})
    names = Naming.of((*effects, *(term.effect for term in diagnosis.fit.model.terms)), language)
    return {
        "verdict": diagnosis.verdict.value,
        "statement": names.name_in(rows.statement),
        "failures": [collect_failure(each, diagnosis, study) for each in rows.failures],
        "faults": [_describe_fault(each, study, language) for each in diagnosis.faults],
        "candidates": [_make_candidate(each, rows, names) for each in rows.candidates],
        "serious": sum(each.is_serious for each in rows.candidates),
        "hidden": [
            {
                "effects": list(each.effects),
                "names": [names.name_in(effect) for effect in each.effects],
                "reason": names.name_in(each.reason),
            }
            for each in (*list_hidden(diagnosis, language), *list_not_tested(diagnosis, language))
        ],
        "notExcluded": list(rows.not_excluded),
        "notExcludedNames": [names.name_in(each) for each in rows.not_excluded],
        "remarks": [names.name_in(each) for each in rows.remarks],
    }


def _describe_fault(fault: DataFault, study: Study, language: Language) -> dict[str, Any]:
    """Return what looks wrong in the data, with the places of the readings of its run."""
    observed = study.observed
    of_run = observed.design.run == (-1 if fault.run is None else fault.run)
    return {
        "statement": fault.statement.in_language(language),
        "remedy": fault.remedy.in_language(language),
        "readings": observed.reading[of_run].tolist(),
    }


def _make_candidate(row: CandidateRow, diagnosed: DiagnosisRows, names: Naming) -> dict[str, Any]:
    return {
        "effect": row.effect,
        "name": names.name_in(row.effect),
        "title": row.title,
        "argument": row.argument,
        "probability": f"{row.probability} %",
        "share": row.candidate.probability,
        "plausible": row.candidate.is_plausible,
        "p": row.p,
        "rmsBefore": diagnosed.error.pairs[0][1],
        "rmsAfter": row.error.pairs[0][1],
        "error": collect_errors(row.error),
        "parameters": [collect_parameter(each, names.language) for each in row.parameters],
        "explains": names.name_in(row.explains),
        "equals": list(row.equals),
        "equalNames": [names.name_in(each) for each in row.equals],
        "tell": names.name_in(row.tell_apart_by),
        "remedy": names.name_in(row.remedy),
    }


def make_stairs(
    steps: Sequence[Mapping[str, Any]], job: Job, registry: Registry, names: Naming
) -> list[dict[str, Any]]:
    """Return the steps of a build as a page shows them.

    `steps`: As ``zlmreport model build --json`` has them, errors in the unit of the job's deviations.
    """
    unit, language = job.axis.deviation_unit, names.language
    largest = max((each["rms_before"] for each in steps), default=0.0) or 1.0

    def write(value: float | None) -> str:
        number = write_deviation(None if value is None else unit.to_si(value), job.axis, language)
        return with_unit(number, unit.symbol)

    def make_stair(each: Mapping[str, Any]) -> dict[str, Any]:
        removed = bool(each.get("removed"))
        name, noise = _name_one_of(each, names), each["noise_rms"]
        reshaped = _RESHAPED.given(effect=name).in_language(language)
        return {
            "effect": each["effect"],
            "argument": _write_argument(each["effect"], each["settings"], job, registry),
            "removed": removed,
            "name": reshaped if each.get("reshaped") else f"{'−' if removed else '+'} {name}",
            "before": write(each["rms_before"]),
            "after": write(each["rms_after"]),
            "share": each["rms_after"] / largest,
            "floor": None if noise is None else min(1.0, noise / largest),
        }

    return [make_stair(each) for each in steps]


def _name_one_of(step: Mapping[str, Any], names: Naming) -> str:
    """Return the effect of a step, with those that the readings do not tell from it."""
    titles = [names.name_in(each) for each in (step["effect"], *step.get("indistinguishable_from", ()))]
    return list_alternatives(titles).in_language(names.language)


def _write_argument(effect: str, settings: Mapping[str, Any], job: Job, registry: Registry) -> str:
    """Return an effect as a job names it: a formula of its candidates by name, else with unusual keys."""
    if effect in {each.identifier for each in job.candidates}:
        return effect
    try:
        usual = registry.effect(effect).settings.model_dump(mode="json")
    except ZlmreportError:  # one that stands there several times has a number that no plugin knows
        usual = {}
    unusual = {key: value for key, value in settings.items() if key not in usual or usual[key] != value}
    return f"{effect}: {json.dumps(unusual)}" if unusual else effect


def add_stairs(state: dict[str, Any], job: Job, registry: Registry, language: Language) -> dict[str, Any]:
    """Return the state of a build with its staircase; any other state as it is."""
    steps = state.get("values", {}).get("steps")
    if steps is None:
        return state
    return {**state, "stairs": make_stairs(steps, job, registry, Naming.of(registry.effects, language))}
