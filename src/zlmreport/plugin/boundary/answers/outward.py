"""Checks what the methods of renderers, part programs, notifiers and live instruments answer."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, Any

from zlmreport.plugin.boundary import Guarded, Unacceptable
from zlmreport.plugin.boundary.answers.required import name_answer, require_kind

if TYPE_CHECKING:
    from zlmreport.document.certificate.document import Certificate


def render(_renderer: Guarded, answer: Any, _certificate: Certificate) -> bytes:
    """Refuse what is no file."""
    content: bytes = require_kind(bytes, answer)
    if not content:
        raise Unacceptable("returns an empty file")
    return content


def program(_program: Guarded, answer: Any, *_: Any) -> str:
    """Refuse what a control could not read."""
    text: str = require_kind(str, answer)
    if not text or not text.isascii():
        raise Unacceptable("returns a program that is empty or not plain ASCII")
    return text


def receiver(_notifier: Guarded, answer: Any, _options: Any) -> str:
    """Refuse a receiver that could not be named in a line."""
    text: str = require_kind(str, answer)
    if len(text.splitlines()) != 1 or not text.strip():
        raise Unacceptable("returns a receiver that is empty, or not of one line")
    return text


def opened(instrument: Guarded, answer: Any, _options: Any) -> Any:
    """Hand on an open instrument, behind the boundary too."""
    lacking = [name for name in ("__enter__", "__exit__", "readings", "zero") if not hasattr(answer, name)]
    if lacking:
        raise Unacceptable(f"returns {name_answer(answer)} without {', '.join(lacking)}; see Connection")
    return instrument.guard_connection(answer)


#: What is made of an answer, by method; no two of these kinds have one of the same name.
ACCEPTED: Mapping[str, Callable[..., Any]] = {
    "render": render,
    "write": program,
    "write_circle": program,
    "receiver": receiver,
    "open": opened,
}
