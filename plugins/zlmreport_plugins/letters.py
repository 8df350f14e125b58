"""Letters that no typeface of a document has: it is refused, for it would show boxes in their place."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from unicodedata import category, name

from zlmreport.plugin import InputError, Place, Problem
from zlmreport.plugin.renderer import Certificate

#: What is seen only by what it does: line ends, joiners, direction marks.
_UNSEEN = frozenset({"Cf", "Zl", "Zp"})
_MOST_TOLD, _MOST_PLACES = 3, 8
#: What nobody prints of a job.
_COMMENT = re.compile(r"(?:^|(?<=\s))#.*")
#: How files say what they hold in letters that are not ASCII.
_ENCODINGS = ("utf-8-sig", "utf-16", "gbk", "cp1252")


def refuse_letters(letters: Iterable[str], certificate: Certificate, lack: str, remedy: str) -> None:
    """Refuse a certificate for letters that have no shape, if any of them would be seen: where each stands.

    `lack`: The beginning of the sentence that names them: what has none of them.
    `remedy`: What would be right, as its end.
    """
    left = {letter for letter in letters if category(letter) not in _UNSEEN}
    problems = []
    for place, lacking in _locate_letters(left, certificate):
        told = ", ".join(map(_tell_letter, lacking[:_MOST_TOLD]))
        more = f" and {len(lacking) - _MOST_TOLD} more" if len(lacking) > _MOST_TOLD else ""
        problems.append(Problem(place, f"{lack} {told}{more}; {remedy}"))
    if problems:
        raise InputError(problems[:_MOST_PLACES])


def _locate_letters(left: set[str], certificate: Certificate) -> Iterator[tuple[Place, list[str]]]:
    """Yield the places at which the files of a certificate have letters: each letter at the first one."""
    for source in certificate.sources:
        file = source.file
        path = str(file.path or file.name)
        if found := [letter for letter in dict.fromkeys(file.name) if letter in left]:
            left -= {*found}
            yield Place(path), found
        lines = _read_lines(file.content or b"") if left else []
        for number, line in enumerate(lines, 1):
            if found := [letter for letter in dict.fromkeys(_COMMENT.sub("", line)) if letter in left]:
                left -= {*found}
                yield Place(path, number, line.index(found[0]) + 1), found
    if left:
        yield Place(certificate.number), sorted(left)


def _read_lines(content: bytes) -> list[str]:
    for encoding in _ENCODINGS if b"\0" not in content[:1] else ():
        try:
            return content.decode(encoding).splitlines()
        except UnicodeDecodeError:
            continue
    return []


def _tell_letter(letter: str) -> str:
    shown = f"{letter!r} " if letter.isprintable() else ""
    return f"{shown}(U+{ord(letter):04X} {name(letter, 'a control character')})"
