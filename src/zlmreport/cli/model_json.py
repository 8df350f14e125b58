"""What ``zlmreport model … --json`` prints beside the diagnosis: full precision, µm or ″."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

from zlmreport.certificate.forecast import Forecast
from zlmreport.cli.model_session import Change, Session
from zlmreport.model.report import report_error, report_model
from zlmreport.model.study import Fitted

FIT = "zlmreport/fit/1"
HISTORY = "zlmreport/history/1"
CHANGE = "zlmreport/model-change/1"


def fit_values(fitted: Fitted) -> dict[str, Any]:
    """Return a fitted model with its parameters, and its error."""
    axis = fitted.fit.design.axis
    return {"schema": FIT, "model": report_model(fitted.fit), "error": report_error(fitted.error, axis)}


def history_values(history: Sequence[Fitted], forecasts: Sequence[Forecast]) -> dict[str, Any]:
    """Return how the error fell, step by step; the first step is that without a model."""
    return {"schema": HISTORY, "steps": _steps(history, forecasts)}


def change_values(session: Session, change: Change) -> dict[str, Any]:
    """Return what was changed, and the error before and after."""
    after = change.history[-1]
    axis = after.fit.design.axis
    return {
        "schema": CHANGE,
        "job": str(session.path),
        "added": change.added or None,
        "removed": list(change.removed),
        "model": report_model(after.fit),
        "error_before": report_error(change.before.error, axis),
        "error": report_error(after.error, axis),
        "steps": _steps(change.history, change.forecasts),
    }


def _steps(history: Sequence[Fitted], forecasts: Sequence[Forecast]) -> list[dict[str, Any]]:
    axis = history[-1].fit.design.axis
    names = [None, *history[-1].fit.model.identifiers]
    return [
        {
            "effect": name,
            "error": report_error(each.error, axis),
            "predicted": [_predicted(forecast, index) for forecast in forecasts],
        }
        for index, (name, each) in enumerate(zip(names, history, strict=True))
    ]


def _predicted(forecast: Forecast, step: int) -> dict[str, Any]:
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
