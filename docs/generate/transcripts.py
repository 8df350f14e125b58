"""Writes what commands print into the pages: ``python docs/generate/transcripts.py [PAGE…]``.

Executes the examples of each page (of every page with console blocks, if none is named) as the tests do, and
writes what the commands print today. What a page leaves out by ``…`` stays left out. It takes a minute; read
the difference before you keep it: what stands around the examples may tell of the old numbers.
"""

from __future__ import annotations

import sys
import tempfile
from pathlib import Path

_ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(_ROOT / "tests"))  # the tests know how a page is executed

from documents.examples import EXECUTED  # noqa: E402 - found on the path above
from documents.pages import blocks, name  # noqa: E402
from documents.transcripts import rewrite_page  # noqa: E402


def main(pages: list[Path]) -> int:
    """Bring pages up to date, and name those that changed; return whether any does not work."""
    is_broken = False
    for page in pages:
        with tempfile.TemporaryDirectory() as folder:
            try:
                if rewrite_page(page, Path(folder)):
                    print(name(page))  # noqa: T201 - a command prints
            except AssertionError as error:  # the page is left as it is
                is_broken = True
                print(error, file=sys.stderr)  # noqa: T201 - a command prints
    return int(is_broken)


if __name__ == "__main__":
    named = [Path(page).resolve() for page in sys.argv[1:]]
    with_consoles = (page for page in EXECUTED if any(block.language == "console" for block in blocks(page)))
    sys.exit(main(named or list(with_consoles)))
