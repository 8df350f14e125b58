"""Whether what a laboratory gives as a reason is one: a dash is not, and neither is the claim itself."""

from __future__ import annotations

import re

_WORD = re.compile(r"[^\W\d_]{2,}")
#: Words that say of themselves nothing about why a contributor should be negligible.
_EMPTY: frozenset[str] = frozenset(
    {
        "angegeben",
        "any",
        "applicable",
        "are",
        "aucun",
        "because",
        "bekannt",
        "berücksichtigt",
        "considered",
        "das",
        "der",
        "die",
        "entfaellt",
        "entfällt",
        "gering",
        "grund",
        "insignificant",
        "irrelevant",
        "is",
        "ist",
        "it",
        "its",
        "ja",
        "kein",
        "keine",
        "klein",
        "known",
        "leer",
        "low",
        "na",
        "negligible",
        "nein",
        "nicht",
        "nichts",
        "nil",
        "no",
        "none",
        "not",
        "nothing",
        "nul",
        "null",
        "ohne",
        "ok",
        "okay",
        "reason",
        "relevant",
        "sehr",
        "significant",
        "sind",
        "small",
        "stated",
        "tba",
        "tbd",
        "the",
        "todo",
        "unbekannt",
        "unknown",
        "unwesentlich",
        "vernachlaessigbar",
        "vernachlässigbar",
        "very",
        "weil",
        "without",
        "xx",
        "xxx",
        "yes",
        "zero",
        "zutreffend",
    }
)


def says_something(reason: str) -> bool:
    """Return whether a text has a word in it that could be a reason.

    >>> says_something("laser, no length of its own"), says_something("-"), says_something("none")
    (True, False, False)
    """
    return any(word.lower() not in _EMPTY for word in _WORD.findall(reason))


#: Words that say of a document only that it is none, or none yet.
_OF_NO_DOCUMENT: frozenset[str] = _EMPTY | {
    "ausstehend",
    "available",
    "calibrated",
    "calibration",
    "certificate",
    "fehlt",
    "folgt",
    "follows",
    "kalibrierschein",
    "kalibriert",
    "kalibrierung",
    "keinen",
    "keiner",
    "keines",
    "later",
    "liegt",
    "missing",
    "noch",
    "pending",
    "später",
    "to",
    "follow",
    "verfügbar",
    "vor",
    "vorhanden",
    "yet",
    "zertifikat",
}


def is_reference(text: str) -> bool:
    """Return whether a text can name a document: it has a number in it, or says something else than none.

    >>> is_reference("C-1"), is_reference("none"), is_reference("not calibrated yet"), is_reference("")
    (True, False, False, False)
    """
    words = (word.lower() for word in _WORD.findall(text))
    return any(character.isdigit() for character in text) or any(one not in _OF_NO_DOCUMENT for one in words)
