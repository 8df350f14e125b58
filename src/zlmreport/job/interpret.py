"""From the users' units to SI: the axis and the tolerances of a job."""

from __future__ import annotations

from collections.abc import Mapping

from zlmreport.job.model import AxisKeys
from zlmreport.measurement.axis import Axis, position_units
from zlmreport.measurement.position_table import TableColumn, read_position_table
from zlmreport.quantities.units import ANGLE_UNITS, MICRORADIAN, MILLIMETRE


def axis_in_si(keys: AxisKeys) -> Axis:
    """Return the axis with its lengths in metres, or its angles in radians, and with its tables.

    Raises
    ------
    AccessError
        If the file of a table cannot be read.
    InputError
        If it is not such a table.
    """
    bare = Axis(keys.name, keys.kind)
    to_si = bare.position_unit.to_si
    position = TableColumn("position", bare.position_unit, position_units(keys.kind))
    deviation = TableColumn("deviation", bare.deviation_unit, position_units(keys.kind))
    angle = TableColumn("angle", MICRORADIAN, ANGLE_UNITS)
    return Axis(
        name=keys.name,
        kind=keys.kind,
        travel=(to_si(keys.travel[0]), to_si(keys.travel[1])) if keys.travel else None,
        screw_pitch=to_si(keys.screw_pitch) if keys.screw_pitch else None,
        signal_period=to_si(keys.signal_period) if keys.signal_period else None,
        scale_element=to_si(keys.scale_element) if keys.scale_element else None,
        compensation_table=(
            read_position_table(keys.compensation_table, position, deviation)
            if keys.compensation_table
            else None
        ),
        angular_errors=(
            read_position_table(keys.angular_errors, position, angle) if keys.angular_errors else None
        ),
        abbe_offset=None if keys.abbe_offset is None else MILLIMETRE.to_si(keys.abbe_offset),
    )


def tolerances_in_si(tolerances: Mapping[str, float], axis: Axis) -> dict[str, float]:
    """Return tolerances, given in µm or ″, in metres or radians."""
    return {symbol: axis.deviation_unit.to_si(limit) for symbol, limit in tolerances.items()}
