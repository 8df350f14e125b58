"""``zlmreport look``: what a file that no job describes holds, and the job that is written for it."""

from __future__ import annotations

import os
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace
from pathlib import Path

from pydantic import ValidationError

from zlmreport.errors import AccessError, InputError, Place, ZlmreportError
from zlmreport.job.yaml_text import write_in_a_line
from zlmreport.measurement.axis import Axis, AxisKind
from zlmreport.measurement.measurand import CIRCLE, list_measurands_of
from zlmreport.measurement.measurement_set import MeasurementSet, join_lines
from zlmreport.plugin.protocols import DataSource, SourceContext, SourceProposal
from zlmreport.plugin.registry import Registry

#: Axes that turn, by their letters (ISO 841).
_TURNING = frozenset("ABC")
#: How an axis is called that the file does not name.
_UNNAMED = {AxisKind.LINEAR: "X", AxisKind.ROTARY: "C"}
#: How the name of a table ends.
_OF_TABLES = ".csv"
#: By which standard a job that is begun evaluates an axis, and a circle.
_OF_AXES, _OF_CIRCLES = "iso230-2:2014", "iso230-4:2005"


@dataclass(frozen=True, slots=True)
class Looked:
    """A file that could be read."""

    source: DataSource  #: By which data source.
    proposal: SourceProposal  #: With which keys, and what is to be asked.
    read: MeasurementSet  #: What it holds.
    standard: str  #: By which a job that is begun evaluates it.

    def write_block(self, file: str, indent: str = "") -> Iterator[str]:
        """Yield the lines of the ``source:`` block of a job that names the file so, and of its tests."""
        keys = {"plugin": self.source.identifier, "file": file, **self.proposal.keys}
        yield f"{indent}source:"
        yield from (f"{indent}  {name}: {write_in_a_line(value)}" for name, value in keys.items())
        if self.proposal.tests:
            yield f"{indent}tests: {write_in_a_line({name: {} for name in self.proposal.tests})}"

    def write_groups(self) -> Iterator[str]:
        """Yield the lines of the groups at the top of a job that the source needs."""
        yield from (f"{name}: {write_in_a_line(keys)}" for name, keys in self.proposal.beside.items())


def look_at(path: Path, registry: Registry, sheet: str = "") -> Looked:
    """Return how a file can be read.

    `sheet`: Of a workbook, the sheet that holds the readings; without it the likeliest one.

    Raises `ZlmreportError` if no data source reads it: what the likeliest of them says; or no job names it.
    """
    _refuse_unwritable(path.name, path)
    sources = _sort_by_suffix(registry.sources, path.suffix.casefold())
    ways: list[tuple[DataSource, SourceProposal]] = []
    errors: list[ZlmreportError] = []
    for source in sources:
        if "file" in source.options.model_fields:
            try:
                ways += ((source, proposal) for proposal in _propose_readings(source, path, sheet))
            except AccessError:
                raise  # no other source could open it
            except ZlmreportError as error:
                errors.append(error)
    # A table of senses, or of channels, would pass as one of directions.
    ways.sort(key=lambda way: not _is_certain(way[1]))
    for source, proposal in ways:
        failed: list[ZlmreportError] = []
        for axis in _propose_axes(proposal):
            try:
                read = _read(source, proposal, path, axis)
                return Looked(source, proposal, read, _choose_standard_for(source, proposal, registry))
            except AccessError:
                raise
            except ZlmreportError as error:
                failed.append(error)
        if _is_certain(proposal):  # it is what it is, and not sound: not for an axis of the other kind
            raise max(failed, key=lambda error: error.problems[-1].place.line)
        errors += failed
    raise next(iter(errors), InputError.at(Place(str(path)), "no installed data source reads such a file"))


def _is_certain(proposal: SourceProposal) -> bool:
    return proposal.is_certain or proposal.circle is not None or proposal.quantity is not None


def _sort_by_suffix(sources: Iterable[DataSource], suffix: str) -> list[DataSource]:
    """Return data sources, first those that a suffix is of; one that none knows is taken for a table's."""
    sources = list(sources)
    is_known = any(suffix in getattr(each, "suffixes", ()) for each in sources)
    wanted = suffix if is_known else _OF_TABLES
    return sorted(sources, key=lambda each: wanted not in getattr(each, "suffixes", ()))


