"""However a job names its files, they are found again inside the certificate."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest

from verification.issued import JOB, LABORATORY, issue, lay_out
from zlmreport.verification.findings import CheckedCertificate

Verify = Callable[[bytes], CheckedCertificate]


def holds(verified: Verify, job: Path) -> bool:
    found = verified(issue(job))
    assert found.holds
    return bool(found.values)


@pytest.mark.long
@pytest.mark.parametrize("file", ["./x-axis.csv", "../jobs/x-axis.csv", "tables/../x-axis.csv"])
def test_readings_that_are_named_in_a_roundabout_way(tmp_path: Path, verified: Verify, file: str) -> None:
    assert holds(verified, lay_out(tmp_path, job=JOB.replace("file: x-axis.csv", f"file: {file}")))


@pytest.mark.long
def test_readings_that_are_named_from_the_root(tmp_path: Path, verified: Verify) -> None:
    named = JOB.replace("file: x-axis.csv", f"file: {tmp_path}/jobs/x-axis.csv")
    assert holds(verified, lay_out(tmp_path, job=named))


@pytest.mark.long
def test_a_laboratory_that_is_named_from_the_root(tmp_path: Path, verified: Verify) -> None:
    named = JOB.replace("extends: ../laboratory.yaml", f"extends: {tmp_path}/laboratory.yaml")
    assert holds(verified, lay_out(tmp_path, job=named))


def test_a_job_that_is_named_from_its_own_folder(
    tmp_path: Path, verified: Verify, monkeypatch: pytest.MonkeyPatch
) -> None:
    job = lay_out(tmp_path)
    monkeypatch.chdir(job.parent)
    assert holds(verified, Path("job.yaml"))


def test_files_of_one_name_in_several_folders(tmp_path: Path, verified: Verify) -> None:
    job = lay_out(tmp_path)
    (tmp_path / "jobs/shared").mkdir()
    (tmp_path / "jobs/shared/job.yaml").write_text(LABORATORY.replace("pictures", "../../pictures"))
    job.write_text(JOB.replace("../laboratory.yaml", "shared/job.yaml"))
    assert holds(verified, job)
