"""Which effect is missing from the model of a machine: found one by one, each with evidence of its own."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import pairwise
from typing import TypeAlias

import numpy as np

from zlmreport.language import Words
from zlmreport.machines.choosing import add_effect, add_form, measure_sharpness, refine_form
from zlmreport.machines.contest import (
    SIZES,
    CircleContest,
    Contender,
    Held,
    Nameless,
    contest,
    make_nameless_curves,
)
from zlmreport.machines.forms import CircleForm, list_forms_of, make_whole_form, split_parts_of
from zlmreport.machines.noise import NoiseModel, find_anew
from zlmreport.machines.study import CircleStudy, EstimatedTerm
from zlmreport.measurement.arrays import FloatArray
from zlmreport.model.diagnosis.diagnosis import DiagnosisVerdict
from zlmreport.model.diagnosis.null_distribution import LEVEL, PValue
from zlmreport.model.effects.circle_effect import CircleEffect, Parity

#: Evidence that a cause after the first must bring more than that, that is worth a mention, and by which a
#: name must surpass a shape without one.
FURTHER, MENTION, NAMED = 8.0, 2.0, 2.0
#: Part of an effect's curve that another must leave for the plan to tell them apart.
_ALIKE = 0.02
#: The same, where the readings favour neither of them.
_SIMILAR = 0.15
#: Effects behind the best of which a word is worth it.
_SERIOUS = 0.01
_MOST_EFFECTS = 6


@dataclass(frozen=True, slots=True)
class CircleCandidate:
    """An effect that might be missing."""

    effect: CircleEffect
    form: CircleForm
    evidence: float
    probability: float
    p_value: PValue
    estimates: tuple[EstimatedTerm, ...]
    rms_after: float  #: m.
    is_plausible: bool
    indistinguishable_from: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class CircleRemainder:
    """What is left beside all that is named."""

    rms: float  #: m.
    shape: Words


@dataclass(frozen=True, slots=True)
class EffectStep:
    """An effect that came into the model."""

    effect: str
    before: float  #: RMS of what the model leaves, m.
    after: float
    noise: float


@dataclass(frozen=True, slots=True)
class MachineDiagnosis:
    """The outcome."""

    study: CircleStudy  #: Of the model as it is.
    complete: CircleStudy  #: With all that was found.
    verdict: DiagnosisVerdict
    p_value: PValue
    candidates: tuple[CircleCandidate, ...]
    found: tuple[str, ...]  #: What belongs in, first the one to add first; nothing that has an equal.
    steps: tuple[EffectStep, ...]
    remainder: CircleRemainder | None
    not_testable: tuple[str, ...]
    catalogue: tuple[CircleEffect, ...]  #: All effects that were thought of.
    is_tied: bool  #: Whether the next effect has an equal that this plan cannot tell from it.
    #: Root mean square of what scatters beside the model that describes the circles best, m. Where effects
    #: are tied, that has one of them, though `complete` has none: what they do is no noise.
    noise: float
    noise_of_readings: float  #: The same of single readings, before they are thinned.


def find_verdict_after_build(diagnosis: MachineDiagnosis) -> DiagnosisVerdict:
    """Return the verdict on the model as built: effects that cannot be told apart are still missing."""
    if diagnosis.remainder:
        return DiagnosisVerdict.UNEXPLAINED
    return DiagnosisVerdict.MISSING if diagnosis.is_tied else DiagnosisVerdict.ADEQUATE


@dataclass(frozen=True, slots=True)
class _Stage:
    """The model with some effects more, and what the contest says of it."""

    study: CircleStudy
    outcome: CircleContest
    shown: tuple[CircleCandidate, ...]
    hidden: tuple[str, ...]
    gathered: float  #: Evidence of all effects that came in, less what each further one must bring.
    #: Evidence of the best curve without a name, less what it must bring as a cause more; 0 where nothing is
    #: left.
    curve: float
    beside: CircleStudy  #: The model with that curve beside it.

    @property
    def is_something_left(self) -> bool:
        """Whether something is left that chance does not explain."""
        return _is_left(self.outcome)

    @property
    def leader(self) -> CircleCandidate | None:
        """The first that is possible."""
        return next((each for each in self.shown if each.is_plausible), None)

    @property
    def worth(self) -> float:
        """Evidence of the model so far, with a curve without a name beside it where something is left."""
        return self.gathered + self.curve


def diagnose(study: CircleStudy, catalogue: Sequence[CircleEffect]) -> MachineDiagnosis:
    """Say whether something is missing from a study's model, and what.

    The best effect comes in, then the next beside it, as long as each has evidence of its own. Of all these
    models, and of a curve without a name in the place of what is left, the one with the most evidence is
    taken: so two effects are found that together look like neither, and a cause that is in no catalogue gets
    no name.
    """
    stages = _build_stages(study, catalogue)
    chosen = max(
        range(len(stages)), key=lambda index: (round(stages[index].worth - NAMED * (index > 0), 9), -index)
    )
    found: list[str] = []
    steps: list[EffectStep] = []
    is_tied = False
    for before, after in pairwise(stages[: chosen + 1]):
        leader = before.leader
        if leader is None or leader.indistinguishable_from:
            is_tied = True
            break
        found.append(leader.effect.identifier)
        steps.append(
            EffectStep(
                leader.effect.identifier,
                before.study.rms,
                after.study.rms,
                after.study.noise.rms,
            )
        )
    first, last = stages[0], stages[len(found)]
    is_left = last.is_something_left and not is_tied
    remainder = _find_left(last.study, last.outcome) if is_left else None
    complete = last.beside if is_left else last.study
    verdict = DiagnosisVerdict.UNEXPLAINED if remainder else DiagnosisVerdict.ADEQUATE
    verdict = DiagnosisVerdict.MISSING if found or is_tied else verdict
    return MachineDiagnosis(
        study if found else complete, complete, verdict, first.outcome.p_value, first.shown,
        tuple(found), tuple(steps), remainder, first.hidden, tuple(catalogue), is_tied,
        stages[chosen].study.noise.rms, stages[chosen].study.noise_of_readings,
    )  # fmt: skip


#: An effect with the forms of it that a design can show.
_Forms: TypeAlias = tuple[CircleEffect, tuple[CircleForm, ...]]


def _build_stages(study: CircleStudy, catalogue: Sequence[CircleEffect]) -> list[_Stage]:
    """Return the models that come about when the best effect comes in again and again."""
    stages: list[_Stage] = []
    current, gathered = study, 0.0
    curves = make_nameless_curves(study.design)
    forms_of = [
        (effect, tuple(form for form in list_forms_of(effect, study.design) if form.terms))
        for effect in catalogue
    ]
    while True:
        outcome, hidden = _hold_effects(current, forms_of, curves, len(stages))
        price = _price_curve(current, outcome, curves) if stages else 0.0
        curve, beside = _weigh_curve(current, outcome, curves)
        shown = _list_candidates(current, outcome)
        stage = _Stage(current, outcome, shown, tuple(hidden), gathered, max(curve - price, 0.0), beside)
        stages.append(stage)
        leader = stage.leader
        needed = FURTHER + NAMED if len(stages) > 1 else NAMED
        if not stage.is_something_left or leader is None or leader.evidence < needed:
            return stages
        if len(stages) > _MOST_EFFECTS:
            return stages
        gathered += leader.evidence - (FURTHER if len(stages) > 1 else 0.0)
        kept = current.noise.shapes
        current = add_effect(current, leader.effect, leader.form)
        gathered += find_anew(current.model, current.deviation, kept)


def _is_left(outcome: CircleContest) -> bool:
    return outcome.p_value.value <= LEVEL


def _weigh_curve(
    study: CircleStudy, outcome: CircleContest, curves: Sequence[Nameless]
) -> tuple[float, CircleStudy]:
    """Return the evidence of the best curve without a name, its noise found anew, and the study beside it.

    Nothing, and the study as it is, where nothing is left.
    """
    if outcome.shape_evidence <= 0 or not _is_left(outcome):
        return 0.0, study
    shapes, deviation = study.noise.shapes, study.deviation
    tried = [size * each.columns for each in curves if each.shape == outcome.shape for size in SIZES]
    models = [NoiseModel(study.shared, study.base, np.column_stack([study.known, each])) for each in tried]
    logs = [float(each.compute_log_likelihoods(shapes[:1], deviation)[0, 0]) for each in models]
    likeliest = int(np.argmax(logs))
    evidence = outcome.shape_evidence + find_anew(models[likeliest], deviation, shapes)
    return evidence, study.with_curve(tried[likeliest])


def _price_curve(study: CircleStudy, outcome: CircleContest, curves: Sequence[Nameless]) -> float:
    """Return what a curve without a name must bring beside effects that came in.

    A catalogue knows the shape of what follows a reversal only roughly: what is left of it there is no cause
    more.
    """
    is_locked = any(each.is_locked for each in curves if each.shape == outcome.shape)
    is_by_travel = any(each.effect.law.parity is Parity.BY_TRAVEL for each in study.effects)
    return 0.0 if is_locked and is_by_travel else FURTHER


def _hold_effects(
    study: CircleStudy, forms_of: Sequence[_Forms], curves: Sequence[Nameless], seed: int
) -> tuple[CircleContest, list[str]]:
    """Hold all effects that are not in the model against what it leaves."""
    basis, _ = np.linalg.qr(study.base)
    tried, unseen = [], []
    for effect, forms in forms_of:
        if effect.identifier in study.names:
            continue
        seen = tuple(form for form in forms if _is_seen(form.columns, basis))
        if seen:
            tried.append((effect, seen))
        else:
            unseen.append(effect.identifier)

    def refine(effect: CircleEffect, form: CircleForm) -> tuple[CircleForm, float]:
        refined = refine_form(study, effect, form)
        return refined, measure_sharpness(study, effect, refined)

    return contest(Held(study.model, study.noise, study.deviation), tried, curves, refine, seed), unseen


def _is_seen(columns: FloatArray, basis: FloatArray) -> bool:
    """Return whether the base model, an orthonormal basis of it, leaves anything of a form."""
    left = columns - basis @ (basis.T @ columns)
    return bool(np.sum(left**2) > 1e-6 * np.sum(columns**2))


def _list_candidates(study: CircleStudy, outcome: CircleContest) -> tuple[CircleCandidate, ...]:
    """Return the effects that are worth a word, best first, with their estimates and equals."""
    most = outcome.contenders[0].evidence if outcome.contenders else 0.0
    worth = [
        (each, probability)
        for each, probability in zip(outcome.contenders, outcome.probabilities, strict=True)
        if each.evidence > max(most - 60.0, 0.0) or probability > _SERIOUS
    ][:8]
    found = _leave_out_impossible([_make_candidate(study, *each) for each in worth])
    found.sort(key=lambda each: (not each.is_plausible, -each.evidence))
    curves = [_compute_curve(study, each) for each in found]
    named = [
        _add_equals(study, each, curve, found, curves) for each, curve in zip(found, curves, strict=True)
    ]
    if named and named[0].is_plausible:
        # Of effects that the plan cannot tell apart, the one leads that needs the least unusual values.
        equals = named[0].indistinguishable_from
        tied = [
            each
            for each in named
            if each is named[0]
            or (each.effect.identifier in equals and each.evidence > named[0].evidence - MENTION)
        ]
        plainest = min(tied, key=_measure_strangeness)
        named.sort(key=lambda each: each is not plainest)
    return tuple(named)


def _leave_out_impossible(candidates: Sequence[CircleCandidate]) -> list[CircleCandidate]:
    """Return candidates with the probabilities that they have where no impossible value is the cause."""
    left = 1.0 - sum(each.probability for each in candidates if not each.is_plausible)
    return [
        replace(
            each, probability=min(each.probability / left, 1.0) if each.is_plausible and left > 0 else 0.0
        )
        for each in candidates
    ]


def _make_candidate(study: CircleStudy, contender: Contender, probability: float) -> CircleCandidate:
    form = refine_form(study, contender.effect, contender.form)
    after = add_form(study, contender.effect, form)
    estimates = after.list_estimates_of(contender.effect.identifier)
    return CircleCandidate(
        contender.effect, form, contender.evidence, probability, contender.p_value, estimates,
        after.rms, all(each.is_possible for each in estimates),
    )  # fmt: skip


def _measure_strangeness(candidate: CircleCandidate) -> float:
    """Return how far beyond the usual an effect's values are, and how much was searched for it."""
    beyond = [
        abs(each.value) / each.term.usual
        for each in candidate.estimates
        if each.term is not None and each.term.usual
    ]
    return float(np.log(max([*beyond, 1.0]))) + len(candidate.effect.searched)


