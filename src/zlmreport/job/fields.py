"""What a model of keys says of a key: for messages that name the keys there are, and show an example."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from enum import Enum
from types import UnionType
from typing import Annotated, Any, Literal, Union, get_args, get_origin

from pydantic import BaseModel
from pydantic.fields import FieldInfo

from zlmreport.job.tree import Step


def keys_in(model: type[BaseModel]) -> dict[str, FieldInfo]:
    """Return the keys that a model knows, as they are written in a job."""
    return {info.alias or name: info for name, info in model.model_fields.items()}


def field_at(model: type[BaseModel], path: Iterable[Step]) -> FieldInfo | None:
    """Return what the model says of the last key in a path; of a list's item, what it says of the list."""
    annotation: Any = model
    found = None
    for step in path:
        part = model_in(annotation)
        if part and isinstance(step, str):
            found = keys_in(part).get(step)
            annotation = found.annotation if found else None
        else:
            annotation = _item(annotation, step)
    return found


def model_at(model: type[BaseModel], path: Iterable[Step]) -> type[BaseModel] | None:
    """Return the model of the group of keys at a path."""
    annotation: Any = model
    for step in path:
        part = model_in(annotation)
        field = keys_in(part).get(step) if part and isinstance(step, str) else None
        annotation = field.annotation if field else _item(annotation, step)
    return model_in(annotation)


def model_in(annotation: Any) -> type[BaseModel] | None:
    """Return the model among the alternatives of an annotation."""
    for alternative in _alternatives(annotation):
        if isinstance(alternative, type) and issubclass(alternative, BaseModel):
            return alternative
    return None


def choices_in(annotation: Any) -> list[str]:
    """Return the values of an annotation that lists them."""
    found: list[str] = []
    for alternative in _alternatives(annotation):
        if isinstance(alternative, type) and issubclass(alternative, Enum):
            found.extend(str(member.value) for member in alternative)
        elif get_origin(alternative) is Literal:
            found.extend(map(str, get_args(alternative)))
    return found


def _item(annotation: Any, step: Step) -> Any:
    """Return the annotation of a list's items, or of a mapping's values."""
    for alternative in _alternatives(annotation):
        origin, arguments = get_origin(alternative), get_args(alternative)
        if not isinstance(origin, type) or not arguments:
            continue
        if isinstance(step, int) and issubclass(origin, Sequence):
            return arguments[0]
        if isinstance(step, str) and issubclass(origin, Mapping):
            return arguments[1]
    return None


def _alternatives(annotation: Any) -> Iterator[Any]:
    """Yield what an annotation stands for: `Annotated` opened, unions taken apart."""
    origin, arguments = get_origin(annotation), get_args(annotation)
    if origin is Annotated:
        yield from _alternatives(arguments[0])
    elif origin in {Union, UnionType}:
        for argument in arguments:
            yield from _alternatives(argument)
    else:
        yield annotation
