"""Reads the calibration file of a step gauge: YAML with all facts, or a CSV table of the faces."""

from __future__ import annotations

import itertools
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Literal

from pydantic import Field

from zlmreport.plugin import (
    CELSIUS,
    MICROMETRE,
    MICROMETRE_PER_METRE_KELVIN,
    MILLIMETRE,
    Date,
    Finite,
    InputError,
    JobPart,
    NotNegative,
    Place,
    Positive,
    Problem,
    TextLine,
    counted,
)
from zlmreport.plugin.extension import (
    FileFormat,
    JobInstrument,
    JobKeys,
    KeysFile,
    is_named_as_yaml,
    read_keys_file,
)
from zlmreport.plugin.source import SourceFile
from zlmreport_step_gauge.gauge import Face, Side, StepGauge
from zlmreport_step_gauge.keys import Temperature
from zlmreport_step_gauge.tables import NamedRow, NamedTable, read_named_columns

#: Of the file that a gauge's calibration is.
FORMAT = FileFormat(
    "zlmreport/step-gauge/1", "the calibration of a step gauge", "step_gauge.calibration of a job"
)
_COLUMNS = ("face", "side", "nominal_mm", "calibrated_mm", "U_k2_um")
_SIDES = {"front": Side.FRONT, "back": Side.BACK}
_REFERENCE_CELSIUS = 20.0
#: Of the distance between neighbouring faces: a calibrated face lies no farther from its nominal place.
_MOST_OF_A_STEP = 0.1


class FaceKeys(JobPart):
    """A calibrated face."""

    face: int = Field(ge=1, description="Its number, from 1 at the beginning of the gauge.", examples=[1])
    side: Literal["front", "back"] = Field(description="front: the face nearer to the beginning.")
    nominal: Finite = Field(description="Nominal distance from the reference face, mm.", examples=[10])
    calibrated: Finite = Field(description="Calibrated distance, mm.", examples=[9.99962])
    expanded_uncertainty: NotNegative = Field(
        description="Of the calibrated distance (k = 2), micrometres.", examples=[0.21]
    )


class BlockKeys(JobPart):
    """The size of the blocks across the gauge."""

    width: Positive | None = Field(None, description="mm", examples=[20])
    height: Positive | None = Field(None, description="mm", examples=[15])


class StepGaugeFileKeys(JobPart):
    """A calibrated step gauge."""

    schema_: Literal["zlmreport/step-gauge/1"] = Field(
        alias="schema", description="Version of this format.", examples=["zlmreport/step-gauge/1"]
    )
    name: TextLine = Field(description="Type designation.", examples=["Step gauge 420"])
    manufacturer: TextLine | None = Field(None, description="Who built it.")
    serial: TextLine | None = Field(None, description="Serial number.")
    certificate: TextLine | None = Field(None, description="Its calibration certificate.")
    calibrated: Date | None = Field(None, description="Date of that calibration.", examples=["2026-02-10"])
    due: Date | None = Field(
        None, description="When it is due to be calibrated again.", examples=["2028-02-10"]
    )
    support: TextLine | None = Field(
        None, description="How it was supported.", examples=["at its Bessel points"]
    )
    expansion_coefficient: Finite | None = Field(None, description="α, micrometres/(m K).", examples=[11.5])
    expansion_coefficient_uncertainty: NotNegative | None = Field(
        None, description="Standard uncertainty of α, micrometres/(m K).", examples=[0.5]
    )
    reference_temperature: Temperature = Field(20.0, description="At which the distances hold, °C.")
    block: BlockKeys = Field(
        default_factory=BlockKeys,
        description="The size of the blocks across the gauge.",
        examples=[{"width": 20, "height": 15}],
    )
    faces: list[FaceKeys] = Field(
        min_length=4,
        max_length=2000,
        description="The faces from the beginning of the gauge.",
        examples=[[{"face": 1, "side": "front", "nominal": 0, "calibrated": 0, "expanded_uncertainty": 0.2}]],
    )


@dataclass(frozen=True, slots=True)
class CalibratedGauge:
    """A gauge with the file that its calibration was read from."""

    gauge: StepGauge
    file: SourceFile


