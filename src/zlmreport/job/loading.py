"""From a job file to a checked job, with its axis and tolerances in SI."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from contextlib import suppress
from dataclasses import replace
from pathlib import Path
from typing import Generic, TypeVar

from pydantic import BaseModel

from zlmreport.errors import InputError, Place, Problem, did_you_mean, quoted
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
from zlmreport.job.contradictions import contradictions, validate
from zlmreport.job.evaluation_keys import PriorsKeys
from zlmreport.job.extends import JOB, PRIORS, Composition, Defaults, FileFormat, compose, refuse_other_format
from zlmreport.job.installed import Installed, InstalledStandard
from zlmreport.job.job import Job, SourceChoice, StandardChoice
from zlmreport.job.keys import JobKeys
from zlmreport.job.measurement_keys import AxisKeys
from zlmreport.job.tree import Items, Keys, Scalar, found_at, place_of
from zlmreport.measurement.axis import Axis, position_units
from zlmreport.measurement.position_table import TableColumn, read_position_table
from zlmreport.measurement.provenance import SourceFile
from zlmreport.quantities.formatting import plain
from zlmreport.quantities.units import ANGLE_UNITS, MICRORADIAN, MILLIMETRE
from zlmreport.values import dataclass

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
    job = _checked(compose(path, content, defaults), path.parent, registry, formats)
    sessions, priors = _sessions(job, path, registry), _priors(job)
    files = [file for each in sessions for file in each.files]
    if priors:
        files.append(priors.file)
    return replace(job, sessions=sessions, priors=priors.keys if priors else None, files=(*job.files, *files))


def _checked(
    composition: Composition, folder: Path, registry: Installed, formats: tuple[str, ...] = ()
) -> Job:
    """Return the job in a folder that files make together, without the further tests that its model names."""
    tree = composition.keys
    refuse_other_format(
        tree, JOB, lambda: [each for offered in registry.extensions for each in offered.formats]
    )
    problems: list[Problem] = []
    own = tree.without(*registry.extension_keys)
    keys = validate(JobKeys, own, problems, also_known=registry.extension_keys)
    source = _source(tree, _SOURCE, registry, problems)
    source_as_found = _source(tree, _SOURCE_AS_FOUND, registry, problems)
    standards = list(standard_choices(tree, registry, problems))
    effects = effect_choices(found_at(tree, _EFFECTS), registry, problems, within=".".join(_EFFECTS))
    candidates = candidate_choices(
        found_at(tree, _CANDIDATES), registry, problems, within=".".join(_CANDIDATES)
    )
    programs = program_choices(
        found_at(tree, _PROGRAMS), registry.part_program, problems, within=".".join(_PROGRAMS)
    )
    extensions = tuple(extension_choices(tree, registry, problems))
    controller = controller_choice(found_at(tree, _COMPENSATION), registry, problems)
    formats = formats or _formats(tree, keys, registry, problems)
    if keys:
        found = [
            each
            for choice in extensions
            for each in registry.extension(choice.identifier).contradictions(keys, choice.options)
        ]
        problems.extend(contradictions(keys, tree, found))
    if problems or keys is None or source is None:
        raise InputError(sorted(set(problems)))
    for choice in extensions:
        keys = registry.extension(choice.identifier).completed(keys, choice.options)
    axis = axis_in_si(keys.axis)
    return Job(
        keys=keys,
        axis=axis,
        source=source,
        source_as_found=source_as_found,
        standards=tuple(
            replace(choice, tolerances=tolerances_in_si(each.tolerances, axis))
            for choice, each in zip(standards, keys.evaluate, strict=True)
        ),
        effects=effects,
        candidates=candidates,
        programs=programs,
        extensions=extensions,
        controller=controller,
        formats=formats,
        directory=keys.output.directory or folder,
        files=(*composition.files, *axis.files),
        tree=tree,
    )


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


def standard_choices(tree: Keys, registry: Installed, problems: list[Problem]) -> Iterator[StandardChoice]:
    """Yield the standards that a job's `evaluate` lists, with their own keys and no tolerances yet.

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
            standard = registry.standard(identifier, place)
        except InputError as error:
            problems.extend(error.problems)
            continue
        if identifier in first_named:
            first = first_named[identifier].line
            problems.append(
                Problem(place, f"{identifier} stands in line {first} already; remove one of them")
            )
        first_named.setdefault(identifier, place)
        problems.extend(_unknown_tolerances(keys, standard))
        own = replace(keys.without("standard", "tolerances"), place=place)
        options = validate(
            standard.options, own, problems, within="evaluate", also_known=["standard", "tolerances"]
        )
        if options:
            yield StandardChoice(standard.identifier, options, place, {})


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
    """Return the identifiers of output formats.

    Raises `InputError` for each that no plugin provides, and each that would write the same file as one
    before it.
    """
    problems: list[Problem] = []
    by_suffix: dict[str, str] = {}
    for identifier, place in named:
        try:
            suffix = registry.renderer(identifier, place).suffix
        except InputError as error:
            problems.extend(error.problems)
            continue
        other = by_suffix.setdefault(suffix, identifier)
        if other == identifier:
            continue
        problems.append(
            Problem(place, f"{other} and {identifier} both write {suffix} files; choose one of them")
        )
    if problems:
        raise InputError(problems)
    return tuple(by_suffix.values())


def axis_in_si(keys: AxisKeys) -> Axis:
    """Return the axis with its lengths in metres, or its angles in radians, and with its tables.

    Raises `AccessError` if the file of a table cannot be read; `InputError` if it is not such a table.
    """
    bare = Axis(keys.name, keys.kind)
    to_si = bare.position_unit.to_si
    position = TableColumn("position", bare.position_unit, position_units(keys.kind))
    deviation = TableColumn("deviation", bare.deviation_unit, position_units(keys.kind))
    angle = TableColumn("angle", MICRORADIAN, ANGLE_UNITS)
    return Axis(
        name=keys.name,
        kind=keys.kind,
        travel=(to_si(keys.travel[0]), to_si(keys.travel[1])) if keys.travel else None,
        screw_pitch=to_si(keys.screw_pitch) if keys.screw_pitch else None,
        signal_period=to_si(keys.signal_period) if keys.signal_period else None,
        scale_element=to_si(keys.scale_element) if keys.scale_element else None,
        compensation_table=(
            read_position_table(keys.compensation_table, position, deviation, ("forward", "reverse"))
            if isinstance(keys.compensation_table, Path)
            else None
        ),
        angular_errors=(
            read_position_table(keys.angular_errors, position, angle) if keys.angular_errors else None
        ),
        abbe_offset=None if keys.abbe_offset is None else MILLIMETRE.to_si(keys.abbe_offset),
    )


def tolerances_in_si(tolerances: Mapping[str, float], axis: Axis) -> dict[str, float]:
    """Return tolerances, given in µm or ″, in metres or radians."""
    return {symbol: axis.deviation_unit.to_si(limit) for symbol, limit in tolerances.items()}


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
    """

    keys: Model
    file: SourceFile
    tree: Keys

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
    return KeysFile(keys, composition.files[0], composition.keys)
