"""``zlmreport machine compensate``: tables across axes for a control, with the sign said and a forecast."""

from __future__ import annotations

from argparse import Namespace
from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from zlmreport.cli.terminal import show_path
from zlmreport.document.blocks import Section
from zlmreport.errors import InputError, Place
from zlmreport.files import Document, write_new
from zlmreport.language import Language
from zlmreport.machines.cross_tables import CrossForecast, CrossPlan, forecast, plan_tables
from zlmreport.machines.reading import MachineFile
from zlmreport.machines.subjects.cross_tables import (
    forecast_section,
    lay_out_tables,
    lay_out_trial,
    sign_section,
)
from zlmreport.machines.subjects.saying import Sayer
from zlmreport.measurement.units import MICROMETRE, MILLIMETRE
from zlmreport.model.compensation.cross import CrossTable
from zlmreport.plugin.registry import Registry

SCHEMA = "zlmreport/machine-compensation/1"
_COMMAND = Place("zlmreport machine compensate")
_SAY = Sayer(Language.ENGLISH)
_MOVES = {"plus": 1, "minus": -1}
#: Height of a trial value, m: an indicator shows it, and no axis is hurt by it.
_PEAK = 10e-6


def compensate(
    machine: MachineFile, registry: Registry, options: Namespace
) -> tuple[Sequence[Section], Sequence[str], dict[str, Any]]:
    """Return what is said of the tables, the files that were written, and the values.

    Raises `InputError` if the control takes no such tables, or its sign is neither known nor stated.
    """
    control = _choose_control(registry, options)
    if options.step is not None and options.step <= 0:
        raise InputError.at(_COMMAND, f"--step {options.step:g}: rows are more than 0 mm apart, such as 25")
    step = None if options.step is None else MILLIMETRE.to_si(options.step)
    plan = plan_tables(machine.machine, _COMMAND, step)
    if options.trial:
        table = _make_trial(plan.tables[0])
        files = control.cross_files([table], 1)
        shown = _write_tables(files, machine, options, "-trial")
        values = {"schema": SCHEMA, "controller": control.identifier, "trial": True, "files": shown}
        return [lay_out_trial(table, _PEAK, _SAY)], shown, values
    moves = _sign(control, options)
    files = control.cross_files(plan.tables, moves)
    if not files:
        raise InputError.at(
            _COMMAND,
            f"{control.identifier} can take away squareness alone, and none is known that is larger than its "
            f"uncertainty; straightness ({', '.join(plan.taken)}) is left",
        )
    decoded = control.read_cross(files, plan.tables, moves)
    found = forecast(machine.machine, decoded, machine.measured, registry)
    shown = _write_tables(files, machine, options, "")
    sections = [lay_out_tables(plan, decoded, control.cross_notes, _SAY)]
    if control.cross_sign == "stated":
        sections.append(sign_section(moves, _SAY))
    sections.append(forecast_section(found, _SAY))
    named = {"controller": control.identifier, "positive_value_moves": moves, "files": shown}
    return sections, shown, {"schema": SCHEMA, **named, **_collect_values(plan, decoded, found)}


def _choose_control(registry: Registry, options: Namespace) -> Any:
    """Return the control; refuse one without tables across axes by its name."""
    known = [each.identifier for each in registry.controllers if hasattr(each, "cross_files")]
    if not options.controller:
        raise InputError.at(_COMMAND, f"which control? State --controller NAME: {', '.join(known)}")
    found = registry.controller(options.controller, _COMMAND)
    if found.identifier not in known:
        raise InputError.at(
            _COMMAND,
            f"of {found.identifier} no tables across axes are known to this program, neither their syntax "
            f"nor their sign; of these they are: {', '.join(known)}",
        )
    return found


def _sign(control: Any, options: Namespace) -> int:
    """Return which way a positive value moves an axis; who loads a table with an unknown sign has to say."""
    if control.cross_sign == "known":
        if options.moves:
            raise InputError.at(_COMMAND, f"the sign of {control.identifier} is known; leave --moves out")
        return 1
    if not options.moves:
        raise InputError.at(
            _COMMAND,
            f"which way does a positive value of {control.identifier} move the axis? It was not found in "
            "print, and a wrong sign doubles the error. --trial writes a file that shows it; then state "
            "--moves plus or --moves minus",
        )
    return _MOVES[options.moves]


def _make_trial(table: CrossTable) -> CrossTable:
    """Return a table of which a positive value in the middle is written, and nothing at the ends."""
    share = np.linspace(0.0, 1.0, len(table.positions))
    middle = share[len(share) // 2]
    return replace(table, values=-_PEAK * np.minimum(share / middle, (1 - share) / (1 - middle)), slope=0.0)


def _write_tables(files: Any, machine: MachineFile, options: Namespace, mark: str) -> list[str]:
    if options.output is None:
        return []
    documents = [
        Document(options.output / f"{machine.number}{mark}{end}", text.encode("ascii"))
        for end, text in files.items()
    ]
    write_new(documents)
    return [show_path(each.path) for each in documents]


def _collect_values(plan: CrossPlan, tables: Sequence[CrossTable], found: CrossForecast) -> dict[str, Any]:
    return {
        "taken": list(plan.taken),
        "within_uncertainty": list(plan.within_uncertainty),
        "tables": [
            {
                "input": each.input,
                "output": each.output,
                "positions": MILLIMETRE.from_si(each.positions).tolist(),
                "deviation": MICROMETRE.from_si(each.values).tolist(),
            }
            for each in tables
        ],
        "forecast": dict(_forecast(found)),
        "unit": "um",
    }


def _forecast(found: CrossForecast) -> Iterator[tuple[str, Any]]:
    in_um = MICROMETRE.from_si
    yield (
        "circles",
        [
            {
                "test": each.name,
                "rms": [in_um(each.before), in_um(each.after)],
                "numbers": {name: [in_um(before), in_um(after)] for name, before, after in each.numbers},
            }
            for each in found.circles
        ],
    )
    yield "diagonals", {name: [in_um(before), in_um(after)] for name, before, after in found.diagonals}
    yield "largest", [in_um(each) for each in found.largest] if found.largest else None
