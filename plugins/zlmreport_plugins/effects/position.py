"""What is fixed in position: the effects of ``position.yaml``."""

from __future__ import annotations

from collections.abc import Iterable

from zlmreport.plugin import hookimpl
from zlmreport.plugin.effect import Effect, effects_of_catalogue


@hookimpl
def zlmreport_effects() -> Iterable[Effect]:
    """Return them in the order of the file."""
    return effects_of_catalogue(__file__, "position.yaml")
