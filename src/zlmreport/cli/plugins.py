"""``zlmreport plugins``: what is installed, what is not and why; ``zlmreport schema``: the keys of a job."""

from __future__ import annotations

from argparse import Namespace
from collections.abc import Iterator
from pathlib import Path

from zlmreport.cli.terminal import Colour, lay_out_table, print_json, show_path, wrap
from zlmreport.language import Language
from zlmreport.plugin.kinds import KINDS
from zlmreport.plugin.registry import DISABLE, Plugin, Registry, find_plugins


def run(options: Namespace) -> int:
    """Print every plugin, and then what the user should mend before any job is run."""
    registry = find_plugins(files=options.plugin, lenient=True)
    print(*_list_plugins(registry), sep="\n", flush=True)
    if registry.refused:
        raise registry.refused
    return 0


def _list_plugins(registry: Registry) -> Iterator[str]:
    offers = registry.list_offers()
    for kind in KINDS:
        yield Colour.BOLD.set(f"{kind.label}s")
        rows = [
            (each.identifier, each.offered.title.in_language(Language.ENGLISH), _name_origin(each.plugin))
            for each in offers
            if each.kind is kind
        ]
        yield from lay_out_table(rows or [("none", "", "")], indent="  ", wrapping=1)
    if registry.failed:
        yield Colour.RED.set("not loaded")
        rows = [(each.plugin.name, each.plugin.release, each.reason) for each in registry.failed]
        yield from lay_out_table(rows, indent="  ", wrapping=2)
    if clashes := registry.list_clashes():
        yield Colour.RED.set("provided twice")
        for each in clashes:
            yield from wrap(each)
    if registry.disabled:
        yield f"switched off by {DISABLE}"
        yield from (f"  {name}" for name in registry.disabled)


def _name_origin(plugin: Plugin) -> str:
    """Return where a plugin comes from: what was installed, or its file."""
    return plugin.release or show_path(Path(plugin.module))


def schema(options: Namespace) -> int:
    """Print the schema, with the keys of all installed plugins."""
    from zlmreport.job.schema import make_job_schema  # noqa: PLC0415 - brings all keys, which a listing does not need

    print_json(make_job_schema(find_plugins(files=options.plugin)))
    return 0
