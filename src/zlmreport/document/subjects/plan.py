"""A test before it is done, for people and as values: targets or circles, what it will see, what it hides."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from zlmreport.document.blocks import (
    Align,
    Block,
    Column,
    Facts,
    Mark,
    Notice,
    Paragraph,
    RowGroup,
    Section,
    Table,
)
from zlmreport.evaluation.checks import position_in_words, readings_in_words
from zlmreport.job.job import Job
from zlmreport.language import Language, Words, named
from zlmreport.language.formatting import (
    HELD,
    write_general_number,
    write_percentage,
    write_stated_number,
)
from zlmreport.language.numbers import write_significant
from zlmreport.language.writer import LanguageWriter
from zlmreport.measurement.axis import Axis
from zlmreport.measurement.units import MILLIMETRE, SECONDS_PER_MINUTE, with_unit, write_behind
from zlmreport.model.effects import wording
from zlmreport.model.effects.effect import Shape, find_unit_of
from zlmreport.model.planning.circle_path import SENSES, CirclePath
from zlmreport.model.planning.methods import Method, Visit
from zlmreport.model.planning.plan import ASSUMPTION
from zlmreport.model.planning.planned_test import PlannedTest
from zlmreport.model.planning.targets import convert_to_users_unit
from zlmreport.model.planning.visibility import Remedy, SeenEffect, Sight

_MOST_STRETCHES = 6
_COUNT = Words("{targets}, {readings}")
_COUNTED_TARGETS = Words("{number} target", plural="{number} targets")
_TARGETS = Words("Targets")
_FRACTIONS = Words("In {unit}, at random fractions, seed {seed}")
_NO_FRACTIONS = Words("In {unit}, at no random fractions")
_HALF_SEEN = Words(
    "check: all targets lie at two phases of {period}: of what repeats with it, a part stays hidden that "
    "no share below counts; choose targets with a random fraction"
)
_METHOD = Words("{method} method{assumed}")
_ASSUMED = Words(" (assumed)")
_SEQUENCES = {
    Method.LINEAR: Words("over all targets upwards, then over all of them downwards: {runs}"),
    Method.UNIDIRECTIONAL: Words("over all targets upwards, and back without a reading: {runs}"),
    Method.PENDULUM: Words("each target from below and from above in turn, {runs}, before the next"),
    Method.QUASI_PILGRIM: Words(
        "to and fro between neighbours, the next upwards and this one downwards: {runs}"
    ),
}
_ONCE, _TIMES = Words("once"), Words("{runs} times")
_MOTION = Words(
    "the axis turns round {overrun} beyond; {feed} {unit}/min{is_feed}, {dwell} s at rest{is_dwell}"
)
_TRAVELLED = Words("{way} of travel, about {minutes} min")
_BEYOND = Words("check: it turns round at {low} and {high}; the travel is {first} to {last}")
_ASKED = Words("What the standards ask")
_MET = Words("met: {standard}")
_NOT_MET = Words("not met: {standard}: {requirement}: {found}")
_SEEN = Words("What this plan can see beside {model}{assumed}")
_IF = Words("if single readings scatter by {scatter} (standard deviation{assumed}), and {rise}")
_HIDDEN = Words("What it cannot see")
_SHARE = Words("{share} % visible")
_THEN = Words("{shares}, then {share} %")
_HARDLY = Words("{shares}; found only from {size}, hardly plausible")
_REMEDY = Words("{reason}; {advice}")
_NEEDS_LOG = Words("cannot be tried without the logged column {columns}")
_TIME = Words("time: else the number of the reading stands for it ({effects})")
_TO_TELL = Words("{columns}: to be able to tell {effects}")
_PARAMETER = Words("{name} {size}{unit}")


def say_size_of_plan(planned: PlannedTest) -> Words:
    """Return how many targets and readings a plan has."""
    targets = _COUNTED_TARGETS.given(number=len(planned.proposal.plan.targets))
    return _COUNT.given(targets=targets, readings=readings_in_words(len(planned.visits)))


def plan_sections(job: Job, planned: PlannedTest, language: Language) -> tuple[Section, ...]:
    """Return what is said of a plan: ``targets``, ``visits``, ``asked``, ``seen``, ``hidden``, ``logs``."""
    said = _Plan(language, job, planned)
    model = " + ".join(planned.model.identifiers) or said.say(Words("nothing"))
    sections = (
        Section("targets", said.say(_TARGETS), tuple(said.lay_out_targets())),
        Section("visits", said.say(Words("Visits")), tuple(said.lay_out_visits())),
        Section("asked", said.say(_ASKED), tuple(said.lay_out_requirements())),
        Section(
            "seen",
            said.say(_SEEN.given(model=model, assumed=said.say_assumed("model.effects"))),
            tuple(said.lay_out_seen()),
        ),
        Section("hidden", said.say(_HIDDEN), tuple(said.lay_out_hidden())),
        Section("logs", said.say(Words("What to log beside the readings")), tuple(said.lay_out_logs())),
    )
    return tuple(each for each in sections if each.blocks)


@dataclass(frozen=True, slots=True)
class _Plan(LanguageWriter):
    """Says what there is to say of a plan in one language."""

    job: Job
    planned: PlannedTest

    @property
    def axis(self) -> Axis:
        return self.job.axis

    def say_assumed(self, key: str) -> Words | str:
        """Return the words behind a value that the job does not state."""
        return _ASSUMED if key in self.planned.proposal.assumed else ""

    def lay_out_targets(self) -> Iterator[Block]:
        proposal, unit = self.planned.proposal, self.axis.position_unit.symbol
        how = _FRACTIONS if proposal.has_fractions else _NO_FRACTIONS
        yield Paragraph(self.say(how.given(unit=unit, seed=proposal.seed)))
        targets = convert_to_users_unit(self.axis, proposal.plan.targets)
        decimals = max(len(f"{target:.9f}".rstrip("0").partition(".")[2]) for target in targets)
        texts = (self.write_number(each, decimals) for each in targets)
        yield Facts(tuple((str(number), text) for number, text in enumerate(texts, start=1)))
        for period in self.planned.half_seen:
            yield Paragraph(self.say(_HALF_SEEN.given(period=period)), Mark.OPEN)

    def lay_out_visits(self) -> Iterator[Block]:
        planned, plan = self.planned, self.planned.proposal.plan
        unit = self.axis.position_unit
        runs = _ONCE if plan.runs == 1 else _TIMES.given(runs=plan.runs)
        stretches = list(_join_stretches(planned.visits))
        shown = "  ".join(stretches[:_MOST_STRETCHES])
        method = _METHOD.given(method=plan.method.value, assumed=self.say_assumed("measurement.method"))
        yield Paragraph(self.say(method))
        yield Paragraph(self.say(_SEQUENCES[plan.method].given(runs=runs)))
        yield Paragraph(f"{shown}  …" if len(stretches) > _MOST_STRETCHES else shown)
        motion = _MOTION.given(
            overrun=position_in_words(self.axis, plan.overrun),
            feed=self.write_stated(unit.from_si(plan.feed) * SECONDS_PER_MINUTE),
            unit=unit.symbol,
            is_feed=self.say_assumed("measurement.feed"),
            dwell=self.write_stated(plan.dwell),
            is_dwell=self.say_assumed("measurement.dwell"),
        )
        yield Paragraph(self.say(motion))
        way = with_unit(self.say(write_significant(unit.from_si(planned.travelled))), unit.symbol)
        minutes = max(1, round(planned.duration / SECONDS_PER_MINUTE))
        yield Paragraph(self.say(_TRAVELLED.given(way=way, minutes=minutes)))
        if self.axis.travel is not None and planned.beyond_travel is not None:
            names = ("low", "high", "first", "last")
            ends = (position_in_words(self.axis, end) for end in (*planned.beyond_travel, *self.axis.travel))
            yield Paragraph(self.say(_BEYOND.given(**dict(zip(names, ends, strict=True)))), Mark.OPEN)

    def lay_out_requirements(self) -> Iterator[Block]:
        for standard, findings in self.planned.findings.items():
            unmet = [each for each in findings if each.met is False]
            if not unmet:
                yield Paragraph(self.say(_MET.given(standard=standard)), Mark.MET)
            for each in unmet:
                words = _NOT_MET.given(standard=standard, requirement=each.requirement, found=each.found)
                yield Paragraph(self.say(words), Mark.NOT_MET)

    def lay_out_seen(self) -> Iterator[Block]:
        rows = tuple(
            (
                each.effect.identifier,
                self.write_percent(each.visibility.share),
                self.say(self.say_smallest(each)),
                self.say(Words("needs a log")) if each.logs else "",
            )
            for each in self.planned.seen_effects
            if each.sight is Sight.VISIBLE
        )
        columns = (
            Column(""),
            Column(self.say(Words("visible")), "%", Align.RIGHT),
            Column(self.say(Words("found half of the time from"))),
            Column(""),
        )
        yield Table("", columns, (RowGroup(rows),))
        expected, assumed = self.planned.proposal.expected, self.planned.proposal.assumed
        words = _IF.given(
            scatter=wording.deviation(self.axis, expected.sigma),
            assumed=Words(", assumed") if "plan.repeatability" in assumed else "",
            rise=ASSUMPTION.given(rise=expected.temperature_change),
        )
        yield Paragraph(self.say(words))

    def lay_out_hidden(self) -> Iterator[Block]:
        """Yield what the plan hides, by what to do about it, and what cannot be tried, by what it needs."""
        blurred: dict[str, list[str]] = {}
        untestable: dict[str, list[str]] = {}
        for each in self.planned.seen_effects:
            name = each.effect.identifier
            if each.sight is Sight.NOT_TESTABLE:
                untestable.setdefault(self.say(self.say_untestable(each)), []).append(name)
            elif each.sight in {Sight.HIDDEN, Sight.TOO_SMALL}:
                remedy = self.planned.remedies.get(name)
                item = self.say(named(name, self.say_blurred(each, remedy)))
                blurred.setdefault(self.say(_say_what_to_do(remedy)), []).append(item)
        yield from (Notice(text, tuple(items)) for text, items in blurred.items())
        yield from (Paragraph(self.say(named(", ".join(names), text))) for text, names in untestable.items())

    def say_blurred(self, seen: SeenEffect, remedy: Remedy | None) -> Words:
        """Return what is visible of an effect, and what would be."""
        words = _SHARE.given(share=self.write_percent(seen.visibility.share))
        if remedy and remedy.share is not None:
            words = _THEN.given(shares=words, share=self.write_percent(remedy.share))
        if seen.sight is Sight.TOO_SMALL:
            words = _HARDLY.given(shares=words, size=self.say_smallest(seen))
        return words

    def say_untestable(self, seen: SeenEffect) -> Words:
        unexpected = [column for column in seen.logs if column not in self.planned.design.conditions]
        if unexpected:
            return _NEEDS_LOG.given(columns=", ".join(unexpected))
        return seen.visibility.reason or Words("cannot be tried")

    def lay_out_logs(self) -> Iterator[Block]:
        timed = [
            each.effect.identifier
            for each in self.planned.seen_effects
            if each.effect.shape is Shape.TIME and each.sight is not Sight.OTHER_AXIS and not each.logs
        ]
        by_effects: dict[str, list[str]] = {}
        for column, identifiers in self.planned.logs.items():
            by_effects.setdefault(", ".join(identifiers), []).append(column)
        if timed:
            yield Paragraph(self.say(_TIME.given(effects=", ".join(timed))))
        for effects, columns in by_effects.items():
            yield Paragraph(self.say(_TO_TELL.given(columns=", ".join(columns), effects=effects)))

    def say_smallest(self, found: SeenEffect) -> Words:
        """Return the smallest effect that is found half of the time: by its parameter, or by what it does."""
        seen = found.visibility
        if seen.smallest is None:
            return Words("{size} rms").given(size=wording.deviation(self.axis, seen.smallest_rms))
        parameter, value = seen.smallest
        unit = find_unit_of(parameter.dimension, self.axis.kind)
        size = write_significant(value * unit.per_si, 2)
        return _PARAMETER.given(name=parameter.name, size=size, unit=write_behind(unit.symbol))

    def write_percent(self, share: float) -> str:
        return write_percentage(share, self.language.decimal_sign)


def _say_what_to_do(remedy: Remedy | None) -> Words:
    if remedy is None:
        return Words("no other targets or sequence that were tried would show")
    return _REMEDY.given(reason=remedy.reason, advice=remedy.advice) if remedy.reason else remedy.advice


def _join_stretches(visits: Sequence[Visit]) -> Iterator[str]:
    """Yield visits in their order; those that go on in one direction from target to target as one."""
    start = 0
    for index in range(1, len(visits) + 1):
        if index < len(visits) and _is_going_on(visits[index - 1], visits[index]):
            continue
        first, last = visits[start], visits[index - 1]
        arrow = first.approach.arrow
        whole = f"{first.target + 1}{arrow}"
        yield whole if first is last else f"{whole} … {last.target + 1}{arrow}"
        start = index


def _is_going_on(one: Visit, other: Visit) -> bool:
    step = other.target - one.target
    return one.run == other.run and one.approach is other.approach and step == int(one.approach)


_DIGITS = 3
_SIZE_OF_ONE = Words("1 turn of radius {radius} mm")
_SIZE = Words("{count} turns of radius {radius} mm")
_PATH = Words("Path")
_ROUND = Words(
    "evaluated from {first} to {last}°, +{from_axis} towards +{to_axis}, counter-clockwise and back clockwise"
)
_RUNS = Words("{runs} in each sense{assumed}")
_BESIDE = Words(
    "{arc}° of the circle before and behind it; the tool comes up from {run_up} mm outside, and rests "
    "{rest} s between two turns"
)
_SLOWER = Words(
    "a control that allows less acceleration runs slower than it is told; the readings then tell their "
    "own time"
)
_SOURCE = Words("source: {{plugin: circle-csv, feed_in: {arc}, feed_out: {arc}}}")


def say_size_of_circle(path: CirclePath) -> Words:
    """Return how many turns a test has, and of which radius."""
    turns = len(path.turns)
    return (_SIZE if turns != 1 else _SIZE_OF_ONE).given(count=turns, radius=path.radius)


def lay_out_circle_plan(job: Job, paths: Sequence[CirclePath], language: Language) -> tuple[Section, ...]:
    """Return what is said of the path of a circular test: ``path``, ``feeds``, ``reading``.

    `paths`: One for each feed.
    """

    def say(words: Words) -> str:
        return words.in_language(language)

    arc = write_stated_number(paths[0].turns[0].arc)
    return (
        Section("path", say(_PATH), tuple(Paragraph(say(words)) for words in _describe_path(job, paths[0]))),
        Section("feeds", say(Words("Feeds")), tuple(_lay_out_feeds(paths, language))),
        Section("reading", say(Words("To read the circle")), (Paragraph(say(_SOURCE.given(arc=arc))),)),
    )


def _describe_path(job: Job, path: CirclePath) -> Iterator[Words]:
    turn = path.turns[0]
    first, last = sorted((turn.first, turn.last))
    from_axis, to_axis = path.circle.axes
    yield _ROUND.given(first=first, last=last, from_axis=from_axis, to_axis=to_axis)
    runs = len({each.run for each in path.turns})
    yield _RUNS.given(runs=runs, assumed="" if job.keys.plan.runs else _ASSUMED)
    yield _BESIDE.given(arc=turn.arc, run_up=path.run_up, rest=path.rest)


def _lay_out_feeds(paths: Sequence[CirclePath], language: Language) -> Iterator[Block]:
    columns = (
        Column("", "mm/min", Align.RIGHT),
        Column(Words("turn").in_language(language), "s", Align.RIGHT),
        Column(Words("test").in_language(language), "min", Align.RIGHT),
        Column(Words("acceleration").in_language(language), "m/s²", Align.RIGHT),
    )
    sign = language.decimal_sign
    rows = tuple(
        tuple(
            write_general_number(float(f"{value:.{_DIGITS}g}"), sign)
            for value in (
                path.feed,
                _compute_time_of_turn(path),
                path.duration / SECONDS_PER_MINUTE,
                path.acceleration,
            )
        )
        for path in paths
    )
    yield Table("", columns, (RowGroup(rows),))
    yield Paragraph(_SLOWER.in_language(language))


def _compute_time_of_turn(path: CirclePath) -> float:
    """Return the time of what is evaluated of a turn, s."""
    turn = path.turns[0]
    return math.radians(abs(turn.last - turn.first)) * path.radius / path.feed * SECONDS_PER_MINUTE


def collect_circle_plan(job: Job, paths: Sequence[CirclePath], written: Sequence[Path]) -> dict[str, Any]:
    """Return the path of a circular test as plain values for JSON; positions in mm, angles in degrees."""
    path = paths[0]
    return {
        "schema": SCHEMA,
        "certificate": {"number": job.keys.certificate.number},
        "circle": {
            "plane": path.circle.plane,
            "radius": path.radius,
            "centre": [MILLIMETRE.from_si(each) for each in path.circle.centre],
        },
        "units": {"position": "mm", "angle": "deg", "time": "s"},
        "run_up": path.run_up,
        "rest": path.rest,
        "turns": [
            {
                "sense": SENSES[turn.sense],
                "run": turn.run,
                "first": turn.first,
                "last": turn.last,
                "arc": turn.arc,
            }
            for turn in path.turns
        ],
        "feeds": [
            {
                "feed_per_minute": each.feed,
                "duration": each.duration,
                "acceleration": each.acceleration,
            }
            for each in paths
        ],
        "assumed": [] if job.keys.plan.runs else ["plan.runs"],
        "files": [str(each) for each in written],
    }


SCHEMA = "zlmreport/plan/1"


def plan_values(job: Job, planned: PlannedTest, written: Sequence[Path] = ()) -> dict[str, Any]:
    """Return a plan as plain values for JSON."""
    axis, proposal = job.axis, planned.proposal
    plan, position = proposal.plan, axis.position_unit
    targets = convert_to_users_unit(axis, plan.targets)
    return {
        "schema": SCHEMA,
        "certificate": {"number": job.keys.certificate.number},
        "axis": {"name": axis.name, "kind": axis.kind.value},
        "units": {"position": position.ascii, "deviation": axis.deviation_unit.ascii, "time": "s"},
        "method": plan.method.value,
        "runs": plan.runs,
        "overrun": round(position.from_si(plan.overrun), 9),
        "feed_per_minute": round(position.from_si(plan.feed) * 60, 9),
        "dwell": plan.dwell,
        "seed": proposal.seed if proposal.has_fractions else None,
        "assumed": sorted(proposal.assumed),
        "expected": {
            "repeatability": axis.deviation_unit.from_si(proposal.expected.sigma),
            "temperature_change": proposal.expected.temperature_change,
        },
        "travelled": position.from_si(planned.travelled),
        "duration": planned.duration,
        "targets": targets,
        "two_phases_of": [_say(period) for period in planned.half_seen],
        "visits": [
            {
                "target": targets[visit.target],
                "direction": visit.approach.sign,
                "run": visit.run,
                "time": time,
            }
            for visit, time in zip(planned.visits, planned.design.time.tolist(), strict=True)
        ],
        "model": list(planned.model.identifiers),
        "visibility": [
            _collect_seen_effect(each, planned.remedies.get(each.effect.identifier), axis)
            for each in planned.seen_effects
        ],
        "log": [{"column": column, "effects": names} for column, names in planned.logs.items()],
        "requirements": [
            {
                "standard": designation,
                "requirement": _say(finding.requirement),
                "found": _say(finding.found),
                "met": finding.met,
            }
            for designation, findings in planned.findings.items()
            for finding in findings
        ],
        "files": [str(path) for path in written],
    }


def _collect_seen_effect(found: SeenEffect, remedy: Remedy | None, axis: Axis) -> dict[str, Any]:
    seen = found.visibility
    smallest = None
    if seen.smallest is not None and math.isfinite(seen.smallest[1]):
        parameter, value = seen.smallest
        unit = find_unit_of(parameter.dimension, axis.kind)
        smallest = {"name": parameter.name, "value": value * unit.per_si, "unit": unit.ascii}
    return {
        "effect": seen.effect,
        "sight": found.sight.value,
        "share": seen.share,
        "smallest_rms": axis.deviation_unit.from_si(seen.smallest_rms)
        if math.isfinite(seen.smallest_rms)
        else None,
        "smallest": smallest,
        "log": list(found.logs),
        "reason": None if seen.reason is None else _say(seen.reason),
        "remedy": None
        if remedy is None
        else {
            "reason": None if remedy.reason is None else _say(remedy.reason),
            "advice": _say(remedy.advice),
            "share": remedy.share,
        },
    }


def _say(words: Words | str) -> str:
    text = words if isinstance(words, str) else words.in_language(Language.ENGLISH)
    return text.replace(HELD, " ")
