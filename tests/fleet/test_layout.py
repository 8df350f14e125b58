"""Certificates lie in folders by machine and axis, whatever these are called."""

from __future__ import annotations

from pathlib import Path

import pytest

from job.jobs import REGISTRY, SOUND
from zlmreport.fleet.records import find_folder_of, write_designation
from zlmreport.job.loading import load
from zlmreport.plugin.extension import JobKeys


def keys(folder: Path, machine: str, axis: str = "X") -> JobKeys:
    path = folder / "job.yaml"
    text = SOUND.replace("{serial: 17}", machine).replace("name: X", f"name: {axis}")
    path.write_text(text, encoding="utf-8")
    return load(path, REGISTRY).keys


@pytest.mark.parametrize(
    ("layout", "folder"),
    [
        ("{machine}/{axis}", "Werk-Müller-HMC-500-17/X"),
        ("{serial}", "17"),
        ("{manufacturer}/{model}/{number}", "Werk-Müller/HMC-500/CAL-1"),
        ("all", "all"),
    ],
)
def test_a_layout_is_filled_by_what_the_job_says(tmp_path: Path, layout: str, folder: str) -> None:
    machine = "{manufacturer: Werk Müller, model: HMC 500, serial: 17}"
    assert str(find_folder_of(keys(tmp_path, machine), layout)) == folder


@pytest.mark.parametrize("serial", ["../../etc", "/etc/x", "..", "a\\b:c"])
def test_no_name_leads_out_of_its_folder(tmp_path: Path, serial: str) -> None:
    folder = find_folder_of(keys(tmp_path, f"{{serial: '{serial}'}}"), "{serial}/{axis}")
    assert len(folder.parts) == 2
    assert ".." not in folder.parts


def test_what_a_job_does_not_say_has_a_folder_too(tmp_path: Path) -> None:
    assert str(find_folder_of(keys(tmp_path, "{}"), "{machine}/{model}")) == "no-machine/no-model"


def test_a_machine_is_called_by_manufacturer_model_and_serial_number(tmp_path: Path) -> None:
    assert write_designation(keys(tmp_path, "{model: HMC 500, serial: 17}").machine) == "HMC 500 17"
