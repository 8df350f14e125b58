"""``--plugin FILE``: a person's own plugin, without an installation."""

from __future__ import annotations

import os
from pathlib import Path
from subprocess import CompletedProcess

import pytest

from environments import ROOT
from processes import ZLMREPORT, run
from zlmreport.cli.arguments import parse

_MINE = """\
from zlmreport.plugin import hookimpl
from testing.exemplary_effect import ExemplaryEffect

@hookimpl
def zlmreport_effects():
    return [ExemplaryEffect()]
"""


def _run(*arguments: str, folder: Path, **variables: str) -> CompletedProcess[str]:
    environment = {**os.environ, "PYTHONPATH": str(ROOT / "tests"), **variables}
    return run(*ZLMREPORT, *arguments, cwd=folder, env=environment)


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    (tmp_path / "mine.py").write_text(_MINE, encoding="utf-8")
    return tmp_path


def test_the_effect_in_the_file_is_listed_with_the_file(folder: Path) -> None:
    done = _run("plugins", "--plugin", "mine.py", folder=folder)
    assert (done.returncode, done.stderr) == (0, "")
    (line,) = [line.split() for line in done.stdout.splitlines() if "exemplary-wave" in line]
    assert line[0] == "exemplary-wave"
    assert line[-1] == "mine.py"


def test_the_environment_names_it_too(folder: Path) -> None:
    done = _run("plugins", folder=folder, ZLMREPORT_PLUGINS=str(folder / "mine.py"))
    assert "exemplary-wave" in done.stdout


def test_without_being_named_it_is_not_there(folder: Path) -> None:
    assert "exemplary-wave" not in _run("plugins", folder=folder).stdout


def test_a_file_that_is_not_there_cannot_be_read(folder: Path) -> None:
    done = _run("plugins", "--plugin", "yours.py", folder=folder)
    assert done.returncode == 3
    assert "iso230-2:2014" in done.stdout  # what works is listed all the same
    assert done.stderr.endswith("yours.py: there is no such plugin file\n")


def test_a_file_that_does_not_work_is_a_mistake_at_its_line(folder: Path) -> None:
    (folder / "mine.py").write_text("import numpy\n1 / 0\n")
    done = _run("plugins", "--plugin", "mine.py", folder=folder)
    assert done.returncode == 2
    assert "iso230-2:2014" in done.stdout
    assert "mine.py:2:1: ZeroDivisionError: division by zero" in done.stderr


@pytest.mark.parametrize(
    "command", [["job.yaml"], ["check", "job.yaml"], ["plugins"], ["schema"], ["init", "new"]]
)
def test_every_command_takes_the_option_and_takes_it_again(command: list[str]) -> None:
    _, options = parse([*command, "--plugin", "one.py", "--plugin", "two.py"])
    assert options.plugin == [Path("one.py"), Path("two.py")]
