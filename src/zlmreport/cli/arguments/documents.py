"""Options and help of JOB.yaml and of all commands that ``measuring.py`` has not; ``--version``."""

from __future__ import annotations

import argparse
import contextlib
import math
from collections.abc import Mapping
from pathlib import Path

from zlmreport.cli.arguments.parser import (
    JSON_HELP,
    WHOLE_NUMBER,
    CommandParser,
    add_jobs,
    read_number,
    read_point,
    read_port,
    read_position,
)
from zlmreport.errors import did_you_mean, quoted
from zlmreport.version import __version__

#: Environment variable with the password of the key that signs.
SIGN_PASSWORD = "ZLMREPORT_SIGN_PASSWORD"  # noqa: S105 (a name)

_MAIN_EPILOG = """\
examples:
  zlmreport init first && zlmreport first/job.yaml
  zlmreport x-axis.yaml y-axis.yaml --output certificates
  zlmreport x-axis.yaml --format pdf,html,json --fail-on-nonconformity

exit codes: 0 done; 1 done, but a limit is not met (only with --fail-on-nonconformity);
2 a job, its data or the command line is wrong; 3 a file could not be read or written
"""
MODEL_ACTIONS = {
    "fit": "the parameters with their uncertainties, and the error that is left",
    "diagnose": "where the model fails, and which effect is missing",
    "build": "all of it in one go: add what has evidence of its own, step by step",
    "add": "write an effect into the job, and show the error before and after",
    "remove": "take an effect out of the job, and show the same",
    "history": "how the error fell, effect by effect",
    "learn": "from a folder of earlier tests: the file for model.priors of a job",
}
MACHINE_ACTIONS = {
    "predict": "what the axes predict of each test, of the work space and of its diagonals",
    "check": "what is known of the 21 errors, what is not, and which tests there are",
    "diagnose": "where circles differ from what is predicted, and which effect is missing",
    "plan": "the next run of a ballbar: what it decides, in how many minutes, how likely",
    "build": "add effects as long as each has evidence of its own, and write them into the file",
    "certificate": "write the document: errors, map, circles predicted and measured, verdict",
    "compensate": "tables across axes for a control (straightness, squareness), with their forecast",
    "add": "write an effect into the machine file, and show the error before and after",
    "remove": "take an effect out of the machine file, and show the same",
}
#: Of each command: its actions, an effect, and to which actions an option belongs.
_ACTIONS: dict[str, tuple[dict[str, str], str, dict[str, tuple[str, ...]]]] = {
    "model": (MODEL_ACTIONS, "backlash", {"at": ("fit",), "output": ("learn",), "dry_run": ("build",)}),
    "machine": (
        MACHINE_ACTIONS,
        "servo-mismatch",
        {
            **dict.fromkeys(("controller", "moves", "confirm", "trial", "step"), ("compensate",)),
            "output": ("certificate", "compensate"),
            "format": ("certificate",),
            "dry_run": ("build",),
        },
    ),
}
_MOST_WORKERS = 1024


def main_job(commands: Mapping[str, str]) -> CommandParser:
    """Return the parser of the main job; its help lists the other commands, each with a line."""
    parser = CommandParser("", _describe(commands), _MAIN_EPILOG)
    parser.add_argument("--version", action="version", version=f"zlmreport {__version__}")
    add_jobs(parser)
    parser.add_output("DIR", "folder of the files, instead of the job's")
    parser.add_argument(
        "--format", metavar="F,F", help="formats, parted by commas, instead of the job's: pdf,html,json"
    )
    parser.add_argument(
        "--sign",
        metavar="ID",
        help="sign the PDF with the key in a PKCS#12 file (ID.p12) or a token (pkcs11:…); its password is "
        f"asked for, or stands in the environment variable {SIGN_PASSWORD}",
    )
    parser.add_flag("--quiet", "print nothing but mistakes")
    parser.add_flag("--json", JSON_HELP)
    parser.add_flag("--fail-on-nonconformity", "exit with 1 if a stated limit is not met")
    return parser


