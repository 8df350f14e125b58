"""What a click does to the job file: tried first, then written, then recorded.

Each change carries the digest of the file that its page showed. If the file is another one now, nothing is
written: two windows, or a window and an editor, never overwrite each other silently.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated

from pydantic import BaseModel, ConfigDict, StringConstraints, ValidationError

from zlmreport.errors import InputError, Problem
from zlmreport.job.edit import Edit, edit_effects
from zlmreport.job.edit_items import ParameterChoice, edit_keys, edit_parameter, exclude, include
from zlmreport.job.loading import load
from zlmreport.job.measurement_keys import ExclusionKeys
from zlmreport.language import Words
from zlmreport.measurement.approach import Approach
from zlmreport.measurement.measurement_set import MeasurementSet
from zlmreport.model.diagnosis.asking import list_lengths_asked
from zlmreport.model.diagnosis.study import Fitted, read_addition, refuse_useless
from zlmreport.web.asked import list_what_is_lacking
from zlmreport.web.bench import PLACE, Bench, Loaded
from zlmreport.web.journal import (
    REDO,
    UNDO,
    BenchJournal,
    find_redoable,
    find_undoable,
    make_entry,
    record_change,
)

_KEY = "model.effects"
_TABLE = "axis.compensation_table"
_NOTHING = "fill in a field first"
#: Of a target position in mm or degrees: finer than any control is told.
_DECIMALS = 6

_CONFLICT = Words(
    "The job was changed elsewhere: in another window, or in an editor. Nothing was overwritten. The page "
    "now shows the job as it is; do it again if it still makes sense."
)
_NOTHING_TO_UNDO = Words(
    "There is nothing to take back: the job is not as the last step on this page left it."
)

#: What a page sends of a text.
ShortText = Annotated[str, StringConstraints(max_length=500)]


class ConflictError(Exception):
    """The job is no longer the one that the page showed; `words` says so to people."""

    words = _CONFLICT


class NothingToUndoError(Exception):
    """The job is not as the last change or undo left it; `words` says so to people."""

    words = _NOTHING_TO_UNDO


class Request(BaseModel):
    """A click, as the page sends it."""

    model_config = ConfigDict(extra="forbid", frozen=True)

    based_on: ShortText  #: SHA-256 of the job file that the page showed.
    action: ShortText  #: One of `ACTIONS`.
    effect: ShortText = ""  #: Of add and remove, fix and free: an effect; of add as in a job, with its keys.
    parameter: ShortText = ""  #: Of fix and free.
    value: float | None = None  #: Of fix: in the unit of the page.
    #: Of state: values by the keys that the page asks for, in the units of the job.
    stated: dict[ShortText, float | ShortText] = {}
    readings: tuple[int, ...] = ()  #: Of exclude the places of readings in the measurement set.
    listed: int = -1  #: Of include the place of the reading in the job's list.
    reason: ShortText = ""  #: Of exclude.


@dataclass(frozen=True, slots=True)
class _Step:
    """A change that makes sense: what is written, and what the record says of it."""

    edit: Edit
    subject: str


def change(bench: Bench, request: Request) -> None:
    """Do what a click asks for.

    Raises `ConflictError` if the job is no longer the one that the page showed; `NothingToUndoError` if there
    is nothing to take back; `InputError` or `AccessError` if the change makes no sense, or the file cannot be
    written.
    """
    with bench.lock:
        loaded = bench.load()
        if request.based_on != loaded.digest:
            raise ConflictError
        if request.action not in ACTIONS:
            raise InputError.at(PLACE, f"there is no action {request.action[:60]!r}")
        before = bench.fit_whole(loaded)
        content = loaded.job.files[0].content or b""
        step = ACTIONS[request.action](bench, loaded, request)
        step.edit.write()
        after = bench.fit_whole(bench.load())
        errors = _write_rms(before), _write_rms(after)
        entry = make_entry(request.action, step.subject, (content, step.edit.content), errors)
        record_change(bench.path, entry)


def _add(bench: Bench, loaded: Loaded, request: Request) -> _Step:
    registry = bench.registry
    named, removed = read_addition(request.effect, loaded.job, registry, registry.effects, PLACE)
    edit = edit_effects(bench.path, loaded.job, registry, add=[named], remove=removed)
    added = named.choice.identifier
    refuse_useless(added, bench.fit_whole(loaded), _try_fit(bench, loaded, edit), loaded.job)
    return _Step(edit, request.effect)


def _remove(bench: Bench, loaded: Loaded, request: Request) -> _Step:
    if request.effect not in {each.identifier for each in loaded.job.effects}:
        raise InputError.at(loaded.job.place_of(_KEY), f"{request.effect!r} does not stand in the model")
    edit = edit_effects(bench.path, loaded.job, bench.registry, remove=(request.effect,))
    _try_fit(bench, loaded, edit)
    return _Step(edit, request.effect)


def _fix(bench: Bench, loaded: Loaded, request: Request) -> _Step:
    if request.value is None or not math.isfinite(request.value):
        raise InputError.at(PLACE, "a parameter is fixed at a number; write one, such as 4.2")
    return _change_parameter(bench, loaded, request, request.value)


def _free(bench: Bench, loaded: Loaded, request: Request) -> _Step:
    return _change_parameter(bench, loaded, request, None)


def _change_parameter(bench: Bench, loaded: Loaded, request: Request, value: float | None) -> _Step:
    choice = ParameterChoice(request.effect, request.parameter, value)
    edit = edit_parameter(bench.path, loaded.job, bench.registry, choice)
    _try_fit(bench, loaded, edit)
    return _Step(edit, f"{request.effect}.{request.parameter}")


def _exclude(bench: Bench, loaded: Loaded, request: Request) -> _Step:
    measurements = loaded.measurements
    wrong = [each for each in request.readings if not 0 <= each < len(measurements.deviation)]
    if wrong or not request.readings:
        raise InputError.at(PLACE, f"there is no reading {wrong[0]}" if wrong else "choose a reading first")
    try:
        exclusions = [_make_exclusion(measurements, each, request.reason) for each in request.readings]
    except ValidationError as error:
        raise InputError.at(
            PLACE, "a reading is set aside for a reason: one line that others can read"
        ) from error
    edit = exclude(bench.path, loaded.job, bench.registry, exclusions)
    _try_fit(bench, loaded, edit)
    return _Step(
        edit, _name_reading(exclusions[0]) if len(exclusions) == 1 else f"{len(exclusions)} readings"
    )


def _make_exclusion(measurements: MeasurementSet, reading: int, reason: str) -> ExclusionKeys:
    """Return a reading of a measurement set as a job sets it aside."""
    target = measurements.target_positions[measurements.target[reading]]
    return ExclusionKeys.model_validate(
        {
            "target": round(measurements.axis.position_unit.from_si(float(target)), _DECIMALS),
            "direction": Approach(int(measurements.approach[reading])).sign,
            "run": int(measurements.run[reading]),
            "reason": reason,
        }
    )


def _include(bench: Bench, loaded: Loaded, request: Request) -> _Step:
    listed = loaded.job.keys.measurement.excluded
    if not 0 <= request.listed < len(listed):
        raise InputError.at(PLACE, "this reading is not set aside")
    edit = include(bench.path, loaded.job, bench.registry, request.listed)
    _try_fit(bench, loaded, edit)
    return _Step(edit, _name_reading(listed[request.listed]))


def _state(bench: Bench, loaded: Loaded, request: Request) -> _Step:
    units = _list_asked_for(bench, loaded)
    unasked = [key for key in request.stated if key not in units]
    if unasked or not request.stated:
        raise InputError.at(PLACE, f"the job is not asked for {unasked[0][:60]!r}" if unasked else _NOTHING)
    wrong = [key for key, value in request.stated.items() if not _is_value(value)]
    if wrong:
        raise InputError(
            Problem(PLACE, f"{key}: write a number such as 10, or a line of text") for key in wrong
        )
    edit = edit_keys(bench.path, loaded.job, bench.registry, request.stated, units)
    _try_fit(bench, loaded, edit)
    return _Step(edit, ", ".join(request.stated))


def _list_asked_for(bench: Bench, loaded: Loaded) -> dict[str, str]:
    """Return the keys that the page asks for, each with the symbol of its unit."""
    units = {
        f"axis.{each.key}": each.unit
        for each in list_lengths_asked(
            loaded.study.observed.design, loaded.study.model.identifiers, bench.registry.effects
        )
    }
    if loaded.job.keys.axis.compensation_table is None:
        units[_TABLE] = ""
    for field in list_what_is_lacking(loaded, bench.registry):
        units |= {f"{field.key}.kind": ""} if field.form == "place" else {field.key: field.unit}
        units |= {field.reason: ""} if field.reason else {}
    return units


def _is_value(value: float | str) -> bool:
    return bool(value.strip()) if isinstance(value, str) else math.isfinite(value)


def _put_back(bench: Bench, loaded: Loaded, request: Request) -> _Step:
    """Return the change that puts back what a line of the record replaced."""
    content, subject = find_last_step(bench.path, loaded.digest, request)
    job = load(bench.path, bench.registry, content=content)
    return _Step(Edit(bench.path, loaded.digest, content, job), subject)


def find_last_step(path: Path, digest: str, request: Request) -> tuple[bytes, str]:
    """Return what an undo or a redo puts back into a file, and what the record says that it is about."""
    find = find_undoable if request.action == UNDO else find_redoable
    last = find(BenchJournal.of(path).read_entries(), digest)
    if last is None:
        raise NothingToUndoError
    return last.content, last.subject if last.action in {UNDO, REDO} else f"{last.action} {last.subject}"


def _try_fit(bench: Bench, loaded: Loaded, edit: Edit) -> Fitted:
    """Return the fit of the job as it is to become; refuse one that makes no sense."""
    try:
        return bench.fit_whole(bench.try_job(edit.job))
    except InputError as error:  # its places are those of the job as it would be
        place = loaded.job.place_of(_KEY)
        raise InputError(Problem(place, each.message) for each in error.problems) from error


def _name_reading(exclusion: ExclusionKeys) -> str:
    """Return a reading as the record names it: ``213.4 + 3``."""
    return f"{exclusion.target:.10g} {exclusion.direction} {exclusion.run}"


def _write_rms(fitted: Fitted) -> float:
    return fitted.fit.design.axis.deviation_unit.from_si(fitted.error.rms)


#: What a page can ask for.
ACTIONS: Mapping[str, Callable[[Bench, Loaded, Request], _Step]] = {
    "add": _add,
    "remove": _remove,
    "fix": _fix,
    "free": _free,
    "exclude": _exclude,
    "include": _include,
    "state": _state,
    UNDO: _put_back,
    REDO: _put_back,
}
