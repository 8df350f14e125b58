"""From a step gauge's calibration file to its keys, checked."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from zlmreport.errors import InputError, Place, Problem
from zlmreport.job.extends import STEP_GAUGE, compose, refuse_other_format
from zlmreport.job.keys import JobKeys
from zlmreport.job.measurement_keys import Instrument
from zlmreport.job.step_gauge_file_keys import StepGaugeFileKeys
from zlmreport.job.tree import Keys, place_of
from zlmreport.job.validate import validate
from zlmreport.measurement.provenance import SourceFile

#: Names of files that hold all facts; any other is a table of the faces.
_SUFFIXES = frozenset({".yaml", ".yml"})


@dataclass(frozen=True, slots=True)
class StepGaugeFile:
    """A checked calibration file.

    Attributes
    ----------
    keys
        What it says, in users' units.
    file
        Its name, digest and bytes.
    tree
        What it says, value by value, with the places.
    """

    keys: StepGaugeFileKeys
    file: SourceFile
    tree: Keys

    def place_of(self, *steps: str | int) -> Place:
        """Return where a key stands; of one that is missing, its nearest parent's place."""
        return place_of(self.tree, steps)


def holds_all_facts(path: Path) -> bool:
    """Whether a calibration is such a file, and no bare table of faces."""
    return path.suffix.lower() in _SUFFIXES


def load_step_gauge(path: Path) -> StepGaugeFile:
    """Read a calibration file.

    Raises
    ------
    InputError
        With every mistake, in the order of their places.
    AccessError
        If it cannot be read.
    """
    composition = compose(path)
    tree = composition.keys
    refuse_other_format(tree, STEP_GAUGE)
    problems: list[Problem] = []
    keys = validate(StepGaugeFileKeys, tree, problems)
    if problems or keys is None:
        raise InputError(sorted(set(problems)))
    return StepGaugeFile(keys, composition.files[0], tree)


def with_gauge_as_instrument(keys: JobKeys) -> JobKeys:
    """Return the keys of a job whose step gauge is its measuring instrument, unless it names another.

    The gauge's uncertainty as an instrument is that of the face whose distance is known worst; the budget
    takes each face by itself.

    Raises
    ------
    InputError
        With every mistake of the calibration file.
    AccessError
        If it cannot be read.
    """
    if keys.step_gauge is None or keys.instrument or not holds_all_facts(keys.step_gauge.calibration):
        return keys
    gauge = load_step_gauge(keys.step_gauge.calibration).keys
    instrument = Instrument(
        name=gauge.name,
        manufacturer=gauge.manufacturer,
        serial=gauge.serial,
        certificate=gauge.certificate,
        calibrated=gauge.calibrated,
        expanded_uncertainty=max(face.expanded_uncertainty for face in gauge.faces) or None,
        expansion_coefficient=gauge.expansion_coefficient,
    )
    return keys.model_copy(update={"instrument": instrument})
