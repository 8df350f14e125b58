"""The pen draws what matplotlib draws, and texts are as wide as it says."""

from __future__ import annotations

import subprocess
import sys

import numpy as np
import pytest
from matplotlib.ft2font import FT2Font, LoadFlags

from figures.samples import ALL, DrawnOutline, Recording, both_directions, figure
from zlmreport.figures import draw, pen
from zlmreport.figures.canvas import Face
from zlmreport.figures.figure import Figure
from zlmreport.figures.metrics import advance, font_file, has_letter, mark_offset
from zlmreport.figures.style import ROLES, Mark
from zlmreport.language import Language

#: Marks that are circles: each way has curves of its own for them.
_DISCS = [role for role, style in ROLES.items() if style.mark is Mark.DISC]
_ROUND = {"legend", *(f"mark {role.name.lower()}" for role in _DISCS)}


def _points(outline: DrawnOutline) -> tuple[str, list[float]]:
    operators = "".join(operator for operator, _ in outline.segments)
    return operators, [number for _, points in outline.segments for number in points]


@pytest.mark.parametrize("sample", ALL.values(), ids=ALL)
@pytest.mark.parametrize("language", Language)
def test_both_ways_draw_the_same(sample: Figure, language: Language) -> None:
    one, other = Recording(), Recording()
    draw.draw(sample, language, one)
    pen.draw(sample, language, other)
    assert [each.kind for each in one.outlines] == [each.kind for each in other.outlines]
    for first, second in zip(one.outlines, other.outlines, strict=True):
        assert (first.stroke, first.fill) == (second.stroke, second.fill)
        if first.kind not in _ROUND or "C" not in _points(first)[0]:
            assert _points(first)[0] == _points(second)[0]
            np.testing.assert_allclose(_points(first)[1], _points(second)[1], rtol=0, atol=1e-6)
    for label, same in zip(one.texts, other.texts, strict=True):
        assert (label.kind, label.text, label.angle) == (same.kind, same.text, same.angle)
        for run, run_again in zip(label.runs, same.runs, strict=True):
            assert (run.x, run.y) == pytest.approx((run_again.x, run_again.y), abs=1e-6)


def test_a_disc_is_as_wide_as_its_mark_and_round() -> None:
    canvas = Recording()
    pen.draw(figure(both_directions()), Language.ENGLISH, canvas)
    (marks,) = canvas.of("mark mean_bidirectional")
    segments = marks.segments[: next(n for n, (operator, _) in enumerate(marks.segments) if operator == "Z")]
    ends = np.array([points[-2:] for _, points in segments])
    middle = (ends.min(axis=0) + ends.max(axis=0)) / 2
    np.testing.assert_allclose(np.hypot(*(ends - middle).T), 3.8 / 2, rtol=1e-9)
    # Half way along each curve a circle of four of them is true to 3 parts in 10 000.
    for start, (_, curve) in zip(ends, segments[1:], strict=False):
        points = np.array([start, *np.reshape(curve, (3, 2))])
        half_way = np.array([1, 3, 3, 1]) @ points / 8
        assert np.hypot(*(half_way - middle)) == pytest.approx(3.8 / 2, rel=3e-4)


@pytest.mark.parametrize("face", Face)
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
def test_a_text_is_as_wide_as_a_library_that_sets_it_says(text: str, face: Face) -> None:
    font = FT2Font(str(font_file(face)))
    font.set_size(1000.0, 72)
    font.set_text(text, 0.0, flags=LoadFlags.NO_HINTING)
    width, _ = font.get_width_height()
    assert advance(text, face) == pytest.approx(width / 64 / 1000, abs=1 / 64 / 1000)


def test_a_bar_stands_over_the_middle_of_its_letter() -> None:
    right, above = mark_offset("x", "\N{COMBINING MACRON}", Face.REGULAR)
    assert above == 0.0  # over a small letter the bar is drawn where its own glyph has it
    assert right == pytest.approx(advance("x", Face.REGULAR) / 2, abs=0.02)
    assert mark_offset("B", "\N{COMBINING MACRON}", Face.REGULAR)[1] > 0.1


def test_a_mark_without_a_place_is_told() -> None:
    with pytest.raises(LookupError, match=r"U\+0304"):
        mark_offset("↑", "\N{COMBINING MACRON}", Face.REGULAR)


def test_letters_that_the_typeface_lacks_are_known() -> None:
    assert all(has_letter(letter, Face.REGULAR) for letter in "Aµ↑½✓Ωя")
    assert not any(has_letter(letter, Face.REGULAR) for letter in "中🙂ש")


def test_drawing_needs_no_matplotlib() -> None:
    program = (
        "import sys; from zlmreport.figures.pen import draw; from zlmreport.language import Language;"
        "from zlmreport.testing.certificates import sample_certificate;"
        "from zlmreport.figures.svg import SvgCanvas;"
        "[draw(each, Language.ENGLISH, SvgCanvas(1, 1, '')) for each in sample_certificate().figures];"
        "print('matplotlib' in sys.modules)"
    )
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "False"
