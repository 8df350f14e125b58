"""The commands of I++ DME 1.4.3 that lead a probe along a path: for programs and for a live machine alike.

Lengths are mm, speeds mm/s. ``GoTo`` moves the tip's centre; ``PtMeas`` touches the nominal point of a
surface whose outward normal is IJK, and what it reports is the centre of the tip.

Approach and retract are sent as distances of the tip's surface from the face. Whether a server counts them
from the surface or from the centre of the tip is (check); with an approach larger than the radius, the tip
is free either way.
"""

from __future__ import annotations

from collections.abc import Iterator

from zlmreport.errors import InputError
from zlmreport.quantities.units import MILLIMETRE
from zlmreport.step_gauge.path import Move, ProbingPath, Travel
from zlmreport.step_gauge.program_text import coordinates, direction

_DECIMALS = 5


def beginning(path: ProbingPath, tool: str | None) -> Iterator[str]:
    """Yield the commands before the first move; without a tool, the machine keeps the one that it has.

    Raises
    ------
    InputError
        If the path asks for points of the surface: this protocol reports centres of the tip.
    """
    if path.radius_correction:
        raise InputError.at(
            path.place,
            "I++ DME reports centres of the tip, and step_gauge.radius_correction says that the machine "
            "corrects the radius; state false there",
        )
    yield "StartSession()"
    yield "Home()"
    if tool is not None:
        yield f'ChangeTool("{tool}")'
    yield f"SetProp(Tool.GoToPar.Speed({_number(path.speed)}))"
    yield f"SetProp(Tool.PtMeasPar.Speed({_number(path.measuring_speed)}))"
    yield f"SetProp(Tool.PtMeasPar.Approach({_number(path.approach)}))"
    yield f"SetProp(Tool.PtMeasPar.Search({_number(path.search)}))"
    yield f"SetProp(Tool.PtMeasPar.Retract({_number(path.retract)}))"
    yield "OnPtMeasReport(X(), Y(), Z(), IJK())"


def command(move: Move) -> str:
    """Return the command of a move."""
    if isinstance(move, Travel):
        return f"GoTo({_at(coordinates(move.to, _DECIMALS))})"
    normal = ", ".join(direction(move.normal))
    return f"PtMeas({_at(coordinates(move.target, _DECIMALS))}, IJK({normal}))"


def _at(texts: tuple[str, str, str]) -> str:
    return ", ".join(f"{axis}({text})" for axis, text in zip("XYZ", texts, strict=True))


def _number(length: float) -> str:
    return f"{MILLIMETRE.from_si(length):.9g}"
