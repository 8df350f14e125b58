"""From a job file to a checked job, with its axis and tolerances in SI."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from contextlib import suppress
from dataclasses import dataclass, replace
from pathlib import Path
from types import MappingProxyType
from typing import Any, Generic, TypeVar

from pydantic import BaseModel

from zlmreport.errors import InputError, Place, Problem, did_you_mean, quoted
from zlmreport.files import demand
from zlmreport.job.choices import (
    choose_candidates,
    choose_controller_of,
    choose_effects_of,
    choose_extensions,
    choose_in,
    choose_instrument,
    choose_programs_of,
    group_naming,
)
from zlmreport.job.circle_keys import CircleKeys, find_circle_contradictions, find_circle_plan_contradictions
from zlmreport.job.collection import (
    is_collection,
    list_jobs_named,
    make_document_of,
    make_part_of,
    name_measurements_of,
)
from zlmreport.job.contradictions import find_all_contradictions, validate
from zlmreport.job.evaluation_keys import PriorsKeys, StandardKeys
from zlmreport.job.extends import JOB, PRIORS, Composition, Defaults, FileFormat, compose, refuse_other_format
from zlmreport.job.installed import Installed, InstalledStandard
from zlmreport.job.job import Job, SourceChoice, StandardChoice
from zlmreport.job.keys import JobKeys
from zlmreport.job.measurement_keys import AxisKeys, Measurement
from zlmreport.job.parse import LARGEST
from zlmreport.job.quantity import (
    convert_places_to_si,
    find_effect_contradictions,
    find_measurand_of,
    find_quantity_contradictions,
    find_stated_error,
    find_tests_contradictions,
)
from zlmreport.job.tree import (
    Items,
    KeyEntry,
    Keys,
    Scalar,
    find_at,
    find_key_place,
    make_keys_of,
    merge,
    place_of,
)
from zlmreport.language.formatting import write_plain
from zlmreport.measurement.axis import Axis
from zlmreport.measurement.error_symbol import (
    ErrorSymbol,
    evaluate_for_error,
    find_error_named,
    find_letter_of,
)
from zlmreport.measurement.measurand import POSITIONING, Measurand, is_for
from zlmreport.measurement.position_table import TableColumn, read_position_table
from zlmreport.measurement.provenance import SourceFile
from zlmreport.measurement.units import ANGLE_UNITS, MICRORADIAN, MILLIMETRE

_SOURCE = ("measurement", "source")
_TESTS = ("measurement", "tests")
_SOURCE_AS_FOUND = ("as_found", "measurement", "source")
_EFFECTS = ("model", "effects")
_CANDIDATES = ("model", "candidates")
_PROGRAMS = ("plan", "programs")
_COMPENSATION = ("compensation",)


def load(
    path: Path,
    registry: Installed,
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
    composition = compose(path, content, defaults)
    if is_collection(composition.keys):
        return _collect_jobs(composition, path, registry, formats)
    return _add_sessions(_check_job(composition, path.parent, registry, formats), path, registry)


def _collect_jobs(composition: Composition, path: Path, registry: Installed, formats: tuple[str, ...]) -> Job:
    """Return a job that makes one document of several jobs."""
    document = composition.keys
    named = list_jobs_named(document)
    problems: list[Problem] = []
    parts: list[tuple[Job, Path]] = []
    first: Keys | None = None
    for file, place in named:
        try:
            own = compose(file)
            keys = make_part_of(own.keys, document, place)
            first = first or keys
            part = _check_job(replace(own, keys=keys), file.parent, registry, formats)
            parts.append((_add_sessions(part, file, registry), file))
        except InputError as error:
            problems.extend(error.problems)
    if problems or first is None:
        raise InputError(sorted(set(problems)))
    whole = replace(composition, keys=make_document_of(first, document))
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


def _add_sessions(job: Job, path: Path, registry: Installed) -> Job:
    """Return a job with the further tests that its model names, and what earlier ones taught."""
    sessions, priors = _read_sessions(job, path, registry), _read_priors(job)
    files = [file for each in sessions for file in each.files]
    if priors:
        files.append(priors.file)
    return replace(job, sessions=sessions, priors=priors.keys if priors else None, files=(*job.files, *files))


def _check_job(
    composition: Composition, folder: Path, registry: Installed, formats: tuple[str, ...] = ()
) -> Job:
    """Return the job in a folder that files make together, without the further tests that its model names."""
    tree = _add_axis(_share_keys(_add_shared_source(composition.keys), registry), registry)
    refuse_other_format(
        tree, JOB, lambda: [each for offered in registry.extensions for each in offered.formats]
    )
    problems: list[Problem] = []
    own = tree.without(*registry.extension_keys)
    keys = validate(JobKeys, own, problems, also_known=registry.extension_keys)
    source = _choose_source(tree, _SOURCE, registry, problems)
    source_as_found = _choose_source(tree, _SOURCE_AS_FOUND, registry, problems)
    error = _find_stated_in(tree)
    standards = list(choose_standards(tree, registry, problems, error))
    effects = choose_effects_of(find_at(tree, _EFFECTS), registry, problems, within=".".join(_EFFECTS))
    candidates = choose_candidates(
        find_at(tree, _CANDIDATES), registry, problems, within=".".join(_CANDIDATES)
    )
    programs = choose_programs_of(
        find_at(tree, _PROGRAMS), registry.part_program, problems, within=".".join(_PROGRAMS)
    )
    extensions = tuple(choose_extensions(tree, registry, problems))
    controller = choose_controller_of(find_at(tree, _COMPENSATION), registry, problems)
    tests = _test_sources(keys, tree, registry, problems) if keys else {}
    measurand = find_measurand_of(keys, tree, registry, problems) if keys else POSITIONING
    formats = formats or _choose_formats(tree, keys, registry, problems)
    if keys:
        found = [
            each
            for choice in extensions
            for each in registry.extension(choice.identifier).contradictions(keys, choice.options)
        ]
        found += [
            *find_quantity_contradictions(keys, measurand),
            *find_tests_contradictions(keys, measurand),
            *find_circle_contradictions(keys, measurand, has_axis="axis" in composition.keys.entries),
            *find_circle_plan_contradictions(keys),
            *find_effect_contradictions(effects, measurand, registry),
        ]
        problems.extend(find_all_contradictions(keys, tree, found))
    if source is None and tests:
        source = next(iter(tests.values()))
    if problems or keys is None or source is None:
        raise InputError(sorted(_drop_said_twice(problems)))
    for choice in extensions:
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
        effects=effects,
        candidates=candidates,
        programs=programs,
        extensions=extensions,
        controller=controller,
        formats=formats,
        directory=keys.output.directory or folder,
        files=(*composition.files, *axis.files, *_list_files_named(standards)),
        tree=tree,
    )
    if not tests:
        return job
    parts = {name: _make_job_of_test(job, name, chosen, registry) for name, chosen in tests.items()}
    files = [file for each in parts.values() for file in each.axis.files]
    return replace(job, tests=parts, files=(*job.files, *files))


def _find_stated_in(tree: Keys) -> str:
    """Return what a job says was measured, by its symbol or its name; empty where it does not."""
    stated = find_at(tree, ("measurement", "error"))
    return stated.text.strip() if isinstance(stated, Scalar) else ""


def _find_error_in(tree: Keys) -> ErrorSymbol | None:
    """Return the error that a job names; None where it names none, or one that there is not."""
    with suppress(ValueError):
        return find_error_named(_find_stated_in(tree))
    return None


def _drop_said_twice(problems: Iterable[Problem]) -> set[Problem]:
    """Return problems without those of a standard with a key of the job that the job was told already."""
    found = set(problems)
    return {
        each
        for each in found
        if replace(each, message=each.message.removeprefix("evaluate.")) == each
        or replace(each, message=each.message.removeprefix("evaluate.")) not in found
    }


def _add_axis(tree: Keys, registry: Installed) -> Keys:
    """Return the keys of a job with its axis, where a circle, an extension or an error's symbol has it."""
    if "axis" in tree.entries:
        return tree
    error = _find_error_in(tree)
    name = next((key for key in registry.axis_keys if key in tree.entries), "")
    place = tree.entries[name].place if name else place_of(tree, ("measurement",))
    if "circle" in tree.entries:
        plane = find_at(tree, ("circle", "plane"))
        place = tree.entries["circle"].place
        name = plane.text if isinstance(plane, Scalar) else str(CircleKeys.model_fields["plane"].default)
    if not name and error:
        name = error.axis
    if not name and isinstance(listed := find_at(tree, ("measurement", "tests")), Keys):
        name = _name_together(listed.entries)
    if not name:
        return tree
    axis = make_keys_of(place, (KeyEntry("name", place, Scalar(place, name, plain=False)),))
    return merge(tree, make_keys_of(tree.place, (KeyEntry("axis", place, axis),)))


