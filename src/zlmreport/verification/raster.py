"""Compares both documents pixel by pixel, as a viewer draws them; the resolution and tolerances.

PDFium, the engine of Chromium, knows nothing of what is compared elsewhere: its text and its pixels must be
the same, or something is seen that the comparison of the structure overlooked.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from zlmreport.verification.findings import CheckedStatement

#: Dots to the inch: a digit of 7 points is 7 pixels high.
_RESOLUTION = 96
#: Of 255: the edge of a glyph that another library packed may be smoothed otherwise.
_STEP = 48
#: Pixels by which a mark may be off on a page that other libraries drew, and what smoothing then makes of a
#: stroke narrower than a pixel, of 255: it is one dark pixel, or two that are half as dark.
_REACH, _STEP_OFF = 1, 144
_MILLIMETRES = 25.4 / _RESOLUTION
_LONGEST = 40


def compare(content: bytes, again: bytes, is_alike: Sequence[bool]) -> dict[int, CheckedStatement]:
    """Return what is seen otherwise, by the number of the page from 0.

    `is_alike`: For each page whether both draw stroke for stroke alike; otherwise marks may be off by a
        pixel.
    """
    import pypdfium2  # noqa: PLC0415 - slow to load

    found: dict[int, CheckedStatement] = {}
    with pypdfium2.PdfDocument(content) as one, pypdfium2.PdfDocument(again) as other:
        for number, is_same in enumerate(is_alike):
            if number >= len(one):
                difference = "it is not there"
            else:
                difference = _find_difference(one[number], other[number], is_alike=is_same)
            if difference:
                detail = f"PDFium shows it otherwise: {difference}"
                found[number] = CheckedStatement.of(f"page {number + 1}", detail)
    return found


def _find_difference(page: Any, again: Any, *, is_alike: bool) -> str:
    size, size_again = page.get_size(), again.get_size()
    if size != size_again or page.get_rotation() != again.get_rotation():
        return "in another size"
    text, text_again = _read_text(page), _read_text(again)
    if text != text_again:
        at = next((i for i, pair in enumerate(zip(text, text_again, strict=False)) if len(set(pair)) > 1), 0)
        return (
            f"{text[at : at + _LONGEST]!r} stands where {text_again[at : at + _LONGEST]!r} is printed again"
        )
    pixels, pixels_again = _draw_pixels(page), _draw_pixels(again)
    if pixels.shape != pixels_again.shape:
        return "in another size"
    if np.array_equal(pixels, pixels_again):
        return ""
    on_either = [
        _find_pixels_off(pixels, pixels_again, is_alike=is_alike),
        _find_pixels_off(pixels_again, pixels, is_alike=is_alike),
    ]
    rows, columns = np.unique(np.vstack(on_either), axis=0).T
    if not len(rows):
        return ""
    across, down = columns[0] * _MILLIMETRES, rows[0] * _MILLIMETRES
    return f"{len(rows)} pixels, the first {across:.0f} mm from the left and {down:.0f} mm from the top"


def _read_text(page: Any) -> str:
    return " ".join(page.get_textpage().get_text_bounded().split())


def _draw_pixels(page: Any) -> NDArray[np.uint8]:
    pixels: NDArray[np.uint8] = page.render(scale=_RESOLUTION / 72).to_numpy()
    return pixels


def _find_pixels_off(
    pixels: NDArray[np.uint8], again: NDArray[np.uint8], *, is_alike: bool
) -> NDArray[np.intp]:
    """Return row and column of the pixels that are darker or lighter than all near them on the other page."""
    reach, step = (0, _STEP) if is_alike else (_REACH, _STEP_OFF)
    differing = np.maximum(pixels, again) - np.minimum(pixels, again)
    rows, columns = np.nonzero(np.any(differing > step, axis=-1))
    height, width, _ = again.shape
    near = np.stack(
        [
            again[(rows + down).clip(0, height - 1), (columns + across).clip(0, width - 1)].astype(np.int16)
            for down in range(-reach, reach + 1)
            for across in range(-reach, reach + 1)
        ]
    )
    colours = pixels[rows, columns]
    is_off = np.any((colours < near.min(axis=0) - step) | (colours > near.max(axis=0) + step), axis=-1)
    return np.stack([rows[is_off], columns[is_off]], axis=1)
