"""The nominal circle of a circular test: where it lies, how large it is, how fast it is run."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType

#: The planes of circles, each by its first and its second axis: in this order counter-clockwise is from the
#: first towards the second, seen against the third (ISO 841).
PLANES: Mapping[str, tuple[str, str]] = MappingProxyType(
    {"XY": ("X", "Y"), "YZ": ("Y", "Z"), "ZX": ("Z", "X")}
)


@dataclass(frozen=True, slots=True)
class NominalCircle:
    """The path that a control was told to run.

    Angles on it are reckoned from the plane's first axis towards its second.
    """

    plane: str  #: ``XY``, ``YZ`` or ``ZX``.
    radius: float  #: m.
    feed: float  #: Along the path, m/s.
    centre: tuple[float, float, float] = (0.0, 0.0, 0.0)  #: In the machine, m.
    #: Whether the length of the instrument is known, so that a mean radius says something of the machine.
    is_calibrated: bool = False

    @property
    def axes(self) -> tuple[str, str]:
        """The plane's first and second axis."""
        return PLANES[self.plane]

    @property
    def angular_speed(self) -> float:
        """How fast the angle grows or falls, rad/s."""
        return self.feed / self.radius
