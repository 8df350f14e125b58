"""Several tests of one axis beside each other: deviations, differences, parameters with U, models."""

from __future__ import annotations

import datetime as dt
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from itertools import chain
from typing import Any

import numpy as np

from zlmreport import pipeline
from zlmreport.document.certificate.results import Evaluated
from zlmreport.document.subjects.fit import make_parameter_rows
from zlmreport.document.subjects.linked import collect_drawn_values
from zlmreport.document.writer import NOTHING, Writer, write_with_uncertainty
from zlmreport.errors import InputError, Place, Problem, ZlmreportError
from zlmreport.evaluation.evaluation import EvaluatedParameter
from zlmreport.evaluation.statistics import position_statistics
from zlmreport.job.contradictions import find_last_day
from zlmreport.job.job import Job
from zlmreport.language import Language, Words, same
from zlmreport.measurement.arrays import FloatArray
from zlmreport.measurement.axis import Axis
from zlmreport.measurement.measurement_set import MeasurementSet
from zlmreport.model.diagnosis.study import Fitted
from zlmreport.model.effects.effect import Effect
from zlmreport.web.bench import Bench, Loaded
from zlmreport.web.naming import Naming
from zlmreport.web.panels import split_symbol

_AS_FOUND = Words("{name}, as found")


@dataclass(frozen=True, slots=True)
class _Test:
    """One test of the axis: the job's own, or the one before its adjustment."""

    name: Words
    job: Job
    measurements: MeasurementSet
    evaluated: tuple[Evaluated, ...]
    model: Fitted | None

    @property
    def day(self) -> dt.date | None:
        return find_last_day(self.job.keys.measurement)

    @property
    def means(self) -> FloatArray:
        """Mean deviations, shape (direction, target)."""
        return position_statistics(self.measurements.deviations(), self.measurements.target_positions).mean


@dataclass(slots=True)
class ComparedTests:
    """The tests that are laid over that of the job on the bench."""

    bench: Bench  #: The job that is worked on.
    others: Sequence[Bench]  #: Jobs with other tests of its axis; nothing is written into them.
    _as_found: dict[str, tuple[MeasurementSet, tuple[Evaluated, ...]]] = field(default_factory=dict)

    @classmethod
    def of(cls, bench: Bench, others: Sequence[Bench]) -> ComparedTests:
        """Return the comparison; raise what is wrong with the other jobs, all at once."""
        problems: list[Problem] = []
        for each in others:
            try:
                _demand_same_axis(bench.load().job, each.load().job)
            except ZlmreportError as error:
                problems += error.problems
        if problems:
            raise InputError(problems)
        return cls(bench, others)

    def make_stamp(self) -> str:
        """Return the name of the state in which the files of the other jobs are now."""
        return " ".join(each.make_stamp() for each in self.others)

    def list_values(self, language: Language) -> dict[str, Any]:
        """Return what a page shows of the tests, in the order of their days; nothing of one test alone.

        A job that cannot be read is named with what is wrong, and the rest is compared.
        """
        own = self.bench.load()
        tests = list(self._list_tests(self.bench, own))
        here = tests[-1]
        problems = []
        for each in self.others:
            try:
                loaded = each.load()
                _demand_same_axis(own.job, loaded.job)
                tests += self._list_tests(each, loaded)
            except ZlmreportError as error:
                problems += [str(problem) for problem in error.problems]
        if all(each.day for each in tests):
            tests.sort(key=lambda each: each.day or dt.date.min)  # stable: those of one day stay as named
        shown = {
            "tests": [_list_test(each, here, language) for each in tests],
            "standards": list(_compare_standards(tests, here, language)),
            "models": list(_compare_models(tests, self.bench.registry.effects, language)),
        }
        return {
            "stamp": self.make_stamp(),
            "problems": problems,
            **(shown if len(tests) > 1 else {"tests": []}),
        }

    def _list_tests(self, bench: Bench, loaded: Loaded) -> Iterator[_Test]:
        job, name = loaded.job, same(bench.path.stem)
        if job.as_found is not None:
            measurements, evaluated = self._find_before(bench, loaded, job.as_found)
            yield _Test(_AS_FOUND.given(name=name), job.as_found, measurements, evaluated, None)
        yield _Test(name, job, loaded.measurements, bench.evaluate(loaded), bench.fit_whole(loaded))

    def _find_before(
        self, bench: Bench, loaded: Loaded, job: Job
    ) -> tuple[MeasurementSet, tuple[Evaluated, ...]]:
        """Return the readings before an adjustment, and what the standards say of them."""
        known = self._as_found.get(loaded.basis)
        if known is None:
            measurements = pipeline.read(job, bench.registry)
            known = measurements, pipeline.evaluate_all(job, measurements, bench.registry)
            self._as_found = {**dict(list(self._as_found.items())[-len(self.others) :]), loaded.basis: known}
        return known


