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
from zlmreport.files import demanded
from zlmreport.job.choices import (
    candidate_choices,
    choice_in,
    controller_choice,
    effect_choices,
    extension_choices,
    group_naming,
    instrument_choice,
    program_choices,
)
from zlmreport.job.circle_keys import CircleKeys, circle_contradictions, circle_plan_contradictions
from zlmreport.job.collection import document_of, is_collection, jobs_named, names_of, part_of
from zlmreport.job.contradictions import contradictions, validate
from zlmreport.job.evaluation_keys import PriorsKeys, StandardKeys
from zlmreport.job.extends import JOB, PRIORS, Composition, Defaults, FileFormat, compose, refuse_other_format
from zlmreport.job.installed import Installed, InstalledStandard
from zlmreport.job.job import Job, SourceChoice, StandardChoice
from zlmreport.job.keys import JobKeys
from zlmreport.job.measurement_keys import AxisKeys, Measurement
from zlmreport.job.parse import LARGEST
from zlmreport.job.quantity import (
    effect_contradictions,
    measurand_of,
    places_in_si,
    quantity_contradictions,
    stated_error,
    tests_contradictions,
)
from zlmreport.job.tree import Items, KeyEntry, Keys, Scalar, found_at, keys_of, merged, place_of
from zlmreport.language.formatting import plain
from zlmreport.measurement.axis import Axis
from zlmreport.measurement.error_symbol import ErrorSymbol, error_named, for_error, letter_of
from zlmreport.measurement.measurand import POSITIONING, Measurand, is_for
from zlmreport.measurement.position_table import TableColumn, read_position_table
from zlmreport.measurement.provenance import SourceFile
from zlmreport.measurement.units import ANGLE_UNITS, MICRORADIAN, MILLIMETRE

_SOURCE = ("measurement", "source")
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
        return _collected(composition, path, registry, formats)
    return _with_sessions(_checked(composition, path.parent, registry, formats), path, registry)


def _collected(composition: Composition, path: Path, registry: Installed, formats: tuple[str, ...]) -> Job:
    """Return a job that makes one document of several jobs."""
    document = composition.keys
    named = jobs_named(document)
    problems: list[Problem] = []
    parts: list[tuple[Job, Path]] = []
    first: Keys | None = None
    for file, place in named:
        try:
            own = compose(file)
            keys = part_of(own.keys, document, place)
            first = first or keys
            part = _checked(replace(own, keys=keys), file.parent, registry, formats)
            parts.append((_with_sessions(part, file, registry), file))
        except InputError as error:
            problems.extend(error.problems)
    if problems or first is None:
        raise InputError(sorted(set(problems)))
    whole = replace(composition, keys=document_of(first, document))
    job = _checked(whole, path.parent, registry, formats)
    names = names_of((part.axis, file) for part, file in parts)
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


def _with_sessions(job: Job, path: Path, registry: Installed) -> Job:
    """Return a job with the further tests that its model names, and what earlier ones taught."""
    sessions, priors = _sessions(job, path, registry), _priors(job)
    files = [file for each in sessions for file in each.files]
    if priors:
        files.append(priors.file)
    return replace(job, sessions=sessions, priors=priors.keys if priors else None, files=(*job.files, *files))


