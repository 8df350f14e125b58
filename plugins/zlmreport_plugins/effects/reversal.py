"""What differs between the directions of approach: the effects of ``reversal.yaml``."""

from __future__ import annotations

from collections.abc import Iterable

from zlmreport.plugin import hookimpl
from zlmreport.plugin.effect import Effect, effects_of_catalogue


@hookimpl
def zlmreport_effects() -> Iterable[Effect]:
    """Return them in the order of the file."""
    return effects_of_catalogue(__file__, "reversal.yaml")
