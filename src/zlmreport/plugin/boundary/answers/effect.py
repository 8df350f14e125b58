"""Checks what the methods of an effect answer."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, Any

from zlmreport.language import Words
from zlmreport.model.effects.effect import Effect
from zlmreport.plugin.boundary import Guarded, Unacceptable
from zlmreport.plugin.boundary.answers.required import (
    accept_one_or_none,
    require_all_of,
    require_finite,
    require_kind,
    require_numbers,
)

if TYPE_CHECKING:
    from zlmreport.measurement.arrays import FloatArray
    from zlmreport.model.effects.design import Design


def columns(effect: Guarded, answer: Any, design: Design, _theta: FloatArray) -> FloatArray:
    """Refuse what is no finite column for each parameter."""
    shape = (len(design.position), len(effect.linear))
    return require_finite(answer, shape, "columns")


def grid(effect: Guarded, answer: Any, _design: Design) -> FloatArray:
    """Refuse what is no finite row for each start."""
    array = require_numbers(answer, "a grid")
    if not array.size and effect.searched:
        raise Unacceptable("gives an empty grid; the search begins with at least one row")
    rows = array.shape[0] if array.ndim else 0
    return require_finite(array, (max(rows, 1), len(effect.searched)), "a grid")


def form(effect: Guarded, answer: Any, _settings: Any) -> Effect:
    """Hand on the form of an effect, behind the boundary too."""
    return effect.guard_another(require_kind(Effect, answer))  # type: ignore[no-any-return]


def further_forms(effect: Guarded, answer: Any) -> tuple[Effect, ...]:
    """Hand on forms of an effect, if there are any, behind the boundary too."""
    return tuple(effect.guard_another(each) for each in require_all_of(Effect, answer))


def forms(effect: Guarded, answer: Any) -> tuple[Effect, ...]:
    """Hand on the forms of an effect likewise; there is one at least."""
    found = further_forms(effect, answer)
    if not found:
        raise Unacceptable("returns no form; there is one at least")
    return found


def expected(effect: Guarded, answer: Any, *_: Any) -> Mapping[str, float]:
    """Refuse values that are none, or of no parameter."""
    names = {each.name for each in (*effect.linear, *effect.searched)}
    for name, value in require_kind(Mapping, answer).items():
        if name not in names:
            raise Unacceptable(f"gives {name!r}, which is none of its parameters")
        require_finite(value, (), str(name))
    return answer  # type: ignore[no-any-return]


#: What is made of an answer, by method.
ACCEPTED: Mapping[str, Callable[..., Any]] = {
    "columns": columns,
    "grid": grid,
    "with_settings": form,
    "forms": forms,
    "further_forms": further_forms,
    "repeated": form,
    "untestable": accept_one_or_none(Words),
    "forbids": accept_one_or_none(Words),
    "expected": expected,
}
