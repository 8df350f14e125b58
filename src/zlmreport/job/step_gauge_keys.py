"""The keys of a calibration with a step gauge: the gauge, where it lies, and how it is probed.

The temperature and the expansion of the machine's scale are no keys of their own: they stand in
`environment`, as for any other instrument.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Annotated, Literal

from pydantic import Field

from zlmreport.job.options import JobPath
from zlmreport.job.part import JobPart
from zlmreport.job.types import Finite, NotNegative, Positive

#: Number of a block, from 1 at the beginning of the gauge.
Block = Annotated[int, Field(ge=1, le=10_000)]


class ProbingPathKeys(JobPart):
    """The way of the probe from face to face; distances are of the tip's surface, mm."""

    kind: Literal["vertical", "horizontal"] = Field(
        "vertical", description="Over the top of the blocks, or round their side."
    )
    clearance: Positive = Field(
        5.0, description="Distance of the tip from the blocks while it passes them, mm.", examples=[5]
    )
    approach: Positive = Field(
        2.5, description="Distance from the face at which the measuring move begins, mm.", examples=[2.5]
    )
    retract: Positive = Field(
        2.0, description="How far the probe draws back from a face that it has touched, mm."
    )
    depth: Positive | None = Field(
        None,
        description="How far below the top of the blocks their faces are probed, mm. Without it at half "
        "their height.",
    )
    cycles: int = Field(5, ge=1, le=100, description="How often each face is probed.")
    safe_position: tuple[Finite, Finite, Finite] | None = Field(
        None,
        description="Where the path begins and ends: x, y, z of the tip's centre, mm.",
        examples=[[0, 0, 400]],
    )
    working_volume: (
        tuple[tuple[Finite, Finite], tuple[Finite, Finite], tuple[Finite, Finite]] | None
    ) = Field(
        None,
        description="First and last position in x, y and z that the tip's centre can reach, mm.",
        examples=[[[0, 500], [0, 700], [0, 450]]],
    )


class StepGaugeKeys(JobPart):
    """A calibrated step gauge, where it lies on the machine, and how its faces are probed."""

    calibration: JobPath = Field(
        description="The gauge's calibration: a YAML file, or a CSV file of its faces.",
        examples=["gauge.yaml"],
    )
    first_block: Block | None = Field(
        None, description="First block of the section that is used. Without it the first of the gauge."
    )
    last_block: Block | None = Field(
        None, description="Last block of the section. Without it the last of the gauge."
    )
    initial_points: JobPath | None = Field(
        None,
        description="CSV file of the 16 points that say where the gauge lies: columns block (begin, end), "
        "point (1 to 8), x, y, z, mm.",
        examples=["initial-points.csv"],
    )
    initial_points_uncertainty: Positive = Field(
        5.0, description="Standard uncertainty of a coordinate of the initial points, micrometres."
    )
    tip_radius: Positive | None = Field(
        None, description="Nominal radius of the probe's tip, mm.", examples=[2]
    )
    radius_correction: bool = Field(
        default=False,
        description="Whether the machine has taken the tip's radius into account: true, if coordinates are "
        "those of the surface.",
    )
    gauge_temperature: Finite | None = Field(
        None, description="Temperature of the gauge during the test, °C.", examples=[20.3]
    )
    gauge_temperature_uncertainty: NotNegative = Field(
        0.1, description="Its standard uncertainty, K."
    )
    scale_temperature_uncertainty: NotNegative = Field(
        0.1, description="Standard uncertainty of environment.axis_temperature, K."
    )
    compensate: Literal["nothing", "gauge", "gauge-and-scale"] = Field(
        "nothing",
        description="Whose expansion is taken into account here: that of the gauge, or also that of the "
        "machine's scale (environment.axis_temperature, environment.expansion_coefficient).",
    )
    path: ProbingPathKeys = Field(
        default_factory=ProbingPathKeys,
        description="The way of the probe from face to face.",
        examples=[{"kind": "horizontal", "clearance": 10}],
    )


def contradictions(keys: StepGaugeKeys) -> Iterator[tuple[str, str]]:
    """Yield what no single key shows to be wrong: the key, and a sentence."""
    first, last = keys.first_block, keys.last_block
    if first is not None and last is not None and first >= last:
        yield (
            "last_block",
            f"the section ends with block {last} and begins with block {first}; its end lies behind its "
            "beginning, and it has two blocks at least",
        )
    if keys.compensate != "nothing" and keys.gauge_temperature is None:
        yield "compensate", "the expansion of the gauge needs its temperature; state gauge_temperature"
    volume = keys.path.working_volume or ()
    for name, (low, high) in zip("xyz", volume, strict=bool(volume)):
        if low >= high:
            yield "path", f"working_volume: in {name} the first position must be less than the last"
