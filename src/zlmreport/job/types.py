"""Types of values in jobs: dates, texts and their lengths, numbers that name files, paths, uncertainties.

What is written without quotes and reads as a number comes as a number where a key takes one, and as it is
spelt where a key takes text: so ``serial: 00123`` stays what it is.
"""

from __future__ import annotations

import contextlib
import datetime as dt
import posixpath
import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextvars import ContextVar
from dataclasses import dataclass
from enum import Enum
from pathlib import Path
from types import UnionType
from typing import Annotated, Any, ClassVar, Literal, Self, Union, get_args, get_origin

from pydantic import AfterValidator, BaseModel, BeforeValidator, ConfigDict, Field, StringConstraints
from pydantic.fields import FieldInfo

from zlmreport.errors import Place, quoted
from zlmreport.files import say_outside
from zlmreport.job.tree import Step
from zlmreport.measurement.measurement_set import CONDITIONS, ConditionKind

_ENCLOSURE: ContextVar[Enclosure | None] = ContextVar("enclosure", default=None)

_LONGEST_LINE = 500
_LONGEST_TEXT = 5000
_EARLIEST_YEAR = 1900

_LONGEST_STEM = 100
_FILE_STEM = re.compile(rf"[A-Za-z0-9][A-Za-z0-9._-]{{0,{_LONGEST_STEM - 1}}}")
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


@dataclass(frozen=True, slots=True)
class Enclosure:
    """The only files that jobs can name: those that came with a document."""

    #: Where each lies, by its path from the folder of the job as it was, ``../laboratory.yaml``, or from the
    #: root.
    files: Mapping[str, Path]
    nowhere: Path  #: A folder that is not there: where every other reference leads.

    def find_path(self, file: Path) -> str | None:
        """Return the path of one of the files from the job's folder."""
        return next((path for path, where in self.files.items() if where == file), None)

    def find_path_named(self, reference: str, naming_file: Path) -> Path:
        """Return the file that a reference means; one that leads past the folder's files leads nowhere.

        A reference to a file whose path is not known is answered by the file's name, if only one has it.
        """
        folder = posixpath.dirname(self.find_path(naming_file) or "")
        found = self.files.get(posixpath.normpath(posixpath.join(folder, reference)))
        if found:
            return found
        name = posixpath.basename(reference)
        alike = [path for path in self.files.values() if path.name == name]
        return alike[0] if len(alike) == 1 else self.nowhere / name


def resolve_path_named(reference: str, naming_file: Path) -> Path:
    """Return the path that a file names: relative to its own folder, or from the root.

    Raises `ValueError` if it lies outside of the folder to which the program is confined.
    """
    enclosure = _ENCLOSURE.get()
    path = enclosure.find_path_named(reference, naming_file) if enclosure else naming_file.parent / reference
    reason = "\0" not in reference and say_outside(path)
    if reason:
        raise ValueError(f"{quoted(reference)} must not be used: {reason}")
    return path


def find_path_from_job(file: Path, job: Path, from_root: str | None = None) -> str | None:
    """Return the path by which a job comes to a file: from its folder, or None if the file lies elsewhere.

    `from_root`: How the job names the file, if it does so from the root of the file system.
    """
    enclosure = _ENCLOSURE.get()
    if enclosure:
        return enclosure.find_path(file)
    if from_root:
        return posixpath.normpath(from_root)
    if not file.is_relative_to(job.parent):
        return None
    return posixpath.normpath(file.relative_to(job.parent).as_posix())


@contextlib.contextmanager
def enclose(enclosure: Enclosure) -> Iterator[None]:
    """Let jobs name the files of an enclosure and no others: for a job from a document that anyone sent."""
    token = _ENCLOSURE.set(enclosure)
    try:
        yield
    finally:
        _ENCLOSURE.reset(token)


class LocatedText(str):
    """A string from a job file, with its place, so that a path can be read beside the file that names it."""

    __slots__ = ("place",)
    place: Place

    def __new__(cls, text: str, place: Place) -> Self:
        """Return the text with its place."""
        located = super().__new__(cls, text)
        located.place = place
        return located


def replace_decimal_comma(text: str) -> str | None:
    """Return a number that is written with a decimal comma as it should be written.

    >>> replace_decimal_comma("0,5"), replace_decimal_comma("0.5"), replace_decimal_comma("a, b")
    ('0.5', None, None)
    """
    return text.replace(",", ".") if "," in text and _NUMBER.fullmatch(text) else None


