"""Requirements of ISO 230-3: duration, gaps, sensors, temperatures, one clock."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

import numpy as np

from zlmreport.plugin import (
    CELSIUS,
    CONDITION_NAMES,
    CONDITIONS,
    HOUR,
    MICROMETRE,
    BoolArray,
    FloatArray,
    MeasurementSet,
    PartRow,
    Words,
    same_in_all_languages,
)
from zlmreport.plugin.standard import Basis, Finding
from zlmreport_plugins.standards.iso230_3.hours import Hours, find_longest_gap, find_usual_interval
from zlmreport_plugins.standards.iso230_3.quantities import PAIRS

#: Of a test at the least, and of one that shows a whole day, h.
_AT_LEAST, _A_DAY = 4.0, 24.0
#: Of the time over which the drift is taken: a longer gap may hide an extreme.
_PART = 1 / 20
#: What the name of a temperature that has no name of its own ends in; it is in °C.
_TEMPERATURE = "_temperature"


def check_requirements(
    measurements: MeasurementSet, hours: Hours, distances: Mapping[str, float]
) -> Iterator[Finding]:
    """Yield the requirements.

    `distances`: Of both sensors of a direction, m, by its letter.
    """
    tests = measurements.tests
    yield _check_stated(tests, hours)
    if hours.are_stated:
        yield _check_covered(tests, hours)
    yield _check_long_enough(tests, hours)
    yield _check_without_gaps(tests, hours)
    yield _check_directions(tests)
    yield from _check_tilts(tests, distances)
    yield _check_temperatures(tests)
    yield _check_completeness(tests)
    yield from _check_averaged(tests)
    yield from _check_one_clock(tests)


def list_temperatures(measurements: MeasurementSet) -> Iterator[tuple[str, FloatArray]]:
    """Yield the temperatures beside the readings of a sensor by their names, °C, in the order of time."""
    order = np.argsort(measurements.target, kind="stable")
    for name, values in measurements.conditions.items():
        kind = CONDITIONS.get(name)
        if kind is not None and kind.unit is CELSIUS:
            yield name, np.asarray(CELSIUS.from_si(values[order]))
        elif kind is None and name.endswith(_TEMPERATURE):
            yield name, values[order]


def _find_duration(tests: Mapping[str, MeasurementSet], hours: Hours) -> float:
    """Return for how long the shortest record goes over the hours, s."""
    return min((hours.measure_covered(each.target_positions) for each in tests.values()), default=0.0)


def _convert_to_hours(seconds: float) -> float:
    return float(f"{HOUR.from_si(seconds):.3g}")


def _check_stated(tests: Mapping[str, MeasurementSet], hours: Hours) -> Finding:
    if not hours.are_stated:
        found = _WHOLE.given(
            hours=_convert_to_hours(_find_duration(tests, hours)), start=_convert_to_hours(hours.start)
        )
        return Finding(_HOURS, found, met=None)
    found = _THESE.given(hours=_convert_to_hours(hours.length), start=_convert_to_hours(hours.start))
    return Finding(_HOURS, found, met=True)


def _check_covered(tests: Mapping[str, MeasurementSet], hours: Hours) -> Finding:
    short = {
        name: hours.measure_covered(each.target_positions)
        for name, each in tests.items()
        if not hours.are_covered(each.target_positions)
    }
    if not short:
        return Finding(_OVER_ALL, Words("they go over all of them"), met=True)
    name = min(short, key=lambda each: short[each])
    found = _TOO_SHORT.given(
        names=", ".join(short),
        name=name,
        hours=_convert_to_hours(short[name]),
        of=_convert_to_hours(hours.length),
    )
    return Finding(_OVER_ALL, found, met=False)


def _check_long_enough(tests: Mapping[str, MeasurementSet], hours: Hours) -> Finding:
    duration = _find_duration(tests, hours)
    is_enough = duration >= HOUR.to_si(_AT_LEAST) * (1 - 1e-9)
    found = Words("{hours} h").given(hours=_convert_to_hours(duration))
    return Finding(_LONG.given(least=_AT_LEAST, day=_A_DAY), found, is_enough)


def _check_without_gaps(tests: Mapping[str, MeasurementSet], hours: Hours) -> Finding:
    gaps = {
        name: find_longest_gap(
            each.target_positions[_find_what_is_there(each) & hours.select(each.target_positions)]
        )
        for name, each in tests.items()
    }
    name = max(gaps, key=lambda each: gaps[each], default="")
    if not gaps or not gaps[name]:
        return Finding(_NO_GAP, Words("a sensor has fewer than two readings"), met=False)
    most = _PART * (hours.length if hours.are_stated else _find_duration(tests, hours))
    usual = find_usual_interval(tests[name].target_positions)
    found = _LONGEST.given(name=name, gap=float(f"{gaps[name] / 60:.3g}"), usual=float(f"{usual / 60:.3g}"))
    return Finding(_NO_GAP, found, gaps[name] <= most)


def _find_what_is_there(measurements: MeasurementSet) -> BoolArray:
    """Return at which times there is a reading, shape (position,)."""
    return np.asarray(np.isfinite(measurements.deviations()).any(axis=(0, 2)))


def _check_directions(tests: Mapping[str, MeasurementSet]) -> Finding:
    lacking = [letter for letter in PAIRS if not any(name.startswith(letter) for name in tests)]
    measured = ", ".join(tests)
    if not lacking:
        return Finding(_ALL, same_in_all_languages(measured), met=True)
    return Finding(_ALL, _ONLY.given(measured=measured, lacking=", ".join(lacking)), met=False)


def _check_tilts(tests: Mapping[str, MeasurementSet], distances: Mapping[str, float]) -> Iterator[Finding]:
    """Yield whether the tilt of each direction can be had that has two sensors, or the distance of two."""
    for letter, (first, second) in PAIRS.items():
        has_pair = first in tests and second in tests
        requirement = _TILT.given(first=first, second=second)
        if has_pair and letter in distances:
            found = _APART.given(distance=float(f"{distances[letter] * 1e3:.6g}"))
            yield Finding(requirement, found, met=True)
        elif has_pair:
            yield Finding(requirement, _NO_DISTANCE.given(letter=letter), met=None)
        elif letter in distances:
            yield Finding(requirement, _NO_PAIR.given(letter=letter), met=False)


def _check_temperatures(tests: Mapping[str, MeasurementSet]) -> Finding:
    found: dict[str, float] = {}
    for each in tests.values():
        for name, values in list_temperatures(each):
            if np.isfinite(values).any():
                found.setdefault(name, float(np.nanmax(values) - np.nanmin(values)))
    if not found:
        return Finding(_BESIDE, _NONE, met=False)
    spans = tuple(_say_span(name, span) for name, span in found.items())
    return Finding(_BESIDE, same_in_all_languages(PartRow(spans)), met=True)


def _say_span(name: str, span: float) -> Words:
    condition = CONDITION_NAMES.get(name) or same_in_all_languages(name.replace("_", " "))
    return _SPAN.given(name=condition, span=float(f"{span:.2g}"))


def _check_completeness(tests: Mapping[str, MeasurementSet]) -> Finding:
    missing = {name: int(np.count_nonzero(~np.isfinite(each.deviation))) for name, each in tests.items()}
    total = sum(len(each.deviation) for each in tests.values())
    lacking = {name: count for name, count in missing.items() if count}
    if not lacking:
        return Finding(_NO_MISSING, Words("all {total} readings").given(total=total), met=True)
    found = _SOME.given(missing=sum(lacking.values()), total=total, names=", ".join(lacking))
    return Finding(_NO_MISSING, found, met=False)


def _check_averaged(tests: Mapping[str, MeasurementSet]) -> Iterator[Finding]:
    """Yield how much averages may hide of an extreme, of the sensor of which it is most."""
    left = {
        name: each.provenance.averaging.left_out for name, each in tests.items() if each.provenance.averaging
    }
    if left:
        name = max(left, key=lambda each: left[each])
        found = _LEFT.given(name=name, left=float(f"{MICROMETRE.from_si(left[name]):.2g}"))
        yield Finding(_HIDDEN, found, None, Basis.APPLIED)


def _check_one_clock(tests: Mapping[str, MeasurementSet]) -> Iterator[Finding]:
    """Yield that several loggers need one beginning: by the readings alone nobody knows whether they have."""
    files = {file.sha256 for each in tests.values() for file in each.provenance.files}
    if len(files) > 1:
        yield Finding(_BEGIN, _OF_FILES.given(count=len(files)), None, Basis.APPLIED)


_BEGIN = Words("Times of all sensors counted from one moment")
_OF_FILES = Words(
    "{count} files; unless the job says otherwise (counted_from, later_by) each counts from its own first "
    "reading"
)
_HOURS = Words("Hours over which the drift is taken")
_WHOLE = Words("not stated (hours); the whole record is taken: {hours} h from {start} h on")
_THESE = Words("{hours} h from {start} h on")
_OVER_ALL = Words("Readings over all these hours, but for one interval of readings and a fiftieth at most")
_TOO_SHORT = Words(
    "{name}: {hours} h of {of} h; what follows from {names} is not reported, for a range in a shorter time "
    "is another quantity"
)
_LONG = Words("A test of at least {least} h; {day} h show a whole day")
_NO_GAP = Words("No time without readings longer than a twentieth of the hours")
_LONGEST = Words("{gap} min at most ({name}), usually {usual} min")
_ALL = Words("Sensors in X, Y and Z")
_ONLY = Words("{measured}; none in {lacking}")
_TILT = Words("Tilt from {first} and {second}")
_APART = Words("both measured, {distance} mm apart")
_NO_DISTANCE = Words("their distance is not stated (distance: {{{letter}: …}}); the tilt is not reported")
_NO_PAIR = Words(
    "a distance is stated (distance: {letter}), and not both were measured; the tilt is not reported"
)
_SPAN = Words("{name} {span} K")
_BESIDE = Words("Temperatures recorded beside the displacements, with their ranges")
_NONE = Words("none")
_NO_MISSING = Words("No reading missing")
_SOME = Words("{missing} of {total} missing ({names}); evaluated by what is there")
_HIDDEN = Words("No extreme hidden by averages of readings")
_LEFT = Words("left out of the averages: {left} µm at most ({name}, root mean square)")