def _checked(
    composition: Composition, folder: Path, registry: Installed, formats: tuple[str, ...] = ()
) -> Job:
    """Return the job in a folder that files make together, without the further tests that its model names."""
    tree = _with_axis(_with_shared_keys(composition.keys, registry), registry)
    refuse_other_format(
        tree, JOB, lambda: [each for offered in registry.extensions for each in offered.formats]
    )
    problems: list[Problem] = []
    own = tree.without(*registry.extension_keys)
    keys = validate(JobKeys, own, problems, also_known=registry.extension_keys)
    source = _source(tree, _SOURCE, registry, problems)
    source_as_found = _source(tree, _SOURCE_AS_FOUND, registry, problems)
    error = _stated_in(tree)
    standards = list(standard_choices(tree, registry, problems, error))
    effects = effect_choices(found_at(tree, _EFFECTS), registry, problems, within=".".join(_EFFECTS))
    candidates = candidate_choices(
        found_at(tree, _CANDIDATES), registry, problems, within=".".join(_CANDIDATES)
    )
    programs = program_choices(
        found_at(tree, _PROGRAMS), registry.part_program, problems, within=".".join(_PROGRAMS)
    )
    extensions = tuple(extension_choices(tree, registry, problems))
    controller = controller_choice(found_at(tree, _COMPENSATION), registry, problems)
    tests = _test_sources(keys, tree, registry, problems) if keys else {}
    measurand = measurand_of(keys, tree, registry, problems) if keys else POSITIONING
    formats = formats or _formats(tree, keys, registry, problems)
    if keys:
        found = [
            each
            for choice in extensions
            for each in registry.extension(choice.identifier).contradictions(keys, choice.options)
        ]
        found += [
            *quantity_contradictions(keys, measurand),
            *tests_contradictions(keys, measurand),
            *circle_contradictions(keys, measurand, has_axis="axis" in composition.keys.entries),
            *circle_plan_contradictions(keys),
            *effect_contradictions(effects, measurand, registry),
        ]
        problems.extend(contradictions(keys, tree, found))
    if source is None and tests:
        source = next(iter(tests.values()))
    if problems or keys is None or source is None:
        raise InputError(sorted(_said_once(problems)))
    for choice in extensions:
        keys = registry.extension(choice.identifier).completed(keys, choice.options)
    axis = axis_in_si(keys.axis, measurand, stated_error(keys), keys.measurement.at, keys.circle)
    job = Job(
        keys=keys,
        axis=axis,
        source=source,
        source_as_found=source_as_found,
        standards=tuple(
            replace(
                choice,
                tolerances=tolerances_in_si(
                    each.tolerances, for_error(registry.standard(each.standard), error), axis
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
        files=(*composition.files, *axis.files, *_files_named(standards)),
        tree=tree,
    )
    if not tests:
        return job
    parts = {name: _of_test(job, name, chosen, registry) for name, chosen in tests.items()}
    files = [file for each in parts.values() for file in each.axis.files]
    return replace(job, tests=parts, files=(*job.files, *files))


def _stated_in(tree: Keys) -> str:
    """Return what a job says was measured, by its symbol or its name; empty where it does not."""
    stated = found_at(tree, ("measurement", "error"))
    return stated.text.strip() if isinstance(stated, Scalar) else ""


def _error_in(tree: Keys) -> ErrorSymbol | None:
    """Return the error that a job names; None where it names none, or one that there is not."""
    with suppress(ValueError):
        return error_named(_stated_in(tree))
    return None


def _said_once(problems: Iterable[Problem]) -> set[Problem]:
    """Return problems without those of a standard with a key of the job that the job was told already."""
    found = set(problems)
    return {
        each
        for each in found
        if replace(each, message=each.message.removeprefix("evaluate.")) == each
        or replace(each, message=each.message.removeprefix("evaluate.")) not in found
    }


def _with_axis(tree: Keys, registry: Installed) -> Keys:
    """Return the keys of a job with its axis, where a circle, an extension or an error's symbol has it."""
    if "axis" in tree.entries:
        return tree
    error = _error_in(tree)
    name = next((key for key in registry.axis_keys if key in tree.entries), "")
    place = tree.entries[name].place if name else place_of(tree, ("measurement",))
    if "circle" in tree.entries:
        plane = found_at(tree, ("circle", "plane"))
        place = tree.entries["circle"].place
        name = plane.text if isinstance(plane, Scalar) else str(CircleKeys.model_fields["plane"].default)
    if not name and error:
        name = error.axis
    if not name and isinstance(listed := found_at(tree, ("measurement", "tests")), Keys):
        name = _together(listed.entries)
    if not name:
        return tree
    axis = keys_of(place, (KeyEntry("name", place, Scalar(place, name, plain=False)),))
    return merged(tree, keys_of(tree.place, (KeyEntry("axis", place, axis),)))


def _with_shared_keys(tree: Keys, registry: Installed) -> Keys:
    """Return the keys of a job with what standards ask of the measurement among their own keys.

    Such a key stands in `measurement`, or at the top of the job; each standard that asks for it gets it. One
    that is the job's own, as `circle`, stays there too.
    """
    evaluate, measurement = found_at(tree, ("evaluate",)), found_at(tree, ("measurement",))
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
            keys_of(group.place, tuple(entries.values())) if len(entries) > len(group.entries) else item
        )
    if not taken:
        return tree
    taken -= JobKeys.model_fields.keys()
    entries = dict(tree.without(*taken).entries)
    entries["evaluate"] = replace(tree.entries["evaluate"], value=Items(evaluate.place, tuple(items)))
    if isinstance(measurement, Keys):
        entries["measurement"] = replace(entries["measurement"], value=measurement.without(*taken))
    return keys_of(tree.place, tuple(entries.values()))


def _test_sources(
    keys: JobKeys, tree: Keys, registry: Installed, problems: list[Problem]
) -> dict[str, SourceChoice]:
    """Return the data source of each named test."""
    found = {}
    for name in keys.measurement.tests:
        source = _source(tree, ("measurement", "tests", name, "source"), registry, problems)
        if source:
            found[name] = source
    return found


def _of_test(job: Job, name: str, source: SourceChoice, registry: Installed) -> Job:
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
    error = error_named(own.error) if own.error and not is_usual else None
    if axis_keys is None:
        axis_keys = _axis_of_test(job, name, error)
    update["axis"] = axis_keys
    quantity = error.measurand if error else of_lines
    return replace(
        job,
        keys=job.keys.model_copy(update=update),
        axis=axis_in_si(axis_keys, quantity, error, measurement.at),
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


def _axis_of_test(job: Job, name: str, error: ErrorSymbol | None) -> AxisKeys:
    """Return the axis of a measured line that states none: that of its error, or one of the test's name."""
    stated = job.keys.axis
    if error is None:
        return AxisKeys(name=name) if stated.name == _together(job.keys.measurement.tests) else stated
    return stated if letter_of(stated.name) == error.axis else AxisKeys(name=error.axis)


def _together(tests: Iterable[str]) -> str:
    """Return the name of what several measured lines are of, where no axis is stated."""
    return " ".join(tests)


def _files_named(standards: Iterable[StandardChoice]) -> Iterator[SourceFile]:
    """Yield the files that keys of standards name; a certificate carries them as it does its readings."""
    for choice in standards:
        for path in _paths_in(choice.options):
            yield SourceFile.of(path, demanded(path, LARGEST, choice.place))


def _paths_in(value: Any) -> Iterator[Path]:
    """Yield every path among the values of keys."""
    if isinstance(value, Path):
        yield value
    elif isinstance(value, BaseModel):
        for name in type(value).model_fields:
            yield from _paths_in(getattr(value, name))
    elif isinstance(value, Mapping):
        for each in value.values():
            yield from _paths_in(each)
    elif isinstance(value, list | tuple):
        for each in value:
            yield from _paths_in(each)


def _priors(job: Job) -> KeysFile[PriorsKeys] | None:
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


def _sessions(job: Job, path: Path, registry: Installed) -> tuple[Job, ...]:
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
        other = _checked(compose(stated), stated.parent, registry)
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


def _source(
    tree: Keys, path: tuple[str, ...], registry: Installed, problems: list[Problem]
) -> SourceChoice | None:
    """Return the data source at a path, with its own keys; None where there is none, or a wrong one."""
    keys, within = found_at(tree, path), ".".join(path)
    plugin = found_at(tree, (*path, "plugin"))
    choice = choice_in(keys, "plugin", registry.source, problems, within=within)
    instrument = None
    with suppress(InputError):  # a source that there is not was refused above
        if isinstance(keys, Keys) and isinstance(plugin, Scalar):
            known = registry.source(plugin.text).options
            instrument = instrument_choice(known, keys, registry, problems, within=within)
    return SourceChoice(choice.identifier, choice.options, choice.place, instrument) if choice else None


#: Keys of `evaluate` that every standard has.
_OF_EVERY_STANDARD = tuple(StandardKeys.model_fields)


def standard_choices(
    tree: Keys, registry: Installed, problems: list[Problem], error: str = ""
) -> Iterator[StandardChoice]:
    """Yield the standards that a job's `evaluate` lists, with their own keys and no tolerances yet.

    `error`: What the job says was measured: some parameters bear its symbol.

    Mistakes are added to the problems: tolerances for what is no parameter among them.
    """
    evaluate = found_at(tree, ("evaluate",))
    first_named: dict[str, Place] = {}
    for item in evaluate.items if isinstance(evaluate, Items) else ():
        keys = group_naming("standard", item)
        named = keys.entries.get("standard")
        if named is None or not isinstance(named.value, Scalar) or named.value.is_nothing:
            continue
        identifier, place = named.value.text, named.value.place
        try:
            standard = for_error(registry.standard(identifier, place), error)
        except InputError as unknown:
            problems.extend(unknown.problems)
            continue
        if standard.identifier in first_named:
            first = first_named[standard.identifier].line
            problems.append(
                Problem(place, f"{standard.identifier} stands in line {first} already; remove one of them")
            )
        first_named.setdefault(standard.identifier, place)
        problems.extend(_unknown_tolerances(keys, standard))
        own = replace(keys.without(*_OF_EVERY_STANDARD), place=place)
        options = validate(standard.options, own, problems, within="evaluate", also_known=_OF_EVERY_STANDARD)
        if options:
            adoption = "" if identifier == standard.identifier else identifier
            yield StandardChoice(standard.identifier, options, place, {}, adoption=adoption)


def _unknown_tolerances(keys: Keys, standard: InstalledStandard) -> Iterator[Problem]:
    """Yield tolerances for what is no parameter of the standard, or cannot have one."""
    tolerances = found_at(keys, ("tolerances",))
    limitable = [quantity.symbol for quantity in standard.quantities if quantity.can_be_limited]
    symbols = {quantity.symbol for quantity in standard.quantities}
    printed = {plain(each.notation): each.symbol for each in standard.quantities if each.symbol in limitable}
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


def _formats(
    tree: Keys, keys: JobKeys | None, registry: Installed, problems: list[Problem]
) -> tuple[str, ...]:
    """Return the output formats; without a list of them, the usual ones."""
    stated = found_at(tree, ("output", "formats"))
    if isinstance(stated, Items):
        named = [(item.text, item.place) for item in stated.items if isinstance(item, Scalar)]
    else:
        place = place_of(tree, ("output", "formats"))
        named = [(identifier, place) for identifier in (keys.output.formats if keys else ())]
    try:
        return chosen_formats(named, registry)
    except InputError as error:
        problems.extend(error.problems)
        return ()


def chosen_formats(named: Iterable[tuple[str, Place]], registry: Installed) -> tuple[str, ...]:
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


def axis_in_si(
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
        at=places_in_si(at),
        circle=circle.in_si() if circle else None,
    )


def tolerances_in_si(
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
