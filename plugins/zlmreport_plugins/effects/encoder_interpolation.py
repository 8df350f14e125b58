"""The interpolation within a signal period of the scale is not even."""

from __future__ import annotations

import numpy as np

from zlmreport.plugin import (
    Axis,
    Design,
    Dimension,
    Effect,
    FloatArray,
    Parameter,
    Shape,
    Words,
    harmonic_columns,
    harmonic_parameters,
    needs_whole_period,
)
from zlmreport_plugins.effects.harmonic_options import COMBINATIONS, HarmonicOptions

_KEY = "axis.signal_period"
_LARGEST = 2e-6


class EncoderInterpolation(Effect):
    """Offset, unequal amplitudes and phase of an encoder's two signals: an error within each signal period.

    Makers state 1 % to 2 % of the signal period: 0.2 µm to 0.4 µm at 20 µm. The period is exact in the
    encoder's own positions, so it is known; targets must be true to a micrometre, and at random fractions
    of the period, or the error looks like independent noise. Micro steps over two or three signal periods
    show it plainly.
    """

    identifier = "encoder-interpolation"
    title = Words(en="Interpolation error of the encoder", de="Interpolationsabweichung des Messsystems")
    equation = "Σ A_{h}·sin(2π·h·P/Λ_{s} + φ_{h})"
    searched = (
        Parameter(
            "period",
            "Λ_{s}",
            Dimension.POSITION,
            Words(en="signal period of the scale", de="Signalperiode des Maßstabs"),
            0.0,
        ),
    )
    shape = Shape.POSITION
    look = Words(
        en="The residuals look like noise over the travel; folded at the signal period they lie on a wave.",
        de="Die Residuen sehen über dem Verfahrweg wie Rauschen aus; über der Signalperiode gefaltet "
        "liegen sie auf einer Welle.",
    )
    options = HarmonicOptions

    def __init__(self, settings: HarmonicOptions | None = None) -> None:
        self.settings = settings or HarmonicOptions()
        self.orders = self.settings.harmonics
        self.linear = harmonic_parameters(self.orders, _LARGEST)

    def with_settings(self, settings: HarmonicOptions) -> Effect:
        """Return the effect with the stated harmonics."""
        return EncoderInterpolation(settings)

    def forms(self) -> tuple[Effect, ...]:
        """Return the combinations of harmonics that a contest tries."""
        return tuple(EncoderInterpolation(HarmonicOptions(harmonics=orders)) for orders in COMBINATIONS)

    def untestable(self, design: Design) -> Words | None:
        """Demand the signal period, and a travel that holds one."""
        return needs_whole_period(design, design.axis.signal_period, _KEY)

    def grid(self, design: Design) -> FloatArray:
        """Return the signal period that the job states: it is known."""
        return np.array([[design.axis.signal_period]], dtype=np.float64)

    def columns(self, design: Design, theta: FloatArray) -> FloatArray:
        """Return sine and cosine of each harmonic."""
        return harmonic_columns(2 * np.pi * design.position / theta[0], self.orders)

    def expected(self, axis: Axis) -> dict[str, float]:
        """Return the signal period."""
        return {} if axis.signal_period is None else {"period": axis.signal_period}
