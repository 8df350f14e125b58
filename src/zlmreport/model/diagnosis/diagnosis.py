"""Runs a diagnosis: its verdict, where the model fails, what it lacks, what is next."""

from __future__ import annotations

from collections.abc import Container, Iterable, Sequence
from dataclasses import dataclass, replace
from enum import StrEnum

import numpy as np

from zlmreport.errors import count_in_words
from zlmreport.language import Words
from zlmreport.measurement.arrays import IntArray
from zlmreport.model.diagnosis.candidate import EffectCandidate, list_candidates
from zlmreport.model.diagnosis.contest import Told, tell_nobody
from zlmreport.model.diagnosis.contradicted import list_contradicted
from zlmreport.model.diagnosis.effects_to_try import NotTestable, list_effects_to_try
from zlmreport.model.diagnosis.error_numbers import (
    LARGEST_RATIO,
    ErrorNumbers,
    choose_scattering,
    compute_error_numbers,
)
from zlmreport.model.diagnosis.faults import DataFault, FaultKind, find_faults_of, find_pauses_between_runs
from zlmreport.model.diagnosis.finding import ContestFinding, NamedEffect, find, fit_with_member
from zlmreport.model.diagnosis.remainder import Remainder, find_irregular_remainder, make_remainder_of_run
from zlmreport.model.diagnosis.residual_tests import find_failures, report_flagged, run_residual_tests
from zlmreport.model.diagnosis.residuals import Failure, find_residuals_of
from zlmreport.model.diagnosis.single_run import find_single_run
from zlmreport.model.diagnosis.visibility import Visibility
from zlmreport.model.effects.axis_model import AxisModel
from zlmreport.model.effects.effect import Effect, is_of_another_axis
from zlmreport.model.effects.model_error import ModelError
from zlmreport.model.fitting.blunders import Outliers, find_outliers
from zlmreport.model.fitting.distributions import f_tail
from zlmreport.model.fitting.fit import Assumptions, Fit, fit
from zlmreport.model.fitting.observations import Observations, thin
from zlmreport.model.fitting.priors import PriorExpectation
from zlmreport.model.fitting.repeats import estimate_lasting_floor, find_repeats

#: Readings that are compared at most, and what each takes: 8 s and 0.45 GB at least were measured for 2,100.
_MOST_READINGS = 20_000
_MINUTES_EACH, _GIGABYTES_EACH = 8 / 60 / 2100, 0.45 / 2100
#: Degrees of freedom that a comparison needs to tell anything from noise.
_FEWEST_DEGREES = 6
#: Of the scatter of a single reading, what has no name must reach to be told of: less changes no result.
_LEAST_LEFT = 0.25
#: Chance of a larger χ²/ν below which it is no noise.
_IMPROBABLE = 1e-3


class DiagnosisVerdict(StrEnum):
    """What a diagnosis comes to.

    `ADEQUATE`: nothing is left that the noise does not explain. `MISSING`: at least one installed effect has
    evidence of its own, also where something unknown is left beside it. `UNEXPLAINED`: something is left, and
    no installed effect has.
    """

    ADEQUATE = "adequate"
    MISSING = "missing"
    UNEXPLAINED = "unexplained"


