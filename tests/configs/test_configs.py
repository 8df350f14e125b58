"""Every example job gives its documents and a digital certificate, and together they show every standard."""

from __future__ import annotations

import contextlib
import json
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from unittest.mock import Mock

import pypdfium2
import pytest
from dcclib.validation.schematron import SchematronValidator

from configs.pages import embarrassments
from document.figures.samples import collisions
from document.typesetting import samples
from environments import ROOT
from installed import registry
from zlmreport import pipeline
from zlmreport.cli import main
from zlmreport.document.certificate.build import lay_out
from zlmreport.files import write
from zlmreport.job.loading import load
from zlmreport.plugin import InputError, Language
from zlmreport.plugin.extension import Job
from zlmreport.plugin.renderer import Certificate, Notice, Paragraph, Section

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
def jobs() -> list[Job]:
    return [load(path, registry()) for path in JOBS]


@dataclass(frozen=True)
class Made:
    """An example's job, its files, and its certificate in each layout that holds it."""

    job: Job
    written: tuple[Path, ...]
    laid_out: Mapping[str, Certificate]


@pytest.fixture(scope="module", params=JOBS, ids=name)
def made(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Made:
    """An example, evaluated once for all tests of it."""
    job = load(request.param, registry())
    job = replace(job, directory=tmp_path_factory.mktemp("made"), formats=(*job.formats, "dcc"))
    with pytest.MonkeyPatch.context() as patch:
        paged = Mock(wraps=lay_out)
        patch.setattr(pipeline, "lay_out", paged)
        outcome = pipeline.run(job, registry())
        written = write(outcome.documents)
    if job.measurements:  # each of which has its own example, in each layout
        return Made(job, tuple(written), {job.keys.certificate.layout: outcome.certificate})
    (material,), _ = paged.call_args
    laid_out = {}
    for layout in ("sheet", "standard", "full"):
        keys = job.keys.certificate.model_copy(update={"layout": layout})
        with contextlib.suppress(InputError):  # a certificate that a sheet does not hold
            certificate = replace(job, keys=job.keys.model_copy(update={"certificate": keys}))
            laid_out[layout] = lay_out(replace(material, job=certificate))
    return Made(job, tuple(written), laid_out)


@pytest.mark.long
def test_a_job_gives_each_of_its_formats_and_each_of_its_standards(made: Made) -> None:
    stem = made.job.keys.certificate.number
    suffixes = {"dcc": "xml"}
    expected = {f"{stem}.{suffixes.get(identifier, identifier)}" for identifier in made.job.formats}
    assert {file.name for file in made.written} == expected
    rules = SchematronValidator.for_dcc().validate_file(made.job.directory / f"{stem}.xml")
    assert rules.failed_assertions == []
    results = json.loads((made.job.directory / f"{stem}.json").read_bytes())
    stated = [choice.identifier for part in made.job.parts for choice in part.standards]
    assert [evaluation["standard"] for evaluation in results["evaluations"]] == stated


@pytest.mark.long
def test_no_page_of_any_layout_embarrasses(made: Made) -> None:
    press = registry().renderer("pdf-typst")
    found = {layout: embarrassments(each, press.render(each)) for layout, each in made.laid_out.items()}
    of_files = [each for each in made.written if each.suffix == ".pdf"]
    asked_for = made.laid_out[made.job.keys.certificate.layout]
    found |= {each.name: embarrassments(asked_for, each.read_bytes()) for each in of_files}
    assert not {where: what for where, what in found.items() if what}


@pytest.mark.long
@pytest.mark.parametrize("press", ["pdf", "pdf-typst"])
@pytest.mark.parametrize(
    ("example", "layout"),
    [
        ("as-found/certificate", "standard"),
        ("as-found/certificate", "full"),
        ("step-gauge/job", "full"),
    ],
)
def test_no_page_with_long_german_names_embarrasses(example: str, layout: str, press: str) -> None:
    job = load(CONFIGS / f"{example}.yaml", registry())
    keys = job.keys.certificate.model_copy(update={"language": Language.GERMAN, "layout": layout})
    job = replace(job, keys=job.keys.model_copy(update={"certificate": keys}))
    certificate = pipeline.compose(job, registry())
    assert not embarrassments(certificate, registry().renderer(press).render(certificate))


@pytest.mark.long
def test_nothing_drawn_in_any_layout_collides(made: Made) -> None:
    figures = {each.key: each for every in made.laid_out.values() for each in every.figures}
    assert not {key: what for key, each in figures.items() if (what := collisions(each))}


def test_an_embarrassing_page_is_found() -> None:
    lone = Section("lone", "Lone", (Notice("Only a note", ("of one item",)),), new_page=True)
    last = Section("last", "Last", (Paragraph("The end."),), new_page=True)
    certificate = samples.certificate(standards=1, sections=(lone, last))
    pdf = registry().renderer("pdf-typst").render(certificate)
    pages = len(pypdfium2.PdfDocument(pdf))
    assert embarrassments(certificate, pdf) == [
        f"page {pages - 1} is filled to 0.10",
        f"page {pages} leaves alone '2 Last / The end. / — End of the calibration certificate —'",
    ]


def test_each_standard_is_shown_by_a_job(jobs: list[Job]) -> None:
    shown = {choice.identifier for job in jobs for choice in job.standards}
    built_in = {
        identifier
        for identifier, plugin in ((each.identifier, each.plugin) for each in registry().list_offers())
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
