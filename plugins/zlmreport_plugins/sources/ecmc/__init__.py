"""Data source ``ecmc``: ``KEY=VALUE`` logs of positioning tests (``.dat``)."""

from __future__ import annotations

import math
import re
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from typing import Annotated, TypeAlias

from pydantic import AfterValidator, Field

from zlmreport.plugin import (
    Approach,
    InputError,
    JobPath,
    MeasurementSet,
    Options,
    Place,
    Problem,
    Unit,
    Words,
    counted,
    did_you_mean,
    hookimpl,
    position_units,
    quoted,
    unit_named,
)
from zlmreport.plugin.source import (
    DataSource,
    Provenance,
    Reading,
    SourceContext,
    TextFile,
    collect_readings,
    known_encoding,
    parse_number,
    read_text,
    refuse_other_than_positions,
)

UNIT, CYCLES, POSITIONS = "UNIT", "CYCLES", "POSITIONS"
TARGET, FORWARD, BACKWARD = "TGT_DATA", "REF_DATA_FWD", "REF_DATA_BWD"
#: Names of signals, and the decimals of a printed report: nothing of the readings.
_NOT_READ = ("REF_PV", "TEST_PV", "TGT_SET_PV", "DEC")
_KNOWN = (UNIT, CYCLES, POSITIONS, TARGET, FORWARD, BACKWARD, *_NOT_READ)
_INDICES = {
    TARGET: ("position",),
    FORWARD: ("position", "cycle"),
    BACKWARD: ("position", "cycle"),
}

_KEY = re.compile(r"([^\[\]]*)(?:\[([^\[\]]*)\])?")
_INDEX = re.compile(r"[0-9]{1,6}")

#: A key with its indices.
Key: TypeAlias = tuple[str, tuple[int, ...]]


@dataclass(frozen=True, slots=True)
class EcmcEntry:
    """What stands behind a key, and where."""

    place: Place
    value: str


def read_entries(text: TextFile, problems: list[Problem]) -> Mapping[Key, EcmcEntry]:
    """Return the entries of a log that are read; what is wrong with a line is added to the problems."""
    found: dict[Key, EcmcEntry] = {}
    for number, line in enumerate(text.lines, 1):
        content = line.partition("#")[0]
        if not content.strip() or (number == 1 and _is_glued(line)):
            continue
        begin = text.place(number, len(line) - len(line.lstrip()) + 1)
        name, equals, value = content.partition("=")
        try:
            key = _read_key(name.strip(), stands_alone=not equals)
        except ValueError as error:
            problems.append(Problem(begin, str(error)))
            continue
        if key in found:
            first = found[key].place.line
            problems.append(
                Problem(begin, f"{_write_key(key)} stands in line {first} already; keep one of them")
            )
        elif key[0] not in _NOT_READ:
            column = len(name) + 1 + len(value) - len(value.lstrip()) + 1
            found[key] = EcmcEntry(text.place(number, column), value.strip())
    return found


def _write_key(key: Key) -> str:
    """Return a key as logs write it.

    >>> _write_key((FORWARD, (3, 1)))
    'REF_DATA_FWD[3,1]'
    """
    name, indices = key
    return f"{name}[{','.join(map(str, indices))}]" if indices else name


def is_count(value: str) -> bool:
    """Whether a value is a number of things."""
    return _INDEX.fullmatch(value) is not None and int(value) > 0


def _is_glued(line: str) -> bool:
    """Whether a line is a comment to whose front another text is glued, as happens to the first one."""
    before, equals, after = line.partition("=")
    return bool(equals) and after.lstrip().startswith("#") and before.strip() not in _KNOWN


def _read_key(text: str, *, stands_alone: bool) -> Key:
    if stands_alone:
        raise ValueError(f"{quoted(text)} is not of the form KEY=VALUE")
    match = _KEY.fullmatch(text)
    name, indices = (match[1].rstrip(), match[2]) if match else (text, None)
    if name not in _KNOWN:
        raise ValueError(f"{quoted(name)} is no key of a log; {did_you_mean(name[:40], _KNOWN)}")
    if name in _NOT_READ:
        return name, ()
    expected = _INDICES.get(name, ())
    found = [index.strip() for index in indices.split(",")] if indices is not None else []
    if len(found) != len(expected) or not all(map(is_count, found)):
        form = f"{name}[{','.join(expected)}], counted from 1" if expected else name
        raise ValueError(f"{quoted(text)} is not of the form {form}")
    return name, tuple(map(int, found))


#: What a log means that does not state them.
_DEFAULTS = {CYCLES: 5, POSITIONS: 8}
#: With so many announced readings to an entry, hardly any would be there.
_HARDLY_ANY = 100


