"""Checks what the methods of a writer of part programs answer."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

from zlmreport.plugin.boundary import Guarded, Unacceptable
from zlmreport.plugin.boundary.answers.required import require_kind


def program(_program: Guarded, answer: Any, *_: Any) -> str:
    """Refuse what a control could not read."""
    text: str = require_kind(str, answer)
    if not text or not text.isascii():
        raise Unacceptable("returns a program that is empty or not plain ASCII")
    return text


#: What is made of an answer, by method.
ACCEPTED: Mapping[str, Callable[..., Any]] = {
    "write": program,
    "write_circle": program,
}
