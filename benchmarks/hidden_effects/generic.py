"""Generic ways to find what is missing, on the same readings: stepwise BIC, sparse regression, kernel search.

Each is given what the job's model leaves, and may add to it what it finds. None knows causes, so it is
taken to name the effect already if what it puts first depends on the right variables and has roughly the
right form.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, TypeAlias

import numpy as np

from hidden_effects import kernel_search
from hidden_effects.cases import Case
from hidden_effects.library import Term, library
from hidden_effects.prediction import seen_again
from hidden_effects.sizes import base_columns, beyond
from hidden_effects.sparse import sparse
from hidden_effects.stepwise import stepwise
from hidden_effects.trial import Trial
from zlmreport.measurement.arrays import FloatArray
from zlmreport.measurement.refractive_index import index_change
from zlmreport.model.effects.design import Design
from zlmreport.model.fitting.observations import Observations
from zlmreport.model.planning.methods import Method

#: Share of the visible hidden deviation that the leading term, sine and cosine together, must describe.
_ROUGHLY = 0.6
#: A term of which the job's model leaves less is in the model already.
_LEAST_LEFT = 1e-3
_LINEAR_METHOD_ONLY = Method.LINEAR
_SIZE = 1.0

#: On what each effect depends.
_POSITION = frozenset({"P"})
_AIR = frozenset({"air"})
_DEPENDS_ON: Mapping[str, Sequence[frozenset[str]]] = {
    "backlash": [frozenset({"d"})],
    "backlash-gradient": [frozenset({"d", "P"})],
    "backlash-bow": [frozenset({"d", "P"}), frozenset({"d", "s"})],
    "reversal-relaxation": [frozenset({"d", "s"}), frozenset({"d", "P"})],
    "directional-pitch": [frozenset({"d", "P"})],
    "scale-expansion": [frozenset({"P", "axis temperature"})],
    "screw-expansion": [frozenset({"P", "screw temperature"})],
    "thermal-growth": [frozenset({"P", "t"})],
    "thermal-drift": [frozenset({"t"})],
    "datum-temperature": [frozenset({"axis temperature"})],
    "air-index": [_AIR | _POSITION],
    "dead-path": [_AIR],
    "time-periodic": [frozenset({"t"})],
    "datum-step": [frozenset({"t"}), frozenset({"c"})],
    "first-run": [frozenset({"c"}), frozenset({"t"})],
    "probe-radius": [frozenset({"d"})],
}

#: From visible columns and residuals to the leading column and the coefficients of all.
Way: TypeAlias = Callable[[FloatArray, FloatArray], tuple[int | None, FloatArray]]
_WAYS: Mapping[str, Way] = {"stepwise BIC": stepwise, "sparse regression": sparse}


@dataclass(frozen=True, slots=True)
class _Field:
    """Two tests as a generic way sees them: what the job's model describes, and the terms beyond it."""

    terms: Sequence[Term]
    base: FloatArray
    columns: FloatArray
    deviation: FloatArray
    design_again: Design
    base_again: FloatArray
    columns_again: FloatArray
    truth_again: FloatArray
    hidden: FloatArray


def is_tried_on(case: Case) -> bool:
    """Whether the generic ways are tried: on linear axes in the linear method, at ρ = 1."""
    rotary = case.hidden[0] in ("eccentricity", "ellipticity", "gear-mesh")
    return case.method is _LINEAR_METHOD_ONLY and case.size == _SIZE and not rotary


def tried(trial: Trial, observed: Observations, *, slow: bool) -> dict[str, dict[str, Any]]:
    """Return of each way whether it names the effect, its error on the second test over σ, and its time."""
    field = _field(trial, observed)
    found = {}
    for name, way in _WAYS.items():
        started = time.process_time()
        leading, coefficients = way(field.columns, beyond(field.base, field.deviation[:, np.newaxis])[:, 0])
        seconds = time.process_time() - started
        found[name] = {
            "names": leading is not None and _names(trial.case.hidden[0], field, leading),
            "after": _error(field, coefficients) / trial.sigma,
            "seconds": seconds,
        }
    if slow and kernel_search.is_installed():
        found["kernel search"] = _by_kernels(trial, observed, field)
    return found


