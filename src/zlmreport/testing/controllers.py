"""What every writer of compensation tables must do."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from zlmreport.errors import InputError, Place
from zlmreport.measurement.arrays import read_only_floats
from zlmreport.measurement.axis import Axis
from zlmreport.model.compensation.curve import CompensationTable
from zlmreport.plugin.kinds import CONTROLLER
from zlmreport.plugin.protocols import Controller
from zlmreport.testing.cross_tables import CrossExample, check_cross_files
from zlmreport.testing.expectations import (
    check,
    expect,
    expect_named,
    expect_options,
    expect_words,
    guard_subject,
    list_checks_of,
    run_all,
)

#: Where the kit asks for a table.
PLACE = Place("job.yaml", 9, 3)
#: Of half a step, what rounding may take: a half may go either way.
_HALF = 0.55
#: What decimals of a file leave open of a stated example, of a step.
_DIGITS = 0.02


@dataclass(frozen=True, slots=True)
class ControlExample:
    """A file as the control's maker prints it, and what the control takes away when it reads it.

    Attributes
    ----------
    files
        The texts by the ends of their names, as `Controller.files` returns them: of the maker's manual, or
        saved by a control whose axis was measured.
    rows
        Some rows of it: the position, mm (°), and e = actual − nominal moving forward and in reverse, µm (″),
        that the control takes away there. A deviation that it takes away moves the axis the other way. Of a
        control whose table has one column, the third number is the second.
    keys
        The job keys with which this file is written.
    deviation_step, position_step
        The finest steps in which the control takes a deviation, µm (″), and a position, mm (°).
    across
        A file with a table across axes, of a control that takes one whose sign is known.
    """

    files: Mapping[str, str]
    rows: tuple[tuple[float, float, float], ...]
    keys: Mapping[str, Any] | None = None
    deviation_step: float = 0.1
    position_step: float = 0.001
    across: CrossExample | None = None


def sample_table() -> CompensationTable:
    """Return a table of an axis X that begins at zero: forward and reverse part by 12 µm."""
    positions = 0.030125 * np.arange(11)
    forward = 4e-6 * np.sin(7 * positions) + 20e-6 * positions
    return CompensationTable(
        Axis("X"),
        "KIT-7",
        read_only_floats(positions),
        read_only_floats(forward),
        read_only_floats(forward + 12e-6),
        PLACE,
    )


@check
def is_named(controller: Controller, _keys: Mapping[str, Any], *_: Any) -> None:
    """Check its identifier, its title, its notes and its confidence."""
    expect_named(controller, CONTROLLER)
    for note in controller.notes:
        expect_words(note, f"{controller.identifier}: a note")
    known = {"verified", "documented", "unconfirmed"}
    expect(controller.confidence in known, f"{controller.identifier}: confidence is one of {sorted(known)}")


@check
def options_are_described(controller: Controller, _keys: Mapping[str, Any], *_: Any) -> None:
    """Check that its job keys are described, none is a key of the core, and all have defaults."""
    expect_options(controller, CONTROLLER)
    controller.options()


@check
def reads_what_it_writes(
    controller: Controller, keys: Mapping[str, Any], example: ControlExample | None = None
) -> None:
    """Check that its files, read as the control does, take away what was asked, where it was asked."""
    table, options = sample_table(), controller.options.model_validate(dict(keys))
    guarded = guard_subject(controller, CONTROLLER)
    files = guarded.files(table, options)
    stated = example or ControlExample({}, ())
    is_ascii = all(text.isascii() for text in files.values())
    expect(is_ascii, f"{controller.identifier}: files must be plain ASCII")
    decoded = guarded.read(files, table, options)
    rows, asked = len(decoded.positions), len(table.positions)
    expect(rows >= asked, f"{controller.identifier}: read back, the table has {rows} rows instead of {asked}")
    apart = float(np.abs(decoded.positions - table.positions[:, np.newaxis]).min(axis=1).max())
    finest = _HALF * table.axis.position_unit.to_si(stated.position_step)
    expect(
        apart <= finest,
        f"{controller.identifier}: read back, a row stands {apart:.2e} m off its position; the control takes "
        f"steps of {stated.position_step:g} mm (ControlExample.position_step)",
    )
    meant = table.at(table.positions)
    if not controller.is_directional:
        meant = np.broadcast_to(meant.mean(axis=0), meant.shape)
    difference = decoded.at(table.positions) - meant
    off = float(np.abs(difference - difference.mean()).max())  # a control may want zero at its first row
    finest = _HALF * table.axis.deviation_unit.to_si(stated.deviation_step)
    expect(
        off <= finest,
        f"{controller.identifier}: read back, the table is off by {off:.2e} m; the control takes steps of "
        f"{stated.deviation_step:g} µm (ControlExample.deviation_step)",
    )


@check
def reads_what_its_maker_prints(
    controller: Controller, _keys: Mapping[str, Any], example: ControlExample | None = None
) -> None:
    """Check that a file of the control's maker is read as the control reads it: sign, directions, units."""
    where = controller.identifier
    expect(
        example,
        f"{where}: give a file as the control's maker prints it, and what the control takes away: "
        "check_controller(…, example=ControlExample(files, rows)); nobody else can see a sign or a direction "
        "that is wrong in both ways",
    )
    assert example is not None  # noqa: S101  # said above; for type checkers
    _expect_telling(controller, example)
    axis = Axis("X")
    at, forward, reverse = (read_only_floats(column) for column in zip(*example.rows, strict=True))
    positions = axis.position_unit.to_si(at)
    meant = CompensationTable(
        axis,
        "KIT-7",
        read_only_floats(positions),
        read_only_floats(axis.deviation_unit.to_si(forward)),
        read_only_floats(axis.deviation_unit.to_si(reverse)),
        PLACE,
    )
    read = controller.read(example.files, meant, controller.options.model_validate(dict(example.keys or {})))
    apart = np.abs(read.positions - positions[:, np.newaxis]).min(axis=1, initial=np.inf)
    for row, distance in zip(example.rows, apart, strict=True):
        expect(
            distance <= axis.position_unit.to_si(_HALF * example.position_step),
            f"{where}: of the maker's file no row is read at {row[0]:g} mm, but at "
            f"{axis.position_unit.from_si(read.positions)}",
        )
    found = axis.deviation_unit.from_si(read.at(read_only_floats(positions)))
    for name, values, wanted in (("forward", found[0], forward), ("reverse", found[1], reverse)):
        for position, value, stated in zip(at, values, wanted, strict=True):
            expect(
                abs(value - stated) <= max(_DIGITS * example.deviation_step, 1e-6),
                f"{where}: of the maker's file {value:.6g} µm are read at {position:g} mm {name}; the "
                f"control takes {stated:.6g} µm away (sign, direction and unit are the control's)",
            )


