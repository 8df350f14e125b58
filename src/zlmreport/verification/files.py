"""The attached files against what the certificate states of them, and against those of one made again."""

from __future__ import annotations

import hashlib
from collections.abc import Iterator, Mapping, Sequence

from zlmreport.verification.carrier import Carried
from zlmreport.verification.findings import Finding, Verdict
from zlmreport.verification.stated import StatedSource

_SHOWN_DIGITS = 12
_LONGEST_TEXT = 60
_DESCRIBED = {"relationship": "relationship", "description": "description", "media_type": "media type"}


def compare(
    sources: Sequence[StatedSource], carried: Mapping[str, Carried], again: Mapping[str, Carried] | None
) -> tuple[Finding, ...]:
    """Return a finding for each file that is attached, or should be.

    Parameters
    ----------
    sources
        What the certificate states that it was made from.
    carried
        What it carries, by name.
    again
        What it carries when it is made again, by name; None if it cannot be.
    """
    stated = {source.name: source for source in sources}
    findings = []
    for name in dict.fromkeys((*stated, *carried, *(again or {}))):
        file, source = carried.get(name), stated.get(name)
        if file is None:
            findings.append(Finding(name, Verdict.DIFFERS, "is not attached"))
            continue
        faults = [*_digests(file, source)]
        if again is not None:
            faults += _described(file, again.get(name))
        verdict = Verdict.DIFFERS if faults else Verdict.HOLDS if source or again else Verdict.OPEN
        findings.append(Finding(name, verdict, "; ".join(faults)))
    return tuple(findings)


def _digests(file: Carried, source: StatedSource | None) -> Iterator[str]:
    digest = hashlib.sha256(file.content).hexdigest()
    if source and (digest, len(file.content)) != (source.sha256, source.size):
        yield (
            f"is not the file that the results come from: its SHA-256 is {digest[:_SHOWN_DIGITS]}…, and "
            f"{source.sha256[:_SHOWN_DIGITS]}… is stated"
        )
    elif file.checksum and file.checksum != hashlib.md5(file.content, usedforsecurity=False).hexdigest():
        yield "is not the file that was attached: the PDF states another checksum"


def _described(file: Carried, again: Carried | None) -> Iterator[str]:
    """Yield where the PDF does not say of a file what it says when it is made again."""
    if again is None:
        yield "is no file of this certificate"
        return
    for key, what in _DESCRIBED.items():
        found, expected = getattr(file, key), getattr(again, key)
        if found != expected:
            yield f"its {what} is {found[:_LONGEST_TEXT]!r} and should be {expected[:_LONGEST_TEXT]!r}"
