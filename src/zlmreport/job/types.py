"""Types of values in a job file: for the job's own keys, and for those of plugins.

What is written without quotes and reads as a number comes as a number where a key takes one, and as it is
spelt where a key takes text: so ``serial: 00123`` stays what it is.
"""

from __future__ import annotations

import datetime as dt
import re
from pathlib import Path
from typing import Annotated, Any

from pydantic import AfterValidator, BaseModel, BeforeValidator, ConfigDict, Field, StringConstraints

from zlmreport.errors import quoted
from zlmreport.job.references import LocatedText, path_named

_LONGEST_LINE = 500
_LONGEST_TEXT = 5000
_EARLIEST_YEAR = 1900

_FILE_STEM = re.compile(r"[A-Za-z0-9][A-Za-z0-9._-]{0,99}")
#: Devices, whatever follows behind a point.
_OF_WINDOWS = re.compile(r"con|prn|aux|nul|(com|lpt)[0-9]", re.IGNORECASE)
_ISO_DATE = re.compile(r"\d{4}-\d{2}-\d{2}", re.ASCII)
_GERMAN_DATE = re.compile(r"(\d{1,2})\.(\d{1,2})\.(\d{4})", re.ASCII)
_NUMBER = re.compile(r"[-+]?(\d+([.,]\d*)?|[.,]\d+)([eE][-+]?\d+)?", re.ASCII)
#: 0.6 + 0.3*L: micrometres, and micrometres for each metre.
_ALONG_THE_LENGTH = re.compile(
    r"(?P<constant>\d+(?:\.\d+)?)\s*(?:µm|um)?\s*\+\s*(?P<per_metre>\d+(?:\.\d+)?)\s*"
    r"(?:(?:µm|um)/m)?\s*[*·×]?\s*L(?:\s*/\s*m)?",
    re.ASCII,
)
#: What only a formula has: an L by itself beside a number or a sign.
_FORMULA = re.compile(r"[\d*·×/+]\s*L\b|\bL\s*[*·×/+]")


def with_decimal_point(text: str) -> str | None:
    """Return a number that is written with a decimal comma as it should be written.

    >>> with_decimal_point("0,5"), with_decimal_point("0.5"), with_decimal_point("a, b")
    ('0.5', None, None)
    """
    return text.replace(",", ".") if "," in text and _NUMBER.fullmatch(text) else None


def _one_line(text: str) -> str:
    for character, name in (("\n", "a line break"), ("\t", "a tab")):
        if character in text:
            raise ValueError(f"there is {name} in a text of one line; write a space instead")
    return text


def _without_tabs(text: str) -> str:
    if "\t" in text:
        raise ValueError("there is a tab in the text; write a space instead")
    return text


def _in_words(text: str) -> str:
    if _NUMBER.fullmatch(text):
        raise ValueError(
            f"{quoted(text)} is not a number with a decimal point; write {text.replace(',', '.')}"
        )
    return text


def along_the_length(text: str) -> tuple[float, float] | None:
    """Return the constant part and the part per metre of an uncertainty; None for words.

    >>> along_the_length("0.6 + 0.3*L"), along_the_length("see its certificate")
    ((0.6, 0.3), None)
    """
    found = _ALONG_THE_LENGTH.fullmatch(text)
    return (float(found["constant"]), float(found["per_metre"])) if found else None


def _instrument_uncertainty(text: str) -> str:
    """Take words, and formulas that are understood; refuse what looks like a formula and is none."""
    if along_the_length(text) is None and (_FORMULA.search(text) or text[:1].isdigit()):
        raise ValueError(
            f"{quoted(text)} is not understood; write a number of micrometres, or a constant part and one "
            "that grows with the length in metres: 0.6 + 0.3*L"
        )
    return text


def file_stem(text: str) -> str:
    """Refuse a text that cannot be the stem of a file's name on every system."""
    if not _FILE_STEM.fullmatch(text):
        raise ValueError(
            f"{quoted(text)} cannot name files: a number has letters A to Z, digits, '.', '_' and '-', and "
            "begins with a letter or digit, such as CAL-2026-0117"
        )
    if _OF_WINDOWS.fullmatch(text.partition(".")[0]) or text.endswith("."):
        better = f"CAL-{text.rstrip('.')}"
        raise ValueError(f"{quoted(text)} cannot name files on Windows; write more before it: {better}")
    return text


def _date(value: Any) -> Any:
    """Take a date only as ISO 8601 writes it: other spellings mean different days in different countries."""
    if isinstance(value, dt.date):
        return value
    text = str(value)
    if _ISO_DATE.fullmatch(text):
        try:
            date = dt.date.fromisoformat(text)
        except ValueError:
            raise ValueError(f"there is no day {text} in the calendar") from None
        if date.year < _EARLIEST_YEAR:
            raise ValueError(f"{text} lies before the year {_EARLIEST_YEAR}")
        return date
    german = _GERMAN_DATE.fullmatch(text)
    if german:
        day, month, year = german.groups()
        raise ValueError(f"{text!r} is not a date as it is written here; write {year}-{month:0>2}-{day:0>2}")
    raise ValueError(f"{quoted(text)} is not a date; write year-month-day, such as 2026-11-20")


#: A line of text as it is printed; long enough for any name, short enough for a page.
Text = Annotated[
    str,
    StringConstraints(min_length=1, max_length=_LONGEST_LINE, strip_whitespace=True),
    AfterValidator(_one_line),
]
#: Text of several lines.
Lines = Annotated[
    str,
    StringConstraints(min_length=1, max_length=_LONGEST_TEXT, strip_whitespace=True),
    AfterValidator(_without_tabs),
]
#: Text in a key that takes a number too: what looks like a number must be one.
InWords = Annotated[Text, AfterValidator(_in_words)]
#: The uncertainty of an instrument that is no single number.
InstrumentUncertainty = Annotated[InWords, AfterValidator(_instrument_uncertainty)]
#: A number above 0.
Positive = Annotated[float, Field(gt=0, allow_inf_nan=False)]
#: A number from 0.
NotNegative = Annotated[float, Field(ge=0, allow_inf_nan=False)]
#: A number that is neither infinite nor "not a number".
Finite = Annotated[float, Field(allow_inf_nan=False)]
#: A date as jobs write it: 2026-11-20.
Date = Annotated[dt.date, BeforeValidator(_date)]


class JobPart(BaseModel):
    """A part of a job: frozen, and closed to keys that it does not know."""

    model_config = ConfigDict(defer_build=True, extra="forbid", frozen=True)


class Options(BaseModel):
    """The base of every plugin's own job keys.

    A plugin subclasses it and declares one field a key, with a type, a default if it has one, and a
    `description`. Unknown keys are refused, and every mistake is reported with the line and column in
    the job file; ``zlmreport schema`` shows the keys to editors.
    """

    model_config = ConfigDict(defer_build=True, extra="forbid", frozen=True, arbitrary_types_allowed=True)


def _beside_the_naming_file(value: Any) -> Any:
    """Resolve a relative path against the folder of the file that names it."""
    if not value:
        raise ValueError("the name of a file is expected")
    if isinstance(value, LocatedText):
        return path_named(str(value), Path(value.place.file))
    return value


#: A path in a job file: relative to the file that names it, which may be one that the job extends.
JobPath = Annotated[Path, BeforeValidator(_beside_the_naming_file)]


class LiveInstrumentKeys(BaseModel):
    """A live instrument; its own keys follow `plugin`. A data source that has one declares a key of it."""

    model_config = ConfigDict(extra="allow", frozen=True)

    plugin: Text = Field(description="Identifier of an installed live instrument.", examples=["umd1"])
