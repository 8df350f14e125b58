"""All tests of the residuals of a model."""

from __future__ import annotations

from collections.abc import Iterator

from zlmreport.model.failures.conditions import conditions
from zlmreport.model.failures.failure import Failure
from zlmreport.model.failures.means import direction, lack_of_fit, runs, signs
from zlmreport.model.failures.order import period_in_position, period_in_time, time_order
from zlmreport.model.failures.residuals import Residuals
from zlmreport.model.failures.scatter import spread

_SINGLE = (
    lack_of_fit,
    signs,
    direction,
    runs,
    time_order,
    period_in_position,
    period_in_time,
    conditions,
)
#: Chance that any of the tests of a sound model is called a failure.
LEVEL = 0.05


def residual_tests(residuals: Residuals) -> tuple[Failure, ...]:
    """Return every test that the design allows, passed or not."""
    return tuple(_tests(residuals))


def failures(tests: tuple[Failure, ...]) -> tuple[Failure, ...]:
    """Return the tests that were not passed, the clearest first; each pays for the number of them."""
    limit = LEVEL / max(1, len(tests))
    return tuple(sorted((test for test in tests if test.p_value < limit), key=lambda test: test.p_value))


def _tests(residuals: Residuals) -> Iterator[Failure]:
    for single in _SINGLE:
        found = single(residuals)
        if found is not None:
            yield found
    yield from spread(residuals)
