"""Tables across axes as plain values for JSON: what they hold, what they will leave, what circles showed."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from zlmreport.machines.cross_confirmation import CrossConfirmation
from zlmreport.machines.cross_making import CrossMade
from zlmreport.machines.cross_tables import CrossForecast
from zlmreport.measurement.units import MICROMETRE, MILLIMETRE

SCHEMA = "zlmreport/machine-compensation/1"
CONFIRMATION_SCHEMA = "zlmreport/machine-confirmation/1"


def collect_cross(made: CrossMade) -> dict[str, Any]:
    """Return tables with their forecast; lengths in µm, positions in mm."""
    return {
        "schema": SCHEMA,
        "controller": made.control.identifier,
        "positive_value_moves": made.moves,
        "taken": list(made.held),
        "within_uncertainty": list(made.plan.within_uncertainty),
        "tables": [
            {
                "input": each.input,
                "output": each.output,
                "positions": MILLIMETRE.from_si(each.positions).tolist(),
                "deviation": MICROMETRE.from_si(each.values).tolist(),
            }
            for each in made.decoded
        ],
        "forecast": dict(_forecast(made.forecast)),
        "unit": "um",
    }


def _forecast(found: CrossForecast) -> Iterator[tuple[str, Any]]:
    in_um = MICROMETRE.from_si
    yield (
        "circles",
        [
            {
                "test": each.name,
                "rms": [in_um(each.before), in_um(each.after)],
                "numbers": {name: [in_um(before), in_um(after)] for name, before, after in each.numbers},
            }
            for each in found.circles
        ],
    )
    yield "diagonals", {name: [in_um(before), in_um(after)] for name, before, after in found.diagonals}
    yield "largest", [in_um(each) for each in found.largest] if found.largest else None


def collect_confirmation(found: CrossConfirmation) -> dict[str, Any]:
    """Return how later circles stand to the forecast; lengths in µm."""
    in_um = MICROMETRE.from_si
    is_seen = found.expanded_uncertainty < float("inf")
    return {
        "schema": CONFIRMATION_SCHEMA,
        "verdict": found.verdict.value,
        "applied": found.applied if is_seen else None,
        "expanded_uncertainty": found.expanded_uncertainty if is_seen else None,
        "circles": [
            {
                "test": each.name,
                "before": in_um(each.before),
                "forecast": in_um(each.forecast),
                "after": in_um(each.after),
            }
            for each in found.circles
        ],
        "unit": "um",
    }
