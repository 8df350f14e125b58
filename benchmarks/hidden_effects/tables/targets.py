"""What was aimed at, and what was measured."""

from __future__ import annotations

import statistics
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from hidden_effects.cases import Scatter
from hidden_effects.records import Record
from hidden_effects.tables.markdown import table
from hidden_effects.tables.outcome import Outcome, judged, outcome
from hidden_effects.tables.shares import Share
from hidden_effects.tables.worth import USUAL_READINGS

_FIRST, _FIRST_OF_SMALL, _NAMED, _WRONG = 0.92, 0.80, 0.97, 0.05
_GROUP = 1.3
_ALARMS, _STRANGERS = 0.05, 0.15
_OF_THE_ORACLE = 1.05
_SECONDS = 2.0


@dataclass(frozen=True, slots=True)
class _Target:
    """A row: what is aimed at, in words and as a limit, and what was measured, as a number and as printed."""

    what: str
    aim: str
    tests: int
    measured: object
    is_met: bool


def targets(records: Sequence[Record]) -> Iterator[str]:
    """Yield the table of targets."""
    rows = [
        (each.what, each.aim, each.tests, each.measured, "met" if each.is_met else "**missed**")
        for each in _targets(records)
        if each.tests
    ]
    return table(("what", "target", "tests", "measured", ""), rows)


def _targets(records: Sequence[Record]) -> Iterator[_Target]:
    effects = judged(records, kind="effect")
    by_noise = {f"{scatter} noise": judged(effects, scatter=scatter) for scatter in Scatter}
    for noise, chosen in {"both noises": effects, **by_noise}.items():
        one, where = _outcomes(judged(chosen, size=1.0)), f"ρ = 1, {noise}"
        yield _at_least(f"{where}: first", _FIRST, (each.is_first for each in one))
        yield _at_least(f"{where}: first, or in the named group", _NAMED, (each.is_named for each in one))
        groups = [each.group for each in one if each.group]
        mean = statistics.mean(groups) if groups else 0.0
        yield _Target(f"{where}: mean group", f"≤ {_GROUP:g}", len(groups), f"{mean:.2f}", mean <= _GROUP)
        yield _at_most(f"{where}: wrong name", _WRONG, (each.is_wrong for each in one))
        small = _outcomes(judged(chosen, size=0.6))
        yield _at_least(f"ρ = 0.6, {noise}: first", _FIRST_OF_SMALL, (each.is_first for each in small))
    for scatter in Scatter:
        nothing = judged(records, kind="nothing", scatter=scatter)
        what = f"false alarms, {scatter} noise"
        yield _at_most(what, _ALARMS, (each["verdict"] != "adequate" for each in nothing))
    strangers = judged(records, kind="stranger")
    what = "strangers falsely named, all sizes, both noises"
    yield _at_most(what, _STRANGERS, (each["verdict"] == "missing" for each in strangers))
    second = [each["second"] for each in judged(effects, size=1.0)]
    ratios = [each["after"] / each["oracle"] for each in second]
    ratio = statistics.median(ratios) if ratios else 0.0
    what = "error on a second test, ρ = 1, over that of the oracle, median"
    yield _Target(what, f"≤ {_OF_THE_ORACLE:g}", len(ratios), f"{ratio:.2f}", ratio <= _OF_THE_ORACLE)
    seconds = [each["seconds"] for each in judged(records) if each["readings"] > USUAL_READINGS]
    median = statistics.median(seconds) if seconds else 0.0
    what = "a diagnosis of some 210 readings, s of one core, median"
    yield _Target(what, f"≤ {_SECONDS:g}", len(seconds), f"{median:.2f}", median <= _SECONDS)


def _at_least(what: str, least: float, judgements: Iterator[bool]) -> _Target:
    share = Share.of(judgements)
    return _Target(what, f"≥ {100 * least:g} %", share.total, share, share.value >= least)


def _at_most(what: str, most: float, judgements: Iterator[bool]) -> _Target:
    share = Share.of(judgements)
    return _Target(what, f"≤ {100 * most:g} %", share.total, share, share.value <= most)


def _outcomes(records: Sequence[Record]) -> list[Outcome]:
    return [outcome(each) for each in records]
