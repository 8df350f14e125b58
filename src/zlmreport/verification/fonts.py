"""Whether two embedded fonts draw the same glyphs: one that draws a 3 for a 2 is found.

A font is closed: every entry of it, its encoding and its map from codes to glyphs, must be that of the
font printed again. Only what depends on the library that packs it may differ: its name's prefix, which other
glyphs it has, and tables that nothing is drawn by. The glyphs are compared one by one.
"""

from __future__ import annotations

import re
from collections import deque
from collections.abc import Callable, Hashable, Mapping
from io import BytesIO
from itertools import count
from typing import Any

from zlmreport.verification.carrier import find_value

_MAPPED = re.compile(rb"<([0-9a-fA-F]{4})>\s*<([0-9a-fA-F]+)>")
_SECTION = re.compile(rb"\d+\s+beginbfchar\b(.*?)\bendbfchar\b", re.DOTALL)
#: What depends on the library that packs a font, or is compared glyph by glyph.
_OWN_NAME = frozenset({"/BaseFont", "/FontName"})
_GLYPHS = frozenset({"/DescendantFonts", "/ToUnicode", "/W", "/FontDescriptor", "/FontFile2", "/CIDSet"})
#: Tables of a font program by which nothing is drawn once its outlines are.
_NOT_DRAWN_BY = frozenset(
    {"DSIG", "GDEF", "GPOS", "GSUB", "GlyphOrder", "OS/2", "cmap", "gasp", "kern", "name", "post"}
)
_OUTLINES = frozenset({"glyf", "head", "hhea", "hmtx", "loca", "maxp", "vhea", "vmtx"})
#: Programs that move the points of outlines where these are fitted to pixels.
_INSTRUCTIONS = frozenset({"cvt ", "fpgm", "prep"})

#: Parts of a glyph, one in another: a letter with its accents has four.
_MOST_PARTS = 50
_LAST_GLYPH = 0xFFFF

#: The digest of an object of a PDF.
Digest = Callable[[Any], str]


def show_the_same(font: Any, again: Any, digest: Digest, digest_again: Digest, *, completely: bool) -> bool:
    """Compare two fonts entry by entry, and glyph by glyph: shape, width, and the text that it stands for.

    `font`, `again`: Fonts of pypdf, of the certificate and of the one printed again.
    `digest`, `digest_again`: Return the digests of the objects of either document.
    `completely`: Whether every glyph of the font printed again must be there; otherwise those that both have
        count.
    """
    parts, parts_again = _find_parts(font), _find_parts(again)
    if parts is None or parts_again is None:
        return False
    for part, part_again in zip(parts, parts_again, strict=True):
        if _list_entries(part, digest) != _list_entries(part_again, digest_again):
            return False
    (_, inner, described), (_, inner_again, described_again) = parts, parts_again
    program, program_again = _read_program(described), _read_program(described_again)
    if program is None or program_again is None or not _is_packed_alike(program, program_again):
        return False
    (frame, mapped), (frame_again, mapped_again) = _split_mapping(font), _split_mapping(again)
    if frame != frame_again:
        return False
    widths, widths_again = _list_widths(inner["/W"]), _list_widths(inner_again["/W"])
    codes = mapped_again.keys() | widths_again.keys()
    if not completely:
        codes &= mapped.keys() | widths.keys()
    return all(
        mapped.get(code) == mapped_again.get(code)
        and widths.get(code) == widths_again.get(code)
        and _trace_outline(program, code) == _trace_outline(program_again, code)
        for code in codes
    )


def read_glyphs(font: Any) -> Mapping[int, tuple[str, float, Hashable]]:
    """Return the text, the width and the outline of each glyph that a font says a text of, by its code."""
    parts = _find_parts(font)
    program = _read_program(parts[2]) if parts else None
    if parts is None or program is None:
        raise ValueError("a font that is packed as in no certificate")
    widths = _list_widths(parts[1]["/W"])
    default = float(parts[1].get("/DW", 1000))
    return {
        code: (text, widths.get(code, default), _trace_outline(program, code))
        for code, text in _split_mapping(font)[1].items()
    }


def _find_parts(font: Any) -> tuple[Any, Any, Any] | None:
    """Return a font, the font of its glyphs, and what describes that; None if it is made otherwise."""
    inner = find_value(font.get("/DescendantFonts", ()))
    if len(inner) != 1 or "/ToUnicode" not in font:
        return None
    described = inner[0].get_object().get("/FontDescriptor")
    if described is None or "/W" not in inner[0].get_object():
        return None
    return font, inner[0].get_object(), described.get_object()


