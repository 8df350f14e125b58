"""Checks what the methods of a renderer answer."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, Any

from zlmreport.plugin.boundary import Guarded, Unacceptable
from zlmreport.plugin.boundary.answers.required import require_kind

if TYPE_CHECKING:
    from zlmreport.document.certificate.document import Certificate


def render(_renderer: Guarded, answer: Any, _certificate: Certificate) -> bytes:
    """Refuse what is no file."""
    content: bytes = require_kind(bytes, answer)
    if not content:
        raise Unacceptable("returns an empty file")
    return content


#: What is made of an answer, by method.
ACCEPTED: Mapping[str, Callable[..., Any]] = {
    "render": render,
}
