"""The messages on wrong and unknown keys of a job: what was expected, bounds, the nearest name."""

from __future__ import annotations

import difflib
import re
from collections.abc import Callable, Collection, Iterator, Mapping
from dataclasses import dataclass
from typing import Any

from pydantic import BaseModel, ValidationError
from pydantic.fields import FieldInfo
from pydantic_core import ErrorDetails

from zlmreport.errors import (
    Place,
    Problem,
    count_in_words,
    describe_character,
    did_you_mean,
    list_names,
    quoted,
)
from zlmreport.job.tree import Items, Keys, Node, Scalar, Step, find_key_place, place_of, walk
from zlmreport.job.types import (
    find_field_at,
    find_model_at,
    find_part,
    list_choices_in,
    list_keys_in,
    replace_decimal_comma,
)

#: Kinds of mistakes that a value makes which is no text, no group, and so on.
TEXT_EXPECTED = frozenset({"string_type", "literal_error", "enum", "path_type", "value_error"})
GROUP_EXPECTED = frozenset({"model_type", "model_attributes_type", "dict_type", "mapping_type"})
#: The key itself is the mistake: it is not there, or should not be.
MISSING = "missing"
UNKNOWN = "extra_forbidden"


@dataclass(frozen=True, slots=True)
class Refusal:
    """One reason why a value does not fit: a kind in pydantic's naming, with its numbers or choices."""

    kind: str
    context: dict[str, Any]


@dataclass(frozen=True, slots=True)
class Mistake:
    """A value that does not fit, a key that is missing, or one that is unknown."""

    path: tuple[Step, ...]  #: Keys and indices that lead to it.
    place: Place  #: Where it stands; of what is missing, the group that should have it.
    node: Node | None  #: The value; None where it is missing.
    #: Why: several where a key takes several kinds of values, and this is none of them.
    refusals: tuple[Refusal, ...]

    @property
    def kinds(self) -> frozenset[str]:
        """The kinds of all refusals."""
        return frozenset(refusal.kind for refusal in self.refusals)


def find_mistakes_in(error: ValidationError, keys: Keys) -> tuple[Mistake, ...]:
    """Return the mistakes that a model found in a group of keys."""
    gathered: dict[tuple[Step, ...], list[Refusal]] = {}
    for details in error.errors(include_url=False, include_input=False):
        refusal = Refusal(details["type"], details.get("ctx", {}))
        gathered.setdefault(_find_path(details, keys), []).append(refusal)
    return tuple(
        Mistake(path, _find_place(keys, path, refusals), _find_node(keys, path), tuple(refusals))
        for path, refusals in gathered.items()
        if not _is_explained_below(path, gathered)
    )


def _find_path(details: ErrorDetails, keys: Keys) -> tuple[Step, ...]:
    """Return a mistake's path in the job, without the names that pydantic gives to alternatives of a type."""
    path = tuple(_list_steps_that_exist(details["loc"], keys))
    return (*path, details["loc"][-1]) if details["type"] == MISSING else path


def _list_steps_that_exist(location: tuple[Step, ...], keys: Keys) -> Iterator[Step]:
    node: Node = keys
    for step in location:
        for existing, _, value in walk(node, (step,)):
            yield existing
            node = value


def _find_place(keys: Keys, path: tuple[Step, ...], refusals: list[Refusal]) -> Place:
    """Return the place of a value, or of an unknown key."""
    if any(refusal.kind == UNKNOWN for refusal in refusals):
        return find_key_place(keys, path)
    return place_of(keys, path)


def _find_node(keys: Keys, path: tuple[Step, ...]) -> Node | None:
    found = list(walk(keys, path))
    if len(found) < len(path):
        return None
    return found[-1][2] if found else keys


def _is_explained_below(path: tuple[Step, ...], gathered: dict[tuple[Step, ...], list[Refusal]]) -> bool:
    """Whether a part of the value has a mistake: then the value is right in kind, and only its part wrong."""
    return any(len(other) > len(path) and other[: len(path)] == path for other in gathered)


_NUMBER_AND_UNIT = re.compile(
    r"([-+]?\d+(?:\.\d+)?)\s*(?:mm|µm|μm|um|nm|m|in|°C?|deg|arcsec|″|%|hPa|s)(?:/min)?"
)

_DATE = "a date such as 2026-11-20"
#: How much alike a key of the same group is, of 1, that is meant before any of another group.
_MISTYPED = 0.9
#: Groups that are looked through for a key that stands in another; how deep, and how many are named at most.
_DEEPEST_HOME, _MOST_HOMES = 2, 3
#: Keys under which whole jobs stand, or measurements.
_LIKE_THE_MEASUREMENT = frozenset({"tests", "as_found", "measurements"})
_CHOICE_KINDS = frozenset({"literal_error", "enum"})
_SPOKEN_KINDS = frozenset({"value_error", "assertion_error"})

