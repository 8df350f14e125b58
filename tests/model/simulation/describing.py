"""Small simulations."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np

from zlmreport.model.effects.axis_model import Term
from zlmreport.model.planning.methods import Method
from zlmreport.model.planning.plan import AxisPlan
from zlmreport.model.simulation.description import Description
from zlmreport.plugin import Axis
from zlmreport_plugins.effects import zlmreport_effects

EFFECTS = {effect.identifier: effect for effect in zlmreport_effects()}


def described(
    targets: int = 11, method: Method = Method.LINEAR, runs: int = 5, **changes: Any
) -> Description:
    """Return the description of a quiet test of a metre."""
    plan = AxisPlan(np.linspace(0.0, 1.0, targets), method, runs)
    return replace(Description(Axis("X", travel=(0.0, 1.0)), plan, seed=1), **changes)


def hidden(identifier: str, **values: float) -> Term:
    return Term(EFFECTS[identifier], values)
