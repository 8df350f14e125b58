"""``zlmreport emulate ippdme``: a coordinate measuring machine that is not there, with a job's step gauge."""

from __future__ import annotations

from argparse import Namespace

from zlmreport.cli.line import put_on_line
from zlmreport.emulation.dme_server import DmeServer, PointFault
from zlmreport.errors import InputError, Place
from zlmreport.job.loading import load
from zlmreport.job.machine_keys import STANDARD_PORT
from zlmreport.plugins import find_plugins
from zlmreport.probing.emulated import machine_of_job
from zlmreport.quantities.formatting import general_number
from zlmreport.quantities.units import MICROMETRE

#: As the command line names the machine.
IPPDME = "ippdme"
_COMMAND = Place("zlmreport emulate")


def refuse_options_of_machines(options: Namespace) -> None:
    """Raise `InputError` if another instrument is given options that only the machine has."""
    wrong = next((name for name in ("job", "scale_error", "point_fault") if getattr(options, name)), None)
    if wrong:
        raise InputError.at(_COMMAND, f"--{wrong.replace('_', '-')} is for {IPPDME} alone; leave it out")


def run_machine(options: Namespace) -> int:
    """Emulate the machine until its connection is cut, or the user ends it."""
    if options.job is None or options.link is not None:
        raise InputError.at(
            _COMMAND,
            f"{IPPDME} needs the job whose gauge lies on it, and a TCP port: --job JOB.yaml --port "
            f"{STANDARD_PORT}",
        )
    if options.port is None:
        options.port = STANDARD_PORT
    job = load(options.job, find_plugins(files=options.plugin))
    machine = machine_of_job(
        job, scale_error=options.scale_error * 1e-6, noise=MICROMETRE.to_si(options.noise)
    )
    tool = getattr(getattr(job.source.options, "machine", None), "tool", None)
    faults = {number: PointFault(kind) for kind, number in options.point_fault}
    server = DmeServer(machine, ("RefTool", *([tool] if tool else [])), faults)

    def beat() -> None:
        if server.is_gone:
            raise _CutError

    try:
        return put_on_line(
            server,
            options,
            lambda address: (
                f"{IPPDME}: coordinate measuring machine, I++ DME, emulated",
                f"port: {address}",
                f"scale error: {general_number(options.scale_error)} µm/m along the gauge; Ctrl-C ends",
            ),
            beat,
        )
    except _CutError:
        print("the connection is cut")
        return 0


class _CutError(Exception):
    """The planned fault has cut the connection."""
