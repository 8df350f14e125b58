"""Linear displacement accuracy by step gauge, as Pahk and Kim evaluate and present it."""

from __future__ import annotations

from zlmreport.plugin import hookimpl
from zlmreport.plugin.protocols import Standard
from zlmreport_plugins.standards.step_gauge.standard import StepGaugeEvaluation


@hookimpl
def zlmreport_standards() -> tuple[Standard, ...]:
    """Return the one evaluation."""
    return (StepGaugeEvaluation(),)
