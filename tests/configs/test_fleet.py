"""The example fleet is what its program makes, and shows a failure, a drift, and a limit that is not met."""

from __future__ import annotations

import json
import re
import shutil
from pathlib import Path

import pytest

from environments import ROOT
from processes import PYTHON, run
from zlmreport.cli import main
from zlmreport.job.loading import load
from zlmreport.plugin.registry import find_plugins

FLEET = ROOT / "configs" / "fleet"
JOBS = sorted(FLEET.glob("*/*-20*.yaml"))
#: The axes that show something, and some that do not, so that the tests of the fleet have a fleet.
SHOWN = ("mc-800/y-20*", "lt-250/c-20*", "sm-300/x-20*", "cm-7/x-20*")


def files(folder: Path) -> dict[str, bytes]:
    return {
        path.relative_to(folder).as_posix(): path.read_bytes()
        for path in folder.glob("*/*")
        if path.suffix in {".yaml", ".csv"}
    }


def test_the_files_are_those_that_the_program_makes(tmp_path: Path) -> None:
    run(PYTHON, FLEET / "make.py", tmp_path, check=True)
    assert files(tmp_path) == files(FLEET)


def test_the_fleet_has_at_least_24_axes() -> None:
    assert len({(job.parent.name, job.name.partition("-")[0]) for job in JOBS}) >= 24


def test_every_axis_has_a_history_that_is_long_enough_to_be_tested_for_drift() -> None:
    dates: dict[tuple[str, str], int] = {}
    for job in JOBS:
        axis = job.parent.name, job.name.partition("-")[0]
        dates[axis] = dates.get(axis, 0) + 1
    assert min(dates.values()) >= 5


def test_the_fleet_is_small() -> None:
    assert sum(path.stat().st_size for path in FLEET.rglob("*.*")) < 1_500_000


def test_jobs_are_right_and_their_numbers_unique() -> None:
    registry = find_plugins()
    jobs = [load(path, registry) for path in JOBS[::7]]
    assert all(
        "Example" in (job.keys.customer.name or "") or "Beispiel" in job.keys.customer.name for job in jobs
    )
    numbers = re.findall(r"number: (\S+),", "\n".join(job.read_text() for job in JOBS))
    assert len(set(numbers)) == len(JOBS)


@pytest.fixture(scope="module")
def morning(tmp_path_factory: pytest.TempPathFactory) -> tuple[int, Path]:
    """Return the exit code of a night with a part of the fleet, and the folder of its files."""
    place = tmp_path_factory.mktemp("fleet")
    shutil.copytree(ROOT / "configs", place / "configs")
    fleet = place / "configs" / "fleet" / "fleet.yaml"
    patterns = json.dumps([f"{pattern}.yaml" for pattern in SHOWN])
    text = re.sub(r"^jobs: .*$", f"jobs: {patterns}", fleet.read_text(encoding="utf-8"), flags=re.MULTILINE)
    fleet.write_text(text.replace("formats: [html, json]", "formats: [json]"), encoding="utf-8")
    code = main(["fleet", str(fleet), "--quiet"])
    assert main(["fleet", "report", str(fleet)]) == 0
    return code, place / "out" / "fleet"


def test_a_night_with_the_broken_job_says_so_by_its_exit_code(morning: tuple[int, Path]) -> None:
    assert morning[0] == 4


def needs(folder: Path) -> str:
    html = (folder / "fleet.html").read_text(encoding="utf-8")
    text = re.sub(r"<[^>]+>", " ", html.partition('id="needs"')[2].partition("</section>")[0])
    return re.sub(r"\s+", " ", text)


def test_the_overview_names_the_broken_job(morning: tuple[int, Path]) -> None:
    assert re.search(
        r"Failed 1 .*lt-250/c-2026-10\.yaml .*c-2026-10\.csv:10:\d+: .*overflow", needs(morning[1])
    )


def test_the_overview_names_the_axis_whose_limit_is_not_met(morning: tuple[int, Path]) -> None:
    assert re.search(r"Limit not met 1 .* X Beispiel-Maschinenbau SM 300 EX-106", needs(morning[1]))


def test_the_overview_names_the_axis_that_drifts_and_when_its_limit_is_met(morning: tuple[int, Path]) -> None:
    drifting = (
        r"Drifting 1 .* Y Example Machine Works MC 800 EX-102.* \+3\.\d+ ± 0\.\d+ µm/year .* 202[78]-\d\d"
    )
    assert re.search(drifting, needs(morning[1]))


def test_links_of_the_overview_lead_to_files(morning: tuple[int, Path]) -> None:
    links = re.findall(r'href="([^"#]+)"', (morning[1] / "fleet.html").read_text(encoding="utf-8"))
    assert links
    assert [link for link in links if not (morning[1] / link).is_file()] == []


def test_an_overview_elsewhere_leads_to_the_same_files(morning: tuple[int, Path], tmp_path: Path) -> None:
    fleet = morning[1].parents[1] / "configs" / "fleet" / "fleet.yaml"
    assert main(["fleet", "report", str(fleet), "--output", str(tmp_path)]) == 0
    links = re.findall(r'href="([^"#]+)"', (tmp_path / "fleet.html").read_text(encoding="utf-8"))
    assert links
    assert [link for link in links if not (tmp_path / link).is_file()] == []


def test_monitoring_is_told_the_same(morning: tuple[int, Path]) -> None:
    told = (morning[1] / "fleet.prom").read_text(encoding="utf-8")
    assert 'zlmreport_fleet_jobs{fleet="Example fleet",state="failed"} 1.0' in told