@dataclass(frozen=True, slots=True)
class _Listed:
    """A face as a file lists it."""

    face: Face
    place: Place


def read_calibration(path: Path) -> CalibratedGauge:
    """Read a gauge's calibration.

    Raises `AccessError` if a file cannot be read; `InputError` with every defect and its place: blocks out of
    order, a face that is missing or stands on the wrong side, distances that do not rise or lie far from
    their nominal place.
    """
    if not is_named_as_yaml(path):
        return _read_table(path)
    file = read_keys_file(path, StepGaugeFileKeys, FORMAT)
    keys = file.keys
    gauge = StepGauge(
        name=keys.name,
        serial=keys.serial or "",
        certificate=keys.certificate or "",
        faces=_check_faces(list(_read_stated(file)), file.place_of("faces")),
        expansion_coefficient=_read_per_kelvin(keys.expansion_coefficient),
        expansion_uncertainty=_read_per_kelvin(keys.expansion_coefficient_uncertainty),
        reference_temperature=CELSIUS.to_si(keys.reference_temperature),
        block_width=_read_metres(keys.block.width),
        block_height=_read_metres(keys.block.height),
        place=Place(str(path)),
    )
    return CalibratedGauge(gauge, file.file)


def cut_section(gauge: StepGauge, first_block: int | None, last_block: int | None, place: Place) -> StepGauge:
    """Return the part of a gauge from one block to another, both included.

    `first_block`, `last_block`: Numbers of blocks; None for the first and the last of the gauge.

    Raises `InputError` if the gauge lacks one of them, or the section has no two blocks.
    """
    blocks = gauge.blocks
    first = blocks[0] if first_block is None else first_block
    last = blocks[-1] if last_block is None else last_block
    for block in (first, last):
        if block not in blocks:
            raise InputError.at(
                place,
                f"the section begins or ends with block {block}, and {gauge.place.file} has the blocks "
                f"{blocks[0]} to {blocks[-1]}",
            )
    if first >= last:
        raise InputError.at(
            place, f"the section from block {first} to block {last} has no two blocks; its end lies behind"
        )
    return replace(gauge, faces=tuple(face for face in gauge.faces if first <= face.block <= last))


def _read_per_kelvin(value: float | None) -> float | None:
    return None if value is None else value * MICROMETRE_PER_METRE_KELVIN


def _read_metres(value: float | None) -> float | None:
    return None if value is None else MILLIMETRE.to_si(value)


def _read_stated(file: KeysFile[StepGaugeFileKeys]) -> Iterator[_Listed]:
    for index, each in enumerate(file.keys.faces):
        face = Face(
            each.face,
            _SIDES[each.side],
            MILLIMETRE.to_si(each.nominal),
            MILLIMETRE.to_si(each.calibrated),
            MICROMETRE.to_si(each.expanded_uncertainty),
        )
        yield _Listed(face, file.place_of("faces", index, "face"))


def _read_table(path: Path) -> CalibratedGauge:
    """Return the gauge of a table: of its material it says nothing."""
    table = read_named_columns(path, _COLUMNS)
    problems = table.problems
    listed = [each for row in table.rows if (each := _read_face(row, problems))]
    if problems:
        raise InputError(sorted(problems))
    gauge = StepGauge(
        name=path.name,
        serial="",
        certificate="",
        faces=_check_faces(listed, _end(table)),
        expansion_coefficient=None,
        expansion_uncertainty=None,
        reference_temperature=CELSIUS.to_si(_REFERENCE_CELSIUS),
        block_width=None,
        block_height=None,
        place=Place(str(path)),
    )
    return CalibratedGauge(gauge, table.source)


def _end(table: NamedTable) -> Place:
    return table.rows[-1].place if table.rows else table.text.place()


