"""Checks a job: each value against its key, and keys that contradict each other, with messages."""

from __future__ import annotations

import datetime as dt
import re
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping
from functools import cache
from typing import Any, TypeAlias, TypeVar

from pydantic import BaseModel, ValidationError

from zlmreport.errors import Problem, did_you_mean, quoted
from zlmreport.job.document_keys import Amends, OpinionKeys
from zlmreport.job.evaluation_keys import find_uncertainty_contradictions, find_wrong_positions
from zlmreport.job.keys import JobKeys
from zlmreport.job.measurement_keys import InstrumentKeys, Measurement, SensorKeys
from zlmreport.job.sentences import (
    GROUP_EXPECTED,
    MISSING,
    TEXT_EXPECTED,
    Mistake,
    find_mistakes_in,
    make_problem,
)
from zlmreport.job.tree import Items, Keys, Node, Scalar, Step, place_of
from zlmreport.job.types import LocatedText, find_model_at, list_keys_in
from zlmreport.measurement.axis import AxisKind

Model = TypeVar("Model", bound=BaseModel)
Path = tuple[Step, ...]

_NO_NUMBER = re.compile(r"[-+]?\.(inf|nan)", re.IGNORECASE)
_MOST_DIGITS = 400

#: The path of the key that would have to change, and a sentence.
Contradiction: TypeAlias = tuple[tuple[Step, ...], str]

_VERBS = {"amendment": "amends", "replacement": "replaces"}


def validate(
    model: type[Model],
    keys: Keys,
    problems: list[Problem],
    *,
    within: str = "",
    also_known: Collection[str] = (),
) -> Model | None:
    """Return a group of keys as its model, or None and all that is wrong with it.

    `also_known`: Keys that belong to the group and are not the model's, for messages.
    """
    found, mistakes = _read(model, keys)
    problems.extend(make_problem(mistake, model, within, also_known) for mistake in mistakes)
    return found


def find_problems_in_part(model: type[BaseModel], keys: Keys, within: str) -> list[Problem]:
    """Return what is wrong with some keys of a group, the rest of which stands elsewhere."""
    _, mistakes = _read(model, keys)
    return [make_problem(mistake, model, within, ()) for mistake in mistakes if mistake.kinds != {MISSING}]


def _read(model: type[Model], keys: Keys) -> tuple[Model | None, tuple[Mistake, ...]]:
    """Return a group of keys as its model, or None and the mistakes in it."""
    readings: dict[Path, Callable[[Scalar], Any]] = {}
    try:
        return model.model_validate(_read_plain_values(keys, (), readings)), ()
    except ValidationError as error:
        mistakes = find_mistakes_in(error, keys)
    readings = {mistake.path: reading for mistake in mistakes if (reading := _find_other_reading(mistake))}
    if readings:
        try:
            return model.model_validate(_read_plain_values(keys, (), readings)), ()
        except ValidationError as error:
            mistakes = find_mistakes_in(error, keys)
    return None, mistakes


def _find_other_reading(mistake: Mistake) -> Callable[[Scalar], Any] | None:
    """Return how a value that its key does not take may be read too.

    What looks like a number is text where only text is asked for, as it is spelt; and a group of which
    nothing is left but its key is an empty group.
    """
    node = mistake.node
    if not isinstance(node, Scalar):
        return None
    if node.is_nothing:
        return (lambda _: {}) if mistake.kinds & GROUP_EXPECTED else None
    return (lambda scalar: LocatedText(scalar.text, scalar.place)) if mistake.kinds <= TEXT_EXPECTED else None


def _read_plain_values(node: Node, path: Path, readings: Mapping[Path, Callable[[Scalar], Any]]) -> Any:
    """Return a tree as plain values; `readings` says which of them are read otherwise than they look."""
    if isinstance(node, Keys):
        return {
            key: _read_plain_values(entry.value, (*path, key), readings)
            for key, entry in node.entries.items()
        }
    if isinstance(node, Items):
        return [_read_plain_values(item, (*path, index), readings) for index, item in enumerate(node.items)]
    return readings.get(path, _resolve)(node)


