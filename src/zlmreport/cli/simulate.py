"""``zlmreport simulate``: readings of an axis that never was."""

from __future__ import annotations

from argparse import Namespace

from zlmreport import pipeline
from zlmreport.cli.terminal import shown_path
from zlmreport.job.simulation import SimulationFile, load_simulation
from zlmreport.pipeline import Document
from zlmreport.plugins import find_plugins
from zlmreport.simulation.interpret import description_of
from zlmreport.simulation.simulate import simulate
from zlmreport.simulation.writing import job_text, readings_table


def run(options: Namespace) -> int:
    """Write the readings anew, and the job unless it is there: somebody may have worked on it."""
    registry = find_plugins(files=options.plugin)
    file = load_simulation(options.specification, registry)
    measurements = simulate(description_of(file, registry.effect)).measurements
    folder = options.output or options.specification.parent
    readings = folder / (file.keys.output.readings or f"{options.specification.stem}.csv")
    job = folder / file.keys.output.job
    is_new = not job.exists()
    documents = [Document(readings, readings_table(measurements, _remarks(file)).encode())]
    if is_new:
        documents.append(Document(job, job_text(file, folder, readings.name).encode()))
    for path in pipeline.write(documents):
        print(shown_path(path))
    if not is_new:
        print(f"{shown_path(job)} is there already and was left as it is")
    print(f"next: zlmreport {shown_path(job)}")
    return 0


def _remarks(file: SimulationFile) -> tuple[str, ...]:
    """Return what the head of the readings says of their origin."""
    origin = f"sha256 {file.source.sha256[:16]}…, seed {file.keys.seed}"
    return (
        "Simulated readings, not measurements.",
        f"Source: zlmreport simulate {file.source.name} ({origin})",
    )
