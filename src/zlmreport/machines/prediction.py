"""What the axes of a machine predict, as plain values: of tests, of the work space, of its diagonals."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from zlmreport.machines.comparison import ComparedTest
from zlmreport.machines.machine import Machine
from zlmreport.machines.report import compared_values, diagonal_values, error_values, volume_values
from zlmreport.machines.volume import diagonals, measured_space, volume_map

SCHEMA = "zlmreport/prediction/1"


def prediction_values(machine: Machine, compared: Iterable[ComparedTest]) -> dict[str, Any]:
    """Return what the axes predict of each test, of the work space and of its diagonals."""
    space = measured_space(machine)
    return {
        "schema": SCHEMA,
        "chain": machine.chain.letters,
        "errors": error_values(machine),
        "tests": [compared_values(each) for each in compared],
        "volume": volume_values(volume_map(machine, space)) if space else None,
        "diagonals": [diagonal_values(each) for each in diagonals(machine, space)] if space else [],
    }
