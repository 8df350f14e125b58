"""What differs from one µMD to the other."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Model:
    """A display.

    Attributes
    ----------
    identifier
        As jobs name it.
    name
        As its makers write it.
    baud_rate
        Of its port; only that of µMD0 is a real line, the others take any.
    slots
        After so many samples the low-speed channel begins anew.
    announces_counting
        Whether it says how many counts a cycle has (code 20); one that does not has 1.
    interpolation
        By how many counts DISP and VEL may disagree: the displacement is moved by interpolation, and the
        velocity is not.
    """

    identifier: str
    name: str
    baud_rate: int
    slots: int
    announces_counting: bool
    interpolation: int


MODELS = (
    Model("umd0", "µMD0", 115_200, 256, announces_counting=True, interpolation=0),
    Model("umd1", "µMD1", 115_200, 32, announces_counting=False, interpolation=0),
    Model("umd2", "µMD2", 2_000_000, 32, announces_counting=True, interpolation=2),
)
