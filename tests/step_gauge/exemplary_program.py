"""A writer of probing programs that does everything right, in two words; the tests of the kit make it sin."""

from __future__ import annotations

from typing import Any

from zlmreport.plugin import Options, Words
from zlmreport.plugin.program import plain_name
from zlmreport_step_gauge.paths.path import Probing, ProbingPath
from zlmreport_step_gauge.paths.programs import coordinates, direction
from zlmreport_step_gauge.testing import Stated


class ExemplaryProbing:
    identifier = "exemplary-probing"
    title = Words(en="Two words", de="Zwei Wörter")
    suffix = ".words"
    options: Any = Options

    def write(self, path: ProbingPath, _options: Any) -> str:
        lines = [f"SAY {plain_name(path.gauge)}"]
        for move in path.moves:
            if isinstance(move, Probing):
                lines.append(" ".join(["TOUCH", *coordinates(move.target, 4), *direction(move.normal)]))
            else:
                lines.append(" ".join(["GO", *coordinates(move.to, 4)]))
        return "".join(f"{line}\n" for line in lines)


def read_words(text: str) -> list[Stated]:
    """Read a program of these words."""
    found = []
    for line in text.splitlines():
        word, *rest = line.split(" ")
        if word == "SAY":
            continue
        x, y, z, *normal = map(float, rest)
        assert (word, len(normal)) in {("GO", 0), ("TOUCH", 3)}
        found.append(
            Stated(word == "TOUCH", (x, y, z), (normal[0], normal[1], normal[2]) if normal else None)
        )
    return found
