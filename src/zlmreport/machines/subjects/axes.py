"""The 21 errors of a machine, and what they make of its work space: tables, and maps of which slices."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from zlmreport.document.blocks import Block, Cell, Column, Graph, Mark, Paragraph, Section, Symbol
from zlmreport.document.figures.figure import Curve, Figure, Panel, Role, Tiles
from zlmreport.language import Words, list_alternatives, list_in_words, same
from zlmreport.machines.kinematics import ERRORS
from zlmreport.machines.machine import MachineModel, find_unit_of
from zlmreport.machines.subjects.saying import Sayer, make_plain_table, make_right_column
from zlmreport.machines.volume import VolumeMap, find_measured_space, is_parted, map_volume, predict_diagonals
from zlmreport.measurement.units import MICROMETRE, MILLIMETRE
from zlmreport.model.effects.circle_design import AXES


def lay_out_errors(machine: MachineModel, say: Sayer, *, is_full: bool) -> Section:
    """Return the errors that are known, and the others: in one table, or the others in a sentence."""
    known: list[tuple[Cell, ...]] = []
    bounded: list[tuple[Cell, ...]] = []
    named: list[str] = []
    unmeasured = {each.name: each for each in machine.unmeasured}
    for name in ERRORS:
        unit, curve = find_unit_of(name), machine.find_curve(name)
        if curve is None:
            missing = unmeasured[name]
            bound = say.write_quantity(missing.bound, unit)
            named.append(f"{name} ≤ {bound}")
            origin = say(_BOUND_ASSUMED if missing.is_assumed else _BOUND)
            largest = f"≤ {say.write_general(unit.from_si(missing.bound))}"
            bounded.append((Symbol(name), largest, unit.symbol, "", "", origin))
            continue
        size = float(curve.values[0]) if curve.is_single else curve.span
        stretch = "" if curve.is_single else say.write_span(float(curve.nodes[0]), float(curve.nodes[-1]))
        places = ", ".join(
            f"{axis} {say.write_millimetres(place)}" for axis, place in curve.line.others.items()
        )
        value = say.write_pair(size, curve.largest_uncertainty, unit)
        known.append((Symbol(name), value, unit.symbol, stretch, places, curve.source or say(_STATED)))
    columns = (
        Column(say(_ERROR)), make_right_column(say(_SIZE)), Column(say(_UNIT)), Column(say(_RANGE), "mm"),
        Column(say(_LINE), "mm"), Column(say(_FROM)),
    )  # fmt: skip
    table = make_plain_table(say(_ERRORS), columns, (*known, *bounded) if is_full else known)
    title = say(_KNOWN.given(known=len(known), all=len(ERRORS)))
    blocks: list[Block] = [replace(table, dense=is_full)] if known or is_full else []
    exact = [each.name for each in machine.curves if not each.largest_uncertainty]
    if exact:
        blocks.append(Paragraph(say(_EXACT.given(errors=list_in_words(exact)))))
    unplaced = machine.lines_without_place
    if unplaced:
        blocks.append(Paragraph(say(_NO_PLACE.given(errors=list_in_words(unplaced))), Mark.OPEN))
    blocks += [Paragraph(each) for each in _tell_moved(machine, say)]
    blocks += [Paragraph(each, Mark.OPEN) for each in _tell_doubts(machine, say)]
    if is_full:
        return Section("errors", say(_ERRORS), (Paragraph(say(_NOTE)), *blocks))
    if named:
        blocks.append(Paragraph(say(_NOT_MEASURED.given(errors=", ".join(named)))))
    assumed = sum(each.is_assumed for each in machine.unmeasured)
    if assumed:
        blocks.append(Paragraph(say(_ASSUMED.given(number=assumed))))
    return Section("errors", title, tuple(blocks))


def _tell_moved(machine: MachineModel, say: Sayer) -> Iterator[str]:
    """Yield what known angles make of squareness errors that were measured elsewhere than straightness."""
    for each in machine.moved_squares:
        square, unit = machine.find_curve(each.name), find_unit_of(each.name)
        if square is None:
            continue
        yield say(
            _MOVED.given(
                square=each.name,
                measured=say.write_quantity(each.measured, unit),
                value=say.write_quantity(float(square.values[0]), unit),
                angles=list_in_words(each.angles),
            )
        )


def _tell_doubts(machine: MachineModel, say: Sayer) -> Iterator[str]:
    """Yield what angles that nobody measured leave open of squareness errors."""
    for each in machine.square_doubts:
        yield say(
            _DOUBTFUL.given(
                square=each.name,
                straightness=each.straightness,
                angles=list_in_words(each.angles),
                size=say.write_quantity(each.size, MICROMETRE),
                length=say.write_millimetres(each.length),
            )
        )


def say_known(machine: MachineModel) -> Words:
    """Return how many of the 21 errors are known."""
    return _OF.given(known=len(machine.curves), all=len(ERRORS))


def lay_out_space(machine: MachineModel, say: Sayer) -> Section:
    """Return the largest error of the work space, slices of it, and the body diagonals."""
    space = find_measured_space(machine)
    if space is None:
        parted = [axis for axis in AXES if is_parted(machine, axis)]
        said = _PARTED.given(axes=list_alternatives(parted)) if parted else _NO_SPACE
        return Section("work-space", say(_SPACE), (Paragraph(say(said)),))
    found = map_volume(machine, space)
    place = found.largest
    at = ", ".join(
        f"{axis} {say.write_millimetres(float(grid[index]))}"
        for axis, grid, index in zip(AXES, found.grids, place, strict=True)
    )
    size = say.write_pair(float(found.length[place]), float(found.expanded_uncertainty[place]), MICROMETRE)
    more = say.write_number(MICROMETRE.from_si(2.0 * float(found.bound[place])), 1)
    largest = _LARGEST.given(more=more) if machine.unmeasured else _LARGEST_OF_ALL
    box = ", ".join(
        f"{axis} {say.write_span(float(low), float(high))}"
        for axis, low, high in zip(AXES, space.low, space.high, strict=True)
    )
    rows = (
        (
            Symbol(each.name),
            say.write_micrometres(each.span),
            say.write_micrometres(float(each.expanded_uncertainty.max())),
        )
        for each in predict_diagonals(machine, space)
    )
    table = make_plain_table(
        say(_DIAGONALS),
        (Column(say(_DIAGONAL)), make_right_column("E", "µm"), make_right_column("U", "µm")),
        rows,
    )
    return Section(
        "work-space",
        say(_SPACE),
        (
            Paragraph(say(largest.given(box=box, size=size, at=at))),
            Graph(_draw_slices(found, say)),
            Paragraph(say(_DIAGONALS_NOTE)),
            table,
        ),
    )


def _draw_slices(found: VolumeMap, say: Sayer) -> Figure:
    """Return the length of Δ in slices: maps over two axes, or curves where but one was measured."""
    moving = [index for index, grid in enumerate(found.grids) if len(grid) > 1]
    return _draw_maps(found, moving, say) if len(moving) > 1 else _draw_curve(found, moving[0])


def _draw_curve(found: VolumeMap, axis: int) -> Figure:
    size, place = MICROMETRE.from_si(found.length).ravel(), MILLIMETRE.from_si(found.grids[axis])
    panel = Panel(curves=(Curve("", Role.MEAN_BIDIRECTIONAL, place, size),))
    largest = _SEEN_ON_A_LINE.given(largest=float(np.round(size.max(), 2)))
    return Figure(
        "work-space", _LENGTH_OF, largest, same(AXES[axis]), _LENGTH_OF, "mm", "µm", (panel,), height=60.0
    )


def _draw_maps(found: VolumeMap, moving: list[int], say: Sayer) -> Figure:
    """Return maps over the first two axes that move: at both ends and in the middle of the third."""
    first, second, *third = moving
    size = MICROMETRE.from_si(found.length)
    across, upwards = (MILLIMETRE.from_si(found.grids[each]) for each in (first, second))
    darkest = float(size.max()) or 1.0
    panels = []
    for slice_ in sorted({0, size.shape[third[0]] // 2, size.shape[third[0]] - 1}) if third else (0,):
        still = ({0, 1, 2} - {first, second}).pop()
        place = say.write_millimetres(float(found.grids[still][slice_]))
        values = np.take(size, slice_, axis=still)
        panels.append(
            Panel(heading=same(f"{AXES[still]} = {place} mm"), tiles=Tiles(across, upwards, values, darkest))
        )
    largest = _SEEN.given(number=len(panels), largest=float(np.round(darkest, 2)))
    return Figure(
        "work-space", _SLICES, largest, same(AXES[first]), same(AXES[second]), "mm", "mm", tuple(panels),
        height=_MAP_HEIGHT, is_wide=True,
    )  # fmt: skip


#: Of maps beside each other, mm.
_MAP_HEIGHT = 72.0
_ERRORS = Words("The 21 errors of the axes")
_KNOWN = Words("{known} of {all} errors are known")
_OF = Words("{known} of {all}")
_NOTE = Words(
    "Size is the span of the curve, of a squareness error its value; ± is U, k = 2. An error that nobody "
    "measured is bounded and never taken as zero."
)
_NO_PLACE = Words(
    "Of {errors} nobody says where the other axes stood (at): arms of the known angles count from 0 there."
)
_EXACT = Words(
    "No uncertainty is known of {errors}: neither repeats nor an instrument tell it. What is predicted takes "
    "them as exact."
)
_STATED = Words("stated")
_MOVED = Words(
    "{square} was measured at another place than the model has it (the tool's offset, or where the other "
    "axes stood): {measured} there are {value} here, by the known {angles}."
)
_DOUBTFUL = Words(
    "{square} was measured at another place than {straightness} (the tool's offset, or where the other axes "
    "stood): angles that nobody measured ({angles}) may make up to {size} of it over {length} mm. Measure "
    "them, or both at one place."
)
_NOT_MEASURED = Words("Not measured, taken as bounded: {errors}")
_ASSUMED = Words(
    "{number} of these bounds is an assumption of this program; the machine file (bounds) states your own.",
    plural="{number} of these bounds are assumptions of this program; the machine file (bounds) states your "
    "own.",
)
_ERROR, _SIZE = Words("Error"), Words("Size")
_UNIT, _RANGE = Words("Unit"), Words("Range")
_LINE, _FROM = Words("Line at"), Words("From")
_BOUND = Words("not measured, stated bound")
_BOUND_ASSUMED = Words("not measured, assumed bound")
_SPACE = Words("Work space")
_NO_SPACE = Words("No work space: the errors of no axis were measured over a range.")
_PARTED = Words(
    "No work space: no place of {axes} lies within the ranges of all errors that were measured of it."
)
_LARGEST = Words(
    "In {box} mm the largest error, relative to the middle, is ({size}) µm at {at} mm; errors that "
    "nobody measured may add ± {more} µm."
)
_LARGEST_OF_ALL = Words("In {box} mm the largest error, relative to the middle, is ({size}) µm at {at} mm.")
_DIAGONALS = Words("Body diagonals, predicted")
_DIAGONAL = Words("Diagonal")
_DIAGONALS_NOTE = Words(
    "E is the span of what the errors predict along a body diagonal, U its largest uncertainty there. A "
    "small diagonal error does not mean a small volumetric error: opposite scales cancel."
)
_SLICES = Words("Length of the error in slices of the work space, in µm: the darker, the larger")
_SEEN = Words(
    "Map of {number} slice, values written on it; the largest value is {largest} µm.",
    plural="Maps of {number} slices, values written on them; the largest value is {largest} µm.",
)
_SEEN_ON_A_LINE = Words("A curve over the axis; the largest value is {largest} µm.")
_LENGTH_OF = Words("Length of the error")
