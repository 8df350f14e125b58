"""The JSON Schema of the job file, for editors: its keys, and those of the installed plugins."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence
from typing import TYPE_CHECKING, Any, TypeAlias

from pydantic import BaseModel
from pydantic.errors import PydanticInvalidForJsonSchema

from zlmreport.job.choices import group_model
from zlmreport.job.document_keys import Output
from zlmreport.job.effect_choices import ParameterLimits
from zlmreport.job.evaluation_keys import (
    AxisModelKeys,
    ControllerKeys,
    DecisionRuleKeys,
    ProgramKeys,
    StandardKeys,
)
from zlmreport.job.formula_keys import FormulaKeys
from zlmreport.job.keys import JobKeys
from zlmreport.job.measurement_keys import Measurement, SourceKeys
from zlmreport.job.standards import list_adoptions_of
from zlmreport.job.tree import Step
from zlmreport.job.types import LiveInstrumentKeys, find_model_at
from zlmreport.language import Language

if TYPE_CHECKING:
    from zlmreport.job.choices import WithKeys
    from zlmreport.model.effects.effect import Effect
    from zlmreport.plugin.protocols import Standard
    from zlmreport.plugin.registry import Registry

Schema: TypeAlias = dict[str, Any]
#: What a text looks like that is a number.
_NUMBER = r"^\s*[-+]?(\d+([.,]\d*)?|[.,]\d+)([eE][-+]?\d+)?\s*$"


def make_job_schema(registry: Registry) -> Schema:
    """Return the JSON Schema (draft 2020-12) of the job file.

    A file may be a job, or a part of one that others extend. What a job must have is asked only of a whole
    job: of one that states its schema and extends no other file.
    """
    schema = JobKeys.model_json_schema()
    definitions = schema["$defs"]
    sources = [_make_by_name("plugin", "data source", each, definitions) for each in registry.sources]
    definitions[SourceKeys.__name__] = {
        "description": definitions[SourceKeys.__name__]["description"],
        **_make_whole_or_part("plugin", sources),
    }
    for name in [name for name in definitions if name.endswith(f".{LiveInstrumentKeys.__name__}")]:
        definitions[name] = {
            "description": definitions[name]["description"],
            "oneOf": [
                _make_by_name("plugin", "live instrument", each, definitions) for each in registry.instruments
            ],
        }
    definitions[StandardKeys.__name__] = {
        "description": definitions[StandardKeys.__name__]["description"],
        "anyOf": [
            {"enum": [name for standard in registry.standards for name in _list_names(standard)]},
            *(_describe_standard(standard, definitions) for standard in registry.standards),
        ],
    }
    for key, value in _make_of_the_measurement(registry, definitions).items():
        schema["properties"].setdefault(key, value)
        definitions[Measurement.__name__]["properties"].setdefault(key, value)
    rule = definitions[DecisionRuleKeys.__name__]
    definitions[DecisionRuleKeys.__name__] = {
        "description": rule["description"],
        "anyOf": [{"enum": rule["properties"]["rule"]["enum"]}, rule],
    }
    definitions[ParameterLimits.__name__] = ParameterLimits.model_json_schema()
    definitions[f"formula.{FormulaKeys.__name__}"] = _make_own_keys(FormulaKeys, "formula", definitions)
    formula = {"$ref": f"#/$defs/formula.{FormulaKeys.__name__}"}
    definitions[AxisModelKeys.__name__]["properties"]["effects"]["items"] = {
        "anyOf": [
            {"enum": [effect.identifier for effect in registry.effects]},
            *(_make_effect(effect, definitions) for effect in registry.effects),
            formula,
        ]
    }
    definitions[AxisModelKeys.__name__]["properties"]["candidates"]["items"] = formula
    if registry.controllers:
        definitions[ControllerKeys.__name__] = {
            "description": definitions[ControllerKeys.__name__]["description"],
            "oneOf": [
                _make_by_name("controller", "controller", each, definitions) for each in registry.controllers
            ],
        }
    for extension in registry.extensions:
        own = group_model(extension).model_json_schema()
        definitions.update(own["$defs"])
        schema["properties"].update(own["properties"])
    for name, takes in _find_listed_programs(registry).items():
        programs = registry.list_programs_for(takes)
        definitions[name] = {
            "description": definitions[name]["description"],
            "anyOf": [
                {"enum": [program.identifier for program in programs]},
                *(_make_by_name("program", "part program", each, definitions) for each in programs),
            ],
        }
    formats = definitions[Output.__name__]["properties"]["formats"]
    formats["items"] = {"enum": [renderer.identifier for renderer in registry.renderers]}
    _describe_references(schema, definitions)
    _take_numbers_for_text(schema)
    demands = _find_demands(
        schema, definitions, {SourceKeys.__name__: _make_named_demands("plugin", sources)}
    )
    return {
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "$id": "urn:zlmreport:job:1",
        **_drop_demands(schema),
        "if": {
            "required": ["schema"],
            "not": {"anyOf": [{"required": ["extends"]}, {"required": ["measurements"]}]},
        },
        "then": {
            **demands,
            "required": [key for key in demands["required"] if key != "axis"],
            "anyOf": [{"required": [key]} for key in ("axis", "circle", *registry.axis_keys)]
            + [{"properties": {"measurement": {"required": [key]}}} for key in ("error", "tests")],
        },
    }


def _find_listed_programs(registry: Registry) -> dict[str, type | None]:
    """Return what the part programs are written of, by the definition of what names them in a list."""
    listed: dict[str, type | None] = {ProgramKeys.__name__: None}
    for extension in registry.extensions:
        path: tuple[Step, ...] = (extension.identifier, *extension.programs, 0)
        named = find_model_at(group_model(extension), path) if extension.programs else None
        if named:
            listed[named.__name__] = extension.takes
    return listed


def _make_whole_or_part(key: str, alternatives: Sequence[Schema]) -> Schema:
    """Return the schema of a group that names a plugin, or of a part of it; what it demands stands apart.

    A file that is extended may name the plugin and leave its keys to others, or the other way about: without
    the name, the keys of all plugins are known.
    """
    known: Schema = {}
    for alternative in alternatives:
        for name, value in alternative["properties"].items():
            if name != key:
                known.setdefault(name, {"description": value.get("description", ""), "anyOf": []})
                known[name]["anyOf"].append(value)
    return {
        "if": {"required": [key]},
        "then": {"oneOf": [{**each, "required": [key]} for each in alternatives]},
        "else": {"type": "object", "properties": known, "additionalProperties": False},
    }


def _make_named_demands(key: str, alternatives: Sequence[Schema]) -> Schema:
    """Return what a whole group must have: the plugin's name, and the keys that this plugin demands."""
    return {
        "required": [key],
        "allOf": [
            {
                "if": {"required": [key], "properties": {key: {"const": each["properties"][key]["const"]}}},
                "then": {"required": each["required"]},
            }
            for each in alternatives
        ],
    }


