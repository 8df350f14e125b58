"""Readings of a journal, and which of them count."""

from __future__ import annotations

import json
from itertools import chain
from pathlib import Path

import numpy as np
import pytest

from installed import registry
from live.capture.moves import MM, UM, Axis, listed, planned
from live.capture.recording import recorded, written
from plugins.sources.reading import DATA, JOB, missing_in, said
from zlmreport.live.capture.journal import Journal
from zlmreport.model.planning.methods import Method
from zlmreport.plugin import (
    AccessError,
    Approach,
    Axis as MeasuredAxis,
    AxisKind,
    InputError,
    Language,
    MeasurementSet,
)
from zlmreport.plugin.instrument import CaptureEnded, CaptureResumed, Fault
from zlmreport.plugin.protocols import SourceContext

#: The last reading before an axis is quite there may be among the hundred of a mean, m.
ARRIVAL = 1 * UM / 100
LINEAR = DATA / "sources" / "linear.journal"


ROTARY = {"axis": "C", "kind": AxisKind.ROTARY}


def read(journal: Path, name: str = "X", kind: AxisKind = AxisKind.LINEAR) -> MeasurementSet:
    source = registry().source("serial-interferometer")
    options = source.options.model_validate({"journal": journal})
    return source.read(options, SourceContext(MeasuredAxis(name, kind), JOB))


def beam_lost(axis: Axis) -> chain:
    return axis.stand(1.5, faults=Fault.BEAM_LOST, value=float("nan"), message="the beam is broken")


def broken_in_run_1(path: Path, *, until: float) -> Path:
    """Write a capture whose zero was lost after 100 mm; its second attempt goes up to a target, 4 µm off."""
    axis = Axis(error={0: 0.001, 100: 0.002})
    written(path, chain(axis.stand(), axis.go(0, 100), beam_lost(axis)), datum=-5 * MM)
    axis = Axis(time=axis.time + 500, error=dict.fromkeys((0, 100, 200), 0.004))
    targets = [target for target in (0, 100, 200) if target <= until]
    with Journal.resume(path) as journal:
        journal.append(CaptureResumed(), axis.time - 100)
        recorded(chain(axis.stand(), axis.go(*targets)), journal)
        journal.append(CaptureEnded(), journal.elapsed)
    return path


def test_deviations_directions_runs_and_times_are_those_of_the_capture() -> None:
    measurements = read(LINEAR)
    assert measurements.target_positions.tolist() == [0.0, 100 * MM, 200 * MM]
    assert measurements.run.tolist() == [1] * 6 + [2] * 6
    assert measurements.approach.tolist() == [1, 1, 1, -1, -1, -1] * 2
    taken = np.delete(measurements.deviation, 10)
    expected = np.delete(np.tile([1.1, -2.3, 4.7, 4.7, -2.3, 1.1], 2), 10) * UM
    np.testing.assert_allclose(taken, expected, rtol=0, atol=1e-15)
    assert np.all(np.diff(np.delete(measurements.time, 10)) > 3.0)


def test_conditions_stand_beside_each_reading() -> None:
    air = read(LINEAR).conditions["air_temperature"]
    assert air[0] == 293.45
    assert np.isnan(air[10])


def test_the_datum_of_the_capture_is_that_of_the_readings() -> None:
    assert read(LINEAR).datum == -5e-3


def test_a_missed_visit_is_a_missing_reading() -> None:
    measurements = read(LINEAR)
    assert missing_in(measurements) == [(100 * MM, Approach.NEGATIVE, 2)]
    assert "1 of 12 visits of the plan has no reading." in said(measurements)


def test_a_repeated_run_counts_whole_and_is_not_mixed_with_the_first_attempt(tmp_path: Path) -> None:
    measurements = read(broken_in_run_1(tmp_path / "x.journal", until=200))
    np.testing.assert_allclose(measurements.deviation[:3], 4 * UM, rtol=0, atol=1e-12)
    kept = "attempt 2, the most complete, counts; what was read in the others stays in the journal"
    assert any(kept in remark for remark in said(measurements))


def test_an_attempt_that_came_less_far_does_not_count(tmp_path: Path) -> None:
    measurements = read(broken_in_run_1(tmp_path / "x.journal", until=0))
    np.testing.assert_allclose(measurements.deviation[:2], [1 * UM, 2 * UM], rtol=0, atol=ARRIVAL)
    assert np.all(np.isnan(measurements.deviation[2:]))