def _resolve(scalar: Scalar) -> float | LocatedText | None:
    """Read a value as YAML 1.2 does, but for the truth values, which the keys that take them read."""
    if scalar.is_nothing:
        return None
    if scalar.plain and len(scalar.text) <= _MOST_DIGITS:
        if re.fullmatch(r"[-+]?\d+", scalar.text, re.ASCII):
            return int(scalar.text)
        if scalar.is_number:
            return float(scalar.text)
        if _NO_NUMBER.fullmatch(scalar.text):
            return float(scalar.text.replace(".", ""))
    return LocatedText(scalar.text, scalar.place)


def find_all_contradictions(keys: JobKeys, tree: Keys, others: Iterable[Contradiction]) -> Iterator[Problem]:
    """Yield every contradiction of a job, and others that are known, at the key that would have to change."""
    for path, message in (*_find_contradictions(keys), *others):
        named = ".".join(step for step in path if isinstance(step, str))
        yield Problem(place_of(tree, path), f"{named}: {message}")
    if keys.provided_by_customer or keys.external:
        yield from _find_supplied_problems(keys, tree)


def _find_contradictions(keys: JobKeys) -> Iterator[Contradiction]:
    certificate, due = keys.certificate, keys.next_due
    yield from _find_wrong_days(keys)
    if certificate.amends:
        yield from _find_wrong_amendment(certificate.number, certificate.amends)
    if certificate.authorised_by is None and keys.opinions:
        yield from _find_opinions_of_nobody(keys.opinions)
    if certificate.title and certificate.kind == "report":
        yield from _find_wrong_title(certificate.title)
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
    yield from _find_turned_ranges(keys)
    if keys.plan.targets.positions is not None:
        for message in find_wrong_positions(keys.plan.targets, keys.plan.targets.positions):
            yield ("plan", "targets", "positions"), message
    for steps, message in find_uncertainty_contradictions(
        keys.uncertainty, keys.axis.kind, is_circle=keys.circle is not None
    ):
        yield ("uncertainty", *steps), message
    if keys.instrument and keys.axis.kind is AxisKind.ROTARY:
        yield from _find_per_metre(keys.instrument)


def _list_devices(keys: JobKeys) -> Iterator[tuple[tuple[Step, ...], InstrumentKeys | SensorKeys]]:
    """Yield the instrument and the thermometers, each with the path of its keys."""
    if keys.instrument:
        yield ("instrument",), keys.instrument
    for number, each in enumerate(keys.environment.thermometers if keys.environment else ()):
        yield ("environment", "thermometers", number), each


def _find_turned_ranges(keys: JobKeys) -> Iterator[Contradiction]:
    """Yield the calibrated ranges that end before they begin, and calibrations due before they were made."""
    for group, device in _list_devices(keys):
        extent = device.calibrated_range
        if extent and extent[0] >= extent[1]:
            yield (*group, "calibrated_range"), "the first value of the range must be less than the last"
        if device.due and device.calibrated and device.due <= device.calibrated:
            yield (
                (*group, "due"),
                f"{device.due} does not lie after the calibration of {device.calibrated}",
            )


def _find_per_metre(instrument: InstrumentKeys) -> Iterator[Contradiction]:
    """Yield an uncertainty that grows with the length of an axis that has none."""
    stated = instrument.stated_uncertainty
    if stated and stated[1]:
        is_own = instrument.expanded_uncertainty_per_metre is not None
        name = "expanded_uncertainty_per_metre" if is_own else "expanded_uncertainty"
        yield ("instrument", name), "belongs to a linear axis: a rotary one has no metres"


def _find_wrong_days(keys: JobKeys) -> Iterator[Contradiction]:
    """Yield every day that lies before one which it must follow."""
    first, last = keys.measurement.date, find_last_day(keys.measurement)
    before = keys.as_found.measurement if keys.as_found else None
    received, sampled, issued = keys.dates.received, keys.dates.sampled, keys.certificate.issued
    due = keys.next_due.date if keys.next_due else None
    began = before.date if before and before.date else first
    if keys.measurement.end:
        yield from _find_wrong_end(("measurement",), keys.measurement.date, keys.measurement.end)
    if before:
        if before.end:
            yield from _find_wrong_end(("as_found", "measurement"), before.date, before.end)
        found = find_last_day(before)
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


