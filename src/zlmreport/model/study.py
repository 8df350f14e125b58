"""A job's error model beside its readings: what every command and the certificate's annex begin with."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from zlmreport.errors import InputError, Place, Problem
from zlmreport.job.job import Job
from zlmreport.measurement.measurement_set import MeasurementSet
from zlmreport.model.axis_model import AxisModel, ModelError
from zlmreport.model.chosen import chosen_terms
from zlmreport.model.diagnose import diagnose, error_numbers
from zlmreport.model.diagnosis import Diagnosis, ErrorNumbers
from zlmreport.model.effect import Effect
from zlmreport.model.fit import Assumptions, Fit, fit
from zlmreport.model.instrument import InstrumentError
from zlmreport.model.observe import Observations, observe
from zlmreport.model.outliers import outliers

#: Coverage factor of the instrument's uncertainty as a job states it.
_COVERAGE_FACTOR = 2.0
_KEY = "model.effects"


@dataclass(frozen=True, slots=True)
class Fitted:
    """A fitted model, and how far it is from the readings."""

    fit: Fit
    error: ErrorNumbers


@dataclass(frozen=True, slots=True)
class Study:
    """The error model that a job names, and the readings that it is held against.

    Its methods raise `InputError` at the place in the job where an effect stands that makes no sense on these
    readings.

    Attributes
    ----------
    job
        The job.
    measurements
        Its readings.
    model
        Its effects.
    observed
        The readings as the model sees them, none set aside.
    assumptions
        What fits take for granted: the error of the instrument, as the job states it.
    """

    job: Job
    measurements: MeasurementSet
    model: AxisModel
    observed: Observations
    assumptions: Assumptions

    @classmethod
    def of(cls, job: Job, measurements: MeasurementSet, effects: Sequence[Effect]) -> Study:
        """Begin the study of a job.

        Parameters
        ----------
        job
            A job whose effects are installed.
        measurements
            Its readings.
        effects
            All that are installed.
        """
        by_identifier = {effect.identifier: effect for effect in effects}
        return cls(
            job,
            measurements,
            AxisModel(chosen_terms(job.effects, by_identifier.__getitem__, job.axis.kind)),
            observe(measurements),
            Assumptions(instrument=instrument_error(job)),
        )

    def fitted(self) -> Fitted:
        """Return the model fitted to the readings, those that stand off set aside."""
        return self._fitted(self.model)

    def diagnosis(self, effects: Sequence[Effect]) -> Diagnosis:
        """Return the diagnosis: every installed effect is tried."""
        try:
            return diagnose(self.model, self.observed, effects, self.assumptions)
        except ModelError as error:
            raise InputError(self._problems(error)) from error

    def history(self, whole: Fitted | None = None) -> tuple[Fitted, ...]:
        """Return the fits of no effect, of the first, of the first two …, up to the whole model.

        So a history needs no record beside the job, and says of every model what is true of it today.

        Parameters
        ----------
        whole
            The fit of the whole model, where it is there already.
        """
        terms = self.model.terms
        parts = [self._fitted(AxisModel(terms[:count])) for count in range(len(terms))]
        return (*parts, whole or self.fitted())

    def _fitted(self, model: AxisModel) -> Fitted:
        kept = self.observed.without(outliers(self.observed.design, self.observed.deviation).readings)
        try:
            found = fit(model, kept.design, kept.deviation, self.assumptions)
        except ModelError as error:
            raise InputError(self._problems(error)) from error
        return Fitted(found, error_numbers(found))

    def _problems(self, error: ModelError) -> Iterator[Problem]:
        for sentence in error.sentences:
            yield Problem(self._place_of(sentence.partition(" ")[0]), sentence)

    def _place_of(self, identifier: str) -> Place:
        """Return where the job names an effect, or the list of effects if it does not."""
        for choice in self.job.effects:
            if choice.identifier == identifier:
                return choice.place
        return self.job.place_of(_KEY)


def instrument_error(job: Job) -> InstrumentError:
    """Return the error of the instrument as a job states it; none if it is not stated as a number."""
    stated = job.keys.instrument.expanded_uncertainty if job.keys.instrument else None
    if not isinstance(stated, int | float):
        return InstrumentError()
    return InstrumentError(common=job.axis.deviation_unit.to_si(stated) / _COVERAGE_FACTOR)
