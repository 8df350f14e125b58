"""The annex on the error model: what the laboratory thinks the deviations come from.

An opinion, and marked as one (ISO/IEC 17025:2017, 7.8.7): it stands on pages of its own, after all results.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from zlmreport.certificate.document import (
    Align,
    Block,
    Cell,
    Column,
    Explained,
    Facts,
    Formulas,
    Graph,
    Notice,
    Paragraph,
    RowGroup,
    Section,
    Symbol,
    Table,
)
from zlmreport.certificate.linked import Linked, linked
from zlmreport.certificate.statements import OPINION
from zlmreport.figures.model_diagram import ModelDiagram, estimate
from zlmreport.figures.model_residuals import (
    fall_chart,
    over_condition,
    over_position,
    over_run,
    over_time,
    slopes_over_time,
)
from zlmreport.language import Words
from zlmreport.model import wording
from zlmreport.model.diagnosis import Diagnosis, Verdict
from zlmreport.model.estimate import Plausibility
from zlmreport.model.residuals import Failure, ResidualTest
from zlmreport.presenting.diagnosis import DiagnosisRows
from zlmreport.presenting.model import (
    ErrorRows,
    ParameterRow,
    deviation,
    no_table_takes_away,
    parameter_rows,
    wave_rows,
)
from zlmreport.presenting.writer import NOTHING, Writer
from zlmreport.quantities.formatting import percentage

if TYPE_CHECKING:
    from zlmreport.certificate.forecast import Forecast
    from zlmreport.figures.figure import Figure
    from zlmreport.model.design import Design
    from zlmreport.model.study import Fitted, Study
    from zlmreport.model.visibility import Visibility
    from zlmreport.planning.experiment import Experiment
    from zlmreport.presenting.diagnosis import CandidateRow
    from zlmreport.presenting.writer import Writer

_KEY = "model"
_TITLE = Words(
    en="Annex: error model – opinion and interpretation",
    de="Anhang: Fehlermodell – Meinung und Interpretation",
)
_BASIS = Words(
    en="It rests on the readings of this document alone: a model of physical effects was fitted to them. "
    "What the model explains is not proved to be the cause.",
    de="Sie beruht allein auf den Messwerten dieses Dokuments: An sie wurde ein Modell physikalischer "
    "Einflüsse angepasst. Was das Modell erklärt, ist damit nicht als Ursache bewiesen.",
)
_SYMBOLS = Words(
    en="P: target position; d: +1 approaching in the positive direction, −1 in the negative; t: time; s: "
    "distance since the last reversal; ΔT: temperature less 20 °C; the other symbols are parameters.",
    de="P: Sollposition; d: +1 beim Anfahren in positiver, −1 in negativer Richtung; t: Zeit; s: Weg seit "
    "der letzten Umkehr; ΔT: Temperatur minus 20 °C; die übrigen Zeichen sind Parameter.",
)
_FAILED = Words(en="Where the model fails", de="Wo das Modell versagt")
_NO_FAILURE = Words(
    en="No test of the residuals fails: not that of the means against the repeats, nor those over direction, "
    "run, time and the logged conditions.",
    de="Keine Prüfung der Residuen schlägt an: weder die der Mittelwerte gegen die Wiederholungen noch die "
    "über Richtung, Durchlauf, Zeit und die aufgezeichneten Bedingungen.",
)
_NOT_TRIED = Words(
    en="Effects that this test could not try", de="Einflüsse, die mit dieser Messung nicht prüfbar sind"
)
_REMEDY = Words(en="What to do if this is the cause", de="Was zu tun ist, wenn dies die Ursache ist")
_EXPERIMENT = Words(en="The next experiment", de="Der nächste Versuch")
_NOT_EXCLUDED = Words(
    en="Not excluded, for this test could not try them: {effects}.",
    de="Nicht ausgeschlossen, weil mit dieser Messung nicht prüfbar: {effects}.",
)
_ASSUMED = Words(en="Taken for granted", de="Angenommen")
_EFFECT = Words(en="Effect", de="Einfluss")
_OF_GRID = Words(en="{half_width} (grid)", de="{half_width} (Raster)")
_PLAUSIBILITY = {
    Plausibility.PLAUSIBLE: Words(en="yes", de="ja"),
    Plausibility.DOUBTFUL: Words(en="doubtful", de="zweifelhaft"),
    Plausibility.IMPLAUSIBLE: Words(en="no", de="nein"),
    Plausibility.UNKNOWN: Words(en=NOTHING, de=NOTHING),
}


@dataclass(frozen=True, slots=True)
class Modelled:
    """The error model of a job, studied."""

    history: tuple[Fitted, ...]  #: Its fits, effect by effect; the first without any.
    diagnosis: Diagnosis  #: What it lacks.
    forecasts: tuple[Forecast, ...]  #: What each standard would say of a corrected axis.
    titles: Mapping[str, Words]  #: What all installed effects are called, by identifier.
    study: Study  #: The model and the readings that it was held against.
    experiment: Experiment | None = None  #: What to measure next; None where nothing is to be decided.


def section(modelled: Modelled, writer: Writer) -> Section:
    """Return the annex."""
    diagnosis, whole = modelled.diagnosis, modelled.history[-1]
    rows = DiagnosisRows.of(diagnosis, writer.language, modelled.titles)
    moving = no_table_takes_away(whole.fit, writer.language)
    tables = ModelTables(writer, whole.fit.design, modelled.titles)
    diagram = ModelDiagram(whole.fit.of_the_job, whole.error)
    blocks: list[Block] = [
        Notice(writer.say(OPINION), (writer.say(_BASIS),)),
        Paragraph(rows.statement),
        _error(whole, writer),
        tables.equations(whole),
        Paragraph(writer.say(_SYMBOLS)),
        *([Notice(writer.say(_ASSUMED), rows.remarks)] if rows.remarks else []),
        tables.parameters(whole),
        Graph(over_position(diagram)),
        Graph(estimate(diagram)),
        Graph(fall_chart(modelled.history, next(iter(diagnosis.candidates), None))),
        tables.history(modelled.history, modelled.forecasts[0]),
        tables.compensation(modelled.forecasts),
        *([Paragraph(moving)] if moving else []),
        *_failures(rows, diagram, writer),
    ]
    if diagnosis.verdict is not Verdict.ADEQUATE and diagnosis.candidates:
        blocks += [tables.candidates(rows.candidates), *_what_to_do(rows, modelled, writer)]
    if rows.not_tested:
        not_tried = (f"{', '.join(each.effects)}: {each.reason}" for each in rows.not_tested)
        blocks.append(Notice(writer.say(_NOT_TRIED), tuple(not_tried)))
    # A table at the end: no page holds notes alone.
    blocks.append(tables.visibility(diagnosis.visibility))
    return Section(_KEY, writer.say(_TITLE), tuple(blocks))


def linked_graphs(modelled: Modelled, writer: Writer) -> Linked:
    """Return the annex's graphs as values, for documents in which readings can be pointed at."""
    return linked(_KEY, modelled.study, modelled.history[-1], modelled.diagnosis, writer.language)


