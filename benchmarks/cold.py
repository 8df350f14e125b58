"""Processes from their start to their end: the command, the plain recipe, and what their imports take."""

from __future__ import annotations

import json
import sys
import sysconfig
from functools import partial
from pathlib import Path
from tempfile import TemporaryDirectory

from content import content
from measure import Measured, Sizes, alternately, cost_of_command, cpu, median, ratio, wall
from sample import write_job
from zlmreport.job.loading import load
from zlmreport.pipeline import compose
from zlmreport.plugin.registry import find_plugins

PLAIN_RECIPE = Path(__file__).with_name("plain.py")

_CPU_OF_VERSION = 0.15
#: What a run that prints nothing cannot do without; commands are held against it.
_LEAST = "numpy, yaml, pydantic, pluggy"
_CPU_OF_RUN, _CPU_OF_HELP = 2.5, 0.5
_WALL_OF_CERTIFICATE = 0.7

#: Modules, each imported alone into an empty interpreter.
_IMPORTS = (
    _LEAST,
    "pluggy, yaml",
    "numpy",
    "pydantic",
    "jinja2",
    "matplotlib.figure",
    "matplotlib.pyplot",
    "weasyprint",
    "zlmreport.cli",
    "zlmreport.pipeline",
)


def measure(sizes: Sizes) -> list[Measured]:
    """Measure commands and imports, each in turn."""
    with TemporaryDirectory() as name:
        commands = _commands(Path(name))
        costs = alternately(
            {label: partial(cost_of_command, command) for label, command in commands.items()}, sizes.rounds
        )
    bare = median(cpu(costs["python"]))
    return [
        Measured("zlmreport --version", median(cpu(costs["--version"])), "s CPU", _CPU_OF_VERSION),
        *(
            Measured(f"{label} / import {_LEAST}", ratio(cpu(costs[label]), cpu(costs[_LEAST])), "", target)
            for label, target in (
                ("json", _CPU_OF_RUN),
                ("check", _CPU_OF_RUN),
                ("--help", _CPU_OF_HELP),
                ("--version", _CPU_OF_HELP),
            )
        ),
        Measured("zlmreport plugins", median(cpu(costs["plugins"])), "s CPU"),
        Measured("zlmreport check JOB", median(cpu(costs["check"])), "s CPU"),
        Measured("zlmreport JOB, one certificate", median(wall(costs["job"])), "s"),
        Measured("plain recipe, the same document", median(wall(costs["plain"])), "s"),
        Measured(
            "zlmreport JOB / plain recipe",
            ratio(wall(costs["job"]), wall(costs["plain"])),
            "",
            _WALL_OF_CERTIFICATE,
        ),
        Measured("python, empty", bare, "s CPU"),
        *(Measured(f"import {names}", median(cpu(costs[names])) - bare, "s CPU") for names in _IMPORTS),
    ]


def _commands(folder: Path) -> dict[str, list[str | Path]]:
    """Return the commands by name; their files lie in the folder."""
    zlmreport = Path(sysconfig.get_path("scripts"), "zlmreport")
    job = write_job(folder, "COLD-0001")
    document = folder / "content.json"
    registry = find_plugins()
    words = content(compose(load(job, registry), registry))
    document.write_text(json.dumps(words), encoding="utf-8")
    return {
        "--version": [zlmreport, "--version"],
        "--help": [zlmreport, "--help"],
        "json": [zlmreport, job, "--format", "json", "--output", folder / "json", "--quiet"],
        "plugins": [zlmreport, "plugins"],
        "check": [zlmreport, "check", job],
        "job": [zlmreport, job, "--output", folder / "out", "--quiet"],
        "plain": [sys.executable, PLAIN_RECIPE, document, folder / "plain.pdf"],
        "python": [sys.executable, "-c", ""],
        **{names: [sys.executable, "-c", f"import {names}"] for names in _IMPORTS},
    }
