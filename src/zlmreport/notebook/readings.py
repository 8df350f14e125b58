"""Readings of an axis for notebooks: from files, frames, arrays or a simulation; columns of their frame."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, fields, replace
from functools import cache, cached_property
from pathlib import Path
from typing import Any, TypeVar

import numpy as np
from numpy.typing import ArrayLike, NDArray
from pydantic import BaseModel

from zlmreport.errors import InputError, Place, Problem, count_in_words, did_you_mean
from zlmreport.job.axis import convert_axis_to_si
from zlmreport.job.contradictions import validate
from zlmreport.job.job import Job
from zlmreport.job.loading import load
from zlmreport.job.measurement_keys import AxisKeys
from zlmreport.job.parse import is_named_as_yaml, parse
from zlmreport.job.simulation import load_simulation
from zlmreport.job.tree import Keys
from zlmreport.measurement.approach import Approach
from zlmreport.measurement.arrays import FloatArray, read_only_floats
from zlmreport.measurement.axis import Axis, AxisKind
from zlmreport.measurement.collect import Reading, collect
from zlmreport.measurement.measurement_set import CONDITIONS, MeasurementSet
from zlmreport.measurement.provenance import Provenance
from zlmreport.model.simulation.files import read_description_of
from zlmreport.model.simulation.simulate import simulate as simulate_test
from zlmreport.notebook.frames import Library, columns_of, frame_of, library_of, table_html
from zlmreport.plugin.protocols import SourceContext
from zlmreport.plugin.registry import Registry, find_plugins

_DIRECTIONS = {
    **dict.fromkeys(("+", "1", "+1", "1.0", "up", "forward", "↑"), Approach.POSITIVE),
    **dict.fromkeys(("-", "−", "-1", "-1.0", "down", "reverse", "backward", "↓"), Approach.NEGATIVE),
}
_NEEDED = ("target", "direction")

Model = TypeVar("Model", bound=BaseModel)


@cache
def registry() -> Registry:
    """Return the installed plugins; they are looked up once."""
    return find_plugins()


def tree_of(values: Mapping[str, Any], name: str) -> Keys:
    """Return keys given in Python as those of a file: so they are checked, and complained of, alike."""
    return parse(json.dumps(values, default=plain_value).encode(), name)


def plain_value(value: Any) -> Any:
    """Return an array, a path or a number of numpy as JSON has it; raise TypeError of anything else."""
    if isinstance(value, np.ndarray | np.generic):
        return value.tolist()
    if isinstance(value, Path):
        return str(value)
    raise TypeError(f"{value!r} is nothing that a key can have")


def checked(model: type[Model], values: Mapping[str, Any], name: str) -> Model:
    """Return keys given in Python as their model.

    Raises
    ------
    InputError
        With all that is wrong with them.
    """
    problems: list[Problem] = []
    found = validate(model, tree_of(values, name), problems)
    if problems or found is None:
        raise InputError(Problem(Place(name), each.message) for each in problems)
    return found


@dataclass(frozen=True, eq=False)
class Readings:
    """The readings of one test of one axis, in the order in which they were taken.

    Attributes
    ----------
    measurements
        The same in SI, for those who go further down; no part of the stable interface.
    library
        Of the frame that they came from; None if they came otherwise.
    """

    measurements: MeasurementSet
    library: Library | None = None

    @property
    def unit(self) -> str:
        """Of the deviations: ``um``, on a rotary axis ``arcsec``."""
        return self.measurements.axis.deviation_unit.ascii

    @cached_property
    def targets(self) -> FloatArray:
        """Target positions, rising, shape (targets,), mm or degrees."""
        return read_only_floats(
            self.measurements.axis.position_unit.from_si(self.measurements.target_positions)
        )

    @cached_property
    def grid(self) -> FloatArray:
        """Deviations as standards take them, shape (approach, target, run), m or rad; NaN where missing."""
        return read_only_floats(self.measurements.deviations())

    @property
    def up(self) -> FloatArray:
        """Deviations of the positive approach, shape (runs, targets), µm or ″; NaN where missing."""
        return self._select(Approach.POSITIVE)

    @property
    def down(self) -> FloatArray:
        """Deviations of the negative approach, shape (runs, targets), µm or ″; NaN where missing."""
        return self._select(Approach.NEGATIVE)

    def _select(self, approach: Approach) -> FloatArray:
        return read_only_floats(self.measurements.axis.deviation_unit.from_si(self.grid[approach.index].T))

    def to_frame(self, library: Library | None = None) -> Any:
        """Return a row for each reading: target, direction, run, deviation, time in s, conditions.

        Parameters
        ----------
        library
            Of which library the frame is: ``pandas``, ``polars`` or ``pyarrow``. Without it the one that the
            readings came from, that is in use, or that is installed; where none is, a structured array.

        Raises
        ------
        InputError
            If that library is not installed.
        """
        return frame_of(self._columns, library or self.library)

    @cached_property
    def _columns(self) -> dict[str, NDArray[Any]]:
        found = self.measurements
        columns: dict[str, NDArray[Any]] = {
            "target": self.targets[found.target],
            "direction": np.where(found.approach > 0, "+", "-"),
            "run": found.run,
            "deviation": found.axis.deviation_unit.from_si(found.deviation),
        }
        if found.time is not None:
            columns["time"] = found.time
        for name, log in found.conditions.items():
            kind = CONDITIONS.get(name)
            columns[name] = (log - kind.unit.zero) / kind.unit.si if kind else log
        return columns

    def __len__(self) -> int:
        """Return how many readings there are, missing ones that are named among them."""
        return len(self.measurements.deviation)

    def __reduce__(self) -> tuple[Any, ...]:
        """Return how to make the readings anew: they are read-only again then."""
        return _make_anew, (self.measurements, self.library)

    def __repr__(self) -> str:
        """Return the axis and how many readings there are; of several measured lines their names."""
        if self.measurements.tests:
            return f"<Readings of several lines: {', '.join(self.measurements.tests)}>"
        targets, runs = (
            count_in_words(len(self.targets), "target"),
            count_in_words(len(self.measurements.runs), "run"),
        )
        missing = len(self.measurements.missing())
        left_out = f", {missing} missing" if missing else ""
        return f"<Readings of axis {self.measurements.axis.name}: {targets}, {runs}{left_out}>"

    def _repr_html_(self) -> str:
        return table_html(self._columns)


def _make_anew(measurements: MeasurementSet, library: Library | None) -> Readings:
    logs = measurements.conditions.values()
    for each in (*(getattr(measurements, own.name) for own in fields(measurements)), *logs):
        if isinstance(each, np.ndarray):
            each.flags.writeable = False
    return Readings(measurements, library)


def readings_of(data: object, name: str) -> Readings:
    """Return what is given as readings of one line; raise `InputError` if it is anything else."""
    if isinstance(data, Readings):
        return _refuse_lines(data, Place(name))
    raise InputError.at(
        Place(name),
        f"a {type(data).__name__} holds no readings of an axis; z.test(targets, up, down) makes them of "
        "arrays, z.read(…) of a file, a job or a frame",
    )


def _refuse_lines(data: Readings, place: Place) -> Readings:
    """Return readings; raise `InputError` if they are those of several lines that are evaluated together."""
    if data.measurements.tests:
        raise InputError.at(
            place,
            f"the test has several lines ({', '.join(data.measurements.tests)}), and readings are of one; "
            "z.certificate(job).results has what follows from them together",
        )
    return data


def read(
    source: Any, *, plugin: str = "", axis: str | Mapping[str, Any] | None = None, **keys: Any
) -> Readings:
    """Read the measurements of an axis.

    Parameters
    ----------
    source
        A file of measurements (``x.csv``, ``x.rtl``); a job (``job.yaml``), whose readings are then corrected
        as it says; or columns by name: a frame of pandas, polars or another library, a mapping of arrays,
        with the columns of a measurement file (``target`` mm, ``direction``, ``run``, ``deviation`` µm or
        ``position`` mm, ``time`` s, conditions).
    plugin
        The data source that reads the file, if its suffix does not tell: ``laser-csv``.
    axis
        Its name, or its keys as in a job: ``{"name": "C", "kind": "rotary"}``; it is X, or C if it is rotary,
        where no name is given. Of a job they stand instead of its own.
    **keys
        Further keys of the data source as in a job: ``layout="wide"``.

    Raises
    ------
    InputError
        With every defect of the data and its place.
    AccessError
        If a file cannot be read.
    """
    columns = columns_of(source)
    if columns is not None:
        if plugin or keys:
            raise InputError.at(
                Place("read"), f"columns need no {'plugin' if plugin else next(iter(keys))!r}"
            )
        return Readings(_read_columns(columns, axis_of(axis)), library_of(source))
    if not isinstance(source, str | Path):
        raise InputError.at(
            Place("read"),
            f"{type(source).__name__}: this is no path of a file, and no frame with named columns",
        )
    path = Path(source)
    if is_named_as_yaml(path) and not plugin:
        from zlmreport import pipeline  # noqa: PLC0415 - it brings all that a certificate needs

        if keys:
            message = f"a job states {next(iter(keys))!r} itself, under measurement.source"
            raise InputError.at(Place("read"), message)
        job = load(path, registry())
        found = pipeline.read(job, registry())
        _refuse_lines(Readings(found), Place(str(path)))
        return Readings(found if axis is None else _replace_axis(found, job, axis))
    name = "read"
    reader = registry().source(plugin, Place(name)) if plugin else _find_reader_of(path)
    options = checked(reader.options, {"file": str(path), **keys}, name)
    return Readings(reader.read(options, SourceContext(axis_of(axis), Place(name))))


def axis_of(axis: str | Mapping[str, Any] | None) -> Axis:
    """Return an axis by its name, or by its keys as in a job; without a name X, or C if it is rotary."""
    keys = {"name": axis} if isinstance(axis, str) else dict(axis or {})
    usual = "C" if keys.get("kind") == AxisKind.ROTARY else "X"
    return convert_axis_to_si(checked(AxisKeys, {"name": usual, **keys}, "axis"))


def _replace_axis(found: MeasurementSet, job: Job, axis: str | Mapping[str, Any]) -> MeasurementSet:
    """Return the readings of a job with keys of the axis that stand instead of its own."""
    stated = job.keys.axis.model_dump(mode="json", exclude_unset=True)
    keys = {"name": axis} if isinstance(axis, str) else axis
    changed = axis_of({**stated, **keys})
    if changed.kind is not found.axis.kind:
        raise InputError.at(Place("axis"), f"the readings of the job are of a {found.axis.kind.value} axis")
    lengths = ("name", "travel", "screw_pitch", "signal_period", "scale_element", "compensation_table")
    return replace(
        found, axis=replace(found.axis, **{each: getattr(changed, each) for each in lengths if each in keys})
    )


def _find_reader_of(path: Path) -> Any:
    """Return the data source for files of a suffix."""
    suffix = path.suffix.casefold()
    by_suffix = {each: source for source in registry().sources for each in getattr(source, "suffixes", ())}
    if suffix in by_suffix:
        return by_suffix[suffix]
    known = [source.identifier for source in registry().sources]
    raise InputError.at(
        Place(str(path)),
        f"its suffix does not tell who reads it; name the data source: plugin='{known[0]}' "
        f"({did_you_mean(suffix, [*known, *by_suffix])})",
    )


def _read_columns(columns: Mapping[str, NDArray[Any]], axis: Axis) -> MeasurementSet:
    place = Place("columns")
    value = next((name for name in ("deviation", "position") if name in columns), "")
    missing = [name for name in _NEEDED if name not in columns]
    if missing or not value:
        wanted = ", ".join([*missing, *([] if value else ["deviation or position"])])
        raise InputError.at(place, f"there is no column {wanted} (there are: {', '.join(columns)})")
    rows = {name: len(np.atleast_1d(column)) for name, column in columns.items()}
    uneven = [f"{name} {count}" for name, count in rows.items() if count != rows["target"]]
    if uneven:
        message = f"target has {count_in_words(rows['target'], 'row')}, and not as many: {', '.join(uneven)}"
        raise InputError.at(place, message)
    problems: list[Problem] = []
    readings = list(_rows(columns, value, axis, problems))
    return collect(readings, axis, Provenance("columns"), place=place, problems=problems)


def _rows(
    columns: Mapping[str, NDArray[Any]], value: str, axis: Axis, problems: list[Problem]
) -> Iterator[Reading]:
    position, deviation = axis.position_unit, axis.deviation_unit
    target = position.to_si(_take_numbers("target", columns["target"], "columns"))
    found = _take_numbers(value, columns[value], "columns")
    found = deviation.to_si(found) if value == "deviation" else position.to_si(found) - target
    runs = _take_numbers("run", columns.get("run", np.ones(len(target))), "columns")
    seconds = _convert_to_seconds(columns["time"]) if "time" in columns else np.full(len(target), np.nan)
    known = {*_NEEDED, "run", "time", value}
    logs = {name: _read_log(name, log) for name, log in columns.items() if name not in known}
    for row, spelt in enumerate(columns["direction"].tolist()):
        place = Place("columns", row + 1)
        approach = _DIRECTIONS.get(str(spelt).strip().casefold())
        if approach is None:
            problems.append(Problem(place, f"{str(spelt)[:40]!r} is no direction; write '+' or '-'"))
            continue
        conditions = {name: float(log[row]) for name, log in logs.items()}
        yield Reading(
            place,
            float(target[row]),
            approach,
            float(runs[row]),
            float(found[row]),
            float(seconds[row]),
            conditions,
        )


def _convert_to_seconds(times: NDArray[Any]) -> FloatArray:
    if times.dtype.kind == "M":
        return np.asarray((times - times.min()) / np.timedelta64(1, "s"), dtype=np.float64)
    return _take_numbers("time", times, "columns")


def _read_log(name: str, values: NDArray[Any]) -> FloatArray:
    log = _take_numbers(name, values, "columns")
    return log * CONDITIONS[name].unit.si + CONDITIONS[name].unit.zero if name in CONDITIONS else log


def of_arrays(
    targets: ArrayLike,
    up: ArrayLike,
    down: ArrayLike | None = None,
    *,
    axis: str | Mapping[str, Any] | None = None,
) -> Readings:
    """Return readings that are given as arrays, taken run by run: upwards, then downwards.

    Parameters
    ----------
    targets : (targets,) array
        Target positions, mm or degrees.
    up, down : (runs, targets) arrays
        Deviations of the positive and of the negative approach, µm or ″; NaN for a missing reading. A
        single run may be of shape (targets,); without `down` the test is unidirectional.
    axis
        Its name, or its keys as in a job.

    Raises
    ------
    InputError
        If the arrays do not fit together, or hold what no reading can be.
    """
    place = Place("test")
    of = axis_of(axis)
    positions = _take_numbers("targets", targets)
    found = {Approach.POSITIVE: up, Approach.NEGATIVE: down}
    grids = {
        approach: np.atleast_2d(_take_numbers("up" if approach > 0 else "down", values))
        for approach, values in found.items()
        if values is not None
    }
    if not grids:
        raise InputError.at(place, "holds no readings; up is an array of them, a row for each run")
    for approach, grid in grids.items():
        if grid.ndim != 2 or grid.shape[1:] != positions.shape:
            name = "up" if approach > 0 else "down"
            raise InputError.at(
                place,
                f"{name} has the shape {grid.shape}; (runs, {len(positions)}) is expected, a "
                "row for each run, a column for each target",
            )
    order = np.argsort(positions, kind="stable")
    readings = [
        Reading(
            Place("test", run + 1),
            float(of.position_unit.to_si(positions[index])),
            approach,
            run + 1,
            float(of.deviation_unit.to_si(grid[run, index])),
        )
        for run in range(max(map(len, grids.values())))
        for approach, grid in grids.items()
        if run < len(grid)
        for index in order[:: int(approach)]
    ]
    return Readings(collect(readings, of, Provenance("arrays"), place=place))


def _take_numbers(name: str, values: ArrayLike, where: str = "test") -> FloatArray:
    """Return an array of numbers; raise `InputError` if it holds other things, or rows of unlike lengths."""
    try:
        return np.asarray(values, dtype=np.float64)
    except (TypeError, ValueError) as error:
        message = f"{name} is no array of numbers: {error}; a missing reading is nan"
        raise InputError.at(Place(where), message) from error


def simulate(specification: str | Path | Mapping[str, Any] | None = None, **keys: Any) -> Readings:
    """Return readings of an axis that is not there.

    Parameters
    ----------
    specification
        A simulation file (``spec.yaml``), or its keys.
    **keys
        The same, or keys that stand instead of the file's: ``seed=2``.

    Raises
    ------
    InputError
        With all that is wrong with the keys.
    AccessError
        If the file cannot be read.
    """
    name, content = "simulate", None
    if isinstance(specification, str | Path):
        name = str(specification)
        if keys:
            beside = Path(name).with_name("simulate")
            content = json.dumps({"extends": Path(name).name, **keys}, default=plain_value).encode()
            name = str(beside)
    else:
        given = {"schema": "zlmreport/simulation/1", "seed": 1, **(specification or {}), **keys}
        content = json.dumps(given, default=plain_value).encode()
    file = load_simulation(Path(name), registry(), content)
    return Readings(simulate_test(read_description_of(file, registry().effect)).measurements)