def _what_to_do(rows: DiagnosisRows, modelled: Modelled, writer: Writer) -> Iterator[Block]:
    """Yield the remedies of the leading candidates and what they are taken for, and the next experiment."""
    if rows.not_excluded:
        yield Paragraph(writer.say(_NOT_EXCLUDED.given(effects=", ".join(rows.not_excluded))))
    items = tuple(f"{each.effect}: {each.remedy}" for each in rows.leading if each.remedy)
    if items:
        yield Notice(writer.say(_REMEDY), items)
    if modelled.experiment:
        yield Notice(writer.say(_EXPERIMENT), (writer.say(modelled.experiment.statement),))


def _error(whole: Fitted, writer: Writer) -> Facts:
    rows = ErrorRows.of(whole.error, whole.fit.design.axis, writer.language)
    return Facts(rows.named, writer.say(Words(en="Error of the model", de="Abweichung des Modells")))


def _failures(rows: DiagnosisRows, diagram: ModelDiagram, writer: Writer) -> Iterator[Block]:
    """Yield what the residuals do, and the graphs that show it."""
    if not rows.failures:
        yield Paragraph(writer.say(_NO_FAILURE))
        return
    items = (f"{each.statement} ({each.where})" for each in rows.failures)
    yield Notice(writer.say(_FAILED), tuple(items))
    yield from map(Graph, _graphs([each.failure for each in rows.failures], diagram))


def _graphs(failures: Sequence[Failure], diagram: ModelDiagram) -> Iterator[Figure]:
    """Yield the residuals over whatever a failed test is about; those over the position stand above."""
    failed = {failure.test for failure in failures}
    if ResidualTest.RUNS in failed:
        yield over_run(diagram)
    if failed & {ResidualTest.TIME_ORDER, ResidualTest.PERIOD_IN_TIME}:
        yield over_time(diagram)
        yield slopes_over_time(diagram)
    yield from (over_condition(diagram, each.condition) for each in failures if each.condition)


