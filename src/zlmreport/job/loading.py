"""Loads a job file, also of several jobs: reads, checks, chooses plugins, converts axis and limits to SI."""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING

from zlmreport.errors import InputError, Place, Problem, quoted
from zlmreport.job.axis import convert_axis_to_si
from zlmreport.job.choices import (
    Choice,
    ControllerChoice,
    ExtensionChoice,
    choose_controller_of,
    choose_extensions,
    choose_programs_of,
    choose_source,
    choose_sources_of_tests,
)
from zlmreport.job.circle_keys import find_circle_contradictions, find_lack_of_circle
from zlmreport.job.contradictions import find_all_contradictions, validate
from zlmreport.job.evaluation_keys import PriorsKeys
from zlmreport.job.extends import JOB, PRIORS, Composition, Defaults, read_composition, refuse_other_format
from zlmreport.job.implied_keys import (
    add_axis,
    add_shared_source,
    find_stated_in,
    make_job_of_test,
    share_keys,
)
from zlmreport.job.job import Job
from zlmreport.job.keys import JobKeys
from zlmreport.job.keys_file import KeysFile, read_keys_file
from zlmreport.job.measurement_keys import is_same_serial
from zlmreport.job.quantity import (
    find_effect_contradictions,
    find_measurand_of,
    find_quantity_contradictions,
    find_stated_error,
    find_tests_contradictions,
)
from zlmreport.job.standards import choose_standards, convert_tolerances_to_si, list_files_named
from zlmreport.job.tree import Items, KeyEntry, Keys, Node, Scalar, find_at, make_keys_of, merge, place_of
from zlmreport.job.types import resolve_path_named
from zlmreport.measurement.axis import Axis, AxisKind
from zlmreport.measurement.error_symbol import evaluate_for_error
from zlmreport.measurement.measurand import POSITIONING

if TYPE_CHECKING:
    from zlmreport.job.effect_choices import EffectChoice
    from zlmreport.plugin.registry import Registry

_SOURCE = ("measurement", "source")
_SOURCE_AS_FOUND = ("as_found", "measurement", "source")
_EFFECTS = ("model", "effects")
_CANDIDATES = ("model", "candidates")
_PROGRAMS = ("plan", "programs")


@dataclass(frozen=True)
class _Chosen:
    """The plugins that groups of keys name which a job may lack."""

    effects: tuple[EffectChoice, ...] = ()
    candidates: tuple[EffectChoice, ...] = ()
    programs: tuple[Choice, ...] = ()
    extensions: tuple[ExtensionChoice, ...] = ()
    controller: ControllerChoice | None = None


def load(
    path: Path,
    registry: Registry,
    formats: tuple[str, ...] = (),
    content: bytes | None = None,
    defaults: Defaults | None = None,
) -> Job:
    """Read a job file and check all that can be checked without reading measurements.

    `content`: What the job file is to hold, instead of what it holds: to see what a change would come to.
    `defaults`: Keys that it builds on as if it extended a file of them.

    Raises `InputError` with every mistake, in the order of their places; `AccessError` if the job, or a file
    that it extends, cannot be read.
    """
    composition = read_composition(path, content, defaults)
    if MEASUREMENTS in composition.keys.entries:
        return _collect_jobs(composition, path, registry, formats)
    return _add_sessions(_check_job(composition, path.parent, registry, formats), path, registry)


def _collect_jobs(composition: Composition, path: Path, registry: Registry, formats: tuple[str, ...]) -> Job:
    """Return a job that makes one document of several jobs."""
    document = composition.keys
    named = list_jobs_named(document)
    problems: list[Problem] = []
    parts: list[tuple[Job, Path]] = []
    first: Keys | None = None
    for file, place in named:
        try:
            own = read_composition(file)
            keys = make_part_of(own.keys, document, place)
            first = first or keys
            part = _check_job(replace(own, keys=keys), file.parent, registry, formats)
            parts.append((_add_sessions(part, file, registry), file))
        except InputError as error:
            problems.extend(error.problems)
    if problems or first is None:
        raise InputError(sorted(set(problems)))
    # What a job must have, the document has of its first.
    whole = replace(composition, keys=merge(first, document.without("extends")))
    job = _check_job(whole, path.parent, registry, formats)
    names = name_measurements_of((part.axis, file) for part, file in parts)
    files = dict.fromkeys((*composition.files, *(each for part, _ in parts for each in part.files)))
    of_each = {
        name: replace(part, formats=job.formats, directory=job.directory)
        for name, (part, _) in zip(names, parts, strict=True)
    }
    of_document = {"as_found": None, "model": None, "corrections": None}
    return replace(
        job,
        keys=job.keys.model_copy(update=of_document),
        files=tuple(files),
        tree=document,
        measurements=of_each,
        effects=(),
        candidates=(),
        extensions=(),
        source_as_found=None,
        tests={},
    )


