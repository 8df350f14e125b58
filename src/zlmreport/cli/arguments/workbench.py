"""The command of the workbench."""

from __future__ import annotations

from pathlib import Path

from zlmreport.cli.arguments.parser import CommandParser
from zlmreport.cli.arguments.values import port


def workbench(command: str) -> CommandParser:
    """Return the parser of ``zlmreport workbench``."""
    parser = CommandParser(
        f"zlmreport {command}",
        "Open the error model of a job as a web page of this computer: compare the model with the\n"
        "readings, see where it fails, add what is missing, watch the error fall. Every click is\n"
        "written into the job (comments stay) and recorded beside it. The page opens by the printed\n"
        "address alone.",
        "examples:\n  zlmreport workbench x-axis.yaml\n"
        "  zlmreport workbench x-axis.yaml --port 8420 --no-browser",
    )
    parser.add_argument("job", metavar="JOB.yaml", type=Path, help="job file")
    parser.add_argument(
        "--port", metavar="N", type=port, default=0, help="a TCP port; without it any free one"
    )
    parser.add_argument("--no-browser", action="store_true", help="print the address, and open no browser")
    return parser
