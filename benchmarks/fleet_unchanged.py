"""A night in which nothing changed: ``./run benchmark unchanged``.

One small certificate is made; all others are put beside it, on the disk and in the ledger, as a night leaves
them. The command looks them through, twice as many each time: how much CPU, how much memory, and with which
power of the number of jobs the CPU grows. Each night must find every job unchanged.
"""

from __future__ import annotations

import argparse
import json
import math
import os
import subprocess
import sys
import time
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from sqlalchemy import event
from sqlalchemy.engine import Engine

import report
from measure import Measured
from zlmreport.fleet.basis import FileStamp, KnownFile, compute_sha256, write_path_in
from zlmreport.fleet.ledger import Ledger
from zlmreport.job.fleet import load_fleet

#: Of the largest fleet: the others are a half, a quarter and an eighth of it.
_STEPS = (8, 4, 2, 1)
_FLEET = """\
schema: zlmreport/fleet/1
jobs: jobs/*/*.yaml
output: {formats: [csv]}
executor: {workers: 2}
"""
_JOB = """\
schema: zlmreport/job/1
certificate: {{number: B-{number:06}, kind: report}}
machine: {{model: HMC 500, serial: {machine}}}
axis: {{name: X, travel: [0, 400]}}
measurement:
  date: 2026-11-18
  source: {{plugin: laser-csv, file: ../readings.csv}}
evaluate: [{{standard: "iso230-2:2014", tolerances: {{A: 20}}}}]
"""
_KIBIBYTES = 1024


@dataclass(frozen=True, slots=True)
class Cost:
    """What a command took: CPU with all that it started, s, and its own memory at its largest, MB."""

    cpu: float
    memory: float
    seconds: float


def main(words: Sequence[str]) -> None:
    """Measure, and print a table."""
    parser = argparse.ArgumentParser(prog="./run benchmark unchanged", description=__doc__)
    parser.add_argument("--jobs", type=int, default=10_000, help="of the largest fleet (%(default)s)")
    options = parser.parse_args(words)
    event.listen(Engine, "connect", _not_durable)
    with TemporaryDirectory() as folder:
        print(report.table("A night in which nothing changed", list(_measured(Path(folder), options.jobs))))


def _measured(folder: Path, jobs: int) -> Iterator[Measured]:
    (folder / "fleet.yaml").write_text(_FLEET, encoding="utf-8")
    (folder / "jobs").mkdir()
    (folder / "jobs" / "readings.csv").write_text(_readings(), encoding="utf-8")
    made, costs = 0, list[tuple[int, Cost]]()
    for number in (jobs // part for part in _STEPS):
        if not made:
            _write_job(folder, 0)
        if not made:
            _night(folder, unchanged=0)
        _seed(folder, range(max(made, 1), number))
        made = number
        cost = _night(folder, unchanged=number)
        costs.append((number, cost))
        print(f"{number} jobs: {cost.cpu:.2f} s of CPU", file=sys.stderr, flush=True)
        yield Measured(f"{number} jobs: CPU", cost.cpu, "s")
        yield Measured("  from start to end", cost.seconds, "s")
        yield Measured("  memory", cost.memory, "MB")
    first, second, third = (cost.cpu for _, cost in costs[-3:])
    # Of sizes that double, the start of the command is in all of them and in no difference.
    ratio = (third - second) / (second - first) if second > first else math.nan
    growth = math.log2(ratio) if ratio > 0 else math.nan
    yield Measured("exponent of the growth of CPU, the start left out", growth, "", 1.1)


def _write_job(folder: Path, each: int) -> Path:
    path = folder / "jobs" / f"{each // 100:04}" / f"{each:06}.yaml"
    path.parent.mkdir(exist_ok=True)
    path.write_text(_JOB.format(number=each, machine=each // 3), encoding="utf-8")
    return path


def _seed(folder: Path, numbers: Iterable[int]) -> None:
    """Write jobs with their certificates, and what the ledger knows of them, like the first."""
    fleet = load_fleet(folder / "fleet.yaml")
    with Ledger.open(fleet.ledger, fleet.name) as ledger:
        (first,) = (each for each in ledger.list_entries() if each.number.endswith("-000000"))
        basis = ledger.list_standings()[first.job].basis
        assert basis
        content = (fleet.output / first.files[0]).read_bytes()
        with ledger.hold_night(first.night, "seed") as night:
            for each in numbers:
                job = _write_job(folder, each)
                number = f"B-{each:06}"
                files = [_known(file, job, folder) if file.role == "job" else file for file in basis.files]
                path = fleet.output / f"seed/{each // 100:04}/{number}.csv"
                path.parent.mkdir(parents=True, exist_ok=True)
                path.write_bytes(content)
                own = KnownFile(".csv", "", "")
                entry = replace(
                    first, job=write_path_in(folder, job), number=number, machine=f"HMC 500 {each // 3}"
                )
                night.issue(
                    replace(entry, files=(str(path.relative_to(fleet.output)),)),
                    (_known(own, path, fleet.output),),
                    replace(basis, files=tuple(files)),
                )
            night.end(first.night)


def _known(file: KnownFile, path: Path, folder: Path) -> KnownFile:
    return KnownFile(file.role, write_path_in(folder, path), compute_sha256(path), FileStamp.at(path))


def _not_durable(connection: Any, _record: Any) -> None:
    connection.execute("PRAGMA synchronous = OFF")  # only of what is put beside the first certificate


def _night(folder: Path, unchanged: int) -> Cost:
    """Spend a night by the command; its last child's usage is that of the whole of it."""
    command = [Path(sys.executable).with_name("zlmreport"), "fleet", "fleet.yaml", "--log-json"]
    begun = time.perf_counter()
    with subprocess.Popen(command, cwd=folder, stdout=subprocess.PIPE, text=True) as process:
        assert process.stdout
        counts = json.loads(process.stdout.read().splitlines()[-1])["counts"]
        _, status, used = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode or counts["unchanged"] != unchanged:
        raise SystemExit(f"the night ended with exit code {process.returncode}: {counts}")
    return Cost(used.ru_utime + used.ru_stime, used.ru_maxrss / _KIBIBYTES, time.perf_counter() - begun)


def _readings() -> str:
    rows = ["target,direction,run,deviation"]
    for run in range(1, 6):
        for sign, targets in (("+", range(0, 401, 100)), ("-", range(400, -1, -100))):
            rows.extend(f"{target},{sign},{run},{target / 100 + run / 10:.1f}" for target in targets)
    return "\n".join(rows)
