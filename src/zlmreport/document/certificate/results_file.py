"""Reads a certificate's results file back: no key twice, every number finite, the keys that are asked for."""

from __future__ import annotations

import json
import math
from typing import Any, Self

from pydantic import BaseModel, ConfigDict, ValidationError

from zlmreport.errors import quoted
from zlmreport.language import Language

RESULTS = "zlmreport/results/1"
#: Of a value in a message.
_LONGEST = 60
#: Of a document on a whole machine.
MACHINE_RESULTS = "zlmreport/machine-results/1"


class ResultsPart(BaseModel):
    """Keys of a results file that somebody needs; others are not looked at."""

    model_config = ConfigDict(frozen=True, extra="ignore")


class StatedCertificate(ResultsPart):
    """What a results file states of its certificate."""

    number: str
    title: str = ""
    issued: str = ""
    language: Language = Language.ENGLISH


class ResultsFile(ResultsPart):
    """A results file as far as somebody needs to understand it."""

    certificate: StatedCertificate

    @classmethod
    def of(cls, tree: Any) -> Self:
        """Return what is understood of a results file.

        Raises `ValueError` naming the first key that is missing or wrong.
        """
        try:
            return cls.model_validate(tree)
        except ValidationError as error:
            first = error.errors()[0]
            where = ".".join(map(str, first["loc"]))
            raise ValueError(f"{where}: {first['msg']}") from error


def read_results(content: bytes) -> Any:
    """Return all that a results file says.

    Raises `ValueError` if it is no JSON, has a key twice, or a number that no certificate states.
    """
    try:
        return json.loads(
            content,
            object_pairs_hook=_refuse_doubles,
            parse_float=_require_finite,
            parse_int=_read_whole,
            parse_constant=_require_finite,
        )
    except UnicodeDecodeError as error:
        raise ValueError(f"no JSON: byte {error.start + 1} is no UTF-8") from error
    except json.JSONDecodeError as error:
        raise ValueError(f"no JSON: line {error.lineno}, column {error.colno}: {error.msg}") from error
    except RecursionError as error:
        raise ValueError("no JSON: it is nested too deeply") from error


def _refuse_doubles(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    """Refuse a key that is there twice: one reader takes the first, and another the last."""
    found: dict[str, Any] = {}
    for key, value in pairs:
        if key in found:
            raise ValueError(f"{quoted(key)} is there twice, as {_show(found[key])} and as {_show(value)}")
        found[key] = value
    return found


def _show(value: Any) -> str:
    text = json.dumps(value)
    return text if len(text) <= _LONGEST else f"{text[:_LONGEST]}…"


def _require_finite(text: str) -> float:
    """Refuse what no certificate states: such a value has no difference from another, and no JSON."""
    if not math.isfinite(value := float(text)):
        raise ValueError(f"{text[:20]} is no finite number")
    return value


def _read_whole(text: str) -> int:
    _require_finite(text)
    return int(text)
