"""What ``zlmreport model … --json`` prints beside the diagnosis: full precision, µm or ″."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from zlmreport.document.subjects.forecast import StandardForecast
from zlmreport.errors import Place
from zlmreport.job.edit import Edit
from zlmreport.measurement.approach import Approach
from zlmreport.measurement.arrays import FloatArray
from zlmreport.measurement.axis import Axis
from zlmreport.model.diagnosis.report import report_error, report_model, report_noise, report_precision
from zlmreport.model.diagnosis.study import Fitted, list_one_way
from zlmreport.model.effects.effect import Shape
from zlmreport.model.fitting.fit import Fit, Prediction

FIT = "zlmreport/fit/1"
HISTORY = "zlmreport/history/1"
CHANGE = "zlmreport/model-change/1"


@dataclass(frozen=True, slots=True)
class ModelChange:
    """A change of a model that makes sense."""

    edit: Edit  #: Of the job file.
    added: str  #: The effect that comes in; empty if none does.
    removed: tuple[str, ...]  #: The effects that go out.
    before: Fitted  #: The model as it was.
    history: tuple[Fitted, ...]  #: The model as it is then, effect by effect.
    forecasts: tuple[StandardForecast, ...]  #: What standards would say of an axis corrected by it.


@dataclass(frozen=True, slots=True)
class PredictedPoints:
    """What a model gives at positions that were asked for."""

    positions: FloatArray  #: (M,): m or rad.
    predictions: dict[Approach, Prediction]  #: By direction of approach.
    #: Whether the model changes with time or run: then the predictions are those of the mean of the test.
    moves: bool


def find_points_of(fit: Fit, positions: Sequence[float]) -> PredictedPoints | None:
    """Return what a model gives at positions in mm or degrees; None if none is asked for."""
    if not positions:
        return None
    places = fit.design.axis.position_unit.to_si(np.array(positions, dtype=np.float64))
    return PredictedPoints(
        places,
        fit.predict_at(places, Place("--at")),
        any(term.effect.shape in {Shape.TIME, Shape.RUN} for term in fit.model.terms),
    )


def collect_fit(fitted: Fitted) -> dict[str, Any]:
    """Return a fitted model with its parameters, how well they are known, its error and its residuals."""
    axis = fitted.fit.design.axis
    return {
        "schema": FIT,
        "model": report_model(fitted.fit),
        "error": report_error(fitted.error, axis),
        **report_precision(fitted.fit),
        "noise": report_noise(fitted.fit.noise, axis),
        "polynomials": [
            {
                "direction": approach.sign,
                "unit": axis.position_unit.ascii,
                "coefficients": values.tolist(),
                "covariance": covariance.tolist(),
            }
            for approach, values, covariance in list_one_way(fitted.fit)
        ],
    }


def collect_history(history: Sequence[Fitted], forecasts: Sequence[StandardForecast]) -> dict[str, Any]:
    """Return how the error fell, step by step; the first step is that without a model."""
    return {"schema": HISTORY, "steps": _list_steps(history, forecasts)}


def collect_change(path: Path, change: ModelChange) -> dict[str, Any]:
    """Return what was changed, and the error before and after."""
    after = change.history[-1]
    axis = after.fit.design.axis
    return {
        "schema": CHANGE,
        "job": str(path),
        "added": change.added or None,
        "removed": list(change.removed),
        "model": report_model(after.fit),
        "error_before": report_error(change.before.error, axis),
        "error": report_error(after.error, axis),
        "steps": _list_steps(change.history, change.forecasts),
    }


def collect_points(points: PredictedPoints | None, axis: Axis) -> dict[str, Any]:
    """Return the same for JSON, in full precision: positions in mm or degrees, deviations in µm or ″."""
    if points is None:
        return {}
    unit = axis.deviation_unit
    return {
        "points": [
            {
                "position": axis.position_unit.from_si(place),
                "direction": approach.sign,
                "deviation": unit.from_si(float(found.deviation[number])),
                "expanded_uncertainty": unit.from_si(float(found.expanded_uncertainty[number])),
                "coverage_factor": float(found.coverage_factor[number]),
                "unit": unit.ascii,
            }
            for number, place in enumerate(points.positions.tolist())
            for approach, found in points.predictions.items()
        ]
    }


def _list_steps(history: Sequence[Fitted], forecasts: Sequence[StandardForecast]) -> list[dict[str, Any]]:
    axis = history[-1].fit.design.axis
    names = [None, *history[-1].fit.model.identifiers]
    return [
        {
            "effect": name,
            "error": report_error(each.error, axis),
            "predicted": [_predict_results(forecast, index) for forecast in forecasts],
        }
        for index, (name, each) in enumerate(zip(names, history, strict=True))
    ]


def _predict_results(forecast: StandardForecast, step: int) -> dict[str, Any]:
    """Return what a standard would say of an axis corrected by the effects up to a step."""
    unit = forecast.unit
    return {
        "standard": forecast.standard,
        "parameters": [
            {"symbol": quantity.symbol, "value": unit.from_si(value), "unit": unit.ascii}
            for quantity, value in zip(forecast.quantities, forecast.by_step[step].tolist(), strict=True)
            if not math.isnan(value)
        ],
    }
