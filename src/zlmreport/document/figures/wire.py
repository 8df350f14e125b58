"""Wire pictures of a body (a surface plate): both coordinates on one scale, values written at places."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from zlmreport.document.figures.figure import Panel
from zlmreport.document.figures.metrics import make_plain_label
from zlmreport.document.figures.scale import AxisScale, find_extremes
from zlmreport.document.figures.shapes import TICK_TEXT_SIZE, Box, Frame, PlacedLabel
from zlmreport.language import Language, Words
from zlmreport.language.formatting import write_fixed_number

#: Round the body, in points: half a note has room there.
_ROOM_BESIDE, _ROOM_ABOVE = 16.0, 12.0
#: Between a place and its note.
_GAP = 2.0


def make_wire_frame(panel: Panel, box: Box) -> Frame:
    """Return the area in which a body is drawn, as large as a box lets it be and in its middle."""
    x_low, x_high = find_extremes(np.concatenate([np.empty(0), *(each.x for each in panel.curves)]))
    y_low, y_high = find_extremes(np.concatenate([np.empty(0), *(each.y for each in panel.curves)]))
    width, height = (x_high - x_low) or 1.0, (y_high - y_low) or 1.0
    factor = min((box.width - 2 * _ROOM_BESIDE) / width, (box.height - 2 * _ROOM_ABOVE) / height)
    return Frame(
        box,
        _scale((x_low + x_high) / 2, box.width / factor),
        _scale((y_low + y_high) / 2, box.height / factor),
    )


def _scale(middle: float, span: float) -> AxisScale:
    return AxisScale(middle - span / 2, middle + span / 2, (), ())


def place_notes(panel: Panel, frame: Frame, language: Language) -> Iterator[PlacedLabel]:
    """Yield the notes where they stand: above or below their places, in the middle."""
    for note in panel.notes:
        value = note.value
        if isinstance(value, Words):
            text = value.in_language(language)
        else:
            text = write_fixed_number(value, 1, language.decimal_sign)
        label = make_plain_label(text, TICK_TEXT_SIZE)
        x, y = frame.place_x(note.x), frame.place_y(note.y)
        foot = y - _GAP - label.height if note.is_below else y + _GAP
        yield PlacedLabel(label, x - label.width / 2, foot)
