"""The commands as their parsers describe them.

The texts are set from the parsers' parts and not from ``--help``, which Python's releases print differently.
"""

from __future__ import annotations

import argparse
from collections.abc import Iterator

from markdown import code, table

from zlmreport.cli import arguments


def text() -> str:
    """Return a section for each command."""
    return "\n\n".join(part for parser in arguments.make_parsers() for part in _section(parser))


def arguments_of(parser: argparse.ArgumentParser) -> list[tuple[str, str]]:
    """Return the arguments of a command that have a help, and what each means."""
    return [(_name(action), _meaning(action)) for action in _actions(parser)]


def _actions(parser: argparse.ArgumentParser) -> list[argparse.Action]:
    return [action for action in parser._actions if action.help]  # noqa: SLF001 - argparse has no other list


def _section(parser: argparse.ArgumentParser) -> Iterator[str]:
    positional = [action for action in _actions(parser) if not action.option_strings]
    named = "".join(f" {_name(action)}" for action in positional)
    yield f"## `{parser.prog}{named}`"
    yield _as_printed(parser.description)
    yield table(("Argument", "Meaning"), ((code(name), meaning) for name, meaning in arguments_of(parser)))
    if parser.epilog:
        yield _as_printed(parser.epilog)


def _name(action: argparse.Action) -> str:
    value = f" {action.metavar}" if action.metavar and action.option_strings else ""
    name = ", ".join(action.option_strings) or str(action.metavar)
    return f"{name}{value}{' …' if action.nargs == '+' else ''}"


def _meaning(action: argparse.Action) -> str:
    return str(action.help).replace("show program's version number and exit", "print the version")


def _as_printed(text: str | None) -> str:
    return f"```text\n{(text or '').strip()}\n```"
