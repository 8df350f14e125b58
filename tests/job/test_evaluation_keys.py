"""What a job may not state of its uncertainty budget."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from document.certificate.documents import COMPLETE, job
from refusals import refused

ROTARY = {"name": "C", "kind": "rotary"}


def told(folder: Path, **groups: Any) -> str:
    """Return the message on the only mistake of a job."""
    (problem,) = refused(job, folder, {**COMPLETE, **groups}).problems
    return problem.message


@pytest.mark.parametrize(
    "key",
    [
        "misalignment",
        "machine_temperature",
        "device_temperature",
        "expansion_coefficient",
        "device_expansion_coefficient",
    ],
)
def test_a_rotary_axis_has_no_lengths_that_expand_or_are_misaligned(tmp_path: Path, key: str) -> None:
    message = told(tmp_path, axis=ROTARY, evaluate=["nmtba"], uncertainty={key: 1.0})

    assert message == (
        f"uncertainty.{key}: belongs to a linear axis; take it out (with null, where another file states "
        "it), or state contributions of this axis"
    )


def test_null_takes_out_what_another_file_states(tmp_path: Path) -> None:
    (tmp_path / "shared.yaml").write_text("uncertainty: {misalignment: 0.5}\n", encoding="utf-8")
    keys = {"extends": "shared.yaml", "axis": ROTARY, "evaluate": ["nmtba"]}
    assert "belongs to a linear axis" in told(tmp_path, **keys, uncertainty={})
    stated = job(tmp_path, {**COMPLETE, **keys, "uncertainty": {"misalignment": None}}).keys.uncertainty
    assert stated is not None
    assert stated.misalignment is None


def test_a_rotary_axis_has_no_metres(tmp_path: Path) -> None:
    instrument = {**COMPLETE["instrument"], "expanded_uncertainty_per_metre": 0.5}

    message = told(tmp_path, axis=ROTARY, evaluate=["nmtba"], instrument=instrument)

    assert message == (
        "instrument.expanded_uncertainty_per_metre: belongs to a linear axis: a rotary one has no metres"
    )


def test_a_capability_of_rotary_axes_does_not_grow_with_metres(tmp_path: Path) -> None:
    laboratory = {**COMPLETE["laboratory"], "cmc": {"constant": 0.3, "per_metre": 0.5, "kind": "rotary"}}

    message = told(tmp_path, laboratory=laboratory)

    assert message == (
        "laboratory.cmc: per_metre belongs to linear axes: a rotary one has no metres; take it out"
    )


def test_a_formula_with_a_length_is_none_of_a_rotary_axis(tmp_path: Path) -> None:
    instrument = {**COMPLETE["instrument"], "expanded_uncertainty": "0.2 + 0.5*L"}

    message = told(tmp_path, axis=ROTARY, evaluate=["nmtba"], instrument=instrument)

    assert message == "instrument.expanded_uncertainty: belongs to a linear axis: a rotary one has no metres"


def test_a_scale_of_the_instrument_is_named_in_per_cent_of_the_reading(tmp_path: Path) -> None:
    message = told(tmp_path, uncertainty={"instrument_acts": "with-the-reading"})

    assert message == (
        "uncertainty.instrument_acts: with-the-reading is stated in % of the reading: name it under "
        "uncertainty.contributions, as {name: Scale of the instrument, acts: with-the-reading, "
        "expanded_uncertainty: …}"
    )


@pytest.mark.parametrize(
    ("sizes", "found"),
    [({}, "none"), ({"range": 1, "standard_uncertainty": 1}, "standard_uncertainty and range")],
)
def test_a_contribution_is_stated_once(tmp_path: Path, sizes: dict[str, Any], found: str) -> None:
    contribution = {"name": "Dead path", "acts": "at-each-reading", **sizes}

    message = told(tmp_path, uncertainty={"contributions": [contribution]})

    assert message == (
        "uncertainty.contributions: state one of expanded_uncertainty, standard_uncertainty, range "
        f"(found: {found})"
    )


def test_a_normal_distribution_has_no_range(tmp_path: Path) -> None:
    contribution = {"name": "Any", "acts": "at-each-reading", "range": 1, "distribution": "normal"}

    message = told(tmp_path, uncertainty={"contributions": [contribution]})

    assert message.startswith("uncertainty.contributions.distribution: a normal distribution has no range; ")


def test_who_shares_an_error_is_said_for_every_contribution(tmp_path: Path) -> None:
    message = told(tmp_path, uncertainty={"contributions": [{"name": "Any", "range": 1}]})

    assert "uncertainty.contributions.acts is missing" in message


@pytest.mark.parametrize("key", ["misalignment", "environmental_variation", "resolution"])
def test_a_range_is_not_negative(tmp_path: Path, key: str) -> None:
    assert f"uncertainty.{key}" in told(tmp_path, uncertainty={key: -0.1})