def _describe_references(schema: Schema, definitions: Schema) -> None:
    """Give keys that refer to a definition its description: not every editor looks there."""
    for part in list(_walk_parts(schema)):
        for value in part.get("properties", {}).values():
            if isinstance(value, dict) and "$ref" in value and "description" not in value:
                referred = definitions.get(value["$ref"].removeprefix("#/$defs/"), {})
                value["description"] = referred.get("description", "")


def _make_by_name(key: str, what: str, plugin: WithKeys, definitions: Schema) -> Schema:
    """Return the schema of a plugin's keys with the one that names it."""
    named = {"const": plugin.identifier, "description": f"Identifier of the {what}."}
    return _add_keys(_make_own_keys(plugin.options, plugin.identifier, definitions), {key: named})


#: Parameters that bear the symbol of what was measured: ``EYX``, ``EYX_fwd``, ``C0Y``.
_ERROR_SYMBOLS = "^[EABC][0A-CU-Z][A-CU-Z](_[a-z]+)?$"


def _list_names(standard: Standard) -> tuple[str, ...]:
    """Return what a job may call a standard: its identifier, and its identical adoptions."""
    return (standard.identifier, *list_adoptions_of(standard))


def _describe_standard(standard: Standard, definitions: Schema) -> Schema:
    """Return the schema of a standard's keys."""
    of_all = StandardKeys.model_json_schema()["properties"]
    limit = of_all["tolerances"]["additionalProperties"]
    of_error = {**limit, "description": "Of an error by its symbol, µm (″)."}
    names = _list_names(standard)
    keys = {
        **of_all,
        "standard": {
            **({"enum": list(names)} if names[1:] else {"const": standard.identifier}),
            "description": "Identifier of the standard.",
        },
        "tolerances": {
            "type": "object",
            "description": of_all["tolerances"]["description"],
            "properties": {
                each.symbol: {**limit, "description": f"{each.name.in_language(Language.ENGLISH)}, µm (″)."}
                for each in standard.quantities
                if each.can_be_limited
            },
            **({"patternProperties": {_ERROR_SYMBOLS: of_error}} if hasattr(standard, "of_error") else {}),
            "additionalProperties": False,
        },
    }
    return _add_keys(_make_own_keys(standard.options, standard.identifier, definitions), keys)


