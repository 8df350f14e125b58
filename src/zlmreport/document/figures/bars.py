"""Bar graphs: values in percent of their limits, and contributions to the uncertainty."""

from __future__ import annotations

from zlmreport.document.figures.figure import Bar, Figure, Level, Panel, Role
from zlmreport.document.figures.prescribed import alternative_text
from zlmreport.evaluation.evaluation import EvaluatedParameter, Evaluation
from zlmreport.evaluation.uncertainty.budget import Budget
from zlmreport.language import Words, same
from zlmreport.language.formatting import write_plain
from zlmreport.language.numbers import number_words, write_part
from zlmreport.measurement.axis import Axis
from zlmreport.measurement.units import write_behind

_UNCERTAIN_TITLE = Words("{bearer}: amounts in percent of their limits TL with their uncertainty ± U")
_GUARDED_TITLE = Words(
    "{bearer}: amounts in percent of their limits TL with their uncertainty ± U; a line across a bar "
    "is the acceptance limit"
)
_BARE_TITLE = Words("{bearer}: amounts in percent of their limits TL")
_GRAPH = Words("{bearer}: bar chart of the parameters that have a limit.")
#: One by itself compares nothing.
_FEWEST_BARS = 2
_X_TITLE = Words("Parameters with a limit")
_Y_TITLE = Words("Share of limit")
_BAR = Words("{symbol}: {percent} % of its limit")
_UNCERTAIN = Words("{bar} ± {uncertainty} %")
_ACCEPTED = Words("{bar}, accepted up to {accepted} %")
_SENTENCE = Words("{bar}.")


def draw_conformity(evaluation: Evaluation) -> Figure | None:
    """Return the graph; None of a single bar, which the table says better."""
    limited = [each for each in evaluation.parameters if each.limit]
    if len(limited) < _FEWEST_BARS:
        return None
    bars = tuple(map(_make_bar, limited))
    graph = _GRAPH.given(bearer=evaluation.measurements.axis.heading)
    sentences = [graph, *(_write_sentence(each, bar) for each, bar in zip(limited, bars, strict=True))]
    title = _UNCERTAIN_TITLE if any(bar.uncertainty for bar in bars) else _BARE_TITLE
    if any(bar.accepted is not None for bar in bars):
        title = _GUARDED_TITLE
    return Figure(
        key="conformity",
        title=title.given(bearer=evaluation.measurements.axis.heading),
        alternative=alternative_text(*sentences),
        x_title=_X_TITLE,
        y_title=_Y_TITLE,
        x_unit="",
        y_unit="%",
        panels=(Panel(bars=bars, levels=(Level("TL", Role.TOLERANCE, 100.0),)),),
    )


def _make_bar(parameter: EvaluatedParameter) -> Bar:
    limit = parameter.limit or 1.0
    decision = parameter.decision
    accepted = None if decision is None else decision.acceptance_limit
    percent = 100.0 * abs(parameter.value) / limit
    return Bar(
        label=same(parameter.quantity.notation),
        y=percent,
        value=number_words(percent, 1),
        uncertainty=100.0 * (parameter.expanded_uncertainty or 0.0) / limit,
        accepted=None if accepted in (None, limit) else max(0.0, 100.0 * accepted / limit),
        is_symbol=True,
    )


def _write_sentence(parameter: EvaluatedParameter, bar: Bar) -> Words:
    words = _BAR.given(symbol=write_plain(parameter.quantity.notation), percent=bar.value)
    if bar.uncertainty:
        words = _UNCERTAIN.given(bar=words, uncertainty=number_words(bar.uncertainty, 1))
    if bar.accepted is not None:
        words = _ACCEPTED.given(bar=words, accepted=number_words(bar.accepted, 1))
    return _SENTENCE.given(bar=words)


def draw_budget(budget: Budget, axis: Axis) -> Figure:
    """Return the graph of the standard uncertainties of a budget, in the order of its table."""
    unit = axis.deviation_unit
    whole = unit.from_si(budget.standard_uncertainty)
    bars = []
    sentences = []
    for number, each in enumerate(budget.contributions, 1):
        size = unit.from_si(each.standard_uncertainty)
        bar = Bar(same(f"u_{{{number}}}"), size, write_part(size, whole), is_symbol=True)
        bars.append(bar)
        sentences.append(
            Words("{symbol}, {name}: {value}{unit}.").given(
                symbol=f"u{number}", name=each.name, value=bar.value, unit=write_behind(unit.symbol)
            )
        )
    return Figure(
        key="budget",
        title=Words("Standard uncertainties of the contributions at full effect"),
        alternative=alternative_text(*sentences),
        x_title=Words("Contributions"),
        y_title=Words("Standard uncertainty"),
        x_unit="",
        y_unit=unit.symbol,
        panels=(Panel(bars=tuple(bars)),),
    )
