"""Faults of the data that look like effects: wrong direction, target, unit or clock; a lagging sensor.

A run is held against the others, as it stands and as it would be without a slip: directions exchanged, signs
turned, every reading moved by one target. Only a slip that takes away most of what repeats differ by, and far
more than any effect explains, is said. What the rows themselves show is sure, whatever the readings are.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from enum import StrEnum
from typing import TYPE_CHECKING

import numpy as np

from zlmreport.language import Words
from zlmreport.language.numbers import write_significant
from zlmreport.measurement.arrays import (
    BoolArray,
    FloatArray,
    IntArray,
    compute_left_beside,
    estimate_robust_deviation,
)
from zlmreport.measurement.axis import AxisKind
from zlmreport.measurement.other_unit import CORRECT_RUN, IN_ANOTHER_UNIT, find_run_in_another_unit
from zlmreport.model.effects import wording
from zlmreport.model.effects.design import Design
from zlmreport.model.fitting.observations import Observations, select_of_the_job, select_readings
from zlmreport.model.fitting.pauses import find_pauses
from zlmreport.model.fitting.repeats import estimate_noise_floor, find_repeats

if TYPE_CHECKING:
    from zlmreport.model.effects.effect import Effect
    from zlmreport.model.fitting.fit import Fit

#: Evidence, 2·ln of a likelihood ratio, that a slip must have, and by which it must surpass every effect.
_STRONG, _FARTHER = 20.0, 6.0
#: Share of the squares within the repeats that a slip must take away.
_MOST_OF_IT = 0.5
_FEWEST_RUNS = 3
#: m or rad: a whole test that deviates no more is likelier to be one in another unit.
_TINY = 1e-7
#: m or rad: repeats scatter by more on every machine whose deviations are not small as well, and by less.
_STILL, _SMALL, _WILD = 5e-9, 2e-6, 3e-4
#: Fewest targets among which one that is written wrongly is seen; m or rad by which it is off at least, and
#: how many times as far as any other without it, and as its readings scatter.
_FEWEST_TARGETS, _MISPLACED_BY, _MISPLACED = 8, 1e-4, 10.0
#: Of the distance between two targets, how far a reading of the wrong one may be off; and how many times the
#: scatter of all deviations it must stand off from them.
_NEAR, _STANDS_OFF = 0.1, 6.0
#: Lags of a sensor that are tried, s; evidence ahead of the best effect that surpasses it, and is as good.
_LAGS, _LAGGING, _AS_GOOD = (120.0, 300.0, 600.0, 1200.0), 10.0, -2.0
#: Squares that may be left, over those of the noise floor.
_NEARLY_NOISE = 1.3
_FEWEST_STUCK, _FEWEST_EQUAL = 20, 6
#: Tests in which readings may stay the same so long, if each repeats the one before as often as elsewhere.
_BY_CHANCE = 1e-3
#: Agreement of rows with their directions, or of runs with each other, that is clear.
_CLEAR = 0.5
_LIKELY, _ALMOST, _ALMOST_SURE, _EXACT = 0.9, 0.99, 50.0, 1e-6


class FaultKind(StrEnum):
    """What went wrong in recording, as results files name it."""

    SWAPPED_DIRECTION = "swapped-direction"
    WRONG_SIGN = "wrong-sign"
    WRONG_UNIT = "wrong-unit"
    SHIFTED_RUN = "shifted-run"
    DUPLICATED_RUN = "duplicated-run"
    WRONG_TARGET = "wrong-target"
    CLOCK_JUMP = "clock-jump"
    STUCK_SENSOR = "stuck-sensor"
    LAGGING_SENSOR = "lagging-sensor"
    SWAPPED_COLUMNS = "swapped-columns"


#: What is wrong in a log alone: what follows no log is told all the same.
_OF_LOGS = frozenset({FaultKind.STUCK_SENSOR, FaultKind.LAGGING_SENSOR, FaultKind.SWAPPED_COLUMNS})


@dataclass(frozen=True, slots=True)
class DataFault:
    """Something that looks wrong in the data."""

    kind: FaultKind  #: What went wrong.
    run: int | None  #: In which run; None where it is not one.
    probability: float  #: That it is so, against the best effect; 1 for what the rows themselves show.
    #: statement and remedy: What the data look like, and what to do, in sentences without a full stop.
    statement: Words
    remedy: Words
    explains: bool = False  #: Whether it explains more than any effect: then no effect is a candidate.

    @property
    def comes_first(self) -> bool:
        """Whether no cause is sought before it is mended: it is sure, or explains more than any effect."""
        return self.explains or (self.probability >= _ALMOST and self.kind not in _OF_LOGS)

    @property
    def is_sure(self) -> bool:
        """Whether the rows themselves show it."""
        return self.probability >= 1.0


def find_faults_of(
    observed: Observations,
    before: Fit,
    rivals: Sequence[Fit],
    effects: Iterable[Effect],
    *,
    changes: float,
) -> tuple[DataFault, ...]:
    """Return what looks wrong in the data; a run that two signs betray is named once.

    `before`: The job's model.
    `rivals`: The same with all effects that a contest found; nothing where it found none.
    `changes`: Evidence of what changes in time, or from run to run, without a name.
    """
    own = select_of_the_job(observed)
    recorded = find_recorded_faults(own.design, own.deviation)
    by_runs = run_faults(before, rivals, changes)
    lagging = find_lagging_sensors(before, rivals, effects, changes)
    known = {(each.kind, each.run): each for each in recorded}
    found = [known.pop((each.kind, each.run), each) for each in (*by_runs, *lagging)]
    return (*found, *known.values())


def find_pauses_between_runs(design: Design) -> Iterator[Words]:
    """Yield what is to be said of long gaps in time: what lies on either side is a session of its own."""
    for place in np.flatnonzero(find_pauses(design) & (np.diff(design.cycle) != 0)).tolist():
        hours = write_significant(float(design.time[place + 1] - design.time[place]) / 3600.0, 2)
        yield _GAP.given(hours=hours, before=int(design.run[place]), after=int(design.run[place + 1]))


def find_recorded_faults(design: Design, deviation: FloatArray) -> tuple[DataFault, ...]:
    """Return what the rows themselves show, without any model."""
    return (
        *_find_against_the_order(design),
        *_find_duplicated(design, deviation),
        *_find_wrong_targets(design, deviation),
        *_find_misplaced_target(design, deviation),
        *_find_stuck_readings(design, deviation),
        *_find_faults_of_the_clock(design),
        *_find_faults_of_sensors(design),
        *_find_faults_of_units(design, deviation),
    )


def run_faults(fitted: Fit, rivals: Sequence[Fit] = (), changes: float = 0.0) -> tuple[DataFault, ...]:
    """Return slips of single runs that explain what the repeats differ by.

    An effect that changes with time makes runs differ as well: a slip must leave less within the repeats than
    the model and any effect does, also one that is physically impossible, and surpass every shape without a
    name.

    `rivals`: The same with each of the best effects.
    `changes`: Evidence of what changes in time, or from run to run, without a name, on all degrees of freedom
        of the model.
    """
    design, deviation = fitted.design, fitted.deviation
    runs = np.unique(design.cycle)
    if len(runs) < _FEWEST_RUNS:
        return ()
    spread = find_repeats(design, deviation).squares
    # What the model explains already, no slip needs to.
    left_by_models = (find_repeats(each.design, each.residual).squares for each in (fitted, *rivals))
    by_effects = min((*left_by_models, spread))
    tried = [
        (kind, run, left, whole, count)
        for run in runs.tolist()
        for kind, left, whole, count in _try_slips(design, deviation, design.cycle == run)
    ]
    found = []
    for kind, run, left, whole, count in tried:
        if not left < _MOST_OF_IT * whole:
            continue
        least = max(left / whole, _EXACT)
        evidence = -count * float(np.log(least)) - 2 * float(np.log(len(tried)))
        by_rivals = -count * float(np.log(max(by_effects / spread, _EXACT)))
        # Repeats have fewer degrees of freedom than all readings: on these the evidence is compared.
        ahead = evidence - max(by_rivals, changes * count / fitted.degrees, 0.0)
        if evidence > _STRONG and ahead > 0:
            statement, remedy = _OF_RUNS[kind]
            fault = DataFault(
                kind, run, _compute_probability(ahead), statement.given(run=run), remedy, ahead > _FARTHER
            )
            found.append((evidence, fault))
    return tuple(fault for _, fault in sorted(found, key=lambda each: -each[0])[:1])


def find_lagging_sensors(
    fitted: Fit, rivals: Sequence[Fit], effects: Iterable[Effect], changes: float = 0.0
) -> tuple[DataFault, ...]:
    """Return a temperature log that explains as much as any effect, if its sensor lagged behind.

    `rivals`: The same with each of the best effects; nothing is said where none is better than nothing.
    `changes`: Evidence of what changes in time, or from run to run, without a name.
    """
    design, readings = fitted.design, len(fitted.deviation)
    floor = estimate_noise_floor(design, fitted.deviation)
    if not rivals or floor is None or design.time_is_counted or design.duration == 0:
        return ()
    # A lag turns a log into another: only one with which nothing is left is worth a word.
    enough = _NEARLY_NOISE * readings * floor**2
    moments = len(np.unique(design.time))
    base, least = fitted.compute_base(), min(float(np.sum(each.residual**2)) for each in rivals)
    found: list[tuple[float, str, float]] = []
    for name in design.conditions:
        if not name.endswith("temperature") or moments < _FEWEST_STUCK:
            continue
        log, rate = design.conditions[name], _compute_rate(design, name)
        for effect in _list_followers(effects, design, name):
            # What follows the log as it stands, as it does one that stands still, tells of no lag.
            as_logged = _sum_squares_beside(base, effect, design, fitted.open_deviation)
            for lag in _LAGS:
                corrected = replace(design, conditions={**design.conditions, name: log + lag * rate})
                left = _sum_squares_beside(base, effect, corrected, fitted.open_deviation)
                if left > enough or readings * np.log(as_logged / max(left, 1e-12 * as_logged)) < _LAGGING:
                    continue
                found.append((readings * float(np.log(least / max(left, 1e-12 * least))), name, lag))
    if not found:
        return ()
    most, name, lag = max(found)
    evidence = most - changes
    # The effect that leads was searched over as many time constants: neither pays more than the other.
    if evidence < _AS_GOOD:
        return ()
    statement = _LAGS_BEHIND.given(column=name, minutes=write_significant(lag / 60, 1))
    kind = FaultKind.LAGGING_SENSOR
    return (
        DataFault(
            kind, None, _compute_probability(evidence), statement, _OTHER_SENSOR, explains=evidence > _LAGGING
        ),
    )


def _sum_squares_beside(base: FloatArray, effect: Effect, design: Design, deviation: FloatArray) -> float:
    """Return the sum of squares that a model's columns leave of deviations with those of an effect beside."""
    columns = np.column_stack([base, effect.columns(design, effect.grid(design)[0])])
    return float(np.sum(compute_left_beside(columns, deviation) ** 2))


