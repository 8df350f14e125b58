"""What is new on a morning, as a message (title, text), and how people are told: how long is waited.

Each event is a line, known by a subject, so that it is told once. Each way is a notifier of a plugin with
its own keys, as the fleet file names it.
"""

from __future__ import annotations

import threading
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path

from zlmreport.errors import InputError, Problem, ZlmreportError
from zlmreport.fleet.causes import find_cause_of
from zlmreport.fleet.drifts import Trend, group_by_axis
from zlmreport.fleet.issuing import Happened, What
from zlmreport.fleet.overview_words import ABOUTS
from zlmreport.fleet.plan import Evening
from zlmreport.fleet.printing import Names, write_change, write_limit, write_value
from zlmreport.fleet.records import About, News, NewsKind, NightNotice, name_axis
from zlmreport.fleet.state import FleetState
from zlmreport.fleet.trend import Series
from zlmreport.job.contradictions import validate
from zlmreport.job.fleet import FleetFile
from zlmreport.job.tree import Keys, Scalar, find_at
from zlmreport.job.types import Options
from zlmreport.language import Language, Words, join_parts, named
from zlmreport.plugin.kinds import NOTIFIER
from zlmreport.plugin.protocols import Message, Notifier, Occasion
from zlmreport.plugin.registry import Registry, find_plugins

_KINDS = {
    NewsKind.NIGHT: Words("the whole night"),
    NewsKind.FAILED: Words("failed"),
    NewsKind.NOT_MET: Words("limit not met"),
    NewsKind.CHANGED: Words("changed"),
    NewsKind.DRIFTING: Words("drifting"),
    NewsKind.OVERDUE: Words("overdue"),
    NewsKind.DRAFT: Words("draft"),
}
#: How many there are of each, in the title of a message.
_COUNTED = {
    NewsKind.NIGHT: Words("{number} notice", plural="{number} notices"),
    NewsKind.FAILED: Words("{number} failed"),
    NewsKind.NOT_MET: Words("{number} limit not met", plural="{number} limits not met"),
    NewsKind.CHANGED: Words("{number} changed", plural="{number} changed"),
    NewsKind.DRIFTING: Words("{number} drifting", plural="{number} drifting"),
    NewsKind.OVERDUE: Words("{number} overdue", plural="{number} overdue"),
    NewsKind.DRAFT: Words("{number} draft", plural="{number} drafts"),
}
_NOT_MET = Words("{symbol} = {value}, limit {limit}")
_WILDER = Words("scatters more than before")
_SINCE = Words("{changes} since {since}")
_INSTRUMENT = Words("; measured with {after} in place of {before}")
_DRIFT = Words("{symbol} {change} a year")
_REACHED = Words(", limit reached {month}")
_OVERDUE = Words("measured on {measured}, and was to be measured again by {due}")
_ISSUED = Words("{number} was issued")
_LIMIT = Words("; a limit is not met")
_UNTOLD = Words("the news was not sent by {way}: {reason}")
_FAILED = Words("{job} failed")


def find_news_of_night(notices: Iterable[NightNotice], language: Language) -> Iterator[News]:
    """Yield what concerns the whole night."""
    for each in notices:
        text = each.text.in_language(language)
        subject = each.about.value if each.about.is_condition else f"{each.about.value}|{text}"
        yield News(NewsKind.NIGHT, subject, named(ABOUTS[each.about], text).in_language(language))


