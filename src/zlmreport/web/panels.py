"""The values of the panels beside the graphs: error, effects, fall of the error, standards, exclusions."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import asdict, dataclass
from itertools import zip_longest
from typing import Any

from zlmreport import pipeline
from zlmreport.document.blocks import ColumnKind, Facts
from zlmreport.document.certificate.conformity import STATEMENTS
from zlmreport.document.certificate.results import Evaluated
from zlmreport.document.certificate.values import limit
from zlmreport.document.subjects.fit import (
    FLOOR,
    LEFT_OUT,
    RMS,
    ParameterRow,
    list_error_facts,
    make_parameter_rows,
    say_notes,
)
from zlmreport.document.subjects.forecast import make_fall_table, make_forecasts
from zlmreport.document.writer import NOTHING, Writer, write_with_uncertainty
from zlmreport.evaluation.evaluation import EvaluatedParameter
from zlmreport.language import Language, Words, named
from zlmreport.language.formatting import split_spans
from zlmreport.language.writer import LanguageWriter
from zlmreport.measurement.arrays import FloatArray
from zlmreport.measurement.units import with_unit
from zlmreport.model.diagnosis.study import Fitted
from zlmreport.model.effects.design import Design
from zlmreport.model.effects.effect import Effect
from zlmreport.plugin.registry import Registry
from zlmreport.web.bench import Loaded
from zlmreport.web.naming import Naming
from zlmreport.web.texts import TEXTS

_RMS_IS = Words("Root mean square of the residuals: what the model does not explain.")
_LEFT_OUT_IS = Words(
    "Each run in turn is predicted by a model that was fitted to the other runs: root mean square of what is "
    "wrong with these predictions. If it is much larger than the error, the model follows noise."
)
_CHI2_IS = Words(
    "Sum of the squared residuals in units of the noise, for each degree of freedom: about 1 "
    "where the model leaves only noise, larger where something is missing."
)


@dataclass(frozen=True, slots=True)
class Panels(LanguageWriter):
    """Writes the panels of a page in its language."""

    loaded: Loaded  #: The job with its readings.
    registry: Registry  #: The installed plugins.
    whole: Fitted  #: The whole model.

    @property
    def design(self) -> Design:
        """The test."""
        return self.whole.fit.design

    @property
    def writer(self) -> Writer:
        """Writes as the certificate does."""
        return Writer.of(self.loaded.measurements, self.language)

    @property
    def naming(self) -> Naming:
        """What effects are called."""
        return make_naming(self.whole, self.registry.effects, self.language)

    def list_error(self) -> list[dict[str, str]]:
        """Return how far model and readings are apart, number by number."""
        said = ((RMS, _RMS_IS), (FLOOR, TEXTS["noiseFloorIs"]), (LEFT_OUT, _LEFT_OUT_IS))
        meanings = {self.say(name): self.say(meaning) for name, meaning in said}
        chi2 = self.say(_CHI2_IS)
        facts = list_error_facts(self.whole.error, self.design.axis, self.language)
        return [each | {"meaning": meanings.get(each["name"], chi2)} for each in collect_errors(facts)]

    def list_effects(self) -> list[dict[str, Any]]:
        """Return the effects of the model with their parameters."""
        fit, names = self.whole.fit, self.naming
        return [
            {
                "effect": term.effect.identifier,
                "name": names.name_in(term.effect.identifier),
                "title": self.say(term.effect.title),
                "equation": split_symbol(term.effect.equation),
                "parameters": [
                    collect_parameter(each, self.language) | {"fixed": each.name in term.fixed}
                    for each in make_parameter_rows(fit, self.language)
                    if each.effect == term.effect.identifier
                ],
            }
            for term in fit.model.terms
        ]

    def list_other_effects(self) -> list[dict[str, str]]:
        """Return the installed effects that do not stand in the model, and can be tried on this test."""
        present, names = set(self.whole.fit.model.identifiers), self.naming
        return [
            {
                "effect": each.identifier,
                "name": names.name_in(each.identifier),
                "title": self.say(each.title),
            }
            for each in self.registry.effects
            if each.identifier not in present and each.untestable(self.design) is None
        ]

    def list_fall(self, history: Sequence[Fitted]) -> dict[str, Any]:
        """Return how the error fell, effect by effect, down to the noise floor."""
        table = make_fall_table(history, None, self.writer).without("chi2")
        called, effects = self.naming, self.whole.fit.model.identifiers
        of_rows = ("", *effects, "")  # the readings as they are; the noise floor
        rows = [
            {
                "effect": effect,
                "name": called.name_in(effect),
                "label": called.name_in(str(label)),
                "share": float(str(share)) / 100,
                "cells": cells,
            }
            for effect, (label, share, *cells) in zip(of_rows, table.groups[0].rows, strict=False)
        ]
        meanings = {"rms": _RMS_IS, "cross_validated": _LEFT_OUT_IS}
        return {
            "heads": [
                {
                    "text": f"{column.heading} ({column.unit})" if column.unit else column.heading,
                    "meaning": self.say(meanings[column.key]) if column.key in meanings else "",
                }
                for column in table.columns
                if column.kind is not ColumnKind.BARS
            ],
            "rows": rows[: 1 + len(effects)],
            "floor": next(iter(rows[1 + len(effects) :]), None),
        }

    def list_standards(self, results: Sequence[Evaluated]) -> list[dict[str, Any]]:
        """Return the parameters of each standard: now, by a table of positions, and by the whole model.

        `results`: Of the job's standards, in their order.
        """
        standards = pipeline.choose_standards(self.loaded.job, self.registry)
        forecasts = make_forecasts(standards, self.loaded.study, [self.whole])
        return [
            {
                "designation": each.evaluation.designation,
                "unit": self.writer.deviation_unit.symbol,
                "rows": [
                    self._make_row(
                        parameter, forecast.parameters[parameter.quantity.symbol] if forecast else None
                    )
                    for parameter in each.evaluation.parameters
                ],
                "unmet": [
                    self.say(named(finding.requirement, finding.found))
                    for finding in each.evaluation.findings
                    if finding.met is False
                ],
            }
            for each, forecast in zip_longest(results, forecasts)
        ]

    def list_excluded(self) -> list[dict[str, str]]:
        """Return the readings that the job sets aside, each with its value and the reason."""
        position, unit = self.writer.position_unit.symbol, self.writer.deviation_unit.symbol
        return [
            {
                "reading": f"{self.writer.position(each.target_position)} {position} {each.approach.arrow}",
                "run": str(each.run),
                "deviation": f"{self.writer.deviation(each.deviation)} {unit}",
                "reason": each.reason,
            }
            for each in self.loaded.measurements.provenance.exclusions
        ]

    def _make_row(self, parameter: EvaluatedParameter, forecast: FloatArray | None) -> dict[str, Any]:
        quantity, decision = parameter.quantity, parameter.decision
        writer = self.writer.of_quantity(quantity)
        value, uncertainty = write_with_uncertainty(parameter, self.writer)
        by_model, by_table = (
            (None, None) if forecast is None else (quantity.printed_sign * float(value) for value in forecast)
        )

        def write(number: str) -> str:
            """Return a number with its unit, where that is another than the panel says."""
            is_usual = writer.deviation_unit == self.writer.deviation_unit
            return (
                number if is_usual or number == NOTHING else with_unit(number, writer.deviation_unit.symbol)
            )

        return {
            "symbol": split_symbol(quantity.notation),
            "name": self.say(quantity.name),
            "value": write(value),
            "uncertainty": "" if uncertainty == NOTHING else write(uncertainty),
            "limit": write(limit(parameter, self.writer)),
            "verdict": "" if decision is None else self.say(STATEMENTS[decision.conformity][1]),
            "mark": "" if decision is None else STATEMENTS[decision.conformity][0].name.lower(),
            "by_table": None if by_table is None else write(writer.deviation(by_table)),
            "by_model": None if by_model is None else write(writer.deviation(by_model)),
        }


def make_naming(whole: Fitted, installed: Iterable[Effect], language: Language) -> Naming:
    """Return what effects are called: those that are installed, and those of the model."""
    return Naming.of((*installed, *(term.effect for term in whole.fit.model.terms)), language)


def collect_errors(facts: Facts) -> list[dict[str, str]]:
    """Return how far model and readings are apart: name and value."""
    return [{"name": name, "value": value} for name, value in facts.pairs]


def collect_parameter(row: ParameterRow, language: Language) -> dict[str, Any]:
    """Return a parameter as a page shows it."""
    return {
        "name": row.name,
        "symbol": split_symbol(row.notation),
        "description": row.description,
        "value": row.value,
        "number": row.number,
        "uncertainty": row.uncertainty,
        "unit": row.unit,
        "given": row.is_given,
        "plausibility": row.plausibility.name.lower(),
        "notes": list(say_notes(row, language)),
    }


def split_symbol(notation: str) -> list[dict[str, Any]]:
    """Return a notation as stretches that are set alike."""
    return [asdict(each) for each in split_spans(notation)]
