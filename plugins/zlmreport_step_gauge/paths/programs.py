"""Probing programs: DMIS, I++ DME commands, and the MV/MS code of Pahk and Kim."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import Any

from pydantic import Field

from zlmreport.plugin import MILLIMETRE, InputError, Options, Words, hookimpl
from zlmreport.plugin.program import PartProgram, plain_name
from zlmreport_step_gauge.keys import TOOL
from zlmreport_step_gauge.paths.path import Move, Point, Probing, ProbingPath, Travel

#: Digits after the decimal point of a unit vector: 10⁻⁷ rad is 0.1 µm over a metre.
_DIRECTION_DIGITS = 7


def coordinates(point: Point, decimals: int) -> tuple[str, str, str]:
    """Write a point, m, in mm; zero has no sign.

    >>> coordinates((0.290865, -1e-9, 0.4), 3)
    ('290.865', '0.000', '400.000')
    """
    x, y, z = (_write_fixed(MILLIMETRE.from_si(at), decimals) for at in point)
    return x, y, z


def direction(vector: Point) -> tuple[str, str, str]:
    """Write a unit vector.

    >>> direction((0.0006, -0.99999982, 0.0))
    ('0.0006000', '-0.9999998', '0.0000000')
    """
    i, j, k = (_write_fixed(each, _DIRECTION_DIGITS) for each in vector)
    return i, j, k


def _write_fixed(value: float, decimals: int) -> str:
    return f"{round(value, decimals) + 0.0:.{decimals}f}"


_DECIMALS = 5


def write_beginning(path: ProbingPath, tool: str | None) -> Iterator[str]:
    """Yield the commands of I++ DME before the first move; without a tool, the machine keeps the one it has.

    Lengths are mm, speeds mm/s. Approach and retract are sent as distances of the tip's surface from the
    face. Whether a server counts them from the surface or from the centre of the tip is (check); with an
    approach larger than the radius, the tip is free either way.

    Raises `InputError` if the path asks for points of the surface: this protocol reports centres of the tip.
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
    yield f"SetProp(Tool.GoToPar.Speed({_write_number(path.speed)}))"
    yield f"SetProp(Tool.PtMeasPar.Speed({_write_number(path.measuring_speed)}))"
    yield f"SetProp(Tool.PtMeasPar.Approach({_write_number(path.approach)}))"
    yield f"SetProp(Tool.PtMeasPar.Search({_write_number(path.search)}))"
    yield f"SetProp(Tool.PtMeasPar.Retract({_write_number(path.retract)}))"
    yield "OnPtMeasReport(X(), Y(), Z(), IJK())"


def write_command(move: Move) -> str:
    """Return the command of I++ DME for a move.

    ``GoTo`` moves the tip's centre; ``PtMeas`` touches the nominal point of a surface whose outward normal is
    IJK, and what it reports is the centre of the tip.
    """
    if isinstance(move, Travel):
        return f"GoTo({_write_at(coordinates(move.to, _DECIMALS))})"
    normal = ", ".join(direction(move.normal))
    return f"PtMeas({_write_at(coordinates(move.target, _DECIMALS))}, IJK({normal}))"


def _write_at(texts: tuple[str, str, str]) -> str:
    return ", ".join(f"{axis}({text})" for axis, text in zip("XYZ", texts, strict=True))


def _write_number(length: float) -> str:
    return f"{MILLIMETRE.from_si(length):.9g}"


class MvMsOptions(Options):
    """The keys of ``mv-ms``."""

    decimals: int = Field(3, ge=0, le=6, description="Digits after the decimal point of coordinates.")


class MvMs:
    """The code of Pahk and Kim's measuring machine (Fig. 4).

    - ``MV x y z`` moves the tip's centre to a point, mm.
    - ``MS x y z`` measures towards a point of the surface.
    - ``PO 1`` follows the first move and each measuring move, as in the figure; the paper does not say
      what it does (check).

    The code has no way to state speeds, the tip, or a remark: all that is set on the machine.
    """

    identifier = "mv-ms"
    title = Words("MV, MS, PO, END code (Pahk and Kim)")
    suffix = ".mvms"
    options: Any = MvMsOptions
    takes = ProbingPath

    def write(self, path: ProbingPath, options: Any) -> str:
        """Return the program."""
        return "".join(f"{line}\n" for line in _write_mv_ms(path, options))


def _write_mv_ms(path: ProbingPath, options: MvMsOptions) -> Iterator[str]:
    for number, move in enumerate(path.moves):
        if isinstance(move, Probing):
            yield _write_mv_ms_line("MS", move.target, options)
        else:
            yield _write_mv_ms_line("MV", move.to, options)
        if isinstance(move, Probing) or number == 0:
            yield "PO 1 ;"
    yield "END;"


def _write_mv_ms_line(word: str, point: Point, options: MvMsOptions) -> str:
    return " ".join([word, *(f"{each:>11}" for each in coordinates(point, options.decimals)), ";"])


_SECONDS_A_MINUTE = 60.0
_LONGEST_LINE = 80
_CONTINUATION = " $"


class DmisOptions(Options):
    """The keys of ``dmis``."""

    decimals: int = Field(4, ge=0, le=6, description="Digits after the decimal point of coordinates.")