def _compute_curve(study: CircleStudy, candidate: CircleCandidate) -> FloatArray:
    """Return what an effect makes of the deviations at its estimated values."""
    parts = (each.value * each.term.column for each in candidate.estimates if each.term is not None)
    return np.asarray(sum(parts, np.zeros(study.design.count)))


def _add_equals(
    study: CircleStudy,
    candidate: CircleCandidate,
    curve: FloatArray,
    others: Sequence[CircleCandidate],
    curves: Sequence[FloatArray],
) -> CircleCandidate:
    """Return a candidate with those that the plan cannot tell from it, by columns and evidence.

    `curves`: What each of the others makes of the deviations.
    """
    if not candidate.is_plausible:
        return candidate
    equals = []
    for other, of_other in zip(others, curves, strict=True):
        if other is candidate or not other.is_plausible:
            continue
        apart = _measure_apart(study, curve, other)
        # To be like is mutual: of two that the readings favour alike, either may be what the other can do.
        least = min(apart, _measure_apart(study, of_other, candidate))
        nearer = abs(other.evidence - candidate.evidence)
        if (apart < _ALIKE and nearer < FURTHER) or (least < _SIMILAR and nearer < MENTION):
            equals.append(other.effect.identifier)
    return replace(candidate, indistinguishable_from=tuple(equals))


def _measure_apart(study: CircleStudy, curve: FloatArray, other: CircleCandidate) -> float:
    """Return which part of a curve another effect leaves, whatever its values; 1 of a curve that is none."""
    under = study.whitened
    own = under.whiten(curve[:, np.newaxis])
    length = float(under.multiply(own, own)[0, 0])
    if length <= 0:
        return 1.0
    whole = make_whole_form(other.effect, study.design, other.form.searched)
    explained = max(
        under.measure_explained(under.whiten(form.columns), own)
        for form in split_parts_of(other.effect, whole)
        if form.terms
    )
    return 1.0 - explained / length


def _find_left(study: CircleStudy, outcome: CircleContest) -> CircleRemainder:
    """Return what is left beside all that is named: the residual beyond its noise."""
    beyond = max(study.rms**2 - (study.noise.sigma**2), 0.0)
    return CircleRemainder(float(np.sqrt(beyond)), outcome.shape or Words("of no shape"))
