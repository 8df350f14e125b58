"""What a laboratory says and arranges its own way: its texts in the document, and the order of the sections.

A text is never evaluated: a key in braces is looked up among what the job states, and nothing else is.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from datetime import date
from typing import TYPE_CHECKING, Any

from zlmreport.document.blocks import Notice, Section
from zlmreport.errors import InputError, Problem, did_you_mean
from zlmreport.job.document_keys import OwnText
from zlmreport.language import Words

if TYPE_CHECKING:
    from zlmreport.job.job import Job

#: Above what no reading gives: nobody is to take it for a result.
_QUOTED = Words("The laboratory's own words")
_KEY = r"([a-z_]+(?:\.[a-z_]+)+)"
_PLACEHOLDER = re.compile(rf"\{{{_KEY}\}}")
#: A key in braces with blanks beside it, or without the second brace.
_MISWRITTEN = re.compile(rf"\{{\s*{_KEY}(?![a-z_.])\s*\}}?")
_NAMES = frozenset({"conditions", "definitions", "uncertainty", "readings", "origin", "opinions", "model"})
#: Sections that a calibration certificate cannot leave out: what they state, and its clause of ISO/IEC 17025.
_MANDATORY = {
    "conditions": ("what departs from the method, and the conditions", "7.8.2.1 n, 7.8.4.1 b"),
    "uncertainty": ("the measurement uncertainty and how the results are traceable", "7.8.4.1 a, c"),
    "opinions": ("that opinions are opinions, and on what they rest", "7.8.7"),
}


def fill_in(text: str, job: Job, key: str) -> str:
    """Return a text with the values of the keys that it names in braces.

    `text`: As the job states it at `key`.
    `job`: The job; its texts, numbers and dates can be named.

    Raises `InputError` if it names a key that the job does not state: every such key.
    """
    known = dict(_list_values(job.keys.model_dump(exclude_none=True)))
    problems = tuple(
        Problem(
            job.place_of(key),
            f"{{{name}}} stands for no value that this job states; {did_you_mean(name, sorted(known))}",
        )
        for name in dict.fromkeys(_PLACEHOLDER.findall(text))
        if name not in known
    )
    problems += tuple(
        Problem(job.place_of(key), f"{found[0].strip()!r} stands for no value; write {{{found[1]}}}")
        for found in _MISWRITTEN.finditer(text)
        if found[1] in known and not _PLACEHOLDER.fullmatch(found[0])
    )
    if problems:
        raise InputError(problems)
    return _PLACEHOLDER.sub(lambda found: known[found[1]], text)


def _list_values(keys: Mapping[str, Any], within: str = "") -> Iterator[tuple[str, str]]:
    for name, value in keys.items():
        match value:
            case dict():
                yield from _list_values(value, f"{within}{name}.")
            case str() | int() | float() | date():  # and no path: it tells of the laboratory's folders
                yield f"{within}{name}", str(value)


def arrange_sections(
    sections: Sequence[Section], wanted: Sequence[str | OwnText], job: Job
) -> tuple[Section, ...]:
    """Return the sections that the job wants, in its order, with its own texts among them."""
    found: list[Section] = []
    for number, each in enumerate(wanted):
        if isinstance(each, OwnText):
            key = f"certificate.sections.{number}"
            lines = fill_in(each.text, job, f"{key}.text").splitlines()
            heading = _QUOTED.in_language(job.keys.certificate.language)
            said = Notice(heading, tuple(filter(None, map(str.strip, lines))), is_quoted=True)
            found.append(Section(f"text-{number + 1}", fill_in(each.title, job, f"{key}.title"), (said,)))
        else:
            found += (section for section in sections if _name(section, job) == each)
    return tuple(found)


def _name(section: Section, job: Job) -> str:
    """Return by what name a job arranges a section."""
    name = section.key
    for of_a_part in (*job.measurements, "as-found", *job.tests):
        name = name.removeprefix(f"{of_a_part}-")
    return name if name in _NAMES else "results"


def find_left_out(wanted: Sequence[str | OwnText], job: Job) -> Iterator[Problem]:
    """Yield what a calibration certificate must state and the job's list of sections leaves out."""
    for name, (what, clause) in _MANDATORY.items():
        if name not in wanted and (name != "opinions" or job.keys.opinions):
            yield Problem(
                job.place_of("certificate.sections"),
                f"a calibration certificate must state {what} (ISO/IEC 17025:2017, {clause}): add {name} to "
                "certificate.sections, or make a measuring report by certificate.kind: report",
            )
