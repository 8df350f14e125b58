"""Each check of a data source passes the exemplary one, and finds the sin it is there for."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from pydantic import Field

from refusals import failed_checks
from testing.exemplary import ExemplarySource, ExemplarySourceOptions
from testing.sinning import make_sinner, make_tests
from zlmreport.measurement.arrays import read_only_integers
from zlmreport.plugin import (
    Axis,
    InputError,
    JobPath,
    MeasurementSet,
    Options,
    Place,
    Words,
    read_only_floats,
    same_in_all_languages as same,
)
from zlmreport.plugin.protocols import SourceContext
from zlmreport.testing import SOURCE_CHECKS, FileContents, check_source, simulated_test, sources


class UndescribedOptions(Options):
    file: JobPath


class GreedyOptions(ExemplarySourceOptions):
    plugin: str = Field("x", description="Taken.")


def reading(change: Callable[[MeasurementSet], MeasurementSet]) -> dict[str, Any]:
    """Return the sin of a source whose measurement set has been changed."""
    return {"read": lambda self, options, context: change(ExemplarySource.read(self, options, context))}


def negligent(_self: object, options: Any, context: SourceContext) -> MeasurementSet:
    try:
        return ExemplarySource().read(options, context)
    except Exception:  # noqa: BLE001 - the sin
        return simulated_test(axis=context.axis)


def careless(_self: object, options: Any, _context: SourceContext) -> MeasurementSet:
    raise ValueError(options.file.read_text(encoding="utf-8"))


def nameless(self: Any, options: Any, context: SourceContext) -> MeasurementSet:
    try:
        return ExemplarySource.read(self, options, context)
    except Exception as error:
        raise InputError.at(Place("somewhere"), "cannot be read") from error


def stale(measurements: MeasurementSet) -> MeasurementSet:
    (file,) = measurements.provenance.files
    return with_provenance(measurements, files=(replace(file, sha256="0" * 64),))


def forgetful(measurements: MeasurementSet) -> MeasurementSet:
    (file,) = measurements.provenance.files
    return with_provenance(measurements, files=(replace(file, content=None),))


def with_provenance(measurements: MeasurementSet, **changes: Any) -> MeasurementSet:
    return replace(measurements, provenance=replace(measurements.provenance, **changes))


def swapped(measurements: MeasurementSet) -> MeasurementSet:
    return replace(measurements, approach=read_only_integers(-measurements.approach))


def scaled(factor: float) -> Callable[[MeasurementSet], MeasurementSet]:
    return lambda sound: replace(sound, deviation=read_only_floats(factor * sound.deviation))


def shortened(measurements: MeasurementSet) -> MeasurementSet:
    """Leave one direction out, as a reader does that stops at the first empty line."""
    kept = measurements.approach == 1
    return replace(
        measurements,
        **{
            name: read_only_integers(getattr(measurements, name)[kept])
            for name in ("target", "approach", "run")
        },
        deviation=read_only_floats(measurements.deviation[kept]),
    )


def turned(measurements: MeasurementSet) -> MeasurementSet:
    """Count targets from the wrong end."""
    return replace(measurements, target=read_only_integers(2 - measurements.target))


class Fickle(ExemplarySource):
    factor = 1.0

    def read(self, options: Any, context: SourceContext) -> MeasurementSet:
        measurements = super().read(options, context)
        self.factor += 1
        return replace(measurements, deviation=read_only_floats(measurements.deviation * self.factor))


def forgiving(self: Any, options: Any, context: SourceContext) -> MeasurementSet:
    """Read one direction only where there are not enough numbers for both."""
    words = options.file.read_text(encoding="ascii").split()
    if len(words) == 6:
        return ExemplarySource.read(self, options, context)
    options.file.write_text(" ".join((words + ["0"] * 6)[:6]), encoding="ascii")
    return shortened(ExemplarySource.read(self, options, context))


def _lenient(number: Callable[[str], float]) -> Callable[..., MeasurementSet]:
    """Return a reader that takes any word for a number."""

    def read(self: Any, options: Any, context: SourceContext) -> MeasurementSet:
        values = [number(word) for word in options.file.read_text(encoding="ascii").split()]
        options.file.write_text("1 2 3 4 5 6", encoding="ascii")
        sound = ExemplarySource.read(self, options, context)
        return replace(sound, deviation=read_only_floats(np.array(values) * 1e-6))

    return read


def _as_missing(word: str) -> float:
    try:
        return float(word)
    except ValueError:
        return np.nan


def _up_to_the_letter(word: str) -> float:
    return float(word.partition("x")[0])


def in_millimetres(self: Any, options: Any, context: SourceContext) -> MeasurementSet:
    return replace(ExemplarySource.read(self, options, replace(context, axis=Axis("X"))), axis=context.axis)


def in_micrometres(self: Any, options: Any, context: SourceContext) -> MeasurementSet:
    sound = ExemplarySource.read(self, options, context)
    length = ExemplarySource.read(self, options, replace(context, axis=Axis("X")))
    return replace(sound, deviation=length.deviation)


WRITABLE = np.array([1.0, 2.0, 3.0, 4.0, 5.0, 6.0])
SINS = [
    (sources.is_named, {"identifier": "Exemplary Text"}, "lower-case ASCII"),
    (sources.is_named, {"title": Words(en="", de="Titel")}, "title says nothing in 'en'"),
    (sources.options_are_described, {"options": UndescribedOptions}, "'file' needs a description"),
    (sources.options_are_described, {"options": GreedyOptions}, "plugin belong to the core"),
    (sources.reads_a_measurement_set, {"read": lambda *_: None}, "MeasurementSet is expected"),
    (
        sources.reads_a_measurement_set,
        reading(lambda m: replace(m, target_positions=m.target_positions[::-1])),
        "target positions that do not rise",
    ),
    (sources.reads_a_measurement_set, reading(lambda m: replace(m, run=m.run[:-1])), "run of the shape (5,)"),
    (
        sources.reads_a_measurement_set,
        reading(lambda m: replace(m, conditions={"load": WRITABLE[:2]})),
        "load of the shape (2,)",
    ),
    (
        sources.reads_a_measurement_set,
        reading(lambda m: replace(m, deviation=m.deviation * np.inf)),
        "a deviation that is infinite",
    ),
    (
        sources.reads_a_measurement_set,
        reading(lambda m: replace(m, target=m.target + 1)),
        "target that is no index of the target positions",
    ),
    (
        sources.reads_a_measurement_set,
        reading(lambda m: replace(m, approach=m.approach * 2)),
        "neither 1 nor -1",
    ),
    (sources.reads_a_measurement_set, reading(lambda m: replace(m, run=m.run - 1)), "numbered from 1"),
    (
        sources.reads_what_the_file_holds,
        reading(swapped),
        "the reading at 0 + of run 1 is 0.5; the file holds 1.5",
    ),
    (sources.reads_what_the_file_holds, reading(scaled(-1)), "is -1.5; the file holds 1.5"),
    (sources.reads_what_the_file_holds, reading(scaled(1000)), "is 1500; the file holds 1.5"),
    (sources.reads_what_the_file_holds, reading(scaled(1e-3)), "is 0.0015; the file holds 1.5"),
    (sources.reads_what_the_file_holds, reading(shortened), "3 readings; the file holds 6"),
    (sources.reads_what_the_file_holds, reading(turned), "is 3.5; the file holds 1.5"),
    (sources.reads_a_measurement_set, reading(lambda m: replace(m, axis=Axis("W"))), "the job describes"),
    (
        sources.values_are_read_only,
        reading(lambda m: replace(m, deviation=WRITABLE)),
        "deviation can be altered",
    ),
    (
        sources.reads_a_measurement_set,
        reading(lambda m: with_provenance(m, source="other")),
        "names 'other' as the source",
    ),
    (sources.names_its_files, reading(lambda m: with_provenance(m, files=())), "do not name 'six.txt'"),
    (sources.names_its_files, reading(stale), "sha256 is not the digest"),
    (sources.names_its_files, reading(forgetful), "content is not the bytes of the file"),
    (
        sources.remarks_are_worded,
        reading(lambda m: with_provenance(m, remarks=(same(""),))),
        "remark 1 says nothing",
    ),
    (sources.damaged_files_are_refused, {"read": negligent}, "a file that is not there, and it reads"),
    (sources.damaged_files_are_refused, {"read": careless}, "FileNotFoundError"),
    (sources.damaged_files_are_refused, {"read": nameless}, "does not name the file"),
    (
        sources.no_number_is_guessed,
        {"read": _lenient(_as_missing)},
        "line 1 of 'file' holds '1x', and that makes 1 reading fewer without a word",
    ),
    (sources.no_number_is_guessed, {"read": _lenient(_up_to_the_letter)}, "other readings without a word"),
    (
        sources.no_short_line_is_dropped,
        {"read": forgiving},
        "line 1 of 'file' lost its last word, and that makes 3 readings fewer without a word",
    ),
    (
        sources.follows_the_kind_of_axis,
        {"read": in_millimetres},
        "read as of a rotary axis the targets are [ 0.          5.72957795 11.4591559 ] °",
    ),
    (
        sources.follows_the_kind_of_axis,
        {"read": in_micrometres},
        "ask the axis for its units (axis.deviation",
    ),
]


def keys_in(folder: Path) -> dict[str, Any]:
    file = folder / "six.txt"
    file.write_text("1.5 2.5 3.5 0.5 1.5 2.5\n", encoding="ascii")
    return {"file": file}


@pytest.fixture
def keys(tmp_path: Path) -> dict[str, Any]:
    return keys_in(tmp_path)


HOLDS = FileContents(6, ((0.0, "+", 1, 1.5), (200.0, "+", 1, 3.5), (0.0, "-", 1, 0.5)))


test_exemplary_passes, test_a_check_finds_its_sin, test_every_check_has_a_sin = make_tests(
    SOURCE_CHECKS,
    ExemplarySource,
    SINS,
    lambda _, folder: (keys_in(folder), Axis("X"), HOLDS),
    beside=[sources.reads_the_same_again],
)


def test_a_source_that_reads_something_else_the_second_time_is_found(keys: dict[str, Any]) -> None:
    with pytest.raises(AssertionError, match="gives another set"):
        sources.reads_the_same_again(Fickle(), keys, Axis("X"), HOLDS)


def test_all_failures_are_reported_at_once(keys: dict[str, Any]) -> None:
    sin = reading(lambda m: replace(m, axis=Axis("W"), approach=read_only_integers(m.approach * 2)))
    sinner = make_sinner(ExemplarySource, sin)
    checks = failed_checks(check_source, sinner, keys, holds=HOLDS)
    assert checks == [
        "reads_what_the_file_holds",
        "reads_a_measurement_set",
        "follows_the_kind_of_axis",
    ]


ZEROED = FileContents(5, ((0.0, "+", 1, 1.5), (0.0, "-", 1, 0.5)), missing=1)


def test_a_missing_reading_that_is_filled_in_is_found(keys: dict[str, Any]) -> None:
    keys["file"].write_text("1.5 nan 3.5 0.5 1.5 2.5\n", encoding="ascii")
    sources.reads_what_the_file_holds(ExemplarySource(), keys, Axis("X"), ZEROED)
    filled = reading(lambda m: replace(m, deviation=read_only_floats(np.nan_to_num(m.deviation))))
    with pytest.raises(AssertionError, match="6 readings; the file holds 5"):
        sources.reads_what_the_file_holds(make_sinner(ExemplarySource, filled), keys, Axis("X"), ZEROED)


@pytest.mark.parametrize(
    ("holds", "sentence"),
    [
        (None, "say what the file holds"),
        (FileContents(6, ((0.0, "+", 1, 1.5), (200.0, "+", 1, 3.5))), "must show each direction"),
        (FileContents(6, ((0.0, "+", 1, 1.5), (100.0, "-", 1, 1.5))), "must have different deviations"),
    ],
)
def test_contents_that_would_show_no_mistake_are_not_enough(
    holds: Any, sentence: str, keys: dict[str, Any]
) -> None:
    with pytest.raises(AssertionError, match=sentence):
        sources.reads_what_the_file_holds(ExemplarySource(), keys, Axis("X"), holds)
