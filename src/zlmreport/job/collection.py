"""A job that makes one document of several jobs (``measurements``): what it says for all of them."""

from __future__ import annotations

import re
from collections.abc import Iterable
from pathlib import Path

from zlmreport.errors import InputError, Place, Problem, quoted
from zlmreport.job.measurement_keys import is_same_serial
from zlmreport.job.tree import Items, KeyEntry, Keys, Node, Scalar, find_at, make_keys_of, merge
from zlmreport.job.types import resolve_path_named
from zlmreport.measurement.axis import Axis

MEASUREMENTS = "measurements"
#: Jobs that one document has at most.
MOST = 60
#: Keys of the document that its jobs have too, in the place of their own.
_SHARED = (
    *("schema", "laboratory", "customer", "machine", "location", "procedure"),
    *("dates", "agreement", "decision_rule"),
)
_OF_CERTIFICATE = (
    *("number", "kind", "language", "issued"),
    *("layout", "paper", "readings_on_graphs", "authorised_by", "style"),
)
#: Keys of one measurement, which a document of several has none of.
_OF_ONE = (
    *("axis", "circle", "measurement", "as_found", "instrument", "environment", "corrections", "evaluate"),
    *("uncertainty", "model", "plan", "capture", "compensation"),
)
_NOT_IN_NAMES = re.compile(r"[^A-Za-z0-9_-]+")


def list_jobs_named(tree: Keys) -> tuple[tuple[Path, Place], ...]:
    """Return the files of the jobs that a document is made of, with the places that name them.

    Raises `InputError` with each that is none, stands there twice, or is a key of one measurement.
    """
    entry = tree.entries[MEASUREMENTS]
    problems = [
        Problem(
            tree.entries[key].place,
            f"{key} belongs to one measurement: a document of several has it in each of their jobs",
        )
        for key in _OF_ONE
        if key in tree.entries
    ]
    items = entry.value.items if isinstance(entry.value, Items) else ()
    if not 1 <= len(items) <= MOST:
        said = f"{MEASUREMENTS}: a list of 1 to {MOST} jobs is expected: [x.yaml, circle.yaml]"
        problems.append(Problem(entry.place, said))
    found: dict[Path, Place] = {}
    for item in items:
        try:
            path = _take_path(item)
        except ValueError as error:
            problems.append(Problem(item.place, f"{MEASUREMENTS}: {error}"))
            continue
        if path.resolve() in {each.resolve() for each in found}:
            problems.append(Problem(item.place, f"{MEASUREMENTS}: this job stands there already"))
        found.setdefault(path, item.place)
    if problems:
        raise InputError(problems)
    return tuple(found.items())


def _take_path(item: Node) -> Path:
    if not isinstance(item, Scalar) or not item.text:
        raise ValueError("the name of a job file is expected")
    return resolve_path_named(item.text, Path(item.place.file))


def make_part_of(own: Keys, document: Keys, named_at: Place) -> Keys:
    """Return the keys of one job of a document: its own, but for what the document says for all.

    Raises `InputError` if it is such a document itself, or on another machine.
    """
    if MEASUREMENTS in own.entries:
        raise InputError.at(named_at, "this job is a document of several itself; name its jobs here")
    serials = [
        node.text
        for each in (own, document)
        if isinstance(node := find_at(each, ("machine", "serial")), Scalar) and not node.is_nothing
    ]
    if len(serials) > 1 and not is_same_serial(*serials):
        raise InputError.at(
            named_at,
            f"this job is on machine {quoted(serials[0])}, and the document on {quoted(serials[1])}: it is "
            "made of measurements of one machine",
        )
    none = KeyEntry("certificate", document.place, make_keys_of(document.place))
    certificate = document.entries.get("certificate", none)
    shared = [document.entries[key] for key in _SHARED if key in document.entries]
    group = certificate.value
    if isinstance(group, Keys):
        of_all = group.entries
        group = make_keys_of(group.place, tuple(of_all[key] for key in _OF_CERTIFICATE if key in of_all))
    shared.append(KeyEntry("certificate", certificate.place, group))
    return merge(own.without("certificate"), make_keys_of(own.place, tuple(shared)))


def make_document_of(first: Keys, document: Keys) -> Keys:
    """Return the keys of a document of several jobs, with what a job must have from its first."""
    return merge(first, document.without("extends"))


def name_measurements_of(axes: Iterable[tuple[Axis, Path]]) -> tuple[str, ...]:
    """Return what the measurements of a document are called: by their errors' symbols, or their files."""
    found: list[str] = []
    for axis, path in axes:
        name = axis.symbol or _NOT_IN_NAMES.sub("-", path.stem).strip("-") or "measurement"
        count, unique = 1, name
        while unique in found:
            count += 1
            unique = f"{name}-{count}"
        found.append(unique)
    return tuple(found)
