"""What every data source must do."""

from __future__ import annotations

import hashlib
import re
import tempfile
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, TypeAlias

import numpy as np

from zlmreport.errors import Place, ZlmreportError, count_in_words
from zlmreport.measurement.approach import Approach
from zlmreport.measurement.axis import Axis, AxisKind
from zlmreport.measurement.measurement_set import MeasurementSet
from zlmreport.plugin.kinds import SOURCE
from zlmreport.plugin.protocols import DataSource, SourceContext
from zlmreport.testing.expectations import (
    check,
    expect,
    expect_named,
    expect_options,
    expect_words,
    guard_subject,
    is_same_value,
    list_checks_of,
    run_all,
)

_DIRECTIONS = {"+": Approach.POSITIVE, "-": Approach.NEGATIVE}
#: What a file's own digits leave open, µm or ″.
_DIGITS = 5e-4


#: The axis that the data are of, or the whole context of a source that needs more of the job than that.
OfAxis: TypeAlias = Axis | SourceContext


@dataclass(frozen=True, slots=True)
class FileContents:
    """What the author of a data source knows that a file holds, as somebody reads it who looks into it.

    Attributes
    ----------
    readings
        How many readings there are; those that are missing are not counted.
    samples
        Some of them, each with its target (mm, °), its direction (``+`` or ``-``), the number of its run and
        its deviation (µm, ″): at least one of each direction and one of the last run, so that a swapped
        direction, a wrong sign or unit and a lost run show.
    missing
        How many readings a full test would have beside these.
    """

    readings: int
    samples: tuple[tuple[float, str, int, float], ...]
    missing: int = 0


@check
def is_named(source: DataSource, _keys: Mapping[str, Any], _axis: OfAxis, *_: Any) -> None:
    """Check that it has an identifier that can be typed, and a title in every language."""
    expect_named(source, SOURCE)


@check
def options_are_described(source: DataSource, _keys: Mapping[str, Any], _axis: OfAxis, *_: Any) -> None:
    """Check that its job keys are described, and none is a key of the core."""
    expect_options(source, SOURCE)


@check
def reads_what_the_file_holds(
    source: DataSource,
    keys: Mapping[str, Any],
    axis: OfAxis,
    holds: FileContents | None = None,
) -> None:
    """Check that the readings are those of the file: their number, and the samples that the author knows."""
    where = source.identifier
    expect(
        holds,
        f"{where}: say what the file holds: check_source(…, holds=FileContents(readings, samples, missing)); "
        "nobody else can see a swapped direction, a wrong sign or a lost run",
    )
    assert holds is not None  # noqa: S101  # said above; for type checkers
    read = _read(source, keys, axis)
    found, missing = int(np.isfinite(read.deviation).sum()), len(read.missing())
    expect(
        found == holds.readings,
        f"{where}: {count_in_words(found, 'reading')}; the file holds {holds.readings}",
    )
    expect(missing == holds.missing, f"{where}: missing readings: {missing}; expected {holds.missing}")
    _expect_telling(read, holds, where)
    positions = read.axis.position_unit.from_si(read.target_positions[read.target])
    deviations = read.axis.deviation_unit.from_si(read.deviation)
    for target, direction, run, deviation in holds.samples:
        is_it = np.isclose(positions, target, rtol=0.0, atol=1e-6)
        is_it &= (read.approach == _DIRECTIONS[direction]) & (read.run == run)
        which = f"{where}: the reading at {target:g} {direction} of run {run}"
        expect(is_it.any(), f"{which} is not read")
        got = float(deviations[is_it][0])
        expect(abs(got - deviation) <= _DIGITS, f"{which} is {got:.6g}; the file holds {deviation:.6g}")


