"""Probing programs in the code of Pahk and Kim (Fig. 4): ``MV``, ``MS``, ``PO`` and ``END``.

- ``MV x y z`` moves the tip's centre to a point, mm.
- ``MS x y z`` measures towards a point of the surface.
- ``PO 1`` follows the first move and each measuring move, as in the figure; the paper does not say what it
  does (check).

The code has no way to state speeds, the tip, or a remark: all that is set on the machine.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import Any

from pydantic import Field

from zlmreport.job.types import Options
from zlmreport.language import Words
from zlmreport.plugin import hookimpl
from zlmreport.plugin.protocols import ProbingProgram
from zlmreport.step_gauge.path import Point, Probing, ProbingPath
from zlmreport.step_gauge.program_text import coordinates


class MvMsOptions(Options):
    """The keys of ``mv-ms``."""

    decimals: int = Field(3, ge=0, le=6, description="Digits after the decimal point of coordinates.")


class MvMs:
    """The code of Pahk and Kim's measuring machine."""

    identifier = "mv-ms"
    title = Words(en="MV, MS, PO, END code (Pahk and Kim)", de="Code aus MV, MS, PO, END (Pahk und Kim)")
    suffix = ".mvms"
    options: Any = MvMsOptions

    def write(self, path: ProbingPath, options: Any) -> str:
        """Return the program."""
        return "".join(f"{line}\n" for line in _lines(path, options))


def _lines(path: ProbingPath, options: MvMsOptions) -> Iterator[str]:
    for number, move in enumerate(path.moves):
        if isinstance(move, Probing):
            yield _line("MS", move.target, options)
        else:
            yield _line("MV", move.to, options)
        if isinstance(move, Probing) or number == 0:
            yield "PO 1 ;"
    yield "END;"


def _line(word: str, point: Point, options: MvMsOptions) -> str:
    return " ".join([word, *(f"{each:>11}" for each in coordinates(point, options.decimals)), ";"])


@hookimpl
def zlmreport_probing_programs() -> Iterable[ProbingProgram]:
    """Return the writer."""
    return [MvMs()]