def _add_sessions(job: Job, path: Path, registry: Registry) -> Job:
    """Return a job with the further tests that its model names, and what earlier ones taught."""
    if job.keys.model is None:
        return job
    sessions, priors = _read_sessions(job, path, registry), _read_priors(job)
    files = [file for each in sessions for file in each.files]
    if priors:
        files.append(priors.file)
    return replace(job, sessions=sessions, priors=priors.keys if priors else None, files=(*job.files, *files))


def _check_job(
    composition: Composition, folder: Path, registry: Registry, formats: tuple[str, ...] = ()
) -> Job:
    """Return the job in a folder that files make together, without the further tests that its model names."""
    tree = share_keys(add_shared_source(composition.keys), registry)
    if "axis" not in tree.entries:
        tree = add_axis(tree, registry)
    refuse_other_format(
        tree, JOB, lambda: [each for offered in registry.extensions for each in offered.formats]
    )
    problems: list[Problem] = []
    own = tree.without(*registry.extension_keys)
    keys = validate(JobKeys, own, problems, also_known=registry.extension_keys)
    source = choose_source(tree, _SOURCE, registry, problems)
    source_as_found = choose_source(tree, _SOURCE_AS_FOUND, registry, problems)
    error = find_stated_in(tree)
    standards = list(choose_standards(tree, registry, problems, error))
    chosen = _choose_where_stated(tree, registry, problems)
    has_tests = keys is not None and keys.measurement.tests
    tests = choose_sources_of_tests(keys, tree, registry, problems) if keys and has_tests else {}
    measurand = find_measurand_of(keys, tree, registry, problems) if keys else POSITIONING
    formats = formats or _choose_formats(tree, keys, registry, problems)
    if keys:
        found = [
            each
            for choice in chosen.extensions
            for each in registry.extension(choice.identifier).contradictions(keys, choice.options)
        ]
        if not measurand.is_position:
            found += find_quantity_contradictions(keys, measurand)
        found += [
            *find_tests_contradictions(keys, measurand),
            *(
                find_circle_contradictions(keys, keys.circle, has_axis="axis" in composition.keys.entries)
                if keys.circle
                else find_lack_of_circle(keys, measurand)
            ),
        ]
        if chosen.effects:
            found += find_effect_contradictions(chosen.effects, measurand, registry)
        problems.extend(find_all_contradictions(keys, tree, found))
    if source is None and tests:
        source = next(iter(tests.values()))
    if problems or keys is None or source is None:
        raise InputError(sorted(_drop_said_twice(problems)))
    for choice in chosen.extensions:
        keys = registry.extension(choice.identifier).completed(keys, choice.options)
    axis = convert_axis_to_si(keys.axis, measurand, find_stated_error(keys), keys.measurement.at, keys.circle)
    job = Job(
        keys=keys,
        axis=axis,
        source=source,
        source_as_found=source_as_found,
        standards=tuple(
            replace(
                choice,
                tolerances=convert_tolerances_to_si(
                    each.tolerances, evaluate_for_error(registry.standard(each.standard), error), axis
                ),
                specification=each.specification or "",
            )
            for choice, each in zip(standards, keys.evaluate, strict=True)
        ),
        **vars(chosen),
        formats=formats,
        directory=keys.output.directory or folder,
        files=(*composition.files, *axis.files, *list_files_named(standards)),
        tree=tree,
    )
    if not tests:
        return job
    parts = {name: make_job_of_test(job, name, chosen, registry) for name, chosen in tests.items()}
    files = [file for each in parts.values() for file in each.axis.files]
    return replace(job, tests=parts, files=(*job.files, *files))


