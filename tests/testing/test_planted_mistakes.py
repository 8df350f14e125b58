# ruff: noqa: E501 - pieces of text that stand as they do in a skeleton
"""What ``zlmreport new`` writes has a test of its own that finds mistakes: for each kind one is planted.

It is one that only what the test brings can show: a worked example, what a file holds, a file of the control's
maker. The mistakes that each check finds are in the tests of the kits beside this one.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator
from pathlib import Path
from typing import TypeAlias

import pytest

from environments import imported_from
from refusals import failure
from replacing import replaced
from zlmreport.cli.new import make_skeleton_of
from zlmreport.testing import instruments

#: What is replaced by what, in the file of an ending.
Changes: TypeAlias = tuple[tuple[str, str], ...]
PLANTED: dict[str, tuple[str, str, Changes, str]] = {
    "k is 3 instead of 2": (
        "standard",
        ".py",
        (("4 * statistics", "6 * statistics"),),
        "gives_the_worked_values: my-plugin: worked example 1: S is 8.48528 µm; the example has 5.65685",
    ),
    "what an effect needs is forgotten": (
        "effect",
        ".yaml",
        (("    needs: {axis: linear, targets: 8}\n", ""),),
        "no readings could tell its parameters apart",
    ),
    "directions are swapped": (
        "source",
        ".py",
        (
            (
                '"UP": Approach.POSITIVE, "DOWN": Approach.NEGATIVE',
                '"DOWN": Approach.POSITIVE, "UP": Approach.NEGATIVE',
            ),
            ("targets[:: int(approach)]", "targets[:: -int(approach)]"),
        ),
        "the file holds",
    ),
    "it tells always the same": (
        "notifier",
        ".py",
        (("with options.file.open", 'with options.file.with_name("news.txt").open'),),
        "what somebody else is told arrives at",
    ),
    "directions are swapped in both ways": (
        "controller",
        ".py",
        (
            ("(table.forward, table.reverse)", "(table.reverse, table.forward)"),
            ("rows[:, 1]", "rows[:, 9]"),
            ("rows[:, 2]", "rows[:, 1]"),
            ("rows[:, 9]", "rows[:, 2]"),
        ),
        "of the maker's file 1.5 µm are read at 0 mm forward; the control takes 0 µm away",
    ),
    "a slope is written as a length": (
        "renderer",
        ".py",
        (
            (
                "parameter.quantity.unit_or(evaluation.measurements.axis.deviation_unit)",
                "evaluation.measurements.axis.deviation_unit",
            ),
        ),
        "a parameter is in SI, or in its own unit",
    ),
    "a garbled answer is taken": (
        "instrument",
        ".py",
        ((' or check_sum(found["text"]) != found["sum"]', ""),),
        "garbled (a digit is another, and the check sum is not)",
    ),
    "no feed before the first motion": (
        "program",
        ".py",
        (('    yield f"F{program_number(motion.feed)}"\n', ""),),
        "the motion to stop 1 has the feed nan; expected 1500 mm/min",
    ),
}


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Path]:
    """The folder of a skeleton, whose modules are forgotten in the end; of an instrument one check is run."""
    monkeypatch.setattr(instruments, "INSTRUMENT_CHECKS", (instruments.no_garbled_answer_is_usable,))
    yield tmp_path
    for name in ("my_plugin", "test_my_plugin"):
        sys.modules.pop(name, None)


@pytest.mark.parametrize(("kind", "ending", "changes", "sentence"), PLANTED.values(), ids=PLANTED)
def test_a_planted_mistake_is_named_by_the_test_of_the_skeleton(
    kind: str, ending: str, changes: Changes, sentence: str, folder: Path
) -> None:
    for path, content in make_skeleton_of(kind, "my-plugin").items():
        text = replaced(content.decode(), *(changes if path == f"my_plugin{ending}" else ()))
        if path in {"my_plugin.py", "my_plugin.yaml", "test_my_plugin.py"}:
            (folder / path).write_text(text, encoding="utf-8")
    imported_from("my_plugin", folder)
    test_conforms = imported_from("test_my_plugin", folder).test_conforms
    assert sentence in failure(test_conforms, *([folder] if kind in {"source", "notifier"} else []))
