"""The ways to tell people that a fleet file names: each a notifier of a plugin with its own keys."""

from __future__ import annotations

import threading
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field, replace
from pathlib import Path

from zlmreport.errors import InputError, Problem, ZlmreportError
from zlmreport.fleet.records import About, Notice
from zlmreport.job.contradictions import validate
from zlmreport.job.fleet import FleetFile
from zlmreport.job.tree import Keys, Scalar, found_at
from zlmreport.job.types import Options
from zlmreport.plugin.kinds import NOTIFIER
from zlmreport.plugin.protocols import Message, Notifier, Occasion
from zlmreport.plugins import Registry, find_plugins

#: For which the night waits until a message is taken, s: nothing that tells of a night may stop it.
PATIENCE = 60.0
#: Of the group of keys itself.
_CORE = ("plugin", "tells")


class NotToldError(Exception):
    """Nobody took the news; why, in words."""


@dataclass(frozen=True, slots=True)
class Way:
    """A way to tell people.

    Attributes
    ----------
    notifier
        Of a plugin.
    options
        Its own keys.
    tells
        What it is used for.
    """

    notifier: Notifier
    options: Options
    tells: frozenset[Occasion]

    @property
    def name(self) -> str:
        """What tells this way from others, here and in the ledger."""
        return f"{self.notifier.identifier} {self.notifier.receiver(self.options)}"

    def tell(self, message: Message) -> None:
        """Tell people; raise `NotToldError` if nobody took it in time."""
        raised: list[Exception] = []

        def run() -> None:
            try:
                self.notifier.tell(message, self.options)
            except (ZlmreportError, MemoryError) as error:
                raised.append(error)

        thread = threading.Thread(target=run, daemon=True)
        thread.start()
        thread.join(PATIENCE)
        if thread.is_alive():
            raise NotToldError(f"it was not taken within {PATIENCE:g} s")
        if raised:
            raise NotToldError(str(raised[0])) from raised[0]


@dataclass(slots=True)
class Ways:
    """All ways of a fleet; one that failed is not tried again in the same night.

    Attributes
    ----------
    all
        In the order of the fleet file.
    failed
        Those that nobody was reached by tonight.
    """

    all: tuple[Way, ...] = ()
    failed: set[str] = field(default_factory=set)

    def of(self, occasion: Occasion) -> Iterator[Way]:
        """Yield those that tell of an occasion, and may still work."""
        return (way for way in self.all if occasion in way.tells and way.name not in self.failed)

    def tell(self, way: Way, message: Message, watch: Callable[[Notice], None]) -> bool:
        """Tell people by one of them, and return whether it was taken; if not, the watch takes note."""
        try:
            way.tell(message)
        except NotToldError as error:
            self.failed.add(way.name)
            watch(Notice(About.UNTOLD, f"the news was not sent by {way.name}: {error}"))
            return False
        return True


def ways_of(fleet: FleetFile, plugins: tuple[Path, ...]) -> Ways:
    """Return the ways that a fleet file names, each with its own keys checked.

    Raises
    ------
    InputError
        With every mistake in these keys, in the order of their places.
    """
    if not fleet.keys.notify:
        return Ways()
    registry, problems = find_plugins(files=plugins), list[Problem]()
    found = [_way(fleet, index, registry, problems) for index in range(len(fleet.keys.notify))]
    if problems:
        raise InputError(sorted(set(problems)))
    return Ways(tuple(way for way in found if way))


def _way(fleet: FleetFile, index: int, registry: Registry, problems: list[Problem]) -> Way | None:
    keys, core = found_at(fleet.tree, ("notify", index)), fleet.keys.notify[index]
    named = found_at(fleet.tree, ("notify", index, "plugin"))
    if not isinstance(keys, Keys) or not isinstance(named, Scalar):
        return None
    try:
        notifier = registry.find(NOTIFIER, named.text, named.place)
    except InputError as error:
        problems.extend(error.problems)
        return None
    own = replace(keys.without(*_CORE), place=named.place)
    options = validate(notifier.options, own, problems, within="notify", also_known=_CORE)
    return Way(notifier, options, frozenset(map(Occasion, core.tells))) if options else None
