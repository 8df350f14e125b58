"""The data source ``step-gauge``: tables, bare coordinates, Calypso tables, logs of I++ DME."""

from __future__ import annotations

import csv
import math
import re
from collections.abc import Iterable
from pathlib import Path
from typing import Annotated, Literal

from pydantic import Field

from zlmreport.plugin import (
    CELSIUS,
    LENGTH_UNITS,
    MILLIMETRE,
    Finite,
    InputError,
    JobPath,
    MeasurementSet,
    Options,
    Place,
    Problem,
    Words,
    quoted,
    unit_named,
)
from zlmreport.plugin.source import SourceContext, SourceProposal, TextFile, cap_problems, read_text
from zlmreport_step_gauge.deviations import compute_deviations_of
from zlmreport_step_gauge.gauge import Face, Side, StepGauge
from zlmreport_step_gauge.keys import MachineKeys
from zlmreport_step_gauge.measurements import Sign, Targets, make_measurement_set
from zlmreport_step_gauge.probed import (
    Direction,
    Points,
    ProbedPoint,
    Unnumbered,
    arrange_on_grid,
    find_face_of,
    number_by_order,
    number_points,
    say_wrong_side,
)
from zlmreport_step_gauge.set_up import GaugeSetUp
from zlmreport_step_gauge.tables import NamedRow, read_measured, read_named_columns

_TABLE = ("face", "cycle", "x", "y", "z")
_NORMAL = ("i", "j", "k")


def read_table(path: Path, gauge: StepGauge, direction: Direction | None) -> Points:
    """Read face, cycle, x, y, z and, if there is one, the outward normal i, j, k.

    A point that was missed has its row, with empty cells for x, y and z.
    """
    table = read_named_columns(path, _TABLE, _NORMAL)
    problems = table.problems
    points = [
        found for row in table.rows if (found := _read_row(row, gauge, direction, problems)) is not None
    ]
    return Points(tuple(points), table.source, table.text.place(), tuple(problems))


def _read_row(
    row: NamedRow, gauge: StepGauge, direction: Direction | None, problems: list[Problem]
) -> ProbedPoint | None:
    face, cycle = row.read_integer("face", problems), row.read_integer("cycle", problems)
    if any(row.read_text(column) for column in _TABLE[2:]):
        coordinates = [row.read_number(column, problems) for column in _TABLE[2:]]
    else:
        coordinates = [math.nan] * 3
    if face is None or cycle is None or None in coordinates:
        return None
    if all(row.read_text(column) for column in _NORMAL):
        normal = [row.read_number(column, problems) for column in _NORMAL]
        if None not in normal:
            message = say_wrong_side([each or 0.0 for each in normal], gauge.find_face(face), direction)
            if message:
                problems.append(Problem(row.place, message))
    x, y, z = (MILLIMETRE.to_si(each) for each in coordinates if each is not None)
    return ProbedPoint(row.place, face, cycle, (x, y, z))


_PARTED = re.compile(r"[\s,;]+")


def _read_sequence(path: Path) -> tuple[TextFile, list[Unnumbered]]:
    """Read coordinates alone, x y z on a line, cycle after cycle; blanks, commas or semicolons part them."""
    text = read_text(path)
    problems: list[Problem] = []
    points = []
    for number, line in enumerate(text.lines, 1):
        written = line.partition("#")[0].strip(" \t,;")
        if not written:
            continue
        place = text.place(number, 1)
        cells = _PARTED.split(written)
        if len(cells) != 3:
            problems.append(Problem(place, f"three numbers are expected, x y z: {quoted(written)}"))
            continue
        try:
            x, y, z = (MILLIMETRE.to_si(read_measured(cell)) for cell in cells)
        except ValueError as error:
            problems.append(Problem(place, str(error)))
            continue
        points.append(Unnumbered(place, (x, y, z)))
    if problems:
        raise InputError(cap_problems(problems))
    return text, points


_CALYPSO = ("partnb", "id", "actual", "unit")
_END = "END"


