"""Data source ``renishaw-rtl``: linear (``.rtl``) and angular (``.rta``) tests of laser interferometers."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import Annotated

from pydantic import AfterValidator, Field

from zlmreport.plugin import (
    MICROMETRE,
    MILLIRADIAN,
    POSITION_UNITS,
    AxisKind,
    InputError,
    JobPath,
    MeasurementSet,
    Options,
    PartRow,
    Place,
    Problem,
    Unit,
    Words,
    counted,
    hookimpl,
    quoted,
    same_in_all_languages,
    unit_named,
)
from zlmreport.plugin.source import (
    DataSource,
    Provenance,
    Reading,
    SourceContext,
    SourceProposal,
    TextFile,
    collect_readings,
    known_encoding,
    likely_encodings,
    parse_number,
    read_text,
)
from zlmreport_plugins.sources.renishaw_rtl.contents import (
    Deviation,
    Pass,
    RtlEntry,
    RtlSection,
    list_passes,
    read_deviations,
    read_stated_count,
    read_target_positions,
    split_sections,
)

#: Of a text in a file that is printed as a remark.
_LONGEST = 200
#: What is recorded for a sensor that is not there.
_ABSENT = -10.0

_TEMPERATURES = {None: "°C", "0": "°C"}
_RECORDED: tuple[tuple[str, Words, Mapping[str | None, str]], ...] = (
    ("airtemp", Words("Air temperature"), _TEMPERATURES),
    ("airpress", Words("Air pressure"), {"1": "kPa"}),
    ("airhumid", Words("Relative humidity"), {None: "%"}),
    ("mattemp", Words("Material temperature"), _TEMPERATURES),
    ("envfactor", Words("Environmental factor"), {}),
    (
        "expcoeff",
        Words("Expansion coefficient"),
        {None: "ppm/°C", "0": "ppm/°C"},
    ),
)
#: Says nothing of the conditions.
_NOT_SAID = frozenset({"finaldata"})

#: Sections whose lines are kept as they are.
_TEXTS = {
    "HEADER": Words("Header of the file: {text}."),
    "USER-TEXT": Words("User’s text in the file: {text}."),
    "EQUIPMENT": Words("Equipment named in the file: {text}."),
}


def list_remarks(sections: Mapping[str, RtlSection], problems: list[Problem]) -> Iterator[Words]:
    """Yield what the file says; a value that is no number is added to the problems."""
    for name, introduction in _TEXTS.items():
        if name in sections:
            lines = (" ".join(line.text.split())[:_LONGEST] for line in sections[name].lines)
            said = [line for line in lines if not line.endswith(":")]
            if said:
                yield introduction.given(text=PartRow(tuple(said)))
    if "ENVIRONMENT" in sections:
        for entry in sections["ENVIRONMENT"].list_entries():
            try:
                remark = _say_recorded(entry)
            except ValueError as error:
                problems.append(Problem(entry.line.place, f"{entry.name}: {error}"))
            else:
                if remark:
                    yield remark


def _say_recorded(entry: RtlEntry) -> Words | None:
    """Return what was recorded at the start and at the end of the test; None if there was no sensor."""
    if entry.key in _NOT_SAID:
        return None
    kind = entry.key.rstrip("0123456789")
    quantity, units = next(
        ((words, units) for key, words, units in _RECORDED if key == kind),
        (same_in_all_languages(entry.name), None),
    )
    if units is None:
        return Words("{quantity}: {text}.").given(quantity=quantity, text=entry.value[:_LONGEST])
    values = [parse_number(word) for word in entry.value.split()[:2]]
    if len(values) < 2 or values == [_ABSENT, _ABSENT]:
        return None
    code = next(iter(entry.value.split()[2:]), None)
    unit = units.get(code, f"(unit {code})" if code else "")
    return Words("{quantity}{number}: {start}{unit} at the start, {end}{unit} at the end of the test.").given(
        quantity=quantity,
        number=f" {number}" if (number := entry.key[len(kind) :]) else "",
        start=values[0],
        end=values[1],
        unit=f" {unit}" if unit else "",
    )


_KINDS = {"rtl": AxisKind.LINEAR, "rta": AxisKind.ROTARY}
_UNITS = {AxisKind.LINEAR: MICROMETRE, AxisKind.ROTARY: MILLIRADIAN}
#: With so many readings that could be to one that is, hardly any are there.
_HARDLY_ANY = 100
_WHY = {
    "rta": "angular deviations of a linear axis are pitch, yaw or roll, and no positioning test",
    "rtl": "the linear test of a rotary axis is none of its angular positions",
}
_TARGETS, _DEVIATIONS = "TARGET DATA", "DEVIATIONS"

_UNIT_TAKEN = Words(
    "The file does not name the unit of its deviations; they were read as {unit}, which is usual in files "
    "of this kind (.{kind})."
)
_UNIT_STATED = Words(
    "The file does not name the unit of its deviations; they were read as {unit}, as the job states."
)


def _find_known_unit(spelling: str) -> str:
    unit_named(spelling, POSITION_UNITS)
    return spelling


class RenishawRtlOptions(Options):
    """Where the file is, and what it does not say itself."""

    file: JobPath = Field(description="The .rtl or .rta file, relative to the file that names it.")
    deviation_unit: Annotated[str, AfterValidator(_find_known_unit)] | None = Field(
        None,
        description="Unit of the deviations, if it is not micrometres (.rtl) or mrad (.rta): arcsec, nm.",
    )
    encoding: Annotated[str, AfterValidator(known_encoding)] | None = Field(
        None, description="Encoding of the file, if it is not UTF-8: cp1252, gbk, utf-16."
    )


class RenishawRtl:
    """Renishaw's linear and angular test files."""

    identifier = "renishaw-rtl"
    title = Words("Renishaw test file (.rtl, .rta)")
    options: type[Options] = RenishawRtlOptions
    suffixes = (".rtl", ".rta")

    def proposals(self, file: Path) -> Iterable[SourceProposal]:
        """Return no keys for a file that begins as these do, and nothing for any other."""
        for encoding in likely_encodings(file):
            try:
                text = read_text(file, encoding)
            except InputError:
                continue
            if next(filter(None, map(str.strip, text.lines)), "").upper() == "HEADER::":
                yield SourceProposal({"encoding": encoding} if encoding else {}, is_certain=True)
            return

    def read(self, options: RenishawRtlOptions, context: SourceContext) -> MeasurementSet:
        """Read a test file; raise `InputError` with every defect and its place."""
        text = read_text(options.file, options.encoding)
        parts = split_sections(text, (_TARGETS, _DEVIATIONS))
        kind = _find_kind(text, parts, context)
        unit = _find_deviation_unit(options, context)
        targets = read_target_positions(parts[_TARGETS])
        problems: list[Problem] = []
        found = read_deviations(parts[_DEVIATIONS], targets, problems)
        taken = list(list_passes(found, targets, problems))
        problems.extend(_cut_off(parts, found))
        if len(taken) * len(targets) > _HARDLY_ANY * len(found):
            message = (
                f"has {counted(len(targets), 'target')} and {counted(len(taken), 'run')}, and only "
                f"{counted(len(found), 'reading')}"
            )
            raise InputError([Problem(text.place(), message), *problems])
        said = [_say_unit(options, unit, kind), *list_remarks(parts, problems)]
        return collect_readings(
            _list_readings(taken, targets, unit, context),
            context.axis,
            Provenance(self.identifier, (text.source,), tuple(said)),
            place=text.place(),
            problems=problems,
        )


