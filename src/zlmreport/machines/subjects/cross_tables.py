"""Tables across axes as people read them: what they hold, which way they act, what they will leave."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from zlmreport.document.blocks import Block, Cell, Column, Notice, Paragraph, Section, Symbol
from zlmreport.language import Words, join_parts, list_in_words
from zlmreport.language.formatting import round_pair
from zlmreport.machines.cross_confirmation import CrossConfirmation, CrossVerdict
from zlmreport.machines.cross_making import PEAK, CrossMade
from zlmreport.machines.cross_tables import CrossForecast, forecast, plan_worthwhile
from zlmreport.machines.reading import MachineFile
from zlmreport.machines.subjects.saying import Sayer, make_plain_table, make_right_column
from zlmreport.model.compensation.curve import CrossTable
from zlmreport.plugin.registry import Registry

#: A part of tables is told to no more than this.
_FINEST = 0.01


def lay_out_cross(made: CrossMade, say: Sayer) -> list[Section]:
    """Return what the tables hold, which way they act where that was stated, and what they will leave."""
    sign = [_lay_out_sign(made.moves, say)] if made.control.cross_sign == "stated" else []
    return [_lay_out_tables(made, say), *sign, _lay_out_forecast(made.forecast, say)]


def _lay_out_tables(made: CrossMade, say: Sayer) -> Section:
    """Return what the tables hold as the control reads them, and what is left out."""
    plan = made.plan
    rows: list[tuple[Cell, ...]] = [
        (
            each.input,
            each.output,
            say.write_span(float(each.positions[0]), float(each.positions[-1])),
            str(len(each.positions)),
            say.write_micrometres(float(np.ptp(each.values))),
        )
        for each in made.decoded
    ]
    columns = (
        Column(say(_MOVES)), Column(say(_ASIDE)), Column(say(_RANGE), "mm"), make_right_column(say(_ROWS)),
        make_right_column(say(_SPAN), "µm"),
    )  # fmt: skip
    blocks: list[Block] = [
        make_plain_table(say(TABLES), columns, rows),
        Paragraph(say(_HELD.given(errors=list_in_words(made.held)))),
    ]
    if plan.within_uncertainty:
        blocks.append(Paragraph(say(_SMALL.given(errors=", ".join(plan.within_uncertainty)))))
    blocks += [Paragraph(say(_LEFT)), Notice(say(_BEFORE_LOADING), tuple(map(say, made.control.cross_notes)))]
    return Section("cross-tables", say(TABLES), tuple(blocks))


def lay_out_promised(machine: MachineFile, registry: Registry, say: Sayer) -> Section | None:
    """Return what tables across axes would leave, whatever the control; None where nothing is worth one."""
    plan = plan_worthwhile(machine.machine)
    if plan is None:
        return None
    found = forecast(machine.machine, plan.tables, machine.measured, registry)
    blocks: list[Block] = [Paragraph(say(_WOULD_HOLD.given(errors=list_in_words(plan.taken))))]
    if plan.within_uncertainty:
        blocks.append(Paragraph(say(_SMALL.given(errors=", ".join(plan.within_uncertainty)))))
    return Section("cross-tables", say(_PROMISED), (*blocks, *_lay_out_forecast(found, say).blocks))


def say_promised(machine: MachineFile, registry: Registry, say: Sayer) -> Paragraph | None:
    """Return the same in a sentence, for a page without room; None where nothing is worth a table."""
    plan = plan_worthwhile(machine.machine)
    if plan is None:
        return None
    found = forecast(machine.machine, plan.tables, machine.measured, registry)
    sizes = [(f"{each.name}, RMS", each.before, each.after) for each in found.circles]
    if found.largest:
        sizes.append((say(_LARGEST), *found.largest))
    told = (
        f"{name} {say.write_micrometres(before)} → {say.write_micrometres(after)} µm"
        for name, before, after in sizes
    )
    left = join_parts(told, say.language)
    return Paragraph(say(_BRIEFLY.given(errors=list_in_words(plan.taken), left=left)))


def _lay_out_sign(moves: int, say: Sayer) -> Section:
    """Return which way a positive value acts, as it was stated, with what shows that it does."""
    return Section("sign", say(_SIGN), (Paragraph(say(_STATED[moves])), Paragraph(say(_CHECK))))


def lay_out_trial(table: CrossTable, say: Sayer) -> Section:
    """Return what to do with the trial file, and what its outcome says."""
    middle = float(table.positions[len(table.positions) // 2])
    said = _TRIAL.given(
        output=table.output,
        input=table.input,
        low=say.write_millimetres(float(table.positions[0])),
        at=say.write_millimetres(middle),
        peak=say.write_micrometres(PEAK),
    )
    return Section("trial", say(Words("A trial value")), (Paragraph(say(said)),))


def _lay_out_forecast(found: CrossForecast, say: Sayer) -> Section:
    """Return circles, diagonals and the largest error before and after."""
    rows = list(_forecast_rows(found, say))
    columns = (Column(""), make_right_column(say(_NOW), "µm"), make_right_column(say(_WITH), "µm"))
    table = make_plain_table(say(_FORECAST), columns, rows)
    return Section("forecast", say(_FORECAST), (table, Paragraph(say(_NO_MEASUREMENT))))


def lay_out_confirmation(found: CrossConfirmation, say: Sayer) -> Section:
    """Return what became of tables by circles that were run again."""
    verdict = found.verdict
    said = _BECAME[verdict]
    if verdict is not CrossVerdict.NOT_SEEN:
        u_shown = max(found.expanded_uncertainty, _FINEST)
        part, u = round_pair(found.applied, u_shown, say.language.decimal_sign)
        said = said.given(part=part, u=u)
    rows = [
        (each.name, *map(say.write_micrometres, (each.before, each.forecast, each.after)))
        for each in found.circles
    ]
    columns = (
        Column(say(_CIRCLE)), make_right_column(say(_BEFORE), "µm"), make_right_column(say(_EXPECTED), "µm"),
        make_right_column(say(_AFTER), "µm"),
    )  # fmt: skip
    return Section(
        "confirmation",
        say(_CONFIRMATION),
        (Paragraph(say(said)), make_plain_table(say(_ROUND), columns, rows)),
    )


def _forecast_rows(found: CrossForecast, say: Sayer) -> Iterator[tuple[Cell, ...]]:
    for each in found.circles:
        yield f"{each.name}, RMS", say.write_micrometres(each.before), say.write_micrometres(each.after)
        for notation, before, after in each.numbers:
            yield Symbol(notation), say.write_micrometres(before), say.write_micrometres(after)
    for name, before, after in found.diagonals:
        yield say(_DIAGONAL.given(name=name)), say.write_micrometres(before), say.write_micrometres(after)
    if found.largest:
        yield say(_LARGEST), *map(say.write_micrometres, found.largest)


TABLES = Words("Tables across axes")
_MOVES, _ASIDE = Words("moves"), Words("is corrected")
_RANGE, _ROWS, _SPAN = (
    Words("from–to"),
    Words("rows"),
    Words("span"),
)
_PROMISED = Words("What tables across axes would leave")
_WOULD_HOLD = Words(
    "A control that moves one axis aside while another moves could take away {errors}; zlmreport machine "
    "compensate writes such tables."
)
_BRIEFLY = Words(
    "Tables across axes that take away {errors} would leave: {left}. A forecast is no measurement."
)
_HELD = Words("They hold {errors}.")
_SMALL = Words("Left out, for they are no larger than their uncertainty: {errors}.")
_LEFT = Words(
    "Angles and their arms are left: a table over one axis does not hold them. Positions have tables of "
    "their own: zlmreport compensate."
)
_BEFORE_LOADING = Words("Before it is loaded")
_SIGN = Words("The sign")
_STATED = {
    1: Words("Stated: a positive value moves the axis in its positive direction. So the rows are −e."),
    -1: Words("Stated: a positive value moves the axis in its negative direction. So the rows are +e."),
}
_CHECK = Words(
    "Load, and measure one line or circle again: the error must shrink. If it doubles, the sign is wrong."
)
_TRIAL = Words(
    "The file holds nothing of the machine: only +{peak} µm for {output} at {input} {at} mm, and zero at "
    "both ends. Load it with the axes clear, set an indicator against {output}, and move {input} from {low} "
    "to {at} mm. If {output} goes in its positive direction, a positive value moves an axis so (moves plus), "
    "else the other way (moves minus). State that, and remove the file."
)
_FORECAST = Words("Forecast")
_NOW, _WITH = Words("now"), Words("with the tables")
_DIAGONAL = Words("diagonal {name}, E, predicted")
_LARGEST = Words("largest error of the work space, predicted")
_NO_MEASUREMENT = Words("A forecast is no measurement: run the circle again with the tables in effect.")
_CONFIRMATION, _ROUND = Words("Confirmation"), Words("Root mean squares about the centre")
_CIRCLE, _BEFORE, _EXPECTED, _AFTER = Words("Circle"), Words("before"), Words("forecast"), Words("after")
_BECAME = {
    CrossVerdict.HELD: Words("Held: the circles show {part} ± {u} of the tables in effect."),
    CrossVerdict.WRONG_SIGN: Words(
        "Wrong sign: the circles show {part} ± {u} of the tables. State the other way for moves, and write "
        "them again."
    ),
    CrossVerdict.HALF: Words(
        "Half: the circles show {part} ± {u} of the tables. The control halves them, or reads other units."
    ),
    CrossVerdict.NOT_IN_EFFECT: Words(
        "Not in effect: the circles show {part} ± {u} of the tables. Were they loaded and switched on?"
    ),
    CrossVerdict.OTHER: Words(
        "Not as forecast: the circles show {part} ± {u} of the tables. Something else has changed, too."
    ),
    CrossVerdict.NOT_SEEN: Words(
        "Not decided: these circles hardly see what the tables hold. Run one in the plane of the axes that "
        "they correct, with a larger radius."
    ),
}
