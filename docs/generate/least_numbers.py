"""The least numbers of targets and runs, found by asking each standard about ever larger tests."""

from __future__ import annotations

import math

from markdown import table

from zlmreport.language import Language
from zlmreport.measurement.axis import Axis, AxisKind
from zlmreport.measurement.measurand import list_measurands_of
from zlmreport.measurement.measurement_set import MeasurementSet
from zlmreport.plugin.protocols import Standard
from zlmreport.plugin.registry import find_plugins
from zlmreport.testing import simulated_test

_MOST = 60
#: What tests of so many targets more do not meet either is no matter of their number.
_HOPELESS = 8
_RUNS = range(5, 0, -1)
#: Measured lengths in mm, and a whole turn.
_LENGTHS = (500.0, 1000.0, 1500.0, 2000.0)
_WHOLE_TURN = 360.0


def text() -> str:
    """Return a row for each standard; editions that ask the same share one."""
    rows: dict[tuple[str, ...], list[str]] = {}
    for standard in find_plugins().standards:
        if all(each.is_continuous for each in list_measurands_of(standard)):
            continue
        asked = [_targets(standard, _linear(length), length) for length in _LENGTHS]
        asked.append(_targets(standard, Axis("C", AxisKind.ROTARY, travel=(0.0, 2 * math.pi)), _WHOLE_TURN))
        rows.setdefault((*asked, _runs(standard)), []).append(standard.designation)
    heading = ["Standard", *(f"Targets on {length:g} mm" for length in _LENGTHS), "on 360°", "Runs"]
    return table(heading, [(", ".join(names), *asked) for asked, names in rows.items()])


def _linear(length: float) -> Axis:
    return Axis("X", travel=(0.0, length / 1000))


def _targets(standard: Standard, axis: Axis, length: float) -> str:
    """Return the number of targets from which on all that more of them can meet is met; a dash for none."""
    least = 0
    still_unmet: set[str] = set()
    for count in range(_MOST, 1, -1):
        unmet = _unmet(standard, simulated_test(count, axis=axis, length=length))
        if count > _MOST - _HOPELESS:
            still_unmet |= unmet
        elif unmet - still_unmet:
            least = count + 1
            break
    return str(least) if least else "–"


def _runs(standard: Standard) -> str:
    """Return the least number of runs that meets as much as five do."""
    unmet = {
        runs: _unmet(standard, simulated_test(21, runs, axis=_linear(1000.0), length=1000.0))
        for runs in _RUNS
    }
    return str(min(runs for runs in _RUNS if unmet[runs] == unmet[_RUNS[0]]))


def _unmet(standard: Standard, measurements: MeasurementSet) -> set[str]:
    """Return the requirements that a test does not meet."""
    findings = standard.requirements(measurements, standard.options())
    return {finding.requirement.in_language(Language.ENGLISH) for finding in findings if finding.met is False}
