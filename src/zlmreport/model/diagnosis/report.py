"""The verdict of a diagnosis or a build in sentences; ``--json`` of ``zlmreport model``: it as values."""

from __future__ import annotations

import json
from collections.abc import Iterable, Mapping, Sequence
from functools import reduce
from math import isfinite
from typing import Any

import numpy as np

from zlmreport.job.formula_keys import FormulaKeys
from zlmreport.language import Language, Words, list_alternatives, list_in_words
from zlmreport.language.numbers import write_share
from zlmreport.measurement.axis import Axis
from zlmreport.model.diagnosis.building import Built
from zlmreport.model.diagnosis.candidate import Doubt, EffectCandidate, ask_about, find_doubts
from zlmreport.model.diagnosis.diagnosis import AxisDiagnosis, DiagnosisVerdict
from zlmreport.model.diagnosis.error_numbers import ErrorNumbers
from zlmreport.model.diagnosis.faults import DataFault, FaultKind
from zlmreport.model.diagnosis.fixed_numbers import FixedNumbers
from zlmreport.model.diagnosis.looking import look_for
from zlmreport.model.diagnosis.remainder import NamesInstead, Remainder, RemainderPart
from zlmreport.model.diagnosis.residuals import ResidualTest
from zlmreport.model.diagnosis.visibility import Visibility
from zlmreport.model.effects import wording
from zlmreport.model.effects.design import Design
from zlmreport.model.effects.effect import find_unit_on
from zlmreport.model.fitting.estimate import ParameterEstimate
from zlmreport.model.fitting.fit import Fit
from zlmreport.model.fitting.noise import Noise
from zlmreport.model.fitting.profile import find_intervals

SCHEMA, BUILD_SCHEMA = "zlmreport/diagnosis/1", "zlmreport/build/1"
#: Probability from which on a candidate is worth a word, and a sentence beside what has no name.
_SERIOUS, _LIKELY = 0.01, 0.8

_ADEQUATE = Words("The model describes the readings: nothing is left that their scatter does not explain.")
_MISSING = Words("Missing effect: {effects}")
_MISSING_TOGETHER = Words("Missing effects: {effects}")
_RESTS = {
    False: Words("{missing}, which explains the rest."),
    True: Words("{missing}, which together explain the rest."),
}
_IN_PART = Words("{missing}. With {many} the error falls from {before} to {after}, over a noise of {noise}.")
_WITHOUT_FLOOR = Words("{missing}. With {many} the error falls from {before} to {after}.")
_NOT_BY_ITSELF = Words("{missing}. The error is {after} with {many} and {before} without.")
_STAYS = Words("{missing}. The error stays {after} with {many}.")
_MANY = {False: Words("it"), True: Words("them")}
_BESIDE = Words("Beside that something is left without a name: {shape}, {where}; root mean square {size}.")
_ONE_OF = Words("({names})")
_GOES = Words("{statement} Then no longer needed: {effects}.")
_FAULTY = Words(
    "The data look wrong, and no cause is sought before they are right: {statement}. Remedy: {remedy}."
)
_GIVEN = Words(
    "The readings contradict what the job gives, and no cause is sought before it is right: {statements}"
)
_ADEQUATE_SO_FAR = Words(
    "The model describes the readings as far as their scatter lets it be seen: the error is {error}, over a "
    "noise of {noise}."
)
_TOO_RICH = Words(
    "The model has as many numbers that are fixed to position as there are targets, or more: it describes "
    "any readings, and that it describes these says nothing of the axis."
)
_YET = Words("{statement} Yet {failure}.")
_UNEXPLAINED = Words("Something is left that no installed effect explains.")
_SHAPE = Words(
    "Something is left that no installed effect explains: {shape}, {where}; root mean square {size}."
)
_UNSURE = Words(
    "Something is left that no installed effect explains for sure: {shape}, {where}; root mean square {size}."
)
_LIKELY_BESIDE = Words("{statement} Likely beside it, but not to be fitted without it: {chances}.")
_AND = Words("{shape}, {where}, and {further}")
_SAME_PLACE = Words("{shape}, and {further}")
_AS_LIKELY = Words("{statement} As likely it is {effects} instead.")
_MORE_LIKELY = Words("{statement} More likely, at odds of {odds}, it is {effects} instead.")
_LESS_LIKELY = Words("{statement} Less likely, at odds of {odds}, it is {effects} instead.")
_ODDS = Words("{those} to {this}")
_IN_DOUBT = Words("The data look wrong: {statement}. Remedy: {remedy}. {verdict}")
_TWO = Words("{one} {other}")
#: Tests of how readings scatter: what they find is no part of the model.
_OF_SCATTER = {ResidualTest.SPREAD, ResidualTest.OUTLIERS}
_NOT_SURE = Words("{statement} Not sure: {chances}; else another effect, or something without a name.")
_CHANCE = Words("{effects} {share} %")