def _describe(commands: Mapping[str, str]) -> str:
    listed = "\n".join(f"  {name:14} {summary}" for name, summary in commands.items())
    return (
        "Read the measurements that a job names, evaluate them by its standards, and write\n"
        f"the certificate.\n\nother commands:\n{listed}\n"
    )


def check(command: str) -> CommandParser:
    """Return the parser of ``zlmreport check``."""
    parser = CommandParser(
        command,
        "Validate jobs and their data, and hold each standard's requirements against the test.\n"
        "Nothing is written. A requirement that is not met is no mistake; the certificate says so.",
        "example:\n  zlmreport check x-axis.yaml",
    )
    add_jobs(parser)
    parser.add_flag("--quiet", "print nothing but mistakes")
    parser.add_flag("--json", JSON_HELP)
    return parser


def init(command: str) -> CommandParser:
    """Return the parser of ``zlmreport init``."""
    parser = CommandParser(
        command,
        "Write a commented job, a laboratory's shared data and sample readings, to begin with.\n"
        "With --machine: a machine file and a job for each file of readings; what nobody but you\n"
        "knows is marked in them. No file that is there already is touched.",
        "examples:\n  zlmreport init first && zlmreport first/job.yaml\n"
        "  zlmreport init mill --machine x-position.csv x-straightness-y.csv ballbar-XY-R150.csv",
    )
    parser.add_argument("directory", metavar="DIR", type=Path, help="folder; it is made if it is not there")
    parser.add_argument(
        "--from",
        dest="origin",
        metavar="FILE",
        type=Path,
        help="measurements that there are: a job that reads them is written instead (see zlmreport look)",
    )
    parser.add_argument(
        "--machine",
        metavar="FILE",
        nargs="+",
        type=Path,
        default=[],
        help="readings of the axes and circles of a machine, or folders of them: a machine file with a job "
        "for each; which error a file holds is taken from its name (EYX.csv, x-pitch.csv)",
    )
    _add_sheet(parser)
    return parser


def look(command: str) -> CommandParser:
    """Return the parser of ``zlmreport look``."""
    parser = CommandParser(
        command,
        "Say what a file of measurements holds, what only its author can say of it, and the source:\n"
        "block of a job that reads it as it is: text in any usual encoding, or a workbook (.xlsx); with\n"
        "lines above and below the table, a row of units, on its side, long or wide.",
        "examples:\n  zlmreport look x-axis.csv\n  zlmreport look protocol.xlsx --sheet Readings\n"
        "  zlmreport init --from x-axis.csv job",
    )
    parser.add_argument("file", metavar="FILE", type=Path, help="a table, or a file of an instrument")
    _add_sheet(parser)
    return parser


def _add_sheet(parser: CommandParser) -> None:
    parser.add_argument(
        "--sheet", metavar="NAME", default="", help="the sheet of a workbook; without it the likeliest one"
    )


def new(command: str) -> CommandParser:
    """Return the parser of ``zlmreport new``."""
    parser = CommandParser(
        command,
        "Write the folder of a plugin that works as it is, with its conformance test: put your own in\n"
        "its place. No file that is there already is touched.",
        "examples:\n  zlmreport new standard shop-rule && python -m pytest shop-rule\n"
        "  zlmreport new effect my-wave --from job.yaml",
    )
    parser.add_argument(
        "kind",
        metavar="KIND",
        help="standard, source, renderer, effect, instrument, program (a part program), controller, "
        "notifier or quantity (a measurand with its standard and its source)",
    )
    parser.add_argument(
        "name", metavar="NAME", help="of the plugin and its folder, as jobs will name it: shop-rule"
    )
    parser.add_argument(
        "--from",
        dest="job",
        metavar="JOB.yaml",
        type=Path,
        help="of an effect: a job with a formula of this name; the plugin gives the same values",
    )
    return parser


def plugins(command: str) -> CommandParser:
    """Return the parser of ``zlmreport plugins``."""
    return CommandParser(
        command,
        "List every plugin found, by kind, with its identifier, title and distribution,\n"
        "and why one failed to load. ZLMREPORT_DISABLE_PLUGINS=name,name switches plugins off.",
    )


