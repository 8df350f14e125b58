"""Calibration with a step gauge: a large plugin that uses nothing of zlmreport but its door.

What it offers is declared here, so that a job loads only what it names.
"""

from __future__ import annotations

from collections.abc import Mapping

#: Entry point to kinds to identifiers.
OFFERS: Mapping[str, Mapping[str, tuple[str, ...]]] = {
    "step_gauge": {"extension": ("step_gauge",), "source": ("step-gauge",), "standard": ("step-gauge",)},
    "step_gauge_effects": {"effect": ("gauge-misalignment", "probe-radius")},
    "step_gauge_programs": {"part_program": ("dmis", "ippdme", "mv-ms")},
}
