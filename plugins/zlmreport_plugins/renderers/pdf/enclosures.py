"""The files that a PDF carries, as WeasyPrint takes them."""

from __future__ import annotations

from collections.abc import Iterator
from datetime import date, datetime, time
from typing import Any

import pydyf
from weasyprint import Attachment

from zlmreport.plugin import Certificate
from zlmreport_plugins.renderers.pdf.supply import Supply

_ADDRESS = "attachment:{}"
#: Of a document that states no date of issue: a file in a PDF must have one, and the clock is not asked.
_UNKNOWN = date(1970, 1, 1)


def enclosures(certificate: Certificate) -> Iterator[Attachment]:
    """Yield the attachments; each is loaded by an address, for only so WeasyPrint takes its media type."""
    moment = datetime.combine(certificate.issued or _UNKNOWN, time())
    for number, attachment in enumerate(certificate.attachments):
        address = _ADDRESS.format(number)
        yield Attachment(
            url=address,
            url_fetcher=Supply({address: (attachment.content, attachment.media_type)}),
            name=attachment.name,
            description=attachment.description,
            created=moment,
            modified=moment,
            relationship=attachment.relationship.value,
        )


def associate_once(pdf: Any) -> None:
    """Name each attachment of a pydyf PDF once among its associated files: WeasyPrint 70 does it twice."""
    if "AF" in pdf.catalog:
        pdf.catalog["AF"] = pydyf.Array(dict.fromkeys(pdf.catalog["AF"]))
