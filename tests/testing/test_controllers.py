"""Each check of a controller passes the exemplary one, and finds the sin it is there for."""

from __future__ import annotations

import itertools
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from pydantic import Field

from refusals import failure
from testing.sinning import make_sinner, make_tests
from zlmreport.plugin import InputError, Options, Place, Words, read_only_floats
from zlmreport.plugin.controller import CompensationTable, CrossTable
from zlmreport.testing import (
    CONTROLLER_CHECKS,
    ControlExample,
    CrossExample,
    check_controller,
    controllers,
)

COUNTER = itertools.count()


class ExemplaryController:
    """Rows of position (mm) and correction in both directions (µm), which the control adds."""

    identifier = "exemplary-control"
    title = Words(en="An exemplary control", de="Eine vorbildliche Steuerung")
    options: Any = Options
    confidence = "documented"
    is_directional = True
    is_equidistant = False
    notes: Any = (Words(en="Copy the file.", de="Datei kopieren."),)

    def files(self, table: CompensationTable, _options: Any) -> Mapping[str, str]:
        if np.any(np.diff(table.positions) <= 0):
            raise InputError.at(table.place, "rows must rise")
        rows = zip(table.positions, table.forward, table.reverse, strict=True)
        return {".tab": "".join(f"{p * 1e3:.4f} {-f * 1e6:.2f} {-r * 1e6:.2f}\n" for p, f, r in rows)}

    def read(self, files: Mapping[str, str], table: CompensationTable, _options: Any) -> CompensationTable:
        rows = np.array([[float(word) for word in line.split()] for line in files[".tab"].splitlines()])
        return replace(
            table,
            positions=read_only_floats(rows[:, 0] / 1e3),
            forward=read_only_floats(-rows[:, 1] / 1e6),
            reverse=read_only_floats(-rows[:, 2] / 1e6),
        )

    cross_sign = "known"
    cross_notes: Any = (Words(en="Copy that file, too.", de="Auch diese Datei kopieren."),)

    def cross_files(self, tables: Sequence[CrossTable], moves: int) -> Mapping[str, str]:
        """A line for each row: both axes, the position (mm), and what is added to the second axis (µm)."""
        rows = [
            f"{each.input} {each.output} {p * 1e3:.4f} {-moves * e * 1e6 + 0.0:.2f}\n"
            for each in tables
            for p, e in zip(each.positions, each.values, strict=True)
        ]
        return {".across": "".join(rows)}

    def read_cross(
        self, files: Mapping[str, str], tables: Sequence[CrossTable], moves: int
    ) -> tuple[CrossTable, ...]:
        words = [line.split() for line in files[".across"].splitlines()]
        pairs = dict.fromkeys((moving, aside) for moving, aside, *_ in words)
        found = []
        for (moving, aside), table in zip(pairs, tables, strict=False):
            own = np.array(
                [[float(p), float(e)] for one, two, p, e in words if (one, two) == (moving, aside)]
            )
            at, values = read_only_floats(own[:, 0] / 1e3), read_only_floats(-moves * own[:, 1] / 1e6)
            found.append(CrossTable(moving, aside, at, values, table.slope))
        return tuple(found)


class StatedSign(ExemplaryController):
    """The same of which nobody knows which way a positive value moves an axis."""

    cross_sign = "stated"


EXEMPLARY = ExemplaryController()
EXAMPLE = ControlExample(
    {".tab": "0 0 -1.5\n50.25 -3.25 -4.75\n"},
    ((0, 0, 1.5), (50.25, 3.25, 4.75)),
    deviation_step=0.01,
    across=CrossExample({".across": "X Y 0 0\nX Y 50 -2.5\n"}, "X", "Y", ((0, 0), (50, 2.5))),
)


def alike(**factors: float) -> dict[str, Any]:
    """Return the sin of a controller that writes and reads another column alike."""

    def changed(table: CompensationTable, power: int) -> CompensationTable:
        columns = {name: getattr(table, name) * factor**power for name, factor in factors.items()}
        return replace(table, **{name: read_only_floats(column) for name, column in columns.items()})

    return {
        "files": lambda _, table, options: EXEMPLARY.files(changed(table, 1), options),
        "read": lambda _, files, table, options: changed(EXEMPLARY.read(files, table, options), -1),
    }


def swapped_alike() -> dict[str, Any]:
    return {
        "files": lambda _, table, options: EXEMPLARY.files(crossed(table), options),
        "read": lambda _, files, table, options: crossed(EXEMPLARY.read(files, table, options)),
    }


def in_steps(position: float, deviation: float) -> dict[str, Any]:
    """Return the sin of a controller that writes positions and deviations in steps, m."""

    def stepped(table: CompensationTable) -> CompensationTable:
        return replace(
            table,
            positions=read_only_floats(np.round(table.positions / position) * position),
            forward=read_only_floats(np.round(table.forward / deviation) * deviation),
            reverse=read_only_floats(np.round(table.reverse / deviation) * deviation),
        )

    return meaning(stepped)


