"""The job on the bench: read again whenever a file of it changes, and fitted no more often than needed."""

from __future__ import annotations

import hashlib
from collections import OrderedDict
from collections.abc import Callable, Iterable
from concurrent.futures import Future
from dataclasses import dataclass, field, replace
from pathlib import Path

from zlmreport import pipeline
from zlmreport.document.certificate.results import Evaluated
from zlmreport.errors import Place
from zlmreport.evaluation.correction.corrections import drop_excluded
from zlmreport.job.effect_choices import EffectChoice
from zlmreport.job.job import Job
from zlmreport.job.loading import load
from zlmreport.language import Language
from zlmreport.measurement.measurement_set import MeasurementSet
from zlmreport.measurement.provenance import SourceFile
from zlmreport.model.diagnosis.study import Fitted, Study, read_addition
from zlmreport.model.effects.axis_model import AxisModel, choose_terms
from zlmreport.model.fitting.sessions import add_zeros
from zlmreport.web.watched import WatchedFile, make_stamp_of

#: Where mistakes stand that are made on the page.
PLACE = Place("workbench")
#: Fits that are kept: more than anybody tries in an hour, and few enough for any memory.
_KEPT_FITS = 64


@dataclass(frozen=True, slots=True)
class Loaded:
    """The job as it stands in its files."""

    job: Job
    study: Study  #: Its readings with its model.
    basis: str  #: Names what the readings follow from: all but the model.
    #: Names the state of all files behind it: another state, another stamp; empty for a job that is not
    #: written yet.
    stamp: str = ""

    @property
    def measurements(self) -> MeasurementSet:
        """The readings."""
        return self.study.measurements

    @property
    def digest(self) -> str:
        """SHA-256 of the job file: what a change says that it was made from."""
        return self.job.files[0].sha256

    @property
    def language(self) -> Language:
        """Of its certificate."""
        return self.job.keys.certificate.language

    @property
    def content(self) -> str:
        """Names what stands in all files behind it, wherever and whenever they were written."""
        files = (*self.job.files, *_list_files(self.measurements, *self.study.sessions))
        return hashlib.sha256(" ".join(each.sha256 for each in files).encode()).hexdigest()


@dataclass(slots=True)
class _Readings:
    """What follows from the job without its model; what its standards say once that is asked for."""

    basis: str
    measurements: MeasurementSet
    evaluated: tuple[Evaluated, ...] | None = None


@dataclass(slots=True)
class Bench(WatchedFile[Loaded]):
    """A job file that is worked on."""

    _readings: _Readings | None = None
    _raw: tuple[str, MeasurementSet] | None = None
    _fits: OrderedDict[tuple[object, ...], Future[Fitted]] = field(default_factory=OrderedDict)

    def read(self) -> tuple[Callable[[str], Loaded], Iterable[Path | None]]:
        """Read the job with its readings."""
        job = load(self.path, self.registry)
        found = self.try_job(job)
        files = (*job.files, *_list_files(found.measurements, *found.study.sessions))
        return lambda stamp: replace(found, stamp=stamp), (each.path for each in files)

    def try_job(self, job: Job) -> Loaded:
        """Return a job with its readings, whether or not it is written already."""
        with self.lock:
            readings = self._read(job)
            sessions = pipeline.read_sessions(job, self.registry)
            study = Study.of(job, readings.measurements, self.registry.effects, sessions)
            return Loaded(job, study, readings.basis)

    def evaluate(self, loaded: Loaded) -> tuple[Evaluated, ...]:
        """Return what the standards of a job say of its readings; the lock is free meanwhile."""
        known = self._readings
        if known is not None and known.basis == loaded.basis and known.evaluated is not None:
            return known.evaluated
        found = pipeline.evaluate_all(loaded.job, loaded.measurements, self.registry)
        if known is not None and known.basis == loaded.basis:
            known.evaluated = found
        return found

    def fit_whole(self, loaded: Loaded) -> Fitted:
        """Return the fit of the whole model."""
        return self._fit(loaded.basis, loaded.study, loaded.job.effects)

    def fit_history(self, loaded: Loaded) -> tuple[Fitted, ...]:
        """Return the fits of no effect, of the first, of the first two …: each is made only once."""
        terms = loaded.study.model.terms
        effects = loaded.job.effects
        return tuple(
            self._fit(loaded.basis, replace(loaded.study, model=AxisModel(terms[:count])), effects[:count])
            for count in range(len(terms) + 1)
        )

    def fit_with_effect(self, loaded: Loaded, text: str) -> Fitted:
        """Return the fit of the model with an effect that a person names, in place of what that contains.

        Raises `InputError` if there is no such effect, or it cannot be fitted to these readings.
        """
        job, installed = loaded.job, self.registry.effects
        named, removed = read_addition(text, job, self.registry, installed, PLACE)
        kept = (each for each in job.effects if each.identifier not in removed)
        effects = (*kept, named.choice)
        by_identifier = {each.identifier: each for each in installed}
        terms = choose_terms(effects, by_identifier.__getitem__, job.axis.kind)
        model = add_zeros(AxisModel(terms), loaded.study.together.design)
        return self._fit(loaded.basis, replace(loaded.study, model=model), effects)

    def _read(self, job: Job) -> _Readings:
        """Return the readings: as before, if only the model has changed; read, if more than exclusions has.

        Raises `InputError` if they cannot be read, or a standard of the job cannot evaluate them.
        """
        before = self._readings
        if before is None or before.basis != _write_basis(job, before.measurements):
            raw = self._raw
            if raw is None or raw[0] != _write_basis(job, raw[1], but_for_excluded=True):
                measurements = pipeline.read_whole(job, self.registry)
                raw = self._raw = (_write_basis(job, measurements, but_for_excluded=True), measurements)
            measurements = drop_excluded(raw[1], job)
            pipeline.evaluate_parameters(job, measurements, self.registry)
            self._readings = before = _Readings(_write_basis(job, measurements), measurements)
        return before

    def _fit(self, basis: str, study: Study, effects: tuple[EffectChoice, ...]) -> Fitted:
        """Return a fit, made once; the lock is free meanwhile: a click waits for no step of the model."""
        key = (
            basis,
            *(each.sha256 for each in _list_files(*study.sessions)),
            len(study.model.terms),
            *(
                (each.identifier, each.settings, *sorted(each.values.items()), *sorted(each.limits.items()))
                for each in effects
            ),
        )
        with self.lock:
            found = self._fits.get(key)
            is_known = found is not None
            if found is None:
                found = self._fits[key] = Future()
                if len(self._fits) > _KEPT_FITS:
                    self._fits.popitem(last=False)
            self._fits.move_to_end(key)
        if not is_known:
            try:
                found.set_result(study.fit_whole())
            except BaseException as error:
                found.set_exception(error)
                with self.lock:
                    self._fits.pop(key, None)
                raise
        return found.result()


def _write_basis(job: Job, measurements: MeasurementSet, *, but_for_excluded: bool = False) -> str:
    """Return what readings and evaluations follow from: all keys but the model, and all other files."""
    stated = job.keys.model_copy(update={"model": None})
    if but_for_excluded:
        measured = stated.measurement.model_copy(update={"excluded": []})
        stated = stated.model_copy(update={"measurement": measured})
    files = (*job.files[1:], *measurements.provenance.files)
    state = make_stamp_of(each.path for each in files if each.path is not None)
    return hashlib.sha256(f"{stated!r} {state}".encode()).hexdigest()


def _list_files(*measurements: MeasurementSet) -> tuple[SourceFile, ...]:
    return tuple(file for each in measurements for file in each.provenance.files)
