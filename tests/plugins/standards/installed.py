"""The seven standards that come with zlmreport, by identifier."""

from __future__ import annotations

from zlmreport.plugin import Evaluation, MeasurementSet
from zlmreport.plugin.protocols import Standard
from zlmreport.plugin.standard import evaluate
from zlmreport_plugins.standards import iso230_2, nmtba, vdi

STANDARDS: dict[str, Standard] = {
    standard.identifier: standard
    for module in (iso230_2, vdi, nmtba)
    for standard in module.zlmreport_standards()
}


def evaluated(identifier: str, measurements: MeasurementSet) -> Evaluation:
    standard = STANDARDS[identifier]
    return evaluate(standard, measurements, standard.options(), {})
