"""Which visit of the plan a stop is, as a probability, where visits were missed, repeated or not seen.

Each stop is explained in all the ways that could have led to it: the program went on, visits went unseen, the
operator went back over a target, somebody began anew elsewhere, or it is no stop of the program at all. What
was seen weighs most: between two visits a program turns round at known places. Where nothing was seen, in a
silence of the line, time stands in. What is left is a probability for each visit of the list; a reading is
filed only where one explanation is clear.
"""

from __future__ import annotations

from collections import defaultdict, deque
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from math import exp, hypot, inf, log, pi, sqrt
from statistics import median

from zlmreport.live.capture.events import Mean
from zlmreport.live.capture.motion import PlannedRoute, Route, TurningPoint
from zlmreport.live.capture.visits import FASTEST, Settings
from zlmreport.measurement.approach import Approach

#: A reading is filed if all other explanations together are less probable than the first, and those by which
#: it is another visit's than the second; that a stop is none of the program's harms less to believe, for
#: later stops can still say otherwise.
_DOUBT, _DOUBT_OF_OTHERS, _DOUBT_OF_NONE = 0.01, 3e-3, 0.1
#: From so much doubt on it is said how probable the visit is.
WORTH_SAYING = 1e-3
#: Explanations that are less probable than this beside the best are dropped.
_HOPELESS = -18.0
# The rest are logarithms of how often such a thing happens at a stop: judgement of how operators work.
#: Each visit that went unseen on the way: eleven are eleven times as improbable as one. In a silence they are
#: to be expected, where the time that it took says how many.
_SKIPPED = -1.0
_UNSEEN, _EACH_UNSEEN = -0.5, -0.05
#: The same of a silence before the first visit, of which only the least length is known.
_EACH_IN_SILENCE = -0.3
#: The axis came back to its last visit; it went back and forth before one of the next three.
_REPEATED, _DETOUR = -4.0, -4.0
_NEAR = 3
#: A program began anew, at the beginning of a part of the test; anywhere else.
_BEGUN_ANEW, _ANYWHERE = -8.0, -13.0
#: No stop of the program: at the target that is next or was last, from its wrong side; before the program;
#: elsewhere.
_WRONG_SIDE, _BEFORE, _STRAY = -5.0, -5.0, -13.0
#: Before the program: not its first visit although nobody saw where the axis came from.
_NOT_FIRST = -6.0
#: The axis moved elsewhere before it came to the start of the program.
_WAY_TO_START = -3.0
#: A program that the operator was to begin at a visit ran on while nobody watched.
_RAN_ON = -7.0
#: What a turning point weighs that is where the program has it: an arbitrary one would lie anywhere.
_TURN, _OTHER_TURN = 3.0, -3.0
#: How often the axis turns round on its way to where a program begins anew.
_TURNS_TO_BEGIN = 2
#: A silence in which the axis also stood on hold; in which it hurried on, and each rest that it left out; how
#: improbable any time is.
_HELD, _HURRIED, _EACH_REST, _ANY_TIME = log(0.02), -3.0, -1.5, -2.3
_TOO_FAST = -20.0
#: How far the time of a program is off, as a logarithm: before it was measured, and at least.
_UNKNOWN_PACE, _STEADY_PACE = 0.3, 0.05
_STEPS = 15


@dataclass(frozen=True, slots=True)
class TargetStandstill:
    """A standstill at a target."""

    target: int  #: Its number, from 1.
    #: How the axis came from afar, by which the program is followed; None if nobody saw.
    heading: Approach | None
    #: How it came at last, which a reading needs: an overshoot turns it round. None if nobody saw.
    approach: Approach | None
    position: float  #: Where it stands, seen from the datum, m or rad.
    mean: Mean  #: The reading.


@dataclass(frozen=True, slots=True)
class _Guess:
    """One explanation of all that was seen."""

    place: int  #: Index of the visit that the program made last; −1 before its first.
    weight: float  #: Logarithm of its probability.
    time: float | None  #: When it was there, s; None if that is not known.
    #: turns and breaks: How many turning points and breaks had been seen then.
    turns: int
    breaks: int
    is_heading_known: bool = True  #: Whether it was seen how the axis came there.
    #: Whether the operator begins the program after `place`, from wherever the axis is.
    is_told: bool = False
    #: Which visit each of the stops is that are not decided yet; None for none. At last the stop before.
    files: tuple[int | None, ...] = (None,)


