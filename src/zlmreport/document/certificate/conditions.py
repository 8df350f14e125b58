"""The section on what was measured, and how: machine, axis, instruments, environment, corrections."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from zlmreport.document.blocks import Align, Block, Cell, Column, Facts, Paragraph, RowGroup, Section, Table
from zlmreport.document.certificate.circle_facts import describe_circle, list_circle_facts
from zlmreport.document.certificate.circumstances import (
    Fact,
    list_environment_facts,
    list_measurement_facts,
    select_stated_facts,
    write_date,
    write_extent,
    write_with_unit,
)
from zlmreport.language import Words, join_parts
from zlmreport.measurement import units
from zlmreport.measurement.axis import AxisKind
from zlmreport.measurement.measurand import POSITIONING, Coordinate

if TYPE_CHECKING:
    from zlmreport.document.writer import Writer
    from zlmreport.job.job import Job
    from zlmreport.job.keys import JobKeys
    from zlmreport.job.measurement_keys import CompensatesKeys, InstrumentKeys
    from zlmreport.measurement.measurement_set import MeasurementSet

TITLE = Words("Item, method and conditions")

_MACHINE_TOOL = Words("machine tool")
_MACHINE_KINDS = {
    "machine tool": _MACHINE_TOOL,
    "coordinate measuring machine": Words("coordinate measuring machine"),
    "surface plate": Words("surface plate"),
}

AXIS_KINDS = {AxisKind.LINEAR: Words("linear axis"), AxisKind.ROTARY: Words("rotary axis")}

_NO_INFLUENCE = Words("The laboratory names no environmental condition that influenced the results.")
_CAPTION = Words("Corrections applied to the readings")
_ALL_CORRECTED = Words(
    "Every deviation in this document is a corrected one. The readings as they were displayed are in the"
    " files from which it was made."
)


@dataclass(frozen=True, slots=True)
class Described:
    """What an extension says of its group of job keys: facts below a heading, and blocks at the end."""

    heading: Words
    facts: tuple[Fact, ...]
    blocks: tuple[Block, ...] = ()


def lay_out_conditions(
    job: Job, measurements: MeasurementSet, described: Sequence[Described], writer: Writer
) -> Section:
    """Return the section on the item, the method, the instrument and the environment."""
    blocks = (
        *(group for _, group in list_groups(job, measurements, described, writer)),
        *say_no_influence(job, measurements, writer),
        *list_besides(measurements, described, writer),
    )
    return Section("conditions", writer.say(TITLE), blocks)


def list_groups_beside_identification(
    job: Job, measurements: MeasurementSet, described: Sequence[Described], writer: Writer
) -> Iterator[tuple[str, Facts]]:
    """Yield the groups of which not everything stands in an identification of the machine in one line."""
    said = find_identified(job, writer)
    for key, group in list_groups(job, measurements, described, writer):
        if any(value not in said for _, value in group.pairs):
            yield key, group


def list_groups(
    job: Job, measurements: MeasurementSet, described: Sequence[Described], writer: Writer
) -> Iterator[tuple[str, Facts]]:
    """Yield the groups of what is stated, each with its job key; an extension's with an empty one."""
    keys = job.keys
    environment = list_environment_facts(keys.environment, measurements, writer, "environment")
    all_of_them = (
        ("machine", Words("Machine"), _list_machine_facts(job, writer)),
        _describe_what_moved(job, writer),
        ("measurement", Words("Measurement"), _list_measurement_facts(keys, measurements, writer)),
        (
            "instrument",
            Words("Measuring instrument"),
            _list_instrument_facts(keys.instrument, measurements, writer),
        ),
        *(("", each.heading, each.facts) for each in described),
        ("environment", Words("Environment"), environment),
    )
    for key, heading, group in all_of_them:
        if pairs := select_stated_facts(group, writer):
            yield key, Facts(pairs, writer.say(heading))


def say_no_influence(job: Job, measurements: MeasurementSet, writer: Writer) -> Iterator[Paragraph]:
    """Yield that a certificate names no condition of the environment, where it states none."""
    environment = list_environment_facts(job.keys.environment, measurements, writer, "environment")
    if job.keys.certificate.kind == "certificate" and not select_stated_facts(environment, writer):
        yield Paragraph(writer.say(_NO_INFLUENCE))


def name_machine_kind(job: Job, writer: Writer) -> str:
    """Return what kind of machine, or other item, a document is on: as stated, or else as is usual."""
    stated = job.keys.machine.kind
    return writer.say(_MACHINE_KINDS[stated] if stated else job.axis.measurand.item or _MACHINE_TOOL)


