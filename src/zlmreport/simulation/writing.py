"""A simulated test as files: its readings as a table, and a job that evaluates them."""

from __future__ import annotations

import json
import os
import re
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from zlmreport.job.simulation import SimulationFile
from zlmreport.measurement.approach import Approach
from zlmreport.measurement.measurement_set import CONDITIONS, MeasurementSet
from zlmreport.quantities.arrays import FloatArray
from zlmreport.simulation.description import Plan

#: Digits after the decimal point: of positions in mm or °, of deviations in µm or ″, of times in s.
POSITION_DIGITS, _DEVIATION_DIGITS, _TIME_DIGITS = 4, 3, 1
_CONDITION_DIGITS = 4
#: More digits of mm or ° than anybody types, and fewer than a double rounds at.
_MEANT_DIGITS = 9
_USUAL_MODEL = ("offset", "scale-error", "backlash")
_PLAIN = re.compile(r"[A-Za-z]([A-Za-z0-9._-]*[A-Za-z0-9])?")
_DIRECTIONS = {Approach.POSITIVE: "+", Approach.NEGATIVE: "-"}


def readings_table(measurements: MeasurementSet, remarks: Sequence[str]) -> str:
    """Return the readings as a table that the data source ``laser-csv`` reads.

    Parameters
    ----------
    measurements
        The readings.
    remarks
        Lines for the head of the file: where the readings come from.
    """
    axis = measurements.axis
    target = axis.position_unit.from_si(measurements.target_positions)[measurements.target]
    deviation = axis.deviation_unit.from_si(measurements.deviation)
    columns: dict[str, list[str]] = {
        "target": _numbers(target, POSITION_DIGITS),
        "direction": [_DIRECTIONS[Approach(sign)] for sign in measurements.approach.tolist()],
        "run": [str(run) for run in measurements.run.tolist()],
        "deviation": _numbers(deviation, _DEVIATION_DIGITS),
    }
    if measurements.time is not None:
        columns["time"] = _numbers(measurements.time, _TIME_DIGITS)
    for name, values in measurements.conditions.items():
        columns[name] = _numbers(_in_users_unit(name, values), _CONDITION_DIGITS)
    lines = [f"# {remark}" for remark in remarks]
    lines.append(",".join(columns))
    lines.extend(",".join(row) for row in zip(*columns.values(), strict=True))
    return "\n".join(lines) + "\n"


def _numbers(values: FloatArray, digits: int) -> list[str]:
    """Write numbers without trailing zeros; a missing one is an empty cell."""
    return ["" if np.isnan(value) else _number(value, digits) for value in values.tolist()]


def _number(value: float, digits: int) -> str:
    text = f"{value:.{digits}f}".rstrip("0").rstrip(".")
    return "0" if text == "-0" else text


def _in_users_unit(name: str, values: FloatArray) -> FloatArray:
    kind = CONDITIONS.get(name)
    return (values - kind.unit.zero) / kind.unit.si if kind else values


def job_text(file: SimulationFile, folder: Path, readings: str) -> str:
    """Return a job that evaluates simulated readings, and models them.

    Parameters
    ----------
    file
        The simulation.
    folder
        Where the job will stand: tables of the axis are named from there.
    readings
        Name of the file with the readings, beside the job.
    """
    source = {"plugin": "laser-csv", "file": readings}
    return "\n".join([*_job_lines(file, folder, source), _OUTPUT]) + "\n"


def live_job_text(file: SimulationFile, folder: Path, plan: Plan, source: Mapping[str, Any]) -> str:
    """Return a job that captures the readings of an emulated machine from an instrument, and models them.

    Parameters
    ----------
    file
        The simulation.
    folder
        Where the job will stand: tables of the axis are named from there.
    plan
        What the machine carries out.
    source
        The keys of the job's source.
    """
    unit = file.axis.position_unit
    targets = unit.from_si(plan.targets).round(_MEANT_DIGITS).tolist()
    lines = [
        *_job_lines(file, folder, source, dwell=file.keys.dwell),
        "plan:",
        f"  targets: {_flow({'positions': targets})}",
        f"  runs: {plan.runs}",
        f"  overrun: {_flow(file.keys.overrun)} # {unit.symbol}",
        _OUTPUT,
    ]
    return "\n".join(lines) + "\n"


_OUTPUT = "output: {directory: out, formats: [pdf, json]}"


def _job_lines(
    file: SimulationFile, folder: Path, source: Mapping[str, Any], dwell: float | None = None
) -> Iterator[str]:
    keys = file.keys
    effects = keys.model.effects if keys.model else _USUAL_MODEL
    axis = {
        key: os.path.relpath(value, folder) if isinstance(value, Path) else value
        for key, value in keys.axis.model_dump(exclude_defaults=True).items()
    }
    yield "# A measuring report of simulated readings: nothing here was measured."
    yield "schema: zlmreport/job/1"
    yield "certificate:"
    yield f"  number: {_flow(keys.output.number)}"
    yield "  kind: report"
    yield f"axis: {_flow(axis)} # {file.axis.position_unit.symbol}"
    yield "measurement:"
    yield f"  method: {keys.method}"
    yield f"  feed: {_flow(keys.feed)} # {file.axis.position_unit.symbol}/min"
    if dwell is not None:
        yield f"  dwell: {_flow(dwell)} # s"
    yield f"  source: {_flow(source)}"
    yield "  remarks: Simulated readings, not measurements."
    yield "evaluate:"
    yield "  - iso230-2:2014"
    yield "model:"
    yield "  effects:"
    yield from (f"    - {_flow(effect)}" for effect in effects)


def _flow(value: Any) -> str:
    """Write a value in one line of YAML; a text that is no plain word stands in quotes."""
    if isinstance(value, Mapping):
        return f"{{{', '.join(f'{key}: {_flow(item)}' for key, item in value.items())}}}"
    if isinstance(value, list | tuple):
        return f"[{', '.join(map(_flow, value))}]"
    if isinstance(value, float) and value.is_integer():
        return str(int(value))
    if isinstance(value, str) and _PLAIN.fullmatch(value) and value != "null":
        return value
    return json.dumps(value, ensure_ascii=False)
