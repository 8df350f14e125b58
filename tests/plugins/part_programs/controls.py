"""Four small controls: each runs the programs of its language, strictly, and says where its axis stopped.

They are written from the descriptions of the languages, not from the programs, and refuse every word that
they do not know; so a program that they run says what it should in no other words than those.
"""

from __future__ import annotations

import re
from dataclasses import dataclass, field

#: An address with its number, as ISO code has them.
_WORD = re.compile(r"([A-Z])([+-]?\d+\.?\d*)")


class AlarmError(Exception):
    """The control does not understand, or is asked for what it must not do."""


@dataclass(slots=True)
class Machine:
    """An axis that moves, and rests."""

    feed: float | None = None
    stops: list[tuple[float, float]] = field(default_factory=list)
    feeds: list[float] = field(default_factory=list)
    waits: list[float] = field(default_factory=list)
    blocks: list[int] = field(default_factory=list)

    def move(self, position: float) -> None:
        if not self.feed:
            raise AlarmError("no feed is programmed")
        self.stops.append((position, 0.0))
        self.feeds.append(self.feed)

    def wait(self) -> None:
        if not self.stops:
            raise AlarmError("waits before it has moved")
        self.waits.append(self.stops[-1][0])

    def rest(self, seconds: float) -> None:
        if not self.stops:
            raise AlarmError("rests before it has moved")
        position, before = self.stops[-1]
        if before:
            raise AlarmError("rests twice at one stop")
        self.stops[-1] = position, seconds


def linuxcnc(text: str, axis: str = "[XYZABCUVW]") -> Machine:
    """Run RS274/NGC: remarks in brackets, G53 in each block, P in seconds, M2 at the end."""
    machine, modes = Machine(), set[str]()
    *lines, last = text.splitlines()
    for line in lines:
        code = re.sub(r"\([^()]*\)", "", line).strip()
        if not code:
            continue
        if re.fullmatch(r"(G\d+(\.\d)? ?)+", code):
            modes |= set(code.split())
        elif words := re.fullmatch(r"F([\d.]+)", code):
            machine.feed = float(words[1])
        elif words := re.fullmatch(rf"G53 G1 {axis}(-?\d+\.\d+)", code):
            demand({"G21", "G90", "G94", "G49", "G61.1"} <= modes, "modes are not set")
            machine.move(float(words[1]))
        elif code == "M0":
            machine.wait()
        elif words := re.fullmatch(r"G4 P([\d.]+)", code):
            machine.rest(float(words[1]))
        else:
            raise AlarmError(line)
    demand(last == "M2", "no end")
    return machine


def fanuc(text: str) -> Machine:
    """Run ISO code of a machining centre: between percent signs, modal, every position with a point."""
    machine, modes = Machine(), set[int]()
    first, number, *lines, end, last = text.splitlines()
    demand((first, end, last) == ("%", "M30", "%"), "no frame of percent signs, or no M30")
    demand(re.fullmatch(r"O\d{4}", number), "no program number")
    for line in lines:
        code = re.sub(r"\([A-Z0-9 .,+/-]*\)", "", line).strip()
        if code == "M00":
            machine.wait()
            continue
        found = _WORD.findall(code)
        demand("".join(f"{letter}{value}" for letter, value in found) == code.replace(" ", ""), line)
        words = [(letter, value) for letter, value in found if letter not in "GN"]
        functions = {int(value) for letter, value in found if letter == "G"}
        machine.blocks.extend(int(value) for letter, value in found if letter == "N")
        demand(
            all("." in value for _, value in words), f"without a point, least increments are meant: {line}"
        )
        demand(len(words) <= 1, line)
        if 4 in functions:
            ((letter, value),) = words
            demand(letter == "X" and functions == {4}, line)
            machine.rest(float(value))
            continue
        modes |= functions
        for letter, value in words:
            if letter == "F":
                machine.feed = float(value)
            else:
                demand(letter in "XYZABCUVW" and {1, 21, 61, 90, 94, 49} <= modes, line)
                demand(modes & set(range(54, 60)) and 53 not in modes and 0 not in modes, line)
                machine.move(float(value))
    return machine


def siemens(text: str) -> Machine:
    """Run the language of SINUMERIK: remarks after a semicolon, SUPA in each block, no reading ahead."""
    machine, modes, is_stopped = Machine(), set[str](), False
    *lines, last = text.splitlines()
    for line in lines:
        code = line.partition(";")[0].strip()
        if not code:
            continue
        if words := re.fullmatch(r"(?:N(\d+) )?G4 F([\d.]+)", code):
            demand(is_stopped, "reads ahead before it rests")
            machine.blocks.append(int(words[1]))
            machine.rest(float(words[2]))
        elif words := re.fullmatch(r"SUPA G1 [A-Z][A-Z0-9_]*=(-?\d+(\.\d+)?)", code):
            demand({"G710", "G90", "G94", "G60", "D0"} <= modes, "modes are not set")
            machine.move(float(words[1]))
        elif words := re.fullmatch(r"F([\d.]+)", code):
            machine.feed = float(words[1])
        elif code == "M0":
            machine.wait()
        elif code != "STOPRE":
            demand(re.fullmatch(r"([GD]\d+ ?)+", code), line)
            modes |= set(code.split())
        is_stopped = code == "STOPRE"
    demand(last == "M30", "no end")
    return machine


def heidenhain(text: str) -> Machine:
    """Run Klartext: numbered blocks, a feed and M91 in each line, cycle 9 in two blocks."""
    machine, is_defining = Machine(), False
    for code in read_klartext(text):
        if code.startswith(";"):
            continue
        if code == "STOP":
            machine.wait()
            continue
        if code == "CYCL DEF 9.0 DWELL TIME":
            is_defining = True
            continue
        if is_defining:
            rest = re.fullmatch(r"CYCL DEF 9\.1 DWELL (\d+\.\d+)", code)
            demand(rest, code)
            machine.rest(float(rest[1]))
            is_defining = False
            continue
        line = re.fullmatch(r"L [XYZABCUVW]([+-]\d+(?:\.\d+)?) R0 F(\d+(?:\.\d+)?) M91", code)
        demand(line, code)
        machine.feed = float(line[2])
        machine.move(float(line[1]))
    return machine


def read_klartext(text: str) -> list[str]:
    """Return the blocks of a program in Klartext, between its begin and its end."""
    blocks = []
    for count, line in enumerate(text.splitlines()):
        number, _, code = line.partition(" ")
        demand(number == str(count), f"blocks are not numbered: {line}")
        blocks.append(code)
    begin = re.fullmatch(r"BEGIN PGM ([A-Za-z0-9_-]+) MM", blocks[0])
    demand(begin and blocks[-1] == f"END PGM {begin[1]} MM", "no begin and end of one name")
    return blocks[1:-1]


def demand(condition: object, alarm: str) -> None:
    """Raise an alarm where something is not so."""
    if not condition:
        raise AlarmError(alarm)


CONTROLS = {"linuxcnc": linuxcnc, "fanuc": fanuc, "siemens-840d": siemens, "heidenhain": heidenhain}
