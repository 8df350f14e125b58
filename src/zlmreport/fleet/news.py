"""What is new on a morning: each event in a line, known by a subject, so that it is told once."""

from __future__ import annotations

from collections import Counter, defaultdict
from collections.abc import Iterable, Iterator, Sequence

from zlmreport.fleet.causes import cause_of
from zlmreport.fleet.drifts import Trend
from zlmreport.fleet.records import Kind, News, Notice
from zlmreport.fleet.state import FleetState
from zlmreport.quantities.units import printed_symbol


def news_of_night(notices: Iterable[Notice]) -> Iterator[News]:
    """Yield what concerns the whole night."""
    for each in notices:
        yield News(Kind.NIGHT, each.about.value, each.text)


def news_of(state: FleetState) -> Iterator[News]:
    """Yield all that is so on a morning, whether or not it was told before."""
    yield from news_of_night(state.notices)
    for failure in state.failures:
        entry = failure.entry
        message = entry.message.partition("\n")[0]
        yield News(Kind.FAILED, f"{entry.job}|{message}", f"{entry.job}: {message}")
    for (machine, axis), trends in _by_axis(state.not_met):
        stated = ", ".join(f"{each.series.symbol} = {_value(each)}, limit {_limit(each)}" for each in trends)
        yield News(Kind.NOT_MET, f"{machine}|{axis}", f"{_named(machine, axis)}: {stated}")
    for (machine, axis), trends in _by_axis(state.changed):
        yield _changed(machine, axis, trends, state)
    for (machine, axis), trends in _by_axis(state.drifting):
        stated = "; ".join(map(_drift, trends))
        yield News(Kind.DRIFTING, f"{machine}|{axis}|{trends[0].since}", f"{_named(machine, axis)}: {stated}")
    for term in state.overdue:
        entry = term.entry
        named = _named(entry.machine, entry.axis)
        text = f"{named}: measured on {entry.measured}, and was to be measured again by {term.due}"
        yield News(Kind.OVERDUE, f"{entry.machine}|{entry.axis}|{term.due}", text)
    for entry in state.drafts:
        yield News(Kind.DRAFT, f"{entry.job}|{entry.number}", f"{entry.number}: {entry.message}")


def title(fleet: str, news: Sequence[News]) -> str:
    """Return news in one line: ``Hall North: 2 changed, 1 failed``."""
    counted = Counter(each.kind for each in news)
    return f"{fleet}: " + ", ".join(f"{counted[kind]} {kind.value}" for kind in Kind if counted[kind])


def digest(news: Sequence[News]) -> str:
    """Return news as text, kind by kind."""
    parts = []
    for kind in Kind:
        lines = [f"- {each.text}" for each in news if each.kind is kind]
        if lines:
            parts.append("\n".join([kind.value.capitalize(), *lines]))
    return "\n\n".join(parts) + "\n"


def _changed(machine: str, axis: str, trends: Sequence[Trend], state: FleetState) -> News:
    """Return the change of an axis: one event, however many of its parameters show it."""
    stepped = [each for each in trends if each.step]
    told = _named(machine, axis)
    if not stepped:
        first = trends[0].since
        return News(Kind.CHANGED, f"{machine}|{axis}|scatter|{first}", f"{told}: scatters more than before")
    cause = cause_of(stepped[0], state.effects)
    since = cause.since.isoformat() if cause else ""
    parts = [f"{each.series.symbol} {_signed(each.step.change, each)}" for each in stepped if each.step]
    text = f"{told}: {', '.join(parts)} since {since}"
    if cause and cause.effect:
        text += f"; {cause.effect} {_number(cause.change)} {printed_symbol(cause.unit)}"
    if cause and cause.after:
        text += f"; measured with {cause.after} in place of {cause.before}"
    return News(Kind.CHANGED, f"{machine}|{axis}|{since}", text)


def _drift(trend: Trend) -> str:
    slope = trend.line.slope if trend.line else 0.0
    reached = f", limit reached {trend.forecast.expected:%Y-%m}" if trend.forecast else ""
    return f"{trend.series.symbol} {_signed(slope, trend)} a year{reached}"


def _by_axis(trends: Iterable[Trend]) -> Iterable[tuple[tuple[str, str], list[Trend]]]:
    found: defaultdict[tuple[str, str], list[Trend]] = defaultdict(list)
    for each in trends:
        found[each.series.machine, each.series.axis].append(each)
    return found.items()


def _named(machine: str, axis: str) -> str:
    return ", ".join(part for part in (machine, axis) if part)


def _value(trend: Trend) -> str:
    return f"{trend.series.latest.value:.1f} {printed_symbol(trend.series.unit)}"


def _limit(trend: Trend) -> str:
    return f"{trend.series.latest.limit:g} {printed_symbol(trend.series.unit)}"


def _signed(change: float, trend: Trend) -> str:
    return f"{_number(change)} {printed_symbol(trend.series.unit)}"


def _number(change: float) -> str:
    return f"{'+' if change > 0 else '−'} {abs(change):.1f}"
