"""A fleet's overview as one self-contained page: style, typeface and graphs inside, nothing loaded."""

from __future__ import annotations

from base64 import b64encode

from markupsafe import Markup

from zlmreport.typesetting.resources import Face, font, font_faces, style_sheet


def drawing(image: str) -> Markup:
    """Return a graph of our own as markup.

    Parameters
    ----------
    image
        As `zlmreport.figures.svg.SvgCanvas` writes it, which escapes all text.
    """
    return Markup(image.strip())  # noqa: S704 (the canvas has escaped every text)


def overview_style() -> Markup:
    """Return the style sheet of an overview, the typeface in it."""
    return Markup(f"{font_faces(_embedded)}\n{style_sheet('overview')}")  # noqa: S704 (our own style sheets)


def _embedded(face: Face) -> str:
    return f"data:font/woff2;base64,{b64encode(font(f'{face.stem}.woff2')).decode('ascii')}"