def report(
    diagnosis: AxisDiagnosis,
    language: Language = Language.ENGLISH,
    experiment: Mapping[str, Any] | None = None,
) -> dict[str, Any]:
    """Return a diagnosis as plain values for a JSON file.

    `experiment`: What tells the first candidate from its equals, with these under the key ``effects``.
    """
    fitted = diagnosis.fit
    axis = fitted.design.axis
    return {
        "schema": SCHEMA,
        "model": report_model(fitted),
        "error": report_error(diagnosis.error, axis),
        "noise": report_noise(fitted.noise, axis),
        "verdict": diagnosis.verdict.value,
        "p_value": diagnosis.p_value,
        "failures": [
            {
                "test": each.test.value,
                "p_value": each.p_value,
                "where": each.where.in_language(language),
                "statement": each.statement.in_language(language),
            }
            for each in diagnosis.failures
        ],
        "candidates": [
            {
                **_collect_candidate(each, fitted.design, language),
                "experiment": experiment if experiment and each.identifier in experiment["effects"] else None,
            }
            for each in diagnosis.candidates
        ],
        "set": [each.identifier for each in diagnosis.together],
        "error_after": report_error(diagnosis.error_after, axis),
        "makeshift": list(diagnosis.makeshift),
        "remainder": report_remainder(diagnosis.remainder, fitted.design, language),
        "not_testable": [
            {"effect": each.effect, "reason": each.reason.in_language(language)}
            for each in diagnosis.not_testable
        ],
        "not_excluded": list(diagnosis.not_excluded),
        "visibility": [_collect_visibility(each, axis) for each in diagnosis.visibility],
        "faults": [
            {
                "fault": each.kind.value,
                "run": each.run,
                "probability": each.probability,
                "statement": each.statement.in_language(language),
                "remedy": each.remedy.in_language(language),
            }
            for each in diagnosis.faults
        ],
        "contradicted": [each.in_language(language) for each in diagnosis.contradicted],
        "outliers": diagnosis.outliers.tolist(),
        "remarks": [each.in_language(language) for each in diagnosis.remarks],
    }


def build_values(built: Built) -> dict[str, Any]:
    """Return a build as plain values for a JSON file."""
    last, exchange = built.last, built.exchange
    axis = last.fit.design.axis
    return {
        "schema": BUILD_SCHEMA,
        "steps": [
            {
                "effect": each.identifier,
                "settings": each.effect.settings.model_dump(mode="json"),
                **({"removed": True} if each.is_removed else {}),
                **({"reshaped": True} if each.is_reshaped else {}),
                **({"indistinguishable_from": list(each.equals)} if each.equals else {}),
                "rms_before": axis.deviation_unit.from_si(each.before.rms),
                "rms_after": axis.deviation_unit.from_si(each.after.rms),
                "noise_rms": report_error(each.after, axis)["noise_rms"],
            }
            for each in built.steps
        ],
        "exchange": exchange and {"in": list(exchange.coming), "out": list(exchange.going)},
        "doubts": [
            {"effects": list(each.names), "probability": each.probability, "added": each.is_named}
            for each in built.doubts
        ],
        "questions": [each.in_language(Language.ENGLISH) for each in built.questions],
        "needless": list(built.needless),
        "verdict": last.verdict.value,
        "remainder": report_remainder(last.remainder, last.fit.design),
        "model": report_model(last.fit),
        "error": report_error(last.error, axis),
    }