def _expect_telling(read: MeasurementSet, holds: FileContents, where: str) -> None:
    """Expect samples of which the usual mistakes would change one."""
    directions = {_DIRECTIONS[direction] for _, direction, _, _ in holds.samples}
    expect(
        directions >= set(read.approaches),
        f"{where}: samples of the file's contents must show each direction that was measured",
    )
    expect(
        any(run == read.runs.max() for _, _, run, _ in holds.samples),
        f"{where}: samples of the file's contents must show the last run, {read.runs.max()}",
    )
    expect(
        len({deviation for *_, deviation in holds.samples} - {0.0}) > 1,
        f"{where}: samples of the file's contents must have different deviations, for a swap to show",
    )


@check
def values_are_read_only(source: DataSource, keys: Mapping[str, Any], axis: OfAxis, *_: Any) -> None:
    """Check that nobody can alter a reading."""
    measurements = _read(source, keys, axis)
    arrays = {
        "target_positions": measurements.target_positions,
        "deviation": measurements.deviation,
        "target": measurements.target,
        "approach": measurements.approach,
        "run": measurements.run,
        **measurements.conditions,
    }
    for name, values in arrays.items():
        expect(not values.flags.writeable, f"{source.identifier}: {name} can be altered; make it read-only")


@check
def reads_a_measurement_set(source: DataSource, keys: Mapping[str, Any], axis: OfAxis, *_: Any) -> None:
    """Check that what it reads is whole: the axis of the job, rising targets, directions, runs from 1."""
    _read(guard_subject(source, SOURCE), keys, axis)


@check
def reads_the_same_again(source: DataSource, keys: Mapping[str, Any], axis: OfAxis, *_: Any) -> None:
    """Check that the same file gives the same measurement set."""
    first, second = (_read(source, keys, axis) for _ in range(2))
    expect(
        is_same_value(first, second), f"{source.identifier}: reading the same data again gives another set"
    )


@check
def names_its_files(source: DataSource, keys: Mapping[str, Any], axis: OfAxis, *_: Any) -> None:
    """Check that the provenance names each file read, without its folder, with its bytes."""
    provenance = _read(source, keys, axis).provenance
    named = {file.name: file for file in provenance.files}
    for key, path in _list_files(source, keys):
        where = f"{source.identifier}: provenance of '{key}'"
        expect(path.name in named, f"{where}: files do not name {path.name!r} (they name {sorted(named)})")
        content = path.read_bytes()
        expect(named[path.name].size == len(content), f"{where}: size is not that of the file")
        expect(
            named[path.name].sha256 == hashlib.sha256(content).hexdigest(),
            f"{where}: sha256 is not the digest of the file",
        )
        expect(
            named[path.name].content == content,
            f"{where}: content is not the bytes of the file, which a certificate carries; use SourceFile.of",
        )


@check
def remarks_are_worded(source: DataSource, keys: Mapping[str, Any], axis: OfAxis, *_: Any) -> None:
    """Check that what it has to say of the file is said in every language."""
    for number, remark in enumerate(_read(source, keys, axis).provenance.remarks, 1):
        expect_words(remark, f"{source.identifier}: provenance: remark {number}")


@check
def damaged_files_are_refused(source: DataSource, keys: Mapping[str, Any], axis: OfAxis, *_: Any) -> None:
    """Check that a file that is no such file is refused by name: no other exception, no measurement set."""
    for key, path in _list_files(source, keys):
        for damage, content in _damage(path.read_bytes()).items():
            with tempfile.TemporaryDirectory() as folder:
                copy = Path(folder, path.name)
                if content is not None:
                    copy.write_bytes(content)
                where = f"{source.identifier}: '{key}' names {damage}"
                try:
                    _read(source, {**keys, key: copy}, axis)
                except ZlmreportError as error:
                    places = {problem.place.file for problem in error.problems}
                    expect(
                        any(Path(place).name == path.name for place in places),
                        f"{where}: the message does not name the file: {error}",
                    )
                except Exception as error:
                    message = (
                        f"{where}: {error!r}; expected an InputError or AccessError with the file's place"
                    )
                    raise AssertionError(message) from error
                else:
                    expect(damage == _CUT, f"{where}, and it reads measurements from that")


