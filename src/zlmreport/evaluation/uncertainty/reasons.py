"""Words that are no reason or reference, such as a dash or "negligible", where a job must give one."""

from __future__ import annotations

import re

_WORD = re.compile(r"[^\W\d_]{2,}")
#: A size that is not zero, with its unit: ``below 1 nm``.
_SIZE = re.compile(r"[\d.,]*[1-9][\d.,]*\s*(?:[nµμum]?m|m?K|°C?|%|hPa|″|arcsec|mrad|µrad)(?!\w)")


def _list_words(text: str) -> frozenset[str]:
    return frozenset(text.split())


#: Words that say of themselves nothing about why a contributor should be negligible.
_EMPTY: frozenset[str] = _list_words("""
    above angabe angaben angegeben any applicable are as aucun auswirkung because bedeutung beitrag
    bekannt below benötigt berücksichtigt berücksichtigung considered contribution das der die does effect
    einfluss entfaellt entfällt erforderlich error fehler gegeben gering grund ignored ignoriert impact
    important influence insignificant irrelevant is ist it its ja kein keine keinen keiner klein known
    later leer low matter matters mm na needed negligible nein nicht nichts nil no noetig none not nothing
    notwendig nul null nötig oben ohne ok okay present reason relevant required see sehr siehe significant
    sind small später standard stated tba tbd test the there this todo trivial um unbekannt unimportant
    unknown unten unwesentlich unwichtig usual usually vernachlaessigbar vernachlässigbar very vorhanden
    was weil wichtig wie wird without xx xxx yes zero zutreffend µm üblich
""")


def says_something(reason: str) -> bool:
    """Return whether a text has a word in it that could be a reason, or a size.

    >>> says_something("laser, no length of its own"), says_something("-"), says_something("no influence")
    (True, False, False)
    >>> says_something("below 1 nm"), says_something("0 µm")
    (True, False)
    """
    return bool(_SIZE.search(reason)) or any(word.lower() not in _EMPTY for word in _WORD.findall(reason))


#: Words that say of a document only that it is none, or none yet.
_OF_NO_DOCUMENT: frozenset[str] = _EMPTY | _list_words("""
    ausstehend available calibrated calibration certificate fehlt folgt follows kalibrierschein kalibriert
    kalibrierung keines liegt missing noch pending to follow verfügbar vor yet zertifikat
""")


def is_reference(text: str) -> bool:
    """Return whether a text can name a document: it has a number in it, or says something else than none.

    >>> is_reference("C-1"), is_reference("none"), is_reference("not calibrated yet"), is_reference("")
    (True, False, False, False)
    """
    words = (word.lower() for word in _WORD.findall(text))
    return any(character.isdigit() for character in text) or any(one not in _OF_NO_DOCUMENT for one in words)


#: What stands where nobody has written anything yet, without its spaces and signs.
_PLACEHOLDERS: frozenset[str] = frozenset({""}) | _list_words("""
    ka na nb nn tba tbc tbd todo xx xxx xxxx unknown notapplicable notavailable notknown notspecified
    notstated unbekannt keineangabe keineangaben nichtangegeben nichtbekannt inconnu inconnue nonprécisé
    sconosciuto sconosciuta nonspecificato desconocido desconocida noespecificado
""")
#: Words by which something is said not to be there: no name, address or number.
_NONE = frozenset({"no", "nil", "none", "nothing", "kein", "keine", "ohne", "aucun", "nessuno", "ninguno"})


def is_placeholder(text: str) -> bool:
    """Return whether a text only fills a place: a dash, or that nothing is known or stated.

    >>> is_placeholder("-"), is_placeholder("n/a"), is_placeholder("T.B.D."), is_placeholder("k. A.")
    (True, True, True, True)
    >>> is_placeholder("none"), is_placeholder("A"), is_placeholder("0"), is_placeholder("unknown to us")
    (False, False, False, False)
    """
    return "".join(filter(str.isalnum, text.casefold())) in _PLACEHOLDERS


def names_something(text: str) -> bool:
    """Return whether a text can be a name, an address or a number: no placeholder, and not none.

    >>> names_something("Lane 2"), names_something("S-1"), names_something("none"), names_something("?")
    (True, True, False, False)
    """
    bare = "".join(filter(str.isalnum, text.casefold()))
    return bare not in _PLACEHOLDERS and bare not in _NONE
