"""A reading that is set aside is missing from the set, and stands in its provenance with the reason."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from installed import load_job, registry
from zlmreport import pipeline
from zlmreport.plugin import Approach, InputError
from zlmreport.plugin.extension import Job

READINGS = """\
target,direction,run,deviation
0,+,1,1.0
100,+,1,2.0
100,-,1,3.0
0,-,1,4.0
0,+,2,1.5
100,+,2,2.5
100,-,2,
0,-,2,4.5
"""
REASON = "Air hose touched the reflector."


@pytest.fixture
def made(tmp_path: Path) -> Any:
    """Return what loads a job that sets readings aside."""

    def make(*excluded: str, more: str = "") -> Job:
        (tmp_path / "x.csv").write_text(READINGS, encoding="utf-8")
        listed = "".join(f"\n    - {{{each}}}" for each in excluded) or " []"
        (tmp_path / "job.yaml").write_text(
            "schema: zlmreport/job/1\ncertificate: {number: CAL-1, kind: report}\naxis: {name: X}\n"
            f"measurement:\n  source: {{plugin: laser-csv, file: x.csv}}\n  excluded:{listed}\n"
            f"evaluate: [nmtba]\n{more}",
            encoding="utf-8",
        )
        return load_job(tmp_path / "job.yaml")

    return make


def test_the_reading_is_missing_and_the_others_are_as_they_were(made: Any) -> None:
    whole = pipeline.read(made(), registry())
    left = pipeline.read(made(f'target: 100, direction: "-", run: 1, reason: {REASON}'), registry())
    assert np.isnan(left.deviation[2])
    others = np.arange(8) != 2
    np.testing.assert_array_equal(left.deviation[others], whole.deviation[others])
    assert not left.deviation.flags.writeable


def test_provenance_keeps_the_reading_with_its_value_and_the_reason(made: Any) -> None:
    left = pipeline.read(made(f'target: 100, direction: "-", run: 1, reason: {REASON}'), registry())
    (found,) = left.provenance.exclusions
    assert (found.reading, found.target_position, found.approach, found.run) == (2, 0.1, Approach.NEGATIVE, 1)
    assert found.deviation == pytest.approx(3e-6)
    assert found.reason == REASON


def test_a_job_that_sets_nothing_aside_leaves_everything(made: Any) -> None:
    assert pipeline.read(made(), registry()).provenance.exclusions == ()


@pytest.mark.parametrize("direction", ['"+"', "up", "↑", "1"])
def test_a_direction_may_be_spelt_as_in_the_readings(made: Any, direction: str) -> None:
    left = pipeline.read(made(f"target: 0, direction: {direction}, run: 1, reason: r"), registry())
    assert np.isnan(left.deviation[0])


@pytest.mark.parametrize(
    ("excluded", "message"),
    [
        ('target: 99, direction: "+", run: 1, reason: r', r"there is no target 99 mm; the nearest is 100 mm"),
        (
            'target: 100, direction: "+", run: 3, reason: r',
            r"no reading of run 3 at 100 mm ↑; runs there: 1, 2",
        ),
        ('target: 100, direction: "-", run: 2, reason: r', r"run 2 at 100 mm ↓ is missing already"),
    ],
)
def test_a_reading_that_there_is_not_is_refused_at_its_place(made: Any, excluded: str, message: str) -> None:
    job = made('target: 0, direction: "+", run: 1, reason: r', excluded)
    with pytest.raises(InputError, match=message) as caught:
        pipeline.read(job, registry())
    assert [problem.place.line for problem in caught.value.problems] == [8]


def test_a_reading_is_set_aside_once(made: Any) -> None:
    one = 'target: 0, direction: "+", run: 1, reason: r'
    with pytest.raises(InputError, match="stands in the list twice"):
        pipeline.read(made(one, one), registry())


@pytest.mark.parametrize(
    "excluded", ['target: 0, direction: "+", run: 1', 'target: 0, direction: "+", run: 1, reason: ""']
)
def test_nothing_is_set_aside_without_a_reason(made: Any, excluded: str) -> None:
    with pytest.raises(InputError, match="reason"):
        made(excluded)
