"""Doubtful circles, drifts and diagonals: what their readings show is marked, or no certificate is made."""

from __future__ import annotations

import re
import shutil
from collections.abc import Callable, Iterable
from dataclasses import replace
from functools import cache
from pathlib import Path

import numpy as np
import pytest

from document.certificate.documents import text_of
from doubtful.doubtful_jobs import cover
from environments import ROOT
from installed import load_job, registry
from replacing import replace_in
from zlmreport import pipeline
from zlmreport.evaluation import likely_units, traceability
from zlmreport.evaluation.disagreements import find_contradicting_limits, find_disagreements
from zlmreport.evaluation.evidence import find_evidence, find_lines_read_twice
from zlmreport.plugin import InputError, Language, MeasurementSet, Words
from zlmreport.plugin.extension import Job

CIRCLE, DRIFT = "circle/certificate.yaml", "drift/certificate.yaml"


def say(found: Iterable[Words]) -> str:
    return "\n".join(each.in_language(Language.ENGLISH) for each in found)


@cache
def measured(example: str) -> tuple[Job, MeasurementSet]:
    job = load_job(ROOT / "configs" / example)
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
        pipeline.compose(load_job(tmp_path / "job.yaml"), registry())


def spoilt(folder: Path, example: str, **texts: str) -> Job:
    """Return a job of the examples in which some texts of its file are others."""
    shutil.copytree(ROOT / "configs", folder / "configs")
    path = folder / "configs" / example
    replace_in(path, *texts.values())
    return load_job(path)


def findings(job: Job) -> str:
    """Return what the standards of a job find not to be met."""
    evaluations = pipeline.evaluate_parameters(job, pipeline.read(job, registry()), registry())
    found = (each for evaluation in evaluations for each in evaluation.findings if each.met is False)
    return say(each.found for each in found)


@pytest.mark.parametrize(("error", "angle"), [("72", "90.02"), ("90", "90.025"), ("-45", "89.9875")])
def test_an_angle_of_no_square_is_found(error: str, angle: str, tmp_path: Path) -> None:
    example = "machine/xy-squareness.yaml"
    assert findings(load_job(ROOT / "configs" / example)) == ""

    job = spoilt(tmp_path, example, error=("square: {error: 0,", f"square: {{error: {error},"))

    assert f"= {angle}° is the angle of no square" in findings(job)


def test_diagonals_over_a_part_of_the_work_space_are_found(tmp_path: Path) -> None:
    example = "whole-machine/diagonals.yaml"
    assert findings(load_job(ROOT / "configs" / example)) == ""

    job = spoilt(tmp_path, example, axes=("X: [0, 500]", "X: [0, 900]"))

    assert "PPP was measured over 707 mm of 1029.56 mm" in findings(job)


def test_a_diagonal_that_is_shorter_than_the_others_is_found(tmp_path: Path) -> None:
    job = spoilt(tmp_path, "whole-machine/diagonals.yaml", axes=("axes: {X:", "# {X:"))
    path = tmp_path / "configs/whole-machine/nnp.csv"
    rows = path.read_text(encoding="utf-8").splitlines()
    short = [row for row in rows if not row[0].isdecimal() or float(row.split(",")[0]) < 400]
    path.write_text("\n".join(short), encoding="utf-8")

    assert "NNP was measured over 353.5 mm of 707 mm" in findings(job)


@pytest.mark.parametrize(
    ("example", "old", "said"),
    [
        ("flatness/certificate.yaml", "EXAMPLE-K-2026-32", "What was measured against (carriage)"),
        ("machine/xy-squareness.yaml", "EXAMPLE-CAL-9", "What was measured against (square)"),
    ],
)
def test_an_artefact_with_this_document_as_its_certificate_is_no_link(
    example: str, old: str, said: str, tmp_path: Path
) -> None:
    number = load_job(ROOT / "configs" / example).keys.certificate.number
    job = spoilt(tmp_path, example, certificate=(old, number))

    assert f"{said}: the calibration certificate named, {number}, is this document" in say(
        traceability.find_doubts_of_artefacts(job)
    )
    assert traceability.find_chain(job) == traceability.TraceabilityChain()
    broken = "\n".join(map(str, traceability.find_broken_chain(job)))
    assert (".certificate: " in broken) == (job.keys.certificate.kind == "certificate")


def test_a_carriage_without_a_certificate_is_marked_on_the_page(tmp_path: Path) -> None:
    job = spoilt(tmp_path, "flatness/certificate.yaml", certificate=(", certificate: EXAMPLE-K-2026-32", ""))

    assert "(carriage): no calibration certificate named" in say(
        pipeline.compose(job, registry(), trials=100).evidence
    )


def test_a_flatness_limit_in_millimetres_is_marked(tmp_path: Path) -> None:
    job = spoilt(
        tmp_path, "flatness/certificate.yaml", limit=("tolerances: {t: 4}", "tolerances: {t: 0.004}")
    )
    (evaluation,) = pipeline.evaluate_parameters(job, pipeline.read(job, registry()), registry())

    found = say(likely_units.find_unlikely_limits(evaluation))

    assert "t 0.004 µm; tolerances are stated in µm, and 1 mm is 1000 µm" in found


