"""A sound simulation file, to be spoilt line by line."""

from __future__ import annotations

from pathlib import Path

from installed import registry
from zlmreport import ZlmreportError
from zlmreport.job.simulation import SimulationFile, load_simulation
from zlmreport.model.simulation.description import Description
from zlmreport.model.simulation.files import read_description_of

SOUND = """\
schema: zlmreport/simulation/1
seed: 5
axis: {name: X, travel: [0, 600], screw_pitch: 10}
targets: {count: 13}
method: linear
runs: 3
overrun: 4
feed: 3000
dwell: 2
effects: [offset: {offset: 1.5}, {backlash: {lost_motion: -4}}, {screw-pitch: {sine: 2}}]
noise: {reading: 0.5, resolution: 0.1}
conditions: {axis_temperature: {start: 20.5, end: 22, time_constant: 600, sensor_noise: 0.01}}
"""
REGISTRY = registry()


def with_line(number: int, line: str) -> str:
    """Return the sound file with one of its lines replaced."""
    lines = SOUND.splitlines()
    lines[number - 1] = line
    return "\n".join(lines) + "\n"


def loaded(text: str, folder: Path) -> SimulationFile:
    path = folder / "simulation.yaml"
    path.write_text(text, encoding="utf-8")
    return load_simulation(path, REGISTRY)


def described(text: str, folder: Path) -> Description:
    return read_description_of(loaded(text, folder), REGISTRY.effect)


def mistakes(text: str, folder: Path) -> list[str]:
    """Return the messages on a file, without its folder and name; none if it is sound."""
    try:
        described(text, folder)
    except ZlmreportError as error:
        return [str(problem).removeprefix(f"{folder}/simulation.yaml:") for problem in error.problems]
    return []
