"""The data source of a measurement, and of each of its measured lines."""

from __future__ import annotations

from contextlib import suppress

from zlmreport.errors import InputError, Place, Problem
from zlmreport.job.choices import choose_in, choose_instrument
from zlmreport.job.installed import Installed
from zlmreport.job.job import SourceChoice
from zlmreport.job.keys import JobKeys
from zlmreport.job.tree import Keys, Scalar, find_at, find_key_place


def choose_source(
    tree: Keys, path: tuple[str, ...], registry: Installed, problems: list[Problem]
) -> SourceChoice | None:
    """Return the data source at a path, with its own keys; None where there is none, or a wrong one."""
    keys, within = find_at(tree, path), ".".join(path)
    plugin = find_at(tree, (*path, "plugin"))
    choice = choose_in(keys, "plugin", registry.source, problems, within=within)
    instrument = None
    with suppress(InputError):  # a source that there is not was refused above
        if isinstance(keys, Keys) and isinstance(plugin, Scalar):
            known = registry.source(plugin.text).options
            instrument = choose_instrument(known, keys, registry, problems, within=within)
    return SourceChoice(choice.identifier, choice.options, choice.place, instrument) if choice else None


def choose_sources_of_tests(
    keys: JobKeys, tree: Keys, registry: Installed, problems: list[Problem]
) -> dict[str, SourceChoice]:
    """Return the data source of each named test; one that several share is checked once."""
    found = {}
    checked: dict[Place, SourceChoice | None] = {}
    for name in keys.measurement.tests:
        path = ("measurement", "tests", name, "source")
        place = find_key_place(tree, path)
        if place not in checked:
            checked[place] = choose_source(tree, path, registry, problems)
        source = checked[place]
        if source:
            found[name] = source
    return found
