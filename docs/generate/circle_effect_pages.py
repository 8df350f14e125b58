"""The installed effects of circles, from what they say of themselves."""

from __future__ import annotations

from markdown import code, table

from zlmreport.language import Language
from zlmreport.model.effects.circle_effect import CircleEffect, Parity
from zlmreport.plugin.registry import find_plugins
from zlmreport.testing import circle_designs

_PARITY = {
    Parity.EVEN: "alike",
    Parity.ODD: "opposite",
    Parity.BY_TRAVEL: "by travel",
    Parity.IN_TIME: "in time",
}


def text() -> str:
    """Return a table of all of them."""
    return table(
        ("Effect", "Cause", "Δr", "Senses", "Feed", "Radius", "Parameters"),
        (
            (
                code(each.identifier),
                each.explains.in_language(Language.ENGLISH),
                each.equation,
                _PARITY[each.law.parity],
                _power("F", each.law.feed),
                _power("R", each.law.radius),
                _parameters(each),
            )
            for each in find_plugins().circle_effects
        ),
    )


def _power(letter: str, power: float | None) -> str:
    if power is None:
        return "shape"
    return {0.0: "–", 1.0: letter, 2.0: f"{letter}²", -1.0: f"1/{letter}"}[power]


def _parameters(effect: CircleEffect) -> str:
    """Return the terms on a circle in XY, and what is searched, with units."""
    design = circle_designs()["one plane"]
    terms = effect.terms(design, effect.grid(design)[0])
    named = [(each.name, each.unit.symbol) for each in (*terms, *effect.searched)]
    return ", ".join(f"{name} ({unit})" if unit else name for name, unit in named)
