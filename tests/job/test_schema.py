"""The JSON Schema says what the program takes: editors and the program agree."""

from __future__ import annotations

from enum import Enum
from typing import Any

import jsonschema
import pytest
import yaml
from pydantic import BaseModel, Field, create_model

from environments import ROOT
from installed import registry
from job.jobs import SOUND, list_groups, make_editor, with_line, with_lines
from offers import offering
from testing.exemplary import ExemplarySource
from zlmreport.job.schema import make_job_schema
from zlmreport.plugin import Options
from zlmreport.plugin.extension import JobKeys
from zlmreport.plugin.registry import Plugin, collect


class _Loader(yaml.SafeLoader):
    """Reads YAML as editors do: version 1.2, in which a date is text."""


_Loader.yaml_implicit_resolvers = {
    letter: [resolver for resolver in resolvers if not resolver[0].endswith(":timestamp")]
    for letter, resolvers in yaml.SafeLoader.yaml_implicit_resolvers.items()
}


def _complaints(text: str) -> list[str]:
    return [error.message for error in make_editor().iter_errors(yaml.load(text, Loader=_Loader))]


def test_schema_is_one() -> None:
    jsonschema.Draft202012Validator.check_schema(make_editor().schema)


def test_sound_job_fits() -> None:
    assert _complaints(SOUND) == []


@pytest.mark.parametrize(
    "text",
    [
        with_line(1, "schema: zlmreport/job/2"),
        with_line(3, "  number: a/b"),
        with_line(3, "  nmber: CAL-1"),
        with_line(4, "  kind: report\n  issued: 20.11.2026"),
        with_line(6, "machine: {seriall: 1}"),
        with_line(7, "axis: {kind: linear}"),
        with_line(7, "axis: {name: X, screw_pitch: -1}"),
        with_line(11, "    plugin: exemplary-txt"),
        with_line(12, "    fil: six.txt"),
        with_line(14, "  - exemplary:2"),
        with_line(14, "  - {standard: 'exemplary:1', tolerances: {A: 1}}"),
        with_line(14, "  - {standard: 'exemplary:1', facto: 1}"),
        with_lines("plan: {programs: [exemplary-step]}"),
        with_lines("plan: {programs: [{program: exemplary-steps, decimal: 4}]}"),
        with_line(15, "output: {formats: [exemplar]}"),
        with_lines("model: {effects: [exemplary-waves]}"),
        with_lines("model: {effects: [{exemplary-wave: {height: high}}]}"),
        with_lines("model: {effects: [{exemplary-wave: {}, other: {}}]}"),
        with_lines("decision_rule: {rule: guard-band, guard_band_factor: 0}"),
        "schema: zlmreport/job/1\n",
    ],
)
def test_what_the_program_refuses_does_not_fit(text: str) -> None:
    assert _complaints(text)


@pytest.mark.parametrize(
    "text",
    [
        with_line(6, "machine: {serial: 00123}"),
        with_line(14, "  - exemplary:1"),
        with_line(14, "  - {standard: 'exemplary:1', factor: 3, tolerances: {R: 0.5}}"),
        with_lines("environment: {air_temperature: 20.5, remarks: none}"),
        with_lines("decision_rule: guard-band"),
        with_lines("decision_rule: {rule: guard-band, guard_band_factor: 0.5}"),
        with_lines("plan: {programs: [exemplary-steps]}"),
        with_lines("plan: {programs: [{program: exemplary-steps, axis: X1}]}"),
        with_lines("laboratory:", "model: {effects: [exemplary-wave, {exemplary-wave: {height: 3}}]}"),
        "extends: base.yaml\nlaboratory: {address: Here}\ncertificate: {issued: 2026-11-20}\n",
    ],
)
def test_what_the_program_takes_fits(text: str) -> None:
    assert _complaints(text) == []


def test_every_key_is_described() -> None:
    schema = make_editor().schema
    undescribed = [
        f"{name}.{key}"
        for name, part in [("job", schema), *schema["$defs"].items()]
        for key, value in part.get("properties", {}).items()
        if "description" not in {**schema["$defs"].get(value.get("$ref", "").rpartition("/")[2], {}), **value}
    ]
    assert undescribed == []


