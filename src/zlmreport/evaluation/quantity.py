"""What a standard reports: parameters of the whole axis, and columns of the table by position."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum

from zlmreport.language import Words


class Group(Enum):
    """The three kinds of deviation that all standards tell apart (ZLM, G 1.3)."""

    SYSTEMATIC = "systematic"
    RANDOM = "random"
    COMPOSITE = "composite"


@dataclass(frozen=True, slots=True)
class Quantity:
    """A parameter of the axis as a standard defines it.

    Attributes
    ----------
    symbol
        ASCII, as in the results file: ``A_fwd``.
    notation
        As printed (`zlmreport.quantities.notation`): ``A↑``.
    name
        The name in the wording of the standard's edition.
    group
        Systematic, random or composite.
    formula
        The definition as printed, in notation.
    meaning
        What it says of a part made (or measured) on the machine, in a sentence.
    can_be_limited
        Whether a job may state a tolerance for it.
    printed_sign
        −1 where the edition prints the value with the sign opposite to the results file; else 1.
    """

    symbol: str
    notation: str
    name: Words
    group: Group
    formula: str
    meaning: Words
    can_be_limited: bool = True
    printed_sign: int = 1


@dataclass(frozen=True, slots=True)
class PositionQuantity:
    """A column of the table by position: one value at each target position.

    Attributes
    ----------
    symbol
        ASCII key, as in the results file: ``mean_fwd``.
    notation
        As printed: ``x̄_{i}↑``.
    name
        In words.
    """

    symbol: str
    notation: str
    name: Words