def report_remainder(
    remainder: Remainder | None, design: Design, language: Language = Language.ENGLISH
) -> dict[str, Any] | None:
    """Return what is left without a name; its formula as an item of a job's effects."""
    if remainder is None:
        return None
    look = look_for(remainder, design)
    return {
        **_collect_part(remainder, design, language),
        "share": remainder.share,
        "formula": None if remainder.formula is None else write_formula_entry(remainder.formula),
        "further": [_collect_part(each, design, language) for each in remainder.further],
        "instead": _collect_names_instead(remainder.instead),
        "look_at": look.at.in_language(language),
        "measure": look.measure.in_language(language),
    }


def _collect_part(part: RemainderPart, design: Design, language: Language) -> dict[str, Any]:
    from_si = design.axis.deviation_unit.from_si
    return {
        "rms": from_si(part.rms),
        "size": from_si(part.size),
        "where": part.where.in_language(language),
        "from": part.low * part.unit.per_si,
        "to": part.high * part.unit.per_si,
        "unit": part.unit.ascii,
        "shape": part.shape.in_language(language),
    }


def _collect_names_instead(instead: NamesInstead | None) -> dict[str, Any] | None:
    if instead is None:
        return None
    return {"effects": [each.identifier for each in instead.effects], "odds": instead.odds}


def write_formula_entry(keys: FormulaKeys) -> str:
    """Return a formula as an item of `model.effects` in one line, as `zlmreport model add` takes it."""
    own = keys.model_dump(mode="json", exclude_none=True, exclude_defaults=True)
    return json.dumps(own, ensure_ascii=False)


def report_model(fitted: Fit) -> dict[str, Any]:
    """Return the effects of a fitted model with their parameters."""
    return {
        "effects": list(fitted.model.identifiers),
        "parameters": [
            {"effect": each.effect, **_estimate(each, fitted.design)} for each in fitted.estimates
        ],
    }


def report_precision(fitted: Fit, *, with_residuals: bool = True) -> dict[str, Any]:
    """Return how well a model is known: covariance and intervals of its parameters, and what it leaves.

    Without residuals where single readings are not to be told.
    """
    residuals = {"residuals": _collect_residuals(fitted.of_the_job)} if with_residuals else {}
    return {"covariance": _collect_covariance(fitted), "intervals": _collect_intervals(fitted), **residuals}


def _collect_covariance(fitted: Fit) -> dict[str, Any]:
    """Return how the estimated parameters hang together, in the units in which they are reported."""
    units = [find_unit_on(fitted.design, each.dimension) for _, each in fitted.columns]
    covariance = fitted.uncertainties.covariance
    scale = np.array([each.per_si for each in units])
    deviations = np.sqrt(np.diagonal(covariance))
    deviations = np.where(deviations > 0, deviations, 1.0)
    return {
        "parameters": [f"{effect}.{each.name}" for effect, each in fitted.columns],
        "units": [each.ascii for each in units],
        "covariance": (covariance * np.outer(scale, scale)).tolist(),
        "correlation": (covariance / np.outer(deviations, deviations)).tolist(),
    }


def _collect_intervals(fitted: Fit) -> list[dict[str, Any]]:
    """Return from where to where the readings leave each parameter; null where they exclude nothing."""
    return [
        {
            "parameter": f"{each.effect}.{each.parameter.name}",
            "unit": (unit := find_unit_on(fitted.design, each.parameter.dimension)).ascii,
            "low": each.low * unit.per_si if isfinite(each.low) else None,
            "high": each.high * unit.per_si if isfinite(each.high) else None,
            "open": [
                side for side, is_open in (("low", each.low_is_open), ("high", each.high_is_open)) if is_open
            ],
        }
        for each in find_intervals(fitted)
    ]


def _collect_residuals(fitted: Fit) -> list[dict[str, Any]]:
    """Return what the model leaves of each reading, in the order in which they were taken."""
    design = fitted.design
    unit = design.axis.deviation_unit
    positions = design.axis.position_unit.from_si(design.position).tolist()
    residuals = unit.from_si(fitted.residual).tolist()
    signs = ["+" if each > 0 else "-" for each in design.direction.tolist()]
    return [
        {"target": target, "direction": sign, "run": run, "residual": residual, "unit": unit.ascii}
        for target, sign, run, residual in zip(positions, signs, design.run.tolist(), residuals, strict=True)
    ]


