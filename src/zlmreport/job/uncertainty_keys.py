"""The keys of the uncertainty budget: what the measuring set-up may add to the readings."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Literal, TypeAlias

from pydantic import Field

from zlmreport.job.part import JobPart
from zlmreport.job.types import NotNegative, Text
from zlmreport.measurement.axis import AxisKind

#: `zlmreport.uncertainty.contribution.Acts`, by its values.
ActsName: TypeAlias = Literal[
    "along-the-length",
    "between-directions",
    "at-the-datum",
    "at-each-position",
    "at-each-approach",
    "at-each-reading",
]


class ContributionKeys(JobPart):
    """A contribution that has no key of its own; its size is stated in one of three ways."""

    name: Text = Field(description="What it comes from.", examples=["Dead path"])
    expanded_uncertainty: NotNegative | None = Field(
        None, description="U with k = 2, micrometres (arc seconds)."
    )
    standard_uncertainty: NotNegative | None = Field(
        None, description="Or u, micrometres (arc seconds).", examples=[0.2]
    )
    range: NotNegative | None = Field(
        None, description="Or the full range of the values that it may have, micrometres (arc seconds)."
    )
    acts: ActsName = Field(
        description="Which readings share it: all in proportion to their distance from the first target, all "
        "of the negative direction, all alike, those of a target, those of a target in one "
        "direction, or none.",
        examples=["at-each-reading"],
    )
    distribution: Literal["normal", "rectangular", "triangular", "one-sided"] | None = Field(
        None,
        description="How its values are distributed; one-sided: rectangular from zero. Without it "
        "rectangular for a range, else normal.",
    )


class UncertaintyKeys(JobPart):
    """The uncertainty of the measuring set-up, beside that of the instrument.

    A range is full: from the smallest value that is possible to the largest.
    """

    misalignment: NotNegative | None = Field(
        None, description="Of the measuring line from the axis over the measured length, mm.", examples=[0.5]
    )
    machine_temperature: NotNegative | None = Field(
        None, description="Range of error of the machine's measured temperature, K.", examples=[0.4]
    )
    device_temperature: NotNegative | None = Field(
        None, description="Range of error of the measuring device's measured temperature, K.", examples=[0.2]
    )
    expansion_coefficient: NotNegative | None = Field(
        None,
        description="Range of error of the machine's expansion coefficient, micrometres/(m K).",
        examples=[2],
    )
    device_expansion_coefficient: NotNegative | None = Field(
        None,
        description="Range of error of the measuring device's expansion coefficient, micrometres/(m K).",
        examples=[1],
    )
    air_temperature: NotNegative | None = Field(
        None,
        description="Range of error of the measured air temperature, K, where corrections.air is made.",
        examples=[0.4],
    )
    air_pressure: NotNegative | None = Field(
        None, description="Likewise of the air pressure, hPa.", examples=[1]
    )
    relative_humidity: NotNegative | None = Field(
        None, description="Likewise of the relative humidity, %.", examples=[10]
    )
    environmental_variation: NotNegative | None = Field(
        None,
        description="Range of the readings of the axis at rest over the time of the test, micrometres (arc "
        "seconds).",
        examples=[0.6],
    )
    resolution: NotNegative | None = Field(
        None,
        description="Smallest step of the readings, micrometres (arc seconds). Without it that of their last "
        "digit, 0.001 at least; nothing if they are corrected.",
        examples=[0.1],
    )
    instrument_acts: ActsName | None = Field(
        None,
        description="Which readings share the error of the instrument. Without it along-the-length on a "
        "linear axis, at-each-position on a rotary one.",
    )
    contributions: list[ContributionKeys] = Field(
        default_factory=list,
        max_length=100,
        description="Anything else.",
        examples=[[{"name": "Dead path", "range": 0.3, "acts": "at-each-reading"}]],
    )


#: Keys that speak of lengths and their expansion.
_OF_LINEAR_AXES = (
    "misalignment",
    "machine_temperature",
    "device_temperature",
    "expansion_coefficient",
    "device_expansion_coefficient",
)
_SIZES = ("expanded_uncertainty", "standard_uncertainty", "range")


def contradictions(keys: UncertaintyKeys, kind: AxisKind) -> Iterator[tuple[tuple[str | int, ...], str]]:
    """Yield what no single key shows to be wrong: the path of a key, and a sentence."""
    if kind is AxisKind.ROTARY:
        for name in _OF_LINEAR_AXES:
            if getattr(keys, name) is not None:
                yield (name,), "belongs to a linear axis; take it out, or state contributions of this axis"
    for index, each in enumerate(keys.contributions):
        stated = [size for size in _SIZES if getattr(each, size) is not None]
        if len(stated) != 1:
            found = " and ".join(stated) or "none"
            yield ("contributions", index), f"state one of {', '.join(_SIZES)} (found: {found})"
        elif stated == ["range"] and each.distribution == "normal":
            yield (
                ("contributions", index, "distribution"),
                "a normal distribution has no range; state standard_uncertainty or expanded_uncertainty",
            )
