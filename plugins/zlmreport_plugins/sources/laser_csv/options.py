"""The keys of a table in a job, and the names by which columns, runs and directions go."""

from __future__ import annotations

import re
from collections.abc import Mapping
from types import MappingProxyType
from typing import Annotated, Literal, Self

from pydantic import AfterValidator, Field, field_validator, model_validator

from zlmreport.plugin import (
    CONDITIONS,
    MINUS_SIGN,
    POSITION_UNITS,
    TIME_UNITS,
    Approach,
    DecimalSign,
    JobPath,
    Options,
    ReadingScale,
    Unit,
    did_you_mean,
    known_encoding,
    unit_named,
)

#: The columns that have a meaning; any other is kept as a condition under its own name.
COLUMN_NAMES = ("target", "direction", "run", "deviation", "position", "time", *CONDITIONS)

_SIGNS = {"+": Approach.POSITIVE, "-": Approach.NEGATIVE, MINUS_SIGN: Approach.NEGATIVE}
_ARROWS = {"↑": Approach.POSITIVE, "↓": Approach.NEGATIVE}
_WORDS = {
    **dict.fromkeys(("up", "forward", "forwards", "fwd", "positive", "pos"), Approach.POSITIVE),
    **dict.fromkeys(("down", "reverse", "rev", "backward", "backwards", "bwd"), Approach.NEGATIVE),
    **dict.fromkeys(("negative", "neg"), Approach.NEGATIVE),
    **dict.fromkeys(("auf", "hin", "vor", "vorwärts", "positiv"), Approach.POSITIVE),
    **dict.fromkeys(("ab", "rück", "rueck", "zurück", "rückwärts", "negativ"), Approach.NEGATIVE),
}
_NUMBERS = {
    "1": Approach.POSITIVE,
    "+1": Approach.POSITIVE,
    "-1": Approach.NEGATIVE,
    f"{MINUS_SIGN}1": Approach.NEGATIVE,
}
_SPELLED_OUT: Mapping[str, Approach] = MappingProxyType({**_SIGNS, **_ARROWS, **_WORDS})
_DIRECTIONS: Mapping[str, Approach] = MappingProxyType({**_SPELLED_OUT, **_NUMBERS})

_IN_HEADERS = "|".join(re.escape(spelling) for spelling in sorted(_SPELLED_OUT, key=len, reverse=True))
_RUN = r"(?:(?:run|cycle|lauf|messlauf|zyklus)[\s_.]*)?"
#: ``1+``, ``1 ↓``, ``Run 1 fwd``, ``RUN 1``; ``+1``, ``fwd 1``, ``forward run 1``.
_HEADERS = (
    rf"{_RUN}(?P<run>[1-9][0-9]{{0,5}})[\s_.]*(?P<direction>{_IN_HEADERS})?",
    rf"(?P<direction>{_IN_HEADERS})[\s_.]*{_RUN}(?P<run>[1-9][0-9]{{0,5}})",
)


def folded(name: str) -> str:
    """Return a name without what people do not mind: case, and blanks, hyphens or underscores.

    >>> folded(" Air Temperature ")
    'air_temperature'
    """
    return re.sub(r"[\s_-]+", "_", name.strip().casefold())


def direction(spelling: str) -> Approach:
    """Return the direction of approach that a cell names; raise ValueError if it names none."""
    found = _DIRECTIONS.get(spelling.strip().casefold())
    if found is None:
        shown = ["+", "-", "up", "down", "forward", "reverse", "fwd", "bwd", "↑", "↓", "1", "-1"]
        raise ValueError(f"{spelling.strip()[:40]!r} is no direction; {did_you_mean(spelling[:40], shown)}")
    return found


def names_direction(text: str) -> bool:
    """Whether a text in a header is a direction: a sign, an arrow or a word."""
    return text.strip().casefold() in _SPELLED_OUT


def run_and_direction(header: str) -> tuple[int, Approach | None] | None:
    """Return the run, and the direction if it is named, that the header of a wide table's column tells.

    Two forms are read, without regard to case: the number of the run and then the direction (``1+``,
    ``1 ↓``, ``Run 1 fwd``), and the direction and then the number (``+1``, ``Forward Run 1``). ``RUN 1``
    names no direction. None if the header is of neither form.

    >>> run_and_direction("Run 2 bwd"), run_and_direction("RUN 3"), run_and_direction("Average")
    ((2, <Approach.NEGATIVE: -1>), (3, None), None)
    """
    if header.isalpha():  # nearly always, and the patterns are large: they are read when they are needed
        return None
    for form in _HEADERS:
        match = re.fullmatch(form, header.strip().casefold())
        if match:
            spelling = match["direction"]
            return int(match["run"]), _SPELLED_OUT[spelling] if spelling else None
    return None


