"""Questions to an attocube IDS3010 and its answers: JSON-RPC 2.0 without an end to a message.

Source: attocube's published programming interfaces (IDS-APIs). The first element of a result is the number
of a warning; positions are in picometres.
"""

from __future__ import annotations

import json
from dataclasses import dataclass
from typing import Any

_API = 2
_METHOD_NOT_FOUND = -32_601


@dataclass(frozen=True, slots=True)
class Answer:
    """What an IDS answers.

    Attributes
    ----------
    number
        Of the question.
    warning
        Of the device; 0 for none.
    values
        What was asked for.
    error
        Text of an error; empty if there is none.
    is_unknown
        Whether the error is that there is no such method.
    """

    number: int
    warning: int = 0
    values: tuple[Any, ...] = ()
    error: str = ""
    is_unknown: bool = False


def question(number: int, method: str, *parameters: int) -> bytes:
    """Return the bytes of a question."""
    message = {"jsonrpc": "2.0", "method": method, "params": parameters, "id": number, "api": _API}
    return json.dumps(message, separators=(",", ":")).encode("ascii")


def answer_to(number: int, arrived: bytes) -> Answer | None:
    """Return the answer to a question in what has arrived; None if it is not there, or not whole.

    Answers to earlier questions, which came too late, are passed over.
    """
    decoder = json.JSONDecoder()
    text = arrived.decode("utf-8", "replace").lstrip()
    while text:
        try:
            message, end = decoder.raw_decode(text)
        except ValueError:
            return None
        found = _answer(message)
        if found is not None and found.number == number:
            return found
        text = text[end:].lstrip()
    return None


def _answer(message: Any) -> Answer | None:
    """Return a message as an answer; None if it is none."""
    if not isinstance(message, dict) or not isinstance(message.get("id"), int):
        return None
    number = message["id"]
    error = message.get("error")
    if isinstance(error, dict):
        is_unknown = error.get("code") == _METHOD_NOT_FOUND
        return Answer(number, error=str(error.get("message", "error")), is_unknown=is_unknown)
    result = message.get("result")
    if not isinstance(result, list) or not result or not isinstance(result[0], int):
        return None
    return Answer(number, result[0], tuple(result[1:]))
