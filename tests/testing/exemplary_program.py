"""A writer of part programs that does everything right, in four words; the tests of the kit make it sin."""

from __future__ import annotations

import math
from typing import Any

from zlmreport.plugin import Words
from zlmreport.plugin.program import Motion, ProgramOptions, program_heading


class ExemplaryProgram:
    identifier = "exemplary-steps"
    title = Words(en="Four words", de="Vier Wörter")
    suffix = ".steps"
    options: Any = ProgramOptions

    def write(self, motion: Motion, options: Any) -> str:
        lines = [*(f"SAY {text}" for text in program_heading(motion)), f"FEED {motion.feed:g}"]
        for stop in motion.in_decimals(options.decimals).stops:
            lines.append(f"GO {stop.position:.{options.decimals}f}")
            if stop.reading:
                lines.append(f"REST {motion.dwell:g}")
        return "".join(f"{line}\n" for line in lines)


def run_steps(text: str) -> list[tuple[float, float, float]]:
    """Run a program of these words."""
    stops: list[tuple[float, float, float]] = []
    feed = math.nan
    for line in text.splitlines():
        word, _, rest = line.partition(" ")
        if word == "GO":
            stops.append((float(rest), 0.0, feed))
        elif word == "REST":
            stops[-1] = stops[-1][0], float(rest), stops[-1][2]
        elif word == "FEED":
            feed = float(rest)
        else:
            assert word == "SAY"
    return stops
