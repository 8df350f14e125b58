"""Each check of an extension finds the sin it is there for."""

from __future__ import annotations

from collections.abc import Callable
from types import MappingProxyType
from typing import Any

import pytest

from refusals import failure
from zlmreport.plugin import Options, Words
from zlmreport.plugin.extension import Command, CommandOption, Extension
from zlmreport.testing import check_extension, extensions as kit

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
    assert message in failure(check, sinner)
