"""Documented exchanges with instruments."""

from __future__ import annotations

from pathlib import Path

DATA = Path(__file__).parents[2] / "data" / "instruments"


def lines(name: str) -> list[str]:
    """Return the lines of a file that are no comments."""
    text = (DATA / name).read_text(encoding="utf-8")
    return [line for line in text.splitlines() if not line.startswith("#")]


def dialogue() -> list[tuple[bytes, bytes, str]]:
    """Return what a host sends to an ND 287, what comes back, and what it says."""
    rows = (line.split(" | ") for line in lines("nd287.txt"))
    return [(bytes.fromhex(host), bytes.fromhex(display), says) for host, display, says in rows]


def questions_and_answers() -> list[tuple[bytes, bytes]]:
    """Return the questions to an IDS3010, each with its answer."""
    listed = lines("ids3010.txt")
    return [
        (question[2:].encode(), answer[2:].encode() + b"\r\n")
        for question, answer in zip(listed[::2], listed[1::2], strict=True)
    ]
