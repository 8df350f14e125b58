"""Warnings where a job states one thing at two places and otherwise each time, or days too far apart.

Nothing of it is refused, for each may have its reason: a reader is told, and the laboratory asked.
"""

from __future__ import annotations

import datetime as dt
from collections.abc import Iterator, Mapping
from itertools import combinations, pairwise

import numpy as np

from zlmreport.evaluation.evaluation import EvaluatedParameter, Evaluation
from zlmreport.evaluation.logged_conditions import (
    find_gaps,
    find_silent_sensors,
    find_temperatures_apart,
)
from zlmreport.evaluation.uncertainty.reasons import is_reference, says_something
from zlmreport.job.circle_keys import CircleKeys
from zlmreport.job.contradictions import find_last_day
from zlmreport.job.job import Job
from zlmreport.job.keys import JobKeys
from zlmreport.job.measurement_keys import is_same_serial
from zlmreport.language import Words, same
from zlmreport.language.formatting import write_plain
from zlmreport.measurement.approach import Approach
from zlmreport.measurement.arrays import BoolArray, FloatArray
from zlmreport.measurement.axis import AxisKind
from zlmreport.measurement.circle import NominalCircle
from zlmreport.measurement.measurement_set import MeasurementSet
from zlmreport.measurement.provenance import ReadingDays
from zlmreport.measurement.units import MILLIMETRE, say_stated

_LATE = Words("Issued on {issued}, {years} after the measurement of {measured}")
_YEARS = Words("{number} year", plural="{number} years")
_LONG = Words("The measurement took from {first} to {last}: {days} days")
_UNDATED = Words(
    "The date of the measurement is not stated: whether the calibrations were valid then cannot be told"
)
_COEFFICIENTS = Words(
    "Corrected with {corrected} µm/(m·K), and {stated} µm/(m·K) is stated as the expansion coefficient of "
    "the machine"
)
_TWO_DATES = Words("Calibration certificate {number}: two dates are stated for it, {first} and {second}")
_NO_REASON = Words("The reading of run {run} at {target} {arrow} is set aside without a reason: {reason}")
_PAUSE = Words(
    "Before a reading of run {run} none was taken for {hours} h: what moved meanwhile is in the results"
)
_TOO_FAST = Words(
    "By the times of the readings the axis moved at {speed} {unit}, and its feed is stated as {feed} {unit}"
)
_OTHER_DAY = Words("The times of the readings are of {first}, and the measurement is dated {measured}")
_OTHER_DAYS = Words(
    "The times of the readings are of {first} to {last}, and the measurement is dated {measured}"
)
_OTHER_FEED = Words(
    "By the times of the readings the path was run at {speed} {unit}, and its feed is stated as {feed} {unit}"
)
_OTHER_FEEDS = Words(
    "By the times of the readings the path was run at {slowest} to {fastest} {unit}, and its feed is stated "
    "as {feed} {unit}"
)
_LONGER_THAN_DAYS = Words("The readings go over {hours} h, and the measurement is dated {measured} only")
_SHORTER_THAN_DWELL = Words(
    "Readings follow each other after {seconds} s as a rule, and a dwell of {dwell} s at each target is "
    "stated"
)
_SERIALS = Words("The measuring instrument and the machine are stated with one serial number, {serial}")
_BARE_LENGTH = Words(
    "The length of the instrument is said to be calibrated, and no calibration certificate is named for it"
)
_EXCHANGED = Words(
    "{designation}: the limit of {part}, {larger}, is above that of {whole}, {smaller}, and {whole} is never "
    "smaller than {part}: nothing that conforms by {whole} can fail by {part}"
)
#: Days after which issue is late, and that a measurement may take.
_YEAR, _LONGEST = 365, 31
_DAYS_OF_A_YEAR = 365.25
_ROUNDING = 1e-9
#: Readings of a circle over which its feed is taken: their times are rounded.
_OF_A_PIECE = 20
_DAY = 24 * 3600.0
#: Seconds without a reading that are a pause.
_LONG_PAUSE = 3600.0
#: A moving axis may exceed its feed by the rounding of its times, s, and by this factor.
_OF_TIMES, _OF_FEED = 1.0, 1.2