def _compute_rate(design: Design, name: str) -> FloatArray:
    """Return how fast a log changes at each reading, each session by its own clock, shape (N,)."""
    log, found = design.conditions[name], np.zeros(len(design.time))
    for session in np.unique(design.session):
        own = design.session == session
        moments, first = np.unique(design.time[own], return_index=True)
        if len(moments) > 1:
            found[own] = np.interp(design.time[own], moments, np.gradient(log[own][first], moments))
    return found


def _compute_probability(ahead: float) -> float:
    """Return the probability of a fault by its evidence ahead of the best effect; never quite one."""
    return min(_ALMOST, float(1.0 / (1.0 + np.exp(-min(ahead, _ALMOST_SURE) / 2))))


def _try_slips(
    design: Design, deviation: FloatArray, own: BoolArray
) -> Iterator[tuple[FaultKind, float, float, int]]:
    """Yield of each slip what is left within the repeats without it, what as it stands, with what degrees."""
    as_it_stands = find_repeats(design, deviation)
    whole, degrees = as_it_stands.squares, as_it_stands.degrees
    if design.is_bidirectional:
        turned = replace(design, direction=np.where(own, -design.direction, design.direction))
        yield FaultKind.SWAPPED_DIRECTION, find_repeats(turned, deviation).squares, whole, degrees
    negated = np.where(own, -deviation, deviation)
    yield FaultKind.WRONG_SIGN, find_repeats(design, negated).squares, whole, degrees
    for step in (1, -1):
        source = _find_moved_by(design, own, step)
        kept = np.flatnonzero(source >= 0)
        if len(kept) > len(deviation) // 2:
            subset = select_readings(design, kept)
            stands = find_repeats(subset, deviation[kept])
            left = find_repeats(subset, deviation[source[kept]]).squares
            yield FaultKind.SHIFTED_RUN, left, stands.squares, stands.degrees


