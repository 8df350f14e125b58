"""Running commands in this process."""

from __future__ import annotations

import json
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pytest

from job.jobs import SOUND
from replacing import replaced
from zlmreport.cli import main
from zlmreport.plugin.registry import Registry

_COMMANDS = ("report", "plugins")
READINGS = "1 2 3 -1 -2 -3"


@dataclass(frozen=True, slots=True)
class Run:
    """What a command did."""

    code: int
    output: str
    messages: str

    @property
    def summary(self) -> dict[str, Any]:
        """The summary that it printed."""
        value: dict[str, Any] = json.loads(self.output)
        return value


@dataclass(frozen=True, slots=True)
class Shop:
    """A folder with jobs, and a command line in it."""

    folder: Path
    capture: pytest.CaptureFixture[str]

    def write(self, name: str, text: str) -> Path:
        path = self.folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")
        return path

    def job(self, *changes: tuple[str, str], name: str = "job.yaml", number: str = "CAL-1") -> Path:
        """Write a sound job with its readings; `changes` replace parts of its text."""
        self.write("six.txt", READINGS)
        return self.write(name, replaced(SOUND, ("CAL-1", number), *changes))

    def run(self, *arguments: str) -> Run:
        self.capture.readouterr()
        code = main(arguments)
        return Run(code, *self.capture.readouterr())

    def files(self) -> list[str]:
        """Return the names of the files that there are below the folder `out`."""
        return sorted(path.name for path in self.folder.glob("**/out/*"))


def use(monkeypatch: pytest.MonkeyPatch, registry: Registry) -> None:
    """Let commands find these plugins."""
    for command in _COMMANDS:
        monkeypatch.setattr(f"zlmreport.cli.{command}.find_plugins", lambda **_: registry)


def told(run: Run) -> Any:
    """Return the JSON that a command printed."""
    assert (run.code, run.messages) == (0, "")
    return json.loads(run.output)
