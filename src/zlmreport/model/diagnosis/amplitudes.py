"""Searches the amplitudes of noise and of nameless curves beside a set of effects.

A part after another gets its best level, all others as they are, until none gains anything. Of smooth curves
all levels are looked at, of irregular shares those next to the one there is.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from zlmreport.measurement.arrays import IntArray
from zlmreport.model.diagnosis.contest import Contest
from zlmreport.model.diagnosis.likelihood import Amplitudes

_ROUNDS = 8
#: What a round must gain for another, and a level to be taken.
_SETTLED, _NOTHING = 0.02, 1e-3


class AmplitudeSearch:
    """A search for amplitudes in a contest; a search over sets comes by the same ones again and again."""

    def __init__(self, contest: Contest) -> None:
        self._contest = contest
        self._known: dict[tuple[Amplitudes, Amplitudes, frozenset[bytes]], Amplitudes] = {}

    def find_near(self, start: Amplitudes, columns: Sequence[IntArray], levels: Amplitudes) -> Amplitudes:
        """Return the best amplitudes of all parts near others.

        Parameters
        ----------
        columns
            The places of the columns of each member of the set.
        levels
            How many levels of each part are thought of.
        """
        key = levels, start, frozenset(each.tobytes() for each in columns)
        if key not in self._known:
            self._known[key] = self._find_near(start, columns, levels)
        return self._known[key]

    def _find_near(self, start: Amplitudes, columns: Sequence[IntArray], levels: Amplitudes) -> Amplitudes:
        contest = self._contest
        now = tuple(min(level, most - 1) for level, most in zip(start, levels, strict=True))
        best = contest.compute_criterion(now, columns)
        irregular = [number for number, part in enumerate(contest.parts) if part.irregular is not None]
        smooth = [number for number in range(len(contest.parts)) if number not in irregular]
        for turn in range(_ROUNDS):
            before = best
            silent = [number for number in smooth if not now[number] and levels[number] > 1]
            for numbers in [silent, *self._list_alike(now, smooth)]:
                if not numbers:
                    continue
                tried = [
                    each[: levels[number]]
                    for number, each in zip(numbers, contest.by_level(now, columns, numbers), strict=True)
                ]
                leading = min(range(len(numbers)), key=lambda place: float(tried[place].min()))
                if tried[leading].min() < best - _NOTHING:
                    best = float(tried[leading].min())
                    now = move_amplitude(now, numbers[leading], int(np.argmin(tried[leading])))
            for number in irregular:
                level, noise = now[number], contest.parts[number].noise_levels
                others = {0, level - 1, level + 1} if level or turn else {1, noise - 1, noise, noise + 2}
                for other in sorted(others - {level}):
                    if 0 <= other < levels[number]:
                        criterion = contest.compute_criterion(move_amplitude(now, number, other), columns)
                        if criterion < best - _NOTHING:
                            best, now = criterion, move_amplitude(now, number, other)
            if best > before - _SETTLED:
                break
        return now

    def _list_alike(self, now: Amplitudes, smooth: Sequence[int]) -> Iterator[list[int]]:
        """Yield the parts that are something by themselves, and together with those of other lengths.

        A curve of one length that is as large as the other would be keeps that one away.
        """
        parts = self._contest.parts
        for number in smooth:
            if now[number]:
                alike = [each for each in smooth if parts[each].shape == parts[number].shape]
                yield [number]
                if len(alike) > 1:
                    yield alike


def move_amplitude(amplitudes: Amplitudes, number: int, level: int) -> Amplitudes:
    """Return amplitudes with another level of one part."""
    return (*amplitudes[:number], level, *amplitudes[number + 1 :])
