"""What earlier tests of the same type of machine are worth: each test diagnosed with and without them.

The earlier tests are of other axes with other targets in other weather; alike is how their readings scatter.
Only what they teach of noise is used: the size of what is hidden is nobody's to know.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from functools import lru_cache

from hidden_effects.cases import Case, Kind, Scatter
from hidden_effects.judge import INSTALLED, named
from hidden_effects.records import Record
from hidden_effects.tables.markdown import table
from hidden_effects.tables.outcome import judged as of_judged, outcome
from hidden_effects.tables.shares import Share
from hidden_effects.trial import ROTARY, drawn_trial
from zlmreport.model.diagnosis.diagnosis import diagnose
from zlmreport.model.effects.model_error import ModelError
from zlmreport.model.fitting.fit import Fit, fit
from zlmreport.model.fitting.observations import make_observations_of
from zlmreport.model.fitting.priors import Lesson, PriorExpectation, learn_priors
from zlmreport.model.planning.methods import Method

_EARLIER, _MACHINES = 10, 20
#: Draws of earlier tests: no case has them.
_FIRST_EARLIER = 1_000_000


def chosen(cases: Iterable[Case]) -> Iterator[tuple[Case]]:
    """Yield realistic tests with an effect of 0.6 or 1 σ, or with nothing; of these every sixteenth."""
    for case in cases:
        an_effect = case.kind is Kind.EFFECT and case.size <= 1
        nothing = case.kind is Kind.NOTHING and case.draw % 16 == 0
        if case.scatter is Scatter.REALISTIC and (an_effect or nothing):
            yield (case,)


def judged(case: Case) -> Record:
    """Return what is said without and with earlier tests."""
    trial = drawn_trial(case)
    if trial is None:
        return named(case) | {"outcome": "not visible"}
    observed = make_observations_of(trial.first.measurements, overrun=trial.description.plan.overrun)
    machine = int(case.random().integers(_MACHINES))
    expected = _taught(machine, is_rotary=bool(ROTARY.intersection(case.hidden)))
    found = named(case) | {"outcome": "judged", "twins": sorted(trial.twins)}
    for way, known in (("without", None), ("with", expected)):
        try:
            said = diagnose(trial.model, observed, INSTALLED, expected=known)
        except ModelError as error:
            return named(case) | {"outcome": "refused", "message": str(error)}
        found[way] = {
            "verdict": said.verdict,
            "candidates": [
                {"effect": each.identifier, "probability": each.probability, "equals": list(each.equals)}
                for each in said.candidates[:1]
            ],
        }
    return found


@lru_cache
def _taught(machine: int, *, is_rotary: bool) -> PriorExpectation:
    """Return what the noise of ten earlier tests teaches that hide nothing."""
    fits = [
        _earlier(_FIRST_EARLIER + _EARLIER * machine + each, is_rotary=is_rotary) for each in range(_EARLIER)
    ]
    return PriorExpectation.of(
        learn_priors([Lesson.of(each) for each in fits]).model_copy(update={"effects": {}}),
        fits[0].design.axis,
    )


def _earlier(draw: int, *, is_rotary: bool) -> Fit:
    methods = tuple(Method)
    # On a rotary axis it hides what the fitted model has.
    kind, hidden, size = (Kind.EFFECT, ("eccentricity",), 2.0) if is_rotary else (Kind.NOTHING, (), 0.0)
    trial = drawn_trial(Case(kind, hidden, methods[draw % len(methods)], Scatter.REALISTIC, size, draw))
    assert trial is not None  # eccentricity is always seen
    model = trial.model
    for term in trial.effects:
        model = model.with_effect(term.effect)
    observed = make_observations_of(trial.first.measurements, overrun=trial.description.plan.overrun)
    return fit(model, observed.design, observed.deviation)


def report(records: Sequence[Record], state: str) -> str:
    """Return the table."""
    return "\n".join([f"{len(records)} cases of code {state}.", "", *_table(of_judged(records))])


def _table(records: Sequence[Record]) -> Iterator[str]:
    rows = []
    for what, target, kind, size, hit in (
        ("ρ = 1: first", "≥ 91 %, ≥ 93 %", Kind.EFFECT, 1.0, "is_first"),
        ("ρ = 1: wrong name", "≤ 5 %", Kind.EFFECT, 1.0, "is_wrong"),
        ("ρ = 0.6: first", "≥ 72 %, ≥ 80 %", Kind.EFFECT, 0.6, "is_first"),
        ("ρ = 0.6: wrong name", "", Kind.EFFECT, 0.6, "is_wrong"),
        ("false alarms", "≤ 5 %", Kind.NOTHING, 0.0, "is_alarm"),
    ):
        own = [each for each in records if each["kind"] == kind and each["size"] == size]
        hits = {way: [_hit(each, way, hit) for each in own] for way in ("without", "with")}
        pairs = list(zip(hits["without"], hits["with"], strict=True))
        gained, lost = (sum(each == change for each in pairs) for change in ((False, True), (True, False)))
        shares = [str(Share.of(each)) for each in hits.values()]
        rows.append((what, target, len(own), *shares, f"{gained}, {lost}"))
    yield from table(("what", "target", "tests", "without", "with", "only with, only without"), rows)


def _hit(record: Record, way: str, what: str) -> bool:
    said = {**record, **record[way]}
    if what == "is_alarm":
        return bool(said["verdict"] != "adequate")
    return bool(getattr(outcome(said), what))
