"""Certificates to typeset: every kind of block, in both languages, from one simulated axis."""

from __future__ import annotations

import datetime as dt
import random
from collections.abc import Iterable
from dataclasses import replace
from io import BytesIO

import numpy as np
from PIL import Image

from zlmreport.document.certificate.document import Party
from zlmreport.document.figures.figure import PlottedReadings
from zlmreport.measurement.arrays import read_only_integers
from zlmreport.plugin import (
    Approach,
    Axis,
    AxisKind,
    Evaluation,
    Figure,
    Language,
    MeasurementSet,
    Options,
    Words,
    fixed_number,
    read_only_floats,
)
from zlmreport.plugin.renderer import (
    Align,
    Block,
    Certificate,
    Column,
    Facts,
    Formulas,
    Graph,
    Letterhead,
    Mark,
    Notice,
    PageWords,
    Paragraph,
    RowGroup,
    Section,
    Symbol,
    Table,
    Verdict,
)
from zlmreport.plugin.source import Provenance, SourceFile
from zlmreport.plugin.standard import (
    Arithmetic,
    Arrow,
    Band,
    Basis,
    Bracket,
    Curve,
    Finding,
    Panel,
    PositionQuantity,
    PositionStatistics,
    Quantity,
    QuantityGroup,
    Role,
    decided,
    decision_rule,
    evaluate,
)

TARGETS = 21
RUNS = 5
NUMBER = "CAL-2026-0117"


class SampleStandard:
    """A standard with two parameters and one column of its own."""

    identifier = "sample:2026"
    designation = "SAMPLE 1:2026"
    position_index = "i"
    title = Words("Sample of a standard", "Muster einer Norm")
    options = Options
    quantities = (
        Quantity(
            "M",
            "M",
            Words(
                "Range of the mean bidirectional deviation", "Spanne der mittleren beidseitigen Abweichung"
            ),
            QuantityGroup.SYSTEMATIC,
            "max[x̄_{i}] − min[x̄_{i}]",
            Words("The mean error of a part.", "Der mittlere Fehler eines Teils."),
        ),
        Quantity(
            "R_fwd",
            "R↑",
            Words("Unidirectional repeatability", "Einseitige Wiederholpräzision"),
            QuantityGroup.RANDOM,
            "max[4s_{i}↑]",
            Words("The scatter of parts.", "Die Streuung von Teilen."),
        ),
        Quantity(
            "B",
            "B",
            Words("Reversal value", "Umkehrspanne"),
            QuantityGroup.SYSTEMATIC,
            "max[|B_{i}|]",
            Words("The backlash.", "Das Umkehrspiel."),
        ),
    )
    position_quantities = (
        PositionQuantity("R_i_fwd", "R_{i}↑", Words("Repeatability", "Wiederholpräzision")),
    )
    notes = (Words("Formulas as printed.", "Formeln wie gedruckt."),)

    def requirements(self, measurements: MeasurementSet, options: Options) -> Iterable[Finding]:  # noqa: ARG002 (the protocol's)
        yield Finding(
            Words("at least five target positions", "mindestens fünf Zielpositionen"),
            Words("{n} target positions", "{n} Zielpositionen").given(n=len(measurements.target_positions)),
            met=True,
            basis=Basis.PUBLISHED,
        )
        yield Finding(
            Words("random spacing", "unregelmäßige Abstände"),
            Words("equal spacing", "gleiche Abstände"),
            met=False,
        )
        yield Finding(Words("warm-up", "Warmlauf"), Words("not stated", "nicht angegeben"), met=None)

    def arithmetic(self, statistics: PositionStatistics, options: Options) -> Arithmetic:  # noqa: ARG002 (the protocol's)
        mean = statistics.mean_bidirectional
        repeatability = 4 * statistics.s_positive
        return Arithmetic(
            parameters={
                "M": mean.max(axis=-1) - mean.min(axis=-1),
                "R_fwd": repeatability.max(axis=-1),
                "B": np.abs(statistics.reversal_value).max(axis=-1),
            },
            positions={"R_i_fwd": repeatability},
        )


