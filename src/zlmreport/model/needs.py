"""What effects need of a test: each function says in words what is missing, or returns None.

An effect joins its needs by ``or``, the first that is not met answers::

    def untestable(self, design: Design) -> Words | None:
        return needs.linear_axis(design) or needs.logged(design, "axis_temperature")
"""

from __future__ import annotations

import numpy as np

from zlmreport.language import Words
from zlmreport.measurement.axis import AxisKind
from zlmreport.model.design import Design

_NO_COLUMN = Words(
    en="no column {column} was logged beside the readings",
    de="die Spalte {column} wurde nicht neben den Messwerten aufgezeichnet",
)
_NO_COLUMNS = Words(
    en="no columns {columns} were logged beside the readings",
    de="die Spalten {columns} wurden nicht neben den Messwerten aufgezeichnet",
)
_NO_KEY = Words(en="the job does not state {key}", de="der Auftrag nennt {key} nicht")
_ONE_DIRECTION = Words(
    en="the targets were approached from one direction only",
    de="die Zielpositionen wurden nur aus einer Richtung angefahren",
)
_NOT_LINEAR = Words(en="it belongs to linear axes", de="er gehört zu Linearachsen")
_NOT_ROTARY = Words(en="it belongs to rotary axes", de="er gehört zu Drehachsen")
_FEW_TARGETS = Words(
    en="it needs at least {least} target positions; there are {found}",
    de="er braucht mindestens {least} Zielpositionen; es sind {found}",
)
_FEW_RUNS = Words(
    en="it needs at least {least} runs; there are {found}",
    de="er braucht mindestens {least} Durchläufe; es sind {found}",
)
_NO_TIME = Words(
    en="no time passes between the first reading and the last",
    de="zwischen dem ersten und dem letzten Messwert vergeht keine Zeit",
)
_SHORT_TRAVEL = Words(
    en="the measured travel is shorter than one period ({key})",
    de="der gemessene Verfahrweg ist kürzer als eine Periode ({key})",
)


def logged(design: Design, *columns: str) -> Words | None:
    """Demand logged conditions, by their names."""
    missing = [column for column in columns if column not in design.conditions]
    if len(missing) > 1:
        return _NO_COLUMNS.given(columns=", ".join(missing))
    return _NO_COLUMN.given(column=missing[0]) if missing else None


def stated(value: object, key: str) -> Words | None:
    """Demand that the job states something, by its value and its key."""
    return _NO_KEY.given(key=key) if value is None else None


def both_directions(design: Design) -> Words | None:
    """Demand targets that are approached from both directions."""
    return None if design.is_bidirectional else _ONE_DIRECTION


def linear_axis(design: Design) -> Words | None:
    """Demand an axis along which positions are lengths."""
    return None if design.axis.kind is AxisKind.LINEAR else _NOT_LINEAR


def rotary_axis(design: Design) -> Words | None:
    """Demand an axis along which positions are angles."""
    return None if design.axis.kind is AxisKind.ROTARY else _NOT_ROTARY


def is_of_another_axis(reason: Words) -> bool:
    """Whether a need that is not met is that for another kind of axis: no measurement would meet it."""
    return reason in (_NOT_LINEAR, _NOT_ROTARY)


def targets(design: Design, least: int) -> Words | None:
    """Demand a number of target positions."""
    found = len(design.target_positions)
    return None if found >= least else _FEW_TARGETS.given(least=least, found=found)


def runs(design: Design, least: int) -> Words | None:
    """Demand a number of runs."""
    found = len(np.unique(design.run))
    return None if found >= least else _FEW_RUNS.given(least=least, found=found)


def passing_time(design: Design) -> Words | None:
    """Demand readings that were not all taken at once."""
    return None if design.duration > 0 else _NO_TIME


def whole_period(design: Design, period: float | None, key: str) -> Words | None:
    """Demand a period that the job states under a key, and a travel that is not shorter."""
    if period is None:
        return stated(period, key)
    return None if design.length >= period else _SHORT_TRAVEL.given(key=key)
