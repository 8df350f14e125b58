"""Whether the axis comes to the next target from the right side, runs through it, or is too slow there."""

from __future__ import annotations

from collections.abc import Iterator

from zlmreport.live.capture.events import Event, Passed, Settling
from zlmreport.live.capture.progress import Progress
from zlmreport.live.capture.standstill import Track
from zlmreport.live.capture.visits import ListedVisit, Settings


class WayAhead:
    """Follows an axis to the first visit that is neither taken nor passed.

    `settings`: With tolerance and stability range of the targets.
    """

    def __init__(self, settings: Settings) -> None:
        self._settings = settings
        self._passed = 0
        #: When the axis came into the tolerance of that visit, s; None if it did not, or nobody saw.
        self.inside_since: float | None = None
        self._comes_from_its_side = False
        #: When and where the axis nearly stood, first and last.
        self._crept: tuple[float, float] | None = None
        self._crept_last = (0.0, 0.0)

    def begin(self) -> None:
        """Begin with the visit that is next."""
        self._passed = 0
        self.forget()

    def forget(self) -> None:
        """Forget how the axis came to the visit ahead: it is another one now, or nobody saw."""
        self._comes_from_its_side = False
        self.inside_since = None

    def follow(self, time: float, track: Track, progress: Progress, stood: float) -> Iterator[Event]:
        """Follow the axis into the tolerance of the visit ahead, and through it.

        `time`: Of the reading after which the axis is where its track ends, s.
        `stood`: How long it has stood there, s.
        """
        position = track.position
        while position is not None and (index := progress.taken + self._passed) < len(progress.visits):
            visit = progress.visits[index]
            if self.inside_since is None:
                self._comes_from_its_side |= not progress.must_check and self._is_before(visit, track)
                if not (self._comes_from_its_side and self._is_at_or_beyond(visit, track)):
                    return
                self.inside_since = time
                self._crept = None
                yield Settling(visit)
            if abs(position - visit.position) <= self._settings.tolerance + self._settings.motion:
                if stood >= self._settings.still / 4:
                    self._crept_last = (time, position)
                    self._crept = self._crept or self._crept_last
                return
            yield Passed(visit, time - self.inside_since, self._drift)
            self._passed += 1
            self.forget()

    @property
    def _drift(self) -> float | None:
        """How fast the readings went on at a target, too slow for a motion; None if they did not."""
        if self._crept is None:
            return None
        (begin, first), (end, last) = self._crept, self._crept_last
        is_long = end - begin >= self._settings.still / 2
        return (
            (last - first) / (end - begin)
            if is_long and abs(last - first) >= 3 * self._settings.stability
            else None
        )

    def _is_before(self, visit: ListedVisit, track: Track) -> bool:
        """Tell whether the axis is, or just was, on the side of a target from which it is to come."""
        seen = (track.position, track.before)
        way_to_go = max((visit.position - each) * visit.approach for each in seen if each is not None)
        return way_to_go > self._settings.tolerance

    def _is_at_or_beyond(self, visit: ListedVisit, track: Track) -> bool:
        """Tell whether the axis goes towards a target and is inside its tolerance, or has run over it."""
        assert track.position is not None  # noqa: S101 - the caller has seen it
        is_there = (visit.position - track.position) * visit.approach <= self._settings.tolerance
        return is_there and track.direction is visit.approach
