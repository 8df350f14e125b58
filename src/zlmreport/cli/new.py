"""``zlmreport new``: a plugin to begin with, with its conformance test."""

from __future__ import annotations

import re
from argparse import Namespace
from importlib.resources import files
from importlib.util import find_spec
from keyword import iskeyword
from pathlib import Path

from zlmreport.cli.terminal import show_path
from zlmreport.errors import InputError, Place, did_you_mean
from zlmreport.files import Document, write_new

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
    "quantity": "add-a-quantity.md",
}
#: The groups of entry points, where they are not those of the kind: a quantity is a standard and a source.
_GROUPS = {"program": "zlmreport.part_program", "quantity": "zlmreport"}
#: What must be installed for it, where zlmreport alone is not enough.
_NEEDED = {"instrument": "zlmreport[capture]"}
_PLACE = Place("zlmreport new")
_NAME = re.compile(r"[a-z][a-z0-9]*(-[a-z0-9]+)*")
_ADVICE = "choose another name, such as 'shop-rule'"


def run(options: Namespace) -> int:
    """Write the folder of a plugin; no file that is there already is touched."""
    kind, name = _find_kind(options.kind), _check_name(options.name)
    _refuse_taken(kind, name)
    folder, module = Path(name), _name_module(name)
    documents = make_skeleton_of(kind, name)
    further = ""
    if options.job:
        documents[f"{module}.yaml"], further = _make_from_formula(options, kind, name)
    for path in write_new([Document(folder / path, content) for path, content in documents.items()]):
        print(show_path(path))
    print(f"next: python -m pytest {show_path(folder / f'test_{module}.py')}{further}")
    return 0


def make_skeleton_of(kind: str, name: str) -> dict[str, bytes]:
    """Return the files of a plugin to begin with, by their paths in its folder."""
    words = name.replace("-", " ")
    module = _name_module(name)
    meant = {
        "kind": kind,
        "group": _name_group(kind),
        "needed": _NEEDED.get(kind, "zlmreport"),
        "guide": GUIDES[kind],
        "identifier": name,
        "module": module,
        "Class": _name_class(name),
        "words": words.capitalize(),
        "data": f', "{module}.yaml"' if kind == "effect" else "",
        "described": f"| `{module}.yaml` | what the effect is: formula, ranges, words |\n"
        * (kind == "effect"),
    }
    wanted = {f"{module}.py": f"{kind}.py", f"test_{module}.py": f"{kind}_test.py"}
    wanted |= {each: each for each in ("pyproject.toml", "README.md")}
    if kind == "effect":
        wanted[f"{module}.yaml"] = "effect.yaml"
    return {path: _fill_skeleton(skeleton, meant) for path, skeleton in wanted.items()}


def _make_from_formula(options: Namespace, kind: str, name: str) -> tuple[bytes, str]:
    """Return a formula of a job as a catalogue, and how the job names the effect then."""
    from zlmreport.job.edit import CANDIDATES, EFFECTS, list_items_written  # noqa: PLC0415 - likewise
    from zlmreport.job.effect_catalogue import write_as_catalogue, write_in_job  # noqa: PLC0415 - brings the job
    from zlmreport.job.formula_keys import FormulaKeys  # noqa: PLC0415
    from zlmreport.job.formula_parts import Formula  # noqa: PLC0415
    from zlmreport.job.loading import load  # noqa: PLC0415
    from zlmreport.job.tree import Keys  # noqa: PLC0415
    from zlmreport.plugin.registry import find_plugins  # noqa: PLC0415

    if kind != "effect":
        raise InputError.at(_PLACE, f"--from takes a formula, which is an effect and no {kind}")
    job = load(options.job, find_plugins(files=options.plugin))
    listed = zip(
        (*list_items_written(job, EFFECTS), *list_items_written(job, CANDIDATES)),
        (*job.effects, *job.candidates),
        strict=True,
    )
    choices = {choice.identifier: (node, choice) for node, choice in listed if choice.is_formula}
    if name not in choices:
        there = did_you_mean(name, list(choices)) if choices else "it writes none"
        raise InputError.at(job.place_of("model"), f"the job writes no formula {name!r}; {there}")
    node, choice = choices[name]
    keys = choice.settings
    assert isinstance(node, Keys) and isinstance(keys, FormulaKeys)  # noqa: S101, PT018  # it is a formula
    formula = Formula.of(keys, job.axis.kind)
    if "v" in formula.names:
        raise InputError.at(
            choice.place,
            f"{name}: v is the feed of a job, which no plugin is given; log it as a column of another name",
        )
    text = write_as_catalogue(node, formula, job.axis.kind)
    return text.encode(), f"\nin the job, instead of the formula: {write_in_job(formula)}"


def _find_kind(named: str) -> str:
    if named not in GUIDES:
        raise InputError.at(_PLACE, f"there is no kind {named[:60]!r}; {did_you_mean(named, list(GUIDES))}")
    return named


def _check_name(named: str) -> str:
    """Return a name that is an identifier for jobs, and with underscores a module."""
    if not _NAME.fullmatch(named):
        raise InputError.at(
            _PLACE,
            f"{named[:60]!r} is no name for a plugin; write lower-case letters and digits, joined by '-', "
            "as in 'shop-rule'",
        )
    module = _name_module(named)
    if iskeyword(module) or iskeyword(_name_class(named)):
        raise InputError.at(_PLACE, f"{named!r} is a word of Python, which no module is called; {_ADVICE}")
    there = find_spec(module)  # a folder alone has no origin; of the plugin itself, each file is told below
    if there and there.origin and Path(there.origin).parent != Path(named).resolve():
        raise InputError.at(
            _PLACE,
            f"there is a module {module!r} already, and Python would take one for the other; {_ADVICE}",
        )
    return named


def _refuse_taken(kind: str, name: str) -> None:
    """Raise `InputError` if an installed plugin is called so: no job could name one of two."""
    from zlmreport.plugin.kinds import KINDS  # noqa: PLC0415 - likewise
    from zlmreport.plugin.registry import find_plugins  # noqa: PLC0415

    registry = find_plugins()
    for each in KINDS:
        if each.group == _name_group(kind) and name in registry.list_identifiers(each):
            there = f"a plugin provides {each.label} {name!r} already, and jobs could name neither of two"
            raise InputError.at(_PLACE, f"{there}; {_ADVICE}")


def _name_group(kind: str) -> str:
    return _GROUPS.get(kind, f"zlmreport.{kind}")


def _name_module(name: str) -> str:
    return name.replace("-", "_")


def _name_class(name: str) -> str:
    return name.replace("-", " ").title().replace(" ", "")


def _fill_skeleton(skeleton: str, meant: dict[str, str]) -> bytes:
    text = files("zlmreport").joinpath("skeletons", f"{skeleton}.txt").read_text(encoding="utf-8")
    for token, meaning in meant.items():
        text = text.replace(f"{{{{{token}}}}}", meaning)
    return text.encode()
