"""Calibration certificates for machine axes, from measurements to the printed page.

For notebooks and scripts: ``import zlmreport as z``. Micrometres and millimetres (arc seconds and degrees).
A name loads its module when it is used.
"""

from __future__ import annotations

import os
import sys
from importlib import import_module
from typing import TYPE_CHECKING

from zlmreport.version import __version__

if TYPE_CHECKING:
    from zlmreport.errors import AccessError, InputError, ZlmreportError
    from zlmreport.notebook.documents import (
        Certificate,
        Compensation,
        Verification,
        certificate,
        compensate,
        verify,
    )
    from zlmreport.notebook.machines import BuiltMachine, DiagnosisOfMachine, Machine, machine
    from zlmreport.notebook.models import Diagnosis, Model, fit
    from zlmreport.notebook.offered import OfferedEffect, OfferedStandard, effects, standards
    from zlmreport.notebook.plans import Plan, plan
    from zlmreport.notebook.readings import Readings, of_arrays as test, read, simulate
    from zlmreport.notebook.results import Result, Value, evaluate

__all__ = [
    "AccessError",
    "BuiltMachine",
    "Certificate",
    "Compensation",
    "Diagnosis",
    "DiagnosisOfMachine",
    "InputError",
    "Machine",
    "Model",
    "OfferedEffect",
    "OfferedStandard",
    "Plan",
    "Readings",
    "Result",
    "Value",
    "Verification",
    "ZlmreportError",
    "__version__",
    "certificate",
    "compensate",
    "effects",
    "evaluate",
    "fit",
    "machine",
    "plan",
    "read",
    "simulate",
    "standards",
    "test",
    "verify",
]
_ROOMS = {
    "errors": "AccessError InputError ZlmreportError",
    "notebook.documents": "Certificate Compensation Verification certificate compensate verify",
    "notebook.machines": "BuiltMachine DiagnosisOfMachine Machine machine",
    "notebook.models": "Diagnosis Model fit",
    "notebook.offered": "OfferedEffect OfferedStandard effects standards",
    "notebook.plans": "Plan plan",
    "notebook.readings": "Readings read simulate test=of_arrays",
    "notebook.results": "Result Value evaluate",
}
_HOMES = {
    offered: (room, own or offered)
    for room, names in _ROOMS.items()
    for offered, _, own in (name.partition("=") for name in names.split())
}

if not TYPE_CHECKING:  # a type checker knows the names from above, and reports one that is not among them

    def __getattr__(name: str) -> object:
        if name not in _HOMES:
            message = f"module {__name__!r} has no attribute {name!r}"
            raise AttributeError(message)
        if "numpy" not in sys.modules:
            # On the small matrices of a test, threads only wait for each other.
            os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
        room, own = _HOMES[name]
        value = globals()[name] = getattr(import_module(f"{__name__}.{room}"), own)
        return value


def __dir__() -> list[str]:
    return sorted(__all__)
