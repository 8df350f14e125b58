"""A test that the residuals of a model did not pass."""

from __future__ import annotations

from dataclasses import dataclass, field
from enum import Enum

from zlmreport.language import Words
from zlmreport.quantities.arrays import IntArray, read_only_integers


class ResidualTest(Enum):
    """The tests of residuals, with the names that results files use."""

    LACK_OF_FIT = "lack-of-fit"
    TIME_ORDER = "time-order"
    SIGNS = "signs"
    PERIOD_IN_POSITION = "period-in-position"
    PERIOD_IN_TIME = "period-in-time"
    DIRECTION = "direction"
    RUNS = "runs"
    CONDITION = "condition"
    SPREAD = "spread"
    OUTLIERS = "outliers"

    @property
    def title(self) -> Words:
        """What it tests."""
        return _TITLES[self]

    @property
    def blind_to(self) -> Words:
        """What it cannot see."""
        return _BLIND[self]


@dataclass(frozen=True, slots=True)
class Failure:
    """A test that the residuals did not pass.

    Attributes
    ----------
    test
        Which.
    p_value
        Chance of such residuals if the model held.
    where
        The place, the time, the run or the condition: what stands in brackets after the statement.
    statement
        What the residuals do, in a sentence without a full stop.
    readings : (k,) integer array
        The readings that `where` names, by their places in the design; none where all show it, or where they
        were set aside before.
    """

    test: ResidualTest
    p_value: float
    where: Words
    statement: Words
    readings: IntArray = field(default_factory=lambda: read_only_integers([]), compare=False)


_TITLES = {
    ResidualTest.LACK_OF_FIT: Words(
        en="Means of the positions against the repeats",
        de="Mittelwerte der Positionen gegen die Wiederholungen",
    ),
    ResidualTest.TIME_ORDER: Words(
        en="Order of time within the repeats", de="Zeitfolge innerhalb der Wiederholungen"
    ),
    ResidualTest.SIGNS: Words(en="Signs along the axis", de="Vorzeichen längs der Achse"),
    ResidualTest.PERIOD_IN_POSITION: Words(en="Period along the axis", de="Periode längs der Achse"),
    ResidualTest.PERIOD_IN_TIME: Words(en="Period in time", de="Periode in der Zeit"),
    ResidualTest.DIRECTION: Words(en="Up against down", de="Aufwärts gegen abwärts"),
    ResidualTest.RUNS: Words(en="Run against run", de="Durchlauf gegen Durchlauf"),
    ResidualTest.CONDITION: Words(en="Logged conditions", de="Aufgezeichnete Bedingungen"),
    ResidualTest.SPREAD: Words(en="Equal scatter", de="Gleiche Streuung"),
    ResidualTest.OUTLIERS: Words(en="Single readings", de="Einzelne Messwerte"),
}
_BLIND = {
    ResidualTest.LACK_OF_FIT: Words(
        en="whatever moves with time in the linear method: there it counts as scatter",
        de="alles, was sich beim Linearverfahren mit der Zeit bewegt: Es zählt dort als Streuung",
    ),
    ResidualTest.TIME_ORDER: Words(
        en="position and direction; in pendulum and pilgrim tests nearly everything",
        de="Position und Richtung; bei Pendel- und Pilgerschrittverfahren fast alles",
    ),
    ResidualTest.SIGNS: Words(en="the size of the residuals", de="die Größe der Residuen"),
    ResidualTest.PERIOD_IN_POSITION: Words(
        en="periods of which the targets are multiples",
        de="Perioden, deren Vielfache die Zielpositionen sind",
    ),
    ResidualTest.PERIOD_IN_TIME: Words(
        en="periods shorter than a few readings", de="Perioden, die kürzer als einige Messwerte sind"
    ),
    ResidualTest.DIRECTION: Words(en="what is alike up and down", de="was aufwärts und abwärts gleich ist"),
    ResidualTest.RUNS: Words(en="changes within a run", de="Änderungen innerhalb eines Durchlaufs"),
    ResidualTest.CONDITION: Words(
        en="conditions that were not logged", de="nicht aufgezeichnete Bedingungen"
    ),
    ResidualTest.SPREAD: Words(en="the means", de="die Mittelwerte"),
    ResidualTest.OUTLIERS: Words(en="all but single readings", de="alles außer einzelnen Messwerten"),
}
