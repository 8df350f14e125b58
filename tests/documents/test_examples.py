"""Every example in the README, the tutorial and the how-tos does what the page says."""

from __future__ import annotations

import os
import re
from collections.abc import Iterator
from pathlib import Path
from tempfile import TemporaryDirectory

import pytest

from documents.examples import EXECUTED, commands, compare, matches, patched, run_page
from documents.pages import DOCS, ROOT, Block, blocks, name
from documents.shell import VARIABLES
from documents.warm import warm_command, warm_server
from processes import PATIENCE, started
from zlmreport.cli.new import make_skeleton_of

#: They simulate, measure, diagnose and print so much that they take as long as all other pages together.
_LONG = {
    "README.md",
    "docs/explanation/real-measurements.md",
    "docs/how-to/accept-a-machine.md",
    "docs/how-to/use-in-a-notebook.md",
}


@pytest.fixture(scope="module")
def command() -> Iterator[Path]:
    """Return the folder of a command line that has imported what it needs."""
    with TemporaryDirectory() as folder, warm_command(Path(folder), env=os.environ | VARIABLES) as command:
        yield command


@pytest.mark.early
@pytest.mark.parametrize(
    "page",
    [
        pytest.param(page, marks=pytest.mark.long if name(page) in _LONG else (), id=name(page))
        for page in EXECUTED
    ],
)
def test_the_examples_of_a_page_work(page: Path, command: Path, tmp_path: Path) -> None:
    run_page(page, tmp_path, compare, command)


def test_the_warm_command_ends_with_whoever_started_it_and_takes_along_what_runs(tmp_path: Path) -> None:
    with warm_server(tmp_path) as server, started(tmp_path / "zlmreport", "emulate", "umd1") as emulated:
        emulated.lines(1)
        server.stdin.close()
        assert server.wait(PATIENCE) == 0
        assert emulated.process.wait(PATIENCE) != 0


def test_the_guide_to_a_quantity_shows_what_is_written_in_less_than_200_lines() -> None:
    written = make_skeleton_of("quantity", "rail-line")
    shown = {block.file: block.text for block in blocks(DOCS / "how-to" / "add-a-quantity.md") if block.file}
    for path in ("rail_line.py", "test_rail_line.py"):
        assert shown[path] == written[path].decode()
    assert len(shown["rail_line.py"].splitlines()) < 200


@pytest.mark.parametrize("page", EXECUTED, ids=name)
def test_commands_that_are_only_shown_exist(page: Path) -> None:
    known = set(re.findall(r"^  ([a-z]+) {2,}", (ROOT / "run").read_text(), re.MULTILINE))
    shown = [line for block in blocks(page) if block.language == "sh" for line in block.text.splitlines()]
    assert {line.split()[1] for line in shown if line.startswith("./run")} <= known


@pytest.mark.parametrize(
    ("expected", "printed"),
    [
        (["A = 3.1 µm"], "A = 3.1 µm\n"),
        (["A = … µm"], "A = 3.2 µm\n"),
        (["first", "…", "last"], "first\nlast\n"),
        (["first", "…", "last"], "first\nsecond\nthird\nlast\n"),
    ],
)
def test_the_runner_takes_what_the_page_says(expected: list[str], printed: str) -> None:
    assert matches(expected, printed)


@pytest.mark.parametrize(
    ("expected", "printed"),
    [
        (["A = 3.1 µm"], "A = 3.2 µm\n"),
        (["A = … µm"], "A = 3.2 nm\n"),
        (["first"], "first\nsecond\n"),
        (["first", "second"], "first\n"),
    ],
)
def test_the_runner_refuses_what_the_page_does_not_say(expected: list[str], printed: str) -> None:
    assert not matches(expected, printed)


def test_the_runner_refuses_a_change_of_lines_that_are_not_there() -> None:
    block = Block(ROOT / "README.md", 1, "diff", "job.yaml", "-language: fr\n+language: de\n")
    with pytest.raises(AssertionError, match="not there once"):
        patched(block, "certificate:\n  language: en\n")


def test_the_runner_makes_a_change_in_place() -> None:
    block = Block(ROOT / "README.md", 1, "diff", "job.yaml", " a: 1\n-b: 2\n+b: 3\n")
    assert patched(block, "z: 0\na: 1\nb: 2\nc: 4\n") == "z: 0\na: 1\nb: 3\nc: 4\n"


def test_the_runner_takes_a_console_block_apart() -> None:
    block = Block(ROOT / "README.md", 1, "console", "", "$ false\n$ echo $?\n1\n")
    assert [(each.text, each.expected) for each in commands(block)] == [("false", []), ("echo $?", ["1"])]
