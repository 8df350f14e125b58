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

# What stands in the line instead, where the message points, what it says.
WRONG_VALUES = [
    (
        "schema: zlmreport/job/2",
        "1:9",
        "schema: 'zlmreport/job/2' is unknown; did you mean 'zlmreport/job/1'?",
    ),
    ("  nmber: CAL-1", "3:3", "unknown key 'nmber' in certificate; did you mean 'number'?"),
    ("machin: {}", "6:1", "unknown key 'machin'; did you mean 'machine'?"),
    ("  number: CAL/1", "3:11", "'CAL/1' cannot name files"),
    (f"  number: {'C' * 101}", "3:11", "has up to 100 letters"),
    ("  number: ../CAL", "3:11", "'../CAL' cannot name files"),
    ("  number: .CAL", "3:11", "'.CAL' cannot name files"),
    ("  number: [1]", "3:3", "certificate.number: a list of 1 value is not text"),
    ("  number:", "3:3", "certificate.number has no value; text is expected"),
    ("  number: '  '", "3:11", "is not text of at least 1 character"),
    ("  kind: certificat", "4:9", "did you mean 'certificate'?"),
    ("  language: no", "5:13", "certificate.language: 'no' is unknown; known: de, en"),
    (
        "  sections: [results, origins]",
        "5:23",
        "did you mean 'origin'? (known: conditions, definitions, model, opinions, origin, readings, results,",
    ),
    ("  language: DE", "5:13", "did you mean 'de'?"),
    ("machine: lathe", "6:10", "machine: 'lathe' is not a group of keys; its keys are manufacturer"),
    ("machine: {serial: {a: 1}}", "6:11", "machine.serial: a group of keys is not text"),
    ("axis: [X]", "7:1", "axis: a list of 1 value is not a group of keys"),
    ("axis: {name: X, kind: rotatory}", "7:23", "axis.kind: 'rotatory' is unknown; did you mean 'rotary'?"),
    (
        "axis: {name: X, travel: [0]}",
        "7:17",
        "axis.travel: a value is missing in the list; for example [0, 1000]",
    ),
    (
        "axis: {name: X, travel: [0, 1, 2]}",
        "7:17",
        "axis.travel: a list of 3 values is not a list of at most 2 values",
    ),
    ("axis: {name: X, travel: [9, 1]}", "7:17", "the first position of the travel must be less"),
    ("axis: {name: X, travel: [9, 9]}", "7:17", "the first position of the travel must be less"),
    ("axis: {name: X, screw_pitch: -10}", "7:30", "'-10' is not a number greater than 0; for example 10"),
    ("axis: {name: X, screw_pitch: .inf}", "7:30", "'.inf' is not a finite number"),
    ("axis: {name: X, screw_pitch: 1e999}", "7:30", "'1e999' is not a finite number"),
    ("axis: {name: X, screw_pitch: .nan}", "7:30", "'.nan' is not a"),
    (
        "axis: {name: X, screw_pitch: 12,5}",
        "7:33",
        "axis: a comma parts keys, and 5 is none; write a decimal point",
    ),
    ("axis: {name: X, screw_pitch: '0,5'}", "7:30", "write a decimal point: 0.5"),
    ("axis: {name: X, screw_pitch: 10 mm}", "7:30", "write the number without its unit: 10"),
    ("axis: {name: X, screw_pitch: 0x10}", "7:30", "'0x10' is not a number"),
    ("axis: {name: X, screw_pitch: 12:30}", "7:30", "'12:30' is not a number"),
    ("axis: {name: X, screw_pitch: true}", "7:30", "'true' is not a number"),
    ("axis: {name: X, screw_pitch: [1]}", "7:17", "axis.screw_pitch: a list of 1 value is not a number"),
    ("  date: 18.11.2026", "9:9", "'18.11.2026' is not a date as it is written here; write 2026-11-18"),
    ("  date: 11/18/2026", "9:9", "write year-month-day, such as 2026-11-20"),
    ("  date: 20261118", "9:9", "'20261118' is not a date"),
    ("  date: 2026-02-30", "9:9", "there is no day 2026-02-30 in the calendar"),
    ("  date: 0206-11-18", "9:9", "lies before the year 1900"),
    ("  date: 2026-11-18T10:00:00", "9:9", "is not a date"),
    ("    plugin:", "11:5", "measurement.source.plugin has no value"),
    (
        "    plugin: exemplary-txt",
        "11:13",
        "no plugin provides data source 'exemplary-txt'; did you mean 'exemplary-text'?",
    ),
    (
        "    fil: six.txt",
        "12:5",
        "unknown key 'fil' in measurement.source; did you mean 'file'? (known: file, plugin)",
    ),
    ("    file: ''", "12:11", "measurement.source.file: the name of a file is expected"),
    ("    file: [a, b]", "12:5", "measurement.source.file: a list of 2 values is not the name of a file"),
    ("  - exemplary:2", "14:5", "no plugin provides standard 'exemplary:2'; did you mean 'exemplary:1'?"),
    ("  - 230", "14:5", "no plugin provides standard '230'"),
    ("  - [exemplary:1]", "14:5", "evaluate: a list of 1 value is not a group of keys"),
    ("  - {tolerances: {E: 1}}", "14:5", "evaluate.standard is missing"),
    (
        "  - {standard: 'exemplary:1', facto: 3}",
        "14:31",
        "unknown key 'facto' in evaluate; did you mean 'factor'?",
    ),
    (
        "  - {standard: 'exemplary:1', factor: 0}",
        "14:39",
        "evaluate.factor: '0' is not a number greater than 0",
    ),
    (
        "  - {standard: 'exemplary:1', tolerances: {A: 1}}",
        "14:44",
        "'A' is no parameter of exemplary:1; known: E, R",
    ),
    (
        "  - {standard: 'exemplary:1', tolerances: {E: 0}}",
        "14:47",
        "evaluate.tolerances.E: '0' is not a number greater than 0",
    ),
    (
        "  - {standard: 'exemplary:1', tolerances: {E: 12,5}}",
        "14:50",
        "a comma parts keys; write a decimal point: E: 12.5",
    ),
    (
        "  - {standard: 'exemplary:1', tolerances: {E: '12,5'}}",
        "14:47",
        "'12,5' is not a number; write a decimal point: 12.5",
    ),
    ("  - {standard: 'exemplary:1', tolerances: {E: tight}}", "14:47", "'tight' is not a number"),
    (
        "  - {standard: 'exemplary:1', tolerances: {E: 20 µm}}",
        "14:47",
        "write the number without its unit: 20",
    ),
    ("  - exemplary:1", "15:5", "exemplary:1 stands in line 14 already"),
    (
        "output: {formats: [exemplar]}",
        "15:20",
        "no plugin provides format 'exemplar'; did you mean 'exemplary'?",
    ),
    (
        "output: {formats: exemplary}",
        "15:19",
        "output.formats: 'exemplary' is not a list; for example [pdf, json]",
    ),
    (
        "output: {formats: []}",
        "15:10",
        "output.formats: a list of 0 values is not a list of at least 1 value",
    ),
]


