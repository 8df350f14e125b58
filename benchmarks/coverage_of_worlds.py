"""Whether the intervals of a whole job hold what they are said to hold, in worlds that budgets find hard.

A job with all that an assessor asks for is held against an axis that is known: readings rounded to a
coarse step on a quiet axis, an instrument whose error is a smooth curve, scatter with long tails, a
machine that is warm or warms up. The errors of the set-up are drawn as the job states them, once for each
test; what the instrument would have shown is corrected, budgeted and evaluated as by ``zlmreport
JOB.yaml``. y ± U is held against the parameter of the true readings at 20 °C, and the interval of the
axis against what the same set-up, left as it stands, finds in the next test.

    ./run benchmark worlds [--tests N] [--results FILE.jsonl] [WORLD]

Each world is appended to the results when it is done, and is not measured again; the tables are of all
results.
"""

from __future__ import annotations

import argparse
import json
import tempfile
from collections.abc import Iterable, Mapping
from dataclasses import asdict, dataclass, replace
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
import yaml

from shares import Held, share_held
from zlmreport import pipeline
from zlmreport.evaluation.correction.corrections import correct, find_corrections_of
from zlmreport.evaluation.evaluate import evaluate
from zlmreport.evaluation.uncertainty.budget import Budget
from zlmreport.evaluation.uncertainty.expanded import add_uncertainty
from zlmreport.evaluation.uncertainty.job_budget import make_budget_of
from zlmreport.job.loading import load
from zlmreport.job.types import Options
from zlmreport.measurement.arrays import FloatArray, read_only_floats
from zlmreport.measurement.measurement_set import MeasurementSet
from zlmreport.measurement.units import REFERENCE_TEMPERATURE
from zlmreport.plugin.registry import Registry, find_plugins

_MICROMETRE = 1e-6
_TARGETS = (3.1, 104.2, 201.7, 303.9, 398.3, 502.6, 601.4, 703.8, 799.2, 902.5, 996.4)
_RUNS = 5
#: Of the machine, µm/(m·K), and the full ranges of its error and of that of the measured temperature, K.
_ALPHA, _ALPHA_RANGE, _SENSOR_RANGE = 11.5, 1.0, 0.1
_SEED = 20260103
#: What is asked: whether y ± U holds, and the interval of the axis.
_TEST, _AXIS = "this test", "this axis"
#: How symbols are written on a page.
_WRITTEN = {
    "A_fwd": "A↑",
    "A_bwd": "A↓",
    "E_fwd": "E↑",
    "E_bwd": "E↓",
    "R_fwd": "R↑",
    "R_bwd": "R↓",
    "B_mean": "B̄",
}


@dataclass(frozen=True)
class World:
    """What a test is like; lengths in µm, temperatures in °C."""

    scatter: float = 0.4  #: Standard deviation of the axis's readings.
    has_long_tails: bool = False  #: Whether these are distributed like t with 3 degrees of freedom.
    step: float = 0.01  #: In which readings are shown.
    instrument: float = 0.4  #: U of the instrument.
    #: Share of the length over which its curve bends; 0 for an error of each position of its own.
    smooth: float = 0.0
    waves: float = 0.0  #: Over the length, if that curve is a wave of one amplitude; else 0.
    temperature: tuple[float, float] = (20.0, 20.0)  #: Of the machine at the first reading and at the last.
    is_corrected: bool = False  #: Whether the job corrects the readings to 20 °C.


WORLDS: Mapping[str, World] = {
    "20 °C, an error at each position": World(),
    "steps of 1 µm, s = 0.05 µm": World(scatter=0.05, step=1.0, instrument=0.02),
    "steps of 1 µm, s = 0.2 µm": World(scatter=0.2, step=1.0, instrument=0.02),
    "steps of 1 µm, s = 0.5 µm": World(scatter=0.5, step=1.0, instrument=0.02),
    "steps of 1 µm, s = 1.5 µm": World(scatter=1.5, step=1.0, instrument=0.02),
    "instrument, a smooth curve": World(smooth=0.3),
    "instrument, a smoother curve": World(smooth=0.7),
    "instrument of 2 µm, an error at each position": World(instrument=2.0),
    "instrument of 2 µm, a smooth curve": World(instrument=2.0, smooth=0.3),
    "instrument, half a wave": World(waves=0.5),
    "instrument, one wave": World(waves=1.0),
    "instrument, two waves": World(waves=2.0),
    "scatter with tails like t₃": World(has_long_tails=True),
    "26 °C, uncorrected": World(temperature=(26.0, 26.0)),
    "26 °C, corrected": World(temperature=(26.0, 26.0), is_corrected=True),
    "20 to 24 °C, uncorrected": World(temperature=(20.0, 24.0)),
    "20 to 24 °C, corrected": World(temperature=(20.0, 24.0), is_corrected=True),
    "24 °C, uncorrected": World(temperature=(24.0, 24.0)),
    "24 °C, corrected": World(temperature=(24.0, 24.0), is_corrected=True),
}


