"""What no single key of a job shows to be wrong: days out of order, and statements that need another."""

from __future__ import annotations

import datetime as dt
from collections.abc import Iterator
from typing import TypeAlias

from zlmreport.errors import Problem
from zlmreport.job import plan_keys, step_gauge_keys, uncertainty_keys
from zlmreport.job.model import JobKeys, Measurement
from zlmreport.job.supplied_keys import supplied_problems
from zlmreport.job.tree import Keys, Step, place_of
from zlmreport.measurement.axis import AxisKind

#: The path of the key that would have to change, and a sentence.
Contradiction: TypeAlias = tuple[tuple[Step, ...], str]

_VERBS = {"amendment": "amends", "replacement": "replaces"}


def contradictions(keys: JobKeys, tree: Keys) -> Iterator[Problem]:
    """Yield every contradiction of a job, at the key that would have to change."""
    for path, message in _contradictions(keys):
        named = ".".join(step for step in path if isinstance(step, str))
        yield Problem(place_of(tree, path), f"{named}: {message}")
    yield from supplied_problems(keys, tree)


def _contradictions(keys: JobKeys) -> Iterator[Contradiction]:
    yield from _days(keys)
    yield from _amendment(keys)
    yield from _opinions(keys)
    due = keys.next_due
    if due and not due.agreed:
        yield (
            ("next_due", "agreed"),
            (
                "a certificate says when the next calibration is due only if the customer has agreed to it "
                "(ISO/IEC 17025:2017, 7.8.4.3); state agreed: true, or take next_due out"
            ),
        )
    travel = keys.axis.travel
    if travel and travel[0] >= travel[1]:
        yield ("axis", "travel"), "the first position of the travel must be less than the last"
    for key, message in plan_keys.contradictions(keys.plan.targets):
        yield ("plan", "targets", key), message
    if keys.step_gauge and keys.axis.kind is AxisKind.ROTARY:
        yield ("step_gauge",), "a step gauge has lengths, and the axis is rotary (axis.kind); take one out"
    for key, message in step_gauge_keys.contradictions(keys.step_gauge) if keys.step_gauge else ():
        yield ("step_gauge", key), message
    for steps, message in uncertainty_keys.contradictions(keys.uncertainty, keys.axis.kind):
        yield ("uncertainty", *steps), message
    per_metre = keys.instrument and keys.instrument.expanded_uncertainty_per_metre
    if per_metre and keys.axis.kind is AxisKind.ROTARY:
        yield (
            ("instrument", "expanded_uncertainty_per_metre"),
            "belongs to a linear axis: a rotary one has no metres",
        )


def _days(keys: JobKeys) -> Iterator[Contradiction]:
    """Yield every day that lies before one which it must follow."""
    first, last = keys.measurement.date, last_day(keys.measurement)
    before = keys.as_found.measurement if keys.as_found else None
    received, sampled, issued = keys.dates.received, keys.dates.sampled, keys.certificate.issued
    due = keys.next_due.date if keys.next_due else None
    began = before.date if before and before.date else first
    yield from _ends(("measurement",), keys.measurement)
    if before:
        yield from _ends(("as_found", "measurement"), before)
        found = last_day(before)
        if found and first and first < found:
            yield (
                ("as_found", "measurement", "date"),
                f"{found} lies after the measurement as left of {first}",
            )
    if issued and last and issued < last:
        yield ("certificate", "issued"), f"{issued} lies before the measurement of {last}"
    for key, day in (("received", received), ("sampled", sampled)):
        if day and began and began < day:
            yield ("dates", key), f"{day} lies after the measurement of {began}"
    if due and last and due <= last:
        yield ("next_due", "date"), f"{due} does not lie after the measurement of {last}"


def last_day(measurement: Measurement) -> dt.date | None:
    """Return the last day of a measurement; None where no day is stated."""
    return measurement.end or measurement.date


def _ends(group: tuple[str, ...], measurement: Measurement) -> Iterator[Contradiction]:
    if measurement.end and measurement.date is None:
        yield (*group, "end"), f"the first day is missing; add {'.'.join(group)}.date"
    elif measurement.end and measurement.date and measurement.end < measurement.date:
        yield (*group, "end"), f"{measurement.end} lies before the first day, {measurement.date}"


def _amendment(keys: JobKeys) -> Iterator[Contradiction]:
    amends = keys.certificate.amends
    if amends and amends.number.casefold() == keys.certificate.number.casefold():
        yield (
            ("certificate", "number"),
            (
                f"{keys.certificate.number} is the number of the document that this one "
                f"{_VERBS[amends.kind]}; a changed document has a number of its own, such as "
                f"{keys.certificate.number}-1"
            ),
        )


def _opinions(keys: JobKeys) -> Iterator[Contradiction]:
    for index, opinion in enumerate(keys.opinions):
        if opinion.by is None and keys.certificate.authorised_by is None:
            yield (
                ("opinions", index),
                (
                    "an opinion is stated by an authorised person (ISO/IEC 17025:2017, 7.8.7.1); add by, or "
                    "certificate.authorised_by"
                ),
            )