def find_disagreements(job: Job, measurements: MeasurementSet) -> Iterator[Words]:
    """Yield a sentence for each statement of a job that another one does not bear out."""
    keys, times = job.keys, measurements.time
    yield from _find_days_apart(keys)
    if measurements.provenance.days is not None:
        yield from _find_other_days(keys, measurements.provenance.days)
    if times is not None:
        yield from _find_more_than_days(keys, times)
    yield from find_temperatures_apart(job, measurements)
    if measurements.conditions:
        yield from find_gaps(measurements)
        yield from find_silent_sensors(measurements)
    if keys.corrections and keys.corrections.material:
        yield from _find_other_coefficient(keys, keys.corrections.material.expansion_coefficient)
    yield from _find_certificates_of_two_dates(keys)
    if keys.measurement.excluded:
        yield from _find_exclusions_without_reason(job)
    if times is not None:
        yield from _find_odd_times(job, measurements, times)
    yield from _find_other_method(keys, measurements)
    yield from _find_one_serial(keys)
    if keys.circle and keys.circle.calibrated_length:
        yield from _find_bare_length(keys, keys.circle)


def _find_days_apart(keys: JobKeys) -> Iterator[Words]:
    first, last, issued = keys.measurement.date, find_last_day(keys.measurement), keys.certificate.issued
    if issued and last and (issued - last).days > _YEAR:
        years = _YEARS.given(number=int((issued - last).days / _DAYS_OF_A_YEAR + 0.01))
        yield _LATE.given(issued=issued.isoformat(), years=years, measured=last.isoformat())
    if first and last and (last - first).days > _LONGEST:
        days = (last - first).days + 1
        yield _LONG.given(first=first.isoformat(), last=last.isoformat(), days=days)
    if first is None and any(day for _, _, day in _list_calibrations(keys)):
        yield _UNDATED


def _find_other_days(keys: JobKeys, days: ReadingDays) -> Iterator[Words]:
    """Yield days of the readings that are not those of the measurement; a night may end on the next one."""
    first, last = keys.measurement.date, find_last_day(keys.measurement)
    if first is None or last is None:
        return
    spare = dt.timedelta(days=1 if days.is_utc else 0)
    of_night = dt.timedelta(days=1) if keys.measurement.end is None and days.last > days.first else spare
    if not first - spare <= days.first <= last + spare or days.last > last + of_night:
        words = _OTHER_DAY if days.first == days.last else _OTHER_DAYS
        first_read, last_read = days.first.isoformat(), days.last.isoformat()
        yield words.given(first=first_read, last=last_read, measured=first.isoformat())


def _find_more_than_days(keys: JobKeys, times: FloatArray) -> Iterator[Words]:
    """Yield whether the readings go over more time than the days of the measurement have."""
    first, last = keys.measurement.date, find_last_day(keys.measurement)
    if first is None or last is None or not np.isfinite(times).any():
        return
    seconds = float(np.nanmax(times) - np.nanmin(times))
    if seconds >= ((last - first).days + 1) * _DAY - _OF_TIMES:
        hours = float(f"{seconds / 3600:.3g}")
        yield _LONGER_THAN_DAYS.given(hours=hours, measured=first.isoformat())


def _find_other_method(keys: JobKeys, measurements: MeasurementSet) -> Iterator[Words]:
    """Yield a method in one direction whose readings are in both."""
    if keys.measurement.method == "unidirectional" and measurements.is_bidirectional:
        yield Words("A unidirectional method is stated, and targets were approached from both directions")


