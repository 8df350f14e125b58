"""The door of part programs: the motion of a planned test."""

from __future__ import annotations

from zlmreport.model.planning.circle_path import (
    CirclePath,
    PathBlock,
    PlannedTurn,
    write_circle_heading as circle_heading,
)
from zlmreport.model.planning.programs import (
    Motion,
    ProgramOptions,
    write_axis_address as axis_address,
    write_heading as program_heading,
    write_plain_name as plain_name,
    write_program_number as program_number,
    write_remark as reading_remark,
)
from zlmreport.plugin.protocols import (
    PartProgram,
)

__all__ = [
    "CirclePath",
    "Motion",
    "PartProgram",
    "PathBlock",
    "PlannedTurn",
    "ProgramOptions",
    "axis_address",
    "circle_heading",
    "plain_name",
    "program_heading",
    "program_number",
    "reading_remark",
]
