"""What stands beside the graphs: error, effects with parameters, the fall of the error, the standards."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import asdict, dataclass
from typing import Any

import numpy as np

from zlmreport import pipeline
from zlmreport.certificate.conformity import STATEMENTS
from zlmreport.certificate.model_tables import unit_symbol
from zlmreport.certificate.rounding import written
from zlmreport.certificate.scribe import NOTHING, Scribe
from zlmreport.evaluation.evaluation import Parameter
from zlmreport.evaluation.statistics import position_statistics
from zlmreport.language import Language, Words
from zlmreport.model import wording
from zlmreport.model.design import Design
from zlmreport.model.diagnosis import ErrorNumbers
from zlmreport.model.effect import Shape, unit_of
from zlmreport.model.estimate import Estimate
from zlmreport.model.study import BY_TABLE, Fitted, corrected, moves_with_time
from zlmreport.plugins import Registry
from zlmreport.quantities.formatting import general_number
from zlmreport.quantities.notation import spans
from zlmreport.quantities.uncertain import rounded_pair
from zlmreport.web.bench import Loaded

_RMS = Words(en="Root mean square", de="Quadratischer Mittelwert")
_FLOOR = Words(en="Noise floor", de="Grundrauschen")
_LEFT_OUT = Words(en="Runs left out", de="Durchläufe ausgelassen")
_MOVES = Words(
    en="Not fixed in position, so no table of positions takes it away: {effects}.",
    de="Nicht an die Position gebunden, eine Positionstabelle nimmt es also nicht weg: {effects}.",
)


@dataclass(frozen=True, slots=True)
class Panels:
    """Writes the panels of a page in one language.

    Attributes
    ----------
    loaded
        The job with its readings.
    registry
        The installed plugins.
    history
        The model, effect by effect.
    language
        Of the page.
    """

    loaded: Loaded
    registry: Registry
    history: Sequence[Fitted]
    language: Language

    @property
    def design(self) -> Design:
        """The test."""
        return self.history[-1].fit.design

    @property
    def scribe(self) -> Scribe:
        """Writes as the certificate does."""
        return Scribe.of(self.loaded.measurements, self.language)

    def say(self, words: Words) -> str:
        """Return words in the language of the page."""
        return words.in_language(self.language)

    def error(self) -> list[dict[str, str]]:
        """Return how far model and readings are apart, number by number."""
        return list(error_numbers(self.history[-1].error, self.design, self.language))

    def effects(self) -> list[dict[str, Any]]:
        """Return the effects of the model with their parameters."""
        fit = self.history[-1].fit
        return [
            {
                "effect": term.effect.identifier,
                "title": self.say(term.effect.title),
                "equation": symbol(term.effect.equation),
                "parameters": [
                    parameter(each, self.design, self.language) | {"fixed": each.parameter.name in term.fixed}
                    for each in fit.estimates
                    if each.effect == term.effect.identifier
                ],
            }
            for term in fit.model.terms
        ]

    def others(self) -> list[dict[str, str]]:
        """Return the installed effects that do not stand in the model, and can be tried on this test."""
        present = set(self.history[-1].fit.model.identifiers)
        return [
            {"effect": each.identifier, "title": self.say(each.title)}
            for each in self.registry.effects
            if each.identifier not in present and each.untestable(self.design) is None
        ]

    def fall(self) -> dict[str, Any]:
        """Return how the error fell, effect by effect, down to the noise floor."""
        unit = self.design.axis.deviation_unit
        largest = max(each.error.rms for each in self.history) or 1.0
        names = ["", *self.history[-1].fit.model.identifiers]
        floor = self.history[-1].error.noise_rms
        return {
            "unit": unit.symbol,
            "rows": [
                {
                    "effect": name,
                    "rms": self._number(each.error.rms),
                    "share": each.error.rms / largest,
                    "left_out": self._number(each.error.cross_validated_rms),
                }
                for name, each in zip(names, self.history, strict=True)
            ],
            "floor": None
            if floor is None
            else {"rms": self._number(floor), "share": min(1.0, floor / largest)},
        }

    def standards(self) -> list[dict[str, Any]]:
        """Return the parameters of each standard: now, by a table of positions, and by the whole model."""
        study, whole = self.loaded.study, self.history[-1].fit
        tests = [
            corrected(study.measurements, study.observed, whole, shapes)
            for shapes in (BY_TABLE, frozenset(Shape))
        ]
        statistics = position_statistics(np.stack([test.deviations() for test in tests]))
        found = []
        for (standard, options), evaluated in zip(
            pipeline.standards(self.loaded.job, self.registry), self.loaded.evaluated, strict=True
        ):
            forecast = standard.arithmetic(statistics, options).parameters
            parameters = evaluated.evaluation.parameters
            found.append(
                {
                    "designation": evaluated.evaluation.designation,
                    "unit": self.scribe.deviation_unit.symbol,
                    "rows": [self._row(each, forecast[each.quantity.symbol]) for each in parameters],
                    "unmet": [
                        f"{self.say(finding.requirement)}: {self.say(finding.found)}"
                        for finding in evaluated.evaluation.findings
                        if finding.met is False
                    ],
                }
            )
        return found

    def moving(self) -> str:
        """Return the sentence on effects that no table takes away; empty if there are none."""
        moving = moves_with_time(self.history[-1].fit)
        return self.say(_MOVES.given(effects=", ".join(moving))) if moving else ""

    def excluded(self) -> list[dict[str, str]]:
        """Return the readings that the job sets aside, each with its value and the reason."""
        position, unit = self.scribe.position_unit.symbol, self.scribe.deviation_unit.symbol
        return [
            {
                "reading": f"{self.scribe.position(each.target_position)} {position} {each.approach.arrow}",
                "run": str(each.run),
                "deviation": f"{self.scribe.deviation(each.deviation)} {unit}",
                "reason": each.reason,
            }
            for each in self.loaded.measurements.provenance.exclusions
        ]

    def _row(self, parameter: Parameter, forecast: Any) -> dict[str, Any]:
        scribe, quantity = self.scribe, parameter.quantity
        value, uncertainty = written(parameter, scribe)
        by_table, by_model = (quantity.printed_sign * float(value) for value in forecast)
        decision = parameter.decision
        return {
            "symbol": symbol(quantity.notation),
            "name": self.say(quantity.name),
            "value": value,
            "uncertainty": "" if uncertainty == NOTHING else uncertainty,
            "limit": NOTHING if parameter.limit is None else scribe.deviation(parameter.limit),
            "verdict": "" if decision is None else self.say(STATEMENTS[decision.conformity][1]),
            "mark": "" if decision is None else STATEMENTS[decision.conformity][0].name.lower(),
            "by_table": scribe.deviation(by_table),
            "by_model": scribe.deviation(by_model),
        }

    def _number(self, value: float | None) -> str:
        if value is None or math.isnan(value):
            return NOTHING
        return self.say(wording.significant(self.design.axis.deviation_unit.from_si(value)))


def error_numbers(error: ErrorNumbers, design: Design, language: Language) -> Iterator[dict[str, str]]:
    """Yield how far model and readings are apart: name and value."""
    for name, value in ((_RMS, error.rms), (_FLOOR, error.noise_rms), (_LEFT_OUT, error.cross_validated_rms)):
        if value is not None:
            yield {
                "name": name.in_language(language),
                "value": wording.deviation(design.axis, value).in_language(language),
            }
    if error.chi2_per_dof is not None:
        yield {"name": "χ²/ν", "value": wording.significant(error.chi2_per_dof).in_language(language)}


def parameter(estimate: Estimate, design: Design, language: Language) -> dict[str, Any]:
    """Return a parameter as a page shows it, rounded to what is known."""
    sign, own = language.decimal_sign, estimate.parameter
    unit = unit_of(own.dimension, design.axis.kind, time_is_counted=design.time_is_counted)
    value, half = rounded_pair(
        estimate.value * unit.per_si, estimate.expanded_uncertainty * unit.per_si, sign
    )
    if estimate.is_given:
        value, half = general_number(estimate.value * unit.per_si, sign), ""
    expected = estimate.expected
    return {
        "name": own.name,
        "symbol": symbol(own.notation),
        "description": own.description.in_language(language),
        "value": value,
        "number": float(f"{estimate.value * unit.per_si:.6g}") if estimate.is_given else _plain(value),
        "uncertainty": half,
        "unit": unit_symbol(unit, language),
        "given": estimate.is_given,
        "plausibility": estimate.plausibility(time_is_counted=design.time_is_counted).name.lower(),
        "expected": "" if expected is None else general_number(expected * unit.per_si, sign),
    }


def _plain(printed: str) -> float:
    """Return a printed value as a number: what is fixed is what was shown."""
    return float(printed.replace("−", "-").replace(",", "."))


def symbol(notation: str) -> list[dict[str, Any]]:
    """Return a notation as stretches that are set alike."""
    return [asdict(each) for each in spans(notation)]