def _keys(world: World) -> dict[str, Any]:
    """Return the job: a report, for a certificate of what is left uncorrected here is refused."""
    corrections = {"corrections": {"material": {"temperature": "axis_temperature"}}}
    unasked = (
        "misalignment",
        "device_temperature",
        "device_expansion_coefficient",
        "environmental_variation",
    )
    return {
        "schema": "zlmreport/job/1",
        "certificate": {"number": "1", "kind": "report"},
        "axis": {"name": "X"},
        "measurement": {"source": {"plugin": "laser-csv", "file": "x.csv"}},
        "instrument": {
            "name": "Interferometer",
            "expanded_uncertainty": world.instrument,
            "compensates": {"air": True},
        },
        "environment": {"expansion_coefficient": _ALPHA},
        "uncertainty": {
            "machine_temperature": _SENSOR_RANGE,
            "expansion_coefficient": _ALPHA_RANGE,
            "resolution": world.step,
            "negligible": dict.fromkeys(unasked, "there is none in this world"),
        },
        "evaluate": ["iso230-2:2014"],
        **(corrections if world.is_corrected else {}),
    }


def _frame(folder: Path, world: World, registry: Registry) -> tuple[Any, MeasurementSet]:
    """Return the job of a world, and a test of its plan with the logged temperature of each reading."""
    count = len(_TARGETS)
    order = [
        (target, direction, run)
        for run in range(_RUNS)
        for direction, targets in (("+", range(count)), ("-", reversed(range(count))))
        for target in targets
    ]
    logged = np.linspace(*world.temperature, len(order))
    lines = [
        f"{_TARGETS[target]},{direction},{run + 1},0.{target:02d},{temperature:.6f}"
        for (target, direction, run), temperature in zip(order, logged, strict=True)
    ]
    header = "target,direction,run,deviation,axis_temperature"
    (folder / "x.csv").write_text("\n".join([header, *lines]) + "\n", encoding="utf-8")
    path = folder / "job.yaml"
    path.write_text(yaml.safe_dump(_keys(world), allow_unicode=True), encoding="utf-8")
    job = load(path, registry)
    uncorrected = replace(job, keys=_uncorrected(job.keys)) if world.is_corrected else job
    return job, pipeline.read_whole(uncorrected, registry)


def _uncorrected(keys: Any) -> Any:
    """Return the keys of a job that asks for no correction."""
    return keys.model_copy(update={"corrections": None})


class Axis:
    """An axis under a set-up: tests of it share the errors of the set-up, and scatter anew."""

    def __init__(self, world: World, frame: MeasurementSet, generator: np.random.Generator) -> None:
        """Draw the axis and the errors of its set-up."""
        self.world, self.frame, self.generator = world, frame, generator
        targets = frame.target_positions
        shares = (targets - targets[0]) / (targets[-1] - targets[0])
        wave, phase = generator.uniform(0.4, 1.2), generator.uniform(0, 2 * np.pi)
        bow = 2.0 * shares + wave * np.sin(6.0 * shares + phase)
        sides = np.where(frame.approach > 0, 0.4, -0.4)
        self.means = bow[frame.target] + sides
        self.of_instrument = world.instrument / 2 * self._curve(shares)
        half = generator.uniform(-0.5, 0.5, 2)
        alpha = _ALPHA + _ALPHA_RANGE * half[0]
        warm = frame.conditions["axis_temperature"] - REFERENCE_TEMPERATURE + _SENSOR_RANGE * half[1]
        self.expansion = alpha * warm * (targets[frame.target] - targets[0])

    def _curve(self, shares: FloatArray) -> FloatArray:
        """Return the instrument's error at each target, of standard deviation 1."""
        own = self.generator.standard_normal(len(shares))
        if self.world.waves:
            phase = self.generator.uniform(0, 2 * np.pi)
            return np.asarray(np.sqrt(2.0) * np.sin(2 * np.pi * self.world.waves * shares + phase))
        if not self.world.smooth:
            return own
        distances = (shares[:, np.newaxis] - shares) / self.world.smooth
        covariance = np.exp(-0.5 * distances**2) + 1e-9 * np.eye(len(shares))
        return np.asarray(np.linalg.cholesky(covariance) @ own)

    def tested(self) -> tuple[MeasurementSet, MeasurementSet]:
        """Return the true readings of a test at 20 °C, and what is shown of them."""
        count = len(self.means)
        if self.world.has_long_tails:
            own = self.generator.standard_t(3, count) / np.sqrt(3.0)
        else:
            own = self.generator.standard_normal(count)
        truth = self.means + self.world.scatter * own
        shown = truth + self.of_instrument[self.frame.target] + self.expansion
        steps = np.round(shown / self.world.step) * self.world.step
        one, other = (read_only_floats(each * _MICROMETRE) for each in (truth, steps))
        return replace(self.frame, deviation=one), replace(self.frame, deviation=other)