def schema(command: str) -> CommandParser:
    """Return the parser of ``zlmreport schema``."""
    return CommandParser(
        command,
        "Print the JSON Schema of the job file, with the keys of all installed plugins.",
        "example, for editors that use the YAML language server: write the schema to a file,\n"
        "  zlmreport schema > job.schema.json\n"
        "and begin the job with the line\n"
        "  # yaml-language-server: $schema=job.schema.json",
    )


def verify(command: str) -> CommandParser:
    """Return the parser of ``zlmreport verify``."""
    parser = CommandParser(
        command,
        "Evaluate a certificate again from the job and the readings that it carries, print it again, and\n"
        "say for every number, page and attached file whether it holds. Nothing is written. A file that\n"
        "was made beside a PDF (json, xml, html, csv, xlsx) is held against the PDF of its name beside it.",
        "example:\n  zlmreport verify CAL-2026-0117.pdf\n\n"
        "exit codes: 0 everything holds; 1 something does not; 2 the file is no certificate of zlmreport,\n"
        "or cannot be evaluated here; 3 the file cannot be read; 5 not decided: something could not be\n"
        "compared here",
    )
    parser.add_argument(
        "certificate", metavar="FILE.pdf", type=Path, help="certificate, signed or not, or a file of one"
    )
    parser.add_flag("--json", "print every finding as JSON")
    parser.add_argument(
        "--trusted",
        metavar="CERT.pem|FOLDER",
        type=Path,
        help="certificates of signers or authorities that are trusted (default: the user's configuration)",
    )
    parser.add_flag("--require-signature", "only what bears an intact signature that is trusted holds")
    parser.add_argument(
        "--dcc-schema",
        metavar="DIR",
        type=Path,
        help="check an attached digital certificate (DCC) by PTB's rules, and by PTB's schema in this folder",
    )
    return parser


def model(command: str) -> CommandParser:
    """Return the parser of ``zlmreport model``."""
    parser = CommandParser(
        command,
        "Work on the error model of a job (its key model.effects):\n\n"
        + "\n".join(f"  {action:9} {text}" for action, text in MODEL_ACTIONS.items())
        + "\n\nThe job is edited in place; comments and layout stay. It is left as it is if the effect\n"
        "makes no sense or explains nothing.",
        "examples:\n"
        "  zlmreport model diagnose configs/hidden-effect/job.yaml\n"
        "  zlmreport model build x-axis.yaml --dry-run\n"
        "  zlmreport model add x-axis.yaml screw-pitch\n"
        "  zlmreport model add x-axis.yaml 'polynomial: {order: 5}'\n"
        "  zlmreport model learn earlier -o priors.yaml",
    )
    parser.add_argument("action", metavar="ACTION", help=", ".join(MODEL_ACTIONS))
    parser.add_argument("job", metavar="JOB.yaml", type=Path, help="job file; of learn: a folder of jobs")
    parser.add_argument(
        "effect",
        metavar="EFFECT",
        nargs="?",
        default="",
        help="of add and remove: an installed effect; add takes it with keys as in a job, too",
    )
    parser.add_repeated(
        "--at", "P", read_position, "of fit: a position, mm or degrees, at which to state the deviation"
    )
    parser.add_output("FILE", "of learn: the file; without it, it is printed")
    parser.add_flag("--dry-run", "of build: show what would be added, and leave the job as it is")
    parser.add_flag("--json", "print the values in full precision as JSON")
    return parser