def _is_calypso(header: str) -> bool:
    return set(_CALYPSO) <= set(header.split("\t"))


def _find_header(text: TextFile) -> int:
    """Return the index of the first line that is neither empty nor a comment; 0 if there is none."""
    lines = enumerate(text.lines)
    return next((index for index, line in lines if line.strip() and not line.lstrip().startswith("#")), 0)


def _read_calypso(path: Path, mapping: dict[str, int]) -> Points:
    """Read the distances in the table of characteristics of ZEISS Calypso, ``*_chr.txt``.

    Each part is a cycle, in the order in which the parts come. The layout is known from two independent
    readers. Only the columns ``partnb``, ``id``, ``actual`` and ``unit`` are used; a closing line ``END`` may
    be there or not. Distances are those of the surface.
    """
    text = read_text(path)
    first = _find_header(text)
    header = text.lines[first].split("\t")
    missing = [name for name in _CALYPSO if name not in header]
    if missing:
        raise InputError.at(
            text.place(first + 1, 1), f"the header lacks {', '.join(missing)}; columns are tabbed"
        )
    indices = {name: header.index(name) for name in _CALYPSO}
    problems: list[Problem] = []
    cycles: dict[str, int] = {}
    points = []
    for number, line in enumerate(text.lines[first + 1 :], first + 2):
        if line.strip() and line.strip() != _END:
            point = _read_characteristic(text, number, line.split("\t"), indices, mapping, cycles, problems)
            if point:
                points.append(point)
    return Points(tuple(points), text.source, text.place(), tuple(problems), is_corrected=True)


def _read_characteristic(  # noqa: PLR0913, PLR0917 - a row with what it is read by
    text: TextFile,
    line: int,
    cells: list[str],
    indices: dict[str, int],
    mapping: dict[str, int],
    cycles: dict[str, int],
    problems: list[Problem],
) -> ProbedPoint | None:
    def column(name: str) -> int:
        return sum(len(cell) + 1 for cell in cells[: indices[name]]) + 1

    if len(cells) <= max(indices.values()):
        problems.append(Problem(text.place(line, 1), "the row ends before its column unit"))
        return None
    part, name, actual, unit = (cells[indices[each]].strip() for each in _CALYPSO)
    try:
        face = find_face_of(name, mapping, text.place(line, column("id")))
        value = unit_named(unit, LENGTH_UNITS).to_si(read_measured(actual))
    except InputError as error:
        problems.extend(error.problems)
        return None
    except ValueError as error:
        problems.append(Problem(text.place(line, column("actual")), str(error)))
        return None
    cycle = cycles.setdefault(part, len(cycles) + 1)
    return ProbedPoint(text.place(line, 1), face, cycle, (value,))


_ANSWER = re.compile(r"\s*[0-9]{5}\s+[&%#!]")
_DATA = re.compile(r"\s*(?P<tag>[E\d]\d{4})\s+#\s*(?P<data>.*)")
_ERROR = re.compile(r"\s*(?P<tag>[E\d]\d{4})\s+!\s*Error\((?P<text>.*)\)\s*")
_COORDINATE = re.compile(r"\b(X|Y|Z)\(\s*([^()]*?)\s*\)")
_IJK = re.compile(r"\bIJK\(\s*([^(),]*?)\s*,\s*([^(),]*?)\s*,\s*([^(),]*?)\s*\)")


def _read_log(path: Path) -> tuple[TextFile, list[Unnumbered]]:
    """Read the measured points in the log of an I++ DME run, ``00120 # X(…), Y(…), Z(…), IJK(…)``.

    They come in the order of the log; an error that the machine answered is a defect.
    """
    text = read_text(path)
    problems: list[Problem] = []
    points = []
    for number, line in enumerate(text.lines, 1):
        place = text.place(number, 1)
        error = _ERROR.fullmatch(line)
        if error:
            problems.append(
                Problem(
                    place, f"the machine answered with an error: {error['text'][:80]}; probe this face again"
                )
            )
        data = _DATA.fullmatch(line)
        if data and _COORDINATE.search(data["data"]):
            point = _read_measured(data["data"], place, problems)
            if point:
                points.append(point)
    if problems:
        raise InputError(cap_problems(problems))
    return text, points


