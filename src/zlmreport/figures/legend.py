"""What stands above a panel: its heading, and a legend of samples and symbols in rows."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TypeAlias

from zlmreport.figures.canvas import Face, Label
from zlmreport.figures.figure import Band, Curve, Panel, Readings
from zlmreport.figures.frame import PlacedLabel
from zlmreport.figures.lettering import plain_label, symbol_label
from zlmreport.figures.style import TEXT_SIZE
from zlmreport.language import Language, Words

#: Width of the sample of a line or a band, and of a single mark.
LINE_SAMPLE = 25.0
MARK_SAMPLE = 6.0

#: Between a legend and the frame below it.
LEGEND_GAP = 5.0

_ROW_HEIGHT = 13.0
_SAMPLE_GAP = 4.0
_ENTRY_GAP = 14.0
_HEADING_GAP = 14.0
_READINGS = Words("single readings", "Einzelmesswerte")

#: What an entry explains; the readings of all approaches share one.
Explained: TypeAlias = Curve | Band | tuple[Readings, ...]


@dataclass(frozen=True, slots=True)
class Entry:
    """A sample, and the label after it."""

    explained: Explained
    label: Label

    @property
    def label_start(self) -> float:
        """Where the label begins, from the beginning of the sample."""
        marks = len(self.explained) if isinstance(self.explained, tuple) else 0
        return (marks * MARK_SAMPLE or LINE_SAMPLE) + _SAMPLE_GAP

    @property
    def width(self) -> float:
        """Of sample and label."""
        return self.label_start + self.label.width


@dataclass(frozen=True, slots=True)
class LegendLayout:
    """The heading, and each entry with the beginning of its sample and the height of its middle.

    Places are points from the legend's lower left corner, y upwards.
    """

    heading: PlacedLabel | None
    entries: tuple[tuple[Entry, float, float], ...]
    height: float


def lay_out_legend(panel: Panel, language: Language, width: float) -> LegendLayout:
    """Return the legend of a panel in rows of a width; a heading begins the first row."""
    entries = _entries(panel, language)
    heading = None
    x, row = 0.0, 0
    if panel.heading is not None:
        heading = plain_label(panel.heading.in_language(language), TEXT_SIZE, Face.SEMIBOLD)
        x = heading.width + _HEADING_GAP
    places = []
    for entry in entries:
        if x > 0 and x + entry.width > width:
            x, row = 0.0, row + 1
        places.append((entry, x, row))
        x += entry.width + _ENTRY_GAP
    rows = row + 1 if entries or heading else 0
    middles = [(rows - row - 0.5) * _ROW_HEIGHT for row in range(rows)]
    return LegendLayout(
        None if heading is None else PlacedLabel(heading, 0.0, middles[0] - heading.rise),
        tuple((entry, x, middles[row]) for entry, x, row in places),
        rows * _ROW_HEIGHT,
    )


def _entries(panel: Panel, language: Language) -> tuple[Entry, ...]:
    """Return one entry for each symbol of a panel: curves, bands, readings."""
    explained: tuple[Curve | Band, ...] = (*panel.curves, *panel.bands)
    found: dict[object, Entry] = {}
    for one in explained:
        if one.notation:
            entry = Entry(one, symbol_label(one.notation, TEXT_SIZE))
            found.setdefault((type(one), one.role, one.notation), entry)
    if panel.readings:
        arrows = (readings.approach.arrow for readings in panel.readings)
        text = " ".join((_READINGS.in_language(language), *arrows))
        found["readings"] = Entry(panel.readings, plain_label(text, TEXT_SIZE))
    return tuple(found.values())
