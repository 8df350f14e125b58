"""``zlmreport new``: a plugin to begin with, with its conformance test."""

from __future__ import annotations

import re
from argparse import Namespace
from importlib.resources import files
from pathlib import Path

from zlmreport.cli.terminal import shown_path
from zlmreport.errors import InputError, Place, did_you_mean
from zlmreport.files import Document, demand_free, write

#: What can be begun, and the guide that goes on from there.
GUIDES = {
    "standard": "add-a-standard.md",
    "source": "write-a-data-source.md",
    "renderer": "write-a-renderer.md",
    "effect": "add-an-effect.md",
    "instrument": "write-an-instrument.md",
    "program": "write-a-part-program.md",
    "controller": "compensate-an-axis.md",
    "notifier": "run-a-fleet.md",
}
_PLACE = Place("zlmreport new")
_NAME = re.compile(r"[a-z][a-z0-9]*(-[a-z0-9]+)*")


def run(options: Namespace) -> int:
    """Write the folder of a plugin; no file that is there already is touched."""
    kind, name = _kind(options.kind), _name(options.name)
    folder = Path(name)
    words = name.replace("-", " ")
    meant = {
        "kind": kind,
        "guide": GUIDES[kind],
        "identifier": name,
        "module": name.replace("-", "_"),
        "Class": words.title().replace(" ", ""),
        "words": words.capitalize(),
    }
    module = folder / f"{meant['module']}.py"
    test = folder / f"test_{meant['module']}.py"
    documents = [
        Document(path, _filled(skeleton, meant))
        for path, skeleton in (
            (module, f"{kind}.py"),
            (test, f"{kind}_test.py"),
            (folder / "pyproject.toml", "pyproject.toml"),
            (folder / "README.md", "README.md"),
        )
    ]
    demand_free(document.path for document in documents)
    for path in write(documents):
        print(shown_path(path))
    print(f"next: python -m pytest {shown_path(test)}")
    return 0


def _kind(named: str) -> str:
    if named not in GUIDES:
        raise InputError.at(_PLACE, f"there is no kind {named[:60]!r}; {did_you_mean(named, list(GUIDES))}")
    return named


def _name(named: str) -> str:
    """Return a name that is an identifier for jobs, and with underscores a module."""
    if not _NAME.fullmatch(named):
        raise InputError.at(
            _PLACE,
            f"{named[:60]!r} is no name for a plugin; write lower-case letters and digits, joined by '-', "
            "as in 'shop-rule'",
        )
    return named


def _filled(skeleton: str, meant: dict[str, str]) -> bytes:
    text = files("zlmreport").joinpath("skeletons", f"{skeleton}.txt").read_text(encoding="utf-8")
    for token, meaning in meant.items():
        text = text.replace(f"{{{{{token}}}}}", meaning)
    return text.encode()
