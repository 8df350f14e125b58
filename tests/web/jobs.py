"""The example on which the pages are tried."""

from __future__ import annotations

import shutil
from pathlib import Path

#: An axis whose model lacks the error of its screw.
EXAMPLE = Path(__file__).parents[2] / "configs" / "hidden-effect"


def lay_out(folder: Path) -> Path:
    """Write the example into a folder, and return its job."""
    shutil.copy(EXAMPLE / "x-axis.csv", folder)
    path = folder / "job.yaml"
    text = (EXAMPLE / "job.yaml").read_text(encoding="utf-8")
    path.write_text(text.replace("../../out", "out"), encoding="utf-8")
    return path