def _share_keys(tree: Keys, registry: Installed) -> Keys:
    """Return the keys of a job with what standards ask of the measurement among their own keys.

    Such a key stands in `measurement`, or at the top of the job; each standard that asks for it gets it. One
    that is the job's own, as `circle`, stays there too.
    """
    evaluate, measurement = find_at(tree, ("evaluate",)), find_at(tree, ("measurement",))
    if not isinstance(evaluate, Items):
        return tree
    taken: set[str] = set()
    items = []
    for item in evaluate.items:
        group = group_naming("standard", item)
        shared = []
        named = group.entries.get("standard")
        if named and isinstance(named.value, Scalar):
            with suppress(InputError):  # a standard that there is not is refused later
                options = registry.standard(named.value.text, named.value.place).options
                shared = [key for key in options.of_the_measurement if key not in registry.extension_keys]
        entries = dict(group.entries)
        for key in shared:
            for place in (measurement, tree):
                if isinstance(place, Keys) and key in place.entries:
                    entries.setdefault(key, place.entries[key])
                    taken.add(key)
        items.append(
            make_keys_of(group.place, tuple(entries.values())) if len(entries) > len(group.entries) else item
        )
    if not taken:
        return tree
    taken -= JobKeys.model_fields.keys()
    entries = dict(tree.without(*taken).entries)
    entries["evaluate"] = replace(tree.entries["evaluate"], value=Items(evaluate.place, tuple(items)))
    if isinstance(measurement, Keys):
        entries["measurement"] = replace(entries["measurement"], value=measurement.without(*taken))
    return make_keys_of(tree.place, tuple(entries.values()))