def _refuse_unwritable(name: str, path: Path) -> None:
    """Refuse a name that is no text: a job is UTF-8, and cannot hold it."""
    try:
        name.encode()
    except UnicodeEncodeError as error:
        raise InputError.at(
            Place(str(path)),
            "has a path in another encoding than UTF-8, and no job can name it; rename it",
        ) from error


def _propose_readings(source: DataSource, path: Path, sheet: str) -> Iterator[SourceProposal]:
    """Yield the ways in which a source may read a file, or a sheet of it; the last is without other keys."""
    proposals = getattr(source, "proposals", None)
    if proposals:
        found = [each for each in proposals(path) if not sheet or each.keys.get("sheet", sheet) == sheet]
        yield from sorted(found, key=lambda each: bool(sheet) and "sheet" not in each.keys)
    if not sheet or "sheet" in source.options.model_fields:
        yield SourceProposal({"sheet": sheet} if sheet else {})


def _propose_axes(proposal: SourceProposal) -> Iterator[Axis]:
    """Yield the axes that a file may be of: of the kind first that its letter tells; a circle has its own."""
    if proposal.circle:
        return iter([Axis(proposal.circle.plane, quantity=CIRCLE, circle=proposal.circle)])
    if proposal.quantity:
        name = " ".join(proposal.tests) or proposal.axis or _UNNAMED[AxisKind.LINEAR]
        return iter([Axis(name, quantity=proposal.quantity)])
    kinds = sorted(AxisKind, key=lambda kind: (kind is AxisKind.ROTARY) is not (proposal.axis in _TURNING))
    return iter([Axis(proposal.axis or _UNNAMED[kind], kind) for kind in kinds])


def _read(source: DataSource, proposal: SourceProposal, path: Path, axis: Axis) -> MeasurementSet:
    try:
        options = source.options.model_validate({"file": path, **proposal.keys})
    except ValidationError as error:
        raise InputError.at(Place(str(path)), f"{source.identifier} needs more keys: {error}") from error
    if proposal.tests:
        lines = {
            name: source.read(
                options, SourceContext(replace(axis, name=name), Place(str(path)), proposal.set_ups)
            )
            for name in proposal.tests
        }
        return join_lines(axis, lines)
    return source.read(options, SourceContext(axis, Place(str(path)), proposal.set_ups))


def _choose_standard_for(source: DataSource, proposal: SourceProposal, registry: Registry) -> str:
    """Return a standard that evaluates what a file holds: the usual one, or one that is for it."""
    if source.identifier in {each.identifier for each in registry.standards}:
        return source.identifier
    if proposal.circle:
        return _OF_CIRCLES
    if proposal.quantity is None:
        return _OF_AXES
    wanted = proposal.quantity.identifier
    fitting = (
        standard.identifier
        for standard in registry.standards
        for each in list_measurands_of(standard)
        if wanted == (each.of_lines if proposal.tests and each.of_lines else each).identifier
    )
    return next(fitting, _OF_AXES)


def write_job_of(looked: Looked, file: Path, directory: Path) -> str:
    """Return the job in a folder that makes a report of a file; what is to be asked stands in comments."""
    name = Path(os.path.relpath(file.resolve(), directory.resolve())).as_posix()
    _refuse_unwritable(name, file)
    return "\n".join(
        [
            f"# A measuring report of {' '.join(file.name.split())}. 'zlmreport schema' describes every key.",
            "schema: zlmreport/job/1",
            "certificate: {number: REPORT-0001, kind: report}",
            *_write_measured(looked),
            "measurement:",
            *(f"  # {question}" for question in looked.proposal.asks),
            *looked.write_block(name, indent="  "),
            *looked.write_groups(),
            "evaluate:",
            f'  - "{looked.standard}"',
            "output: {formats: [pdf, json]}",
            "",
        ]
    )


def _write_measured(looked: Looked) -> Iterator[str]:
    """Yield the lines of a job that say of what the file holds readings."""
    axis = looked.read.axis
    if axis.circle:
        radius, feed = axis.circle.radius * 1e3, axis.circle.feed * 60e3
        yield f"circle: {{plane: {axis.circle.plane}, radius: {radius:.9g}, feed: {feed:.9g}}}"
        return
    if looked.proposal.tests:
        return
    if not looked.proposal.axis:
        yield "# Which axis is it? The file does not name it."
    first, last = (axis.typed(float(each)) for each in looked.read.target_positions[[0, -1]])
    travel = f", travel: [{first:.15g}, {last:.15g}]" if first < last else ""  # a single target tells none
    yield f"axis: {{name: {axis.name}, kind: {axis.kind.value}{travel}}}"
