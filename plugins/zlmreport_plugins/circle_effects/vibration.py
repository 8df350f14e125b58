"""The effect of a vibration of the machine on a circle."""

from __future__ import annotations

import numpy as np

from zlmreport.plugin import MICROMETRE, Words
from zlmreport.plugin.circle_effect import (
    HERTZ,
    CircleDesign,
    CircleEffect,
    CircleTerm,
    Law,
    Parity,
    Searched,
    SearchedParameter,
)

#: Oscillations a turn: from more than geometry has to as many as the readings resolve.
_FEWEST, _MOST, _READINGS_OF_ONE = 8.0, 70.0, 2.5
#: Steps of the search in oscillations a turn, for few turns and for many.
_FINE, _COARSE, _FEW_TURNS = 0.5, 1.0, 4


class Vibration(CircleEffect):
    """A·sin(2πf·t + ψ), ψ of each turn its own: fixed in Hz, so that its order falls with the feed."""

    identifier = "vibration"
    title = Words("Vibration")
    equation = "A·sin(2πf·t + ψ), each turn its own"
    explains = Words("an oscillation of a fixed frequency")
    law = Law(Parity.IN_TIME, feed=None, radius=None)
    searched = (SearchedParameter("frequency", HERTZ, is_refined=True, title=Words("frequency")),)

    def grid(self, design: CircleDesign) -> list[Searched]:
        """Return frequencies that the readings of every turn resolve."""
        turns_a_second = design.feed / design.radius / (2.0 * np.pi)
        slowest, fastest = float(turns_a_second.min()), float(turns_a_second.max())
        step = _FINE if len(design.turns) <= _FEW_TURNS else _COARSE
        most = min(design.fewest_of_a_turn / _READINGS_OF_ONE, _MOST)
        return [(each,) for each in np.arange(_FEWEST * fastest, most * slowest, step * slowest).tolist()]

    def terms(self, design: CircleDesign, searched: Searched) -> list[CircleTerm]:
        """Return sine and cosine of each turn."""
        # Time by the path: what is logged may be rounded or missing.
        phase = 2.0 * np.pi * searched[0] * design.travelled * design.radius / design.feed
        return [
            CircleTerm(
                f"{name} of turn {turn + 1}", MICROMETRE, (design.turn == turn) * wave(phase), "all",
                low=-1e-4, high=1e-4, usual=2e-6, title=_OF_TURN.given(wave=name, turn=turn + 1),
            )
            for turn in design.turns.tolist()
            for name, wave in (("sin", np.sin), ("cos", np.cos))
        ]  # fmt: skip


_OF_TURN = Words("{wave} of turn {turn}")
