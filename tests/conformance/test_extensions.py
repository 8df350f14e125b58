"""Every installed extension does what the kit asks; one that sins is told."""

from __future__ import annotations

from collections.abc import Callable
from types import MappingProxyType
from typing import Any

import pytest

from zlmreport.plugin import Options, Words
from zlmreport.plugin.extension import Command, CommandOption, Extension
from zlmreport.plugin.registry import find_plugins
from zlmreport.testing import EXTENSION_CHECKS, check_extension, extensions as kit


@pytest.mark.parametrize("extension", find_plugins().extensions, ids=lambda each: each.identifier)
@pytest.mark.parametrize("check", EXTENSION_CHECKS)
def test_conforms(check: Callable[..., None], extension: Extension) -> None:
    check(extension)


UNDESCRIBED = CommandOption("x", "X", "", str)


class Tracer(Extension):
    """A group without keys."""

    identifier = "tracer"
    title = Words(en="Tracer", de="Laser-Tracer")
    description = "A tracer."
    example = MappingProxyType({})
    options = Options


@pytest.mark.parametrize(
    ("check", "sin", "message"),
    [
        (kit.is_named, {"identifier": "My-Tracer"}, "the identifier is a job key"),
        (kit.is_named, {"identifier": "axis"}, "the job has this key itself"),
        (kit.keys_are_described, {"example": {"speed": 3}}, "unknown keys speed"),
        (kit.lists_part_programs_where_it_says, {"programs": ("path",)}, "is no list of part programs"),
        (
            kit.commands_are_described,
            {"commands": (Command("trace", "Trace.", "", (UNDESCRIBED,), lambda *_: 0),)},
            "--x has no help",
        ),
    ],
)
def test_a_sin_is_told(check: Callable[..., None], sin: dict[str, Any], message: str) -> None:
    check_extension(Tracer())
    sinner = type("Sinner", (Tracer,), sin)()
    with pytest.raises(AssertionError, match=message):
        check(sinner)
