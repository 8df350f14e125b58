"""Texts of which parts are replaced: each part must be there, or a test would try nothing."""

from __future__ import annotations

from pathlib import Path


def replaced(text: str, *changes: tuple[str, str]) -> str:
    """Return a text with parts replaced, one after the other."""
    for old, new in changes:
        assert old in text, f"there is no {old!r}"
        text = text.replace(old, new)
    return text


def replace_in(path: Path, *changes: tuple[str, str]) -> None:
    """Replace parts of a file's text."""
    path.write_text(replaced(path.read_text(encoding="utf-8"), *changes), encoding="utf-8")
