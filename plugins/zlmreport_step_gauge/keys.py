"""Keys of ``step_gauge`` in a job, and their defaults: gauge, place, probing; its machine on the network.

The temperature and the expansion of the machine's scale are no keys of their own: they stand in
`environment`, as for any other instrument.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Annotated, Literal

from pydantic import Field

from zlmreport.plugin import CONDITIONS, Finite, JobPart, JobPath, NotNegative, Options, Positive, TextLine
from zlmreport.plugin.extension import ProgramKeys

_CELSIUS = CONDITIONS["air_temperature"]
#: Of a gauge, °C: within what is taken for the temperature of anything near a machine.
Temperature = Annotated[float, Field(ge=_CELSIUS.lowest, le=_CELSIUS.highest, allow_inf_nan=False)]
#: Number of a block, from 1 at the beginning of the gauge.
Block = Annotated[int, Field(ge=1, le=10_000)]


class ProbingProgramKeys(ProgramKeys):
    """A probing program; the plugin's own keys may follow."""

    program: TextLine = Field(description="Identifier of an installed writer of probing programs.")


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
    search: Positive = Field(
        4.0, description="How far behind the place of a face the probe goes before the face is missed, mm."
    )
    stylus_allowance: NotNegative = Field(
        0.5, description="What must stay free between the tip and all that it does not measure, mm."
    )
    lead_in: Positive | None = Field(
        None,
        description="How far before the first face a horizontal path comes into the line of the gauge, "
        "before it goes round the side, mm. Without it, it comes from the side.",
        examples=[20],
    )
    speed: Positive = Field(30.0, description="Of moves between the faces, mm/s.")
    measuring_speed: Positive = Field(3.0, description="Of measuring moves, mm/s.")
    cycles: int = Field(5, ge=1, le=100, description="How often each face is probed.")
    safe_position: tuple[Finite, Finite, Finite] | None = Field(
        None,
        description="Where the path begins and ends: x, y, z of the tip's centre, mm.",
        examples=[[0, 0, 400]],
    )
    working_volume: tuple[tuple[Finite, Finite], tuple[Finite, Finite], tuple[Finite, Finite]] | None = Field(
        None,
        description="First and last position in x, y and z that the tip's centre can reach, mm.",
        examples=[[[0, 500], [0, 700], [0, 450]]],
    )
    programs: list[ProbingProgramKeys] = Field(
        default_factory=list,
        description="Probing programs that are written beside the plan; a bare identifier stands for "
        "{program: …}.",
        examples=[["dmis"]],
    )


class StepGaugeKeys(Options):
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
    effective_radius: Positive | None = Field(
        None,
        description="Effective radius of the tip in the probing direction, as calibrated, mm. Without it, it "
        "is determined from the gauge's own blocks, and takes the mean reversal with it.",
        examples=[1.9985],
    )
    effective_radius_uncertainty: NotNegative = Field(
        0.0, description="Standard uncertainty of effective_radius, micrometres.", examples=[0.2]
    )
    probing_uncertainty: NotNegative = Field(
        0.0,
        description="Standard uncertainty of a single touch by the probe's own repeatability, micrometres.",
        examples=[0.3],
    )
    gauge_temperature: Temperature | None = Field(
        None, description="Temperature of the gauge during the test, °C.", examples=[20.3]
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


def find_contradictions(keys: StepGaugeKeys) -> Iterator[tuple[str, str]]:
    """Yield what no single key shows to be wrong: the key, and a sentence."""
    first, last = keys.first_block, keys.last_block
    if first is not None and last is not None and first >= last:
        yield (
            "last_block",
            (
                f"the section ends with block {last} and begins with block {first}; its end lies behind its "
                "beginning, and it has two blocks at least"
            ),
        )
    if keys.radius_correction and keys.effective_radius is not None:
        yield "effective_radius", "the machine has corrected the radius (radius_correction); take one out"
    if keys.compensate != "nothing" and keys.gauge_temperature is None:
        yield "compensate", "the expansion of the gauge needs its temperature; state gauge_temperature"
    if keys.path.retract > keys.path.approach:
        yield (
            "path",
            (
                f"retract: {keys.path.retract:g} mm is farther than the approach, {keys.path.approach:g} mm, "
                "and nobody knows what is there; state less"
            ),
        )
    volume = keys.path.working_volume or ()
    for name, (low, high) in zip("xyz", volume, strict=bool(volume)):
        if low >= high:
            yield "path", f"working_volume: in {name} the first position must be less than the last"


#: The TCP port of I++ DME.
STANDARD_PORT = 1294
#: Names that a server knows its tools by: they stand between quotes.
TOOL = r"^[A-Za-z0-9 ._-]{1,64}$"


class MachineKeys(JobPart):
    """A coordinate measuring machine on the network, for `zlmreport capture`."""

    host: TextLine = Field(description="Name or address of its server.", examples=["192.168.1.20"])
    port: int = Field(STANDARD_PORT, ge=1, le=65535, description="TCP port of its server.")
    tool: str | None = Field(
        None,
        pattern=TOOL,
        description="Name of the tool that the machine is to take. Without it, the one that it has.",
        examples=["RefTool"],
    )
    timeout: Positive = Field(120.0, description="How long a single command of the machine may take, s.")
