"""Writing into a job what its axis did not state: the pitch of its screw, or that no table was active."""

from __future__ import annotations

import codecs
from pathlib import Path
from typing import Literal

from zlmreport.errors import InputError
from zlmreport.job.edit import Edit, alike_elsewhere, content_of, loaded, meaning
from zlmreport.job.extents import Form, Written
from zlmreport.job.installed import Installed
from zlmreport.job.job import Job
from zlmreport.job.list_edits import UneditableError, inserted, members, with_member
from zlmreport.job.text import decoded

_GROUP = "axis"


def edit_axis(path: Path, job: Job, registry: Installed, key: str, value: float | Literal["none"]) -> Edit:
    """Return the change of a job that states something of its axis.

    Parameters
    ----------
    path, job, registry
        The job file, as it was loaded, and the installed plugins.
    key
        Of `axis`; the job must not state it yet.
    value
        A length in the job's unit of positions, mm or degrees; or that there is none.

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
    stated = value if value == "none" else f"{value:.10g}"
    remark = "" if value == "none" else f" # {unit.symbol}"
    try:
        edited = mark + _with_key(decoded(content, str(path)), f"{key}: {stated}", remark).encode()
        after = loaded(path, registry, edited)
    except UneditableError:
        after = None
    wanted = job.axis if value == "none" else job.axis.with_length(key, unit.to_si(float(stated)))
    is_alike = (
        after is not None
        and after.axis == wanted
        and meaning(after.effects) == meaning(job.effects)
        and alike_elsewhere(job, after, _GROUP, key)
    )
    if after is None or not is_alike:
        raise InputError.at(
            job.place_of(_GROUP),
            f"nothing can be added here without changing more; write by hand: {_GROUP}: {{{key}: {stated}}}",
        )
    return Edit(path, job.files[0].sha256, edited, after)


def _with_key(text: str, pair: str, remark: str) -> str:
    """Return the text with a key more in its group: in the braces, or in a line with a remark behind it."""
    written = Written.of(text)
    group = written.root.entry(_GROUP)
    if group is None:
        raise UneditableError
    axis = group[1]
    if axis.form is Form.BRACES:
        return with_member(written, axis, members(axis.parts, 2), pair)
    if axis.form is not Form.INDENTED or axis.parts[-1].form is Form.ALIAS:
        raise UneditableError
    end = written.line_end(axis.parts[-1].end)
    indent = " " * written.column(axis.parts[0].start)
    return inserted(text, end, f"{written.break_at(end)}{indent}{pair}{remark}")
