"""Keys that follow from others of a job: axis, what standards ask; lines as jobs of their own."""

from __future__ import annotations

from collections.abc import Iterable
from contextlib import suppress
from dataclasses import replace
from typing import TYPE_CHECKING, Any

from zlmreport.errors import InputError
from zlmreport.job.axis import convert_axis_to_si
from zlmreport.job.choices import SourceChoice, group_naming
from zlmreport.job.circle_keys import CircleKeys
from zlmreport.job.job import Job
from zlmreport.job.keys import JobKeys
from zlmreport.job.measurement_keys import AxisKeys, Measurement
from zlmreport.job.tree import Items, KeyEntry, Keys, Scalar, find_at, make_keys_of, merge, place_of
from zlmreport.measurement.error_symbol import ErrorSymbol, find_error_named, find_letter_of
from zlmreport.measurement.measurand import POSITIONING, is_for

if TYPE_CHECKING:
    from zlmreport.plugin.registry import Registry

_TESTS = ("measurement", "tests")


def find_stated_in(tree: Keys) -> str:
    """Return what a job says was measured, by its symbol or its name; empty where it does not."""
    stated = find_at(tree, ("measurement", "error"))
    return stated.text.strip() if isinstance(stated, Scalar) else ""


def _find_error_in(tree: Keys) -> ErrorSymbol | None:
    """Return the error that a job names; None where it names none, or one that there is not."""
    with suppress(ValueError):
        return find_error_named(find_stated_in(tree))
    return None


def add_shared_source(tree: Keys) -> Keys:
    """Return the keys of a job with the source of its measurement in each test that has none of its own."""
    measurement, tests = find_at(tree, ("measurement",)), find_at(tree, _TESTS)
    if (
        not isinstance(measurement, Keys)
        or not isinstance(tests, Keys)
        or "source" not in measurement.entries
    ):
        return tree
    source = measurement.entries["source"]
    shared = {
        name: entry
        for name, entry in tests.entries.items()
        if isinstance(entry.value, Keys) and "source" not in entry.value.entries
    }
    if not shared:
        return tree
    filled = {
        name: replace(entry, value=make_keys_of(entry.value.place, (*entry.value.entries.values(), source)))
        for name, entry in shared.items()
        if isinstance(entry.value, Keys)
    }
    of_tests = make_keys_of(tests.place, tuple({**tests.entries, **filled}.values()))
    entries = dict(measurement.without("source").entries)
    entries["tests"] = replace(entries["tests"], value=of_tests)
    whole = replace(
        tree.entries["measurement"], value=make_keys_of(measurement.place, tuple(entries.values()))
    )
    return make_keys_of(tree.place, tuple({**tree.entries, "measurement": whole}.values()))


def add_axis(tree: Keys, registry: Registry) -> Keys:
    """Return the keys of a job without an axis, with the one that a circle, an extension or an error has."""
    error = _find_error_in(tree)
    name = next((key for key in registry.axis_keys if key in tree.entries), "")
    place = tree.entries[name].place if name else place_of(tree, ("measurement",))
    if "circle" in tree.entries:
        plane = find_at(tree, ("circle", "plane"))
        place = tree.entries["circle"].place
        name = plane.text if isinstance(plane, Scalar) else str(CircleKeys.model_fields["plane"].default)
    if not name and error:
        name = error.axis
    if not name and isinstance(listed := find_at(tree, _TESTS), Keys):
        name = name_together(listed.entries)
    if not name:
        return tree
    axis = make_keys_of(place, (KeyEntry("name", place, Scalar(place, name, plain=False)),))
    return merge(tree, make_keys_of(tree.place, (KeyEntry("axis", place, axis),)))


def share_keys(tree: Keys, registry: Registry) -> Keys:
    """Return the keys of a job with what standards ask of the measurement among their own keys.

    Such a key stands in `measurement`, or at the top of the job; each standard that asks for it gets it. One
    that is the job's own, as `circle`, stays there too.
    """
    evaluate, measurement = find_at(tree, ("evaluate",)), find_at(tree, ("measurement",))
    if not isinstance(evaluate, Items):
        return tree
    taken: set[str] = set()
    items = []
    for item in evaluate.items:
        group = group_naming("standard", item)
        shared = []
        named = group.entries.get("standard")
        if named and isinstance(named.value, Scalar):
            with suppress(InputError):  # a standard that there is not is refused later
                options = registry.standard(named.value.text, named.value.place).options
                shared = [key for key in options.of_the_measurement if key not in registry.extension_keys]
        entries = dict(group.entries)
        for key in shared:
            for place in (measurement, tree):
                if isinstance(place, Keys) and key in place.entries:
                    entries.setdefault(key, place.entries[key])
                    taken.add(key)
        items.append(
            make_keys_of(group.place, tuple(entries.values())) if len(entries) > len(group.entries) else item
        )
    if not taken:
        return tree
    taken -= JobKeys.model_fields.keys()
    entries = dict(tree.without(*taken).entries)
    entries["evaluate"] = replace(tree.entries["evaluate"], value=Items(evaluate.place, tuple(items)))
    if isinstance(measurement, Keys):
        entries["measurement"] = replace(entries["measurement"], value=measurement.without(*taken))
    return make_keys_of(tree.place, tuple(entries.values()))


def make_job_of_test(job: Job, name: str, source: SourceChoice, registry: Registry) -> Job:
    """Return one of several measured lines as a job of its own: what is not said of it is as in the job."""
    whole, own = job.keys.measurement, job.keys.measurement.tests[name]
    inherited = {
        key: getattr(whole, key)
        for key in whole.model_fields_set & type(own).model_fields.keys()
        if key not in own.model_fields_set and key not in {"error", "source"}
    }
    stated = {key: getattr(own, key) for key in own.model_fields_set & Measurement.model_fields.keys()}
    measurement = Measurement.model_validate({}).model_copy(update={**inherited, **stated})
    update: dict[str, Any] = {"measurement": measurement}
    for key in ("instrument", "environment", "uncertainty"):
        if getattr(own, key) is not None:
            update[key] = getattr(own, key)
    axis_keys = own.axis
    of_lines = job.axis.measurand.of_lines
    is_usual = of_lines is not None and own.error in {None, of_lines.identifier}
    error = find_error_named(own.error) if own.error and not is_usual else None
    if axis_keys is None:
        axis_keys = _find_axis_of_test(job, name, error)
    update["axis"] = axis_keys
    quantity = error.measurand if error else of_lines
    return replace(
        job,
        keys=job.keys.model_copy(update=update),
        axis=convert_axis_to_si(axis_keys, quantity, error, measurement.at),
        source=source,
        source_as_found=None,
        standards=tuple(
            replace(each, tolerances={})
            for each in job.standards
            if is_for(registry.standard(each.identifier), quantity or POSITIONING)
        ),
        effects=(),
        candidates=(),
        files=(),
        tests={},
    )


def _find_axis_of_test(job: Job, name: str, error: ErrorSymbol | None) -> AxisKeys:
    """Return the axis of a measured line that states none: that of its error, or one of the test's name."""
    stated = job.keys.axis
    if error is None:
        return AxisKeys(name=name) if stated.name == name_together(job.keys.measurement.tests) else stated
    return stated if find_letter_of(stated.name) == error.axis else AxisKeys(name=error.axis)


def name_together(tests: Iterable[str]) -> str:
    """Return the name of what several measured lines are of, where no axis is stated."""
    return " ".join(tests)
