"""A night of a whole fleet: from a cold start, when nothing changed, when one changed, and when it is killed.

``./run benchmark fleet`` measures each of them, and beside it what others would do with the same jobs.
"""

from __future__ import annotations

import argparse
import contextlib
import json
import os
import shutil
import statistics
import subprocess
import sys
import time
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory

import report
from measure import Measured, own_process
from sample import write_job
from zlmreport.job.loading import load
from zlmreport.pipeline import run
from zlmreport.plugin.registry import find_plugins

WORKERS = 2
#: By then caches are full and libraries warm.
_SETTLED = 50
#: Of the processors, at least.
_EFFICIENCY = 0.9
#: Readings of the memory that are averaged.
_READINGS = 10
_FLEET = f"""\
schema: zlmreport/fleet/1
jobs: jobs/*.yaml
output: {{formats: [pdf]}}
executor: {{workers: {WORKERS}}}
"""
_KILLS = Path(__file__).parents[1] / "tests/fleet/kill_nights.py"


@dataclass(frozen=True, slots=True)
class Night:
    """What a night took.

    Attributes
    ----------
    seconds
        From the start of the command to its end.
    settled, last
        Memory of a worker when all are warm, and at the end, MB; NaN where too few certificates were made.
    """

    seconds: float
    settled: float
    last: float


def main(arguments: Sequence[str]) -> None:
    """Measure what the command line asks for, print a table, and write JSON if asked to."""
    options = _parser().parse_args(arguments)
    with TemporaryDirectory() as folder:
        lines = list(_measured(Path(folder), options))
    print(report.table(f"A fleet of {options.certificates} jobs", lines))
    if options.json:
        report.write_json(options.json, {"fleet": lines})


def _measured(folder: Path, options: argparse.Namespace) -> Iterator[Measured]:
    number = options.certificates
    (folder / "jobs").mkdir()
    (folder / "fleet.yaml").write_text(_FLEET, encoding="utf-8")
    jobs = [write_job(folder / "jobs", f"FLEET-{index:05}") for index in range(number)]
    first = _night(folder)
    yield Measured("first night, from a cold start", first.seconds, "s")
    yield Measured("  a certificate", first.seconds / number, "s")
    if options.sample:
        yield from _other_ways(jobs[: options.sample], folder / "naive", first.seconds / number)
    yield Measured("second night, nothing changed", _night(folder).seconds, "s", 3.0)
    with jobs[0].with_suffix(".csv").open("a", encoding="utf-8") as readings:
        readings.write("\n# a remark\n")
    yield Measured(f"third night, one changed in {number}", _night(folder).seconds, "s")
    if number >= 2 * WORKERS * _SETTLED:
        yield Measured(f"a worker after {_SETTLED} certificates", first.settled, "MB")
        yield Measured(f"a worker after {number // WORKERS} certificates", first.last, "MB")
        yield Measured("  ratio", first.last / first.settled, "", 1.2)
    if options.kills:
        yield from _killed(folder / "killed", options.kills)


def _other_ways(jobs: Sequence[Path], output: Path, fleet: float) -> Iterator[Measured]:
    """Make the same certificates in other ways; `fleet` is what one took in the fleet, s."""
    naive = _one_process_each(jobs, output) / len(jobs)
    with own_process() as one:
        warm = one.submit(_warm, jobs).result()
    with contextlib.ExitStack() as stack:
        processes = [stack.enter_context(own_process()) for _ in range(WORKERS)]
        at_once = statistics.mean(
            each.result() for each in [process.submit(_warm, jobs) for process in processes]
        )
    yield Measured(f"one process each, a certificate ({len(jobs)} measured)", naive, "s")
    yield Measured(f"one warm process, a certificate ({len(jobs)} measured)", warm, "s")
    yield Measured(f"{WORKERS} warm processes at once, a certificate of one of them", at_once, "s")
    yield Measured("fleet / one process each", fleet / naive)
    yield Measured("fleet / one warm process", fleet / warm)
    yield Measured(f"  times {WORKERS} workers", fleet * WORKERS / warm, "", 1 / _EFFICIENCY)
    yield Measured(
        f"fleet / {WORKERS} warm processes at once", fleet * WORKERS / at_once, "", 1 / _EFFICIENCY
    )


