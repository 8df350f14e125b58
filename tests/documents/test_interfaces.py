"""Every hook, protocol member and exit code that the program has stands in the reference, and no other."""

from __future__ import annotations

import inspect
import re
from importlib import import_module
from pathlib import Path

import pytest

from documents.pages import DOCS
from zlmreport import errors, plugin
from zlmreport.plugin.instrument import Emulator, LiveReading
from zlmreport.plugin.kinds import KINDS
from zlmreport.plugin.protocols import Connection, SourceContext

_PAGE = (DOCS / "reference" / "plugin-interfaces.md").read_text(encoding="utf-8")
#: Guides to writing a plugin.
_GUIDES = sorted([*(DOCS / "how-to").glob("write-a*-*.md"), *(DOCS / "how-to").glob("add-a*-*.md")])
_GUIDES = [
    guide
    for guide in _GUIDES
    if guide.stem
    not in {"write-a-digital-certificate", "write-a-probing-program"}  # no plugin; of the step gauge
]
_DOORS = [plugin, *(import_module(f"zlmreport.plugin.{name}") for name in plugin.DOORS)]
_LIVE_HOOKS = [kind.hook for kind in KINDS]
_MEMBERS = [
    f"{protocol.__name__}.{member}"
    for protocol in (*(kind.protocol for kind in KINDS), SourceContext, Connection, LiveReading, Emulator)
    for member in (
        *protocol.__annotations__,
        *(name for name in vars(protocol) if inspect.isfunction(vars(protocol)[name])),
    )
    if not member.startswith("_")
]


def _section(heading: str) -> str:
    return _PAGE.partition(f"### {heading}\n")[2].partition("\n### ")[0].partition("\n## ")[0]


@pytest.mark.parametrize("hook", _LIVE_HOOKS)
def test_a_live_hook_is_documented(hook: str) -> None:
    assert f"`{hook}(" in _PAGE


def test_no_hook_is_documented_that_does_not_live() -> None:
    assert set(re.findall(r"`(zlmreport_[a-z_]+)\(", _PAGE)) == set(_LIVE_HOOKS)


@pytest.mark.parametrize("member", _MEMBERS)
def test_a_member_of_a_protocol_is_documented(member: str) -> None:
    protocol, _, name = member.partition(".")
    assert re.search(rf"^\| `{name}[:(]", _section(protocol), re.MULTILINE)


def test_the_page_lists_the_names_of_the_door_and_no_others() -> None:
    listed = re.findall(
        r"^\| `(\w+)(?:\([^`]*\))?` \| \S", _PAGE.partition("\n## The door\n")[2], re.MULTILINE
    )
    offered = [name for door in _DOORS for name in door.__all__]
    assert sorted({*listed, "DOORS"} - {name for name in listed if name.startswith("check_")}) == sorted(
        offered
    )


@pytest.mark.parametrize("guide", _GUIDES, ids=lambda guide: guide.stem)
def test_a_plugin_that_follows_the_guide_imports_only_the_door(guide: Path) -> None:
    imported = re.findall(
        r"^[+ ]?from (zlmreport(?:\.\w+)*) import", guide.read_text(encoding="utf-8"), re.MULTILINE
    )
    assert imported
    assert set(imported) <= {"zlmreport.testing", *(door.__name__ for door in _DOORS)}


def test_every_exit_code_of_an_error_is_documented() -> None:
    page = (DOCS / "reference" / "exit-codes.md").read_text(encoding="utf-8")
    documented = {int(code) for code in re.findall(r"^\| (\d) \|", page, re.MULTILINE)}
    raised = {
        error.exit_code
        for _, error in inspect.getmembers(errors, inspect.isclass)
        if issubclass(error, errors.ZlmreportError)
    }
    assert raised <= documented
