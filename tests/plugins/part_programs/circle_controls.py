"""Four small controls that run circles, strictly: from the text of a program to the moves of the tool.

As `controls`, they are written from the descriptions of the languages: an arc is in the plane that was
chosen, its centre is reckoned from its start, and it goes all round where it ends at its start.
"""

from __future__ import annotations

import re
from dataclasses import dataclass, field

from plugins.part_programs.controls import AlarmError, demand, read_klartext
from zlmreport.testing import CircleMove

_WORD = re.compile(r"([A-Z])=?([+-]?\d+\.?\d*)")
_PLANES = {17: "XY", 18: "ZX", 19: "YZ"}
_OFFSETS = {"X": "I", "Y": "J", "Z": "K"}
_TOLERANCE = 2e-3


@dataclass(slots=True)
class Tool:
    """Moves in a plane, and says what an operator or a clock was waited for."""

    plane: str = ""
    feed: float | None = None
    at: tuple[float, float] | None = None
    moves: list[CircleMove] = field(default_factory=list)
    waits: list[tuple[float, float]] = field(default_factory=list)
    rests: list[float] = field(default_factory=list)
    is_exact: bool | None = None

    def line(self, words: dict[str, float]) -> None:
        self._move(words, 0, (0.0, 0.0))

    def arc(self, words: dict[str, float], sense: int, centre: tuple[float, float] | None = None) -> None:
        if self.at is None:
            raise AlarmError("an arc from nowhere")
        if self.is_exact:
            raise AlarmError("stops on the circle")
        if centre is None:
            x, y = (words.pop(_OFFSETS[axis]) for axis in self.plane)
            centre = self.at[0] + x, self.at[1] + y
        self._move(words, sense, centre)

    def wait(self) -> None:
        if self.at is None:
            raise AlarmError("waits before it has moved")
        self.waits.append(self.at)

    def _move(self, words: dict[str, float], sense: int, centre: tuple[float, float]) -> None:
        if not self.feed:
            raise AlarmError("no feed is programmed")
        if set(words) - set(self.plane) or (words and set(words) != set(self.plane)):
            raise AlarmError(f"{words} in the plane {self.plane}")
        end = (words[self.plane[0]], words[self.plane[1]]) if words else self.at
        assert end is not None
        if sense and self.at is not None and abs(_way(self.at, centre) - _way(end, centre)) > _TOLERANCE:
            raise AlarmError("the end is not on the circle of the start")
        self.at = end
        self.moves.append(CircleMove(end, self.feed, sense, centre))


def _way(point: tuple[float, float], centre: tuple[float, float]) -> float:
    return float(((point[0] - centre[0]) ** 2 + (point[1] - centre[1]) ** 2) ** 0.5)


def linuxcnc(text: str) -> Tool:
    """Run RS274/NGC: remarks in brackets, offsets of arcs from their start, M2 at the end."""
    *lines, last = text.splitlines()
    demand(last == "M2", "no end")
    tool, modes = Tool(), set[str]()
    for line in lines:
        code = re.sub(r"\([^()]*\)", "", line).strip()
        if words := re.fullmatch(r"G4 P([\d.]+)", code):
            tool.rests.append(float(words[1]))
        elif code == "M0":
            tool.wait()
        elif code == "G61.1" or re.fullmatch(r"G64 P[\d.]+", code):
            tool.is_exact = code == "G61.1"
        elif code:
            _iso(code, tool, modes)
    demand({"G21", "G90", "G94", "G49", "G91.1"} <= modes, "modes are not set")
    return tool


