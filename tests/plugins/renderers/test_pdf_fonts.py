"""The fonts of a PDF are the same bytes whatever libraries the system has beside."""

from __future__ import annotations

from io import BytesIO
from pathlib import Path
from typing import Any

import pytest
import weasyprint.pdf.fonts
from fontTools.pens.recordingPen import DecomposingRecordingPen
from fontTools.ttLib import TTFont

from document.certificate.documents import certificate
from installed import registry
from zlmreport.plugin import FONT_FACES, font_file
from zlmreport_plugins.renderers.pdf.subset import keep_glyphs


@pytest.mark.long
def test_a_document_is_the_same_where_the_system_has_no_library_of_subsets(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture
) -> None:
    """`libharfbuzz-subset` is hidden in the way in which WeasyPrint finds it missing."""
    document = certificate(tmp_path)
    usual = registry().renderer("pdf").render(document)
    for library in (None, object()):
        monkeypatch.setattr(weasyprint.pdf.fonts, "harfbuzz_subset", library)
        assert registry().renderer("pdf").render(document) == usual
    assert "fontTools" not in caplog.text


@pytest.mark.parametrize("face", FONT_FACES, ids=lambda each: each.stem)
def test_glyphs_keep_their_numbers_outlines_and_widths_and_others_are_empty(face: Any) -> None:
    content = font_file(f"{face.stem}.ttf")
    whole = TTFont(BytesIO(content))
    letters = "0123456789µ±Å"
    numbers = [whole.getGlyphID(whole.getBestCmap()[ord(each)]) for each in letters]
    part = TTFont(BytesIO(keep_glyphs(content, numbers)))
    for number in numbers:
        assert _drawn(part, number) == _drawn(whole, number)
        assert part["hmtx"][part.getGlyphName(number)] == whole["hmtx"][whole.getGlyphName(number)]
    other = whole.getGlyphID(whole.getBestCmap()[ord("w")])
    assert other >= part["maxp"].numGlyphs or not _drawn(part, other)
    assert part["head"].modified == whole["head"].modified


def _drawn(font: TTFont, number: int) -> list[object]:
    pen, glyphs = DecomposingRecordingPen(font.getGlyphSet()), font.getGlyphSet()
    glyphs[font.getGlyphName(number)].draw(pen)
    return list(pen.value)
