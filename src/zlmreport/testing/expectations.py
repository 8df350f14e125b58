"""How a check of the conformance kit fails: `expect`, and its messages."""

from __future__ import annotations

import functools
import re
import threading
from collections.abc import Callable, Iterable, Mapping
from dataclasses import fields, is_dataclass
from typing import Any

import numpy as np

from zlmreport.errors import PluginError, ZlmreportError
from zlmreport.job.types import Options
from zlmreport.language import Language, Words
from zlmreport.plugin.boundary import Guarded, tell_failure
from zlmreport.plugin.kinds import Kind

#: How long a check may take, s: on a busy computer a renderer of pages needs some of them.
PATIENCE = 120.0

_IDENTIFIER = re.compile(r"[a-z0-9]+([-.:][a-z0-9]+)*")
_SUFFIX = re.compile(r"\.[a-z0-9]+(\.[a-z0-9]+)*")
_MADE_IN: dict[str, list[Callable[..., None]]] = {}


def expect(condition: object, sentence: str) -> None:
    """Raise an `AssertionError` with the sentence unless the condition holds."""
    if not condition:
        raise AssertionError(sentence)


def check(body: Callable[..., None]) -> Callable[..., None]:
    """Make a check of what says in its body what it expects of a plugin, which is its first argument.

    Whatever the plugin raises is a sentence then, and one that never comes back fails too: so no check ends
    the others.
    """

    @functools.wraps(body)
    def checked(*subject: Any, **keywords: Any) -> None:
        raised: list[BaseException] = []

        def run() -> None:
            try:
                body(*subject, **keywords)
            except BaseException as error:  # noqa: BLE001 - it is raised again below
                raised.append(error)

        thread = threading.Thread(target=run, daemon=True)
        thread.start()
        thread.join(PATIENCE)
        name = getattr(subject[0], "identifier", subject[0])
        expect(not thread.is_alive(), f"{name}: does not come back within {PATIENCE:g} s")
        for error in raised:
            if isinstance(error, AssertionError):
                raise error
            if isinstance(error, PluginError):
                sentence = error.problems[0].message  # it names the plugin
            elif isinstance(error, ZlmreportError):
                sentence = f"{name}: {error}"
            else:
                sentence = f"{name}: {tell_failure(error, subject[0])}"
            raise AssertionError(sentence) from error

    _MADE_IN.setdefault(body.__module__, []).append(checked)
    return checked


def list_checks_of(module: str) -> tuple[Callable[..., None], ...]:
    """Return every check that a module makes, in their order there: none can be left out."""
    return tuple(_MADE_IN[module])


@check
def expect_members(offered: object, kind: Kind[Any]) -> None:
    """Expect that an object has every member that is asked of its kind."""
    missing = [name for name in kind.members if not hasattr(offered, name)]
    where = f"zlmreport.plugin.{kind.door}.{kind.interface}"
    expect(not missing, f"{offered!r} has no {', '.join(missing)} (see {where})")


def run_all(kind: Kind[Any], checks: Iterable[Callable[..., None]], *subject: object) -> None:
    """Run every check on the subject; raise one `AssertionError` with the sentences of all that fail.

    Where a member that its kind has is missing, that alone is said; what several checks say, once.
    """
    expect_members(subject[0], kind)
    failures: dict[str, str] = {}
    for check in checks:
        try:
            check(*subject)
        except AssertionError as failure:
            said = str(failure)
            failures[check.__name__] = f"as {before}" if (before := _find_key(failures, said)) else said
    expect(not failures, "\n".join(f"{name}: {said}" for name, said in failures.items()))


def _find_key(failures: Mapping[str, str], said: str) -> str:
    return next((name for name, sentence in failures.items() if sentence == said), "")


def guard_subject(subject: Any, kind: Kind[Any]) -> Any:
    """Return it as the program has it: an answer that it must not give fails in the same words."""
    return Guarded(kind, subject, subject.identifier)


def expect_identifier(identifier: object, owner: str) -> None:
    """Expect a name that can be typed into a job: lower-case ASCII words joined by ``-``, ``.`` or ``:``."""
    expect(
        isinstance(identifier, str) and _IDENTIFIER.fullmatch(identifier),
        f"{owner}: identifier {identifier!r} must be lower-case ASCII letters and digits, "
        "joined by '-', '.' or ':', as 'iso230-2:2014' is",
    )


def expect_words(words: object, owner: str) -> None:
    """Expect a phrase that says something in every language, with all its places filled."""
    expect(isinstance(words, Words), f"{owner} must be Words(…), not {words!r}")
    unfilled = ", ".join(f"{name}=…" for name in words.list_unfilled())  # type: ignore[attr-defined]  # said above
    expect(not unfilled, f"{owner} has places without a value; say Words(…).given({unfilled})")
    for language in Language:
        try:
            text = words.in_language(language)  # type: ignore[attr-defined]  # said above
        except (KeyError, IndexError, ValueError) as error:
            message = f"{owner} cannot be written in '{language}': place {error} has no value"
            raise AssertionError(message) from error
        expect(text.strip(), f"{owner} says nothing in '{language}'")


def expect_named(plugin: Any, kind: Kind[Any]) -> None:
    """Expect every member of its kind, a name that can be typed, a title in every language, and a suffix.

    The suffix is asked of what writes files.
    """
    expect_members(plugin, kind)
    expect_identifier(plugin.identifier, repr(plugin))
    expect_words(plugin.title, f"{plugin.identifier}: title")
    expect(
        not kind.suffix or _SUFFIX.fullmatch(plugin.suffix),
        f"{plugin.identifier}: suffix {getattr(plugin, 'suffix', '')!r} must be like {kind.suffix!r}",
    )


def expect_options(plugin: Any, kind: Kind[Any]) -> None:
    """Expect job keys that are all described, and none that every plugin of the kind has."""
    options, owner = plugin.options, plugin.identifier
    expect(
        isinstance(options, type) and issubclass(options, Options),
        f"{owner}: options must be a subclass of zlmreport.plugin.Options, not {options!r}",
    )
    for key, field in options.model_fields.items():
        expect(field.description, f"{owner}: job key '{key}' needs a description (Field(description=…))")
    clashes = sorted(kind.reserved & set(options.model_fields))
    expect(not clashes, f"{owner}: job keys {', '.join(clashes)} belong to the core; choose other names")


def is_same_value(one: Any, other: Any) -> bool:
    """Return whether two results are alike to the last bit, arrays and NaN included."""
    if is_dataclass(one):
        return type(one) is type(other) and all(
            is_same_value(getattr(one, field.name), getattr(other, field.name)) for field in fields(one)
        )
    if isinstance(one, tuple | list):
        return len(one) == len(other) and all(map(is_same_value, one, other))
    if isinstance(one, dict):
        return one.keys() == other.keys() and all(is_same_value(one[key], other[key]) for key in one)
    if isinstance(one, float | np.ndarray):
        return bool(np.array_equal(one, other, equal_nan=np.asarray(one).dtype.kind == "f"))
    return bool(one == other)