def _add_shared_source(tree: Keys) -> Keys:
    """Return the keys of a job with the source of its measurement in each test that has none of its own."""
    measurement, tests = find_at(tree, ("measurement",)), find_at(tree, _TESTS)
    if (
        not isinstance(measurement, Keys)
        or not isinstance(tests, Keys)
        or "source" not in measurement.entries
    ):
        return tree
    source = measurement.entries["source"]
    shared = {
        name: entry
        for name, entry in tests.entries.items()
        if isinstance(entry.value, Keys) and "source" not in entry.value.entries
    }
    if not shared:
        return tree
    filled = {
        name: replace(entry, value=make_keys_of(entry.value.place, (*entry.value.entries.values(), source)))
        for name, entry in shared.items()
        if isinstance(entry.value, Keys)
    }
    of_tests = make_keys_of(tests.place, tuple({**tests.entries, **filled}.values()))
    entries = dict(measurement.without("source").entries)
    entries["tests"] = replace(entries["tests"], value=of_tests)
    whole = replace(
        tree.entries["measurement"], value=make_keys_of(measurement.place, tuple(entries.values()))
    )
    return make_keys_of(tree.place, tuple({**tree.entries, "measurement": whole}.values()))


def _test_sources(
    keys: JobKeys, tree: Keys, registry: Installed, problems: list[Problem]
) -> dict[str, SourceChoice]:
    """Return the data source of each named test; one that several share is checked once."""
    found = {}
    checked: dict[Place, SourceChoice | None] = {}
    for name in keys.measurement.tests:
        path = ("measurement", "tests", name, "source")
        place = find_key_place(tree, path)
        if place not in checked:
            checked[place] = _choose_source(tree, path, registry, problems)
        source = checked[place]
        if source:
            found[name] = source
    return found


