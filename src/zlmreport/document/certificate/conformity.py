"""Statements of conformity: the decision rule with its risk, and what it says of each limit."""

from __future__ import annotations

import math
import operator
from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

from zlmreport.document.blocks import (
    Align,
    Block,
    Cell,
    Column,
    Graph,
    Mark,
    Paragraph,
    RowGroup,
    Symbol,
    Table,
    Verdict,
)
from zlmreport.document.writer import NOTHING, Writer, add_unit, is_mixed, write_rounded_together
from zlmreport.evaluation.evaluation import Conformity
from zlmreport.language import Words, join_parts, same
from zlmreport.language.formatting import write_fixed_number, write_percentage, write_plain

if TYPE_CHECKING:
    from zlmreport.evaluation.evaluation import EvaluatedParameter, Evaluation
    from zlmreport.job.evaluation_keys import DecisionRuleKeys

#: Of a risk that no double holds: it is small, and not none.
_UNDERFLOW = 1e-300
#: The risk of a statement on a value that lies on its limit.
_EVEN = 0.5
#: Symbols of the sentences on decision rules: the limit.
_OF_RULES = ("T_{L}",)
#: What each statement looks like, and its words.
STATEMENTS = {
    Conformity.MET: (Mark.MET, Words("conforms")),
    Conformity.CONDITIONALLY_MET: (Mark.MET, Words("conforms, conditionally")),
    Conformity.CONDITIONALLY_FAILED: (Mark.NOT_MET, Words("does not conform, conditionally")),
    Conformity.FAILED: (Mark.NOT_MET, Words("does not conform")),
    Conformity.UNDECIDED: (Mark.OPEN, Words("not decided")),
}

_SIMPLE = Words(
    "Decision rule: simple acceptance. A parameter conforms when its unrounded amount does not exceed "
    "the limit TL. The measurement uncertainty is not taken into account: for a value at the limit, the "
    "risk of a wrong acceptance or rejection reaches 50 %{largest}."
)
_LARGEST = Words("; the largest here is {risk} %, of {symbol}")
_LARGER_IF_WIDE = Words(
    "{largest}: its uncertainty is as large as its limit, or known errors are not corrected"
)
_KNOWN_ERRORS = Words(
    "{rule} Where a known error that is not corrected would turn the statement, nothing is decided."
)
_GUARD_BAND = Words(
    "Decision rule: guarded acceptance with the guard band w = {width}. A parameter conforms when its "
    "unrounded amount does not exceed TL − w; above, it does not conform. The risk of a wrong acceptance is "
    "at most {risk} %."
)
_ISO_14253 = Words(
    "Decision rule: ISO 14253-1:2017 with a conformance probability of 95 %, applied as guard bands of "
    "1.65·u on both sides of the limit. Conformity is stated up to TL − 1.65·u, nonconformity beyond "
    "TL + 1.65·u; in between nothing is decided. The risk of a wrong statement is at most 5 %."
)
_NON_BINARY = Words(
    "Decision rule: non-binary statement with the guard band w = U (ILAC-G8:09/2019). Up to TL − U a "
    "parameter conforms, up to TL conditionally; up to TL + U it conditionally does not conform, beyond "
    "it does not. The risk of a wrong statement is at most {risk} %, of a conditional one at most 50 %."
)
_WITHOUT_UNCERTAINTY = Words(
    "{rule} It needs the expanded uncertainty of each parameter, which this document does not state; "
    "conformity is therefore not decided."
)
_OF_STANDARD = Words("{specification} ({standard})")
_NONE = Words("none")
#: With which an amount and what is accepted of it are told apart.
_MOST_MORE_DECIMALS = 6
#: Of µm or ″: fewer than a double rounds at.
_DIGITS = 9
_CAPTION = Words(
    "Limits and what is stated of them. The risk is the probability that the statement is wrong, for a "
    "normally distributed value with this uncertainty (JCGM 106:2012)."
)


def make_verdict_cell(parameter: EvaluatedParameter, writer: Writer) -> Cell:
    """Return what is stated of a parameter's limit; nothing where it has none."""
    if parameter.limit is None or parameter.decision is None:
        return NOTHING
    mark, words = STATEMENTS[parameter.decision.conformity]
    return Verdict(mark, writer.say(words))