@dataclass(frozen=True)
class Coverage:
    """How many tests of a world were held, by symbol."""

    world: str
    tests: int
    simulated: int
    this_test: Mapping[str, int]  #: In which y ± U holds the parameter of the true readings.
    this_axis: Mapping[str, int]  #: In which the interval of the axis holds what the next test finds.


def measured(name: str, tests: int, simulated: int, registry: Registry) -> Coverage:
    """Draw tests of a world, and count."""
    world = WORLDS[name]
    standard = registry.standard("iso230-2:2014")
    with tempfile.TemporaryDirectory() as folder:
        job, frame = _frame(Path(folder), world, registry)

    def evaluated(measurements: MeasurementSet):  # noqa: ANN202 - an Evaluation
        return evaluate(standard, measurements, Options(), {})

    def as_stated(shown: MeasurementSet) -> MeasurementSet:
        corrections = find_corrections_of(job, shown)
        return correct(shown, corrections) if corrections else shown

    def trial(generator: np.random.Generator) -> Held:
        axis = Axis(world, frame, generator)
        truth, shown = axis.tested()
        stated = as_stated(shown)
        budget = make_budget_of(job, stated)
        assert isinstance(budget, Budget)
        assert budget.is_complete, budget.missing
        arithmetic = partial(standard.arithmetic, options=Options())
        (found,) = add_uncertainty([(evaluated(stated), arithmetic)], budget, simulated)
        true, again = evaluated(truth), evaluated(as_stated(axis.tested()[1]))
        held: dict[tuple[str, str], bool] = {}
        for each in found.parameters:
            symbol = each.quantity.symbol
            held[_TEST, symbol] = abs(each.value - true.value(symbol)) <= each.expanded_uncertainty
            low, high = each.axis_interval
            held[_AXIS, symbol] = low <= again.value(symbol) <= high
        return held

    shares = share_held(trial, tests, _SEED)
    of_test, of_axis = (
        {symbol: round(share * tests) for (asked, symbol), share in shares.items() if asked == question}
        for question in (_TEST, _AXIS)
    )
    return Coverage(name, tests, simulated, of_test, of_axis)


def tables(results: Iterable[Coverage]) -> str:
    """Return a table for each question: a row for each world, a column for each parameter, in percent."""
    done = sorted(results, key=lambda each: list(WORLDS).index(each.world))
    lines = []
    for question in (_TEST, _AXIS):
        rows = [(each, getattr(each, question.replace(" ", "_"))) for each in done]
        symbols = list(rows[0][1])
        heads = " | ".join(_WRITTEN.get(each, each) for each in symbols)
        lines += ["", f"| {question} | {heads} |", f"|---|{'--:|' * len(symbols)}"]
        lines += [
            f"| {each.world} | "
            + " | ".join(f"{100 * counts[symbol] / each.tests:.1f}" for symbol in symbols)
            + " |"
            for each, counts in rows
        ]
    return "\n".join(lines).lstrip()


def read(results: Path) -> list[Coverage]:
    """Return the counts that a file keeps."""
    return [Coverage(**json.loads(line)) for line in results.read_text(encoding="utf-8").splitlines()]


def main(arguments: list[str] | None = None) -> None:
    """Measure what is not among the results yet, and print the tables of all."""
    parser = argparse.ArgumentParser(prog="./run benchmark worlds", description=__doc__)
    parser.add_argument("--tests", type=int, default=400, help="of each world (%(default)s)")
    parser.add_argument("--simulated", type=int, default=2000, help="simulated tests of each (%(default)s)")
    parser.add_argument("--results", type=Path, help="file of the counts, a line for each world")
    parser.add_argument("worlds", nargs="*", metavar="WORLD", help="how its name begins (all)")
    options = parser.parse_args(arguments)
    results: Path | None = options.results
    done = read(results) if results and results.exists() else []
    registry = find_plugins()
    for name in WORLDS:
        if name.startswith(tuple(options.worlds) or "") and name not in {each.world for each in done}:
            done.append(measured(name, options.tests, options.simulated, registry))
            if results:
                with results.open("a", encoding="utf-8") as file:
                    file.write(json.dumps(asdict(done[-1]), ensure_ascii=False) + "\n")
    print(tables(done))
