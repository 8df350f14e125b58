"""What a page says that a command prints, brought up to date; what its author left out stays left out."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from difflib import SequenceMatcher
from functools import cache
from pathlib import Path
from typing import TypeVar

from documents.examples import ELLIPSIS, matches, run_page, typed
from documents.pages import Block
from documents.shell import Shell

Element = TypeVar("Element")


def rewrite_page(page: Path, folder: Path) -> bool:
    """Execute a page in a folder and write what its commands print today; return whether anything changed."""
    renewals: list[tuple[Block, str]] = []

    def console(block: Block, shell: Shell) -> None:
        renewals.append((block, _renewed_block(block, shell)))

    run_page(page, folder, console)
    before = page.read_text(encoding="utf-8").splitlines()
    lines = list(before)
    for block, text in reversed(renewals):
        indent = lines[block.line - 1].partition("`")[0]
        inside = slice(block.line, block.line + block.text.count("\n"))
        lines[inside] = [f"{indent}{line}".rstrip() for line in text.splitlines()]
    if lines != before:
        page.write_text("".join(f"{line}\n" for line in lines), encoding="utf-8")
    return lines != before


def renewed(expected: Sequence[str], printed: Sequence[str]) -> list[str]:
    """Return the lines that a page should say, with its ellipses where its author put them.

    Parameters
    ----------
    expected
        The lines as the page has them.
    printed
        The lines that the command prints.
    """
    pairs = _aligned(expected, printed, lambda line: line.strip() == ELLIPSIS, _difference)
    return [old if new is None else _renewed_line(old, new) for old, new in pairs]


def _renewed_block(block: Block, shell: Shell) -> str:
    text = ""
    for command, printed, _ in typed(block, shell):
        text += "$ " + command.text.replace("\n", "\n> ") + "\n"
        if command.expected:
            lines = [line.rstrip() for line in printed.splitlines()]
            text += "".join(f"{line}\n" for line in renewed(command.expected, lines))
    return text


def _renewed_line(old: str, new: str) -> str:
    if matches([old], new):
        return old
    if ELLIPSIS in new:  # the command's own
        return new
    pairs = _aligned(old, new, lambda letter: letter == ELLIPSIS, lambda one, other: float(one != other))
    return "".join(letter if other is None else other for letter, other in pairs)


def _difference(expected: str, printed: str) -> float:
    """Return 0 for a line that the page describes, up to 1 for one that has nothing in common with it."""
    if matches([expected], printed):
        return 0.0
    return 1.0 - 0.9 * SequenceMatcher(None, expected, printed, autojunk=False).ratio()


def _aligned(
    old: Sequence[Element],
    new: Sequence[Element],
    is_ellipsis: Callable[[Element], bool],
    difference: Callable[[Element, Element], float],
) -> tuple[tuple[Element, Element | None], ...]:
    """Return what replaces what, at the least cost: pairs of old and new; an ellipsis has no counterpart.

    An ellipsis swallows anything for nothing. An element that comes in or goes out costs one; what comes in
    is paired with itself.
    """

    @cache
    def best(row: int, column: int) -> tuple[float, tuple[tuple[Element, Element | None], ...]]:
        is_old, is_new = row < len(old), column < len(new)
        if not is_old and not is_new:
            return 0.0, ()
        ways = []
        if is_old and is_ellipsis(old[row]):
            cost, rest = best(row + 1, column)
            ways.append((cost, ((old[row], None), *rest)))
            if is_new:
                ways.append(best(row, column + 1))
        else:
            if is_old and is_new:
                cost, rest = best(row + 1, column + 1)
                ways.append((cost + difference(old[row], new[column]), ((old[row], new[column]), *rest)))
            if is_old:
                cost, rest = best(row + 1, column)
                ways.append((cost + 1.0, rest))
            if is_new:
                cost, rest = best(row, column + 1)
                ways.append((cost + 1.0, ((new[column], new[column]), *rest)))
        return min(ways, key=lambda way: way[0])

    return best(0, 0)[1]
