"""Checks what each method of a plugin answers, and says what is wrong with it.

An answer may be handed on as something else that says the same: a generator as a tuple, so that nothing of it
runs later, and an array as one that nobody can alter.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import replace
from types import MappingProxyType
from typing import TYPE_CHECKING, Any

import numpy as np

from zlmreport.document.certificate.conditions import Described
from zlmreport.document.figures.figure import Figure
from zlmreport.evaluation.evaluation import Arithmetic, Finding
from zlmreport.evaluation.uncertainty.budget import Contribution
from zlmreport.job.keys import JobKeys
from zlmreport.language import Words
from zlmreport.measurement.measurement_set import MeasurementSet
from zlmreport.measurement.provenance import Provenance
from zlmreport.model.compensation.cross import CrossTable
from zlmreport.model.compensation.curve import CompensationTable
from zlmreport.model.effects.circle_effect import CircleTerm
from zlmreport.model.effects.effect import Effect
from zlmreport.plugin.boundary import Guarded, Unacceptable
from zlmreport.plugin.extending import ExtensionPlan, LiveRun
from zlmreport.plugin.protocols import SourceProposal

if TYPE_CHECKING:
    from zlmreport.document.certificate.document import Certificate
    from zlmreport.evaluation.statistics import PositionStatistics
    from zlmreport.measurement.arrays import FloatArray
    from zlmreport.model.effects.circle_design import CircleDesign
    from zlmreport.model.effects.design import Design

_DOUBLE = np.dtype(np.float64)


def real(values: Any, shape: tuple[int, ...], what: str) -> FloatArray:
    """Return numbers as doubles; refuse what is none, complex, infinite, or of another shape."""
    # First the usual answers, in a hurry: one value, or an array in which nothing is amiss.
    if type(values) is np.float64 and not shape and not math.isinf(values):
        return values  # type: ignore[return-value]
    is_as_expected = type(values) is np.ndarray and values.dtype is _DOUBLE and values.shape == shape
    if is_as_expected and math.isfinite(np.add.reduce(values, None)):
        return values  # type: ignore[no-any-return]
    array = _require_numbers(values, what)
    if array.shape != shape:
        raise Unacceptable(f"gives {what} of the shape {array.shape}; {shape} is expected")
    if np.isinf(array).any():
        raise Unacceptable(f"gives {what} that is infinite; NaN stands for what is not defined")
    return array


def _require_numbers(values: Any, what: str) -> FloatArray:
    try:
        array = np.asarray(values)
    except ValueError as error:
        raise Unacceptable(f"gives {what} that is no array: {error}") from None
    if array.dtype.kind not in "iuf":
        named = "complex" if array.dtype.kind == "c" else f"{type(values).__name__} and no number"
        raise Unacceptable(f"gives {what} that is {named}; a real number is expected")
    return array if array.dtype == _DOUBLE else array.astype(np.float64)


def _require_finite(values: Any, shape: tuple[int, ...], what: str) -> FloatArray:
    array = real(values, shape, what)
    if not math.isfinite(np.add.reduce(array, None)) and np.isnan(array).any():
        raise Unacceptable(f"gives {what} that is NaN; a number is expected")
    return array


def _require_kind(kind: type, answer: Any) -> Any:
    if not isinstance(answer, kind):
        raise Unacceptable(f"returns {_name_answer(answer)}; {kind.__name__} is expected")
    return answer


def _name_answer(answer: object) -> str:
    return "nothing" if answer is None else f"an object of type {type(answer).__name__}"


def _require_all_of(kind: type, answer: Any) -> tuple[Any, ...]:
    """Return everything of an iterable; refuse one with something else in it."""
    if not isinstance(answer, Iterable) or isinstance(answer, str | bytes):
        raise Unacceptable(f"returns {_name_answer(answer)}; several {kind.__name__} are expected")
    found = tuple(answer)
    for each in found:
        if not isinstance(each, kind):
            raise Unacceptable(f"returns {_name_answer(each)} among others; each must be {kind.__name__}")
    return found


def arithmetic(
    standard: Guarded, answer: Any, statistics: PositionStatistics, *_: Any, **__: Any
) -> Arithmetic:
    """Refuse values that the standard does not declare, and such as are no lengths or angles."""
    of = _require_kind(Arithmetic, answer)
    *batch, _, positions = statistics.mean.shape
    for owner, given, declared, shape in (
        ("quantities", of.parameters, standard.quantities, tuple(batch)),
        ("position_quantities", of.positions, standard.position_quantities, (*batch, positions)),
    ):
        _require_kind(Mapping, given)
        symbols = [each.symbol for each in declared]
        if list(given) != symbols and (len(given) != len(symbols) or given.keys() != set(symbols)):
            wrong = [f"no {name}" for name in symbols if name not in given]
            wrong += [f"{name}, which is not declared" for name in given if name not in symbols]
            wrong += [f"{name} twice" for name in dict.fromkeys(symbols) if symbols.count(name) > 1]
            raise Unacceptable(f"gives {', '.join(map(str, wrong))} (see {owner})")
        for symbol, value in given.items():
            real(value, shape, symbol)
    return of  # type: ignore[no-any-return]


def requirements(_standard: Guarded, answer: Any, *_: Any, **__: Any) -> tuple[Any, ...]:
    """Take every finding; refuse one that is not said in words."""
    findings = _require_all_of(Finding, answer)
    for each in findings:
        _require_kind(Words, each.requirement)
        _require_kind(Words, each.found)
        if each.met is not None and not isinstance(each.met, bool | np.bool_):
            raise Unacceptable(f"returns a finding whose met is {each.met!r}, not True, False or None")
    return findings


def of_error(standard: Guarded, answer: Any, *_: Any) -> Any:
    """Hand on the standard as it evaluates an error, behind the boundary too."""
    if getattr(answer, "identifier", None) != standard.identifier:
        raise Unacceptable(f"returns {_name_answer(answer)}; itself for that error is expected")
    return standard.guard_another(answer)


def of_lines(_standard: Guarded, answer: Any, measurements: MeasurementSet, *_: Any) -> Mapping[str, Any]:
    """Refuse contributions of lines that there are not."""
    found = {
        name: _require_all_of(Contribution, each) for name, each in _require_kind(Mapping, answer).items()
    }
    if unknown := found.keys() - measurements.tests.keys():
        raise Unacceptable(
            f"gives contributions of {', '.join(map(repr, sorted(unknown)))}, which is no test"
        )
    return found


def figures(_standard: Guarded, answer: Any, *_: Any, **__: Any) -> tuple[Any, ...]:
    """Take every graph."""
    return _require_all_of(Figure, answer)


def read(source: Guarded, answer: Any, _options: Any, context: Any) -> MeasurementSet:
    """Refuse a set that is not whole, and hand it on so that nobody can alter a reading."""
    of: MeasurementSet = _require_kind(MeasurementSet, answer)
    if of.axis != context.axis:
        raise Unacceptable(f"reads the axis {of.axis}; the job describes {context.axis}")
    _require_kind(Provenance, of.provenance)
    if of.provenance.source != source.identifier:
        raise Unacceptable(f"names {of.provenance.source!r} as the source; its own identifier is expected")
    whole(of)
    for array in (of.target_positions, of.target, of.approach, of.run, of.deviation, of.time):
        if array is not None:
            array.setflags(write=False)
    for log in of.conditions.values():
        log.setflags(write=False)
    return of


def proposals(_source: Guarded, answer: Any, *_: Any) -> tuple[Any, ...]:
    """Take every proposal now: a generator would run elsewhere."""
    return _require_all_of(SourceProposal, answer)


def whole(of: MeasurementSet) -> None:
    """Refuse a measurement set whose parts do not belong together, or whose readings are no numbers."""
    targets = _require_finite(of.target_positions, (np.size(of.target_positions),), "target positions")
    if not targets.size or np.any(np.diff(targets) <= 0):
        raise Unacceptable(f"gives target positions that do not rise: {targets}")
    shape = (np.size(of.deviation),)
    real(of.deviation, shape, "a deviation")
    for name, values in (("time", of.time), *of.conditions.items()):
        if values is not None:
            real(values, shape, str(name))
    if of.datum is not None:
        _require_finite(of.datum, (), "datum")
    _require_designations(of, shape)


def _require_designations(of: MeasurementSet, shape: tuple[int, ...]) -> None:
    """Refuse readings that do not say which they are."""
    for what, whole_numbers in (("target", of.target), ("approach", of.approach), ("run", of.run)):
        if np.asarray(whole_numbers).dtype.kind not in "iu":
            raise Unacceptable(f"gives {what} that is not of whole numbers")
        real(whole_numbers, shape, what)
    if np.any((of.target < 0) | (of.target >= of.target_positions.size)):
        raise Unacceptable("gives target that is no index of the target positions")
    if not np.isin(of.approach, (1, -1)).all():
        raise Unacceptable("gives approach that is neither 1 nor -1")
    if np.any(of.run < 1):
        raise Unacceptable("gives run below 1; runs are numbered from 1")
    readings = np.stack([of.target, of.approach, of.run])
    if np.unique(readings, axis=1).shape != readings.shape:
        raise Unacceptable("gives two readings of the same target, direction and run")


def render(_renderer: Guarded, answer: Any, _certificate: Certificate) -> bytes:
    """Refuse what is no file."""
    content: bytes = _require_kind(bytes, answer)
    if not content:
        raise Unacceptable("returns an empty file")
    return content


def columns(effect: Guarded, answer: Any, design: Design, _theta: FloatArray) -> FloatArray:
    """Refuse what is no finite column for each parameter."""
    shape = (len(design.position), len(effect.linear))
    return _require_finite(answer, shape, "columns")


def grid(effect: Guarded, answer: Any, _design: Design) -> FloatArray:
    """Refuse what is no finite row for each start."""
    array = _require_numbers(answer, "a grid")
    if not array.size and effect.searched:
        raise Unacceptable("gives an empty grid; the search begins with at least one row")
    rows = array.shape[0] if array.ndim else 0
    return _require_finite(array, (max(rows, 1), len(effect.searched)), "a grid")


def form(effect: Guarded, answer: Any, _settings: Any) -> Effect:
    """Hand on the form of an effect, behind the boundary too."""
    return effect.guard_another(_require_kind(Effect, answer))  # type: ignore[no-any-return]


def forms(effect: Guarded, answer: Any) -> tuple[Effect, ...]:
    """Hand on the forms of an effect, behind the boundary too."""
    found = tuple(effect.guard_another(each) for each in _require_all_of(Effect, answer))
    if not found:
        raise Unacceptable("returns no form; there is one at least")
    return found


def forms_or_none(effect: Guarded, answer: Any) -> tuple[Effect, ...]:
    """Hand on further forms of an effect, if there are any."""
    return tuple(effect.guard_another(each) for each in _require_all_of(Effect, answer))


def untestable(_effect: Guarded, answer: Any, *_: Any) -> Any:
    """Refuse a reason that is not said in words."""
    return answer if answer is None else _require_kind(Words, answer)


def expected(effect: Guarded, answer: Any, *_: Any) -> Mapping[str, float]:
    """Refuse values that are none, or of no parameter."""
    names = {each.name for each in (*effect.linear, *effect.searched)}
    for name, value in _require_kind(Mapping, answer).items():
        if name not in names:
            raise Unacceptable(f"gives {name!r}, which is none of its parameters")
        _require_finite(value, (), str(name))
    return answer  # type: ignore[no-any-return]


def terms(_effect: Guarded, answer: Any, design: CircleDesign, _searched: Any) -> tuple[CircleTerm, ...]:
    """Refuse what is no finite column for each reading."""
    found = _require_all_of(CircleTerm, answer)
    return tuple(
        replace(each, column=_require_finite(each.column, (design.count,), f"a column of {each.name}"))
        for each in found
    )


def starts(effect: Guarded, answer: Any, _design: CircleDesign) -> tuple[tuple[float, ...], ...]:
    """Refuse what is no number for each searched parameter."""
    found = [tuple(map(float, each)) for each in _require_all_of(Iterable, answer)]
    for each in found:
        _require_finite(np.array(each, dtype=np.float64), (len(effect.searched),), "a row of its grid")
    return tuple(found)


def sentences(_plugin: Guarded, answer: Any, *_: Any) -> tuple[Words, ...]:
    """Take every sentence."""
    return _require_all_of(Words, answer)


def program(_program: Guarded, answer: Any, *_: Any) -> str:
    """Refuse what a control could not read."""
    text: str = _require_kind(str, answer)
    if not text or not text.isascii():
        raise Unacceptable("returns a program that is empty or not plain ASCII")
    return text


def tables(_controller: Guarded, answer: Any, *_: Any) -> Mapping[str, str]:
    """Refuse what are no files, and names that would leave their folder."""
    if not _require_kind(Mapping, answer):
        raise Unacceptable("returns no file")
    return cross_tables(_controller, answer)


def cross_tables(_controller: Guarded, answer: Any, *_: Any) -> Mapping[str, str]:
    """Refuse the same of tables across axes, of which there may be none that the control takes."""
    for name, text in _require_kind(Mapping, answer).items():
        if not isinstance(text, str) or not text:
            raise Unacceptable(f"returns no text for the file {name!r}")
        if not isinstance(name, str) or any(sign in name for sign in "/\\\0"):
            raise Unacceptable(f"returns a file that is called {name!r}; the end of a name is expected")
    return answer  # type: ignore[no-any-return]


def table(_controller: Guarded, answer: Any, *_: Any) -> CompensationTable:
    """Refuse a table with something else than a deviation at each position."""
    of: CompensationTable = _require_kind(CompensationTable, answer)
    shape = (np.size(of.positions),)
    for what, values in (("positions", of.positions), ("forward", of.forward), ("reverse", of.reverse)):
        _require_finite(values, shape, what)
    return of


def read_cross(_controller: Guarded, answer: Any, *_: Any) -> tuple[CrossTable, ...]:
    """Refuse a table across axes with something else than a value at each position."""
    found: tuple[CrossTable, ...] = _require_all_of(CrossTable, answer)
    for each in found:
        shape = (np.size(each.positions),)
        for what, values in (("positions", each.positions), ("values", each.values)):
            _require_finite(values, shape, what)
    return found


def contributions(_extension: Guarded, answer: Any, *_: Any) -> Sequence[Any]:
    """Take every contribution."""
    return _require_all_of(Contribution, answer)


def described(_extension: Guarded, answer: Any, *_: Any) -> Any:
    """Refuse what is no description."""
    return answer if answer is None else _require_kind(Described, answer)


def plan(extension: Guarded, answer: Any, *_: Any) -> Any:
    """Hand on a plan whose files and programs are asked for through the boundary too."""
    if answer is None:
        return None
    of = _require_kind(ExtensionPlan, answer)
    files = extension.look_after("files of the plan", of.files)
    return replace(of, subject=extension.look_after("subject of the plan", of.subject), files=files)


def live(extension: Guarded, answer: Any, *_: Any) -> Any:
    """Hand on readings that are taken through the boundary too."""
    if answer is None:
        return None
    of = _require_kind(LiveRun, answer)
    return replace(of, run=extension.look_after("live", of.run))


def contradictions(_extension: Guarded, answer: Any, *_: Any) -> Sequence[Any]:
    """Take every contradiction now: a generator would run elsewhere."""
    return _require_all_of(tuple, answer)


def completed(_extension: Guarded, answer: Any, *_: Any) -> Any:
    """Refuse what are no keys."""
    return _require_kind(JobKeys, answer)


def opened(instrument: Guarded, answer: Any, _options: Any) -> Any:
    """Hand on an open instrument, behind the boundary too."""
    lacking = [name for name in ("__enter__", "__exit__", "readings", "zero") if not hasattr(answer, name)]
    if lacking:
        raise Unacceptable(f"returns {_name_answer(answer)} without {', '.join(lacking)}; see Connection")
    return instrument.guard_connection(answer)


def receiver(_notifier: Guarded, answer: Any, _options: Any) -> str:
    """Refuse a receiver that could not be named in a line."""
    text: str = _require_kind(str, answer)
    if len(text.splitlines()) != 1 or not text.strip():
        raise Unacceptable("returns a receiver that is empty, or not of one line")
    return text


#: What is made of an answer, by kind and method.
ACCEPTED: Mapping[tuple[str, str], Callable[..., Any]] = MappingProxyType(
    {
        ("standard", "arithmetic"): arithmetic,
        ("standard", "requirements"): requirements,
        ("standard", "figures"): figures,
        ("standard", "of_error"): of_error,
        ("standard", "contributions"): of_lines,
        ("source", "read"): read,
        ("source", "proposals"): proposals,
        ("renderer", "render"): render,
        ("effect", "columns"): columns,
        ("effect", "grid"): grid,
        ("effect", "with_settings"): form,
        ("effect", "forms"): forms,
        ("effect", "further_forms"): forms_or_none,
        ("effect", "repeated"): form,
        ("effect", "untestable"): untestable,
        ("effect", "forbids"): untestable,
        ("effect", "tried_in"): untestable,
        ("effect", "expected"): expected,
        ("circle_effect", "terms"): terms,
        ("circle_effect", "grid"): starts,
        ("circle_effect", "findings"): sentences,
        ("circle_effect", "absence"): sentences,
        ("part_program", "write"): program,
        ("part_program", "write_circle"): program,
        ("controller", "files"): tables,
        ("controller", "read"): table,
        ("controller", "cross_files"): cross_tables,
        ("controller", "read_cross"): read_cross,
        ("instrument", "open"): opened,
        ("notifier", "receiver"): receiver,
        ("extension", "contributions"): contributions,
        ("extension", "doubts"): sentences,
        ("extension", "described"): described,
        ("extension", "contradictions"): contradictions,
        ("extension", "completed"): completed,
        ("extension", "plan"): plan,
        ("extension", "live"): live,
    }
)
