"""Checks what the methods of a notifier answer."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

from zlmreport.plugin.boundary import Guarded, Unacceptable
from zlmreport.plugin.boundary.answers.required import require_kind


def receiver(_notifier: Guarded, answer: Any, _options: Any) -> str:
    """Refuse a receiver that could not be named in a line."""
    text: str = require_kind(str, answer)
    if len(text.splitlines()) != 1 or not text.strip():
        raise Unacceptable("returns a receiver that is empty, or not of one line")
    return text


#: What is made of an answer, by method.
ACCEPTED: Mapping[str, Callable[..., Any]] = {
    "receiver": receiver,
}
