"""Doubtful circles, drifts and diagonals: what their readings show is marked, or no certificate is made."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import replace
from functools import cache
from pathlib import Path

import numpy as np
import pytest

from document.certificate.documents import registry
from environments import ROOT
from zlmreport import pipeline
from zlmreport.errors import InputError
from zlmreport.evaluation.disagreements import find_disagreements
from zlmreport.evaluation.evidence import find_evidence, find_lines_read_twice
from zlmreport.job.job import Job
from zlmreport.job.loading import load
from zlmreport.language import Language, Words
from zlmreport.measurement.measurement_set import MeasurementSet

CIRCLE, DRIFT = "circle/certificate.yaml", "drift/certificate.yaml"


def say(found: Iterable[Words]) -> str:
    return "\n".join(each.in_language(Language.ENGLISH) for each in found)


@cache
def measured(example: str) -> tuple[Job, MeasurementSet]:
    job = load(ROOT / "configs" / example, registry())
    return job, pipeline.read(job, registry())


def shown(example: str, spoil: Callable[[np.ndarray], np.ndarray]) -> str:
    """Return what the spoilt readings of an example show; of several sensors those of the first."""
    job, measurements = measured(example)
    if measurements.tests:
        name, measurements = next(iter(measurements.tests.items()))
        job = job.lines[name]
    spoilt = replace(measurements, deviation=spoil(measurements.deviation.copy()))
    return say(find_evidence(job, spoilt))


def with_a_spike(deviations: np.ndarray) -> np.ndarray:
    deviations[200] += 2e-4
    return deviations


@pytest.mark.parametrize(
    ("example", "spoil", "said"),
    [
        (CIRCLE, lambda deviations: deviations / 1e3, "if the file has mm"),
        (CIRCLE, with_a_spike, "lies 200 µm from those before and after it, and is in the results"),
        (DRIFT, with_a_spike, "µm from those before and after it, and is in the results"),
        (DRIFT, np.zeros_like, "All readings are equal"),
    ],
)
def test_what_a_record_shows_is_said(example: str, spoil: Callable[..., np.ndarray], said: str) -> None:
    assert said in shown(example, spoil)


@pytest.mark.parametrize(
    "example", [CIRCLE, DRIFT, "whole-machine/circle-xy.yaml", "flatness/certificate.yaml"]
)
def test_of_a_sound_record_nothing_is_said(example: str) -> None:
    assert shown(example, lambda deviations: deviations) == ""


@pytest.mark.parametrize(("times", "said"), [(1.0, ""), (10.0, "the path was run at 1000 mm/min")])
def test_the_feed_of_a_circle_is_that_of_its_times(times: float, said: str) -> None:
    job, measurements = measured(CIRCLE)
    circle = measurements.axis.circle
    assert circle is not None
    slower = replace(measurements.axis, circle=replace(circle, feed=circle.feed / times))

    found = say(find_disagreements(job, replace(measurements, axis=slower)))

    assert (said in found) if said else not found


def test_a_line_that_was_read_twice_is_named() -> None:
    _, measurements = measured("whole-machine/diagonals.yaml")
    tests = dict(measurements.tests)
    assert not [*find_lines_read_twice(tests)]
    tests["NNP"] = replace(tests["NNP"], deviation=tests["PPP"].deviation)
    assert "The readings of PPP and NNP" in say(find_lines_read_twice(tests))


def test_a_certificate_without_any_result_is_refused(tmp_path: Path) -> None:
    rows = (ROOT / "configs" / "drift" / "drift.csv").read_text(encoding="utf-8").splitlines()
    (tmp_path / "drift.csv").write_text("\n".join(rows[:40]), encoding="utf-8")
    text = (ROOT / "configs" / DRIFT).read_text(encoding="utf-8")
    text = text.replace("../laboratory.yaml", str(ROOT / "configs" / "laboratory.yaml"))
    (tmp_path / "job.yaml").write_text(text, encoding="utf-8")

    with pytest.raises(InputError, match="states results, and these readings give none"):
        pipeline.compose(load(tmp_path / "job.yaml", registry()), registry())
