"""The data source ``dcc``: the readings of a digital calibration certificate that this program wrote."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from typing import Any, Literal
from xml.etree import ElementTree as ET

from pydantic import Field

from zlmreport.plugin import (
    CONDITIONS,
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
    quoted,
)
from zlmreport.plugin.source import Provenance, Reading, SourceContext, TextFile, collect_readings, read_text
from zlmreport_plugins.renderers.dcc.elements import (
    CONDITION,
    DCC,
    DEVIATION,
    DIRECTION,
    READINGS,
    RUN,
    SCALES,
    SI,
    TARGET,
    TEST,
    TEST_AS_FOUND,
    TIME,
    TRAITS,
    write_unit_of,
)

_FROM = Words("Readings of the digital calibration certificate {number}, corrected as it states.")
_DEMANDED = (TARGET, DIRECTION, RUN, DEVIATION)
_APPROACHES = {1.0: Approach.POSITIVE, -1.0: Approach.NEGATIVE}


class DccOptions(Options):
    """Where the file is, and which of its measurements is meant."""

    file: JobPath = Field(description="The DCC (.xml), relative to the file that names it.")
    state: Literal["as found", "as left"] = Field(
        "as left", description="Which measurement of an axis that was adjusted: as found or as left."
    )
    test: str | None = Field(
        None, description="Which of several measured lines, by its name.", examples=["x"]
    )


class DccSource:
    """The readings that a digital calibration certificate carries beside its results."""

    identifier = "dcc"
    title = Words("Digital calibration certificate (DCC, XML)")
    options: type[Options] = DccOptions
    suffixes = (".xml",)

    def read(self, options: DccOptions, context: SourceContext) -> MeasurementSet:
        """Read the readings; raise `InputError` with every defect."""
        text = read_text(options.file)
        root = _read_root(text)
        columns = _find_columns(_find_readings(root, options, text), text)
        axis, place = context.axis, text.place()
        position = _find_unit(columns[TARGET], axis.position_unit, place)
        deviation = _find_unit(columns[DEVIATION], axis.deviation_unit, place)
        number = root.findtext(f".//{{{DCC}}}uniqueIdentifier", "–")
        measurements = collect_readings(
            _read_each(columns, position, deviation, place),
            axis,
            Provenance(self.identifier, (text.source,), (_FROM.given(number=number),)),
            place=place,
        )
        traits: dict[str, Any] = {
            name: True for kind, name in TRAITS.items() if kind in columns[DEVIATION].kinds
        }
        return replace(measurements, **traits)


@dataclass(frozen=True, slots=True)
class _Column:
    """A column of readings: its values, its unit as D-SI writes it, its kinds, its name."""

    values: tuple[float, ...]
    unit: str
    kinds: tuple[str, ...]
    name: str


def _read_root(text: TextFile) -> ET.Element:
    if any("<!DOCTYPE" in line for line in text.lines):
        raise InputError.at(text.place(), "declares a document type; a DCC declares none")
    try:
        root = ET.fromstring(text.source.content or b"")  # noqa: S314 - it declares no entity
    except ET.ParseError as error:
        line, column = error.position
        raise InputError.at(text.place(line, column + 1), f"is no XML: {error}") from error
    if root.tag != f"{{{DCC}}}digitalCalibrationCertificate":
        raise InputError.at(text.place(1, 1), "is no digital calibration certificate (DCC) of PTB's schema")
    return root


def _find_readings(root: ET.Element, options: DccOptions, text: TextFile) -> ET.Element:
    found = root.findall(f".//{{{DCC}}}result[@refType='{READINGS}']")
    if not found:
        message = (
            f"carries no readings (no result of the kind {READINGS}): its results cannot be evaluated again"
        )
        raise InputError.at(text.place(), message)
    named = {each.get("id", ""): each for each in found if each.get("id")}
    tests = [each.removeprefix(TEST) for each in named if each.startswith(TEST)]
    if named or options.test:
        if options.test not in tests:
            names = ", ".join(tests) or "none"
            raise InputError.at(text.place(), f"say which of its lines is meant: test (it has: {names})")
        meant = f"{TEST_AS_FOUND if options.state == 'as found' else TEST}{options.test}"
        if meant not in named:
            message = f"{quoted(options.test)} has readings of one measurement only, and none as found"
            raise InputError.at(text.place(), message)
        return named[meant]
    if options.state == "as found" and len(found) == 1:
        raise InputError.at(text.place(), "has readings of one measurement only, and none as found")
    return found[0 if options.state == "as found" else -1]


def _find_columns(readings: ET.Element, text: TextFile) -> Mapping[str, _Column]:
    """Return the columns by their kinds; of a condition without a kind of its own, by CONDITION and name."""
    columns: dict[str, _Column] = {}
    problems: list[Problem] = []
    for quantity in readings.iter(f"{{{DCC}}}quantity"):
        kinds = tuple(quantity.get("refType", "").split())
        name = " ".join("".join(quantity.find(f"{{{DCC}}}name").itertext()).split())  # type: ignore[union-attr]
        try:
            values = tuple(map(float, quantity.findtext(f".//{{{SI}}}valueXMLList", "").split()))
        except ValueError as error:
            problems.append(Problem(text.place(), f"{quoted(name)}: {error}"))
            continue
        unit = quantity.findtext(f".//{{{SI}}}unitXMLList", "").strip()
        kind = next(iter(kinds), "")
        columns[f"{CONDITION}{name}" if kind == CONDITION else kind] = _Column(values, unit, kinds, name)
    lacking = [kind for kind in _DEMANDED if kind not in columns]
    problems += [Problem(text.place(), f"the readings lack the column {kind}") for kind in lacking]
    if not lacking:
        count = len(columns[DEVIATION].values)
        problems += [
            Problem(
                text.place(),
                f"{quoted(each.name)} has {counted(len(each.values), 'value')} for "
                f"{counted(count, 'reading')}",
            )
            for each in columns.values()
            if len(each.values) != count
        ]
    if problems:
        raise InputError(problems)
    return columns


def _find_unit(column: _Column, unit: Unit, place: Place) -> Unit:
    """Return the unit of a column, which must be that of the axis."""
    if column.unit != write_unit_of(unit):
        raise InputError.at(
            place,
            f"{quoted(column.name)} is in {column.unit}, this axis has {write_unit_of(unit)}; "
            "is axis.kind right?",
        )
    return unit


def _read_each(
    columns: Mapping[str, _Column], position: Unit, deviation: Unit, place: Place
) -> Iterator[Reading]:
    conditions = {
        kind.removeprefix(CONDITION): column for kind, column in columns.items() if kind.startswith(CONDITION)
    }
    times = columns[TIME].values if TIME in columns else None
    wrong = [value for value in columns[DIRECTION].values if value not in _APPROACHES]
    if wrong:
        raise InputError.at(place, f"{wrong[0]:g} is no direction of approach; they are 1 and -1")
    for index, direction in enumerate(columns[DIRECTION].values):
        yield Reading(
            place,
            position.to_si(columns[TARGET].values[index]),
            _APPROACHES[direction],
            columns[RUN].values[index],
            deviation.to_si(columns[DEVIATION].values[index]),
            times[index] if times else None,
            {name: _read_condition(name, column, index, place) for name, column in conditions.items()},
        )


def _read_condition(name: str, column: _Column, index: int, place: Place) -> float:
    value = column.values[index]
    known = CONDITIONS.get(name)
    if known is None or math.isnan(value):
        return value
    if column.unit != SCALES[known.unit.symbol]:
        raise InputError.at(
            place, f"{quoted(column.name)} is in {column.unit}; {SCALES[known.unit.symbol]} is read"
        )
    return known.unit.to_si(value)
