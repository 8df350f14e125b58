"""The next experiment, followed: a tie is left by a small test, the advised test is simulated and diagnosed.

The truth is that of the first test, and so is what is irregular along the axis at the same targets. The
second has the plan that was advised, weather as the advice expects it with a random walk beside it, and noise
of its own. It is diagnosed alone, or held together with the first where the advice says so.
"""

from __future__ import annotations

import time
from collections.abc import Iterable, Iterator
from dataclasses import replace
from typing import Any

import numpy as np

from hidden_effects.cases import Case, Kind
from hidden_effects.judge import INSTALLED, named
from hidden_effects.records import Record
from hidden_effects.trial import OF_A_GAUGE, Measured, Trial, drawn_trial, measured, sum_of
from hidden_effects.weather import wandering
from zlmreport.measurement.arrays import FloatArray
from zlmreport.model.diagnosis.diagnosis import DiagnosisVerdict, diagnose
from zlmreport.model.effects.design import Design
from zlmreport.model.effects.model_error import ModelError
from zlmreport.model.fitting.observations import make_observations_of
from zlmreport.model.fitting.sessions import add_zeros, join_sessions
from zlmreport.model.planning.deciding import find_question_of_tie
from zlmreport.model.planning.experiment import Experiment, plan_next_experiment
from zlmreport.model.planning.plan import AxisPlan, ExpectedTest
from zlmreport.model.simulation.description import SimulatedNoise, sample_noise_of

#: Targets and runs of tests that leave ties.
_TARGETS, _RUNS = (7, 9, 11, 15), (2, 3, 4)
#: Expected difference of the criteria of two effects from which on they hardly tie (`Trial.nearest`).
_APART = 8.0
#: ρ of what is hidden: a smaller effect that ties leaves a plan little to promise.
_SIZE = 2.0


def chosen(cases: Iterable[Case]) -> Iterator[tuple[Case]]:
    """Yield tests with one effect of 2 σ that a second test of the same axis can show."""
    for case in cases:
        if case.kind is Kind.EFFECT and case.size == _SIZE and not OF_A_GAUGE.intersection(case.hidden):
            yield (case,)


def judged(case: Case) -> Record:
    """Return whether a test leaves a tie, what is advised, and what comes of the advice."""
    random = case.random()
    trial = drawn_trial(case, (int(random.choice(_TARGETS)), int(random.choice(_RUNS))))
    if trial is None:
        return named(case) | {"outcome": "not visible"}
    nearest = trial.nearest()
    has_twin = len(trial.twins) > 1
    if has_twin or nearest is None or nearest[1] > _APART:
        return named(case) | {"outcome": "the same as another" if has_twin else "nothing like it"}
    plan = trial.description.plan
    started = time.process_time()
    try:
        first = diagnose(
            trial.model, make_observations_of(trial.first.measurements, overrun=plan.overrun), INSTALLED
        )
    except ModelError as error:
        return named(case) | {"outcome": "refused", "message": str(error)}
    diagnosed = time.process_time()
    question = find_question_of_tie(first)
    if (
        question is None
        or first.verdict is not DiagnosisVerdict.MISSING
        or case.hidden[0] not in question.names
    ):
        return named(case) | {"outcome": "no tie with the truth in it"}
    rise = float(np.ptp(first.fit.design.conditions["axis_temperature"]))
    expected = ExpectedTest(question.sigma, rise)
    advice = plan_next_experiment(question, plan, expected, INSTALLED, trial.description.seed)
    found = named(case) | {"outcome": "judged", "tied": list(question.names), "decides": advice.decides}
    found |= {"diagnosis": diagnosed - started, "experiment": time.process_time() - diagnosed}
    if advice.plan is None:
        return found | {"followed": None}
    design = question.make_next_design(advice.plan, expected)
    found |= {"minutes": advice.minutes, "session": advice.plan.after is not None}
    return found | {"followed": _followed(trial, advice, advice.plan, design)}


def _followed(trial: Trial, advice: Experiment, plan: AxisPlan, expected: Design) -> dict[str, Any]:
    """Return what the diagnosis of the advised test says; `expected` is its design."""
    design = wandering(expected, np.random.default_rng([trial.description.seed, 3]))
    # What the job's model describes is in the advised test as it is in every test.
    base = np.concatenate(
        [term.compute_columns(design, term.make_grid(design)[0])[0] for term in trial.model.terms], axis=1
    )
    again = _measured_again(trial, plan, design, base @ trial.coefficients)
    observed = make_observations_of(again.measurements, overrun=plan.overrun)
    try:
        if plan.after:
            first = make_observations_of(trial.first.measurements, overrun=trial.description.plan.overrun)
            observed = join_sessions(observed, [("the first", first)])
        said = diagnose(add_zeros(trial.model, observed.design), observed, INSTALLED)
    except ModelError as error:
        return {"decision": "refused", "message": str(error)}
    leading = said.candidates[:1] if said.verdict is DiagnosisVerdict.MISSING else ()
    names = {name for each in leading for name in (each.identifier, *each.equals)}
    left = names.intersection(advice.effects)
    truth = trial.case.hidden[0]
    decision = "right" if left == {truth} else "undecided" if truth in left or not left else "wrong"
    return {"decision": decision, "verdict": said.verdict, "names": sorted(names)}


def _measured_again(trial: Trial, plan: AxisPlan, design: Design, known: FloatArray) -> Measured:
    """Return the readings of the advised test; what is irregular along the axis stays where it was."""
    first = trial.description
    noise, seed = first.noise, first.seed + 1
    stays = np.array_equal(plan.targets, first.plan.targets)
    geometry = SimulatedNoise(
        0.0, position=noise.position, position_and_direction=noise.position_and_direction
    )
    irregular = sample_noise_of(geometry, design, first.seed if stays else seed)
    description = replace(
        first,
        plan=plan,
        seed=seed,
        noise=replace(noise, position=0.0, position_and_direction=0.0),
        conditions={name: course for name, course in first.conditions.items() if name in design.conditions},
    )
    return measured(description, design, known, irregular + sum_of(trial.effects, design))
