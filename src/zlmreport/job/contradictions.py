"""What no single key of a job shows to be wrong: days out of order, and statements that need another."""

from __future__ import annotations

import datetime as dt
from collections.abc import Iterable, Iterator
from functools import cache
from typing import TypeAlias

from pydantic import BaseModel

from zlmreport.errors import Problem, did_you_mean, quoted
from zlmreport.job.evaluation_keys import uncertainty_contradictions
from zlmreport.job.fields import keys_in, model_at
from zlmreport.job.keys import JobKeys
from zlmreport.job.measurement_keys import Measurement
from zlmreport.job.plan_keys import plan_contradictions
from zlmreport.job.tree import Items, Keys, Node, Step, place_of
from zlmreport.measurement.axis import AxisKind

#: The path of the key that would have to change, and a sentence.
Contradiction: TypeAlias = tuple[tuple[Step, ...], str]

_VERBS = {"amendment": "amends", "replacement": "replaces"}


def contradictions(keys: JobKeys, tree: Keys, others: Iterable[Contradiction] = ()) -> Iterator[Problem]:
    """Yield every contradiction of a job, and others that are known, at the key that would have to change."""
    for path, message in (*_contradictions(keys), *others):
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
    for key, message in plan_contradictions(keys.plan.targets):
        yield ("plan", "targets", key), message
    for steps, message in uncertainty_contradictions(keys.uncertainty, keys.axis.kind):
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


#: The parts of a job in which others may supply a value; the laboratory answers for the rest itself.
_PARTS = frozenset(
    {
        "customer",
        "machine",
        "axis",
        "location",
        "dates",
        "sampling",
        "measurement",
        "as_found",
        "instrument",
        "environment",
        "corrections",
        "uncertainty",
        "evaluate",
    }
)


@cache
def markable_keys() -> tuple[str, ...]:
    """Return the dotted names of all keys whose values may come from others; lists have no index in them."""
    return tuple(key for key in _names(JobKeys, "") if key.partition(".")[0] in _PARTS)


def supplied_problems(keys: JobKeys, tree: Keys) -> Iterator[Problem]:
    """Yield every key that is said to be somebody else's and is unknown, or not stated by the job."""
    for key, path in _named(keys):
        where = ".".join(step for step in path if isinstance(step, str))
        place = place_of(tree, path)
        if key not in markable_keys():
            near = did_you_mean(key, _neighbours(key, markable_keys()))
            yield Problem(place, f"{where}: {quoted(key)} is no key whose value others can supply; {near}")
        elif not _is_stated(tree, key.split(".")):
            yield Problem(place, f"{where}: this job does not state {key}; state it, or do not list it")


def _named(keys: JobKeys) -> Iterator[tuple[str, tuple[Step, ...]]]:
    """Yield the keys that a job names as others', each with the path at which it does."""
    for index, key in enumerate(keys.provided_by_customer):
        yield key, ("provided_by_customer", index)
    for number, external in enumerate(keys.external):
        for index, key in enumerate(external.keys):
            yield key, ("external", number, "keys", index)


def _names(model: type[BaseModel], within: str) -> Iterator[str]:
    for name in keys_in(model):
        yield f"{within}{name}"
        part = model_at(model, (name,)) or model_at(model, (name, 0))
        if part:
            yield from _names(part, f"{within}{name}.")


def _neighbours(key: str, known: tuple[str, ...]) -> list[str]:
    """Return the keys among which a misspelt one belongs: those of its group, if there is such a group."""
    group = key.rpartition(".")[0]
    return [each for each in known if each.rpartition(".")[0] == group] or list(known)


def _is_stated(node: Node, steps: list[str]) -> bool:
    """Whether a key stands in the job; a key of a list's items, if any of them has it."""
    if not steps:
        return True
    if isinstance(node, Items):
        return any(_is_stated(item, steps) for item in node.items)
    if isinstance(node, Keys) and steps[0] in node.entries:
        return _is_stated(node.entries[steps[0]].value, steps[1:])
    return False
