"""``zlmreport new``: a plugin to begin with, with its conformance test."""

from __future__ import annotations

import re
from argparse import Namespace
from importlib.resources import files
from pathlib import Path
from typing import TYPE_CHECKING, cast

from zlmreport.cli.terminal import shown_path
from zlmreport.errors import InputError, Place, did_you_mean
from zlmreport.files import Document, write_new

if TYPE_CHECKING:
    from zlmreport.model.formula import FormulaEffect

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
    skeleton, further = kind, ""
    if options.job:
        tokens, further = _of_formula(options, kind, name)
        skeleton, meant = "formula", meant | tokens
    module = folder / f"{meant['module']}.py"
    test = folder / f"test_{meant['module']}.py"
    documents = [
        Document(path, _filled(skeleton, meant))
        for path, skeleton in (
            (module, f"{skeleton}.py"),
            (test, f"{kind}_test.py"),
            (folder / "pyproject.toml", "pyproject.toml"),
            (folder / "README.md", "README.md"),
        )
    ]
    for path in write_new(documents):
        print(shown_path(path))
    print(f"next: python -m pytest {shown_path(test)}{further}")
    return 0


def _of_formula(options: Namespace, kind: str, name: str) -> tuple[dict[str, str], str]:
    """Return what a formula of a job fills the skeleton with, and how the job names the plugin then."""
    from zlmreport.cli.formula_source import in_job, tokens_of  # noqa: PLC0415 - brings the error model
    from zlmreport.job.loading import load  # noqa: PLC0415 - likewise
    from zlmreport.model.axis_model import chosen_effect  # noqa: PLC0415
    from zlmreport.plugins import find_plugins  # noqa: PLC0415

    if kind != "effect":
        raise InputError.at(_PLACE, f"--from takes a formula, which is an effect and no {kind}")
    registry = find_plugins(files=options.plugin)
    job = load(options.job, registry)
    choices = {each.identifier: each for each in (*job.effects, *job.candidates) if each.is_formula}
    if name not in choices:
        there = did_you_mean(name, list(choices)) if choices else "it writes none"
        raise InputError.at(job.place_of("model"), f"the job writes no formula {name!r}; {there}")
    effect = cast("FormulaEffect", chosen_effect(choices[name], registry.effect, job.axis.kind))
    if "v" in effect.formula.names:
        raise InputError.at(
            choices[name].place,
            f"{name}: v is the feed of a job, which no plugin is given; log it as a column of another name",
        )
    return tokens_of(effect, job.axis.kind), f"\nin the job, instead of the formula: {in_job(effect)}"


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