@dataclass(frozen=True, slots=True)
class AxisDiagnosis:
    """A model held against the readings of a test."""

    fit: Fit  #: The model as it is.
    error: ErrorNumbers  #: How far it is from the readings.
    verdict: DiagnosisVerdict  #: What the diagnosis comes to.
    p_value: float  #: Chance of such a contest where nothing is missing.
    tests: tuple[Failure, ...]  #: All tests of the residuals.
    failures: tuple[Failure, ...]  #: Those that they did not pass, and flagged readings.
    #: Effects that may be missing: those of the set in the order in which to add them, each followed by its
    #: equals. Where none has evidence of its own, those that explain most; none where the model is adequate.
    candidates: tuple[EffectCandidate, ...]
    together: tuple[Effect, ...]  #: The set: effects that belong in, first the one to add first.
    #: The error once the whole set is in the model; that of the model as it is without a set.
    error_after: ErrorNumbers
    makeshift: tuple[str, ...]  #: Effects of the model that others take the place of.
    remainder: Remainder | None  #: What is left beside the set without a name; None where it is noise.
    not_testable: tuple[NotTestable, ...]  #: Effects that the test cannot show, and what they need.
    not_excluded: tuple[str, ...]  #: Those among them that would look like the first candidate.
    visibility: tuple[Visibility, ...]  #: How much of each effect this plan can see.
    outliers: IntArray  #: (k,) integer: Readings set aside, by their places in the measurement set.
    remarks: tuple[Words, ...]  #: What was assumed, and what was left out.
    #: The noise floor with that which lasts over a few readings, m or rad; None without repeats.
    lasting_noise: float | None
    faults: tuple[DataFault, ...] = ()  #: What looks wrong in the data.
    contradicted: tuple[Words, ...] = ()  #: Of values that the job gives, what the readings say instead.

    @property
    def leaves_noise(self) -> bool:
        """Whether nothing but noise is left once the whole set is in the model."""
        return self.remainder is None and _is_noise(self.error_after, self.lasting_noise)

    @property
    def further(self) -> tuple[str, ...]:
        """Effects that are missing beside the first of the set."""
        return tuple(each.identifier for each in self.together[1:])


def diagnose(  # noqa: PLR0913 - what is known, what may be, and who is told
    model: AxisModel,
    observed: Observations,
    effects: Sequence[Effect],
    assumptions: Assumptions | None = None,
    expected: PriorExpectation | None = None,
    *,
    may_go: frozenset[str] = frozenset(),
    told: Told = tell_nobody,
) -> AxisDiagnosis:
    """Hold a model against the readings of a test, and try every effect that might be missing.

    `may_go`: Effects of the model that were added on the way to it, and go out where others take their place.

    Raises `ModelError` if the model makes no sense on these readings, or they are too few to tell anything.
    """
    observed = thin(observed)
    count = len(observed.deviation)
    if count > _MOST_READINGS:
        sentence = (
            f"the model would be compared with {count} readings, which takes at least "
            f"{_MINUTES_EACH * count:.0f} min and {_GIGABYTES_EACH * count:.0f} GB; diagnose fewer runs: at "
            f"most {_MOST_READINGS} readings"
        )
        raise ModelError([sentence])
    asked = _Asked(model, observed, effects, assumptions, expected, may_go)
    aside = find_outliers(observed.design, observed.deviation)
    held = _hold_data(asked, aside, lambda share: told(0.5 * share))
    judged = held.find_outliers_of_all()
    if not np.array_equal(judged.readings, aside.readings) and not held.is_quiet:
        # What the leading model explains is no blunder, and what it leaves far off is one.
        aside, held = judged, _hold_data(asked, judged, lambda share: told(0.5 + 0.5 * share))
    told(1.0)
    return _tell_diagnosis(asked, aside, held)


@dataclass(frozen=True, slots=True)
class _Asked:
    """What a diagnosis is asked."""

    model: AxisModel
    observed: Observations
    effects: Sequence[Effect]
    assumptions: Assumptions | None
    expected: PriorExpectation | None
    may_go: frozenset[str]


@dataclass(frozen=True, slots=True)
class _Held:
    """A model held against the readings that were not set aside."""

    observed: Observations  #: All readings.
    fit: Fit
    error: ErrorNumbers
    finding: ContestFinding
    complete: Fit  #: With the whole set that was found.
    error_after: ErrorNumbers  #: Of the complete model.
    left: Remainder | None

    @property
    def is_quiet(self) -> bool:
        """Whether nothing was found."""
        return self.complete is self.fit and self.left is None

    def find_outliers_of_all(self) -> Outliers:
        """Return the readings that stand off from what the complete model says of all of them."""
        design = self.observed.design
        return find_outliers(design, self.observed.deviation - self.complete.compute_value_at(design))


