"""A folder of jobs: what fails, what is due, and each opens."""

from __future__ import annotations

import datetime as dt
import shutil
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from starlette.testclient import TestClient

from environments import ROOT
from installed import registry
from processes import awaited
from replacing import replace_in
from web.browsers import enter, pass_by
from zlmreport.plugin import InputError
from zlmreport.web.folder import FolderWorkbench, JobFolder

TODAY = dt.date(2026, 11, 26)


@pytest.fixture
def folder(job: Path) -> Iterator[FolderWorkbench]:
    """Return the workbench of a folder that holds the example's job."""
    made = FolderWorkbench(JobFolder(job.parent, registry(), lambda: TODAY), registry())
    yield made
    made.end()


@pytest.fixture
def listing(folder: FolderWorkbench) -> TestClient:
    return enter(folder)


def rows(listing: TestClient) -> list[dict[str, Any]]:
    """Return the jobs once all have been looked at."""

    def known() -> Any:
        found = listing.get("/api/folder").json()["jobs"]
        return found if all(each["state"] != "waits" for each in found) else None

    found: list[dict[str, Any]] = awaited(known)
    return found


def test_a_job_is_listed_with_axis_and_day(listing: TestClient) -> None:
    (job,) = rows(listing)
    assert (job["name"], job["number"], job["state"]) == ("job.yaml", "EXAMPLE-2026-0007", "fine")
    assert (job["axis"], job["measured"], job["due"]) == ("Axis X", "2026-11-18", "")


def test_a_job_opens_as_a_workbench_of_its_own(listing: TestClient) -> None:
    (job,) = rows(listing)
    assert listing.get(f"/jobs/{job['key']}/").status_code == 200
    assert listing.get(f"/jobs/{job['key']}/api/job").json()["number"] == "EXAMPLE-2026-0007"
    assert listing.get("/jobs/none-such/api/job").status_code == 404


def test_a_click_in_a_folder_is_written_into_its_job(job: Path, listing: TestClient) -> None:
    root = f"/jobs/{rows(listing)[0]['key']}"
    digest = listing.get(f"{root}/api/job").json()["digest"]
    added = {"based_on": digest, "action": "add", "effect": "screw-pitch"}
    assert listing.post(f"{root}/api/change", json=added).is_success
    assert "    - screw-pitch\n" in job.read_text("utf-8")


def test_nobody_opens_a_job_without_the_token(folder: FolderWorkbench) -> None:
    stranger = pass_by(folder)
    key = next(iter(folder.folder.list_paths()))
    assert [stranger.get(path).status_code for path in ("/api/folder", f"/jobs/{key}/api/job")] == [403, 403]


def test_what_fails_stands_first_with_its_place_and_is_fine_once_it_is_mended(
    job: Path, listing: TestClient
) -> None:
    text = job.read_text("utf-8")
    job.with_name("a-good.yaml").write_text(text.replace("EXAMPLE-X-7", "OTHER"), "utf-8")
    job.write_text(text.replace("- offset", "- ofset"), "utf-8")
    first, second = rows(listing)
    assert (first["name"], first["state"], second["state"]) == ("job.yaml", "fails", "fine")
    assert "did you mean 'offset'?" in first["problems"][0]
    job.write_text(text, "utf-8")
    assert awaited(lambda: all(each["state"] == "fine" for each in rows(listing)))


def test_a_job_that_fails_opens_and_says_what_is_wrong(job: Path, listing: TestClient) -> None:
    replace_in(job, ("- offset", "- ofset"))
    (row,) = rows(listing)
    assert listing.get(f"/jobs/{row['key']}/").status_code == 200
    assert "did you mean 'offset'?" in listing.get(f"/jobs/{row['key']}/api/job").json()["problems"][0]