#: What is expected instead, by the kind of refusal: the same words whatever its numbers are, or with them.
_EXPECTED_KINDS: Mapping[str, str] = {
    kind: words
    for kinds, words in (
        ({"float_type", "float_parsing"}, "a number"),
        ({"finite_number"}, "a finite number"),
        ({"int_type", "int_parsing", "int_from_float"}, "a whole number"),
        ({"string_type"}, "text"),
        ({"path_type"}, "the name of a file"),
        ({"date_type", "date_parsing", "date_from_datetime_parsing", "date_from_datetime_inexact"}, _DATE),
        ({"bool_type", "bool_parsing"}, "true or false"),
        ({"list_type", "tuple_type", "set_type"}, "a list"),
        (GROUP_EXPECTED, "a group of keys"),
    )
    for kind in kinds
}
_EXPECTED_SIZES: Mapping[str, Callable[[Mapping[str, Any]], str]] = {
    "greater_than": lambda given: _say_bounds("greater than", given["gt"]),
    "greater_than_equal": lambda given: _say_bounds("of at least", given["ge"]),
    "less_than": lambda given: _say_bounds("less than", given["lt"]),
    "less_than_equal": lambda given: _say_bounds("of at most", given["le"]),
    "multiple_of": lambda given: f"a multiple of {given['multiple_of']}",
    "string_too_short": lambda given: f"text of at least {count_in_words(given['min_length'], 'character')}",
    "string_too_long": lambda given: f"text of at most {count_in_words(given['max_length'], 'character')}",
    "string_pattern_mismatch": lambda given: f"text of the form {given['pattern']}",
    "too_short": lambda given: f"a list of at least {count_in_words(given['min_length'], 'value')}",
    "too_long": lambda given: f"a list of at most {count_in_words(given['max_length'], 'value')}",
}


def _say_bounds(words: str, bound: Any) -> str:
    """Say what is expected of a number, or of a date."""
    return f"a number {words} {bound:g}" if isinstance(bound, int | float) else f"{words} {bound}"


def make_problem(
    mistake: Mistake, model: type[BaseModel], within: str, also_known: Collection[str]
) -> Problem:
    """Return the problem that the user reads.

    `model`: What describes the keys: a message quotes its descriptions and examples.
    `within`: The dotted path of the model's keys in the job.
    """
    field = find_field_at(model, mistake.path)
    name = _write_dotted(within, mistake.path)
    if mistake.kinds == {MISSING}:
        return Problem(mistake.place, _say_missing(mistake, name, field))
    if mistake.kinds == {UNKNOWN}:
        return Problem(mistake.place, _say_unknown(mistake, model, within, also_known))
    return Problem(mistake.place, _say_unfit(mistake, model, name, field))


def _write_dotted(within: str, path: tuple[Step, ...]) -> str:
    """Return the dotted name of a key; items of a list are known by their place.

    A user's own key, such as a tolerance's symbol, may hold what no terminal prints: it is shown escaped.
    """
    steps = (step for step in (within, *path) if isinstance(step, str) and step)
    return ".".join(step if step.isprintable() else repr(step)[1:-1] for step in steps)


def _say_missing(mistake: Mistake, name: str, field: FieldInfo | None) -> str:
    if isinstance(mistake.path[-1], int):
        return f"{name}: a value is missing in the list{_say_example(field)}"
    return f"{name} is missing{_say_description(field)}{_say_example(field)}"


def _say_unknown(mistake: Mistake, model: type[BaseModel], within: str, also_known: Collection[str]) -> str:
    *group, key = map(str, mistake.path)
    part = find_model_at(model, mistake.path[:-1])
    known = list(list_keys_in(part)) if part else []
    if not group:
        known.extend(also_known)
    where = _write_dotted(within, tuple(group))
    if key.isdecimal():
        return f"{where or 'here'}: a comma parts keys, and {key} is none; write a decimal point"
    space = next((each for each in key if each.isspace() and each != " "), None)
    if space:
        return f"unknown key {quoted(key)}; {describe_character(space)} stands where a space belongs"
    is_mistyped = difflib.get_close_matches(key.casefold(), known, n=1, cutoff=_MISTYPED)
    homes = [] if within or is_mistyped else _find_homes(key, model)
    advice = f"it is a key of {list_names(homes, 'or of')}" if homes else did_you_mean(key, known)
    return f"unknown key {quoted(key)}{f' in {where}' if where else ''}; {advice}"


