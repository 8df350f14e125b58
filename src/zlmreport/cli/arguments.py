"""The commands with their options, and what is said of an option or a command that there is not."""

from __future__ import annotations

import argparse
import math
from collections.abc import Sequence
from pathlib import Path
from typing import Any, NoReturn

from zlmreport import __version__
from zlmreport.errors import InputError, Place, did_you_mean

#: The job's own name, for it has no word of its own on the command line.
MAIN_JOB = "report"

#: Environment variable with the password of the key that signs.
SIGN_PASSWORD = "ZLMREPORT_SIGN_PASSWORD"  # noqa: S105 (a name)

_COMMANDS = {
    "check": "validate jobs, their data and the tests; write nothing",
    "emulate": "put an instrument that is not there on a line, to try capture without hardware",
    "init": "write a commented job with sample data that runs as it is",
    "model": "fit a job's error model, find what it lacks, add it, watch the error fall",
    "plan": "choose targets and their sequence, and say what such a test will not see",
    "plugins": "list the plugins found, and why one failed to load",
    "schema": "print the JSON Schema of the job file, for editors",
    "simulate": "write simulated readings of a described axis, and a job for them",
    "verify": "evaluate a certificate again from what it carries, and say whether it holds",
    "surface": "fit the deviation over a plane, from lines that were measured in it",
}

_MAIN_DESCRIPTION = f"""\
Read the measurements that a job names, evaluate them by its standards, and write
the certificate.

other commands:
{chr(10).join(f"  {name:9} {text}" for name, text in _COMMANDS.items())}
"""
_MAIN_EPILOG = """\
examples:
  zlmreport init first && zlmreport first/job.yaml
  zlmreport x-axis.yaml y-axis.yaml --output certificates
  zlmreport x-axis.yaml --format pdf,html,json --fail-on-nonconformity

exit codes: 0 done; 1 done, but a limit is not met (only with --fail-on-nonconformity);
2 a job, its data or the command line is wrong; 3 a file could not be read or written
"""
_JSON_HELP = "print a machine-readable summary (zlmreport/summary/1) instead of tables"


def parse(arguments: Sequence[str]) -> tuple[str, argparse.Namespace]:
    """Return the command with its options.

    Raises
    ------
    InputError
        If there is no such command or option, with the nearest that there is.
    SystemExit
        After ``--help`` and ``--version`` have been printed.
    """
    command, *rest = arguments or [""]
    if command in _COMMANDS:
        parser = _PARSERS[command](command)
        options = parser.parse_strictly(rest)
        if command == "model":
            _demand_model_action(options, parser)
        return command, options
    options = _main_job().parse_strictly(arguments)
    for job in options.jobs:
        _refuse_mistaken_command(job)
    return MAIN_JOB, options


class _Parser(argparse.ArgumentParser):
    """A parser whose errors are problems like all others, and name the nearest option."""

    def __init__(self, program: str, description: str, epilog: str = "") -> None:
        super().__init__(
            program,
            description=description,
            epilog=epilog,
            formatter_class=argparse.RawDescriptionHelpFormatter,
            allow_abbrev=False,
        )
        self._known = ["--help"]
        self.add_argument(
            "--plugin",
            metavar="FILE",
            type=Path,
            action="append",
            default=[],
            help="a plugin in a file of its own, beside the installed ones; may be given several times",
        )

    def add_argument(self, *names: Any, **settings: Any) -> argparse.Action:
        """Add an argument, and remember its long names."""
        action = super().add_argument(*names, **settings)
        if hasattr(self, "_known"):
            self._known.extend(name for name in names if name.startswith("--"))
        return action

    def parse_strictly(self, arguments: Sequence[str]) -> argparse.Namespace:
        options, unknown = self.parse_known_args(arguments)
        if unknown:
            name = unknown[0].partition("=")[0]
            if name.startswith("-"):
                self.error(f"unknown option {name!r}; {did_you_mean(name, self._known)}")
            self.error(f"{name!r} is one argument too many")
        return options

    def error(self, message: str) -> NoReturn:
        raise InputError.at(Place(self.prog), f"{message} (see {self.prog} --help)")


def _refuse_mistaken_command(job: Path) -> None:
    """Take a word that is no file for a command that there is not."""
    word = str(job)
    if job.suffix or job.name != word or job.exists():
        return
    if word in _COMMANDS:
        raise InputError.at(Place("zlmreport"), f"the command comes first: zlmreport {word} …")
    raise InputError.at(
        Place("zlmreport"),
        f"{word!r} is neither a file nor a command; {did_you_mean(word, list(_COMMANDS))}",
    )


