"""One case from its draw to a line of the results."""

from __future__ import annotations

import time
from collections.abc import Mapping
from typing import Any

from hidden_effects import generic, prediction
from hidden_effects.cases import Case, Kind
from hidden_effects.trial import EFFECTS, Trial, drawn_trial
from zlmreport.language import Language
from zlmreport.model.diagnosis.diagnosis import AxisDiagnosis, DiagnosisVerdict, diagnose
from zlmreport.model.effects.axis_model import AxisModel
from zlmreport.model.effects.model_error import ModelError
from zlmreport.model.fitting.observations import Observations, make_observations_of

INSTALLED = tuple(EFFECTS.values())
#: Effects that a user who believes the first candidate would add to find a pair, and one more.
_MOST_ADDED = 4


def judged(
    case: Case,
    slow_ways: bool = False,  # noqa: FBT001, FBT002 - a pool hands it over by its place
) -> dict[str, Any]:
    """Return what comes of a case.

    Parameters
    ----------
    case
        The case.
    slow_ways
        Whether the generic ways that take half a minute are tried as well.
    """
    trial = drawn_trial(case)
    record: dict[str, Any] = named(case)
    if trial is None:
        return record | {"outcome": "not visible"}
    started = time.process_time()
    observed = make_observations_of(trial.first.measurements, overrun=trial.description.plan.overrun)
    try:
        diagnosis = diagnose(trial.model, observed, INSTALLED)
    except ModelError as error:
        return record | {"outcome": "refused", "message": str(error)}
    record |= {"outcome": "judged", "seconds": time.process_time() - started, **_said(diagnosis)}
    record |= {"readings": len(observed.deviation), "twins": sorted(trial.twins)}
    if case.kind is Kind.STRANGER:
        record["imitated"] = max(each.share for each in trial.imitated)
    nearest = trial.nearest()
    if nearest is not None:
        record |= {"nearest": nearest[0].effect.identifier, "distance": nearest[1]}
    if case.kind is Kind.EFFECT:
        record["second"] = prediction.errors(trial, diagnosis)
        if generic.is_tried_on(case):
            record["ways"] = generic.tried(trial, observed, slow=slow_ways)
    if case.kind is Kind.PAIR:
        record["added"] = _added(trial, observed, diagnosis)
    return record


def named(case: Case) -> dict[str, Any]:
    """Return a record that says which case it is of."""
    return {
        "key": case.key,
        "kind": case.kind,
        "hidden": list(case.hidden),
        "method": case.method,
        "scatter": case.scatter,
        "size": case.size,
        "draw": case.draw,
    }


def _said(diagnosis: AxisDiagnosis) -> Mapping[str, Any]:
    """Return what a diagnosis says, as far as it is judged."""
    return {
        "verdict": diagnosis.verdict,
        "p_value": diagnosis.p_value,
        "candidates": [
            {
                "effect": each.identifier,
                "probability": each.probability,
                "evidence": each.evidence,
                "p_value": each.p_value,
                "equals": list(each.equals),
                "share": each.share,
            }
            for each in diagnosis.candidates
        ],
        "further": list(diagnosis.further),
        "shape": diagnosis.remainder.shape.in_language(Language.ENGLISH) if diagnosis.remainder else None,
        "outliers": len(diagnosis.outliers),
    }


def _added(trial: Trial, observed: Observations, diagnosis: AxisDiagnosis) -> list[list[str]]:
    """Return what a user adds who believes every first candidate: its name and its equals."""
    model: AxisModel = trial.model
    added = []
    while diagnosis.verdict is DiagnosisVerdict.MISSING and len(added) < _MOST_ADDED:
        first = diagnosis.candidates[0]
        added.append([first.identifier, *first.equals])
        model = model.with_effect(first.effect)
        try:
            diagnosis = diagnose(model, observed, INSTALLED)
        except ModelError:
            break
    return added
