"""``zlmreport plugins``: what is installed, and what is not and why."""

from __future__ import annotations

from argparse import Namespace
from collections.abc import Iterator
from pathlib import Path

from zlmreport.cli.terminal import Colour, shown_path, table
from zlmreport.language import Language
from zlmreport.plugins import DISABLE, Kind, Plugin, Registry, find_plugins


def run(options: Namespace) -> int:
    """Print every plugin."""
    print(*listing(find_plugins(files=options.plugin)), sep="\n")
    return 0


def listing(registry: Registry) -> Iterator[str]:
    """Yield the lines on all plugins, kind by kind."""
    for kind, offered in (
        (Kind.STANDARD, registry.standards),
        (Kind.SOURCE, registry.sources),
        (Kind.RENDERER, registry.renderers),
        (Kind.EFFECT, registry.effects),
        (Kind.PART_PROGRAM, registry.part_programs),
        (Kind.PROBING_PROGRAM, registry.probing_programs),
        (Kind.INSTRUMENT, registry.instruments),
    ):
        yield Colour.BOLD.of(f"{kind.label}s")
        rows = [
            (
                each.identifier,
                each.title.in_language(Language.ENGLISH),
                _origin(registry.origins[kind, each.identifier]),
            )
            for each in offered
        ]
        yield from table(rows or [("none", "", "")], indent="  ")
    if registry.failed:
        yield Colour.RED.of("not loaded")
        rows = [(each.plugin.name, each.plugin.release, each.reason) for each in registry.failed]
        yield from table(rows, indent="  ")
    if registry.disabled:
        yield f"switched off by {DISABLE}"
        yield from (f"  {name}" for name in registry.disabled)


def _origin(plugin: Plugin) -> str:
    """Return where a plugin comes from: what was installed, or its file."""
    return plugin.release or shown_path(Path(plugin.module))
