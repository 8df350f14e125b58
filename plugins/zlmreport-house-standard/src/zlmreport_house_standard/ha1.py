"""House acceptance HA-1: what this works asks of a machine axis before it is put to use.

An invented rule, so nothing in it is taken from a norm; it is here to be copied. It reads in the order in
which a test is evaluated: job keys, requirements, formulas, graph, and last the standard that joins them.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import Annotated

import numpy as np
from pydantic import Field

from zlmreport.plugin import (
    Approach,
    Evaluation,
    Figure,
    FloatArray,
    MeasurementSet,
    Options,
    Words,
    hookimpl,
)
from zlmreport.plugin.standard import (
    LIMIT_ROLES,
    MEAN_ROLES,
    Arithmetic,
    Basis,
    Bracket,
    Diagram,
    Finding,
    PositionQuantity,
    PositionStatistics,
    Quantity,
    QuantityGroup,
    Standard,
    alternative_text,
    both_directions,
    diagram_panel,
    graph_in_words,
    largest_over_positions,
    marks_in_words,
    no_missing_readings,
    number_of_runs,
    positions_in_all,
    range_in_words,
    worst_position,
)


class HouseAcceptanceOptions(Options):
    """The job keys of HA-1: ``{standard: house:ha-1, weight: 1.0}``."""

    weight: Annotated[float, Field(gt=0, allow_inf_nan=False)] = Field(
        0.5, description="Weight k of the range in the total T: 0.5 for roughing, 1 for finishing machines."
    )


_DEVIATION = Quantity(
    symbol="D",
    notation="D",
    name=Words(en="largest mean deviation", de="größte mittlere Abweichung"),
    group=QuantityGroup.SYSTEMATIC,
    formula="max(|x̄_{i}↑|, |x̄_{i}↓|)",
    meaning=Words(
        en="how far a feature may on average lie from where the program puts it",
        de="wie weit ein Formelement im Mittel von seiner programmierten Lage entfernt sein kann",
    ),
)
_HYSTERESIS = Quantity(
    symbol="H",
    notation="H",
    name=Words(en="largest reversal", de="größte Umkehrspanne"),
    group=QuantityGroup.SYSTEMATIC,
    formula="max|x̄_{i}↑ − x̄_{i}↓|",
    meaning=Words(
        en="the step left on a surface where the axis turns round",
        de="die Stufe, die beim Umkehren der Achse auf einer Fläche bleibt",
    ),
)
_WIDTH = Quantity(
    symbol="W",
    notation="W",
    name=Words(en="largest range of readings", de="größte Spannweite der Messwerte"),
    group=QuantityGroup.RANDOM,
    formula="max(w_{i}↑, w_{i}↓)",
    meaning=Words(
        en="by how much parts differ that are made one after the other",
        de="um wie viel nacheinander gefertigte Teile voneinander abweichen",
    ),
)
_TOTAL = Quantity(
    symbol="T",
    notation="T",
    name=Words(en="weighted total deviation", de="gewichtete Gesamtabweichung"),
    group=QuantityGroup.COMPOSITE,
    formula="max(|x̄_{i}↑| + k·w_{i}↑, |x̄_{i}↓| + k·w_{i}↓)",
    meaning=Words(
        en="the deviation to expect of a single part",
        de="die Abweichung, mit der bei einem einzelnen Teil gerechnet wird",
    ),
)
_WIDTH_POSITIVE = PositionQuantity(
    "range_fwd",
    "w_{i}↑",
    Words(en="range of readings, positive approach", de="Spannweite, positive Richtung"),
)
_WIDTH_NEGATIVE = PositionQuantity(
    "range_bwd",
    "w_{i}↓",
    Words(en="range of readings, negative approach", de="Spannweite, negative Richtung"),
)


def range_of_readings(statistics: PositionStatistics) -> FloatArray:
    """Return w_i, the largest minus the smallest of two or more readings, (..., approach, position)."""
    highest = np.fmax.reduce(statistics.deviations, axis=-1)
    lowest = np.fmin.reduce(statistics.deviations, axis=-1)
    return np.where(statistics.count > 1, highest - lowest, np.nan)


def _largest_of_all(values: FloatArray) -> FloatArray:
    """Return the largest value over both approaches: (..., approach, position) to (...)."""
    return largest_over_positions(largest_over_positions(values))


def _draw_figure(evaluation: Evaluation, weight: float) -> Figure:
    """Return the graph: both means with their weighted ranges, D and T from zero, H at its target."""
    diagram = Diagram(evaluation)
    statistics = evaluation.statistics
    mean = statistics.mean
    half_width = weight * range_of_readings(statistics)
    shown = diagram_panel(
        curves=[
            diagram.curve(f"x̄_{{i}}{each.arrow}", MEAN_ROLES[each], mean[each.index])
            for each in diagram.approaches
        ],
        bands=[
            diagram.band(
                f"x̄_{{i}}{each.arrow} ± k·w_{{i}}{each.arrow}",
                LIMIT_ROLES[each],
                mean[each.index] - half_width[each.index],
                mean[each.index] + half_width[each.index],
            )
            for each in diagram.approaches
        ],
        readings=diagram.readings(),
        arrows=[
            diagram.arrow(
                _HYSTERESIS.notation,
                worst_position(np.abs(statistics.reversal_value)),
                statistics.mean_positive,
                statistics.mean_negative,
            )
        ],
        brackets=[
            _from_zero(diagram, _DEVIATION, mean),
            _from_zero(diagram, _TOTAL, mean + np.copysign(half_width, mean)),
        ],
    )
    title = Words(
        en="Axis {axis}: mean deviations with their weighted ranges",
        de="Achse {axis}: mittlere Abweichungen mit gewichteter Spannweite",
    )
    alternative = alternative_text(
        graph_in_words(evaluation),
        range_in_words(diagram.axis, Words(en="Mean deviations", de="Mittlere Abweichungen"), mean),
        marks_in_words(diagram.axis, (*shown.arrows, *shown.brackets)),
    )
    return diagram.figure("acceptance", title.given(axis=diagram.axis.name), alternative, [shown])


def _from_zero(diagram: Diagram, quantity: Quantity, values: FloatArray) -> Bracket | None:
    """Return a quantity as a bracket from zero to the value, (approach, position), farthest from it."""
    farthest = worst_position(np.abs(values).ravel())
    end = np.where(np.arange(values.size).reshape(values.shape) == farthest, values, np.nan)
    return diagram.bracket(quantity.symbol, np.minimum(end, 0.0), np.maximum(end, 0.0))


class HouseAcceptance:
    """House acceptance HA-1 (`zlmreport.plugin.protocols.Standard`)."""

    identifier = "house:ha-1"
    designation = "HA-1"
    title = Words(en="House acceptance of machine axes", de="Werksabnahme von Maschinenachsen")
    position_index = "i"
    options: type[Options] = HouseAcceptanceOptions
    quantities: tuple[Quantity, ...] = (_DEVIATION, _HYSTERESIS, _WIDTH, _TOTAL)
    position_quantities: tuple[PositionQuantity, ...] = (_WIDTH_POSITIVE, _WIDTH_NEGATIVE)
    notes: tuple[Words, ...] = (
        Words(
            en="w is the range of the readings of one approach at one target; k is the weight that the job "
            "states.",
            de="w ist die Spannweite der Messwerte einer Anfahrrichtung an einer Sollposition; k ist das im "
            "Auftrag angegebene Gewicht.",
        ),
    )

    def requirements(
        self, measurements: MeasurementSet, options: HouseAcceptanceOptions
    ) -> Iterable[Finding]:
        """Ask for five targets and three runs in both directions, for finishing machines five runs.

        The rule is ours, so its requirements are PUBLISHED: printed as its word.
        """
        yield positions_in_all(measurements, 5, Basis.PUBLISHED)
        yield number_of_runs(measurements, 3 if options.weight < 1 else 5, Basis.PUBLISHED)
        without_reversal = Words(en="H is not evaluated", de="H wird nicht ermittelt")
        yield both_directions(measurements, without_reversal, Basis.PUBLISHED)
        yield no_missing_readings(measurements)

    def arithmetic(self, statistics: PositionStatistics, options: HouseAcceptanceOptions) -> Arithmetic:
        """Return D, H, W and T of the axis, and the ranges by position."""
        ranges = range_of_readings(statistics)
        return Arithmetic(
            parameters={
                "D": _largest_of_all(np.abs(statistics.mean)),
                "H": largest_over_positions(np.abs(statistics.reversal_value)),
                "W": _largest_of_all(ranges),
                "T": _largest_of_all(np.abs(statistics.mean) + options.weight * ranges),
            },
            positions={
                "range_fwd": ranges[..., Approach.POSITIVE.index, :],
                "range_bwd": ranges[..., Approach.NEGATIVE.index, :],
            },
        )

    def figures(self, evaluation: Evaluation, options: HouseAcceptanceOptions) -> Iterable[Figure]:
        """Return the acceptance graph, where there is anything to show."""
        if evaluation.parameters:
            yield _draw_figure(evaluation, options.weight)


@hookimpl
def zlmreport_standards() -> Iterable[Standard]:
    """Return the standards that this plugin evaluates by."""
    return [HouseAcceptance()]
