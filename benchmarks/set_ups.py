"""Errors of measuring set-ups as they truly are, and the worlds that are made of them.

Each is drawn for a whole test: what it adds to the readings of every measured line, in the order of these.
Sizes are in the unit of the readings, µm or ″; lines that are measured with one device share what that has.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np

from zlmreport.evaluation.uncertainty.drift import Drift, compute_reading_times, sample_drifts
from zlmreport.measurement.approach import Approach
from zlmreport.measurement.arrays import FloatArray
from zlmreport.measurement.measurement_set import MeasurementSet

Lines = Mapping[str, MeasurementSet]
#: Returns what is added to the readings of each line, by its name, in the unit of the readings.
Error = Callable[[Lines, np.random.Generator], Mapping[str, FloatArray]]
#: Returns the same of one line, which shares it with no other.
OfOne = Callable[[MeasurementSet, np.random.Generator], FloatArray]


def on_each(error: OfOne) -> Error:
    """Return an error that every line has of its own."""
    return lambda lines, generator: {name: error(line, generator) for name, line in lines.items()}


def _along(line: MeasurementSet) -> FloatArray:
    """Return how far along the line its targets lie, from 0 to 1."""
    at = line.target_positions
    return np.asarray((at - at[0]) / (at[-1] - at[0]))


def readings_of(line: MeasurementSet) -> FloatArray:
    """Return the readings of a line in their unit."""
    return np.asarray(line.axis.deviation_unit.from_si(line.deviation))


def at_each_position(size: float) -> Error:
    """Return an error of each position of its own, of standard deviation `size`."""
    return on_each(
        lambda line, generator: size * generator.standard_normal(len(line.target_positions))[line.target]
    )


def smooth(size: float, share: float) -> Error:
    """Return an error smooth along the line: alike over `share` of its length."""

    def curve(line: MeasurementSet, generator: np.random.Generator) -> FloatArray:
        distances = np.subtract.outer(_along(line), _along(line)) / share
        covariance = np.exp(-0.5 * distances**2) + 1e-9 * np.eye(len(distances))
        drawn = np.linalg.cholesky(covariance) @ generator.standard_normal(len(distances))
        return np.asarray(size * drawn[line.target])

    return on_each(curve)


def wave(size: float, waves: float) -> Error:
    """Return an error that is a wave of any phase along the line, of root mean square `size`."""

    def curve(line: MeasurementSet, generator: np.random.Generator) -> FloatArray:
        phase = generator.uniform(0, 2 * np.pi)
        return np.asarray(size * np.sqrt(2) * np.sin(2 * np.pi * waves * _along(line) + phase)[line.target])

    return on_each(curve)


def bow(size: float) -> Error:
    """Return an error that is a parabola along the line, of standard deviation `size` where it is largest."""

    def curve(line: MeasurementSet, generator: np.random.Generator) -> FloatArray:
        shape = (2 * _along(line) - 1) ** 2
        shape -= shape.mean()
        return np.asarray(size * generator.standard_normal() * (shape / np.abs(shape).max())[line.target])

    return on_each(curve)


def at_each_reading(size: float) -> Error:
    """Return an error of each reading of its own."""
    return on_each(lambda line, generator: size * generator.standard_normal(len(line.deviation)))


def over_the_reading(size: float, period: float) -> Error:
    """Return an error that is a curve over what the device shows, the same on every line."""

    def error(lines: Lines, generator: np.random.Generator) -> Mapping[str, FloatArray]:
        phase = generator.uniform(0, 2 * np.pi)
        return {
            name: size * np.sqrt(2) * np.sin(2 * np.pi * readings_of(line) / period + phase)
            for name, line in lines.items()
        }

    return error


def in_proportion(percent: float) -> Error:
    """Return an error in proportion to the reading, the same on every line: a wrong scale, or wrong feet."""

    def error(lines: Lines, generator: np.random.Generator) -> Mapping[str, FloatArray]:
        gain = percent / 100 * generator.standard_normal()
        return {name: gain * readings_of(line) for name, line in lines.items()}

    return error


def own_scale(percent: float) -> Error:
    """Return an error in proportion to the reading, of each line its own: as sensors have them."""
    return on_each(lambda line, generator: percent / 100 * generator.standard_normal() * readings_of(line))


def sine(line: MeasurementSet, _generator: np.random.Generator) -> FloatArray:
    """Return by how much the sine of an angle is not the angle, which an angle interferometer counts."""
    return np.asarray(line.axis.deviation_unit.from_si(np.sin(line.deviation) - line.deviation))


def along_the_length(size: float) -> Error:
    """Return an error in proportion to the distance from the first target, of each line its own."""
    return on_each(lambda line, generator: size * generator.standard_normal() * _along(line)[line.target])


def one_scale(per_metre: float) -> Error:
    """Return an error in proportion to the length, the same on every line: one laser, one temperature."""

    def error(lines: Lines, generator: np.random.Generator) -> Mapping[str, FloatArray]:
        scale = per_metre * generator.standard_normal()
        return {
            name: scale * (line.target_positions - line.target_positions[0])[line.target]
            for name, line in lines.items()
        }

    return error


def one_scale_in(full_range: float) -> Error:
    """Return the same, all scales in a range being alike: of a temperature that was measured once."""

    def error(lines: Lines, generator: np.random.Generator) -> Mapping[str, FloatArray]:
        scale = full_range * generator.uniform(-0.5, 0.5)
        return {
            name: scale * (line.target_positions - line.target_positions[0])[line.target]
            for name, line in lines.items()
        }

    return error


def misaligned(full_range: float) -> Error:
    """Return the cosine error of a line that departs from its axis by up to a range, mm, over its length."""

    def shortened(line: MeasurementSet, generator: np.random.Generator) -> FloatArray:
        length = float(np.ptp(line.target_positions)) * 1e3
        off = full_range * np.sqrt(generator.uniform())  # so that all errors up to the largest are alike
        return np.asarray(-(off**2) / (2 * length) * 1e3 * _along(line)[line.target])

    return on_each(shortened)


def drifting(full_range: float, kind: Drift) -> Error:
    """Return a drift over the time of each line, of a full range."""

    def drift(line: MeasurementSet, generator: np.random.Generator) -> FloatArray:
        (drawn,) = sample_drifts(kind, compute_reading_times(line), 1, generator)
        side = np.where(line.approach == Approach.POSITIVE, 0, 1)
        runs = np.searchsorted(line.runs, line.run)
        return np.asarray(full_range * drawn[side, line.target, runs])

    return on_each(drift)


def square_of(size: float) -> Error:
    """Return what an error of a square's angle, ″, does to the second of two lines."""

    def tilt(lines: Lines, generator: np.random.Generator) -> Mapping[str, FloatArray]:
        *first, second = lines
        line = lines[second]
        length = float(np.ptp(line.target_positions)) * 1e6
        angle = size * generator.standard_normal() * np.pi / 648_000
        none = {name: np.zeros(len(lines[name].deviation)) for name in first}
        return {**none, second: angle * length * _along(line)[line.target]}

    return tilt


