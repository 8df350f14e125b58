"""What a fleet writes for others: metrics and sign of life (Prometheus), a calendar (RFC 5545), priors.

The node exporter of Prometheus collects its text format from files: metres, radians and seconds, as it has
its units; no sample carries a time, which the collector would refuse. Priors are what the tests of the fleet
teach of noise and sizes of effects, for the next tests.
"""

from __future__ import annotations

import hashlib
from collections import defaultdict
from collections.abc import Callable, Iterable, Iterator, Mapping
from datetime import UTC, date, datetime, timedelta
from pathlib import Path

from zlmreport.files import Document
from zlmreport.fleet.drifts import Trend, group_by_axis
from zlmreport.fleet.ledger import Taught
from zlmreport.fleet.records import About, make_file_name
from zlmreport.fleet.state import FleetState
from zlmreport.fleet.trend import Series
from zlmreport.language import Language, Words
from zlmreport.measurement.measurand import POSITIONING
from zlmreport.measurement.units import ANGLES, LENGTHS
from zlmreport.version import __version__

_UNITS = {unit.ascii: unit for unit in (*LENGTHS, *ANGLES)}
#: What follows the name of a metric, by the units of the ledger.
_QUANTITIES = ((LENGTHS, "meters"), (ANGLES, "radians"))
_Samples = Iterable[tuple[Mapping[str, str], float | None]]


def write_metrics(state: FleetState) -> str:
    """Return the text of the file."""
    return "".join((*_list_fleet_metrics(state), *_list_axis_metrics(state), *_list_parameter_metrics(state)))


def write_heartbeat(fleet: str, moment: datetime, *, is_at_work: bool) -> str:
    """Return the file by which a night shows that it is alive."""
    labels = {"fleet": fleet}
    beat = [(labels, moment.timestamp())]
    about = "1 while a run is at work, and after one that was killed."
    return _write_family(
        "fleet_heartbeat_timestamp_seconds", "When a run last gave a sign of life.", beat
    ) + _write_family("fleet_at_work", about, [(labels, float(is_at_work))])


def _write_family(name: str, about: str, samples: _Samples) -> str:
    """Return a metric: what it says, and its samples; none of what is not known."""
    lines = []
    for labels, value in samples:
        if value is not None:
            stated = ",".join(f'{key}="{_escape(text, quotes=True)}"' for key, text in labels.items())
            lines.append(f"zlmreport_{name}{{{stated}}} {value!r}\n")
    head = f"# HELP zlmreport_{name} {_escape(about)}\n# TYPE zlmreport_{name} gauge\n"
    return "".join((head, *lines)) if lines else ""


def _list_fleet_metrics(state: FleetState) -> Iterator[str]:
    fleet, night = {"fleet": state.name}, state.night
    began, seconds = (night.began.timestamp(), night.seconds) if night else (None, None)
    jobs = [({**fleet, "state": name}, float(count)) for name, count in state.counts.items()]
    noticed = {each.about for each in state.notices}
    notices = [({**fleet, "about": about.value}, float(about in noticed)) for about in About]
    for name, about, samples in (
        ("last_run_timestamp_seconds", "When the last run of the fleet began.", [(fleet, began)]),
        ("last_run_duration_seconds", "How long the last run of the fleet took.", [(fleet, seconds)]),
        ("jobs", "Jobs of the fleet by their state after the last run.", jobs),
        ("notice", "1 if the last run as a whole was not as it should be.", notices),
    ):
        yield _write_family(f"fleet_{name}", about, samples)


def _list_axis_metrics(state: FleetState) -> Iterator[str]:
    def of_axis(axis: tuple[str, str], day: date) -> tuple[Mapping[str, str], float]:
        return {"fleet": state.name, "machine": axis[0], "axis": axis[1]}, _make_timestamp(day)

    measured = [
        of_axis(axis, max(each.series.calibrations[-1].measured for each in trends))
        for axis, trends in group_by_axis(state.trends).items()
    ]
    yield _write_family(
        "axis_measured_timestamp_seconds", "Date of the last measurement of the axis.", measured
    )
    due = [of_axis(term.entry.axis_key, term.due) for term in state.terms]
    yield _write_family("axis_due_timestamp_seconds", "Day on which the axis is due (UTC).", due)


def _list_parameter_metrics(state: FleetState) -> Iterator[str]:
    def family(name: str, about: str, values: Iterable[tuple[Series, float | None]]) -> str:
        samples = (
            (
                {
                    "fleet": state.name,
                    "machine": each.machine,
                    "axis": each.axis,
                    "standard": each.standard,
                    "symbol": each.symbol,
                },
                value,
            )
            for each, value in values
        )
        return _write_family(f"parameter_{name}", about, samples)

    for units, quantity in _QUANTITIES:
        of_kind = [each for each in state.trends if _UNITS.get(each.series.unit) in units]
        for name, about, value in _AMOUNTS:
            known = ((each.series, value(each)) for each in of_kind)
            amounts = ((of, size if size is None else _UNITS[of.unit].to_si(size)) for of, size in known)
            yield family(f"{name}_{quantity}", about, amounts)
    for name, about, value in _STATEMENTS:
        yield family(name, about, ((each.series, value(each)) for each in state.trends))


def _make_timestamp(day: date) -> float:
    return datetime(day.year, day.month, day.day, tzinfo=UTC).timestamp()


