"""One test evaluated by every standard: the example of `configs/linear-axis`."""

from __future__ import annotations

from pathlib import Path

from markdown import symbol, table

from zlmreport.document.writer import Writer
from zlmreport.job.loading import load
from zlmreport.language import Language
from zlmreport.pipeline import compose
from zlmreport.plugin.registry import find_plugins

_JOB = Path(__file__).parents[2] / "configs" / "linear-axis" / "certificate.yaml"


def text() -> str:
    """Return the parameters of the example by each standard that its job names, in micrometres."""
    registry = find_plugins()
    certificate = compose(load(_JOB, registry), registry)
    writer = Writer.of(certificate.measurements, Language.ENGLISH)
    return table(
        ("By", f"Parameters, {writer.deviation_unit.symbol}"),
        (
            (
                evaluation.designation,
                ", ".join(
                    f"{symbol(parameter.quantity.notation)} = {writer.deviation(parameter.printed_value)}"
                    for parameter in evaluation.parameters
                ),
            )
            for evaluation in certificate.evaluations
        ),
    )
