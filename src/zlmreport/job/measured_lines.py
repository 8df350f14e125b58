"""Several measured lines in a job: the source of each, and each as a job of its own."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace
from typing import Any

from zlmreport.job.axis import convert_axis_to_si
from zlmreport.job.installed import Installed
from zlmreport.job.job import Job, SourceChoice
from zlmreport.job.measurement_keys import AxisKeys, Measurement
from zlmreport.job.tree import Keys, find_at, make_keys_of
from zlmreport.measurement.error_symbol import ErrorSymbol, find_error_named, find_letter_of
from zlmreport.measurement.measurand import POSITIONING, is_for

_TESTS = ("measurement", "tests")


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


def make_job_of_test(job: Job, name: str, source: SourceChoice, registry: Installed) -> Job:
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
