"""The next experiment, followed: a tie is left by a small test, the advised test is simulated and diagnosed.

The truth is that of the first test. The second has the plan that was advised, weather as the advice expects
it with a random walk beside it, and noise of its own.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from hidden_effects.cases import Case, Kind
from hidden_effects.judge import INSTALLED, named
from hidden_effects.records import Record
from hidden_effects.tables.markdown import table
from hidden_effects.tables.shares import Share
from hidden_effects.trial import OF_A_GAUGE, Trial, drawn_trial, measured, sum_of
from hidden_effects.weather import wandering
from zlmreport.model.axis_model import ModelError
from zlmreport.model.diagnosis import Verdict, diagnose
from zlmreport.model.observations import observations_of
from zlmreport.planning.deciding import question_of_tie
from zlmreport.planning.experiment import Experiment, next_experiment
from zlmreport.planning.plan import Expected, Plan
from zlmreport.planning.visibility import expected_design

#: Targets and runs of tests that leave ties.
_TARGETS, _RUNS = (7, 9, 11, 15), (2, 3, 4)
_PROMISED = (0.95, 0.8, 0.5)


def chosen(cases: Iterable[Case]) -> Iterator[tuple[Case]]:
    """Yield tests with one effect of 1 or 2 σ that a second test of the same axis can show."""
    for case in cases:
        if case.kind is Kind.EFFECT and case.size >= 1 and not OF_A_GAUGE.intersection(case.hidden):
            yield (case,)


def judged(case: Case) -> Record:
    """Return whether a test leaves a tie, what is advised, and what comes of the advice."""
    random = case.random()
    trial = drawn_trial(case, (int(random.choice(_TARGETS)), int(random.choice(_RUNS))))
    if trial is None:
        return named(case) | {"outcome": "not visible"}
    plan = trial.description.plan
    try:
        first = diagnose(
            trial.model, observations_of(trial.first.measurements, overrun=plan.overrun), INSTALLED
        )
    except ModelError as error:
        return named(case) | {"outcome": "refused", "message": str(error)}
    question = question_of_tie(first)
    if question is None or first.verdict is not Verdict.MISSING or case.hidden[0] not in question.names:
        return named(case) | {"outcome": "no tie with the truth in it"}
    rise = float(np.ptp(first.fit.design.conditions["axis_temperature"]))
    expected = Expected(question.sigma, rise)
    advice = next_experiment(question, plan, expected, INSTALLED, trial.description.seed)
    found = named(case) | {"outcome": "judged", "tied": list(question.names), "decides": advice.decides}
    if advice.plan is None:
        return found | {"followed": None}
    return found | {"minutes": advice.minutes, "followed": _followed(trial, advice, advice.plan, expected)}


def _followed(trial: Trial, advice: Experiment, plan: Plan, expected: Expected) -> dict[str, Any]:
    """Return what the diagnosis of the advised test says."""
    description = replace(trial.description, plan=plan, seed=trial.description.seed + 1)
    design = expected_design(description.axis, plan, expected)
    logged = {name: design.conditions[name] for name in description.conditions}
    design = replace(design, conditions=logged, span=trial.first.design.span)
    design = wandering(design, np.random.default_rng([description.seed, 3]))
    # What the job's model describes is in the advised test as it is in every test.
    base = np.concatenate(
        [term.columns(design, term.grid(design)[0])[0] for term in trial.model.terms], axis=1
    )
    again = measured(description, design, base @ trial.coefficients, sum_of(trial.effects, design))
    try:
        said = diagnose(trial.model, observations_of(again.measurements, overrun=plan.overrun), INSTALLED)
    except ModelError as error:
        return {"decision": "refused", "message": str(error)}
    leading = said.candidates[:1] if said.verdict is Verdict.MISSING else ()
    names = {name for each in leading for name in (each.identifier, *each.equals)}
    left = names.intersection(advice.effects)
    truth = trial.case.hidden[0]
    decision = "right" if left == {truth} else "undecided" if truth in left or not left else "wrong"
    return {"decision": decision, "verdict": said.verdict, "names": sorted(names)}


def report(records: Sequence[Record], state: str) -> str:
    """Return the table."""
    ties = [each for each in records if each["outcome"] == "judged"]
    return "\n".join([f"{len(records)} cases of code {state}: {len(ties)} ties.", "", *_table(ties)])


def _table(ties: Sequence[Record]) -> Iterator[str]:
    rows: list[tuple[object, ...]] = []
    most = np.inf
    for least in _PROMISED:
        own = [each for each in ties if each["followed"] and least <= each["decides"] < most]
        came = [each["followed"]["decision"] for each in own]
        stated = f"{100 * float(np.mean([each['decides'] for each in own])):.0f}" if own else "–"
        shares = [Share.of(each == way for each in came) for way in ("right", "undecided", "wrong")]
        rows.append((f"≥ {least}", len(own), stated, *shares))
        most = least
    rows.append(("no plan is worth it", sum(not each["followed"] for each in ties), "–", "–", "–", "–"))
    yield from table(
        ("promised", "ties", "promised on average, %", "decided rightly", "undecided", "wrong"), rows
    )
