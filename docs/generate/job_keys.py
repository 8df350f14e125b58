"""The keys of a job file, from the classes that validate them and their JSON Schema."""

from __future__ import annotations

import inspect
import json
from collections.abc import Callable, Iterable, Iterator, Mapping
from typing import Any, TypeAlias

from markdown import code, table
from pydantic import BaseModel

from zlmreport.job.choices import group_model
from zlmreport.job.fleet import FleetKeys
from zlmreport.job.formula_keys import (
    FormKey,
    FormulaKeys,
    FormulaParameter,
    Harmonics,
    Instead,
    Meaning,
    Needs,
    Possible,
)
from zlmreport.job.keys import JobKeys
from zlmreport.job.schema import make_job_schema
from zlmreport.job.types import Options, find_field_at
from zlmreport.language import Language
from zlmreport.machines.keys import MachineFileKeys
from zlmreport.plugin.protocols import PartProgram
from zlmreport.plugin.registry import find_plugins
from zlmreport_plugins.notifiers import zlmreport_notifiers
from zlmreport_step_gauge.paths.path import ProbingPath

Schema: TypeAlias = Mapping[str, Any]

_HEADING = ("Key", "Value", "Without it", "Meaning")


def job_text() -> str:
    """Return every key of a job file that does not belong to a plugin."""
    return _table(JobKeys)


def schema_text() -> str:
    """Return the JSON Schema of the job file with the keys of all plugins that come with the program."""
    return f"{json.dumps(make_job_schema(find_plugins()), indent=1, ensure_ascii=False)}\n"


def fleet_text() -> str:
    """Return every key of a fleet file."""
    return _table(FleetKeys)


def catalogue_text() -> str:
    """Return the keys of an entry of a catalogue of effects."""
    groups = {
        "An entry": FormulaKeys,
        "A parameter": FormulaParameter,
        "`needs`": Needs,
        "`harmonics`": Harmonics,
        "An item of `keys`": FormKey,
        "`possible`": Possible,
        "An item of `meanings`": Meaning,
        "`instead`": Instead,
    }
    return "\n\n".join(part for head, model in groups.items() for part in (f"### {head}", _own_table(model)))


def _own_table(model: type[BaseModel]) -> str:
    """Return the keys of a group, without those of the groups in it."""
    schema = model.model_json_schema(by_alias=True)
    rows = _rows(model, schema, schema.get("$defs", {}), ())
    return table(_HEADING, (row for row in rows if "." not in row[0]))


def machine_text() -> str:
    """Return every key of a machine file."""
    return _table(MachineFileKeys)


def notifiers_text() -> str:
    """Return the keys of each built-in notifier."""
    return "\n\n".join(
        part
        for notifier in zlmreport_notifiers()
        for part in (f"### `plugin: {notifier.identifier}`", _table(notifier.options))
    )


def sources_text() -> str:
    """Return the keys of each installed data source."""
    return "\n\n".join(
        part
        for source in find_plugins().sources
        for part in (f"### `plugin: {source.identifier}`", _table(source.options))
    )


def standards_text() -> str:
    """Return the keys of the standards that have any of their own."""
    with_keys = [standard for standard in find_plugins().standards if standard.options.model_fields]
    if not with_keys:
        return "The standards that come with `zlmreport` have no keys of their own."
    return "\n\n".join(
        part
        for standard in with_keys
        for part in (f"### `standard: {standard.identifier}`", _table(standard.options))
    )


def programs_text() -> str:
    """Return the keys of each installed writer of part programs."""
    return _programs_text(find_plugins().list_programs_for())


def probing_programs_text() -> str:
    """Return the keys of each installed writer of paths of a probe."""
    return _programs_text(find_plugins().list_programs_for(ProbingPath))


def extensions_text() -> str:
    """Return the groups of keys of the installed extensions."""
    return "\n\n".join(_table(group_model(extension)) for extension in find_plugins().extensions)