def _read_face(row: NamedRow, problems: list[Problem]) -> _Listed | None:
    number = row.read_integer("face", problems)
    nominal, calibrated, expanded = (row.read_number(column, problems) for column in _COLUMNS[2:])
    side = _SIDES.get(row.read_text("side").casefold())
    if side is None:
        problems.append(Problem(row.cells["side"].place, "column side: front or back is expected"))
    if expanded is not None and expanded < 0:
        problems.append(Problem(row.cells["U_k2_um"].place, "an uncertainty is not negative"))
    if None in {number, nominal, calibrated, expanded} or side is None:
        return None
    face = Face(
        number or 0,
        side,
        MILLIMETRE.to_si(nominal or 0.0),
        MILLIMETRE.to_si(calibrated or 0.0),
        MICROMETRE.to_si(expanded or 0.0),
    )
    return _Listed(face, row.cells["face"].place)


def _check_faces(listed: Sequence[_Listed], end: Place) -> tuple[Face, ...]:
    """Return the faces of whole blocks in their order, or raise InputError."""
    problems = list(_find_out_of_order(listed))
    if not problems:
        problems = list(_find_unlike_a_gauge(listed))
    if not problems and (len(listed) < 4 or len(listed) % 2):
        problems.append(
            Problem(
                end,
                f"the calibration ends after {counted(len(listed), 'face')}; a gauge has two blocks at "
                "least, and each block a front and a back face",
            )
        )
    if not problems and not any(each.face.expanded_uncertainty for each in listed):
        problems.append(
            Problem(
                listed[0].place,
                "U is 0 at every face; write those of the calibration certificate (k = 2): of the face from "
                "which distances count it may be 0",
            )
        )
    if problems:
        raise InputError(sorted(problems))
    return tuple(each.face for each in listed)


def _find_out_of_order(listed: Sequence[_Listed]) -> Iterator[Problem]:
    """Yield the faces that do not follow the one before them, or are on the wrong side for their number."""
    for index, each in enumerate(listed):
        number = each.face.number
        expected = listed[index - 1].face.number + 1 if index else number
        if number != expected:
            yield Problem(each.place, f"face {number} stands where face {expected} is expected")
        elif index == 0 and number % 2 == 0:
            yield Problem(each.place, f"the calibration begins with face {number}, the back of a block")
        elif (number % 2 == 1) != (each.face.side is Side.FRONT):
            right = "front" if number % 2 else "back"
            yield Problem(
                each.place,
                f"face {number} is a {right} face: block b has the front face 2b − 1 and the back face 2b; "
                "was a face left out, or the gauge read from its other end?",
            )


def _find_unlike_a_gauge(listed: Sequence[_Listed]) -> Iterator[Problem]:
    for earlier, each in itertools.pairwise(listed):
        if each.face.nominal <= earlier.face.nominal:
            yield Problem(
                each.place,
                f"face {each.face.number} lies at {MILLIMETRE.from_si(each.face.nominal):.9g} mm, not behind "
                f"face {earlier.face.number}; distances rise from the beginning of the gauge",
            )
    if len(listed) < 2:
        return
    steps = [b.face.nominal - a.face.nominal for a, b in itertools.pairwise(listed)]
    largest = _MOST_OF_A_STEP * min(steps)
    for each in listed:
        departure = each.face.distance - each.face.nominal
        if abs(departure) > largest > 0:
            yield Problem(
                each.place,
                f"the calibrated distance of face {each.face.number} is "
                f"{MICROMETRE.from_si(departure):.6g} µm from the nominal one; is the unit right?",
            )


def name_gauge_as_instrument(keys: JobKeys, calibration: Path) -> JobKeys:
    """Return the keys of a job whose step gauge is its measuring instrument, unless it names another.

    The gauge's uncertainty as an instrument is that of the face whose distance is known worst; the budget
    takes each face by itself.

    Raises `InputError` with every mistake of the calibration file; `AccessError` if it cannot be read.
    """
    if keys.instrument or not is_named_as_yaml(calibration):
        return keys
    gauge = read_keys_file(calibration, StepGaugeFileKeys, FORMAT).keys
    instrument = JobInstrument(
        name=gauge.name,
        manufacturer=gauge.manufacturer,
        serial=gauge.serial,
        certificate=gauge.certificate,
        calibrated=gauge.calibrated,
        due=gauge.due,
        expanded_uncertainty=max(face.expanded_uncertainty for face in gauge.faces) or None,
        expansion_coefficient=gauge.expansion_coefficient,
    )
    return keys.model_copy(update={"instrument": instrument})
