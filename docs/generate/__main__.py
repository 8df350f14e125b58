"""Writes the generated parts of the pages, and pictures of sequences.

Called as ``python docs/generate [FOLDER]``.

A part stands between two comments, ``<!-- generated: NAME -->`` and ``<!-- end: NAME -->``, in any page below
the folder (this one's parent, if none is given). What is around it is written by hand and left alone.
"""

from __future__ import annotations

import re
import sys
from collections.abc import Callable, Mapping
from pathlib import Path

import bill_of_materials
import circle_effect_pages
import command_texts
import comparison
import door
import effect_pages
import hooks
import job_keys
import least_numbers
import manual
import methods
import modules
import probing_path
import rooms
import sequences
import standard_pages

_PART = re.compile(r"(<!-- generated: (?P<name>[a-z0-9-]+) -->\n).*?(<!-- end: (?P=name) -->)", re.DOTALL)

PARTS: Mapping[str, Callable[[], str]] = {
    "catalogue-keys": job_keys.catalogue_text,
    "commands": command_texts.text,
    "comparison": comparison.text,
    "door": door.text,
    "effects": effect_pages.text,
    "extension-keys": job_keys.extensions_text,
    "fleet-keys": job_keys.fleet_text,
    "hooks": hooks.hooks_text,
    "protocols": hooks.protocols_text,
    "instrument-keys": job_keys.instruments_text,
    "job-keys": job_keys.job_text,
    "least-numbers": least_numbers.text,
    "machine-keys": job_keys.machine_text,
    "circle-effects": circle_effect_pages.text,
    "methods-drift": methods.drift_text,
    "methods-sight": methods.sight_text,
    "modules": modules.text,
    "notifier-keys": job_keys.notifiers_text,
    "probing-program-keys": job_keys.probing_programs_text,
    "program-keys": job_keys.programs_text,
    "source-keys": job_keys.sources_text,
    "standard-keys": job_keys.standards_text,
    "standards": standard_pages.text,
}


def generate(folder: Path) -> set[str]:
    """Fill the generated parts of every page below a folder; return the names of the parts that are used."""
    used: set[str] = set()

    def filled(match: re.Match[str]) -> str:
        used.add(match["name"])
        return f"{match[1]}\n{PARTS[match['name']]().strip()}\n\n{match[3]}"

    for page in sorted(folder.rglob("*.md")):
        before = page.read_text(encoding="utf-8")
        after = _PART.sub(filled, before)
        if after != before:
            page.write_text(after, encoding="utf-8")
    (folder / "reference" / "job.schema.json").write_text(job_keys.schema_text(), encoding="utf-8")
    (folder / "reference" / "zlmreport.1").write_text(manual.text(), encoding="utf-8")
    (folder / "reference" / "zlmreport.cdx.json").write_text(bill_of_materials.text(), encoding="utf-8")
    for name, picture in {**sequences.pictures(), **probing_path.pictures(), **rooms.pictures()}.items():
        (folder / "images" / name).write_text(picture, encoding="utf-8")
    return used


if __name__ == "__main__":
    generate(Path(sys.argv[1]) if len(sys.argv) > 1 else Path(__file__).parents[1])
