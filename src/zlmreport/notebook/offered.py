"""What is installed, for notebooks: the standards that evaluate a test, the effects that a model may hold."""

from __future__ import annotations

from typing import NamedTuple

from zlmreport.language import Language, Words
from zlmreport.language.formatting import write_plain
from zlmreport.measurement.axis import AxisKind
from zlmreport.model.effects.effect import find_unit_of
from zlmreport.notebook.readings import registry


class OfferedStandard(NamedTuple):
    """An installed standard.

    Attributes
    ----------
    identifier
        As `evaluate` and jobs name it, edition included: ``iso230-2:2014``.
    title
        In words.
    symbols
        The parameters that it may give, by the symbols of the results file.
    keys
        Its own keys beside ``tolerances``.
    """

    identifier: str
    title: str
    symbols: tuple[str, ...]
    keys: tuple[str, ...]


class OfferedEffect(NamedTuple):
    """An installed effect.

    Attributes
    ----------
    identifier
        As `fit` and jobs name it: ``backlash``.
    title
        In words.
    equation
        Of the deviation that it makes.
    parameters
        The units of its parameters on a linear axis, by their names.
    keys
        Its own keys, which choose between its forms.
    """

    identifier: str
    title: str
    equation: str
    parameters: dict[str, str]
    keys: tuple[str, ...]


def standards() -> dict[str, OfferedStandard]:
    """Return the installed standards by their identifiers."""
    return {
        each.identifier: OfferedStandard(
            each.identifier,
            _say(each.title),
            tuple(quantity.symbol for quantity in each.quantities),
            tuple(each.options.model_fields),
        )
        for each in registry().standards
    }


def effects() -> dict[str, OfferedEffect]:
    """Return the installed effects by their identifiers."""
    return {
        each.identifier: OfferedEffect(
            each.identifier,
            _say(each.title),
            write_plain(each.equation),
            {
                parameter.name: find_unit_of(parameter.dimension, AxisKind.LINEAR).ascii
                for parameter in (*each.linear, *each.searched)
            },
            tuple(each.options.model_fields),
        )
        for each in registry().effects
    }


def _say(words: Words) -> str:
    return words.in_language(Language.ENGLISH)