def _demand_same_axis(own: Job, other: Job) -> None:
    """Refuse a test of another kind of axis, or of another error of it.

    What people call the axis may differ from test to test, and so may the symbol of its positioning.
    """
    if own.axis.kind is not other.axis.kind:
        raise InputError.at(
            Place(str(other.files[0].path)),
            f"the axis is {other.axis.kind.value}, that of {own.files[0].path} {own.axis.kind.value}: "
            "these are no tests of one axis",
        )
    if _name_error(own.axis) != _name_error(other.axis):
        theirs, ours = (job.axis.subject.in_language(Language.ENGLISH) for job in (other, own))
        raise InputError.at(
            Place(str(other.files[0].path)),
            f"it measured the {theirs[:1].lower()}{theirs[1:]}, and {own.files[0].path} the "
            f"{ours[:1].lower()}{ours[1:]}: these are no tests of one error",
        )


def _name_error(axis: Axis) -> tuple[str, str]:
    """Return what was measured, and of an error beside positioning its symbol."""
    return axis.measurand.identifier, "" if axis.measurand.is_position else axis.error


def _list_test(test: _Test, here: _Test, language: Language) -> dict[str, Any]:
    """Return a test: its name and day, its means over the axis, and how they differ from those here."""
    axis, means = here.job.axis, test.means
    at = test.measurements.target_positions
    curves = []
    for approach in test.measurements.approaches:
        mean = means[approach.index]
        there = np.isfinite(mean)
        difference = mean - _interpolate(here, approach.index, at)
        curves.append(
            {
                "direction": int(approach),
                "x": collect_drawn_values(axis.position_unit.from_si(at[there])),
                "y": collect_drawn_values(axis.deviation_unit.from_si(mean[there])),
                "difference": collect_drawn_values(axis.deviation_unit.from_si(difference[there])),
            }
        )
    return {
        "name": test.name.in_language(language),
        "day": None if test.day is None else test.day.isoformat(),
        "axis": test.job.axis.name,
        "isHere": test is here,
        "curves": curves,
    }


def _interpolate(test: _Test, direction: int, at: FloatArray) -> FloatArray:
    """Return the means of a test at other targets: straight between its own, and nothing beyond them."""
    mean = test.means[direction]
    there = np.isfinite(mean)
    if not there.any():
        return np.full(len(at), np.nan)
    own = test.measurements.target_positions[there]
    # Beyond the last target by less than a micrometre is rounding of the file, not another place.
    reach = 1e-6 if len(own) > 1 else 0.0
    inside = (at >= own[0] - reach) & (at <= own[-1] + reach)
    return np.where(inside, np.interp(at, own, mean[there]), np.nan)


def _compare_standards(tests: Sequence[_Test], here: _Test, language: Language) -> Iterator[dict[str, Any]]:
    """Yield the parameters of each standard of the job, test by test."""
    writer = Writer.of(here.measurements, language)
    for evaluated in here.evaluated:
        designation = evaluated.evaluation.designation
        others = [
            next((e.evaluation for e in each.evaluated if e.evaluation.designation == designation), None)
            for each in tests
        ]
        yield {
            "designation": designation,
            "unit": writer.deviation_unit.symbol,
            "rows": [
                {
                    "symbol": split_symbol(own.quantity.notation),
                    "name": own.quantity.name.in_language(language),
                    "limit": None
                    if own.limit is None
                    else own.quantity.unit_or(writer.deviation_unit).from_si(own.limit),
                    "cells": [
                        _make_cell(None if other is None else other.parameter(own.quantity.symbol), writer)
                        for other in others
                    ],
                }
                for own in evaluated.evaluation.parameters
            ],
        }


def _make_cell(parameter: EvaluatedParameter | None, writer: Writer) -> dict[str, Any] | None:
    """Return a parameter and its U as text and as numbers to be drawn, with a unit that is its own."""
    if parameter is None:
        return None
    value, uncertainty = write_with_uncertainty(parameter, writer)
    unit = parameter.quantity.unit_or(writer.deviation_unit)
    expanded = parameter.expanded_uncertainty
    number = unit.from_si(parameter.printed_value)
    return {
        "value": value,
        "uncertainty": "" if uncertainty == NOTHING else uncertainty,
        "unit": "" if unit == writer.deviation_unit else unit.symbol,
        "number": number if np.isfinite(number) else None,
        "expanded": None if expanded is None else unit.from_si(expanded),
    }


def _compare_models(
    tests: Sequence[_Test], effects: Sequence[Effect], language: Language
) -> Iterator[dict[str, Any]]:
    """Yield the parameters of all models, each with its amount in every test whose model has it."""
    of_tests = [
        {(each.effect, each.name): each for each in make_parameter_rows(test.model.fit, language)}
        if test.model is not None
        else {}
        for test in tests
    ]
    names = Naming.of(effects, language)
    for key in dict.fromkeys(chain.from_iterable(of_tests)):
        found = [rows.get(key) for rows in of_tests]
        first = next(each for each in found if each is not None)
        yield {
            "called": names.name_in(first.effect),
            "name": first.name,
            "symbol": split_symbol(first.notation),
            "description": first.description,
            "unit": first.unit,
            "cells": [
                None
                if each is None
                else {"value": each.value, "uncertainty": each.uncertainty, "unit": each.unit}
                for each in found
            ],
        }