#: So many places of a file are damaged one by one, evenly spread where it has more.
_DAMAGES = 40
_NUMBER_IN_TEXT = re.compile(rb"(?<![\w.,+-])[-+]?\d+(?:[.,]\d+)?(?![\w.,])")
#: What makes of a number none, without making two words or two cells of it.
_GARBLE = b"x"


@check
def no_number_is_guessed(source: DataSource, keys: Mapping[str, Any], axis: OfAxis, *_: Any) -> None:
    """Check that a number that is none (``1x25``) is refused with its place, or was no reading at all."""
    before = _read(source, keys, axis)
    for key, path in _list_files(source, keys):
        content = path.read_bytes()
        for found in _spread(list(_NUMBER_IN_TEXT.finditer(content))):
            middle = (found.start() + found.end() + 1) // 2
            damaged = content[:middle] + _GARBLE + content[middle:]
            word = damaged[found.start() : found.end() + 1].decode("ascii")
            line = content.count(b"\n", 0, middle) + 1
            read = _read_damaged(source, {**keys, key: path}, key, damaged, axis)
            expect(
                read is None or _has_same_readings(read, before),
                f"{source.identifier}: line {line} of '{key}' holds {word!r}, and "
                f"that makes {_read_instead(read, before)}; "
                "a number that is none is an InputError with its place",
            )


@check
def no_short_line_is_dropped(source: DataSource, keys: Mapping[str, Any], axis: OfAxis, *_: Any) -> None:
    """Check that a line whose last word is lost is refused, or counts as one missing reading and no more."""
    before = _read(source, keys, axis)
    known = _count_found(before) + len(before.missing())
    for key, path in _list_files(source, keys):
        lines = path.read_bytes().splitlines(keepends=True)
        for number in _spread(range(len(lines))):
            shorter = re.sub(rb"[^\s,;]+(\s*)\Z", rb"\1", lines[number])
            if shorter == lines[number] or not re.search(rb"\d", lines[number]):
                continue
            damaged = b"".join([*lines[:number], shorter, *lines[number + 1 :]])
            read = _read_damaged(source, {**keys, key: path}, key, damaged, axis)
            if read is None or _has_same_readings(read, before):
                continue
            is_told = (
                _count_found(read) >= _count_found(before) - 1
                and _count_found(read) + len(read.missing()) >= known
            )
            expect(
                is_told,
                f"{source.identifier}: line {number + 1} of '{key}' lost its last word, and that makes "
                f"{_read_instead(read, before)}; a line that is too short is an InputError with its place",
            )


@check
def follows_the_kind_of_axis(source: DataSource, keys: Mapping[str, Any], axis: OfAxis, *_: Any) -> None:
    """Check that of an axis of the other kind the same numbers are degrees (millimetres), or are refused.

    Of a source that needs more of the job than its axis, that part of the job says which axes go with it.
    """
    context = _make_context(axis)
    if context.axis.quantity is not None or context.set_ups:
        return
    was_linear = context.axis.kind is AxisKind.LINEAR
    other = Axis("C", AxisKind.ROTARY) if was_linear else Axis("X")
    before = _read(source, keys, axis)
    try:
        read = _read(source, keys, replace(context, axis=other))
    except ZlmreportError:
        return
    where = f"{source.identifier}: read as of {'a rotary' if was_linear else 'a linear'} axis"
    targets, wanted = (each.axis.position_unit.from_si(each.target_positions) for each in (read, before))
    expect(
        targets.shape == wanted.shape and np.allclose(targets, wanted, rtol=1e-9, atol=1e-9),
        f"{where} the targets are {targets[:3]} {other.position_unit.symbol}, the file says {wanted[:3]}; "
        "ask the axis for its units (axis.position_unit), or refuse it",
    )
    one, two = (each.axis.deviation_unit.from_si(each.deviation) for each in (read, before))
    # A file with deviations gives them in both units; one with positions makes 1000 µm of 1 mm, 3600″ of 1°.
    ratios = (1.0, 3.6) if was_linear else (1.0, 1 / 3.6)
    expect(
        any(np.allclose(one, two * ratio, rtol=1e-6, atol=1e-6, equal_nan=True) for ratio in ratios),
        f"{where} deviations are {one[:3]} {other.deviation_unit.symbol} instead of {two[:3]}; ask the axis "
        "for its units (axis.deviation_unit), or refuse it",
    )


