"""The command that takes readings live."""

from __future__ import annotations

from pathlib import Path

from zlmreport.cli.arguments.parser import CommandParser


def capture(command: str) -> CommandParser:
    """Return the parser of ``zlmreport capture``."""
    parser = CommandParser(
        f"zlmreport {command}",
        "Take the readings of a job's test from the instrument that its key measurement.source names, while\n"
        "the axis follows its plan. Each reading is on the disk, in the job's journal, before the next is\n"
        "waited for. Ctrl-C ends; nothing that was taken is lost. A step gauge is probed by the machine\n"
        "that the key names, along its path; the same command again probes what is missing.",
        "examples:\n  zlmreport capture x-axis.yaml\n"
        "  zlmreport capture x-axis.yaml --resume\n"
        "  zlmreport capture x-axis.yaml --resume --answer 17\n"
        "  zlmreport capture x-axis.yaml --end && zlmreport x-axis.yaml",
    )
    parser.add_argument("job", metavar="JOB.yaml", type=Path, help="job file")
    parser.add_argument(
        "--resume", action="store_true", help="go on with a capture that was interrupted, from its journal"
    )
    parser.add_argument(
        "--answer",
        metavar="VISIT",
        default="",
        help="with --resume: the visit at which the axis stood when the capture asked and ended, by its\n"
        "number, or none",
    )
    parser.add_argument(
        "--end",
        action="store_true",
        help="close a capture that was interrupted: what was not taken is missing",
    )
    parser.add_argument("--journal", metavar="FILE", type=Path, help="journal, instead of the job's")
    parser.add_argument(
        "--json",
        action="store_true",
        help="print what happens as JSON, a line each, as it stands in the journal",
    )
    return parser