def test_of_attempts_that_came_as_far_the_last_counts(tmp_path: Path) -> None:
    measurements = read(broken_in_run_1(tmp_path / "x.journal", until=100))
    np.testing.assert_allclose(measurements.deviation[:2], 4 * UM, rtol=0, atol=1e-12)


def test_what_happened_to_the_datum_is_said(tmp_path: Path) -> None:
    remarks = said(read(broken_in_run_1(tmp_path / "x.journal", until=200)))
    assert "The instrument's zero was lost (times: 1)" in " ".join(remarks)
    assert any("−5 mm was taken for that position" in remark for remark in remarks)


def test_a_difference_at_the_check_of_the_datum_is_said(tmp_path: Path) -> None:
    axis, path = Axis(), tmp_path / "x.journal"
    written(path, chain(axis.stand(), axis.go(0, 100)))
    axis = Axis(position=95, time=axis.time + 500, error={100: 0.0031})
    with Journal.resume(path) as journal:
        journal.append(CaptureResumed(), axis.time - 100)
        recorded(axis.go(100), journal)
        journal.append(CaptureEnded(), journal.elapsed)
    assert any("largest difference: 3.1 µm" in remark for remark in said(read(path)))


def test_remarks_are_said_in_german_with_a_decimal_comma() -> None:
    (first, *_) = read(LINEAR).provenance.remarks
    assert "höchstens 1 mm vom Sollwert" in first.in_language(Language.GERMAN)


def test_the_time_over_which_readings_are_averaged_is_said(tmp_path: Path) -> None:
    axis, path = Axis(), tmp_path / "x.journal"
    written(path, chain(axis.stand(), axis.go(0, 100, 200, 205, 200, 100, 0, -5)), datum=-5 * MM)
    taken = [json.loads(line) for line in path.read_text("utf-8").splitlines()[1:]]
    averaged = {round(each["duration"], 1) for each in taken if each["record"] == "reading"}
    (first, *_) = said(read(path))
    assert averaged == {0.5}
    assert "the mean over the last 0.5 s of a standstill of 1 s" in first


def test_signs_of_angles_touch_their_numbers(tmp_path: Path) -> None:
    axis, path = Axis(), tmp_path / "c.journal"
    written(path, chain(axis.stand(), axis.go(0, 100, 200, 205, 200, 100, 0, -5)), datum=-5 * MM, **ROTARY)
    first, datum, closure = said(read(path, "C", AxisKind.ROTARY))
    assert "within 0.206265″, at most 0.0572958° from" in first
    assert datum.startswith("The reading at −0.286479° was taken")
    assert closure.endswith("closure: 0″.")


def test_a_capture_that_is_not_finished_says_how_to_go_on(tmp_path: Path) -> None:
    axis = Axis()
    path = written(tmp_path / "x.journal", chain(axis.stand(), axis.go(0)))
    with pytest.raises(AccessError, match=r"1 of 6 visits; .* --resume' goes on, .* --end' closes it"):
        read(path)


def test_a_journal_of_another_axis_is_refused() -> None:
    with pytest.raises(InputError, match=r"journal of the linear axis X .* the linear axis Y"):
        read(LINEAR, "Y")


def test_the_sample_is_the_plan_that_it_says() -> None:
    assert planned(runs=2).targets.tolist() == read(LINEAR).target_positions.tolist()
    assert len(listed(runs=2)) == len(read(LINEAR).deviation)


def test_of_a_visit_that_was_read_again_the_last_reading_counts(tmp_path: Path) -> None:
    axis = Axis(error={-0.025: 0.0})
    written(tmp_path / "x.journal", chain(axis.stand(), axis.go(-0.025, stay=1.5), axis.go(0, 100)))
    with Journal.resume(tmp_path / "x.journal") as journal:
        journal.append(CaptureEnded(), journal.elapsed)
    assert read(tmp_path / "x.journal").deviation[0] == 0.0


@pytest.mark.parametrize(
    ("slip", "expected"), [(0.004, "closure: 4"), (0.011, "The datum slipped: at the end the axis read 11")]
)
def test_the_closing_look_at_the_datum_is_told(slip: float, expected: str, tmp_path: Path) -> None:
    plan, axis = planned(Method.UNIDIRECTIONAL), Axis(error={-5: slip})
    path = written(tmp_path / "x.journal", chain(axis.stand(), axis.go(0, 100, 200, -5)), plan, datum=-5 * MM)
    assert any(expected in remark for remark in said(read(path)))
