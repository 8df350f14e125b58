"""The results as a table for people and as JSON for programs."""

from __future__ import annotations

import json
import os
import platform
from collections.abc import Mapping, Sequence
from dataclasses import asdict
from datetime import UTC, datetime
from importlib.metadata import version
from pathlib import Path

from measure import Measured

Results = Mapping[str, Sequence[Measured]]

_MEASURED_LIBRARIES = ("zlmreport", "weasyprint", "matplotlib", "numpy", "jinja2", "pydantic")


def table(title: str, lines: Sequence[Measured]) -> str:
    """Return a benchmark's results as a table."""
    width = max(len(line.name) for line in lines)
    written = [title, "-" * len(title)]
    for line in lines:
        text = f"{line.name:{width}}  {_written(line.value):>9} {line.unit:8}"
        if line.target is not None:
            outcome = "kept" if line.value <= line.target else "missed"
            text += f"  target {_written(line.target)} {line.unit} {outcome}"
        written.append(text.rstrip())
    return "\n".join(written)


def write_json(path: Path, results: Results) -> None:
    """Write all results, with what they were measured on."""
    document = {
        "schema": "zlmreport/benchmarks/1",
        "measured": datetime.now(UTC).isoformat(timespec="seconds"),
        "machine": {
            "processors": os.cpu_count(),
            "architecture": platform.machine(),
            "system": platform.system(),
            "python": platform.python_version(),
        },
        "versions": {name: version(name) for name in _MEASURED_LIBRARIES},
        "results": {name: [asdict(line) for line in lines] for name, lines in results.items()},
    }
    path.write_text(json.dumps(document, indent=2) + "\n", encoding="utf-8")


def _written(value: float) -> str:
    """Write a value with three significant digits."""
    return f"{value:.0f}" if abs(value) >= 100 else f"{value:.3g}"
