"""Catalogues of effects: files in which each entry is an effect that is written as a formula."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import replace
from types import MappingProxyType
from typing import Any, Literal

from pydantic import Field

from zlmreport.errors import InputError, Problem, did_you_mean
from zlmreport.job.contradictions import validate
from zlmreport.job.formula import FormulaError
from zlmreport.job.formula_keys import FormulaKeys, FormulaParameter, Phrase
from zlmreport.job.formula_parts import Formula, find_kinds_of
from zlmreport.job.parse import parse
from zlmreport.job.sentences import show_value
from zlmreport.job.tree import Items, KeyEntry, Keys, Scalar, make_keys_of, place_of
from zlmreport.job.types import JobPart, Text
from zlmreport.job.yaml_text import write_lines
from zlmreport.language import Words
from zlmreport.measurement.axis import AxisKind


class CatalogueKeys(JobPart):
    """A catalogue of effects."""

    schema_: Literal["zlmreport/effects/1"] = Field(
        alias="schema", description="Version of this format.", examples=["zlmreport/effects/1"]
    )
    measurements: dict[str, Phrase] | Text = Field(
        {},
        description="Measurements that tell effects apart, by names that entries use; or a file beside this "
        "one that has them.",
        examples=["measurements.yaml"],
    )
    effects: list[dict[str, Any]] = Field([], description="The entries, each as a job writes a formula.")


def read_catalogue(content: bytes, file: str, beside: Callable[[str], bytes]) -> tuple[FormulaKeys, ...]:
    """Return the entries of a catalogue.

    `file`: As messages name it.
    `beside`: Returns what a file holds that lies beside this one, by its name.

    Raises `InputError` with every mistake, each at its line and column.
    """
    problems: list[Problem] = []
    tree = parse(content, file, strictly=False)
    measurements = _find_measurements(tree, beside, problems)
    whole: dict[str, FormulaKeys] = {}
    for item in _list_items(tree, problems):
        entry = _make_entry(item, measurements.entries, problems)
        if entry is None:
            continue
        if entry.name in whole:
            sentence = f"effects.name: {entry.name} stands there twice; remove one of them"
            problems.append(Problem(place_of(item, ("name",)), sentence))
        whole[entry.name] = entry
    if problems:
        raise InputError(problems)
    return tuple(whole.values())


def read_measurements(content: bytes, file: str, beside: Callable[[str], bytes]) -> Mapping[str, Words]:
    """Return the measurements of a catalogue by their names, as `read_catalogue` reads it."""
    problems: list[Problem] = []
    tree = parse(content, file, strictly=False)
    keys = validate(CatalogueKeys, tree.without("effects"), problems)
    if keys is None:
        raise InputError(problems)
    if isinstance(keys.measurements, str):
        return read_measurements(beside(keys.measurements), keys.measurements, beside)
    return keys.measurements


def _find_measurements(tree: Keys, beside: Callable[[str], bytes], problems: list[Problem]) -> Keys:
    """Return the measurements of a catalogue, or of the file that it names."""
    keys = validate(CatalogueKeys, tree.without("effects"), problems)
    if keys is None or "measurements" not in tree.entries:
        return make_keys_of(tree.place)
    if isinstance(keys.measurements, str):
        try:
            tree = parse(beside(keys.measurements), keys.measurements, strictly=False)
        except OSError:
            sentence = f"measurements: there is no file {keys.measurements!r} beside this one"
            problems.append(Problem(place_of(tree, ("measurements",)), sentence))
            return make_keys_of(tree.place)
        return _find_measurements(tree, beside, problems)
    listed = tree.entries["measurements"].value
    return listed if isinstance(listed, Keys) else make_keys_of(tree.place)


def _list_items(tree: Keys, problems: list[Problem]) -> Iterator[Keys]:
    listed = tree.entries["effects"].value if "effects" in tree.entries else Items(tree.place, ())
    for item in listed.items if isinstance(listed, Items) else (listed,):
        if isinstance(item, Keys) and isinstance(listed, Items):
            yield item
        else:
            sentence = f"effects: {show_value(item)} is no entry; each begins with '- name: …'"
            problems.append(Problem(item.place, sentence))


def _make_entry(
    item: Keys, measurements: Mapping[str, KeyEntry], problems: list[Problem]
) -> FormulaKeys | None:
    """Return an entry, the measurements that it names written out."""
    name = item.entries.get("name")
    within = f"effects.{name.value.text}" if name and isinstance(name.value, Scalar) else "effects"
    told = item.entries.get("taken_for")
    if told and isinstance(told.value, Keys):
        spelled = replace(
            told.value, entries=MappingProxyType(dict(_list_words(told.value, measurements, problems)))
        )
        item = replace(
            item, entries=MappingProxyType({**item.entries, "taken_for": replace(told, value=spelled)})
        )
    keys = validate(FormulaKeys, item, problems, within=within)
    if keys is None:
        return None
    try:
        kind = (find_kinds_of(keys) or [AxisKind.LINEAR])[0]
        Formula.of(keys, kind)
        for key in keys.keys:
            for value in list(key.choices)[1:]:
                Formula.of(keys, kind, choices={key.name: value})
    except FormulaError as error:
        problems.append(Problem(place_of(item, error.key), f"{'.'.join((within, *error.key))}: {error}"))
        return None
    return keys


def _list_words(
    told: Keys, measurements: Mapping[str, KeyEntry], problems: list[Problem]
) -> Iterator[tuple[str, KeyEntry]]:
    """Yield what tells an effect from others, each in words."""
    for effect, entry in told.entries.items():
        value = entry.value
        if isinstance(value, Scalar) and value.text in measurements:
            yield effect, replace(entry, value=measurements[value.text].value)
            continue
        if isinstance(value, Scalar) and measurements and " " not in value.text:
            advice = did_you_mean(value.text, list(measurements))
            problems.append(Problem(value.place, f"there is no measurement {value.text!r}; {advice}"))
        yield effect, entry


#: What an entry that comes from a job still lacks, to be written by who finds the cause.
_LACKING = """\
physics:
  en: "Its cause is not known yet: find it, and write here how it becomes a deviation."
  de: "Die Ursache ist noch nicht bekannt: sie suchen und hier angeben, wie sie zur Abweichung wird."
