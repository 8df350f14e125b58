"""Verifies a single file of a certificate: results, digital certificate, HTML, CSV, workbook.

Only the PDF carries what a certificate was made from. So such a file is held against the PDF that lies beside
it: it is made again from what that carries, and compared byte by byte. Without one, nothing of it is decided;
the digest that it states, if it does, can be held against the PDF's, also over the telephone.
"""

from __future__ import annotations

import re
import zipfile
from collections.abc import Callable
from dataclasses import replace
from io import BytesIO
from pathlib import Path

from zlmreport import pipeline
from zlmreport.document.certificate.results_file import MACHINE_RESULTS, RESULTS
from zlmreport.errors import InputError, Place, quoted
from zlmreport.job.loading import load
from zlmreport.language import Words
from zlmreport.plugin.protocols import Renderer
from zlmreport.plugin.registry import Registry
from zlmreport.verification.attached import find_stated_by, lay_out
from zlmreport.verification.carrier import find_results_in, open_pdf, read_file
from zlmreport.verification.findings import (
    CheckedCertificate,
    CheckedStatement,
    Identity,
    VerificationOutcome,
    VerificationVerdict,
)

#: Beginnings of a file that tell what it is, without its first bytes of white space.
_LONGEST_HEAD = 4000
#: Of a text, before and behind the place where it first differs.
_SHOWN = 24
_DIGEST = re.compile(r"(?<![0-9A-Z-])[0-9A-HJKMNP-TV-Z]{4}(?:-[0-9A-HJKMNP-TV-Z]{4}){3}(?![0-9A-Z-])")
_UNSIGNED = Words("a file of this kind bears no signature: nothing tells who made it")
_NO_PDF = Words(
    "nothing of it is compared: it does not carry what it was made from. Put the PDF of the certificate "
    "beside it, as {name}, and verify it once more"
)
_BY_DIGEST = Words(
    "it states the digest {digest}; verify the PDF of the certificate, and hold the digest that it gives "
    "against this one"
)
_BESIDE = Words("held against {name}, which lies beside it")
_OTHER_PROGRAMS = Words("made by other releases, or in a look of the laboratory's own: not compared")


def _is_workbook(content: bytes) -> bool:
    try:
        return "xl/workbook.xml" in zipfile.ZipFile(BytesIO(content)).namelist()
    except (zipfile.BadZipFile, ValueError, OSError):
        return False


#: What each kind of file is by its content, with the format that makes it.
_KINDS: tuple[tuple[str, Callable[[bytes], bool]], ...] = (
    (
        "json",
        lambda head: (
            head.startswith(b"{") and any(f'"{each}"'.encode() in head for each in (RESULTS, MACHINE_RESULTS))
        ),
    ),
    ("dcc", lambda head: head.startswith(b"<") and b"https://ptb.de/dcc" in head),
    ("html", lambda head: head[:15].lower() == b"<!doctype html>" and b"<title>" in head),
    ("csv", lambda head: head.startswith(b"standard,symbol,target,quantity,value,unit")),
)


def format_of(content: bytes) -> str | None:
    """Return the format that makes files like this one; None if none of a certificate is like it."""
    head = content[:_LONGEST_HEAD].lstrip()
    for identifier, is_kind in _KINDS:
        if is_kind(head):
            return identifier
    return "xlsx" if content.startswith(b"PK") and _is_workbook(content) else None


