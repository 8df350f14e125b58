"""The door of effects of circles: what one depends on, its law, its terms, and what it says of itself."""

from __future__ import annotations

from zlmreport.language.numbers import (
    write_pair as pair_words,
)
from zlmreport.model.effects.circle_design import (
    AXES,
    CircleDesign,
    CircleTest,
)
from zlmreport.model.effects.circle_effect import (
    HERTZ,
    MICROMETRE_PER_MINUTE,
    MILLISECOND,
    ONE,
    PER_ACCELERATION,
    SQUARE_MILLISECOND,
    CircleEffect,
    CircleTerm,
    Estimate,
    Law,
    Parity,
    Searched,
    SearchedParameter,
)

__all__ = [
    "AXES",
    "HERTZ",
    "MICROMETRE_PER_MINUTE",
    "MILLISECOND",
    "ONE",
    "PER_ACCELERATION",
    "SQUARE_MILLISECOND",
    "CircleDesign",
    "CircleEffect",
    "CircleTerm",
    "CircleTest",
    "Estimate",
    "Law",
    "Parity",
    "Searched",
    "SearchedParameter",
    "pair_words",
]
