"""Frozen data classes whose methods are written when they are first called.

`dataclasses.dataclass` writes seven methods of each class and compiles them at once: a millisecond a class. A
command loads a hundred and fifty classes, makes objects of half of them, and compares hardly any.
"""

from __future__ import annotations

import dataclasses
from dataclasses import MISSING, Field, FrozenInstanceError
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Callable
    from dataclasses import dataclass
    from typing import Any, Literal

__all__ = ["dataclass"]


def _deferred(cls: type) -> type:
    """Return a class with the slots of its fields, and with what a frozen data class has besides, on use."""
    namespace = {name: value for name, value in vars(cls).items() if name not in {"__dict__", "__weakref__"}}
    inherited = {name for base in cls.__mro__[1:] for name in vars(base).get("__slots__", ())}
    own = {
        name: namespace.pop(name, MISSING)
        for name, annotation in cls.__annotations__.items()
        if not str(annotation).startswith("ClassVar")
    }
    slots = tuple(name for name in own if name not in inherited)
    whole = {name: _OnUse(write) for name, write in _ON_USE.items()}
    if namespace.get("__hash__", MISSING) is None:  # as Python has it where only __eq__ is written
        del namespace["__hash__"]
    namespace |= {"__qualname__": cls.__qualname__, "__slots__": slots, "_own": own}
    return type(cls)(cls.__name__, cls.__bases__, {**_AT_ONCE, **whole, **namespace})


if not TYPE_CHECKING:

    def dataclass(*, frozen: Literal[True], slots: Literal[True]) -> Callable[[type], type]:  # noqa: ARG001
        """Return the decorator of a frozen data class with slots: what `dataclasses.dataclass` makes, on use.

        Fields have a default, a `field` or neither, in the order in which they can be given; `InitVar` is not
        known. The keywords are there to be read.
        """
        return _deferred


class _OnUse:
    """What a class gets when it is first asked for it."""

    def __init__(self, write: Callable[[type], Any]) -> None:
        self._write = write

    def __set_name__(self, owner: type, name: str) -> None:
        self._owner, self._name = owner, name

    def __get__(self, instance: object, owner: type | None = None) -> Any:
        """Write it, put it in this one's place, and return it as the class or the object has it."""
        written = self._write(self._owner)
        setattr(self._owner, self._name, written)
        bind = getattr(written, "__get__", None)
        return bind(instance, owner) if bind else written


def _fields(cls: type) -> dict[str, Any]:
    """Return defaults, `Field` objects, or `MISSING` by the names of fields, those of the bases first."""
    own = [vars(base).get("_own", {}) for base in reversed(cls.__mro__)]
    return {name: stated for of_one in own for name, stated in of_one.items()}


def _written(cls: type, name: str, parameters: str, lines: list[str], known: dict[str, Any]) -> Any:
    """Return a method of text."""
    exec(f"def {name}({parameters}):\n " + "\n ".join(lines), known)  # noqa: S102 - of names of fields
    known[name].__qualname__ = f"{cls.__qualname__}.{name}"  # messages have it
    return known[name]


def _initialiser(cls: type) -> Any:
    known: dict[str, Any] = {"_put": object.__setattr__, "_nothing": MISSING}
    parameters, lines = ["self"], []
    for name, stated in _fields(cls).items():
        usual, made = (
            (stated.default, stated.default_factory) if isinstance(stated, Field) else (stated, MISSING)
        )
        known |= {f"_usual_{name}": usual, f"_made_{name}": made}
        if made is not MISSING:
            parameters.append(f"{name}=_nothing")
            lines.append(f"_put(self, {name!r}, _made_{name}() if {name} is _nothing else {name})")
        else:
            parameters.append(name if usual is MISSING else f"{name}=_usual_{name}")
            lines.append(f"_put(self, {name!r}, {name})")
    if hasattr(cls, "__post_init__"):
        lines.append("self.__post_init__()")
    return _written(cls, "__init__", ", ".join(parameters), lines or ["pass"], known)


def _shown(cls: type, part: str) -> list[str]:
    """Return the names of the fields that take part: in what is compared (`compare`), or printed (`repr`)."""
    return [
        name
        for name, stated in _fields(cls).items()
        if not isinstance(stated, Field) or getattr(stated, part) is not False
    ]


def _all(cls: type, of: str) -> str:
    """Return, as text, the tuple by which an object is compared."""
    return f"({''.join(f'{of}.{name}, ' for name in _shown(cls, 'compare'))})"


def _equality(cls: type) -> Any:
    same = f"{_all(cls, 'self')} == {_all(cls, 'other')}"
    line = f"return {same} if other.__class__ is self.__class__ else NotImplemented"
    return _written(cls, "__eq__", "self, other", [line], {})


def _hashing(cls: type) -> Any:
    return _written(cls, "__hash__", "self", [f"return hash({_all(cls, 'self')})"], {})


def _representation(self: object) -> str:
    values = ", ".join(f"{name}={getattr(self, name)!r}" for name in _shown(type(self), "repr"))
    return f"{type(self).__qualname__}({values})"


def _refused(self: object, name: str, *value: object) -> None:
    """Refuse to set or delete a field; a class of someone else that builds on this one can have more."""
    cls = type(self)
    if "_own" in vars(cls) or name in _fields(cls):
        raise FrozenInstanceError(f"cannot {'assign to' if value else 'delete'} field {name!r}")
    (object.__setattr__ if value else object.__delattr__)(self, name, *value)


def _state(self: object) -> list[Any]:
    return [getattr(self, name) for name in _fields(type(self))]


def _set_state(self: object, state: list[Any]) -> None:
    for name, value in zip(_fields(type(self)), state, strict=True):
        object.__setattr__(self, name, value)


def _standard(cls: type, *, frozen: bool) -> Any:
    """Return a class of the same fields by the standard library, whose functions look at what it has."""
    bases = [base for base in reversed(cls.__mro__) if "_own" in vars(base)]
    annotations = {name: base.__annotations__[name] for base in bases for name in vars(base)["_own"]}
    stated = {name: value for name, value in _fields(cls).items() if value is not MISSING}
    bare = type(cls.__name__, (), {"__annotations__": annotations, "__doc__": cls.__doc__, **stated})
    return dataclasses.dataclass(init=False, repr=False, eq=False, frozen=frozen)(bare)


_AT_ONCE: dict[str, Any] = {
    "__repr__": _representation,
    "__setattr__": _refused,
    "__delattr__": _refused,
    "__getstate__": _state,
    "__setstate__": _set_state,
}
_ON_USE: dict[str, Callable[[type], Any]] = {
    "__init__": _initialiser,
    "__eq__": _equality,
    "__hash__": _hashing,
    "__match_args__": lambda cls: tuple(_fields(cls)),
    "__dataclass_fields__": lambda cls: _standard(cls, frozen=False).__dataclass_fields__,
    "__dataclass_params__": lambda cls: _standard(cls, frozen=True).__dataclass_params__,
}
