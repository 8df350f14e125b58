"""The effects that come with zlmreport: one page each."""

from __future__ import annotations

from collections.abc import Iterable

from zlmreport.plugin import Effect, hookimpl
from zlmreport_plugins.effects.abbe import Abbe
from zlmreport_plugins.effects.air_index import AirIndex
from zlmreport_plugins.effects.backlash import Backlash
from zlmreport_plugins.effects.backlash_bow import BacklashBow
from zlmreport_plugins.effects.backlash_gradient import BacklashGradient
from zlmreport_plugins.effects.compensation_shift import CompensationShift
from zlmreport_plugins.effects.compensation_sign import CompensationSign
from zlmreport_plugins.effects.cosine_error import CosineError
from zlmreport_plugins.effects.datum_step import DatumStep
from zlmreport_plugins.effects.datum_temperature import DatumTemperature
from zlmreport_plugins.effects.dead_path import DeadPath
from zlmreport_plugins.effects.directional_pitch import DirectionalPitch
from zlmreport_plugins.effects.eccentricity import Eccentricity
from zlmreport_plugins.effects.ellipticity import Ellipticity
from zlmreport_plugins.effects.encoder_interpolation import EncoderInterpolation
from zlmreport_plugins.effects.first_run import FirstRun
from zlmreport_plugins.effects.gauge_misalignment import GaugeMisalignment
from zlmreport_plugins.effects.gear_mesh import GearMesh
from zlmreport_plugins.effects.offset import Offset
from zlmreport_plugins.effects.periodic import Periodic
from zlmreport_plugins.effects.polynomial import Polynomial
from zlmreport_plugins.effects.probe_radius import ProbeRadius
from zlmreport_plugins.effects.reversal_relaxation import ReversalRelaxation
from zlmreport_plugins.effects.scale_error import ScaleError
from zlmreport_plugins.effects.scale_expansion import ScaleExpansion
from zlmreport_plugins.effects.scale_joint import ScaleJoint
from zlmreport_plugins.effects.scale_kink import ScaleKink
from zlmreport_plugins.effects.screw_expansion import ScrewExpansion
from zlmreport_plugins.effects.screw_pitch import ScrewPitch
from zlmreport_plugins.effects.thermal_drift import ThermalDrift
from zlmreport_plugins.effects.thermal_growth import ThermalGrowth
from zlmreport_plugins.effects.time_periodic import TimePeriodic


@hookimpl
def zlmreport_effects() -> Iterable[Effect]:
    """Return all of them: of position, of direction, of time and temperature, of rotary axes and gauges."""
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
        ProbeRadius(),
        GaugeMisalignment(),
    )
