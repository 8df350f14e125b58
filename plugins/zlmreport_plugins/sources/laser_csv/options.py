"""The keys of a table in a job; names of columns, runs and directions (up, forward, aller, ↑, +)."""

from __future__ import annotations

import itertools
import re
from collections.abc import Mapping
from types import MappingProxyType
from typing import Literal, Self

from pydantic import Field, model_validator

from zlmreport.plugin import (
    CONDITIONS,
    MINUS_SIGN,
    POSITION_UNITS,
    TIME_UNITS,
    Approach,
    ReadingScale,
    Unit,
    did_you_mean,
)
from zlmreport.plugin.table import TableOptions, TablePlace
from zlmreport_plugins.logged_columns import list_spellings

#: The columns that have a meaning; any other is kept as a condition under its own name.
COLUMN_NAMES = ("target", "direction", "run", "deviation", "position", "time", *CONDITIONS)

_SIGNS = {"+": Approach.POSITIVE, "-": Approach.NEGATIVE, MINUS_SIGN: Approach.NEGATIVE}
_ARROWS = {**dict.fromkeys("↑→", Approach.POSITIVE), **dict.fromkeys("↓←", Approach.NEGATIVE)}
_CHINESE = {
    Approach.POSITIVE: ("正向", "正方向", "正程", "去程", "往程", "往路", "前进", "正", "去", "往"),
    Approach.NEGATIVE: (
        *("反向", "负向", "負向", "逆向", "反方向", "负方向", "反程", "回程", "返程", "复路", "復路", "后退"),
        *("反", "负", "負", "逆", "回", "返", "复", "復"),
    ),
}
#: Words for directions of a language in which no blank parts words.
CHINESE_DIRECTIONS = tuple(itertools.chain(*_CHINESE.values()))
_WORDS = {
    **dict.fromkeys(
        (
            *("up", "forward", "forwards", "fwd", "positive", "pos", "plus", "increasing"),
            *("auf", "aufwärts", "hin", "hinweg", "hinfahrt"),
            *("vor", "vorwärts", "vorlauf", "positiv", "steigend"),
            *list_spellings("aller montant montée positif croissant"),
            *list_spellings("andata salita avanti positivo positiva crescente"),
            *list_spellings("ida subida adelante ascendente creciente"),
            *_CHINESE[Approach.POSITIVE],
        ),
        Approach.POSITIVE,
    ),
    **dict.fromkeys(
        (
            *("down", "reverse", "rev", "backward", "backwards", "bwd"),
            *("negative", "neg", "minus", "decreasing"),
            *("ab", "abwärts", "her", "rück", "rückweg", "rückfahrt", "zurück", "rückwärts", "rücklauf"),
            *("negativ", "fallend"),
            *list_spellings("retour descendant descente négatif décroissant"),
            *list_spellings("ritorno discesa indietro negativo negativa decrescente"),
            *list_spellings("vuelta bajada atrás descendente decreciente"),
            *_CHINESE[Approach.NEGATIVE],
        ),
        Approach.NEGATIVE,
    ),
}
#: In cells only: in a header they may be the initial of anything.
_LETTERS = {**dict.fromkeys("fvuph", Approach.POSITIVE), **dict.fromkeys("brdn", Approach.NEGATIVE)}
_NUMBERS = {
    "1": Approach.POSITIVE,
    "+1": Approach.POSITIVE,
    "-1": Approach.NEGATIVE,
    f"{MINUS_SIGN}1": Approach.NEGATIVE,
}
#: As keyboards without umlauts write them.
_TRANSCRIBED = str.maketrans({"ä": "ae", "ö": "oe", "ü": "ue", "ß": "ss"})
_IN_ASCII = {word.translate(_TRANSCRIBED): approach for word, approach in _WORDS.items()}
_SPELLED_OUT: Mapping[str, Approach] = MappingProxyType({**_SIGNS, **_ARROWS, **_WORDS, **_IN_ASCII})
_DIRECTIONS: Mapping[str, Approach] = MappingProxyType({**_SPELLED_OUT, **_LETTERS, **_NUMBERS})

