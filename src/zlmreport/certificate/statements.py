"""Statements below the results of the first page: what they hold for, and whose they are."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from zlmreport.certificate import exclusions
from zlmreport.certificate.document import Block, Notice, Paragraph
from zlmreport.language import Words, same
from zlmreport.presenting.marks import BY_CUSTOMER, EXTERNAL

if TYPE_CHECKING:
    from zlmreport.job.keys import JobKeys
    from zlmreport.presenting.writer import Writer

ONLY_THIS_ITEM = Words(
    en="The results relate only to the item calibrated, in its condition at the time of the measurement.",
    de="Die Ergebnisse gelten nur für den kalibrierten Gegenstand in seinem Zustand zur Zeit der Messung.",
)
_TRACEABLE = Words(
    en="The results are metrologically traceable through the calibration of the measuring instrument "
    "(calibration certificate {certificate}).",
    de="Die Ergebnisse sind über die Kalibrierung des Messgeräts (Kalibrierschein {certificate}) "
    "metrologisch rückführbar.",
)
_ONLY_IN_FULL = Words(
    en="This certificate may be reproduced only in full, unless the laboratory agrees in writing.",
    de="Dieser Kalibrierschein darf nur vollständig vervielfältigt werden; Auszüge bedürfen der "
    "schriftlichen Zustimmung des Laboratoriums.",
)
_SIMPLIFIED = Words(
    en="By agreement with the customer{reference} the results are reported in a simplified way: the single "
    "readings are not printed. The laboratory keeps them available.",
    de="Nach Vereinbarung mit dem Auftraggeber{reference} sind die Ergebnisse vereinfacht dargestellt: Die "
    "einzelnen Messwerte sind nicht abgedruckt. Das Laboratorium hält sie verfügbar.",
)
_SUPPLIED = Words(
    en="{mark} Provided by the customer. The laboratory is not responsible for these data, which can affect "
    "the validity of the results.",
    de="{mark} Angaben des Auftraggebers. Das Laboratorium ist für sie nicht verantwortlich; sie können die "
    "Gültigkeit der Ergebnisse beeinflussen.",
)
_DEVIATIONS = Words(
    en="Additions to, deviations and exclusions from the method",
    de="Ergänzungen, Abweichungen und Ausschlüsse gegenüber dem Verfahren",
)
_EXTERNAL = Words(en="{mark} Results from external providers", de="{mark} Ergebnisse von externen Anbietern")
_FROM = Words(en="{results}: {provider}", de="{results}: {provider}")
_FROM_REPORT = Words(en="{results}: {provider}, {reference}", de="{results}: {provider}, {reference}")


def notices(keys: JobKeys, writer: Writer) -> Iterator[Notice]:
    """Yield what nobody may overlook: how the work departed from the method, and what others did."""
    deviations = keys.measurement.deviations_from_method
    items = (*([deviations] if deviations else []), *exclusions.stated(keys, writer))
    if items:
        yield Notice(writer.say(_DEVIATIONS), items)
    if keys.external:
        yield Notice(
            writer.say(_EXTERNAL.given(mark=EXTERNAL)),
            tuple(
                writer.say(
                    (_FROM_REPORT if each.reference else _FROM).given(
                        results=each.results, provider=each.provider, reference=each.reference or ""
                    )
                )
                for each in keys.external
            ),
        )


def paragraphs(keys: JobKeys, writer: Writer) -> Iterator[Block]:
    """Yield the statements in running text."""
    if keys.provided_by_customer:
        yield Paragraph(writer.say(_SUPPLIED.given(mark=BY_CUSTOMER)))
    if keys.agreement.simplified:
        reference = keys.agreement.reference
        yield Paragraph(writer.say(_SIMPLIFIED.given(reference=same(f" ({reference})") if reference else "")))
    if keys.instrument and keys.instrument.certificate:
        yield Paragraph(writer.say(_TRACEABLE.given(certificate=keys.instrument.certificate)))
    yield Paragraph(writer.say(ONLY_THIS_ITEM))
    if keys.certificate.kind == "certificate":
        yield Paragraph(writer.say(_ONLY_IN_FULL))
