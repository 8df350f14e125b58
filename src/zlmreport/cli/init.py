"""``zlmreport init``: a job or a machine file to begin with; ``look``: what a file of measurements holds."""

from __future__ import annotations

from argparse import Namespace
from collections.abc import Iterator, Sequence
from importlib.resources import files
from pathlib import Path

import numpy as np

from zlmreport.cli.terminal import say, show_path, wrap
from zlmreport.errors import InputError, Place, count_in_words
from zlmreport.files import Document, write_new
from zlmreport.language.formatting import DecimalSign, write_general_number
from zlmreport.looking import Looked, look_at, write_job_of
from zlmreport.machines.beginning import begin_machine
from zlmreport.measurement.measurand import Coordinate
from zlmreport.measurement.measurement_set import MeasurementSet
from zlmreport.measurement.units import Unit, write_behind
from zlmreport.plugin.registry import Registry, find_plugins

_PLACE = Place("zlmreport init")
_STARTER = ("job.yaml", "laboratory.yaml", "x-axis.csv")


def run(options: Namespace) -> int:
    """Write the starter job; no file that is there already is touched."""
    directory: Path = options.directory
    if options.machine and options.origin:
        raise InputError.at(_PLACE, "--from writes a job, and --machine a machine file: take one of them")
    if options.sheet and not options.origin:
        raise InputError.at(_PLACE, "--sheet names a sheet of the workbook of --from: state both")
    if options.machine:
        return _begin_machine(options.machine, directory, find_plugins(files=options.plugin))
    if options.origin:
        looked = look_at(options.origin, find_plugins(files=options.plugin), options.sheet)
        documents = [
            Document(directory / "job.yaml", write_job_of(looked, options.origin, directory).encode())
        ]
    else:
        documents = [
            Document(directory / name, files("zlmreport").joinpath("starter", name).read_bytes())
            for name in _STARTER
        ]
    written = write_new(documents)
    for target in written:
        print(show_path(target))
    print(f"next: zlmreport {show_path(written[0])}")
    return 0


def _begin_machine(files: Sequence[Path], directory: Path, registry: Registry) -> int:
    """Write a machine file with its jobs, and say what was taken for what and what is to be filled in."""
    begun = begin_machine(files, directory, registry)
    for target in write_new(begun.documents):
        print(show_path(target))
    print("", "taken for", sep="\n")
    for each in begun.jobs:
        print(*wrap(f"{each.file.name}: {each.said}"), sep="\n")
    open_ = list(begun.to_fill_in())
    if open_:
        print("", "to fill in", sep="\n")
        for path, number, what in open_:
            print(*wrap(f"{show_path(path)}:{number}: {what}"), sep="\n")
    print("", f"next: zlmreport machine check {show_path(begun.documents[0].path)}", sep="\n")
    return 0


def look(options: Namespace) -> int:
    """Print what a file holds."""
    path: Path = options.file
    looked = look_at(path, find_plugins(files=options.plugin), options.sheet)
    print(*_tell_lines(looked, path), sep="\n")
    return 0


def _tell_lines(looked: Looked, path: Path) -> Iterator[str]:
    yield f"{path}: {say(looked.source.title)}"
    for name, read in (looked.read.tests or {"": looked.read}).items():
        yield from wrap(f"{name}: {_summarise(read)}" if name else _summarise(read))
    remarks = dict.fromkeys(say(each) for read in looked.read.lines for each in read.provenance.remarks)
    for remark in remarks:
        yield from wrap(remark)
    if looked.proposal.asks:
        yield ""
        yield "to be answered by who measured"
        for question in looked.proposal.asks:
            yield from wrap(question)
    yield ""
    yield from looked.write_block(path.name)
    yield from looked.write_groups()


def _summarise(read: MeasurementSet) -> str:
    """Return in a line what a measurement set holds."""
    place, size = read.axis.position_unit, read.axis.deviation_unit
    at, deviation = place.from_si(read.target_positions), size.from_si(read.deviation)
    count, missing = int(np.isfinite(deviation).sum()), len(read.missing())
    if read.axis.measurand.coordinate is Coordinate.TIME:
        return _summarise_over_time(read, count)
    is_circle = read.axis.measurand.is_closed
    target, run, sense = ("angle", "turn", "sense") if is_circle else ("target", "run", "direction")
    senses = f"both {sense}s" if read.is_bidirectional else f"one {sense}"
    single = f"at {_write_number(at[0])}{write_behind(place.symbol)}"
    travel = f"from {_write_range(at[0], at[-1], place)}" if len(at) > 1 else single
    parts = [
        f"{count_in_words(count, 'reading')} of {count_in_words(len(at), target)} {travel}",
        f"{count_in_words(len(read.runs), run)}, {senses}",
    ]
    if count:
        parts.append(f"deviations {_write_range(np.nanmin(deviation), np.nanmax(deviation), size)}")
    parts.append(f"{missing} missing" if missing else "nothing missing")
    return "; ".join(parts)


def _summarise_over_time(read: MeasurementSet, count: int) -> str:
    """Return in a line what was read over time, and what was logged beside it."""
    place, size = read.axis.position_unit, read.axis.deviation_unit
    lasts = _write_number(place.from_si(float(read.target_positions[-1] - read.target_positions[0])))
    parts = [f"{count_in_words(count, 'reading')} over {lasts} {place.symbol}"]
    if count:
        smallest, largest = (size.from_si(float(end(read.deviation))) for end in (np.nanmin, np.nanmax))
        parts.append(_write_range(smallest, largest, size))
    if read.conditions:
        parts.append(f"with {', '.join(read.conditions)}")
    return "; ".join(parts)


def _write_range(low: float, high: float, unit: Unit) -> str:
    """Write two values in a unit: ``−20 to 20 mm``, ``0° to 40°``."""
    behind = write_behind(unit.symbol)
    between = "" if behind.startswith(" ") else behind
    return f"{_write_number(low)}{between} to {_write_number(high)}{behind}"


def _write_number(value: float) -> str:
    return write_general_number(float(f"{value:.6g}"), DecimalSign.POINT)
