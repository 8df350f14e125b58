"""A coordinate measuring machine whose errors are known, and a step gauge on it along any line.

It is what the evaluation is proved by: what it recovers is held against the errors that were put in.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from zlmreport.plugin import MILLIMETRE, FloatArray
from zlmreport_step_gauge.gauge import StepGauge
from zlmreport_step_gauge.initial_points import BLOCKS

Vector = tuple[float, float, float]

#: Where P1 to P3 lie on the front face, and how far from the foot P7 is, as parts of the block's size.
_ON_FACE = ((0.35, -0.25), (-0.35, -0.25), (0.0, 0.35))
_INTO_THE_GAP = 0.4
_ORIGIN = "Simulated by configs/step-gauge/make.py."


@dataclass(frozen=True, slots=True)
class MachineErrors:
    """The errors of three axes, each by its own coordinate, and the angles between them.

    Attributes
    ----------
    scale
        Relative error of length of x, y, z, m/m.
    amplitude, period
        Of an error that repeats along x, y, z, m.
    lost_motion
        By how much x, y, z read more when they move in the positive direction than in the negative one, m.
    squareness
        Departure of y from the normal of x, of z from that of x, and of z from that of y, rad.
    """

    scale: Vector = (0.0, 0.0, 0.0)
    amplitude: Vector = (0.0, 0.0, 0.0)
    period: Vector = (0.1, 0.1, 0.1)
    lost_motion: Vector = (0.0, 0.0, 0.0)
    squareness: Vector = (0.0, 0.0, 0.0)

    def at(self, points: FloatArray, motion: FloatArray) -> FloatArray:
        """Return what the machine reads too much at points that it comes to by a motion, each (..., 3), m."""
        error = np.array(self.scale) * points
        error = error + np.array(self.amplitude) * np.sin(2 * np.pi * points / np.array(self.period))
        error = error + np.array(self.lost_motion) / 2 * np.sign(np.round(motion, 12))
        xy, xz, yz = self.squareness
        x, y, z = np.moveaxis(points, -1, 0)
        skew: FloatArray = error + np.stack([xy * y + xz * z, yz * z, np.zeros_like(x)], axis=-1)
        return skew


@dataclass(frozen=True, slots=True)
class SimulatedTest:
    """How a gauge lies on the machine, and how it is probed.

    Attributes
    ----------
    gauge
        As it was calibrated: the section; its blocks' width and height must be known.
    begin
        Centre of the front face of the first block, m.
    direction, upward
        Along the gauge, and roughly out of its top.
    tip_radius, effective_radius
        Nominal, and what it really is in the direction of the gauge, m.
    cycles
        How often each face is touched.
    point_uncertainty, touch_uncertainty
        Standard deviation of a coordinate of an initial point, and of a touch of a face, m.
    temperature_difference, temperature_range
        Of the gauge above its reference temperature as it is believed to be, and the full range of the error
        of this, K.
    """

    gauge: StepGauge
    begin: Vector
    direction: Vector
    upward: Vector = (0.0, 0.0, 1.0)
    tip_radius: float = 2e-3
    effective_radius: float = 1.9985e-3
    cycles: int = 5
    point_uncertainty: float = 1e-6
    touch_uncertainty: float = 0.3e-6
    temperature_difference: float = 0.0
    temperature_range: float = 0.0


@dataclass(frozen=True, slots=True)
class Simulated:
    """What the machine reads, and what is true.

    Attributes
    ----------
    initial_points : (block, point, 3) array
        Centres of the tip, m.
    coordinates : (face, cycle, 3) array
        Centres of the tip, m.
    truth : (face,) array
        The error of the machine along the line at each face, in the direction of probing, relative to that at
        the first face, m.
    """

    initial_points: FloatArray
    coordinates: FloatArray
    truth: FloatArray


def simulate(test: SimulatedTest, machine: MachineErrors, generator: np.random.Generator) -> Simulated:
    """Simulate a test: the gauge is drawn from its calibration, the touches from their uncertainties."""
    gauge = test.gauge
    frame = _frame(test)
    along, _, _ = frame
    sides = np.array([float(face.side) for face in gauge.faces])
    distances = _distances(test, generator)
    surface = np.array(test.begin) + (distances - distances[0])[:, np.newaxis] * along
    motion = -sides[:, np.newaxis] * along
    error = machine.at(surface, motion)
    centre = surface + (sides * test.effective_radius)[:, np.newaxis] * along + error
    touches = generator.normal(0.0, test.touch_uncertainty, (len(sides), test.cycles))
    coordinates = centre[:, np.newaxis] + touches[..., np.newaxis] * along
    projected = error @ along
    points, normals = _initial_points(test, surface, frame)
    read = points + machine.at(points, -normals)
    read = read + generator.normal(0.0, test.point_uncertainty, points.shape)
    return Simulated(read, coordinates, projected - projected[0])


def _frame(test: SimulatedTest) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Return the unit vectors along the gauge, to its side and out of its top."""
    along = np.array(test.direction) / np.linalg.norm(test.direction)
    sideward = np.cross(along, test.upward)
    sideward = sideward / np.linalg.norm(sideward)
    return along, sideward, np.cross(sideward, along)


