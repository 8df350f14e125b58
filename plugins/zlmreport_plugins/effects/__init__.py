"""The effects that come with zlmreport: catalogues by subject, and a polynomial, which no formula says."""

from __future__ import annotations

from collections.abc import Iterable

from zlmreport.plugin import hookimpl
from zlmreport.plugin.effect import Effect


@hookimpl
def zlmreport_effects() -> Iterable[Effect]:
    """Return all of them: of position, of direction, of what repeats, of time and temperature."""
    from zlmreport_plugins.effects import course, periodic, polynomial, position, reversal, thermal

    subjects = (position, polynomial, reversal, periodic, thermal, course)
    return tuple(effect for subject in subjects for effect in subject.zlmreport_effects())