def say_rule(
    keys: DecisionRuleKeys, evaluations: Sequence[Evaluation], writer: Writer
) -> Iterator[Paragraph]:
    """Yield the decision rule with its risk, where any limit is stated."""
    limited = [each for evaluation in evaluations for each in evaluation.parameters if each.limit is not None]
    if not limited:
        return
    words = _say_rule(keys, limited, writer)
    if keys.rule != "simple" and any(each.expanded_uncertainty is None for each in limited):
        words = _WITHOUT_UNCERTAINTY.given(rule=words)
    if any(each.known_error for each in limited):
        words = _KNOWN_ERRORS.given(rule=words)
    symbols = (*_OF_RULES, *(each.quantity.notation for each in limited if "_" in each.quantity.notation))
    yield Paragraph(writer.say(_say_source_of_limits(evaluations, writer).given(rule=words)), symbols=symbols)


def _say_source_of_limits(evaluations: Sequence[Evaluation], writer: Writer) -> Words:
    """Return the sentence on the document that limits come from (ISO/IEC 17025:2017, 7.8.6.2 b)."""
    limited = [each for each in evaluations if any(one.limit is not None for one in each.parameters)]
    named = dict.fromkeys(each.specification for each in limited if each.specification)
    if not named:
        return Words("{rule} Limits as ordered; their source is not stated.")
    some = len({each.specification for each in limited}) > 1
    names = join_parts(
        (
            writer.say(_OF_STANDARD.given(specification=each.specification, standard=each.designation))
            if some
            else each.specification
            for each in limited
            if each.specification
        ),
        writer.language,
    )
    mark = writer.marks.write_after("evaluate.specification")
    return Words("{rule} Limits{mark}: {names}.").given(names=names if some else next(iter(named)), mark=mark)


def lay_out_conformity(evaluation: Evaluation, writer: Writer) -> Iterator[Block]:
    """Yield the graph of a standard's limits, and the table of what is stated of them.

    Nothing where the job states no limit; no table where no uncertainty is known: it would say no more than
    that of the results.
    """
    if all(each.limit is None for each in evaluation.parameters):
        return
    from zlmreport.document.figures.bars import draw_conformity  # noqa: PLC0415 - only with limits

    graph = draw_conformity(evaluation)
    if graph is None:
        return
    yield Graph(graph)
    yield from lay_out_statements([evaluation], writer)


def lay_out_statements(evaluations: Sequence[Evaluation], writer: Writer) -> Iterator[Table]:
    """Yield the table of what is stated of limits, by standard where there are several."""
    limited = {
        each.designation: [one for one in each.parameters if one.limit is not None] for each in evaluations
    }
    if all(each.expanded_uncertainty is None for some in limited.values() for each in some):
        return
    every = [one for some in limited.values() for one in some]
    mixed = is_mixed(every, writer)
    unit = "" if mixed else writer.deviation_unit.symbol
    columns = (
        Column(writer.say(Words("Symbol"))),
        Column(writer.say(Words("Amount")), unit, Align.RIGHT),
        Column(
            writer.say(Words("Limit TL")) + writer.marks.write_after("evaluate.tolerances"), unit, Align.RIGHT
        ),
        Column(writer.say(Words("Accepted up to")), unit, Align.RIGHT),
        Column(writer.say(Words("Statement"))),
        Column(writer.say(Words("Risk")), "%", Align.RIGHT),
    )
    groups = tuple(
        RowGroup(
            tuple(_lay_out_row(each, writer, with_units=mixed) for each in some),
            name if len(limited) > 1 else "",
        )
        for name, some in limited.items()
        if some
    )
    yield Table(writer.say(_CAPTION), columns, groups)


