"""The kits find the mistakes of authors: each is planted into a skeleton, whose own test names it."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from functools import cache
from importlib import import_module
from pathlib import Path

import pytest

from environments import imported_from
from refusals import failure
from testing.planted import PLANTED, Changes, Planted
from zlmreport.cli.new import make_skeleton_of

#: Where the kit of a kind has its checks.
_KITS = {
    "standard": ("standards", "STANDARD_CHECKS"),
    "effect": ("effects", "EFFECT_CHECKS"),
    "source": ("sources", "SOURCE_CHECKS"),
    "notifier": ("notifiers", "NOTIFIER_CHECKS"),
    "controller": ("controllers", "CONTROLLER_CHECKS"),
    "renderer": ("renderers", "RENDERER_CHECKS"),
    "instrument": ("instruments", "INSTRUMENT_CHECKS"),
    "program": ("part_programs", "PART_PROGRAM_CHECKS"),
}


@cache
def _skeleton(kind: str) -> dict[str, str]:
    return {path: content.decode() for path, content in make_skeleton_of(kind, "my-plugin").items()}


def _changed(text: str, changes: Changes) -> str:
    for old, new in changes:
        assert old in text, f"the skeleton has no {old!r}"
        text = text.replace(old, new)
    return text


@pytest.fixture
def test_of(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> Iterator[Callable[[Planted], Callable[..., None]]]:
    """Return a function that gives the test of a skeleton with a mistake; the named check runs alone."""

    def build(planted: Planted) -> Callable[..., None]:
        files = _skeleton(planted.kind)
        for name, changes in (
            ("my_plugin.py", planted.module),
            ("test_my_plugin.py", planted.test),
            ("my_plugin.yaml", planted.data),
        ):
            if name in files:
                (tmp_path / name).write_text(_changed(files[name], changes), encoding="utf-8")
        kit, checks = _KITS[planted.kind]
        module = import_module(f"zlmreport.testing.{kit}")
        named = [check for check in getattr(module, checks) if check.__name__ == planted.check]
        assert named, f"the kit of a {planted.kind} has no check {planted.check}"
        monkeypatch.setattr(module, checks, tuple(named))
        imported_from("my_plugin", tmp_path)
        found: Callable[..., None] = imported_from("test_my_plugin", tmp_path).test_conforms
        return found

    yield build
    for name in ("my_plugin", "test_my_plugin"):
        sys.modules.pop(name, None)


@pytest.mark.parametrize("planted", PLANTED, ids=str)
def test_a_planted_mistake_is_named(
    planted: Planted, test_of: Callable[[Planted], Callable[..., None]], tmp_path: Path
) -> None:
    test_conforms = test_of(planted)
    takes_folder = planted.kind in {"source", "notifier"}
    assert planted.sentence in failure(test_conforms, *([tmp_path] if takes_folder else []))
