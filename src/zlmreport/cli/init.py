"""``zlmreport init``: a job to begin with."""

from __future__ import annotations

import os
from argparse import Namespace
from importlib.resources import files
from pathlib import Path
from typing import TYPE_CHECKING

from zlmreport.cli.terminal import shown_path
from zlmreport.files import Document, demand_free, write
from zlmreport.plugins import find_plugins

if TYPE_CHECKING:
    from zlmreport.cli.look import Looked

_STARTER = ("job.yaml", "laboratory.yaml", "x-axis.csv")


def run(options: Namespace) -> int:
    """Write the starter job; no file that is there already is touched."""
    directory: Path = options.directory
    if options.origin:
        from zlmreport.cli.look import look  # noqa: PLC0415 - only for measurements that there are

        looked = look(options.origin, find_plugins(files=options.plugin))
        documents = [Document(directory / "job.yaml", _job(looked, options.origin, directory).encode())]
    else:
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


def _job(looked: Looked, file: Path, directory: Path) -> str:
    """Return a measuring report of a file; what is asked stands in it as comments."""
    axis = looked.read.axis
    first, last = axis.position_unit.from_si(looked.read.target_positions[[0, -1]])
    name = Path(os.path.relpath(file.resolve(), directory.resolve())).as_posix()
    return "\n".join(
        [
            f"# A measuring report of {file.name}. 'zlmreport schema' describes every key.",
            "schema: zlmreport/job/1",
            "certificate: {number: REPORT-0001, kind: report}",
            f"axis: {{name: X, kind: {axis.kind.value}, travel: [{first:.9g}, {last:.9g}]}}",
            "measurement:",
            *(f"  # {question}" for question in looked.proposal.asks),
            *looked.block(name, indent="  "),
            "evaluate:",
            '  - "iso230-2:2014"',
            "output: {formats: [pdf, json]}",
            "",
        ]
    )
