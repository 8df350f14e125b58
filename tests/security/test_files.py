"""A job writes its own files into the folder that it names, and touches nothing else."""

from __future__ import annotations

import os
import tracemalloc
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


@pytest.mark.parametrize(
    "command",
    ["", "check", "fleet", "simulate", "verify", "look", "model diagnose", "plan", "surface --at 1,1"],
)
def test_a_pipe_in_the_place_of_a_file_is_refused_and_not_waited_for(
    command: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    pipe = tmp_path / "job.yaml"
    os.mkfifo(pipe)
    assert main([*command.split(), str(pipe)]) == 3
    assert capsys.readouterr().err == f"{pipe}: cannot be read: it is no file but a device or a pipe\n"


def test_a_fleet_file_of_gigabytes_is_not_read_to_its_end(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "fleet.yaml"
    path.touch()
    os.truncate(path, 3 << 30)
    tracemalloc.start()
    try:
        assert main(["fleet", str(path)]) == 2
        _, most = tracemalloc.get_traced_memory()
    finally:
        tracemalloc.stop()
    assert "is larger than 1 MiB" in capsys.readouterr().err
    assert most < 20 << 20


def test_no_file_but_yaml_is_extended_and_shown(job: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (job.parent / "shadow").write_text("root:$6$secret:1::\n", encoding="utf-8")
    job.write_text(f"extends: shadow\n{job.read_text(encoding='utf-8')}", encoding="utf-8")
    assert _make(job, job.parent / "out") == 2
    said = capsys.readouterr().err
    assert said == f"{job}:1:10: extends: 'shadow' is no YAML file; its name ends in .yaml, .yml, .json\n"


@pytest.mark.parametrize("number", ["CON", "nul.x", "LPT1", "com0.pdf"])
def test_a_number_that_is_a_device_on_windows_names_no_files(
    number: str, job: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    text = job.read_text(encoding="utf-8").replace("number: CAL-1", f"number: {number}")
    job.write_text(text, encoding="utf-8")
    assert _make(job, job.parent / "out") == 2
    assert f"{number!r} cannot name files on Windows" in capsys.readouterr().err


def _confined(job: Path, *arguments: str) -> int:
    return main([str(job), "--quiet", "--format", "json", "--confine", str(job.parent), *arguments])


def test_a_confined_job_makes_its_files_in_the_folder(job: Path) -> None:
    assert _confined(job, "--output", str(job.parent / "out")) == 0
    assert (job.parent / "out" / "CAL-1.json").exists()


@pytest.mark.parametrize("way", ["path", "root", "link", "extends", "logo", "output"])
def test_a_confined_job_comes_to_nothing_outside(
    way: str, job: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    outside = tmp_path / "secret.csv"
    (job.parent / "x-axis.csv").rename(outside)
    (tmp_path / "other.yaml").write_text("machine: {serial: secret}\n", encoding="utf-8")
    text = job.read_text(encoding="utf-8")
    if way == "link":
        (job.parent / "x-axis.csv").symlink_to(outside)
    elif way == "path":
        text = text.replace("file: x-axis.csv", "file: ../secret.csv")
    elif way == "root":
        text = text.replace("file: x-axis.csv", f"file: {outside}")
    else:
        (job.parent / "x-axis.csv").write_text(READINGS, encoding="utf-8")
    if way == "extends":
        text = f"extends: ../other.yaml\n{text}"
    elif way == "logo":
        text = text.replace("laboratory:\n", "laboratory:\n  logo: ../logo.png\n", 1)
    job.write_text(text, encoding="utf-8")
    before = _tree(tmp_path)
    code = _confined(job, "--output", str((tmp_path if way == "output" else job.parent) / "out"))
    said = capsys.readouterr().err
    assert code == (3 if way == "output" else 2)
    assert "to which this run is confined" in said
    told = said.replace(str(tmp_path), "")  # which has a number of its own
    assert "100" not in told.partition("to which")[2]
    assert _tree(tmp_path) == before


def test_a_link_is_followed_before_it_is_judged(job: Path) -> None:
    """What matters is where a file lies, and not by which name a job comes to it."""
    (job.parent / "x-axis.csv").rename(job.parent / "real.csv")
    (job.parent / "x-axis.csv").symlink_to(job.parent / "real.csv")
    assert _confined(job, "--output", str(job.parent / "out")) == 0


def test_a_fleet_is_confined_by_its_own_key(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    folder = tmp_path / "fleet"
    folder.mkdir()
    (tmp_path / "x-axis.csv").write_text(READINGS, encoding="utf-8")
    job = job_with(lambda key: f"x {key[-1]}").replace("file: x-axis.csv", "file: ../x-axis.csv")
    (folder / "a.yaml").write_text(job, encoding="utf-8")
    fleet = folder / "fleet.yaml"
    keys = "schema: zlmreport/fleet/1\njobs: a.yaml\nconfine: .\n"
    keys += "executor: {workers: 1}\noutput: {formats: [json]}\n"
    fleet.write_text(keys, encoding="utf-8")
    assert main(["fleet", str(fleet), "--quiet"]) == 4
    assert "to which this run is confined" in capsys.readouterr().err
    fleet.write_text(f"{keys}ledger: ../ledger.db\n", encoding="utf-8")
    assert main(["fleet", str(fleet), "--quiet"]) == 2
    assert "ledger: " in capsys.readouterr().err
    assert sorted(path.name for path in tmp_path.iterdir()) == ["fleet", "x-axis.csv"]