def written(change: Callable[[str], Any]) -> dict[str, Any]:
    """Return the sin of a controller whose file is another one."""
    return {"files": lambda _, table, options: {".tab": change(EXEMPLARY.files(table, options)[".tab"])}}


def meaning(change: Callable[[CompensationTable], CompensationTable]) -> dict[str, Any]:
    """Return the sin of a controller that writes another table."""
    return {"files": lambda _, table, options: EXEMPLARY.files(change(table), options)}


def across(change: Callable[[CrossTable], CrossTable], *, read_too: bool = False) -> dict[str, Any]:
    """Return the sin of a controller that writes other tables across axes, and may read them alike."""
    sin: dict[str, Any] = {
        "cross_files": lambda _, tables, moves: EXEMPLARY.cross_files([*map(change, tables)], moves)
    }
    if read_too:
        sin["read_cross"] = lambda _, files, tables, moves: tuple(
            map(change, EXEMPLARY.read_cross(files, tables, moves))
        )
    return sin


def turned(table: CrossTable) -> CrossTable:
    return replace(table, input=table.output, output=table.input)


def negative(table: CrossTable) -> CrossTable:
    return replace(table, values=-table.values)


def across_written(change: Callable[[str], str]) -> dict[str, Any]:
    """Return the sin of a controller whose file across axes is another one."""
    return {
        "cross_files": lambda _, tables, moves: {
            name: change(text) for name, text in EXEMPLARY.cross_files(tables, moves).items()
        }
    }


def careless(_self: object, table: CompensationTable, options: Any) -> Mapping[str, str]:
    try:
        return EXEMPLARY.files(table, options)
    except InputError:
        return {".tab": "0 0 0\n"}


def elsewhere(_self: object, table: CompensationTable, options: Any) -> Mapping[str, str]:
    try:
        return EXEMPLARY.files(table, options)
    except InputError as error:
        raise InputError.at(Place("somewhere"), "no") from error


def crossed(table: CompensationTable) -> CompensationTable:
    return replace(table, forward=table.reverse, reverse=table.forward)


class Undescribed(Options):
    grid: float = 1.0


class Greedy(Options):
    controller: str = Field("", description="Taken.")


class Demanding(Options):
    grid: float = Field(description="Without a default.")