def _make_of_the_measurement(registry: Registry, definitions: Schema) -> Schema:
    """Return the keys of standards that a job may write in `measurement` or at its top, by their names."""
    asked: dict[str, list[Schema]] = {}
    for standard in registry.standards:
        of_standard = [
            key for key in standard.options.of_the_measurement if key not in registry.extension_keys
        ]
        if of_standard:
            own = _make_own_keys(standard.options, standard.identifier, definitions)["properties"]
            for key in of_standard:
                asked.setdefault(key, []).append(own[key])
    return {
        key: {"description": keys[0].get("description", ""), "anyOf": keys} for key, keys in asked.items()
    }


def _make_effect(effect: Effect, definitions: Schema) -> Schema:
    """Return the schema of an effect with keys: its own, and its parameters in any of its forms.

    Which parameters there are depends on its own keys, and a schema cannot say so of every plugin.
    """
    keys = _make_own_keys(effect.options, effect.identifier, definitions)
    limits = {"$ref": f"#/$defs/{ParameterLimits.__name__}"}
    parameters = {
        parameter.name: {
            "anyOf": [{"type": "number"}, limits],
            "description": f"Fixes the parameter, or limits it: "
            f"{parameter.description.in_language(Language.ENGLISH)}.",
        }
        for parameter in (*effect.linear, *effect.searched)
    }
    known = {**keys, "properties": {**parameters, **keys.get("properties", {})}}
    if effect.options.model_fields:
        known["additionalProperties"] = {"anyOf": [{"type": "number"}, limits]}
    return {
        "type": "object",
        "properties": {
            effect.identifier: {
                "description": f"{effect.title.in_language(Language.ENGLISH)}.",
                "anyOf": [{"type": "null"}, known],
            }
        },
        "required": [effect.identifier],
        "additionalProperties": False,
    }


def _make_own_keys(options: type[BaseModel], identifier: str, definitions: Schema) -> Schema:
    """Return the schema of a plugin's own keys; what they refer to moves into the definitions."""
    template = f"#/$defs/{identifier}.{{model}}"
    try:
        schema = options.model_json_schema(ref_template=template)
    except PydanticInvalidForJsonSchema:  # a plugin may have keys of types that JSON does not know
        return {"type": "object", "properties": {}}
    own = schema.pop("$defs", {})
    definitions.update({f"{identifier}.{name}": definition for name, definition in own.items()})
    return schema


