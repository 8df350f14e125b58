"""What is said where something is refused, and where a check fails."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from zlmreport.plugin import InputError


def refused(make: Callable[..., object], *given: Any, **stated: Any) -> InputError:
    """Return the error that tells a user of a mistake; it fails where nothing is refused."""
    with pytest.raises(InputError) as caught:
        make(*given, **stated)
    return caught.value


def refusal(make: Callable[..., object], *given: Any, **stated: Any) -> str:
    """Return what a user is told of a mistake."""
    return str(refused(make, *given, **stated))


def messages(make: Callable[..., object], *given: Any, **stated: Any) -> list[str]:
    """Return the messages on all mistakes, without their places."""
    return [each.message for each in refused(make, *given, **stated).problems]


def mistakes(folder: Path, make: Callable[..., object], *given: Any, **stated: Any) -> list[str]:
    """Return the messages on all mistakes, without their folder."""
    return [str(each).removeprefix(f"{folder}/") for each in refused(make, *given, **stated).problems]


def failure(check: Callable[..., object], *given: Any, **stated: Any) -> str:
    """Return the sentence with which a check of the kit fails."""
    with pytest.raises(AssertionError) as caught:
        check(*given, **stated)
    return str(caught.value)


def failed_checks(check: Callable[..., object], *given: Any, **stated: Any) -> list[str]:
    """Return the names of all checks that fail, in the order in which they are told."""
    return [line.partition(":")[0] for line in failure(check, *given, **stated).splitlines()]
