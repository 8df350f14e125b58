"""Small simulations."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np

from installed import registry
from zlmreport.model.effects.axis_model import Term
from zlmreport.model.planning.methods import Method
from zlmreport.model.planning.plan import AxisPlan
from zlmreport.model.simulation.description import Description
from zlmreport.plugin import Axis


def described(
    targets: int = 11, method: Method = Method.LINEAR, runs: int = 5, **changes: Any
) -> Description:
    """Return the description of a quiet test of a metre."""
    plan = AxisPlan(np.linspace(0.0, 1.0, targets), method, runs)
    return replace(Description(Axis("X", travel=(0.0, 1.0)), plan, seed=1), **changes)


def hidden(identifier: str, **values: float) -> Term:
    return Term(registry().effect(identifier), values)
