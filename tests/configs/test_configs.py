"""Every example job gives its documents and a digital certificate, and together they show every standard."""

from __future__ import annotations

import json
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import pytest
from dcclib.validation.schematron import SchematronValidator

from environments import ROOT
from zlmreport import pipeline
from zlmreport.cli import main
from zlmreport.files import write
from zlmreport.job.job import Job
from zlmreport.job.loading import load
from zlmreport.plugins import Registry, find_plugins

CONFIGS = ROOT / "configs"
#: The jobs of the fleet have tests of their own.
FLEET = CONFIGS / "fleet"
#: What other jobs extend is no job by itself.
JOBS = sorted(
    path
    for path in CONFIGS.rglob("*.yaml")
    if FLEET not in path.parents and "schema: zlmreport/job/1" in path.read_text(encoding="utf-8")
)
SIMULATIONS = sorted(
    path
    for path in CONFIGS.rglob("*.yaml")
    if "schema: zlmreport/simulation/1" in path.read_text(encoding="utf-8")
)
#: Real readings; beside a simulation, a script that makes them, or an emulated capture stand others.
MADE = {each.parent for each in (*SIMULATIONS, *CONFIGS.rglob("make.py"), *CONFIGS.rglob("*.journal"))}
DATA = sorted(
    path for path in CONFIGS.rglob("*.csv") if FLEET not in path.parents and path.parent not in MADE
)


def name(path: Path) -> str:
    return path.relative_to(CONFIGS).as_posix()


@pytest.fixture(scope="module")
def registry() -> Registry:
    return find_plugins()


@pytest.fixture(scope="module")
def jobs(registry: Registry) -> list[Job]:
    return [load(path, registry) for path in JOBS]


@pytest.mark.parametrize("path", JOBS, ids=name)
def test_a_job_gives_each_of_its_formats_and_each_of_its_standards(
    path: Path, registry: Registry, tmp_path: Path
) -> None:
    job = load(path, registry)
    job = replace(job, directory=tmp_path, formats=(*job.formats, "dcc"))
    written = write(pipeline.run(job, registry).documents)
    stem = job.keys.certificate.number
    suffixes = {"dcc": "xml"}
    expected = {f"{stem}.{suffixes.get(identifier, identifier)}" for identifier in job.formats}
    assert {file.name for file in written} == expected
    rules = SchematronValidator.for_dcc().validate_file(tmp_path / f"{stem}.xml")
    assert rules.failed_assertions == []
    results = json.loads((tmp_path / f"{stem}.json").read_bytes())
    stated = [choice.identifier for choice in job.standards]
    assert [evaluation["standard"] for evaluation in results["evaluations"]] == stated


def test_each_standard_is_shown_by_a_job(jobs: list[Job], registry: Registry) -> None:
    shown = {choice.identifier for job in jobs for choice in job.standards}
    built_in = {
        identifier
        for identifier, plugin in ((each.identifier, each.plugin) for each in registry.offers())
        if plugin.module.startswith("zlmreport_plugins.standards.")
    }
    assert built_in <= shown


def test_numbers_of_certificates_are_unique(jobs: list[Job]) -> None:
    numbers = [job.keys.certificate.number for job in jobs]
    assert sorted(numbers) == sorted(set(numbers))


@pytest.mark.parametrize("path", DATA, ids=name)
def test_readings_name_their_source(path: Path) -> None:
    comments = [line for line in path.read_text(encoding="utf-8").splitlines() if line.startswith("#")]
    assert any("Source: github.com/" in line or "Quelle: github.com/" in line for line in comments)


@pytest.mark.parametrize("path", DATA, ids=name)
def test_readings_are_those_of_the_published_set(path: Path) -> None:
    published = [set(readings(file)) for file in (ROOT / "tests" / "data" / "published").glob("*.csv")]
    assert set(readings(path)) in published


@pytest.mark.parametrize("path", SIMULATIONS, ids=name)
def test_simulated_readings_are_those_that_the_simulation_makes(path: Path, tmp_path: Path) -> None:
    assert main(["simulate", str(path), "--output", str(tmp_path)]) == 0
    (made,) = tmp_path.glob("*.csv")
    stands = (path.parent / made.name).read_text(encoding="utf-8")
    assert made.read_text(encoding="utf-8") == stands
    assert stands.startswith("# Simulated readings, not measurements.\n")


def test_invented_parties_are_named_examples(jobs: list[Job]) -> None:
    for job in jobs:
        keys = job.keys
        parties = [keys.laboratory, keys.customer, keys.certificate.authorised_by]
        invented = [party.name for party in parties if party] + [keys.machine.manufacturer or "Example"]
        assert all("Example" in each or "Beispiel" in each for each in invented)


def readings(path: Path) -> Iterator[tuple[float, str, int, float]]:
    """Yield (target, direction, run, deviation) of each row, whatever the decimal sign."""
    lines = [line for line in path.read_text(encoding="utf-8").splitlines() if not line.startswith("#")]
    separator = ";" if ";" in lines[0] else ","
    for line in lines[1:]:
        target, direction, run, deviation = line.split(separator)
        yield float(target.replace(",", ".")), direction, int(run), float(deviation.replace(",", "."))
