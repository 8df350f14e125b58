"""The tables of the annex on the error model: parameters, history, candidates, visibility."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from zlmreport.certificate.document import Align, Cell, Column, Explained, Formulas, RowGroup, Symbol, Table
from zlmreport.language import Words
from zlmreport.model import wording
from zlmreport.model.estimate import Plausibility
from zlmreport.presenting.model import ParameterRow, deviation, parameter_rows, wave_rows
from zlmreport.presenting.writer import NOTHING, Writer
from zlmreport.quantities.formatting import percentage

if TYPE_CHECKING:
    from zlmreport.certificate.forecast import Forecast
    from zlmreport.model.design import Design
    from zlmreport.model.study import Fitted
    from zlmreport.model.visibility import Visibility
    from zlmreport.presenting.diagnosis import CandidateRow

_EFFECT = Words(en="Effect", de="Einfluss")
_OF_GRID = Words(en="{half_width} (grid)", de="{half_width} (Raster)")
_PLAUSIBILITY = {
    Plausibility.PLAUSIBLE: Words(en="yes", de="ja"),
    Plausibility.DOUBTFUL: Words(en="doubtful", de="zweifelhaft"),
    Plausibility.IMPLAUSIBLE: Words(en="no", de="nein"),
    Plausibility.UNKNOWN: Words(en=NOTHING, de=NOTHING),
}


@dataclass(frozen=True, slots=True)
class ModelTables:
    """Writes the tables of one model.

    Attributes
    ----------
    writer
        Of the document.
    design
        The test.
    titles
        What effects are called, by identifier.
    """

    writer: Writer
    design: Design
    titles: Mapping[str, Words]

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
        names = [say(Words(en="without model", de="ohne Modell")), *_identifiers(history)]
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
            en="What a compensation would leave, predicted from the readings of this document",
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
        elif row.is_on_grid:
            uncertainty = self.writer.say(_OF_GRID.given(half_width=uncertainty))
        plausible = self.writer.say(_PLAUSIBILITY[row.plausibility])
        return Symbol(row.notation), row.description, row.value, uncertainty, row.unit, plausible

    def _deviation(self, value: float | None) -> str:
        return deviation(value, self.design.axis, self.writer.language)

    def _number(self, value: float | None) -> str:
        return NOTHING if value is None else self.writer.say(wording.significant(value))


def _identifiers(history: Sequence[Fitted]) -> list[str]:
    return [f"+ {name}" for name in history[-1].fit.model.identifiers]
