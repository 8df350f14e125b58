"""Probing programs in DMIS (ISO 22093), of statements that public programs of DMIS 3 and 4 show.

- ``PRCOMP`` is stated always: ``OFF``, so that a point is the centre of the tip and the effective radius can
  be found from the gauge; ``ON`` where the job says that the machine corrects the radius. (``OFF`` is
  (check): the public programs say ``ON``.)
- i, j, k are the outward normal of the face.
- ``F(F003_2)`` is face 3 in cycle 2.
- A line has 80 characters at most, and goes on in the next where it ends in `` $``.
- The speed of measuring moves is left to the machine: no confirmed statement sets it.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import Any

from pydantic import Field

from zlmreport.job.types import Options
from zlmreport.language import Words
from zlmreport.plugin import hookimpl
from zlmreport.plugin.protocols import ProbingProgram
from zlmreport.quantities.units import MILLIMETRE
from zlmreport.step_gauge.path import Probing, ProbingPath
from zlmreport.step_gauge.program_text import coordinates, direction, plain

_SECONDS_A_MINUTE = 60.0
_LONGEST_LINE = 80
_CONTINUATION = " $"


class DmisOptions(Options):
    """The keys of ``dmis``."""

    decimals: int = Field(4, ge=0, le=6, description="Digits after the decimal point of coordinates.")


class Dmis:
    """DMIS."""

    identifier = "dmis"
    title = Words(en="DMIS", de="DMIS")
    suffix = ".dmi"
    options: Any = DmisOptions

    def write(self, path: ProbingPath, options: Any) -> str:
        """Return the program."""
        return "".join(f"{line}\n" for statement in _lines(path, options) for line in _continued(statement))


def _lines(path: ProbingPath, options: DmisOptions) -> Iterator[str]:
    name = plain(path.number)
    yield f"DMISMN/'{name}',4.0"
    yield f"FILNAM/'{name}'"
    yield f"$$ {plain(path.gauge)}, {len(path.probings)} points"
    yield "UNITS/MM,ANGDEC"
    yield f"DID(OUT)=DEVICE/STOR,'{name}.dmo'"
    yield "OPEN/DID(OUT),FDATA,DMIS,OUTPUT"
    yield "D(MCS)=DATSET/MCS"
    yield f"PRCOMP/{'ON' if path.radius_correction else 'OFF'}"
    diameter = _mm(2 * path.tip_radius)
    yield f"S(TIP)=SNSDEF/PROBE,FIXED,CART,0.0,0.0,0.0,0.0,0.0,-1.0,{diameter}"
    yield "SNSLCT/S(TIP)"
    yield f"SNSET/APPRCH,{_mm(path.approach)}"
    yield f"SNSET/SEARCH,{_mm(path.search)}"
    yield f"SNSET/RETRCT,{_mm(path.retract)}"
    yield f"FEDRAT/POSVEL,MPM,{path.speed * _SECONDS_A_MINUTE:.3f}"
    yield "MODE/PROG,MAN"
    for move in path.moves:
        if isinstance(move, Probing):
            yield from _measured(move, options)
        else:
            yield f"GOTO/{','.join(coordinates(move.to, options.decimals))}"
    yield "CLOSE/DID(OUT)"
    yield "ENDFIL"


def _measured(probing: Probing, options: DmisOptions) -> Iterator[str]:
    label = f"F{probing.face:03d}_{probing.cycle}"
    where = ",".join([*coordinates(probing.target, options.decimals), *direction(probing.normal)])
    yield f"F({label})=FEAT/POINT,CART,{where}"
    yield f"MEAS/POINT,F({label}),1"
    yield f"PTMEAS/CART,{where}"
    yield "ENDMES"
    yield f"OUTPUT/FA({label})"


def _continued(statement: str) -> Iterator[str]:
    """Yield a statement in lines that are not too long: all but the last end in a comma and the sign."""
    while len(statement) > _LONGEST_LINE:
        end = statement.rindex(",", 0, _LONGEST_LINE - len(_CONTINUATION)) + 1
        yield f"{statement[:end]}{_CONTINUATION}"
        statement = statement[end:]
    yield statement


def _mm(length: float) -> str:
    return f"{MILLIMETRE.from_si(length):.3f}"


@hookimpl
def zlmreport_probing_programs() -> Iterable[ProbingProgram]:
    """Return the writer."""
    return [Dmis()]