def report_error(error: ErrorNumbers, axis: Axis) -> dict[str, Any]:
    """Return how far readings and model are apart."""
    return {
        "rms": axis.deviation_unit.from_si(error.rms),
        "noise_rms": _convert_to_unit(error.noise_rms, axis),
        "chi2_per_dof": error.chi2_per_dof,
        "cross_validated_rms": _convert_to_unit(error.cross_validated_rms, axis),
        "unit": axis.deviation_unit.ascii,
    }


def _convert_to_unit(value: float | None, axis: Axis) -> float | None:
    return None if value is None else axis.deviation_unit.from_si(value)


def report_noise(noise: Noise, axis: Axis) -> dict[str, Any]:
    """Return what scatters: where readings are weighted, also where they scatter least and most."""
    unit = axis.deviation_unit
    least, largest = noise.span
    ends = (("least", least), ("largest", largest)) if least < largest else ()
    return {
        "repeatability": unit.from_si(noise.sigma),
        **{f"{end}_repeatability": unit.from_si(size) for end, size in ends},
        **{
            source.value.replace(" ", "_"): unit.from_si(noise.compute_amount(source))
            for source in noise.ratios
        },
    }


def _estimate(estimate: ParameterEstimate, design: Design) -> dict[str, Any]:
    unit = find_unit_on(design, estimate.parameter.dimension)
    found = {
        "name": estimate.parameter.name,
        "value": estimate.value * unit.per_si,
        "unit": unit.ascii,
        "expanded_uncertainty": estimate.expanded_uncertainty * unit.per_si,
        "coverage_factor": estimate.coverage_factor,
        "given": estimate.is_given,
        "plausibility": estimate.plausibility(time_is_counted=design.time_is_counted).name.lower(),
    }
    if estimate.equals:
        found["equals"] = estimate.equals
    if estimate.at_bound:
        found["at_bound"] = estimate.at_bound
    if estimate.expected is not None:
        found["expected"] = estimate.expected * unit.per_si
    return found


def _collect_candidate(candidate: EffectCandidate, design: Design, language: Language) -> dict[str, Any]:
    after = report_error(candidate.error, design.axis)
    discriminate_by, remedy = candidate.discriminate_by, candidate.effect.remedy
    return {
        "effect": candidate.identifier,
        "settings": candidate.effect.settings.model_dump(mode="json"),
        "p_value": candidate.p_value,
        "p_value_extrapolated": candidate.p_value_is_extrapolated,
        "probability": candidate.probability,
        "plausible": candidate.is_plausible,
        "large": candidate.is_large,
        "question": "" if candidate.question is None else candidate.question.in_language(language),
        "rms_after": after["rms"],
        "chi2_per_dof_after": after["chi2_per_dof"],
        "cross_validated_rms_after": after["cross_validated_rms"],
        "parameters": [_estimate(each, design) for each in candidate.estimates],
        "share": candidate.share,
        "explains": candidate.explains.in_language(language),
        "indistinguishable_from": list(candidate.equals),
        "discriminate_by": "" if discriminate_by is None else discriminate_by.in_language(language),
        "remedy": remedy.in_language(language) if remedy else "",
    }


def _collect_visibility(seen: Visibility, axis: Axis) -> dict[str, Any]:
    unit = axis.deviation_unit
    finite = seen.smallest_rms < float("inf")
    return {
        "effect": seen.effect,
        "share": seen.share,
        "smallest_rms": unit.from_si(seen.smallest_rms) if finite else None,
    }


