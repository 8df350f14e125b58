"""``zlmreport init``: a job to begin with."""

from __future__ import annotations

from argparse import Namespace
from importlib.resources import files
from pathlib import Path

from zlmreport.cli.terminal import shown_path
from zlmreport.errors import AccessError, InputError, Place, Problem

_STARTER = ("job.yaml", "laboratory.yaml", "x-axis.csv")


def run(options: Namespace) -> int:
    """Write the starter job; no file that is there already is touched."""
    directory: Path = options.directory
    targets = [directory / name for name in _STARTER]
    there = [target for target in targets if target.exists()]
    if there:
        raise InputError(
            Problem(Place(str(target)), "is there already; choose another folder, or remove it")
            for target in there
        )
    written: list[Path] = []
    try:
        directory.mkdir(parents=True, exist_ok=True)
        for target in targets:
            with target.open("xb") as file:
                written.append(target)
                file.write(files("zlmreport").joinpath("starter", target.name).read_bytes())
    except OSError as error:
        for target in written:
            target.unlink(missing_ok=True)
        reason = (error.strerror or str(error)).lower()
        raise AccessError.at(Place(str(directory)), f"cannot be written: {reason}") from error
    for target in written:
        print(shown_path(target))
    print(f"next: zlmreport {shown_path(targets[0])}")
    return 0
