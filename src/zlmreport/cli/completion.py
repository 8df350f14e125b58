"""Completion by the Tab key of a shell: commands, options, names of plugins, files."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Sequence
from typing import Any

from zlmreport.cli.arguments import COMMANDS, make_parser_for
from zlmreport.cli.arguments.documents import MACHINE_ACTIONS, MODEL_ACTIONS
from zlmreport.cli.new import GUIDES
from zlmreport.plugin.kinds import CIRCLE_EFFECT, CONTROLLER, EFFECT, INSTRUMENT, RENDERER, Kind
from zlmreport.plugin.registry import find_plugins

_LINE, _POINT = "COMP_LINE", "COMP_POINT"
#: The words that the first argument of a command is one of.
_WORDS = {"model": MODEL_ACTIONS, "machine": MACHINE_ACTIONS, "new": GUIDES}
#: The plugins whose identifiers an argument takes; an effect of a machine is one of circles.
_PLUGINS = {"format": RENDERER, "controller": CONTROLLER, "effect": EFFECT, "instrument": INSTRUMENT}
_OF_MACHINES = {**_PLUGINS, "effect": CIRCLE_EFFECT}


def complete() -> None:
    """Print what may follow, and end the program; without the extra ``completion``, nothing."""
    try:
        import argcomplete  # noqa: PLC0415 (an extra)
        from argcomplete.completers import FilesCompleter  # noqa: PLC0415
    except ModuleNotFoundError:
        raise SystemExit(1) from None
    line = os.environ[_LINE].encode()[: int(os.environ[_POINT])].decode(errors="ignore")
    program, *words = line.split(" ")
    command, rest = _split_command(words)
    parser = make_parser_for(command)
    actions: list[Any] = parser._actions  # noqa: SLF001 - argparse has no other list
    positional = [action for action in actions if not action.option_strings]
    plugins = _OF_MACHINES if command == "machine" else _PLUGINS
    for action in actions:
        if action.dest in plugins:
            action.completer = _complete_identifiers(plugins[action.dest])
        elif action.dest in {"action", "kind"}:
            action.choices = tuple(_WORDS[command])
        elif positional and action is positional[0] and action.choices is None:
            further = _list_further_words(command) if rest == rest[-1:] else ()
            action.completer = _complete_files_or(further, FilesCompleter())
    os.environ[_LINE] = " ".join((program, *rest))
    os.environ[_POINT] = str(len(os.environ[_LINE].encode()))
    argcomplete.autocomplete(parser, always_complete_options=False)


def _split_command(words: Sequence[str]) -> tuple[str, list[str]]:
    """Return the command of which all words are written, and the words after it, the last as yet unended."""
    for length in (2, 1):
        command = " ".join(words[:length])
        if length < len(words) and command in COMMANDS:
            return command, list(words[length:])
    return "", list(words)


def _list_further_words(command: str) -> list[str]:
    """Return the words that make another command of this one."""
    begun = f"{command} ".lstrip()
    return sorted({name.removeprefix(begun).split(" ")[0] for name in COMMANDS if name.startswith(begun)})


def _complete_identifiers(kind: Kind[Any]) -> Callable[..., Iterable[str]]:
    def complete_begun(prefix: str, **_: object) -> Iterable[str]:
        begun, comma, _last = prefix.rpartition(",")  # of a list, such as that of the formats
        return [f"{begun}{comma}{identifier}" for identifier in find_plugins().list_identifiers(kind)]

    return complete_begun


def _complete_files_or(words: Iterable[str], files: Callable[..., Iterable[str]]) -> Callable[..., list[str]]:
    def complete_begun(prefix: str, **others: object) -> list[str]:
        return [*(word for word in words if word.startswith(prefix)), *files(prefix=prefix, **others)]

    return complete_begun
