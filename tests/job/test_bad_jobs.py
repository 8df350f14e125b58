"""Every wrong job is refused at the line and column of its mistake, with what would be right."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest

from job.jobs import SOUND, mistakes, with_line, with_lines
from offers import offering
from testing.exemplary import ExemplaryRenderer, ExemplarySource, ExemplaryStandard
from zlmreport.job.loading import load
from zlmreport.plugin import InputError
from zlmreport.plugin.registry import Plugin, collect

# Line of the sound job that is replaced, the line it is replaced by, where the message points, what it says.
WRONG_VALUES = {
    "another version of the format": (
        1,
        "schema: zlmreport/job/2",
        "1:9",
        "schema: 'zlmreport/job/2' is unknown; did you mean 'zlmreport/job/1'?",
    ),
    "key misspelt": (
        3,
        "  nmber: CAL-1",
        "3:3",
        "unknown key 'nmber' in certificate; did you mean 'number'?",
    ),
    "key of the top level misspelt": (
        6,
        "machin: {}",
        "6:1",
        "unknown key 'machin'; did you mean 'machine'?",
    ),
    "number that cannot name a file": (3, "  number: CAL/1", "3:11", "'CAL/1' cannot name files"),
    "number too long": (3, f"  number: {'C' * 101}", "3:11", "has up to 100 letters"),
    "number that leaves the folder": (3, "  number: ../CAL", "3:11", "'../CAL' cannot name files"),
    "number that is hidden": (3, "  number: .CAL", "3:11", "'.CAL' cannot name files"),
    "number that is a list": (3, "  number: [1]", "3:3", "certificate.number: a list of 1 value is not text"),
    "number without value": (3, "  number:", "3:3", "certificate.number has no value; text is expected"),
    "number of blanks": (3, "  number: '  '", "3:11", "is not text of at least 1 character"),
    "unknown kind": (4, "  kind: certificat", "4:9", "did you mean 'certificate'?"),
    "Norwegian": (5, "  language: no", "5:13", "certificate.language: 'no' is unknown; known: de, en"),
    "capital language": (5, "  language: DE", "5:13", "did you mean 'de'?"),
    "text for a group": (
        6,
        "machine: lathe",
        "6:10",
        "machine: 'lathe' is not a group of keys; its keys are manufacturer",
    ),
    "group for a text": (
        6,
        "machine: {serial: {a: 1}}",
        "6:11",
        "machine.serial: a group of keys is not text",
    ),
    "list for a group": (7, "axis: [X]", "7:1", "axis: a list of 1 value is not a group of keys"),
    "kind of axis": (
        7,
        "axis: {name: X, kind: rotatory}",
        "7:23",
        "axis.kind: 'rotatory' is unknown; did you mean 'rotary'?",
    ),
    "half a travel": (
        7,
        "axis: {name: X, travel: [0]}",
        "7:17",
        "axis.travel: a value is missing in the list; for example [0, 1000]",
    ),
    "three ends of a travel": (
        7,
        "axis: {name: X, travel: [0, 1, 2]}",
        "7:17",
        "axis.travel: a list of 3 values is not a list of at most 2 values",
    ),
    "travel backwards": (
        7,
        "axis: {name: X, travel: [9, 1]}",
        "7:17",
        "the first position of the travel must be less",
    ),
    "travel of no length": (
        7,
        "axis: {name: X, travel: [9, 9]}",
        "7:17",
        "the first position of the travel must be less",
    ),
    "negative pitch": (
        7,
        "axis: {name: X, screw_pitch: -10}",
        "7:30",
        "'-10' is not a number greater than 0; for example 10",
    ),
    "infinite pitch": (7, "axis: {name: X, screw_pitch: .inf}", "7:30", "'.inf' is not a finite number"),
    "overflowing pitch": (7, "axis: {name: X, screw_pitch: 1e999}", "7:30", "'1e999' is not a finite number"),
    "no number as pitch": (7, "axis: {name: X, screw_pitch: .nan}", "7:30", "'.nan' is not a"),
    "decimal comma that parts keys": (
        7,
        "axis: {name: X, screw_pitch: 12,5}",
        "7:33",
        "axis: a comma parts keys, and 5 is none; write a decimal point",
    ),
    "decimal comma": (7, "axis: {name: X, screw_pitch: '0,5'}", "7:30", "write a decimal point: 0.5"),
    "number with unit": (
        7,
        "axis: {name: X, screw_pitch: 10 mm}",
        "7:30",
        "write the number without its unit: 10",
    ),
    "hexadecimal": (7, "axis: {name: X, screw_pitch: 0x10}", "7:30", "'0x10' is not a number"),
    "time for a number": (7, "axis: {name: X, screw_pitch: 12:30}", "7:30", "'12:30' is not a number"),
    "truth for a number": (7, "axis: {name: X, screw_pitch: true}", "7:30", "'true' is not a number"),
    "list for a number": (
        7,
        "axis: {name: X, screw_pitch: [1]}",
        "7:17",
        "axis.screw_pitch: a list of 1 value is not a number",
    ),
    "German date": (
        9,
        "  date: 18.11.2026",
        "9:9",
        "'18.11.2026' is not a date as it is written here; write 2026-11-18",
    ),
    "American date": (9, "  date: 11/18/2026", "9:9", "write year-month-day, such as 2026-11-20"),
    "date as a number": (9, "  date: 20261118", "9:9", "'20261118' is not a date"),
    "date that does not exist": (
        9,
        "  date: 2026-02-30",
        "9:9",
        "there is no day 2026-02-30 in the calendar",
    ),
    "date before all machines": (9, "  date: 0206-11-18", "9:9", "lies before the year 1900"),
    "date with time": (9, "  date: 2026-11-18T10:00:00", "9:9", "is not a date"),
    "source without plugin": (11, "    plugin:", "11:5", "measurement.source.plugin has no value"),
    "source misspelt": (
        11,
        "    plugin: exemplary-txt",
        "11:13",
        "no plugin provides data source 'exemplary-txt'; did you mean 'exemplary-text'?",
    ),
    "source's key misspelt": (
        12,
        "    fil: six.txt",
        "12:5",
        "unknown key 'fil' in measurement.source; did you mean 'file'? (known: file, plugin)",
    ),
    "source's file empty": (
        12,
        "    file: ''",
        "12:11",
        "measurement.source.file: the name of a file is expected",
    ),
    "source's file a list": (
        12,
        "    file: [a, b]",
        "12:5",
        "measurement.source.file: a list of 2 values is not the name of a file",
    ),
    "bare standard misspelt": (
        14,
        "  - exemplary:2",
        "14:5",
        "no plugin provides standard 'exemplary:2'; did you mean 'exemplary:1'?",
    ),
    "number for a standard": (14, "  - 230", "14:5", "no plugin provides standard '230'"),
    "list for a standard": (
        14,
        "  - [exemplary:1]",
        "14:5",
        "evaluate: a list of 1 value is not a group of keys",
    ),
    "standard without name": (14, "  - {tolerances: {E: 1}}", "14:5", "evaluate.standard is missing"),
    "standard's key misspelt": (
        14,
        "  - {standard: 'exemplary:1', facto: 3}",
        "14:31",
        "unknown key 'facto' in evaluate; did you mean 'factor'?",
    ),
    "standard's key out of bounds": (
        14,
        "  - {standard: 'exemplary:1', factor: 0}",
        "14:39",
        "evaluate.factor: '0' is not a number greater than 0",
    ),
    "tolerance of an unknown parameter": (
        14,
        "  - {standard: 'exemplary:1', tolerances: {A: 1}}",
        "14:44",
        "'A' is no parameter of exemplary:1; known: E, R",
    ),
    "tolerance of zero": (
        14,
        "  - {standard: 'exemplary:1', tolerances: {E: 0}}",
        "14:47",
        "evaluate.tolerances.E: '0' is not a number greater than 0",
    ),
    "tolerance with a decimal comma": (
        14,
        "  - {standard: 'exemplary:1', tolerances: {E: 12,5}}",
        "14:50",
        "a comma parts keys; write a decimal point: E: 12.5",
    ),
    "quoted tolerance with a decimal comma": (
        14,
        "  - {standard: 'exemplary:1', tolerances: {E: '12,5'}}",
        "14:47",
        "'12,5' is not a number; write a decimal point: 12.5",
    ),
    "tolerance in words": (
        14,
        "  - {standard: 'exemplary:1', tolerances: {E: tight}}",
        "14:47",
        "'tight' is not a number",
    ),
    "tolerance with unit": (
        14,
        "  - {standard: 'exemplary:1', tolerances: {E: 20 µm}}",
        "14:47",
        "write the number without its unit: 20",
    ),
    "standard twice": (
        14,
        "  - exemplary:1\n  - exemplary:1",
        "15:5",
        "exemplary:1 stands in line 14 already",
    ),
    "no standards": (14, "  []", "13:1", "evaluate: a list of 0 values is not a list of at least 1 value"),
    "format misspelt": (
        15,
        "output: {formats: [exemplar]}",
        "15:20",
        "no plugin provides format 'exemplar'; did you mean 'exemplary'?",
    ),
    "format that is no list": (
        15,
        "output: {formats: exemplary}",
        "15:19",
        "output.formats: 'exemplary' is not a list; for example [pdf, json]",
    ),
    "no format": (
        15,
        "output: {formats: []}",
        "15:10",
        "output.formats: a list of 0 values is not a list of at least 1 value",
    ),
}


@pytest.mark.parametrize(("line", "replacement", "place", "core"), WRONG_VALUES.values(), ids=WRONG_VALUES)
def test_wrong_value_is_refused_where_it_stands(
    line: int, replacement: str, place: str, core: str, tmp_path: Path
) -> None:
    found = mistakes(with_line(line, replacement), tmp_path)
    assert [message for message in found if message.startswith(f"job.yaml:{place}: ") and core in message], (
        found
    )


# Lines after the sound job's last, where the message points, what it says.
WRONG_ADDITIONS = {
    "bar for hectopascal": (
        "environment: {air_pressure: 1.013}",
        "16:29",
        "1.013 hPa is not between 300 and 1200 hPa",
    ),
    "kelvin for degrees": (
        "environment: {air_temperature: 293.15}",
        "16:32",
        "293.15 K would be 20 °C",
    ),
    "more than saturated": (
        "environment: {relative_humidity: 140}",
        "16:34",
        "140 % is not between 0 and 100 %",
    ),
    "key twice": ("machine: {}", "16:1", "'machine' stands in line 6 already"),
    "extends a number of nothing": ("extends: [a, [b]]", "16:14", "extends names a file, or a list of files"),
    "extends a group": ("extends: {a: b}", "16:10", "extends names a file, or a list of files"),
    "unknown decision rule": ("decision_rule: guardband", "16:16", "did you mean 'guard-band'?"),
    "line break in a name": (
        'customer: {name: "A\\nB"}',
        "16:18",
        "customer.name: there is a line break in a text",
    ),
    "tab in a name": ('customer: {name: "A\\tB"}', "16:18", "customer.name: there is a tab in a text"),
    "tab in an address": ('customer: {name: A, address: "A\\tB"}', "16:30", "there is a tab in the text"),
    "uncertainty below zero": (
        "instrument: {name: I, expanded_uncertainty: -1}",
        "16:45",
        "'-1' is not a number greater than 0 or text",
    ),
    "uncertainty with comma": ("instrument: {name: I, expanded_uncertainty: '0,3'}", "16:45", "write 0.3"),
    "effect that is a list": (
        "model: {effects: [[a]]}",
        "16:19",
        "model.effects: a list of 1 value is not text or a group of keys",
    ),
    "effect's parameters in words": (
        "model: {effects: [{a: b}]}",
        "16:23",
        "model.effects.a: 'b' is not a group of keys",
    ),
    "unknown effect": (
        "model: {effects: [exemplary-wav]}",
        "16:19",
        "no plugin provides effect 'exemplary-wav'; did you mean 'exemplary-wave'?",
    ),
    "two effects in one item": (
        "model: {effects: [{exemplary-wave: {}, height: {}}]}",
        "16:19",
        "model.effects: a group of keys is no effect; an effect is its name, or {name: {parameter: value}}",
    ),
    "unknown parameter of an effect": (
        "model: {effects: [{exemplary-wave: {heigth: 3}}]}",
        "16:37",
        "unknown key 'heigth' in model.effects.exemplary-wave; did you mean 'height'? (known: height, rect",
    ),
    "parameter in words": (
        "model: {effects: [{exemplary-wave: {height: high}}]}",
        "16:45",
        "model.effects.exemplary-wave.height: 'high' is not a number",
    ),
    "infinite parameter": (
        "model: {effects: [{exemplary-wave: {height: .inf}}]}",
        "16:45",
        "model.effects.exemplary-wave.height: '.inf' is not a finite number",
    ),
    "own key of an effect": (
        "model: {effects: [{exemplary-wave: {rectified: perhaps}}]}",
        "16:48",
        "model.effects.exemplary-wave.rectified: 'perhaps' is not true or false",
    ),
    "merge key": ("<<: {}", "16:1", "'<<' is not used in a job; shared keys come from a file by 'extends'"),
    "tag": ("laboratory: !!python/object:os.system {}", "16:13", "a job uses no tags"),
    "key that is a list": ("? [a]\n: b", "16:3", "a key is a plain word"),
    "alias to nothing": ("customer: *c", "16:11", "*c names nothing that stands above it"),
    "alias to itself": ("customer: &c {name: *c}", "16:21", "*c stands inside the value that it names"),
    "second document": ("---\na: 1", "16:1", "a second document begins here"),
    "control character in quotes": (
        'customer: {name: "A\\x07"}',
        "16:18",
        "control character U+0007 in a text",
    ),
    "escape of a terminal": ('customer: {name: "\\e[31m"}', "16:18", "control character U+001B in a text"),
    "lone surrogate": ('customer: {name: "\\ud800"}', "16:18", "control character U+D800 in a text"),
    "text turned around": (
        "customer: {name: A\u202eB}",
        "16:19",
        "invisible character U+202E (right-to-left override)",
    ),
    "raw control character": ("customer: {name: A\x07B}", "16:19", "control character U+0007; remove it"),
    "line separator": ("customer: {name: A\u2028B}", "16:19", "invisible character U+2028"),
    "name of 100,000 characters": (
        f"customer: {{name: {'x' * 100_000}}}",
        "16:18",
        "(100,000 characters) is not text of at most 500 characters",
    ),
    "number of 100,000 digits": (
        f"measurement2: 1\ndecision_rule: {'1' * 100_000}",
        "16:1",
        "unknown key 'measurement2'",
    ),
}


@pytest.mark.parametrize(("addition", "place", "core"), WRONG_ADDITIONS.values(), ids=WRONG_ADDITIONS)
def test_wrong_addition_is_refused_where_it_stands(
    addition: str, place: str, core: str, tmp_path: Path
) -> None:
    found = mistakes(with_lines(addition), tmp_path)
    assert [message for message in found if message.startswith(f"job.yaml:{place}: ") and core in message], (
        found
    )


def test_sound_job_has_no_mistake(tmp_path: Path) -> None:
    assert mistakes(SOUND, tmp_path) == []


def test_everything_wrong_is_said_at_once_in_the_order_of_lines(tmp_path: Path) -> None:
    text = with_line(5, "  language: pl").replace("travel: [0, 300]", "travel: [0]")
    text = text.replace("2026-11-18", "18.11.2026").replace("six.txt", "{}").replace("{E: 20}", "{A: 20}")
    places = [message.split(": ")[0] for message in mistakes(text, tmp_path)]
    assert places == ["job.yaml:5:13", "job.yaml:7:31", "job.yaml:9:9", "job.yaml:12:5", "job.yaml:14:44"]


def test_duplicate_key_does_not_hide_the_next_duplicate(tmp_path: Path) -> None:
    found = mistakes(with_lines("machine: {}", "axis: {}"), tmp_path)
    assert [message.split(": ")[0] for message in found] == ["job.yaml:16:1", "job.yaml:17:1"]


def test_missing_parts_are_named_with_an_example(tmp_path: Path) -> None:
    found = mistakes("schema: zlmreport/job/1\n", tmp_path)
    assert [message.split(" is missing")[0] for message in found] == [
        "job.yaml:1:1: axis",
        "job.yaml:1:1: certificate",
        "job.yaml:1:1: evaluate",
        "job.yaml:1:1: measurement",
    ]
    assert found[0].endswith("for example {name: X, kind: linear}")


def test_issue_before_the_measurement_is_refused(tmp_path: Path) -> None:
    found = mistakes(with_line(4, "  issued: 2026-11-17"), tmp_path)
    assert found == [
        "job.yaml:4:11: certificate.issued: 2026-11-17 lies before the measurement of 2026-11-18"
    ]


def test_issue_on_the_day_of_the_measurement_is_sound(tmp_path: Path) -> None:
    assert mistakes(with_line(4, "  issued: 2026-11-18\n  kind: report"), tmp_path) == []


@pytest.mark.parametrize("key", ["number", "name", "file", "tolerances"])
def test_no_sentence_of_the_validation_library_leaks(key: str, tmp_path: Path) -> None:
    text = with_line(3, f"  {key}: {{}}")
    for message in mistakes(text, tmp_path):
        assert "input" not in message.lower()
        assert "pydantic" not in message.lower()
        assert "valid" not in message.lower()


def test_tolerance_of_a_parameter_that_takes_none_is_refused(tmp_path: Path) -> None:
    class Signed(ExemplaryStandard):
        quantities = (
            ExemplaryStandard.quantities[0],
            replace(ExemplaryStandard.quantities[1], can_be_limited=False),
        )

    offers = offering([Signed()], [ExemplarySource()], [ExemplaryRenderer()])
    path = tmp_path / "job.yaml"
    path.write_text(SOUND.replace("{E: 20}", "{R: 20}"), encoding="utf-8")
    with pytest.raises(InputError, match=r"job\.yaml:14:44: R of exemplary:1 takes no tolerance; known: E"):
        load(path, collect([(Plugin("signed"), offers)]))
