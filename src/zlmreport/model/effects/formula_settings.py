"""The job keys of an effect that is written as a formula, and the forms of it that a diagnosis tries."""

from __future__ import annotations

import re
from collections.abc import Iterator
from functools import cache
from typing import Annotated, Any, Literal

from pydantic import AfterValidator, Field, create_model

from zlmreport.job.formula_keys import FormulaKeys
from zlmreport.job.types import Options

#: Values of a key of `Instead`.
STATED, OTHER = "stated", "other"
_WHOLE_NUMBER = re.compile("-?[0-9]{1,9}")


def _require_distinct(orders: tuple[int, ...]) -> tuple[int, ...]:
    if len(set(orders)) < len(orders):
        raise ValueError("a harmonic stands there twice; each is named once, as in [1, 2]")
    return orders


_ORDERS: Any = Annotated[tuple[Annotated[int, Field(ge=1, le=4)], ...], AfterValidator(_require_distinct)]


@cache
def _made(
    usual: tuple[int, ...], chosen: tuple[tuple[str, str, tuple[str | int, ...]], ...]
) -> type[Options]:
    """Return the model of keys: of harmonics, and of choices by name, description and values."""
    fields: dict[str, Any] = {}
    if usual:
        description = "Harmonics of the period, 1 to 4: 1 is once a period."
        fields["harmonics"] = (_ORDERS, Field(usual, min_length=1, description=description))
    for name, described, values in chosen:
        fields[name] = (Literal[values], Field(values[0], description=described))
    return create_model("FormOptions", __base__=Options, **fields) if fields else Options


def make_options_of(keys: FormulaKeys) -> type[Options]:
    """Return the job keys of an effect beside its parameters, the usual form being that which names none."""
    chosen: list[tuple[str, str, tuple[str | int, ...]]] = [
        (each.name, each.description, tuple(map(_read_value, each.choices))) for each in keys.keys
    ]
    chosen.extend(
        (each.instead.key, each.instead.description, (STATED, OTHER))
        for each in keys.parameters.values()
        if each.instead
    )
    return _made(keys.harmonics.usual if keys.harmonics else (), tuple(chosen))


def list_tried_settings(keys: FormulaKeys, options: type[Options]) -> Iterator[Options]:
    """Yield the settings of the forms that a diagnosis tries: one key at a time, the others being usual."""
    if keys.harmonics:
        for orders in keys.harmonics.tried:
            yield options.model_validate({"harmonics": orders})
    else:
        yield options()
    for key in keys.keys:
        for choice in list(key.choices)[1:]:  # the first is the usual form
            yield options.model_validate({key.name: _read_value(choice)})
    for each in keys.parameters.values():
        if each.instead:
            plainest = {"harmonics": (1,)} if keys.harmonics else {}
            yield options.model_validate({**plainest, each.instead.key: OTHER})


def _read_value(text: str) -> str | int:
    """Return the value of a key as a job has it: a whole number where it is written like one."""
    return int(text) if _WHOLE_NUMBER.fullmatch(text) else text
