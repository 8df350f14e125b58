"""Where a model fails, as values that point at the readings which show it."""

from __future__ import annotations

from typing import Any

import numpy as np

from zlmreport.language import Language
from zlmreport.measurement.measurement_set import CONDITION_NAMES
from zlmreport.model import wording
from zlmreport.model.diagnosis import Diagnosis
from zlmreport.model.residuals import Failure, ResidualTest
from zlmreport.model.study import Study

_IN_TIME = {ResidualTest.TIME_ORDER, ResidualTest.PERIOD_IN_TIME}
#: Nobody knows the tails of real scatter better: below, a smaller chance is no stronger evidence.
_LEAST_P = 1e-6
_SMALL_P = 1e-3
#: A blank at which no line ends.
_HELD = "\N{NO-BREAK SPACE}"
_SUPERSCRIPTS = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")


def failure(found: Failure, diagnosis: Diagnosis, study: Study, language: Language) -> dict[str, Any]:
    """Return a failure: what is said of it, and the axis and the readings that show it."""
    axis, where = "position", found.where
    if found.test is ResidualTest.RUNS:
        axis = "run"
    elif found.test in _IN_TIME:
        axis = "time"
    elif found.test is ResidualTest.CONDITION:
        axis = where.in_language(Language.ENGLISH)
        where = CONDITION_NAMES.get(axis, where)
    return {
        "statement": found.statement.in_language(language),
        "where": where.in_language(language),
        "p": chance(found.p_value, language),
        "axis": axis,
        "readings": _readings(found, diagnosis, study),
    }


def _readings(failure: Failure, diagnosis: Diagnosis, study: Study) -> list[int]:
    """Return the places of the readings that show a failure, in the measurement set; none where all do."""
    if failure.test is ResidualTest.OUTLIERS:
        return [int(each) for each in diagnosis.outliers]
    kept = study.observed.reading[~np.isin(study.observed.reading, diagnosis.outliers)]
    return [int(each) for each in kept[failure.readings]]


def chance(value: float, language: Language, *, is_extrapolated: bool = False) -> str:
    """Write a chance with as many digits as it is known to: one if no simulated test comes near it."""
    if value < _LEAST_P:
        return _HELD.join(("p", "<", "10⁻⁶"))
    sign, digits = ("≈", 0) if is_extrapolated else ("=", 1)
    if value >= _SMALL_P:
        return _HELD.join(("p", sign, wording.number(value, 3).in_language(language)))
    mantissa, _, exponent = f"{value:.{digits}e}".partition("e")
    mantissa = mantissa.replace(".", language.decimal_sign)
    return _HELD.join(("p", sign, f"{mantissa}·10{str(int(exponent)).translate(_SUPERSCRIPTS)}"))
