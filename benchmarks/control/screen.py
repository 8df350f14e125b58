#!/usr/bin/python3
"""Stands in for LinuxCNC's screen: lets program.ngc run, and writes down where each motor is.

LinuxCNC starts it under the system's Python, which has its modules. Motors are looked at in each cycle of
the control, so that a busy computer shows in no reading: motor.txt has a line a millisecond with the position
of each, mm.
"""

from __future__ import annotations

import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path

import hal
import linuxcnc

#: s: how long anything may take; how long the operator waits where the program does; between two looks.
PATIENCE, WAIT, STEP = 20.0, 3.0, 0.005

command, status = linuxcnc.command(), linuxcnc.stat()


def until(happened: Callable[[], bool], patience: float = PATIENCE) -> None:
    """Wait for something."""
    end = time.monotonic() + patience
    while not happened():
        if time.monotonic() > end:
            sys.exit("LinuxCNC does not answer")
        time.sleep(STEP)
        status.poll()


def main() -> None:
    """Switch on, home, and let the program run to its end."""
    component = hal.component("screen")  # as long as it is kept, pins can be read
    component.ready()
    status.poll()
    for state in (linuxcnc.STATE_ESTOP_RESET, linuxcnc.STATE_ON):
        command.state(state)
        command.wait_complete()
    command.home(-1)
    until(lambda: all(status.homed[: status.joints]))
    command.mode(linuxcnc.MODE_AUTO)
    command.wait_complete()
    command.program_open("program.ngc")
    command.auto(linuxcnc.AUTO_RUN, 0)
    until(lambda: status.interp_state == linuxcnc.INTERP_PAUSED and status.inpos)
    hal.set_p("sampler.0.enable", "1")
    time.sleep(WAIT)
    command.auto(linuxcnc.AUTO_RESUME)
    until(lambda: status.interp_state == linuxcnc.INTERP_IDLE and status.inpos, 5 * PATIENCE)
    time.sleep(WAIT)
    hal.set_p("sampler.0.enable", "0")
    count = hal.get_value("sampler.0.curr-depth")
    with Path("motor.txt").open("w", encoding="ascii") as motor:
        subprocess.run(["halsampler", "-n", str(count)], stdout=motor, check=True)


main()