def find_identified(job: Job, writer: Writer) -> frozenset[str]:
    """Return what an identification of the machine says in one line."""
    machine = job.keys.machine
    kind = name_machine_kind(job, writer)
    return frozenset({machine.manufacturer or "", machine.model or "", machine.serial or "", kind})


def list_besides(
    measurements: MeasurementSet, described: Sequence[Described], writer: Writer
) -> Iterator[Block]:
    """Yield what does not fit into facts: corrections, and what extensions show."""
    yield from lay_out_corrections(measurements, writer)
    yield from (block for each in described for block in each.blocks)


def describe_axis(job: Job, writer: Writer) -> str:
    """Write the axis's name and kind; of a circle, which one; of sensors, and of lines, their names."""
    if job.keys.circle is not None:
        return describe_circle(job.keys.circle, writer)
    if job.axis.measurand.coordinate is Coordinate.TIME or _is_along_lines(job):
        return job.axis.name
    words = Words("{name} ({kind})")
    return writer.say(words.given(name=job.axis.name, kind=AXIS_KINDS[job.axis.kind]))


def _is_along_lines(job: Job) -> bool:
    """Return whether what was measured lies along lines of their own, as diagonals or those of a plate."""
    return job.axis.measurand.bearer != POSITIONING.bearer


def _list_machine_facts(job: Job, writer: Writer) -> Iterator[Fact]:
    machine = job.keys.machine
    kind = name_machine_kind(job, writer)
    yield Fact(Words("Manufacturer"), machine.manufacturer, ("machine.manufacturer",))
    yield Fact(Words("Model", context="type of machine"), machine.model, ("machine.model",))
    yield Fact(Words("Serial number"), machine.serial, ("machine.serial",))
    yield Fact(Words("Kind"), kind, ("machine.kind",))
    yield Fact(Words("Location"), machine.location, ("machine.location",))
    yield Fact(Words("Condition"), machine.condition, ("machine.condition",))


def say_measured_of(job: Job) -> Words:
    """Return what was measured of, as a heading: an axis, two on a circle, sensors over time, or lines."""
    if job.keys.circle is not None:
        return Words("Circle")
    if job.axis.measurand.coordinate is Coordinate.TIME:
        joins = job.axis.measurand.joins_tests
        return Words("Sensors") if joins else Words("Sensor")
    if _is_along_lines(job):
        return Words("Lines") if job.axis.measurand.joins_tests else Words("Line")
    return Words("Axis")


def _describe_what_moved(job: Job, writer: Writer) -> tuple[str, Words, Iterator[Fact]]:
    """Return the group on what moved: its job key, its heading and its facts."""
    if job.keys.circle is not None:
        return "circle", say_measured_of(job), list_circle_facts(job.keys.circle, writer)
    return "axis", say_measured_of(job), _list_axis_facts(job, writer)


def _list_axis_facts(job: Job, writer: Writer) -> Iterator[Fact]:
    axis, keys = job.axis, job.keys.axis
    yield Fact(say_measured_of(job), describe_axis(job, writer), ("axis.name", "axis.kind"))
    if axis.travel is not None:
        unit = writer.position_unit
        travel = write_extent([unit.from_si(end) for end in axis.travel], unit.symbol, writer)
        is_rotary = axis.kind is AxisKind.ROTARY
        yield Fact(Words("Angular travel") if is_rotary else Words("Travel"), travel, ("axis.travel",))
    for name, length, key in (
        (Words("Screw or gear pitch"), axis.screw_pitch, "screw_pitch"),
        (Words("Signal period of the scale"), axis.signal_period, "signal_period"),
        (Words("Length of a scale element"), axis.scale_element, "scale_element"),
        (Words("Distance of like poles"), axis.pole_pitch, "pole_pitch"),
    ):
        yield Fact(name, None if length is None else writer.length(length), (f"axis.{key}",))
    yield Fact(
        Words("Compensation table"),
        _write_table(keys.compensation_table, writer),
        ("axis.compensation_table",),
    )
    yield Fact(Words("Angular errors"), _write_table(keys.angular_errors, writer), ("axis.angular_errors",))
    yield Fact(
        Words("Distance of the measuring line from the scale"),
        write_with_unit(keys.abbe_offset, "mm", writer),
        ("axis.abbe_offset",),
    )


def _write_table(stated: str | Path | None, writer: Writer) -> str | None:
    """Write the table that was active during the test; the word for none."""
    if isinstance(stated, Path):
        return stated.name
    return writer.say(Words("none")) if stated else None