def test_every_example_is_taken_by_its_own_key() -> None:
    fields = [
        (name, field)
        for part in list_groups(JobKeys)
        for name, field in part.model_fields.items()
        if field.examples
    ]
    assert len(fields) > 20
    for name, field in fields:
        alone = create_model("Alone", **{name: (field.annotation, field)})  # type: ignore[call-overload]
        alone.model_validate({field.alias or name: field.examples[0]})


class Nested(BaseModel):
    """A group of keys within a plugin's."""

    depth: float = Field(description="How deep.")


class Colour(Enum):
    """Something to choose from."""

    RED = "red"


class NestedOptions(Options):
    """Keys with groups and choices."""

    nested: Nested = Field(description="A group.")
    colour: Colour = Field(Colour.RED, description="A choice.")


class UnknownToJson:
    """A type that JSON does not know."""


class PythonOptions(Options):
    """Keys that only Python knows."""

    thing: UnknownToJson | None = None


def _source_schema(options: type[Options]) -> dict[str, Any]:
    class Source(ExemplarySource):
        identifier = "other"

    Source.options = options
    schema = make_job_schema(collect([(Plugin("other"), offering(sources=[ExemplarySource(), Source()]))]))
    jsonschema.Draft202012Validator.check_schema(schema)
    return schema


def test_groups_of_a_plugins_keys_are_described_under_its_own_name() -> None:
    schema = _source_schema(NestedOptions)
    assert {"other.Nested", "other.Colour"} <= schema["$defs"].keys()
    good = SOUND.replace("plugin: exemplary-text", "plugin: other").replace(
        "file: six.txt", "nested: {depth: 1}"
    )
    bad = good.replace("{depth: 1}", "{depth: deep}")
    validator = jsonschema.Draft202012Validator(schema)
    assert not validator.is_valid(yaml.load(bad, Loader=_Loader))


def test_plugin_whose_keys_json_does_not_know_is_taken_as_it_is() -> None:
    schema = _source_schema(PythonOptions)
    other = schema["$defs"]["SourceKeys"]["then"]["oneOf"][-1]
    assert other["properties"]["plugin"]["const"] == "other"


def test_every_example_and_every_part_of_one_fits() -> None:
    """Whole jobs, what they extend, and a job of a fleet that says only its file."""
    files = (ROOT / "configs").rglob("*.yaml")
    values = {path: yaml.load(path.read_text("utf-8"), Loader=_Loader) for path in files}
    jobs = {path: each for path, each in values.items() if each.get("schema") in {None, "zlmreport/job/1"}}
    assert len(jobs) > 140
    assert [path for path, each in jobs.items() if not make_editor(registry()).is_valid(each)] == []


def test_a_misspelt_key_never_fits() -> None:
    schema = make_editor().schema
    groups = {
        name: schema["$defs"].get(part.get("$ref", "").rpartition("/")[2], {}).get("properties", {})
        for name, part in schema["properties"].items()
    }
    misspelt: list[dict[str, Any]] = [{f"{name}x": 1} for name in groups]
    misspelt += [{name: {f"{key}x": 1}} for name, keys in groups.items() for key in keys]
    assert len(misspelt) > 60
    assert [each for each in misspelt if make_editor().is_valid({"extends": "base.yaml", **each})] == []


def test_a_part_may_leave_the_data_source_or_its_file_to_others() -> None:
    base = "extends: other.yaml\n"
    assert _complaints(f"{base}measurement: {{source: {{file: six.txt}}}}\n") == []
    assert _complaints(f"{base}measurement: {{source: {{plugin: exemplary-text}}}}\n") == []
    assert _complaints(f"{base}measurement: {{source: {{fil: six.txt}}}}\n") != []


def test_a_whole_job_names_its_data_source_and_what_that_demands() -> None:
    assert _complaints(with_line(11, "    # no plugin")) != []
    assert _complaints(with_line(12, "    # no file")) != []
