"""``--plugin FILE``: a person's own plugin, without an installation."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest

from cli.commands import Run
from environments import ROOT
from zlmreport.cli import main
from zlmreport.cli.arguments import parse

_MINE = """\
from zlmreport.plugin import hookimpl
from testing.exemplary_effect import ExemplaryEffect

@hookimpl
def zlmreport_effects():
    return [ExemplaryEffect()]
"""


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "mine.py").write_text(_MINE, encoding="utf-8")
    return tmp_path


@pytest.fixture
def run(folder: Path, capsys: pytest.CaptureFixture[str]) -> Callable[..., Run]:  # noqa: ARG001 - it works there
    """Return a function that runs a command in the folder."""
    return lambda *arguments: Run(main(arguments), *capsys.readouterr())


def test_the_effect_in_the_file_is_listed_with_the_file(run: Callable[..., Run]) -> None:
    done = run("plugins", "--plugin", "mine.py")
    assert (done.code, done.messages) == (0, "")
    (line,) = [line.split() for line in done.output.splitlines() if "exemplary-wave" in line]
    assert line[0] == "exemplary-wave"
    assert line[-1] == "mine.py"


def test_a_catalogue_of_effects_may_be_named_in_capitals(folder: Path, run: Callable[..., Run]) -> None:
    catalogue = (ROOT / "src/zlmreport/skeletons/effect.yaml.txt").read_text(encoding="utf-8")
    (folder / "MINE.YAML").write_text(
        catalogue.replace("{{identifier}}", "my-wave").replace("{{words}}", "My wave"), encoding="utf-8"
    )
    done = run("plugins", "--plugin", "MINE.YAML")
    assert (done.code, done.messages) == (0, "")
    assert "my-wave" in done.output


def test_the_environment_names_it_too(
    folder: Path, run: Callable[..., Run], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("ZLMREPORT_PLUGINS", str(folder / "mine.py"))
    assert "exemplary-wave" in run("plugins").output


def test_without_being_named_it_is_not_there(run: Callable[..., Run]) -> None:
    assert "exemplary-wave" not in run("plugins").output


def test_a_file_that_is_not_there_cannot_be_read(run: Callable[..., Run]) -> None:
    done = run("plugins", "--plugin", "yours.py")
    assert done.code == 3
    assert "iso230-2:2014" in done.output  # what works is listed all the same
    assert done.messages.endswith("yours.py: there is no such plugin file\n")


def test_a_file_that_does_not_work_is_a_mistake_at_its_line(folder: Path, run: Callable[..., Run]) -> None:
    (folder / "mine.py").write_text("import numpy\n1 / 0\n")
    done = run("plugins", "--plugin", "mine.py")
    assert done.code == 2
    assert "iso230-2:2014" in done.output
    assert "mine.py:2:1: ZeroDivisionError: division by zero" in done.messages


@pytest.mark.parametrize(
    "command", [["job.yaml"], ["check", "job.yaml"], ["plugins"], ["schema"], ["init", "new"]]
)
def test_every_command_takes_the_option_and_takes_it_again(command: list[str]) -> None:
    _, options = parse([*command, "--plugin", "one.py", "--plugin", "two.py"])
    assert options.plugin == [Path("one.py"), Path("two.py")]
