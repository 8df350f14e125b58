"""The fall chart: the error that is left after each effect of a model, down to the noise floor."""

from __future__ import annotations

from collections.abc import Sequence
from math import floor, log10

from zlmreport.figures import alternatives
from zlmreport.figures.figure import Bar, Figure, Level, Panel, Role
from zlmreport.language import Words
from zlmreport.model import wording
from zlmreport.model.study import Fitted

_TITLE = Words(
    en="Root mean square error after each effect of the model; σ₀ is the noise floor, which no effect can "
    "take away",
    de="Quadratischer Mittelwert der Abweichungen nach jedem Einfluss des Modells; σ₀ ist das Grundrauschen, "
    "das kein Einfluss wegnehmen kann",
)
_WITHOUT = Words(en="without model", de="ohne Modell")
_ADDED = Words(en="+ {effect}", de="+ {effect}")
_BAR = Words(en="{label}: {value} {unit}.", de="{label}: {value} {unit}.")
_FLOOR = Words(en="Noise floor: {value} {unit}.", de="Grundrauschen: {value} {unit}.")
_X_TITLE = Words(en="Effects, one after another", de="Einflüsse, einer nach dem anderen")
_Y_TITLE = Words(en="Root mean square error", de="Quadratischer Mittelwert")


def fall_chart(history: Sequence[Fitted]) -> Figure:
    """Return the fall chart of a model, from the readings without a model to the whole of it."""
    axis = history[-1].fit.design.axis
    unit = axis.deviation_unit
    values = [unit.from_si(each.error.rms) for each in history]
    noise = history[-1].error.noise_rms
    decimals = _decimals(min(values))
    labels = [_WITHOUT, *(_ADDED.given(effect=name) for name in history[-1].fit.model.identifiers)]
    bars = tuple(
        Bar(label, value, wording.number(value, decimals))
        for label, value in zip(labels, values, strict=True)
    )
    sentences = [_BAR.given(label=bar.label, value=bar.value, unit=unit.symbol) for bar in bars]
    levels: tuple[Level, ...] = ()
    if noise is not None:
        levels = (Level("σ₀", Role.TOLERANCE, unit.from_si(noise)),)
        written = wording.number(unit.from_si(noise), decimals)
        sentences.append(_FLOOR.given(value=written, unit=unit.symbol))
    return Figure(
        key="fall",
        title=_TITLE,
        alternative=alternatives.text(*sentences),
        x_title=_X_TITLE,
        y_title=_Y_TITLE,
        x_unit="",
        y_unit=unit.symbol,
        panels=(Panel(bars=bars, levels=levels),),
    )


def _decimals(value: float) -> int:
    """Return the decimals that show two significant digits of a value."""
    return max(0, 1 - floor(log10(value))) if value > 0 else 2
