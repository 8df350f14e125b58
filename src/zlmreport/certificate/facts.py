"""Facts of a document: a name, a value that may not be stated, and the job keys from which it comes."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from zlmreport.language import Words
    from zlmreport.presenting.writer import Writer


class Fact(NamedTuple):
    """A fact.

    Attributes
    ----------
    name
        What is stated.
    value
        In the document's language; None or empty where the job does not state it.
    keys
        Dotted job keys that the value comes from: a mark stands behind the name if others supplied one.
    """

    name: Words
    value: str | None
    keys: tuple[str, ...] = ()


def stated(facts: Iterable[Fact], writer: Writer) -> tuple[tuple[str, str], ...]:
    """Return the facts that have a value, named and marked in the document's language."""
    return tuple(
        (writer.say(fact.name) + writer.marks.after(*fact.keys), fact.value) for fact in facts if fact.value
    )