def _find_moved_by(design: Design, own: BoolArray, step: int) -> IntArray:
    """Return for each reading that of the next target in the same run and direction, where it is of a run."""
    places = {
        (run, sign, target): place
        for place, (run, sign, target) in enumerate(
            zip(design.cycle.tolist(), design.direction.tolist(), design.target.tolist(), strict=True)
        )
    }
    source = np.arange(len(own))
    for place in np.flatnonzero(own).tolist():
        key = int(design.cycle[place]), float(design.direction[place]), int(design.target[place]) + step
        source[place] = places.get(key, -1)
    return np.asarray(source, dtype=np.int64)


def _list_followers(effects: Iterable[Effect], design: Design, log: str) -> Iterator[Effect]:
    """Yield forms of effects that follow a log and have nothing to be searched."""
    without = replace(
        design, conditions={name: each for name, each in design.conditions.items() if name != log}
    )
    for effect in effects:
        for form in effect.forms():
            follows = form.untestable(design) is None and form.untestable(without) is not None
            if follows and len(form.grid(design)) == 1:
                yield form


def _find_against_the_order(design: Design) -> Iterator[DataFault]:
    """Yield runs whose rows lead the other way than their directions say, where others do not.

    Where the axis turns at each target, its way says nothing of the direction: two rows of one direction are
    then neighbours because one between them is missing.
    """
    agrees = {}
    for run in np.unique(design.cycle).tolist():
        own = design.cycle == run
        steps = np.diff(design.position[own])
        same_way = np.diff(design.direction[own]) == 0
        along = np.sign(steps[same_way]) * design.direction[own][1:][same_way]
        leads = along.size > _CLEAR * len(steps)
        agrees[run] = float(np.mean(along)) if leads else 0.0
    rightly = sum(each > _CLEAR for each in agrees.values())
    for run, each in agrees.items():
        if each < -_CLEAR and rightly >= 1 and rightly >= len(agrees) / 2:
            statement, remedy = _OF_RUNS[FaultKind.SWAPPED_DIRECTION]
            words = _ORDER_SAYS_SO.given(statement=statement.given(run=run))
            yield DataFault(FaultKind.SWAPPED_DIRECTION, run, 1.0, words, remedy)


