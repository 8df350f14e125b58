"""Where lines of a PDF end."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np
from weasyprint import HTML

from zlmreport_plugins.renderers.pdf.press import find_press

SENTENCE = "Traceable through the calibration of the instrument (certificate "
NUMBER = "C-1)."


def lay_out(width: float) -> list[Any]:
    """Return the lines of the sentence and its number, which no line parts, in a column so wide, px."""
    find_press()
    page = (
        "<style>@page { size: 600px 200px; margin: 0 }"
        f"body {{ font-size: 10px; margin: 0; overflow-wrap: break-word; width: {width}px }}"
        ".held { display: inline-block }</style>"
        f'<p>{SENTENCE}<span class="held">{NUMBER}</span></p>'
    )
    (sheet,) = HTML(string=page).render().pages
    return list(list_lines(sheet._page_box))


def list_lines(box: Any) -> Iterator[Any]:
    if type(box).__name__ == "LineBox":
        yield box
    else:
        for each in getattr(box, "children", ()):
            yield from list_lines(each)


def count_words(line: Any) -> int:
    return sum(len(each.text.split()) for each in line.descendants() if hasattr(each, "text"))


def test_a_wider_column_never_has_fewer_words_on_its_first_line() -> None:
    """Where the sentence fits but for its last blank, too, at which a line ends anyway."""
    sentence = next(each for each in lay_out(580)[0].descendants() if hasattr(each, "text"))
    words = [count_words(lay_out(sentence.width + more)[0]) for more in np.arange(-6, 2, 0.5)]

    assert words == sorted(words)
    assert {words[0], words[-1]} == {len(SENTENCE.split()) - 1, len(SENTENCE.split())}