def find_news_of(state: FleetState, language: Language, names: Names) -> Iterator[News]:
    """Yield all that is so on a morning, whether or not it was told before."""
    state = replace(state, trends=tuple(map(names.as_printed, state.trends)))
    yield from find_news_of_night(state.notices, language)
    for failure in state.failures:
        entry = failure.entry
        message = entry.message.partition("\n")[0]
        told = message if message.startswith(entry.job) else f"{entry.job}: {message}"
        yield News(NewsKind.FAILED, f"{entry.job}|{message}", told)
    for (machine, axis), trends in group_by_axis(state.not_met).items():
        stated = ", ".join(_say_not_met(each, language, names) for each in trends)
        told = named(name_axis(machine, axis), stated).in_language(language)
        yield News(NewsKind.NOT_MET, f"{machine}|{axis}", told)
    for trends in group_by_axis(state.changed).values():
        yield _report_change(trends, state.effects, language, names)
    for (machine, axis), trends in group_by_axis(state.drifting).items():
        stated = join_parts((_say_drift(each, language, names) for each in trends), language)
        told = named(name_axis(machine, axis), stated).in_language(language)
        yield News(NewsKind.DRIFTING, f"{machine}|{axis}|{trends[0].since}", told)
    for term in state.overdue:
        entry = term.entry
        overdue = _OVERDUE.given(measured=entry.measured, due=str(term.due))
        told = named(entry.of_axis, overdue).in_language(language)
        yield News(NewsKind.OVERDUE, entry.name_term(term.due.isoformat()), told)
    for entry in state.drafts:
        yield News(NewsKind.DRAFT, f"{entry.job}|{entry.number}", f"{entry.number}: {entry.message}")


def write_digest(fleet: FleetFile, news: Sequence[News]) -> Message:
    """Return news as a message, kind by kind: ``Hall North: 1 failed, 2 drafts``."""
    language = fleet.keys.language
    counted = Counter(each.kind for each in news)
    said = {kind: words.in_language(language) for kind, words in _KINDS.items() if counted[kind]}
    numbers = ", ".join(_COUNTED[kind].given(number=counted[kind]).in_language(language) for kind in said)
    title = named(fleet.name, numbers).in_language(language)
    parts = [
        "\n".join([word[0].upper() + word[1:], *(f"- {each.text}" for each in news if each.kind is kind)])
        for kind, word in said.items()
    ]
    return Message(Occasion.DIGEST, title, "\n\n".join(parts) + "\n")


def find_news_of_job(happened: Happened, known: Evening) -> Message | None:
    """Return what people may be told as it happens; a job that failed before is no news."""
    fleet, language = known.fleet, known.fleet.keys.language
    if happened.what is What.ISSUED:
        said = _ISSUED.given(number=happened.number).in_language(language)
        said += _LIMIT.in_language(language) if happened.conforms is False else ""
        files = tuple(fleet.output / file for file in happened.files)
        doubts = [each.in_language(language) for each in happened.doubts]
        text = "".join(f"{line}\n" for line in (happened.job, *files, *doubts))
        return Message(Occasion.CERTIFICATE, named(fleet.name, said).in_language(language), text, files)
    standing = known.standings.get(happened.job)
    if happened.what not in {What.FAILED, What.VANISHED} or (standing and standing.state.is_failure):
        return None
    title = named(fleet.name, _FAILED.given(job=happened.job)).in_language(language)
    text = "".join(f"{problem}\n" for problem in happened.problems)
    return Message(Occasion.FAILURE, title, text)


def _report_change(
    trends: Sequence[Trend], effects: Sequence[Series], language: Language, names: Names
) -> News:
    """Return the change of an axis: one event, however many of its parameters show it."""
    stepped = [each for each in trends if each.step]
    machine, axis = trends[0].series.axis_key
    name, sign = name_axis(machine, axis), language.decimal_sign
    if not stepped:
        subject = f"{machine}|{axis}|scatter|{trends[0].since}"
        return News(NewsKind.CHANGED, subject, named(name, _WILDER).in_language(language))
    cause = find_cause_of(stepped[0], effects)
    since = cause.since.isoformat() if cause else ""
    changes = ", ".join(
        f"{names.write_symbol(each.series)} {write_change(each.step.change, each.series.unit, sign)}"
        for each in stepped
        if each.step
    )
    text = named(name, _SINCE.given(changes=changes, since=since)).in_language(language)
    if cause and cause.effect:
        effect = f"{cause.effect} {write_change(cause.change, cause.unit, sign)}"
        text = join_parts((text, effect), language)
    if cause and cause.after:
        text += _INSTRUMENT.given(after=cause.after, before=cause.before).in_language(language)
    return News(NewsKind.CHANGED, f"{machine}|{axis}|{since}", text)