def _find_duplicated(design: Design, deviation: FloatArray) -> Iterator[DataFault]:
    """Yield runs that repeat another reading for reading, where readings do not repeat as a rule."""
    runs = {
        run: deviation[design.cycle == run][
            np.lexsort((design.direction[design.cycle == run], design.target[design.cycle == run]))
        ]
        for run in np.unique(design.cycle).tolist()
    }
    pairs = [
        (one, other) for one in runs for other in runs if one < other and len(runs[one]) == len(runs[other])
    ]
    alike = {pair: float(np.mean(runs[pair[0]] == runs[pair[1]])) for pair in pairs}
    for (one, other), share in alike.items():
        others = [each for pair, each in alike.items() if pair != (one, other)]
        usual = max(others, default=0.0) if len(runs) > _FEWEST_RUNS - 1 else 0.0
        if share == 1.0 and len(runs[one]) >= _FEWEST_EQUAL and (usual < _CLEAR) and np.ptp(runs[one]) > 0:
            statement = _DUPLICATED.given(run=other, first=one)
            yield DataFault(FaultKind.DUPLICATED_RUN, other, 1.0, statement, _EXCLUDE_RUN.given(run=other))


def _find_wrong_targets(design: Design, deviation: FloatArray) -> Iterator[DataFault]:
    """Yield readings that are off by the distance to another target."""
    targets = design.target_positions
    if len(targets) < _FEWEST_RUNS:
        return
    spacing = float(np.diff(targets).min())
    off = deviation - np.median(deviation)
    # Where targets lie micrometres apart, any deviation is the distance to some of them.
    least = max(0.5 * spacing, _STANDS_OFF * estimate_robust_deviation(off))
    for place in np.flatnonzero(np.abs(off) > least).tolist():
        other = int(np.argmin(np.abs(targets - design.position[place] - off[place])))
        if abs(targets[other] - design.position[place] - off[place]) < _NEAR * spacing:
            statement = _WRONG_TARGET.given(
                reading=wording.reading_at(design, place),
                target=wording.position(design.axis, float(targets[other])),
            )
            yield DataFault(FaultKind.WRONG_TARGET, int(design.cycle[place]), 1.0, statement, _CORRECT_TARGET)


