"""The errors of a machine's axes, from jobs, certificates of this program, or stated values.

Each becomes an `AxisErrorCurve`: means with their covariance. What of the uncertainty budget the readings of
a test share is carried on as shared: along the length, at each position, between the directions.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping
from pathlib import Path
from typing import Any

import numpy as np
from pydantic import ConfigDict, Field

from zlmreport import pipeline
from zlmreport.document.certificate.results_file import (
    MACHINE_RESULTS,
    RESULTS,
    ResultsFile,
    ResultsPart,
    read_results,
)
from zlmreport.errors import InputError, Place, Problem, did_you_mean, quoted
from zlmreport.evaluation.uncertainty.budget import Acts, Budget
from zlmreport.files import demand
from zlmreport.job.job import Job
from zlmreport.job.tree import Keys, Scalar
from zlmreport.machines.curve import (
    AxisErrorCurve,
    Means,
    make_curve_of_means,
    make_measured_curve,
    with_scale_error,
)
from zlmreport.machines.keys import ErrorLineKeys, StatedKeys
from zlmreport.machines.kinematics import ERRORS, SQUARENESS, ErrorLine
from zlmreport.machines.machine import find_unit_of
from zlmreport.measurement.arrays import FloatArray
from zlmreport.measurement.error_symbol import ROTARY_AXES
from zlmreport.measurement.measurement_set import MeasurementSet
from zlmreport.measurement.units import MILLIMETRE
from zlmreport.model.diagnosis.study import find_instrument_error
from zlmreport.model.fitting.estimate import InstrumentError
from zlmreport.plugin.registry import Registry

#: Largest certificate that is read, in bytes.
LARGEST = 256 * 1024 * 1024
#: Opens a PDF: the results file that it carries, or None if it carries none.
Opened = Callable[[Path], bytes | None]

#: Axes that run beside X, Y and Z.
_BESIDE = {"U": "X", "V": "Y", "W": "Z"}
_AT_POSITIONS = {Acts.AT_EACH_POSITION, Acts.AT_EACH_APPROACH, Acts.IN_TIME}


class _Line(ErrorLineKeys):
    """Where the others stood, as jobs and certificates say it: the model knows nothing of rotary axes."""

    model_config = ConfigDict(extra="ignore")


def _find_line(at: ErrorLineKeys) -> ErrorLine:
    """Return where an error was measured."""
    places = {"X": at.X, "Y": at.Y, "Z": at.Z}
    others = {axis: MILLIMETRE.to_si(place) for axis, place in places.items() if place is not None}
    if at.tool is None:
        return ErrorLine(others)
    x, y, z = map(MILLIMETRE.to_si, at.tool)
    return ErrorLine(others, (x, y, z))


def find_error_of(job: Job) -> str:
    """Return which of the 21 errors a job measured; that of position where it does not say.

    Raises `InputError` if it is none of them.
    """
    if job.axis.circle is not None:
        raise InputError.at(job.place_of("circle"), "it is a circle, which two axes run; name it under tests")
    name = job.axis.symbol or job.axis.name
    if name not in ERRORS:
        raise InputError.at(
            job.place_of("measurement.error"),
            f"{quoted(name)} is none of the 21 errors of three linear axes; {_say_meant(name)}",
        )
    return name


def find_line_of_job(job: Job) -> ErrorLine:
    """Return where the others stood while a job measured."""
    return _find_line(_Line.model_validate(job.keys.measurement.at))


def find_line_of_test(job: Job, name: str) -> ErrorLine:
    """Return where the others stood on a line of a job: what the line says of it, or else the job."""
    return _find_line(
        _Line.model_validate({**job.keys.measurement.at, **job.tests[name].keys.measurement.at})
    )


def _find_line_of_square(job: Job) -> ErrorLine:
    """Return where a squareness error was measured: each of its lines says where the other axis stood."""
    measurement = job.keys.measurement
    stated: dict[str, Any] = {}
    for line in measurement.tests.values():
        stated |= line.at
    return _find_line(_Line.model_validate(stated | measurement.at))


def _say_meant(name: str) -> str:
    """Return which error a wrong name may mean: a letter O in the place of the zero of a squareness, too."""
    axis = name[-1:].upper()
    if axis in _BESIDE:
        other = _BESIDE[axis]
        return (
            f"{axis} runs beside {other}, and the model has one axis of a direction: leave this job out, or "
            f"call the axis {other} if it moves in the place of it"
        )
    if axis in ROTARY_AXES and len(name) == len("ECC"):
        return f"{axis} turns, and a rotary axis has no place in it; leave this job out"
    with_zero = name.upper().replace("O", "0")
    return f"with a zero it is {with_zero}" if with_zero in ERRORS else did_you_mean(name, ERRORS)


def make_curve_of_job(job: Job, measurements: MeasurementSet, registry: Registry) -> AxisErrorCurve:
    """Return the error that a job measured, with what its budget says of it.

    Raises `InputError` if it measured none of the 21, or a squareness error without stating its uncertainty.
    """
    name, source = find_error_of(job), job.keys.certificate.number
    if name not in SQUARENESS:
        shared, scale = _find_shared_error(job, measurements, registry)
        curve = make_measured_curve(name, measurements, shared, find_line_of_job(job), source)
        return with_scale_error(curve, scale)
    evaluated = (each.evaluation for each in pipeline.evaluate_all(job, measurements, registry))
    found = [one for each in evaluated for one in each.parameters if one.quantity.symbol == name]
    u = found[0].standard_uncertainty if found else None
    if u is None:
        raise InputError.at(
            job.place_of("measurement.error"),
            f"this job states no {name} with its uncertainty; name what enters it under uncertainty and "
            "instrument, and evaluate iso230-1:2012",
        )
    return make_single_curve(name, found[0].value, u, _find_line_of_square(job), source)


def make_single_curve(name: str, value: float, u: float, line: ErrorLine, source: str) -> AxisErrorCurve:
    """Return a squareness error: one value, rad, with its standard uncertainty."""
    return AxisErrorCurve(name, np.zeros(1), np.array([value]), np.eye(1) * u, line, source)


def _find_shared_error(
    job: Job, measurements: MeasurementSet, registry: Registry
) -> tuple[InstrumentError, float]:
    """Return the uncertainty that the readings of a test share, by its budget or else by its instrument.

    The second is that of the scale in which all of them were read.
    """
    length = float(np.ptp(measurements.target_positions)) or 1.0
    budget = pipeline.make_budget_of_job(job, measurements, registry)
    if not isinstance(budget, Budget):
        return find_instrument_error(job, length), 0.0
    found = [(each.acts, each.standard_uncertainty) for each in budget.contributions]
    return _share_contributions(found, length), _find_scale(found, measurements.deviation)


def _share_contributions(contributions: Iterable[tuple[Acts, float]], length: float) -> InstrumentError:
    """Return contributions, standard uncertainties in m or rad, by what shares them."""
    sums = {"along": 0.0, "at": 0.0, "between": 0.0}
    for acts, u in contributions:
        if acts is Acts.ALONG_THE_LENGTH:
            sums["along"] += (u / length) ** 2
        elif acts in _AT_POSITIONS:
            sums["at"] += u**2
        elif acts is Acts.BETWEEN_DIRECTIONS:
            sums["between"] += u**2
    return InstrumentError(
        proportional=math.sqrt(sums["along"]),
        at_each_position=math.sqrt(sums["at"]),
        between_directions=math.sqrt(sums["between"]),
    )


def _find_scale(contributions: Iterable[tuple[Acts, float]], readings: FloatArray) -> float:
    """Return the uncertainty of the scale of readings; that of a budget is the error of the largest one."""
    largest = float(np.nanmax(np.abs(readings), initial=0.0))
    squares = sum(u**2 for acts, u in contributions if acts is Acts.WITH_THE_READING)
    return math.sqrt(squares) / largest if largest else 0.0


class _Position(ResultsPart):
    target: float
    mean_fwd: float | None = None
    mean_bwd: float | None = None
    s_fwd: float | None = None
    s_bwd: float | None = None
    n_fwd: int = 1
    n_bwd: int = 1


class _Parameter(ResultsPart):
    symbol: str
    value: float
    unit: str = ""
    expanded_uncertainty: float | None = None
    coverage_factor: float | None = None


class _Evaluation(ResultsPart):
    parameters: tuple[_Parameter, ...] = ()
    positions: tuple[_Position, ...] = ()


class _Contribution(ResultsPart):
    acts: Acts
    standard_uncertainty: float


class _Uncertainty(ResultsPart):
    contributions: tuple[_Contribution, ...] = ()


class _Measurements(ResultsPart):
    axis: str
    error: str | None = None
    at: _Line | None = None


class _Results(ResultsFile):
    """A results file as far as a machine needs it."""

    measurements: _Measurements
    evaluations: tuple[_Evaluation, ...] = Field(min_length=1)
    uncertainty: _Uncertainty = _Uncertainty()


def make_curve_of_certificate(path: Path, place: Place, opened: Opened) -> AxisErrorCurve:
    """Return the error that a certificate of this program states, with its uncertainty.

    Raises `InputError` if it is none that can be read.
    """
    content = demand(path, LARGEST)
    if content.startswith(b"%PDF"):
        carried = opened(path)
        if carried is None:
            raise InputError.at(
                place, f"{path.name} carries no results file; a certificate of this program does"
            )
        content = carried
    try:
        tree = read_results(content)
        _refuse_other_documents(path.name, tree, place)
        found = _Results.of(tree)
    except ValueError as error:
        raise InputError.at(
            place, f"{path.name} is no results file of this program ({RESULTS}): {error}"
        ) from error
    name = found.measurements.error or f"E{found.measurements.axis}{found.measurements.axis}"
    if name not in ERRORS:
        raise InputError.at(
            place,
            f"{path.name}: {quoted(name)} is none of the 21 errors of three linear axes; {_say_meant(name)}",
        )
    unit = find_unit_of(name)
    line = _find_line(found.measurements.at or _Line())
    own = next((each for of in found.evaluations for each in of.parameters if each.symbol == name), None)
    if name in SQUARENESS:
        if own is None or own.expanded_uncertainty is None:
            raise InputError.at(place, f"{path.name} states no {name} with its uncertainty")
        u = unit.to_si(own.expanded_uncertainty / (own.coverage_factor or 2.0))
        return make_single_curve(name, unit.to_si(own.value), u, line, found.certificate.number)
    positions = max((each.positions for each in found.evaluations), key=len)
    if len(positions) < 2:
        raise InputError.at(place, f"{path.name} states no deviations by position")
    return _make_of_positions(name, positions, found, line)


def _refuse_other_documents(name: str, tree: Any, place: Place) -> None:
    """Refuse what this program wrote on something else than one error, and say what that is."""
    stated = tree if isinstance(tree, Mapping) else {}
    measured = stated.get("measurements")
    axis = str(measured.get("axis", "")) if isinstance(measured, Mapping) else ""
    is_one_error = isinstance(measured, Mapping) and measured.get("error") is not None
    if stated.get("schema") == MACHINE_RESULTS:
        what = (
            "is on a whole machine; name the jobs or certificates of its axes, which its machine file lists"
        )
    elif "parts" in stated:
        what = "holds several measurements; name the job or the certificate of each of them"
    elif not is_one_error and {*axis} <= {*"XYZ"} and len(axis) == len("XY"):
        what = f"is on a circle in {axis}, which two axes run; name its job under tests"
    elif not is_one_error and " " in axis:
        what = f"holds several lines or channels ({axis[:60]}); diagonals stand under tests, by their job"
    else:
        return
    raise InputError.at(place, f"{name} {what}")


def _make_of_positions(
    name: str, positions: tuple[_Position, ...], found: _Results, line: ErrorLine
) -> AxisErrorCurve:
    """Return the means of a table by position as a curve."""
    unit = find_unit_of(name)
    nodes = np.array([each.target for each in positions]) / 1e3
    sides = [
        side
        for side in ("fwd", "bwd")
        if all(getattr(each, f"mean_{side}") is not None for each in positions)
    ]

    def column(name: str, nothing: float = 0.0) -> FloatArray:
        return np.array(
            [[getattr(each, f"{name}_{side}") or nothing for each in positions] for side in sides],
            dtype=np.float64,
        )

    count = np.maximum(column("n", 1.0).astype(np.int64), 1)
    means = Means(nodes, unit.to_si(column("mean")), count, (count - 1) * unit.to_si(column("s")) ** 2)
    contributions = [
        (each.acts, float(unit.to_si(each.standard_uncertainty))) for each in found.uncertainty.contributions
    ]
    shared = _share_contributions(contributions, float(np.ptp(nodes)))
    curve = make_curve_of_means(means, name, shared, line, found.certificate.number)
    return with_scale_error(curve, _find_scale(contributions, means.values))


def read_curves_of_statement(stated: StatedKeys, node: Keys, problems: list[Problem]) -> list[AxisErrorCurve]:
    """Return the errors that an item of the machine file states, each a value or a curve of values."""
    found = []
    own = dict(stated.model_extra or {})
    if not own:
        problems.append(
            Problem(node.place, "states no error; write for example {C0Y: 2.5, expanded_uncertainty: 0.6}")
        )
    for name, value in own.items():
        place = node.entries[name].place
        if name not in ERRORS:
            problems.append(Problem(place, f"{quoted(name)} is none of the 21 errors; {_say_meant(name)}"))
            continue
        curve = _read_stated(name, value, stated, problems, node.entries[name].value)
        if curve:
            found.append(curve)
    return found


def _read_stated(
    name: str, value: Any, stated: StatedKeys, problems: list[Problem], node: Any
) -> AxisErrorCurve | None:
    unit, line = find_unit_of(name), _find_line(stated.at)
    u = float(unit.to_si(stated.expanded_uncertainty)) / 2.0
    source = stated.source or ""
    if name in SQUARENESS:
        number = _read_number(value)
        if number is None:
            problems.append(Problem(node.place, f"{name}: a number is expected, arc seconds, such as 2.5"))
            return None
        return AxisErrorCurve(name, np.zeros(1), np.array([unit.to_si(number)]), np.eye(1) * u, line, source)
    pairs = (
        [(_read_number(at), _read_number(each)) for at, each in value.items()]
        if isinstance(value, Mapping)
        else []
    )
    places = [at for at, _ in pairs if at is not None]
    values = [each for _, each in pairs if each is not None]
    if (
        len(places) < 2
        or len(places) != len(pairs)
        or len(values) != len(pairs)
        or sorted(set(places)) != places
    ):
        axis = name[2]
        problems.append(
            Problem(
                node.place,
                f"{name}: values by the position of {axis} are expected, rising, such as "
                f"{{0: 0, 250: 1.2, 500: 2.0}} (mm: {unit.symbol}); a single number is a squareness error's",
            )
        )
        return None
    own = np.eye(len(values)) * u
    return AxisErrorCurve(name, np.array(places) / 1e3, unit.to_si(np.array(values)), own, line, source)


def _read_number(value: Any) -> float | None:
    """Return a number, or what reads as one."""
    try:
        number = float(value.text if isinstance(value, Scalar) else value)
    except (TypeError, ValueError):
        return None
    return number if math.isfinite(number) and abs(number) < 1e9 else None


def read_bounds_of(stated: Mapping[str, float], tree: Keys, problems: list[Problem]) -> dict[str, float]:
    """Return the bounds of errors that nobody measured, m or rad."""
    found = {}
    for name, bound in stated.items():
        if name in ERRORS:
            found[name] = float(find_unit_of(name).to_si(bound))
        else:
            problems.append(
                Problem(
                    tree.entries[name].place,
                    f"{quoted(name)} is none of the 21 errors; {_say_meant(name)}",
                )
            )
    return found
