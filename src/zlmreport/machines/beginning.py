"""``zlmreport init --machine``: a machine file and its jobs from files of readings, and what to fill in.

What a file or its name tells is written; what it leaves open stands as a commented line, marked with what to
fill in. Nothing is guessed in silence.
"""

from __future__ import annotations

import os
import re
import textwrap
import unicodedata
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from zlmreport.errors import InputError, Place
from zlmreport.files import Document
from zlmreport.looking import Looked, look_at
from zlmreport.machines.file_names import (
    find_circle_by_name,
    find_diagonal_by_name,
    find_error_by_name,
    find_rotary_axis_by_name,
)
from zlmreport.machines.kinematics import ERRORS, SQUARENESS
from zlmreport.measurement.error_symbol import find_error_named
from zlmreport.measurement.measurand import ANGLE, POSITIONING
from zlmreport.plugin.registry import Registry

#: Marks a line that a user has to complete.
FILL_IN = "fill in:"
_WIDTH = 100
_SHARED, _MACHINE, _DOCUMENT = "shared.yaml", "machine.yaml", "document.yaml"
_OF_POSITIONS, _OF_LINES, _OF_CIRCLES = "iso230-2:2014", "iso230-1:2012", "iso230-4:2005"
_OF_DIAGONALS = "iso230-6:2002"
#: Its job.
_DIAGONALS = "diagonals"
_OF_POSITION = ("EXX", "EYY", "EZZ")
#: What is no part of a job's name, which is its certificate's number, too; and how long that may be.
_NOT_PLAIN, _LONGEST = re.compile(r"[^A-Za-z0-9._-]+"), 80


@dataclass(frozen=True, slots=True)
class BegunJob:
    """The job of a file of readings."""

    file: Path
    stem: str
    text: str
    error: str  #: Which of the 21 it is; empty of a circle, of what the name does not tell, of other things.
    doubt: str = ""  #: What is to be settled before the machine file may name it; empty where it may.
    is_circle: bool = False
    is_other: bool = False  #: Whether it is neither circle nor error, but another quantity: a drift, a plate.
    source: str = ""  #: Its data source, on a line.
    travel: str = ""  #: Of the axis that moved, mm.

    @property
    def said(self) -> str:
        """What the file was taken for."""
        if self.is_circle:
            return "a circle"
        if self.is_other:
            return self.doubt
        return f"not known: {self.doubt}" if self.doubt else self.error


@dataclass(frozen=True, slots=True)
class BegunMachine:
    """A machine file, its jobs, and what they share."""

    jobs: tuple[BegunJob, ...]
    documents: tuple[Document, ...]

    def to_fill_in(self) -> Iterator[tuple[Path, int, str]]:
        """Yield each line that has to be completed: its file, its number, what belongs there."""
        for each in self.documents:
            for number, line in enumerate(each.content.decode().splitlines(), 1):
                if FILL_IN in line:
                    yield each.path, number, line.partition(FILL_IN)[2].strip()


def begin_machine(files: Sequence[Path], directory: Path, registry: Registry) -> BegunMachine:
    """Return the documents of a machine file in a folder that names jobs for files of readings.

    `files`: Tables, or folders of them.

    Raises `InputError` or `AccessError` if one cannot be read.
    """
    jobs: list[BegunJob] = []
    diagonals: dict[str, tuple[Path, str]] = {}
    for file in _list_files(files):
        looked = look_at(file, registry)
        diagonal = find_diagonal_by_name(file.stem)
        if diagonal and diagonal not in diagonals:
            diagonals[diagonal] = file, _write_source(looked, file, directory)
        else:
            jobs.append(_begin_job(file, looked, directory, jobs))
    if diagonals:
        jobs.append(_begin_diagonals(diagonals, jobs))
    square = _begin_squareness(jobs)
    texts = {
        _MACHINE: _write_machine(jobs, square),
        _SHARED: _write_shared(),
        _DOCUMENT: _write_document(jobs),
    }
    texts |= {f"{each.stem}.yaml": each.text for each in jobs} | dict(square)
    documents = (Document(directory / name, text.encode()) for name, text in texts.items())
    return BegunMachine(tuple(jobs), tuple(documents))


