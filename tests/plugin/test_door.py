"""Everything that a plugin needs comes in by the doors, each for what an author builds."""

from __future__ import annotations

import ast
from importlib import import_module
from pathlib import Path
from types import ModuleType

import pytest

from zlmreport import plugin

_PLUGINS = Path(__file__).parents[2] / "plugins"
_OPEN = {"zlmreport.plugin", *(f"zlmreport.plugin.{name}" for name in plugin.DOORS)}
_HOUSE_STANDARD = sorted((_PLUGINS / "zlmreport-house-standard").rglob("*.py"))


def _imported(path: Path) -> set[str]:
    """Return the modules of zlmreport that a file imports."""
    modules: set[str] = set()
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.ImportFrom):
            modules.add(node.module or "")
        elif isinstance(node, ast.Import):
            modules.update(name.name for name in node.names)
    return {module for module in modules if module.partition(".")[0] == "zlmreport"}


_DOORS = [plugin, *(import_module(f"zlmreport.plugin.{name}") for name in plugin.DOORS)]


@pytest.mark.parametrize("door", _DOORS, ids=lambda door: door.__name__)
def test_every_name_of_a_door_leads_to_what_it_stands_for(door: ModuleType) -> None:
    assert [name for name in door.__all__ if not hasattr(door, name)] == []


def test_a_name_stands_in_one_door_only() -> None:
    names = [name for door in _DOORS for name in door.__all__]
    assert sorted(names) == sorted(set(names))


@pytest.mark.parametrize("name", ["PositionStatistics", "Effect", "compose_html", "JournalEntry", "Command"])
def test_a_name_that_has_gone_to_another_door_is_still_found(name: str) -> None:
    assert getattr(plugin, name) is next(getattr(door, name) for door in _DOORS if name in door.__all__)


def test_a_name_that_no_door_offers_is_refused() -> None:
    with pytest.raises(AttributeError, match="no attribute 'Nonesuch'"):
        _ = import_module("zlmreport.plugin").Nonesuch


@pytest.mark.parametrize("path", _HOUSE_STANDARD, ids=lambda path: path.name)
def test_the_example_of_a_third_party_imports_only_the_door_and_the_kits(path: Path) -> None:
    allowed = _OPEN | {"zlmreport.testing"} if "tests" in path.parts[-2:] else _OPEN
    assert _imported(path) <= allowed