def write_verdict_statement(diagnosis: AxisDiagnosis) -> Words:
    """Return the verdict in sentences: what is surely there, then what the rest looks like."""
    if diagnosis.verdict is DiagnosisVerdict.ADEQUATE:
        return _say_adequate(diagnosis)
    if diagnosis.verdict is DiagnosisVerdict.UNEXPLAINED:
        return _say_unexplained(diagnosis)
    by_name = {each.identifier: each for each in diagnosis.candidates}
    is_many = len(diagnosis.together) > 1
    groups = [
        _name_group(each.identifier, by_name[each.identifier].equals, is_many=is_many)
        for each in diagnosis.together
    ]
    missing = (_MISSING_TOGETHER if is_many else _MISSING).given(effects=list_in_words(groups))
    statement = _say_so_far(diagnosis, missing, is_many=is_many)
    if diagnosis.makeshift:
        statement = _GOES.given(statement=statement, effects=list_in_words(diagnosis.makeshift))
    doubts = find_doubts(diagnosis.candidates, [each.identifier for each in diagnosis.together])
    if doubts:
        statement = _NOT_SURE.given(statement=statement, chances=list_chances(doubts))
    for each in diagnosis.together:
        candidate = by_name[each.identifier]
        question = candidate.question
        if question is not None:
            # What contradicts the job names its effect by itself.
            question = ask_about(each.identifier, question) if is_many and candidate.is_large else question
            statement = _TWO.given(one=statement, other=question)
    if diagnosis.remainder is not None:
        beside = _describe_remainder(_BESIDE, diagnosis.remainder, diagnosis.fit.design.axis)
        statement = _TWO.given(one=statement, other=beside)
    fault = find_stated_fault(diagnosis)
    if fault is None:
        return statement
    return _IN_DOUBT.given(statement=fault.statement, remedy=fault.remedy, verdict=statement)


def write_statement_after_build(last: AxisDiagnosis, *, has_steps: bool) -> Words:
    """Return the verdict on a model that was built: where steps were taken, what is left beside them."""
    left = last.remainder
    if left is None or not has_steps or last.verdict is not DiagnosisVerdict.UNEXPLAINED:
        return write_verdict_statement(last)
    return _describe_remainder(_BESIDE, left, last.fit.design.axis)


def _say_adequate(diagnosis: AxisDiagnosis) -> Words:
    """Return that nothing is missing; where that is open, with the error beside noise.

    It is open where readings are few, and where the residuals have an order that is too small for a cause;
    what describes any readings proves nothing.
    """
    if FixedNumbers(diagnosis.fit.design, diagnosis.fit.compute_base()).is_model_too_rich():
        return _TOO_RICH
    floor, axis = diagnosis.error.noise_rms, diagnosis.fit.design.axis
    order = next((each for each in diagnosis.failures if each.test not in _OF_SCATTER), None)
    if floor is None or (diagnosis.leaves_noise and order is None):
        return _ADEQUATE
    statement = _ADEQUATE_SO_FAR.given(
        error=wording.deviation(axis, diagnosis.error.rms), noise=wording.deviation(axis, floor)
    )
    return statement if order is None else _YET.given(statement=statement, failure=order.statement)


def list_chances(doubts: Iterable[Doubt]) -> Words:
    """Return effects that are no more than likely in a row, each with its probability."""
    return list_in_words(
        [
            _CHANCE.given(effects=list_alternatives(each.names), share=write_share(each.probability))
            for each in doubts
        ]
    )


def _name_group(effect: str, equals: Sequence[str], *, is_many: bool) -> Words:
    """Return an effect with its equals; in brackets beside others, or nobody sees where one group ends."""
    names = list_alternatives([effect, *equals])
    return _ONE_OF.given(names=names) if equals and is_many else names


def _say_so_far(diagnosis: AxisDiagnosis, missing: Words, *, is_many: bool) -> Words:
    """Return how far the effects that are missing explain the rest."""
    if diagnosis.leaves_noise:
        return _RESTS[is_many].given(missing=missing)
    axis, after = diagnosis.fit.design.axis, diagnosis.error_after
    before, with_them = wording.deviation(axis, diagnosis.error.rms), wording.deviation(axis, after.rms)
    if before.in_language(Language.ENGLISH) == with_them.in_language(Language.ENGLISH):
        words = _STAYS
    elif after.rms > diagnosis.error.rms:  # one takes the place of another, and what is left hides its gain
        words = _NOT_BY_ITSELF
    else:
        words = _WITHOUT_FLOOR if after.noise_rms is None else _IN_PART
    given = words.given(missing=missing, many=_MANY[is_many], before=before, after=with_them)
    if words is not _IN_PART or after.noise_rms is None:
        return given
    return given.given(noise=wording.deviation(axis, after.noise_rms))


