"""The keys of a test that is still to be done: its target positions, and what is expected of it."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any, Literal

from pydantic import BaseModel, ConfigDict, Field, model_validator

from zlmreport.job.types import Finite, JobPart, NotNegative, Positive, Text


class PlannedTargetKeys(JobPart):
    """The target positions: a number of them at random fractions of a period, or a list."""

    count: int | None = Field(
        None,
        ge=2,
        le=2000,
        description="Number of targets over the travel. Without it as many as the standards ask, at least 11 "
        "and no more than 100 mm or 30 degrees apart.",
        examples=[21],
    )
    fractions_of: NotNegative | None = Field(
        None,
        description="Period of whose random fractions the targets lie, mm or degrees; 0 for even targets. "
        "Without it axis.screw_pitch, or else a quarter of the interval.",
        examples=[10],
    )
    positions: list[Finite] | None = Field(
        None, min_length=2, max_length=2000, description="Instead: all targets, rising, mm or degrees."
    )


class ProgramKeys(BaseModel):
    """A part program; the plugin's own keys may follow."""

    model_config = ConfigDict(extra="allow", frozen=True)

    program: Text = Field(description="Identifier of an installed writer of part programs.")

    @model_validator(mode="before")
    @classmethod
    def _bare_identifier(cls, value: Any) -> Any:
        """Take a bare identifier for the part program without further keys."""
        return {"program": value} if isinstance(value, str | int | float) else value


class ControllerKeys(BaseModel):
    """A control that takes compensation tables; the plugin's own keys may follow."""

    model_config = ConfigDict(extra="allow", frozen=True)

    controller: Text = Field(description="Identifier of an installed controller.", examples=["linuxcnc"])


class PauseKeys(JobPart):
    """A rest half-way through the test in which a temperature changes."""

    minutes: Positive = Field(description="How long.")
    change: Finite = Field(description="By how much the temperature changes meanwhile, K.")
    of: Literal["axis_temperature", "screw_temperature", "air_temperature"] = Field(
        "axis_temperature",
        description="Which one: the whole machine's; the screw's, while the axis runs to and fro; or the "
        "air's. What it takes along with it is estimated.",
    )


class PlanKeys(JobPart):
    """The test before it is done, for `zlmreport plan`."""

    targets: PlannedTargetKeys = Field(
        default_factory=PlannedTargetKeys, description="The target positions.", examples=[{"count": 21}]
    )
    runs: int | None = Field(
        None,
        ge=1,
        le=1000,
        description="Readings of each target in each direction. Without it what the standards ask, mostly 5.",
    )
    overrun: Finite | None = Field(
        None,
        ge=0.001,
        description="How far beyond a target the axis turns round, mm or degrees, at least 0.001. Without it "
        "5, or a fiftieth of a short travel.",
    )
    seed: int | None = Field(
        None,
        ge=0,
        description="Of the random fractions: the same seed gives the same targets. Without it, it follows "
        "from certificate.number.",
    )
    repeatability: Positive = Field(
        1.0,
        description="Standard deviation of a single reading that is expected, micrometres (arc seconds).",
    )
    temperature_change: Positive = Field(
        1.0, description="By how much temperatures are expected to rise during the test, K."
    )
    pause: PauseKeys | None = Field(
        None,
        description="A rest half-way, between two runs where the method goes run by run.",
        examples=[{"minutes": 60, "change": 3}],
    )
    programs: list[ProgramKeys] = Field(
        default_factory=list,
        description="Part programs that are written beside the plan; a bare identifier stands for "
        "{program: …}.",
        examples=[["linuxcnc"]],
    )


def plan_contradictions(targets: PlannedTargetKeys) -> Iterator[tuple[str, str]]:
    """Yield what no single key of the targets shows to be wrong: the key, and a sentence."""
    if targets.positions is None:
        return
    if targets.count is not None or targets.fractions_of is not None:
        yield "positions", "either positions, or a count of targets with fractions_of; take one of them out"
    if sorted(set(targets.positions)) != targets.positions:
        yield "positions", "target positions rise, and none is there twice"
