"""Graphs of an error model: its curve with U over the travel, means, scatter; the estimate."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from zlmreport.document.figures.figure import Band, Curve, Figure, Panel, PlottedReadings, Role
from zlmreport.document.figures.prescribed import DEVIATION_TITLE, POSITION_TITLE, alternative_text
from zlmreport.language import Words
from zlmreport.measurement.approach import Approach
from zlmreport.measurement.arrays import BoolArray, FloatArray, IntArray, read_only_floats
from zlmreport.measurement.axis import Axis
from zlmreport.model.diagnosis.error_numbers import ErrorNumbers
from zlmreport.model.effects import wording
from zlmreport.model.effects.design import Design, place_at_positions
from zlmreport.model.effects.effect import Shape
from zlmreport.model.fitting.curve import lay_curve_positions, shows_reach_only
from zlmreport.model.fitting.fit import Fit

MODEL = {Approach.POSITIVE: Role.MODEL_POSITIVE, Approach.NEGATIVE: Role.MODEL_NEGATIVE}
UNCERTAINTY = {
    Approach.POSITIVE: Role.UNCERTAINTY_POSITIVE,
    Approach.NEGATIVE: Role.UNCERTAINTY_NEGATIVE,
}
#: The scatter of single readings is drawn this many standard deviations to both sides.
SPREAD = 2.0
RESIDUAL_TITLE = Words("Residual")

_RANGE = Words("{name} from {low} to {high}.")
_SENTENCE = Words("Residuals from {low} to {high}, root mean square {rms}.")
_NOISE = Words("Single readings scatter by {noise} (standard deviation).")


@dataclass(frozen=True, slots=True)
class ModelDiagram:
    """The graphs of one fitted model."""

    fit: Fit  #: The model with the readings.
    error: ErrorNumbers  #: How far they are apart.
    #: The part of the travel over which the model is drawn, m or rad; without it all that was measured.
    span: tuple[float, float] | None = None

    @property
    def design(self) -> Design:
        """The test."""
        return self.fit.design

    @property
    def axis(self) -> Axis:
        """The axis under test."""
        return self.fit.design.axis

    @property
    def approaches(self) -> tuple[Approach, ...]:
        """The directions in which there are readings, the positive one first."""
        return tuple(each for each in Approach if np.any(self.select(each)))

    @property
    def noise(self) -> float:
        """Standard deviation of single readings: the noise floor, or without repeats the σ of the fit."""
        floor = self.error.noise_rms
        return self.fit.noise.sigma if floor is None else floor

    @property
    def positions(self) -> FloatArray:
        """The target position of each reading in the unit of the page, shape (N,)."""
        return self.axis.position_unit.from_si(self.design.position)

    def select(self, approach: Approach) -> BoolArray:
        """Return which readings are of a direction of approach, shape (N,)."""
        return np.asarray(self.design.direction == approach, dtype=np.bool_)

    def convert_to_printed(self, values: FloatArray) -> FloatArray:
        """Return deviations in the unit of the page."""
        return read_only_floats(self.axis.deviation_unit.from_si(values))

    def draw_readings(self, x: FloatArray, values: FloatArray) -> tuple[PlottedReadings, ...]:
        """Return values of single readings, shape (N,), over anything in the unit of the page."""
        return tuple(
            PlottedReadings(
                approach,
                read_only_floats(x[self.select(approach)]),
                self.convert_to_printed(values[self.select(approach)]),
            )
            for approach in self.approaches
        )

    def draw_means(
        self, notation: str, role: Role, x: FloatArray, values: FloatArray, group: IntArray
    ) -> Curve:
        """Return a curve through the means of groups of readings.

        `x`, `values`, (k,): Of readings: in the unit of the page, and m or rad.
        `group`, (k,) integer: The group of each reading; the curve follows their numbers.
        """
        _, place, count = np.unique(group, return_inverse=True, return_counts=True)
        mean_x = np.bincount(place, weights=x) / count
        mean_y = np.bincount(place, weights=values) / count
        return Curve(notation, role, read_only_floats(mean_x), self.convert_to_printed(mean_y))

    def draw_scatter(self, x: FloatArray) -> Band:
        """Return the band in which residuals of an adequate model lie, over the range of `x`."""
        ends = read_only_floats([x.min(), x.max()])
        half = np.full(2, SPREAD * self.noise)
        return Band("± 2σ", Role.NOISE, ends, self.convert_to_printed(-half), self.convert_to_printed(half))

    def say_range(self, name: Words, values: FloatArray) -> Words:
        """Return where deviations (m or rad) lie."""
        return _RANGE.given(
            name=name,
            low=wording.deviation(self.axis, float(values.min())),
            high=wording.deviation(self.axis, float(values.max())),
        )

    def say_residuals(self) -> tuple[Words, Words]:
        """Return what the residuals amount to, for those who cannot see them."""
        residual = self.fit.residual
        return (
            _SENTENCE.given(
                low=wording.deviation(self.axis, float(residual.min())),
                high=wording.deviation(self.axis, float(residual.max())),
                rms=wording.deviation(self.axis, self.error.rms),
            ),
            _NOISE.given(noise=wording.deviation(self.axis, self.noise)),
        )

    def make_figure(  # noqa: PLR0913 - a figure has a key, words for each of its parts, a unit, and panels
        self,
        key: str,
        title: Words,
        alternative: Words,
        x_title: Words,
        x_unit: str,
        *panels: Panel,
        y_title: Words = DEVIATION_TITLE,
    ) -> Figure:
        """Return a figure of deviations over anything; each panel has a span of its own."""
        return Figure(
            key=key,
            title=title,
            alternative=alternative,
            x_title=x_title,
            y_title=y_title,
            x_unit=x_unit,
            y_unit=self.axis.deviation_unit.symbol,
            panels=panels,
            spans_are_alike=False,
        )


_TITLE = Words(
    "Deviation estimated by the error model at any position of the travel, with its expanded uncertainty "
    "U (about 95 %)"
)
_AT_THE_MEAN = Words("{title}; at the mean time and the mean logged conditions of the test")
_REACH = Words(
    "{title}; its waves are too short to be parted on this length: the line shows how far they reach"
)
_LARGEST = Words("The expanded uncertainty is {largest} at most.")


def estimate(diagram: ModelDiagram) -> Figure:
    """Return the estimate with its uncertainty for each direction of approach, the readings behind it."""
    axis, fit = diagram.axis, diagram.fit
    curves, bands, sentences = [], [], []
    largest = 0.0
    for approach in diagram.approaches:
        positions = lay_curve_positions(fit, approach, diagram.span)
        x = read_only_floats(axis.position_unit.from_si(positions))
        found = fit.predict(place_at_positions(diagram.design, positions, approach))
        value, half = found.deviation, found.expanded_uncertainty
        arrow = approach.arrow
        curves.append(Curve(f"x̂{arrow}", MODEL[approach], x, diagram.convert_to_printed(value)))
        bands.append(
            Band(
                f"x̂{arrow} ± U",
                UNCERTAINTY[approach],
                x,
                diagram.convert_to_printed(value - half),
                diagram.convert_to_printed(value + half),
            )
        )
        sentences.append(diagram.say_range(Words("Estimate {arrow}").given(arrow=arrow), value))
        largest = max(largest, float(half.max()))
    moves = any(term.effect.shape in {Shape.TIME, Shape.RUN} for term in fit.model.terms)
    title = _AT_THE_MEAN.given(title=_TITLE) if moves else _TITLE
    return diagram.make_figure(
        "estimate",
        _REACH.given(title=title) if shows_reach_only(fit, diagram.span) else title,
        alternative_text(*sentences, _LARGEST.given(largest=wording.deviation(axis, largest))),
        POSITION_TITLE,
        axis.position_unit.symbol,
        Panel(
            curves=tuple(curves),
            bands=tuple(bands),
            readings=diagram.draw_readings(diagram.positions, fit.deviation),
        ),
    )
