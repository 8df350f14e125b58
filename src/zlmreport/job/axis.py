"""Turns the axis of a job into SI, and reads its tables (compensation, angular errors)."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from types import MappingProxyType
from typing import Any

from zlmreport.job.circle_keys import CircleKeys
from zlmreport.job.measurement_keys import AxisKeys
from zlmreport.job.quantity import convert_places_to_si
from zlmreport.measurement.axis import Axis
from zlmreport.measurement.error_symbol import ErrorSymbol
from zlmreport.measurement.measurand import Measurand
from zlmreport.measurement.position_table import TableColumn, read_position_table
from zlmreport.measurement.units import ANGLE_UNITS, MICRORADIAN, MILLIMETRE


def convert_axis_to_si(
    keys: AxisKeys,
    measurand: Measurand | None = None,
    error: ErrorSymbol | None = None,
    at: Mapping[str, Any] = MappingProxyType({}),
    circle: CircleKeys | None = None,
) -> Axis:
    """Return the axis with its lengths in metres, or its angles in radians, and with its tables.

    `measurand`: What was measured of it; None for its positioning.
    `error`: The symbol of that, where the job states it.
    `at`: Where the other axes stood, mm or degrees.
    `circle`: That two axes ran together; None for a single axis.

    Raises `AccessError` if the file of a table cannot be read; `InputError` if it is not such a table.
    """
    bare = Axis(keys.name, keys.kind)
    to_si = bare.position_unit.to_si
    position = TableColumn("position", bare.position_unit, bare.position_units)
    deviation = TableColumn("deviation", bare.deviation_unit, bare.deviation_units)
    angle = TableColumn("angle", MICRORADIAN, ANGLE_UNITS)
    return Axis(
        name=keys.name,
        kind=keys.kind,
        travel=(to_si(keys.travel[0]), to_si(keys.travel[1])) if keys.travel else None,
        screw_pitch=to_si(keys.screw_pitch) if keys.screw_pitch else None,
        signal_period=to_si(keys.signal_period) if keys.signal_period else None,
        scale_element=to_si(keys.scale_element) if keys.scale_element else None,
        pole_pitch=to_si(keys.pole_pitch) if keys.pole_pitch else None,
        compensation_table=(
            read_position_table(keys.compensation_table, position, deviation, ("forward", "reverse"))
            if isinstance(keys.compensation_table, Path)
            else None
        ),
        angular_errors=(
            read_position_table(keys.angular_errors, position, angle) if keys.angular_errors else None
        ),
        abbe_offset=None if keys.abbe_offset is None else MILLIMETRE.to_si(keys.abbe_offset),
        quantity=measurand,
        error=error.symbol if error else "",
        at=convert_places_to_si(at),
        circle=circle.in_si() if circle else None,
    )
