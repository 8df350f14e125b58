"""The graphs of ISO 230-4: the paths about the nominal circle, magnified, and the same over the angle."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any

import numpy as np

from zlmreport.plugin import Approach, Evaluation, Figure, FloatArray, Words, read_only_floats
from zlmreport.plugin.standard import (
    MEAN_ROLES,
    Bracket,
    Curve,
    Level,
    Panel,
    Role,
    alternative_text,
    deviation_in_words,
    range_in_words,
)
from zlmreport_plugins.standards.iso230_4.circles import (
    Zone,
    compute_about,
    fit_least_squares_circle,
    is_full_turn,
)
from zlmreport_plugins.standards.iso230_4.quantities import SENSES

#: Returns the two circles that hold points at angles between them, by the keys of the standard.
ZoneOf = Callable[[FloatArray, FloatArray, Any], Zone]

_RADIAL = Words("Radial deviation")
_ANGLE = Words("Angle from +{first} towards +{second}")
_ONE_PATH = Words("Plane {plane}: path, {sense}")
_ON_CIRCLE = Words(
    "{paths}, and the two circles of {symbol} about {centre}; radius {radius} mm, feed {feed} mm/min. Arrow: "
    "sense; bar: start; points: where an axis turns round."
)
_CENTRES = {
    "minimum-zone": Words("their own centre (minimum zone)"),
    "least-squares": Words("the centre of the circle of least squares"),
}
_OVER_ANGLE = Words("{paths}, over the angle")
_PATH = Words("Path, {sense}:")


def draw_figures(evaluation: Evaluation, zone_of: ZoneOf, options: Any) -> Iterator[Figure]:
    """Yield the paths drawn outwards from the nominal circle, and the same over the angle."""
    graphs = _Graphs(evaluation, zone_of, options)
    if graphs.senses:
        yield graphs.draw_on_circle()
        yield graphs.draw_over_angle()


class _Graphs:
    """The graphs of one evaluation; the common centre is taken off once."""

    def __init__(self, evaluation: Evaluation, zone_of: ZoneOf, options: Any) -> None:
        measurements, mean = evaluation.measurements, evaluation.statistics.mean
        self.measurements, self.axis = measurements, measurements.axis
        self.angles = measurements.target_positions
        self.senses = [each for each in Approach if np.isfinite(mean[each.index]).any()]
        if not self.senses:
            return
        paths = mean[[each.index for each in self.senses]]
        there = np.isfinite(paths)
        points, at = paths[there], np.broadcast_to(self.angles, paths.shape)[there]
        symbol = "G_b" if len(self.senses) > 1 else f"G_{list(SENSES)[self.senses[0].index]}"
        found = evaluation.parameter(symbol)
        self.symbol = found.quantity.notation if found else ""
        self.zone = zone_of(points, at, options)
        self.is_about_nominal = options.has_length
        self.centre_in_words = _CENTRES[options.reference_circle]
        nominal = 0.0 if options.has_length else float(fit_least_squares_circle(points, at).radius)
        self.paths = compute_about(self.zone.centre, paths, self.angles) - nominal
        self.inner, self.outer = float(self.zone.inner) - nominal, float(self.zone.outer) - nominal

    def draw_on_circle(self) -> Figure:
        """Return the paths about the nominal circle, or about the mean one where no length is known."""
        first, second = self.axes
        levels = tuple(
            Level(self.symbol, Role.BAND_LIMIT, self._convert_to_printed(each))
            for each in (self.inner, self.outer)
        )
        panel = Panel(
            curves=tuple(map(self._draw_as_run, self.senses, self.paths)),
            levels=levels if self.symbol else (),
            projection="polar",
            directions=(
                (0.0, f"+{first}"),
                (90.0, f"+{second}"),
                (180.0, f"−{first}"),
                (270.0, f"−{second}"),
            ),
        )
        circle = self.axis.circle
        title = _ON_CIRCLE.given(
            paths=self.paths_in_words,
            symbol=self.symbol,
            centre=self.centre_in_words,
            radius=circle.radius * 1e3 if circle else 0.0,
            feed=float(f"{circle.feed * 60e3:.6g}") if circle else 0.0,
        )
        return self._make_figure("circle", title, panel)

    def draw_over_angle(self) -> Figure:
        """Return the paths over the angle, with the circular deviation where it arises."""
        bracket = []
        if self.symbol:
            lowest, highest = int(np.nanargmin(self.paths)), int(np.nanargmax(self.paths))
            count = len(self.angles)
            bracket = [
                Bracket(
                    self.symbol,
                    self._convert_to_printed(self.inner),
                    self._convert_to_printed(self.outer),
                    self._convert_to_degrees(self.angles[lowest % count]),
                    self._convert_to_degrees(self.angles[highest % count]),
                )
            ]
        curves = tuple(
            Curve(
                self._write_notation(each),
                MEAN_ROLES[each],
                read_only_floats(self.axis.position_unit.from_si(self.angles)),
                read_only_floats(self.axis.deviation_unit.from_si(path)),
            )
            for each, path in zip(self.senses, self.paths, strict=True)
        )
        panel = Panel(curves=curves, brackets=tuple(bracket))
        return self._make_figure("over-angle", _OVER_ANGLE.given(paths=self.paths_in_words), panel)

    @property
    def axes(self) -> tuple[str, str]:
        """The letters of the plane's axes."""
        return self.axis.circle.axes if self.axis.circle else ("1", "2")

    @property
    def paths_in_words(self) -> Words:
        """What the graphs show, and from where deviations are reckoned."""
        if len(self.senses) > 1:
            paths = Words("Plane {plane}: paths of both senses").given(plane=self.axis.name)
        else:
            paths = _ONE_PATH.given(plane=self.axis.name, sense=list(SENSES.values())[self.senses[0].index])
        return paths if self.is_about_nominal else Words("{paths}, from the mean radius").given(paths=paths)

    def _draw_as_run(self, sense: Approach, path: FloatArray) -> Curve:
        """Return a path in the order in which it was run; a full turn ends where it began."""
        order = np.arange(len(self.angles))
        if sense is Approach.NEGATIVE:
            order = order[::-1]
        of_sense = np.flatnonzero(self.measurements.approach == sense)
        begin = int(np.flatnonzero(order == self.measurements.target[of_sense[0]])[0])
        order = np.roll(order, -begin)
        if is_full_turn(self.angles):
            order = np.append(order, order[0])
        return Curve(
            self._write_notation(sense),
            MEAN_ROLES[sense],
            read_only_floats(self.axis.position_unit.from_si(self.angles[order])),
            read_only_floats(self.axis.deviation_unit.from_si(path[order])),
        )

    def _make_figure(self, key: str, title: Words, panel: Panel) -> Figure:
        first, second = self.axes
        zone = self.zone
        ranges = (
            range_in_words(self.axis, _PATH.given(sense=list(SENSES.values())[sense.index]), path)
            for sense, path in zip(self.senses, self.paths, strict=True)
        )
        circles = Words("{symbol} = {width}: its circles lie at {inner} and {outer}.").given(
            symbol=self.symbol,
            width=deviation_in_words(self.axis, float(zone.width)),
            inner=deviation_in_words(self.axis, self.inner),
            outer=deviation_in_words(self.axis, self.outer),
        )
        centre = Words("The centre lies at {first} = {x} and {second} = {y} from that of the set-up.").given(
            first=first,
            second=second,
            x=deviation_in_words(self.axis, float(zone.centre[0])),
            y=deviation_in_words(self.axis, float(zone.centre[1])),
        )
        return Figure(
            key=key,
            title=title,
            alternative=alternative_text(write_title_as_sentence(title), *ranges, circles, centre),
            x_title=_ANGLE.given(first=first, second=second),
            y_title=_RADIAL,
            x_unit=self.axis.position_unit.symbol,
            y_unit=self.axis.deviation_unit.symbol,
            panels=(panel,),
        )

    @staticmethod
    def _write_notation(sense: Approach) -> str:
        return f"r({list(SENSES)[sense.index]})"

    def _convert_to_printed(self, value: float) -> float:
        return float(self.axis.deviation_unit.from_si(value))

    def _convert_to_degrees(self, angle: float) -> float:
        return float(self.axis.position_unit.from_si(angle))


def write_title_as_sentence(title: Words) -> Words:
    """Return a caption as a sentence."""
    return Words("{title}.").given(title=title)
