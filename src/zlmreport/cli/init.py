"""``zlmreport init``: a job to begin with; ``zlmreport look``: what a file of measurements holds."""

from __future__ import annotations

import json
import os
import re
from argparse import Namespace
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from importlib.resources import files
from pathlib import Path
from typing import Any

import numpy as np
from pydantic import ValidationError

from zlmreport.cli.terminal import said, shown_path, wrapped
from zlmreport.errors import InputError, Place, ZlmreportError
from zlmreport.files import Document, write_new
from zlmreport.measurement.axis import Axis, AxisKind
from zlmreport.measurement.measurement_set import MeasurementSet
from zlmreport.plugin.protocols import DataSource, SourceContext, SourceProposal
from zlmreport.plugins import Registry, find_plugins
from zlmreport.quantities.formatting import DecimalSign, general_number

_STARTER = ("job.yaml", "laboratory.yaml", "x-axis.csv")

_PLAIN = re.compile(r"[A-Za-z][A-Za-z0-9_./-]*")
_WORDS_OF_YAML = frozenset({"true", "false", "yes", "no", "on", "off", "null", "y", "n"})


def run(options: Namespace) -> int:
    """Write the starter job; no file that is there already is touched."""
    directory: Path = options.directory
    if options.origin:
        looked = looked_at(options.origin, find_plugins(files=options.plugin))
        documents = [Document(directory / "job.yaml", _job(looked, options.origin, directory).encode())]
    else:
        documents = [
            Document(directory / name, files("zlmreport").joinpath("starter", name).read_bytes())
            for name in _STARTER
        ]
    written = write_new(documents)
    for target in written:
        print(shown_path(target))
    print(f"next: zlmreport {shown_path(written[0])}")
    return 0


def _job(looked: Looked, file: Path, directory: Path) -> str:
    """Return a measuring report of a file; what is asked stands in it as comments."""
    axis = looked.read.axis
    first, last = axis.position_unit.from_si(looked.read.target_positions[[0, -1]])
    name = Path(os.path.relpath(file.resolve(), directory.resolve())).as_posix()
    return "\n".join(
        [
            f"# A measuring report of {file.name}. 'zlmreport schema' describes every key.",
            "schema: zlmreport/job/1",
            "certificate: {number: REPORT-0001, kind: report}",
            f"axis: {{name: X, kind: {axis.kind.value}, travel: [{first:.9g}, {last:.9g}]}}",
            "measurement:",
            *(f"  # {question}" for question in looked.proposal.asks),
            *looked.block(name, indent="  "),
            "evaluate:",
            '  - "iso230-2:2014"',
            "output: {formats: [pdf, json]}",
            "",
        ]
    )


@dataclass(frozen=True, slots=True)
class Looked:
    """A file that could be read."""

    source: DataSource  #: By which data source.
    proposal: SourceProposal  #: With which keys, and what is to be asked.
    read: MeasurementSet  #: What it holds.

    def block(self, file: str, indent: str = "") -> Iterator[str]:
        """Yield the lines of the ``source:`` block of a job that names the file so."""
        keys = {"plugin": self.source.identifier, "file": file, **self.proposal.keys}
        yield f"{indent}source:"
        yield from (f"{indent}  {name}: {_in_yaml(value)}" for name, value in keys.items())


def look(options: Namespace) -> int:
    """Print what a file holds."""
    path: Path = options.file
    looked = looked_at(path, find_plugins(files=options.plugin))
    print(*_lines(looked, path), sep="\n")
    return 0


def looked_at(path: Path, registry: Registry) -> Looked:
    """Return how a file can be read.

    Raises `ZlmreportError` if no data source reads it: what the likeliest of them says.
    """
    suffix = path.suffix.casefold()
    sources = sorted(registry.sources, key=lambda each: suffix not in getattr(each, "suffixes", ()))
    first: ZlmreportError | None = None
    for source in sources:
        if "file" not in source.options.model_fields:
            continue
        try:
            for proposal in _proposals(source, path):
                for kind in AxisKind:
                    try:
                        return Looked(source, proposal, _read(source, proposal, path, Axis("X", kind)))
                    except ZlmreportError as error:
                        first = first or error
        except ZlmreportError as error:
            first = first or error
    raise first or InputError.at(Place(str(path)), "no installed data source reads such a file")


def _proposals(source: DataSource, path: Path) -> tuple[SourceProposal, ...]:
    """Return the ways in which a source may read a file: without keys, if it proposes none."""
    proposals = getattr(source, "proposals", None)
    return (*(proposals(path) if proposals else ()), SourceProposal())


def _read(source: DataSource, proposal: SourceProposal, path: Path, axis: Axis) -> MeasurementSet:
    try:
        options = source.options.model_validate({"file": path, **proposal.keys})
    except ValidationError as error:
        raise InputError.at(Place(str(path)), f"{source.identifier} needs more keys: {error}") from error
    return source.read(options, SourceContext(axis, Place(str(path))))


def _lines(looked: Looked, path: Path) -> Iterator[str]:
    yield f"{path}: {said(looked.source.title)}"
    yield from wrapped(_summary(looked.read))
    for remark in looked.read.provenance.remarks:
        yield from wrapped(said(remark))
    if looked.proposal.asks:
        yield ""
        yield "to be answered by who measured"
        for question in looked.proposal.asks:
            yield from wrapped(question)
    yield ""
    yield from looked.block(path.name)


def _summary(read: MeasurementSet) -> str:
    """Return in a line what a measurement set holds."""
    place, size = read.axis.position_unit, read.axis.deviation_unit
    at, deviation = place.from_si(read.target_positions), size.from_si(read.deviation)
    count, missing = int(np.isfinite(deviation).sum()), len(read.missing())
    travel = f"from {_number(at[0])} to {_number(at[-1])} {place.symbol}"
    directions = "both directions" if read.is_bidirectional else "one direction"
    parts = [
        f"{count} readings of {_counted(len(at), 'target')} {travel}",
        f"{_counted(len(read.runs), 'run')}, {directions}",
    ]
    if count:
        smallest, largest = np.nanmin(deviation), np.nanmax(deviation)
        parts.append(f"deviations {_number(smallest)} to {_number(largest)} {size.symbol}")
    parts.append(f"{missing} missing" if missing else "nothing missing")
    return "; ".join(parts)


def _counted(number: int, what: str) -> str:
    return f"{number} {what}{'' if number == 1 else 's'}"


def _number(value: float) -> str:
    return general_number(float(f"{value:.6g}"), DecimalSign.POINT)


def _in_yaml(value: Any) -> str:
    """Return a value in YAML, on one line: text without quotation marks where that is safe."""
    if isinstance(value, Mapping):
        return f"{{{', '.join(f'{_in_yaml(name)}: {_in_yaml(each)}' for name, each in value.items())}}}"
    if isinstance(value, list | tuple):
        return f"[{', '.join(map(_in_yaml, value))}]"
    if isinstance(value, str) and _PLAIN.fullmatch(value) and value.casefold() not in _WORDS_OF_YAML:
        return value
    return json.dumps(value, ensure_ascii=False)
