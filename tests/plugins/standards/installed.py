"""The seven standards of positioning that come with zlmreport, by identifier."""

from __future__ import annotations

from installed import registry
from zlmreport.plugin import Evaluation, MeasurementSet
from zlmreport.plugin.protocols import Standard
from zlmreport.plugin.standard import evaluate

STANDARDS: dict[str, Standard] = {
    each: registry().standard(each)
    for each in (
        "iso230-2:1988",
        "iso230-2:1997",
        "iso230-2:2006",
        "iso230-2:2014",
        "vdi-dgq-3441",
        "vdi-vde-2617",
        "nmtba",
    )
}


def evaluated(identifier: str, measurements: MeasurementSet) -> Evaluation:
    standard = STANDARDS[identifier]
    return evaluate(standard, measurements, standard.options(), {})