def _spread(places: Sequence[Any]) -> Sequence[Any]:
    """Return some of many places, the first and the last among them."""
    if len(places) <= _DAMAGES:
        return places
    return [places[index] for index in np.linspace(0, len(places) - 1, _DAMAGES).astype(int)]


def _read_damaged(
    source: DataSource, keys: Mapping[str, Any], key: str, content: bytes, axis: OfAxis
) -> MeasurementSet | None:
    """Return what is read of a copy with another content; None where it is refused."""
    with tempfile.TemporaryDirectory() as folder:
        copy = Path(folder, keys[key].name)
        copy.write_bytes(content)
        try:
            return _read(source, {**keys, key: copy}, axis)
        except ZlmreportError:
            return None


def _count_found(read: MeasurementSet) -> int:
    return int(np.isfinite(read.deviation).sum())


def _has_same_readings(one: MeasurementSet, other: MeasurementSet) -> bool:
    return all(
        np.array_equal(getattr(one, name), getattr(other, name), equal_nan=name == "deviation")
        for name in ("target_positions", "target", "approach", "run", "deviation")
    )


def _read_instead(read: MeasurementSet | None, before: MeasurementSet) -> str:
    if read is None:
        return "nothing"
    lost = _count_found(before) - _count_found(read)
    fewer = f"{count_in_words(lost, 'reading')} fewer" if lost else "other readings"
    return f"{fewer} without a word"


_CUT = "a file cut off in the middle"


def _damage(content: bytes) -> Mapping[str, bytes | None]:
    return {
        "a file that is not there": None,
        "an empty file": b"",
        "a file of blank lines": b"\n \n\t\n\r\n",
        "a binary file": bytes(range(256)) * 16,
        "a file of words": "Über die Messung ist nichts bekannt.\n".encode() * 5,
        _CUT: content[: len(content) // 2],
    }


def _list_files(source: DataSource, keys: Mapping[str, Any]) -> Iterator[tuple[str, Path]]:
    """Yield the keys whose values are existing files."""
    options = source.options.model_validate(dict(keys))
    for key in type(options).model_fields:
        value = getattr(options, key)
        if isinstance(value, Path) and value.is_file():
            yield key, value


def _read(source: DataSource, keys: Mapping[str, Any], axis: OfAxis) -> MeasurementSet:
    options = source.options.model_validate(dict(keys))
    return source.read(options, _make_context(axis))


def _make_context(axis: OfAxis) -> SourceContext:
    return axis if isinstance(axis, SourceContext) else SourceContext(axis, Place("job.yaml", 1, 1))


#: Every check of a data source, each called with the source, its job keys, the axis, and what the file holds.
SOURCE_CHECKS = list_checks_of(__name__)


def check_source(
    source: DataSource,
    keys: Mapping[str, Any],
    *,
    axis: OfAxis | None = None,
    holds: FileContents | None = None,
) -> None:
    """Run every check on a data source.

    Parameters
    ----------
    source
        The object that the plugin's hook returns.
    keys
        Its job keys for data that it reads without complaint, as a job file would give them.
    axis
        The axis that the data are of; a linear one, X, if it is not given. Or the whole context of a source
        that needs more of the job.
    holds
        What the data are, as the author knows them from elsewhere; without it the kit cannot tell a right
        reader from a wrong one, and does not pass.

    Raises
    ------
    AssertionError
        With a line for every check that fails.
    """
    axis = axis or Axis("X")
    run_all(SOURCE, SOURCE_CHECKS, source, keys, axis, holds)