def _find_misplaced_target(design: Design, deviation: FloatArray) -> Iterator[DataFault]:
    """Yield the target that was written wrongly: all its readings are off by a distance, those beside it not.

    No worn place is a tenth of a millimetre deep and ends before the next target. A step, or a bump, is there
    without any one of the targets as well.
    """
    # At some targets there may be no reading, or one of another session alone.
    targets, number = np.unique(design.position, return_inverse=True)
    if len(targets) < _FEWEST_TARGETS or not design.axis.measurand.is_position:
        return
    level = deviation.copy()
    for sign in np.unique(design.direction):
        level[design.direction == sign] -= np.median(deviation[design.direction == sign])
    means = np.array([np.median(level[number == each]) for each in range(len(targets))])
    off = _compute_distances_from_neighbours(targets, means)
    place = int(np.argmax(off)) + 1
    size = float(off[place - 1])
    others = _compute_distances_from_neighbours(np.delete(targets, place), np.delete(means, place))
    scatter = max(float(others.max()), float(np.std(level[number == place])))
    if size > max(_MISPLACED_BY, _MISPLACED * scatter):
        statement = _MISPLACED_TARGET.given(
            target=wording.position(design.axis, float(targets[place])),
            size=wording.deviation(design.axis, size),
        )
        yield DataFault(FaultKind.WRONG_TARGET, None, _ALMOST, statement, _CORRECT_TARGET)


def _compute_distances_from_neighbours(targets: FloatArray, means: FloatArray) -> FloatArray:
    """Return how far each mean but those at the ends is off the line between its neighbours, m or rad."""
    shares = (targets[1:-1] - targets[:-2]) / (targets[2:] - targets[:-2])
    return np.asarray(np.abs(means[1:-1] - (1 - shares) * means[:-2] - shares * means[2:]), dtype=np.float64)


