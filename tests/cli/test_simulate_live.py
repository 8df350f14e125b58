"""``zlmreport simulate --emulate``: a whole calibration in real time, and nothing of it is there."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from processes import ZLMREPORT, started
from zlmreport.cli import main
from zlmreport.plugin import Axis, Place
from zlmreport.plugin.protocols import SourceContext
from zlmreport.plugin.registry import find_plugins

SIMULATION = """\
schema: zlmreport/simulation/1
seed: 4
axis: {name: X, travel: [0, 40]}
targets: {positions: [0, 11, 23]}
runs: 1
overrun: 4
feed: 3000
dwell: 1.6
effects: [{backlash: {lost_motion: -4}}]
noise: {reading: 0.5}
conditions: {air_temperature: {start: 24}}
"""
MODEL = "model:\n  effects:\n    - offset\n    - scale-error\n    - backlash\n"


@pytest.fixture
def specification(tmp_path: Path) -> Path:
    path = tmp_path / "spec.yaml"
    path.write_text(SIMULATION, encoding="utf-8")
    return path


@pytest.mark.long
@pytest.mark.early
def test_plan_machine_instrument_capture_and_certificate_go_together(specification: Path) -> None:
    """The readings are longer by Δn of the warm air, which the job is told to correct."""
    folder = specification.parent
    link = folder / "interferometer"
    command = (*ZLMREPORT, "simulate", specification, "--emulate", "umd1", "--link", link, "--start", "2")
    with started(*command) as simulation:
        said = simulation.lines(6)
        job = folder / "job.yaml"  # an emulator on a busy computer is silent for a while
        patient = job.read_text(encoding="utf-8").replace("{plugin: umd1, ", "{plugin: umd1, timeout: 60, ")
        job.write_text(patient, encoding="utf-8")
        assert main(["capture", str(job)]) == 0
        said += simulation.ended()
    assert said[2:4] == ["umd1: Laser interferometer display µMD1, emulated\n", f"port: {link}\n"]
    assert said[6] == "the program has started\n"
    assert not link.exists()
    corrections = "corrections: {air: {assumed: standard air}, datum: -4}\n"
    without_model = job.read_text(encoding="utf-8").replace(MODEL, "")  # six readings are too few for one
    job.write_text(without_model + corrections, encoding="utf-8")
    assert main([str(job), "--format", "json", "--quiet"]) == 0
    results = json.loads((folder / "out" / "SIMULATION-1.json").read_text(encoding="utf-8"))
    positions = results["evaluations"][0]["positions"]
    truth = _true_means(folder / "spec-truth.csv")
    # µm: a step of the display, the rounding of the truth, what the last way to a target adds to the mean of
    # a hundred readings, and the last digit of the air's temperature, of 0.01 K and 1 ppm/K over 27 mm
    allowed = 0.0013 + 0.0005 + 0.01 + 0.0003
    for side, expected in zip(("fwd", "bwd"), truth, strict=True):
        assert [row[f"mean_{side}"] for row in positions] == pytest.approx(expected, abs=allowed)


def _true_means(table: Path) -> list[list[float]]:
    """Return the means of what the axis did, upwards and downwards, µm."""
    source = find_plugins().source("laser-csv")
    context = SourceContext(Axis("X"), Place("job.yaml"))
    read = source.read(source.options.model_validate({"file": table}), context)
    means: list[list[float]] = (read.deviations().mean(axis=-1) * 1e6).tolist()
    return means


def test_every_instrument_can_watch_the_axis(specification: Path) -> None:
    command = (*ZLMREPORT, "simulate", specification, "--emulate", "ids3010", "--port", "0")
    with started(*command) as simulation:
        said = simulation.lines(6)
        simulation.ended()
    port = said[3].removeprefix("port: ").strip()
    assert port.startswith("socket://127.0.0.1:")
    assert f"port: {port}" in (specification.parent / "job.yaml").read_text(encoding="utf-8")


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["--emulate", "no-such"], "no plugin provides instrument 'no-such'"),
        (["--emulate", "umd1", "--start=-1"], "--start -1 has gone by"),
        (["--emulate", "umd1", "--link", "a", "--port", "0"], "take one"),
    ],
)
def test_a_mistake_is_told_and_nothing_is_written(
    arguments: list[str], message: str, specification: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["simulate", str(specification), *arguments]) == 2
    assert message in capsys.readouterr().err
    assert [path.name for path in specification.parent.iterdir()] == ["spec.yaml"]
