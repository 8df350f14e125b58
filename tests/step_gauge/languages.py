"""A strict recogniser of each language of probing programs.

They are written from the descriptions of the languages, not from the programs, and refuse every statement
that they do not know; so a program that they read says what it should in no other statements than those.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from zlmreport_step_gauge.testing import Stated

_NUMBER = r"-?\d+\.\d+"
_XYZ = rf"({_NUMBER}),({_NUMBER}),({_NUMBER})"
_NAME = r"[A-Za-z0-9_]+"
_TEXT = r"'[A-Za-z0-9 ._+-]*'"

#: Statements that public programs of DMIS 3 and 4 show, beside the moves.
_DMIS_ONCE = (
    rf"DMISMN/{_TEXT},4\.0",
    rf"FILNAM/{_TEXT}",
    r"UNITS/MM,ANGDEC",
    rf"DID\({_NAME}\)=DEVICE/STOR,{_TEXT}",
    rf"OPEN/DID\({_NAME}\),FDATA,DMIS,OUTPUT",
    rf"D\({_NAME}\)=DATSET/MCS",
    r"PRCOMP/(ON|OFF)",
    rf"S\({_NAME}\)=SNSDEF/PROBE,FIXED,CART(,{_NUMBER}){{7}}",
    rf"SNSLCT/S\({_NAME}\)",
    rf"SNSET/APPRCH,{_NUMBER}",
    rf"SNSET/SEARCH,{_NUMBER}",
    rf"SNSET/RETRCT,{_NUMBER}",
    rf"FEDRAT/POSVEL,MPM,{_NUMBER}",
    r"MODE/PROG,MAN",
)
_DMIS_LONGEST_LINE = 80

#: Commands of I++ DME beside the moves, in their order.
_DME_HEAD = (
    r"StartSession\(\)",
    r"Home\(\)",
    r'ChangeTool\("[^"]+"\)',
    r"SetProp\(Tool\.GoToPar\.Speed\([\d.]+\)\)",
    *(
        rf"SetProp\(Tool\.PtMeasPar\.{name}\([\d.]+\)\)"
        for name in ("Speed", "Approach", "Search", "Retract")
    ),
    r"OnPtMeasReport\(X\(\), Y\(\), Z\(\), IJK\(\)\)",
    r"EndSession\(\)",
)


class LanguageError(Exception):
    """A statement is none of the language, or stands where it must not."""


def dmis(text: str) -> list[Stated]:
    """Read a DMIS program: every statement of the head once, then moves, then the end."""
    lines = [line for line in text.replace(", $\n", ",").splitlines() if not line.startswith("$$")]
    if any(len(line) > _DMIS_LONGEST_LINE for line in text.splitlines()):
        raise LanguageError("a line is too long, and is not continued")
    head = [line for line in lines if any(re.fullmatch(form, line) for form in _DMIS_ONCE)]
    if len(head) != len(_DMIS_ONCE) or lines[: len(head)] != head or not head[0].startswith("DMISMN"):
        raise LanguageError("the head is not whole")
    for form in _DMIS_ONCE:
        if sum(bool(re.fullmatch(form, line)) for line in head) != 1:
            raise LanguageError(f"not once: {form}")
    if not re.fullmatch(rf"CLOSE/DID\({_NAME}\)", lines[-2]) or lines[-1] != "ENDFIL":
        raise LanguageError("the end is missing")
    return list(_dmis_moves(iter(lines[len(head) : -2])))


def _dmis_moves(lines: Iterator[str]) -> Iterator[Stated]:
    names = set()
    for line in lines:
        if found := re.fullmatch(rf"GOTO/{_XYZ}", line):
            yield Stated(is_measuring=False, point=_triple(found.groups()))
            continue
        feature = re.fullmatch(rf"F\(({_NAME})\)=FEAT/POINT,CART,({_XYZ},{_XYZ})", line)
        if feature is None or feature[1] in names:
            raise LanguageError(line)
        name, where = feature[1], feature[2]
        names.add(name)
        block = [next(lines, "") for _ in range(4)]
        if block != [f"MEAS/POINT,F({name}),1", f"PTMEAS/CART,{where}", "ENDMES", f"OUTPUT/FA({name})"]:
            raise LanguageError(f"{name}: {block}")
        numbers = where.split(",")
        yield Stated(is_measuring=True, point=_triple(numbers[:3]), normal=_triple(numbers[3:]))


def mv_ms(text: str) -> list[Stated]:
    """Read the code of the seed paper: PO 1 after the first move and after each measuring move."""
    found: list[Stated] = []
    *lines, last = text.splitlines()
    if last != "END;":
        raise LanguageError("the end is missing")
    wants_output = False
    for line in lines:
        if wants_output != (line == "PO 1 ;"):
            raise LanguageError(line)
        if wants_output:
            wants_output = False
            continue
        words = re.fullmatch(rf"(MV|MS) +({_NUMBER}) +({_NUMBER}) +({_NUMBER}) ;", line)
        if words is None:
            raise LanguageError(line)
        word, *numbers = words.groups()
        wants_output = word == "MS" or not found
        found.append(Stated(is_measuring=word == "MS", point=_triple(numbers)))
    return found


def ippdme(text: str) -> list[Stated]:
    """Read a file of I++ DME commands: tags that rise, CR LF, separators, and the end."""
    if not text.endswith("\\\\\r\n:\r\n:\r\n"):
        raise LanguageError("the end is missing")
    lines = text.removesuffix(":\r\n:\r\n").split("\r\n")[:-1]
    if any(line != "\\\\" for line in lines[1::2]) or any("\n" in line for line in lines):
        raise LanguageError("commands are not parted")
    tags, commands = zip(*(line.split(" ", 1) for line in lines[::2]), strict=True)
    if list(tags) != sorted(set(tags)) or not all(re.fullmatch(r"\d{5}", tag) for tag in tags):
        raise LanguageError("tags do not rise")
    head = [command for command in commands if not command.startswith(("GoTo", "PtMeas("))]
    if len(head) != len(_DME_HEAD) or not all(map(re.fullmatch, _DME_HEAD, head)):
        raise LanguageError(str(head))
    return [_dme_move(command) for command in commands[len(head) - 1 : -1]]


def _dme_move(command: str) -> Stated:
    xyz = rf"X\(({_NUMBER})\), Y\(({_NUMBER})\), Z\(({_NUMBER})\)"
    if found := re.fullmatch(rf"GoTo\({xyz}\)", command):
        return Stated(is_measuring=False, point=_triple(found.groups()))
    found = re.fullmatch(rf"PtMeas\({xyz}, IJK\(({_NUMBER}), ({_NUMBER}), ({_NUMBER})\)\)", command)
    if found is None:
        raise LanguageError(command)
    return Stated(is_measuring=True, point=_triple(found.groups()[:3]), normal=_triple(found.groups()[3:]))


def _triple(texts: object) -> tuple[float, float, float]:
    x, y, z = map(float, texts)  # type: ignore[call-overload]
    return x, y, z


LANGUAGES = {"dmis": dmis, "mv-ms": mv_ms, "ippdme": ippdme}
