"""The sheet beside a compensation table, for who loads it; and what a second test confirmed."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from zlmreport.document.blocks import (
    Align,
    Block,
    Column,
    Facts,
    Graph,
    Mark,
    Notice,
    Paragraph,
    RowGroup,
    Section,
    Symbol,
    Table,
)
from zlmreport.document.certificate import conditions
from zlmreport.document.certificate.build import GENERATOR
from zlmreport.document.certificate.document import Certificate, PageWords
from zlmreport.document.figures.figure import Band, Curve, Figure, Panel, Role
from zlmreport.document.figures.prescribed import DEVIATION_TITLE, POSITION_TITLE
from zlmreport.document.writer import NOTHING, Writer
from zlmreport.language import Words
from zlmreport.language.formatting import write_fixed_number
from zlmreport.language.numbers import number_words
from zlmreport.measurement.arrays import FloatArray, read_only_floats
from zlmreport.measurement.units import with_unit
from zlmreport.model.compensation.confirmation import ConfirmationVerdict
from zlmreport.model.compensation.curve import TURN, find_open_part, wrap
from zlmreport.model.compensation.making import GridReason

if TYPE_CHECKING:
    from zlmreport.job.job import Job
    from zlmreport.measurement.measurement_set import MeasurementSet
    from zlmreport.model.compensation.confirmation import Confirmation
    from zlmreport.model.compensation.forecast import ExpectedFigure, Figures
    from zlmreport.model.compensation.making import Made

_TITLE = Words("Compensation table")
_SUBTITLE = Words("Axis {axis}, for {control}")
_CONFIDENCE = {
    "verified": Words("sign and format verified"),
    "documented": Words("documented by the maker, not tried on the control"),
    "unconfirmed": Words("not confirmed: sign or format may be another"),
}
_COORDINATES = Words(
    "Positions are those of this test: they must be the control's machine coordinates, counted the same way. "
    "With a zero offset the table acts at shifted positions, and counted the other way at those mirrored."
)
_CHECK = Words(
    "Load the table, reference the axis, and measure the worked row again: what is left must be no more than "
    "it says. If the deviation doubles, the sign is wrong: take the table out. A backlash parameter of the "
    "control must not correct the same play a second time."
)
_NO_MEASUREMENT = Words(
    "A forecast is no measurement: the axis with its table needs a test of its own "
    "(zlmreport compensate --confirm)."
)
_BOTH_SET_UPS = Words(
    "A second test shows the scatter of both tests, and the errors of two set-ups of this test's budget."
)
_SCATTER_ALONE = Words(
    "A second test shows the scatter of both tests; of the set-up's errors the job states no budget."
)
_UNKNOWN_BETWEEN = Words(
    "Between the targets nothing was measured, and no model says what is there: straight lines from one to "
    "the next are taken."
)
_ALTERNATIVE = Words(
    "The mean deviations with the table, from {low} to {high}; and what the table leaves of them, from "
    "{least} to {most}."
)
#: What a second test says of the table.
CONFIRMED = {
    ConfirmationVerdict.HELD: Words("The second test holds the forecast."),
    ConfirmationVerdict.WRONG_SIGN: Words("The table acts with the wrong sign: turn it."),
    ConfirmationVerdict.HALF: Words("Half of the table acts; look for a factor of two."),
    ConfirmationVerdict.DOUBLE: Words(
        "The table acts twice: is it loaded a second time, or does the control count in half the unit?"
    ),
    ConfirmationVerdict.NOT_IN_EFFECT: Words(
        "The table does not act: is it loaded, switched on, and the axis referenced since?"
    ),
    ConfirmationVerdict.SHIFTED: Words("The table acts at other positions; look at its start."),
    ConfirmationVerdict.PLAY_TURNED: Words(
        "What parts the directions is added where it is to be taken away: the table's directions are "
        "exchanged, or the control's backlash parameter has the wrong sign."
    ),
    ConfirmationVerdict.PLAY_TWICE: Words(
        "The play is taken away twice: a backlash parameter of the control takes it, too, or is twice as "
        "large."
    ),
    ConfirmationVerdict.PLAY_LEFT: Words("The table acts in both directions alike: the play is left."),
    ConfirmationVerdict.OTHER: Words(
        "The second test does not show this table as it was made; is it active, and is it this one?"
    ),
}
_RATIO = Words("E after is {share} % of E before.")
_APPLIED = Words("{share} % of the table shows in the second test.")
_NOT_SEEN = Words("What part of the table acts does not show: it takes no more away than both tests scatter.")
_BY_BACKLASH = Words(
    "The lost motion that the table leaves is gone: the control's backlash parameter takes it."
)
_SHIFTED = Words(
    "It is shifted by {length} (its rows are {step} apart): let it begin at {start} instead of {first}."
)
#: What to enter in the control, where the verdict alone does not say it.
_ENTER = {
    ConfirmationVerdict.WRONG_SIGN: Words("Enter every value with the other sign, or take the table out."),
    ConfirmationVerdict.HALF: Words("Where no unit is wrong, enter twice every value."),
    ConfirmationVerdict.DOUBLE: Words("Leave it in once; where it is, enter half of every value."),
    ConfirmationVerdict.PLAY_TWICE: Words(
        "The table has both directions: set the control's backlash parameter to 0."
    ),
    ConfirmationVerdict.PLAY_TURNED: Words(
        "Enter the values of moving forward where those of moving back stand, and these where those stand."
    ),
    ConfirmationVerdict.PLAY_LEFT: Words(
        "Switch on compensation in both directions; a control that has none takes the play by its backlash "
        "parameter: {play} (forward − reverse)."
    ),
}
_ENTER_PLAY = Words(
    "The table has one column: the control's backlash parameter is to take {play} (forward − reverse)."
)
_FITS = Words(
    "So read, the table leaves {rest} of what went between the tests; as it was made, {left} (root mean "
    "squares)."
)
_WITHIN, _BELOW, _ABOVE = Words("within"), Words("below"), Words("above")
_SYMBOL, _PARAMETER = Words("Symbol"), Words("Parameter")
_BEFORE, _SECOND_TEST = Words("Before"), Words("Second test")
_FORECAST = Words("Forecast from the files as the control reads them")
#: U of E, M, B and A by their symbols, before and with the table, in the unit of deviations.
Uncertainties = tuple[Mapping[str, float], Mapping[str, float]]
#: By how much a row may stand off the outermost target and be there, m or rad.
_NEAR = 1e-9
#: Of what is left, m or rad: the rounding of doubles is no curve.
_DIGITS_DRAWN = 12
#: What was done to the axis between two tests.
_ADJUSTMENT = Words("Compensation table of {rows} rows in the control: {control}.")
_FIGURES = {
    "E": Words("Systematic deviation"),
    "M": Words("Mean bidirectional deviation"),
    "B": Words("Reversal value"),
    "A": Words("Accuracy"),
}


def make_compensation_sheet(
    job: Job, measurements: MeasurementSet, made: Made, uncertainties: Uncertainties
) -> Certificate:
    """Return the document: what the table is for, what it leaves, how to load it, how to check it."""
    keys = job.keys.certificate
    writer = Writer.of(measurements, keys.language)
    say = writer.say
    title, control = say(_TITLE), say(made.controller.title)
    return Certificate(
        number=keys.number,
        title=title,
        subtitle=say(_SUBTITLE.given(axis=job.axis.name, control=control)),
        language=keys.language,
        issued=keys.issued,
        paper=keys.paper,
        letterhead=None,
        cover=(
            Facts(tuple(_list_facts(job, made, writer))),
            *lay_out_forecast(made, writer, uncertainties).blocks,
            Graph(_draw_figure(made, writer)),
        ),
        sections=(
            Section("loading", say(Words("Loading and checking")), _lay_out_loading(made, writer)),
            conditions.lay_out_conditions(job, measurements, (), writer),
        ),
        page_words=PageWords.in_language(keys.language, f"{title} {keys.number}"),
        description=f"{title}, {control}",
        measurements=measurements,
        evaluations=(),
        generator=GENERATOR,
        is_compact=True,
    )


def _list_facts(job: Job, made: Made, writer: Writer) -> Iterator[tuple[str, str]]:
    say, active = writer.say, job.keys.axis.compensation_table
    none = Words("no table")
    names = ", ".join(f"{job.keys.certificate.number}{end}" for end in made.files)
    yield say(Words("Files")), names
    yield say(Words("Format")), say(_CONFIDENCE[made.controller.confidence])
    first, last = (_write_length(float(made.decoded.positions[end]), writer) for end in (0, -1))
    yield say(Words("Rows")), f"{len(made.decoded.positions)} ({first} … {last})"
    yield (say(Words("Active during the test")), active.name if isinstance(active, Path) else say(none))


def lay_out_forecast(made: Made, writer: Writer, uncertainties: Uncertainties) -> Section:
    """Return E, M, B and A before, with the table and in a second test, and what is to be known of it."""
    say, unit = writer.say, writer.deviation_unit
    factor = unit.from_si(1.0)
    before, after = (each.in_unit(factor) for each in (made.forecast.before, made.forecast.after))
    rows = tuple(
        (
            Symbol(symbol),
            say(_FIGURES[symbol]),
            _write_with_u(before[symbol], uncertainties[0].get(symbol), writer),
            _write_with_u(after[symbol], uncertainties[1].get(symbol), writer),
            _write_expected(made.forecast.second_test.get(symbol), writer),
        )
        for symbol in before
    )
    columns = (
        Column(say(_SYMBOL)),
        Column(say(_PARAMETER)),
        Column(say(_BEFORE), unit.symbol, Align.RIGHT),
        Column(say(Words("With the table")), unit.symbol, Align.RIGHT),
        Column(say(Words("A second test, 95 %")), unit.symbol, Align.RIGHT),
    )
    sentences = (*_list_table_remarks(made, writer), _NO_MEASUREMENT)
    return Section(
        "forecast",
        say(_FORECAST),
        (
            Table(say(_FORECAST), columns, (RowGroup(rows),)),
            *(Paragraph(say(each), Mark.OPEN) for each in made.assumed),
            *(Paragraph(say(each)) for each in sentences),
        ),
    )


def lay_out_confirmation(found: Confirmation, made: Made, shown: Figures, writer: Writer) -> Section:
    """Return whether a second test holds the forecast: in words, and beside what was and was forecast.

    `shown`: What the second test shows.
    """
    say, unit = writer.say, writer.deviation_unit
    factor = unit.from_si(1.0)
    before, after = made.forecast.before.in_unit(factor), shown.in_unit(factor)
    is_held = found.verdict is ConfirmationVerdict.HELD
    # What is forecast is a test in the same directions: another one shows other figures.
    is_of_plan = (made.forecast.before.reversal is None) == (shown.reversal is None)
    foretold = made.forecast.choose_second_test(has_backlash=found.has_backlash) if is_of_plan else {}

    def where(symbol: str) -> str:
        expected = foretold.get(symbol)
        if expected is None:
            return ""
        shown = after[symbol] / factor
        return say(_BELOW if shown < expected.low else _ABOVE if shown > expected.high else _WITHIN)

    sentences = [
        _RATIO.given(share=number_words(100 * found.ratio, 1)),
        _APPLIED.given(share=number_words(100 * found.applied, 0)) if found.is_seen else _NOT_SEEN,
    ]
    if found.has_backlash:
        sentences.append(_BY_BACKLASH)
    sentences += _list_settings(found, made, writer)
    rows = tuple(
        (
            Symbol(symbol),
            say(_FIGURES[symbol]),
            _write_number(before[symbol], writer) if symbol in before else NOTHING,
            _write_expected(foretold.get(symbol), writer),
            _write_number(value, writer),
            where(symbol),
        )
        for symbol, value in after.items()
    )
    columns = (
        Column(say(_SYMBOL)),
        Column(say(_PARAMETER)),
        Column(say(_BEFORE), unit.symbol, Align.RIGHT),
        Column(say(Words("Forecast, 95 %")), unit.symbol, Align.RIGHT),
        Column(say(_SECOND_TEST), unit.symbol, Align.RIGHT),
        Column(""),
    )
    return Section(
        "confirmation",
        say(_SECOND_TEST),
        (
            Paragraph(say(CONFIRMED[found.verdict]), Mark.MET if is_held else Mark.NOT_MET),
            *(Paragraph(say(each)) for each in sentences),
            Table(say(_SECOND_TEST), columns, (RowGroup(rows),)),
        ),
    )


def _list_settings(found: Confirmation, made: Made, writer: Writer) -> Iterator[Words]:
    """Yield how well the verdict fits, and what is to be entered in the control."""
    verdict, unit, rows = found.verdict, writer.deviation_unit, made.decoded

    def amount(value: float) -> str:
        return with_unit(_write_number(unit.from_si(value), writer), unit.symbol)

    if verdict in {ConfirmationVerdict.HELD, ConfirmationVerdict.OTHER}:
        return
    yield _FITS.given(rest=amount(found.rest), left=amount(found.left))
    if verdict is ConfirmationVerdict.SHIFTED:
        first = float(rows.positions[0])
        lengths = (found.shift, float(np.median(np.diff(rows.positions))), first - found.shift, first)
        names = ("length", "step", "start", "first")
        yield _SHIFTED.given(**{
            name: _write_length(each, writer) for name, each in zip(names, lengths, strict=True)
        })  # fmt: skip
    elif verdict is ConfirmationVerdict.NOT_IN_EFFECT:
        yield from made.controller.notes
    elif made.forecast.play and verdict in {ConfirmationVerdict.PLAY_TURNED, ConfirmationVerdict.PLAY_TWICE}:
        yield _ENTER_PLAY.given(play=amount(made.forecast.play))
    else:
        play = float(np.mean(rows.forward - rows.reverse))
        yield _ENTER[verdict].given(play=amount(play))


def say_adjustment(made: Made) -> Words:
    """Return what was done to the axis between a test and one with its table."""
    return _ADJUSTMENT.given(rows=len(made.decoded.positions), control=made.controller.title)


def _write_expected(expected: ExpectedFigure | None, writer: Writer) -> str:
    """Return from where to where a parameter of a second test is expected."""
    if expected is None:
        return NOTHING
    factor = writer.deviation_unit.from_si(1.0)
    return " … ".join(_write_number(each * factor, writer) for each in (expected.low, expected.high))


def _write_with_u(value: float, expanded: float | None, writer: Writer) -> str:
    text = _write_number(value, writer)
    return text if expanded is None else f"{text} ± {_write_number(expanded, writer)}"


def _list_table_remarks(made: Made, writer: Writer) -> Iterator[Words]:
    """Yield what is to be known of a table: between its rows, left out, constants, play that is left."""
    found, unit = made.forecast, writer.deviation_unit

    def amount(value: float) -> str:
        return with_unit(_write_number(unit.from_si(value), writer), unit.symbol)

    yield _describe_grid(made, writer, amount)
    if made.grid.allowed:
        yield _ALLOWED.given(allowed=amount(made.grid.allowed))
    if not made.basis.is_known_between:
        yield _UNKNOWN_BETWEEN
    yield from _list_ends(made, writer, amount)
    if _find_constant(made):
        yield Words(
            "The control's table is zero at the reference point: a constant of {constant} was taken out."
        ).given(constant=amount(-found.constant))
    if found.play:
        yield Words(
            "The table has one column: the mean lost motion, {play} (forward − reverse), is left to the "
            "control's backlash parameter. With that E is {error}."
        ).given(play=amount(found.play), error=amount(found.after_with_backlash.systematic))
    yield (_LEFT if unit.from_si(found.between) >= _LEAST_WRITTEN / 2 else _LITTLE_LEFT).given(
        rows=len(made.decoded.positions),
        between=amount(max(found.between, unit.to_si(_LEAST_WRITTEN))),
        at=_write_length(found.between_at, writer),
        rounding=amount(found.rounding),
    )
    if made.left_out:
        names = ", ".join(f"{name} ({_write_length(wave, writer)})" for name, wave in made.left_out)
        yield Words("Left out, for no row carries it: {names}. It stays, with up to {error}.").given(
            names=names, error=amount(found.left_out)
        )
    if found.second_test:
        yield _BOTH_SET_UPS if found.has_set_up else _SCATTER_ALONE


def _list_ends(made: Made, writer: Writer, amount: Callable[[float], str]) -> Iterator[Words]:
    """Yield that rows end before the targets or beyond, these before the axis, and what is over the turn."""
    axis, targets = made.meant.axis, made.basis.curve.positions
    first, last = (_write_length(float(targets[end]), writer) for end in (0, -1))
    rows = made.decoded.positions
    low, high = (_write_length(float(rows[end]), writer) for end in (0, -1))
    open_part = find_open_part(axis, targets)
    if open_part is not None:
        after = _write_length(float(targets[0]) + TURN, writer)
        if made.meant.is_closed:
            yield (_ONE_PLACE if last == after else _GOES_ROUND).given(first=first, last=last, after=after)
        else:
            jump = float(np.abs(made.decoded.at(targets[[0]]) - made.decoded.at(targets[[-1]])).max())
            yield _STAYS_OPEN.given(last=last, after=after, jump=amount(jump))
        return
    if rows[-1] < targets[-1] and high != last:
        yield _ENDS_BEFORE.given(row=high, target=last)
    if (rows[0] < targets[0] and low != first) or (rows[-1] > targets[-1] and high != last):
        yield _HELD_BEYOND.given(low=low, high=high)
    if axis.travel is None:
        return
    low, high = (_write_length(each, writer) for each in axis.travel)
    if (axis.travel[0] < targets[0] and low != first) or (axis.travel[1] > targets[-1] and high != last):
        yield _BEYOND_TARGETS.given(low=low, high=high)


_GOES_ROUND = Words(
    "From {last} to {after}, where the turn is closed, nothing was measured: the table goes over it in a "
    "straight line, as between two targets."
)
_ONE_PLACE = Words("{first} and {last} are one place: the table has the mean of both there.")
_STAYS_OPEN = Words(
    "From {last} to {after}, where the turn would be closed, nothing was measured, and that is further than "
    "between any two targets: the table is not closed over it. There its last value is taken to hold, and "
    "where the turn begins again it jumps by {jump}. Targets on the whole turn close it."
)
_HELD_BEYOND = Words("The rows go from {low} to {high}: beyond the targets they hold the end values.")
#: The last digit that deviations are written with, µm or ″.
_LEAST_WRITTEN = 0.01
_LEFT = Words(
    "Anywhere between the {rows} rows up to {between} are left, most at {at}; rounding takes {rounding}."
)
_LITTLE_LEFT = Words(
    "Anywhere between the {rows} rows less than {between} is left; rounding takes {rounding}."
)
_BEYOND_TARGETS = Words(
    "The axis goes from {low} to {high}: beyond the targets nothing was measured, and nothing is forecast."
)
_ALLOWED = Words("U of a mean by the scatter of the readings is {allowed} (k = 2).")
_ENDS_BEFORE = Words(
    "The rows end at {row}, the targets at {target}: beyond the last row its value is taken to hold."
)
_GRIDS = {
    GridReason.STATED: Words(
        "{rows} rows, {step} apart, as stated: the lines between them miss up to {added}."
    ),
    GridReason.TARGETS: Words("{rows} rows at the targets: the lines between them miss up to {added}."),
    GridReason.UNCERTAINTY: Words("{rows} rows, {step} apart: the lines between them miss up to {added}."),
    GridReason.CONTROL: Words(
        "{rows} rows, {step} apart: the lines between them miss up to {added}; the control takes no more "
        "rows."
    ),
    GridReason.SUPPORT: Words(
        "{rows} rows, {step} apart: the lines between them miss up to {added}; the targets support no finer "
        "rows."
    ),
}


#: Where the lines between the rows are what the table is to take away.
_GRIDS_OF_LINES = _GRIDS | {
    GridReason.STATED: Words("{rows} rows, {step} apart, as stated."),
    GridReason.TARGETS: Words("{rows} rows at the targets."),
    GridReason.UNCERTAINTY: Words("{rows} rows, {step} apart."),
}


def _describe_grid(made: Made, writer: Writer, amount: Callable[[float], str]) -> Words:
    """Return where the table has its rows, and why."""
    grid = made.grid
    return (_GRIDS if grid.added else _GRIDS_OF_LINES)[grid.reason].given(
        rows=len(grid.rows),
        step=_write_length(float(grid.rows[1] - grid.rows[0]), writer),
        added=amount(grid.added),
    )


_WORKED = Words(
    "Worked row: at {at} the axis without a table is off by {stood} (actual − target, ↑ moving forward, "
    "↓ moving back); this table takes away {taken}, which leaves {left}."
)
_WORKED_BESIDE = Words(
    "Worked row: at {at} the axis without a table is off by {stood} beside the constant that was taken out "
    "(actual − target, ↑ moving forward, ↓ moving back); this table takes away {taken}, which leaves {left}."
)


def _find_constant(made: Made) -> float:
    """Return what a control adds to the table that it was meant to hold, as some begin at zero, m or rad."""
    found = made.forecast
    return found.constant if abs(found.constant) > found.rounding else 0.0


def _list_measured_rows(made: Made) -> FloatArray:
    """Return the rows within what was measured; the targets, if none is."""
    rows, targets = made.meant.positions, made.basis.curve.positions
    if made.meant.is_closed:
        rows = np.unique(wrap(rows, float(targets[0])))
    inside = rows[(rows >= targets[0] - _NEAR) & (rows <= targets[-1] + _NEAR)]
    return read_only_floats(inside if len(inside) else targets)


def _lay_out_loading(made: Made, writer: Writer) -> tuple[Block, ...]:
    say, unit = writer.say, writer.deviation_unit
    constant = _find_constant(made)
    # what a check can see best
    places = _list_measured_rows(made)
    worst = int(np.argmax(np.abs(made.decoded.at(places).sum(axis=0))))
    at = places[worst : worst + 1]

    def both(values: FloatArray) -> str:
        up, down = (_write_signed(unit.from_si(float(each[0])), writer) for each in values)
        return f"{up} ↑, {down} ↓ {unit.symbol}"

    stood, taken = made.meant.at(at) + constant, made.decoded.at(at)
    worked = (_WORKED_BESIDE if constant else _WORKED).given(
        at=writer.length(float(at[0])), stood=both(stood), taken=both(taken), left=both(stood - taken)
    )
    return (
        Paragraph(say(worked)),
        Notice(
            say(Words("For who loads it")), (*map(say, made.controller.notes), say(_COORDINATES), say(_CHECK))
        ),
    )


def _draw_figure(made: Made, writer: Writer) -> Figure:
    """Return the picture: means and table above, what is left below; beside a constant that was taken out."""
    curve, printed = made.basis.curve, writer.deviation_unit.from_si
    targets = read_only_floats(writer.position_unit.from_si(curve.positions))
    places = made.decoded.positions
    if made.meant.is_closed:
        places = np.append(np.unique(wrap(places[:-1], float(curve.positions[0]))), curve.positions[0] + TURN)
    rows = read_only_floats(writer.position_unit.from_si(places))
    constant = _find_constant(made)
    means, rest = np.stack([curve.forward, curve.reverse]) + constant, made.forecast.left + constant
    table = made.decoded.at(places)
    if made.active is not None:
        table = table - made.active.at(places)
    directions = [each.index for each in curve.approaches]

    def curves(
        x: FloatArray, values: FloatArray, names: tuple[str, str], roles: tuple[Role, Role]
    ) -> tuple[Curve, ...]:
        return tuple(
            Curve(names[each], roles[each], x, read_only_floats(printed(values[each]))) for each in directions
        )

    measured = (Role.MEAN_POSITIVE, Role.MEAN_NEGATIVE)
    before = (
        *curves(targets, means, ("x̄↑", "x̄↓"), measured),
        *curves(rows, table, ("C↑", "C↓"), (Role.MODEL_POSITIVE, Role.MODEL_NEGATIVE)),
    )
    known = printed(made.grid.allowed)
    left = curves(targets, np.round(rest, _DIGITS_DRAWN), ("x̄↑", "x̄↓"), measured)
    beside = np.full(len(targets), known)
    band = Band("±U", Role.NOISE, targets, read_only_floats(-beside), read_only_floats(beside))
    unit = writer.deviation_unit.symbol
    words = {
        name: with_unit(_write_number(float(printed(value)), writer), unit)
        for name, value in (
            ("low", means.min()),
            ("high", means.max()),
            ("least", rest.min()),
            ("most", rest.max()),
        )
    }
    return Figure(
        key="compensation",
        title=Words("The mean deviations with the table C, and what it leaves"),
        alternative=_ALTERNATIVE.given(**words),
        x_title=POSITION_TITLE,
        y_title=DEVIATION_TITLE,
        x_unit=writer.position_unit.symbol,
        y_unit=unit,
        panels=(
            Panel(
                Words("Before, and the new table less the old one")
                if made.active
                else Words("Before, and the table"),
                curves=before,
            ),
            Panel(
                Words("With the table, and U of a mean") if known else Words("With the table"),
                bands=(band,) if known else (),
                curves=left,
            ),
        ),
        spans_are_alike=False,
    )


def _write_length(value: float, writer: Writer) -> str:
    """Write a length or an angle along the axis that was computed, to a thousandth of its unit."""
    unit = writer.position_unit
    return with_unit(writer.number(round(unit.from_si(value), 3)), unit.symbol)


def _write_number(value: float, writer: Writer) -> str:
    return write_fixed_number(value, 2, writer.language.decimal_sign)


def _write_signed(value: float, writer: Writer) -> str:
    rounded = round(value, 3)
    text = write_fixed_number(rounded, 3, writer.language.decimal_sign)
    return text if rounded < 0 else f"+{text}"
