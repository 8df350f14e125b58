"""Whether the band of a prediction holds circles: known errors of axes, measured with noise, then predicted.

    ./run benchmark machine-bands [--machines N]

The true errors are smooth, and finer than the positions at which they are measured. What the band holds is
counted at one angle of one circle of each machine, so that no two counts hang together.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Callable, Sequence
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).parents[1] / "tests"))

from machines.simulated import bare_machine
from zlmreport.machines.course import ToolCourse
from zlmreport.machines.curve import AxisErrorCurve, Means, make_curve_of_means, remove_alignment
from zlmreport.machines.kinematics import ErrorLine
from zlmreport.machines.machine import predict
from zlmreport.model.fitting.estimate import InstrumentError

_RUNS = 5
TrueError = Callable[[np.ndarray], np.ndarray]


def _drawn(draw: np.random.Generator, length: float) -> TrueError:
    """Return a smooth error of an axis, m: four waves, the shortest of a fifth of its length."""
    sizes, phases = draw.normal(0, 2e-6, 4) / np.arange(1, 5), draw.uniform(0, 2 * np.pi, 4)
    orders = np.array([0.5, 1.0, 2.0, 5.0])
    return lambda at: np.sin(2 * np.pi * np.outer(at / length, orders) + phases) @ sizes


def _measured(
    name: str, true: TrueError, length: float, draw: np.random.Generator
) -> tuple[AxisErrorCurve, np.ndarray]:
    """Return a curve as it is measured, and the truth at its nodes with what the alignment takes away."""
    nodes = np.linspace(0.0, length, int(draw.integers(16, 31)))
    scatter, at, along = draw.uniform(0.2e-6, 1e-6), draw.uniform(0, 0.4e-6), draw.uniform(0, 1e-6)
    instrument = InstrumentError(proportional=along, at_each_position=at, between_directions=0.0)
    shared = draw.normal(0, at, len(nodes)) + draw.normal(0, along) * (nodes - nodes.mean())
    readings = true(nodes) + shared + scatter * draw.standard_normal((_RUNS, 2, len(nodes)))
    means = readings.mean(axis=0)
    squares = ((readings - means) ** 2).sum(axis=0)
    count = np.full(means.shape, _RUNS)
    curve = make_curve_of_means(Means(nodes, means, count, squares), name, instrument, ErrorLine({}), "drawn")
    bare = AxisErrorCurve(name, nodes, true(nodes), np.zeros((len(nodes), 0)), ErrorLine({}), "true")
    return remove_alignment(curve), true(nodes) - remove_alignment(bare).values


def holds(seed: int) -> bool:
    """Tell whether the band of a machine holds the truth at one angle of one circle."""
    draw = np.random.default_rng(seed)
    lengths = {"X": 0.5, "Y": 0.4}
    angle = float(draw.uniform(0, 2 * np.pi))
    centre, radius = draw.uniform([0.2, 0.2, 0], [0.3, 0.2, 0]), float(draw.uniform(0.05, 0.19))
    sensing = np.array([[np.cos(angle), np.sin(angle), 0.0]])
    position = centre + radius * sensing
    curves, truth = [], 0.0
    for name in ("EXX", "EYX", "EXY", "EYY"):
        true = _drawn(draw, lengths[name[2]])
        curve, taken = _measured(name, true, lengths[name[2]], draw)
        curves.append(curve)
        place = position[0, "XY".index(name[2])]
        value = float(true(np.array([place]))[0]) - float(np.interp(place, curve.nodes, taken))
        truth += value * sensing[0, "XY".index(name[1])]
    square, u = float(draw.normal(0, 20e-6)), 2e-6
    seen = np.array([square + draw.normal(0, u)])
    curves.append(AxisErrorCurve("C0Y", np.zeros(1), seen, np.eye(1) * u, ErrorLine({}), "drawn"))
    truth -= square * position[0, 1] * sensing[0, 0]
    motion = np.array([[-np.sign(sensing[0, 1]), np.sign(sensing[0, 0]), 0.0]])
    found = predict(bare_machine(curves), ToolCourse(position, sensing, motion))
    return bool(abs(found.values[0] - truth) <= found.expanded_uncertainty[0])


def main(arguments: Sequence[str]) -> None:
    """Print what share of the circles the bands hold."""
    parser = argparse.ArgumentParser(
        prog="./run benchmark machine-bands", description=__doc__.splitlines()[0]
    )
    parser.add_argument("--machines", type=int, default=2000, help="(%(default)s)")
    count = parser.parse_args(arguments).machines
    held = sum(holds(seed) for seed in range(count))
    print(f"the band of U holds {held} of {count} circles, {100 * held / count:.1f} %")
