"""The job keys of ``text-readout``."""

from __future__ import annotations

import re
from typing import Annotated, Literal, Self

from pydantic import AfterValidator, Field, model_validator

from zlmreport.plugin import POSITION_UNITS, Framing, PolledOptions, unit_named

#: A number with decimal point or comma, its sign apart or not, and a unit if it has one.
USUAL = r"(?P<value>[+-]?\s*\d+(?:[.,]\d+)?)\s*(?P<unit>mm|inch|in|µm|um|deg)?"


def _is_pattern(text: str) -> str:
    try:
        re.compile(text)
    except re.error as error:
        raise ValueError(f"{text!r} is no regular expression: {error}") from error
    return text


def _is_unit(text: str) -> str:
    unit_named(text, POSITION_UNITS)
    return text


Pattern = Annotated[str, AfterValidator(_is_pattern)]


class TextReadoutOptions(PolledOptions):
    """Where the readout is, and what its lines look like."""

    baud_rate: Annotated[int, Field(gt=0)] = Field(9600, description="Bits a second.")
    bits: Literal[7, 8] = Field(8, description="Data bits of a byte.")
    parity: Literal["none", "even", "odd"] = Field("none", description="Parity of a byte.")
    stop_bits: Literal[1, 2] = Field(1, description="Stop bits of a byte.")
    request: str = Field(
        "",
        description='What makes the readout send a line: "M?\\r". Without it the readout sends of its own '
        "accord, and 'rate' is of no matter.",
    )
    pattern: Pattern = Field(
        USUAL,
        description="Regular expression of a whole line, blanks around it apart, with a group 'value' and, "
        "if the readout writes its unit, a group 'unit'.",
    )
    unit: Annotated[str, AfterValidator(_is_unit)] = Field(
        "mm", description="Of the value, where the line names none: mm, µm, inch, deg, arcsec."
    )
    no_reading: tuple[Pattern, ...] = Field(
        ("(?i)err",),
        description="Regular expressions of which a line holds one if it says that there is no reading.",
    )

    @model_validator(mode="after")
    def _pattern_has_a_value(self) -> Self:
        if "value" not in re.compile(self.pattern).groupindex:
            raise ValueError("'pattern' needs a group (?P<value>…) around the number")
        return self

    @property
    def framing(self) -> Framing:
        """How bytes travel."""
        parity = {"none": "N", "even": "E", "odd": "O"}[self.parity]
        return Framing(self.baud_rate, self.bits, parity, self.stop_bits)  # type: ignore[arg-type]  # one of these
