"""The annex on the error model: what the laboratory thinks the deviations come from.

An opinion, and marked as one (ISO/IEC 17025:2017, 7.8.7): it stands on pages of its own, after all results.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from zlmreport.certificate.document import Block, Facts, Graph, Notice, Paragraph, Section
from zlmreport.certificate.linked import Linked, linked
from zlmreport.certificate.model_tables import ModelTables
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
from zlmreport.model.diagnosis import Diagnosis, Verdict
from zlmreport.model.residuals import Failure, ResidualTest
from zlmreport.presenting.diagnosis import DiagnosisRows
from zlmreport.presenting.model import ErrorRows, no_table_takes_away

if TYPE_CHECKING:
    from zlmreport.certificate.forecast import Forecast
    from zlmreport.figures.figure import Figure
    from zlmreport.model.study import Fitted, Study
    from zlmreport.planning.experiment import Experiment
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


@dataclass(frozen=True, slots=True)
class Modelled:
    """The error model of a job, studied.

    Attributes
    ----------
    history
        Its fits, effect by effect; the first without any.
    diagnosis
        What it lacks.
    forecasts
        What each standard would say of a corrected axis.
    titles
        What all installed effects are called, by identifier.
    study
        The model and the readings that it was held against.
    experiment
        What to measure next; None where nothing is to be decided.
    """

    history: tuple[Fitted, ...]
    diagnosis: Diagnosis
    forecasts: tuple[Forecast, ...]
    titles: Mapping[str, Words]
    study: Study
    experiment: Experiment | None = None


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
    blocks.append(tables.visibility(diagnosis.visibility))
    if rows.not_tested:
        not_tried = (f"{', '.join(each.effects)}: {each.reason}" for each in rows.not_tested)
        blocks.append(Notice(writer.say(_NOT_TRIED), tuple(not_tried)))
    if rows.remarks:
        blocks.append(Notice(writer.say(_ASSUMED), rows.remarks))
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
