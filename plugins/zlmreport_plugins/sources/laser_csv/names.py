"""Names and spellings in tables: columns, directions, and the headers of a wide table."""

from __future__ import annotations

import re
from collections.abc import Mapping
from types import MappingProxyType

from zlmreport.plugin import CONDITIONS, MINUS_SIGN, Approach, did_you_mean

#: The columns that have a meaning; any other is kept as a condition under its own name.
COLUMN_NAMES = ("target", "direction", "run", "deviation", "position", "time", *CONDITIONS)

_SIGNS = {"+": Approach.POSITIVE, "-": Approach.NEGATIVE, MINUS_SIGN: Approach.NEGATIVE}
_ARROWS = {"↑": Approach.POSITIVE, "↓": Approach.NEGATIVE}
_WORDS = {
    **dict.fromkeys(("up", "forward", "forwards", "fwd", "positive", "pos"), Approach.POSITIVE),
    **dict.fromkeys(("down", "reverse", "rev", "backward", "backwards", "bwd"), Approach.NEGATIVE),
    **dict.fromkeys(("negative", "neg"), Approach.NEGATIVE),
    **dict.fromkeys(("auf", "vor", "vorwärts", "positiv"), Approach.POSITIVE),
    **dict.fromkeys(("ab", "zurück", "rückwärts", "negativ"), Approach.NEGATIVE),
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
    re.compile(rf"{_RUN}(?P<run>[1-9][0-9]{{0,5}})[\s_.]*(?P<direction>{_IN_HEADERS})?"),
    re.compile(rf"(?P<direction>{_IN_HEADERS})[\s_.]*{_RUN}(?P<run>[1-9][0-9]{{0,5}})"),
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
    for form in _HEADERS:
        match = form.fullmatch(header.strip().casefold())
        if match:
            spelling = match["direction"]
            return int(match["run"]), _SPELLED_OUT[spelling] if spelling else None
    return None
