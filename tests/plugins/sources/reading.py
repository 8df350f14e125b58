"""How tests of data sources hand a file to a reader."""

from __future__ import annotations

from dataclasses import astuple, dataclass
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from installed import registry
from zlmreport.plugin import Approach, Axis, InputError, Language, MeasurementSet, Place
from zlmreport.plugin.protocols import DataSource, SourceContext

DATA = Path(__file__).parents[2] / "data"
#: Where the job names the source.
JOB = Place("job.yaml", 9, 5)
#: In SI, of what is written in micrometres and in millimetres.
UM, MM = 1e-6, 1e-3


@dataclass(frozen=True)
class File:
    """A file for the data source of an identifier, written anew for each reading."""

    identifier: str
    path: Path

    @property
    def source(self) -> DataSource:
        """The installed data source."""
        return registry().source(self.identifier)

    def read(self, content: str | bytes, axis: Axis | None = None, **keys: Any) -> MeasurementSet:
        """Write the file and read it."""
        self.path.write_bytes(content if isinstance(content, bytes) else content.encode())
        return self.read_as_it_is(axis, **keys)

    def read_as_it_is(self, axis: Axis | None = None, **keys: Any) -> MeasurementSet:
        """Read the file."""
        options = self.source.options.model_validate({"file": self.path, **keys})
        return self.source.read(options, SourceContext(axis or Axis("X"), JOB))

    def complaints(self, content: str | bytes, axis: Axis | None = None, **keys: Any) -> list[str]:
        """Write a file that is wrong; return what is said of it, the folder left out."""
        with pytest.raises(InputError) as caught:
            self.read(content, axis, **keys)
        folder = f"{self.path.parent}/"
        return [str(problem).removeprefix(folder) for problem in caught.value.problems]

    def complaint(self, content: str | bytes, axis: Axis | None = None, **keys: Any) -> str:
        """Return the only thing that is said of a file."""
        (complaint,) = self.complaints(content, axis, **keys)
        return complaint


def said(measurements: MeasurementSet) -> list[str]:
    """Return the remarks on the readings, in English."""
    return [remark.in_language(Language.ENGLISH) for remark in measurements.provenance.remarks]


def missing_in(measurements: MeasurementSet) -> list[tuple[float, Approach, int]]:
    """Return target (m or rad), direction and run of each reading that is missing."""
    return [astuple(each) for each in measurements.missing()]


def assert_same_readings(first: MeasurementSet, second: MeasurementSet, tolerance: float = 0.0) -> None:
    """Hold two sets to be the same readings in the same order; `tolerance` is of deviations, m or rad."""
    np.testing.assert_array_equal(first.target_positions, second.target_positions)
    np.testing.assert_array_equal(first.target, second.target)
    np.testing.assert_array_equal(first.approach, second.approach)
    np.testing.assert_array_equal(first.run, second.run)
    np.testing.assert_allclose(first.deviation, second.deviation, rtol=0.0, atol=tolerance)