def _read_measured(data: str, place: Place, problems: list[Problem]) -> Unnumbered | None:
    written = dict(_COORDINATE.findall(data))
    normal = _IJK.search(data)
    if set(written) != {"X", "Y", "Z"}:
        problems.append(Problem(place, "a measured point has X, Y and Z; ask for them by OnPtMeasReport"))
        return None
    try:
        x, y, z = (MILLIMETRE.to_si(read_measured(written[name])) for name in "XYZ")
        if normal is None:
            return Unnumbered(place, (x, y, z))
        i, j, k = (read_measured(each) for each in normal.groups())
    except ValueError as error:
        problems.append(Problem(place, str(error)))
        return None
    return Unnumbered(place, (x, y, z), (i, j, k))


FaceNumber = Annotated[int, Field(ge=1)]


class StepGaugeOptions(Options):
    """Where the probed points are, and what of them is evaluated; the gauge itself stands in `step_gauge`."""

    file: JobPath = Field(description="The file of points, relative to the file that names it.")
    machine: MachineKeys | None = Field(
        None,
        description="The machine that probes the gauge live by I++ DME, for `zlmreport capture`, which "
        "writes the file of points.",
        examples=[{"host": "192.168.1.20", "tool": "RefTool"}],
    )
    layout: Literal["table", "sequence", "calypso", "ipp-dme"] | None = Field(
        None,
        description="table: face, cycle, x, y, z, i, j, k; sequence: x y z, cycle after cycle; calypso: a "
        "_chr.txt of ZEISS Calypso; ipp-dme: the log of an I++ DME run. Without it, it is told by the file.",
    )
    targets: Literal["faces", "blocks"] = Field(
        "faces",
        description="What is a target position: each face where it is, read in one direction; or each block, "
        "its front face read in the positive and its back face in the negative direction.",
    )
    side: Literal["both", "front", "back"] = Field(
        "both", description="Which faces are evaluated: front faces alone make a test in one direction."
    )
    sign: Literal["indicated-calibrated", "calibrated-indicated"] = Field(
        "indicated-calibrated",
        description="What a deviation is: by how much the machine reads too much (its error of indication, "
        "Eq. 2 and 3), or by how much the axis stands too far (actual - target, as ISO 230-2 and tables of "
        "compensation have it), which is the opposite.",
    )
    position_of_reference_face: Finite = Field(
        0.0, description="Where on the axis the reference face of the gauge lies, mm.", examples=[40]
    )
    faces: dict[str, FaceNumber] = Field(
        default_factory=dict,
        description="Calypso: number of the face by the id of the characteristic. Without it the digits at "
        "the end of the id are the number.",
        examples=[{"Step_A": 1, "Step_B": 2}],
    )


_GAUGE_ASKED = (
    "Which gauge was probed? Its calibration belongs in the file that step_gauge names at the top of the "
    "job; the deviations here are from the nominal lengths in the table."
)
_SIDES = {"both": tuple(Side), "front": (Side.FRONT,), "back": (Side.BACK,)}


