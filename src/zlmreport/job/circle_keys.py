"""The key `circle` of a job: a circular test, which two axes run together and no single one."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, Annotated, Literal

from pydantic import Field

from zlmreport.job.types import Finite, JobPart, Positive, Text, optional
from zlmreport.measurement.circle import NominalCircle
from zlmreport.measurement.measurand import CIRCLE, Measurand
from zlmreport.measurement.units import MILLIMETRE, SECONDS_PER_MINUTE

if TYPE_CHECKING:
    from zlmreport.job.keys import JobKeys
    from zlmreport.job.tree import Step

#: Keys of `plan` that a circle has too.
_OF_PLANNED_CIRCLES = frozenset({"circle", "runs", "programs"})


class CircleKeys(JobPart):
    """A circular test, instead of an axis."""

    plane: Literal["XY", "YZ", "ZX"] = Field("XY", description="Plane of the circle.")
    radius: Positive = Field(description="Nominal radius, mm.", examples=[150])
    feed: Positive = Field(description="Feed along the path, mm/min.", examples=[1000])
    centre: tuple[Finite, Finite, Finite] = Field(
        (0.0, 0.0, 0.0),
        description="Centre of the circle in the machine: X, Y and Z, mm.",
        examples=[[250, 150, 80]],
    )
    calibrated_length: bool = Field(
        default=False,
        description="Whether the length of the instrument was calibrated: only then a mean radius, and what "
        "is reckoned from the nominal one, says something of the machine.",
    )
    certificate: Text | None = optional(
        "Calibration certificate of that length: of the bar, or of the calibrator it was set by."
    )

    def in_si(self) -> NominalCircle:
        """Return the circle in metres and seconds."""
        x, y, z = map(MILLIMETRE.to_si, self.centre)
        feed = MILLIMETRE.to_si(self.feed) / SECONDS_PER_MINUTE
        return NominalCircle(
            self.plane, MILLIMETRE.to_si(self.radius), feed, (x, y, z), self.calibrated_length
        )


class CirclePlanKeys(JobPart):
    """The path of a circular test before it is done, for `zlmreport plan`."""

    start: Annotated[float, Field(ge=-360, le=360)] = Field(
        0.0,
        description="Where a turn is evaluated from, degrees from the plane's first axis towards its second.",
        examples=[90],
    )
    extent: Annotated[float, Field(gt=0, le=360)] = Field(
        360.0, description="How far round it is evaluated, degrees; less is an arc.", examples=[220]
    )
    arc: Annotated[float, Field(ge=0, le=360)] = Field(
        180.0,
        description="Of the circle, run before and behind what is evaluated, degrees: the machine comes up "
        "to its feed there.",
    )
    run_up: Annotated[float, Field(ge=0, le=100)] = Field(
        1.5, description="How far outside the circle the tool begins and ends each turn, mm."
    )
    rest: Annotated[float, Field(ge=0, le=3600)] = Field(
        5.0, description="Time at rest between two turns, s."
    )
    feeds: list[Positive] = Field(
        [],
        max_length=20,
        description="Feeds, mm/min: a part program is written for each. Without it circle.feed alone.",
        examples=[[500, 1000, 2000]],
    )


def find_lack_of_circle(keys: JobKeys, measurand: Measurand) -> Iterator[tuple[tuple[Step, ...], str]]:
    """Yield what would need a circle, of a job that states none."""
    if measurand.identifier == CIRCLE.identifier:
        yield (
            ("circle",),
            "missing; say which circle was run: {plane: XY, radius: 150, feed: 1000} (mm, mm/min)",
        )
    if keys.plan.circle is not None:
        yield ("plan", "circle"), "belongs to a circular test (circle: …); take it out"


def find_circle_contradictions(
    keys: JobKeys, circle: CircleKeys, *, has_axis: bool
) -> Iterator[tuple[tuple[Step, ...], str]]:
    """Yield what does not go together of a circle and the other keys of a job.

    `has_axis`: Whether the job itself states an axis, which a circle stands for otherwise.
    """
    if has_axis:
        yield ("axis",), "a circle stands instead of an axis; take one of the two out"
    if keys.measurement.error is not None:
        yield (
            ("measurement", "error"),
            "names the error of one axis, and a circle is run by two; take it out",
        )
    if keys.measurement.tests:
        yield ("measurement", "tests"), "a circle is one measurement; write a job for each circle"
    for key in ("method", "dwell"):
        if getattr(keys.measurement, key) is not None:
            yield ("measurement", key), "a circle has no targets at which an axis stops; take it out"
    feed = keys.measurement.feed
    if feed is not None and feed != circle.feed:
        yield (
            ("measurement", "feed"),
            f"{feed:g} is not the feed of the circle (circle.feed: {circle.feed:g})",
        )
    for key in sorted(keys.plan.model_fields_set - _OF_PLANNED_CIRCLES):
        yield ("plan", key), "belongs to a test at targets; the path of a circle stands under plan.circle"