@dataclass(frozen=True, slots=True)
class Log:
    """A log."""

    file: Place  #: For what has no line of its own.
    entries: Mapping[Key, EcmcEntry]  #: By key.
    problems: list[Problem]  #: What is wrong with them; reading adds to it.

    def list_readings(self, unit: Unit, forward: Approach) -> Iterator[Reading]:
        """Yield the readings cycle by cycle, upwards and then downwards; the log tells no order.

        `forward`: The approach that the log calls FWD.
        """
        positions, cycles = self._read_count(POSITIONS), self._read_count(CYCLES)
        if positions * cycles > _HARDLY_ANY * len(self.entries):
            plan = f"{counted(positions, 'position')} and {counted(cycles, 'cycle')}"
            message = f"holds {len(self.entries)} entries for {plan}; are POSITIONS and CYCLES right?"
            self.problems.append(Problem(self.file, message))
            return
        self._refuse_beyond(positions, cycles)
        targets = sorted(self._list_targets(positions), key=lambda target: target[1])
        measured = {name for name, _ in self.entries}
        names = {forward: FORWARD, Approach(-forward): BACKWARD}
        for cycle in range(1, cycles + 1):
            for approach in Approach:
                if names[approach] in measured:
                    for index, target in targets[:: int(approach)]:
                        yield self._make_reading((names[approach], (index, cycle)), target, approach, unit)

    def _make_reading(self, key: Key, target: float, approach: Approach, unit: Unit) -> Reading:
        """Return a reading; where its entry is empty, or not there, it is a missing one."""
        entry = self.entries.get(key)
        actual = self._read_number(key) if entry and entry.value else math.nan
        index, cycle = key[1]
        place = entry.place if entry else self.entries[TARGET, (index,)].place
        return Reading(place, unit.to_si(target), approach, cycle, unit.to_si(actual - target))

    def _list_targets(self, positions: int) -> Iterator[tuple[int, float]]:
        """Yield the targets by number; say what is missing, unless it may be in a line that is wrong."""
        keys = [(TARGET, (index,)) for index in range(1, positions + 1)]
        absent = [_write_key(key) for key in keys if key not in self.entries]
        if absent and not self.problems:
            stated = self.entries.get((POSITIONS, ()))
            some = f"{', '.join(absent[:5])}{' …' if absent[5:] else ''}"
            message = f"there is no {some}, and {self._find_stated(POSITIONS)}"
            self.problems.append(Problem(stated.place if stated else self.file, message))
        for key in keys:
            if key in self.entries:
                target = self._read_number(key)
                if not math.isnan(target):
                    yield key[1][0], target

    def _refuse_beyond(self, positions: int, cycles: int) -> None:
        """Refuse entries of positions or cycles that the log does not announce."""
        limits = ((POSITIONS, positions), (CYCLES, cycles))
        for key, entry in self.entries.items():
            for (name, limit), index in zip(limits, key[1], strict=False):
                if index > limit:
                    message = f"{_write_key(key)} is one too many: {self._find_stated(name)}"
                    self.problems.append(Problem(entry.place, message))

    def _read_count(self, name: str) -> int:
        entry = self.entries.get((name, ()))
        if entry and is_count(entry.value):
            return int(entry.value)
        if entry:
            message = f"{name} is {entry.value[:40]!r}; a number of them belongs there"
            self.problems.append(Problem(entry.place, message))
        return _DEFAULTS[name]

    def _find_stated(self, name: str) -> str:
        entry = self.entries.get((name, ()))
        if entry:
            return f"{name} is {entry.value[:40]}"
        return f"{name} is not stated, which in such a log means {_DEFAULTS[name]}"

    def _read_number(self, key: Key) -> float:
        entry = self.entries[key]
        try:
            return parse_number(entry.value)
        except ValueError as error:
            self.problems.append(Problem(entry.place, f"{_write_key(key)}: {error}"))
            return math.nan


_USUAL_UNIT = "mm"

_ORDER = Words(
    "The file does not tell the order of the readings: they are listed cycle by cycle, upwards and "
    "then downwards."
)
_EXCHANGED = Words(
    "The directions of approach were exchanged against the file (FWD read as ↓, BWD as ↑), as the job states."
)


class EcmcOptions(Options):
    """Where the file is, and what it does not say itself."""

    file: JobPath = Field(description="The .dat file, relative to the file that names it.")
    exchange_directions: bool = Field(
        default=False,
        description="Whether FWD means the negative approach: some tests label the directions so.",
    )
    encoding: Annotated[str, AfterValidator(known_encoding)] | None = Field(
        None, description="Encoding of the file, if it is not UTF-8: cp1252, gbk, utf-16."
    )


class Ecmc:
    """Logs of positioning tests with ecmc, an EtherCAT motion controller."""

    identifier = "ecmc"
    title = Words("ecmc test log (.dat)")
    options: type[Options] = EcmcOptions
    suffixes = (".dat",)

    def read(self, options: EcmcOptions, context: SourceContext) -> MeasurementSet:
        """Read a log; raise `InputError` with every defect and its place."""
        refuse_other_than_positions(context.axis, context.place, "such a log has positions and nothing else")
        text = read_text(options.file, options.encoding)
        problems: list[Problem] = []
        found = read_entries(text, problems)
        if not found:
            raise InputError.at(text.place(), "holds no entry such as 'TGT_DATA[1]=-20'; is it an ecmc log?")
        log = Log(text.place(), found, problems)
        forward = Approach.NEGATIVE if options.exchange_directions else Approach.POSITIVE
        readings = list(log.list_readings(_find_unit(found, context), forward))
        remarks = (_ORDER, _EXCHANGED) if options.exchange_directions else (_ORDER,)
        provenance = Provenance(self.identifier, (text.source,), remarks)
        return collect_readings(readings, context.axis, provenance, place=text.place(), problems=problems)


def _find_unit(found: Mapping[Key, EcmcEntry], context: SourceContext) -> Unit:
    """Return the unit of all positions; raise InputError if it is none of the axis."""
    entry = found.get((UNIT, ()))
    try:
        return unit_named(entry.value if entry else _USUAL_UNIT, position_units(context.axis.kind))
    except ValueError as error:
        place = entry.place if entry else context.place
        raise InputError.at(place, f"UNIT: {error}; the axis is {context.axis.kind} (axis.kind)") from error


@hookimpl
def zlmreport_sources() -> Iterable[DataSource]:
    """Return the reader of ecmc logs."""
    return [Ecmc()]
