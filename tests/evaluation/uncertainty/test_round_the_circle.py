"""The budget of a circular test: what its radius, its instrument and its centre bring; what is missing."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import yaml

from document.certificate.documents import COMPLETE, job as job_of_axis
from evaluation.uncertainty.budgets import make_budget_of
from installed import load_job, registry
from refusals import refused
from zlmreport import pipeline
from zlmreport.evaluation.uncertainty.round_the_circle import is_round, smooth_curves
from zlmreport.plugin import Evaluation, InputError, Language
from zlmreport.plugin.extension import Acts, Contribution, Job
from zlmreport.plugin.renderer import Budget

MICROMETRE = 1e-6
#: How far the bar's centre lies off, and what the readings scatter by, µm.
OFFSET, SCATTER = 40.0, 0.2
STATED = {
    "calibrated_length": 0.8,
    "machine_temperature": 0.5,
    "device_temperature": 0.3,
    "expansion_coefficient": 2,
    "device_expansion_coefficient": 1,
    "environmental_variation": 0.6,
}
ENVIRONMENT = {"air_temperature": 22, "axis_temperature": 22, "expansion_coefficient": 11.5}
COLD = {**ENVIRONMENT, "axis_temperature": 20, "air_temperature": 20}
DEVICE = {
    "name": "Ballbar",
    "certificate": "C-1",
    "expanded_uncertainty": 0.5,
    "expansion_coefficient": 1.5,
}


def written(folder: Path, degrees: np.ndarray) -> str:
    """Write a circle of one turn in each sense, and return the name of its file."""
    generator = np.random.default_rng(4)
    rows = ["sense,run,angle,deviation"]
    for sense, order in (("ccw", degrees), ("cw", degrees[::-1])):
        deviations = OFFSET * np.cos(np.radians(order)) + generator.normal(0, SCATTER, len(order))
        rows += [f"{sense},1,{angle:g},{each:.2f}" for angle, each in zip(order, deviations, strict=True)]
    (folder / "circle.csv").write_text("\n".join(rows))
    return "circle.csv"


def job(folder: Path, *, calibrated: bool = True, arc: float = 360.0, **groups: Any) -> Job:
    """Return a job of a report on a circle of 150 mm with everything stated, groups of its keys changed."""
    degrees = np.arange(0.0, arc, 3.0)
    keys = {
        **{key: each for key, each in COMPLETE.items() if key != "axis"},
        "certificate": {**COMPLETE["certificate"], "kind": "report"},
        "circle": {"radius": 150, "feed": 1000, "calibrated_length": calibrated},
        "measurement": {"source": {"plugin": "circle-csv", "file": written(folder, degrees)}},
        "instrument": DEVICE,
        "environment": ENVIRONMENT,
        "uncertainty": STATED,
        "evaluate": ["iso230-4:2005"],
        **groups,
    }
    path = folder / "job.yaml"
    path.write_text(yaml.safe_dump(keys, sort_keys=False), encoding="utf-8")
    return load_job(path)


def named(found: Budget) -> dict[str, Contribution]:
    return {each.contributor or "": each for each in found.contributions}


def evaluation(of: Job, trials: int = 2000) -> Evaluation:
    (found,) = pipeline.evaluate_all(of, pipeline.read(of, registry()), registry(), trials)
    return found.evaluation


def uncertainty(of: Job, symbol: str) -> float:
    (found,) = [each for each in evaluation(of).parameters if each.quantity.symbol == symbol]
    return found.expanded_uncertainty / MICROMETRE


# --- errors smooth over the angle


@pytest.mark.parametrize("acts", [Acts.ROUND_THE_CIRCLE, Acts.OFF_CENTRE])
def test_a_smooth_curve_is_of_root_mean_square_one_at_every_angle(acts: Acts) -> None:
    angles = np.linspace(0, 2 * np.pi, 13)[:-1]

    curves = smooth_curves(acts, angles, 20_000, np.random.default_rng(1))

    # s² of 20 000 normal values is within 3·√(2/20 000) of σ².
    assert np.mean(curves**2, axis=0) == pytest.approx(1.0, abs=0.03)


def test_the_instrument_errs_by_neither_a_length_nor_a_centre() -> None:
    angles = np.linspace(0, 2 * np.pi, 37)[:-1]
    lowest = np.exp(-1j * np.outer((0, 1), angles))

    curves = smooth_curves(Acts.ROUND_THE_CIRCLE, angles, 50, np.random.default_rng(1))

    assert np.abs(curves @ lowest.T).max() == pytest.approx(0.0, abs=1e-12)


def test_a_wrong_centre_is_a_sine_over_the_angle() -> None:
    angles = np.linspace(0, 2 * np.pi, 37)[:-1]
    sine = np.column_stack([np.cos(angles), np.sin(angles)])

    curves = smooth_curves(Acts.OFF_CENTRE, angles, 50, np.random.default_rng(1))

    assert curves - curves @ sine @ sine.T / 18 == pytest.approx(np.zeros_like(curves), abs=1e-12)


@pytest.mark.parametrize(("degrees", "found"), [((0, 80, 160, 240, 320), True), ((0, 90, 180, 269), False)])
def test_angles_tell_a_centre_where_no_right_angle_is_left_out(
    degrees: tuple[float, ...], found: object
) -> None:
    assert is_round(np.radians(degrees)) is found


# --- what a budget has


def test_each_contribution_acts_where_it_does(tmp_path: Path) -> None:
    found = named(make_budget_of(job(tmp_path)))

    assert {name: each.acts for name, each in found.items()} == {
        "machine_temperature": Acts.AT_THE_DATUM,
        "device_temperature": Acts.AT_THE_DATUM,
        "expansion_coefficient": Acts.AT_THE_DATUM,
        "device_expansion_coefficient": Acts.AT_THE_DATUM,
        "calibrated_length": Acts.AT_THE_DATUM,
        "instrument": Acts.ROUND_THE_CIRCLE,
        "centring": Acts.ROUND_THE_CIRCLE,
        "environmental_variation": Acts.IN_TIME,
        "resolution": Acts.AT_EACH_READING,
    }


def test_lengths_are_those_of_the_radius(tmp_path: Path) -> None:
    found = named(make_budget_of(job(tmp_path)))
    sizes = {name: each.standard_uncertainty / MICROMETRE for name, each in found.items()}

    assert sizes["calibrated_length"] == pytest.approx(0.8 / 2)
    assert sizes["machine_temperature"] == pytest.approx(11.5 * 0.15 * 0.5 / math.sqrt(12))
    assert sizes["device_temperature"] == pytest.approx(1.5 * 0.15 * 0.3 / math.sqrt(12))
    assert sizes["expansion_coefficient"] == pytest.approx(2.0 * 0.15 * 2 / math.sqrt(12))
    # The centre lies 40 µm off: over the angle a circle then is no circle by e²/2R.
    # The offset that is found has the scatter of 120 readings in each sense.
    scatter = 3 * OFFSET * SCATTER / math.sqrt(120) / 150_000 / math.sqrt(12)
    assert sizes["centring"] == pytest.approx(OFFSET**2 / (2 * 150_000) / math.sqrt(12), abs=scatter)


def test_an_expansion_that_is_not_corrected_is_in_what_has_a_length_only(tmp_path: Path) -> None:
    """Machine and bar are 2 K too warm: what the one expands by more is in the readings, and in U whole."""
    warm = job(tmp_path)
    symbols = ("G_b", "D")
    in_warmth = {symbol: uncertainty(warm, symbol) for symbol in symbols}
    expansion = (11.5 - 1.5) * 0.15 * 2

    assert make_budget_of(warm).uncorrected_expansion == pytest.approx(expansion * MICROMETRE)

    cold = job(tmp_path, environment=COLD)
    grown = {symbol: in_warmth[symbol] - uncertainty(cold, symbol) for symbol in symbols}
    # The coefficients' own uncertainties count with the 2 K, too.
    assert grown["D"] == pytest.approx(expansion, abs=0.3)
    assert grown["G_b"] == pytest.approx(0.0, abs=0.05)


def test_without_a_calibrated_length_nothing_of_a_length_counts(tmp_path: Path) -> None:
    bare = {"environmental_variation": 0.6}

    found = make_budget_of(job(tmp_path, calibrated=False, uncertainty=bare))

    assert found.is_complete
    assert set(named(found)) == {"instrument", "centring", "environmental_variation", "resolution"}
    assert not found.uncorrected_expansion


def test_a_radius_that_nobody_calibrated_does_not_expand(tmp_path: Path) -> None:
    of_a_length = ("machine_temperature", "expansion_coefficient", "device_expansion_coefficient")
    stated = {key: STATED[key] for key in (*of_a_length, "environmental_variation")}

    assert (
        not {*of_a_length} & named(make_budget_of(job(tmp_path, calibrated=False, uncertainty=stated))).keys()
    )


@pytest.mark.parametrize("left_out", ["calibrated_length", "machine_temperature", "environmental_variation"])
def test_what_is_not_stated_is_missing(tmp_path: Path, left_out: str) -> None:
    stated = {key: each for key, each in STATED.items() if key != left_out}

    assert make_budget_of(job(tmp_path, uncertainty=stated)).missing == (left_out,)


def test_a_full_turn_tells_its_own_centre_and_an_arc_does_not(tmp_path: Path) -> None:
    assert make_budget_of(job(tmp_path)).is_complete
    assert make_budget_of(job(tmp_path, arc=200)).missing == ("centring",)


@pytest.mark.parametrize(("deviation", "said"), [("0.16", "0.16"), ("0", "0")])
def test_a_centre_that_is_hardly_off_counts_and_has_no_more_digits_than_a_circle_shows(
    tmp_path: Path, deviation: str, said: str
) -> None:
    """e²/(2R) of an offset of 0.16 µm is a tenth of a picometre; of none it is nothing, and not missing."""
    of = job(tmp_path)
    turns = [
        f"{sense},1,{angle},{float(deviation) * math.cos(math.radians(angle)):.4f}"
        for sense, order in (("ccw", range(0, 360, 3)), ("cw", range(357, -1, -3)))
        for angle in order
    ]
    (tmp_path / "circle.csv").write_text("\n".join(["sense,run,angle,deviation", *turns]), encoding="utf-8")

    found = make_budget_of(of)

    assert found.is_complete
    centring = named(found)["centring"]
    assert centring.stated.in_language(Language.GERMAN) == "R < 0,0001 µm"
    assert f"lies {said} µm off" in centring.source.in_language(Language.ENGLISH)


def test_the_centre_of_an_arc_that_is_stated_shifts_its_path(tmp_path: Path) -> None:
    of_arc = job(tmp_path, arc=200, uncertainty={**STATED, "centring": 6})

    found = named(make_budget_of(of_arc))["centring"]

    assert found.acts is Acts.OFF_CENTRE
    assert found.standard_uncertainty / MICROMETRE == pytest.approx(6 / math.sqrt(12))


def test_a_certificate_says_what_to_state(tmp_path: Path) -> None:
    stated = {key: each for key, each in STATED.items() if key != "calibrated_length"}
    keys = {"certificate": COMPLETE["certificate"], "uncertainty": stated}

    assert any(
        "uncertainty.calibrated_length: state the expanded uncertainty (k = 2) of the instrument's "
        "calibrated length" in str(each)
        for each in refused(pipeline.compose, job(tmp_path, **keys), registry(), trials=100).problems
    )


@pytest.mark.parametrize("key", ["calibrated_length", "centring"])
def test_keys_of_a_circle_belong_to_a_circle(tmp_path: Path, key: str) -> None:
    with pytest.raises(InputError, match=f"uncertainty.{key}"):
        job_of_axis(tmp_path, {**COMPLETE, "uncertainty": {key: 1}})


@pytest.mark.parametrize(
    ("of", "acts", "said"),
    [
        ("axis", "round-the-circle", "this job is on no circle"),
        ("axis", "off-centre", "this job is on no circle"),
        ("circle", "along-the-length", "a circle has no length along an axis"),
    ],
)
def test_errors_are_shared_in_a_way_that_fits(tmp_path: Path, of: str, acts: str, said: str) -> None:
    """By a contribution of one's own, and by the instrument."""
    own = {"contributions": [{"name": "Cup", "range": 0.2, "acts": acts}], "instrument_acts": acts}
    load_it = {
        "circle": lambda: job(tmp_path, uncertainty={**STATED, **own}),
        "axis": lambda: job_of_axis(tmp_path, {**COMPLETE, "uncertainty": own}),
    }[of]

    assert [str(each).partition(": ")[2] for each in refused(load_it).problems] == [
        f"uncertainty.{key}: {acts} does not fit: {said}" for key in ("contributions.acts", "instrument_acts")
    ]


# --- what comes of it


def test_an_error_of_the_length_is_in_d_and_in_no_form(tmp_path: Path) -> None:
    long = {**STATED, "calibrated_length": 8}
    symbols = ("G_ccw", "G_b", "D", "F_max_ccw")

    of_short, of_long = job(tmp_path, environment=COLD), job(tmp_path, environment=COLD, uncertainty=long)
    short = {symbol: uncertainty(of_short, symbol) for symbol in symbols}
    found = {symbol: uncertainty(of_long, symbol) for symbol in symbols}

    assert found["G_ccw"] == pytest.approx(short["G_ccw"], rel=0.1)
    assert found["G_b"] == pytest.approx(short["G_b"], rel=0.1)
    assert found["D"] == pytest.approx(8, rel=0.1)
    assert found["F_max_ccw"] == pytest.approx(8, rel=0.1)


def test_what_has_one_turn_or_many_has_no_interval_of_an_axis(tmp_path: Path) -> None:
    """Readings that follow each other on a path do not scatter by themselves."""
    found = evaluation(job(tmp_path), 100).parameters
    assert [each.axis_interval for each in found] == [None] * len(found)
