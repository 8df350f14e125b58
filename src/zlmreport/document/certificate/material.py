"""What all layouts get to lay out, the sections that they share, and the layout ``full``."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from zlmreport.document.certificate import (
    conditions,
    cover,
    measured_lines,
    origin,
    readings,
    results,
    uncertainty,
)
from zlmreport.document.certificate.document import Head
from zlmreport.document.certificate.statements import lay_out_opinions

if TYPE_CHECKING:
    from zlmreport.document.blocks import Block, Section
    from zlmreport.document.certificate.conditions import Described
    from zlmreport.document.certificate.document import Certificate
    from zlmreport.document.certificate.results import Evaluated, Tested
    from zlmreport.document.subjects.annex import Modelled
    from zlmreport.document.writer import Writer
    from zlmreport.job.job import Job
    from zlmreport.measurement.measurement_set import MeasurementSet


@dataclass(frozen=True, slots=True)
class Material:
    """What the pages of a document are made of."""

    document: Certificate  #: Without its pages.
    job: Job  #: The checked job.
    evaluated: tuple[Evaluated, ...]  #: At least one evaluation; all are of the same measurements.
    #: Evaluations of the axis before it was adjusted, by the same standards; empty where it was not.
    as_found: tuple[Evaluated, ...]
    #: What the laboratory thinks that the deviations come from; None where the job names no error model.
    interpretation: Modelled | None
    described: Sequence[Described]  #: What extensions say of their groups of job keys.
    writer: Writer  #: Of the document.
    #: Of several measured lines that are evaluated together, each by itself; empty of most documents.
    tests: tuple[Tested, ...] = ()
    #: Whether it is one of several that make one document, which says what all of them share.
    is_part: bool = False

    @property
    def measurements(self) -> MeasurementSet:
        """What the results are of: the axis as left."""
        return self.evaluated[0].evaluation.measurements

    @property
    def read(self) -> tuple[MeasurementSet, ...]:
        """All that was measured: the axis as left, and as found if it was adjusted."""
        return (self.measurements, *(each.evaluation.measurements for each in self.as_found[:1]))


@dataclass(frozen=True, slots=True)
class LaidOut:
    """A document in a layout: the first page under its title, and the rest."""

    cover: tuple[Block, ...]
    sections: tuple[Section, ...]
    is_compact: bool = False
    head: Head = Head.WHOLE


def lay_out_uncertainty(of: Material, *, with_bars: bool = True) -> Iterator[Section]:
    """Yield the uncertainty budget; of an axis that was adjusted, that of both measurements.

    `with_bars`: Whether contributions are drawn, too.
    """
    keys = of.job.keys.as_found
    if keys:
        from zlmreport.document.certificate.as_found import lay_out_uncertainty_beside_as_found  # noqa: PLC0415 - of few

        yield from lay_out_uncertainty_beside_as_found(
            keys, of.as_found, of.evaluated, of.writer, with_bars=with_bars
        )
    elif of.tests:
        yield measured_lines.lay_out_uncertainty(of.evaluated[0], of.tests, of.writer, with_bars=with_bars)
    else:
        yield uncertainty.lay_out_budgets(
            of.evaluated[0].budget,
            [each.evaluation for each in of.evaluated],
            of.writer,
            with_bars=with_bars,
        )


def lay_out_readings(of: Material) -> Iterator[Section]:
    """Yield the readings, unless the customer agreed to a document without them."""
    keys = of.job.keys
    if keys.agreement.simplified:
        return
    if of.tests:
        yield from measured_lines.lay_out_readings(of.tests, of.writer)
        return
    yield readings.lay_out_readings(of.measurements, of.writer)
    if keys.as_found:
        from zlmreport.document.certificate.as_found import lay_out_readings_as_found  # noqa: PLC0415 - of few

        yield lay_out_readings_as_found(keys.as_found, of.as_found, of.writer)


def lay_out_opinions_and_model(of: Material) -> Iterator[Section]:
    """Yield what is an opinion and no result: the job's, and what the error model says."""
    if of.job.keys.opinions:
        yield lay_out_opinions(of.job.keys, of.writer)
    if of.interpretation:
        yield of.interpretation.lay_out_section(of.writer)


def lay_out_in_full(of: Material) -> LaidOut:
    """Return the layout ``full``: a chapter for each standard, with all that is to be said of it."""
    return LaidOut(
        cover.lay_out_cover(of),
        (
            conditions.lay_out_conditions(of.job, of.measurements, of.described, of.writer),
            *_lay_out_results(of),
            *measured_lines.lay_out_results(
                of.tests, conditions.list_groups(of.job, of.measurements, of.described, of.writer), of.writer
            ),
            *lay_out_uncertainty(of),
            *lay_out_readings(of),
            origin.lay_out_origin(of),
            *lay_out_opinions_and_model(of),
        ),
    )


def _lay_out_results(of: Material) -> Iterator[Section]:
    """Yield the results by each standard; of an axis that was adjusted, those before, after, and compared."""
    sections = (results.lay_out_results(each, of.writer) for each in of.evaluated)
    keys = of.job.keys.as_found
    if keys is None:
        return sections
    from zlmreport.document.certificate.as_found import lay_out_beside_as_found  # noqa: PLC0415 - of the few that need it

    return lay_out_beside_as_found(keys, sections, of.as_found, of.evaluated, of.writer)