def _choose_where_stated(tree: Keys, registry: Registry, problems: list[Problem]) -> _Chosen:
    """Return the plugins that a job's model, plan, compensation and extensions name, where it has these."""
    chosen = _Chosen(extensions=tuple(choose_extensions(tree, registry, problems)))
    if "model" in tree.entries:
        from zlmreport.job.effect_choices import choose_candidates, choose_effects_of  # noqa: PLC0415 - brings formulas

        stated, within = find_at(tree, _EFFECTS), ".".join(_EFFECTS)
        tried, among = find_at(tree, _CANDIDATES), ".".join(_CANDIDATES)
        chosen = replace(
            chosen,
            effects=choose_effects_of(stated, registry, problems, within=within),
            candidates=choose_candidates(tried, registry, problems, within=among),
        )
    if "plan" in tree.entries:
        listed, within = find_at(tree, _PROGRAMS), ".".join(_PROGRAMS)
        programs = choose_programs_of(listed, registry.part_program, problems, within=within)
        chosen = replace(chosen, programs=programs)
    if compensation := tree.entries.get("compensation"):
        controller = choose_controller_of(compensation.value, registry, problems)
        chosen = replace(chosen, controller=controller)
    return chosen


def _drop_said_twice(problems: Iterable[Problem]) -> set[Problem]:
    """Return problems without those of a standard with a key of the job that the job was told already."""
    found = set(problems)
    return {
        each
        for each in found
        if replace(each, message=each.message.removeprefix("evaluate.")) == each
        or replace(each, message=each.message.removeprefix("evaluate.")) not in found
    }


def _read_priors(job: Job) -> KeysFile[PriorsKeys] | None:
    """Return what earlier tests say, if the job names a file of it."""
    stated = job.keys.model.priors if job.keys.model else None
    if stated is None:
        return None
    found = read_keys_file(stated, PriorsKeys, PRIORS)
    if found.keys.kind != job.axis.kind:
        raise InputError.at(
            job.place_of("model.priors"),
            f"it was learned from {found.keys.kind} axes, and this one is {job.axis.kind}",
        )
    if found.keys.measurand != job.axis.measurand.identifier:
        raise InputError.at(
            job.place_of("model.priors"),
            f"it was learned from tests of {found.keys.measurand}, and this one is of "
            f"{job.axis.measurand.identifier}",
        )
    return found


def _read_sessions(job: Job, path: Path, registry: Registry) -> tuple[Job, ...]:
    """Return the jobs of further tests of an axis; the sessions that these name are not theirs to add.

    Raises `InputError` if one is the job itself, stands there twice, or is of another axis or error.
    """
    keys, found = job.keys, list[Job]()
    named = [path.resolve()]
    for number, stated in enumerate(keys.model.sessions if keys.model else ()):
        place = job.place_of(f"model.sessions.{number}")
        if stated.resolve() in named:
            raise InputError.at(place, "this test is in the model already; name each further test once")
        named.append(stated.resolve())
        other = _check_job(read_composition(stated), stated.parent, registry)
        same = _list_measured(other.axis) == _list_measured(job.axis)
        if not same or other.keys.machine.is_other_than(keys.machine):
            name, kind, what = _list_measured(other.axis)
            serial = other.keys.machine.serial or "a machine without a serial number"
            of = f"axis {name} ({kind}) of {serial}, on {what}"
            said = "sessions of a model are tests of one error of one axis of one machine"
            raise InputError.at(place, f"it is a test of {of}; {said}")
        found.append(other)
    return tuple(found)


def _list_measured(axis: Axis) -> tuple[str, AxisKind, str]:
    """Return what tests must share to be held against one model: axis, kind and error."""
    return axis.name, axis.kind, axis.symbol or axis.measurand.identifier


def _choose_formats(
    tree: Keys, keys: JobKeys | None, registry: Registry, problems: list[Problem]
) -> tuple[str, ...]:
    """Return the output formats; without a list of them, the usual ones."""
    stated = find_at(tree, ("output", "formats"))
    if isinstance(stated, Items):
        named = [(item.text, item.place) for item in stated.items if isinstance(item, Scalar)]
    else:
        place = place_of(tree, ("output", "formats"))
        named = [(identifier, place) for identifier in (keys.output.formats if keys else ())]
    try:
        return choose_formats_once(named, registry)
    except InputError as error:
        problems.extend(error.problems)
        return ()


