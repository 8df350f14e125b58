"""One self-contained page of HTML: style, typeface and graphs inside, no script, nothing loaded."""

from __future__ import annotations

from base64 import b64encode
from functools import cache

from zlmreport.certificate.document import Certificate
from zlmreport.hookspecs import hookimpl
from zlmreport.language import Words


class HtmlRenderer:
    """Certificates as HTML, for screens and for printing from a browser."""

    identifier = "html"
    title = Words(en="HTML in one file", de="HTML in einer Datei")
    suffix = ".html"

    def render(self, certificate: Certificate) -> bytes:
        """Return the page, UTF-8."""
        from zlmreport.figures.draw import to_svg  # noqa: PLC0415 (brings matplotlib)
        from zlmreport.typesetting.compose import Setting, compose  # noqa: PLC0415 (brings Jinja)

        letterhead = certificate.letterhead
        logo = letterhead.logo if letterhead else None
        setting = Setting(
            style=_style(certificate.paper),
            drawings=tuple(to_svg(figure, certificate.language) for figure in certificate.figures),
            logo=_data_address(logo, letterhead.logo_type) if letterhead and logo else "",
        )
        return compose(certificate, setting).encode()


@cache
def _style(paper: str) -> str:
    from zlmreport.typesetting.resources import font, font_faces, style_sheet  # noqa: PLC0415 (brings Jinja)

    faces = font_faces(lambda face: _data_address(font(f"{face.stem}.woff2"), "font/woff2"))
    return f"{faces}\n{style_sheet('certificate', 'screen', paper)}"


def _data_address(content: bytes, media_type: str) -> str:
    return f"data:{media_type};base64,{b64encode(content).decode('ascii')}"


@hookimpl
def zlmreport_renderers() -> list[HtmlRenderer]:
    """Offer the renderer."""
    return [HtmlRenderer()]
