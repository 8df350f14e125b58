"""Graphs of residuals over position, run, time and conditions; the bar chart of how the error falls."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from math import floor, log10

import numpy as np

from zlmreport.document.figures.figure import Bar, Curve, Figure, Level, Panel, Role
from zlmreport.document.figures.model_diagram import MODEL, RESIDUAL_TITLE, ModelDiagram
from zlmreport.document.figures.prescribed import MEANS, POSITION_TITLE, alternative_text
from zlmreport.language import Language, Words, same
from zlmreport.language.numbers import number_words, write_significant
from zlmreport.measurement.arrays import FloatArray, IntArray, read_only_floats
from zlmreport.measurement.measurement_set import CONDITION_NAMES, CONDITIONS
from zlmreport.measurement.units import SECONDS_PER_MINUTE, write_behind
from zlmreport.model.diagnosis.candidate import EffectCandidate
from zlmreport.model.diagnosis.study import Fitted
from zlmreport.model.effects.design import Design
from zlmreport.model.effects.effect import Dimension, find_unit_of

#: Groups of readings that follow one another, through whose means a curve leads.
_GROUPS = 12
_LONG = 600.0

_AGAINST_MODEL = Words(
    "Readings and error model over the target position; below, what the model leaves of the readings "
    "(residual e = x − x̂), with twice the scatter of single readings"
)
_OVER = Words("Residuals over {quantity}, with twice the scatter of single readings")
_SLOPE = Words("Slope of the residuals")
_SLOPES = Words("Slope over the position of what the model leaves of each pass, over {quantity}")
_SLOPES_RANGE = Words("{caption}: from {low} to {high}{unit}.")
_MEASURED = Words("Measured and model")
_RUN = (Words("Run"), Words("the run"))
_TIME = (Words("Time"), Words("time"))
_COUNTED = (
    Words("Number of the reading"),
    Words("their order"),
)


def draw_over_position(diagram: ModelDiagram) -> Figure:
    """Return readings and model, and the residuals below, over the target position for each direction."""
    fit, x = diagram.fit, diagram.positions
    model, residual = [], []
    for approach in diagram.approaches:
        chosen = diagram.select(approach)
        arrow, targets = approach.arrow, fit.design.target[chosen]
        model.append(
            diagram.draw_means(f"x̂_{{i}}{arrow}", MODEL[approach], x[chosen], fit.fitted[chosen], targets)
        )
        residual.append(
            diagram.draw_means(f"ē_{{i}}{arrow}", MEANS[approach], x[chosen], fit.residual[chosen], targets)
        )
    return diagram.make_figure(
        "model",
        _AGAINST_MODEL,
        alternative_text(
            diagram.say_range(Words("Readings"), fit.deviation),
            diagram.say_range(Words("Model"), fit.fitted),
            *diagram.say_residuals(),
        ),
        POSITION_TITLE,
        diagram.axis.position_unit.symbol,
        Panel(heading=_MEASURED, curves=tuple(model), readings=diagram.draw_readings(x, fit.deviation)),
        Panel(
            heading=RESIDUAL_TITLE,
            curves=tuple(residual),
            readings=diagram.draw_readings(x, fit.residual),
            bands=(diagram.draw_scatter(x),),
        ),
    )


def draw_over_run(diagram: ModelDiagram) -> Figure:
    """Return the residuals over the number of the run, with the mean of each run and direction."""
    runs = diagram.design.run
    curves = [
        diagram.draw_means(
            f"ē{approach.arrow}", MEANS[approach], runs[chosen].astype(np.float64), residual, runs[chosen]
        )
        for approach in diagram.approaches
        for chosen in (diagram.select(approach),)
        for residual in (diagram.fit.residual[chosen],)
    ]
    panel = _make_panel(diagram, runs.astype(np.float64))
    return _draw_residuals(diagram, "run", _RUN, "", replace(panel, curves=tuple(curves)))


def draw_over_time(diagram: ModelDiagram) -> Figure:
    """Return the residuals over time, or in their order where the source tells no times."""
    time, quantity, unit = choose_time(diagram.design)
    return _draw_residuals(diagram, "time", quantity, unit, _make_panel(diagram, time))


def choose_time(design: Design) -> tuple[FloatArray, tuple[Words, Words], str]:
    """Return when each reading was taken, what that is called alone and in a sentence, and its unit."""
    if design.time_is_counted:
        return 1.0 + design.time, _COUNTED, ""
    if design.duration > _LONG:
        return design.time / SECONDS_PER_MINUTE, _TIME, "min"
    return design.time, _TIME, "s"


def draw_slopes_over_time(diagram: ModelDiagram) -> Figure:
    """Return the slope over the position of what the model leaves of each pass, at the mean time of the pass.

    Whatever warms turns the straight line from pass to pass.
    """
    design, residual = diagram.design, diagram.fit.residual
    time, (title, in_sentence), unit_of_time = choose_time(design)
    slope = find_unit_of(Dimension.SLOPE, diagram.axis.kind)
    curves = []
    for approach in diagram.approaches:
        passes = [(diagram.select(approach)) & (design.run == run) for run in np.unique(design.run)]
        seen = [each for each in passes if len(np.unique(design.position[each])) > 1]
        slopes = [np.polyfit(design.position[each], residual[each], 1)[0] * slope.per_si for each in seen]
        times = [float(time[each].mean()) for each in seen]
        curves.append(
            Curve(f"b{approach.arrow}", MEANS[approach], read_only_floats(times), read_only_floats(slopes))
        )
    values = np.concatenate([each.y for each in curves])
    ends = {"low": write_significant(values.min()), "high": write_significant(values.max())}
    caption = _SLOPES.given(quantity=in_sentence)
    return Figure(
        key="slopes-time",
        title=caption,
        alternative=alternative_text(
            _SLOPES_RANGE.given(caption=caption, unit=write_behind(slope.symbol), **ends)
        ),
        x_title=title,
        y_title=_SLOPE,
        x_unit=unit_of_time,
        y_unit=slope.symbol,
        panels=(Panel(curves=tuple(curves)),),
    )


def draw_over_condition(diagram: ModelDiagram, condition: str) -> Figure:
    """Return the residuals over a condition that was logged beside the readings."""
    log, name, unit = convert_condition(condition, diagram.design.conditions[condition])
    # A column that a user has named is called so everywhere.
    in_sentence = same(_InSentence(name)) if condition in CONDITION_NAMES else name
    return _draw_residuals(
        diagram, condition.replace("_", "-"), (name, in_sentence), unit, _make_panel(diagram, log)
    )


def convert_condition(condition: str, log: FloatArray) -> tuple[FloatArray, Words, str]:
    """Return a logged condition (SI) in the unit that is printed, what it is called, and that unit."""
    name = CONDITION_NAMES.get(condition, same(condition))
    if condition not in CONDITIONS:
        return log, name, ""
    scale = CONDITIONS[condition].unit
    return scale.from_si(log), name, scale.symbol


@dataclass(frozen=True, slots=True)
class _InSentence:
    """A name within a sentence: only German keeps its capital."""

    name: Words

    def in_language(self, language: Language) -> str:
        text = self.name.in_language(language)
        return text if language is Language.GERMAN else text[:1].lower() + text[1:]


def _draw_residuals(
    diagram: ModelDiagram, key: str, quantity: tuple[Words, Words], unit: str, panel: Panel
) -> Figure:
    title, in_sentence = quantity
    caption = _OVER.given(quantity=in_sentence)
    return diagram.make_figure(
        f"residuals-{key}",
        caption,
        alternative_text(Words("{caption}.").given(caption=caption), *diagram.say_residuals()),
        title,
        unit,
        panel,
        y_title=RESIDUAL_TITLE,
    )


def _make_panel(diagram: ModelDiagram, x: FloatArray) -> Panel:
    """Return the residuals over anything that changes from reading to reading."""
    residual = diagram.fit.residual
    curve = diagram.draw_means("ē", Role.MEAN_BIDIRECTIONAL, x, residual, _group_followers(x))
    return Panel(
        curves=(curve,),
        readings=diagram.draw_readings(x, residual),
        bands=(diagram.draw_scatter(x),),
    )


def _group_followers(x: FloatArray) -> IntArray:
    """Return groups of readings that follow one another: alike in number, like values together."""
    rank = np.unique(x, return_inverse=True)[1]
    share = np.searchsorted(np.sort(x), x, side="left") / len(x)
    group = np.floor(share * _GROUPS)
    return np.asarray(group if len(np.unique(rank)) > _GROUPS else rank, dtype=np.int64)


_TITLE = Words(
    "Root mean square error after each effect of the model; σ₀ is the noise floor, which no effect can "
    "take away"
)
_WITHOUT = Words("without model")
_ADDED = Words("+ {effect}")
_WITH = Words("with {effect}")
_BAR = Words("{label}: {value}{unit}.")
_FLOOR = Words("Noise floor: {value}{unit}.")
_X_TITLE = Words("Effects, one after another")
_Y_TITLE = Words("Root mean square error", context="axis of a graph")


def draw_fall_chart(history: Sequence[Fitted], missing: EffectCandidate | None = None) -> Figure:
    """Return the fall chart of a model, from the readings without a model to the whole of it.

    `missing`: What the model lacks: a last bar shows the error with it.
    """
    axis = history[-1].fit.design.axis
    unit = axis.deviation_unit
    further = [missing] if missing else []
    errors = [*(each.error for each in history), *(each.error for each in further)]
    values = [unit.from_si(each.rms) for each in errors]
    noise = history[-1].error.noise_rms
    decimals = _count_decimals(min(values))
    labels = [_WITHOUT, *(_ADDED.given(effect=name) for name in history[-1].fit.model.identifiers)]
    labels += [_WITH.given(effect=each.identifier) for each in further]
    bars = tuple(
        Bar(label, value, number_words(value, decimals)) for label, value in zip(labels, values, strict=True)
    )
    sentences = [_BAR.given(label=bar.label, value=bar.value, unit=write_behind(unit.symbol)) for bar in bars]
    levels: tuple[Level, ...] = ()
    if noise is not None:
        levels = (Level("σ₀", Role.TOLERANCE, unit.from_si(noise)),)
        written = number_words(unit.from_si(noise), decimals)
        sentences.append(_FLOOR.given(value=written, unit=write_behind(unit.symbol)))
    return Figure(
        key="fall",
        title=_TITLE,
        alternative=alternative_text(*sentences),
        x_title=_X_TITLE,
        y_title=_Y_TITLE,
        x_unit="",
        y_unit=unit.symbol,
        panels=(Panel(bars=bars, levels=levels),),
    )


def _count_decimals(value: float) -> int:
    """Return the decimals that show two significant digits of a value."""
    return max(0, 1 - floor(log10(value))) if value > 0 else 2
