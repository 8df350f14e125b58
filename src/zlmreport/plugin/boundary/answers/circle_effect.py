"""Checks what the methods of an effect on a circle answer."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np

from zlmreport.language import Words
from zlmreport.model.effects.circle_effect import CircleTerm
from zlmreport.plugin.boundary import Guarded
from zlmreport.plugin.boundary.answers.required import accept_all_of, require_all_of, require_finite

if TYPE_CHECKING:
    from zlmreport.model.effects.circle_design import CircleDesign


def terms(_effect: Guarded, answer: Any, design: CircleDesign, _searched: Any) -> tuple[CircleTerm, ...]:
    """Refuse what is no finite column for each reading."""
    found = require_all_of(CircleTerm, answer)
    return tuple(
        replace(each, column=require_finite(each.column, (design.count,), f"a column of {each.name}"))
        for each in found
    )


def starts(effect: Guarded, answer: Any, _design: CircleDesign) -> tuple[tuple[float, ...], ...]:
    """Refuse what is no number for each searched parameter."""
    found = [tuple(map(float, each)) for each in require_all_of(Iterable, answer)]
    for each in found:
        require_finite(np.array(each, dtype=np.float64), (len(effect.searched),), "a row of its grid")
    return tuple(found)


#: What is made of an answer, by method.
ACCEPTED: Mapping[str, Callable[..., Any]] = {
    "terms": terms,
    "grid": starts,
    "findings": accept_all_of(Words),
    "absence": accept_all_of(Words),
}
