"""Reading findings in tests."""

from __future__ import annotations

from zlmreport.plugin import Language
from zlmreport.plugin.standard import Finding


def said(finding: Finding) -> tuple[str, str, bool | None]:
    """Return requirement, what was found, and whether it is met, in English."""
    english = Language.ENGLISH
    return finding.requirement.in_language(english), finding.found.in_language(english), finding.met
