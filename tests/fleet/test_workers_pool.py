"""Workers on this machine: warm, renewed, and missed by one job only when they die."""

from __future__ import annotations

import os
import signal
import tempfile
from pathlib import Path

import pytest

from fleet.deadly import PLUGIN
from fleet.fleets import Fleet, Witness
from processes import PYTHON, run
from zlmreport.fleet import night, workers
from zlmreport.fleet.issuing import What
from zlmreport.fleet.records import State


@pytest.fixture(scope="module")
def fleet(tmp_path_factory: pytest.TempPathFactory) -> Fleet:
    """Return a fleet of sound jobs and of jobs that end their worker."""
    fleet = Fleet.of(tmp_path_factory.mktemp("fleet"), "a1", "a2", "a3", "a4", "killed", "killed-once")
    fleet.write("deadly.py", PLUGIN)
    return fleet


@pytest.fixture(scope="module")
def spent(fleet: Fleet) -> Witness:
    """Spend a night with two workers that make three certificates each before they are renewed."""
    witness, aside = Witness(), fleet.folder / "temporary"
    aside.mkdir()
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(workers, "LIFE", 3)
        patch.setattr(tempfile, "tempdir", str(aside))
        night.spend_night(fleet.file, night.Order((fleet.folder / "deadly.py",), workers=2), witness)
    return witness


def test_a_killed_worker_fails_its_own_job_and_no_other(spent: Witness) -> None:
    assert {stem for stem, what in spent.what.items() if what is What.FAILED} == {"killed"}
    assert sum(what is What.ISSUED for what in spent.what.values()) == 5


def test_it_is_said_how_the_worker_ended(spent: Witness) -> None:
    (killed,) = spent.of("killed").problems
    assert killed.message.startswith(
        "the worker process was killed by SIGKILL while this plugin was at work, twice: format 'exemplary'"
    )
    assert killed.message.endswith("render; the system may have run out of memory")


def test_a_job_whose_worker_was_killed_is_tried_once_more(spent: Witness) -> None:
    assert spent.what["killed-once"] is What.ISSUED


@pytest.mark.usefixtures("spent")
def test_the_ledger_names_the_failures(fleet: Fleet) -> None:
    failed = {each.number for each in fleet.entries() if each.state is State.STOPPED}
    assert failed == {"CAL-KILLED"}


@pytest.mark.usefixtures("spent")
def test_workers_make_several_certificates_and_are_renewed(fleet: Fleet) -> None:
    pids = [fleet.certificate(f"a{number}", ".pid").read_text() for number in range(1, 5)]
    assert 1 < len(set(pids)) < 4
    assert str(os.getpid()) not in pids


STILLBORN = """\
import multiprocessing
import os

if multiprocessing.parent_process():
    os._exit(3)
"""


def test_jobs_are_not_set_aside_for_workers_that_never_began(tmp_path: Path) -> None:
    fleet = Fleet.of(tmp_path, "a")
    plugin = fleet.write("stillborn.py", STILLBORN)
    witness = Witness()
    night.spend_night(fleet.file, night.Order((plugin,), workers=1), witness)
    assert witness.of("a").problems[0].message == (
        "the worker process ended with exit code 3 before it was ready, twice"
    )
    assert [each.state for each in fleet.entries()] == [State.FAILED]


def test_a_worker_that_nobody_ends_is_ended_by_the_system() -> None:
    deed = (
        "import time; from zlmreport.fleet.workers import _end_after as after\n"
        "with after(60): pass\nwith after(0.01): time.sleep(60)"
    )
    assert run(PYTHON, "-c", deed).returncode == -signal.SIGALRM


@pytest.mark.usefixtures("spent")
def test_no_worker_is_left_behind(fleet: Fleet) -> None:
    pids = {path.read_text() for path in (fleet.folder / "certificates").rglob("*.pid")}
    assert not [pid for pid in pids if Path("/proc", pid).exists()]


@pytest.mark.usefixtures("spent")
def test_no_temporary_file_of_a_worker_is_left_behind(fleet: Fleet) -> None:
    left = [each.name for each in (fleet.folder / "temporary").iterdir()]
    # What `multiprocessing` shares with workers lies in a folder that goes with this process.
    assert [each for each in left if not each.startswith("pymp-")] == []
