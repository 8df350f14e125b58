"""Calls into plugins: whatever one raises or answers wrongly becomes one message that names it.

A plugin is a program of somebody else's. Whatever it raises and whatever it answers that it must not becomes
one message which names the plugin, its distribution, and what was asked of it; the job is named by who knows
it (`zlmreport.errors.as_problems`). What a plugin is handed it cannot alter.
"""

from __future__ import annotations

import inspect
import sys
import traceback
from collections.abc import Callable, Iterator
from dataclasses import replace
from functools import partial
from importlib import import_module
from pathlib import Path
from typing import Any, Self

from zlmreport.errors import NOWHERE, PluginError, Problem, ZlmreportError
from zlmreport.plugin.kinds import EXTENSION, Kind
from zlmreport.presence import PRESENCE

#: What is no fault of a plugin: the user's mistake that it tells of, the user's stop, too little memory.
_PASSED = (ZlmreportError, KeyboardInterrupt, MemoryError)
#: Plugins of these kinds open files, ports and libraries, which may not be there.
_OPENING = frozenset({"source", "renderer", "instrument", "extension"})
#: Kinds whose answers are checked by one module.
_OUTWARD = frozenset({"renderer", "part_program", "notifier", "instrument"})
_LONGEST = 300
_NOTHING = object()


class Unacceptable(Exception):  # noqa: N818 - it ends in the call that met it, and is nobody's error
    """An answer that a plugin must not give; the message ends the sentence "arithmetic …"."""


class Guarded:
    """An object of a plugin, as the core has it: the same attributes, and methods that are looked after.

    `who`: What messages call it: ``standard 'house' of plugin house (zlmreport-house 1.0)``.
    """

    def __init__(self, kind: Kind[Any], offered: Any, who: str) -> None:
        self._kind = kind
        self._offered = offered
        self._who = who

    @property  # type: ignore[misc]  # as weak references and mocks do it: who asks what it is means the object
    def __class__(self) -> type:
        return type(self._offered)

    def __getattr__(self, name: str) -> Any:
        """Return what the object has under this name; what can be called is guarded, and kept."""
        if name.startswith("__") or name in {"_kind", "_offered", "_who"}:
            raise AttributeError(name)  # of an interpreter that copies it, or looks into it
        try:
            found = getattr(self._offered, name)
        except AttributeError:
            raise
        except BaseException as error:
            self._tell(name, error)
            raise
        if name == "commands" and self._kind is EXTENSION:
            return tuple(
                replace(each, run=self.look_after(f"command {each.words}", each.run)) for each in found
            )
        # Whether it can be called is quickly asked, and mostly settles it.
        if not callable(found) or not inspect.isroutine(found):
            return found
        # The checks of answers load what a listing of names, or a plugin of another kind, does not need.
        module = "outward" if self._kind.name in _OUTWARD else self._kind.name
        accept = import_module(f"zlmreport.plugin.boundary.answers.{module}").ACCEPTED.get(name)
        method = self.__dict__[name] = self.look_after(name, found, accept)
        return method

    def __eq__(self, other: object) -> bool:
        return bool(self._offered == (other._offered if isinstance(other, Guarded) else other))

    def __hash__(self) -> int:
        return hash(self._offered)

    def __repr__(self) -> str:
        return repr(self._offered)

    def guard_as(self, kind: type[Guarded]) -> Any:
        """Return the same object as another kind of guard has it."""
        return kind(self._kind, self._offered, self._who)

    def guard_another(self, offered: Any) -> Any:
        """Return another object of the same kind and plugin, guarded too; this one, if it is this one."""
        return self if offered is self._offered else Guarded(self._kind, offered, self._who)

    def guard_connection(self, connection: Any) -> Any:
        """Return an open instrument, guarded too."""
        return _GuardedConnection(self._kind, connection, self._who)

    def look_after(
        self, name: str, method: Callable[..., Any], accept: Callable[..., Any] | None = None
    ) -> Callable[..., Any]:
        """Return a function of the plugin that is looked after.

        `accept`: Takes this object, the answer and what was asked, and returns what is handed on; raises
            `Unacceptable` for what no plugin must answer.
        """
        return partial(self._ask, name, method, accept)

    def _ask(
        self,
        name: str,
        method: Callable[..., Any],
        accept: Callable[..., Any] | None,
        /,
        *arguments: Any,
        **keywords: Any,
    ) -> Any:
        """Return an answer; whatever is raised instead becomes one message."""
        before, wrong = PRESENCE.begin(f"{self._who}: {name}"), ""
        try:
            try:
                answer = method(*arguments, **keywords)
                return answer if accept is None else accept(self, answer, *arguments, **keywords)
            finally:
                wrong = PRESENCE.end(before)
                if wrong:
                    raise Unacceptable(wrong)
        except BaseException as error:
            self._tell(name, error)
            raise

    def _tell(self, asked: str, error: BaseException) -> None:
        """Raise the error that tells of another one, unless that is no fault of the plugin."""
        if isinstance(error, _PASSED) or (isinstance(error, OSError) and self._kind.name in _OPENING):
            return
        sentence = str(error) if isinstance(error, Unacceptable) else tell_failure(error, self._offered)
        raise PluginError([Problem(NOWHERE, f"{self._who}: {asked} {sentence}")]) from error


class _GuardedConnection(Guarded):
    """An open instrument."""

    def __enter__(self) -> Self:
        self._ask("open", self._offered.__enter__, None)
        return self

    def __exit__(self, *raised: object) -> None:
        self._ask("open", self._offered.__exit__, None, *raised)

    def readings(self) -> Iterator[Any]:
        """Yield what the instrument yields."""
        readings = self._ask("readings", lambda: iter(self._offered.readings()), None)
        while (reading := self._ask("readings", next, None, readings, _NOTHING)) is not _NOTHING:
            yield reading


def guard(kind: Kind[Any], offered: Any, by: str) -> Any:
    """Return an object of a plugin behind the boundary; it stands wherever the object would.

    `by`: Where it comes from: ``plugin house (zlmreport-house 1.0)``.
    """
    return Guarded(kind, offered, f"{kind.label} {offered.identifier!r} of {by}")


def tell_failure(error: BaseException, offered: object) -> str:
    """Return what a plugin raised, with the innermost line that is its own."""
    message = " ".join(str(error).split())[:_LONGEST]
    frames = traceback.extract_tb(error.__traceback__)
    module = sys.modules.get(type(offered).__module__)
    own = str(Path(getattr(module, "__file__", None) or "-").parent)
    frame = next((each for each in reversed(frames) if each.filename.startswith(own)), frames[-1])
    where = f"({Path(frame.filename).name}, line {frame.lineno})"
    return f"raised {type(error).__name__}{f': {message}' if message else ''} {where}"
