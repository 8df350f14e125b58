"""A third party's standard: built, installed beside zlmreport into a fresh environment, and used."""

from __future__ import annotations

import json
import shutil
from pathlib import Path

import pytest
from pypdf import PdfReader

from environments import HOUSE_STANDARD, Environment


@pytest.fixture(scope="module")
def outcome(house_environment: Environment, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The folder with the files that the plugin's example job gives."""
    folder = tmp_path_factory.mktemp("example")
    shutil.copytree(HOUSE_STANDARD / "example", folder, dirs_exist_ok=True)
    done = house_environment.run("zlmreport", "job.yaml", folder=folder)
    assert done.returncode == 0, done.stdout + done.stderr
    return folder / "out"


@pytest.mark.long
def test_it_is_listed_with_its_distribution(house_environment: Environment, tmp_path: Path) -> None:
    listed = house_environment.run("zlmreport", "plugins", folder=tmp_path).stdout
    (line,) = (line for line in listed.splitlines() if "house:ha-1" in line)
    assert "zlmreport-house-standard" in line


@pytest.mark.long
def test_it_is_not_there_without_being_installed(environment: Environment, tmp_path: Path) -> None:
    done = environment.run("zlmreport", "plugins", folder=tmp_path)
    assert done.returncode == 0, done.stderr
    assert "house:ha-1" not in done.stdout


@pytest.mark.long
def test_its_results_are_those_of_the_worked_example(outcome: Path) -> None:
    results = json.loads((outcome / "HA-EXAMPLE-1.json").read_bytes())
    (evaluation,) = results["evaluations"]
    values = {
        each["symbol"]: (round(each["value"], 6), each["conforms"]) for each in evaluation["parameters"]
    }
    assert evaluation["standard"] == "house:ha-1"
    assert values == {"D": (11.0, True), "H": (6.0, True), "W": (4.0, True), "T": (12.5, True)}


@pytest.mark.long
def test_its_own_columns_stand_in_the_results_by_position(outcome: Path) -> None:
    results = json.loads((outcome / "HA-EXAMPLE-1.json").read_bytes())
    positions = results["evaluations"][0]["positions"]
    assert [round(position["range_bwd"], 6) for position in positions] == [2, 2, 2, 2, 4]


def test_its_certificate_is_a_pdf_with_its_words(outcome: Path) -> None:
    reader = PdfReader(outcome / "HA-EXAMPLE-1.pdf")
    text = "\n".join(page.extract_text() for page in reader.pages)
    assert "Results by HA-1" in text
    assert "weighted total deviation" in text


@pytest.mark.long
def test_its_tests_pass_with_nothing_but_the_public_kit(
    house_environment: Environment, tmp_path: Path
) -> None:
    shutil.copytree(HOUSE_STANDARD / "tests", tmp_path / "tests")
    shutil.copy(HOUSE_STANDARD / "pyproject.toml", tmp_path)
    done = house_environment.run("python", "-m", "pytest", "-p", "no:cacheprovider", "-q", folder=tmp_path)
    assert done.returncode == 0, done.stdout + done.stderr
