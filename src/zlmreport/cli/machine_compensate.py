"""``zlmreport machine compensate``: tables across axes for a control, with the sign said and a forecast."""

from __future__ import annotations

from argparse import Namespace
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from zlmreport.document.blocks import Section
from zlmreport.errors import NOT_MET, InputError, Place
from zlmreport.files import write_new
from zlmreport.language import Language
from zlmreport.machines.cross_confirmation import CrossVerdict, confirm
from zlmreport.machines.cross_making import (
    PEAK,
    CrossWanted,
    make_cross,
    make_table_documents,
    make_trial,
)
from zlmreport.machines.cross_report import (
    CONFIRMATION_SCHEMA,
    SCHEMA,
    collect_confirmation,
    collect_cross,
)
from zlmreport.machines.reading import MachineFile
from zlmreport.machines.subjects.cross_tables import (
    lay_out_confirmation,
    lay_out_cross,
    lay_out_trial,
)
from zlmreport.machines.subjects.saying import Sayer
from zlmreport.measurement.units import MILLIMETRE
from zlmreport.plugin.registry import Registry

_COMMAND = Place("zlmreport machine compensate")
_SAY = Sayer(Language.ENGLISH)


def compensate(
    machine: MachineFile, registry: Registry, options: Namespace
) -> tuple[Sequence[Section], Sequence[Path], dict[str, Any]]:
    """Return what is said of the tables, the files that were written, and the values.

    Raises `InputError` if the control takes no such tables, or its sign is neither known nor stated.
    """
    if options.step is not None and options.step <= 0:
        raise InputError.at(_COMMAND, f"--step {options.step:g}: rows are more than 0 mm apart, such as 25")
    step = None if options.step is None else MILLIMETRE.to_si(options.step)
    wanted = CrossWanted(options.controller, options.moves, step, _COMMAND, is_command=True)
    if options.trial:
        control, table, files = make_trial(machine, registry, wanted)
        written = _write_tables(files, machine, options, "-trial")
        values = {"schema": SCHEMA, "controller": control.identifier, "trial": True}
        return [lay_out_trial(table, PEAK, _SAY)], written, {**values, "files": list(map(str, written))}
    made = make_cross(machine, registry, wanted)
    if options.confirm:
        found = confirm(machine, made, options.confirm, registry, _COMMAND)
        return [lay_out_confirmation(found, _SAY)], (), collect_confirmation(found)
    written = _write_tables(made.files, machine, options, "")
    return lay_out_cross(made, _SAY), written, {**collect_cross(made), "files": list(map(str, written))}


def find_exit_code(values: Mapping[str, Any]) -> int:
    """Return 1 for tables that circles do not confirm, by the values of an action; 0 for all else."""
    is_confirmation = values.get("schema") == CONFIRMATION_SCHEMA
    return NOT_MET if is_confirmation and values["verdict"] != CrossVerdict.HELD.value else 0


def _write_tables(files: Any, machine: MachineFile, options: Namespace, mark: str) -> Sequence[Path]:
    if options.output is None:
        return ()
    documents = make_table_documents(files, options.output, f"{machine.number}{mark}")
    return write_new(documents)
