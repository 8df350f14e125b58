"""What YAML would take for something else stays what the user wrote."""

from __future__ import annotations

import datetime as dt
from pathlib import Path
from typing import Any, Literal

import pytest
from pydantic import Field

from job.jobs import loaded, mistakes, with_line, with_lines
from zlmreport.job.contradictions import validate
from zlmreport.job.parse import parse
from zlmreport.job.types import InWords
from zlmreport.plugin import Finite, JobPath, Options, Place, Problem

TEXTS = [
    "00123",
    "0x1F",
    "1e3",
    "1_000",
    "12:30",
    "2026-11-20",
    "2026-11-20T10:00:00Z",
    "no",
    "Yes",
    "off",
    "true",
    "1.10",
    ".5",
    "+49",
    "-0",
    "NULL",
    "0o17",
    ".inf",
    "=",
    "1" * 400,
]


@pytest.mark.parametrize("text", TEXTS)
def test_text_keeps_its_spelling(text: str, tmp_path: Path) -> None:
    assert loaded(with_line(6, f"machine: {{serial: {text}}}"), tmp_path).keys.machine.serial == text


@pytest.mark.parametrize("text", ["2026-11-20", "00123", "1e3", "no", "1.10"])
def test_number_of_the_certificate_keeps_its_spelling(text: str, tmp_path: Path) -> None:
    assert loaded(with_line(3, f"  number: {text}"), tmp_path).keys.certificate.number == text


@pytest.mark.parametrize("name", ["Y", "N", "y", "NO", "on", "1"])
def test_axis_may_have_any_name(name: str, tmp_path: Path) -> None:
    assert loaded(with_line(7, f"axis: {{name: {name}}}"), tmp_path).axis.name == name


@pytest.mark.parametrize(
    ("written", "value"),
    [
        ("10", 10),
        ("010", 10),
        ("1e3", 1000),
        ("1.5E-1", 0.15),
        (".5", 0.5),
        ("5.", 5),
        ("+2", 2),
        ("'10'", 10),
    ],
)
def test_number_is_decimal_however_it_is_written(written: str, value: float, tmp_path: Path) -> None:
    text = with_lines(f"instrument: {{name: I, expanded_uncertainty: {written}}}")
    instrument = loaded(text, tmp_path).keys.instrument
    assert instrument is not None
    assert instrument.expanded_uncertainty == value


@pytest.mark.parametrize(("written", "value"), [("yes", True), ("no", False), ("true", True), ("Off", False)])
def test_truth_is_read_where_truth_is_asked_for(written: str, value: bool, tmp_path: Path) -> None:
    keys = loaded(with_line(5, f"  readings_on_graphs: {written}"), tmp_path).keys
    assert keys.certificate.readings_on_graphs is value


def test_condition_is_a_number_or_words(tmp_path: Path) -> None:
    text = with_lines("environment: {air_temperature: 20.5, axis_temperature: 20.1 to 20.7}")
    environment = loaded(text, tmp_path).keys.environment
    assert environment is not None
    assert environment.air_temperature == 20.5
    assert environment.axis_temperature == "20.1 to 20.7"


@pytest.mark.parametrize(
    "text", ["מעבדת כיול", "مختبر المعايرة", "Лаборатория", "校正", "Prüf-Labor №1 ½ µm ″", "🧪"]
)
def test_text_of_every_script_is_taken(text: str, tmp_path: Path) -> None:
    customer = loaded(with_lines(f"customer: {{name: {text}}}"), tmp_path).keys.customer
    assert customer is not None
    assert customer.name == text


def test_markup_is_text(tmp_path: Path) -> None:
    customer = loaded(with_lines("customer: {name: '<b>&amp;{{7*7}}</b>'}"), tmp_path).keys.customer
    assert customer is not None
    assert customer.name == "<b>&amp;{{7*7}}</b>"


def test_address_keeps_its_lines_and_a_name_loses_its_last_line_break(tmp_path: Path) -> None:
    text = with_lines("customer:", "  name: |", "    Ours", "  address: |", "    Street 1", "    Town")
    customer = loaded(text, tmp_path).keys.customer
    assert customer is not None
    assert customer.name == "Ours"
    assert customer.address == "Street 1\nTown"


@pytest.mark.parametrize("nothing", ["", "~", "null"])
def test_group_of_which_only_the_key_is_left_is_an_empty_group(nothing: str, tmp_path: Path) -> None:
    assert loaded(with_line(6, f"machine: {nothing}"), tmp_path).keys.machine.serial is None


def test_empty_group_that_must_have_keys_names_them(tmp_path: Path) -> None:
    assert mistakes(with_line(7, "axis:"), tmp_path) == [
        "job.yaml:7:1: axis.name is missing: as on the machine; for example X"
    ]