def verify_alone(
    path: Path, content: bytes, made_by: str, registry: Registry, verify: Callable[[Path], CheckedCertificate]
) -> CheckedCertificate:
    """Say of a file of a certificate what can be said.

    `made_by`: The format that makes such files.
    `verify`: Verifies the PDF beside it.

    Raises as `zlmreport.verification.verify.verify` does for the PDF; `InputError` if no plugin makes such
    files here.
    """
    digest = _find_digest(content) if made_by not in {"csv", "xlsx"} else ""
    beside = path.with_suffix(".pdf")
    found = CheckedCertificate(Identity(), CheckedStatement("signature", VerificationVerdict.OPEN, _UNSIGNED))
    if not beside.is_file():
        told = [_BY_DIGEST.given(digest=digest)] if digest else []
        unknown = CheckedStatement(path.name, VerificationVerdict.OPEN, _NO_PDF.given(name=beside.name))
        return replace(found, files=(unknown,), remarks=tuple(told))
    of_pdf = verify(beside)
    remark = _BESIDE.given(name=beside.name)
    whole = CheckedStatement(beside.name, _decide_verdict(of_pdf), _find_first(of_pdf))
    if of_pdf.outcome is VerificationOutcome.DOES_NOT_HOLD:
        return replace(found, identity=of_pdf.identity, files=(whole,), remarks=(remark,))
    own = CheckedStatement(path.name, VerificationVerdict.OPEN, _OTHER_PROGRAMS) if of_pdf.remarks else None
    if own is None:
        renderer = registry.renderer(made_by)
        try:
            again = _make_again(beside, renderer, registry)
        except InputError:  # the PDF holds: what cannot be made of it is no file of this certificate
            again = None
        own = CheckedStatement.of(path.name, "" if again == content else _say_difference(content, again))
    return replace(
        found,
        identity=of_pdf.identity,
        files=(own, whole),
        own_words=of_pdf.own_words,
        remarks=(*of_pdf.remarks, remark),
    )


def _say_difference(content: bytes, again: bytes | None) -> str:
    """Say that a file is not what the PDF beside it gives, and of a text where it first is not."""
    told = "is not what the PDF beside it gives"
    try:
        texts = content.decode(), (again or b"").decode()
    except UnicodeDecodeError:
        return told
    if not all(texts):
        return told
    pairs = enumerate(zip(*texts, strict=False))
    same = next((place for place, (one, other) in pairs if one != other), min(map(len, texts)))
    line, begin = texts[0].count("\n", 0, same) + 1, texts[0].rfind("\n", 0, same) + 1
    found, expected = (
        each[max(begin, same - _SHOWN) : same + _SHOWN].partition("\n")[0].strip() for each in texts
    )
    return f"{told}: line {line} has {quoted(found)} where it gives {quoted(expected)}"


def _find_digest(content: bytes) -> str:
    """Return the digest that a file states; empty where it states none, or several."""
    found = set(_DIGEST.findall(content.decode("utf-8", "replace")))
    return found.pop() if len(found) == 1 else ""


def _decide_verdict(found: CheckedCertificate) -> VerificationVerdict:
    return {
        VerificationOutcome.HOLDS: VerificationVerdict.HOLDS,
        VerificationOutcome.DOES_NOT_HOLD: VerificationVerdict.DIFFERS,
        VerificationOutcome.UNDECIDED: VerificationVerdict.OPEN,
    }[found.outcome]


def _find_first(found: CheckedCertificate) -> Words | str:
    """Return the first that does not hold of a certificate."""
    findings = (*found.files, *found.pages, *found.document)
    wanted = VerificationVerdict.DIFFERS if found.differences else VerificationVerdict.OPEN
    return next((each.detail for each in findings if each.verdict is wanted), "")


def _make_again(pdf: Path, renderer: Renderer, registry: Registry) -> bytes:
    """Make a file again from what a PDF carries, which holds."""
    carrier = open_pdf(read_file(pdf), Place(str(pdf)))
    stated = find_stated_by(carrier)
    if stated is None:
        raise InputError.at(carrier.place, "carries no results file")
    with lay_out(stated.results.provenance.sources, carrier.carried) as layout:
        if stated.tree["schema"] == MACHINE_RESULTS:
            from zlmreport.machines.document import make_machine_document  # noqa: PLC0415 - only for such a document
            from zlmreport.machines.reading import read_machine  # noqa: PLC0415

            document = make_machine_document(read_machine(layout.job, registry, find_results_in), registry)
            is_results = renderer.identifier == pipeline.RESULTS
            return document.results if is_results else renderer.render(document.certificate)
        job = load(layout.job, registry, formats=(renderer.identifier,))
        return renderer.render(pipeline.compose(job, registry))