def test_an_axis_is_due_after_its_interval_from_the_day_of_the_measurement(
    job: Path, listing: TestClient
) -> None:
    text = job.read_text("utf-8")
    for interval in (7, 8, 98, 99):  # days; the measurement was eight days ago
        own = f"{text.replace('EXAMPLE-X-7', f'X-{interval}')}\nfleet: {{interval: {interval}}}\n"
        job.with_name(f"{interval}.yaml").write_text(own, "utf-8")
    assert {each["name"]: (each["due"], each["state"]) for each in rows(listing)} == {
        "7.yaml": ("2026-11-25", "overdue"),
        "8.yaml": ("2026-11-26", "soon"),
        "98.yaml": ("2027-02-24", "soon"),
        "99.yaml": ("2027-02-25", "fine"),
        "job.yaml": ("", "fine"),
    }
    assert listing.get("/api/folder?lang=de").json()["jobs"][0]["words"] == "überfällig"


@pytest.mark.parametrize(
    ("was", "now", "state"),
    [
        ("  - iso230-2:2014", "  - {standard: 'iso230-2:2014', tolerances: {A: 5}}", "not-met"),
        ("x-axis.csv", "none.csv", "fails"),
    ],
)
def test_what_is_worse_than_being_overdue_is_said_of_an_axis_that_is(
    job: Path, listing: TestClient, was: str, now: str, state: str
) -> None:
    text = job.read_text("utf-8")
    assert was in text
    job.write_text(f"{text.replace(was, now)}\nfleet: {{interval: 7}}\n", "utf-8")
    (row,) = rows(listing)
    assert row["state"] == state, row["problems"]


def test_an_earlier_test_of_an_axis_needs_nobody(job: Path, listing: TestClient) -> None:
    text = job.read_text("utf-8")
    job.with_name("before.yaml").write_text(text.replace("date: 2026-11-18", "date: 2025-11-18"), "utf-8")
    assert [(each["name"], each["state"]) for each in rows(listing)] == [
        ("job.yaml", "fine"),
        ("before.yaml", "earlier"),
    ]


@pytest.mark.parametrize(
    ("was", "other"),
    [
        ("name: X", "name: Y"),
        ("name: X", "name: X2"),
        ("method: linear", "method: linear\n  error: EXX"),
        ("method: linear", "method: linear\n  error: EYX"),
    ],
    ids=["another axis", "a second axis of the letter", "the same error by its symbol", "another error"],
)
def test_a_later_test_leaves_behind_none_of_another_axis_or_error(
    job: Path, listing: TestClient, was: str, other: str
) -> None:
    text = job.read_text("utf-8")
    assert was in text
    later = text.replace("date: 2026-11-18", "date: 2026-11-20").replace(was, other)
    if "EYX" in other:
        later = later.replace("iso230-2:2014", '"iso230-1:2012"')
    job.with_name("later.yaml").write_text(later, "utf-8")
    states = {each["name"]: each["state"] for each in rows(listing)}
    assert states == {"later.yaml": "fine", "job.yaml": "earlier" if "EXX" in other else "fine"}


def test_only_jobs_are_listed_whatever_the_case_of_their_ending(job: Path, listing: TestClient) -> None:
    folder = job.parent
    (folder / "fleet.yaml").write_text("schema: zlmreport/fleet/1\n", "utf-8")
    hidden = folder / ".old"
    hidden.mkdir()
    for copy in (hidden, folder / "y.YAML", folder / "z.Yml"):
        shutil.copy(job, copy)
    assert {each["name"] for each in rows(listing)} == {"job.yaml", "y.YAML", "z.Yml"}


def test_a_folder_without_a_job_is_refused(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="no job or machine file lies here"):
        JobFolder(tmp_path, registry(), lambda: TODAY).list_paths()


@pytest.mark.long
def test_a_job_without_an_error_model_is_listed_and_does_not_open() -> None:
    folder = JobFolder(ROOT / "configs" / "circle", registry(), lambda: TODAY)
    (row,) = (
        each
        for each in rows(enter(FolderWorkbench(folder, registry())))
        if each["name"] == "certificate.yaml"
    )
    assert row["state"] != "fails", row["problems"]
    assert "no installed effect acts on that" in row["closed"]
