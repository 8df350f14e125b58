"""A plugin is loaded when it is asked for; what installed ones offer is known, or remembered."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from collections.abc import Callable
from importlib import import_module
from importlib.metadata import distribution
from pathlib import Path
from typing import Any

import pytest

from zlmreport.errors import InputError
from zlmreport.plugin.kinds import EFFECT, KINDS, SOURCE
from zlmreport.plugins import find_plugins

_EFFECT = """\
from testing.exemplary_effect import ExemplaryEffect
from zlmreport.plugin import hookimpl

class Mine(ExemplaryEffect):
    identifier = "my-effect"

@hookimpl
def zlmreport_effects():
    return [Mine()]
"""
_BROKEN = "1 / 0\n"


@pytest.fixture
def install(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Callable[..., Path]:
    """Return a function that installs a distribution with one plugin, and what it declares to offer."""
    folder = tmp_path / "site"
    folder.mkdir()
    monkeypatch.syspath_prepend(str(folder))

    def installed(code: str, declared: Any = None) -> Path:
        module = folder / "zlm_mine.py"
        module.write_text(code, encoding="utf-8")
        metadata = folder / "zlm_mine-3.0.dist-info"
        metadata.mkdir(exist_ok=True)
        (metadata / "METADATA").write_text("Metadata-Version: 2.1\nName: zlm-mine\nVersion: 3.0\n")
        entries = "[zlmreport]\nmine = zlm_mine\n"
        if declared is not None:
            (folder / "zlm_declared.py").write_text(f"OFFERS = {declared!r}\n", encoding="utf-8")
            entries += "[zlmreport.offers]\nmine = zlm_declared:OFFERS\n"
        (metadata / "entry_points.txt").write_text(entries)
        for name in ("zlm_mine", "zlm_declared"):
            monkeypatch.delitem(sys.modules, name, raising=False)
        return module

    return installed


@pytest.fixture
def cache(tmp_path: Path) -> dict[str, str]:
    """The environment of a user whose cache folder is empty."""
    return {"XDG_CACHE_HOME": str(tmp_path / "cache")}


def _remembered(environment: dict[str, str]) -> list[Any]:
    path = Path(environment["XDG_CACHE_HOME"]) / "zlmreport" / "plugins.json"
    return list(json.loads(path.read_text(encoding="utf-8")).values()) if path.exists() else []


def test_the_built_in_plugins_offer_what_is_declared_and_nothing_else() -> None:
    registry = find_plugins({})
    assert registry.offers()
    assert registry.failed == ()


def test_every_built_in_plugin_declares_what_it_offers() -> None:
    points = [point for point in distribution("zlmreport").entry_points if point.group == "zlmreport"]
    declarations = [
        point for point in distribution("zlmreport").entry_points if point.group == "zlmreport.offers"
    ]
    declared = {name for point in declarations for name in point.load()}
    assert {point.name for point in points} == declared


def test_a_plugin_that_declares_its_offers_is_not_loaded_to_know_them(install: Any) -> None:
    install(_BROKEN, {"mine": {"effect": ["my-effect"]}})
    assert "my-effect" in find_plugins({}).identifiers(EFFECT)
    assert "zlm_mine" not in sys.modules


def test_a_declared_plugin_that_breaks_is_told_of_to_who_needs_it(install: Any) -> None:
    install(_BROKEN, {"mine": {"effect": ["my-effect"]}})
    with pytest.raises(InputError, match=r"no plugin provides effect 'my-effect'(.|\n)*ZeroDivisionError"):
        find_plugins({}).effect("my-effect")


def test_a_plugin_that_offers_other_things_than_declared_is_refused(install: Any) -> None:
    install(_EFFECT, {"mine": {"effect": ["my-efect"]}})
    registry = find_plugins({})
    registry.offers()
    assert [each.reason for each in registry.failed] == [
        "offers other things than its distribution declares: effect 'my-efect', effect 'my-effect'"
    ]


def test_a_declaration_that_is_none_leaves_the_word_to_the_plugin(install: Any) -> None:
    install(_EFFECT, ["my-effect"])
    assert find_plugins({}).effect("my-effect").identifier == "my-effect"


def test_what_an_installed_plugin_offers_is_remembered(install: Any, cache: dict[str, str]) -> None:
    install(_EFFECT)
    find_plugins(cache)
    assert _remembered(cache) == [[["effect", "my-effect"]]]
    del sys.modules["zlm_mine"]
    assert "my-effect" in find_plugins(cache).identifiers(EFFECT)
    assert "zlm_mine" not in sys.modules


def test_a_changed_file_of_it_is_looked_at_again(install: Any, cache: dict[str, str]) -> None:
    install(_EFFECT)
    find_plugins(cache)
    install(_EFFECT.replace("my-effect", "my-other-effect"))
    assert find_plugins(cache).effect("my-other-effect").identifier == "my-other-effect"


def test_a_plugin_that_fails_is_not_remembered(install: Any, cache: dict[str, str]) -> None:
    install(_BROKEN)
    find_plugins(cache)
    assert _remembered(cache) == []


def test_an_editable_installation_is_not_remembered(
    install: Any, cache: dict[str, str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    module = install(_EFFECT)
    sources = tmp_path / "sources"
    sources.mkdir()
    module.rename(sources / module.name)
    monkeypatch.syspath_prepend(str(sources))
    assert find_plugins(cache).effect("my-effect").identifier == "my-effect"
    assert _remembered(cache) == []


def test_a_file_of_ones_own_is_not_remembered(tmp_path: Path, cache: dict[str, str]) -> None:
    path = tmp_path / "mine.py"
    path.write_text(_EFFECT, encoding="utf-8")
    find_plugins(cache, [path])
    assert _remembered(cache) == []


@pytest.mark.parametrize("content", ["", "[]", '{"a": 5}', '{"a": [["effect"]]}', "\x00"])
def test_a_memory_that_was_spoilt_is_not_used(content: str, install: Any, cache: dict[str, str]) -> None:
    install(_EFFECT)
    path = Path(cache["XDG_CACHE_HOME"]) / "zlmreport" / "plugins.json"
    path.parent.mkdir(parents=True)
    path.write_text(content, encoding="utf-8")
    assert find_plugins(cache).effect("my-effect").identifier == "my-effect"


def test_a_memory_that_cannot_be_written_is_not_used(install: Any, tmp_path: Path) -> None:
    install(_EFFECT)
    (tmp_path / "file").write_text("", encoding="utf-8")
    registry = find_plugins({"XDG_CACHE_HOME": str(tmp_path / "file")})
    assert registry.effect("my-effect").identifier == "my-effect"


def test_an_unknown_name_loads_no_plugin() -> None:
    code = (
        "import sys\n"
        "from zlmreport.errors import InputError\n"
        "from zlmreport.plugins import find_plugins\n"
        "try:\n"
        "    find_plugins({}).source('laser-csw')\n"
        "except InputError as error:\n"
        "    print(str(error).partition(' (')[0])\n"
        "print(*(name for name in sys.modules if name.startswith('zlmreport_plugins')))\n"
    )
    said = subprocess.run(
        [sys.executable, "-c", code], env=os.environ, capture_output=True, text=True, check=True
    )
    assert said.stdout.splitlines() == [
        "zlmreport: no plugin provides data source 'laser-csw'; did you mean 'laser-csv'?",
        "zlmreport_plugins",
    ]


def test_what_is_asked_for_is_loaded_alone() -> None:
    code = (
        "import sys\n"
        "from zlmreport.plugin.kinds import SOURCE\n"
        "from zlmreport.plugins import find_plugins\n"
        "find_plugins({}).find(SOURCE, 'ecmc')\n"
        "loaded = [name.split('.') for name in sys.modules if name.startswith('zlmreport_plugins.')]\n"
        "print(*sorted({'.'.join(parts[:3]) for parts in loaded}))\n"
    )
    said = subprocess.run(
        [sys.executable, "-c", code], env=os.environ, capture_output=True, text=True, check=True
    )
    assert said.stdout.split() == ["zlmreport_plugins.sources", "zlmreport_plugins.sources.ecmc"]


@pytest.mark.parametrize("kind", KINDS, ids=str)
def test_every_kind_is_declared_whole(kind: Any) -> None:
    assert {"identifier", "title"} <= set(kind.members)
    assert callable(getattr(import_module("zlmreport.testing"), f"check_{kind.name}"))
    assert kind is not SOURCE or "read" in kind.members