def _find_homes(key: str, model: type[BaseModel]) -> list[str]:
    """Return the groups, dotted, that have a key of this name; none where it stands in many."""
    level = {"": model}
    while level:
        groups = {
            f"{group}.{name}".lstrip("."): part
            for group, above in level.items()
            for name, field in list_keys_in(above).items()
            if name not in _LIKE_THE_MEASUREMENT and (part := find_part(field.annotation))
        }
        homes = [group for group, part in groups.items() if key in list_keys_in(part)]
        if homes or len(next(iter(groups), "").split(".")) >= _DEEPEST_HOME:
            return homes if len(homes) <= _MOST_HOMES else []
        level = groups
    return []


def _say_unfit(mistake: Mistake, model: type[BaseModel], name: str, field: FieldInfo | None) -> str:
    spoken = [str(refusal.context["error"]) for refusal in mistake.refusals if refusal.kind in _SPOKEN_KINDS]
    prefix = f"{name}: " if name else ""
    node = mistake.node
    if spoken:
        return f"{prefix}{spoken[0]}"
    if mistake.kinds & _CHOICE_KINDS and isinstance(node, Scalar) and not node.is_nothing:
        refusals = (refusal for refusal in mistake.refusals if refusal.kind in _CHOICE_KINDS)
        choices = [choice for refusal in refusals for choice in _list_choices(refusal, field)]
        return f"{prefix}{quoted(node.text)} is unknown; {did_you_mean(node.text, choices)}"
    expected = " or ".join(dict.fromkeys(_say_expectation(refusal, field) for refusal in mistake.refusals))
    hint = _say_hint(node) or _say_keys_hint(model, mistake) or _say_example(field)
    if isinstance(node, Scalar) and node.is_nothing:
        return f"{name} has no value; {expected} is expected{hint.replace('; for', ', for')}"
    return f"{prefix}{show_value(node)} is not {expected}{hint}"


def _say_expectation(refusal: Refusal, field: FieldInfo | None) -> str:
    if refusal.kind in _CHOICE_KINDS:
        return f"one of {', '.join(_list_choices(refusal, field))}"
    if refusal.kind in _EXPECTED_SIZES:
        return _EXPECTED_SIZES[refusal.kind](refusal.context)
    return _EXPECTED_KINDS.get(refusal.kind, f"what is expected{_say_description(field)}")


def _list_choices(refusal: Refusal, field: FieldInfo | None) -> list[str]:
    listed = list_choices_in(field.annotation) if field else []
    return listed or re.split(r", | or ", str(refusal.context.get("expected", "")).replace("'", ""))


def _say_hint(node: Node | None) -> str:
    """Say how a number is written that is almost one."""
    if not isinstance(node, Scalar):
        return ""
    point = replace_decimal_comma(node.text)
    if point:
        return f"; write a decimal point: {point}"
    unit = _NUMBER_AND_UNIT.fullmatch(node.text)
    return f"; write the number without its unit: {unit[1]}" if unit else ""


def _say_keys_hint(model: type[BaseModel], mistake: Mistake) -> str:
    """Name the keys of the group that a value should have been."""
    part = find_model_at(model, mistake.path)
    if part is None or isinstance(mistake.node, Keys):
        return ""
    return f"; its keys are {', '.join(list_keys_in(part))}"


def _say_description(field: FieldInfo | None) -> str:
    """Return a key's description as the end of a sentence."""
    if not field or not field.description:
        return ""
    first, rest = field.description[:1], field.description[1:].rstrip(".")
    return f": {first if rest[:1].isupper() else first.lower()}{rest}"


def _say_example(field: FieldInfo | None) -> str:
    return f"; for example {_write_as_in_a_job(field.examples[0])}" if field and field.examples else ""


def _write_as_in_a_job(example: Any) -> str:
    """Write an example as it would stand in a job."""
    if isinstance(example, dict):
        return f"{{{', '.join(f'{key}: {_write_as_in_a_job(value)}' for key, value in example.items())}}}"
    if isinstance(example, list):
        return f"[{', '.join(map(_write_as_in_a_job, example))}]"
    return str(example).lower() if isinstance(example, bool) else str(example)


def show_value(node: Node | None) -> str:
    """Return a value as a message shows it."""
    if isinstance(node, Keys):
        return "a group of keys"
    if isinstance(node, Items):
        return f"a list of {count_in_words(len(node.items), 'value')}"
    return quoted(node.text) if node else "this"