def find_last_day(measurement: Measurement) -> dt.date | None:
    """Return the last day of a measurement; None where no day is stated."""
    return measurement.end or measurement.date


def _find_wrong_end(group: tuple[str, ...], first: dt.date | None, last: dt.date) -> Iterator[Contradiction]:
    if first is None:
        yield (*group, "end"), f"the first day is missing; add {'.'.join(group)}.date"
    elif last < first:
        yield (*group, "end"), f"{last} lies before the first day, {first}"


def _find_wrong_amendment(number: str, amends: Amends) -> Iterator[Contradiction]:
    if amends.number.casefold() == number.casefold():
        yield (
            ("certificate", "number"),
            (
                f"{number} is the number of the document that this one {_VERBS[amends.kind]}; "
                f"a changed document has a number of its own, such as {number}-1"
            ),
        )


def _find_opinions_of_nobody(opinions: Iterable[OpinionKeys]) -> Iterator[Contradiction]:
    for index, opinion in enumerate(opinions):
        if opinion.by is None:
            yield (
                ("opinions", index),
                (
                    "an opinion is stated by an authorised person (ISO/IEC 17025:2017, 7.8.7.1); add by, or "
                    "certificate.authorised_by"
                ),
            )


#: What a calibration certificate is called, in the languages of documents.
_OF_CERTIFICATES = re.compile(
    r"calibration certificate|certificate of calibration|kalibrier(?:schein|zertifikat)"
    r"|certificat d.[ée]talonnage|certificato di taratura|certificado de calibraci[óo]n",
    re.IGNORECASE,
)


def _find_wrong_title(title: str) -> Iterator[Contradiction]:
    """Yield the title of a measuring report that calls it a calibration certificate."""
    if _OF_CERTIFICATES.search(title):
        yield (
            ("certificate", "title"),
            (
                f"{quoted(title)} is the title of a calibration certificate, and this is a measuring report; "
                "take the title out, or state certificate.kind: certificate"
            ),
        )


#: The parts of a job in which others may supply a value; the laboratory answers for the rest itself.
_PARTS = frozenset(
    {
        "customer",
        "machine",
        "axis",
        "circle",
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


#: Keys of which each test has its own: their values are marked as those of the job's measurement.
_NAMED_TESTS = ("measurement.tests", "as_found.measurement.tests")


@cache
def list_markable_keys() -> tuple[str, ...]:
    """Return the dotted names of all keys whose values may come from others; lists have no index in them."""
    return tuple(
        key
        for key in _list_names(JobKeys, "")
        if key.partition(".")[0] in _PARTS and not key.startswith(_NAMED_TESTS)
    )


def _find_supplied_problems(keys: JobKeys, tree: Keys) -> Iterator[Problem]:
    """Yield every key that is said to be somebody else's and is unknown, or not stated by the job."""
    named: list[tuple[str, Path]] = [
        (key, ("provided_by_customer", index)) for index, key in enumerate(keys.provided_by_customer)
    ]
    for number, external in enumerate(keys.external):
        named += ((key, ("external", number, "keys", index)) for index, key in enumerate(external.keys))
    for key, path in named:
        where = ".".join(step for step in path if isinstance(step, str))
        place = place_of(tree, path)
        if key not in list_markable_keys():
            near = did_you_mean(key, _list_neighbours(key, list_markable_keys()))
            yield Problem(place, f"{where}: {quoted(key)} is no key whose value others can supply; {near}")
        elif not _is_stated(tree, key.split(".")):
            yield Problem(place, f"{where}: this job does not state {key}; state it, or do not list it")


def _list_names(model: type[BaseModel], within: str) -> Iterator[str]:
    for name in list_keys_in(model):
        yield f"{within}{name}"
        part = find_model_at(model, (name,)) or find_model_at(model, (name, 0))
        if part:
            yield from _list_names(part, f"{within}{name}.")


def _list_neighbours(key: str, known: tuple[str, ...]) -> list[str]:
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
