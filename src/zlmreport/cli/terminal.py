"""What all commands print by: colours, wrapping, columns, the line of progress, control characters shown."""

from __future__ import annotations

import json
import os
import re
import shutil
import sys
import textwrap
import unicodedata
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import contextmanager
from enum import Enum
from pathlib import Path
from typing import Any

from zlmreport.errors import Problem, ZlmreportError, write_problems
from zlmreport.language import Language, Words
from zlmreport.language.formatting import HELD

_USUAL_LINE, _SHORTEST_LINE = 110, 60
#: Letters of a column of texts, however much room the others take.
_SHORTEST_TEXT = 15
#: Seconds of a minute, minutes of an hour; and from how many seconds on only minutes are said.
_MINUTE, _LONG = 60, 600
#: A blank at which no line ends: before a number or a unit, and around a sign between numbers.
_WITHIN_A_VALUE = re.compile(
    r" (?=[−\d]|[±=<≈] )|(?<=[±=<≈]) |(?<=\d) (?=(?:[mµn]?m|s|min|readings|%|°|″)(?!\w))"
)


class Colour(Enum):
    """A colour, as a terminal is told to take it."""

    RED = "31"
    GREEN = "32"
    YELLOW = "33"
    BOLD = "1"

    def set(self, text: str) -> str:
        """Return a text in this colour where somebody sees it."""
        if not text or os.environ.get("NO_COLOR") or not sys.stdout.isatty():
            return text
        return f"\x1b[{self.value}m{text}\x1b[0m"


def say(words: Words | str, language: Language = Language.ENGLISH) -> str:
    """Return words as the terminal has them, with blanks that a search finds."""
    text = words if isinstance(words, str) else words.in_language(language)
    return text.replace(HELD, " ")


def wrap(text: str, indent: str = "  ") -> list[str]:
    """Return a text in lines that fit, all but the first further in; no line ends within a value."""
    return [line.replace(HELD, " ") for line in fill(hold_values(text), indent)]


def hold_values(text: str) -> str:
    """Return a text whose values are held together: no line ends within one."""
    return _WITHIN_A_VALUE.sub(HELD, text)


def fill(text: str, indent: str = "  ") -> list[str]:
    """Return a text in lines that fit, all but the first further in; blanks that are held stay."""
    further = f"{indent}  "
    return textwrap.wrap(
        text, measure_line(), initial_indent=indent, subsequent_indent=further, break_on_hyphens=False
    )


def wrap_steps(text: str) -> Iterator[str]:
    """Yield a text in lines that fit, none of which ends between a sign and the effect that comes or goes."""
    yield from wrap(text.replace("+ ", f"+{HELD}").replace("− ", f"−{HELD}"), "")


def lay_out_changes(path: str, names: Sequence[str], *, is_tried: bool) -> Iterator[str]:
    """Yield what a build writes into a file, or would: the effects that come, and that go."""
    if not names:
        yield f"{path}: nothing to change"
    else:
        lead = f"{path}: left as it is; without --dry-run:" if is_tried else f"{path}:"
        yield from wrap_steps(f"{lead} {', '.join(names)}")


def lay_out_heading(name: str, rest: str) -> Iterator[str]:
    """Yield a name in bold and what is said of it, in lines that fit."""
    first, *further = wrap(f"{name}  {rest}", "")
    yield Colour.BOLD.set(name) + first.removeprefix(name) if first.startswith(name) else first
    yield from further


def measure_line() -> int:
    """Return how many letters a line may have: those of the terminal; of a pipe, always as many."""
    return max(_SHORTEST_LINE, shutil.get_terminal_size((_USUAL_LINE, 0)).columns)


def lay_out_beside(label: str, texts: Iterable[str], column: int) -> Iterator[str]:
    """Yield a label, and right of it texts in lines that fit: each text begins in the same column."""
    first, *further = (line for text in texts for line in wrap(text, " " * column))
    yield label + " " * (column - measure_width(label)) + first[column:]
    yield from further