def _programs_text(programs: Iterable[PartProgram]) -> str:
    return "\n\n".join(
        part
        for program in programs
        for part in (f"### `program: {program.identifier}`", _table(program.options))
    )


def instruments_text() -> str:
    """Return what each installed live instrument is, and its keys."""
    return "\n\n".join(
        part
        for instrument in find_plugins().instruments
        for part in (
            f"## `{instrument.identifier}`",
            f"{instrument.title.in_language(Language.ENGLISH)}.",
            (inspect.getdoc(instrument.__class__) or "").partition("\n\nParameters\n")[0],
            _table(instrument.options),
        )
    )


def _table(model: type[Options | BaseModel]) -> str:
    schema = model.model_json_schema(by_alias=True)
    return table(_HEADING, _rows(model, schema, schema.get("$defs", {}), ()))


def _rows(
    model: type[BaseModel], group: Schema, definitions: Schema, path: tuple[str | int, ...]
) -> Iterator[tuple[str, str, str, str]]:
    """Yield a row for each key of a group, and the rows of the groups in it."""
    for key, described in group.get("properties", {}).items():
        here = (*path, key)
        field = find_field_at(model, here)
        assert field, f"{here} is in the schema and not in the model"  # noqa: S101 - of this script itself
        inner = _group_in(described, definitions)
        meaning = field.description or (inner or {}).get("description", "")
        without = (
            "required" if field.is_required() else _written(field.get_default(call_default_factory=True))
        )
        yield code(_dotted(here)), _value(described, definitions), without, meaning
        if inner:
            yield from _rows(model, inner, definitions, here)
        item = _group_in(described.get("items", {}), definitions)
        if item:
            yield from _rows(model, item, definitions, (*here, 0))


def _dotted(path: tuple[str | int, ...]) -> str:
    """Return the name of a key: ``evaluate[].standard``."""
    return "".join("[]" if isinstance(step, int) else f".{step}" for step in path).removeprefix(".")


def _group_in(described: Schema, definitions: Schema) -> Schema | None:
    """Return the schema of a value that is a group of keys."""
    for alternative in (described, *described.get("anyOf", ())):
        if "$ref" in alternative:
            referred: Schema = definitions[alternative["$ref"].rpartition("/")[2]]
            if "properties" in referred:
                return referred
    return None


def _written(default: Any) -> str:
    """Write a default as a job would state it; nothing for nothing."""
    if default is None or default in ([], {}, ()) or isinstance(default, BaseModel):
        return ""
    return code(default if isinstance(default, str) else json.dumps(default).replace('"', ""))


def _value(described: Schema, definitions: Schema) -> str:
    """Say in words what kind of value is expected."""
    alternatives = described.get("anyOf", [described])
    kinds = [_kind(each, definitions) for each in alternatives if each.get("type") != "null"]
    return " or ".join(dict.fromkeys(kinds))


def _kind(described: Schema, definitions: Schema) -> str:
    if "$ref" in described:
        return _kind(definitions[described["$ref"].rpartition("/")[2]], definitions)
    if "const" in described:
        return code(str(described["const"]))
    if "enum" in described:
        return ", ".join(code(str(choice).replace("\t", "⇥")) for choice in described["enum"])
    return _TYPES.get(described.get("type", ""), lambda _: "any value")(described)


def _number(described: Schema) -> str:
    kind = "whole number" if described["type"] == "integer" else "number"
    return f"{kind} above {described['exclusiveMinimum']:g}" if "exclusiveMinimum" in described else kind


def _list(described: Schema) -> str:
    items = described.get("prefixItems")
    return f"list of {len(items)} values" if items else "list"


def _text(described: Schema) -> str:
    return {"date": "date", "path": "file or folder"}.get(described.get("format", ""), "text")


#: What a type of JSON Schema is called.
_TYPES: Mapping[str, Callable[[Schema], str]] = {
    "array": _list,
    "boolean": lambda _: "`true` or `false`",
    "integer": _number,
    "number": _number,
    "object": lambda _: "group",
    "string": _text,
}
