"""Writing into a job what it does not state: the pitch of its screw, the customer, parts of its U."""

from __future__ import annotations

import codecs
import re
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import yaml

from zlmreport.errors import InputError, Place
from zlmreport.job.edit import Edit, content_of
from zlmreport.job.extents import Form, Written
from zlmreport.job.installed import Installed
from zlmreport.job.job import Job
from zlmreport.job.list_edits import UneditableError, as_text, inserted, members, with_member
from zlmreport.job.loading import load
from zlmreport.job.text import decoded
from zlmreport.job.tree import Scalar

#: What means the same with and without quotes, and is written without.
_DATE = re.compile(r"\d{4}-\d\d-\d\d", re.ASCII)


def edit_keys(
    path: Path, job: Job, registry: Installed, stated: Mapping[str, float | str], units: Mapping[str, str]
) -> Edit:
    """Return the change of a job that states keys which it does not state yet; nothing else changes.

    Parameters
    ----------
    path, job, registry
        The job file, as it was loaded, and the installed plugins.
    stated
        The values by their keys, as ``customer.name``; numbers in the units of the job.
    units
        Symbols by key, for the remark beside a number that has a line of its own.

    Raises
    ------
    InputError
        If the file has changed since it was loaded, or is written in a way in which nothing can be added
        without changing more; or with what is wrong with the job as it would be.
    AccessError
        If the file cannot be read.
    """
    content = content_of(path, job)
    mark = codecs.BOM_UTF8 if content.startswith(codecs.BOM_UTF8) else b""
    before = text = decoded(content, str(path))
    for key, value in stated.items():
        names = key.split(".")
        wanted = _with(_meaning(text), names, value)
        try:
            text = _with_key(text, names, _spelt(value), units.get(key, ""))
        except UneditableError:
            text = ""
        if not text or _meaning(text) != wanted:
            raise InputError.at(
                job.place_of(key),
                f"nothing can be added here without changing more; write by hand: "
                f"{_in_braces(names, _spelt(value))}",
            )
    edited = content if text == before else mark + text.encode()
    return Edit(path, job.files[0].sha256, edited, load(path, registry, content=edited))


def _spelt(value: float | str) -> str:
    """Write a value as people would: ``10``, ``2026-11-20``, text with quotes only where it needs them."""
    if isinstance(value, str):
        return value if _DATE.fullmatch(value) else as_text(Scalar(Place(""), value, plain=False))
    return f"{value:.10g}"


def _meaning(text: str) -> Any:
    """Return what a text says, value by value."""
    return yaml.load(text, Loader=yaml.BaseLoader)  # noqa: S506 - it makes text, lists and groups of text


def _with(stated: Any, names: Sequence[str], value: float | str) -> Any:
    """Return what a text is to say: what it says, and one key more."""
    if not names:
        return value if isinstance(value, str) else f"{value:.10g}"
    group = stated if isinstance(stated, dict) else {}
    return {**group, names[0]: _with(group.get(names[0]), names[1:], value)}


def _in_braces(names: Sequence[str], spelt: str) -> str:
    """Return a pair of key and value, the value of a key within others in their braces."""
    *outer, last = names
    pair = f"{last}: {spelt}"
    for name in reversed(outer):
        pair = f"{name}: {{{pair}}}"
    return pair


def _with_key(text: str, names: Sequence[str], spelt: str, unit: str) -> str:
    """Return the text with a key more in the innermost of its groups that there is."""
    written = Written.of(text)
    group, rest = written.root, list(names)
    while len(rest) > 1 and (entry := group.entry(rest[0])) is not None:
        group = entry[1]
        rest.pop(0)
    if group.entry(rest[0]) is not None:
        raise UneditableError
    pair = _in_braces(rest, spelt)
    if group.form is Form.BRACES:
        return with_member(written, group, members(group.parts, 2), pair)
    if group.form is not Form.INDENTED or group.parts[-1].form is Form.ALIAS:
        raise UneditableError
    end = written.line_end(group.parts[-1].end)
    indent = " " * written.column(group.parts[0].start)
    remark = f" # {unit}" if unit and len(rest) == 1 else ""
    return inserted(text, end, f"{written.break_at(end)}{indent}{pair}{remark}")
