"""Messages on mistakes, without surprises for the terminal that shows them."""

from __future__ import annotations

import sys

from zlmreport.errors import ZlmreportError


def print_problems(error: ZlmreportError) -> None:
    """Print mistakes one a line, to the standard error output."""
    for problem in error.problems:
        print(visible(str(problem)), file=sys.stderr)


def visible(text: str) -> str:
    """Return a text in which a terminal obeys nothing: what cannot be seen stands as an escape."""
    return "".join(
        character if character.isprintable() or character == "\n" else ascii(character)[1:-1]
        for character in text
    )
