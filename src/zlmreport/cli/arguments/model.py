"""The commands of the error model."""

from __future__ import annotations

import argparse
from pathlib import Path

from zlmreport.cli.arguments.parser import CommandParser, add_jobs
from zlmreport.cli.arguments.values import point, position
from zlmreport.errors import did_you_mean

_MODEL_ACTIONS = {
    "fit": "the parameters with their uncertainties, and the error that is left",
    "diagnose": "where the model fails, and which effect is missing",
    "add": "write an effect into the job, and show the error before and after",
    "remove": "take an effect out of the job, and show the same",
    "history": "how the error fell, effect by effect",
}


def model(command: str) -> CommandParser:
    """Return the parser of ``zlmreport model``."""
    parser = CommandParser(
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
        type=position,
        action="append",
        default=[],
        help="of fit: a position, mm or degrees, at which to state the deviation; may be given several times",
    )
    parser.add_argument("--json", action="store_true", help="print the values in full precision as JSON")
    return parser


def demand_model_action(options: argparse.Namespace, parser: CommandParser) -> None:
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


def surface(command: str) -> CommandParser:
    """Return the parser of ``zlmreport surface``."""
    parser = CommandParser(
        f"zlmreport {command}",
        "Fit the deviation of an axis over a plane of two axes. Each job measures one line; its key\n"
        "measurement.plane says where: {axis: Y, at: 200}. Printed are the polynomial of each direction\n"
        "of approach, and the deviation at points of the plane with its expanded uncertainty.",
        "example:\n  zlmreport surface y-100.yaml y-200.yaml y-300.yaml y-400.yaml --at 250,130",
    )
    add_jobs(parser)
    parser.add_argument(
        "--at",
        metavar="P,R",
        type=point,
        action="append",
        default=[],
        help="a point: positions of the axis under test and of the second one, mm (--at=-20,130 for one that "
        "is negative); may be given several times",
    )
    parser.add_argument(
        "--json", action="store_true", help="print the values in full precision as JSON (zlmreport/surface/1)"
    )
    return parser
