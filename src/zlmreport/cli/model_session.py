"""A job whose error model is worked on, and what came of a change of it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from zlmreport import pipeline
from zlmreport.certificate.forecast import Forecast, forecasts
from zlmreport.cli.terminal import shown_path
from zlmreport.job.edit import Edit
from zlmreport.job.job import Job
from zlmreport.measurement.measurement_set import MeasurementSet
from zlmreport.model.study import Fitted, Study
from zlmreport.plugins import Registry


@dataclass(frozen=True, slots=True)
class Session:
    """A job whose error model is worked on, with its readings."""

    path: Path
    job: Job
    measurements: MeasurementSet
    registry: Registry

    @property
    def shown_path(self) -> str:
        """The job file, as the user would type it."""
        return shown_path(self.path)

    def study(self, job: Job | None = None) -> Study:
        """Return the study of the job, or of what it is to become."""
        return Study.of(job or self.job, self.measurements, self.registry.effects)

    def forecasts(self, study: Study, history: Sequence[Fitted]) -> tuple[Forecast, ...]:
        """Return what the job's standards would say of a corrected axis."""
        return forecasts(pipeline.standards(self.job, self.registry), study, history)


@dataclass(frozen=True, slots=True)
class Change:
    """A change of a model that makes sense.

    Attributes
    ----------
    edit
        Of the job file.
    added
        The effect that comes in; empty if none does.
    removed
        The effects that go out.
    before
        The model as it was.
    history
        The model as it is then, effect by effect.
    forecasts
        What standards would say of an axis corrected by it.
    """

    edit: Edit
    added: str
    removed: tuple[str, ...]
    before: Fitted
    history: tuple[Fitted, ...]
    forecasts: tuple[Forecast, ...]
