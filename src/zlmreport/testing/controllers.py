"""What every writer of compensation tables must do."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import Any

import numpy as np

from zlmreport.errors import InputError, Place
from zlmreport.measurement.arrays import read_only_floats
from zlmreport.measurement.axis import Axis
from zlmreport.model.compensation.curve import CompensationTable
from zlmreport.plugin.protocols import Controller
from zlmreport.testing.expectations import (
    check,
    expect,
    expect_members,
    expect_named,
    expect_options,
    expect_words,
    run_all,
)

#: Where the kit asks for a table.
PLACE = Place("job.yaml", 9, 3)
#: Half of the coarsest step in which a control takes a deviation, m.
_HALF_A_QUANTUM = 0.55e-6


def sample_table(rows: int = 11, step: float = 0.03) -> CompensationTable:
    """Return a table of an axis X that begins at zero: forward and reverse part by 12 µm."""
    positions = step * np.arange(rows)
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
def is_named(controller: Controller, _keys: Mapping[str, Any]) -> None:
    """Check its identifier, its title, its notes and its confidence."""
    expect_named(controller, Controller)
    for note in controller.notes:
        expect_words(note, f"{controller.identifier}: a note")
    known = {"verified", "documented", "unconfirmed"}
    expect(controller.confidence in known, f"{controller.identifier}: confidence is one of {sorted(known)}")


@check
def options_are_described(controller: Controller, _keys: Mapping[str, Any]) -> None:
    """Check that its job keys are described, none is a key of the core, and all have defaults."""
    expect_options(controller, frozenset({"controller"}))
    controller.options()


@check
def reads_what_it_writes(controller: Controller, keys: Mapping[str, Any]) -> None:
    """Check that its files, read as the control does, take away what was asked, with the same sign."""
    table, options = sample_table(), controller.options.model_validate(dict(keys))
    files = controller.files(table, options)
    expect(
        isinstance(files, Mapping) and all(isinstance(text, str) for text in files.values()),
        f"{controller.identifier}: files must return texts by the ends of their names, not {files!r}",
    )
    expect(
        files and all(text.isascii() for text in files.values()),
        f"{controller.identifier}: files must be plain ASCII",
    )
    decoded = controller.read(files, table, options)
    expect(
        isinstance(decoded, CompensationTable),
        f"{controller.identifier}: read must return a CompensationTable, not {decoded!r}",
    )
    rows, asked = len(decoded.positions), len(table.positions)
    expect(rows >= asked, f"{controller.identifier}: read back, the table has {rows} rows instead of {asked}")
    meant = table.at(table.positions)
    if not controller.is_directional:
        meant = np.broadcast_to(meant.mean(axis=0), meant.shape)
    difference = decoded.at(table.positions) - meant
    off = float(np.abs(difference - difference.mean()).max())  # a control may want zero at its first row
    expect(off <= _HALF_A_QUANTUM, f"{controller.identifier}: read back, the table is off by {off:.2e} m")


@check
def writes_the_same_again(controller: Controller, keys: Mapping[str, Any]) -> None:
    """Check that the same table gives the same files."""
    options = controller.options.model_validate(dict(keys))
    expect(
        controller.files(sample_table(), options) == controller.files(sample_table(), options),
        f"{controller.identifier}: writing the same table again gives other files",
    )


@check
def refuses_rows_that_do_not_rise(controller: Controller, keys: Mapping[str, Any]) -> None:
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


#: Every check of a controller, each called with it and its job keys.
CONTROLLER_CHECKS = (
    is_named,
    options_are_described,
    reads_what_it_writes,
    writes_the_same_again,
    refuses_rows_that_do_not_rise,
)


def check_controller(controller: Controller, keys: Mapping[str, Any] | None = None) -> None:
    """Run every check on a controller; raise `AssertionError` with a line for every check that fails."""
    expect_members(controller, Controller)
    run_all(CONTROLLER_CHECKS, controller, keys or {})