def fanuc(text: str) -> Tool:
    """Run ISO code of a machining centre: between percent signs, every value with a point."""
    first, number, *lines, end, last = text.splitlines()
    demand((first, end, last) == ("%", "M30", "%"), "no frame of percent signs, or no M30")
    demand(re.fullmatch(r"O\d{4}", number), "no program number")
    tool, modes = Tool(), set[str]()
    for line in lines:
        code = re.sub(r"\([A-Z0-9 .,+/-]*\)", "", line).strip()
        values = [value for letter, value in _WORD.findall(code) if letter not in "GM"]
        demand(all("." in value for value in values), f"without a point, least increments are meant: {line}")
        if words := re.fullmatch(r"G04 X([\d.]+)", code):
            tool.rests.append(float(words[1]))
        elif code == "M00":
            tool.wait()
        elif code in {"G61", "G64"}:
            tool.is_exact = code == "G61"
        elif code:
            _iso(code, tool, modes)
    demand({"G21", "G90", "G94", "G49"} <= modes, "modes are not set")
    return tool


def siemens(text: str) -> Tool:
    """Run the language of SINUMERIK: remarks after a semicolon, no reading ahead of a rest."""
    *lines, last = text.splitlines()
    demand(last == "M30", "no end")
    tool, modes, is_stopped = Tool(), set[str](), False
    for line in lines:
        code = line.partition(";")[0].strip()
        if words := re.fullmatch(r"G4 F([\d.]+)", code):
            demand(is_stopped, "reads ahead before it rests")
            tool.rests.append(float(words[1]))
        elif code == "M0":
            tool.wait()
        elif code in {"G60", "G64"}:
            tool.is_exact = code == "G60"
        elif code and code != "STOPRE":
            _iso(code, tool, modes)
        is_stopped = code == "STOPRE"
    demand({"G710", "G90", "G94", "D0"} <= modes, "modes are not set")
    return tool


def heidenhain(text: str) -> Tool:
    """Run Klartext: numbered blocks, arcs about CC, cycle 9 in two blocks."""
    tool, centre = Tool(), None
    for code in read_klartext(text):
        words = {letter: float(value) for letter, value in re.findall(r"([XYZ])([+-][\d.]+)", code)}
        if code == "STOP":
            tool.wait()
        elif rest := re.fullmatch(r"CYCL DEF 9\.1 DWELL (\d+\.\d+)", code):
            tool.rests.append(float(rest[1]))
        elif re.fullmatch(r"CC( [XYZ][+-]\d+){2}", code):
            tool.plane = "".join(words)
            centre = (words[tool.plane[0]], words[tool.plane[1]])
        elif line := re.fullmatch(r"L( [XYZ][+-][\d.]+){2} R0 F([\d.]+)", code):
            tool.feed = float(line[2])
            tool.line(words)
        elif arc := re.fullmatch(r"C( [XYZ][+-][\d.]+){2} DR([+-])", code):
            demand(centre, "no centre")
            tool.arc(words, 1 if arc[2] == "+" else -1, centre)
        else:
            demand(code.startswith(";") or code == "CYCL DEF 9.0 DWELL TIME", code)
    return tool


def _iso(code: str, tool: Tool, modes: set[str]) -> None:
    """Run a block of modes, of a feed, or of one move."""
    if feed := re.fullmatch(r"F([\d.]+)", code):
        tool.feed = float(feed[1])
    elif re.fullmatch(r"([GD]\d+(\.\d)? ?)+", code):
        modes |= set(code.split())
        for number, plane in _PLANES.items():
            if f"G{number}" in modes:
                tool.plane = plane
    else:
        head, _, rest = code.partition(" ")
        demand(re.fullmatch(r"([A-Z]=?[+-]?\d+\.\d+ ?)+", rest), code)
        words = {letter: float(value) for letter, value in _WORD.findall(rest)}
        demand(modes & {"G54", "G55", "G56", "G57", "G58", "G59"}, "no work offset")
        match head.replace("G0", "G"):
            case "G1":
                tool.line(words)
            case "G2":
                tool.arc(words, -1)
            case "G3":
                tool.arc(words, 1)
            case _:
                raise AlarmError(code)


CONTROLS = {"linuxcnc": linuxcnc, "fanuc": fanuc, "siemens-840d": siemens, "heidenhain": heidenhain}