def _make_job_of_test(job: Job, name: str, source: SourceChoice, registry: Installed) -> Job:
    """Return one of several measured lines as a job of its own: what is not said of it is as in the job."""
    whole, own = job.keys.measurement, job.keys.measurement.tests[name]
    inherited = {
        key: getattr(whole, key)
        for key in whole.model_fields_set & type(own).model_fields.keys()
        if key not in own.model_fields_set and key not in {"error", "source"}
    }
    stated = {key: getattr(own, key) for key in own.model_fields_set & Measurement.model_fields.keys()}
    measurement = Measurement.model_validate({}).model_copy(update={**inherited, **stated})
    update: dict[str, Any] = {"measurement": measurement}
    for key in ("instrument", "environment", "uncertainty"):
        if getattr(own, key) is not None:
            update[key] = getattr(own, key)
    axis_keys = own.axis
    of_lines = job.axis.measurand.of_lines
    is_usual = of_lines is not None and own.error in {None, of_lines.identifier}
    error = find_error_named(own.error) if own.error and not is_usual else None
    if axis_keys is None:
        axis_keys = _find_axis_of_test(job, name, error)
    update["axis"] = axis_keys
    quantity = error.measurand if error else of_lines
    return replace(
        job,
        keys=job.keys.model_copy(update=update),
        axis=convert_axis_to_si(axis_keys, quantity, error, measurement.at),
        source=source,
        source_as_found=None,
        standards=tuple(
            replace(each, tolerances={})
            for each in job.standards
            if is_for(registry.standard(each.identifier), quantity or POSITIONING)
        ),
        effects=(),
        candidates=(),
        files=(),
        tests={},
    )


def _find_axis_of_test(job: Job, name: str, error: ErrorSymbol | None) -> AxisKeys:
    """Return the axis of a measured line that states none: that of its error, or one of the test's name."""
    stated = job.keys.axis
    if error is None:
        return AxisKeys(name=name) if stated.name == _name_together(job.keys.measurement.tests) else stated
    return stated if find_letter_of(stated.name) == error.axis else AxisKeys(name=error.axis)


def _name_together(tests: Iterable[str]) -> str:
    """Return the name of what several measured lines are of, where no axis is stated."""
    return " ".join(tests)


def _list_files_named(standards: Iterable[StandardChoice]) -> Iterator[SourceFile]:
    """Yield the files that keys of standards name; a certificate carries them as it does its readings."""
    for choice in standards:
        for path in _list_paths_in(choice.options):
            yield SourceFile.of(path, demand(path, LARGEST, choice.place))


def _list_paths_in(value: Any) -> Iterator[Path]:
    """Yield every path among the values of keys."""
    if isinstance(value, Path):
        yield value
    elif isinstance(value, BaseModel):
        for name in type(value).model_fields:
            yield from _list_paths_in(getattr(value, name))
    elif isinstance(value, Mapping):
        for each in value.values():
            yield from _list_paths_in(each)
    elif isinstance(value, list | tuple):
        for each in value:
            yield from _list_paths_in(each)


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
    return found


def _read_sessions(job: Job, path: Path, registry: Installed) -> tuple[Job, ...]:
    """Return the jobs of further tests of an axis; the sessions that these name are not theirs to add.

    Raises `InputError` if one is the job itself, stands there twice, or is of another axis.
    """
    keys, found = job.keys, list[Job]()
    named = [path.resolve()]
    for number, stated in enumerate(keys.model.sessions if keys.model else ()):
        place = job.place_of(f"model.sessions.{number}")
        if stated.resolve() in named:
            raise InputError.at(place, "this test is in the model already; name each further test once")
        named.append(stated.resolve())
        other = _check_job(compose(stated), stated.parent, registry)
        axis, machine = other.keys.axis, other.keys.machine
        same = (axis.name, axis.kind) == (keys.axis.name, keys.axis.kind)
        serials = {each for each in (machine.serial, keys.machine.serial) if each}
        if not same or len(serials) > 1:
            of = f"axis {axis.name} ({axis.kind}) of {machine.serial or 'a machine without a serial number'}"
            raise InputError.at(
                place, f"it is a test of {of}; sessions of a model are tests of one axis of one machine"
            )
        found.append(other)
    return tuple(found)