def _take_one_line(text: str) -> str:
    for character, name in (("\n", "a line break"), ("\t", "a tab")):
        if character in text:
            raise ValueError(f"there is {name} in a text of one line; write a space instead")
    return text


def _take_without_tabs(text: str) -> str:
    if "\t" in text:
        raise ValueError("there is a tab in the text; write a space instead")
    return text


def _take_words(text: str) -> str:
    if _NUMBER.fullmatch(text):
        raise ValueError(
            f"{quoted(text)} is not a number with a decimal point; write {text.replace(',', '.')}"
        )
    return text


def parse_along_the_length(text: str) -> tuple[float, float] | None:
    """Return the constant part and the part per metre of an uncertainty; None for words.

    >>> parse_along_the_length("0.6 + 0.3*L"), parse_along_the_length("see its certificate")
    ((0.6, 0.3), None)
    """
    found = _ALONG_THE_LENGTH.fullmatch(text)
    return (float(found["constant"]), float(found["per_metre"])) if found else None


def _take_instrument_uncertainty(text: str) -> str:
    """Take words, and formulas that are understood; refuse what looks like a formula and is none."""
    if parse_along_the_length(text) is None and (_FORMULA.search(text) or text[:1].isdigit()):
        raise ValueError(
            f"{quoted(text)} is not understood; write a number of micrometres, or a constant part and one "
            "that grows with the length in metres: 0.6 + 0.3*L"
        )
    return text


def take_file_stem(text: str) -> str:
    """Refuse a text that cannot be the stem of a file's name on every system."""
    if not _FILE_STEM.fullmatch(text):
        raise ValueError(
            f"{quoted(text)} cannot name files: a number has up to {_LONGEST_STEM} letters A to Z, digits, "
            "'.', '_' and '-', and begins with a letter or digit, such as CAL-2026-0117"
        )
    if _OF_WINDOWS.fullmatch(text.partition(".")[0]) or text.endswith("."):
        better = f"CAL-{text.rstrip('.')}"
        raise ValueError(f"{quoted(text)} cannot name files on Windows; write more before it: {better}")
    return text


def _take_date(value: Any) -> Any:
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


@dataclass(frozen=True, slots=True)
class _Free:
    """Marks text that whoever writes a job is free to choose, and that is printed as it stands."""


_FREE = _Free()
#: What no text may hold: control characters, and overrides of the writing direction.
_UNSEEN = r"\u0000-\u0008\u000b\u000c\u000e-\u001f\u007f-\u009f\u2028\u2029\u202a-\u202e\u2066-\u2069"
#: What the schema says of a line, and of several: something that is seen, and no tab.
LINE_FORM = rf"^(?!.*[{_UNSEEN}])\s*\S([^\t\r\n]*\S)?\s*$"
LINES_FORM = rf"^(?![\s\S]*[{_UNSEEN}])\s*\S([^\t]*\S)?\s*$"
_Line = Annotated[
    str,
    StringConstraints(min_length=1, max_length=_LONGEST_LINE, strip_whitespace=True),
    AfterValidator(_take_one_line),
    Field(json_schema_extra={"pattern": LINE_FORM}),
]
#: A line of text as it is printed; long enough for any name, short enough for a page.
Text = Annotated[_Line, _FREE]
#: Text of several lines.
Lines = Annotated[
    str,
    StringConstraints(min_length=1, max_length=_LONGEST_TEXT, strip_whitespace=True),
    AfterValidator(_take_without_tabs),
    Field(json_schema_extra={"pattern": LINES_FORM}),
    _FREE,
]
#: Text in a key that takes a number too: what looks like a number must be one.
InWords = Annotated[_Line, AfterValidator(_take_words)]
#: The uncertainty of an instrument that is no single number.
InstrumentUncertainty = Annotated[InWords, AfterValidator(_take_instrument_uncertainty)]
#: No axis is longer, no room hotter, no test slower; and every square of such numbers is one.
_LARGEST = 1e9
#: Nothing that is there is shorter or briefer; and no quotient of such numbers is too large.
_SMALLEST = 1e-12


