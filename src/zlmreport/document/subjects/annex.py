"""The annex of a certificate on the error model: what the laboratory thinks the deviations come from.

An opinion, and marked as one (ISO/IEC 17025:2017, 7.8.7): it stands on pages of its own, after all results.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from zlmreport.document.blocks import Block, Facts, Graph, Notice, Paragraph, Section, Table
from zlmreport.document.certificate.statements import OPINION
from zlmreport.document.figures.model_diagram import ModelDiagram, estimate
from zlmreport.document.figures.model_residuals import (
    draw_fall_chart,
    draw_over_condition,
    draw_over_position,
    draw_over_run,
    draw_over_time,
    draw_slopes_over_time,
)
from zlmreport.document.subjects.diagnosis import lay_out_diagnosis, lay_out_unseen
from zlmreport.document.subjects.fit import lay_out_equations
from zlmreport.document.subjects.forecast import lay_out_fall, lay_out_left_after_compensation
from zlmreport.document.subjects.linked import link_graphs
from zlmreport.language import Words
from zlmreport.model.diagnosis.diagnosis import DiagnosisVerdict
from zlmreport.model.diagnosis.residuals import Failure, ResidualTest

if TYPE_CHECKING:
    from zlmreport.document.certificate.document import Linked
    from zlmreport.document.figures.figure import Figure
    from zlmreport.document.subjects.forecast import StandardForecast
    from zlmreport.document.writer import Writer
    from zlmreport.measurement.measurement_set import MeasurementSet
    from zlmreport.model.diagnosis.diagnosis import AxisDiagnosis
    from zlmreport.model.diagnosis.study import Fitted, Study
    from zlmreport.model.planning.experiment import Experiment

_KEY = "model"
_TITLE = Words("Annex: error model – opinion and interpretation")
_BASIS = Words(
    "It rests on the readings of this document alone: a model of physical effects was fitted to them. "
    "What the model explains is not proved to be the cause."
)
_BASIS_AND_EARLIER = Words(
    "It rests on the readings of this document, and on what earlier tests say of scatter and of the sizes of "
    "effects: a model of physical effects was fitted to the readings. What the model explains is not proved "
    "to be the cause."
)
_SYMBOLS = Words(
    "P: target position; d: +1 approaching in the positive direction, −1 in the negative; t: time; s: "
    "distance since the last reversal; ΔT: temperature less 20 °C; the other symbols are parameters."
)
#: What an annex leaves out: effects that are hardly missing; what the table at its end shows of all effects.
_ELSEWHERE = ("improbable", "hidden")
#: Columns of tables that a page has no room for.
_TOO_WIDE = ("name", "expected", "share", "left_out", "p", "parameters", "explains")


@dataclass(frozen=True, slots=True)
class Modelled:
    """The error model of a job, studied."""

    history: tuple[Fitted, ...]  #: Its fits, effect by effect; the first without any.
    diagnosis: AxisDiagnosis  #: What it lacks.
    forecasts: tuple[
        StandardForecast, ...
    ]  #: What each standard would say of a corrected axis, if one can be.
    titles: Mapping[str, Words]  #: What all installed effects are called, by identifier.
    study: Study  #: The model and the readings that it was held against.
    experiment: Experiment | None = None  #: What to measure next; None where nothing is to be decided.

    @property
    def sessions(self) -> tuple[MeasurementSet, ...]:
        """Other tests that the model was held against."""
        return self.study.sessions

    def lay_out_section(self, writer: Writer) -> Section:
        """Return the annex."""
        blocks = _lay_out_blocks(self, writer)
        narrow = (each.without(*_TOO_WIDE) if isinstance(each, Table) else each for each in blocks)
        return Section(_KEY, writer.say(_TITLE), tuple(narrow))

    def list_linked(self, writer: Writer) -> Linked:
        """Return the annex's graphs as values, for documents in which readings can be pointed at."""
        return link_graphs(_KEY, self.study, self.history[-1], self.diagnosis, writer.language)


def _lay_out_blocks(modelled: Modelled, writer: Writer) -> Iterator[Block]:
    """Yield what is said of the diagnosis, with the graphs that show it."""
    diagnosis, whole = modelled.diagnosis, modelled.history[-1]
    sections = (
        *lay_out_diagnosis(diagnosis, writer.language, modelled.titles, modelled.experiment),
        *lay_out_unseen(diagnosis, writer.language, modelled.titles),
    )
    said = {each.key: tuple(_head_facts(each)) for each in sections}
    diagram = ModelDiagram(whole.fit.of_the_job, whole.error)
    table, *moving = lay_out_fall(modelled.history, next(iter(modelled.forecasts), None), writer).blocks
    basis = _BASIS_AND_EARLIER if modelled.study.job.priors else _BASIS
    yield Notice(writer.say(OPINION), (writer.say(basis),))
    yield from said.pop("verdict")
    yield from said.pop("remainder", ())
    yield lay_out_equations(whole.fit, writer.language)
    yield Paragraph(writer.say(_SYMBOLS))
    yield from said.pop("faults", ())
    yield from said.pop("assumed", ())
    yield from said.pop("model", ())
    yield Graph(draw_over_position(diagram))
    yield Graph(estimate(diagram))
    missing = diagnosis.candidates if diagnosis.verdict is DiagnosisVerdict.MISSING else ()
    yield Graph(draw_fall_chart(modelled.history, next(iter(missing), None)))
    yield table
    if modelled.forecasts:
        yield lay_out_left_after_compensation(modelled.forecasts, writer)
    yield from moving
    yield from said.pop("failures")
    yield from map(Graph, _draw_graphs(diagnosis.failures, diagram))
    for key, blocks in said.items():
        if key not in _ELSEWHERE:
            yield from blocks


def _head_facts(section: Section) -> Iterator[Block]:
    """Yield the blocks of a section, its title above facts that have none: an annex prints no titles."""
    for block in section.blocks:
        if isinstance(block, Facts) and not block.heading:
            yield replace(block, heading=section.title)
        else:
            yield block


def _draw_graphs(failures: Sequence[Failure], diagram: ModelDiagram) -> Iterator[Figure]:
    """Yield the residuals over whatever a failed test is about; those over the position stand above."""
    failed = {failure.test for failure in failures}
    if ResidualTest.RUNS in failed:
        yield draw_over_run(diagram)
    if failed & {ResidualTest.TIME_ORDER, ResidualTest.PERIOD_IN_TIME}:
        yield draw_over_time(diagram)
        yield draw_slopes_over_time(diagram)
    yield from (draw_over_condition(diagram, each.condition) for each in failures if each.condition)