def _by_kernels(trial: Trial, observed: Observations, field: _Field) -> dict[str, Any]:
    known = np.linalg.lstsq(field.base, field.deviation, rcond=1e-9)[0]
    inputs = _inputs(observed.design, field.design_again)
    result = kernel_search.search(inputs, field.deviation - field.base @ known)
    hidden = beyond(field.base, field.hidden[:, np.newaxis])[:, 0]
    left = hidden - result.fitted
    dependence = _DEPENDS_ON.get(trial.case.hidden[0], [_POSITION])
    is_alike = float(left @ left) < (1 - _ROUGHLY) * float(hidden @ hidden)
    error = field.base_again @ known + result.predicted - field.truth_again
    return {
        "names": is_alike and result.variables in dependence,
        "after": float(np.sqrt(np.mean(error**2))) / trial.sigma,
        "seconds": result.seconds,
    }


def _inputs(first: Design, again: Design) -> kernel_search.Inputs:
    """Return everything that was recorded, the air as one number: what its index does."""

    def recorded(design: Design) -> dict[str, FloatArray]:
        logs = design.conditions
        air = index_change(logs["air_temperature"], logs["air_pressure"], logs["relative_humidity"])
        return {
            "P": design.position,
            "t": design.time,
            "d": design.direction,
            "s": design.since_reversal,
            "axis temperature": logs["axis_temperature"],
            "screw temperature": logs["screw_temperature"],
            "air": air,
        }

    here, there = recorded(first), recorded(again)
    centre = {name: values.mean() for name, values in here.items()}
    spread = {name: values.std() or 1.0 for name, values in here.items()}
    return kernel_search.Inputs(
        tuple(here),
        np.column_stack([(values - centre[name]) / spread[name] for name, values in here.items()]),
        np.column_stack([(values - centre[name]) / spread[name] for name, values in there.items()]),
    )


def _field(trial: Trial, observed: Observations) -> _Field:
    again = trial.again()
    seen = seen_again(trial, again)
    design = observed.design
    effects = [term.effect for term in trial.model.terms]
    base, base_again = base_columns(effects, design), base_columns(effects, seen.design)
    terms, terms_again = library(design, design), library(seen.design, design)
    columns = np.column_stack([term.values for term in terms])
    visible = np.sqrt(np.mean(beyond(base, columns) ** 2, axis=0)) > _LEAST_LEFT
    return _Field(
        [term for term, is_visible in zip(terms, visible, strict=True) if is_visible],
        base,
        columns[:, visible],
        observed.deviation,
        seen.design,
        base_again,
        np.column_stack([term.values for term in terms_again])[:, visible],
        (again.known + again.hidden)[seen.reading],
        trial.first.hidden[observed.reading],
    )


def _names(effect: str, field: _Field, leading: int) -> bool:
    term = field.terms[leading]
    if term.variables not in _DEPENDS_ON.get(effect, [_POSITION]):
        return False
    together = [place for place, each in enumerate(field.terms) if each.group == term.group]
    columns = beyond(field.base, field.columns[:, together])
    hidden = beyond(field.base, field.hidden[:, np.newaxis])[:, 0]
    left = hidden - columns @ np.linalg.lstsq(columns, hidden, rcond=1e-9)[0]
    return float(left @ left) < (1 - _ROUGHLY) * float(hidden @ hidden)


def _error(field: _Field, coefficients: FloatArray) -> float:
    """Return the error on the second test of the job's model with the chosen terms, all fitted anew."""
    chosen = np.flatnonzero(coefficients)
    together = np.column_stack([field.base, field.columns[:, chosen]])
    lengths = np.linalg.norm(together, axis=0)
    solved = np.linalg.lstsq(together / lengths, field.deviation, rcond=1e-9)[0] / lengths
    predicted = np.column_stack([field.base_again, field.columns_again[:, chosen]]) @ solved
    return float(np.sqrt(np.mean((predicted - field.truth_again) ** 2)))
