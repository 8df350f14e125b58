"""The uncertainty of measurement: what U means, the budget as a table and as bars, and what it leaves out."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from typing import TYPE_CHECKING

from zlmreport.document.blocks import (
    Align,
    Block,
    Cell,
    Column,
    Explained,
    Graph,
    Notice,
    Paragraph,
    RowGroup,
    Section,
    Symbol,
    Table,
)
from zlmreport.document.certificate.values import is_of_axis
from zlmreport.document.figures.bars import draw_budget
from zlmreport.evaluation.uncertainty import wording
from zlmreport.evaluation.uncertainty.budget import Acts, Budget, Contribution, KnownError, NoBudget
from zlmreport.evaluation.uncertainty.monte_carlo import TRIALS
from zlmreport.language import Words, join_parts, named
from zlmreport.language.formatting import write_percentage
from zlmreport.language.numbers import write_part
from zlmreport.measurement.units import MICROMETRE

if TYPE_CHECKING:
    from zlmreport.document.writer import Writer
    from zlmreport.evaluation.evaluation import Evaluation
    from zlmreport.measurement.axis import Axis

TITLE = Words("Uncertainty of measurement")
_COVERAGE = Words(
    "U = k·u is the expanded uncertainty of this test: y ± U holds, with a probability of about 95 %, the "
    "value that a faultless measuring set-up would have found in it."
)
_INTERVAL = Words(
    "{coverage} The interval of the axis holds, with the same probability, what another test of this axis by "
    "the same plan would find with the same set-up left in place; errors of the set-up are not in it."
)
_INTERVAL_OF_ANOTHER_TEST = Words(
    "{coverage} The interval of another test holds, with the same probability, what another test by the same "
    "plan would find with the same set-up left in place; errors of the set-up are not in it."
)
_INCOMPLETE = Words("U incomplete: {missing} not considered")
_INCOMPLETE_MEANS = Words(
    "Nothing is stated of these contributors to the uncertainty. y ± U holds the errors of the others "
    "only; no probability is stated for it, and no rule that uses U decides anything."
)
_NOT_AT_REFERENCE = Words(
    "The temperature or the expansion of the measured length is not known: the results hold at the "
    "temperature of the test, and not at 20 °C"
)
_EXPANDED = Words(
    "The measured length was {expansion} µm {longer} than at 20 °C; the readings are not corrected for it."
)
_LONGER, _SHORTER = Words("longer"), Words("shorter")
_KNOWN_ERRORS = Words(
    "Known errors that are in the readings ({names}) are added to U whole: U = k·u + |b|, where b is what "
    "the parameter would change by if they were taken out of every reading (JCGM 100:2008, F.2.4.5)."
)
_NEGLIGIBLE = Words("Declared negligible by the laboratory")
_METHOD = Words(
    "The budget below was propagated to every parameter by the Monte Carlo method (JCGM 101:2008): {trials} "
    "simulated tests, the readings with errors drawn from the budget, were evaluated by the formulas of each "
    "standard. Errors that readings share stay shared. y ± U holds at least 95.45 % of the simulated values."
)
_METHOD_BY_POSITION = Words(
    "{method} U of the mean deviations by position follows from the law of propagation (JCGM 100:2008), "
    "with k = 2."
)
_FACTOR = Words("k is 2 where simulated values scatter normally about y and U was not raised.")
#: A coverage factor between these is taken for 2.
_USUAL_FACTORS = (1.9, 2.1)
_SCATTER = Words(
    "The scatter of the axis itself is a property of the axis, which the parameters state, and no "
    "uncertainty of the measurement."
)
_UNSEEN_SCATTER = Words(
    "The scatter of the axis itself is a property of the axis and no uncertainty of the measurement; a "
    "single run does not show it."
)
_SCATTERS_OF_RUNS = (
    Words(
        "The scatter from run to run is not in U: what it makes of a parameter is in the interval of another "
        "test."
    ),
    Words("The scatter from run to run is not in U; a single run does not show it."),
)
_SCATTER_OF_THE_MACHINE = Words(
    "What the machine does otherwise from time to time is a property of the machine, and no uncertainty "
    "of the measurement."
)
_CAPTION = Words(
    "Uncertainty budget, grouped by the readings that share an error. u is the root mean square of the "
    "error of a reading{at_the_end}; the share is that of u² in the combined u²."
)
_COMBINED = Words("all contributions together")
_KNOWN = Words("known errors, not corrected: in no u, and in every U whole")
_AT_THE_END = Words(" at the end of the measured length, where every contribution has its full effect")
_COMBINED_OF = Words("A single reading at the end of the measured length")
_SINGLE = Words("A single reading")
_OF_NOTHING = Words("The readings give no parameter, and so there is no uncertainty of one.")
_NO_BUDGET = Words("The uncertainty of the parameters is not evaluated: {reason}.")


def _gives_nothing(evaluations: Sequence[Evaluation]) -> bool:
    """Return whether no standard gives a parameter, nor one line of several any of its own."""
    if not evaluations or any(each.parameters for each in evaluations):
        return False
    measurements = evaluations[0].measurements
    return not measurements.tests or measurements.axis.measurand.is_continuous


def say_uncertainty(
    budget: Budget | NoBudget, evaluations: Iterable[Evaluation], writer: Writer
) -> Iterator[Block]:
    """Yield what U means, what it leaves out, or why there is none: for the first page.

    `evaluations`: What it is of: where they have intervals of the axis, it is said what these are.
    """
    evaluations = tuple(evaluations)
    if isinstance(budget, NoBudget):
        yield Paragraph(writer.say(_NO_BUDGET.given(reason=budget.reason)))
    elif _gives_nothing(evaluations):
        yield Paragraph(writer.say(_OF_NOTHING))
        return
    elif budget.is_complete:
        parameters = [each for evaluation in evaluations for each in evaluation.parameters]
        has_interval = any(each.axis_interval is not None for each in parameters)
        interval = _INTERVAL if all(map(is_of_axis, evaluations)) else _INTERVAL_OF_ANOTHER_TEST
        yield Paragraph(writer.say(interval.given(coverage=_COVERAGE) if has_interval else _COVERAGE))
    else:
        missing = join_parts(
            (writer.say(wording.name_contributor(name)) for name in budget.missing), writer.language
        )
        yield Notice(writer.say(_INCOMPLETE.given(missing=missing)), (writer.say(_INCOMPLETE_MEANS),))
    if budget.uncorrected_expansion is None:
        yield Notice(writer.say(_NOT_AT_REFERENCE), ())
    elif budget.uncorrected_expansion:
        longer = MICROMETRE.from_si(budget.uncorrected_expansion)
        expansion = writer.number(float(f"{abs(longer):.3g}"))
        words = _EXPANDED.given(expansion=expansion, longer=_LONGER if longer > 0 else _SHORTER)
        yield Paragraph(writer.say(words))
    if isinstance(budget, Budget) and budget.known_errors:
        names = ", ".join(writer.say(each.name) for each in budget.known_errors)
        yield Paragraph(writer.say(_KNOWN_ERRORS.given(names=names)))


def say_neglected(budget: Budget | NoBudget, writer: Writer) -> Iterator[Paragraph]:
    """Yield in a line what was declared negligible, with the reasons; those that share one stand together."""
    by_reason: dict[str, list[str]] = {}
    for name, reason in budget.negligible:
        by_reason.setdefault(reason, []).append(writer.say(wording.name_contributor(name)))
    if by_reason:
        parts = (f"{', '.join(names)} ({reason})" for reason, names in by_reason.items())
        said = join_parts(parts, writer.language)
        yield Paragraph(writer.say(named(_NEGLIGIBLE, f"{said}.")))


def lay_out_budgets(
    budget: Budget | NoBudget, evaluations: Sequence[Evaluation], writer: Writer, *, with_bars: bool
) -> Section:
    """Return the section on the uncertainty of everything that evaluations of one test state.

    `with_bars`: Whether contributions are drawn, too.
    """
    blocks = _lay_out_blocks(budget, evaluations, writer, with_bars=with_bars)
    return Section("uncertainty", writer.say(TITLE), tuple(blocks))


def _lay_out_blocks(
    budget: Budget | NoBudget, evaluations: Sequence[Evaluation], writer: Writer, *, with_bars: bool
) -> Iterator[Block]:
    measurements = evaluations[0].measurements
    axis = measurements.axis
    yield from say_uncertainty(budget, evaluations, writer)
    if isinstance(budget, NoBudget) or _gives_nothing(evaluations):
        return
    method, stops = _METHOD.given(trials=TRIALS), not axis.measurand.is_continuous
    said = [_METHOD_BY_POSITION.given(method=method) if stops else method]
    factors = (parameter.coverage_factor for each in evaluations for parameter in each.parameters)
    usual_least, usual_most = _USUAL_FACTORS
    if any(not usual_least <= factor <= usual_most for factor in factors if factor is not None):
        said.append(_FACTOR)
    yield Paragraph(" ".join(map(writer.say, said)))
    unseen = all(len(each.runs) == 1 for each in measurements.lines)
    of_item = (_SCATTER, _UNSEEN_SCATTER) if is_of_axis(evaluations[0]) else _SCATTERS_OF_RUNS
    yield Paragraph(writer.say(of_item[unseen] if stops else _SCATTER_OF_THE_MACHINE))
    if not budget.tests:  # each line of several has a budget of its own
        yield from lay_out_own_blocks(budget, axis, writer, with_bars=with_bars)
    if budget.negligible:
        reasons = (named(wording.name_contributor(name), reason) for name, reason in budget.negligible)
        yield Notice(writer.say(_NEGLIGIBLE), tuple(map(writer.say, reasons)))


def lay_out_own_blocks(
    budget: Budget | NoBudget, axis: Axis, writer: Writer, *, with_bars: bool
) -> Iterator[Block]:
    """Yield the contributions of a budget, as a table and as bars."""
    if isinstance(budget, Budget):
        yield _lay_out_table(budget, writer)
        if with_bars:
            yield Graph(draw_budget(budget, axis))


def _lay_out_table(budget: Budget, writer: Writer) -> Table:
    columns = (
        Column(writer.say(Words("Symbol"))),
        Column(writer.say(Words("Contribution and its source"))),
        Column(
            writer.say(Words("Stated")) + writer.marks.write_after("instrument", "environment", "uncertainty")
        ),
        Column(writer.say(Words("Distribution"))),
        Column(Symbol("u"), writer.deviation_unit.symbol, Align.RIGHT),
        Column(writer.say(Words("Share")), "%", Align.RIGHT),
    )
    numbered = list(enumerate(budget.contributions, 1))
    groups = [
        RowGroup(rows, writer.say(wording.ACTS[acts]))
        for acts in Acts
        if (
            rows := tuple(
                _lay_out_row(number, each, budget, writer) for number, each in numbered if each.acts is acts
            )
        )
    ]
    total = (
        Symbol("u"),
        writer.say(_COMBINED_OF if budget.acting(Acts.ALONG_THE_LENGTH) else _SINGLE),
        "",
        "",
        _write_size(budget.standard_uncertainty, budget, writer),
        write_percentage(1.0, writer.language.decimal_sign, 1),
    )
    groups.append(RowGroup((total,), writer.say(_COMBINED)))
    if budget.known_errors:
        rows = tuple(_known(number, each, writer) for number, each in enumerate(budget.known_errors, 1))
        groups.append(RowGroup(rows, writer.say(_KNOWN)))
    at_the_end = _AT_THE_END if budget.acting(Acts.ALONG_THE_LENGTH) else ""
    return Table(writer.say(_CAPTION.given(at_the_end=at_the_end)), columns, tuple(groups))


def _known(number: int, error: KnownError, writer: Writer) -> tuple[Cell, ...]:
    return (
        Symbol(f"b_{{{number}}}"),
        Explained(writer.say(error.name), writer.say(error.source)),
        writer.say(error.stated),
        writer.say(Words("known")),
        "",
        "",
    )


def _lay_out_row(number: int, contribution: Contribution, budget: Budget, writer: Writer) -> tuple[Cell, ...]:
    return (
        Symbol(f"u_{{{number}}}"),
        Explained(writer.say(contribution.name), writer.say(contribution.source)),
        writer.say(contribution.stated),
        writer.say(wording.DISTRIBUTIONS[contribution.distribution]),
        _write_size(contribution.standard_uncertainty, budget, writer),
        write_percentage(budget.share(contribution), writer.language.decimal_sign, 1),
    )


def _write_size(value: float, budget: Budget, writer: Writer) -> str:
    """Write a standard uncertainty as a part of all together."""
    unit = writer.deviation_unit
    return writer.say(write_part(unit.from_si(value), unit.from_si(budget.standard_uncertainty)))
