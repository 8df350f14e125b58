"""Tests of the scatter: whether it is the same everywhere, and whether single readings stand off."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from zlmreport.language import Words
from zlmreport.model import wording
from zlmreport.model.design import Design
from zlmreport.model.failures.failure import Failure, ResidualTest
from zlmreport.model.failures.residuals import Residuals
from zlmreport.model.outliers import Outliers
from zlmreport.model.spread import SpreadFactor, SpreadTest, spread_tests
from zlmreport.quantities.arrays import IntArray, read_only_integers

_UNEQUAL = Words(
    en="the readings scatter unequally {factor}", de="die Messwerte streuen {factor} verschieden"
)
_UPWARDS = Words(en="more upwards", de="mehr aufwärts")
_DOWNWARDS = Words(en="more downwards", de="mehr abwärts")
_MOST_AT = Words(en="most at {place}", de="am meisten bei {place}")
_RUN = Words(en="run {run}", de="Durchlauf {run}")
_FLAGGED = Words(
    en="readings that stand off from their repeats and from their neighbours in time: {count}; they are set "
    "aside, not altered",
    de="Messwerte, die von ihren Wiederholungen und ihren zeitlichen Nachbarn abstehen: {count}; sie sind "
    "beiseite gelegt, nicht verändert",
)
_AT = Words(en="at {place}", de="bei {place}")
_AND_MORE = Words(en="{first}; others: {more}", de="{first}; weitere: {more}")


def spread(residuals: Residuals) -> Iterator[Failure]:
    """Yield the tests of equal scatter by position, direction and run."""
    design = residuals.design
    for test in spread_tests(design, residuals.fit.deviation):
        statement = _UNEQUAL.given(factor=test.factor.words)
        where, readings = _widest(design, test)
        yield Failure(ResidualTest.SPREAD, test.p_value, where, statement, readings)


def flagged(design: Design, aside: Outliers) -> Failure | None:
    """Return what is to be said of readings that were set aside, on the design that still has them."""
    readings = aside.readings
    if not len(readings):
        return None
    where = _AT.given(place=wording.reading_at(design, int(readings[0])))
    if len(readings) > 1:
        where = _AND_MORE.given(first=where, more=len(readings) - 1)
    return Failure(ResidualTest.OUTLIERS, aside.p_value, where, _FLAGGED.given(count=len(readings)))


def _widest(design: Design, test: SpreadTest) -> tuple[Words, IntArray]:
    """Return where readings scatter most, and which these are."""
    if test.factor is SpreadFactor.DIRECTION:
        chosen = np.sign(design.direction) == np.sign(test.widest)
        return (_UPWARDS if test.widest > 0 else _DOWNWARDS), read_only_integers(np.flatnonzero(chosen))
    if test.factor is SpreadFactor.RUN:
        chosen = design.run == test.widest
        place = _RUN.given(run=test.widest)
    else:
        chosen = design.target == test.widest
        place = wording.position(design.axis, float(design.position[int(np.argmax(chosen))]))
    return _MOST_AT.given(place=place), read_only_integers(np.flatnonzero(chosen))
