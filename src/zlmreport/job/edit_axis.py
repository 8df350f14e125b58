"""Writing into a job what its axis did not state: a length such as the pitch of its screw."""

from __future__ import annotations

import codecs
from pathlib import Path

from zlmreport.errors import InputError
from zlmreport.job.edit import Edit, alike_elsewhere, content_of, loaded, meaning
from zlmreport.job.extents import Form, Written
from zlmreport.job.installed import Installed
from zlmreport.job.job import Job
from zlmreport.job.list_edits import UneditableError, inserted, members, with_member
from zlmreport.job.text import decoded

_GROUP = "axis"


def edit_axis(path: Path, job: Job, registry: Installed, key: str, value: float) -> Edit:
    """Return the change of a job that states a length of its axis.

    Parameters
    ----------
    path, job, registry
        The job file, as it was loaded, and the installed plugins.
    key
        Of `axis`; the job must not state it yet.
    value
        In the job's unit of positions, mm or degrees.

    Raises
    ------
    InputError
        If the file has changed since it was loaded, or the axis is written in a way in which nothing can be
        added without changing more.
    AccessError
        If the file cannot be read.
    """
    content = content_of(path, job)
    mark = codecs.BOM_UTF8 if content.startswith(codecs.BOM_UTF8) else b""
    unit = job.axis.position_unit
    number = f"{value:.10g}"
    try:
        edited = mark + _with_length(decoded(content, str(path)), key, number, unit.symbol).encode()
        after = loaded(path, registry, edited)
    except UneditableError:
        after = None
    wanted = job.axis.with_length(key, unit.to_si(float(number)))
    is_alike = (
        after is not None
        and after.axis == wanted
        and meaning(after.effects) == meaning(job.effects)
        and alike_elsewhere(job, after, _GROUP, key)
    )
    if after is None or not is_alike:
        raise InputError.at(
            job.place_of(_GROUP),
            f"nothing can be added here without changing more; write by hand: {_GROUP}: {{{key}: {number}}}",
        )
    return Edit(path, job.files[0].sha256, edited, after)


def _with_length(text: str, key: str, number: str, unit: str) -> str:
    """Return the text with a key more in its group: in the braces, or in a line with its unit beside it."""
    written = Written.of(text)
    group = written.root.entry(_GROUP)
    if group is None:
        raise UneditableError
    axis = group[1]
    if axis.form is Form.BRACES:
        return with_member(written, axis, members(axis.parts, 2), f"{key}: {number}")
    if axis.form is not Form.INDENTED or axis.parts[-1].form is Form.ALIAS:
        raise UneditableError
    end = written.line_end(axis.parts[-1].end)
    indent = " " * written.column(axis.parts[0].start)
    return inserted(text, end, f"{written.break_at(end)}{indent}{key}: {number} # {unit}")
