"""The examples of a page, executed from top to bottom in one folder, as a reader would.

What a fenced block is, its first word says; a second word names a file:

``yaml NAME``, ``csv NAME``, ``python NAME`` and so on
    The block is saved under that name.
``diff NAME``
    Lines with ``-`` are replaced by those with ``+`` in the file of that name; lines with a blank say where.
``console``
    Lines with ``$`` are typed into a shell, and so are those with ``>`` that go on with a command. What
    follows is what it prints; ``…`` stands for any text, and in a line of its own for any lines. A command
    that fails is followed by ``$ echo $?``.
``python``
    Is run.
``yaml``
    Is a part of a job: it is put under a whole job and loaded.
``json``
    Is read.
``sh``, ``text``
    Are only shown: commands that install or take long, and schemes.
"""

from __future__ import annotations

import json
import re
import shutil
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import TypeAlias

from documents.pages import DOCS, ROOT, Block, blocks
from documents.shell import Shell, shell as opened
from processes import PYTHON, run
from zlmreport import ZlmreportError

ELLIPSIS = "…"
_SHOWN = {"sh", "text", "toml"}
_BASE = Path(__file__).with_name("base.yaml")
_ELSEWHERE = {DOCS / "how-to" / "add-a-standard.md"}  # its examples have a test of their own

#: What is done with a console block in a shell.
Console: TypeAlias = Callable[[Block, Shell], None]

#: The pages whose examples are executed.
EXECUTED = [
    ROOT / "README.md",
    *sorted(
        {*DOCS.glob("tutorial/*.md"), *DOCS.glob("how-to/*.md"), *DOCS.glob("explanation/*.md")} - _ELSEWHERE
    ),
    *sorted(DOCS.glob("reference/*.md")),
]


@dataclass(slots=True)
class Command:
    """A command line of a console block, and what it is said to print."""

    place: str
    text: str
    expected: list[str]


def compare(block: Block, shell: Shell) -> None:
    """Type the commands of a console block, and compare what they print with what the page says."""
    for command, printed, status in typed(block, shell):
        if command.expected or status:
            assert matches(command.expected, printed), (
                f"{command.place}: {command.text}\nsaid to print:\n"
                + "\n".join(command.expected)
                + f"\nprinted:\n{printed}"
            )


def run_page(page: Path, folder: Path, console: Console = compare, *commands: Path) -> None:
    """Execute every example of a page in a folder; commands are found in those folders first."""
    shutil.copytree(ROOT / "configs", folder / "configs")
    page_blocks = blocks(page)
    with opened(folder, *commands) as shell:
        for block in page_blocks:
            run_block(block, folder, shell, console)


def commands(block: Block) -> Iterator[Command]:
    """Yield the commands of a console block."""
    command: Command | None = None
    for number, line in enumerate(block.text.splitlines(), block.line + 1):
        if line.startswith("$ "):
            if command:
                yield command
            place = f"{block.page.relative_to(ROOT)}:{number}"
            command = Command(place, line.removeprefix("$ "), [])
        else:
            assert command, f"{block.place}: a console block begins with '$ ' and a command"
            if line.startswith("> ") and not command.expected:
                command.text = f"{command.text}\n{line.removeprefix('> ')}"
            else:
                command.expected.append(line)
    if command:
        yield command


def typed(block: Block, shell: Shell) -> Iterator[tuple[Command, str, int]]:
    """Type the commands of a console block; yield each with what it prints and its exit status.

    One that fails must be followed by a look at the exit status.
    """
    listed = list(commands(block))
    for number, command in enumerate(listed):
        printed, status = shell.run(command.text)
        yield command, printed, status
        shown = number + 1 < len(listed) and listed[number + 1].text == "echo $?"
        assert status == 0 or shown, f"{command.place}: {command.text} fails ({status}):\n{printed}"


def matches(expected: list[str], printed: str) -> bool:
    """Return whether a command printed what the page says."""
    pattern = ""
    for line in expected:
        if line.strip() == ELLIPSIS:
            pattern += r"(?:.*\n)*"
        else:
            pattern += ".*".join(map(re.escape, line.split(ELLIPSIS))) + r"\n"
    return re.fullmatch(pattern, "".join(f"{line.rstrip()}\n" for line in printed.splitlines())) is not None


def patched(block: Block, text: str) -> str:
    """Return a file's text with the change of a diff block made."""
    lines = block.text.splitlines()
    assert all(line[:1] in {" ", "+", "-", ""} for line in lines), f"{block.place}: not a change"
    old = "".join(f"{line[1:]}\n" for line in lines if not line.startswith("+"))
    new = "".join(f"{line[1:]}\n" for line in lines if not line.startswith("-"))
    assert f"\n{text}".count(f"\n{old}") == 1, f"{block.place}: these lines are not there once in:\n{text}"
    return f"\n{text}".replace(f"\n{old}", f"\n{new}", 1).removeprefix("\n")


def run_block(block: Block, folder: Path, shell: Shell, console: Console = compare) -> None:
    if block.language == "console":
        console(block, shell)
    elif block.language == "diff":
        path = _current(shell) / block.file
        path.write_text(patched(block, path.read_text(encoding="utf-8")), encoding="utf-8")
    elif block.file:
        (_current(shell) / block.file).write_text(block.text, encoding="utf-8")
    elif block.language == "yaml":
        _load_part(block, folder)
    elif block.language == "python":
        _run_python(block, _current(shell))
    elif block.language == "json":
        json.loads(block.text)
    else:
        assert block.language in _SHOWN, f"{block.place}: nobody checks a block of {block.language!r}"


def _current(shell: Shell) -> Path:
    """Return the folder into which the commands so far have led."""
    return Path(shell.run("pwd")[0].strip())


def _run_python(block: Block, folder: Path) -> None:
    done = run(PYTHON, "-W", "error", "-c", block.text, cwd=folder)
    assert done.returncode == 0, f"{block.place}:\n{done.stdout}{done.stderr}"


def _load_part(block: Block, folder: Path) -> None:
    from zlmreport.job.loading import load
    from zlmreport.plugin.registry import find_plugins

    shutil.copy(_BASE, folder / "whole.yaml")
    part = folder / "part.yaml"
    part.write_text(f"extends: whole.yaml\n{block.text}", encoding="utf-8")
    try:
        load(part, find_plugins())
    except ZlmreportError as error:
        message = f"{block.place}: this is no part of a job (one line further down than it stands):\n{error}"
        raise AssertionError(message) from error