def _lay_out_row(parameter: EvaluatedParameter, writer: Writer, *, with_units: bool) -> tuple[Cell, ...]:
    writer = writer.of_quantity(parameter.quantity)

    def shown(number: str) -> str:
        return add_unit(number, parameter.quantity, writer) if with_units else number

    decision = parameter.decision
    accepted = None if decision is None else decision.acceptance_limit
    is_nothing_accepted = accepted is not None and accepted < 0  # the guard band is wider than the limit
    risk = None if decision is None else decision.risk
    amount, most = _write_apart(abs(parameter.value), accepted, parameter, writer)
    return (
        Symbol(parameter.quantity.notation),
        shown(amount),
        shown(writer.number(writer.deviation_unit.from_si(parameter.limit or 0.0))),
        writer.say(_NONE) if is_nothing_accepted else shown(most),
        make_verdict_cell(parameter, writer),
        NOTHING if risk is None else write_percentage(risk or _UNDERFLOW, writer.language.decimal_sign, 1),
    )


def _write_apart(
    amount: float, accepted: float | None, parameter: EvaluatedParameter, writer: Writer
) -> tuple[str, str]:
    """Write an amount and up to where it is accepted, with more decimals where rounding exchanges them.

    "15.9, accepted up to 15.9: not decided" would contradict itself.
    """
    written = _write_rounded(amount, parameter, writer), _write_accepted(accepted, parameter, writer)
    if accepted is None:
        return written
    sign, is_limit = writer.language.decimal_sign, accepted == parameter.limit
    value, most = (round(writer.deviation_unit.from_si(each), _DIGITS) for each in (amount, accepted))
    decimals = len(written[0].partition(sign)[2])
    for more in range(decimals, decimals + _MOST_MORE_DECIMALS):
        shown = round(value, more), most if is_limit else round(most, more)
        if (shown[0] <= shown[1]) == (value <= most):
            if more == decimals:
                return written
            finer = (write_fixed_number(each, more, sign) for each in shown)
            return next(finer), written[1] if is_limit else next(finer)
    return written


def _write_accepted(accepted: float | None, parameter: EvaluatedParameter, writer: Writer) -> str:
    if accepted is None:
        return NOTHING
    if accepted == parameter.limit:
        return writer.number(writer.deviation_unit.from_si(accepted))
    return _write_rounded(accepted, parameter, writer)


def _write_rounded(value: float, parameter: EvaluatedParameter, writer: Writer) -> str:
    """Write a value (m or rad) with the decimals that the parameter has in every other table."""
    expanded = parameter.expanded_uncertainty
    return write_rounded_together(value, expanded, writer)[0] if expanded else writer.deviation(value)


def _say_rule(keys: DecisionRuleKeys, limited: Sequence[EvaluatedParameter], writer: Writer) -> Words:
    coverage_factor = max(2.0, min((each.coverage_factor or 2.0) for each in limited))
    match keys.rule:
        case "guard-band":
            factor = keys.guard_band_factor
            width = "U" if factor == 1 else f"{writer.number(factor)}·U"
            return _GUARD_BAND.given(width=width, risk=_compute_tail(factor * coverage_factor, writer))
        case "iso14253-1":
            return _ISO_14253
        case "non-binary":
            return _NON_BINARY.given(risk=_compute_tail(coverage_factor, writer))
        case _:
            return _SIMPLE.given(largest=_say_largest_risk(limited, writer))


def _say_largest_risk(limited: Sequence[EvaluatedParameter], writer: Writer) -> Words:
    """Return what is said of the largest risk of a document: nothing where none is known."""
    risks = [
        (each.decision.risk, each) for each in limited if each.decision and each.decision.risk is not None
    ]
    if not risks:
        return same("")
    risk, of = max(risks, key=operator.itemgetter(0))
    words = _LARGEST.given(
        risk=write_percentage(risk or _UNDERFLOW, writer.language.decimal_sign, 1),
        symbol=write_plain(of.quantity.notation),
    )
    return _LARGER_IF_WIDE.given(largest=words) if risk > _EVEN else words


def _compute_tail(distance: float, writer: Writer) -> str:
    """Return the percentage of a normal distribution beyond so many standard deviations, rounded up."""
    percent = 50.0 * math.erfc(distance / math.sqrt(2.0))
    return write_fixed_number(math.ceil(10.0 * percent) / 10.0, 1, writer.language.decimal_sign)
