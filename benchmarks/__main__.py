"""Run the benchmarks: ``./run benchmark [NAME …]``."""

from __future__ import annotations

import argparse
import sys
from importlib import import_module
from pathlib import Path

import capturing
import cold
import memory
import report
import stacked
import typst_side_by_side
import warm
from measure import Measured, Sizes, own_process

BENCHMARKS = {
    "warm": ("One certificate, warm", warm.measure),
    "cold": ("Start of the command", cold.measure),
    "evaluation": ("Stacked tests", stacked.measure),
    "typst": ("PDF by WeasyPrint and by Typst", typst_side_by_side.measure),
    "capture": ("Live capture", capturing.measure),
    "memory": ("Memory of a process that makes many certificates", memory.measure),
}
#: With words of their own: the modules that hold them, which would weigh on the others, and what begins them.
OTHERS = {
    "hidden-effects": ("hidden_effects.command", "main"),
    "experiments": ("hidden_effects.command", "main_of_experiments"),
    "several": ("hidden_effects.several", "main"),
    "irregular": ("hidden_effects.irregular", "main"),
    "owners": ("hidden_effects.owners", "main"),
    "priors": ("hidden_effects.command", "main_of_priors"),
    "coverage": ("coverage_of_u", "main"),
    "worlds": ("coverage_of_worlds", "main"),
    "quantities": ("coverage_of_quantities", "main"),
    "machines": ("machines_hidden", "main"),
    "machine-bands": ("machine_bands", "main"),
    "machine-circles": ("circles_on_linuxcnc", "main"),
    "closed-loops": ("closed_loops", "main"),
    "step-gauge": ("step_gauge_coverage", "main"),
    "kills": ("kills", "main"),
    "fleet": ("fleet_nights", "main"),
    "thousand": ("fleet_thousand", "main"),
    "trends": ("fleet_trends", "main"),
    "unchanged": ("fleet_unchanged", "main"),
    "hops": ("hops", "main"),
}


def main() -> None:
    """Measure what the command line names, print tables, and write JSON if asked to."""
    other = OTHERS.get(sys.argv[1] if len(sys.argv) > 1 else "")
    if other:
        module, function = other
        getattr(import_module(module), function)(sys.argv[2:])
        return
    arguments = _parser().parse_args()
    sizes = Sizes(arguments.rounds, arguments.tests, arguments.certificates)
    results: dict[str, list[Measured]] = {}
    for name in arguments.names or BENCHMARKS:
        title, measure = BENCHMARKS[name]
        with own_process() as process:
            results[name] = process.submit(measure, sizes).result()
        print(report.table(title, results[name]), end="\n\n", flush=True)
        if arguments.json:
            report.write_json(arguments.json, results)


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="./run benchmark",
        description="Measure zlmreport against a plain recipe.",
        epilog="./run benchmark hidden-effects, experiments, several, irregular, priors, coverage, worlds, "
        "quantities, machines, machine-bands, machine-circles, step-gauge, kills have options of their own: "
        "see their --help.",
    )
    parser.add_argument("names", nargs="*", type=_benchmark, metavar="NAME", help=", ".join(BENCHMARKS))
    parser.add_argument(
        "--rounds", type=int, default=16, help="repetitions; the first only warms (%(default)s)"
    )
    parser.add_argument("--tests", type=int, default=100_000, help="tests in the stack (%(default)s)")
    parser.add_argument(
        "--certificates", type=int, default=300, help="certificates of one process (%(default)s)"
    )
    parser.add_argument("--json", type=Path, metavar="FILE", help="also write the results there")
    return parser


def _benchmark(name: str) -> str:
    if name not in BENCHMARKS:
        raise argparse.ArgumentTypeError(f"{name!r} is none of {', '.join(BENCHMARKS)}")
    return name


if __name__ == "__main__":
    main()
