"""A folder of jobs: what fails, what is due, and each opens."""

from __future__ import annotations

import datetime as dt
import shutil
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from starlette.testclient import TestClient

from processes import awaited
from web.jobs import registry
from zlmreport.errors import InputError
from zlmreport.language import Language
from zlmreport.web.folder import JobFolder, JobRow, JobState, collect_row, find_jobs_in, look_at
from zlmreport.web.folder_app import FolderWorkbench
from zlmreport.web.guard import Door

TODAY = dt.date(2026, 11, 26)


@pytest.fixture
def folder(job: Path) -> Iterator[FolderWorkbench]:
    """Return the workbench of a folder that holds the example's job."""
    made = FolderWorkbench(JobFolder(job.parent, registry(), lambda: TODAY), registry())
    yield made
    made.end()


@pytest.fixture
def listing(folder: FolderWorkbench, door: Door) -> TestClient:
    """Return a browser that came by the address on the terminal."""
    client = TestClient(
        folder.make_app(door), base_url=f"http://127.0.0.1:{door.port}", follow_redirects=False
    )
    assert client.get(door.address).status_code == 303
    client.headers["Origin"] = f"http://127.0.0.1:{door.port}"
    return client


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


def test_nobody_opens_a_job_without_the_token(folder: FolderWorkbench, door: Door) -> None:
    stranger = TestClient(folder.make_app(door), base_url=f"http://127.0.0.1:{door.port}")
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
    job.write_text(job.read_text("utf-8").replace("- offset", "- ofset"), "utf-8")
    (row,) = rows(listing)
    assert listing.get(f"/jobs/{row['key']}/").status_code == 200
    assert "did you mean 'offset'?" in listing.get(f"/jobs/{row['key']}/api/job").json()["problems"][0]


@pytest.mark.parametrize(
    ("due", "state"),
    [
        (TODAY - dt.timedelta(days=1), JobState.OVERDUE),
        (TODAY, JobState.SOON),
        (TODAY + dt.timedelta(days=90), JobState.SOON),
        (TODAY + dt.timedelta(days=91), JobState.FINE),
        (None, JobState.FINE),
    ],
)
def test_an_axis_is_due_after_its_interval(due: dt.date | None, state: JobState) -> None:
    assert JobRow("", "", JobState.FINE, due=due).date(TODAY, is_latest=True).state is state


@pytest.mark.parametrize("state", [JobState.FAILS, JobState.NOT_MET, JobState.OVERDUE])
def test_being_due_soon_hides_nothing_worse(state: JobState) -> None:
    assert JobRow("", "", state, due=TODAY).date(TODAY, is_latest=True).state is state


def test_the_interval_counts_from_the_day_of_the_measurement(job: Path) -> None:
    job.write_text(f"{job.read_text('utf-8')}\nfleet: {{interval: 180}}\n", "utf-8")
    row, _ = look_at(JobRow("", ""), job, registry())
    assert row.due == dt.date(2027, 5, 17)


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


def test_a_limit_that_is_not_met_is_said(job: Path) -> None:
    text = job.read_text("utf-8").replace(
        "  - iso230-2:2014", "  - {standard: 'iso230-2:2014', tolerances: {A: 5}}"
    )
    job.write_text(text, "utf-8")
    row, _ = look_at(JobRow("", ""), job, registry())
    assert row.state is JobState.NOT_MET, row.problems


def test_only_jobs_are_listed(job: Path) -> None:
    folder = job.parent
    (folder / "fleet.yaml").write_text("schema: zlmreport/fleet/1\n", "utf-8")
    hidden = folder / ".old"
    hidden.mkdir()
    shutil.copy(job, hidden)
    assert find_jobs_in(folder) == (job,)


def test_a_folder_without_a_job_is_refused(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="no job or machine file lies here"):
        find_jobs_in(tmp_path)


@pytest.mark.long
def test_a_job_without_an_error_model_is_listed_and_does_not_open() -> None:
    circle = Path(__file__).parents[2] / "configs" / "circle" / "certificate.yaml"
    row, _ = look_at(JobRow("", ""), circle, registry())
    assert row.state is not JobState.FAILS, row.problems
    assert "no installed effect acts on that" in row.closed


def test_a_state_is_told_in_german() -> None:
    row = JobRow("k", "x.yaml", JobState.OVERDUE, due=dt.date(2026, 11, 1))
    assert collect_row(row, Language.GERMAN)["words"] == "überfällig"


@pytest.mark.parametrize("ending", [".YAML", ".Yml"])
def test_a_job_is_found_whatever_the_case_of_its_ending(tmp_path: Path, ending: str) -> None:
    job = tmp_path / f"x-axis{ending}"
    job.write_text("schema: zlmreport/job/1\n")
    assert find_jobs_in(tmp_path) == (job,)
