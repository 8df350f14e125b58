"""Complete documents for the tests of their sections: a job with everything in it, and real readings."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import yaml

from installed import registry
from zlmreport import pipeline
from zlmreport.job.loading import load
from zlmreport.language.formatting import write_plain
from zlmreport.plugin.extension import Job
from zlmreport.plugin.renderer import (
    Block,
    Cell,
    Certificate,
    Facts,
    Formulas,
    Graph,
    Notice,
    Paragraph,
    Symbol,
    Table,
    Verdict,
)

ROOT = Path(__file__).parents[3]

#: What a document says does not depend on their number, but for digits of U and verdicts near a limit.
FEW_TRIALS = 100

#: What a test of 40 mm at 20 °C may neglect.
NEGLIGIBLE = (
    "misalignment",
    "machine_temperature",
    "device_temperature",
    "expansion_coefficient",
    "device_expansion_coefficient",
    "environmental_variation",
)
COMPLETE: Mapping[str, Any] = {
    "schema": "zlmreport/job/1",
    "certificate": {
        "number": "CAL-1",
        "issued": "2022-04-20",
        "authorised_by": {"name": "A. Person", "function": "Head"},
    },
    "laboratory": {"name": "Some Laboratory", "address": "Street 1, 12345 Town"},
    "customer": {"name": "A Customer", "address": "Lane 2, 54321 Village"},
    "machine": {"manufacturer": "Maker", "model": "M1", "serial": "S-1"},
    "location": {"kind": "customer"},
    "axis": {"name": "Y", "travel": [-20, 20]},
    "measurement": {
        "date": "2022-04-07",
        "source": {"plugin": "laser-csv", "file": str(ROOT / "configs" / "linear-axis" / "y-axis.csv")},
    },
    "instrument": {"name": "Sensor", "certificate": "C-1", "expanded_uncertainty": 2},
    "environment": {"air_temperature": 20.5, "axis_temperature": 20},
    "uncertainty": {"negligible": dict.fromkeys(NEGLIGIBLE, "40 mm at 20 °C")},
    "evaluate": [{"standard": "iso230-2:2014", "tolerances": {"A": 150, "E": 100}}],
}
#: Standards in seven editions, the first with limits.
SEVEN = (
    {"standard": "iso230-2:2014", "tolerances": {"A": 150, "E": 100}},
    "iso230-2:2006",
    "iso230-2:1997",
    "iso230-2:1988",
    "vdi-dgq-3441",
    "vdi-vde-2617",
    "nmtba",
)


def job(folder: Path, keys: Mapping[str, Any] = COMPLETE) -> Job:
    """Write the keys as a job file and load it."""
    path = folder / "job.yaml"
    path.write_text(yaml.safe_dump(dict(keys), sort_keys=False), encoding="utf-8")
    return load(path, registry())


def certificate(folder: Path, keys: Mapping[str, Any] = COMPLETE, trials: int = FEW_TRIALS) -> Certificate:
    """Return the document that a job with these keys composes; few tests are simulated for its U."""
    return pipeline.compose(job(folder, keys), registry(), trials=trials)


def without(*dotted: str, keys: Mapping[str, Any] = COMPLETE) -> dict[str, Any]:
    """Return keys without some of them: ``machine.serial``, ``customer``."""
    left = dict(keys)
    for each in dotted:
        group, _, inner = each.partition(".")
        if inner:
            left[group] = without(inner, keys=left[group])
        else:
            left.pop(group, None)
    return left


def having(dotted: str, value: Any, keys: Mapping[str, Any] = COMPLETE) -> dict[str, Any]:
    """Return keys with one more, or with another value for one: ``machine.serial``."""
    group, _, inner = dotted.partition(".")
    return {**keys, group: having(inner, value, keys.get(group, {})) if inner else value}


def text_of(document: Certificate) -> str:
    """Return a document as plain lines, block by block, as a reader would read it aloud."""
    lines = [document.title, document.subtitle, document.number, ""]
    lines.extend(line for block in document.cover for line in lines_of(block))
    for section in document.sections:
        lines.extend(["", f"# {section.title}"])
        lines.extend(line for block in section.blocks for line in lines_of(block))
    return "\n".join(lines) + "\n"


def lines_of(block: Block) -> list[str]:
    """Return a block as plain lines."""
    match block:
        case Paragraph(text):
            return [text]
        case Facts(pairs, heading):
            return [heading, *(f"  {name}: {value}" for name, value in pairs)]
        case Notice(heading, items):
            return [f"! {heading}", *(f"  - {item}" for item in items)]
        case Formulas(caption, rows):
            return [
                caption,
                *(f"  {write_plain(s.notation)} = {write_plain(f.notation)} ({name})" for s, f, name in rows),
            ]
        case Table(caption, columns, groups):
            head = " | ".join(_cell(column.heading) + f" {column.unit}".rstrip() for column in columns)
            rows = [
                line
                for group in groups
                for line in (
                    *([f"  [{group.heading}] {group.note}".rstrip()] if group.heading else []),
                    *("  " + " | ".join(map(_cell, row)) for row in group.rows),
                )
            ]
            return [caption, f"  {head}", *rows]
        case Graph(figure):
            return [f"({figure.key})"]
        case _:
            raise AssertionError(block)


def _cell(cell: Cell) -> str:
    match cell:
        case Symbol(notation):
            return write_plain(notation)
        case Verdict(_, word):
            return word
        case _:
            return str(cell)
