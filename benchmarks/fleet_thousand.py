"""A thousand full certificates by one worker of a fleet: ``./run benchmark thousand``.

A whole night, ledger and disk included, in which the worker is not renewed: what each certificate costs,
whether the worker's memory stays level, and what lies on the disk at the end.
"""

from __future__ import annotations

import argparse
import multiprocessing
import os
import statistics
import sys
import time
from collections.abc import Iterator, Sequence
from pathlib import Path
from tempfile import TemporaryDirectory

import report
from fleet_nights import memory_of_workers
from measure import Measured
from sample import write_job
from zlmreport.fleet import workers
from zlmreport.fleet.issuing import Happened, What
from zlmreport.fleet.ledger import Ledger
from zlmreport.fleet.night import Order, spend_night
from zlmreport.fleet.plan import PlannedJob
from zlmreport.fleet.records import NightNotice
from zlmreport.job.fleet import load_fleet

#: By then caches are full and libraries warm.
_SETTLED = 50
#: Certificates over which the costs at the begin and at the end are averaged.
_PART = 100
_LEVEL = 1.2
_MEGABYTE = 1024**2
_FLEET = """\
schema: zlmreport/fleet/1
jobs: jobs/*.yaml
output: {{formats: [{format}]}}
executor: {{workers: 1}}
limits: {{seconds: 36000}} # also beside other work
"""


class _Watch:
    """Notes, after each certificate, the CPU that the worker has used, s, and its memory, MB."""

    def __init__(self) -> None:
        self.cpu: list[float] = []
        self.memory: list[float] = []
        self.failed: list[str] = []

    def note_plan(self, jobs: Sequence[PlannedJob]) -> None:
        """Nothing is noted of it."""

    def note_priors(self, file: Path) -> None:
        """Nothing is noted of it."""

    def note_notice(self, notice: NightNotice) -> None:
        """Note it as a failure."""
        self.failed.append(notice.text)

    def note_happened(self, happened: Happened) -> None:
        """Look at the worker."""
        if happened.what is not What.ISSUED:
            self.failed.append(f"{happened.job}: {happened.what.value}")
        self.cpu.append(_cpu_of_worker())
        self.memory.append(memory_of_workers(os.getpid()))
        if len(self.cpu) % _PART == 0:
            print(f"{len(self.cpu)}: {self.memory[-1]:.0f} MB", file=sys.stderr, flush=True)


def _cpu_of_worker() -> float:
    """Return the CPU, s, of the one process of the pool; processes are daemons of this one."""
    (worker,) = multiprocessing.active_children()
    fields = Path(f"/proc/{worker.pid}/stat").read_text(encoding="ascii").rpartition(")")[2].split()
    return sum(map(int, fields[11:13])) / os.sysconf("SC_CLK_TCK")


def main(words: Sequence[str]) -> None:
    """Measure, and print a table for each renderer."""
    parser = argparse.ArgumentParser(prog="./run benchmark thousand", description=__doc__)
    parser.add_argument("--certificates", type=int, default=1000, help="(%(default)s)")
    parser.add_argument("--format", nargs="+", default=["pdf", "pdf-typst"], help="of the PDF (%(default)s)")
    options = parser.parse_args(words)
    workers.LIFE = sys.maxsize
    for each in options.format:
        with TemporaryDirectory() as folder:
            lines = list(_measured(Path(folder), options.certificates, each))
        print(
            report.table(f"{options.certificates} full certificates, {each}", lines), end="\n\n", flush=True
        )


def _measured(folder: Path, number: int, renderer: str) -> Iterator[Measured]:
    (folder / "jobs").mkdir()
    file = folder / "fleet.yaml"
    file.write_text(_FLEET.format(format=renderer), encoding="utf-8")
    for index in range(number):
        write_job(folder / "jobs", f"FULL-{index:05}")
    watch, begun = _Watch(), time.perf_counter()
    fleet = load_fleet(file)
    spend_night(fleet, Order(), watch)
    seconds = time.perf_counter() - begun
    if watch.failed:
        raise SystemExit("\n".join(watch.failed))
    with Ledger.open(fleet.ledger, fleet.name) as ledger:
        known = len(ledger.list_certificates())
    sizes = [path.stat().st_size for path in fleet.output.rglob("*.pdf")]
    costs = [after - before for before, after in zip(watch.cpu[:-1], watch.cpu[1:], strict=True)]
    part = min(_PART, number // 4)
    settled = min(_SETTLED, number // 4)
    yield Measured("certificates in the ledger", known)
    yield Measured("files on the disk", len(sizes))
    yield Measured("  a file", statistics.mean(sizes) / 1000, "kB")
    yield Measured("the whole night", seconds, "s")
    yield Measured("CPU of the worker", watch.cpu[-1], "s")
    yield Measured("  a certificate, median", statistics.median(costs), "s")
    yield Measured(f"  of the first {part}", statistics.mean(costs[:part]), "s")
    yield Measured(f"  of the last {part}", statistics.mean(costs[-part:]), "s")
    memory = {at: watch.memory[at - 1] for at in (settled, number // 2, number)}
    for at, megabytes in memory.items():
        yield Measured(f"memory of the worker after {at}", megabytes, "MB")
    yield Measured("  at its largest, after the first of these", max(watch.memory[settled - 1 :]), "MB")
    yield Measured("  last / first", memory[number] / memory[settled], "", _LEVEL)
