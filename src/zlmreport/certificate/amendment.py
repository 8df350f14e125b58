"""A document that changes an earlier one (ISO/IEC 17025:2017, 7.8.8)."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from zlmreport.certificate.document import Notice
from zlmreport.language import Words

if TYPE_CHECKING:
    from zlmreport.job.document_keys import CertificateKeys
    from zlmreport.presenting.writer import Writer

TITLES = {
    "certificate": Words(en="Calibration Certificate", de="Kalibrierschein"),
    "report": Words(en="Measuring Report", de="Messbericht"),
}
_AMENDMENT = {
    "certificate": Words(
        en="Amendment to Calibration Certificate {number}", de="Änderung zum Kalibrierschein {number}"
    ),
    "report": Words(en="Amendment to Measuring Report {number}", de="Änderung zum Messbericht {number}"),
}
_AMENDMENT_OF_OWN_TITLE = Words(en="Amendment to {title} {number}", de="Änderung zu {title} {number}")
_RUNNING_AMENDMENT = Words(en="Amendment {number}", de="Änderung {number}")

_AMENDS = Words(
    en="This document amends {number}, which remains valid in all that is not changed here",
    de="Dieses Dokument ändert {number}; was hier nicht geändert ist, gilt dort unverändert",
)
_REPLACES = Words(
    en="This document replaces {number}, which is no longer valid",
    de="Dieses Dokument ersetzt {number}; jenes ist nicht mehr gültig",
)
_REASON = Words(en="Reason: {reason}", de="Grund: {reason}")
_CHANGE = Words(en="Changed: {change}", de="Geändert: {change}")


def title(keys: CertificateKeys) -> Words:
    """Return the document's title: an amendment's names what it amends."""
    usual = TITLES[keys.kind]
    amends = keys.amends
    if amends is None or amends.kind == "replacement":
        return usual if keys.title is None else Words("{title}", "{title}").given(title=keys.title)
    if keys.title is None:
        return _AMENDMENT[keys.kind].given(number=amends.number)
    return _AMENDMENT_OF_OWN_TITLE.given(title=keys.title, number=amends.number)


def running_title(keys: CertificateKeys) -> Words:
    """Return what stands on every page: what the document is, with its number."""
    if keys.amends and keys.amends.kind == "amendment":
        return _RUNNING_AMENDMENT.given(number=keys.number)
    return Words("{title} {number}", "{title} {number}").given(title=TITLES[keys.kind], number=keys.number)


def notice(keys: CertificateKeys, writer: Writer) -> Iterator[Notice]:
    """Yield what is said of the earlier document: which it is, what is changed, and why."""
    amends = keys.amends
    if amends is None:
        return
    heading = _AMENDS if amends.kind == "amendment" else _REPLACES
    yield Notice(
        writer.say(heading.given(number=amends.number)),
        (
            writer.say(_REASON.given(reason=amends.reason)),
            *(writer.say(_CHANGE.given(change=change)) for change in amends.changes),
        ),
    )
