"""The keys of corrections that are computed from raw readings."""

from __future__ import annotations

from typing import Literal

from pydantic import Field

from zlmreport.job.part import JobPart
from zlmreport.job.types import Finite, Positive


class AirKeys(JobPart):
    """The refractive index of the air, which the instrument did not know."""

    assumed: Literal["vacuum", "standard air"] | Positive = Field(
        description="What the instrument took the index to be: that of vacuum, of air at 20 °C, 1013.25 hPa "
        "and 50 %, or the number that it was set to.",
        examples=["standard air", 1.00027],
    )
    wavelength: Positive = Field(
        632.991, description="Of the laser in vacuum, nm; that of a helium-neon laser.", examples=[632.991]
    )


class DeadPathKeys(JobPart):
    """The path in air that the instrument does not count: before the datum."""

    length: Positive = Field(
        description="From the interferometer to the reflector at the datum, mm.", examples=[150]
    )
    measured_path: Literal["grows", "shrinks"] = Field(
        "grows", description="What the path between them does while the position rises."
    )


class MaterialKeys(JobPart):
    """The expansion of the material, back to 20 °C."""

    expansion_coefficient: Positive | None = Field(
        None,
        description="Micrometres/(m K); without it environment.expansion_coefficient.",
        examples=[11.5],
    )
    temperature: Literal["material_temperature", "axis_temperature"] = Field(
        "material_temperature", description="The logged or stated temperature that the material has."
    )


class CorrectionKeys(JobPart):
    """What the readings are corrected for; without these keys they are taken as they are."""

    air: AirKeys | None = Field(
        None, description="The refractive index of the air along the measured length."
    )
    dead_path: DeadPathKeys | None = Field(
        None, description="Changes of the air along the dead path; only beside air."
    )
    material: MaterialKeys | None = Field(None, description="Thermal expansion of the material.")
    datum: Finite | None = Field(
        None,
        description="Position at which the instrument was set to zero, mm. Without it as the readings tell, "
        "or else the first target position.",
        examples=[0],
    )