def round_the_circle(size: float, *lobes: int) -> Error:
    """Return an error of some harmonics of the angle, alike in both senses."""

    def curve(line: MeasurementSet, generator: np.random.Generator) -> FloatArray:
        angles = line.target_positions[line.target]
        waves = [f(lobe * angles) for lobe in lobes for f in (np.cos, np.sin)]
        return np.asarray(size * (generator.standard_normal(len(waves)) @ waves) / np.sqrt(len(lobes)))

    return on_each(curve)


def all_alike(size: float) -> Error:
    """Return an error that all readings share: of a calibrated length."""
    return on_each(lambda line, generator: np.full(len(line.deviation), size * generator.standard_normal()))


def uniform_alike(full_range: float) -> Error:
    """Return the same, all of its values in a range being alike: of a temperature."""
    return on_each(
        lambda line, generator: np.full(len(line.deviation), full_range * generator.uniform(-0.5, 0.5))
    )


def off_centre(full_range: float) -> Error:
    """Return what a centre that lies off, in each of two directions by up to a range, does to an arc."""

    def curve(line: MeasurementSet, generator: np.random.Generator) -> FloatArray:
        angles = line.target_positions[line.target]
        x, y = full_range * generator.uniform(-0.5, 0.5, 2)
        return np.asarray(x * np.cos(angles) + y * np.sin(angles))

    return on_each(curve)


@dataclass(frozen=True)
class World:
    """What truly disturbs a test, and what the job states of it beside what it always states."""

    errors: tuple[Error, ...]
    stated: Mapping[str, object]  #: Keys of `uncertainty`, and those of other sections by their names.


#: Kinds of drift that are drawn; and of what is read all the time, those without plain noise.
KINDS = (Drift.NOISE, Drift.RAMP, Drift.ONE_PERIOD, Drift.RANDOM_WALK)
SLOW = tuple(kind for kind in KINDS if kind is not Drift.NOISE)