@dataclass(frozen=True, slots=True)
class ModelTables:
    """Writes the tables of one model."""

    writer: Writer  #: Of the document.
    design: Design  #: The test.
    titles: Mapping[str, Words]  #: What effects are called, by identifier.

    def equations(self, fitted: Fitted) -> Formulas:
        """Return the model: the deviation as a sum of effects."""
        caption = Words(
            en="The model: the deviation x is the sum of these effects",
            de="Das Modell: Die Abweichung x ist die Summe dieser Einflüsse",
        )
        return Formulas(
            self.writer.say(caption),
            tuple(
                (
                    Symbol(term.effect.identifier),
                    Symbol(term.effect.equation),
                    self.writer.say(term.effect.title),
                )
                for term in fitted.fit.model.terms
            ),
        )

    def parameters(self, fitted: Fitted) -> Table:
        """Return the parameters of the model with their expanded uncertainties."""
        say = self.writer.say
        caption = Words(
            en="Parameters of the model with expanded uncertainty U (coverage probability about 95 %). "
            "Grid: one of the values that were tried, with the half-width of the interval that holds it. "
            "Plausible: within what is usual for the effect",
            de="Parameter des Modells mit erweiterter Messunsicherheit U (Überdeckungswahrscheinlichkeit "
            "etwa 95 %). Raster: einer der geprüften Werte, mit der halben Weite des Intervalls, in dem er "
            "liegt. Plausibel: im Bereich des für den Einfluss Üblichen",
        )
        columns = (
            Column(say(Words(en="Symbol", de="Zeichen"))),
            Column(say(Words(en="Parameter", de="Parameter"))),
            Column(say(Words(en="Value", de="Wert")), align=Align.RIGHT),
            Column("U", align=Align.RIGHT),
            Column(say(Words(en="Unit", de="Einheit"))),
            Column(say(Words(en="Plausible", de="Plausibel"))),
        )
        language = self.writer.language
        rows = [
            *parameter_rows(fitted.fit, language),
            *(row for each in wave_rows(fitted.fit, language) for row in (each.amplitude, each.phase)),
        ]
        groups = tuple(
            RowGroup(
                tuple(self._parameter(each) for each in rows if each.effect == identifier),
                f"{identifier}: {say(term.effect.title)}",
            )
            for term in fitted.fit.model.terms
            for identifier in (term.effect.identifier,)
        )
        return Table(say(caption), columns, groups)

    def history(self, history: Sequence[Fitted], forecast: Forecast) -> Table:
        """Return how the error fell, effect by effect, and what a standard would say after each."""
        say, unit = self.writer.say, self.writer.deviation_unit.symbol
        caption = Words(
            en="How the error falls, effect by effect; the parameters of {designation} are predicted for an "
            "axis whose control corrects all effects down to the row",
            de="Wie die Abweichung sinkt, Einfluss für Einfluss; die Kenngrößen nach {designation} sind für "
            "eine Achse vorhergesagt, deren Steuerung alle Einflüsse bis zu dieser Zeile korrigiert",
        ).given(designation=forecast.designation)
        columns = [
            Column(say(_EFFECT)),
            Column(say(Words(en="RMS error", de="Quadr. Mittel")), unit, Align.RIGHT),
            Column("χ²/ν", align=Align.RIGHT),
            Column(say(Words(en="Cross-validated", de="Kreuzvalidiert")), unit, Align.RIGHT),
        ]
        columns += [Column(Symbol(quantity.notation), unit, Align.RIGHT) for quantity in forecast.quantities]
        names = [
            say(Words(en="without model", de="ohne Modell")),
            *(f"+ {name}" for name in history[-1].fit.model.identifiers),
        ]
        rows = tuple(
            (
                name,
                self._deviation(each.error.rms),
                self._number(each.error.chi2_per_dof),
                self._deviation(each.error.cross_validated_rms),
                *(self.writer.deviation(float(value)) for value in forecast.by_step[index]),
            )
            for index, (name, each) in enumerate(zip(names, history, strict=True))
        )
        floor = history[-1].error.noise_rms
        noise = say(Words(en="noise floor", de="Grundrauschen"))
        blank = ("",) * (len(columns) - 2)
        last = () if floor is None else ((noise, self._deviation(floor), *blank),)
        return Table(say(caption), tuple(columns), (RowGroup((*rows, *last)),))

    def compensation(self, forecasts: Sequence[Forecast]) -> Table:
        """Return what a compensation would leave of the leading parameters of each standard."""
        say, unit = self.writer.say, self.writer.deviation_unit.symbol
        caption = Words(
            en="Predicted errors after compensation, from the readings of this document",
            de="Was eine Kompensation übrig ließe, vorhergesagt aus den Messwerten dieses Dokuments",
        )
        columns = (
            Column(say(Words(en="Symbol", de="Zeichen"))),
            Column(say(Words(en="Parameter", de="Kenngröße"))),
            Column(say(Words(en="Measured", de="Gemessen")), unit, Align.RIGHT),
            Column(say(Words(en="Table of positions", de="Positionstabelle")), unit, Align.RIGHT),
            Column(say(Words(en="Whole model", de="Ganzes Modell")), unit, Align.RIGHT),
        )
        groups = tuple(
            RowGroup(
                tuple(
                    (
                        Symbol(quantity.notation),
                        say(quantity.name),
                        *map(self.writer.deviation, map(float, values)),
                    )
                    for quantity, *values in zip(
                        forecast.quantities,
                        forecast.by_step[0],
                        forecast.by_table,
                        forecast.by_step[-1],
                        strict=True,
                    )
                ),
                forecast.designation,
            )
            for forecast in forecasts
        )
        return Table(say(caption), columns, groups)

    def candidates(self, candidates: Sequence[CandidateRow]) -> Table:
        """Return the effects that the model may lack, best first."""
        say, unit = self.writer.say, self.writer.deviation_unit.symbol
        caption = Words(
            en="Effects that the model may lack, with their probabilities among all that were tried",
            de="Einflüsse, die dem Modell fehlen können, mit ihrer Wahrscheinlichkeit unter allen geprüften",
        )
        columns = (
            Column(say(_EFFECT)),
            Column(say(Words(en="Probability", de="Wahrscheinlichkeit")), "%", Align.RIGHT),
            Column(say(Words(en="RMS after", de="Quadr. Mittel danach")), unit, Align.RIGHT),
            Column(say(Words(en="Not to be told from", de="Nicht zu unterscheiden von"))),
            Column(say(Words(en="Told apart by", de="Zu unterscheiden durch"))),
        )
        rows = tuple(
            (
                Explained(each.effect, each.title),
                each.probability,
                each.rms,
                ", ".join(each.equals) or NOTHING,
                each.tell_apart_by or NOTHING,
            )
            for each in candidates
            if each.is_serious
        )
        return Table(say(caption), columns, (RowGroup(rows),))

    def visibility(self, visible: Sequence[Visibility]) -> Table:
        """Return how much of each effect the plan of the test can see, the best hidden first."""
        say, unit = self.writer.say, self.writer.deviation_unit.symbol
        caption = Words(
            en="What the plan of this test can see of effects that are not in the model: the share that the "
            "model does not imitate, and the smallest effect that is found half of the time (root mean "
            "square over all readings)",
            de="Was der Plan dieser Messung von Einflüssen sieht, die nicht im Modell stehen: der Anteil, "
            "den das Modell nicht nachahmt, und der kleinste Einfluss, der in der Hälfte der Fälle gefunden "
            "wird (quadratischer Mittelwert über alle Messwerte)",
        )
        columns = (
            Column(say(_EFFECT)),
            Column(say(Words(en="Title", de="Bezeichnung"))),
            Column(say(Words(en="Visible", de="Sichtbar")), "%", Align.RIGHT),
            Column(say(Words(en="Found from", de="Gefunden ab")), unit, Align.RIGHT),
        )
        rows = tuple(
            (
                each.effect,
                say(self.titles[each.effect]),
                percentage(each.share, self.writer.language.decimal_sign),
                self._deviation(each.smallest_rms),
            )
            for each in sorted(visible, key=lambda each: (each.share, each.effect))
        )
        return Table(say(caption), columns, (RowGroup(rows),), dense=True)

    def _parameter(self, row: ParameterRow) -> tuple[Cell, ...]:
        uncertainty = row.uncertainty
        if row.is_given:
            uncertainty = self.writer.say(Words(en="given", de="vorgegeben"))
        elif row.at_bound:
            uncertainty = self.writer.say(Words(en="held at bound", de="an der Grenze"))
        elif row.is_on_grid:
            uncertainty = self.writer.say(_OF_GRID.given(half_width=uncertainty))
        plausible = self.writer.say(_PLAUSIBILITY[row.plausibility])
        return Symbol(row.notation), row.description, row.value, uncertainty, row.unit, plausible

    def _deviation(self, value: float | None) -> str:
        return deviation(value, self.design.axis, self.writer.language)

    def _number(self, value: float | None) -> str:
        return NOTHING if value is None else self.writer.say(wording.significant(value))
