"""The effects of circles that come with zlmreport, in the order in which they are offered."""

from __future__ import annotations

from collections.abc import Iterable

from zlmreport.plugin import hookimpl
from zlmreport.plugin.circle_effect import CircleEffect
from zlmreport_plugins.circle_effects.drives import (
    DriveCompliance,
    DynamicCrossTalk,
    ServoLag,
    ServoMismatch,
    Vibration,
)
from zlmreport_plugins.circle_effects.geometry import (
    Bow,
    CentreOffset,
    CyclicError,
    Radius,
    RadiusDrift,
    ScaleMismatch,
    Squareness,
)
from zlmreport_plugins.circle_effects.reversals import (
    CircleBacklash,
    LateralPlay,
    OverCompensation,
    ReversalSpikes,
    StickSlip,
)


@hookimpl
def zlmreport_circle_effects() -> Iterable[CircleEffect]:
    """Return all of them: of the set-up, of geometry, of drives, at reversals, in time."""
    return (
        CentreOffset(),
        Radius(),
        RadiusDrift(),
        ScaleMismatch(),
        Squareness(),
        Bow(),
        CyclicError(),
        ServoLag(),
        ServoMismatch(),
        DynamicCrossTalk(),
        DriveCompliance(),
        CircleBacklash(),
        OverCompensation(),
        LateralPlay(),
        ReversalSpikes(),
        StickSlip(),
        Vibration(),
    )
