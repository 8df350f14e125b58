"""Text that knows where it stands in a job file."""

from __future__ import annotations

from typing import Self

from zlmreport.errors import Place


class LocatedText(str):
    """A string from a job file, with its place, so that a path can be read beside the file that names it."""

    __slots__ = ("place",)
    place: Place

    def __new__(cls, text: str, place: Place) -> Self:
        """Return the text with its place."""
        located = super().__new__(cls, text)
        located.place = place
        return located
