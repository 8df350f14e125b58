"""The Tab key of a shell finds commands, options, files, and what installed plugins are called."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from processes import ZLMREPORT, run

argcomplete = pytest.importorskip("argcomplete")


@pytest.mark.parametrize(
    ("line", "found"),
    [
        ("zlmreport x", {"x-axis.yaml"}),
        ("zlmreport fleet re", {"rebuild", "report"}),
        ("zlmreport model a", {"add"}),
        ("zlmreport model add x-axis.yaml backlash-g", {"backlash-gradient"}),
        ("zlmreport machine p", {"plan", "predict"}),
        ("zlmreport machine add x-axis.yaml servo-m", {"servo-mismatch"}),
        ("zlmreport new st", {"standard"}),
        ("zlmreport x-axis.yaml --format pdf,ht", {"pdf,html"}),
    ],
)
def test_what_may_follow(line: str, found: set[str], tmp_path: Path) -> None:
    (tmp_path / "x-axis.yaml").touch()
    asked = {
        "_ARGCOMPLETE": "1",
        "_ARGCOMPLETE_IFS": "\n",
        "_ARGCOMPLETE_STDOUT_FILENAME": str(tmp_path / "found"),
        "COMP_LINE": line,
        "COMP_POINT": str(len(line)),
    }
    done = run(*ZLMREPORT, cwd=tmp_path, env=os.environ | asked)
    assert done.returncode == 0, done.stderr
    assert {word.strip() for word in (tmp_path / "found").read_text().splitlines()} == found
