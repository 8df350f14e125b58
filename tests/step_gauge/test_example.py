"""The measured files of the example with a step gauge are what its simulation makes."""

from __future__ import annotations

import runpy

from environments import ROOT

FOLDER = ROOT / "configs" / "step-gauge"


def test_the_measured_files_are_those_of_the_simulation() -> None:
    made = runpy.run_path(str(FOLDER / "make.py"))["files"]()
    for name, content in made.items():
        assert (FOLDER / name).read_text(encoding="utf-8") == content, name