def _take_not_too_small(value: float) -> float:
    if value < _SMALLEST:
        raise ValueError(f"{value:g} is smaller than anything that is there; {_SMALLEST:g} is the least")
    return value


#: A number above 0.
Positive = Annotated[
    float,
    Field(gt=0, le=_LARGEST, allow_inf_nan=False, json_schema_extra={"minimum": _SMALLEST}),
    AfterValidator(_take_not_too_small),
]
#: A number from 0.
NotNegative = Annotated[float, Field(ge=0, le=_LARGEST, allow_inf_nan=False)]
#: A number of a size that things have.
Finite = Annotated[float, Field(ge=-_LARGEST, le=_LARGEST, allow_inf_nan=False)]
_TEMPERATURE, _PRESSURE = CONDITIONS["air_temperature"], CONDITIONS["air_pressure"]
_HUMIDITY = CONDITIONS["relative_humidity"]


def _describe_condition(kind: ConditionKind) -> tuple[Any, AfterValidator]:
    """Return what pydantic is to know of a condition: its bounds for the schema, and who refuses beyond."""

    def take(value: float) -> float:
        if kind.lowest <= value <= kind.highest:
            return value
        unit, meant = kind.unit.symbol, kind.find_likely_unit(value)
        likely = f"; {value:g} {meant[0].symbol} would be {meant[1]:g} {unit}" if meant else ""
        raise ValueError(
            f"{value:g} {unit} is not between {kind.lowest:g} and {kind.highest:g} {unit}{likely}"
        )

    return (
        Field(allow_inf_nan=False, json_schema_extra={"minimum": kind.lowest, "maximum": kind.highest}),
        AfterValidator(take),
    )


#: Conditions in which somebody measures, °C, hPa and %: beyond, they are refused where they are logged, too.
Temperature = Annotated[float, *_describe_condition(_TEMPERATURE)]
Pressure = Annotated[float, *_describe_condition(_PRESSURE)]
Humidity = Annotated[float, *_describe_condition(_HUMIDITY)]
#: A date as jobs write it: 2026-11-20.
Date = Annotated[dt.date, BeforeValidator(_take_date)]


def optional(description: str, *, example: Any = None, **settings: Any) -> Any:
    """Return a key that need not be stated; `settings`: As of pydantic's `Field`."""
    if example is not None:
        settings["examples"] = [example]
    return Field(None, description=description, **settings)


class JobPart(BaseModel):
    """A part of a job: frozen, and closed to keys that it does not know."""

    model_config = ConfigDict(defer_build=True, extra="forbid", frozen=True)


class Options(BaseModel):
    """The base of every plugin's own job keys.

    A plugin subclasses it and declares one field a key, with a type, a default if it has one, and a
    `description`. Unknown keys are refused, and every mistake is reported with the line and column in
    the job file; ``zlmreport schema`` shows the keys to editors.
    """

    #: Keys that say how the measurement was set up: a job may write them in `measurement`, or at its top, and
    #: every standard that asks for one gets it.
    of_the_measurement: ClassVar[tuple[str, ...]] = ()

    model_config = ConfigDict(defer_build=True, extra="forbid", frozen=True, arbitrary_types_allowed=True)


def _resolve_beside_naming_file(value: Any) -> Any:
    """Resolve a relative path against the folder of the file that names it."""
    if not value:
        raise ValueError("the name of a file is expected")
    if isinstance(value, LocatedText):
        return resolve_path_named(str(value), Path(value.place.file))
    return value


#: A path in a job file: relative to the file that names it, which may be one that the job extends.
JobPath = Annotated[
    Path, BeforeValidator(_resolve_beside_naming_file), Field(json_schema_extra={"minLength": 1})
]


def list_free_texts(keys: BaseModel, within: str) -> Iterator[tuple[str, str]]:
    """Yield the texts of keys that are free words, each with its key, dotted: ``customer.name``."""
    for name, field in list_keys_in(type(keys)).items():
        attribute = next(each for each, info in type(keys).model_fields.items() if info is field)
        is_free = _FREE in field.metadata or _has_free(field.annotation)
        yield from _list_free_in(getattr(keys, attribute), f"{within}{name}", is_free=is_free)