def _add_keys(schema: Schema, keys: Schema) -> Schema:
    """Return a plugin's schema with the key that names the plugin, and others of the job."""
    named_by = next(iter(keys))
    return {
        **schema,
        "properties": {**keys, **schema.get("properties", {})},
        "required": [named_by, *schema.get("required", [])],
    }


def _take_numbers_for_text(schema: Schema) -> None:
    """Allow numbers where text is asked for: a serial number 00123 is taken as it is spelt.

    Not where the text has a form that no number has; nor where a number or a group of keys may stand as well:
    there, what looks like a number is one, and is held to its bounds.
    """
    for part in _walk_parts(schema):
        others = [each for each in _list_alternatives(part)[1:] if not _is_free_text(each)]
        if any(each.get("type") in {"number", "integer"} or "$ref" in each for each in others):
            for each in filter(_is_free_text, _list_alternatives(part)[1:]):
                each["not"] = {"pattern": _NUMBER}
    for part in _walk_parts(schema):
        if _is_free_text(part) and "not" not in part:
            form = re.compile(part.get("pattern", ""))
            if form.search("7.5"):
                part["type"] = ["string", "number"]
            if not form.search("-7.5"):
                part["minimum"] = 0


def _is_free_text(part: Schema) -> bool:
    return part.get("type") == "string" and not {"enum", "const", "format"} & part.keys()


def _walk_parts(schema: Any) -> Iterator[Schema]:
    if isinstance(schema, dict):
        yield schema
        for part in schema.values():
            yield from _walk_parts(part)
    elif isinstance(schema, list):
        for part in schema:
            yield from _walk_parts(part)


def _drop_demands(schema: Schema) -> Schema:
    """Return the schema without what its own parts must have; plugins' keys stay with their plugin.

    So do those of an item of a list: a list is extended as a whole.
    """
    relaxed = {key: value for key, value in schema.items() if key != "required"}
    plugin_parts = {ControllerKeys.__name__, SourceKeys.__name__, StandardKeys.__name__, ProgramKeys.__name__}
    whole = plugin_parts | _find_only_listed(schema)
    relaxed["$defs"] = {
        name: definition
        if name in whole or "." in name
        else {key: value for key, value in definition.items() if key != "required"}
        for name, definition in schema["$defs"].items()
    }
    return relaxed


def _find_only_listed(schema: Schema) -> set[str]:
    """Return the definitions that only items of lists refer to."""
    listed: set[str] = set()
    others: set[str] = set()
    for part in _walk_parts(schema):
        for name, value in part.items():
            for each in _list_alternatives(value) if name != "$defs" and isinstance(value, dict) else ():
                if "$ref" in each:
                    (listed if name == "items" else others).add(each["$ref"].rpartition("/")[2])
    return listed - others


def _list_alternatives(part: Schema) -> list[Schema]:
    return [part, *part.get("anyOf", ()), *part.get("oneOf", ())]


def _find_demands(schema: Schema, definitions: Schema, of_plugins: Schema) -> Schema:
    """Return what a part of a job must have, and what its parts must; `of_plugins` by their definition."""
    inner = {}
    for name, part in schema.get("properties", {}).items():
        referred = _find_referred(part, definitions)
        if referred in of_plugins:
            inner[name] = of_plugins[referred]
        elif referred and (demands := _find_demands(definitions[referred], definitions, of_plugins)):
            inner[name] = demands
    return {
        **({"required": schema["required"]} if "required" in schema else {}),
        **({"properties": inner} if inner else {}),
    }


def _find_referred(part: Schema, definitions: Schema) -> str:
    """Return the name of the definition that a part refers to, alone or beside null; empty for none."""
    alternatives: Iterable[Schema] = part.get("anyOf", [part])
    names = (alternative.get("$ref", "").removeprefix("#/$defs/") for alternative in alternatives)
    return next((name for name in names if name in definitions), "")