TWO_WAYS, ACROSS = controllers.reads_what_its_maker_prints, controllers.takes_tables_across_axes
ENDS = itertools.cycle(("", "", "\n"))
SINS = [
    (TWO_WAYS, alike(forward=-1, reverse=-1), "sign, direction and unit are the control's"),
    (
        TWO_WAYS,
        swapped_alike(),
        "of the maker's file 1.5 µm are read at 0 mm forward; the control takes 0 µm",
    ),
    (TWO_WAYS, alike(forward=1e-3, reverse=1e-3), "the control takes 3.25 µm away"),
    (TWO_WAYS, alike(positions=1e-3), "no row is read at 50.25 mm"),
    (controllers.reads_what_it_writes, in_steps(1e-6, 1e-6), "the control takes steps of 0.01 µm"),
    (controllers.reads_what_it_writes, in_steps(1e-3, 1e-8), "m off its position"),
    (controllers.is_named, {"identifier": "A control"}, "must be lower-case ASCII"),
    (controllers.is_named, {"title": "A control"}, "title must be Words"),
    (controllers.is_named, {"notes": (Words(en="", de="x"),)}, "a note says nothing in 'en'"),
    (controllers.is_named, {"confidence": "sure"}, "confidence is one of"),
    (controllers.options_are_described, {"options": Undescribed}, "'grid' needs a description"),
    (controllers.options_are_described, {"options": Greedy}, "controller belong to the core"),
    (controllers.options_are_described, {"options": Demanding}, "raised ValidationError"),
    (controllers.reads_what_it_writes, {"files": lambda *_: None}, "Mapping is expected"),
    (controllers.reads_what_it_writes, {"files": lambda *_: {}}, "returns no file"),
    (controllers.reads_what_it_writes, {"read": lambda *_: None}, "CompensationTable is expected"),
    (controllers.reads_what_it_writes, written(lambda text: text + "µ"), "must be plain ASCII"),
    (controllers.reads_what_it_writes, written(lambda text: text.replace(" -", " ")), "is off by"),
    (
        controllers.reads_what_it_writes,
        meaning(lambda table: replace(table, forward=-table.forward, reverse=-table.reverse)),
        "is off by",
    ),
    (
        controllers.reads_what_it_writes,
        meaning(lambda table: replace(table, forward=1e3 * table.forward)),
        "is off by",
    ),
    (controllers.reads_what_it_writes, meaning(crossed), "is off by"),
    (
        controllers.reads_what_it_writes,
        meaning(lambda table: replace(table, reverse=table.forward)),
        "is off by",
    ),
    (
        controllers.reads_what_it_writes,
        written(lambda text: "".join(text.splitlines(keepends=True)[:-1])),
        "has 10 rows instead of 11",
    ),
    (controllers.reads_what_it_writes, {"read": lambda *_: {}["x"]}, "raised KeyError: 'x'"),
    (controllers.writes_the_same_again, written(lambda text: f"{text}{next(COUNTER)}"), "gives other files"),
    (ACROSS, across(negative), "is read 24 µm off"),
    (ACROSS, across(negative, read_too=True), "the control takes [0.  2.5] µm away"),
    (ACROSS, across(turned), "Y over X is read as X over Y"),
    (ACROSS, across(lambda table: replace(table, values=table.values * 1e3)), "µm off"),
    (
        ACROSS,
        across(lambda table: replace(table, positions=table.positions - table.positions[0])),
        "positions",
    ),
    (ACROSS, across(lambda table: replace(table, values=np.round(table.values, 6))), "µm off"),
    (
        ACROSS,
        {"cross_files": lambda _, tables, moves: EXEMPLARY.cross_files(tables[:1], moves)},
        "must return the 2",
    ),
    (ACROSS, {"cross_files": lambda *_: {}}, "of tables with slopes nothing is written"),
    (ACROSS, {"cross_files": lambda *_: None}, "Mapping is expected"),
    (ACROSS, across_written(lambda text: f"{text}µ"), "must return texts in plain ASCII"),
    (ACROSS, across_written(lambda text: text + next(ENDS)), "gives other files"),
    (ACROSS, {"cross_sign": "guessed"}, "cross_sign is one of known, stated"),
    (ACROSS, {"cross_notes": ()}, "cross_notes say what who loads the files must know"),
    (ACROSS, {"read_cross": lambda *_: ()}, "must return the 2 tables"),
    (
        ACROSS,
        {
            "cross_sign": "stated",
            "cross_files": lambda _, tables, _moves: EXEMPLARY.cross_files(tables, 1),
            "read_cross": lambda _, files, tables, _moves: EXEMPLARY.read_cross(files, tables, 1),
        },
        "read by who states the other sign: Y over X is read 24 µm off",
    ),
    (controllers.refuses_rows_that_do_not_rise, {"files": careless}, "are not refused"),
    (controllers.refuses_rows_that_do_not_rise, {"files": elsewhere}, "elsewhere than at table.place"),
]


test_exemplary_passes, test_a_check_finds_its_sin, test_every_check_has_a_sin = make_tests(
    CONTROLLER_CHECKS, ExemplaryController, SINS, lambda *_: ({}, EXAMPLE)
)


def test_a_control_of_a_sign_that_is_stated_passes_without_an_example_of_it() -> None:
    ACROSS(StatedSign(), {}, replace(EXAMPLE, across=None))


def test_a_sign_that_is_known_needs_a_file_of_the_maker() -> None:
    with pytest.raises(AssertionError, match="its sign is known: give a file as the maker prints it"):
        ACROSS(EXEMPLARY, {}, replace(EXAMPLE, across=None))


def test_nothing_is_asked_of_a_control_without_such_tables() -> None:
    plain = type("Plain", (), {"identifier": "plain"})()
    ACROSS(plain, {}, EXAMPLE)


def test_all_failures_are_reported_at_once() -> None:
    sinner = make_sinner(ExemplaryController, {"confidence": "sure", "read": lambda *_: {}["x"]})
    lines = failure(check_controller, sinner, example=EXAMPLE).splitlines()
    assert [line.split(": ")[:2] for line in lines] == [
        ["is_named", "exemplary-control"],
        ["reads_what_it_writes", "exemplary-control"],
        ["reads_what_its_maker_prints", "exemplary-control"],
    ]


@pytest.mark.parametrize(
    ("example", "sentence"),
    [
        (None, "give a file as the control's maker prints it"),
        (replace(EXAMPLE, rows=EXAMPLE.rows[:1]), "two are needed at least"),
        (replace(EXAMPLE, rows=((0, 0, 0), (1, 0, 0))), "that are not zero"),
        (replace(EXAMPLE, rows=((0, 1, 1), (1, 2, 2))), "must differ forward and in reverse"),
    ],
    ids=["none", "one row", "zeros", "directions alike"],
)
def test_an_example_that_tells_nothing_does_not_pass(example: ControlExample | None, sentence: str) -> None:
    with pytest.raises(AssertionError, match=sentence):
        TWO_WAYS(EXEMPLARY, {}, example)
