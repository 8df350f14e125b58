"""``zlmreport simulate``: from a description to files that the other commands take."""

from __future__ import annotations

from pathlib import Path

import pytest

from model.simulation.files import SOUND, with_line
from zlmreport.cli import main


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Return a folder with a simulation file, in which commands work."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "spec.yaml").write_text(SOUND, encoding="utf-8")
    return tmp_path


def test_readings_and_a_job_are_written(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["simulate", "spec.yaml", "--output", "trial"]) == 0
    written, job, following = capsys.readouterr().out.splitlines()
    assert (written, job) == ("trial/spec.csv", "trial/job.yaml")
    assert following == "next: zlmreport trial/job.yaml"
    assert sorted(path.name for path in (folder / "trial").iterdir()) == ["job.yaml", "spec.csv"]


def test_files_go_beside_the_description_unless_told_otherwise(folder: Path) -> None:
    assert main(["simulate", str(folder / "spec.yaml")]) == 0
    assert (folder / "spec.csv").exists()


@pytest.mark.usefixtures("folder")
def test_the_job_is_one_that_runs(capsys: pytest.CaptureFixture[str]) -> None:
    main(["simulate", "spec.yaml"])
    assert main(["job.yaml", "--format", "json"]) == 0
    assert "SIMULATION-1  axis X" in capsys.readouterr().out


def test_a_job_that_is_there_is_left_and_the_readings_are_made_anew(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (folder / "job.yaml").write_text("mine\n", encoding="utf-8")
    (folder / "spec.csv").write_text("old\n", encoding="utf-8")
    assert main(["simulate", "spec.yaml"]) == 0
    assert (folder / "job.yaml").read_text(encoding="utf-8") == "mine\n"
    assert (folder / "spec.csv").read_text(encoding="utf-8").startswith("# Simulated readings")
    assert "job.yaml is there already and was left as it is" in capsys.readouterr().out


def test_the_readings_name_the_description_and_its_digest(folder: Path) -> None:
    main(["simulate", "spec.yaml"])
    first, second = (folder / "spec.csv").read_text(encoding="utf-8").splitlines()[:2]
    assert first == "# Simulated readings, not measurements."
    assert second.startswith("# Source: zlmreport simulate spec.yaml (sha256 ")
    assert second.endswith("…, seed 5)")


def test_the_job_says_how_far_the_axis_ran_over_where_it_is_unusual(folder: Path) -> None:
    jobs = []
    for overrun in ("4", "5"):
        (folder / "spec.yaml").write_text(
            SOUND.replace("overrun: 4", f"overrun: {overrun}"), encoding="utf-8"
        )
        main(["simulate", "spec.yaml", "--output", overrun])
        jobs.append((folder / overrun / "job.yaml").read_text(encoding="utf-8"))
    assert ["plan: {overrun: 4} # mm" in each for each in jobs] == [True, False]
    assert "overrun" not in jobs[1]


def test_the_same_description_gives_the_same_bytes(folder: Path) -> None:
    contents = []
    for output in ("one", "other"):
        main(["simulate", "spec.yaml", "--output", output])
        contents.append([path.read_bytes() for path in sorted((folder / output).iterdir())])
    assert contents[0] == contents[1]


def test_a_mistake_is_told_at_its_place_and_nothing_is_written(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (folder / "spec.yaml").write_text(with_line(10, "effects: [backlash]"), encoding="utf-8")
    assert main(["simulate", "spec.yaml"]) == 2
    captured = capsys.readouterr()
    assert captured.err.startswith("spec.yaml:10:11: backlash has no size")
    assert captured.out == ""
    assert sorted(path.name for path in folder.iterdir()) == ["spec.yaml"]


@pytest.mark.usefixtures("folder")
def test_a_description_that_is_not_there_cannot_be_read(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["simulate", "none.yaml"]) == 3
    assert capsys.readouterr().err == "none.yaml: cannot be read: no such file or directory\n"


@pytest.mark.usefixtures("folder")
def test_without_a_description_the_command_line_is_wrong(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["simulate"]) == 2
    assert "SPEC.yaml" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("value", "message"),
    [
        ("-1e308", "conditions.axis_temperature.start: '-1e308' is not a number of at least -1e+09"),
        ("-300", "conditions.axis_temperature: lies from -50 to 150 °C"),
    ],
)
def test_a_condition_that_no_room_has_is_refused(
    value: str, message: str, folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    text = SOUND.replace(
        "{axis_temperature: {start: 20.5, end: 22,", f"{{axis_temperature: {{start: {value},"
    )
    (folder / "spec.yaml").write_text(text, encoding="utf-8")
    assert main(["simulate", "spec.yaml"]) == 2
    assert message in capsys.readouterr().err
    assert [path.name for path in folder.iterdir()] == ["spec.yaml"]


def test_an_effect_beyond_all_bounds_is_refused(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    text = SOUND.partition("effects:")[0] + "effects: [{offset: {offset: 1e9}}]\n"
    (folder / "spec.yaml").write_text(text, encoding="utf-8")
    assert main(["simulate", "spec.yaml"]) == 2
    assert "offset: with these values it deviates beyond all bounds" in capsys.readouterr().err
