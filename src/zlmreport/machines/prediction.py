"""What the axes of a machine predict, as plain values: of tests, of the work space, of its diagonals."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from zlmreport.machines.comparison import ComparedTest
from zlmreport.machines.machine import Machine
from zlmreport.machines.report import collect_compared, collect_diagonal, collect_errors, collect_volume
from zlmreport.machines.volume import find_measured_space, map_volume, predict_diagonals

SCHEMA = "zlmreport/prediction/1"


def collect_prediction(machine: Machine, compared: Iterable[ComparedTest]) -> dict[str, Any]:
    """Return what the axes predict of each test, of the work space and of its diagonals."""
    space = find_measured_space(machine)
    return {
        "schema": SCHEMA,
        "chain": machine.chain.letters,
        "errors": collect_errors(machine),
        "tests": [collect_compared(each) for each in compared],
        "volume": collect_volume(map_volume(machine, space)) if space else None,
        "diagonals": [collect_diagonal(each) for each in predict_diagonals(machine, space)] if space else [],
    }