def _find_one_serial(keys: JobKeys) -> Iterator[Words]:
    """Yield a serial number that is stated of the machine and of what measured it."""
    machine, instrument = keys.machine.serial, keys.instrument.serial if keys.instrument else None
    if machine and instrument and is_same_serial(machine, instrument) and is_reference(machine):
        yield _SERIALS.given(serial=same(machine))


def _find_bare_length(keys: JobKeys, circle: CircleKeys) -> Iterator[Words]:
    """Yield a ballbar of calibrated length without any certificate."""
    of_instrument = keys.instrument.certificate if keys.instrument else None
    if not any(is_reference(each or "") for each in (circle.certificate, of_instrument)):
        yield _BARE_LENGTH


def _list_calibrations(keys: JobKeys) -> Iterator[tuple[str, str | None, dt.date | None]]:
    """Yield name, certificate and date of calibration of each instrument and sensor."""
    devices = (keys.instrument, *(keys.environment.thermometers if keys.environment else ()))
    yield from ((each.name, each.certificate, each.calibrated) for each in devices if each)


def _find_other_coefficient(keys: JobKeys, corrected: float | None) -> Iterator[Words]:
    """Yield a coefficient of the correction that is not the machine's."""
    stated = keys.environment.expansion_coefficient if keys.environment else None
    if corrected and isinstance(stated, float) and abs(corrected - stated) > _ROUNDING:
        yield _COEFFICIENTS.given(corrected=corrected, stated=stated)


def _find_certificates_of_two_dates(keys: JobKeys) -> Iterator[Words]:
    """Yield the certificates that are stated with two dates."""
    named = [
        (number, day)
        for _, number, day in _list_calibrations(keys)
        if number and day and is_reference(number)
    ]
    said = set()
    for (one, first), (other, second) in combinations(named, 2):
        if one.casefold() == other.casefold() and first != second and one.casefold() not in said:
            said.add(one.casefold())
            yield _TWO_DATES.given(number=one, first=first.isoformat(), second=second.isoformat())


def _find_exclusions_without_reason(job: Job) -> Iterator[Words]:
    """Yield the readings that are set aside for no reason."""
    for each in job.keys.measurement.excluded:
        if not says_something(each.reason):
            approach = Approach.POSITIVE if each.direction == "+" else Approach.NEGATIVE
            yield _NO_REASON.given(
                run=each.run,
                target=say_stated(each.target, job.axis.position_unit.symbol),
                arrow=approach.arrow,
                reason=same(f"“{each.reason}”"),
            )


def _find_odd_times(job: Job, measurements: MeasurementSet, times: FloatArray) -> Iterator[Words]:
    """Yield what the times of the readings say against each other, or against the stated feed."""
    if measurements.axis.circle is not None:
        yield from _find_another_feed_of_circle(measurements, measurements.axis.circle, times)
    if measurements.axis.measurand.is_continuous or np.isfinite(times).sum() < 2:
        return
    there = np.isfinite(times)
    seconds = np.diff(times[there])
    if not seconds.any():
        yield Words("All readings are said to have been taken at the same time")
        return
    longest = int(seconds.argmax())
    if seconds[longest] > _LONG_PAUSE:
        run = int(measurements.run[there][longest + 1])
        yield _PAUSE.given(run=run, hours=float(f"{seconds[longest] / 3600:.2g}"))
    dwell, usual = job.keys.measurement.dwell, float(np.median(seconds))
    if dwell is not None and usual + _OF_TIMES < dwell:
        yield _SHORTER_THAN_DWELL.given(seconds=float(f"{usual:.3g}"), dwell=dwell)
    feed = job.keys.measurement.feed
    if feed is not None:
        yield from _find_exceeded_feed(feed, measurements, there, seconds)


