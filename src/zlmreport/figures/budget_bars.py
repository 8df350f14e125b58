"""The budget as bars: how much each contribution adds to the uncertainty of a reading."""

from __future__ import annotations

from zlmreport.figures import alternatives
from zlmreport.figures.figure import Bar, Figure, Panel
from zlmreport.language import Language, Words, same
from zlmreport.measurement.axis import Axis
from zlmreport.quantities.uncertain import rounded_pair
from zlmreport.uncertainty.budget import Budget

_TITLE = Words(
    en="Standard uncertainties of the contributions at full effect",
    de="Standardunsicherheiten der Beiträge bei voller Wirkung",
)
_X_TITLE = Words(en="Contributions", de="Beiträge")
_Y_TITLE = Words(en="Standard uncertainty", de="Standardunsicherheit")
_SENTENCE = Words(en="{symbol}, {name}: {value} {unit}.", de="{symbol}, {name}: {value} {unit}.")


def budget_bars(budget: Budget, axis: Axis) -> Figure:
    """Return the graph of the standard uncertainties of a budget, in the order of its table."""
    unit = axis.deviation_unit
    bars = []
    sentences = []
    for number, each in enumerate(budget.contributions, 1):
        size = unit.from_si(each.standard_uncertainty)
        bar = Bar(same(f"u{number}"), size, _written(size))
        bars.append(bar)
        sentences.append(_SENTENCE.given(symbol=bar.label, name=each.name, value=bar.value, unit=unit.symbol))
    return Figure(
        key="budget",
        title=_TITLE,
        alternative=alternatives.text(*sentences),
        x_title=_X_TITLE,
        y_title=_Y_TITLE,
        x_unit="",
        y_unit=unit.symbol,
        panels=(Panel(bars=tuple(bars)),),
    )


def _written(value: float) -> Words:
    """Write an uncertainty to two significant digits in each language."""
    english, german = (
        rounded_pair(value, value, language.decimal_sign)[1] if value else "0"
        for language in (Language.ENGLISH, Language.GERMAN)
    )
    return Words(english, german)