def _main_job() -> _Parser:
    parser = _Parser("zlmreport", _MAIN_DESCRIPTION, _MAIN_EPILOG)
    parser.add_argument("--version", action="version", version=f"zlmreport {__version__}")
    _add_jobs(parser)
    parser.add_argument(
        "-o", "--output", metavar="DIR", type=Path, help="folder of the files, instead of the job's"
    )
    parser.add_argument(
        "--format", metavar="F,F", help="formats, parted by commas, instead of the job's: pdf,html,json"
    )
    parser.add_argument(
        "--sign",
        metavar="ID",
        help="sign the PDF with the key in a PKCS#12 file (ID.p12) or a token (pkcs11:…); its password is "
        f"asked for, or stands in the environment variable {SIGN_PASSWORD}",
    )
    parser.add_argument("--quiet", action="store_true", help="print nothing but mistakes")
    parser.add_argument("--json", action="store_true", help=_JSON_HELP)
    parser.add_argument(
        "--fail-on-nonconformity", action="store_true", help="exit with 1 if a stated limit is not met"
    )
    return parser


def _check(command: str) -> _Parser:
    parser = _Parser(
        f"zlmreport {command}",
        "Validate jobs and their data, and hold each standard's requirements against the test.\n"
        "Nothing is written. A requirement that is not met is no mistake; the certificate says so.",
        "example:\n  zlmreport check x-axis.yaml",
    )
    _add_jobs(parser)
    parser.add_argument("--quiet", action="store_true", help="print nothing but mistakes")
    parser.add_argument("--json", action="store_true", help=_JSON_HELP)
    return parser


def _init(command: str) -> _Parser:
    parser = _Parser(
        f"zlmreport {command}",
        "Write a commented job, a laboratory's shared data and sample readings, to begin with.\n"
        "No file that is there already is touched.",
        "example:\n  zlmreport init first && zlmreport first/job.yaml",
    )
    parser.add_argument("directory", metavar="DIR", type=Path, help="folder; it is made if it is not there")
    return parser


def _emulate(command: str) -> _Parser:
    parser = _Parser(
        f"zlmreport {command}",
        "Put an instrument that is not there on a pseudo-terminal, or on a TCP port of this computer. It\n"
        "watches an axis that goes from position to position, and speaks as the real instrument does.\n"
        "It runs until Ctrl-C; 'zlmreport plugins' lists the instruments.",
        "examples:\n"
        "  zlmreport emulate umd1\n"
        "  zlmreport emulate umd1 --link interferometer --course 0,100,200,100,0 --fault lost-beam@30\n"
        "  zlmreport emulate ids3010 --port 9090",
    )
    parser.add_argument("instrument", metavar="INSTRUMENT", help="umd1, nd28x, ids3010 or another")
    parser.add_argument(
        "--link", metavar="PATH", type=Path, help="a name for the pseudo-terminal that stays the same"
    )
    parser.add_argument(
        "--port", metavar="N", type=_port, help="a TCP port instead of a pseudo-terminal; 0 for any free one"
    )
    parser.add_argument(
        "--course",
        metavar="P,P",
        type=_course,
        default=(0.0, 100.0, 200.0, 100.0),
        help="positions that the axis goes to in turn, over and over, mm (--course=-5,0 for one that begins "
        "with a negative); 0,100,200,100 without it",
    )
    for name, metavar, without, meaning in (
        ("dwell", "S", 5.0, "how long the axis rests at each position, s"),
        ("feed", "F", 3000.0, "how fast it goes, mm/min"),
        ("noise", "U", 0.05, "standard deviation of what shakes it, micrometres"),
        ("drift", "V", 0.0, "by how much everything moves away, micrometres a minute"),
    ):
        parser.add_argument(
            f"--{name}",
            metavar=metavar,
            type=_position,
            default=without,
            help=f"{meaning}; {without:g} without it",
        )
    parser.add_argument(
        "--fault",
        metavar="KIND@S",
        type=_fault,
        action="append",
        default=[],
        help=f"what goes wrong, and how many seconds after the start: {', '.join(_FAULTS)}; may be given "
        "several times. An instrument shows only what its protocol can say",
    )
    return parser


