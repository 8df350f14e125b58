"""Builds a model: diagnosis after diagnosis, each effect with evidence of its own is added.

What a person would do who follows the advice: add what is named, look again, take out what has proved a
makeshift, and stop where nothing is left that has a name.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import TypeAlias

import numpy as np

from zlmreport.language import Words
from zlmreport.model.diagnosis.candidate import Doubt, find_doubts, list_questions
from zlmreport.model.diagnosis.contest import Told, tell_nobody
from zlmreport.model.diagnosis.diagnosis import AxisDiagnosis, DiagnosisVerdict
from zlmreport.model.diagnosis.error_numbers import LARGEST_RATIO, ErrorNumbers, compute_error_numbers
from zlmreport.model.effects.axis_model import AxisModel
from zlmreport.model.effects.effect import Effect
from zlmreport.model.effects.model_error import ModelError
from zlmreport.model.fitting.fit import Fit, fit
from zlmreport.model.fitting.sessions import SessionZeros

#: Diagnoses of one build: each adds a whole set, so a second mostly finds nothing more.
_MOST_ROUNDS = 6

#: Diagnoses a model, the effects that may be taken out of it named; told how far it is.
Diagnosing: TypeAlias = Callable[[AxisModel, frozenset[str], Told], AxisDiagnosis]


@dataclass(frozen=True, slots=True)
class ModelStep:
    """An effect that comes into a model, or goes out of it."""

    effect: Effect  #: In the form that fits best.
    before: ErrorNumbers  #: How far the model is from the readings without this step.
    after: ErrorNumbers  #: The same with it.
    is_removed: bool = False  #: Whether the effect goes out again.
    is_reshaped: bool = False  #: Whether it stood there in another form.
    equals: tuple[str, ...] = ()  #: Effects that the readings did not tell from it when it came in.

    @property
    def identifier(self) -> str:
        """As jobs name it."""
        return self.effect.identifier


@dataclass(frozen=True, slots=True)
class Exchange:
    """Effects that would take the place of others, and describe the readings as well as these."""

    coming: tuple[str, ...]  #: Names that would come in.
    going: tuple[str, ...]  #: Those of the model that would go out.


@dataclass(frozen=True, slots=True)
class Built:
    """A model that was built."""

    first: AxisDiagnosis  #: Of the model with which it began.
    steps: tuple[ModelStep, ...]  #: What came in and went out, in order.
    last: AxisDiagnosis  #: Of the model that came of it.
    model: AxisModel  #: That model.
    exchange: Exchange | None = None  #: What would do as well; None where nothing would.
    #: Effects that came in and are no more than likely, with what is nearly as likely and did not come in.
    doubts: tuple[Doubt, ...] = ()

    @property
    def removed(self) -> tuple[str, ...]:
        """Effects of the first model that do not stand in the last."""
        kept = self.model.identifiers
        return tuple(each for each in self.first.fit.model.identifiers if each not in kept)

    @property
    def added(self) -> tuple[Effect, ...]:
        """Effects of the last model that did not stand in the first in this form."""
        before = {(each.effect.identifier, each.effect.settings) for each in self.first.fit.model.terms}
        return tuple(
            each.effect
            for each in self.model.terms
            if (each.effect.identifier, each.effect.settings) not in before
        )

    @property
    def needless(self) -> tuple[str, ...]:
        """Effects that stood in the model from the beginning, and that may not be there."""
        before = self.first.fit.model.identifiers
        return tuple(each for each in list_needless(self.last) if each in before)

    @property
    def questions(self) -> tuple[Words, ...]:
        """What is asked of the effects that were added: values far from usual, or against the job."""
        return tuple(list_questions(self.last.fit, {each.identifier for each in self.added}))


def list_needless(diagnosis: AxisDiagnosis) -> tuple[str, ...]:
    """Return the effects of a model that describes the readings, and that may not be there.

    Nothing of them exceeds its uncertainty. A zero is none of them, and that of a session no effect of a job.
    """
    fitted = diagnosis.fit
    if diagnosis.verdict is not DiagnosisVerdict.ADEQUATE:
        return ()
    pairs = zip(fitted.model.terms, fitted.solution.thetas, strict=True)
    moving = [term for term, theta in pairs if np.ptp(term.effect.columns(fitted.design, theta)) > 0]
    names = (each.effect.identifier for each in moving if not isinstance(each.effect, SessionZeros))
    return tuple(each for each in names if not is_outstanding(each, fitted))


def is_outstanding(identifier: str, fitted: Fit) -> bool:
    """Return whether an effect is seen: a size of it exceeds its uncertainty, or far more is left without it.

    Where size and time constant go together, neither is known, and yet something is there. Its place or
    period says nothing of that.
    """
    (effect,) = (term.effect for term in fitted.model.terms if term.effect.identifier == identifier)
    sizes = [
        each for each in fitted.estimates if each.effect == identifier and each.parameter in effect.linear
    ]
    if any(each.is_given or abs(each.value) > each.expanded_uncertainty for each in sizes):
        return True
    without = fit(fitted.model.without(identifier), fitted.design, fitted.deviation, fitted.assumptions)
    return without.rms**2 > LARGEST_RATIO * fitted.rms**2


def build(model: AxisModel, diagnosing: Diagnosing, told: Told = tell_nobody) -> Built:
    """Build a model, from the one that there is.

    `diagnosing`: Holds a model against the readings of the test.

    Raises `ModelError` as a diagnosis does.
    """
    own = frozenset(model.identifiers)
    rounds = [_Round(model, (), diagnosing(model, frozenset(), _tell_part(told, 0)))]
    exchange = None
    while len(rounds) <= _MOST_ROUNDS and rounds[-1].diagnosis.verdict is DiagnosisVerdict.MISSING:
        extended, taken = _extend_model(rounds[-1].model, rounds[-1].diagnosis)
        if not taken:
            break
        tried = [_name_forms(each.model) for each in rounds]
        if _name_forms(extended) in tried:
            # Models each of which takes the next for the better one are as good as each other.
            alike = rounds[tried.index(_name_forms(extended)) :]
            kept = min(alike, key=lambda each: each.diagnosis.error.rms)
            exchange = kept.find_exchange()
            if exchange is not None:
                rounds = [*rounds[: rounds.index(kept)], kept.as_settled()]
            break
        steps = (*rounds[-1].steps, *taken)
        may_go = frozenset(each.identifier for each in steps) - own
        diagnosis = diagnosing(extended, may_go, _tell_part(told, len(rounds)))
        if diagnosis.verdict is not DiagnosisVerdict.MISSING:
            # What is said in the end is what is said of the job as it is then written, where nothing may go.
            diagnosis = diagnosing(extended, frozenset(), _tell_part(told, len(rounds)))
        # Readings that were set aside beside the lesser model may be none that stand off beside this one.
        steps = (*steps[:-1], replace(steps[-1], after=diagnosis.error))
        rounds.append(_Round(extended, steps, diagnosis))
    model, last = rounds[-1].model, rounds[-1].diagnosis
    told_apart = frozenset(model.identifiers)  # what came in later is told from what was there
    steps = tuple(
        replace(each, equals=tuple(other for other in each.equals if other not in told_apart))
        for each in rounds[-1].steps
    )
    return Built(rounds[0].diagnosis, steps, last, model, exchange, _collect_doubts(rounds))


def _name_forms(model: AxisModel) -> frozenset[tuple[str, str]]:
    """Return the effects of a model, each in its form: one with more harmonics is another."""
    effects = (term.effect for term in model.terms)
    return frozenset((each.identifier, each.settings.model_dump_json()) for each in effects)


def _collect_doubts(rounds: Sequence[_Round]) -> tuple[Doubt, ...]:
    """Return of the effects that stayed those that were no more than likely when they came in."""
    stays = rounds[-1].model.identifiers
    found: list[Doubt] = []
    for each in rounds[:-1]:
        doubts = find_doubts(
            each.diagnosis.candidates, [effect.identifier for effect in each.diagnosis.together]
        )
        named = [doubt for doubt in doubts if doubt.is_named and doubt.names[0] in stays]
        rivals = [doubt for doubt in doubts if not doubt.is_named and doubt.names[0] not in stays]
        found += [*named, *rivals] if named else []
    return tuple(found)


@dataclass(frozen=True, slots=True)
class _Round:
    """A model on the way, and what was said of it."""

    model: AxisModel
    steps: tuple[ModelStep, ...]  #: From the first model to it.
    diagnosis: AxisDiagnosis

    def find_exchange(self) -> Exchange | None:
        """Return what would take the place of what; None where nothing would go out."""
        going, own = self.diagnosis.makeshift, self.model.identifiers
        coming = tuple(each.identifier for each in self.diagnosis.together if each.identifier not in own)
        return Exchange(coming, going) if coming and going else None

    def as_settled(self) -> _Round:
        """Return the same with nothing that is missing: what would come in only takes another's place."""
        verdict = DiagnosisVerdict.UNEXPLAINED if self.diagnosis.remainder else DiagnosisVerdict.ADEQUATE
        settled = replace(
            self.diagnosis,
            verdict=verdict,
            together=(),
            makeshift=(),
            error_after=self.diagnosis.error,
        )
        return replace(self, diagnosis=settled)