def measurements(
    targets: int = TARGETS,
    runs: int = RUNS,
    approaches: tuple[Approach, ...] = (Approach.POSITIVE, Approach.NEGATIVE),
    kind: AxisKind = AxisKind.LINEAR,
    missing: tuple[int, ...] = (),
) -> MeasurementSet:
    """Simulated readings of the linear method; `missing` are indices of readings without a value."""
    dice = random.Random(230)
    axis = Axis("X", kind, travel=(0.0, 1.0))
    positions = [axis.position_unit.to_si(50.0 * i) for i in range(targets)]
    rows = []
    for run in range(1, runs + 1):
        for approach in approaches:
            order = range(targets) if approach is Approach.POSITIVE else reversed(range(targets))
            rows.extend((i, int(approach), run) for i in order)
    deviation = [
        axis.deviation_unit.to_si(
            round(0.55 * i + 3 * np.sin(i / 2.5) + 1.2 * a + dice.gauss(0.0, 0.6) - 2.5, 1)
        )
        for i, a, _ in rows
    ]
    for index in missing:
        deviation[index] = float("nan")
    return MeasurementSet(
        axis=axis,
        target_positions=read_only_floats(positions),
        target=read_only_integers([i for i, _, _ in rows]),
        approach=read_only_integers([a for _, a, _ in rows]),
        run=read_only_integers([r for _, _, r in rows]),
        deviation=read_only_floats(deviation),
        provenance=Provenance(
            "laser-csv",
            (
                SourceFile(
                    "x-axis.csv", "9f86d081884c7d659a2feaa0c55ad015a3bf4f1b2b0b822cd15d6c15b0f00a08", 4711
                ),
            ),
            (Words("decimal point, comma between cells", "Dezimalpunkt, Komma zwischen den Zellen"),),
        ),
    )


def evaluation(readings: MeasurementSet) -> Evaluation:
    """The sample standard's evaluation, with a limit that is kept and one that is not."""
    unit = readings.axis.deviation_unit
    limits = {"M": unit.to_si(20.0), "R_fwd": unit.to_si(1.5)}
    return decided(evaluate(SampleStandard(), readings, Options(), limits), decision_rule("simple"))


def figure(result: Evaluation, key: str = "means") -> Figure:
    """A graph with every kind of mark."""
    readings = result.measurements
    unit = readings.axis.deviation_unit
    x = readings.axis.position_unit.from_si(readings.target_positions)
    forward = unit.from_si(result.statistics.mean_positive)
    backward = unit.from_si(result.statistics.mean_negative)
    both = unit.from_si(result.statistics.mean_bidirectional)
    spread = 2 * unit.from_si(result.statistics.s_positive)
    worst = int(np.argmax(np.abs(forward - backward)))
    return Figure(
        key=key,
        title=Words(
            "Mean deviations, spread and reversal value of the axis",
            "Mittlere Abweichungen, Streuung und Umkehrspanne der Achse",
        ),
        alternative=Words(
            "Deviation over target position; the mean lies between {low} and {high} µm.",
            "Abweichung über der Zielposition; der Mittelwert liegt zwischen {low} und {high} µm.",
        ).given(low=float(both.min()), high=float(both.max())),
        x_title=Words("Target position", "Zielposition"),
        y_title=Words("Deviation", "Abweichung"),
        x_unit=readings.axis.position_unit.symbol,
        y_unit=unit.symbol,
        panels=(
            Panel(
                curves=(
                    Curve("x̄_{i}↑", Role.MEAN_POSITIVE, x, forward),
                    Curve("x̄_{i}↓", Role.MEAN_NEGATIVE, x, backward),
                    Curve("x̄_{i}", Role.MEAN_BIDIRECTIONAL, x, both),
                ),
                bands=(Band("x̄_{i}↑ ± 2s_{i}↑", Role.SPREAD, x, forward - spread, forward + spread),),
                readings=(
                    PlottedReadings(
                        Approach.POSITIVE,
                        x[readings.target[readings.approach == 1]],
                        unit.from_si(readings.deviation[readings.approach == 1]),
                    ),
                ),
                arrows=(Arrow("B_{i}", float(x[worst]), float(backward[worst]), float(forward[worst])),),
                brackets=(
                    Bracket(
                        "M",
                        float(both.min()),
                        float(both.max()),
                        float(x[both.argmin()]),
                        float(x[both.argmax()]),
                    ),
                ),
            ),
        ),
    )