def _distances(test: SimulatedTest, generator: np.random.Generator) -> FloatArray:
    """Return true distances of the faces at the temperature of the test, m."""
    gauge = test.gauge
    calibrated = np.array([face.distance for face in gauge.faces])
    uncertainty = np.array([face.expanded_uncertainty / 2 for face in gauge.faces])
    uncertainty[calibrated == 0] = 0.0  # the face that the calibration is relative to
    true = calibrated + generator.normal(0.0, 1.0, len(calibrated)) * uncertainty
    coefficient = (gauge.expansion_coefficient or 0.0) + generator.normal() * (
        gauge.expansion_uncertainty or 0.0
    )
    difference = test.temperature_difference + test.temperature_range * (generator.random() - 0.5)
    grown: FloatArray = true * (1 + coefficient * difference)
    return grown


def _initial_points(
    test: SimulatedTest, surface: FloatArray, frame: tuple[FloatArray, FloatArray, FloatArray]
) -> tuple[FloatArray, FloatArray]:
    """Return the centres of the tip at the 16 points, and the outward normals there, (block, point, 3)."""
    along, sideward, upward = frame
    width, height = test.gauge.block_width or 0.0, test.gauge.block_height or 0.0
    points, normals = [], []
    for front, back in ((surface[0], surface[1]), (surface[-2], surface[-1]))[: len(BLOCKS)]:
        middle, length = (front + back) / 2, float((back - front) @ along)
        foot = middle - upward * height / 2 - along * (0.5 + _INTO_THE_GAP) * length
        touched = [
            *((front + a * width * sideward + b * height * upward, -along) for a, b in _ON_FACE),
            (middle + sideward * width / 2, sideward),
            (middle - sideward * width / 2, -sideward),
            (middle + upward * height / 2, upward),
            (foot, upward),
            (back, along),
        ]
        points.append([point + test.tip_radius * normal for point, normal in touched])
        normals.append([normal for _, normal in touched])
    return np.array(points), np.array(normals)


def initial_points_csv(points: FloatArray) -> str:
    """Return initial points as the file that a job names, to 0.1 µm."""
    lines = [f"# Centres of the tip, mm. {_ORIGIN}", "block,point,x,y,z"]
    for name, of_block in zip(BLOCKS, points, strict=True):
        lines += [f"{name},{number},{_written(point)}" for number, point in enumerate(of_block, 1)]
    return "\n".join([*lines, ""])


def probed_csv(coordinates: FloatArray, gauge: StepGauge) -> str:
    """Return probed points as the file of the source ``step-gauge``: front faces forth, back faces back."""
    lines = [f"# Centres of the tip, mm. {_ORIGIN}", "face,cycle,x,y,z"]
    order = [index for index, face in enumerate(gauge.faces) if face.side < 0]
    order += [index for index, face in reversed(list(enumerate(gauge.faces))) if face.side > 0]
    for cycle in range(coordinates.shape[1]):
        lines += [
            f"{gauge.faces[index].number},{cycle + 1},{_written(coordinates[index, cycle])}"
            for index in order
        ]
    return "\n".join([*lines, ""])


def _written(point: FloatArray) -> str:
    return ",".join(f"{MILLIMETRE.from_si(float(each)):.4f}" for each in point)
