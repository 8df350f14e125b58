"""The effects that come with zlmreport: one page each."""

from __future__ import annotations

from collections.abc import Iterable

from zlmreport.plugin import Effect, hookimpl
from zlmreport_plugins.effects.compensation import CompensationShift, CompensationSign
from zlmreport_plugins.effects.course import (
    Backlash,
    BacklashBow,
    BacklashGradient,
    DatumStep,
    FirstRun,
    ReversalRelaxation,
    TimePeriodic,
)
from zlmreport_plugins.effects.geometry import (
    Abbe,
    CosineError,
    Offset,
    Polynomial,
    ScaleError,
    ScaleJoint,
    ScaleKink,
)
from zlmreport_plugins.effects.periodic import (
    DirectionalPitch,
    Eccentricity,
    Ellipticity,
    EncoderInterpolation,
    GearMesh,
    Periodic,
    ScrewPitch,
)
from zlmreport_plugins.effects.thermal import (
    AirIndex,
    DatumTemperature,
    DeadPath,
    ScaleExpansion,
    ScrewExpansion,
    ThermalDrift,
    ThermalGrowth,
)


@hookimpl
def zlmreport_effects() -> Iterable[Effect]:
    """Return all of them: of position, of direction, of time and temperature, of rotary axes."""
    return (
        Offset(),
        ScaleError(),
        Polynomial(),
        CosineError(),
        ScrewPitch(),
        EncoderInterpolation(),
        Periodic(),
        ScaleJoint(),
        ScaleKink(),
        CompensationSign(),
        CompensationShift(),
        Abbe(),
        Backlash(),
        BacklashGradient(),
        BacklashBow(),
        ReversalRelaxation(),
        DirectionalPitch(),
        ScaleExpansion(),
        ScrewExpansion(),
        ThermalGrowth(),
        ThermalDrift(),
        DatumTemperature(),
        AirIndex(),
        DeadPath(),
        TimePeriodic(),
        DatumStep(),
        FirstRun(),
        Eccentricity(),
        Ellipticity(),
        GearMesh(),
    )