def choose_formats_once(named: Iterable[tuple[str, Place]], registry: Registry) -> tuple[str, ...]:
    """Return the identifiers of output formats, each once.

    Raises `InputError` for each that no plugin provides.
    """
    problems: list[Problem] = []
    found: dict[str, None] = {}
    for identifier, place in named:
        try:
            found[registry.renderer(identifier, place).identifier] = None
        except InputError as error:
            problems.extend(error.problems)
    if problems:
        raise InputError(problems)
    return tuple(found)


MEASUREMENTS = "measurements"
#: Jobs that one document has at most.
MOST = 60
#: Keys of the document that its jobs have too, in the place of their own.
_SHARED = (
    *("schema", "laboratory", "customer", "machine", "location", "procedure"),
    *("dates", "agreement", "decision_rule"),
)
_OF_CERTIFICATE = (
    *("number", "kind", "language", "issued"),
    *("layout", "paper", "readings_on_graphs", "authorised_by", "style"),
)
#: Keys of one measurement, which a document of several has none of.
_OF_ONE = (
    *("axis", "circle", "measurement", "as_found", "instrument", "environment", "corrections", "evaluate"),
    *("uncertainty", "model", "plan", "capture", "compensation"),
)
_NOT_IN_NAMES = re.compile(r"[^A-Za-z0-9_-]+")


def list_jobs_named(tree: Keys) -> tuple[tuple[Path, Place], ...]:
    """Return the files of the jobs that a document is made of, with the places that name them.

    Raises `InputError` with each that is none, stands there twice, or is a key of one measurement.
    """
    entry = tree.entries[MEASUREMENTS]
    problems = [
        Problem(
            tree.entries[key].place,
            f"{key} belongs to one measurement: a document of several has it in each of their jobs",
        )
        for key in _OF_ONE
        if key in tree.entries
    ]
    items = entry.value.items if isinstance(entry.value, Items) else ()
    if not 1 <= len(items) <= MOST:
        said = f"{MEASUREMENTS}: a list of 1 to {MOST} jobs is expected: [x.yaml, circle.yaml]"
        problems.append(Problem(entry.place, said))
    found: dict[Path, Place] = {}
    for item in items:
        try:
            path = _take_path(item)
        except ValueError as error:
            problems.append(Problem(item.place, f"{MEASUREMENTS}: {error}"))
            continue
        if path.resolve() in {each.resolve() for each in found}:
            problems.append(Problem(item.place, f"{MEASUREMENTS}: this job stands there already"))
        found.setdefault(path, item.place)
    if problems:
        raise InputError(problems)
    return tuple(found.items())


def _take_path(item: Node) -> Path:
    if not isinstance(item, Scalar) or not item.text:
        raise ValueError("the name of a job file is expected")
    return resolve_path_named(item.text, Path(item.place.file))


def make_part_of(own: Keys, document: Keys, named_at: Place) -> Keys:
    """Return the keys of one job of a document: its own, but for what the document says for all.

    Raises `InputError` if it is such a document itself, or on another machine.
    """
    if MEASUREMENTS in own.entries:
        raise InputError.at(named_at, "this job is a document of several itself; name its jobs here")
    serials = [
        node.text
        for each in (own, document)
        if isinstance(node := find_at(each, ("machine", "serial")), Scalar) and not node.is_nothing
    ]
    if len(serials) > 1 and not is_same_serial(*serials):
        raise InputError.at(
            named_at,
            f"this job is on machine {quoted(serials[0])}, and the document on {quoted(serials[1])}: it is "
            "made of measurements of one machine",
        )
    none = KeyEntry("certificate", document.place, make_keys_of(document.place))
    certificate = document.entries.get("certificate", none)
    shared = [document.entries[key] for key in _SHARED if key in document.entries]
    group = certificate.value
    if isinstance(group, Keys):
        of_all = group.entries
        group = make_keys_of(group.place, tuple(of_all[key] for key in _OF_CERTIFICATE if key in of_all))
    shared.append(KeyEntry("certificate", certificate.place, group))
    return merge(own.without("certificate"), make_keys_of(own.place, tuple(shared)))


def name_measurements_of(axes: Iterable[tuple[Axis, Path]]) -> tuple[str, ...]:
    """Return what the measurements of a document are called: by their errors' symbols, or their files."""
    found: list[str] = []
    for axis, path in axes:
        name = axis.symbol or _NOT_IN_NAMES.sub("-", path.stem).strip("-") or "measurement"
        count, unique = 1, name
        while unique in found:
            count += 1
            unique = f"{name}-{count}"
        found.append(unique)
    return tuple(found)
