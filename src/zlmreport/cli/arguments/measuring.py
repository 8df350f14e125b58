"""Options and help of the commands plan, compensate, emulate, simulate and capture."""

from __future__ import annotations

import argparse
import math
from pathlib import Path
from typing import TYPE_CHECKING

from zlmreport.cli.arguments.parser import (
    CommandParser,
    add_jobs,
    read_course,
    read_number,
    read_port,
    read_setting,
)
from zlmreport.errors import did_you_mean, quoted

if TYPE_CHECKING:
    from zlmreport.live.emulation.troubles import Planned


def plan(command: str) -> CommandParser:
    """Return the parser of ``zlmreport plan``."""
    parser = CommandParser(
        command,
        "Plan the test of a job before anything is measured: target positions with random fractions, the\n"
        "sequence of its positioning method, and what such a test will see of each installed effect.\n"
        "The readings that the job names need not exist. Numbers come from its key plan.\n"
        "A job with a group of keys of an extension is planned by that: the path of a probe, for example.",
        "examples:\n  zlmreport plan x-axis.yaml\n"
        "  zlmreport plan x-axis.yaml --output plan --program linuxcnc\n"
        "  zlmreport plan x-axis.yaml --decide scale-error,scale-expansion -o next\n"
        "  zlmreport plan x-axis.yaml --decide screw-pitch",
    )
    parser.add_argument("job", metavar="JOB.yaml", type=Path, help="job file")
    _add_test(parser)
    parser.add_argument(
        "--decide",
        metavar="E,E",
        help="instead: simulate which plan tells these effects apart, or shows the one that is named, and "
        "print the job of the cheapest that will; with --output write it, <number>-decide.yaml",
    )
    parser.add_output(
        "DIR",
        "write the targets, a form for the readings, a picture of the sequence or of the path, and "
        "programs into this folder",
    )
    parser.add_argument(
        "--program",
        metavar="P,P",
        help="with --output: part programs, parted by commas, instead of the job's: linuxcnc,fanuc",
    )
    parser.add_argument(
        "--run",
        metavar="N",
        type=int,
        help="write only the programs of one run, for a run that is taken again",
    )
    parser.add_flag("--json", "print the plan as JSON (zlmreport/plan/1, or that of an extension)")
    return parser


def compensate(command: str) -> CommandParser:
    """Return the parser of ``zlmreport compensate``."""
    parser = CommandParser(
        command,
        "Write a compensation table for a control from a job's test, with a sheet (PDF) for who loads it,\n"
        "and say what that very table will leave. The job must say which table was active\n"
        "during the test: axis.compensation_table, a file or none. After the table has been loaded and the\n"
        "axis measured again, --confirm holds the second test against the first.",
        "examples:\n"
        "  zlmreport compensate x-axis.yaml --controller linuxcnc --set type=1 --output table\n"
        "  zlmreport compensate x-axis.yaml --controller linuxcnc --from model --step 5 -o table\n"
        "  zlmreport compensate --confirm x-axis.yaml x-axis-after.yaml\n\n"
        "exit codes: 0 done; 1 the second test does not hold the forecast; 2 a job, its data or the command\n"
        "line is wrong; 3 a file could not be read or written",
    )
    add_jobs(parser)
    parser.add_argument(
        "--controller", metavar="NAME", help="the control, such as linuxcnc, instead of the job's own"
    )
    parser.add_repeated("--set", "KEY=VALUE", read_setting, "a key of the controller, such as type=1")
    parser.add_argument(
        "--step",
        metavar="S",
        type=read_number,
        help="distance of the rows, mm or degrees; without it a rule says where they are, and why",
    )
    parser.add_argument(
        "--from",
        dest="source",
        choices=("means", "model"),
        default="means",
        help="make the table from the mean deviations (as without it), or from the job's fitted model and "
        "what the means show beyond it: as smooth as the readings are uncertain; periodic effects go in that "
        "have four rows in each period",
    )
    parser.add_output(
        "DIR", "folder of the table and its sheet; with --confirm of the job that shows both tests"
    )
    parser.add_flag("--unconfirmed", "write a format, too, that was never tried on the control itself")
    parser.add_flag("--confirm", "two jobs: did the table of the first do what was forecast?")
    parser.add_flag(
        "--json", "print the forecast as JSON (zlmreport/compensation/1, zlmreport/confirmation/1)"
    )
    return parser


def emulate(command: str) -> CommandParser:
    """Return the parser of ``zlmreport emulate``."""
    parser = CommandParser(
        command,
        "Put an instrument that is not there on a pseudo-terminal, or on a TCP port of this computer. It\n"
        "watches an axis that goes from position to position, and speaks as the real instrument does.\n"
        "It runs until Ctrl-C; 'zlmreport plugins' lists the instruments.",
        "examples:\n"
        "  zlmreport emulate umd1\n"
        "  zlmreport emulate umd1 --link interferometer --course 0,100,200,100,0 --fault lost-beam@30\n"
        "  zlmreport emulate ids3010 --port 9090\n\n"
        "An axis with errors, noise and a drift of its own: zlmreport simulate SPEC.yaml --emulate umd1\n"
        "Devices of extensions have options of their own: zlmreport emulate ippdme --help",
    )
    parser.add_argument("instrument", metavar="INSTRUMENT", help="umd1, nd28x, ids3010 or another")
    add_line(parser)
    parser.add_argument(
        "--course",
        metavar="P,P",
        type=read_course,
        default=(0.0, 100.0, 200.0, 100.0),
        help="positions that the axis goes to in turn, over and over, mm (--course=-5,0 for one that begins "
        "with a negative); 0,100,200,100 without it",
    )
    parser.add_argument(
        "--dwell",
        metavar="S",
        type=read_number,
        default=5.0,
        help="how long the axis rests at each position, s; 5 without it",
    )
    return parser


