"""Tables across axes as people read them: what they hold, which way they act, what they will leave."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from zlmreport.document.blocks import Block, Cell, Column, Notice, Paragraph, Section, Symbol
from zlmreport.language import Words
from zlmreport.machines.cross_tables import CrossForecast, CrossPlan
from zlmreport.machines.subjects.saying import Sayer, plain_table, right
from zlmreport.model.compensation.cross import CrossTable


def tables_section(
    plan: CrossPlan, written: Sequence[CrossTable], notes: Sequence[Words], say: Sayer
) -> Section:
    """Return what the tables hold as the control reads them, and what is left out."""
    rows: list[tuple[Cell, ...]] = [
        (
            each.input,
            each.output,
            say.span(float(each.positions[0]), float(each.positions[-1])),
            str(len(each.positions)),
            say.micrometres(float(np.ptp(each.values))),
        )
        for each in written
    ]
    columns = (
        Column(say(_MOVES)), Column(say(_ASIDE)), Column(say(_RANGE), "mm"), right(say(_ROWS)),
        right(say(_SPAN), "µm"),
    )  # fmt: skip
    blocks: list[Block] = [
        plain_table(say(_TABLES), columns, rows),
        Paragraph(say(_HELD.given(errors=", ".join(plan.taken)))),
    ]
    if plan.within_uncertainty:
        blocks.append(Paragraph(say(_SMALL.given(errors=", ".join(plan.within_uncertainty)))))
    blocks += [Paragraph(say(_LEFT)), Notice(say(_BEFORE_LOADING), tuple(say(each) for each in notes))]
    return Section("cross-tables", say(_TABLES), tuple(blocks))


def sign_section(moves: int, say: Sayer) -> Section:
    """Return which way a positive value acts, as it was stated, with what shows that it does."""
    return Section("sign", say(_SIGN), (Paragraph(say(_STATED[moves])), Paragraph(say(_CHECK))))


def trial_section(table: CrossTable, peak: float, say: Sayer) -> Section:
    """Return what to do with the trial file, and what its outcome says."""
    middle = float(table.positions[len(table.positions) // 2])
    said = _TRIAL.given(
        output=table.output,
        input=table.input,
        low=say.millimetres(float(table.positions[0])),
        at=say.millimetres(middle),
        peak=say.micrometres(peak),
    )
    return Section("trial", say(_TRIAL_TITLE), (Paragraph(say(said)),))


def forecast_section(found: CrossForecast, say: Sayer) -> Section:
    """Return circles, diagonals and the largest error before and after."""
    rows = list(_forecast_rows(found, say))
    columns = (Column(""), right(say(_NOW), "µm"), right(say(_WITH), "µm"))
    table = plain_table(say(_FORECAST), columns, rows)
    return Section("forecast", say(_FORECAST), (table, Paragraph(say(_NO_MEASUREMENT))))


def _forecast_rows(found: CrossForecast, say: Sayer) -> Iterator[tuple[Cell, ...]]:
    for each in found.circles:
        yield f"{each.name}, RMS", say.micrometres(each.before), say.micrometres(each.after)
        for notation, before, after in each.numbers:
            yield Symbol(notation), say.micrometres(before), say.micrometres(after)
    for name, before, after in found.diagonals:
        yield say(_DIAGONAL.given(name=name)), say.micrometres(before), say.micrometres(after)
    if found.largest:
        yield say(_LARGEST), *map(say.micrometres, found.largest)


_TABLES = Words(en="Tables across axes", de="Tabellen über Achsen hinweg")
_MOVES, _ASIDE = Words(en="moves", de="bewegt"), Words(en="is corrected", de="wird korrigiert")
_RANGE, _ROWS, _SPAN = (
    Words(en="from–to", de="von–bis"),
    Words(en="rows", de="Zeilen"),
    Words(en="span", de="Spanne"),
)
_HELD = Words(en="They hold {errors}.", de="Sie enthalten {errors}.")
_SMALL = Words(
    en="Left out, for they are no larger than their uncertainty: {errors}.",
    de="Weggelassen, weil nicht größer als ihre Unsicherheit: {errors}.",
)
_LEFT = Words(
    en="Angles and their arms are left: a table over one axis does not hold them. Positions have tables of "
    "their own: zlmreport compensate.",
    de="Winkel mit ihren Hebelarmen bleiben: Eine Tabelle über eine Achse enthält sie nicht. Positionen "
    "haben eigene Tabellen: zlmreport compensate.",
)
_BEFORE_LOADING = Words(en="Before it is loaded", de="Vor dem Laden")
_SIGN = Words(en="The sign", de="Das Vorzeichen")
_STATED = {
    1: Words(
        en="Stated: a positive value moves the axis in its positive direction. So the rows are −e.",
        de="Angegeben: Ein positiver Wert bewegt die Achse in ihre positive Richtung. Die Zeilen sind also "
        "−e.",
    ),
    -1: Words(
        en="Stated: a positive value moves the axis in its negative direction. So the rows are +e.",
        de="Angegeben: Ein positiver Wert bewegt die Achse in ihre negative Richtung. Die Zeilen sind also "
        "+e.",
    ),
}
_CHECK = Words(
    en="Load, and measure one line or circle again: the error must shrink. If it doubles, the sign is wrong.",
    de="Laden und eine Linie oder einen Kreis erneut messen: Die Abweichung muss kleiner werden. Verdoppelt "
    "sie sich, ist das Vorzeichen falsch.",
)
_TRIAL_TITLE = Words(en="A trial value", de="Ein Probewert")
_TRIAL = Words(
    en="The file holds nothing of the machine: only +{peak} µm for {output} at {input} {at} mm, and zero at "
    "both ends. Load it with the axes clear, set an indicator against {output}, and move {input} from {low} "
    "to {at} mm. If {output} goes in its positive direction, state --moves plus, else --moves minus; then "
    "remove the file.",
    de="Die Datei enthält nichts von der Maschine: nur +{peak} µm für {output} bei {input} {at} mm, und "
    "null an beiden Enden. Bei freien Achsen laden, einen Messtaster an {output} setzen und {input} von "
    "{low} nach {at} mm fahren. Geht {output} in die positive Richtung, gilt --moves plus, sonst --moves "
    "minus; danach die Datei entfernen.",
)
_FORECAST = Words(en="Forecast", de="Vorhersage")
_NOW, _WITH = Words(en="now", de="jetzt"), Words(en="with the tables", de="mit den Tabellen")
_DIAGONAL = Words(en="diagonal {name}, E, predicted", de="Diagonale {name}, E, vorhergesagt")
_LARGEST = Words(
    en="largest error of the work space, predicted", de="größte Abweichung im Arbeitsraum, vorhergesagt"
)
_NO_MEASUREMENT = Words(
    en="A forecast is no measurement: run the circle again with the tables in effect.",
    de="Eine Vorhersage ist keine Messung: Fahren Sie den Kreis mit wirksamen Tabellen erneut.",
)