def certificate(
    language: Language = Language.ENGLISH,
    paper: str = "A4",
    readings: MeasurementSet | None = None,
    standards: int = 2,
    customer: str = "Präzisionsmechanik Müller & Söhne <GmbH> & Co. KG",
    **changes: object,
) -> Certificate:
    """A certificate with every kind of block: a cover, two standards, the raw readings."""
    readings = measurements() if readings is None else readings
    result = evaluation(readings)
    writer = _Writer(language, result)
    sections = [writer.conditions()]
    sections += [writer.results(f"standard-{n + 1}") for n in range(standards)]
    sections += [writer.raw_readings()]
    document = Certificate(
        number=NUMBER,
        title=writer.say("Calibration certificate", "Kalibrierschein"),
        subtitle=writer.say("Positioning of the X axis", "Positionierung der Achse X"),
        language=language,
        issued=dt.date(2026, 11, 20),
        paper=paper,
        letterhead=Letterhead(
            Party("Laboratory for Machine Metrology", ("Bundesallee 100", "38116 Braunschweig", "Germany")),
            "DAkkS D-K-12345-01-00",
        ),
        cover=writer.cover(customer),
        sections=tuple(sections),
        page_words=PageWords(
            number=writer.say("Calibration certificate", "Kalibrierschein") + f" {NUMBER}",
            page=writer.say("Page", "Seite"),
            of=writer.say("of", "von"),
            end=writer.say("End of the calibration certificate", "Ende des Kalibrierscheins"),
            figure=writer.say("Figure", "Bild"),
            table=writer.say("Table", "Tabelle"),
        ),
        description=writer.say("Positioning by SAMPLE 1:2026", "Positionierung nach SAMPLE 1:2026"),
        measurements=readings,
        evaluations=(result,) * standards,
        generator="zlmreport 0.1.0",
        keywords=("positioning", "SAMPLE 1:2026"),
        plugins={"laser-csv": "zlmreport 0.1.0", "sample:2026": "zlmreport 0.1.0"},
    )
    return replace(document, **changes)  # type: ignore[arg-type]


def with_logo(kind: str = "png", size: tuple[int, int] = (30, 10)) -> Certificate:
    """A certificate of a laboratory that has a logo of so many pixels."""
    picture = BytesIO()
    Image.new("RGB", size, "navy").save(picture, kind)
    plain = certificate(standards=0)
    assert plain.letterhead is not None
    letterhead = replace(plain.letterhead, logo=picture.getvalue(), logo_type=f"image/{kind}")
    return replace(plain, letterhead=letterhead)


