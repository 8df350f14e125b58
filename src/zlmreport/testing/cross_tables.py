"""What every writer of tables across axes must do: while one axis moves, another is moved aside."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from zlmreport.language import Words
from zlmreport.measurement.arrays import FloatArray, read_only_floats
from zlmreport.measurement.units import MICROMETRE, MILLIMETRE
from zlmreport.model.compensation.curve import CrossTable
from zlmreport.plugin.kinds import CONTROLLER
from zlmreport.testing.expectations import expect, expect_words, guard_subject

#: Of a deviation, what rounding in a file may take, m.
_ROUNDING = 0.06e-6
#: Of a position likewise, m.
_PLACE = 0.6e-6
_SIGNS = ("known", "stated")


@dataclass(frozen=True, slots=True)
class CrossExample:
    """A file with one table across axes as the control's maker prints it, and what it takes away.

    Attributes
    ----------
    files
        The texts by the ends of their names, as ``cross_files`` returns them.
    input, output
        The axis that moves, and the one that is moved aside.
    rows
        Some rows of it: the position of the input axis, mm, and e = actual − nominal of the output axis, µm,
        that the control takes away there; zero at the first.
    moves
        The way in which a positive value moves the axis in it: +1, or −1.
    """

    files: Mapping[str, str]
    input: str
    output: str
    rows: tuple[tuple[float, float], ...]
    moves: int = 1


def sample_cross_tables() -> tuple[CrossTable, ...]:
    """Return tables of Y over X, bent and out of square, and of X over Z; neither begins at zero."""
    found = []
    for moving, aside, first, slope, bend in (("X", "Y", 0.05, 30e-6, 4e-6), ("Z", "X", -0.1, -20e-6, 0.0)):
        positions = first + 0.05 * np.arange(9)
        along = positions - positions[0]
        values = slope * along + bend * np.sin(np.pi * along / along[-1])
        found.append(CrossTable(moving, aside, read_only_floats(positions), read_only_floats(values), slope))
    return tuple(found)


def check_cross_files(controller: Any, example: CrossExample | None) -> None:
    """Check that files across axes, read as the control does, take away what was asked, on the right axes.

    A control that takes squareness alone gives what remains of a table: its slope. Nothing is asked of a
    control without such tables.
    """
    where = f"{controller.identifier}, across axes"
    if not hasattr(controller, "cross_files"):
        return
    expect(hasattr(controller, "read_cross"), f"{where}: what cross_files writes needs a read_cross")
    sign = getattr(controller, "cross_sign", None)
    expect(sign in _SIGNS, f"{where}: cross_sign is one of {', '.join(_SIGNS)}, not {sign!r}")
    for note in getattr(controller, "cross_notes", ()):
        expect_words(note, f"{where}: a note")
    expect(
        all(isinstance(note, Words) for note in controller.cross_notes) and controller.cross_notes,
        f"{where}: cross_notes say what who loads the files must know",
    )
    tables = sample_cross_tables()
    for moves in (1, -1) if sign == "stated" else (1,):
        files = _write_files(controller, tables, moves, where)
        _expect_taken(controller.read_cross(files, tables, moves), tables, where)
    if sign == "stated":
        files = _write_files(controller, tables, 1, where)
        wrong = controller.read_cross(files, tables, -1)
        negative = tuple(replace(each, values=-each.values, slope=-each.slope) for each in tables)
        _expect_taken(wrong, negative, f"{where}: read by who states the other sign")
        expect(
            files != _write_files(controller, tables, -1, where),
            f"{where}: the files are the same whichever way a positive value moves the axis",
        )
    _expect_axes(controller, tables, where)
    expect(
        _write_files(controller, tables, 1, where) == _write_files(controller, tables, 1, where),
        f"{where}: writing the same tables again gives other files",
    )
    _expect_example(controller, example, sign, where)


def _write_files(controller: Any, tables: Sequence[CrossTable], moves: int, where: str) -> Mapping[str, str]:
    files: Mapping[str, str] = guard_subject(controller, CONTROLLER).cross_files(tables, moves)
    is_ascii = all(text.isascii() for text in files.values())
    expect(is_ascii, f"{where}: cross_files must return texts in plain ASCII, not {files!r}")
    expect(files, f"{where}: of tables with slopes nothing is written")
    return files


def _expect_taken(decoded: Sequence[CrossTable], tables: Sequence[CrossTable], where: str) -> None:
    """Expect each table, or the slope of it, and no other."""
    expect(
        len(decoded) == len(tables) and all(isinstance(each, CrossTable) for each in decoded),
        f"{where}: read_cross must return the {len(tables)} tables that were written, not {decoded!r}",
    )
    for found, meant in zip(decoded, tables, strict=True):
        pair = f"{where}: {meant.output} over {meant.input}"
        expect(
            (found.input, found.output) == (meant.input, meant.output),
            f"{pair} is read as {found.output} over {found.input}",
        )
        expect(
            found.positions.shape == meant.positions.shape
            and np.abs(found.positions - meant.positions).max() <= _PLACE,
            f"{pair} is read at other positions: {MILLIMETRE.from_si(found.positions)} mm",
        )
        of_square = meant.slope * (meant.positions - meant.positions[0])
        off = min(_measure_off(found.values, meant.values), _measure_off(found.values, of_square))
        expect(
            off <= _ROUNDING,
            f"{pair} is read {MICROMETRE.from_si(off):.3g} µm off (sign, unit and zero of the first row)",
        )


def _measure_off(found: FloatArray, meant: FloatArray) -> float:
    return float(np.abs(found - meant).max())


def _expect_axes(controller: Any, tables: Sequence[CrossTable], where: str) -> None:
    """Expect files that say which axis moves and which is moved aside, and where: others for others."""
    first = tables[0]
    files = _write_files(controller, [first], 1, where)
    turned = replace(first, input=first.output, output=first.input)
    others = {
        "which axis moves and which is moved aside": turned,
        "of which axis": replace(first, output="Z"),
    }
    for what, other in others.items():
        expect(_write_files(controller, [other], 1, where) != files, f"{where}: the files do not say {what}")


def _expect_example(controller: Any, example: CrossExample | None, sign: Any, where: str) -> None:
    """Expect that a file of the maker is read as the control reads it; of a known sign there is one."""
    if example is None:
        expect(
            sign != "known",
            f"{where}: its sign is known: give a file as the maker prints it, and what the control takes "
            "away (ControlExample.across=CrossExample(…)); nobody else can see a sign that is wrong in both "
            "ways",
        )
        return
    at, values = (np.array(column) for column in zip(*example.rows, strict=True))
    positions, wanted = MILLIMETRE.to_si(at), MICROMETRE.to_si(values)
    expect(bool(np.any(wanted)), f"{where}: rows of the maker's file must have deviations that are not zero")
    run = float(positions[-1] - positions[0])
    blank = CrossTable(
        example.input,
        example.output,
        read_only_floats(positions),
        read_only_floats(np.zeros_like(positions)),
        float(wanted[-1] - wanted[0]) / run if run else 0.0,
    )
    (found,) = controller.read_cross(example.files, [blank], example.moves)
    read = np.array([found.at(np.array([each]))[0] for each in positions])
    expect(
        _measure_off(read, wanted) <= _ROUNDING,
        f"{where}: of the maker's file {MICROMETRE.from_si(read)} µm are read at {at} mm; the control takes "
        f"{values} µm away (sign, axes and unit are the control's)",
    )