def _choose_source(
    tree: Keys, path: tuple[str, ...], registry: Installed, problems: list[Problem]
) -> SourceChoice | None:
    """Return the data source at a path, with its own keys; None where there is none, or a wrong one."""
    keys, within = find_at(tree, path), ".".join(path)
    plugin = find_at(tree, (*path, "plugin"))
    choice = choose_in(keys, "plugin", registry.source, problems, within=within)
    instrument = None
    with suppress(InputError):  # a source that there is not was refused above
        if isinstance(keys, Keys) and isinstance(plugin, Scalar):
            known = registry.source(plugin.text).options
            instrument = choose_instrument(known, keys, registry, problems, within=within)
    return SourceChoice(choice.identifier, choice.options, choice.place, instrument) if choice else None


#: Keys of `evaluate` that every standard has.
_OF_EVERY_STANDARD = tuple(StandardKeys.model_fields)


def choose_standards(
    tree: Keys, registry: Installed, problems: list[Problem], error: str = ""
) -> Iterator[StandardChoice]:
    """Yield the standards that a job's `evaluate` lists, with their own keys and no tolerances yet.

    `error`: What the job says was measured: some parameters bear its symbol.

    Mistakes are added to the problems: tolerances for what is no parameter among them.
    """
    evaluate = find_at(tree, ("evaluate",))
    first_named: dict[str, Place] = {}
    for item in evaluate.items if isinstance(evaluate, Items) else ():
        keys = group_naming("standard", item)
        named = keys.entries.get("standard")
        if named is None or not isinstance(named.value, Scalar) or named.value.is_nothing:
            continue
        identifier, place = named.value.text, named.value.place
        try:
            standard = evaluate_for_error(registry.standard(identifier, place), error)
        except InputError as unknown:
            problems.extend(unknown.problems)
            continue
        if standard.identifier in first_named:
            first = first_named[standard.identifier].line
            problems.append(
                Problem(place, f"{standard.identifier} stands in line {first} already; remove one of them")
            )
        first_named.setdefault(standard.identifier, place)
        problems.extend(_find_unknown_tolerances(keys, standard))
        own = replace(keys.without(*_OF_EVERY_STANDARD), place=place)
        options = validate(standard.options, own, problems, within="evaluate", also_known=_OF_EVERY_STANDARD)
        if options:
            adoption = "" if identifier == standard.identifier else identifier
            yield StandardChoice(standard.identifier, options, place, {}, adoption=adoption)


def _find_unknown_tolerances(keys: Keys, standard: InstalledStandard) -> Iterator[Problem]:
    """Yield tolerances for what is no parameter of the standard, or cannot have one."""
    tolerances = find_at(keys, ("tolerances",))
    limitable = [quantity.symbol for quantity in standard.quantities if quantity.can_be_limited]
    symbols = {quantity.symbol for quantity in standard.quantities}
    printed = {
        write_plain(each.notation): each.symbol for each in standard.quantities if each.symbol in limitable
    }
    before = ""
    for symbol, entry in tolerances.entries.items() if isinstance(tolerances, Keys) else ():
        spelt = symbol.replace("↑", "_fwd").replace("↓", "_bwd")
        if symbol.isdecimal():
            yield Problem(entry.place, f"a comma parts keys; write a decimal point: {before}.{symbol}")
            continue
        before = f"{symbol}: {entry.value.text}" if isinstance(entry.value, Scalar) else symbol
        written = printed.get(symbol, spelt)
        if written != symbol and written in limitable:
            yield Problem(entry.place, f"{quoted(symbol)} is written {written} in a job")
            continue
        if symbol not in symbols:
            message = f"{quoted(symbol)} is no parameter of {standard.identifier}; "
        elif symbol not in limitable:
            message = f"{symbol} of {standard.identifier} takes no tolerance; "
        else:
            continue
        yield Problem(entry.place, message + did_you_mean(symbol, limitable))


