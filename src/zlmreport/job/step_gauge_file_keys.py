"""The keys of a step gauge's calibration file."""

from __future__ import annotations

from typing import Literal

from pydantic import Field

from zlmreport.job.types import Date, Finite, JobPart, NotNegative, Positive, Text


class FaceKeys(JobPart):
    """A calibrated face."""

    face: int = Field(ge=1, description="Its number, from 1 at the beginning of the gauge.", examples=[1])
    side: Literal["front", "back"] = Field(description="front: the face nearer to the beginning.")
    nominal: Finite = Field(description="Nominal distance from the reference face, mm.", examples=[10])
    calibrated: Finite = Field(description="Calibrated distance, mm.", examples=[9.99962])
    expanded_uncertainty: NotNegative = Field(
        description="Of the calibrated distance (k = 2), micrometres.", examples=[0.21]
    )


class BlockKeys(JobPart):
    """The size of the blocks across the gauge."""

    width: Positive | None = Field(None, description="mm", examples=[20])
    height: Positive | None = Field(None, description="mm", examples=[15])


class StepGaugeFileKeys(JobPart):
    """A calibrated step gauge."""

    schema_: Literal["zlmreport/step-gauge/1"] = Field(
        alias="schema", description="Version of this format.", examples=["zlmreport/step-gauge/1"]
    )
    name: Text = Field(description="Type designation.", examples=["Step gauge 420"])
    manufacturer: Text | None = Field(None, description="Who built it.")
    serial: Text | None = Field(None, description="Serial number.")
    certificate: Text | None = Field(None, description="Its calibration certificate.")
    calibrated: Date | None = Field(None, description="Date of that calibration.", examples=["2026-02-10"])
    support: Text | None = Field(None, description="How it was supported.", examples=["at its Bessel points"])
    expansion_coefficient: Finite | None = Field(None, description="α, micrometres/(m K).", examples=[11.5])
    expansion_coefficient_uncertainty: NotNegative | None = Field(
        None, description="Standard uncertainty of α, micrometres/(m K).", examples=[0.5]
    )
    reference_temperature: Finite = Field(20.0, description="At which the distances hold, °C.")
    block: BlockKeys = Field(
        default_factory=BlockKeys,
        description="The size of the blocks across the gauge.",
        examples=[{"width": 20, "height": 15}],
    )
    faces: list[FaceKeys] = Field(
        min_length=4,
        max_length=2000,
        description="The faces from the beginning of the gauge.",
        examples=[[{"face": 1, "side": "front", "nominal": 0, "calibrated": 0, "expanded_uncertainty": 0.2}]],
    )
