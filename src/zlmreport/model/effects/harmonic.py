"""Periodic effects: sine and cosine are linear parameters; people read amplitude and phase.

A·sin(h·ψ + φ) = γ_s·sin(h·ψ) + γ_c·cos(h·ψ) with γ_s = A·cos φ and γ_c = A·sin φ. The names of the
parameters tell the pairs: ``sine`` and ``cosine`` of the fundamental, ``sine_2`` and ``cosine_2`` of the
second harmonic, and so on.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from zlmreport.language import Words
from zlmreport.measurement.arrays import FloatArray
from zlmreport.model.effects.effect import Dimension, Parameter

_SINE, _COSINE = "sine", "cosine"
_DESCRIPTIONS = {
    _SINE: Words("sine part of harmonic {order}"),
    _COSINE: Words("cosine part of harmonic {order}"),
}


@dataclass(frozen=True, slots=True)
class Harmonic:
    """A harmonic as people read it."""

    order: int  #: h: 1 for the fundamental.
    #: amplitude and amplitude_uncertainty: A ≥ 0 and its standard uncertainty, SI.
    amplitude: float
    #: phase and phase_uncertainty: φ of A·sin(hψ + φ), −π < φ ≤ π, and its standard uncertainty, rad. A phase
    #: means nothing where the amplitude is within its uncertainty; the uncertainties are those of a linear
    #: propagation.
    phase: float
    amplitude_uncertainty: float
    phase_uncertainty: float


def make_harmonic_parameters(orders: Sequence[int], largest: float) -> tuple[Parameter, ...]:
    """Return the linear parameters of harmonics, in the order of their columns.

    Parameters
    ----------
    orders
        h of each harmonic.
    largest
        The largest plausible amplitude, m or rad.
    """
    return tuple(
        Parameter(
            name if order == 1 else f"{name}_{order}",
            f"A_{{{letter}{order}}}",
            Dimension.DEVIATION,
            _DESCRIPTIONS[name].given(order=order),
            -largest,
            largest,
        )
        for order in orders
        for name, letter in ((_SINE, "s"), (_COSINE, "c"))
    )


def make_harmonic_columns(angle: FloatArray, orders: Sequence[int]) -> FloatArray:
    """Return sine and cosine of each harmonic, shape (N, 2·len(orders)).

    Parameters
    ----------
    angle : (N,) array
        ψ, the angle within the fundamental period, rad.
    orders
        h of each harmonic.
    """
    return np.column_stack([wave(order * angle) for order in orders for wave in (np.sin, np.cos)])


def find_harmonics(
    parameters: Sequence[Parameter], values: FloatArray, covariance: FloatArray
) -> tuple[Harmonic, ...]:
    """Return the harmonics among estimated parameters; empty for an effect that is not periodic.

    `values`, (k,): Their estimates, SI.
    `covariance`, (k, k): Of the estimates.
    """
    index = {parameter.name: place for place, parameter in enumerate(parameters)}
    found = []
    for name, sine in index.items():
        kind, _, order = name.partition("_")
        cosine = index.get(name.replace(_SINE, _COSINE, 1))
        if kind == _SINE and cosine is not None:
            pair = [sine, cosine]
            found.append(_make_harmonic(int(order or 1), values[pair], covariance[np.ix_(pair, pair)]))
    return tuple(found)


def _make_harmonic(order: int, pair: FloatArray, covariance: FloatArray) -> Harmonic:
    amplitude = float(np.hypot(*pair))
    along = pair / amplitude if amplitude else np.array([1.0, 0.0])
    across = np.array([-along[1], along[0]])
    return Harmonic(
        order,
        amplitude,
        float(np.arctan2(pair[1], pair[0])),
        float(np.sqrt(along @ covariance @ along)),
        float(np.sqrt(across @ covariance @ across) / amplitude) if amplitude else float("inf"),
    )
