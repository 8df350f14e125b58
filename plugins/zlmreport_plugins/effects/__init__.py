"""The effects that come with zlmreport: one page each."""

from __future__ import annotations

from collections.abc import Iterable

from zlmreport.plugin import Effect, hookimpl
from zlmreport_plugins.effects.air import AirIndex, DeadPath
from zlmreport_plugins.effects.compensation import CompensationShift, CompensationSign
from zlmreport_plugins.effects.geometry import Abbe, CosineError, Offset, Polynomial, ScaleError
from zlmreport_plugins.effects.over_time import DatumStep, FirstRun, TimePeriodic
from zlmreport_plugins.effects.periodic import DirectionalPitch, EncoderInterpolation, Periodic, ScrewPitch
from zlmreport_plugins.effects.reversal import Backlash, BacklashBow, BacklashGradient, ReversalRelaxation
from zlmreport_plugins.effects.rotary import Eccentricity, Ellipticity, GearMesh
from zlmreport_plugins.effects.scale import ScaleJoint, ScaleKink
from zlmreport_plugins.effects.thermal import (
    DatumTemperature,
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