def _list_files(files: Iterable[Path]) -> list[Path]:
    found: list[Path] = []
    for each in files:
        inside = sorted(path for path in each.iterdir() if path.is_file()) if each.is_dir() else [each]
        found += (path for path in inside if not path.name.startswith(".") and path not in found)
    if not found:
        raise InputError.at(Place("zlmreport init"), "--machine names no file of readings")
    return found


def _begin_job(file: Path, looked: Looked, directory: Path, others: Sequence[BegunJob]) -> BegunJob:
    taken = {"machine", "shared", "document", _DIAGONALS, *(each.stem for each in others)}
    taken |= {f"squareness-{symbol}" for symbol in SQUARENESS}
    plain = _write_plain(file.stem)
    stem = next(
        name for name in (plain, *(f"{plain}-{number}" for number in range(2, 1000))) if name not in taken
    )
    name = Path(os.path.relpath(file.resolve(), directory.resolve())).as_posix()
    source = list(looked.write_block(name, indent="  "))
    head = [
        f"# Of {file.name}; what is marked '{FILL_IN[:-1]}' only who measured can say.",
        "schema: zlmreport/job/1",
        f"extends: {_SHARED}",
        f"certificate: {{number: {stem}}}",
    ]
    if looked.proposal.circle:
        lines = [*head, *_write_circle(file, looked), "measurement:", *source, f'evaluate: ["{_OF_CIRCLES}"]']
        return BegunJob(file, stem, _join(lines), "", is_circle=True)
    if looked.proposal.quantity:
        said = f"{looked.proposal.quantity.identifier}, none of the 21 errors"
        lines = [*head, "measurement:", *source, f'evaluate: ["{looked.standard}"]']
        return BegunJob(file, stem, _join(lines), "", said, is_other=True)
    rotary = find_rotary_axis_by_name(file.stem)
    if rotary:
        said = f"positions of the rotary axis {rotary}, none of the 21 errors"
        lines = [*head, f"axis: {{name: {rotary}, kind: rotary, travel: {_write_travel(looked)}}} # degrees"]
        lines += ["measurement:", *_write_asks(looked, "kind: rotary"), *source]
        lines += [
            f'evaluate: ["{_OF_POSITIONS}"]',
            _OF_ROTARY,
        ]
        return BegunJob(file, stem, _join(lines), "", said, is_other=True)
    named = find_error_by_name(file.stem)
    clash = next((each for each in others if named.symbol and each.error == named.symbol), None)
    doubt = f"{named.symbol} is {clash.file.name} already; which error it is" if clash else named.doubt
    lines = [*head, *_write_axis(named.symbol, doubt, looked)]
    lines += [*source, f'evaluate: ["{_choose_standard_of(named.symbol)}"]', _INSTRUMENT]
    own = _write_source(looked, file, directory)
    return BegunJob(file, stem, _join(lines), named.symbol, doubt, source=own, travel=_write_travel(looked))


def _write_plain(name: str) -> str:
    """Return a name as a job has it: letters without their marks, nothing else that a number may not have."""
    letters = unicodedata.normalize("NFKD", name).encode("ascii", "ignore").decode()
    return _NOT_PLAIN.sub("-", letters).strip("-._")[:_LONGEST] or "readings"


def _choose_standard_of(symbol: str) -> str:
    is_position = not symbol or find_error_named(symbol).measurand == POSITIONING
    return _OF_POSITIONS if is_position else _OF_LINES


