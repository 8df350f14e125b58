"""The commands of a fleet of machines."""

from __future__ import annotations

import argparse
from pathlib import Path

from zlmreport.cli.arguments.parser import CommandParser

_MOST_WORKERS = 1024


def fleet(command: str) -> CommandParser:
    """Return the parser of ``zlmreport fleet``."""
    parser = CommandParser(
        f"zlmreport {command}",
        "Make the certificates of a fleet that are due: new ones, and those whose job, readings, shared\n"
        "files, plugins or program changed. What was issued under a number is never replaced: another\n"
        "content becomes a draft. A job that fails does so alone, and is tried again the next night.",
        "examples:\n"
        "  zlmreport fleet fleet.yaml --dry-run\n"
        "  zlmreport fleet fleet.yaml --quiet --log-json\n\n"
        "exit codes: 0 done; 2 the fleet file is wrong; 3 the ledger cannot be used, or another night is at\n"
        "work on it; 4 done, but jobs failed",
    )
    _add_fleet(parser)
    parser.add_argument(
        "--dry-run", action="store_true", help="say what would be done, and why; make and write nothing"
    )
    parser.add_argument(
        "--workers", metavar="N", type=_workers, help="number of processes, instead of the fleet file's"
    )
    parser.add_argument("--quiet", action="store_true", help="print nothing but failures")
    parser.add_argument("--json", action="store_true", help="print what became of every job as JSON")
    parser.add_argument("--log-json", action="store_true", help="log each job as a line of JSON")
    return parser


def fleet_report(command: str) -> CommandParser:
    """Return the parser of ``zlmreport fleet report``."""
    parser = CommandParser(
        f"zlmreport {command}",
        "Write the overview of a fleet from its ledger: the state of every axis, failures, limits that are\n"
        "not met, who drifts, with small graphs; and the same numbers as a text file for Prometheus.",
        "example:\n  zlmreport fleet report fleet.yaml --output overview",
    )
    _add_fleet(parser)
    parser.add_argument("-o", "--output", metavar="DIR", type=Path, help="folder of the overview")
    return parser


def _workers(text: str) -> int:
    """Read a number of processes."""
    if not (text.isascii() and text.isdigit() and 0 < int(text) <= _MOST_WORKERS):
        raise argparse.ArgumentTypeError(f"{text!r} is no number of processes; write 2")
    return int(text)


def _add_fleet(parser: CommandParser) -> None:
    parser.add_argument("fleet", metavar="FLEET.yaml", type=Path, help="fleet file")
