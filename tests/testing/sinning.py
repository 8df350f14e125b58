"""What is asked of every kit: its exemplary plugin passes, each check finds its sins, and none has no sin."""

from __future__ import annotations

from collections.abc import Callable, Collection, Sequence
from pathlib import Path
from typing import Any

import pytest

from refusals import failure

Check = Callable[..., None]


def make_sinner(sound: type, sin: dict[str, Any]) -> Any:
    """Return a plugin that does everything right but for what a sin changes."""
    return type("Sinner", (sound,), dict(sin))()


def make_tests(
    checks: Sequence[Check],
    sound: type,
    sins: Sequence[tuple[Check, dict[str, Any], str]],
    given: Callable[[Any, Path], tuple[Any, ...]],
    beside: Collection[Check] = (),
) -> tuple[Callable[..., None], Callable[..., None], Callable[[], None]]:
    """Return three tests of a kit: the sound plugin passes, each sin is named, every check has one.

    `given`: With what a check is called beside the plugin; from it and an empty folder.
    `beside`: Checks whose sin has a test of its own.
    """

    def name(value: object) -> str | None:
        return getattr(value, "__name__", None)

    @pytest.mark.parametrize("check", checks, ids=name)
    def passes(check: Check, tmp_path: Path) -> None:
        plugin = sound()
        check(plugin, *given(plugin, tmp_path))

    @pytest.mark.parametrize(("check", "sin", "sentence"), sins, ids=name)
    def finds_its_sin(check: Check, sin: dict[str, Any], sentence: str, tmp_path: Path) -> None:
        sinner = make_sinner(sound, sin)
        said = failure(check, sinner, *given(sinner, tmp_path))
        assert sentence in said, said

    def has_a_sin() -> None:
        without = set(checks) - {check for check, *_ in sins} - set(beside)
        assert not without, without

    return passes, finds_its_sin, has_a_sin
