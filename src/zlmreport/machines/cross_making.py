"""Makes tables across axes for a control: which control, which sign, a trial, the files, the forecast."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np

from zlmreport.errors import InputError, Place
from zlmreport.files import Document
from zlmreport.machines.cross_tables import CrossForecast, CrossPlan, forecast, is_held, plan_tables
from zlmreport.machines.reading import MachineFile
from zlmreport.model.compensation.curve import CrossTable
from zlmreport.plugin.registry import Registry

#: Height of a trial value, m: an indicator shows it, and no axis is hurt by it.
PEAK = 10e-6
_FEWEST_ROWS = 3
_MOVES = {"plus": 1, "minus": -1}


@dataclass(frozen=True, slots=True)
class CrossWanted:
    """What somebody asks for."""

    controller: str | None  #: The control's identifier.
    #: Which way a positive value moves an axis, ``plus`` or ``minus``; None where that is known.
    moves: str | None
    step: float | None  #: Between rows, m; None for that of the measured positions.
    #: place, is_command: Who asks, and whether by a command: remedies are then said as its options.
    place: Place
    is_command: bool

    def write_option(self, name: str, value: str) -> str:
        """Return how a value is stated."""
        return f"--{name} {value}" if self.is_command else f'{name}="{value}"'


@dataclass(frozen=True, slots=True)
class CrossMade:
    """Tables in the words of a control."""

    control: Any  #: The control.
    moves: int  #: Which way a positive value moves an axis, +1 or −1.
    plan: CrossPlan  #: What the tables hold.
    files: Mapping[str, str]  #: Their text by the end of the file's name.
    decoded: tuple[CrossTable, ...]  #: The tables as the control reads its files back.
    forecast: CrossForecast  #: What they will leave.

    @property
    def held(self) -> tuple[str, ...]:
        """The errors that the control takes away: of those planned it may hold squareness alone."""
        return tuple(name for name in self.plan.taken if any(is_held(name, each) for each in self.decoded))


def make_cross(machine: MachineFile, registry: Registry, wanted: CrossWanted) -> CrossMade:
    """Return the tables of a machine for a control.

    Raises `InputError` if the control takes no such tables, its sign is neither known nor stated, or nothing
    is known that they could hold.
    """
    control = choose_cross_control(registry, wanted)
    plan = plan_tables(machine.machine, wanted.place, wanted.step)
    moves = _sign(control, wanted)
    files = control.cross_files(plan.tables, moves)
    if not files:
        raise InputError.at(
            wanted.place,
            f"{control.identifier} can take away squareness alone, and none is known that is larger than its "
            f"uncertainty; straightness ({', '.join(plan.taken)}) is left",
        )
    decoded = tuple(control.read_cross(files, plan.tables, moves))
    found = forecast(machine.machine, decoded, machine.measured, registry)
    return CrossMade(control, moves, plan, files, decoded, found)


def make_trial(
    machine: MachineFile, registry: Registry, wanted: CrossWanted
) -> tuple[Any, CrossTable, Mapping[str, str]]:
    """Return a control, a table with nothing but a positive value in the middle, and its files.

    Raises `InputError` as `make_cross` does, if the control's sign is known, or if the rows have no middle.
    """
    control = choose_cross_control(registry, wanted)
    if control.cross_sign == "known":
        raise InputError.at(wanted.place, f"the sign of {control.identifier} is known; no trial is needed")
    table = plan_tables(machine.machine, wanted.place, wanted.step).tables[0]
    if len(table.positions) < _FEWEST_ROWS:
        raise InputError.at(
            wanted.place, "two rows have no middle for a trial value; state a shorter step, or none"
        )
    share = np.linspace(0.0, 1.0, len(table.positions))
    middle = share[len(share) // 2]
    trial = replace(table, values=-PEAK * np.minimum(share / middle, (1 - share) / (1 - middle)), slope=0.0)
    return control, trial, control.cross_files([trial], 1)


def make_table_documents(files: Mapping[str, str], folder: Path, stem: str) -> list[Document]:
    """Return the files of a control, to be written into a folder."""
    return [Document(folder / f"{stem}{end}", text.encode("ascii")) for end, text in files.items()]


def list_cross_controls(registry: Registry) -> list[Any]:
    """Return the controls that take tables across axes."""
    return [each for each in registry.controllers if hasattr(each, "cross_files")]


def choose_cross_control(registry: Registry, wanted: CrossWanted) -> Any:
    """Return the control; refuse one without tables across axes by its name."""
    known = [each.identifier for each in list_cross_controls(registry)]
    if not wanted.controller:
        raise InputError.at(
            wanted.place,
            f"which control? State {wanted.write_option('controller', 'NAME')}: {', '.join(known)}",
        )
    found = registry.controller(wanted.controller, wanted.place)
    if found.identifier not in known:
        raise InputError.at(
            wanted.place,
            f"of {found.identifier} no tables across axes are known to this program, neither their syntax "
            f"nor their sign; of these they are: {', '.join(known)}",
        )
    return found


def _sign(control: Any, wanted: CrossWanted) -> int:
    """Return which way a positive value moves an axis; who loads a table with an unknown sign has to say."""
    if control.cross_sign == "known":
        if wanted.moves:
            raise InputError.at(wanted.place, f"the sign of {control.identifier} is known; leave moves out")
        return 1
    plus, minus = (wanted.write_option("moves", each) for each in _MOVES)
    if not wanted.moves:
        trial = "--trial" if wanted.is_command else "zlmreport machine compensate --trial"
        raise InputError.at(
            wanted.place,
            f"which way does a positive value of {control.identifier} move the axis? It was not found in "
            f"print, and a wrong sign doubles the error. {trial} writes a file that shows it; then state "
            f"{plus} or {minus}",
        )
    if wanted.moves not in _MOVES:
        raise InputError.at(wanted.place, f"moves is {wanted.moves!r}; state {plus} or {minus}")
    return _MOVES[wanted.moves]