class StepGaugeSource:
    """Probed faces of a step gauge: as centres of the tip, or as distances."""

    identifier = "step-gauge"
    title = Words("Probed step gauge")
    options: type[Options] = StepGaugeOptions

    def proposals(self, file: Path) -> Iterable[SourceProposal]:
        """Return how a table of Calypso is read: until its gauge is named, by the nominal lengths in it."""
        try:
            text = read_text(file)
        except InputError:
            return  # it is another source's
        first = _find_header(text)
        if _is_calypso(text.lines[first]):
            yield SourceProposal(
                asks=(_GAUGE_ASKED,),
                is_certain=True,
                beside={"step_gauge": {"calibration": "gauge.yaml"}},
                set_ups={"step_gauge": _make_nominal_set_up(text, first)},
            )

    def read(self, options: StepGaugeOptions, context: SourceContext) -> MeasurementSet:
        """Read the points and evaluate them against the gauge; raise `InputError` with every defect."""
        set_up = context.set_ups.get("step_gauge")
        if set_up is None:
            raise InputError.at(
                context.place,
                "this source needs the gauge; state step_gauge with its calibration, "
                "as in step_gauge: {calibration: gauge.yaml, initial_points: initial-points.csv}",
            )
        axis = context.axis
        if not axis.has_length:
            what = "a rotary axis" if axis.measurand.is_position else axis.measurand.identifier
            raise InputError.at(
                context.place,
                "the faces of a step gauge lie at calibrated lengths along a linear axis, and this job is "
                f"on {what}; read it by the source of the instrument that measured it",
            )
        sides = _SIDES[options.side]
        found = _read_points(options, set_up, sides)
        probed = arrange_on_grid(
            found.points, set_up.gauge, sides, place=found.place, problems=found.problems
        )
        deviations = compute_deviations_of(
            probed, set_up, found.place, is_corrected=found.is_corrected or set_up.radius_is_corrected
        )
        return make_measurement_set(
            probed,
            deviations,
            set_up,
            context.axis,
            targets=Targets(options.targets),
            sign=Sign(options.sign),
            origin=MILLIMETRE.to_si(options.position_of_reference_face),
            source=self.identifier,
            files=(found.source,),
            place=found.place,
        )


def _make_nominal_set_up(text: TextFile, first: int) -> GaugeSetUp:
    """Return a gauge of the nominal lengths in a table of Calypso, which nobody calibrated."""
    table = csv.DictReader(text.lines[first:], delimiter="\t", quoting=csv.QUOTE_NONE)
    lengths: dict[int, float] = {}
    for row in table:
        try:
            face = find_face_of((row["id"] or "").strip(), {}, text.place())
            unit = unit_named((row["unit"] or "").strip(), LENGTH_UNITS)
            lengths.setdefault(face, unit.to_si(read_measured((row.get("nominal") or "").strip())))
        except (InputError, ValueError):
            continue  # that is told where the points are read
    faces = (
        Face(number, Side.FRONT if number % 2 else Side.BACK, length, length, 0.0)
        for number, length in sorted(lengths.items())
    )
    gauge = StepGauge("", "", "", tuple(faces), None, None, CELSIUS.to_si(20.0), None, None, text.place())
    return GaugeSetUp(gauge, None, None, True, None, 0.0, None, None, (), text.place())  # noqa: FBT003


def _read_points(options: StepGaugeOptions, set_up: GaugeSetUp, sides: tuple[Side, ...]) -> Points:
    layout = options.layout or _find_layout(read_text(options.file))
    direction = set_up.located.location.direction if set_up.located else None
    if layout == "table":
        return read_table(options.file, set_up.gauge, direction)
    if layout == "calypso":
        return _read_calypso(options.file, options.faces)
    text, unnumbered = (_read_log if layout == "ipp-dme" else _read_sequence)(options.file)
    return _add_faces(text, unnumbered, set_up, sides)


def _add_faces(
    text: TextFile, unnumbered: list[Unnumbered], set_up: GaugeSetUp, sides: tuple[Side, ...]
) -> Points:
    """Return points with their faces: by where they lie, or without a location by their order."""
    if set_up.located and unnumbered:
        location = set_up.located.location
        radius = 0.0 if set_up.radius_is_corrected else set_up.tip_radius or 0.0
        points = number_points(unnumbered, set_up.gauge, location.begin, location.direction, radius)
    else:
        faces = [face for face in set_up.gauge.faces if face.side in sides]
        points = number_by_order(unnumbered, faces, text.place())
    return Points(tuple(points), text.source, text.place())


def _find_layout(text: TextFile) -> str:
    """Tell the layout by the first line that is no comment."""
    first = text.lines[_find_header(text)]
    if _is_calypso(first):
        return "calypso"
    if _ANSWER.match(first):
        return "ipp-dme"
    return "table" if any(letter.isalpha() for letter in first) else "sequence"