def _find_stuck_readings(design: Design, deviation: FloatArray) -> Iterator[DataFault]:
    """Yield where readings stay the same, digit for digit, while the axis goes from target to target.

    A coarse instrument repeats itself as well: how often it does elsewhere says how long it may by chance,
    and where the axis has no error it reads the same in most other runs, too; without any nobody can say.
    """
    has_moved = np.diff(design.target) != 0
    stretch = np.concatenate([[0], np.cumsum(np.diff(deviation) != 0)])
    repeats = np.bincount(stretch[1:], weights=has_moved & (np.diff(stretch) == 0))
    count = int(repeats.max(initial=0))
    elsewhere = int(has_moved.sum()) - count
    share = min(1.0, max(int(repeats.sum()) - count, 1) / max(elsewhere, 1))
    if count < _FEWEST_EQUAL or len(deviation) * share**count > _BY_CHANCE:
        return
    stands = stretch == np.argmax(repeats)
    readings = np.flatnonzero(stands)
    first = int(readings[0])
    beside = deviation[np.isin(design.target, design.target[readings]) & ~stands]
    if not len(beside) or np.count_nonzero(beside == deviation[first]) > _CLEAR * len(beside):
        return
    statement = _STUCK_READINGS.given(count=len(readings), reading=wording.reading_at(design, first))
    yield DataFault(
        FaultKind.STUCK_SENSOR, int(design.cycle[first]), 1.0, statement, _LEAVE_EMPTY, explains=True
    )


def _find_faults_of_the_clock(design: Design) -> Iterator[DataFault]:
    """Yield where the time falls: what it leaps on within a run may be a pause."""
    if design.time_is_counted:
        return
    steps = np.diff(design.time)
    for place in np.flatnonzero(steps < 0).tolist()[:1]:
        statement = _CLOCK_FALLS.given(reading=wording.reading_at(design, place + 1))
        yield DataFault(FaultKind.CLOCK_JUMP, int(design.cycle[place + 1]), 1.0, statement, _CORRECT_CLOCK)


