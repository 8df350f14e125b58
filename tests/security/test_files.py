"""A job writes its own files into the folder that it names, and touches nothing else."""

from __future__ import annotations

from hashlib import sha256
from pathlib import Path

import pytest

from security.hostile import READINGS, job_with
from zlmreport.cli import main


@pytest.fixture
def job(tmp_path: Path) -> Path:
    folder = tmp_path / "jobs"
    folder.mkdir()
    (folder / "x-axis.csv").write_text(READINGS, encoding="utf-8")
    path = folder / "job.yaml"
    path.write_text(job_with(lambda key: f"x {key[-1]}"), encoding="utf-8")
    return path


def _tree(folder: Path) -> dict[str, str]:
    """Every file below a folder, with its digest."""
    return {
        path.relative_to(folder).as_posix(): sha256(path.read_bytes()).hexdigest()
        for path in folder.rglob("*")
        if path.is_file()
    }


def _make(job: Path, output: Path) -> int:
    return main([str(job), "--quiet", "--format", "json", "--output", str(output)])


def test_nothing_is_written_but_the_files_of_its_formats(job: Path, tmp_path: Path) -> None:
    before = _tree(tmp_path)
    assert _make(job, tmp_path / "out") == 0
    after = _tree(tmp_path)
    assert set(after) - set(before) == {"out/CAL-1.json"}
    assert before.items() <= after.items()


def test_a_link_in_the_place_of_a_file_is_replaced_and_what_it_leads_to_stays(
    job: Path, tmp_path: Path
) -> None:
    treasure = tmp_path / "treasure"
    treasure.write_text("untouched", encoding="utf-8")
    (tmp_path / "out").mkdir()
    link = tmp_path / "out" / "CAL-1.json"
    link.symlink_to(treasure)
    assert _make(job, tmp_path / "out") == 0
    assert treasure.read_text(encoding="utf-8") == "untouched"
    assert not link.is_symlink()


def test_a_link_that_leads_nowhere_is_replaced_as_well(job: Path, tmp_path: Path) -> None:
    (tmp_path / "out").mkdir()
    (tmp_path / "out" / "CAL-1.json").symlink_to(tmp_path / "elsewhere.json")
    assert _make(job, tmp_path / "out") == 0
    assert not (tmp_path / "elsewhere.json").exists()


def test_files_are_made_readable_as_the_user_wishes_and_never_executable(job: Path, tmp_path: Path) -> None:
    assert _make(job, tmp_path / "out") == 0
    assert (tmp_path / "out" / "CAL-1.json").stat().st_mode & 0o111 == 0


@pytest.mark.timeout(20)
@pytest.mark.parametrize("key", ["logo", "file", "extends"])
def test_a_device_in_the_place_of_a_file_is_refused_and_not_read_for_ever(
    key: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    logo, file, extends = ("/dev/zero" if key == each else "" for each in ("logo", "file", "extends"))
    lines = [
        "schema: zlmreport/job/1",
        f"extends: {extends}" if extends else "",
        "certificate: {number: CAL-1, kind: report}",
        f"laboratory: {{name: L, logo: {logo}}}" if logo else "",
        "axis: {name: X}",
        f"measurement: {{source: {{plugin: laser-csv, file: {file or 'x-axis.csv'}}}}}",
        "evaluate: [nmtba]",
    ]
    (tmp_path / "x-axis.csv").write_text(READINGS, encoding="utf-8")
    (tmp_path / "job.yaml").write_text("\n".join(lines), encoding="utf-8")
    assert _make(tmp_path / "job.yaml", tmp_path / "out") in {2, 3}
    assert "zero" in capsys.readouterr().err
