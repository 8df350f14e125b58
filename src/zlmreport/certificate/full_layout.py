"""The layout ``full``: a chapter for each standard, with all that is to be said of it."""

from __future__ import annotations

from collections.abc import Iterator

from zlmreport.certificate import conditions, cover, results
from zlmreport.certificate.document import Section
from zlmreport.certificate.material import (
    LaidOut,
    Material,
    opinions_and_model,
    origin_section,
    readings_sections,
    uncertainty_sections,
)


def lay_out(of: Material) -> LaidOut:
    """Return the document."""
    return LaidOut(
        cover.blocks(of),
        (
            conditions.section(of.job, of.measurements, of.described, of.writer),
            *_results(of),
            *uncertainty_sections(of),
            *readings_sections(of),
            origin_section(of),
            *opinions_and_model(of),
        ),
    )


def _results(of: Material) -> Iterator[Section]:
    """Yield the results by each standard; of an axis that was adjusted, those before, after, and compared."""
    sections = (results.section(each, of.writer) for each in of.evaluated)
    keys = of.job.keys.as_found
    if keys is None:
        return sections
    from zlmreport.certificate.as_found import beside_as_found  # noqa: PLC0415 - of the few that need it

    return beside_as_found(keys, sections, of.as_found, of.evaluated, of.writer)
