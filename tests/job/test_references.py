"""How a file that names another finds it."""

from __future__ import annotations

from pathlib import Path

import pytest

from zlmreport.job.types import Enclosure, enclose, find_path_from_job, resolve_path_named

UNPACKED = Path("/unpacked")
ENCLOSURE = Enclosure(
    {
        "job.yaml": UNPACKED / "0/job.yaml",
        "../shared/laboratory.yaml": UNPACKED / "1/laboratory.yaml",
        "../shared/pictures/logo.png": UNPACKED / "2/logo.png",
        "x.csv": UNPACKED / "3/x.csv",
        "old/x.csv": UNPACKED / "4/x.csv",
    },
    UNPACKED / "nowhere",
)


def in_enclosure(reference: str, naming_file: str = "0/job.yaml") -> str:
    with enclose(ENCLOSURE):
        return resolve_path_named(reference, UNPACKED / naming_file).relative_to(UNPACKED).as_posix()


def test_a_file_is_found_beside_the_file_that_names_it() -> None:
    assert resolve_path_named("x.csv", Path("jobs/job.yaml")) == Path("jobs/x.csv")


def test_a_path_from_the_root_stays_what_it_is() -> None:
    assert resolve_path_named("/data/x.csv", Path("jobs/job.yaml")) == Path("/data/x.csv")


@pytest.mark.parametrize(
    ("reference", "found"),
    [
        ("x.csv", "3/x.csv"),
        ("./x.csv", "3/x.csv"),
        ("old/x.csv", "4/x.csv"),
        ("old/../x.csv", "3/x.csv"),
        ("../shared/laboratory.yaml", "1/laboratory.yaml"),
    ],
)
def test_a_job_in_an_enclosure_finds_its_files_as_it_names_them(reference: str, found: str) -> None:
    assert in_enclosure(reference) == found


def test_a_file_that_the_job_extends_names_files_beside_itself() -> None:
    assert in_enclosure("pictures/logo.png", "1/laboratory.yaml") == "2/logo.png"


def test_a_path_from_the_root_finds_the_only_file_of_its_name() -> None:
    assert in_enclosure("/home/anna/logo.png") == "2/logo.png"


@pytest.mark.parametrize(
    "reference",
    ["/etc/passwd", "../../../../etc/passwd", "../laboratory/none.yaml", "/elsewhere/x.csv", ".."],
)
def test_any_other_reference_leads_nowhere(reference: str) -> None:
    assert in_enclosure(reference).startswith("nowhere/")


def test_after_an_enclosure_paths_mean_files_again() -> None:
    in_enclosure("x.csv")
    assert resolve_path_named("x.csv", Path("jobs/job.yaml")) == Path("jobs/x.csv")


def test_an_error_ends_an_enclosure() -> None:
    with pytest.raises(ValueError, match="wrong"), enclose(ENCLOSURE):
        raise ValueError("wrong")
    assert resolve_path_named("x.csv", Path("job.yaml")) == Path("x.csv")


@pytest.mark.parametrize(
    ("file", "job", "path"),
    [
        ("x.csv", "job.yaml", "x.csv"),
        ("jobs/x.csv", "jobs/job.yaml", "x.csv"),
        ("jobs/../laboratory.yaml", "jobs/job.yaml", "../laboratory.yaml"),
        ("/lab/jobs/../laboratory.yaml", "/lab/jobs/job.yaml", "../laboratory.yaml"),
        ("../x.csv", "job.yaml", "../x.csv"),
    ],
)
def test_a_path_is_told_from_the_folder_of_the_job(file: str, job: str, path: str) -> None:
    assert find_path_from_job(Path(file), Path(job)) == path


def test_a_file_elsewhere_has_no_path_from_the_job() -> None:
    assert find_path_from_job(Path("/data/x.csv"), Path("jobs/job.yaml")) is None


def test_an_enclosed_file_has_the_path_that_it_had() -> None:
    with enclose(ENCLOSURE):
        assert find_path_from_job(UNPACKED / "1/laboratory.yaml", UNPACKED / "0/job.yaml") == (
            "../shared/laboratory.yaml"
        )