def _tell_part(told: Told, rounds: int) -> Told:
    """Return what tells the progress of one diagnosis among those of a build: half of what is left."""
    done = 1.0 - 0.5**rounds
    return lambda share: told(done + (1.0 - done) * 0.5 * share)


def _extend_model(model: AxisModel, diagnosis: AxisDiagnosis) -> tuple[AxisModel, list[ModelStep]]:
    """Return the model with the set of a diagnosis, and the steps to it; what cannot be fitted ends it."""
    fitted, error = diagnosis.fit, diagnosis.error
    equals = {each.identifier: each.equals for each in diagnosis.candidates}
    coming = [(each, False) for each in diagnosis.together]
    going = [(term.effect, True) for term in model.terms if term.effect.identifier in diagnosis.makeshift]
    steps: list[ModelStep] = []
    # What is much like a makeshift can only be fitted when that is out.
    for effect, is_removed in (*coming, *going, *(coming if going else ())):
        if not is_removed and effect in (term.effect for term in model.terms):
            continue
        changed = model.without(effect.identifier) if is_removed else model.with_effect(effect)
        try:
            fitted = fit(changed, fitted.design, fitted.deviation, diagnosis.fit.assumptions)
        except ModelError:
            continue
        is_reshaped = not is_removed and effect.identifier in model.identifiers
        model, before, error = changed, error, compute_error_numbers(fitted)
        beside = () if is_removed else equals.get(effect.identifier, ())
        steps.append(ModelStep(effect, before, error, is_removed, is_reshaped, beside))
    return model, steps


def name_steps(steps: Sequence[ModelStep]) -> tuple[str, ...]:
    """Return the effects of steps with those not told from them, what goes out with a minus."""
    return tuple(map(_name_step, steps))


def _name_step(step: ModelStep) -> str:
    if step.is_removed:
        return f"− {step.identifier}"
    if step.is_reshaped:
        return f"{step.identifier} in another form"
    return f"+ {' or '.join((step.identifier, *step.equals))}"


def name_changes(built: Built) -> tuple[str, ...]:
    """Return what the model that was built has that the first had not, then what it has not any more.

    What only passed through is neither; what another effect contains went out without a step of its own.
    """
    added = {each.identifier for each in built.added}
    before = built.first.fit.model.identifiers
    coming = {
        each.identifier: replace(each, is_reshaped=each.identifier in before)
        for each in built.steps
        if each.identifier in added
    }
    return (*name_steps(tuple(coming.values())), *(f"− {each}" for each in built.removed))
