"""Circles of machines that are not there: each cause by its geometry in x and y, not by the catalogue's
Δr."""

from dataclasses import replace
from typing import NamedTuple

import numpy as np

from zlmreport.machines.course import CircularTest
from zlmreport.machines.curve import AxisErrorCurve
from zlmreport.machines.kinematics import Chain, ErrorLine
from zlmreport.machines.machine import MachineModel, list_missing_errors
from zlmreport.plugin import NominalCircle

MICRO = 1e-6


def bare_machine(curves=(), letters="XYFZ", tool=(0.0, 0.0, 0.0)):
    return MachineModel(
        Chain(letters), tool, tuple(curves), list_missing_errors({each.name: each for each in curves}, {})
    )


def straight_curve(name, length, slope=0.0, u=0.0):
    nodes = np.linspace(0, length, 11)
    return AxisErrorCurve(name, nodes, slope * nodes, np.eye(11) * u, ErrorLine({}), "test")


def turns(senses=(1, -1), repeats=1, count=360, first=0.0):
    """Angles, senses, numbers of some whole turns."""
    angle, sense, run = [], [], []
    for way in senses:
        for number in range(1, repeats + 1):
            angle.append(first + way * np.linspace(0, 2 * np.pi, count, endpoint=False))
            sense.append(np.full(count, float(way)))
            run.append(np.full(count, number))
    return np.concatenate(angle), np.concatenate(sense), np.concatenate(run)


CENTRES = {"XY": (0.25, 0.2, 0.1), "YZ": (0.1, 0.25, 0.2), "ZX": (0.2, 0.1, 0.25)}


def circle(move, seed=0, **how):
    """A circle of which `move` says how far the tool is off in both axes, m.

    `move` gets the coordinates about the centre, the velocities of both axes, and the sense. `how`: radius
    (m), feed (m/s), plane, noise (RMS, m), scatter (its kind), name, and what `turns` takes."""
    radius, feed, plane = how.pop("radius", 0.15), how.pop("feed", 1 / 60), how.pop("plane", "XY")
    noise, name, scatter = how.pop("noise", 0.5e-6), how.pop("name", "circle"), how.pop("scatter", Scatter())
    angle, sense, run = turns(**how)
    path = Path(
        radius * np.cos(angle), radius * np.sin(angle),
        -sense * feed * np.sin(angle), sense * feed * np.cos(angle), sense,
    )  # fmt: skip
    off_u, off_v = move(path)
    random = np.random.default_rng(seed)
    deviation = off_u * np.cos(angle) + off_v * np.sin(angle)
    deviation = deviation + 3e-6 * np.cos(angle) - 2e-6 * np.sin(angle) + 4e-6
    deviation = deviation + noise * healthy_noise(angle, sense, run, random, scatter)
    step = np.abs(angle[1] - angle[0]) * radius / feed
    nominal = NominalCircle(plane, radius, feed, CENTRES[plane])
    return CircularTest(name, nominal, angle, sense, run, deviation, step * np.arange(len(angle)))


class Path(NamedTuple):
    """Coordinates about the centre and velocities of both axes, m and m/s; +1 counter-clockwise, −1
    clockwise."""

    u: np.ndarray
    v: np.ndarray
    du: np.ndarray
    dv: np.ndarray
    sense: np.ndarray


class Scatter(NamedTuple):
    """Root mean squares of what scatters, and its correlation lengths in degrees: as in the prototype."""

    white: float = 0.80
    path: float = 0.50
    geometry: float = 0.33
    path_length: float = 6.0
    geometry_length: float = 10.0


def healthy_noise(angle, sense, run, random, scatter):
    """White noise, noise along the path, and irregular geometry that is alike in all turns."""
    found = scatter.white * random.standard_normal(len(angle))
    for way in np.unique(sense):
        for number in np.unique(run):
            own = np.flatnonzero((sense == way) & (run == number))
            if len(own):
                step = float(np.abs(np.diff(angle[own])).mean())
                keep = np.exp(-step / np.radians(scatter.path_length))
                path = np.empty(len(own))
                path[0] = random.standard_normal()
                for index in range(1, len(own)):
                    path[index] = keep * path[index - 1] + np.sqrt(1 - keep**2) * random.standard_normal()
                found[own] += scatter.path * path
    orders = np.arange(1, 60)
    size = np.exp(-0.25 * (orders * np.radians(scatter.geometry_length)) ** 2)
    size /= np.sqrt(np.sum(size**2))
    a, b = random.standard_normal((2, len(orders)))
    waves = np.outer(angle, orders)
    return found + scatter.geometry * (np.cos(waves) @ (size * a) + np.sin(waves) @ (size * b))


def nothing(path):
    return 0 * path.u, 0 * path.v


def out_of_square(angle):
    """C0Y > 0 turns the Y axis towards −X."""
    return lambda path: (-angle * path.v, 0 * path.v)


def unequal_scales(first, second):
    return lambda path: (first * path.u, second * path.v)


def lagging(first, second):
    """Each axis is where it should have been a moment ago."""
    return lambda path: (-first * path.du, -second * path.dv)


def with_lost_motion(first, second):
    """An axis stays half of it behind on its way."""
    return lambda path: (-first / 2 * np.sign(path.du), -second / 2 * np.sign(path.dv))


def with_play(first, second):
    """A carriage shifts across its way: moves of the first axis shift the tool along the second."""
    return lambda path: (second / 2 * np.sign(path.dv), first / 2 * np.sign(path.du))


def added(*moves):
    def move(path):
        parts = [each(path) for each in moves]
        return sum(part[0] for part in parts), sum(part[1] for part in parts)

    return move


def with_deviation(found, extra):
    return replace(found, deviation=found.deviation + extra)
