"""The section with the single readings, and the sentence on missing ones."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

import numpy as np

from zlmreport.document.blocks import (
    Align,
    Block,
    Column,
    Notice,
    Paragraph,
    RowGroup,
    Section,
    Symbol,
    Table,
)
from zlmreport.document.certificate.statements import make_exclusion_notice
from zlmreport.language import Words
from zlmreport.measurement.approach import Approach
from zlmreport.measurement.measurand import Coordinate
from zlmreport.measurement.units import with_unit

if TYPE_CHECKING:
    from zlmreport.document.writer import Writer
    from zlmreport.measurement.measurement_set import MeasurementSet

#: Columns of readings that stand beside each other on an upright page.
_MOST_COLUMNS = 10
#: Missing readings that are named one by one.
_MOST_NAMED = 12

_ONE_MISSING = Words("{count} of {all} readings is missing; nothing was filled in")
_MISSING = Words("{count} of {all} readings are missing; nothing was filled in")
_TITLE = Words("Readings")
_IN_FILES = Words(
    "The {count} readings that are evaluated are not printed. The files that they were read from are named "
    "under “Origin of the results”; the PDF carries them, and the means at each angle in its results file."
)
_IN_FILES_OVER_TIME = Words(
    "The {count} readings that are evaluated are not printed. The files that they were read from are "
    "named under “Origin of the results”; the PDF carries them."
)
_CAPTION = Words("Deviations x = {sign}, in the order of runs")
_INDICATION = Words("Deviations x = indicated − calibrated position, in the order of runs")


def lay_out_readings(
    measurements: MeasurementSet, writer: Writer, key: str = "measurement.source", *, lines: int = 1
) -> Section:
    """Return the section of raw readings: one row a target, runs as columns.

    `key`: The job key that names their source: marked if the readings are the customer's. `lines`: So many
    lines with as many readings are said to be in files, together.
    """
    blocks: list[Block] = [
        *list_missing_readings(measurements, writer),
        *make_exclusion_notice(measurements, writer, f"{key.removesuffix('source')}excluded"),
    ]
    if measurements.axis.measurand.is_continuous:
        count = lines * int(np.count_nonzero(np.isfinite(measurements.deviation)))
        is_over_time = measurements.axis.measurand.coordinate is Coordinate.TIME
        said = _IN_FILES_OVER_TIME if is_over_time else _IN_FILES
        blocks.append(Paragraph(writer.say(said.given(count=count))))
        return Section("readings", writer.say(_TITLE) + writer.marks.write_after(key), tuple(blocks))
    columns = [
        (approach, index) for approach in measurements.approaches for index in range(len(measurements.runs))
    ]
    fit = len(columns) <= _MOST_COLUMNS
    blocks.extend(
        _lay_out_table(measurements, chosen, writer)
        for chosen in ([columns] if fit else _split_by_approach(columns))
    )
    return Section("readings", writer.say(_TITLE) + writer.marks.write_after(key), tuple(blocks))


def list_missing_readings(measurements: MeasurementSet, writer: Writer) -> Iterator[Notice]:
    """Yield the notice that names the missing readings, if there are any beside those that were set aside."""
    aside = {(each.target_position, each.approach, each.run) for each in measurements.provenance.exclusions}
    missing = [
        each
        for each in measurements.missing()
        if (each.target_position, each.approach, each.run) not in aside
    ]
    if not missing:
        return
    heading = (_ONE_MISSING if len(missing) == 1 else _MISSING).given(
        count=len(missing),
        all=len(missing) + int(np.count_nonzero(np.isfinite(measurements.deviations()))),
    )
    one = Words("target {target} {arrow}, run {run}")
    items = [
        writer.say(
            one.given(
                target=with_unit(writer.position(reading.target_position), writer.position_unit.symbol),
                arrow=reading.approach.arrow,
                run=reading.run,
            )
        )
        for reading in missing[:_MOST_NAMED]
    ]
    if len(missing) > _MOST_NAMED:
        more = Words("and {count} more (see the table of readings)")
        items.append(writer.say(more.given(count=len(missing) - _MOST_NAMED)))
    yield Notice(writer.say(heading), tuple(items))


def _split_by_approach(columns: Sequence[tuple[Approach, int]]) -> Iterator[list[tuple[Approach, int]]]:
    """Yield columns that fit on a page: one approach at a time, so many runs at a time."""
    for approach in Approach:
        of_approach = [column for column in columns if column[0] is approach]
        for start in range(0, len(of_approach), _MOST_COLUMNS):
            yield of_approach[start : start + _MOST_COLUMNS]


def _lay_out_table(
    measurements: MeasurementSet, chosen: Sequence[tuple[Approach, int]], writer: Writer
) -> Table:
    grid = measurements.deviations()
    unit = writer.deviation_unit.symbol
    columns = [
        Column(Symbol("i"), align=Align.RIGHT),
        Column(Symbol("P_{i}"), writer.position_unit.symbol, Align.RIGHT),
        *(
            Column(Symbol(f"x_{{i{measurements.runs[run]}}}{approach.arrow}"), unit, Align.RIGHT)
            for approach, run in chosen
        ),
    ]
    rows = tuple(
        (
            str(position + 1),
            writer.position(float(target)),
            *(writer.deviation(float(grid[approach.index, position, run])) for approach, run in chosen),
        )
        for position, target in enumerate(measurements.target_positions)
    )
    axis = measurements.axis
    sign = axis.measurand.sign_of(axis.letter)
    caption = _INDICATION if measurements.is_indication else _CAPTION.given(sign=sign)
    return Table(writer.say(caption), tuple(columns), (RowGroup(rows),), dense=True)
