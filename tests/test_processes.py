"""Nothing that a test starts outlives it."""

from __future__ import annotations

import os
import select
import signal
import subprocess

import pytest

import processes

_STUBBORN = "trap '' TERM; (trap '' TERM; echo $BASHPID; exec sleep 1000) & wait"


@pytest.mark.skipif(not hasattr(os, "pidfd_open"), reason="Linux tells the end of a process that is no child")
def test_a_program_that_ignores_its_end_dies_with_its_children_when_the_block_is_broken_off() -> None:
    living = []

    def broken_off() -> None:
        with processes.started("bash", "-c", _STUBBORN) as program:
            living.append(os.pidfd_open(int(program.lines(1)[0])))
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        broken_off()
    assert select.select(living, [], [], processes.PATIENCE)[0] == living
    os.close(living[0])


def test_a_program_that_says_nothing_is_not_waited_for_without_end(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(processes, "PATIENCE", 0.05)
    with processes.group("sleep", "1000", stdout=subprocess.PIPE):
        pass
    with processes.started("sleep", "1000") as program, pytest.raises(AssertionError, match="printed no"):
        program.lines(1)
    with pytest.raises(subprocess.TimeoutExpired):
        processes.run("sleep", "1000")


def test_a_program_that_was_killed_is_waited_for_however_little_patience_there_is(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(processes, "PATIENCE", 0.0)
    with processes.group("sleep", "1000", stdout=subprocess.PIPE) as process:
        assert process.stdout
    assert process.returncode == -signal.SIGKILL
    assert process.stdout.closed


def test_a_program_that_must_succeed_says_why_it_did_not() -> None:
    with pytest.raises(AssertionError, match=r"ended with 3:\nfull"):
        processes.run("sh", "-c", "echo full; exit 3", check=True)
