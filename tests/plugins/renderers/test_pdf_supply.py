"""What a document may load."""

from __future__ import annotations

from dataclasses import replace

import pytest

from document.typesetting import samples
from installed import registry
from zlmreport_plugins.renderers.pdf.press import Supply


def test_what_there_is_is_handed_out() -> None:
    response = Supply({"logo:": (b"picture", "image/png")})("logo:")
    assert (response.read(), response.content_type) == (b"picture", "image/png")


@pytest.mark.parametrize(
    "address",
    [
        "file:///etc/passwd",
        "http://example.com/",
        "https://example.com/",
        "ftp://example.com/",
        "data:text/plain,x",
        "logo:2",
        "/etc/passwd",
        "",
    ],
)
def test_anything_else_is_refused(address: str) -> None:
    with pytest.raises(ValueError, match="loads nothing from outside"):
        Supply({"logo:": (b"picture", "image/png")})(address)


def test_an_ordinary_certificate_asks_for_nothing(monkeypatch: pytest.MonkeyPatch) -> None:
    registry().renderer("pdf").render(samples.certificate(standards=0))
    asked: list[str] = []
    monkeypatch.setattr(Supply, "fetch", lambda _, url, headers=None: asked.append(url))  # noqa: ARG005
    registry().renderer("pdf").render(samples.certificate(customer="<img src='file:///etc/passwd'>"))
    assert asked == []


def test_a_drawing_as_logo_cannot_fetch_what_it_names(weasyprint_log: list[str]) -> None:
    drawing = (
        b'<svg xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink" '
        b'width="9" height="9"><image width="9" height="9" xlink:href="file:///etc/passwd"/></svg>'
    )
    plain = samples.certificate(standards=0)
    assert plain.letterhead is not None
    letterhead = replace(plain.letterhead, logo=drawing, logo_type="image/svg+xml")
    content = registry().renderer("pdf").render(replace(plain, letterhead=letterhead))
    assert b"root:" not in content
    weasyprint_log.append(
        "Failed to load image at 'file:///etc/passwd': ValueError: "
        "a certificate loads nothing from outside: file:///etc/passwd"
    )
