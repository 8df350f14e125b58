"""The raw readings are printed one row a target, and what is missing is named."""

import numpy as np
import pytest

from zlmreport.document.certificate import readings
from zlmreport.plugin import Axis, Language, MeasurementSet
from zlmreport.plugin.renderer import Notice, Table, Writer


def linear_test(targets, runs, missing=(), directions=(1, -1)):
    """Return a full test in the linear method, each deviation naming its own place, without some readings."""
    rows = [
        (position, direction, run, np.nan if (position, direction, run) in missing else number * 1e-6)
        for number, (run, direction, position) in enumerate(
            (run, direction, position)
            for run in range(1, runs + 1)
            for direction in directions
            for position in range(targets)
        )
    ]
    target, approach, run, deviation = map(np.array, zip(*rows, strict=True))
    return MeasurementSet(
        axis=Axis("X"),
        target_positions=np.arange(targets) * 0.1,
        target=target,
        approach=approach,
        run=run,
        deviation=deviation,
    )


def tables(measurements):
    section = readings.lay_out_readings(measurements, Writer.of(measurements, Language.ENGLISH))
    return [block for block in section.blocks if isinstance(block, Table)]


def test_five_runs_in_both_directions_stand_in_one_table():
    (table,) = tables(linear_test(targets=3, runs=5))
    assert len(table.columns) == 2 + 10
    assert [len(group.rows) for group in table.groups] == [3]


def test_more_runs_than_fit_on_a_page_are_parted_by_direction():
    first, second = tables(linear_test(targets=3, runs=10))
    assert {len(first.columns), len(second.columns)} == {2 + 10}


@pytest.mark.parametrize("runs", [1, 4, 7, 10, 23])
def test_every_reading_is_printed_exactly_once(runs):
    measurements = linear_test(targets=4, runs=runs)
    printed = sorted(
        float(cell)
        for table in tables(measurements)
        for group in table.groups
        for row in group.rows
        for cell in row[2:]
    )
    assert printed == list(range(len(measurements.deviation)))


def test_a_missing_reading_is_a_dash_in_the_table_and_is_named_above_it():
    measurements = linear_test(targets=3, runs=2, missing={(1, -1, 2)})
    section = readings.lay_out_readings(measurements, Writer.of(measurements, Language.ENGLISH))
    notice, table = section.blocks
    assert isinstance(notice, Notice)
    assert notice.heading == "1 of 12 readings is missing; nothing was filled in"
    assert notice.items == ("target 100 mm ↓, run 2",)
    assert table.groups[0].rows[1][-1] == "–"


def test_many_missing_readings_are_named_up_to_a_dozen_and_counted_beyond():
    missing = {(position, 1, run) for position in range(5) for run in (1, 2, 3)}
    measurements = linear_test(targets=6, runs=3, missing=missing)
    (notice,) = readings.list_missing_readings(measurements, Writer.of(measurements, Language.GERMAN))
    assert len(notice.items) == 13
    assert notice.items[-1] == "und 3 weitere (siehe Tabelle der Messwerte)"


def test_a_unidirectional_test_misses_nothing_in_the_other_direction():
    measurements = linear_test(targets=3, runs=2, directions=(1,))
    assert not list(readings.list_missing_readings(measurements, Writer.of(measurements, Language.ENGLISH)))