class PlaceInProgram:
    """Follows the program by its stops.

    `taken`: How many visits are taken or missed for good: the operator begins after them.
    `last`: When the last of them was, s, by the clock of the readings; None if the program cannot have run on
        since then.
    """

    def __init__(
        self, planned: PlannedRoute, settings: Settings, taken: int, last: float | None = None
    ) -> None:
        #: The stops of which it is not clear which visit they are, first come first.
        self.undecided: list[TargetStandstill] = []
        #: Numbers of the visits that the operator leaves out: that they go unseen is no wonder.
        self.left_out: frozenset[int] = frozenset()
        self._planned = planned
        self._settings = settings
        self._close = 2 * settings.tolerance
        self._paces: deque[float] = deque(maxlen=_STEPS)
        self._before: tuple[TargetStandstill, int, int] | None = None
        self._sure: tuple[int, float] | None = None
        self._guesses = [_Guess(taken - 1, 0.0, None, 0, 0, is_told=True)]
        if taken and last is not None:
            self._guesses.append(_Guess(taken - 1, _RAN_ON, last, 0, -1))

    def let_begin(self, taken: int, route: Route) -> None:
        """Take note that the operator may begin the program after so many visits, and not let it run on."""
        best = max(self._guesses, key=lambda guess: guess.weight)
        begun = replace(best, place=taken - 1, time=None, turns=len(route.turns), is_told=True)
        self._guesses.append(replace(begun, breaks=route.breaks, is_heading_known=True))

    def add(self, stop: TargetStandstill, route: Route) -> None:
        """Take the next stop in."""
        before, self._before = self._before, (stop, len(route.turns), route.breaks)
        self.undecided.append(stop)
        if before is not None and before[1:] == self._before[1:] and self._is_same(before[0], stop):
            self._guesses = [self._go_on(each, before[0], stop) for each in self._guesses]
            return
        found: dict[tuple[int, bool, tuple[int | None, ...]], list[_Guess]] = defaultdict(list)
        for guess in self._guesses:
            for after in self._explain(guess, stop, route):
                found[after.place, after.is_told, after.files].append(after)
        merged = [_merge(alike) for alike in found.values()]
        best = max(each.weight for each in merged)
        self._guesses = [
            replace(each, weight=each.weight - best) for each in merged if each.weight > best + _HOPELESS
        ]

    def _is_same(self, before: TargetStandstill, stop: TargetStandstill) -> bool:
        """Tell whether the axis only went on a little, on its way to the same target."""
        return before.target == stop.target and abs(before.position - stop.position) <= self._close

    def _go_on(self, guess: _Guess, before: TargetStandstill, stop: TargetStandstill) -> _Guess:
        """Return an explanation after the axis went on a little; now it may be seen how it came."""
        if before.heading is not None or stop.heading is None or guess.place < 0:
            return replace(guess, files=(*guess.files, guess.files[-1]))
        visit = self._planned.visits[guess.place]
        if (visit.target, visit.approach) == (stop.target, stop.heading):
            return replace(guess, files=(*guess.files, guess.place))
        return replace(guess, weight=guess.weight + _STRAY, files=(*guess.files, None))

    def settle_stops(self) -> Iterator[tuple[TargetStandstill, int | None, float]]:
        """Yield the stops that are clear by now, with the index of their visit and how probable that is.

        The index is None for no visit.
        """
        while self.undecided:
            odds = self.list_odds()
            best = max(odds, key=odds.__getitem__)
            if not _is_clear(odds, best):
                return
            self._settle(best, is_sure=best is not None)
            stop = self.undecided.pop(0)
            if best is not None:
                self._keep_pace(best, stop)
            yield stop, best, odds[best]

    def list_odds(self) -> dict[int | None, float]:
        """Return how probable it is which visit the first undecided stop is; None for none."""
        odds: dict[int | None, float] = defaultdict(float)
        at = -len(self.undecided)
        for guess in self._guesses:
            odds[guess.files[at]] += exp(guess.weight)
        total = sum(odds.values())
        return {index: each / total for index, each in odds.items()}

    def take_word(self, index: int | None) -> TargetStandstill:
        """Take the operator's word which visit the first undecided stop is; return that stop."""
        at = -len(self.undecided)
        if not any(guess.files[at] == index for guess in self._guesses) and index is not None:
            stop, turns, breaks = self._before or (self.undecided[0], 0, 0)
            files = (index, *[None] * (len(self.undecided) - 1))
            self._guesses = [_Guess(index, 0.0, stop.mean.time, turns, breaks, files=files)]
        self._settle(index, is_sure=index is not None)  # a program that began anew may stop short of a target
        return self.undecided.pop(0)

    def _settle(self, index: int | None, *, is_sure: bool) -> None:
        """Keep the explanations that agree; where it is no visit, the others too, for later stops."""
        at = -len(self.undecided)
        self._guesses = [
            replace(each, files=each.files[at:])
            for each in self._guesses
            if each.files[at] == index or not is_sure
        ]

    def _explain(self, guess: _Guess, stop: TargetStandstill, route: Route) -> Iterator[_Guess]:
        """Yield the explanations that one becomes by a stop."""
        candidates = self._planned.list_visits_at(stop.target, stop.heading)
        for index in candidates:
            weight = guess.weight + self._weigh(guess, index, stop, route, len(candidates))
            if weight > -inf:
                yield _Guess(
                    index,
                    weight,
                    stop.mean.time,
                    len(route.turns),
                    route.breaks,
                    is_heading_known=route.heading is not None,
                    files=(*guess.files, None if stop.heading is None else index),
                )
        is_on_its_way = guess.is_told and any(
            self._has_left_start(route.turns[guess.turns :], index, route) for index in candidates
        )
        stray = guess.weight + (_STRAY if is_on_its_way else self._weigh_stray(guess, stop))
        yield replace(guess, weight=stray, files=(*guess.files, None))

    def _weigh_stray(self, guess: _Guess, stop: TargetStandstill) -> float:
        """Return how probable it is that a stop is none of the program's."""
        visits, following = self._planned.visits, guess.place + 1
        if guess.is_told and following < len(visits):
            is_next = (visits[following].target, visits[following].approach) == (stop.target, stop.heading)
            return _STRAY if is_next else _BEFORE
        near = [visits[index] for index in (following, guess.place) if 0 <= index < len(visits)]
        sides = [visit.approach for visit in near if visit.target == stop.target]
        is_wrong = sides and stop.heading is not None and stop.heading not in sides
        return _WRONG_SIDE if is_wrong else _STRAY

    def _weigh(
        self, guess: _Guess, index: int, stop: TargetStandstill, route: Route, candidates: int
    ) -> float:
        """Return how probable it is that the program, where a guess has it, comes to stop at a visit."""
        planned, here = self._planned, guess.place
        turns = route.turns[guess.turns :]
        is_seen = route.breaks == guess.breaks
        jump = (_BEGUN_ANEW if planned.is_first_of_part(index) else _ANYWHERE) - log(candidates)
        if guess.is_told:
            return max(jump, self._weigh_from_rest(here, index, turns, route))
        if not is_seen:
            jump += _ANY_TIME
        else:
            jump = max(jump, self._weigh_new_beginning(index, turns) - log(candidates))
        if index == here:
            return max(jump, _REPEATED + (0.0 if is_seen else _ANY_TIME))
        if index < here:
            return jump
        unseen = self._count_unseen(here, index)
        if not is_seen:
            is_timed = guess.time is not None and self._settings.feed > 0
            skipped = _UNSEEN + (_EACH_UNSEEN if is_timed else _SKIPPED) * unseen if unseen else 0.0
            return max(jump, skipped + self._weigh_by_time(guess, index, stop))
        went_back = unseen < _NEAR and len(turns) > len(planned.list_turns(here, index))
        detour = _DETOUR + _SKIPPED * unseen if went_back else -inf
        return max(jump, detour, self._weigh_by_route(guess, index, turns))

    def _count_unseen(self, here: int, index: int) -> int:
        """Return how many visits lie between two; −1 for one that comes not later."""
        between = range(here + 2, index + 1)  # by their numbers
        return len(between) - len(self.left_out.intersection(between)) if index > here else -1

    def _weigh_new_beginning(self, index: int, turns: Sequence[float]) -> float:
        """Return how probable it is that a part began anew, by its own way; its first rests may be unseen."""
        unseen, way = self._planned.look_back_to_beginning(index)
        known = _BEGUN_ANEW + _TURN * min(len(turns), _TURNS_TO_BEGIN)
        if not unseen:
            return known
        came_so = unseen < _NEAR and self._weigh_turns(turns[-len(way) :], way) == _TURN * len(way)
        return known + _SKIPPED * unseen if came_so else -inf

    def _weigh_from_rest(self, here: int, index: int, turns: Sequence[float], route: Route) -> float:
        """Return how probable a first visit is, after which the operator was told to begin."""
        visits, unseen = self._planned.visits, self._count_unseen(here, index)
        if unseen < 0:
            return -inf
        skipped = _SKIPPED * unseen
        if here < 0 and self._has_left_start(turns, index, route):
            expected = len(self._planned.list_turns(-1, index))
            return skipped + _TURN * expected + (_WAY_TO_START if len(turns) > expected else 0.0)
        if unseen and self._may_have_begun_unseen(here, index, route):
            return _UNSEEN + _EACH_IN_SILENCE * unseen
        first = next(
            each
            for each in range(here + 1, len(visits))
            if (visits[each].target, visits[each].approach) == (visits[index].target, visits[index].approach)
        )
        if index > first:
            return -inf
        return skipped + _NOT_FIRST if unseen else 0.0

    def _may_have_begun_unseen(self, here: int, index: int, route: Route) -> bool:
        """Tell whether the program may have come so far while nobody saw it: most of that way, at least."""
        needed = self._planned.compute_time(here, index) - self._planned.compute_time(here, here + 1)
        return route.breaks > 0 and route.silence >= needed / 2

    def _has_left_start(self, turns: Sequence[float], index: int, route: Route) -> bool:
        """Tell whether the axis came from the start of the program, as the program does."""
        expected = self._planned.list_turns(-1, index)
        before = turns[: max(0, len(turns) - len(expected))]
        came_from = before[-1] if before else route.first if not route.breaks else None
        if came_from is None or abs(came_from - self._planned.start) > self._close:
            return False
        return self._weigh_turns(turns[len(before) :], expected) == _TURN * len(expected)

    def _weigh_by_route(self, guess: _Guess, index: int, turns: Sequence[float]) -> float:
        """Return how probable it is that the program went on to a visit, by where the axis turned round."""
        here = guess.place
        unseen = self._count_unseen(here, index)
        skipped = _SKIPPED * unseen
        expected = self._planned.list_turns(here, index)
        if not guess.is_heading_known and expected[:1] == [
            TurningPoint(self._planned.visits[here].position, None)
        ]:
            expected = expected[1:]  # whether it turned round where it stood nobody could see
        return skipped + self._weigh_turns(turns, expected)

    def _weigh_turns(self, turns: Sequence[float], expected: Sequence[TurningPoint]) -> float:
        """Return how well turning points are those of a program, whose overrun may be another one."""
        if len(turns) != len(expected):
            return -inf
        matches = 0
        for seen, planned in zip(turns, expected, strict=True):
            if abs(seen - planned.position) <= self._close:
                matches += 1
            elif planned.beyond is None or not self._is_beyond(seen, planned.position, planned.beyond):
                return -inf
        return _TURN * matches + _OTHER_TURN * (len(turns) > matches)

    def _is_beyond(self, seen: float, planned: float, target: float) -> bool:
        return abs(seen - target) > self._settings.tolerance and (seen > target) == (planned > target)

    def _weigh_by_time(self, guess: _Guess, index: int, stop: TargetStandstill) -> float:
        """Return how probable the time is that the program took to a visit while nobody saw it."""
        expected = self._planned.compute_time(guess.place, index)
        if guess.time is None or not self._settings.feed:
            return _ANY_TIME
        seconds = max(stop.mean.time - guess.time, 1e-3)
        off = log(seconds / expected) - self._pace
        spread = self._spread
        if stop.heading is None:  # it may have arrived at any time of its rest
            spread = hypot(spread, self._settings.stay / expected)
        steady = exp(-((off / spread) ** 2) / 2) / (spread * sqrt(2 * pi))
        held = exp(_HELD - off) if off > 0 else 0.0
        return max(log(steady + held + self._weigh_hurry(guess.place, index, seconds) + 1e-300), _TOO_FAST)

    def _weigh_hurry(self, here: int, there: int, seconds: float) -> float:
        """Return how probable it is that the program left out rests on its way to a visit."""
        stay, planned = self._settings.stay, self._planned.compute_time(here, there)
        if seconds < (planned - (there - here) * stay) / FASTEST:
            return 0.0
        return exp(_HURRIED + _EACH_REST * max(1.0, (planned - seconds) / stay))

    def _keep_pace(self, index: int, stop: TargetStandstill) -> None:
        """Learn from a step to the next visit how long the program takes, beside the plan."""
        before, self._sure = self._sure, (index, stop.mean.time)
        if before is None or index != before[0] + 1:
            return
        seconds = stop.mean.time - before[1]
        if seconds > 0:
            self._paces.append(log(seconds / self._planned.compute_time(before[0], index)))

    @property
    def _pace(self) -> float:
        return median(self._paces) if self._paces else 0.0

    @property
    def _spread(self) -> float:
        if len(self._paces) < _NEAR:
            return _UNKNOWN_PACE
        pace = self._pace
        return max(_STEADY_PACE, 1.5 * median(abs(each - pace) for each in self._paces))


def _is_clear(odds: Mapping[int | None, float], best: int | None) -> bool:
    """Tell whether it is clear enough that a stop is a visit, or none."""
    if best is None:
        return 1 - odds[best] <= _DOUBT_OF_NONE
    others = sum(share for index, share in odds.items() if index not in {None, best})
    return 1 - odds[best] <= _DOUBT and others <= _DOUBT_OF_OTHERS


def _merge(alike: Sequence[_Guess]) -> _Guess:
    """Return the best of explanations that end alike, with the weight of all."""
    best = max(alike, key=lambda each: each.weight)
    return replace(best, weight=best.weight + log(sum(exp(each.weight - best.weight) for each in alike)))