def _list_entries(part: Any, digest: Digest) -> dict[str, str]:
    """Return the entries that both must have alike, and the names of those that are compared by glyphs."""
    found = {}
    for key in part:
        if key in _OWN_NAME:
            found[key] = str(part[key]).rpartition("+")[2]
        elif key != "/CIDSet":
            found[key] = "" if key in _GLYPHS else digest(part.raw_get(key))
    return found


def _read_program(described: Any) -> Any:
    from fontTools.ttLib import TTFont  # noqa: PLC0415 - slow to load

    if "/FontFile2" not in described:
        return None
    program = TTFont(BytesIO(described["/FontFile2"].get_data()), lazy=True)
    return program if "glyf" in program else None


def _is_packed_alike(program: Any, again: Any) -> bool:
    """Whether two programs draw by the same tables, in the same units and by the same instructions."""
    tables, tables_again = ({*each.keys()} - _NOT_DRAWN_BY for each in (program, again))
    return (
        tables <= _OUTLINES | _INSTRUCTIONS
        and program["head"].unitsPerEm == again["head"].unitsPerEm
        and all(
            (key in tables) == (key in tables_again)
            and (key not in tables or program.getTableData(key) == again.getTableData(key))
            for key in _INSTRUCTIONS
        )
    )


def _trace_outline(program: Any, code: int) -> Hashable:
    """Return what a glyph draws: its contours, and the instructions that would move them.

    None for one that is not there, and for one of more parts than any glyph of a typeface.
    """
    from fontTools.pens.recordingPen import DecomposingRecordingPen  # noqa: PLC0415 - slow to load

    names = program.getGlyphOrder()
    if code >= len(names) or _count_parts(program, names[code], {}) > _MOST_PARTS:
        return None
    shapes = program.getGlyphSet()
    pen = DecomposingRecordingPen(shapes)
    shapes[names[code]].draw(pen)
    return repr(pen.value), _read_instructions(program, names[code])


def _count_parts(program: Any, name: str, known: dict[str, int]) -> int:
    """Return of how many parts a glyph is put together: a part may have parts, each of them many times."""
    if name not in known:
        known[name] = _MOST_PARTS  # until it is known: one that is a part of itself has no end
        _, inner = _expand_glyph(program, name)
        known[name] = 1 + sum(_count_parts(program, each, known) for each in inner)
    return known[name]


def _read_instructions(program: Any, name: str) -> bytes:
    own, inner = _expand_glyph(program, name)
    return own + b"".join(_read_instructions(program, each) for each in inner)


def _expand_glyph(program: Any, name: str) -> tuple[bytes, list[str]]:
    """Return the instructions of a glyph, and the names of the glyphs of which it is put together."""
    glyph = program["glyf"][name]
    glyph.expand(program["glyf"])
    own: bytes = glyph.program.getBytecode() if hasattr(glyph, "program") else b""
    return own, [each.glyphName for each in getattr(glyph, "components", ())]


def _split_mapping(font: Any) -> tuple[bytes, dict[int, str]]:
    """Return what stands around the texts of the codes, and the texts, in hexadecimal.

    A code that is there twice leaves its second text in what stands around: one reader takes the first, and
    another the last.
    """
    found: dict[int, str] = {}

    def take(pair: re.Match[bytes]) -> bytes:
        code, text = int(pair[1], 16), pair[2].decode().lower()
        return b"" if found.setdefault(code, text) == text else pair[0]

    frame = _SECTION.sub(lambda section: _MAPPED.sub(take, section[1]), font["/ToUnicode"].get_data())
    return b" ".join(frame.split()), found


def _list_widths(entries: Any) -> dict[int, float]:
    """Return the widths of glyphs as a PDF lists them: a code, and the widths from there on; or a range.

    Raises `ValueError` where codes are not those of glyphs, each once and rising.
    """
    found: dict[int, float] = {}
    rest, least = deque(entries), 0
    while rest:
        first, widths = int(rest.popleft()), find_value(rest.popleft())
        if isinstance(widths, list):
            listed = dict(zip(count(first), map(float, widths), strict=False))
        elif least <= first and widths <= _LAST_GLYPH:
            listed = dict.fromkeys(range(first, int(widths) + 1), float(rest.popleft()))
        else:
            listed = {}
        if first < least or not listed or max(listed) > _LAST_GLYPH:
            raise ValueError("a font whose widths are listed as in no certificate")
        found |= listed
        least = max(listed) + 1
    return found