def _find_another_feed_of_circle(
    measurements: MeasurementSet, circle: NominalCircle, times: FloatArray
) -> Iterator[Words]:
    """Yield whether the readings of a circle went round at another feed than the stated one."""
    way = np.abs(np.diff(measurements.target_positions[measurements.target])) * circle.radius
    seconds = np.diff(times)
    known = (seconds > 0) & (way > 0) & (way < np.pi * circle.radius)
    if not known.any():
        return
    feed, stated = float(np.median(way[known] / seconds[known])), circle.feed
    if not stated / _OF_FEED <= feed <= stated * _OF_FEED:
        found, said = (float(f"{60 * MILLIMETRE.from_si(each):.2g}") for each in (feed, stated))
        yield _OTHER_FEED.given(speed=found, feed=said, unit="mm/min")
        return
    pieces = ((way[at][known[at]], seconds[at][known[at]]) for at in _list_pieces(measurements))
    of_pieces = [float(gone.sum() / taken.sum()) for gone, taken in pieces if taken.size]
    if of_pieces and not stated / _OF_FEED <= min(of_pieces) <= max(of_pieces) <= stated * _OF_FEED:
        slowest, fastest, said = (
            float(f"{60 * MILLIMETRE.from_si(each):.2g}") for each in (min(of_pieces), max(of_pieces), stated)
        )
        yield _OTHER_FEEDS.given(slowest=slowest, fastest=fastest, feed=said, unit="mm/min")


def _list_pieces(measurements: MeasurementSet) -> Iterator[slice]:
    """Yield the steps between readings that follow each other in a turn, so many at a time."""
    is_new = (np.diff(measurements.run) != 0) | (np.diff(measurements.approach) != 0)
    bounds = [0, *(np.flatnonzero(is_new) + 1), len(measurements.run)]
    for first, end in pairwise(bounds):
        for begin in range(int(first), int(end) - _OF_A_PIECE, _OF_A_PIECE):
            yield slice(begin, begin + _OF_A_PIECE)


def _find_exceeded_feed(
    feed: float, measurements: MeasurementSet, there: BoolArray, seconds: FloatArray
) -> Iterator[Words]:
    """Yield whether readings follow each other faster than the stated feed lets the axis move."""
    unit = measurements.axis.position_unit
    at = measurements.target_positions[measurements.target[there]]
    ways = np.abs(np.diff([unit.from_si(float(each)) for each in at]))
    moved = ways > 0
    if not moved.any():
        return
    speed = 60 * float(np.median(ways[moved] / (seconds[moved] + _OF_TIMES)))
    if speed > _OF_FEED * feed:
        per_minute = "°/min" if measurements.axis.kind is AxisKind.ROTARY else "mm/min"
        yield _TOO_FAST.given(speed=float(f"{speed:.2g}"), feed=feed, unit=per_minute)


def find_contradicting_limits(evaluation: Evaluation) -> Iterator[Words]:
    """Yield the limits that can decide nothing beside that of a parameter that is never smaller."""
    limited = {each.quantity.symbol: each for each in evaluation.parameters if each.limit is not None}
    for whole in limited.values():
        parts = set(_list_parts(whole.quantity.never_below, evaluation))
        for symbol, part in limited.items():
            if symbol in parts and (part.limit or 0.0) > (whole.limit or 0.0):
                yield _EXCHANGED.given(
                    designation=evaluation.designation,
                    part=write_plain(part.quantity.notation),
                    whole=write_plain(whole.quantity.notation),
                    larger=_write_limit(part, evaluation),
                    smaller=_write_limit(whole, evaluation),
                )


def _list_parts(symbols: tuple[str, ...], evaluation: Evaluation) -> Iterator[str]:
    """Yield the symbols of parameters that are never larger, and those of which these say it."""
    known: Mapping[str, EvaluatedParameter] = {each.quantity.symbol: each for each in evaluation.parameters}
    for symbol in symbols:
        yield symbol
        if symbol in known:
            yield from _list_parts(known[symbol].quantity.never_below, evaluation)


def _write_limit(parameter: EvaluatedParameter, evaluation: Evaluation) -> Words:
    unit = parameter.quantity.unit_or(evaluation.measurements.axis.deviation_unit)
    return say_stated(unit.from_si(parameter.limit or 0.0), unit.symbol)