def test_limits_of_a_circle_that_are_exchanged_are_marked(tmp_path: Path) -> None:
    job = spoilt(tmp_path, CIRCLE, limit=("{G_ccw: 8, G_cw: 8, G_b: 10}", "{G_ccw: 12, G_cw: 8, G_b: 10}"))
    (evaluation,) = pipeline.evaluate_parameters(job, pipeline.read(job, registry()), registry())

    (found,) = find_contradicting_limits(evaluation)

    assert "the limit of G(ccw), 12 µm, is above that of G(b), 10 µm" in say([found])


def test_a_ballbar_of_calibrated_length_has_a_certificate(tmp_path: Path) -> None:
    job = spoilt(
        tmp_path,
        CIRCLE,
        certificate=("  certificate: EXAMPLE-K-2026-17\n", ""),
        kind=("issued: 2026-11-20}", "issued: 2026-11-20, kind: report}"),
    )

    found = say(find_disagreements(job, pipeline.read(job, registry())))

    assert found.startswith("The length of the instrument is said to be calibrated, and no calibration")
    assert "\n" not in found


def test_a_circle_that_slows_down_in_a_quadrant_is_marked() -> None:
    job, measurements = measured(CIRCLE)
    angle = np.degrees(measurements.target_positions[measurements.target])
    steps = np.diff(measurements.time, prepend=measurements.time[0])
    slowed = np.cumsum(np.where((angle > 90) & (angle < 180), 4 * steps, steps))

    found = say(find_disagreements(job, replace(measurements, time=slowed)))

    assert "the path was run at 250 to 1000 mm/min, and its feed is stated as 1000 mm/min" in found


def _drift() -> tuple[Job, MeasurementSet]:
    job, measurements = measured(DRIFT)
    name, line = next(iter(measurements.tests.items()))
    return job.lines[name], line


def test_a_drift_of_a_day_takes_more_than_the_day_it_is_dated() -> None:
    job, line = _drift()
    assert say(find_disagreements(job, line)) == ""
    one_day = job.keys.measurement.model_copy(update={"end": None})

    dated = replace(job, keys=job.keys.model_copy(update={"measurement": one_day}))

    said = "The readings go over 24 h, and the measurement is dated 2026-11-18 only"
    assert said in say(find_disagreements(dated, line))


def test_a_thermometer_that_stands_for_a_day_is_marked() -> None:
    job, line = _drift()
    still = {**line.conditions, "air_temperature": np.full(len(line.deviation), 293.15)}

    found = say(find_disagreements(job, replace(line, conditions=still)))

    assert found == (
        "Air temperature: the same in every digit over 24 h, at 289 readings: its sensor may have stood still"
    )


def test_a_drift_of_twenty_minutes_is_not_said_to_be_longer_and_has_no_uncertainty(tmp_path: Path) -> None:
    job = spoilt(
        tmp_path,
        DRIFT,
        hours=("hours: 24", "hours: 4"),
        kind=("issued: 2026-11-20}", "issued: 2026-11-20, kind: report}"),
    )
    path = tmp_path / "configs/drift/drift.csv"
    path.write_text("\n".join(path.read_text(encoding="utf-8").splitlines()[:7]), encoding="utf-8")

    text = text_of(pipeline.compose(job, registry()))

    assert "X1: 0.333 h of 4 h" in text
    assert "The readings give no parameter, and so there is no uncertainty of one." in text
    assert not re.search(r"U = k·u|Monte Carlo|0\.413", text)


def test_a_straightness_says_what_it_was_held_against() -> None:
    job, measurements = measured("machine/x-straightness.yaml")

    def check(job: Job, measurements: MeasurementSet) -> bool | None:
        (evaluated,) = pipeline.evaluate_all(job, measurements, registry(), trials=100)
        asked = "Reference of the straightness"
        findings = [each for each in evaluated.evaluation.findings if each.requirement.en.startswith(asked)]
        (met,) = (each.met for each in findings)
        return met

    assert check(job, measurements) is None
    assert check(job, replace(measurements, artefact_is_reversed=True))
    beam = job.keys.instrument.model_copy(update={"name": "Laser interferometer, straightness optics"})
    assert check(replace(job, keys=job.keys.model_copy(update={"instrument": beam})), measurements)


@pytest.mark.parametrize(
    ("example", "quantity"),
    [
        ("machine/xy-squareness.yaml", "Squareness error"),
        ("whole-machine/diagonals.yaml", "Diagonal displacement test"),
        ("machine/x-straightness.yaml", "Straightness error"),
    ],
)
def test_results_outside_the_accredited_scope_are_those_that_the_certificate_is_about(
    example: str, quantity: str, tmp_path: Path
) -> None:
    accredited = "laboratory: {cmc: {constant: 0.3}}\ncertificate: {"
    job = spoilt(tmp_path, example, scope=("certificate: {", accredited))

    found = cover(pipeline.compose(job, registry()))

    said = re.findall(r"Outside the accredited scope: (.*?)\. The capability .* is for (.*?);", found)
    assert said == [(quantity, "Positioning accuracy")]
