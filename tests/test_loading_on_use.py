"""A plugin is loaded when it is asked for; what installed ones offer, their entry points say."""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Callable
from importlib import import_module
from importlib.metadata import distribution
from pathlib import Path
from typing import Any

import pytest

from zlmreport.plugin import InputError
from zlmreport.plugin.kinds import EFFECT, KINDS, SOURCE
from zlmreport.plugin.registry import find_plugins

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
    """Return a function that installs a distribution with one plugin, by the entry points that are given."""
    folder = tmp_path / "site"
    folder.mkdir()
    monkeypatch.syspath_prepend(str(folder))

    def installed(code: str, entries: str = "[zlmreport.effect]\nmy-effect = zlm_mine\n") -> Path:
        module = folder / "zlm_mine.py"
        module.write_text(code, encoding="utf-8")
        metadata = folder / "zlm_mine-3.0.dist-info"
        metadata.mkdir(exist_ok=True)
        (metadata / "METADATA").write_text("Metadata-Version: 2.1\nName: zlm-mine\nVersion: 3.0\n")
        (metadata / "entry_points.txt").write_text(entries)
        monkeypatch.delitem(sys.modules, "zlm_mine", raising=False)
        return module

    return installed


def test_every_object_of_a_built_in_plugin_has_an_entry_point_of_its_own() -> None:
    """What a hook returns beyond what entry points name would be found by nobody."""
    named = {
        (kind.name, point.name): point
        for kind in KINDS
        for point in distribution("zlmreport").entry_points.select(group=kind.group)
    }
    modules = {point.module for point in named.values()}
    offered = {
        (kind.name, each.identifier)
        for module in map(import_module, modules)
        for kind in KINDS
        for each in (getattr(module, kind.hook)() if hasattr(module, kind.hook) else ())
    }
    assert offered == named.keys()


def test_the_built_in_plugins_offer_what_their_entry_points_name() -> None:
    registry = find_plugins({})
    assert registry.list_offers()
    assert registry.failed == ()


def test_what_an_entry_point_names_is_known_before_it_is_loaded(install: Any) -> None:
    install(_BROKEN)
    assert "my-effect" in find_plugins({}).list_identifiers(EFFECT)
    assert "zlm_mine" not in sys.modules


def test_a_plugin_that_breaks_is_told_of_to_who_needs_it(install: Any) -> None:
    install(_BROKEN)
    with pytest.raises(InputError, match=r"no plugin provides effect 'my-effect'(.|\n)*ZeroDivisionError"):
        find_plugins({}).effect("my-effect")


def test_an_entry_point_that_names_what_its_module_does_not_offer_is_told(install: Any) -> None:
    install(_EFFECT, "[zlmreport.effect]\nmy-efect = zlm_mine\n")
    registry = find_plugins({})
    registry.list_offers()
    (failed,) = registry.failed
    assert failed.reason == (
        "its entry point names effect 'my-efect', and zlmreport_effects offers none of that name; "
        "did you mean 'my-effect'? (known: my-effect)"
    )


def test_a_module_without_an_entry_point_for_each_object_is_loaded_to_know_what_it_offers(
    install: Any,
) -> None:
    install(_EFFECT, "[zlmreport]\nmine = zlm_mine\n")
    assert find_plugins({}).effect("my-effect").identifier == "my-effect"


def test_one_object_of_a_module_that_breaks_another_is_found_all_the_same(install: Any) -> None:
    broken = "    return [Mine(), 5]"
    install(_EFFECT.replace("    return [Mine()]", broken))
    assert find_plugins({}).effect("my-effect").identifier == "my-effect"


def test_an_unknown_name_loads_no_plugin() -> None:
    code = (
        "import sys\n"
        "from zlmreport.errors import InputError\n"
        "from zlmreport.plugin.registry import find_plugins\n"
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
        "",
    ]


def test_what_is_asked_for_is_loaded_alone() -> None:
    code = (
        "import sys\n"
        "from zlmreport.plugin.kinds import SOURCE\n"
        "from zlmreport.plugin.registry import find_plugins\n"
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
