"""``zlmreport init``: a job to begin with."""

from __future__ import annotations

from argparse import Namespace
from importlib.resources import files
from pathlib import Path

from zlmreport.cli.terminal import shown_path
from zlmreport.files import Document, demand_free, write

_STARTER = ("job.yaml", "laboratory.yaml", "x-axis.csv")


def run(options: Namespace) -> int:
    """Write the starter job; no file that is there already is touched."""
    directory: Path = options.directory
    documents = [
        Document(directory / name, files("zlmreport").joinpath("starter", name).read_bytes())
        for name in _STARTER
    ]
    demand_free(document.path for document in documents)
    written = write(documents)
    for target in written:
        print(shown_path(target))
    print(f"next: zlmreport {shown_path(written[0])}")
    return 0