def machine(command: str) -> CommandParser:
    """Return the parser of ``zlmreport machine``."""
    parser = CommandParser(
        command,
        "Hold a whole machine against its tests:\n\n"
        + "\n".join(f"  {action:12} {text}" for action, text in MACHINE_ACTIONS.items()),
        "examples:\n  zlmreport machine predict configs/machine/machine.yaml",
    )
    parser.add_argument("action", metavar="ACTION", help=", ".join(MACHINE_ACTIONS))
    parser.add_argument("job", metavar="MACHINE.yaml", type=Path, help="machine file")
    parser.add_argument(
        "effect", metavar="EFFECT", nargs="?", default="", help="of add and remove: an effect of circles"
    )
    parser.add_output("DIR", "folder, of certificate (out beside the file without it) and of compensate")
    parser.add_argument(
        "--format", metavar="F,F", help="of certificate: formats, parted by commas; without it pdf,json"
    )
    parser.add_argument("--controller", metavar="NAME", help="of compensate: for which control")
    parser.add_argument(
        "--moves",
        choices=("plus", "minus"),
        help="of compensate: which way a positive value moves an axis, where that is not known",
    )
    parser.add_repeated(
        "--confirm",
        "CIRCLE.yaml",
        Path,
        "of compensate: job of a circle that was run again with the tables in effect",
    )
    parser.add_flag("--trial", "of compensate: a file with one value, which shows that way")
    parser.add_argument(
        "--step", metavar="MM", type=read_number, help="of compensate: between rows; as measured without it"
    )
    parser.add_flag("--dry-run", "of build: write nothing")
    parser.add_flag("--json", "print the values in full precision as JSON")
    return parser


def demand_action(command: str, options: argparse.Namespace, parser: CommandParser) -> None:
    """Refuse an action of ``model`` or ``machine`` that there is not, and what does not belong to it."""
    actions, example, options_of = _ACTIONS[command]
    action = options.action
    if action not in actions:
        parser.error(f"unknown action {action!r}; {did_you_mean(action, list(actions))}")
    takes_effect = action in {"add", "remove"}
    if takes_effect and not options.effect.strip():
        parser.error(f"{action} needs the name of an effect, such as {example}")
    for name, belonging in options_of.items():
        given = getattr(options, name)
        if given is not None and given is not False and given != [] and action not in belonging:
            parser.error(f"--{name.replace('_', '-')} belongs to {' and '.join(belonging)}, not to {action}")
    if not takes_effect and options.effect:
        parser.error(f"{action} takes no effect, but {options.effect!r} is given")
    if command == "machine" and options.trial and options.confirm:
        parser.error("--trial writes one value, --confirm holds circles against tables: take one of them")


def surface(command: str) -> CommandParser:
    """Return the parser of ``zlmreport surface``."""
    parser = CommandParser(
        command,
        "Fit the deviation of an axis over a plane of two axes. Each job measures one line; its key\n"
        "measurement.plane says where: {axis: Y, at: 200}. Printed are the polynomial of each direction\n"
        "of approach, and the deviation at points of the plane with its expanded uncertainty.",
        "example:\n  zlmreport surface y-100.yaml y-200.yaml y-300.yaml y-400.yaml --at 250,130",
    )
    add_jobs(parser)
    parser.add_repeated(
        "--at",
        "P,R",
        read_point,
        "a point: positions of the axis under test and of the second one, mm (--at=-20,130 for one that "
        "is negative)",
    )
    parser.add_flag("--json", "print the values in full precision as JSON (zlmreport/surface/1)")
    return parser


def fleet(command: str) -> CommandParser:
    """Return the parser of ``zlmreport fleet``."""
    parser = CommandParser(
        command,
        "Make the certificates of a fleet that are due: new ones, and those whose job, readings, shared\n"
        "files, plugins or program changed. What was issued under a number is never replaced: another\n"
        "content becomes a draft. A job that fails does so alone, and is tried again the next night; one\n"
        "that exceeds its limits twice is set aside until something about it changes.",
        "examples:\n"
        "  zlmreport fleet fleet.yaml --dry-run\n"
        "  zlmreport fleet fleet.yaml --quiet --log-json\n\n"
        "further commands, each with its own --help:\n"
        "  zlmreport fleet report   the overview of a fleet: who fails, who drifts\n"
        "  zlmreport fleet backup   a copy of its ledger\n"
        "  zlmreport fleet rebuild  its ledger made again from its certificates\n\n"
        "exit codes: 0 done; 2 the fleet file is wrong; 3 the ledger cannot be used, or another night is at\n"
        "work on it; 4 done, but jobs failed, or something is missing that should be there",
    )
    _add_fleet(parser)
    parser.add_flag("--dry-run", "say what would be done, and why; make and write nothing")
    parser.add_argument(
        "--workers", metavar="N", type=_read_workers, help="number of processes, instead of the fleet file's"
    )
    parser.add_argument(
        "--max-time",
        metavar="MINUTES",
        type=_read_minutes,
        help="begin no job after that; the rest is the next night's",
    )
    parser.add_flag("--quiet", "print nothing but failures")
    parser.add_flag("--json", "print what became of every job as JSON")
    parser.add_flag("--log-json", "log each job as a line of JSON")
    return parser