@pytest.mark.parametrize(("replacement", "place", "core"), WRONG_VALUES)
def test_wrong_value_is_refused_where_it_stands(
    replacement: str, place: str, core: str, tmp_path: Path
) -> None:
    found = mistakes(with_line(int(place.partition(":")[0]), replacement), tmp_path)
    assert [message for message in found if message.startswith(f"job.yaml:{place}: ") and core in message], (
        found
    )


# Lines after the sound job's last, where the message points, what it says.
WRONG_ADDITIONS = [
    ("environment: {air_pressure: 1.013}", "16:29", "1.013 hPa is not between 300 and 1200 hPa"),
    ("environment: {air_temperature: 293.15}", "16:32", "293.15 K would be 20 °C"),
    ("environment: {relative_humidity: 140}", "16:34", "140 % is not between 0 and 100 %"),
    ("machine: {}", "16:1", "'machine' stands in line 6 already"),
    ("extends: [a, [b]]", "16:14", "extends names a file, or a list of files"),
    ("extends: {a: b}", "16:10", "extends names a file, or a list of files"),
    ("decision_rule: guardband", "16:16", "did you mean 'guard-band'?"),
    ('customer: {name: "A\\nB"}', "16:18", "customer.name: there is a line break in a text"),
    ('customer: {name: "A\\tB"}', "16:18", "customer.name: there is a tab in a text"),
    ('customer: {name: A, address: "A\\tB"}', "16:30", "there is a tab in the text"),
    (
        "instrument: {name: I, expanded_uncertainty: -1}",
        "16:45",
        "'-1' is not a number greater than 0 or text",
    ),
    ("instrument: {name: I, expanded_uncertainty: '0,3'}", "16:45", "write 0.3"),
    ("model: {effects: [[a]]}", "16:19", "model.effects: a list of 1 value is not text or a group of keys"),
    ("model: {effects: [{a: b}]}", "16:23", "model.effects.a: 'b' is not a group of keys"),
    (
        "model: {effects: [exemplary-wav]}",
        "16:19",
        "no plugin provides effect 'exemplary-wav'; did you mean 'exemplary-wave'?",
    ),
    (
        "model: {effects: [{exemplary-wave: {}, height: {}}]}",
        "16:19",
        "model.effects: a group of keys is no effect; an effect is its name, or {name: {parameter: value}}",
    ),
    (
        "model: {effects: [{exemplary-wave: {heigth: 3}}]}",
        "16:37",
        "unknown key 'heigth' in model.effects.exemplary-wave; did you mean 'height'? (known: height, rect",
    ),
    (
        "model: {effects: [{exemplary-wave: {height: high}}]}",
        "16:45",
        "model.effects.exemplary-wave.height: 'high' is not a number",
    ),
    (
        "model: {effects: [{exemplary-wave: {height: .inf}}]}",
        "16:45",
        "model.effects.exemplary-wave.height: '.inf' is not a finite number",
    ),
    (
        "model: {effects: [{exemplary-wave: {rectified: perhaps}}]}",
        "16:48",
        "model.effects.exemplary-wave.rectified: 'perhaps' is not true or false",
    ),
    (
        "model: {candidates: [exemplary-wave]}",
        "16:22",
        "model.candidates: exemplary-wave is installed, and tried in any case; list formulas here",
    ),
    ("<<: {}", "16:1", "'<<' is not used in a job; shared keys come from a file by 'extends'"),
    ("laboratory: !!python/object:os.system {}", "16:13", "a job uses no tags"),
    ("? [a]\n: b", "16:3", "a key is a plain word"),
    ("customer: *c", "16:11", "*c names nothing that stands above it"),
    ("customer: &c {name: *c}", "16:21", "*c stands inside the value that it names"),
    ("source: {file: x.csv}", "16:1", "unknown key 'source'; it is a key of measurement"),
    ("screw_pitch: 10", "16:1", "unknown key 'screw_pitch'; it is a key of axis"),
    ("plugin: laser-csv", "16:1", "unknown key 'plugin'; it is a key of measurement.source"),
    ("tolerances: {A: 10}", "16:1", "unknown key 'tolerances'; it is a key of evaluate"),
    ("\u00a0\u00a0Remark: 1", "16:1", "U+00A0 (no-break space) stands where a space belongs"),
    ("---\na: 1", "16:1", "a second document begins here"),
    ('customer: {name: "A\\x07"}', "16:18", "control character U+0007 in a text"),
    ('customer: {name: "\\e[31m"}', "16:18", "control character U+001B in a text"),
    ('customer: {name: "\\ud800"}', "16:18", "control character U+D800 in a text"),
    ("customer: {name: A\u202eB}", "16:19", "invisible character U+202E (right-to-left override)"),
    ("customer: {name: A\x07B}", "16:19", "control character U+0007; remove it"),
    ("customer: {name: A\u2028B}", "16:19", "invisible character U+2028"),
    pytest.param(
        f"customer: {{name: {'x' * 100_000}}}",
        "16:18",
        "(100,000 characters) is not text of at most 500 characters",
        id="name of 100,000 characters",
    ),
    pytest.param(
        f"measurement2: 1\ndecision_rule: {'1' * 100_000}",
        "16:1",
        "unknown key 'measurement2'",
        id="number of 100,000 digits",
    ),
]