#: As `zlmreport.emulation.faults` knows them; a test holds the two together.
_FAULTS = ("lost-beam", "skipped", "error", "garbled", "unplugged")


def _fault(text: str) -> tuple[str, float]:
    """Read a fault and when it happens."""
    kind, _, moment = text.partition("@")
    if kind not in _FAULTS:
        raise argparse.ArgumentTypeError(f"{kind!r} is no fault; {did_you_mean(kind, _FAULTS)}")
    try:
        start = float(moment)
    except ValueError:
        start = math.nan
    if not (math.isfinite(start) and start >= 0):
        raise argparse.ArgumentTypeError(f"{text!r} does not say when; write seconds, such as {kind}@30")
    return kind, start


def _course(text: str) -> tuple[float, ...]:
    """Read positions, parted by commas."""
    return tuple(_position(part) for part in text.split(","))


def _port(text: str) -> int:
    """Read the number of a TCP port."""
    if not (text.isascii() and text.isdigit() and int(text) < 65_536):
        raise argparse.ArgumentTypeError(f"{text!r} is no TCP port; write a number up to 65535, such as 9090")
    return int(text)


def _plugins(command: str) -> _Parser:
    return _Parser(
        f"zlmreport {command}",
        "List every plugin found, by kind, with its identifier, title and distribution,\n"
        "and why one failed to load. ZLMREPORT_DISABLE_PLUGINS=name,name switches plugins off.",
    )


def _schema(command: str) -> _Parser:
    return _Parser(
        f"zlmreport {command}",
        "Print the JSON Schema of the job file, with the keys of all installed plugins.",
        "example, for editors that use the YAML language server: write the schema to a file,\n"
        "  zlmreport schema > job.schema.json\n"
        "and begin the job with the line\n"
        "  # yaml-language-server: $schema=job.schema.json",
    )


def _simulate(command: str) -> _Parser:
    parser = _Parser(
        f"zlmreport {command}",
        "Write simulated readings of an axis: its effects, noise, conditions and the plan of its test\n"
        "are described in a file. A job that evaluates them is written beside, unless it is there.",
        "example:\n  zlmreport simulate configs/hidden-effect/simulation.yaml --output trial",
    )
    parser.add_argument(
        "specification", metavar="SPEC.yaml", type=Path, help="simulation file (zlmreport/simulation/1)"
    )
    parser.add_argument(
        "-o", "--output", metavar="DIR", type=Path, help="folder of the files, instead of the simulation's"
    )
    return parser


def _plan(command: str) -> _Parser:
    parser = _Parser(
        f"zlmreport {command}",
        "Plan the test of a job before anything is measured: target positions with random fractions, the\n"
        "sequence of its positioning method, and what such a test will see of each installed effect.\n"
        "The readings that the job names need not exist. Numbers come from its key plan.",
        "examples:\n  zlmreport plan x-axis.yaml\n"
        "  zlmreport plan x-axis.yaml --output plan --program linuxcnc",
    )
    parser.add_argument("job", metavar="JOB.yaml", type=Path, help="job file")
    parser.add_argument(
        "-o",
        "--output",
        metavar="DIR",
        type=Path,
        help="write the targets, a form for the readings, a picture of the sequence and part programs into "
        "this folder",
    )
    parser.add_argument(
        "--program",
        metavar="P,P",
        help="with --output: part programs, parted by commas, instead of the job's: linuxcnc,fanuc",
    )
    parser.add_argument("--json", action="store_true", help="print the plan as JSON (zlmreport/plan/1)")
    return parser


def _surface(command: str) -> _Parser:
    parser = _Parser(
        f"zlmreport {command}",
        "Fit the deviation of an axis over a plane of two axes. Each job measures one line; its key\n"
        "measurement.plane says where: {axis: Y, at: 200}. Printed are the polynomial of each direction\n"
        "of approach, and the deviation at points of the plane with its expanded uncertainty.",
        "example:\n  zlmreport surface y-100.yaml y-200.yaml y-300.yaml y-400.yaml --at 250,130",
    )
    _add_jobs(parser)
    parser.add_argument(
        "--at",
        metavar="P,R",
        type=_point,
        action="append",
        default=[],
        help="a point: positions of the axis under test and of the second one, mm (--at=-20,130 for one that "
        "is negative); may be given several times",
    )
    parser.add_argument(
        "--json", action="store_true", help="print the values in full precision as JSON (zlmreport/surface/1)"
    )
    return parser