def _hold_data(asked: _Asked, aside: Outliers, told: Told) -> _Held:
    kept = asked.observed.without(aside.readings)
    fitted = fit(asked.model, kept.design, kept.deviation, asked.assumptions)
    if fitted.degrees < _FEWEST_DEGREES:
        readings = len(kept.deviation)
        sentence = (
            f"the test has {count_in_words(readings, 'reading')} and the model "
            f"{count_in_words(readings - fitted.degrees, 'parameter')}; "
            f"a diagnosis needs at least {_FEWEST_DEGREES} readings more than parameters"
        )
        raise ModelError([sentence])
    error = compute_error_numbers(fitted)
    run = find_single_run(fitted.design, fitted.residual, error.noise_rms or 0.0)
    is_left = run is not None or not _is_perhaps_noise(error, fitted)
    finding = find(fitted, asked.effects, asked.expected, may_go=asked.may_go, is_left=is_left, told=told)
    if finding.makeshift and not finding.named:
        # What only a curve without a name would replace stays: asked is what is left beside it.
        finding = find(fitted, asked.effects, asked.expected, is_left=is_left)
    complete, named = _complete(fitted, finding.named, finding.makeshift)
    finding = replace(finding, named=named)
    after = error if complete is fitted else compute_error_numbers(complete)
    if finding.named and finding.remainder is None and not _is_perhaps_noise(after, complete):
        # A hundredth of a large cause counts as noise: what that hid is seen once it is in the model.
        hidden = find(complete, asked.effects, asked.expected, is_left=True)
        complete, further = _complete(complete, hidden.named, ())
        remainder = _forget_forms_instead(hidden.remainder, {each.identifier for each in named})
        finding = replace(finding, named=(*named, *further), remainder=remainder)
        after = compute_error_numbers(complete)
    # At the sizes that are found: at those that leave least, geometry that it is not hides in any wave.
    if finding.named and finding.remainder and not finding.makeshift and complete.rms >= fitted.rms:
        step = _choose_next(fitted, finding.named)
        if step is None or step[1].rms >= fitted.rms:
            # Beside what has no name they are so little that nobody could add one and see the error fall.
            complete, after = fitted, error
            finding = _forget_names(finding, find(fitted, (), asked.expected, is_left=True))
    left = finding.remainder
    if left is not None and left.rms < _LEAST_LEFT * (error.noise_rms or 0.0):
        left = None
    if left is None and not finding.named and run:
        left = make_remainder_of_run(fitted, run)
    elif left is None and ((complete is fitted and finding.named) or not _is_perhaps_noise(after, complete)):
        # What no curve follows is there all the same, and so is a set that the readings do not determine.
        left = find_irregular_remainder(complete, after.noise_rms or 0.0, fitted)
    return _Held(asked.observed, fitted, error, finding, complete, after, left)


def _tell_diagnosis(asked: _Asked, aside: Outliers, held: _Held) -> AxisDiagnosis:
    """Return what a diagnosis says of what was found; faults of the data come first."""
    observed, fitted, finding = asked.observed, held.fit, held.finding
    complete, candidates = held.complete, tuple(list_candidates(finding, held.error, held.complete))
    # What the readings do not determine beside the job's model is no candidate.
    known = {each.identifier for each in candidates}
    leading = (each.leading.member.effect for each in finding.named)
    together = tuple(each for each in leading if each.identifier in known)
    rivals = [complete] if together else []
    faults = find_faults_of(observed, fitted, rivals, asked.effects, changes=finding.changes)
    left = held.left
    contradicted = list_contradicted(complete, together) if together or left is not None else ()
    if contradicted or any(each.comes_first for each in faults):
        # No cause is sought before data and given values are right: what has no name may be the fault.
        together, candidates, complete, left = (), (), fitted, None
    tests = run_residual_tests(find_residuals_of(fitted, finding.noise))
    stand_off = report_flagged(observed.design, aside)
    not_testable = list_effects_to_try(asked.model, fitted.design, asked.effects).not_testable
    return AxisDiagnosis(
        fit=fitted,
        error=held.error,
        verdict=DiagnosisVerdict.UNEXPLAINED if contradicted else _decide_verdict(left, together, faults),
        p_value=finding.p_value.value,
        tests=tests,
        failures=find_failures(tests) + ((stand_off,) if stand_off else ()),
        candidates=candidates,
        together=together,
        error_after=held.error if complete is fitted else held.error_after,
        makeshift=finding.makeshift if together else (),
        remainder=left,
        not_testable=not_testable,
        not_excluded=_list_not_excluded(candidates, not_testable),
        visibility=finding.visible,
        outliers=_select_of_the_set(observed.reading[aside.readings]),
        remarks=(
            *observed.remarks,
            *find_pauses_between_runs(observed.design),
        ),
        lasting_noise=estimate_lasting_floor(fitted.design, choose_scattering(fitted)),
        faults=faults,
        contradicted=contradicted,
    )