def _say_not_met(trend: Trend, language: Language, names: Names) -> str:
    latest, sign = trend.series.latest, language.decimal_sign
    value, limit = write_value(latest, sign), write_limit(latest, sign)
    told = _NOT_MET.given(symbol=names.write_symbol(trend.series), value=value, limit=limit)
    return told.in_language(language)


def _say_drift(trend: Trend, language: Language, names: Names) -> str:
    slope = trend.line.slope if trend.line else 0.0
    change = write_change(slope, trend.series.unit, language.decimal_sign)
    told = _DRIFT.given(symbol=names.write_symbol(trend.series), change=change).in_language(language)
    if trend.forecast and not trend.was_beyond:
        told += _REACHED.given(month=f"{trend.forecast.expected:%Y-%m}").in_language(language)
    return told


#: For which the night waits until a message is taken, s: nothing that tells of a night may stop it.
PATIENCE = 60.0
#: Of the group of keys itself.
_CORE = ("plugin", "tells")


@dataclass(frozen=True, slots=True)
class NewsChannel:
    """A way to tell people."""

    notifier: Notifier  #: Of a plugin.
    options: Options  #: Its own keys.
    tells: frozenset[Occasion]  #: What it is used for.

    @property
    def name(self) -> str:
        """What tells this way from others, here and in the ledger."""
        return f"{self.notifier.identifier} {self.notifier.receiver(self.options)}"

    def tell(self, message: Message) -> str:
        """Tell people; return why nobody took it in time, and nothing if somebody did."""
        raised: list[Exception] = []

        def run() -> None:
            try:
                self.notifier.tell(message, self.options)
            except (ZlmreportError, MemoryError) as error:
                raised.append(error)

        thread = threading.Thread(target=run, daemon=True)
        thread.start()
        thread.join(PATIENCE)
        if thread.is_alive():
            return f"it was not taken within {PATIENCE:g} s"
        return str(raised[0]) or type(raised[0]).__name__ if raised else ""


@dataclass(slots=True)
class Ways:
    """All ways of a fleet; one that failed is not tried again in the same night."""

    all: tuple[NewsChannel, ...] = ()  #: In the order of the fleet file.
    #: What is to be said of those that nobody was reached by tonight.
    untold: dict[str, NightNotice] = field(default_factory=dict)

    def list_for(self, occasion: Occasion) -> Iterator[NewsChannel]:
        """Yield those that tell of an occasion, and may still work."""
        return (way for way in self.all if occasion in way.tells and way.name not in self.untold)

    def tell(self, way: NewsChannel, message: Message, watch: Callable[[NightNotice], None]) -> bool:
        """Tell people by one of them, and return whether it was taken; if not, the watch takes note."""
        reason = way.tell(message)
        if reason:
            self.untold[way.name] = NightNotice(About.UNTOLD, _UNTOLD.given(way=way.name, reason=reason))
            watch(self.untold[way.name])
        return not reason


def find_ways_of(fleet: FleetFile, plugins: tuple[Path, ...]) -> Ways:
    """Return the ways that a fleet file names, each with its own keys checked.

    Raises `InputError` with every mistake in these keys, in the order of their places.
    """
    if not fleet.keys.notify:
        return Ways()
    registry, problems = find_plugins(files=plugins), list[Problem]()
    found = [_make_channel(fleet, index, registry, problems) for index in range(len(fleet.keys.notify))]
    if problems:
        raise InputError(sorted(set(problems)))
    return Ways(tuple(way for way in found if way))


def _make_channel(
    fleet: FleetFile, index: int, registry: Registry, problems: list[Problem]
) -> NewsChannel | None:
    keys, core = find_at(fleet.tree, ("notify", index)), fleet.keys.notify[index]
    named = find_at(fleet.tree, ("notify", index, "plugin"))
    if not isinstance(keys, Keys) or not isinstance(named, Scalar):
        return None
    try:
        notifier = registry.find(NOTIFIER, named.text, named.place)
    except InputError as error:
        problems.extend(error.problems)
        return None
    own = replace(keys.without(*_CORE), place=named.place)
    options = validate(notifier.options, own, problems, within="notify", also_known=_CORE)
    return NewsChannel(notifier, options, frozenset(map(Occasion, core.tells))) if options else None
