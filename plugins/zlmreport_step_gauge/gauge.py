"""The data of a step gauge: its faces, blocks, expansion, and where it lies."""

from __future__ import annotations

from dataclasses import dataclass
from enum import IntEnum

from zlmreport.plugin import Place


class Side(IntEnum):
    """Which face of a block; the value is the direction of the outward normal along the gauge.

    A front face is reached by a probe that moves from the beginning of the gauge to its end, a back face by
    one that moves the other way.
    """

    FRONT = -1
    BACK = 1


@dataclass(frozen=True, slots=True)
class Face:
    """A calibrated face."""

    #: From 1 at the beginning of the gauge: block b has the front face 2b − 1 and the back face 2b.
    number: int
    side: Side  #: Front or back.
    nominal: float  #: Nominal distance of its centre from the reference face, m.
    distance: float  #: Calibrated distance S from the reference face at the reference temperature, m.
    expanded_uncertainty: float  #: U of the calibrated distance (k = 2), m.

    @property
    def block(self) -> int:
        """Number of the block, from 1."""
        return (self.number + 1) // 2


@dataclass(frozen=True, slots=True)
class StepGauge:
    """A calibrated step gauge, or the section of it that is used."""

    #: name, serial and certificate: What identifies it, and its calibration; empty where the file does not
    #: say.
    name: str
    serial: str
    certificate: str
    faces: tuple[Face, ...]  #: In the order along the gauge: front and back of each block.
    expansion_coefficient: float | None  #: α, 1/K; None where the calibration does not state it.
    expansion_uncertainty: float | None  #: Standard uncertainty of α, 1/K; None where it is not stated.
    reference_temperature: float  #: At which the distances hold, K.
    #: block_width and block_height: Across the gauge, m: for the clearance of a probing path. None where not
    #: stated; the initial points tell them too (`zlmreport_step_gauge.location.Located`).
    block_width: float | None
    block_height: float | None
    place: Place  #: Where the calibration stands: for messages.

    @property
    def blocks(self) -> tuple[int, ...]:
        """Numbers of the blocks, rising."""
        return tuple(sorted({face.block for face in self.faces}))

    def find_face(self, number: int) -> Face | None:
        """Return a face by its number; None if the section does not hold it."""
        return next((face for face in self.faces if face.number == number), None)


@dataclass(frozen=True, slots=True)
class GaugeLocation:
    """Where a step gauge lies in the coordinates of the machine."""

    #: begin and end: C1 and C2: centres of the first and the last block of the section, m.
    begin: tuple[float, float, float]
    end: tuple[float, float, float]
    direction: tuple[float, float, float]  #: Unit vector from C1 to C2.
    #: Unit vector out of the top of the blocks, at right angles to `direction`: the way over them.
    upward: tuple[float, float, float]
    direction_uncertainty: float  #: Standard uncertainty of the direction at right angles to it, rad.
