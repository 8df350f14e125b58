"""ISO 230-2, positioning of numerically controlled axes: editions 1988, 1997, 2006 and 2014.

The editions are rows of one table (`editions`); their formulas differ by the coverage factor only
(`formulas`), their words by edition (`wording`).
"""

from __future__ import annotations

from zlmreport.plugin import Standard, hookimpl
from zlmreport_plugins.standards.iso230_2.editions import EDITIONS
from zlmreport_plugins.standards.iso230_2.standard import Iso230Part2


@hookimpl
def zlmreport_standards() -> tuple[Standard, ...]:
    """Return the four editions, the oldest first."""
    return tuple(Iso230Part2(edition) for edition in EDITIONS)
