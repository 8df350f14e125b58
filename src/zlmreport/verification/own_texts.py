"""The laboratory's own words that read like a result: no reading gives them, nothing computes them again."""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Iterator

from zlmreport.certificate.document import Certificate, Paragraph
from zlmreport.job.job import Job
from zlmreport.language import Words
from zlmreport.verification.findings import Finding, Verdict

#: Lengths and angles as results have them; of millimetres only less than one: travels are stated in them.
_AMOUNT = r"\d\s*(?:[µμ]m|um|nm|arcsec|″|mic(?:ro|ron)|Mikro|Bogensek)|(?<![\d.,])0[.,]\d+\s*mm"
_STATED = Words(
    en="'{text}' is the laboratory's own word: no reading gives its numbers",
    de="„{text}“ ist das Wort des Laboratoriums: kein Messwert ergibt seine Zahlen",
)
_LONGEST = 80


def stated_results(certificate: Certificate, job: Job) -> tuple[Finding, ...]:
    """Return the texts of a job that stand among the results and read like some, each as not decided.

    Title, head, foot and sections of one's own do; what has a label of its own, such as remarks, does not.
    """
    letters = {
        parameter.quantity.symbol.split("_")[0]
        for evaluation in certificate.evaluations
        for parameter in evaluation.parameters
    }
    symbols = "|".join(map(re.escape, sorted(letters | {"U"})))
    result = re.compile(
        rf"{_AMOUNT}|(?<!\w)(?:{symbols})(?:_\w+|[↑↓])?\s*(?:[=:≈<>≤≥]\s*[+−±-]?\d|\d+[.,]\d)", re.IGNORECASE
    )
    return tuple(
        Finding(key, Verdict.OPEN, _STATED.given(text=text[:_LONGEST]))
        for key, text in _texts(certificate, job)
        if result.search(unicodedata.normalize("NFKC", text))
    )


def _texts(certificate: Certificate, job: Job) -> Iterator[tuple[str, str]]:
    """Yield the key of each text, and the text as it is printed."""
    page = certificate.page_words
    yield "axis.name", job.axis.name
    yield "certificate.title", job.keys.certificate.title or ""
    yield "certificate.style.header", page.head
    yield "certificate.style.footer", page.foot
    for section in certificate.sections:
        if section.key.startswith("text-"):
            lines = (block.text for block in section.blocks if isinstance(block, Paragraph))
            yield "certificate.sections", " ".join((section.title, *lines))
