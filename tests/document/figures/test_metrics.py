"""Texts are as wide as the library says that sets them, and marks stand over their letters."""

from __future__ import annotations

import pytest
from matplotlib.ft2font import FT2Font, LoadFlags

from zlmreport.document.figures.metrics import find_font_file
from zlmreport.plugin.page import FontFace, has_letter, mark_offset, text_advance


@pytest.mark.parametrize("face", FontFace)
@pytest.mark.parametrize(
    "text",
    [
        "Abweichung in µm",
        "AVATAR To Ty. fi ffi",
        "−12,5 … 1000 ½",
        "x̄ s̄ B̄ R̄ é ñ",
        "einzelne Messwerte ↑ ↓",
        "P. 11 (A/V)",
    ],
)
def test_a_text_is_as_wide_as_a_library_that_sets_it_says(text: str, face: FontFace) -> None:
    font = FT2Font(str(find_font_file(face)))
    font.set_size(1000.0, 72)
    font.set_text(text, 0.0, flags=LoadFlags.NO_HINTING)
    width, _ = font.get_width_height()
    assert text_advance(text, face) == pytest.approx(width / 64 / 1000, abs=1 / 64 / 1000)


def test_a_bar_stands_over_the_middle_of_its_letter() -> None:
    right, above = mark_offset("x", "\N{COMBINING MACRON}", FontFace.REGULAR)
    assert above == 0.0  # over a small letter the bar is drawn where its own glyph has it
    assert right == pytest.approx(text_advance("x", FontFace.REGULAR) / 2, abs=0.02)
    assert mark_offset("B", "\N{COMBINING MACRON}", FontFace.REGULAR)[1] > 0.1


def test_a_mark_without_a_place_is_told() -> None:
    with pytest.raises(LookupError, match=r"U\+0304"):
        mark_offset("↑", "\N{COMBINING MACRON}", FontFace.REGULAR)


def test_letters_that_the_typeface_lacks_are_known() -> None:
    assert all(has_letter(letter, FontFace.REGULAR) for letter in "Aµ↑½✓Ωя")
    assert not any(has_letter(letter, FontFace.REGULAR) for letter in "中🙂ש")
