"""What people read of a plan: targets, sequence, what it will see, what it hides and what to do about it."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from zlmreport.cli.terminal import Colour, line_width, said, table, wrapped
from zlmreport.evaluation.checks import position_in_words
from zlmreport.job.job import Job
from zlmreport.measurement.axis import Axis
from zlmreport.model import wording
from zlmreport.model.design import Design
from zlmreport.model.effect import Shape, unit_of
from zlmreport.planning.methods import Method, Visit
from zlmreport.planning.plan import ASSUMPTION
from zlmreport.planning.planned_test import PlannedTest
from zlmreport.planning.targets import in_users_unit
from zlmreport.planning.visibility import Remedy, SeenEffect, Sight
from zlmreport.quantities.formatting import fixed_number, general_number, percentage

_MINUTE = 60.0
_MOST_STRETCHES = 6
_SEQUENCES = {
    Method.LINEAR: "over all targets upwards, then over all of them downwards: {runs}",
    Method.UNIDIRECTIONAL: "over all targets upwards, and back without a reading: {runs}",
    Method.PENDULUM: "each target from below and from above in turn, {runs}, before the next",
    Method.QUASI_PILGRIM: "to and fro between neighbours, the next upwards and this one downwards: {runs}",
}


def plan_lines(job: Job, planned: PlannedTest) -> Iterator[str]:
    """Yield the lines on a plan."""
    plan = planned.proposal.plan
    count = f"{len(plan.targets)} targets, {len(planned.visits)} readings"
    yield f"{Colour.BOLD.of(job.keys.certificate.number)}  axis {job.axis.name}: {count}"
    yield from ("", *_targets(job, planned))
    yield from ("", *_sequence(job, planned))
    yield from ("", *_requirements(planned))
    yield from ("", *_seen(job, planned))
    yield from _hidden(job, planned)
    yield from _logs(planned)


def _targets(job: Job, planned: PlannedTest) -> Iterator[str]:
    proposal = planned.proposal
    how = f"random fractions, seed {proposal.seed}" if proposal.has_fractions else "no random fractions"
    yield f"{Colour.BOLD.of('targets')}  {job.axis.position_unit.symbol}, {how}"
    targets = in_users_unit(job.axis, proposal.plan.targets)
    decimals = max(len(f"{target:.9f}".rstrip("0").partition(".")[2]) for target in targets)
    cells = [(f"{number}", fixed_number(each, decimals)) for number, each in enumerate(targets, start=1)]
    wide = max(len(text) for _, text in cells) + len(cells[-1][0]) + 5
    columns = max(1, min(len(cells), line_width() // wide))
    filled = [*cells, *[("", "")] * (-len(cells) % columns)]
    starts = range(0, len(filled), columns)
    rows = [[text for cell in filled[start : start + columns] for text in cell] for start in starts]
    yield from table(rows, right=range(2 * columns), indent="  ")
    for period in planned.half_seen:
        text = (
            f"all targets lie at two phases of {said(period)}: of what repeats with it, a part stays "
            "hidden that no share below counts; choose targets with a random fraction"
        )
        yield from wrapped(f"{Colour.YELLOW.of('check')}: {text}")


def _sequence(job: Job, planned: PlannedTest) -> Iterator[str]:
    proposal, unit = planned.proposal, job.axis.position_unit.symbol
    plan = proposal.plan
    times = "once" if plan.runs == 1 else f"{plan.runs} times"
    yield f"{Colour.BOLD.of('visits')}  {plan.method.value} method{_assumed('measurement.method', planned)}"
    yield from wrapped(_SEQUENCES[plan.method].format(runs=times))
    stretches = list(_stretches(planned.visits))
    shown = "  ".join(stretches[:_MOST_STRETCHES])
    yield from wrapped(f"{shown}  …" if len(stretches) > _MOST_STRETCHES else shown)
    overrun = said(position_in_words(job.axis, plan.overrun))
    feed = general_number(job.axis.position_unit.from_si(plan.feed) * _MINUTE)
    motion = (
        f"the axis turns round {overrun} beyond; {feed} {unit}/min{_assumed('measurement.feed', planned)}"
    )
    yield from wrapped(
        f"{motion}, {general_number(plan.dwell)} s at rest{_assumed('measurement.dwell', planned)}"
    )
    way = said(position_in_words(job.axis, round(planned.travelled, 3)))
    yield from wrapped(f"{way} of travel, about {max(1, round(planned.duration / _MINUTE))} min")
    yield from _beyond_the_travel(job.axis, planned)


def _beyond_the_travel(axis: Axis, planned: PlannedTest) -> Iterator[str]:
    if axis.travel is None or planned.beyond_travel is None:
        return
    ends = [said(position_in_words(axis, end)) for end in (*planned.beyond_travel, *axis.travel)]
    text = "it turns round at {} and {}; the travel is {} to {}".format(*ends)
    yield from wrapped(f"{Colour.YELLOW.of('check')}: {text}")


def _stretches(visits: Sequence[Visit]) -> Iterator[str]:
    """Yield visits in their order; those that go on in one direction from target to target as one."""
    start = 0
    for index in range(1, len(visits) + 1):
        if index < len(visits) and _goes_on(visits[index - 1], visits[index]):
            continue
        first, last = visits[start], visits[index - 1]
        arrow = first.approach.arrow
        whole = f"{first.target + 1}{arrow}"
        yield whole if first is last else f"{whole} … {last.target + 1}{arrow}"
        start = index


def _goes_on(one: Visit, other: Visit) -> bool:
    step = other.target - one.target
    return one.run == other.run and one.approach is other.approach and step == int(one.approach)


def _requirements(planned: PlannedTest) -> Iterator[str]:
    yield Colour.BOLD.of("what the standards ask")
    for designation, findings in planned.findings.items():
        unmet = [finding for finding in findings if finding.met is False]
        if not unmet:
            yield f"  {Colour.GREEN.of('met')}  {designation}"
        for finding in unmet:
            text = f"{designation}: {said(finding.requirement)}: {said(finding.found)}"
            yield from wrapped(f"{Colour.RED.of('not met')}  {text}")


def _seen(job: Job, planned: PlannedTest) -> Iterator[str]:
    model = " + ".join(planned.model.identifiers) or "nothing"
    yield f"{Colour.BOLD.of('what this plan can see')} beside {model}{_assumed('model.effects', planned)}"
    rows = [("", "visible", "found half of the time from", "")]
    for each in planned.seen_effects:
        if each.sight is Sight.VISIBLE:
            logs = "needs a log" if each.logs else ""
            rows.append(
                (each.effect.identifier, _percent(each.visibility.share), _smallest(each, job.axis), logs)
            )
    yield from table(rows, right=(1,), indent="  ")
    expected = planned.proposal.expected
    scatter = said(wording.deviation(job.axis, expected.sigma))
    rise = said(ASSUMPTION.given(rise=expected.temperature_change))
    yield from wrapped(
        f"if single readings scatter by {scatter} (standard deviation"
        f"{', assumed' if 'plan.repeatability' in planned.proposal.assumed else ''}), and {rise}"
    )


def _hidden(job: Job, planned: PlannedTest) -> Iterator[str]:
    """Yield what the plan hides, by what to do about it, and what cannot be tried, by what it needs."""
    blurred: dict[str, list[tuple[str, str]]] = {}
    untestable: dict[str, list[str]] = {}
    for each in planned.seen_effects:
        if each.sight is Sight.NOT_TESTABLE:
            untestable.setdefault(_untestable(each, planned.design), []).append(each.effect.identifier)
        elif each.sight in {Sight.HIDDEN, Sight.TOO_SMALL}:
            remedy = planned.remedies.get(each.effect.identifier)
            row = (each.effect.identifier, _blurred(each, remedy, job.axis))
            blurred.setdefault(_what_to_do(remedy), []).append(row)
    if blurred or untestable:
        yield from ("", Colour.BOLD.of("what it cannot see"))
    for text, rows in blurred.items():
        yield from wrapped(f"{text}:")
        yield from table(rows, indent="      ")
    for text, names in untestable.items():
        yield from wrapped(f"{', '.join(names)}: {text}")


def _blurred(seen: SeenEffect, remedy: Remedy | None, axis: Axis) -> str:
    """Return what is visible of an effect, and what would be."""
    shares = f"{_percent(seen.visibility.share)} visible"
    if remedy and remedy.share is not None:
        shares += f", then {_percent(remedy.share)}"
    if seen.sight is Sight.TOO_SMALL:
        shares += f"; found only from {_smallest(seen, axis)}, hardly plausible"
    return shares


def _what_to_do(remedy: Remedy | None) -> str:
    if remedy is None:
        return "no other targets or sequence that were tried would show"
    return f"{said(remedy.reason)}; {said(remedy.advice)}" if remedy.reason else said(remedy.advice)


def _untestable(seen: SeenEffect, design: Design) -> str:
    unexpected = [column for column in seen.logs if column not in design.conditions]
    if unexpected:
        return f"cannot be tried without the logged column {', '.join(unexpected)}"
    reason = seen.visibility.reason
    return said(reason) if reason else "cannot be tried"


def _logs(planned: PlannedTest) -> Iterator[str]:
    timed = [
        each.effect.identifier
        for each in planned.seen_effects
        if each.effect.shape is Shape.TIME and each.sight is not Sight.OTHER_AXIS and not each.logs
    ]
    by_effects: dict[str, list[str]] = {}
    for column, identifiers in planned.logs.items():
        by_effects.setdefault(", ".join(identifiers), []).append(column)
    if not timed and not by_effects:
        return
    yield from ("", Colour.BOLD.of("what to log beside the readings"))
    if timed:
        yield from wrapped(f"time: else the number of the reading stands for it ({', '.join(timed)})")
    for effects, columns in by_effects.items():
        yield from wrapped(f"{', '.join(columns)}: to be able to tell {effects}")


def _smallest(found: SeenEffect, axis: Axis) -> str:
    """Return the smallest effect that is found half of the time: by its parameter, or by what it does."""
    seen = found.visibility
    if seen.smallest is None:
        return f"{said(wording.deviation(axis, seen.smallest_rms))} rms"
    parameter, value = seen.smallest
    unit = unit_of(parameter.dimension, axis.kind)
    return f"{parameter.name} {said(wording.significant(value * unit.per_si, 2))} {unit.symbol}".rstrip()


def _assumed(key: str, planned: PlannedTest) -> str:
    return " (assumed)" if key in planned.proposal.assumed else ""


def _percent(share: float) -> str:
    return f"{percentage(share)} %"