class _Writer:
    """Writes the blocks of the sample in one language."""

    def __init__(self, language: Language, result: Evaluation) -> None:
        self.language = language
        self.result = result
        self.unit = result.measurements.axis.deviation_unit
        self.position_unit = result.measurements.axis.position_unit

    def say(self, english: str, german: str) -> str:
        return german if self.language is Language.GERMAN else english

    def number(self, value: float, decimals: int = 1) -> str:
        return "–" if np.isnan(value) else fixed_number(value, decimals, self.language.decimal_sign)

    def cover(self, customer: str) -> tuple[Block, ...]:
        say = self.say
        return (
            Facts(
                (
                    (say("Customer", "Auftraggeber"), customer),
                    (say("Address", "Anschrift"), "Werkstraße 7\n70565 Stuttgart\nDeutschland"),
                )
            ),
            Facts(
                (
                    (say("Machine", "Maschine"), "Sample Works HMC 500"),
                    (say("Serial number", "Seriennummer"), "4711-0815"),
                    (say("Axis", "Achse"), say("X, linear, 0 to 1000 mm", "X, linear, 0 bis 1000 mm")),
                    (say("Condition", "Zustand"), say("in working order", "betriebsbereit")),
                ),
                say("Object", "Gegenstand"),
            ),
            Facts(
                (
                    (say("Instrument", "Messgerät"), "ZLM 800 laser interferometer"),
                    (say("Certificate", "Kalibrierschein"), "PTB 5.21-2026-033"),
                    (say("Expanded uncertainty", "Erweiterte Unsicherheit"), "0.4 µm + 0.8 µm/m · L (k = 2)"),
                ),
                say("Traceability", "Rückführung"),
            ),
            Facts(
                (
                    (say("Date of measurement", "Datum der Messung"), "2026-11-18"),
                    (say("Date of issue", "Ausstellungsdatum"), "2026-11-20"),
                    (say("Authorised by", "Freigegeben durch"), "Dr. Erika Mustermann"),
                )
            ),
            Paragraph(
                say(
                    "The results relate only to the axis described here. This certificate shall not be "
                    "reproduced except in full without approval of the laboratory.",
                    "Die Ergebnisse beziehen sich nur auf die hier beschriebene Achse. Dieser Schein "
                    "darf ohne Genehmigung des Laboratoriums nur vollständig weiterverbreitet werden.",
                )
            ),
        )

    def conditions(self) -> Section:
        say = self.say
        return Section(
            "conditions",
            say("Test conditions", "Prüfbedingungen"),
            (
                Facts(
                    (
                        (say("Method", "Verfahren"), say("linear cycle", "Linearverfahren")),
                        (say("Air temperature", "Lufttemperatur"), self.number(20.13, 2) + " °C"),
                        (say("Air pressure", "Luftdruck"), "1013,2 hPa"),
                    )
                ),
                Notice(
                    say("Deviations from the standard", "Abweichungen von der Norm"),
                    (
                        say(
                            "The target positions are equally spaced; the standard asks for random spacing.",
                            "Die Zielpositionen haben gleiche Abstände; die Norm verlangt unregelmäßige.",
                        ),
                        say("2 of 210 readings are missing.", "2 von 210 Messwerten fehlen."),
                    ),
                ),
                Table(
                    say("Requirements of the standard", "Anforderungen der Norm"),
                    (
                        Column(say("Requirement", "Anforderung")),
                        Column(say("Found", "Vorgefunden")),
                        Column(say("Met", "Erfüllt")),
                    ),
                    (
                        RowGroup(
                            tuple(
                                (
                                    finding.requirement.in_language(self.language),
                                    finding.found.in_language(self.language),
                                    self.verdict(finding.met),
                                )
                                for finding in self.result.findings
                            )
                        ),
                    ),
                ),
            ),
        )

    def verdict(self, met: bool | None) -> Verdict:
        if met is None:
            return Verdict(Mark.OPEN, self.say("not stated", "nicht angegeben"))
        if met:
            return Verdict(Mark.MET, self.say("met", "erfüllt"))
        return Verdict(Mark.NOT_MET, self.say("not met", "nicht erfüllt"))

    def results(self, key: str) -> Section:
        say = self.say
        return Section(
            key,
            say("Results by SAMPLE 1:2026", "Ergebnisse nach SAMPLE 1:2026"),
            (
                Paragraph(
                    say(
                        "The table states the parameters of the axis from the deviations that were measured.",
                        "Die Tabelle nennt die Kenngrößen der Achse aus den gemessenen Abweichungen.",
                    )
                ),
                self.results_table(),
                Graph(figure(self.result, f"{key}-means")),
                Graph(figure(self.result, f"{key}-overall")),
                Formulas(
                    say("Definitions", "Definitionen"),
                    tuple(
                        (
                            Symbol(p.quantity.notation),
                            Symbol(p.quantity.formula),
                            p.quantity.name.in_language(self.language),
                        )
                        for p in self.result.parameters
                    ),
                ),
                self.position_table(),
            ),
            new_page=True,
        )

    def results_table(self) -> Table:
        say = self.say
        headings = {
            QuantityGroup.SYSTEMATIC: say("Systematic deviations", "Systematische Abweichungen"),
            QuantityGroup.RANDOM: say("Random deviations", "Zufällige Abweichungen"),
        }
        groups = []
        for group, heading in headings.items():
            of_group = [p for p in self.result.parameters if p.quantity.group is group]
            groups.append(
                RowGroup(
                    tuple(
                        (
                            p.quantity.name.in_language(self.language),
                            Symbol(p.quantity.notation),
                            self.number(self.unit.from_si(p.value)),
                            "–" if p.limit is None else self.number(self.unit.from_si(p.limit)),
                            "–" if p.limit is None else self.verdict(p.conforms),
                        )
                        for p in of_group
                    ),
                    heading,
                    of_group[0].quantity.meaning.in_language(self.language),
                )
            )
        return Table(
            say("Parameters of the axis", "Kenngrößen der Achse"),
            (
                Column(say("Parameter", "Kenngröße")),
                Column(say("Symbol", "Zeichen")),
                Column(say("Value", "Wert"), self.unit.symbol, Align.RIGHT),
                Column(say("Limit", "Grenze"), self.unit.symbol, Align.RIGHT),
                Column(say("Conformity", "Konformität")),
            ),
            tuple(groups),
        )

    def position_table(self) -> Table:
        statistics = self.result.statistics
        unit = self.unit.from_si
        columns = [
            ("n↑", statistics.count[0].astype(float), 0),
            ("n↓", statistics.count[1].astype(float), 0),
            ("x̄_{i}↑", unit(statistics.mean_positive), 1),
            ("x̄_{i}↓", unit(statistics.mean_negative), 1),
            ("x̄_{i}", unit(statistics.mean_bidirectional), 1),
            ("s_{i}↑", unit(statistics.s_positive), 1),
            ("s_{i}↓", unit(statistics.s_negative), 1),
            ("B_{i}", unit(statistics.reversal_value), 1),
            ("R_{i}↑", 4 * unit(statistics.s_positive), 1),
            ("R_{i}↓", 4 * unit(statistics.s_negative), 1),
        ]
        positions = self.position_unit.from_si(self.result.measurements.target_positions)
        return Table(
            self.say("Table by position", "Tabelle nach Positionen"),
            (
                Column("i", align=Align.RIGHT),
                Column(Symbol("P_{i}"), self.position_unit.symbol, Align.RIGHT),
                *(
                    Column(Symbol(notation), self.unit.symbol if decimals else "", Align.RIGHT)
                    for notation, _, decimals in columns
                ),
            ),
            (
                RowGroup(
                    tuple(
                        (
                            str(i + 1),
                            self.number(float(position), 3),
                            *(self.number(float(values[i]), decimals) for _, values, decimals in columns),
                        )
                        for i, position in enumerate(positions)
                    )
                ),
            ),
            dense=True,
        )

    def raw_readings(self) -> Section:
        readings = self.result.measurements
        grid = self.unit.from_si(readings.deviations())
        positions = self.position_unit.from_si(readings.target_positions)
        runs = readings.runs
        return Section(
            "readings",
            self.say("Readings", "Messwerte"),
            (
                Table(
                    self.say("Deviations, all readings", "Abweichungen, alle Messwerte"),
                    (
                        Column(Symbol("P_{i}"), self.position_unit.symbol, Align.RIGHT),
                        *(
                            Column(Symbol(f"x_{{i{run}}}{approach.arrow}"), self.unit.symbol, Align.RIGHT)
                            for approach in Approach
                            for run in runs
                        ),
                    ),
                    (
                        RowGroup(
                            tuple(
                                (
                                    self.number(float(position), 3),
                                    *(
                                        self.number(float(grid[approach.index, i, j]))
                                        for approach in Approach
                                        for j in range(len(runs))
                                    ),
                                )
                                for i, position in enumerate(positions)
                            )
                        ),
                    ),
                    dense=True,
                ),
            ),
        )
