"""The pages of the documentation, their fenced blocks, links and headings."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).parents[2]
DOCS = ROOT / "docs"

_FENCE = re.compile(r"^(?P<indent> *)(?P<ticks>```+)(?P<info>.*)$")
_HEADING = re.compile(r"^#{1,6} +(.*?) *$")
_LINK = re.compile(r"!?\[[^\]]*\]\(([^)\s]+)\)|<img[^>]* src=\"([^\"]+)\"")
_CODE = re.compile(r"`[^`\n]*`")


@dataclass(frozen=True, slots=True)
class Block:
    """A fenced block: its language, the file name beside it, its text, and the line where it begins."""

    page: Path
    line: int
    language: str
    file: str
    text: str

    @property
    def place(self) -> str:
        return f"{self.page.relative_to(ROOT)}:{self.line}"


def pages() -> list[Path]:
    """Return every page that a reader of the project meets."""
    return [ROOT / "README.md", ROOT / "CHANGELOG.md", *sorted(DOCS.rglob("*.md"))]


def name(page: Path) -> str:
    """Return a page's name, for the identifiers of tests."""
    return page.relative_to(ROOT).as_posix()


def blocks(page: Path) -> list[Block]:
    """Return the fenced blocks of a page."""
    return [part for part in _parts(page) if isinstance(part, Block)]


def prose(page: Path) -> str:
    """Return a page without its fenced blocks, line by line."""
    return "\n".join(part for part in _parts(page) if isinstance(part, str))


def links(page: Path) -> list[str]:
    """Return the targets of a page's links and images."""
    return [first or second for first, second in _LINK.findall(_CODE.sub("", prose(page)))]


def anchors(page: Path) -> set[str]:
    """Return the anchors of a page's headings, as GitHub makes them."""
    found: set[str] = set()
    for line in prose(page).splitlines():
        match = _HEADING.match(line)
        if match:
            anchor = re.sub(r"[^\w\- ]", "", match[1].lower()).replace(" ", "-")
            number = 0
            numbered = anchor
            while numbered in found:
                number += 1
                numbered = f"{anchor}-{number}"
            found.add(numbered)
    return found


def _parts(page: Path) -> Iterator[Block | str]:
    """Yield blocks, and every line outside of them."""
    lines = iter(enumerate(page.read_text(encoding="utf-8").splitlines(), 1))
    for number, line in lines:
        fence = _FENCE.match(line)
        if not fence:
            yield line
            continue
        language, _, file = fence["info"].strip().partition(" ")
        inside = []
        for _, within in lines:
            if within.strip() == fence["ticks"]:
                break
            inside.append(within.removeprefix(fence["indent"]))
        yield Block(page, number, language, file.strip(), "".join(f"{each}\n" for each in inside))
