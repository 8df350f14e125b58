"""A sample certificate with one of everything, for the tests of renderers."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import fields, is_dataclass, replace
from datetime import date
from pathlib import Path
from typing import Any

import numpy as np

from zlmreport.document.blocks import (
    Align,
    Block,
    Column,
    Explained,
    Facts,
    Formulas,
    Graph,
    Mark,
    Notice,
    Paragraph,
    RowGroup,
    Section,
    Symbol,
    Table,
    Verdict,
)
from zlmreport.document.certificate.document import Certificate, Letterhead, PageWords, Party
from zlmreport.document.figures.figure import (
    Arrow,
    Band,
    Bracket,
    Curve,
    Figure,
    Level,
    Panel,
    PlottedReadings,
    Role,
)
from zlmreport.errors import Place
from zlmreport.evaluation.evaluation import (
    Conformity,
    Decision,
    EvaluatedParameter,
    Evaluation,
    Finding,
    PositionColumn,
    PositionQuantity,
    Quantity,
    QuantityGroup,
)
from zlmreport.evaluation.statistics import position_statistics
from zlmreport.job.choices import SourceChoice
from zlmreport.job.document_keys import CertificateKeys, Customer, Laboratory, Person
from zlmreport.job.evaluation_keys import StandardKeys
from zlmreport.job.job import Job
from zlmreport.job.keys import JobKeys
from zlmreport.job.measurement_keys import (
    AxisKeys,
    Environment,
    InstrumentKeys,
    MachineUnderTest,
    Measurement,
    SourceKeys,
)
from zlmreport.job.types import Options
from zlmreport.language import Language, Words, same
from zlmreport.measurement.measurement_set import MeasurementSet
from zlmreport.measurement.units import ARCSECOND
from zlmreport.testing.measurements import simulated_test

#: Text that a renderer must set as it stands: it would be a tag, an entity, or a template's expression.
MARKUP = '<zlm-markup a="1">&amp;,;{{7*7}}{%x%}</zlm-markup>'
#: Letters and signs of customers' names and of results, most of which Latin-1 has not.
LETTERS = "Łódź Žďár Ångström Ωμέγα ≤ − ″"
NUMBER = "KIT-2026-0001"
_PLACE_OF_A_WORD = "Word"


def sample_certificate(language: Language = Language.ENGLISH, text: str = "Example") -> Certificate:
    """Return a certificate with every kind of block and every kind of mark on its graph.

    Parameters
    ----------
    language
        Of the document.
    text
        Stands wherever a user's own words can stand.
    """
    measurements = simulated_test()
    evaluation = _make_evaluation(measurements, text)
    return Certificate(
        number=NUMBER,
        title=text,
        subtitle=text,
        language=language,
        issued=date(2026, 11, 20),
        paper="A4",
        letterhead=Letterhead(Party(text, (text,)), accreditation=text),
        cover=(Facts((("Machine", text),), heading=text), Paragraph(text)),
        sections=(
            Section("results", text, _make_blocks(evaluation, text), new_page=True),
            Section("nothing", text, ()),
        ),
        page_words=PageWords.in_language(language, f"Kit {NUMBER}"),
        description=text,
        measurements=measurements,
        evaluations=(evaluation,),
        generator="zlmreport",
        keywords=(text,),
        plugins={"kit": "1"},
        job=_make_job(measurements, text),
    )


def make_worded_certificate() -> tuple[Certificate, Mapping[str, str]]:
    """Return a certificate with a word of its own in each place, and the words by what they are.

    A renderer of documents prints each of them: in the title, the letterhead and the cover, in the headings,
    notices, tables and formulas of each section. Words within a graph are not among them: it may be drawn.
    """
    words: dict[str, str] = {}

    def worded(value: Any, what: str) -> Any:
        if value == _PLACE_OF_A_WORD:
            return words.setdefault(f"{what} {len(words) + 1}", f"Wd{len(words) + 1:03d}")
        if isinstance(value, tuple):
            return tuple(worded(each, what) for each in value)
        if isinstance(value, Graph) or not is_dataclass(value):
            return value
        within = type(value).__name__.lower()
        return replace(  # type: ignore[type-var]  # a dataclass is an object of one here
            value,
            **{
                each.name: worded(getattr(value, each.name), f"{within}: {each.name}")
                for each in fields(value)
                if each.init
            },
        )

    plain = sample_certificate(text=_PLACE_OF_A_WORD)
    printed = {
        name: worded(getattr(plain, name), name)
        for name in ("title", "subtitle", "letterhead", "cover", "sections")
    }
    return replace(plain, **printed), words


def make_ordered_certificate() -> tuple[Certificate, tuple[str, ...], tuple[tuple[float, float], ...]]:
    """Return a certificate whose order can be seen: its words, and its values in SI and in users' units.

    The words stand in sections, one block after the other. The parameters are in no order of symbols or
    values, and one of them is not in the unit of the readings.
    """
    plain = sample_certificate()
    words = tuple(f"Order{number:02d}" for number in (7, 3, 9, 1, 8, 2, 6, 4, 5))
    sections = tuple(
        Section(
            f"section-{start}",
            words[start],
            (Paragraph(words[start + 1]), Notice(words[start + 2], (words[start + 2],))),
        )
        for start in range(0, len(words), 3)
    )
    evaluation = plain.evaluations[0]
    unit = evaluation.measurements.axis.deviation_unit
    parameters = tuple(
        EvaluatedParameter(
            Quantity(symbol, symbol, same(symbol), QuantityGroup.SYSTEMATIC, symbol, same(symbol), unit=own),
            value,
        )
        for symbol, own, value in (
            ("K3", None, 4.321987e-6),
            ("K1", ARCSECOND, 7.654321e-6),
            ("K2", None, 1.234567e-6),
        )
    )
    values = tuple(
        (each.value, float(each.quantity.unit_or(unit).from_si(each.value))) for each in parameters
    )
    evaluations = (replace(evaluation, parameters=parameters, columns=()),)
    return replace(plain, sections=sections, evaluations=evaluations), words, values


def _make_job(measurements: MeasurementSet, text: str) -> Job:
    """Return a job that states whatever a renderer of data may need."""
    day = date(2026, 11, 18)
    keys = JobKeys(
        schema="zlmreport/job/1",
        certificate=CertificateKeys(
            number=NUMBER, issued=date(2026, 11, 20), authorised_by=Person(name=text, function=text)
        ),
        laboratory=Laboratory(name=text, address=text, country="DE"),
        customer=Customer(name=text, address=text),
        machine=MachineUnderTest(manufacturer=text, model=text, serial=text),
        axis=AxisKeys(name=text),
        measurement=Measurement(source=SourceKeys(plugin="kit"), date=day),
        instrument=InstrumentKeys(name=text, serial=text, certificate=text, expanded_uncertainty=0.5),
        environment=Environment(air_temperature=20.1, remarks=text),
        evaluate=[StandardKeys(standard="kit:1")],
    )
    place = Place("kit")
    return Job(
        keys=keys,
        axis=measurements.axis,
        source=SourceChoice("kit", Options(), place),
        standards=(),
        effects=(),
        formats=(),
        directory=Path(),
        files=(),
    )


def _make_blocks(evaluation: Evaluation, text: str) -> tuple[Block, ...]:
    return (
        Notice(text, (text,)),
        Table(
            text,
            (Column(Symbol("x̄_{i}↑"), "µm", Align.RIGHT), Column(text, align=Align.CENTRE), Column("")),
            (
                RowGroup(
                    (("1.5", Explained(text, text), Verdict(Mark.MET, text)),), text, text, section="nothing"
                ),
                RowGroup((("−", Symbol("R_{i}"), Verdict(Mark.NOT_MET, text)),)),
                RowGroup((("", "", Verdict(Mark.OPEN, text)),)),
            ),
        ),
        Table(text, (Column(text),), (), dense=True),
        Table(text, (Column(text), Column(text)), (RowGroup(()), RowGroup((), text))),
        Graph(_make_figure(evaluation, text)),
        Formulas(text, ((Symbol("D"), Symbol("max(x̄_{i}) − min(x̄_{i})"), text),)),
    )


_DECISION = Decision(Conformity.FAILED, 1e-5, 1e-5, None)


def _make_evaluation(measurements: MeasurementSet, text: str) -> Evaluation:
    statistics = position_statistics(measurements.deviations(), measurements.target_positions)
    mean = statistics.mean_bidirectional
    words = same(text)
    quantity = Quantity("D", "D", words, QuantityGroup.SYSTEMATIC, "max(x̄_{i}) − min(x̄_{i})", words)
    return Evaluation(
        standard="kit:1",
        designation=text,
        title=words,
        position_index="i",
        measurements=measurements,
        statistics=statistics,
        parameters=(EvaluatedParameter(quantity, float(np.ptp(mean)), limit=1e-5, decision=_DECISION),),
        columns=(PositionColumn(PositionQuantity("half", "x̄_{i}/2", words), mean / 2),),
        findings=(Finding(words, words, met=None),),
        notes=(words,),
    )


def _make_figure(evaluation: Evaluation, text: str) -> Figure:
    measurements, statistics = evaluation.measurements, evaluation.statistics
    axis = measurements.axis
    x = axis.position_unit.from_si(measurements.target_positions)
    mean = axis.deviation_unit.from_si(statistics.mean_bidirectional)
    lowest, highest = int(np.argmin(mean)), int(np.argmax(mean))
    low, high = float(mean[lowest]), float(mean[highest])
    panel = Panel(
        heading=same(text),
        curves=tuple(Curve("x̄_{i}", role, x, mean) for role in Role),
        bands=(Band("x̄_{i} ± 1", Role.SPREAD, x, mean - 1, mean + 1),),
        readings=tuple(
            PlottedReadings(
                approach,
                x[measurements.target[measurements.approach == approach]],
                axis.deviation_unit.from_si(measurements.deviation[measurements.approach == approach]),
            )
            for approach in measurements.approaches
        ),
        arrows=(Arrow("B_{i}", float(x[1]), low, high), Arrow("B_{i}", float(x[2]), low, low)),
        brackets=(Bracket("D", low, high, float(x[lowest]), float(x[highest])),),
        levels=(Level("0", Role.TOLERANCE, 0.0),),
    )
    gap = np.where(np.arange(len(x)) == 1, np.nan, mean)
    interrupted = Panel(curves=(Curve("x̄_{i}", Role.MEAN_BIDIRECTIONAL, x, gap),))
    return Figure(
        key="everything",
        title=same(text),
        alternative=Words("From {low} to {high}: {text}").given(low=low, high=high, text=text),
        x_title=same(text),
        y_title=same(text),
        x_unit=axis.position_unit.symbol,
        y_unit=axis.deviation_unit.symbol,
        panels=(panel, interrupted),
    )