look:
  en: The residuals follow the formula.
  de: Die Residuen folgen der Formel.
remedy:
  en: "Its cause is not known yet: find it, and write here what a service engineer does."
  de: "Die Ursache ist noch nicht bekannt: sie suchen und hier angeben, was im Service zu tun ist."
"""


def write_as_catalogue(item: Keys, formula: Formula, kind: AxisKind) -> str:
    """Return a formula of a job as a catalogue with one entry, what the entry lacks written for its author.

    `item`: The formula as the job writes it.
    `kind`: Of the axis of the job.
    """
    entries = dict(item.entries)
    # Beside a constant each parameter needs a position of its own, where the formula goes by positions.
    targets = f", targets: {len(formula.keys.parameters) + 1}" if "P" in formula.names else ""
    lacking = parse(f"needs: {{axis: {kind.value}{targets}}}\n{_LACKING}".encode(), "").entries
    entries |= {name: entry for name, entry in lacking.items() if name not in entries}
    parameters = entries["parameters"].value
    if isinstance(parameters, Keys):
        elsewhere = _find_parameters_of_job(formula)
        kept = tuple(
            replace(each, value=each.value.without("value", "equals"))
            if each.key in elsewhere and isinstance(each.value, Keys)
            else each
            for each in parameters.entries.values()
        )
        entries["parameters"] = replace(entries["parameters"], value=make_keys_of(parameters.place, kept))
    first, *rest = write_lines(make_keys_of(item.place, tuple(entries.values())), "    ")
    return "\n".join(("schema: zlmreport/effects/1", "effects:", f"  - {first.lstrip()}", *rest, ""))


def _find_parameters_of_job(formula: Formula) -> dict[str, FormulaParameter]:
    """Return the parameters of which a job says what they are, and which are estimated elsewhere."""
    return {
        name: each
        for name, each in formula.keys.parameters.items()
        if (name in formula.linear or each.range is not None)
        and (each.value is not None or each.equals is not None)
    }


def write_in_job(formula: Formula) -> str:
    """Return how a job names an effect instead of its formula, with what it states of parameters."""
    stated = [
        f"{name}: {each.value!r}" if each.equals is None else f"{name}: {{equals: {each.equals}}}"
        for name, each in _find_parameters_of_job(formula).items()
    ]
    return f"{formula.keys.name}: {{{', '.join(stated)}}}" if stated else formula.keys.name