def lay_out_table(
    rows: Iterable[Sequence[str]],
    right: Sequence[int] = (),
    indent: str = "    ",
    *,
    wrapping: int | None = None,
) -> Iterator[str]:
    """Yield rows whose columns line up.

    `right`: Columns that stand on their last letter.
    `wrapping`: A column of texts, which has the room that the others leave in a line.
    """
    rows = [tuple(row) for row in rows]
    if wrapping is not None and rows:
        rows = list(_wrap_column(rows, wrapping, measure_line() - len(indent)))
    widths = [max(map(measure_width, column)) for column in zip(*rows, strict=True)]
    for row in rows:
        cells = []
        for number, (cell, width) in enumerate(zip(row, widths, strict=True)):
            space = " " * (width - measure_width(cell))
            cells.append(space + cell if number in right else cell + space)
        yield indent + "  ".join(cells).rstrip()


def _wrap_column(rows: Sequence[Sequence[str]], wrapping: int, line: int) -> Iterator[tuple[str, ...]]:
    """Yield rows for a line of so many letters; what has no room in a column stands in further rows."""
    widths = [max(map(measure_width, column)) for column in zip(*rows, strict=True)]
    room = max(_SHORTEST_TEXT, line - sum(widths) + widths[wrapping] - 2 * (len(widths) - 1))
    for row in rows:
        first, *further = textwrap.wrap(row[wrapping], room, break_on_hyphens=False) or [""]
        yield (*row[:wrapping], first, *row[wrapping + 1 :])
        for text in further:
            yield tuple(text if number == wrapping else "" for number in range(len(row)))


def show_path(path: Path) -> str:
    """Return a path as the user would type it: from the current folder, if it lies below that."""
    absolute = path.resolve()
    here = Path.cwd()
    return make_visible(str(absolute.relative_to(here) if absolute.is_relative_to(here) else absolute))


@contextmanager
def show_progress(doing: str, *, is_wanted: bool = True) -> Iterator[Callable[[float], None]]:
    """Give what is told the share of some work that is done; a line on a terminal shows it until the end."""
    shown = is_wanted and sys.stderr.isatty()

    def tell(share: float) -> None:
        if shown:
            print(f"\r{doing} {share:4.0%} ", end="", file=sys.stderr, flush=True)

    try:
        yield tell
    finally:
        if shown:
            print("\r\033[K", end="", file=sys.stderr, flush=True)


def write_duration(seconds: float) -> str:
    """Write how long something takes; from ten minutes on, seconds say nothing.

    >>> write_duration(4.2), write_duration(200), write_duration(1400), write_duration(7300)
    ('4 s', '3 min 20 s', '23 min', '2 h 2 min')
    """
    if round(seconds) < _MINUTE:
        return f"{seconds:.0f} s"
    if seconds < _LONG:
        minutes, rest = divmod(round(seconds), _MINUTE)
        return f"{minutes} min {rest} s" if rest else f"{minutes} min"
    hours, minutes = divmod(round(seconds / _MINUTE), _MINUTE)
    return f"{hours} h {minutes} min" if hours else f"{minutes} min"


def print_json(value: Any) -> None:
    """Print JSON, in letters where the terminal has them and in escapes where it might not."""
    is_unicode = (sys.stdout.encoding or "").lower().replace("-", "") == "utf8"
    print(json.dumps(value, ensure_ascii=not is_unicode, indent=1, allow_nan=False))


def print_problems(error: ZlmreportError) -> None:
    """Print mistakes one a line, to the standard error output."""
    for line in write_problems(error.problems):
        print(make_visible(line), file=sys.stderr)


def collect_problem(problem: Problem) -> dict[str, Any]:
    """Return a mistake as JSON has it."""
    return {
        "file": problem.place.file,
        "line": problem.place.line or None,
        "column": problem.place.column or None,
        "message": problem.message,
    }


def make_visible(text: str) -> str:
    """Return a text in which a terminal obeys nothing: what cannot be seen stands as an escape."""
    return "".join(
        character if character.isprintable() or character == "\n" else ascii(character)[1:-1]
        for character in text
    )


def measure_width(cell: str) -> int:
    """Return how wide a cell is printed: colours and combining marks take no room."""
    width = 0
    in_colour = False
    for character in cell:
        if character == "\x1b":
            in_colour = True
        elif in_colour:
            in_colour = character != "m"
        elif not unicodedata.combining(character):
            width += 1
    return width
