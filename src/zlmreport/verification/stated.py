"""What a certificate states of itself in the results file that it carries."""

from __future__ import annotations

import json
from dataclasses import dataclass, field
from typing import Any

from pydantic import BaseModel, ConfigDict, Field, ValidationError

from zlmreport.verification.carrier import Carried, Carrier

SCHEMA = "zlmreport/results/1"


class _Lenient(BaseModel):
    """Keys of a results file that are needed here; others are compared, not read."""

    model_config = ConfigDict(frozen=True, extra="ignore")


class StatedSource(_Lenient):
    """A file that the certificate was made from."""

    role: str
    name: str
    path: str
    sha256: str
    size: int


class _Certificate(_Lenient):
    number: str
    title: str = ""
    issued: str = ""


class _Provenance(_Lenient):
    generator: str
    plugins: dict[str, str]
    sources: tuple[StatedSource, ...] = Field(min_length=1)


class Results(_Lenient):
    """A results file as far as a verification needs to understand it."""

    certificate: _Certificate
    provenance: _Provenance


@dataclass(frozen=True, slots=True)
class Stated:
    """A results file.

    Attributes
    ----------
    file
        The attachment.
    tree
        All that it says.
    results
        What is understood of it.
    """

    file: Carried
    tree: dict[str, Any] = field(repr=False)
    results: Results


def stated_by(carrier: Carrier) -> Stated | None:
    """Return what the results file of a certificate states; None if it carries none that can be read.

    Raises
    ------
    ValueError
        If there is one, and it is no sound results file.
    """
    for file in carrier.carried.values():
        if file.relationship != "Data" or not file.name.endswith(".json"):
            continue
        try:
            tree = json.loads(file.content, object_pairs_hook=_without_doubles)
        except (ValueError, RecursionError) as error:
            raise ValueError(f"{file.name}: no JSON: {error}") from error
        if isinstance(tree, dict) and tree.get("schema") == SCHEMA:
            try:
                return Stated(file, tree, Results.model_validate(tree))
            except ValidationError as error:
                first = error.errors()[0]
                where = ".".join(map(str, first["loc"]))
                raise ValueError(f"{file.name}: {where}: {first['msg']}") from error
    return None


def _without_doubles(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    """Refuse a key that is there twice: one reader takes the first, and another the last."""
    found = dict(pairs)
    if len(found) != len(pairs):
        raise ValueError("a key is there twice")
    return found