def _expect_telling(controller: Controller, example: ControlExample) -> None:
    """Expect rows of which the usual mistakes would change one."""
    where = f"{controller.identifier}: rows of the maker's file"
    expect(len(example.rows) > 1, f"{where}: two are needed at least")
    sums = [forward + reverse for _, forward, reverse in example.rows]
    expect(any(sums), f"{where} must have deviations that are not zero, for a wrong sign to show")
    if controller.is_directional:
        expect(
            any(forward != reverse for _, forward, reverse in example.rows),
            f"{where} must differ forward and in reverse, for swapped directions to show",
        )


@check
def writes_the_same_again(controller: Controller, keys: Mapping[str, Any], *_: Any) -> None:
    """Check that the same table gives the same files."""
    options = controller.options.model_validate(dict(keys))
    expect(
        controller.files(sample_table(), options) == controller.files(sample_table(), options),
        f"{controller.identifier}: writing the same table again gives other files",
    )


@check
def refuses_rows_that_do_not_rise(controller: Controller, keys: Mapping[str, Any], *_: Any) -> None:
    """Check that a table whose rows coincide is refused where it is asked for, and not cut off."""
    table, options = sample_table(), controller.options.model_validate(dict(keys))
    still = replace(table, positions=read_only_floats(np.zeros_like(table.positions)))
    try:
        controller.files(still, options)
    except InputError as error:
        places = [problem.place for problem in error.problems]
        expect(places == [PLACE], f"{controller.identifier}: rows are refused elsewhere than at table.place")
    else:
        message = f"{controller.identifier}: rows that do not rise are not refused"
        raise AssertionError(message)


@check
def takes_tables_across_axes(
    controller: Controller, _keys: Mapping[str, Any], example: ControlExample | None = None
) -> None:
    """Check that its tables across axes, where it has them, take away what was asked: axes, places, sign."""
    check_cross_files(controller, example.across if example else None)


#: Every check of a controller, each called with it, its job keys, and the example of its maker.
CONTROLLER_CHECKS = list_checks_of(__name__)


def check_controller(
    controller: Controller, keys: Mapping[str, Any] | None = None, *, example: ControlExample | None = None
) -> None:
    """Run every check on a controller.

    Parameters
    ----------
    controller
        The object that the plugin's hook returns.
    keys
        Its job keys; none if they are not given.
    example
        A file of the control's maker; without it nobody can tell a wrong sign that is written and read alike,
        and the kit does not pass.

    Raises
    ------
    AssertionError
        With a line for every check that fails.
    """
    run_all(CONTROLLER, CONTROLLER_CHECKS, controller, keys or {}, example)