def _list_free_in(value: Any, key: str, *, is_free: bool) -> Iterator[tuple[str, str]]:
    match value:
        case BaseModel():
            yield from list_free_texts(value, f"{key}.")
        case str() if is_free and not isinstance(value, Enum):
            yield key, value
        case dict():
            for name, each in value.items():
                yield from _list_free_in(each, f"{key}.{name}", is_free=is_free)
        case list() | tuple():
            for number, each in enumerate(value):
                yield from _list_free_in(each, f"{key}.{number}", is_free=is_free)


def _has_free(annotation: Any) -> bool:
    """Whether an annotation allows free words anywhere: in a union, a list or a mapping."""
    return any(each is _FREE or _has_free(each) for each in get_args(annotation))


class LiveInstrumentKeys(BaseModel):
    """A live instrument; its own keys follow `plugin`. A data source that has one declares a key of it."""

    model_config = ConfigDict(defer_build=True, extra="allow", frozen=True)

    plugin: Text = Field(description="Identifier of an installed live instrument.", examples=["umd1"])


def list_keys_in(model: type[BaseModel]) -> dict[str, FieldInfo]:
    """Return the keys that a model knows, as they are written in a job."""
    return {info.alias or name: info for name, info in model.model_fields.items()}


def list_values(keys: object, within: str = "") -> Iterator[tuple[str, object]]:
    """Yield every single value of keys with its dotted name; items of lists by their index."""
    match keys:
        case BaseModel():
            parts: Iterable[tuple[object, object]] = keys
        case Mapping():
            parts = keys.items()
        case list() | tuple():
            parts = enumerate(keys)
        case _:
            yield within, keys
            return
    for name, each in parts:
        yield from list_values(each, f"{within}.{name}" if within else str(name))


def find_field_at(model: type[BaseModel], path: Iterable[Step]) -> FieldInfo | None:
    """Return what the model says of the last key in a path; of a list's item, what it says of the list."""
    annotation: Any = model
    found = None
    for step in path:
        part = find_model_in(annotation)
        if part and isinstance(step, str):
            found = list_keys_in(part).get(step)
            annotation = found.annotation if found else None
        else:
            annotation = _find_item_type(annotation, step)
    return found


def find_model_at(model: type[BaseModel], path: Iterable[Step]) -> type[BaseModel] | None:
    """Return the model of the group of keys at a path."""
    annotation: Any = model
    for step in path:
        part = find_model_in(annotation)
        field = list_keys_in(part).get(step) if part and isinstance(step, str) else None
        annotation = field.annotation if field else _find_item_type(annotation, step)
    return find_model_in(annotation)


def find_model_in(annotation: Any) -> type[BaseModel] | None:
    """Return the model among the alternatives of an annotation."""
    for alternative in _list_alternatives(annotation):
        if isinstance(alternative, type) and issubclass(alternative, BaseModel):
            return alternative
    return None


def find_part(annotation: Any) -> type[BaseModel] | None:
    """Return the model of a group of keys, or of each group in a list of them."""
    return find_model_in(annotation) or find_model_in(_find_item_type(annotation, 0))


def list_choices_in(annotation: Any) -> list[str]:
    """Return the values of an annotation that lists them."""
    found: list[str] = []
    for alternative in _list_alternatives(annotation):
        if isinstance(alternative, type) and issubclass(alternative, Enum):
            found.extend(str(member.value) for member in alternative)
        elif get_origin(alternative) is Literal:
            found.extend(map(str, get_args(alternative)))
    return found


def _find_item_type(annotation: Any, step: Step) -> Any:
    """Return the annotation of a list's items, or of a mapping's values."""
    for alternative in _list_alternatives(annotation):
        origin, arguments = get_origin(alternative), get_args(alternative)
        if not isinstance(origin, type) or not arguments:
            continue
        if isinstance(step, int) and issubclass(origin, Sequence):
            return arguments[0]
        if isinstance(step, str) and issubclass(origin, Mapping):
            return arguments[1]
    return None


def _list_alternatives(annotation: Any) -> Iterator[Any]:
    """Yield what an annotation stands for: `Annotated` opened, unions taken apart."""
    origin, arguments = get_origin(annotation), get_args(annotation)
    if origin is Annotated:
        yield from _list_alternatives(arguments[0])
    elif origin in {Union, UnionType}:
        for argument in arguments:
            yield from _list_alternatives(argument)
    else:
        yield annotation