_IN_HEADERS = "|".join(re.escape(spelling) for spelling in sorted(_SPELLED_OUT, key=len, reverse=True))
_RUN = (
    r"(?:(?:run|cycle|pass|test|measurement|meas\.?|lauf|messlauf|durchlauf|durchgang|zyklus|messung|messreihe"
    r"|passe|parcours|essai|mesure|passata|ciclo|prova|misura|recorrido|pasada|ensayo|medida|medici[oó]n|第)"
    r"[\s_.]*)?"
)
_NUMBER = r"(?P<run>[1-9][0-9]{0,5})(?:次|回目|遍)?"
#: ``1+``, ``1 ↓``, ``Run 1 fwd``, ``RUN 1``, ``第1次正向``; ``+1``, ``fwd 1``, ``forward run 1``, ``正向1``.
_HEADERS = (
    rf"{_RUN}{_NUMBER}[\s_.]*(?P<direction>{_IN_HEADERS})?",
    rf"(?P<direction>{_IN_HEADERS})[\s_.]*{_RUN}{_NUMBER}",
)


def read_direction(spelling: str) -> Approach:
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


_UNITS: Mapping[str, Mapping[str, Unit | ReadingScale]] = {
    **dict.fromkeys(("target", "deviation", "position"), POSITION_UNITS),
    "time": TIME_UNITS,
    **{name: kind.units for name, kind in CONDITIONS.items()},
}


class _Part(TablePlace):
    """Where a table stands in its file, and what it does not say of the direction."""

    direction: Literal["+", "-", "up", "down", "forward", "reverse", "by-order"] | None = Field(
        None,
        description="Direction of all readings, where the file names none; by-order: rows stand in the order "
        "in which they were taken, and a target above the one before was approached upwards.",
    )


class LaserCsvOptions(_Part, TableOptions):
    """Where the table is, and what it does not say itself."""

    column_names = COLUMN_NAMES
    column_units = _UNITS
    header_example = "target,direction,run,deviation"

    parts: tuple[_Part, ...] = Field(
        (),
        description="Several tables of one file that are one test, such as one of each direction: of each "
        "what the other keys do not say.",
    )
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
    runs: Literal["counted"] | None = Field(
        None,
        description="counted: the file names no runs, and the n-th reading of a target in a direction is of "
        "run n; where the rows go from target to target, of the n-th pass over them. Without it all are of "
        "one run.",
    )
    units: dict[str, str] = Field(
        default_factory=dict,
        description="Units by column: {target: inch, deviation: mm}. Without it the unit behind the number, "
        "in the header's brackets or in a row below the header holds, and without that mm and micrometres "
        "(degrees and arc seconds).",
    )
    sign: Literal["actual-nominal", "nominal-actual"] = Field(
        "actual-nominal", description="How the file forms its deviations; no file tells."
    )

    @classmethod
    def knows_column(cls, name: str) -> bool:
        """Whether a job may name a column so."""
        return super().knows_column(name) or run_and_direction(name) is not None

    @model_validator(mode="after")
    def _layout_agrees(self) -> Self:
        if self.layout == "long" and self.values == "position":
            raise ValueError("'values' is for 'layout: wide'; a long table has a column 'position' instead")
        if self.layout == "wide" and self.is_by_order:
            raise ValueError(
                "'direction: by-order' is for 'layout: long'; the columns of a wide table tell the direction"
            )
        return self

    @property
    def tables(self) -> tuple[LaserCsvOptions, ...]:
        """The keys of each table of the file: one, where the job states no parts."""
        if not self.parts:
            return (self,)
        stated = ({name: getattr(part, name) for name in part.model_fields_set} for part in self.parts)
        return tuple(self.model_copy(update=each) for each in stated)

    @property
    def is_by_order(self) -> bool:
        """Whether the order of the rows tells the directions, of one table at least."""
        return any(part.direction == "by-order" for part in (self, *self.parts))

    @property
    def stated_direction(self) -> Approach | None:
        """The direction of all readings that the job states."""
        return None if self.direction in {None, "by-order"} else read_direction(self.direction)