def _write_axis(symbol: str, doubt: str, looked: Looked) -> Iterator[str]:
    """Yield the lines of a job that say which axis moved, and what was measured of it."""
    name = symbol[2] if symbol else "X"
    yield f"axis: {{name: {name}, travel: {_write_travel(looked)}}} # mm"
    yield "measurement:"
    if doubt:
        yield f"  # error: {symbol or 'EXX'} # {FILL_IN} {doubt} (ISO 230-1: {', '.join(ERRORS[:4])} …)"
    elif symbol != f"E{name}{name}":
        yield f"  error: {symbol}"
    if not doubt:
        others = ", ".join(f"{each}: 0" for each in "XYZ" if each != name)
        yield f"  # at: {{{others}}} # mm: where the other axes stood; without it arms of angles count from 0"
    is_angle = bool(symbol) and find_error_named(symbol).measurand == ANGLE
    yield from _write_asks(looked, "units:" if is_angle else "")
    if is_angle:
        yield "  # Are the angles in arc seconds? If they are in µrad, say units: {deviation: urad}."


def _write_asks(looked: Looked, answered: str) -> Iterator[str]:
    """Yield what the file leaves open as comments, but what is answered already: questions with this text."""
    yield from (f"  # {each}" for each in looked.proposal.asks if not (answered and answered in each))


_INSTRUMENT = (
    "# instrument: {name: …, expanded_uncertainty: 0.2 + 0.4*L} # µm, L in m, k = 2; else scatter alone"
)

_OF_ROTARY = "# instrument: {name: …, expanded_uncertainty: 1} # arc seconds, k = 2; else scatter alone"


def _write_circle(file: Path, looked: Looked) -> Iterator[str]:
    """Yield the lines of a job that say which circle was run."""
    named = find_circle_by_name(file.stem)
    nominal = looked.proposal.circle
    is_told = nominal is not None and "radius" not in " ".join(looked.proposal.asks)
    radius = nominal.radius * 1e3 if nominal is not None and is_told else named.radius
    yield "circle:"
    if named.plane:
        yield f"  plane: {named.plane}"
    else:
        yield f"  # plane: XY # {FILL_IN} the plane: XY, YZ or ZX; XY without it"
    yield _write_number("radius", radius, 150, "nominal radius, mm")
    yield _write_number("feed", named.feed, 1000, "feed along the path, mm/min")
    yield f"  # centre: [0, 0, 0] # {FILL_IN} centre of the circle in the machine: X, Y, Z, mm"


def _write_number(key: str, value: float | None, example: float, meaning: str) -> str:
    if value is None:
        return f"  # {key}: {example:g} # {FILL_IN} {meaning}"
    return f"  {key}: {value:.9g} # {meaning}"


def _begin_squareness(jobs: Sequence[BegunJob]) -> list[tuple[str, str]]:
    """Return a job for each pair of straightness lines that one square may have been measured by."""
    by_error = {each.error: each for each in jobs if each.error and not each.doubt}
    found = []
    for symbol in SQUARENESS:
        lines = find_error_named(symbol).lines
        if not all(each in by_error for each in lines):
            continue
        tests = [
            f"    {each[2].lower()}: {{error: {each}, source: {by_error[each].source}}}" for each in lines
        ]
        name = f"squareness-{symbol}.yaml"
        text = [
            f"# {symbol} from both lines, if they were measured along the two sides of one square.",
            "schema: zlmreport/job/1",
            f"extends: {_SHARED}",
            f"certificate: {{number: squareness-{symbol}}}",
            "measurement:",
            f"  error: {symbol}",
            "  tests:",
            *tests,
            "# square: {error: 0, expanded_uncertainty: 0.5} # arc seconds, from the square's certificate",
            "# instrument: {name: indicator, expanded_uncertainty: 0.3} # µm, k = 2",
            f'evaluate: ["{_OF_LINES}"]',
        ]
        found.append((name, _join(text)))
    return found