def fleet_report(command: str) -> CommandParser:
    """Return the parser of ``zlmreport fleet report``."""
    parser = CommandParser(
        command,
        "Write the overview of a fleet from its ledger: the state of every axis, failures, limits that are\n"
        "not met, who drifts, with small graphs; the same numbers as a text file for Prometheus; and a\n"
        "calendar of the tests that are due.",
        "example:\n  zlmreport fleet report fleet.yaml --output overview",
    )
    _add_fleet(parser)
    parser.add_output("DIR", "folder of the overview")
    return parser


def fleet_backup(command: str) -> CommandParser:
    """Return the parser of ``zlmreport fleet backup``."""
    parser = CommandParser(
        command,
        "Copy the ledger of a fleet into one file, whatever database it is in, even while a night works.\n"
        "The file is a ledger itself: name it in the fleet file to work with it.",
        "example:\n  zlmreport fleet backup fleet.yaml -o backup/fleet.ledger.db",
    )
    _add_fleet(parser)
    parser.add_argument("-o", "--output", metavar="FILE", type=Path, required=True, help="file of the copy")
    return parser


def fleet_rebuild(command: str) -> CommandParser:
    """Return the parser of ``zlmreport fleet rebuild``."""
    parser = CommandParser(
        command,
        "Make the ledger of a fleet again, where it is lost, from the certificates in its folder: their\n"
        "results files, or those that their PDFs carry. The next night makes each anew, and compares.",
        "example:\n  zlmreport fleet rebuild fleet.yaml\n\n"
        "exit codes: 0 done; 2 the ledger is there already; 4 done, but files could not be taken",
    )
    _add_fleet(parser)
    return parser


def _read_minutes(text: str) -> float:
    with contextlib.suppress(ValueError):
        minutes = float(text)
        if 0 < minutes < math.inf:
            return minutes
    raise argparse.ArgumentTypeError(f"{quoted(text)} is no number of minutes; write 90")


def _read_workers(text: str) -> int:
    if WHOLE_NUMBER.fullmatch(text) and 0 < int(text) <= _MOST_WORKERS:
        return int(text)
    raise argparse.ArgumentTypeError(f"{quoted(text)} is no number of processes; write 2")


def _add_fleet(parser: CommandParser) -> None:
    parser.add_argument("fleet", metavar="FLEET.yaml", type=Path, help="fleet file")


def workbench(command: str) -> CommandParser:
    """Return the parser of ``zlmreport workbench``."""
    parser = CommandParser(
        command,
        "Open the error model of a job as a web page of this computer: compare the model with the\n"
        "readings, see where it fails, add what is missing, watch the error fall. Every click is\n"
        "written into the job (comments stay) and recorded beside it. Further jobs are other tests of\n"
        "the axis: they are laid over the first, and nothing is written into them. A machine file opens\n"
        "the same loop for a whole machine. A folder opens as a list of its jobs and machines: what\n"
        "fails, what is due. The page opens by the printed address alone.",
        "examples:\n  zlmreport workbench x-axis.yaml\n  zlmreport workbench after.yaml before.yaml\n"
        "  zlmreport workbench machine.yaml\n"
        "  zlmreport workbench jobs/\n  zlmreport workbench readings.csv\n"
        "  zlmreport workbench x-axis.yaml --port 8420 --no-browser",
    )
    parser.add_argument(
        "jobs",
        metavar="JOB.yaml",
        type=Path,
        nargs="+",
        help="job file, then those of other tests of it; or a machine file, or a folder of them; or a file\n"
        "of readings, for which a job is written beside it",
    )
    parser.add_argument(
        "--port", metavar="N", type=read_port, default=0, help="a TCP port; without it any free one"
    )
    parser.add_flag("--no-browser", "print the address, and open no browser")
    return parser
