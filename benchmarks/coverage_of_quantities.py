"""Whether y ± U holds for straightness, angle, squareness, circles, flatness, drift and diagonals.

Each quantity has a machine, or a plate, that is known, and a job as a laboratory writes it. In each of its
worlds the errors of the measuring set-up are drawn as they truly go, and added; what the instrument would
have shown is budgeted and evaluated as by ``zlmreport JOB.yaml``, and y ± U of each parameter is held
against that of the true readings. A world states to the job what it does, and nothing else.
"""

from __future__ import annotations

import argparse
import json
import re
import tempfile
from collections.abc import Iterable, Mapping
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
import yaml

from known_machines import QUANTITIES, Quantity
from set_ups import Lines, World, readings_of
from shares import Held, keep, print_table, share_held
from zlmreport import pipeline
from zlmreport.evaluation.uncertainty.budget import Budget
from zlmreport.evaluation.uncertainty.monte_carlo import propagate
from zlmreport.job.job import Job
from zlmreport.job.loading import load
from zlmreport.measurement.arrays import FloatArray, read_only_floats
from zlmreport.measurement.measurement_set import MeasurementSet
from zlmreport.plugin.registry import Registry, find_plugins

_SEED = 20261127


def merged(keys: Mapping[str, Any], more: Mapping[str, Any]) -> dict[str, Any]:
    """Return keys with others under them, section by section."""
    found = dict(keys)
    for name, value in more.items():
        own = found.get(name)
        both = isinstance(own, Mapping) and isinstance(value, Mapping)
        found[name] = merged(own, value) if both else value
    return found


def job_of(quantity: Quantity, world: World, folder: Path, registry: Registry) -> Job:
    """Return the job of a world, with the readings of the machine as files beside it."""
    keys = merged(quantity.keys, world.stated)
    keys = merged(
        {"schema": "zlmreport/job/1", "certificate": {"number": "1", "kind": "report"}, "output": {}}, keys
    )
    for name, content in quantity.files.items():
        (folder / name).write_text(content, encoding="utf-8")
    path = folder / "job.yaml"
    path.write_text(yaml.safe_dump(keys, allow_unicode=True), encoding="utf-8")
    return load(path, registry)


def lines_of(measurements: MeasurementSet) -> Lines:
    """Return what was measured by the names of its lines; of a single line by no name."""
    return measurements.tests or {"": measurements}


def with_readings(measurements: MeasurementSet, readings: Mapping[str, FloatArray]) -> MeasurementSet:
    """Return measured lines with other readings, in their unit."""
    changed = {
        name: replace(line, deviation=read_only_floats(line.axis.deviation_unit.to_si(readings[name])))
        for name, line in lines_of(measurements).items()
    }
    return replace(measurements, tests=changed) if measurements.tests else changed[""]


def held_in(
    quantity: Quantity, world: World, registry: Registry, trials: int, simulated: int
) -> dict[str, float]:
    """Return the share of tests of a world in which y ± U holds the true value, by symbol."""
    with tempfile.TemporaryDirectory() as folder:
        job = job_of(quantity, world, Path(folder), registry)
        frame = pipeline.read_whole(job, registry)
    arithmetics = [
        partial(standard.arithmetic, options=options)
        for standard, options in pipeline.choose_standards(job, registry)
    ]

    def trial(generator: np.random.Generator) -> Held:
        truth = with_readings(
            frame,
            {
                name: readings_of(line) + quantity.scatter * generator.standard_normal(len(line.deviation))
                for name, line in lines_of(frame).items()
            },
        )
        shown = {name: readings_of(line).copy() for name, line in lines_of(truth).items()}
        for error in world.errors:
            for name, added in error(lines_of(truth), generator).items():
                shown[name] += added
        spoilt = with_readings(
            frame, {name: np.round(each / quantity.step) * quantity.step for name, each in shown.items()}
        )
        budget = pipeline.make_budget_of_job(job, spoilt, registry)
        assert isinstance(budget, Budget)
        assert budget.is_complete, budget.missing
        found = pipeline.evaluate_parameters(job, spoilt, registry)
        true = pipeline.evaluate_parameters(job, truth, registry)
        stated = propagate(budget, list(zip(found, arithmetics, strict=True)), simulated)
        return {
            each.quantity.symbol: abs(each.value - (of_truth.value(each.quantity.symbol) or 0.0))
            <= expanded[each.quantity.symbol].uncertainty
            for evaluation, of_truth, expanded in zip(found, true, stated, strict=True)
            for each in evaluation.parameters
            if each.quantity.symbol not in quantity.left_out
        }

    return share_held(trial, trials, _SEED)


def read(results: Path) -> list[dict[str, Any]]:
    """Return what a file keeps of worlds, a row for each."""
    return [json.loads(line) for line in results.read_text(encoding="utf-8").splitlines()]


def tables(kept: Iterable[Mapping[str, Any]]) -> str:
    """Return a table for each quantity, as a page prints it: of a world the row that was kept last."""
    last = {(row["title"], row["world"]): row for row in kept}
    lines = []
    for name, quantity in QUANTITIES.items():
        heads = " | ".join(map(_write_symbol, quantity.symbols))
        lines += [
            "",
            f"| {name.capitalize()} | tests | {heads} |",
            f"|---|{'--:|' * (1 + len(quantity.symbols))}",
        ]
        for world in quantity.worlds:
            if row := last.get((name, world)):
                held = (row["held"].get(symbol) for symbol in quantity.symbols)
                cells = " | ".join("–" if each is None else f"{100 * each:.1f}" for each in held)
                lines.append(f"| {world} | {row['trials']} | {cells} |")
    return "\n".join(lines).lstrip()


def _write_symbol(symbol: str) -> str:
    """Return a symbol as a page writes it."""
    arrows = symbol.replace("_fwd", "↑").replace("_bwd", "↓").replace("slope", "m")
    return re.sub(r"_([A-Za-z0-9_]+)", lambda found: f"<sub>{found[1].replace('_', ' ')}</sub>", arrows)


def main(arguments: list[str] | None = None) -> None:
    """Print a table for each quantity: a row for each world, a column for each parameter, in percent."""
    parser = argparse.ArgumentParser(prog="./run benchmark quantities", description=__doc__)
    parser.add_argument("--trials", type=int, default=400, help="tests of each world (%(default)s)")
    parser.add_argument("--simulated", type=int, default=2000, help="simulated tests of each (%(default)s)")
    parser.add_argument("--keep", type=Path, metavar="FILE", help="also add a line of JSON for each world")
    parser.add_argument(
        "--world", default="", metavar="WORD", help="only worlds that have this in their names"
    )
    parser.add_argument(
        "quantities", nargs="*", metavar="QUANTITY", default=list(QUANTITIES), help=", ".join(QUANTITIES)
    )
    sizes = parser.parse_args(arguments)
    unknown = [name for name in sizes.quantities if name not in QUANTITIES]
    if unknown:
        parser.error(f"{unknown[0]!r} is none of {', '.join(QUANTITIES)}")
    registry = find_plugins()
    for name in sizes.quantities:
        quantity = QUANTITIES[name]

        def rows(
            quantity: Quantity = quantity, name: str = name
        ) -> Iterable[tuple[str, Mapping[str, float]]]:
            for called, world in quantity.worlds.items():
                if sizes.world not in called:
                    continue
                shares = held_in(quantity, world, registry, sizes.trials, sizes.simulated)
                keep(sizes.keep, name, sizes.trials, called, shares)
                yield called, shares

        print_table(name, quantity.symbols, rows())