def _night(folder: Path) -> Night:
    """Spend a night by the command, and watch the memory of its workers."""
    command = [_zlmreport(), "fleet", "fleet.yaml", "--log-json"]
    begun = time.perf_counter()
    made, settled, last = 0, [], []
    with subprocess.Popen(command, cwd=folder, stdout=subprocess.PIPE, text=True) as process:
        assert process.stdout
        for line in process.stdout:
            if json.loads(line)["event"] in {"begun", "ended"}:
                continue
            made += 1
            megabytes = memory_of_workers(process.pid)
            if WORKERS * _SETTLED <= made < WORKERS * _SETTLED + _READINGS:
                settled.append(megabytes)
            last = [*last[1 - _READINGS :], megabytes]
    if process.returncode:
        raise SystemExit(f"the night ended with exit code {process.returncode}")
    seconds = time.perf_counter() - begun
    return Night(seconds, _mean(settled), _mean(last[:-WORKERS]))


def memory_of_workers(command: int) -> float:
    """Return the memory in use of one worker of a command, MB: of the children of its server of processes."""
    pages = [
        int(Path(f"/proc/{worker}/statm").read_text(encoding="ascii").split()[1])
        for server in _children(command)
        for worker in _children(server)
    ]
    return _mean(pages) * os.sysconf("SC_PAGE_SIZE") / 1024**2


def _children(process: int) -> list[int]:
    path = Path(f"/proc/{process}/task/{process}/children")
    return [int(child) for child in path.read_text(encoding="ascii").split()]


def _mean(values: Sequence[float]) -> float:
    return statistics.mean(values) if values else float("nan")


def _one_process_each(jobs: Sequence[Path], output: Path) -> float:
    """Return the seconds of a loop in a shell: a command for each job."""
    begun = time.perf_counter()
    for job in jobs:
        subprocess.run([_zlmreport(), job, "--output", output, "--quiet"], check=True)
    return time.perf_counter() - begun


def _warm(jobs: Sequence[Path]) -> float:
    """Return the seconds of a certificate in a process that has made some."""
    registry = find_plugins()
    for job in jobs[:2]:
        run(load(job, registry), registry)
    begun = time.perf_counter()
    for job in jobs:
        run(load(job, registry), registry)
    return (time.perf_counter() - begun) / len(jobs)


def _killed(folder: Path, kills: int) -> Iterator[Measured]:
    """Kill nights at random moments, and count what was lost, doubled or left half-written."""
    folder.mkdir()
    path = os.pathsep.join([str(_KILLS.parents[1]), *filter(None, sys.path)])
    done = subprocess.run(
        [sys.executable, _KILLS, folder, str(kills), "1"],
        env=os.environ | {"PYTHONPATH": path},
        capture_output=True,
        text=True,
        check=True,
    )
    *problems, last = done.stdout.splitlines()
    yield Measured("nights killed", int(last.split()[0]))
    yield Measured("certificates lost, doubled or half-written by it", len(problems), "", 0)


def _zlmreport() -> str:
    return shutil.which("zlmreport", path=str(Path(sys.executable).parent)) or "zlmreport"


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(prog="./run benchmark fleet", description=__doc__)
    parser.add_argument("--certificates", type=int, default=1000, help="jobs of the fleet (%(default)s)")
    parser.add_argument(
        "--sample", type=int, default=30, help="of them for the other ways, which take long (%(default)s)"
    )
    parser.add_argument("--kills", type=int, default=100, help="nights that are killed (%(default)s)")
    parser.add_argument("--json", type=Path, metavar="FILE", help="also write the results there")
    return parser