@pytest.mark.parametrize(("addition", "place", "core"), WRONG_ADDITIONS)
def test_wrong_addition_is_refused_where_it_stands(
    addition: str, place: str, core: str, tmp_path: Path
) -> None:
    found = mistakes(with_lines(addition), tmp_path)
    assert [message for message in found if message.startswith(f"job.yaml:{place}: ") and core in message], (
        found
    )


def test_empty_list_is_refused_at_its_key(tmp_path: Path) -> None:
    (found,) = mistakes(with_line(14, "  []"), tmp_path)
    assert found.startswith("job.yaml:13:1: evaluate: a list of 0 values is not a list of at least 1 value")


@pytest.mark.parametrize(
    ("item", "sentence"),
    [
        ("iso230-2: 2014", "'iso230-2' is no key of a standard; write {standard: 'iso230-2:2014'}"),
        (
            "iso230-2:2014: {tolerances: {A: 10}}",
            "'iso230-2:2014' is no key of a standard; write {standard: iso230-2:2014, …}",
        ),
    ],
)
def test_identifier_that_became_a_key_is_told(item: str, sentence: str, tmp_path: Path) -> None:
    (found,) = mistakes(with_line(14, f"  - {item}"), tmp_path)
    assert found == f"job.yaml:14:5: evaluate: {sentence}"


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
