"""A fleet made by the workers of a Dask scheduler, one of which is killed."""

from __future__ import annotations

import contextlib
import json
import os
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

from fleet.deadly import PLUGIN
from fleet.fleets import FLEET, Fleet, Witness
from fleet.servers import server
from processes import PYTHON, awaited, group
from zlmreport.fleet import night, workers
from zlmreport.fleet.issuing import What
from zlmreport.fleet.records import State
from zlmreport.plugin import AccessError

pytest.importorskip("distributed")

SETTINGS = {
    "DASK_DISTRIBUTED__SCHEDULER__ALLOWED_FAILURES": "1",
    "PYTHONPATH": os.pathsep.join(path for path in sys.path if path),
}


@contextlib.contextmanager
def started(*command: str, folder: Path) -> Iterator[subprocess.Popen[bytes]]:
    """Run a program of Dask, which ends with those that it started."""
    with (folder / "log").open("ab") as log:
        settings = {"env": os.environ | SETTINGS, "cwd": folder, "stdout": log, "stderr": log}
        with group(PYTHON, "-m", *command, **settings) as process:
            yield process


@contextlib.contextmanager
def scheduler_of(workers: int, folder: Path) -> Iterator[tuple[str, int]]:
    """Run a scheduler with workers, and yield its address and its process."""
    file = folder / "address"
    flags = ("--scheduler-file", str(file), "--no-dashboard")
    host = ("--host", "tcp://127.0.0.1:0")
    with started("distributed.cli.dask_scheduler", *host, *flags, folder=folder) as running:
        awaited(lambda: file.is_file() and file.stat().st_size)
        number = ("--nworkers", str(workers), "--nthreads", "1", "--local-directory", str(folder))
        with started("distributed.cli.dask_worker", *number, *flags, folder=folder):
            yield json.loads(file.read_text(encoding="utf-8"))["address"], running.pid


@pytest.fixture(scope="module")
def scheduler(tmp_path_factory: pytest.TempPathFactory) -> Iterator[str]:
    """Run a scheduler with two workers, and yield its address."""
    with scheduler_of(2, tmp_path_factory.mktemp("dask")) as (address, _):
        yield address


@pytest.mark.early
def test_a_cluster_makes_the_certificates_and_loses_none_with_a_worker(
    scheduler: str, tmp_path: Path
) -> None:
    fleet = Fleet.of(tmp_path, "a1", "a2", "a3", "a4", "killed", "killed-once")
    fleet.write("fleet.yaml", f"{FLEET}executor: {{kind: dask, scheduler: '{scheduler}'}}\n")
    plugin = fleet.write("deadly.py", PLUGIN)
    witness = Witness()
    night.spend_night(fleet.file, night.Order((plugin,)), witness)
    assert {stem for stem, what in witness.what.items() if what is What.FAILED} == {"killed"}
    assert "no worker lived to make this certificate" in witness.of("killed").problems[0].message
    pids = {fleet.certificate(f"a{number}", ".pid").read_text() for number in range(1, 5)}
    assert str(os.getpid()) not in pids


@pytest.mark.long
@pytest.mark.early
def test_a_ledger_in_postgresql_has_all_that_a_cluster_with_a_killed_worker_made(
    scheduler: str, tmp_path: Path
) -> None:
    fleet = Fleet.of(tmp_path, "a1", "a2", "killed", "killed-once")
    plugin = fleet.write("deadly.py", PLUGIN)
    with server() as address:
        text = FLEET.replace("ledger.db", address)
        fleet.write("fleet.yaml", f"{text}executor: {{kind: dask, scheduler: '{scheduler}'}}\n")
        night.spend_night(fleet.file, night.Order((plugin,)), Witness())
        states = {Path(each.job).stem: each.state for each in fleet.entries()}
        assert {stem for stem, state in states.items() if state is State.MADE} == {"a1", "a2", "killed-once"}
        (fleet.folder / "jobs/killed.yaml").unlink()
        fleet.write("fleet.yaml", f"{fleet.file.content.decode()}retired: [jobs/killed.yaml]\n")
        witness = Witness()
        night.spend_night(fleet.file, night.Order((plugin,)), witness)
        assert set(witness.what.values()) == {What.UNCHANGED}


@pytest.mark.long
@pytest.mark.early
def test_a_night_whose_scheduler_is_killed_says_so_and_the_next_makes_what_is_left(
    scheduler: str, tmp_path: Path
) -> None:
    fleet = Fleet.of(tmp_path, "a1", "scheduler2", "z3", "z4")
    order = night.Order((fleet.write("deadly.py", PLUGIN),))
    with server() as address:
        text = f"{FLEET.replace('ledger.db', address)}executor: {{kind: dask, scheduler: '%s'}}\n"
        with scheduler_of(1, tmp_path) as (doomed, process):
            fleet.write("jobs/scheduler", str(process))
            fleet.write("fleet.yaml", text % doomed)
            with pytest.raises(AccessError, match=r"fleet.yaml:6:.*the scheduler tcp://.* is gone"):
                night.spend_night(fleet.file, order, Witness())
        fleet.write("fleet.yaml", text % scheduler)
        before = {each.number: each.files for each in fleet.entries()}
        assert before.keys() < {"CAL-A1", "CAL-SCHEDULER2", "CAL-Z3", "CAL-Z4"}
        night.spend_night(fleet.file, order, Witness())
        after = fleet.entries()
        assert sorted(each.number for each in after) == ["CAL-A1", "CAL-SCHEDULER2", "CAL-Z3", "CAL-Z4"]
        assert {each.state for each in after} == {State.MADE}
        assert fleet.files() == {f"{each.number}.pid" for each in after}


def test_a_scheduler_that_is_not_there_is_named_with_its_place(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(workers, "_PATIENCE", 0.2)
    fleet = Fleet.of(tmp_path, "x")
    fleet.write("fleet.yaml", f"{FLEET}executor:\n  kind: dask\n  scheduler: tcp://127.0.0.1:1\n")
    with pytest.raises(AccessError, match=r"fleet.yaml:8:14: no scheduler with workers answers at tcp://127"):
        night.spend_night(fleet.file, night.Order(), Witness())
