"""``zlmreport simulate``: readings of an axis that never was, or the axis itself to be read."""

from __future__ import annotations

from argparse import Namespace

from zlmreport.cli.simulate_files import remarks, written
from zlmreport.cli.simulate_live import run_live
from zlmreport.cli.terminal import shown_path
from zlmreport.files import Document
from zlmreport.job.simulation import load_simulation
from zlmreport.plugins import find_plugins
from zlmreport.simulation.files import description_of, job_text, readings_table
from zlmreport.simulation.simulate import simulate


def run(options: Namespace) -> int:
    """Write the readings anew, and the job unless it is there; or emulate the machine and its instrument."""
    if options.emulate is not None:
        return run_live(options)
    registry = find_plugins(files=options.plugin)
    file = load_simulation(options.specification, registry)
    measurements = simulate(description_of(file, registry.effect)).measurements
    folder = options.output or options.specification.parent
    readings = folder / (file.keys.output.readings or f"{options.specification.stem}.csv")
    job = folder / file.keys.output.job
    head = remarks(file, "Simulated readings, not measurements.")
    print(
        *written(
            Document(readings, readings_table(measurements, head).encode()),
            Document(job, job_text(file, folder, readings.name).encode()),
        ),
        sep="\n",
    )
    print(f"next: zlmreport {shown_path(job)}")
    return 0
