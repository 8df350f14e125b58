"""How the error falls, effect by effect, and what a standard would say if a control corrected the effects."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from zlmreport.document.blocks import Align, Column, ColumnKind, Paragraph, RowGroup, Section, Symbol, Table
from zlmreport.document.subjects.fit import say_no_table_takes_away, write_deviation
from zlmreport.document.writer import NOTHING, Writer
from zlmreport.evaluation.evaluation import Quantity, QuantityGroup
from zlmreport.evaluation.statistics import position_statistics
from zlmreport.language import Words
from zlmreport.language.numbers import write_significant
from zlmreport.measurement.arrays import FloatArray, read_only_floats
from zlmreport.model.compensation.basis import FittedModel, compensate_readings
from zlmreport.model.diagnosis.error_numbers import ErrorNumbers
from zlmreport.model.diagnosis.study import Fitted, Study, correct_by_model

if TYPE_CHECKING:
    from zlmreport.measurement.units import Unit
    from zlmreport.plugin.protocols import Standard

#: Title of the fall of the error, and the heading of its first column.
FALL, EFFECT = Words("How the error falls"), Words("Effect")
_FALL = Words(
    "How the error falls, effect by effect; the parameters of {designation} are predicted for an "
    "axis whose control corrects all effects down to the row"
)
_WITHOUT = Words("without model")
_FLOOR = Words("noise floor")
_LEFT = Words("Predicted errors after compensation, from the readings of this document")
_ORDER = (QuantityGroup.COMPOSITE, QuantityGroup.SYSTEMATIC, QuantityGroup.RANDOM)


@dataclass(frozen=True, slots=True)
class StandardForecast:
    """The parameters of a standard, predicted for a corrected axis."""

    #: standard and designation: Identifier and as printed.
    standard: str
    designation: str
    unit: Unit  #: In which deviations are printed.
    quantities: tuple[Quantity, ...]  #: The first parameter of each group: composite, systematic, random.
    #: (steps + 1,) of each parameter, by its symbol: after each step of the model's history, and with a table
    #: of the model, its rows at the targets; m or rad. NaN for what the test does not define.
    parameters: Mapping[str, FloatArray]

    @property
    def by_step(self) -> FloatArray:
        """(steps, quantities): Of the quantities; the first row is of the readings as they are."""
        return read_only_floats(self._leading[:-1])

    @property
    def by_table(self) -> FloatArray:
        """(quantities,): Of the quantities, with a table."""
        return read_only_floats(self._leading[-1])

    @property
    def _leading(self) -> FloatArray:
        return np.stack([self.parameters[quantity.symbol] for quantity in self.quantities], axis=1)


def make_forecasts(
    standards: Iterable[tuple[Standard, Any]], study: Study, history: Sequence[Fitted]
) -> tuple[StandardForecast, ...]:
    """Return the forecast by each standard; none of an error that no control corrects, such as an angle."""
    if not study.measurements.axis.measurand.is_position:
        return ()
    tests = [correct_by_model(study.measurements, study.observed, each.fit) for each in history]
    tests.append(compensate_readings(FittedModel(study.measurements, study.observed, history[-1].fit)))
    statistics = position_statistics(
        np.stack([test.deviations() for test in tests]), study.measurements.target_positions
    )
    return tuple(
        StandardForecast(
            standard.identifier,
            standard.designation,
            study.measurements.axis.deviation_unit,
            _select_leading(standard.quantities),
            standard.arithmetic(statistics, options).parameters,
        )
        for standard, options in standards
    )


def _select_leading(quantities: Sequence[Quantity]) -> tuple[Quantity, ...]:
    """Return the first quantity of each group."""
    first: dict[QuantityGroup, Quantity] = {}
    for quantity in quantities:
        first.setdefault(quantity.group, quantity)
    return tuple(first[group] for group in _ORDER if group in first)


def lay_out_fall(history: Sequence[Fitted], forecast: StandardForecast | None, writer: Writer) -> Section:
    """Return how the error fell, effect by effect, and what a standard would say after each.

    `forecast`: None of an error that no control corrects, such as a straightness.
    """
    left = say_no_table_takes_away(history[-1].fit, writer.language)
    said = [Paragraph(left)] if left else []
    return Section("fall", writer.say(FALL), (make_fall_table(history, forecast, writer), *said))


def make_fall_table(history: Sequence[Fitted], forecast: StandardForecast | None, writer: Writer) -> Table:
    """Return a row for the readings as they are, one for each effect, and the noise floor where it is known.

    Its columns are ``effect``, ``share`` (of the largest error), ``rms``, ``chi2``, ``cross_validated`` and
    one for each quantity of the forecast, by its symbol.
    """
    say, language, whole = writer.say, writer.language, history[-1]
    axis, unit = whole.fit.design.axis, writer.deviation_unit.symbol
    largest = max(each.error.rms for each in history) or 1.0
    quantities = forecast.quantities if forecast else ()
    predicted = forecast.by_step.tolist() if forecast else [()] * len(history)

    def errors(error: ErrorNumbers) -> tuple[str, ...]:
        chi2 = error.chi2_per_dof
        return (
            _share(error.rms, largest),
            write_deviation(error.rms, axis, language),
            NOTHING if chi2 is None else say(write_significant(chi2)),
            write_deviation(error.cross_validated_rms, axis, language),
        )

    columns = (
        Column(say(EFFECT), key="effect"),
        Column("", "%", Align.LEFT, "share", ColumnKind.BARS),
        Column(say(Words("RMS error")), unit, Align.RIGHT, "rms"),
        Column("χ²/ν", "", Align.RIGHT, "chi2"),
        Column(say(Words("Runs left out")), unit, Align.RIGHT, "cross_validated"),
        *(Column(Symbol(each.notation), unit, Align.RIGHT, each.symbol) for each in quantities),
    )
    names = [say(_WITHOUT), *(f"+ {name}" for name in whole.fit.model.identifiers)]
    rows = [
        (name, *errors(each.error), *map(writer.deviation, values))
        for name, each, values in zip(names, history, predicted, strict=True)
    ]
    floor = whole.error.noise_rms
    if floor is not None:
        blank = ("",) * (2 + len(quantities))
        rows.append((say(_FLOOR), _share(floor, largest), write_deviation(floor, axis, language), *blank))
    caption = say(_FALL.given(designation=forecast.designation) if forecast else FALL)
    return Table(caption, columns, (RowGroup(tuple(rows)),))


def _share(value: float, largest: float) -> str:
    return f"{min(100.0, 100.0 * value / largest):.1f}"


def lay_out_left_after_compensation(forecasts: Sequence[StandardForecast], writer: Writer) -> Table:
    """Return what a compensation would leave of the leading parameters of each standard."""
    say, unit = writer.say, writer.deviation_unit.symbol
    columns = (
        Column(say(Words("Symbol"))),
        Column(say(Words("Parameter"))),
        Column(say(Words("Measured")), unit, Align.RIGHT),
        Column(say(Words("Table of positions")), unit, Align.RIGHT),
        Column(say(Words("Whole model")), unit, Align.RIGHT),
    )
    groups = tuple(
        RowGroup(
            tuple(
                (Symbol(quantity.notation), say(quantity.name), *map(writer.deviation, map(float, values)))
                for quantity, *values in zip(
                    each.quantities, each.by_step[0], each.by_table, each.by_step[-1], strict=True
                )
            ),
            each.designation,
        )
        for each in forecasts
    )
    return Table(say(_LEFT), columns, groups)
