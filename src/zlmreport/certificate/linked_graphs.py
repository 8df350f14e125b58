"""The two graphs as values: readings one by one, so that one is known in both; the model; the noise."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np

from zlmreport.figures.model_diagram import SPREAD, ModelDiagram, estimate
from zlmreport.figures.model_residuals import over_position
from zlmreport.language import Language, Words, same
from zlmreport.measurement.measurement_set import CONDITION_NAMES, CONDITIONS
from zlmreport.model.outliers import outliers
from zlmreport.model.study import Fitted, Study, corrected
from zlmreport.quantities.arrays import FloatArray

_MINUTE = 60.0
_LONG = 600.0
#: Decimals of values that are drawn: finer than any screen.
_DECIMALS = 6

_POSITION = Words(en="Position", de="Position")
_TIME = Words(en="Time", de="Zeit")
_COUNTED = Words(en="Number of the reading", de="Nummer des Messwerts")
_RUN = Words(en="Run", de="Durchlauf")
_DIRECTION = Words(en="Direction", de="Richtung")
_DEVIATION = Words(en="Deviation", de="Abweichung")
_RESIDUAL = Words(en="Residual", de="Residuum")


def graphs(study: Study, whole: Fitted, language: Language) -> dict[str, Any]:
    """Return what both graphs draw, in the units of the page.

    Parameters
    ----------
    study
        The readings, none set aside.
    whole
        The model fitted to them.
    language
        Of titles.
    """
    observed, axis = study.observed, study.job.axis
    design = observed.design
    diagram = ModelDiagram(whole.fit, whole.error)
    left = corrected(study.measurements, observed, whole.fit).deviation[observed.reading]
    aside = outliers(design, observed.deviation).readings
    fitted = np.ones(len(observed.reading), dtype=np.bool_)
    fitted[aside] = False
    unit = axis.deviation_unit
    return {
        "axes": list(_axes(study, language)),
        "unit": unit.symbol,
        "deviation": _DEVIATION.in_language(language),
        "residual": _RESIDUAL.in_language(language),
        "readings": {
            "place": observed.reading.tolist(),
            "direction": np.where(design.direction > 0, 1, -1).tolist(),
            "run": design.run.tolist(),
            "deviation": _values(unit.from_si(observed.deviation)),
            "residual": _values(unit.from_si(left)),
            "fitted": fitted.tolist(),
        },
        "model": list(_model(diagram)),
        "noise": unit.from_si(SPREAD * diagram.noise),
        "alternative": over_position(diagram).alternative.in_language(language),
    }


def _model(diagram: ModelDiagram) -> Iterator[dict[str, Any]]:
    """Yield the model with its expanded uncertainty, for each direction; nothing for a model of no effect."""
    if not diagram.fit.model.terms:
        return
    (panel,) = estimate(diagram).panels
    for approach, curve, band in zip(diagram.approaches, panel.curves, panel.bands, strict=True):
        yield {
            "direction": int(approach),
            "x": _values(curve.x),
            "y": _values(curve.y),
            "low": _values(band.lower),
            "high": _values(band.upper),
        }


def _axes(study: Study, language: Language) -> Iterator[dict[str, Any]]:
    """Yield everything over which readings can be laid out; the first is the position."""
    design, axis = study.observed.design, study.job.axis
    yield _axis(
        "position",
        _POSITION.in_language(language),
        axis.position_unit.symbol,
        axis.position_unit.from_si(design.position),
    )
    if design.time_is_counted:
        yield _axis("time", _COUNTED.in_language(language), "", 1.0 + design.time)
    else:
        in_minutes = design.duration > _LONG
        values = design.time / _MINUTE if in_minutes else design.time
        yield _axis("time", _TIME.in_language(language), "min" if in_minutes else "s", values)
    yield _axis("run", _RUN.in_language(language), "", design.run.astype(np.float64))
    if design.is_bidirectional:
        yield _axis("direction", _DIRECTION.in_language(language), "", design.direction)
    for name, log in study.measurements.conditions.items():
        at = log[study.observed.reading]
        if np.isnan(at).all():
            continue
        title, unit = CONDITION_NAMES.get(name, same(name)), ""
        if name in CONDITIONS:
            scale = CONDITIONS[name].unit
            at, unit = scale.from_si(at), scale.symbol
        yield _axis(name, title.in_language(language), unit, at)


def _axis(key: str, title: str, unit: str, values: FloatArray) -> dict[str, Any]:
    return {"key": key, "title": title, "unit": unit, "values": _values(values)}


def _values(values: FloatArray) -> list[float | None]:
    """Return values as JSON has them: NaN, which it has not, is nothing."""
    return [None if value != value else value for value in np.round(values, _DECIMALS).tolist()]  # noqa: PLR0124 - NaN is what differs from itself
