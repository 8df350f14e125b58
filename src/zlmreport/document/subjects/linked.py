"""Readings and model as values for linked graphs, in the workbench and in certificates as HTML."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from zlmreport.document.certificate.document import Linked
from zlmreport.document.figures.model_diagram import SPREAD, ModelDiagram, estimate
from zlmreport.document.figures.model_residuals import choose_time, convert_condition, draw_over_position
from zlmreport.document.subjects.diagnosis import FAILURES, FailureRow, make_failure_row
from zlmreport.language import Language, Words
from zlmreport.model.diagnosis.residuals import Failure, ResidualTest
from zlmreport.model.diagnosis.study import Fitted, Study, correct_by_model
from zlmreport.model.fitting.blunders import find_outliers
from zlmreport.model.fitting.curve import shows_reach_only

if TYPE_CHECKING:
    from zlmreport.measurement.arrays import FloatArray
    from zlmreport.model.diagnosis.diagnosis import AxisDiagnosis

#: Decimals of values that are drawn: finer than any screen.
_DECIMALS = 6

_POSITION = Words("Position")
_RUN = Words("Run")
_DIRECTION = Words("Direction")
_DEVIATION = Words("Deviation")
_RESIDUAL = Words("Residual")
#: What the graphs say, on the workbench's page and in a certificate.
GRAPH_TEXTS: Mapping[str, Words] = {
    "measured": Words("Measured against the model"),
    "residuals": Words("Residuals"),
    "over": Words("over"),
    "failures": FAILURES,
    "noFailures": Words("No test of the residuals fails."),
    "show": Words("Show the readings"),
    "reset": Words("Whole axis"),
    "point": Words("Point at a reading, or go from one to the next with the arrow keys."),
    "target": Words("Target"),
    "run": _RUN,
    "deviation": _DEVIATION,
    "modelValue": Words("Model"),
    "residual": _RESIDUAL,
    "flagged": Words("stands off; not fitted"),
    "upwards": Words("upwards ↑"),
    "downwards": Words("downwards ↓"),
    "modelUp": Words("model ↑ with U"),
    "modelDown": Words("model ↓ with U"),
    "reach": Words("The waves are too short to be parted on this length: the line shows how far they reach."),
    "noise": Words("± 2σ of single readings"),
    "zoom": Words("Drag to look closer, with Shift to move; double-click for the whole axis."),
    "direction": _DIRECTION,
    "colour": Words("coloured by"),
    "mode": Words("What dragging does"),
    "modeZoom": Words("Look closer"),
    "modeMove": Words("Move"),
    "modeSelect": Words("Choose readings"),
    "save": Words("Save …"),
    "inSight": Words("Readings in sight"),
    "asTable": Words("The readings in sight as a table"),
    "more": Words("{count} more: look closer to see them."),
    "chosen": Words("{count} readings chosen"),
    "chosenOne": Words("1 reading chosen"),
    "slope": Words("Slope of its pass"),
}
_IN_TIME = {ResidualTest.TIME_ORDER, ResidualTest.PERIOD_IN_TIME}


def link_graphs(
    section: str, study: Study, whole: Fitted, diagnosis: AxisDiagnosis, language: Language
) -> Linked:
    """Return the linked graphs of a studied model.

    `study`: The readings, none set aside.
    """
    return Linked(
        section,
        {name: words.in_language(language) for name, words in GRAPH_TEXTS.items()},
        collect_graphs(study, whole, language),
        tuple(
            collect_failure(make_failure_row(each, language), diagnosis, study) for each in diagnosis.failures
        ),
    )


def collect_failure(row: FailureRow, diagnosis: AxisDiagnosis, study: Study) -> dict[str, Any]:
    """Return a failure: what is said of it, and the axis and the readings that show it."""
    failure = row.failure
    axis = failure.condition or "position"
    if failure.test is ResidualTest.RUNS:
        axis = "run"
    elif failure.test in _IN_TIME:
        axis = "time"
    return {
        "statement": row.statement,
        "where": row.where,
        "p": row.p,
        "axis": axis,
        "readings": _list_failing_readings(failure, diagnosis, study),
    }


def collect_graphs(study: Study, whole: Fitted, language: Language) -> dict[str, Any]:
    """Return what both graphs draw, in the units of the page.

    `study`: The readings, none set aside.
    """
    observed, axis = study.observed, study.job.axis
    design = observed.design
    diagram = ModelDiagram(whole.fit.of_the_job, whole.error)
    left = correct_by_model(study.measurements, observed, whole.fit).deviation[observed.reading]
    aside = find_outliers(study.together.design, study.together.deviation).readings
    fitted = np.ones(len(observed.reading), dtype=np.bool_)
    fitted[aside[aside < len(fitted)]] = False  # the job's own readings stand first
    unit = axis.deviation_unit
    return {
        "axes": list(_list_axes(study, language)),
        "unit": unit.symbol,
        "deviation": _DEVIATION.in_language(language),
        "residual": _RESIDUAL.in_language(language),
        "readings": {
            "place": observed.reading.tolist(),
            "direction": np.where(design.direction > 0, 1, -1).tolist(),
            "run": design.run.tolist(),
            "deviation": collect_drawn_values(unit.from_si(observed.deviation)),
            "residual": collect_drawn_values(unit.from_si(left)),
            "fitted": fitted.tolist(),
        },
        "model": collect_model_curves(diagram),
        "noise": unit.from_si(SPREAD * diagram.noise),
        "alternative": draw_over_position(diagram).alternative.in_language(language),
    }


def collect_model_curves(diagram: ModelDiagram) -> list[dict[str, Any]]:
    """Return the model with its U for each direction; nothing for a model of no effect."""
    if not diagram.fit.model.terms:
        return []
    (panel,) = estimate(diagram).panels
    reaches = shows_reach_only(diagram.fit, diagram.span)
    return [
        {
            "direction": int(approach),
            "x": collect_drawn_values(curve.x),
            "y": collect_drawn_values(curve.y),
            "low": collect_drawn_values(band.lower),
            "high": collect_drawn_values(band.upper),
            "reach": reaches,
        }
        for approach, curve, band in zip(diagram.approaches, panel.curves, panel.bands, strict=True)
    ]


def _list_axes(study: Study, language: Language) -> Iterator[dict[str, Any]]:
    """Yield everything over which readings can be laid out; the first is the position."""
    design, axis = study.observed.design, study.job.axis
    yield _make_axis(
        "position",
        _POSITION.in_language(language),
        axis.position_unit.symbol,
        axis.position_unit.from_si(design.position),
    )
    times, (title, _), unit = choose_time(design)
    yield _make_axis("time", title.in_language(language), unit, times)
    yield _make_axis("run", _RUN.in_language(language), "", design.run.astype(np.float64))
    if design.is_bidirectional:
        yield _make_axis("direction", _DIRECTION.in_language(language), "", design.direction)
    for name, log in study.measurements.conditions.items():
        at = log[study.observed.reading]
        if np.isnan(at).all():
            continue
        at, title, unit = convert_condition(name, at)
        yield _make_axis(name, title.in_language(language), unit, at)


def _make_axis(key: str, title: str, unit: str, values: FloatArray) -> dict[str, Any]:
    return {"key": key, "title": title, "unit": unit, "values": collect_drawn_values(values)}


def collect_drawn_values(values: FloatArray) -> list[float | None]:
    """Return values in the units of the page as JSON has them: NaN, which it has not, is nothing."""
    return [None if value != value else value for value in np.round(values, _DECIMALS).tolist()]  # noqa: PLR0124 - NaN is what differs from itself


def _list_failing_readings(failure: Failure, diagnosis: AxisDiagnosis, study: Study) -> list[int]:
    """Return the places of the readings that show a failure, in the measurement set; none where all do."""
    if failure.test is ResidualTest.OUTLIERS:
        return [int(each) for each in diagnosis.outliers]
    kept = study.observed.reading[~np.isin(study.observed.reading, diagnosis.outliers)]
    return [int(each) for each in kept[failure.readings[failure.readings < len(kept)]]]
