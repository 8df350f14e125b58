"""Checks what the methods of a live instrument answer."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

from zlmreport.plugin.boundary import Guarded, Unacceptable
from zlmreport.plugin.boundary.answers.required import name_answer


def opened(instrument: Guarded, answer: Any, _options: Any) -> Any:
    """Hand on an open instrument, behind the boundary too."""
    lacking = [name for name in ("__enter__", "__exit__", "readings", "zero") if not hasattr(answer, name)]
    if lacking:
        raise Unacceptable(f"returns {name_answer(answer)} without {', '.join(lacking)}; see Connection")
    return instrument.guard_connection(answer)


#: What is made of an answer, by method.
ACCEPTED: Mapping[str, Callable[..., Any]] = {
    "open": opened,
}
