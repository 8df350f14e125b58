"""Decision rules with guard bands and risk: whether a value keeps its limit, given its uncertainty.

A limit binds the amount of a value: |y| ≤ TL. A decision rule keeps a guard band w from the limit, accepts
up to TL − w, and says what is stated beyond (ILAC-G8:09/2019; JCGM 106:2012, clauses 7 and 8).
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from enum import Enum
from typing import TypeAlias

from zlmreport.evaluation.evaluation import Conformity, Decision, EvaluatedParameter, Evaluation, Finding
from zlmreport.language import Words
from zlmreport.language.formatting import write_plain

#: Binary doubles cannot hold 1 µm and 3 µm exactly: a range of exactly 2 µm must not fail a limit of 2 µm.
_ROUNDING_OF_DOUBLES = 1e-9

_ROOM = Words("A measurement uncertainty that leaves room for conformity with the limit of {symbol}")
_NO_ROOM = Words("the guard band is as wide as the limit: no value of {symbol} could conform")
_WIDE = Words("U of {symbol} is larger than the limit: the statement says next to nothing")

_UNDECIDED = Decision(Conformity.UNDECIDED, None, None, None)
#: What is stated between TL − w and TL, and between TL and TL + w.
_Between: TypeAlias = tuple[Conformity, Conformity]


class Guard(Enum):
    """In what a guard band is counted: u, or U = k·u."""

    STANDARD_UNCERTAINTY = "u"
    EXPANDED_UNCERTAINTY = "U"


@dataclass(frozen=True, slots=True)
class DecisionRule:
    """How values are held against their limits."""

    identifier: str  #: As jobs name it.
    factor: float = 0.0  #: Width of the guard band, in units of `guard`; 0 for simple acceptance.
    guard: Guard = Guard.EXPANDED_UNCERTAINTY  #: In what it is counted.
    #: What is stated on either side of the limit inside the guard band; None where a value beyond the
    #: acceptance limit fails.
    between: _Between | None = None

    def decide(
        self, parameter: EvaluatedParameter, *, uncertainty_is_complete: bool = True
    ) -> Decision | None:
        """Return what the rule says of a parameter; None without a limit.

        A rule that uses U decides nothing where U is not known or not complete; simple acceptance decides by
        the value alone, and an incomplete U tells no risk.
        """
        limit = parameter.limit
        if limit is None:
            return None
        uncertainty = parameter.standard_uncertainty if uncertainty_is_complete else None
        if uncertainty is None and self.factor:
            return _UNDECIDED
        width = self.factor * self._choose_unit(parameter) if self.factor else 0.0
        conformity = self._find_conformity(abs(parameter.value), limit, width)
        if self._is_reversed_by_correction(parameter, limit, conformity):
            conformity = Conformity.UNDECIDED  # by a value that is known to be wrong nothing is stated
        risk = None if uncertainty is None else _compute_risk(parameter, limit, conformity)
        return Decision(conformity, limit - width, limit + width if self.between else limit - width, risk)

    def _is_reversed_by_correction(
        self, parameter: EvaluatedParameter, limit: float, conformity: Conformity
    ) -> bool:
        """Return whether a value without its known error would have the contrary stated of it."""
        if not parameter.known_error or conformity.conforms is None:
            return False
        unit = (parameter.standard_uncertainty or 0.0) if self.factor else 0.0
        if self.guard is Guard.EXPANDED_UNCERTAINTY:
            unit *= parameter.coverage_factor or 0.0
        corrected = abs(parameter.value + parameter.known_error)
        right = self._find_conformity(corrected, limit, self.factor * unit)
        return right.conforms is not None and right.conforms is not conformity.conforms

    def _choose_unit(self, parameter: EvaluatedParameter) -> float:
        """Return what the guard band is counted in; a known error is in it whole, however it is counted."""
        if self.guard is Guard.EXPANDED_UNCERTAINTY:
            return parameter.expanded_uncertainty or 0.0
        return (parameter.standard_uncertainty or 0.0) + abs(parameter.known_error) / self.factor

    def _find_conformity(self, amount: float, limit: float, width: float) -> Conformity:
        tolerated = limit * _ROUNDING_OF_DOUBLES
        if amount <= limit - width + tolerated:
            return Conformity.MET
        if self.between is None or amount > limit + width + tolerated:
            return Conformity.FAILED
        below, above = self.between
        return below if amount <= limit + tolerated else above


def make_decision_rule(identifier: str, factor: float = 1.0) -> DecisionRule:
    """Return a rule.

    Parameters
    ----------
    identifier
        ``simple``, ``guard-band``, ``iso14253-1`` or ``non-binary``.
    factor
        r of the guard band r·U; of ``guard-band`` only.
    """
    conditional = (Conformity.CONDITIONALLY_MET, Conformity.CONDITIONALLY_FAILED)
    undecided = (Conformity.UNDECIDED, Conformity.UNDECIDED)
    return {
        "simple": DecisionRule("simple"),
        "guard-band": DecisionRule("guard-band", factor),
        "iso14253-1": DecisionRule("iso14253-1", 1.65, Guard.STANDARD_UNCERTAINTY, undecided),
        "non-binary": DecisionRule("non-binary", 1.0, between=conditional),
    }[identifier]


def with_decisions(evaluation: Evaluation, rule: DecisionRule) -> Evaluation:
    """Return an evaluation with what the rule says of every parameter that has a limit."""
    complete = evaluation.uncertainty_is_complete
    undecided = {symbol for each in evaluation.findings for symbol in each.undecided}
    parameters = tuple(
        replace(each, decision=_UNDECIDED)
        if each.limit is not None and each.quantity.symbol in undecided
        else replace(each, decision=rule.decide(each, uncertainty_is_complete=complete))
        for each in evaluation.parameters
    )
    impossible = [_make_finding(each, _NO_ROOM) for each in parameters if _is_accepting_nothing(each)]
    is_by_value = complete and not rule.factor
    wide = [_make_finding(each, _WIDE) for each in parameters if is_by_value and _is_wide(each)]
    return replace(evaluation, parameters=parameters, findings=(*evaluation.findings, *impossible, *wide))


def _is_accepting_nothing(parameter: EvaluatedParameter) -> bool:
    accepted = None if parameter.decision is None else parameter.decision.acceptance_limit
    return accepted is not None and accepted < 0


def _is_wide(parameter: EvaluatedParameter) -> bool:
    expanded = parameter.expanded_uncertainty
    return expanded is not None and parameter.limit is not None and expanded > parameter.limit


def _make_finding(parameter: EvaluatedParameter, found: Words) -> Finding:
    symbol = write_plain(parameter.quantity.notation)
    return Finding(_ROOM.given(symbol=symbol), found.given(symbol=symbol), met=False)


def _compute_risk(parameter: EvaluatedParameter, limit: float, conformity: Conformity) -> float | None:
    """Return the probability that a statement is wrong, for a normal distribution that U holds as U is held.

    About the value without its known errors. 95.45 % of it lie within U, as of the simulated errors; where
    these are packed more closely (k < 2) its standard deviation is not u, but U/2.
    """
    conforms = conformity.conforms
    standard, factor = parameter.standard_uncertainty, parameter.coverage_factor
    if conforms is None or standard is None or factor is None:
        return None
    value = parameter.value + parameter.known_error
    within = _compute_chance_within(value, limit, standard * min(factor, 2.0) / 2.0)
    return 1.0 - within if conforms else within


def _compute_chance_within(value: float, limit: float, uncertainty: float) -> float:
    """Return the probability that a normal variable lies within ± limit."""
    if uncertainty == 0:
        return float(abs(value) <= limit * (1 + _ROUNDING_OF_DOUBLES))
    scale = uncertainty * math.sqrt(2.0)
    return 0.5 * (math.erf((limit - value) / scale) + math.erf((limit + value) / scale))
