"""What can be said of pages that another release printed: whether they show the recomputed numbers."""

from __future__ import annotations

from collections.abc import Iterator

from zlmreport.certificate.document import Certificate
from zlmreport.presenting.amounts import written
from zlmreport.presenting.writer import Writer
from zlmreport.quantities.notation import plain
from zlmreport.verification.carrier import Carrier, guarded
from zlmreport.verification.findings import Finding, Verdict
from zlmreport.verification.pages import words


def compare(carrier: Carrier, again: Certificate) -> tuple[Finding, ...]:
    """Return for each standard whether each of its parameters stands on some page as it is computed again."""
    return guarded(lambda: tuple(_compare(carrier, again)), carrier.place)


def _compare(carrier: Carrier, again: Certificate) -> Iterator[Finding]:
    printed = {word for number in range(len(carrier.reader.pages)) for word in words(carrier, number)}
    writer = Writer.of(again.measurements, again.language)
    for evaluation in again.evaluations:
        missing = [
            f"{plain(parameter.quantity.notation)} = {value}"
            for parameter in evaluation.parameters
            if (value := written(parameter, writer)[0]) not in printed
        ]
        if missing:
            yield Finding(evaluation.designation, Verdict.DIFFERS, f"no page prints {', '.join(missing)}")
        else:
            yield Finding(evaluation.designation, Verdict.HOLDS)