class Dmis:
    """DMIS (ISO 22093), of statements that public programs of DMIS 3 and 4 show.

    - ``PRCOMP`` is stated always: ``OFF``, so that a point is the centre of the tip and the effective radius
      can be found from the gauge; ``ON`` where the job says that the machine corrects the radius. (``OFF`` is
      (check): the public programs say ``ON``.)
    - i, j, k are the outward normal of the face.
    - ``F(F003_2)`` is face 3 in cycle 2.
    - A line has 80 characters at most, and goes on in the next where it ends in `` $``.
    - The speed of measuring moves is left to the machine: no confirmed statement sets it.
    """

    identifier = "dmis"
    title = Words("DMIS")
    suffix = ".dmi"
    options: Any = DmisOptions
    takes = ProbingPath

    def write(self, path: ProbingPath, options: Any) -> str:
        """Return the program."""
        return "".join(
            f"{line}\n" for statement in _write_dmis(path, options) for line in _continue_lines(statement)
        )


def _write_dmis(path: ProbingPath, options: DmisOptions) -> Iterator[str]:
    name = plain_name(path.number)
    yield f"DMISMN/'{name}',4.0"
    yield f"FILNAM/'{name}'"
    yield f"$$ {plain_name(path.gauge)}, {len(path.probings)} points"
    yield "UNITS/MM,ANGDEC"
    yield f"DID(OUT)=DEVICE/STOR,'{name}.dmo'"
    yield "OPEN/DID(OUT),FDATA,DMIS,OUTPUT"
    yield "D(MCS)=DATSET/MCS"
    yield f"PRCOMP/{'ON' if path.radius_correction else 'OFF'}"
    diameter = _write_mm(2 * path.tip_radius)
    yield f"S(TIP)=SNSDEF/PROBE,FIXED,CART,0.0,0.0,0.0,0.0,0.0,-1.0,{diameter}"
    yield "SNSLCT/S(TIP)"
    yield f"SNSET/APPRCH,{_write_mm(path.approach)}"
    yield f"SNSET/SEARCH,{_write_mm(path.search)}"
    yield f"SNSET/RETRCT,{_write_mm(path.retract)}"
    yield f"FEDRAT/POSVEL,MPM,{path.speed * _SECONDS_A_MINUTE:.3f}"
    yield "MODE/PROG,MAN"
    for move in path.moves:
        if isinstance(move, Probing):
            yield from _write_measured(move, options)
        else:
            yield f"GOTO/{','.join(coordinates(move.to, options.decimals))}"
    yield "CLOSE/DID(OUT)"
    yield "ENDFIL"


def _write_measured(probing: Probing, options: DmisOptions) -> Iterator[str]:
    label = f"F{probing.face:03d}_{probing.cycle}"
    where = ",".join([*coordinates(probing.target, options.decimals), *direction(probing.normal)])
    yield f"F({label})=FEAT/POINT,CART,{where}"
    yield f"MEAS/POINT,F({label}),1"
    yield f"PTMEAS/CART,{where}"
    yield "ENDMES"
    yield f"OUTPUT/FA({label})"


def _continue_lines(statement: str) -> Iterator[str]:
    """Yield a statement in lines that are not too long: all but the last end in a comma and the sign."""
    while len(statement) > _LONGEST_LINE:
        end = statement.rindex(",", 0, _LONGEST_LINE - len(_CONTINUATION)) + 1
        yield f"{statement[:end]}{_CONTINUATION}"
        statement = statement[end:]
    yield statement


def _write_mm(length: float) -> str:
    return f"{MILLIMETRE.from_si(length):.3f}"


_LAST_TAG = 99999
_STEP = 10


class IppDmeOptions(Options):
    """The keys of ``ippdme``."""

    tool: str = Field("RefTool", pattern=TOOL, description="Name of the tool, as the machine knows it.")


class IppDme:
    r"""Commands of I++ DME 1.4.3, for an executive that sends files of commands.

    Lines end with CR LF, and ``\\`` parts the commands; ``:`` twice is the end. It is the layout of the
    command files of NIST's test suite for I++ DME. A machine on the network needs no file: see ``zlmreport
    capture``.
    """

    identifier = "ippdme"
    title = Words("I++ DME commands")
    suffix = ".prg"
    options: Any = IppDmeOptions
    takes = ProbingPath

    def write(self, path: ProbingPath, options: Any) -> str:
        """Return the program."""
        commands = [*write_beginning(path, options.tool), *map(write_command, path.moves)]
        if len(commands) >= _LAST_TAG:
            raise InputError.at(
                path.place, f"{len(commands)} commands are more than can be numbered; state fewer cycles"
            )
        return "".join(f"{line}\r\n" for line in _write_ippdme(commands))


def _write_ippdme(commands: list[str]) -> Iterator[str]:
    step = _STEP if _STEP * len(commands) < _LAST_TAG else 1
    for number, text in enumerate(commands, start=1):
        yield f"{number * step:05d} {text}"
        yield "\\\\"
    yield f"{_LAST_TAG:05d} EndSession()"
    yield "\\\\"
    yield ":"
    yield ":"


@hookimpl
def zlmreport_part_programs() -> Iterable[PartProgram]:
    """Return the languages in which a path over a gauge is written."""
    return [Dmis(), IppDme(), MvMs()]
