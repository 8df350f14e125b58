"""Loads the catalogues of effects beside it, and the polynomial."""

from __future__ import annotations

from collections.abc import Iterable

from zlmreport.plugin import hookimpl
from zlmreport.plugin.effect import Effect, effects_of_catalogue


class Catalogue:
    """The catalogue of a subject as a plugin: what a module with the hook is."""

    def __init__(self, file: str) -> None:
        self.file = file

    @hookimpl
    def zlmreport_effects(self) -> Iterable[Effect]:
        """Return its effects, in the order of the file."""
        return effects_of_catalogue(__file__, self.file)


position = Catalogue("position.yaml")
reversal = Catalogue("reversal.yaml")
periodic = Catalogue("periodic.yaml")
thermal = Catalogue("thermal.yaml")
course = Catalogue("course.yaml")


@hookimpl
def zlmreport_effects() -> Iterable[Effect]:
    """Return all of them: of position, of direction, of what repeats, of time and temperature."""
    from zlmreport_plugins.effects import polynomial

    subjects = (position, polynomial, reversal, periodic, thermal, course)
    return tuple(effect for subject in subjects for effect in subject.zlmreport_effects())
