"""Where a new certificate goes: folders by what its job says of machine and axis."""

from __future__ import annotations

import re
from pathlib import PurePosixPath

from zlmreport.job.keys import JobKeys
from zlmreport.job.measurement_keys import Machine

#: What is not in a folder's name, so that it reads alike on every system and in every shell.
_NOT_IN_NAMES = re.compile(r"[^\w.-]+")
_LONGEST_NAME = 100


def designation(machine: Machine) -> str:
    """Return a machine's manufacturer, model and serial number: what it is called in a fleet."""
    return " ".join(part for part in (machine.manufacturer, machine.model, machine.serial) if part)


def folder_of(keys: JobKeys, layout: str) -> PurePosixPath:
    """Return the folder of a job's certificate, below that of all certificates.

    Parameters
    ----------
    keys
        What the job says.
    layout
        Names of folders with placeholders, as `zlmreport.job.fleet` has them.
    """
    machine = keys.machine
    values = {
        "machine": designation(machine),
        "manufacturer": machine.manufacturer,
        "model": machine.model,
        "serial": machine.serial,
        "axis": keys.axis.name,
        "number": keys.certificate.number,
    }
    named = {name: _folder_name(value or f"no {name}") for name, value in values.items()}
    return PurePosixPath(layout.format(**named))


def _folder_name(text: str) -> str:
    """Return a text as the name of one folder."""
    return _NOT_IN_NAMES.sub("-", text).strip("-.")[:_LONGEST_NAME] or "-"