def _choose_formats(
    tree: Keys, keys: JobKeys | None, registry: Installed, problems: list[Problem]
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


def choose_formats_once(named: Iterable[tuple[str, Place]], registry: Installed) -> tuple[str, ...]:
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


def convert_axis_to_si(
    keys: AxisKeys,
    measurand: Measurand | None = None,
    error: ErrorSymbol | None = None,
    at: Mapping[str, Any] = MappingProxyType({}),
    circle: CircleKeys | None = None,
) -> Axis:
    """Return the axis with its lengths in metres, or its angles in radians, and with its tables.

    `measurand`: What was measured of it; None for its positioning.
    `error`: The symbol of that, where the job states it.
    `at`: Where the other axes stood, mm or degrees.
    `circle`: That two axes ran together; None for a single axis.

    Raises `AccessError` if the file of a table cannot be read; `InputError` if it is not such a table.
    """
    bare = Axis(keys.name, keys.kind)
    to_si = bare.position_unit.to_si
    position = TableColumn("position", bare.position_unit, bare.position_units)
    deviation = TableColumn("deviation", bare.deviation_unit, bare.deviation_units)
    angle = TableColumn("angle", MICRORADIAN, ANGLE_UNITS)
    return Axis(
        name=keys.name,
        kind=keys.kind,
        travel=(to_si(keys.travel[0]), to_si(keys.travel[1])) if keys.travel else None,
        screw_pitch=to_si(keys.screw_pitch) if keys.screw_pitch else None,
        signal_period=to_si(keys.signal_period) if keys.signal_period else None,
        scale_element=to_si(keys.scale_element) if keys.scale_element else None,
        pole_pitch=to_si(keys.pole_pitch) if keys.pole_pitch else None,
        compensation_table=(
            read_position_table(keys.compensation_table, position, deviation, ("forward", "reverse"))
            if isinstance(keys.compensation_table, Path)
            else None
        ),
        angular_errors=(
            read_position_table(keys.angular_errors, position, angle) if keys.angular_errors else None
        ),
        abbe_offset=None if keys.abbe_offset is None else MILLIMETRE.to_si(keys.abbe_offset),
        quantity=measurand,
        error=error.symbol if error else "",
        at=convert_places_to_si(at),
        circle=circle.in_si() if circle else None,
    )


def convert_tolerances_to_si(
    tolerances: Mapping[str, float], standard: InstalledStandard, axis: Axis
) -> dict[str, float]:
    """Return tolerances, given in the unit of what was measured or in a parameter's own, in SI."""
    own = {each.symbol: each.unit for each in standard.quantities if each.unit is not None}
    return {symbol: own.get(symbol, axis.deviation_unit).to_si(limit) for symbol, limit in tolerances.items()}


Model = TypeVar("Model", bound=BaseModel)


@dataclass(frozen=True, slots=True)
class KeysFile(Generic[Model]):
    """A checked file of keys.

    Attributes
    ----------
    keys
        What it says, in users' units.
    file
        Its name, digest and bytes.
    tree
        What it says, value by value, with the places.
    extended
        The files that it extends.
    """

    keys: Model
    file: SourceFile
    tree: Keys
    extended: tuple[SourceFile, ...] = ()

    def place_of(self, *steps: str | int) -> Place:
        """Return where a key stands; of one that is missing, its nearest parent's place."""
        return place_of(self.tree, steps)


def read_keys_file(path: Path, model: type[Model], file_format: FileFormat) -> KeysFile[Model]:
    """Read a file of keys; it may extend others, as a job does.

    Raises
    ------
    InputError
        With every mistake, in the order of their places; with one for a file of another format.
    AccessError
        If it cannot be read.
    """
    composition = compose(path)
    refuse_other_format(composition.keys, file_format)
    problems: list[Problem] = []
    keys = validate(model, composition.keys, problems)
    if problems or keys is None:
        raise InputError(sorted(set(problems)))
    first, *others = composition.files
    return KeysFile(keys, first, composition.keys, tuple(others))