def _list_measurement_facts(keys: JobKeys, measurements: MeasurementSet, writer: Writer) -> Iterator[Fact]:
    yield from list_measurement_facts(keys.measurement, measurements, writer, "measurement")
    yield Fact(Words("Procedure"), keys.procedure)
    yield Fact(Words("Sampling"), keys.sampling, ("sampling",))
    yield Fact(Words("Date of sampling"), write_date(keys.dates.sampled, writer), ("dates.sampled",))


def _list_instrument_facts(
    instrument: InstrumentKeys | None, measurements: MeasurementSet, writer: Writer
) -> Iterator[Fact]:
    """Yield what is stated of the instrument; its U of several lines with each of them, in their units."""
    if instrument is None:
        return
    for name, value, key in (
        (Words("Instrument"), instrument.name, "name"),
        (Words("Manufacturer"), instrument.manufacturer, "manufacturer"),
        (Words("Serial number"), instrument.serial, "serial"),
        (Words("Calibration certificate"), instrument.certificate, "certificate"),
        (Words("Calibrated"), write_date(instrument.calibrated, writer), "calibrated"),
        (Words("Calibration due"), write_date(instrument.due, writer), "due"),
        (Words("Calibrated range"), _write_range(instrument, measurements, writer), "calibrated_range"),
    ):
        yield Fact(name, value, (f"instrument.{key}",))
    yield Fact(
        Words("Expanded uncertainty"),
        None if measurements.tests else _write_uncertainty(instrument, writer),
        ("instrument.expanded_uncertainty", "instrument.expanded_uncertainty_per_metre"),
    )
    yield Fact(
        Words("Expansion coefficient of the instrument"),
        write_with_unit(instrument.expansion_coefficient, "µm/(m·K)", writer),
        ("instrument.expansion_coefficient",),
    )
    yield Fact(Words("Compensation by the instrument"), instrument.compensation, ("instrument.compensation",))
    yield Fact(
        Words("Corrected by the instrument"),
        _write_compensates(instrument.compensates, writer),
        ("instrument.compensates",),
    )


def _write_range(instrument: InstrumentKeys, measurements: MeasurementSet, writer: Writer) -> str | None:
    """Write from where to where an instrument is calibrated; None where the job does not tell."""
    extent = instrument.calibrated_range
    axis = measurements.lines[0].axis
    unit = axis.position_unit if axis.measurand.is_position else axis.deviation_unit
    return write_extent(extent, unit.symbol, writer) if extent else None


_MATERIAL = Words("material to 20 °C by α = {alpha} µm/(m·K)")
_AIR = Words("refractive index of the air")
_NOTHING = Words("nothing")


def _write_compensates(keys: CompensatesKeys | None, writer: Writer) -> str | None:
    """Write what the instrument has corrected already; None where the job does not tell."""
    if keys is None:
        return None
    parts = [_MATERIAL.given(alpha=keys.material)] if keys.material else []
    if keys.air:
        parts.append(_AIR)
    return join_parts(map(writer.say, parts), writer.language) or writer.say(_NOTHING)


def _write_uncertainty(instrument: InstrumentKeys, writer: Writer) -> str | None:
    """Write the instrument's expanded uncertainty, with its part that grows with the length."""
    stated, unit = instrument.stated_uncertainty, writer.deviation_unit.symbol
    if stated is None:
        fixed = instrument.expanded_uncertainty
        return fixed if isinstance(fixed, str) else None
    constant, per_metre = stated
    parts = [write_with_unit(constant, unit, writer)] if constant or not per_metre else []
    if per_metre:
        parts.append(f"{writer.number(per_metre)}{units.write_behind(unit)}/m · L")
    return f"U = {' + '.join(filter(None, parts))} (k = 2)"


def lay_out_corrections(measurements: MeasurementSet, writer: Writer) -> Iterator[Block]:
    """Yield what was corrected, in its order; nothing where the readings are as they were read."""
    corrections = measurements.provenance.corrections
    if not corrections:
        return
    columns = (
        Column(writer.say(Words("Correction"))),
        Column(writer.say(Words("By"))),
        Column(writer.say(Words("From")) + writer.marks.write_after("environment", "corrections")),
        Column(writer.say(Words("Largest")), writer.deviation_unit.symbol, Align.RIGHT),
    )
    rows: tuple[tuple[Cell, ...], ...] = tuple(
        (
            writer.say(each.name),
            writer.say(each.method),
            writer.say(each.inputs),
            writer.deviation(each.largest),
        )
        for each in corrections
    )
    yield Table(writer.say(_CAPTION), columns, (RowGroup(rows),))
    yield Paragraph(writer.say(_ALL_CORRECTED))