def _begin_diagonals(found: Mapping[str, tuple[Path, str]], jobs: Sequence[BegunJob]) -> BegunJob:
    """Return the job of the diagonals of a work space, each of which has a file."""
    travels = {each.error[2]: each.travel for each in jobs if each.error in _OF_POSITION and not each.doubt}
    sides = ", ".join(f"{axis}: {travels.get(axis, '[0, 500]')}" for axis in "XYZ")
    is_known = len(travels) == len(_OF_POSITION)
    why = "as the axes were measured" if is_known else f"{FILL_IN} the sides of the work space"
    lines = [
        "# The diagonals of the work space, by the signs of their directions in X, Y and Z.",
        "schema: zlmreport/job/1",
        f"extends: {_SHARED}",
        f"certificate: {{number: {_DIAGONALS}}}",
        f"{'' if is_known else '# '}axes: {{{sides}}} # mm, {why}",
        "measurement:",
        "  tests:",
        *(f"    {name}: {{source: {source}}}" for name, (_, source) in found.items()),
        f'evaluate: ["{_OF_DIAGONALS}"]',
        _INSTRUMENT,
    ]
    (first, _), *_ = found.values()
    said = f"diagonals of the work space: {', '.join(found)}"
    return BegunJob(first, _DIAGONALS, _join(lines), "", said, is_other=True)


def _write_source(looked: Looked, file: Path, directory: Path) -> str:
    """Return the source of a job in a folder on a line."""
    name = Path(os.path.relpath(file.resolve(), directory.resolve())).as_posix()
    _, *keys = looked.write_block(name)
    return f"{{{', '.join(each.strip() for each in keys)}}}"


def _write_travel(looked: Looked) -> str:
    first, last = looked.read.axis.position_unit.from_si(looked.read.target_positions[[0, -1]])
    return f"[{first:.9g}, {last:.9g}]"


def _write_document(jobs: Sequence[BegunJob]) -> str:
    """Return the job of one document on all that was measured."""
    settled = [each for each in jobs if each.is_circle or each.is_other or not each.doubt]
    return _join(
        [
            "# One document on all of it; zlmreport document.yaml makes it.",
            "schema: zlmreport/job/1",
            f"extends: {_SHARED}",
            "certificate: {number: REPORT-0001}",
            "measurements:",
            *(f"  - {each.stem}.yaml" for each in settled),
            "output: {formats: [pdf, json]}",
        ]
    )


def _write_shared() -> str:
    return _join(
        [
            "# What all tests of this machine share.",
            "certificate: {kind: report}",
            "# machine: {manufacturer: …, model: …, serial: …} # which machine it is",
            "# measurement: {date: 2026-11-16} # when it was measured",
            "# laboratory: {name: …} # who measured it",
        ]
    )


def _write_machine(jobs: Sequence[BegunJob], square: Sequence[tuple[str, str]]) -> str:
    known = [each for each in jobs if each.error and not each.doubt]
    unsettled = [each for each in jobs if each.doubt and not each.is_other]
    tests = [each for each in jobs if each.is_circle or each.stem == _DIAGONALS]
    lacking = ", ".join(each for each in ERRORS if each not in {job.error for job in known})
    lines = [
        "# A machine: what is known of its axes, and the tests that it is held against.",
        "#   zlmreport machine check machine.yaml      what is known, and what is not",
        "#   zlmreport machine diagnose machine.yaml   which effect the circles show",
        "schema: zlmreport/machine/1",
        f"extends: {_SHARED}",
        f"# {FILL_IN} from workpiece to tool, F the bed; XYFZ: table in X on a saddle in Y, column in Z",
        "chain: XYFZ",
        "# tool: [0, 0, 120] # mm, from the point that the axis errors refer to",
        "errors:" if known else "errors: []",
        *(f"  - {each.stem}.yaml # {each.error}" for each in known),
        *(f"  # - {each.stem}.yaml # {FILL_IN} its error in it, then name it here" for each in unsettled),
        *(f"  # - {name} # if one square was used for both lines, stated in it" for name, _ in square),
        "# Not measured, and bounded by assumptions of this program unless you state bounds:",
        *(f"#   {line}" for line in textwrap.wrap(lacking, _WIDTH)),
        "# bounds: {EAX: 5} # µm over the travel; of angles and squareness arc seconds",
        "tests:" if tests else "tests: []",
        *(f"  - {each.stem}.yaml" for each in tests),
    ]
    return _join(lines)


def _join(lines: Iterable[str]) -> str:
    return "\n".join([*lines, ""])
