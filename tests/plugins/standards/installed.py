"""The seven standards that come with zlmreport, by identifier."""

from __future__ import annotations

from zlmreport.plugin.protocols import Standard
from zlmreport_plugins.standards import iso230_2, nmtba, vdi

STANDARDS: dict[str, Standard] = {
    standard.identifier: standard
    for module in (iso230_2, vdi, nmtba)
    for standard in module.zlmreport_standards()
}