def find_leading_fault(diagnosis: AxisDiagnosis) -> DataFault | None:
    """Return the fault of the data that is said in place of a cause; None if none is."""
    if diagnosis.verdict is not DiagnosisVerdict.UNEXPLAINED:
        return None
    first = next((each for each in diagnosis.faults if each.comes_first), None)
    if first is None and diagnosis.remainder is None:
        return next(iter(diagnosis.faults), None)
    return first


def find_stated_fault(diagnosis: AxisDiagnosis) -> DataFault | None:
    """Return the fault of the data that the verdict states, in place of causes or before them; or None."""
    if diagnosis.verdict is DiagnosisVerdict.MISSING:
        return next((each for each in diagnosis.faults if each.kind is FaultKind.WRONG_UNIT), None)
    return find_leading_fault(diagnosis)


def list_further_faults(diagnosis: AxisDiagnosis) -> tuple[DataFault, ...]:
    """Return what looks wrong in the data beside the fault that the verdict states."""
    stated = find_stated_fault(diagnosis)
    return tuple(each for each in diagnosis.faults if each is not stated)


def _say_unexplained(diagnosis: AxisDiagnosis) -> Words:
    fault = find_leading_fault(diagnosis)
    if fault is not None and (fault.comes_first or diagnosis.contradicted):
        return _FAULTY.given(statement=fault.statement, remedy=fault.remedy)
    if fault is not None:  # causes were sought, and no more is missing than in the right unit
        return _IN_DOUBT.given(
            statement=fault.statement, remedy=fault.remedy, verdict=_say_adequate(diagnosis)
        )
    if diagnosis.contradicted:
        statements = reduce(lambda one, other: _TWO.given(one=one, other=other), diagnosis.contradicted)
        return _GIVEN.given(statements=statements)
    if diagnosis.remainder is None:
        return _UNEXPLAINED
    words = _SHAPE if diagnosis.remainder.instead is None else _UNSURE
    statement = _describe_remainder(words, diagnosis.remainder, diagnosis.fit.design.axis)
    likely = [
        Doubt((each.identifier,), each.probability, is_named=False)
        for each in diagnosis.candidates
        if each.probability >= _LIKELY
    ]
    return _LIKELY_BESIDE.given(statement=statement, chances=list_chances(likely)) if likely else statement


def _describe_remainder(words: Words, remainder: Remainder, axis: Axis) -> Words:
    """Return a sentence with what is left, its place and size, and what may stand in its place."""
    size, shape, where = wording.deviation(axis, remainder.rms), remainder.shape, remainder.where
    for each in remainder.further:
        is_there = where.in_language(Language.ENGLISH) == each.where.in_language(Language.ENGLISH)
        if is_there:
            shape = _SAME_PLACE.given(shape=shape, further=each.shape)
        else:
            shape, where = _AND.given(shape=shape, where=where, further=each.shape), each.where
    statement = words.given(shape=shape, where=where, size=size)
    if (instead := remainder.instead) is None:
        return statement
    those, this = (str(max(1, round(each))) for each in (instead.odds, 1.0 / instead.odds))
    effects = list_in_words([each.identifier for each in instead.effects])
    if those == this:
        return _AS_LIKELY.given(statement=statement, effects=effects)
    odds, words = _ODDS.given(those=those, this=this), _MORE_LIKELY if instead.odds > 1.0 else _LESS_LIKELY
    return words.given(statement=statement, odds=odds, effects=effects)


def select_serious_candidates(diagnosis: AxisDiagnosis) -> tuple[EffectCandidate, ...]:
    """Return the candidates that are worth a word: those of the set, their equals, what is not improbable."""
    named = {each.identifier for each in diagnosis.together}
    return tuple(
        each
        for each in diagnosis.candidates
        if each.identifier in named or each.equals or each.probability >= _SERIOUS
    )