def _find_kind(text: TextFile, parts: Mapping[str, RtlSection], context: SourceContext) -> str:
    """Return the kind of file, rtl or rta, which must be that of the axis."""
    own = next(kind for kind, axis_kind in _KINDS.items() if axis_kind is context.axis.kind)
    kind, place = _find_told_kind(text, parts) or (own, text.place())
    if kind not in _KINDS:
        raise InputError.at(
            place, f"the file is of type {quoted(kind)}; linear (rtl) and angular (rta) tests are read"
        )
    if kind != own:
        raise InputError.at(
            place,
            f"the file is of type {kind}, and the axis is {context.axis.kind} (axis.kind): {_WHY[kind]}",
        )
    return kind


def _find_told_kind(text: TextFile, parts: Mapping[str, RtlSection]) -> tuple[str, Place] | None:
    """Return the kind that the file's header or else its suffix tells, and where."""
    entry = parts["HEADER"].find_entry("filetype") if "HEADER" in parts else None
    if entry and entry.value:
        return entry.value.casefold(), entry.line.place
    suffix = text.source.name.rpartition(".")[2].casefold()
    return (suffix, text.place()) if suffix in _KINDS else None


def _find_deviation_unit(options: RenishawRtlOptions, context: SourceContext) -> Unit:
    if options.deviation_unit is None:
        return _UNITS[context.axis.kind]
    try:
        return unit_named(options.deviation_unit, context.axis.deviation_units)
    except ValueError as error:
        raise InputError.at(context.place, f"deviation_unit: {error}") from error


def _say_unit(options: RenishawRtlOptions, unit: Unit, kind: str) -> Words:
    return (_UNIT_STATED if options.deviation_unit else _UNIT_TAKEN).given(unit=unit.symbol, kind=kind)


def _cut_off(parts: Mapping[str, RtlSection], found: Sequence[Deviation]) -> Iterator[Problem]:
    """Yield the problem that the file has not as many runs as it announces."""
    stated = read_stated_count(parts["RUNS"], "runcount") if "RUNS" in parts else None
    runs = len({deviation.run for deviation in found})
    if stated and stated[0] != runs:
        yield Problem(
            stated[1].place,
            f"the file announces {counted(stated[0], 'run')} and has readings of {runs}; was it cut off?",
        )


def _list_readings(
    taken: Sequence[Pass], targets: Sequence[float], unit: Unit, context: SourceContext
) -> Iterator[Reading]:
    """Yield the readings run by run; a target that a run left out is a missing reading."""
    positions = [context.axis.position_unit.to_si(target) for target in targets]
    numbers = sorted(range(1, len(targets) + 1), key=lambda number: positions[number - 1])
    for run in taken:
        for number in numbers[:: int(run.approach)]:
            position = positions[number - 1]
            for deviation in run.deviations.get(number, ()):
                yield Reading(deviation.place, position, run.approach, run.cycle, unit.to_si(deviation.value))
            if number not in run.deviations:
                yield Reading(run.place, position, run.approach, run.cycle, math.nan)


@hookimpl
def zlmreport_sources() -> Iterable[DataSource]:
    """Return the reader of Renishaw's test files."""
    return [RenishawRtl()]