def _select_of_the_set(readings: IntArray) -> IntArray:
    """Return the places of readings without those of other sessions."""
    return readings[readings >= 0]


def _decide_verdict(
    left: Remainder | None, together: Sequence[Effect], faults: Iterable[DataFault]
) -> DiagnosisVerdict:
    if together:
        return DiagnosisVerdict.MISSING
    if left is not None or any(each.comes_first or each.kind is FaultKind.WRONG_UNIT for each in faults):
        return DiagnosisVerdict.UNEXPLAINED
    return DiagnosisVerdict.ADEQUATE


def _is_perhaps_noise(error: ErrorNumbers, fitted: Fit) -> bool:
    """Return whether the repeats scatter so much that the error may be their scatter alone."""
    if _is_noise(error, estimate_lasting_floor(fitted.design, choose_scattering(fitted))):
        return True
    ratio, within = error.chi2_per_dof, find_repeats(fitted.design, fitted.residual)
    return ratio is None or f_tail(ratio, fitted.degrees, within.degrees) > _IMPROBABLE


def _is_noise(error: ErrorNumbers, lasting: float | None) -> bool:
    """Return whether the error is no larger than the noise, also such as lasts over a few readings."""
    if error.chi2_per_dof is None or error.chi2_per_dof <= LARGEST_RATIO:
        return True
    return lasting is not None and error.rms**2 <= LARGEST_RATIO * lasting**2


def _forget_forms_instead(remainder: Remainder | None, named: Container[str]) -> Remainder | None:
    """Return what is left without other forms in its place of effects that are named already."""
    instead = remainder.instead if remainder else None
    if remainder is None or instead is None or not all(each.identifier in named for each in instead.effects):
        return remainder
    return replace(remainder, instead=None)


def _forget_names(finding: ContestFinding, nameless: ContestFinding) -> ContestFinding:
    """Return a finding in which the named effects are only some that explain most.

    `nameless`: The same without any effect.
    """
    others = tuple(each.leading for each in finding.named)
    return replace(finding, named=(), others=others, remainder=nameless.remainder)


def _complete(
    fitted: Fit, named: Iterable[NamedEffect], makeshift: Iterable[str]
) -> tuple[Fit, tuple[NamedEffect, ...]]:
    """Return the model with a whole set in it, as much of it as the readings determine, and in which order.

    Before lost motion is in the model, runs seem displaced, and a drift fitted beside that leaves more than
    there was: what lowers the error comes first.
    """
    found, waiting, order = fitted, list(named), list[NamedEffect]()
    going = [each for each in makeshift if each in fitted.model.identifiers]
    while True:
        while (step := _choose_next(found, waiting)) is not None:
            found = step[1]
            order.append(step[0])
            waiting.remove(step[0])
        if not going:
            return found, (*order, *waiting)
        # What is much like a makeshift can only be fitted when that is out.
        found = fit(found.model.without(*going), found.design, found.deviation, found.assumptions)
        going = []


def _choose_next(fitted: Fit, waiting: Iterable[NamedEffect]) -> tuple[NamedEffect, Fit] | None:
    """Return the first effect that lowers the error, or that can be fitted, and the fit with it."""
    found: tuple[NamedEffect, Fit] | None = None
    for each in waiting:
        try:
            after = fit_with_member(fitted, each.leading.member)
        except ModelError:
            continue
        if after.rms < fitted.rms:
            return each, after
        found = found or (each, after)
    return found


def _list_not_excluded(
    candidates: Sequence[EffectCandidate], not_testable: Sequence[NotTestable]
) -> tuple[str, ...]:
    """Return effects that could not be tried and would look like the first candidate."""
    if not candidates:
        return ()
    alike = {confusion.effect for confusion in candidates[0].effect.confusions}
    return tuple(
        each.effect for each in not_testable if each.effect in alike and not is_of_another_axis(each.reason)
    )