_DELIMITERS = {"comma": ",", "semicolon": ";", "tab": "\t"}
_UNITS: Mapping[str, Mapping[str, Unit | ReadingScale]] = {
    **dict.fromkeys(("target", "deviation", "position"), POSITION_UNITS),
    "time": TIME_UNITS,
    **{name: kind.units for name, kind in CONDITIONS.items()},
}


class LaserCsvOptions(Options):
    """Where the table is, and what it does not say itself."""

    file: JobPath = Field(description="The table, relative to the file that names it.")
    layout: Literal["long", "wide"] = Field(
        "long",
        description="long: one reading a row; wide: one target position a row and one column a run and "
        "direction.",
    )
    values: Literal["deviation", "position"] = Field(
        "deviation",
        description="What a wide table holds: deviations, or actual positions. A long table has a column of "
        "that name.",
    )
    columns: dict[str, str] = Field(
        default_factory=dict,
        description="The file's own names: {target: Soll, position: Ist}. For a wide table also {1+: RUN 1}.",
    )
    ignore: tuple[str, ...] = Field((), description="Columns of the file that are not read, by name.")
    units: dict[str, str] = Field(
        default_factory=dict,
        description="Units by column: {target: inch, deviation: mm}. Without it the unit in the header's "
        "brackets holds, and without that mm and micrometres (degrees and arc seconds).",
    )
    delimiter: Literal[",", ";", "\t", "comma", "semicolon", "tab"] | None = Field(
        None, description="What parts the columns; told apart if not stated."
    )
    decimal: Literal[".", ",", "point", "comma"] | None = Field(
        None, description="The decimal sign; told apart if not stated."
    )
    sign: Literal["actual-nominal", "nominal-actual"] = Field(
        "actual-nominal", description="How the file forms its deviations; no file tells."
    )
    direction: Literal["+", "-", "up", "down", "forward", "reverse"] | None = Field(
        None, description="Direction of all readings, where the file names none."
    )
    lines: tuple[Annotated[int, Field(ge=1)], Annotated[int, Field(ge=1)]] | None = Field(
        None, description="First line (the header) and last line of the table, where the file holds more."
    )
    encoding: Annotated[str, AfterValidator(known_encoding)] | None = Field(
        None, description="Encoding of the file, if it is not UTF-8: cp1252, gbk, utf-16."
    )

    @field_validator("columns")
    @classmethod
    def _columns_are_known(cls, columns: dict[str, str]) -> dict[str, str]:
        for name in columns:
            if folded(name) not in COLUMN_NAMES and run_and_direction(name) is None:
                raise ValueError(
                    f"{name!r} is no column of a measurement file; {did_you_mean(name, COLUMN_NAMES)}"
                )
        return columns

    @field_validator("units")
    @classmethod
    def _units_are_of_columns(cls, units: dict[str, str]) -> dict[str, str]:
        for name, spelling in units.items():
            if name not in _UNITS:
                raise ValueError(f"{name!r} is no column with a unit; {did_you_mean(name, list(_UNITS))}")
            unit_named(spelling, _UNITS[name])
        return units

    @model_validator(mode="after")
    def _keys_agree(self) -> Self:
        if self.layout == "long" and self.values == "position":
            raise ValueError("'values' is for 'layout: wide'; a long table has a column 'position' instead")
        if self.lines and self.lines[0] >= self.lines[1]:
            raise ValueError("'lines' names the header's line and the last line; the second is the larger")
        return self

    @property
    def stated_delimiter(self) -> str | None:
        """The delimiter that the job states."""
        return _DELIMITERS.get(self.delimiter, self.delimiter) if self.delimiter else None

    @property
    def stated_decimal_sign(self) -> DecimalSign | None:
        """The decimal sign that the job states."""
        if self.decimal is None:
            return None
        return DecimalSign.COMMA if self.decimal in {",", "comma"} else DecimalSign.POINT

    @property
    def stated_direction(self) -> Approach | None:
        """The direction of all readings that the job states."""
        return direction(self.direction) if self.direction else None
