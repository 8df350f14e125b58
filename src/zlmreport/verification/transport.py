"""Tells what a mail, an archive or a transfer as text has made of a PDF, for who is to get it again."""

from __future__ import annotations

import base64
import re

#: What holds a PDF, or came in its place, by how it begins.
_WRAPPED = (
    (re.compile(rb"PK\x03\x04"), "a ZIP archive: take the certificate out of it"),
    (re.compile(rb"\x1f\x8b"), "a file packed by gzip: unpack it"),
    (re.compile(rb"\x78\x9f\x3e\x22"), "the winmail.dat of a mail: ask for the certificate as an attachment"),
    (re.compile(rb"\s*<(?:!doctype html|html)\b", re.IGNORECASE), "a page in HTML: get the PDF itself"),
)
_HEADER, _END = b"%PDF-", b"%%EOF"
#: The header of a PDF as a mail carries it; its first three bytes make four letters.
_AS_TEXT = base64.b64encode(_HEADER)[:6]
#: How far from its ends a PDF has them, bytes.
_NEAR = 1024
#: Lines from which on it is no chance that all end alike.
_MANY_LINES = 20


def find_wrapping(content: bytes) -> str:
    """Return what a file is that holds a PDF, or came in its place, and what to do; mostly empty."""
    for begins, said in _WRAPPED:
        if begins.match(content):
            return f"{said}, and verify that"
    if _HEADER not in content and _AS_TEXT in content:
        return "a mail or a part of one: save the attachment in it, and verify that"
    return ""


def find_damage(content: bytes) -> str:
    r"""Return how a PDF that cannot be read was damaged on its way, and what to do; empty if none can tell.

    >>> find_damage(b"Content-Type: application/pdf\n\n%PDF-1.7\n")
    '31 bytes stand before the PDF, such as the head of a mail; save the attachment itself'
    """
    if not content:
        return ""
    begin, ends, returns = content.find(_HEADER), content.count(b"\n"), content.count(b"\r\n")
    if begin > 0:
        return f"{begin} bytes stand before the PDF, such as the head of a mail; save the attachment itself"
    if content.isascii():
        return "it was sent by something that keeps seven bits of each byte; get it again, as a binary file"
    if ends == returns and ends > _MANY_LINES:
        return "it was sent as text, with other ends of lines; get it again, as a binary file"
    if _END not in content[-_NEAR:]:
        return "its end is missing; get it again"
    return ""
