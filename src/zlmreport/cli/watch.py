"""Runs a command in a child process, so that a plugin that crashes or exits gets a message and exit code 2.

A plugin may end the process in which it works, by mistake or not: with exit code 0, for example, and without
its certificate. What waits here has loaded no plugin. It knows from the other whether it came to its end, and
who was at work when it did not.
"""

from __future__ import annotations

import mmap
import os
import signal
import sys
from collections.abc import Callable

from zlmreport.errors import ZlmreportError
from zlmreport.presence import PRESENCE, SIZE, Presence

#: Of what the command notes of itself; its first byte says that it came to its end, the second its exit code.
_HEAD = 2
_FAILED = ZlmreportError.exit_code
#: Passed on to the command; the others come from the terminal, which tells both.
_PASSED_ON = ("SIGTERM", "SIGHUP", "SIGQUIT", "SIGUSR1", "SIGUSR2")
_DEATH_OF_PARENT = 1


def watch(command: Callable[[], int]) -> int | None:
    """Do a command in a process of its own, and return its exit code; None where there is no such thing."""
    if not hasattr(os, "fork") or not hasattr(signal, "sigwaitinfo"):
        return None
    memory = mmap.mmap(-1, _HEAD + SIZE)
    waited = {signal.SIGCHLD, signal.SIGINT, *(getattr(signal, name) for name in _PASSED_ON)}
    before = signal.pthread_sigmask(signal.SIG_BLOCK, waited)
    parent = os.getpid()
    child = os.fork()
    if not child:
        _end_with(parent)
        signal.pthread_sigmask(signal.SIG_SETMASK, before)
        PRESENCE.use(memoryview(memory)[_HEAD:])
        code = command()
        memory[0:_HEAD] = bytes((1, code % 256))
        sys.exit(code)
    ended_by, status = _wait_for_process(child, waited)
    if memory[0] and memory[1] != _FAILED:
        return memory[1]
    if ended_by is not None:  # as whoever sent the signal expects
        signal.signal(ended_by, signal.SIG_DFL)
        signal.pthread_sigmask(signal.SIG_UNBLOCK, waited)
        os.kill(parent, ended_by)
    presence = Presence(memoryview(memory)[_HEAD:])
    if not memory[0]:
        print(_say_what_ended(presence, status), file=sys.stderr)
    elif "stderr" in presence.wrong:  # nobody read what the command said of it
        print(f"zlmreport: {presence.wrong}", file=sys.stderr)
    return _FAILED


def _wait_for_process(child: int, waited: set[signal.Signals]) -> tuple[signal.Signals | None, int]:
    """Wait for a process; return the signal that was passed on to it and ended it, and its status."""
    passed_on: set[int] = set()
    while True:
        told = signal.sigwaitinfo(waited)
        number = signal.Signals(told.si_signo)
        if number is signal.SIGCHLD:
            ended, status = os.waitpid(child, os.WNOHANG)
            if ended:
                code = os.waitstatus_to_exitcode(status)
                return (signal.Signals(-code) if -code in passed_on else None), code
        elif told.si_code <= 0:  # of a process: those of a terminal go to both
            passed_on.add(number)
            os.kill(child, number)


def _say_what_ended(presence: Presence, status: int) -> str:
    how = f"was ended by {signal.Signals(-status).name}" if status < 0 else f"ended with exit code {status}"
    hint = "; the system may have run out of memory" if status == -signal.SIGKILL else ""
    if presence.wrong:
        return f"zlmreport: {presence.wrong}, and the process {how}"
    if presence.called:
        return f"zlmreport: {presence.called}: the process {how} while this plugin was at work{hint}"
    after = f"; the last plugin at work was {presence.last}" if presence.last else ""
    return f"zlmreport: the process {how} before it came to its end{after}{hint}"


def _end_with(parent: int) -> None:
    """Let this process end when the one that waits for it does: nobody would be told of its end."""
    if not sys.platform.startswith("linux"):
        return
    import ctypes  # noqa: PLC0415 - slow to load

    ctypes.CDLL(None).prctl(_DEATH_OF_PARENT, signal.SIGKILL)
    if os.getppid() != parent:
        os._exit(_FAILED)
