"""The NMTBA recommendation of 1972 for machine tools."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from zlmreport.plugin import (
    Arithmetic,
    Basis,
    Evaluation,
    Figure,
    Finding,
    MeasurementSet,
    Options,
    PositionQuantity,
    PositionStatistics,
    Quantity,
    QuantityGroup,
    Standard,
    Words,
    both_directions,
    hookimpl,
    no_missing_readings,
    number_of_runs,
    positions_in_words,
    positions_over_travel,
    spacing_against_periods,
)
from zlmreport_plugins.standards.nmtba import figures, formulas

_MEAN = "X̄_{j}"
_HALF_SPREAD = "½P_{sj}"
_SPREAD = f"P_{{sj}} = 6√(∑[(x_{{ij}}↑ − {_MEAN})² + (x_{{ij}}↓ − {_MEAN})²] / (2z − 1))"

#: The parameters of the axis in the order of the results table.
PARAMETERS: tuple[Quantity, ...] = (
    Quantity(
        "P",
        "P",
        Words("Position uncertainty", "Positionsunsicherheit"),
        QuantityGroup.COMPOSITE,
        f"max[{_MEAN} + {_HALF_SPREAD}] − min[{_MEAN} − {_HALF_SPREAD}]",
        Words(
            "The largest error, systematic and random together, that positioning is expected to bring into a "
            "dimension of a part, whichever the direction of approach.",
            "Die größte Abweichung, systematisch und zufällig zusammen, die das Positionieren in einem Maß "
            "des Werkstücks erwarten lässt, gleich aus welcher Richtung angefahren wird.",
        ),
    ),
    Quantity(
        "Pa",
        "P_{a}",
        Words("Position deviation", "Positionsabweichung"),
        QuantityGroup.SYSTEMATIC,
        f"max[{_MEAN}] − min[{_MEAN}], {_MEAN} = 1/(2z) · ∑(x_{{ij}}↑ + x_{{ij}}↓)",
        Words(
            "The largest error of a dimension that remains on average over many like parts.",
            "Die größte Abweichung eines Maßes, die im Mittel über viele gleiche Werkstücke bleibt.",
        ),
    ),
    Quantity(
        "Ps_max",
        "P_{s max}",
        Words("Largest position spread", "Größte Positionsstreubreite"),
        QuantityGroup.RANDOM,
        f"max[P_{{sj}}], {_SPREAD}",
        Words(
            "The scatter to expect of a feature's place among like parts, the effect of the direction of "
            "approach included, at the position where it is largest.",
            "Die zu erwartende Streuung der Lage eines Formelements unter gleichen Werkstücken "
            "einschließlich des Einflusses der Anfahrrichtung, an der Position mit der größten Streuung.",
        ),
    ),
    Quantity(
        "Ps_mean",
        "P_{s mit}",
        Words("Mean position spread", "Mittlere Positionsstreubreite"),
        QuantityGroup.RANDOM,
        "(1/n) · ∑ P_{sj}",
        Words(
            "The scatter to expect of a feature's place among like parts, the effect of the direction of "
            "approach included, averaged over the positions.",
            "Die zu erwartende Streuung der Lage eines Formelements unter gleichen Werkstücken "
            "einschließlich des Einflusses der Anfahrrichtung, gemittelt über die Positionen.",
        ),
    ),
    Quantity(
        "O",
        "O",
        Words("Offset", "Nullpunktverschiebung"),
        QuantityGroup.SYSTEMATIC,
        f"−½(max[{_MEAN} + {_HALF_SPREAD}] + min[{_MEAN} − {_HALF_SPREAD}])",
        Words(
            "What to add to every deviation so that parts scatter evenly about the intended place: the band "
            "is then ± P/2.",
            "Was zu jeder Abweichung zu addieren ist, damit die Werkstücke gleichmäßig um die Solllage "
            "streuen: das Band ist dann ± P/2.",
        ),
    ),
)

#: The columns that the recommendation adds to the table by position.
BY_POSITION: tuple[PositionQuantity, ...] = (
    PositionQuantity("X", _MEAN, Words("Mean of all readings", "Mittelwert aller Messwerte")),
    PositionQuantity("Ps", "P_{sj}", Words("Position spread", "Positionsstreubreite")),
)

#: What a reader of the results must know.
NOTES: tuple[Words, ...] = (
    Words(
        "P is the full width of the band; the recommendation quotes accuracy as ± P/2 after the offset O. "
        "The limits lie three standard deviations to either side of the mean of all readings.",
        "P ist die volle Breite des Bandes; die Empfehlung gibt die Genauigkeit als ± P/2 nach der "
        "Nullpunktverschiebung O an. Die Grenzen liegen drei Standardabweichungen beiderseits des "
        "Mittelwerts aller Messwerte.",
    ),
    Words(
        "The readings of both directions form one sample (2z − 1 degrees of freedom): the reversal is part "
        "of the spread and has no parameter of its own.",
        "Die Messwerte beider Richtungen bilden eine Stichprobe (2z − 1 Freiheitsgrade): die Umkehrspanne "
        "ist Teil der Streubreite und hat keine eigene Kenngröße.",
    ),
    Words(
        "The index mit marks a mean over the positions.",
        "Der Index mit (mittel) bezeichnet ein Mittel über die Positionen.",
    ),
    Words(
        "Formulas as in the manual of the program ZLM Position, G 1.3; corrected: bar over X in the formulas "
        "of the parameters.",
        "Formeln nach dem Handbuch des Programms ZLM Position, G 1.3; berichtigt: Querstrich über X in den "
        "Formeln der Kenngrößen.",
    ),
)


class Nmtba:
    """The NMTBA recommendation of 1972."""

    identifier = "nmtba"
    designation = "NMTBA (1972)"
    position_index = "j"
    title = Words(
        "Positioning accuracy of numerically controlled machine tools",
        "Positioniergenauigkeit numerisch gesteuerter Werkzeugmaschinen",
    )
    options = Options
    quantities = PARAMETERS
    position_quantities = BY_POSITION
    notes = NOTES

    def requirements(self, measurements: MeasurementSet, options: Options) -> Iterable[Finding]:  # noqa: ARG002 - no keys of its own
        """Hold the requirements against the test."""
        return findings(measurements)

    def arithmetic(self, statistics: PositionStatistics, options: Options) -> Arithmetic:  # noqa: ARG002 - no keys of its own
        """Return the parameters, and X̄_j and P_sj by position."""
        mean = formulas.mean_deviation(statistics)
        spread = formulas.position_spread(statistics, mean)
        return Arithmetic(formulas.parameters(mean, spread), {"X": mean, "Ps": spread})

    def figures(self, evaluation: Evaluation, options: Options) -> Iterable[Figure]:  # noqa: ARG002 - no keys of its own
        """Return the two diagrams."""
        return figures.figures(evaluation)


_RUNS_FOR_A_SCATTER = 2
_ONE_DIRECTION_ONLY = Words(
    "the formulas pool both: here the readings of this direction alone are the sample",
    "die Formeln fassen beide zusammen: hier bilden die Messwerte dieser Richtung allein die Stichprobe",
)


def findings(measurements: MeasurementSet) -> Iterator[Finding]:
    """Yield the requirements, held against the test.

    The recommendation's own numbers have not been read; only what its formulas need is asked.
    """
    yield both_directions(measurements, _ONE_DIRECTION_ONLY, Basis.PUBLISHED)
    yield number_of_runs(measurements, _RUNS_FOR_A_SCATTER, Basis.APPLIED)
    yield _number_of_positions(measurements)
    yield no_missing_readings(measurements)
    yield positions_over_travel(measurements)
    yield from spacing_against_periods(measurements, Basis.APPLIED)


def _number_of_positions(measurements: MeasurementSet) -> Finding:
    """Return the open finding on the number of positions, for which no number is known."""
    requirement = Words(
        "Number of target positions as the recommendation asks",
        "Anzahl der Sollpositionen nach der Empfehlung",
    )
    found = Words(
        "{positions}; no number known to hold them against",
        "{positions}; keine Zahl bekannt, an der sie zu messen wären",
    )
    number = len(measurements.target_positions)
    return Finding(requirement, found.given(positions=positions_in_words(number)), met=None)


@hookimpl
def zlmreport_standards() -> tuple[Standard, ...]:
    """Return the one recommendation."""
    return (Nmtba(),)