def _position(text: str) -> float:
    """Read a position."""
    try:
        position = float(text)
    except ValueError:
        position = math.nan
    if not math.isfinite(position):
        raise argparse.ArgumentTypeError(f"{text!r} is no position; write a number, such as 250")
    return position


def _point(text: str) -> tuple[float, float]:
    """Read two positions, parted by a comma."""
    along, _, across = text.partition(",")
    try:
        point = float(along), float(across)
    except ValueError:
        point = math.nan, math.nan
    if not all(map(math.isfinite, point)):
        raise argparse.ArgumentTypeError(f"{text!r} is no point; write two positions in mm, such as 250,130")
    return point


def _verify(command: str) -> _Parser:
    parser = _Parser(
        f"zlmreport {command}",
        "Evaluate a certificate again from the job and the readings that it carries, print it again, and\n"
        "say for every number, page and attached file whether it holds. Nothing is written.",
        "example:\n  zlmreport verify CAL-2026-0117.pdf\n\n"
        "exit codes: 0 everything holds; 1 something does not; 2 the file is no certificate of zlmreport,\n"
        "or cannot be evaluated here; 3 the file cannot be read",
    )
    parser.add_argument("certificate", metavar="FILE.pdf", type=Path, help="certificate, signed or not")
    parser.add_argument("--json", action="store_true", help="print every finding as JSON")
    parser.add_argument(
        "--dcc-schema",
        metavar="DIR",
        type=Path,
        help="check an attached digital certificate (DCC) by PTB's rules, and by PTB's schema in this folder",
    )
    return parser


_MODEL_ACTIONS = {
    "fit": "the parameters with their uncertainties, and the error that is left",
    "diagnose": "where the model fails, and which effect is missing",
    "add": "write an effect into the job, and show the error before and after",
    "remove": "take an effect out of the job, and show the same",
    "history": "how the error fell, effect by effect",
}


def _model(command: str) -> _Parser:
    parser = _Parser(
        f"zlmreport {command}",
        "Work on the error model of a job (its key model.effects):\n\n"
        + "\n".join(f"  {action:9} {text}" for action, text in _MODEL_ACTIONS.items())
        + "\n\nThe job is edited in place; comments and layout stay. It is left as it is if the effect\n"
        "makes no sense or explains nothing.",
        "examples:\n"
        "  zlmreport model diagnose configs/hidden-effect/job.yaml\n"
        "  zlmreport model add x-axis.yaml screw-pitch\n"
        "  zlmreport model add x-axis.yaml 'polynomial: {order: 5}'",
    )
    parser.add_argument("action", metavar="ACTION", help=", ".join(_MODEL_ACTIONS))
    parser.add_argument("job", metavar="JOB.yaml", type=Path, help="job file")
    parser.add_argument(
        "effect",
        metavar="EFFECT",
        nargs="?",
        default="",
        help="of add and remove: an installed effect; add takes it with keys as in a job, too",
    )
    parser.add_argument(
        "--at",
        metavar="P",
        type=_position,
        action="append",
        default=[],
        help="of fit: a position, mm or degrees, at which to state the deviation; may be given several times",
    )
    parser.add_argument("--json", action="store_true", help="print the values in full precision as JSON")
    return parser


def _demand_model_action(options: argparse.Namespace, parser: _Parser) -> None:
    """Refuse an action that there is not, and an effect that is missing or too much."""
    if options.action not in _MODEL_ACTIONS:
        parser.error(
            f"unknown action {options.action!r}; {did_you_mean(options.action, list(_MODEL_ACTIONS))}"
        )
    takes_effect = options.action in {"add", "remove"}
    if takes_effect and not options.effect.strip():
        parser.error(f"{options.action} needs the name of an effect, such as backlash")
    if options.at and options.action != "fit":
        parser.error(f"--at belongs to fit, not to {options.action}")
    if not takes_effect and options.effect:
        parser.error(f"{options.action} takes no effect, but {options.effect!r} is given")


_PARSERS = {
    "check": _check,
    "emulate": _emulate,
    "init": _init,
    "model": _model,
    "plan": _plan,
    "plugins": _plugins,
    "schema": _schema,
    "simulate": _simulate,
    "verify": _verify,
    "surface": _surface,
}


def _add_jobs(parser: _Parser) -> None:
    parser.add_argument("jobs", metavar="JOB.yaml", nargs="+", type=Path, help="job files")
