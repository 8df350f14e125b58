"""The annex on the error model: what the laboratory thinks the deviations come from.

An opinion, and marked as one (ISO/IEC 17025:2017, 7.8.7): it stands on pages of its own, after all results.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

from zlmreport.certificate.document import Block, Facts, Graph, Notice, Paragraph, Section
from zlmreport.certificate.forecast import Forecast
from zlmreport.certificate.linked import Linked, linked
from zlmreport.certificate.model_tables import ModelTables
from zlmreport.certificate.opinions import OPINION
from zlmreport.certificate.scribe import Scribe
from zlmreport.figures.figure import Figure
from zlmreport.figures.model_diagram import ModelDiagram, estimate
from zlmreport.figures.model_residuals import fall_chart, over_condition, over_position, over_run, over_time
from zlmreport.language import Language, Words
from zlmreport.model import wording
from zlmreport.model.diagnosis import Diagnosis, Verdict
from zlmreport.model.report import verdict_statement
from zlmreport.model.residuals import Failure, ResidualTest
from zlmreport.model.study import Fitted, Study, moves_with_time

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
_MOVES = Words(
    en="{effects}: not fixed in position. A table of positions leaves it; it goes away only if the control "
    "compensates it while the axis moves, or if its cause is removed.",
    de="{effects}: nicht an die Position gebunden. Eine Positionstabelle lässt das stehen; es verschwindet "
    "nur, wenn die Steuerung es während der Bewegung kompensiert oder die Ursache beseitigt wird.",
)
_FAILED = Words(en="Where the model fails", de="Wo das Modell versagt")
_FAILURE = Words(en="{statement} ({where})", de="{statement} ({where})")
_NO_FAILURE = Words(
    en="No test of the residuals fails: not that of the means against the repeats, nor those over direction, "
    "run, time and the logged conditions.",
    de="Keine Prüfung der Residuen schlägt an: weder die der Mittelwerte gegen die Wiederholungen noch die "
    "über Richtung, Durchlauf, Zeit und die aufgezeichneten Bedingungen.",
)
_NOT_TRIED = Words(
    en="Effects that this test could not try", de="Einflüsse, die mit dieser Messung nicht prüfbar sind"
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
    """

    history: tuple[Fitted, ...]
    diagnosis: Diagnosis
    forecasts: tuple[Forecast, ...]
    titles: Mapping[str, Words]
    study: Study


def section(modelled: Modelled, scribe: Scribe) -> Section:
    """Return the annex."""
    diagnosis, whole = modelled.diagnosis, modelled.history[-1]
    tables = ModelTables(scribe, whole.fit.design, modelled.titles)
    diagram = ModelDiagram(whole.fit, whole.error)
    blocks: list[Block] = [
        Notice(scribe.say(OPINION), (scribe.say(_BASIS),)),
        Paragraph(scribe.say(verdict_statement(diagnosis))),
        _error(whole, scribe),
        tables.equations(whole),
        Paragraph(scribe.say(_SYMBOLS)),
        tables.parameters(whole),
        Graph(over_position(diagram)),
        Graph(estimate(diagram)),
        Graph(fall_chart(modelled.history)),
        tables.history(modelled.history, modelled.forecasts[0]),
        tables.compensation(modelled.forecasts),
        *_moving(whole, scribe),
        *_failures(diagnosis, diagram, scribe),
    ]
    if diagnosis.verdict is not Verdict.ADEQUATE and diagnosis.candidates:
        blocks.append(tables.candidates(diagnosis))
    blocks.append(tables.visibility(diagnosis.visibility))
    not_tried = tuple(tables.not_testable(diagnosis))
    if not_tried:
        blocks.append(Notice(scribe.say(_NOT_TRIED), not_tried))
    if diagnosis.remarks:
        blocks.append(Notice(scribe.say(_ASSUMED), tuple(map(scribe.say, diagnosis.remarks))))
    return Section(_KEY, scribe.say(_TITLE), tuple(blocks), new_page=True)


def linked_graphs(modelled: Modelled, scribe: Scribe) -> Linked:
    """Return the annex's graphs as values, for documents in which readings can be pointed at."""
    return linked(_KEY, modelled.study, modelled.history[-1], modelled.diagnosis, scribe.language)


def _error(whole: Fitted, scribe: Scribe) -> Facts:
    axis, error = whole.fit.design.axis, whole.error
    pairs = [
        (Words(en="Root mean square error", de="Quadratischer Mittelwert der Abweichungen"), error.rms),
        (Words(en="Noise floor", de="Grundrauschen"), error.noise_rms),
        (
            Words(en="Runs predicted from the others", de="Durchläufe, aus den übrigen vorhergesagt"),
            error.cross_validated_rms,
        ),
    ]
    facts = [
        (scribe.say(name), scribe.say(wording.deviation(axis, value)))
        for name, value in pairs
        if value is not None
    ]
    if error.chi2_per_dof is not None:
        facts.append(("χ²/ν", scribe.say(wording.significant(error.chi2_per_dof))))
    return Facts(tuple(facts), scribe.say(Words(en="Error of the model", de="Abweichung des Modells")))


def _moving(whole: Fitted, scribe: Scribe) -> Iterator[Paragraph]:
    moving = moves_with_time(whole.fit)
    if moving:
        yield Paragraph(scribe.say(_MOVES.given(effects=", ".join(moving))))


def _failures(diagnosis: Diagnosis, diagram: ModelDiagram, scribe: Scribe) -> Iterator[Block]:
    """Yield what the residuals do, and the graphs that show it."""
    if not diagnosis.failures:
        yield Paragraph(scribe.say(_NO_FAILURE))
        return
    items = (
        scribe.say(_FAILURE.given(where=each.where, statement=each.statement)) for each in diagnosis.failures
    )
    yield Notice(scribe.say(_FAILED), tuple(items))
    yield from map(Graph, _graphs(diagnosis.failures, diagram))


def _graphs(failures: tuple[Failure, ...], diagram: ModelDiagram) -> Iterator[Figure]:
    """Yield the residuals over whatever a failed test is about; those over the position stand above."""
    failed = {failure.test for failure in failures}
    if ResidualTest.RUNS in failed:
        yield over_run(diagram)
    if failed & {ResidualTest.TIME_ORDER, ResidualTest.PERIOD_IN_TIME}:
        yield over_time(diagram)
    for failure in failures:
        if failure.test is ResidualTest.CONDITION:
            yield over_condition(diagram, failure.where.in_language(Language.ENGLISH))
