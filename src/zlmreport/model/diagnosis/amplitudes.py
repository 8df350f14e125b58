"""Searches the amplitudes of noise and of nameless curves beside a set of effects.

A part after another gets its best level, all others as they are, until none gains anything. Of smooth curves
all levels are looked at, of irregular shares those next to the one there is, and in the end all in the place
of a smooth curve.
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

        `columns`: The places of the columns of each member of the set.
        `levels`: How many levels of each part are thought of.
        """
        key = levels, start, frozenset(each.tobytes() for each in columns)
        if key not in self._known:
            self._known[key] = self._find_near(start, columns, levels)
        return self._known[key]

    def _find_near(self, start: Amplitudes, columns: Sequence[IntArray], levels: Amplitudes) -> Amplitudes:
        now = tuple(min(level, most - 1) for level, most in zip(start, levels, strict=True))
        best = self._contest.compute_criterion(now, columns)
        for turn in range(_ROUNDS):
            before = best
            best, now = self._choose_smooth(best, now, columns, levels)
            best, now = self._choose_irregular(best, now, columns, levels, is_first=not turn)
            if best > before - _SETTLED:
                instead = self._find_irregular_instead(best, now, columns, levels)
                if instead is None:
                    break
                best, now = instead
        return now

    def _choose_smooth(
        self, best: float, now: Amplitudes, columns: Sequence[IntArray], levels: Amplitudes
    ) -> tuple[float, Amplitudes]:
        """Return amplitudes in which smooth curves have better levels, one after another."""
        contest = self._contest
        smooth = [number for number, part in enumerate(contest.parts) if part.irregular is None]
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
        return best, now

    def _choose_irregular(
        self, best: float, now: Amplitudes, columns: Sequence[IntArray], levels: Amplitudes, *, is_first: bool
    ) -> tuple[float, Amplitudes]:
        """Return amplitudes in which irregular shares have better levels, next to those that there are."""
        for number, part in enumerate(self._contest.parts):
            if part.irregular is None:
                continue
            level, noise = now[number], part.noise_levels
            others = {1, noise - 1, noise, noise + 2} if is_first and not level else {0, level - 1, level + 1}
            for other in sorted(others - {level}):
                if 0 <= other < levels[number]:
                    criterion = self._contest.compute_criterion(move_amplitude(now, number, other), columns)
                    if criterion < best - _NOTHING:
                        best, now = criterion, move_amplitude(now, number, other)
        return best, now

    def _find_irregular_instead(
        self, best: float, now: Amplitudes, columns: Sequence[IntArray], levels: Amplitudes
    ) -> tuple[float, Amplitudes] | None:
        """Return better amplitudes in which an irregular share takes the place of a smooth curve.

        Where targets are few either describes the readings, and the one that is there keeps the other away.
        """
        parts, found = self._contest.parts, None
        for number, part in enumerate(parts):
            if part.irregular is None or now[number] >= part.noise_levels:
                continue
            for other in (place for place, level in enumerate(now) if level >= parts[place].noise_levels):
                for level in range(part.noise_levels, levels[number]):
                    moved = move_amplitude(move_amplitude(now, other, 0), number, level)
                    criterion = self._contest.compute_criterion(moved, columns)
                    if criterion < best - _NOTHING:
                        best, found = criterion, (criterion, moved)
        return found

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