def add_line(parser: CommandParser, *, with_link: bool = True) -> None:
    """Add the options of an emulated instrument's line; one without a link has a TCP port in any case."""
    from zlmreport.live.emulation.troubles import Trouble  # noqa: PLC0415 - other commands need no live room

    if with_link:
        parser.add_argument(
            "--link", metavar="PATH", type=Path, help="a name for the pseudo-terminal that stays the same"
        )
    instead = " instead of a pseudo-terminal" if with_link else ""
    parser.add_argument(
        "--port", metavar="N", type=read_port, help=f"a TCP port{instead}; 0 for any free one"
    )
    parser.add_argument(
        "--fault",
        metavar="KIND@S",
        type=_read_fault,
        action="append",
        default=[],
        help=f"what goes wrong, and how many seconds after the start: {', '.join(Trouble)}; may be given "
        "several times. An instrument shows only what its protocol can say",
    )


def _read_fault(text: str) -> Planned:
    from zlmreport.live.emulation.troubles import Planned, Trouble  # noqa: PLC0415 - likewise

    known = tuple(map(str, Trouble))
    kind, _, moment = text.partition("@")
    if kind not in known:
        raise argparse.ArgumentTypeError(f"{quoted(kind)} is no fault; {did_you_mean(kind, known)}")
    try:
        start = float(moment)
    except ValueError:
        start = math.nan
    if not (math.isfinite(start) and start >= 0):
        raise argparse.ArgumentTypeError(
            f"{quoted(text)} does not say when; write seconds, such as {kind}@30"
        )
    return Planned(Trouble(kind), start)


def simulate(command: str) -> CommandParser:
    """Return the parser of ``zlmreport simulate``."""
    parser = CommandParser(
        command,
        "Write simulated readings of an axis: its effects, noise, conditions and the plan of its test\n"
        "are described in a file. A job that evaluates them is written beside, unless it is there.\n"
        "With --emulate nothing is read: the axis carries out its plan before an emulated instrument, for\n"
        "'zlmreport capture' to follow, until Ctrl-C. What the axis really does is written beside.",
        "examples:\n"
        "  zlmreport simulate configs/hidden-effect/simulation.yaml --output trial\n"
        "  zlmreport simulate configs/hidden-effect/simulation.yaml --output trial --emulate umd1 --link umd",
    )
    parser.add_argument(
        "specification", metavar="SPEC.yaml", type=Path, help="simulation file (zlmreport/simulation/1)"
    )
    parser.add_output("DIR", "folder of the files, instead of the simulation's")
    parser.add_argument(
        "--emulate", metavar="INSTRUMENT", help="let this instrument watch the axis: umd1, nd28x or another"
    )
    add_line(parser)
    parser.add_argument(
        "--start",
        metavar="S",
        type=read_number,
        default=10.0,
        help="with --emulate: how long the axis rests once somebody reads the port, s; 10 without it",
    )
    return parser


def _add_test(parser: CommandParser) -> None:
    parser.add_argument("--test", metavar="NAME", help="of several measured lines of the job, this one")


def capture(command: str) -> CommandParser:
    """Return the parser of ``zlmreport capture``."""
    parser = CommandParser(
        command,
        "Take the readings of a job's test from the instrument that its key measurement.source names, while\n"
        "the axis follows its plan. Each reading is on the disk, in the job's journal, before the next is\n"
        "waited for. Ctrl-C ends; nothing that was taken is lost. Points that a machine\n"
        "probes for an extension are taken along its path; the same command again takes what is missing.",
        "examples:\n  zlmreport capture x-axis.yaml\n"
        "  zlmreport capture x-axis.yaml --resume\n"
        "  zlmreport capture x-axis.yaml --resume --answer 17\n"
        "  zlmreport capture x-axis.yaml --retake 17\n"
        "  zlmreport capture x-axis.yaml --end && zlmreport x-axis.yaml",
    )
    parser.add_argument("job", metavar="JOB.yaml", type=Path, help="job file")
    _add_test(parser)
    parser.add_flag("--resume", "go on with a capture that was interrupted, from its journal")
    parser.add_argument(
        "--answer",
        metavar="VISIT",
        default="",
        help="with --resume: the visit at which the axis stood when the capture asked and ended, by its\n"
        "number, or none",
    )
    parser.add_argument(
        "--retake",
        metavar="VISIT",
        default="",
        help="go on, but first take a visit again, by its number, or a run ('run 2'); also when all visits\n"
        "were taken; the earlier readings stay in the journal",
    )
    parser.add_flag("--end", "close a capture that was interrupted: what was not taken is missing")
    parser.add_argument("--journal", metavar="FILE", type=Path, help="journal, instead of the job's")
    parser.add_flag("--json", "print what happens as JSON, a line each, as it stands in the journal")
    parser.add_flag(
        "--steered",
        "for a program that shows the capture: the present moment and questions as JSON, too,\nand orders "
        "from standard input, a line each, as they are typed at a terminal",
    )
    return parser