#: In the unit of the ledger.
_AMOUNTS: tuple[tuple[str, str, Callable[[Trend], float | None]], ...] = (
    ("value", "Latest certified value.", lambda trend: trend.series.latest.value),
    (
        "expanded_uncertainty",
        "Expanded uncertainty of the latest certified value.",
        lambda trend: trend.series.latest.expanded_uncertainty,
    ),
    ("limit", "Limit of the amount of the value.", lambda trend: trend.series.latest.limit),
    (
        "visible_step",
        "Step that the next test would show in 95 % of all cases.",
        lambda trend: trend.smallest,
    ),
    (
        "change_per_year",
        "Slope of the line through the certified values, in a year.",
        lambda trend: trend.line.slope if trend.line else None,
    ),
)
_STATEMENTS: tuple[tuple[str, str, Callable[[Trend], float | None]], ...] = (
    (
        "conforms",
        "1 if the limit is met, 0 if not; absent where nothing is stated.",
        lambda trend: None if trend.series.latest.conforms is None else float(trend.series.latest.conforms),
    ),
    (
        "drift_p_value",
        "Chance of so steep a line where nothing drifts; of this parameter alone.",
        lambda trend: trend.p_value,
    ),
    (
        "changed",
        "1 if the latest test shows a step, or the latest scatter more; absent where that is not asked.",
        lambda trend: None if trend.course is None else float(trend.step is not None or trend.is_wilder),
    ),
    (
        "drifts",
        "1 if the parameter drifts, with all tests of the fleet in view.",
        lambda trend: None if trend.line is None else float(trend.drifts),
    ),
    (
        "limit_reached_timestamp_seconds",
        "When a drift meets its limit.",
        lambda trend: (
            _make_timestamp(trend.forecast.expected) if trend.forecast and not trend.was_beyond else None
        ),
    ),
)


def _escape(text: str, *, quotes: bool = False) -> str:
    escaped = text.replace("\\", "\\\\").replace("\n", "\\n")
    return escaped.replace('"', '\\"') if quotes else escaped


_TITLE = Words("{fleet}: tests that are due")
_SUMMARY = Words("Measure {axis} of {machine}")
_SUMMARY_OF_AXIS = Words("Measure {axis}")
_DESCRIPTION = Words("Measured last on {measured}, certificate {number}.")
#: Before the day, so that a machine can be made free.
_NOTICE = timedelta(days=14)


def write_calendar(state: FleetState, language: Language) -> bytes:
    """Return the calendar: a whole day for each axis that is to be measured again, with a reminder.

    The same ledger gives the same bytes; an axis keeps its entry until it has been measured.
    """
    from icalendar import Alarm, Calendar, Event  # noqa: PLC0415 - only who asks for a calendar waits for it

    title = _TITLE.given(fleet=state.name).in_language(language)
    days = Calendar()
    for key, text in (
        ("prodid", f"-//zlmreport//{__version__}//EN"),
        ("version", "2.0"),
        ("name", title),
        ("x-wr-calname", title),  # RFC 7986 has the first; most programs know the second
    ):
        days.add(key, text)
    moment = state.night.began if state.night else datetime(2000, 1, 1, tzinfo=UTC)
    for term in state.terms:
        entry = term.entry
        words = _SUMMARY if entry.machine else _SUMMARY_OF_AXIS
        summary = words.given(axis=entry.axis, machine=entry.machine).in_language(language)
        identity = hashlib.sha256(
            repr((state.name, entry.machine, entry.axis, term.due)).encode()
        ).hexdigest()
        event, alarm = Event(), Alarm()
        event.add("uid", f"{identity[:32]}@zlmreport")
        event.add("dtstamp", moment)
        event.add("dtstart", term.due)
        event.add("summary", summary)
        told = _DESCRIPTION.given(measured=entry.measured, number=entry.number)
        event.add("description", told.in_language(language))
        event.add("transp", "TRANSPARENT")
        alarm.add("action", "DISPLAY")
        alarm.add("description", summary)
        alarm.add("trigger", -_NOTICE)
        event.add_component(alarm)
        days.add_component(event)
    return bytes(days.to_ical())


def make_priors(taught: Iterable[Taught], folder: Path) -> Iterator[Document]:
    """Yield the files of priors that are not there yet: of each type of machine, for each kind of axis.

    What was measured stands in the name where it is not positioning.

    A file is named after the last day of whose tests it knows, and stays as it is: certificates are made with
    it. The same ledger gives the same bytes.

    `taught`: In the order of measurement; a test of a machine without a manufacturer and model teaches
        nobody.
    """
    from zlmreport.model.fitting.priors import Lesson, learn_priors, write_priors  # noqa: PLC0415 - only where there is a model

    groups: defaultdict[tuple[str, str], list[tuple[Taught, Lesson]]] = defaultdict(list)
    seen: set[frozenset[str]] = set()
    for each in taught:
        if each.subject.type and each.readings not in seen:
            lesson = Lesson.from_json(each.lesson)
            is_usual = lesson.measurand == POSITIONING.identifier
            of = lesson.kind if is_usual else f"{lesson.kind}.{lesson.measurand}"
            groups[make_file_name(each.subject.type), of].append((each, lesson))
            seen.add(each.readings)
    for (type_, of), learned in sorted(groups.items()):
        tests = [each for each, _ in learned]
        last = tests[-1].subject.measured
        path = folder / f"{type_}.{of}.{last}.yaml"
        if not path.exists():
            found = learn_priors([lesson for _, lesson in learned])
            origin = f"the fleet, of {tests[-1].subject.type} and until {last},"
            yield Document(path, write_priors(found, origin).encode())
