"""Style sheets and fonts, as they lie in the package of templates."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from importlib.resources import files

from zlmreport.typesetting.templates import PACKAGE

#: The family under which the faces are known to style sheets.
FAMILY = "IBM Plex Sans"


@dataclass(frozen=True, slots=True)
class Face:
    """A face of the bundled typeface: the stem of its files, and what style sheets call it."""

    stem: str
    style: str
    weight: int


FACES = (
    Face("IBMPlexSans-Regular", "normal", 400),
    Face("IBMPlexSans-Italic", "italic", 400),
    Face("IBMPlexSans-SemiBold", "normal", 600),
)


def font(name: str) -> bytes:
    """Return the bytes of a font file: ``IBMPlexSans-Regular.woff2``."""
    return (files(PACKAGE) / "fonts" / name).read_bytes()


def style_sheet(*names: str) -> str:
    """Return the style sheets of these names, one after the other."""
    return "\n".join((files(PACKAGE) / "styles" / f"{name}.css").read_text("utf-8") for name in names)


def font_faces(address: Callable[[Face], str]) -> str:
    """Return the rules that bring in the typeface; `address` says where each face is found."""
    return "\n".join(
        f'@font-face {{ font-family: "{FAMILY}"; font-style: {face.style}; font-weight: {face.weight}; '
        f"src: url({address(face)}) }}"
        for face in FACES
    )
