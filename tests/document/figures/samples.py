"""Figures to draw, and a canvas that remembers what was drawn on it."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from zlmreport.document.figures.figure import Bar, PlottedReadings
from zlmreport.document.figures.shapes import Box
from zlmreport.plugin import Approach, Figure, FloatArray, Language, Words
from zlmreport.plugin.page import (
    Colour,
    Fill,
    Segment,
    Stroke,
    TextRun,
    draw_figure,
    figure_size,
    plain_label,
)
from zlmreport.plugin.standard import Arrow, Band, Bracket, Curve, Level, Panel, Role

TARGETS = np.array([0.0, 250.0, 500.0, 750.0, 1000.0])
FORWARD = np.array([1.5, 4.0, -2.5, 3.0, 6.5])
BACKWARD = np.array([-0.5, 1.0, -5.0, 2.0, 3.5])
SPREAD = np.array([1.0, 2.5, 1.5, 2.0, 1.0])


def figure(*panels: Panel, x_unit: str = "mm", y_unit: str = "µm") -> Figure:
    """Return a figure of deviations over target positions."""
    return Figure(
        key="sample",
        title=Words("Deviation", "Abweichung"),
        alternative=Words('Deviations up to 7.5 µm, "A" and B < A', 'Abweichungen bis 7,5 µm, "A" und B < A'),
        x_title=Words("Target position", "Sollposition"),
        y_title=Words("Deviation", "Abweichung"),
        x_unit=x_unit,
        y_unit=y_unit,
        panels=panels,
    )


def both_directions() -> Panel:
    """Return the diagram of both directions with everything that a panel can have."""
    mean = (FORWARD + BACKWARD) / 2
    every = np.repeat(TARGETS, 3)
    scatter = np.tile([-0.4, 0.0, 0.4], len(TARGETS))
    return Panel(
        curves=(
            Curve("x̄_{i}↑", Role.MEAN_POSITIVE, TARGETS, FORWARD),
            Curve("x̄_{i}↓", Role.MEAN_NEGATIVE, TARGETS, BACKWARD),
            Curve("x̄_{i}", Role.MEAN_BIDIRECTIONAL, TARGETS, mean),
        ),
        bands=(
            Band("x̄_{i}↑ ± 2s_{i}↑", Role.LIMIT_POSITIVE, TARGETS, FORWARD - SPREAD, FORWARD + SPREAD),
            Band("x̄_{i}↓ ± 2s_{i}↓", Role.LIMIT_NEGATIVE, TARGETS, BACKWARD - SPREAD, BACKWARD + SPREAD),
        ),
        readings=(
            PlottedReadings(Approach.POSITIVE, every, np.repeat(FORWARD, 3) + scatter),
            PlottedReadings(Approach.NEGATIVE, every, np.repeat(BACKWARD, 3) + scatter),
        ),
        arrows=(Arrow("R_{i}", 250.0, -1.5, 6.5), Arrow("B_{i}", 250.0, 1.0, 4.0)),
        brackets=(
            Bracket("A", -6.5, 7.5, 500.0, 1000.0),
            Bracket("E", -5.0, 6.5, 500.0, 1000.0),
            Bracket("M", -3.75, 5.0, 500.0, 1000.0),
        ),
        levels=(Level("T", Role.TOLERANCE, 8.0),),
    )


def each_direction() -> tuple[Panel, Panel]:
    """Return the diagrams of each direction by itself."""
    whole = both_directions()
    return tuple(
        Panel(
            heading=Words("Direction {arrow}", "Richtung {arrow}").given(arrow=approach.arrow),
            curves=whole.curves[number : number + 1],
            bands=whole.bands[number : number + 1],
            readings=whole.readings[number : number + 1],
            brackets=(Bracket(f"A{approach.arrow}", -4.0, 7.5, 500.0, 1000.0),),
        )
        for number, approach in enumerate(Approach)
    )


def scaled(panel: Panel, factor: float, offset: float = 0.0) -> Panel:
    """Return a panel with all its values scaled and shifted."""

    def moved(value: float | FloatArray) -> float | FloatArray:
        return value * factor + offset

    def ends(one: Arrow | Bracket) -> Arrow | Bracket:
        return replace(one, low=moved(one.low), high=moved(one.high))

    return replace(
        panel,
        curves=tuple(replace(one, y=moved(one.y)) for one in panel.curves),
        bands=tuple(replace(one, lower=moved(one.lower), upper=moved(one.upper)) for one in panel.bands),
        readings=tuple(replace(one, y=moved(one.y)) for one in panel.readings),
        arrows=tuple(map(ends, panel.arrows)),
        brackets=tuple(map(ends, panel.brackets)),
        levels=tuple(replace(one, y=moved(one.y)) for one in panel.levels),
    )


def many_targets() -> Panel:
    """Return a diagram of 200 targets at irregular positions."""
    x = np.linspace(0.0, 1990.0, 200) + np.tile([0.137, 3.71, 1.003, 2.5], 50)
    y = 3.0 * np.sin(x / 90.0) + x / 200.0
    return Panel(
        curves=(Curve("x̄_{i}↑", Role.MEAN_POSITIVE, x, y), Curve("x̄_{i}↓", Role.MEAN_NEGATIVE, x, y - 1)),
        bands=(Band("x̄_{i}↑ ± 2s_{i}↑", Role.LIMIT_POSITIVE, x, y - 2, y + 2),),
        arrows=(
            Arrow("R_{i}", float(x[100]), float(y[100] - 2), float(y[100] + 2)),
            Arrow("B_{i}", float(x[101]), float(y[101] - 1), float(y[101])),
        ),
        brackets=(
            Bracket("E", float(y.min()), float(y.max()), float(x[np.argmin(y)]), float(x[np.argmax(y)])),
        ),
    )


def bars(*heights: float, names: Sequence[str] = ()) -> Panel:
    """Return bars with their values, and a level below the last."""
    names = names or [f"effect-{number}" for number in range(len(heights))]
    return Panel(
        bars=tuple(
            Bar(Words(name, name), height, Words(f"{height:.2f}", f"{height:.2f}".replace(".", ",")))
            for name, height in zip(names, heights, strict=True)
        ),
        levels=(Level("σ₀", Role.TOLERANCE, min(heights) / 2),),
    )


def _lone(*values: float) -> Panel:
    """Return a curve with a band through values at the first targets."""
    y = np.array(values)
    x = TARGETS[: len(y)]
    return Panel(
        curves=(Curve("x̄_{i}", Role.MEAN_BIDIRECTIONAL, x, y),),
        bands=(Band("x̄_{i} ± 2s_{i}", Role.SPREAD, x, y - 1, y + 1),),
        readings=(PlottedReadings(Approach.POSITIVE, x, y),),
    )


NAN = float("nan")
#: Tests that nobody wishes for, and that happen.
DEGENERATE = {
    "nothing at all": figure(Panel()),
    "no panel": figure(),
    "one target": figure(replace(_lone(1.5), arrows=(Arrow("R_{i}", 0.0, 0.5, 2.5),))),
    "no value exists": figure(_lone(NAN, NAN, NAN)),
    "no end of an arrow or bracket exists": figure(
        replace(
            both_directions(),
            arrows=(Arrow("B_{i}", 250.0, NAN, NAN),),
            brackets=(Bracket("A", NAN, 1.0, NAN, 0.0),),
            levels=(Level("T", Role.TOLERANCE, NAN),),
        )
    ),
    "values between gaps": figure(_lone(1.0, NAN, 2.0, NAN, -1.0)),
    "all values are alike": figure(_lone(5000.0, 5000.0, 5000.0)),
    "all values are zero": figure(_lone(0.0, 0.0, 0.0)),
    "a nanometre": figure(scaled(both_directions(), 1e-4)),
    "five millimetres": figure(scaled(both_directions(), 700.0)),
    "a nanometre at five millimetres": figure(scaled(both_directions(), 1e-4, 5000.0)),
    "equal ends": figure(
        replace(
            _lone(1.0, 2.0, 3.0),
            arrows=(Arrow("B_{i}", 250.0, 2.0, 2.0),),
            brackets=(Bracket("M", 2.0, 2.0, 0.0, 250.0),),
        )
    ),
    "ends that nearly meet": figure(
        replace(
            _lone(1.0, 2.0, 3.0),
            arrows=(Arrow("B_{i}", 250.0, 2.0, 2.001),),
            brackets=(Bracket("M", 2.0, 2.001, 0.0, 250.0), Bracket("E", 1.99, 2.01, 0.0, 250.0)),
        )
    ),
    "four brackets of one length": figure(
        replace(
            _lone(1.0, 2.0, 3.0),
            brackets=tuple(
                Bracket(name, 1.0, 3.0, 0.0, 500.0) for name in ("A", "P_{s max}", "U_{max}", "E")
            ),
        )
    ),
    "five arrows at one target": figure(
        replace(
            _lone(1.0, 2.0, 3.0),
            arrows=tuple(
                Arrow(f"R_{{{number}}}", 250.0, 1.0 + 0.1 * number, 3.0 - 0.1 * number) for number in range(5)
            ),
        )
    ),
    "arrows at the first and last target": figure(
        replace(
            _lone(1.0, 2.0, 3.0), arrows=(Arrow("R_{i}", 0.0, 0.0, 2.0), Arrow("P_{s max}", 500.0, 2.0, 4.0))
        )
    ),
    "three levels close together": figure(
        replace(
            _lone(1.0, 2.0, 3.0),
            levels=tuple(Level(name, Role.BAND_LIMIT, 2.0 + 0.01 * n) for n, name in enumerate("abc")),
        )
    ),
    "a single bar": figure(bars(1.0)),
    "bars of no height": figure(bars(0.0, 0.0)),
    "thirty bars": figure(bars(*np.linspace(5.0, 0.5, 30).tolist())),
    "bars with long names": figure(
        bars(5.0, 3.0, 1.0, names=("ohne jeden Einfluss", "+ reversal-relaxation " * 4, "x" * 60))
    ),
    "a legend of several rows": figure(
        replace(
            both_directions(),
            curves=tuple(
                Curve(f"x̄_{{i}}↑ + {number} · s_{{i}}↑", role, TARGETS, FORWARD + number)
                for number, role in enumerate(Role)
            ),
        )
    ),
}
#: What a certificate shows.
ORDINARY = {
    "both directions": figure(both_directions()),
    "each direction": figure(*each_direction()),
    "panels beside each other": replace(figure(*each_direction()), is_wide=True, height=45.0),
    "200 targets": figure(many_targets()),
    "a fall chart": figure(bars(5.77, 3.72, 0.54, names=("without model", "+ offset", "+ screw-pitch"))),
    "a panel of what another leaves": replace(
        figure(both_directions(), scaled(both_directions(), 0.1)), spans_are_alike=False
    ),
    "a rotary axis": figure(both_directions(), x_unit="°", y_unit="″"),
}
ALL = ORDINARY | DEGENERATE


@dataclass(frozen=True)
class DrawnOutline:
    """An outline on the canvas."""

    kind: str
    segments: list[Segment]
    stroke: Stroke | None
    fill: Fill | None

    @property
    def points(self) -> FloatArray:
        """All its points, shape (N, 2)."""
        return np.reshape([value for _, points in self.segments for value in points], (-1, 2))

    @property
    def parts(self) -> list[FloatArray]:
        """The points of each part that begins with a move."""
        parts: list[list[float]] = []
        for operator, coordinates in self.segments:
            if operator == "M":
                parts.append([])
            parts[-1].extend(coordinates)
        return [np.reshape(part, (-1, 2)) for part in parts]


@dataclass(frozen=True)
class DrawnText:
    """A line of text on the canvas."""

    kind: str
    runs: list[TextRun]
    angle: float

    @property
    def text(self) -> str:
        """What it reads."""
        return "".join(run.text for run in self.runs)

    @property
    def box(self) -> Box:
        """The room of its letters, y downwards: from the height of a capital to the baseline."""
        last = self.runs[-1]
        length = last.x - self.runs[0].x + plain_label(last.text, last.size, last.face).width
        x, y, size = self.runs[0].x, self.runs[0].y, self.runs[0].size
        if self.angle:
            return Box(x - 0.7 * size, y - length, x, y)
        return Box(x, y - 0.7 * size, x + length, y)


@dataclass
class Recording:
    """A canvas that remembers."""

    outlines: list[DrawnOutline] = field(default_factory=list)
    texts: list[DrawnText] = field(default_factory=list)

    def outline(
        self, kind: str, segments: Sequence[Segment], stroke: Stroke | None, fill: Fill | None
    ) -> None:
        """Remember an outline."""
        self.outlines.append(DrawnOutline(kind, list(segments), stroke, fill))

    def text(self, kind: str, runs: Sequence[TextRun], colour: Colour, angle: float) -> None:
        """Remember a line of text."""
        del colour
        self.texts.append(DrawnText(kind, list(runs), angle))

    def of(self, kind: str) -> list[DrawnOutline]:
        """Return the outlines of a kind."""
        return [outline for outline in self.outlines if outline.kind == kind]

    def texts_of(self, *kinds: str) -> list[DrawnText]:
        """Return the texts of some kinds."""
        return [text for text in self.texts if text.kind in kinds]


def drawn(of: Figure, language: Language = Language.ENGLISH) -> Recording:
    """Return what is drawn of a figure."""
    canvas = Recording()
    draw_figure(of, language, canvas)
    return canvas


@dataclass(frozen=True)
class Readback:
    """The scales of a drawing of one panel, read from its ticks and their labels alone."""

    canvas: Recording

    def x(self, point: float | FloatArray) -> FloatArray:
        """Return the position that is drawn at a point."""
        return self._value("tick x", 0, point)

    def y(self, point: float | FloatArray) -> FloatArray:
        """Return the value that is drawn at a point."""
        return self._value("tick y", 1, point)

    def values(self, points: FloatArray) -> FloatArray:
        """Return the positions and values drawn at points, both of shape (N, 2)."""
        return np.column_stack([self.x(points[:, 0]), self.y(points[:, 1])])

    def _value(self, kind: str, axis: int, point: float | FloatArray) -> FloatArray:
        labels = [_number(text.text) for text in self.canvas.texts_of(kind)]
        (ticks,) = self.canvas.of("tick")
        across = [part for part in ticks.parts if np.ptp(part[:, axis]) == 0]
        places = [part[0, axis] for part in across][: len(labels)]
        slope, start = np.polyfit(places, labels, 1)
        return np.asarray(slope * np.asarray(point) + start)


def _number(text: str) -> float:
    return float(text.replace("−", "-").replace(",", "."))


def pairs(boxes: Sequence[Box]) -> Iterator[tuple[Box, Box]]:
    """Yield every two of some boxes."""
    for number, one in enumerate(boxes):
        for other in boxes[number + 1 :]:
            yield one, other


#: Kinds of labels that stand where a dimension is.
DIMENSIONS = ("arrow", "bracket", "level")


def collisions(of: Figure, language: Language = Language.ENGLISH) -> list[str]:
    """Return the labels of a figure that lie on each other, on a line of a dimension, or outside of it."""
    canvas = drawn(of, language)
    width, height = figure_size(of)
    dimensions = [text.box for text in canvas.texts_of(*DIMENSIONS)]
    around = [text.box for text in canvas.texts_of("tick x", "tick y", "legend", "heading", "title")]
    found = [
        f"{a} overlaps {b}" for both in (dimensions, around) for a, b in pairs(both) if a.is_overlapping(b)
    ]
    values = [replace(box, top=box.top + 2) for box in (text.box for text in canvas.texts_of("tick y"))]
    found += [f"{a} is close to {b}" for a, b in pairs(values) if a.is_overlapping(b)]
    for text in canvas.texts:
        box = text.box
        if box.left < 0 or box.bottom < 0 or box.right > width or box.top > height:
            found.append(f"{text.text} is outside")
    through = ((DIMENSIONS, ("arrow", "bracket")), (("bar",), ("level",)))
    for kinds, of_lines in through:
        lines = [line.points for kind in of_lines for line in canvas.of(kind)]
        for text in canvas.texts_of(*kinds):
            found += [f"a line runs through {text.text}" for points in lines if _meets(text.box, points)]
    return found


def _meets(box: Box, line: FloatArray) -> bool:
    x, y = line[:, 0], line[:, 1]
    return box.left < x.max() and x.min() < box.right and box.bottom < y.max() and y.min() < box.top