def _find_faults_of_sensors(design: Design) -> Iterator[DataFault]:
    """Yield logs that are in each other's columns, and logs that stopped while others went on."""
    outside = {
        name: not bool(np.all((low <= log) & (log <= high)))
        for name, log in design.conditions.items()
        for low, high in [_POSSIBLE.get(name, (-np.inf, np.inf))]
    }
    wrong = [name for name, is_outside in outside.items() if is_outside]
    if len(wrong) > 1:
        statement = _SWAPPED_COLUMNS.given(columns=", ".join(wrong))
        yield DataFault(FaultKind.SWAPPED_COLUMNS, None, 1.0, statement, _CORRECT_COLUMNS)
    changing = {name for name, log in design.conditions.items() if len(np.unique(log)) > len(log) // 4}
    for name, log in design.conditions.items():
        stuck = len(log) - 1 - int(np.flatnonzero(np.diff(log))[-1]) if np.ptp(log) > 0 else 0
        if name in changing and stuck > max(_FEWEST_STUCK, len(log) // 4):
            statement = _STUCK.given(column=name, count=stuck)
            yield DataFault(FaultKind.STUCK_SENSOR, None, _ALMOST, statement, _EXCLUDE_LOG)


def _find_faults_of_units(design: Design, deviation: FloatArray) -> Iterator[DataFault]:
    """Yield a run of another size than all others, or a test that is hardly any deviation at all."""
    run = find_run_in_another_unit(design.cycle, deviation)
    if run is not None:
        yield DataFault(FaultKind.WRONG_UNIT, run, _ALMOST, IN_ANOTHER_UNIT.given(run=run), CORRECT_RUN)
        return  # how far the whole scatters is that run's doing
    # A single reading at another target is no scatter.
    floor = estimate_robust_deviation(find_repeats(design, deviation).centred)
    largest = float(np.abs(deviation).max())
    if 0 < largest < _TINY:
        statement = _TINY_TEST.given(size=wording.deviation(design.axis, largest))
        yield DataFault(FaultKind.WRONG_UNIT, None, _LIKELY, statement, _STATE_UNITS)
    elif 0 < floor < _STILL and largest < _SMALL:
        statement = _STILL_TEST[design.axis.kind].given(size=wording.deviation(design.axis, floor))
        yield DataFault(FaultKind.WRONG_UNIT, None, _LIKELY, statement, _STATE_UNITS)
    elif floor > _WILD:
        statement = _WILD_TEST.given(size=wording.deviation(design.axis, floor))
        yield DataFault(FaultKind.WRONG_UNIT, None, _LIKELY, statement, _STATE_UNITS)


#: What a log can be at a machine, SI.
_POSSIBLE = {
    **dict.fromkeys(
        ("axis_temperature", "screw_temperature", "air_temperature", "material_temperature"), (253.15, 373.15)
    ),
    "air_pressure": (50_000.0, 110_000.0),
    "relative_humidity": (0.0, 1.0),
}
_ORDER_SAYS_SO = Words("{statement}; the order of its rows says so too")
_EXCLUDE_RUN = Words("measure run {run} again, or leave it out of the file")
_GAP = Words(
    "Between run {before} and run {after} lie {hours} h: these are two sessions. Put the later runs into "
    "a file and a job of their own, and name that under model.sessions; then each has its zero and its "
    "clock."
)
_DUPLICATED = Words("run {run} has the same readings as run {first}, digit for digit")
_WRONG_TARGET = Words("the reading at {reading} looks as if it had been taken at {target}")
_CORRECT_TARGET = Words("correct the target in the file, or leave the reading empty")
_MISPLACED_TARGET = Words(
    "all readings at {target} stand {size} off the line from one target beside it to the other, as if "
    "another target had been approached"
)
_STUCK_READINGS = Words(
    "{count} readings one after another are the same, digit for digit, from that at {reading} on: "
    "the instrument stood still"
)
_LEAVE_EMPTY = Words("leave these readings empty in the file, or measure them again")
_CLOCK_FALLS = Words("the time falls at {reading}")
_CORRECT_CLOCK = Words("correct the times in the file, or leave their column out")
_SWAPPED_COLUMNS = Words("columns look exchanged: {columns} hold what they cannot")
_CORRECT_COLUMNS = Words("name the columns rightly, in the file or in source.columns")
_STUCK = Words("{column} stands still during the last {count} readings")
_EXCLUDE_LOG = Words(
    "leave these values empty in the file; effects that follow them cannot be told otherwise"
)
_TINY_TEST = Words("the deviations are no larger than {size}, as if they stood in another unit")
_STILL_TEST = {
    AxisKind.LINEAR: Words(
        "the readings repeat to {size}, which no machine does, as if they stood in millimetres"
    ),
    AxisKind.ROTARY: Words(
        "the readings repeat to {size}, which no machine does, as if they stood in degrees"
    ),
}
_WILD_TEST = Words("the readings scatter by {size}, which no machine does, as if they stood in another unit")
_STATE_UNITS = Words("state source.units")
_LAGS_BEHIND = Words("{column} looks as if its sensor lagged about {minutes} min behind")
_OTHER_SENSOR = Words("repeat with a sensor in better contact, or wait until temperatures stand")
_OF_RUNS = {
    FaultKind.SWAPPED_DIRECTION: (
        Words("run {run} looks as if its directions were swapped"),
        CORRECT_RUN,
    ),
    FaultKind.WRONG_SIGN: (
        Words("run {run} looks as if its sign were turned"),
        CORRECT_RUN,
    ),
    FaultKind.SHIFTED_RUN: (
        Words("run {run} looks as if every reading stood at the target beside its own"),
        CORRECT_RUN,
    ),
}
