"""The estimate of the deviation at any point of the travel with its expanded uncertainty.

M. Halaj, E. Kureková, R. Palenčár and T. Loebl, The positional deviation in two axes, Fig. 2: where a
standard joins the means of the targets by straight lines, a model says what to expect between them, and how
well that is known.
"""

from __future__ import annotations

from math import sqrt

import numpy as np

from zlmreport.figures import alternatives
from zlmreport.figures.figure import Band, Curve, Figure, Panel
from zlmreport.figures.model_diagram import MODEL, UNCERTAINTY, ModelDiagram
from zlmreport.figures.prescribed import POSITION_TITLE
from zlmreport.language import Words
from zlmreport.model import wording
from zlmreport.model.design import at_positions
from zlmreport.model.effect import Shape
from zlmreport.quantities.arrays import FloatArray, read_only_floats

#: Positions at which the estimate is drawn.
_POSITIONS = 480
_GOLDEN = (sqrt(5.0) - 1.0) / 2.0

_TITLE = Words(
    en="Deviation estimated by the error model at any position of the travel, with its expanded uncertainty "
    "U (about 95 %)",
    de="Vom Fehlermodell geschätzte Abweichung an jeder Stelle des Verfahrwegs mit ihrer erweiterten "
    "Messunsicherheit U (etwa 95 %)",
)
_AT_THE_MEAN = Words(
    en="{title}; at the mean time and the mean logged conditions of the test",
    de="{title}; zur mittleren Zeit und bei den mittleren aufgezeichneten Bedingungen der Messung",
)
_ESTIMATE = Words(en="Estimate {arrow}", de="Schätzwert {arrow}")
_LARGEST = Words(
    en="The expanded uncertainty is {largest} at most.",
    de="Die erweiterte Messunsicherheit beträgt höchstens {largest}.",
)


def estimate(diagram: ModelDiagram) -> Figure:
    """Return the estimate with its uncertainty for each direction of approach, the readings behind it."""
    axis, fit = diagram.axis, diagram.fit
    positions = _scattered(*diagram.design.span)
    x = read_only_floats(axis.position_unit.from_si(positions))
    curves, bands, sentences = [], [], []
    largest = 0.0
    for approach in diagram.approaches:
        found = fit.predict(at_positions(diagram.design, positions, approach))
        value, half = found.deviation, found.expanded_uncertainty
        arrow = approach.arrow
        curves.append(Curve(f"x̂{arrow}", MODEL[approach], x, diagram.printed(value)))
        bands.append(
            Band(
                f"x̂{arrow} ± U",
                UNCERTAINTY[approach],
                x,
                diagram.printed(value - half),
                diagram.printed(value + half),
            )
        )
        sentences.append(diagram.range_sentence(_ESTIMATE.given(arrow=arrow), value))
        largest = max(largest, float(half.max()))
    moves = any(term.effect.shape in {Shape.TIME, Shape.RUN} for term in fit.model.terms)
    return diagram.figure(
        "estimate",
        _AT_THE_MEAN.given(title=_TITLE) if moves else _TITLE,
        alternatives.text(*sentences, _LARGEST.given(largest=wording.deviation(axis, largest))),
        POSITION_TITLE,
        axis.position_unit.symbol,
        Panel(
            curves=tuple(curves),
            bands=tuple(bands),
            readings=diagram.readings(diagram.positions, fit.deviation),
        ),
    )


def _scattered(first: float, last: float) -> FloatArray:
    """Return positions over the travel, each somewhere in a step of its own.

    So a period that is shorter than a step fills the breadth of its amplitude, and never passes for a longer
    one.
    """
    steps = np.arange(_POSITIONS)
    places = (steps + (steps * _GOLDEN) % 1.0) / _POSITIONS
    return read_only_floats(np.concatenate([[first], first + places[1:] * (last - first), [last]]))
