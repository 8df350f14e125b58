"""What a diagnosis says: how well the model describes the readings, where it fails, and what it lacks."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from enum import StrEnum

import numpy as np

from zlmreport.language import Words
from zlmreport.model import wording
from zlmreport.model.axis_model import AxisModel, ModelError
from zlmreport.model.candidates import NotTestable, effects_to_try
from zlmreport.model.comparison import Told, untold
from zlmreport.model.effect import Effect, is_of_another_axis
from zlmreport.model.estimate import Estimate
from zlmreport.model.evidence import Ranked
from zlmreport.model.faults import Fault, lagging_sensors, recorded_faults, run_faults
from zlmreport.model.fit import Assumptions, Fit, cross_validated_rms, fit
from zlmreport.model.observations import Observations, thinned
from zlmreport.model.priors import Expected
from zlmreport.model.repeats import noise_floor, outliers
from zlmreport.model.residual_tests import failures, flagged, residual_tests
from zlmreport.model.residuals import Failure, residuals_of
from zlmreport.model.sessions import of_the_job
from zlmreport.model.steps import Step, add, discriminate_by, equals_of, is_impossible, named_effects, steps
from zlmreport.model.visibility import Visibility
from zlmreport.quantities.arrays import IntArray

#: Candidates that are shown, the leaders in any case.
_SHOWN = 4
#: Share of the misfit from which on an effect explains it, and does not only contribute.
EXPLAINS = 0.75
#: Readings that are compared at most, and what each takes: 20 s and 0.45 GB were measured for 2,100.
_MOST_READINGS = 20_000
_MINUTES_EACH, _GIGABYTES_EACH = 20 / 60 / 2100, 0.45 / 2100
#: Degrees of freedom that a comparison needs to tell anything from noise.
_FEWEST_DEGREES = 6

_EXPLAINS = Words(
    en="explains {share} % of what the noise leaves open",
    de="erklärt {share} % dessen, was das Rauschen offen lässt",
)
_CONTRIBUTES = Words(
    en="contributes {share} % of what the noise leaves open; {left} remain",
    de="trägt {share} % zu dem bei, was das Rauschen offen lässt; es bleiben {left}",
)
_LOOKS_WRONG = Words(
    en="The data look wrong: {statement}. Remedy: {remedy}.",
    de="Die Daten sehen falsch aus: {statement}. Abhilfe: {remedy}.",
)
_IMPOSSIBLE = Words(
    en="{explains}, but only with a value that is physically impossible",
    de="{explains}, aber nur mit einem physikalisch unmöglichen Wert",
)
_NO_FLOOR = Words(
    en="takes the error from {before} to {after}", de="senkt die Abweichung von {before} auf {after}"
)


class Verdict(StrEnum):
    """What a diagnosis comes to.

    `ADEQUATE`: nothing is left that the noise does not explain. `MISSING`: the first candidate, or one of its
    equals, explains the rest, alone or with effects that are found after it. `UNEXPLAINED`: something is left
    that no installed effect explains.
    """

    ADEQUATE = "adequate"
    MISSING = "missing"
    UNEXPLAINED = "unexplained"


@dataclass(frozen=True, slots=True)
class ErrorNumbers:
    """How far readings and model are apart."""

    rms: float  #: √(RSS/(N − q)), m or rad.
    noise_rms: float | None  #: The noise floor σ_f, m or rad; None without repeats.
    chi2_per_dof: float | None  #: RSS/((N − q)·σ_f²); None without a noise floor.
    cross_validated_rms: float | None  #: Of runs predicted from the others, m or rad; None with a single run.


@dataclass(frozen=True, slots=True)
class Candidate:
    """An effect that the model may lack."""

    effect: Effect  #: In the form that fits best.
    p_value: float  #: Chance of so high a likelihood ratio without the effect, its own search allowed for.
    p_value_is_extrapolated: bool  #: Whether it lies beyond what was simulated.
    probability: float  #: Among all effects, nameless shapes and no effect.
    evidence: float  #: 2·ln of the Bayes factor against the model as it is.
    error: ErrorNumbers  #: After adding it.
    estimates: tuple[Estimate, ...]  #: Its own parameters after adding it.
    #: Of what the noise leaves unexplained, explained by it: 0 to 1; None without a noise floor.
    share: float | None
    explains: Words  #: The same in words.
    equals: tuple[str, ...]  #: Effects that the readings cannot tell from it.
    #: The measurement that would tell them; None where there is nothing to tell apart.
    discriminate_by: Words | None
    is_plausible: bool = True  #: Whether its parameters can be what they would have to be.

    @property
    def identifier(self) -> str:
        """As jobs name it."""
        return self.effect.identifier


@dataclass(frozen=True, slots=True)
class Unnamed:
    """What is left without a name."""

    shape: Words  #: Along what it changes.
    where: Words  #: Where its largest part lies.
    size: float  #: Its root mean square value, m or rad.


@dataclass(frozen=True, slots=True)
class Diagnosis:
    """A model held against the readings of a test."""

    fit: Fit  #: The model as it is.
    error: ErrorNumbers  #: How far it is from the readings.
    verdict: Verdict  #: What the diagnosis comes to.
    p_value: float  #: Chance of such a comparison where nothing is missing.
    tests: tuple[Failure, ...]  #: All tests of the residuals.
    failures: tuple[Failure, ...]  #: Those that they did not pass, and flagged readings.
    #: Effects that may be missing, best first, what is impossible last; none where the model is adequate.
    candidates: tuple[Candidate, ...]
    implausible: tuple[Candidate, ...]  #: Where only impossible ones are left, these, and no candidates.
    #: Effects that are missing beside the first candidate, in the order in which they are found after it.
    further: tuple[str, ...]
    unnamed: Unnamed | None  #: What is left without a name; None unless the verdict is `UNEXPLAINED`.
    not_testable: tuple[NotTestable, ...]  #: Effects that the test cannot show, and what they need.
    not_excluded: tuple[str, ...]  #: Those among them that would look like the first candidate.
    visibility: tuple[Visibility, ...]  #: How much of each effect this plan can see.
    outliers: IntArray  #: (k,) integer: Readings set aside, by their places in the measurement set.
    remarks: tuple[Words, ...]  #: What was assumed, and what was left out.
    faults: tuple[Fault, ...] = ()  #: What looks wrong in the data.


def diagnose(  # noqa: PLR0913 - what is known, what may be, and who is told
    model: AxisModel,
    observed: Observations,
    effects: Sequence[Effect],
    assumptions: Assumptions | None = None,
    expected: Expected | None = None,
    *,
    told: Told = untold,
) -> Diagnosis:
    """Hold a model against the readings of a test, and try every effect that might be missing.

    Raises `ModelError` if the model makes no sense on these readings, or they are too few to tell anything.
    """
    observed = thinned(observed)
    count = len(observed.deviation)
    if count > _MOST_READINGS:
        sentence = (
            f"the model would be compared with {count} readings, which takes at least "
            f"{_MINUTES_EACH * count:.0f} min and {_GIGABYTES_EACH * count:.0f} GB; diagnose fewer runs: at "
            f"most {_MOST_READINGS} readings"
        )
        raise ModelError([sentence])
    aside = outliers(observed.design, observed.deviation)
    kept = observed.without(aside.readings)
    fitted = fit(model, kept.design, kept.deviation, assumptions)
    if fitted.degrees < _FEWEST_DEGREES:
        readings = len(kept.deviation)
        sentence = (
            f"the test has {readings} readings and the model {readings - fitted.degrees} parameters; "
            f"a diagnosis needs at least {_FEWEST_DEGREES} readings more than parameters"
        )
        raise ModelError([sentence])
    found = steps(fitted, effects, expected, told)
    first = found[0]
    names = named_effects(found)
    verdict = _verdict(first, names)
    error = error_numbers(fitted)
    tests = residual_tests(residuals_of(fitted, first.noise))
    stand_off = flagged(observed.design, aside)
    shown = () if verdict is Verdict.ADEQUATE else _candidates(first, error)
    faults = _faults(observed, first, effects)
    if verdict is Verdict.MISSING and any(each.explains for each in faults):
        verdict, names = Verdict.UNEXPLAINED, ()
    if any(each.explains for each in faults):
        shown = ()
    candidates = shown if any(each.is_plausible for each in shown) else ()
    not_testable = effects_to_try(model, kept.design, effects).not_testable
    return Diagnosis(
        fit=fitted,
        error=error,
        verdict=verdict,
        p_value=first.p_value.value,
        tests=tests,
        failures=failures(tests) + ((stand_off,) if stand_off else ()),
        candidates=candidates,
        implausible=() if candidates else shown,
        further=names[1:],
        unnamed=_unnamed(found) if verdict is Verdict.UNEXPLAINED else None,
        not_testable=not_testable,
        not_excluded=_not_excluded(candidates, not_testable),
        visibility=first.visible,
        outliers=_of_the_set(observed.reading[aside.readings]),
        remarks=(
            *observed.remarks,
            *(_LOOKS_WRONG.given(statement=each.statement, remedy=each.remedy) for each in faults),
        ),
        faults=faults,
    )


def _of_the_set(readings: IntArray) -> IntArray:
    """Return the places of readings without those of other sessions."""
    return readings[readings >= 0]


def _faults(observed: Observations, first: Step, effects: Sequence[Effect]) -> tuple[Fault, ...]:
    """Return what looks wrong in the data; a run that two signs betray is named once."""
    own = of_the_job(observed)
    recorded = recorded_faults(own.design, own.deviation)
    foremost = (*((first.best,) if first.best else ()), *first.ranking.impossible[:1])
    rivals = [add(first.fit, each) for each in foremost] if first.something_is_missing else []
    by_runs = run_faults(first.fit, rivals, first.ranking.shape_evidence)
    lagging = lagging_sensors(first.fit, rivals, effects) if first.something_is_missing else ()
    known = {(each.kind, each.run): each for each in recorded}
    found = [
        replace(known.pop((each.kind, each.run)), explains=each.explains)
        if (each.kind, each.run) in known
        else each
        for each in (*by_runs, *lagging)
    ]
    return (*found, *known.values())


def _verdict(first: Step, names: Sequence[str]) -> Verdict:
    if not first.something_is_missing:
        return Verdict.ADEQUATE
    return Verdict.MISSING if names else Verdict.UNEXPLAINED


def error_numbers(fitted: Fit) -> ErrorNumbers:
    """Return how far a fitted model is from the readings."""
    floor = noise_floor(fitted.design, fitted.deviation)
    return ErrorNumbers(
        fitted.rms,
        floor,
        (fitted.rms / floor) ** 2 if floor else None,
        cross_validated_rms(fitted.model, fitted.design, fitted.deviation, fitted.solution.thetas),
    )


def _candidates(step: Step, before: ErrorNumbers) -> tuple[Candidate, ...]:
    """Return the leaders and those next to them that are better than nothing, each added on trial.

    What is physically impossible comes last.
    """
    leaders = step.ranking.leaders
    shown = [each for each in step.ranking.effects if each.evidence > 0]
    listed = (*shown[: max(_SHOWN, len(leaders))], *step.ranking.impossible[:_SHOWN])
    found = [_candidate(step, each, before) for each in listed]
    return tuple(sorted(found, key=lambda each: not each.is_plausible))


def _candidate(step: Step, ranked: Ranked, before: ErrorNumbers) -> Candidate:
    after = add(step.fit, ranked)
    error = error_numbers(after)
    share = _share(step.fit, after, before.noise_rms)
    equals = equals_of(ranked, step.ranking)
    is_plausible = not is_impossible(after, ranked.identifier)
    explains = _explains(step.fit, after, share)
    return Candidate(
        effect=ranked.effect,
        p_value=ranked.p_value.value,
        p_value_is_extrapolated=ranked.p_value.is_extrapolated,
        probability=ranked.probability,
        evidence=ranked.evidence,
        error=error,
        estimates=tuple(each for each in after.estimates if each.effect == ranked.identifier),
        share=share,
        explains=explains if is_plausible else _IMPOSSIBLE.given(explains=explains),
        equals=tuple(each.identifier for each in equals),
        discriminate_by=discriminate_by(ranked, equals),
        is_plausible=is_plausible,
    )


def _share(before: Fit, after: Fit, floor: float | None) -> float | None:
    """Return the share of the misfit beyond the noise floor that an effect explains."""
    if floor is None:
        return None
    open_before = float(np.sum(before.residual**2)) - before.degrees * floor**2
    open_after = max(0.0, float(np.sum(after.residual**2)) - after.degrees * floor**2)
    return max(0.0, 1.0 - open_after / open_before) if open_before > 0 else 1.0


def _explains(before: Fit, after: Fit, share: float | None) -> Words:
    axis = before.design.axis
    if share is None:
        return _NO_FLOOR.given(
            before=wording.deviation(axis, before.rms), after=wording.deviation(axis, after.rms)
        )
    percent = wording.number(100 * share, 0)
    if share >= EXPLAINS:
        return _EXPLAINS.given(share=percent)
    return _CONTRIBUTES.given(share=percent, left=wording.deviation(axis, after.rms))


def _not_excluded(candidates: Sequence[Candidate], not_testable: Sequence[NotTestable]) -> tuple[str, ...]:
    """Return effects that could not be tried and would look like the first candidate."""
    if not candidates:
        return ()
    alike = {confusion.effect for confusion in candidates[0].effect.confusions}
    return tuple(
        each.effect for each in not_testable if each.effect in alike and not is_of_another_axis(each.reason)
    )


def _unnamed(found: Sequence[Step]) -> Unnamed | None:
    """Return what is left without a name: the leading shape of the first step that no name surpasses."""
    step = next(
        (
            each
            for each in found
            if each.ranking.shape is not None and each.ranking.shape_evidence > each.ranking.most
        ),
        found[0],
    )
    shape = step.ranking.shape
    if shape is None:
        return None
    residual = step.fit.residual
    design = step.fit.design
    means = np.array([np.mean(residual[design.target == target]) for target in np.unique(design.target)])
    largest = int(np.unique(design.target)[int(np.argmax(np.abs(means)))])
    reading = int(np.argmax(design.target == largest))
    return Unnamed(
        shape,
        wording.position(design.axis, float(design.position[reading])),
        float(np.sqrt(np.mean(residual**2))),
    )
