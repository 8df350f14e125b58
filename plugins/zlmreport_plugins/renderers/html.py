"""One self-contained page of HTML: style, typeface and graphs inside, nothing loaded.

A certificate with an error model also has linked graphs, which a script inside the page draws; the page's
own content security policy lets this script run and no other. Everything can be read without it.
"""

from __future__ import annotations

from base64 import b64encode
from functools import lru_cache

from zlmreport.plugin import Words, hookimpl
from zlmreport.plugin.renderer import Certificate, PageWords

#: The drawings set their look in attributes, so styles inside the page are allowed.
_ALLOWED = (
    "default-src 'none'",
    "style-src 'unsafe-inline'",
    "img-src data:",
    "font-src data:",
    "base-uri 'none'",
    "form-action 'none'",
)


class HtmlRenderer:
    """Certificates as HTML, for screens and for printing from a browser."""

    identifier = "html"
    title = Words("HTML in one file")
    suffix = ".html"

    def render(self, certificate: Certificate) -> bytes:
        """Return the page, UTF-8."""
        from zlmreport.plugin.html import HtmlSetting, compose_html  # noqa: PLC0415 (brings Jinja)
        from zlmreport.plugin.page import (  # noqa: PLC0415 (brings Jinja)
            figure_to_svg,
            linked_script,
            own_style,
            script_fingerprint,
        )

        letterhead = certificate.letterhead
        logo = letterhead.logo if letterhead else None
        script = linked_script() if certificate.linked else ""
        allowed = [f"script-src {script_fingerprint(script)}"] if script else []
        setting = HtmlSetting(
            style=_make_style(certificate.paper, certificate.look.accent, with_linked=bool(script))
            + own_style(certificate.look, lambda font: _make_data_address(font, "font/sfnt"))
            + _write_foot(certificate.page_words),
            drawings=tuple(figure_to_svg(figure, certificate.language) for figure in certificate.figures),
            logo=_make_data_address(logo, letterhead.logo_type) if letterhead and logo else "",
            policy="; ".join([*_ALLOWED, *allowed]),
            script=script,
            is_for_screens=True,
        )
        return compose_html(certificate, setting).encode()


@lru_cache(maxsize=8)
def _make_style(paper: str, accent: str, *, with_linked: bool) -> str:
    from zlmreport.plugin.page import (  # noqa: PLC0415 (brings Jinja)
        font_face_rules,
        font_file,
        linked_style,
        style_sheet,
    )

    faces = font_face_rules(lambda face: _make_data_address(font_file(f"{face.stem}.woff2"), "font/woff2"))
    sheets = f"{faces}\n{style_sheet('tokens', 'certificate', 'screen', paper, accent=accent)}"
    return f"{sheets}\n{linked_style()}" if with_linked else sheets


def _write_foot(words: PageWords) -> str:
    """Return the rule for the foot of pages that a browser prints: number of the document and of the page."""
    number, page, of = (_write_css_text(each) for each in (words.number, f"{words.page} ", f" {words.of} "))
    return (
        f"\n@page {{ @bottom-left {{ content: {number}; font: 7.5pt sans-serif }} "
        f"@bottom-right {{ content: {page} counter(page) {of} counter(pages); font: 7.5pt sans-serif }} }}"
    )


def _write_css_text(text: str) -> str:
    """Return a text as CSS has it, every sign that could mean anything in CSS or HTML as its number."""
    return (
        '"' + "".join(each if each.isalnum() or each == " " else f"\\{ord(each):06x}" for each in text) + '"'
    )


def _make_data_address(content: bytes, media_type: str) -> str:
    return f"data:{media_type};base64,{b64encode(content).decode('ascii')}"


@hookimpl
def zlmreport_renderers() -> list[HtmlRenderer]:
    """Offer the renderer."""
    return [HtmlRenderer()]
