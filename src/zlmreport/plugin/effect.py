"""The door of effects: what one depends on, its parameters and needs, and what is said of a model of them."""

from __future__ import annotations

from zlmreport.model.diagnosis.report import (
    report_error,
    report_model,
    report_precision,
)
from zlmreport.model.effects.catalogue import (
    read_effects_of_catalogue as effects_of_catalogue,
    read_measurements_of_catalogue as measurements_of_catalogue,
)
from zlmreport.model.effects.design import (
    Design,
)
from zlmreport.model.effects.effect import (
    Confusion,
    Dimension,
    Effect,
    Parameter,
    Shape,
    needs_both_directions,
    needs_linear_axis,
    needs_logged,
    needs_passing_time,
    needs_rotary_axis,
    needs_runs,
    needs_stated,
    needs_targets,
    needs_whole_period,
)
from zlmreport.model.effects.harmonic import (
    make_harmonic_columns as harmonic_columns,
    make_harmonic_parameters as harmonic_parameters,
)
from zlmreport.model.effects.searching import (
    search_grid,
)

__all__ = [
    "Confusion",
    "Design",
    "Dimension",
    "Effect",
    "Parameter",
    "Shape",
    "effects_of_catalogue",
    "harmonic_columns",
    "harmonic_parameters",
    "measurements_of_catalogue",
    "needs_both_directions",
    "needs_linear_axis",
    "needs_logged",
    "needs_passing_time",
    "needs_rotary_axis",
    "needs_runs",
    "needs_stated",
    "needs_targets",
    "needs_whole_period",
    "report_error",
    "report_model",
    "report_precision",
    "search_grid",
]