class Keys(Options):
    """Keys as plugins may have them."""

    file: JobPath | None = None
    label: str = ""
    times: Literal[1, 2] = 1
    count: int = 0
    flags: dict[str, bool] = Field(default_factory=dict)
    rows: list[dict[str, Finite]] = Field(default_factory=list)
    value: Finite | InWords | None = None
    anything: Any = None


def _options(text: str) -> tuple[Keys | None, list[Problem]]:
    problems: list[Problem] = []
    options = validate(Keys, parse(text.encode(), "jobs/job.yaml"), problems, within="source")
    return options, problems


@pytest.mark.parametrize(
    ("text", "key", "value"),
    [
        ("file: 2026", "file", Path("jobs/2026")),
        ("file: data/x.csv", "file", Path("jobs/data/x.csv")),
        ("file: /data/x.csv", "file", Path("/data/x.csv")),
        ("label: 1e3", "label", "1e3"),
        ("times: 2", "times", 2),
        ("count: 010", "count", 10),
        ("flags: {a: no}", "flags", {"a": False}),
        ("rows: [{1: 2}]", "rows", [{"1": 2.0}]),
        ("value: 3", "value", 3.0),
        ("value: about 3", "value", "about 3"),
        ("anything: 3", "anything", 3),
        ("anything: a", "anything", "a"),
    ],
)
def test_plugins_keys_of_every_type_are_read(text: str, key: str, value: object) -> None:
    options, problems = _options(text)
    assert problems == []
    assert getattr(options, key) == value


class Bounded(Options):
    """Keys with bounds of every kind."""

    over: float = Field(1, gt=0.5)
    least: float = Field(1, ge=0.5)
    under: float = Field(1, lt=1.5)
    most: float = Field(1, le=1e6)
    steps: int = Field(0, multiple_of=5)
    code: str = Field("A1", pattern="^[A-Z][0-9]$", examples=["B2"])
    short: str = Field("", max_length=1)
    names: set[str] = Field(default_factory=set)
    pair: tuple[int, int] = (0, 0)
    when: dt.datetime | None = Field(None, description="Time of the start.")
    day: dt.date | None = None
    until: dt.date = Field(dt.date(2020, 1, 1), lt=dt.date(2021, 1, 1))
    parts: dict[str, int] = Field(default_factory=dict)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("over: 0.5", "source.over: '0.5' is not a number greater than 0.5"),
        ("least: 0", "source.least: '0' is not a number of at least 0.5"),
        ("under: 2", "source.under: '2' is not a number less than 1.5"),
        ("most: 1e7", "source.most: '1e7' is not a number of at most 1e+06"),
        ("steps: 7", "source.steps: '7' is not a multiple of 5"),
        ("steps: 7.5", "source.steps: '7.5' is not a whole number"),
        ("code: x", "source.code: 'x' is not text of the form ^[A-Z][0-9]$; for example B2"),
        ("short: ab", "source.short: 'ab' is not text of at most 1 character"),
        ("names: a", "source.names: 'a' is not a list"),
        ("pair: a", "source.pair: 'a' is not a list"),
        ("pair: [1, 2, 3]", "source.pair: a list of 3 values is not a list of at most 2 values"),
        ("when: soon", "source.when: 'soon' is not what is expected: time of the start"),
        ("day: soon", "source.day: 'soon' is not a date such as 2026-11-20"),
        ("until: 2022-01-01", "source.until: '2022-01-01' is not less than 2021-01-01"),
        ("parts: [a]", "source.parts: a list of 1 value is not a group of keys"),
        ("over:", "source.over has no value; a number is expected"),
    ],
)
def test_every_bound_is_told(text: str, message: str) -> None:
    problems: list[Problem] = []
    validate(Bounded, parse(text.encode(), "job.yaml"), problems, within="source")
    assert [problem.message for problem in problems] == [message]


@pytest.mark.parametrize(
    ("text", "place", "message"),
    [
        ("times: 3", (1, 8), "source.times: '3' is unknown; known: 1, 2"),
        ("count: 1.5", (1, 8), "source.count: '1.5' is not a whole number"),
        ("flags: {a: 2}", (1, 12), "source.flags.a: '2' is not true or false"),
        ("rows: [{a: 1}, {b: c}]", (1, 20), "source.rows.b: 'c' is not a number"),
        ("value: [1, 2]", (1, 1), "source.value: a list of 2 values is not a number or text"),
        ("value: '3,5'", (1, 8), "source.value: '3,5' is not a number with a decimal point; write 3.5"),
    ],
)
def test_plugins_keys_are_refused_in_words(text: str, place: tuple[int, int], message: str) -> None:
    _, problems = _options(text)
    assert problems == [Problem(Place("jobs/job.yaml", *place), message)]
