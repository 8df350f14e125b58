"""The benchmark of truth: its draws are what they say, and a small fixed part of it keeps its targets."""

from __future__ import annotations

import json
import math
from collections import Counter
from itertools import zip_longest
from pathlib import Path

import numpy as np
import pytest

from hidden_effects import experiments, learned, records
from hidden_effects.cases import Case, Kind, Scatter, cases, effects
from hidden_effects.generic import is_tried_on
from hidden_effects.judge import judged
from hidden_effects.prediction import errors
from hidden_effects.run import run
from hidden_effects.sizes import base_columns, beyond
from hidden_effects.sparse import sparse
from hidden_effects.stepwise import stepwise
from hidden_effects.tables import report
from hidden_effects.tables.experiments import report as of_experiments
from hidden_effects.tables.outcome import outcome
from hidden_effects.tables.shares import Share
from hidden_effects.tables.targets import targets
from hidden_effects.trial import EFFECTS, drawn_trial
from zlmreport.model.diagnosis.diagnosis import diagnose
from zlmreport.model.fitting.observations import make_observations_of
from zlmreport.model.planning.methods import Method

pytestmark = pytest.mark.long

ROOT = Path(__file__).parents[2]


def case(  # noqa: PLR0913 - a case has so many parts
    hidden: str = "screw-pitch",
    *,
    kind: Kind = Kind.EFFECT,
    method: Method = Method.LINEAR,
    scatter: Scatter = Scatter.CLEAN,
    size: float = 1.0,
    draw: int = 1_000_000,  # never a draw of the benchmark itself
) -> Case:
    return Case(kind, (hidden,) if hidden else (), method, scatter, size, draw)


class TestCases:
    def test_every_case_has_a_name_of_its_own(self) -> None:
        keys = [each.key for each in cases(3)]
        assert len(set(keys)) == len(keys)

    def test_every_effect_stands_in_every_cell_once_a_draw(self) -> None:
        of_effects = [each for each in cases(2) if each.kind is Kind.EFFECT]
        cells = Counter((each.hidden, each.method, each.scatter, each.size) for each in of_effects)
        assert len(cells) == len(effects()) * 4 * 2 * 3
        assert set(cells.values()) == {2}

    def test_a_hundred_draws_have_a_thousand_tests_without_effect_in_either_noise(self) -> None:
        of_nothing = Counter(each.scatter for each in cases(10) if each.kind is Kind.NOTHING)
        assert all(10 * count >= 1000 for count in of_nothing.values())
        assert len(of_nothing) == len(Scatter)

    def test_two_draws_have_different_designs(self) -> None:
        first, second = (drawn_trial(case(draw=draw)) for draw in (1, 2))
        assert first is not None
        assert second is not None
        assert not np.array_equal(first.first.design.position, second.first.design.position)


class TestTrials:
    @pytest.mark.parametrize("hidden", ["thermal-growth", "datum-step", "gear-mesh", "polynomial"])
    def test_what_the_model_cannot_imitate_has_the_stated_size(self, hidden: str) -> None:
        trial = drawn_trial(case(hidden, method=Method.PENDULUM, size=0.6))
        assert trial is not None
        base = base_columns([term.effect for term in trial.model.terms], trial.first.design)
        visible = beyond(base, trial.first.hidden[:, np.newaxis])
        assert np.sqrt(np.mean(visible**2)) == pytest.approx(0.6 * trial.sigma, rel=1e-9)

    def test_an_effect_of_direction_cannot_be_hidden_where_there_is_one_direction(self) -> None:
        assert drawn_trial(case("backlash-bow", method=Method.UNIDIRECTIONAL)) is None

    def test_a_falling_line_and_a_cosine_error_are_twins(self) -> None:
        trial = drawn_trial(case("cosine-error"))
        assert trial is not None
        assert trial.twins == {"cosine-error", "scale-error"}

    def test_a_stranger_is_unlike_every_effect(self) -> None:
        trial = drawn_trial(case("bump in position", kind=Kind.STRANGER))
        assert trial is not None
        assert 0.0 < max(each.share for each in trial.imitated) <= 0.95

    def test_an_effect_is_far_from_others_if_it_is_large_and_they_are_unlike(self) -> None:
        near, far = (
            drawn_trial(case(hidden, size=2.0)) for hidden in ("scale-expansion", "directional-pitch")
        )
        assert near is not None
        assert far is not None
        assert 0 < near.nearest()[1] < 100
        assert far.nearest()[1] > 500

    def test_the_second_test_has_the_same_effect_at_other_targets(self) -> None:
        trial = drawn_trial(case("scale-kink"))
        assert trial is not None
        again = trial.again()
        kink, slope = trial.effects[0].fixed["kink"], trial.effects[0].fixed["slope"]
        position = again.design.position
        assert again.hidden == pytest.approx(slope * np.maximum(0.0, position - kink), abs=1e-15)
        inner = np.unique(trial.first.design.position)[1:-1]
        assert not np.any(np.isin(position, inner))


class TestOracle:
    def test_where_the_readings_are_gone_that_show_the_effect_it_adds_nothing(self) -> None:
        trial = drawn_trial(case("first-run", method=Method.UNIDIRECTIONAL))
        assert trial is not None
        observed = make_observations_of(trial.first.measurements, overrun=trial.description.plan.overrun)
        later = observed.without(np.flatnonzero(observed.design.run == observed.design.run.min()))
        found = errors(trial, diagnose(trial.model, later, tuple(EFFECTS.values())))
        assert found["oracle"] == found["before"]


class TestGenericWays:
    @pytest.fixture
    def terms(self) -> np.ndarray:
        return np.random.default_rng(7).standard_normal((200, 60))

    @pytest.mark.parametrize("way", [stepwise, sparse])
    def test_two_terms_among_sixty_are_found(self, way: object, terms: np.ndarray) -> None:
        noise = 0.3 * np.random.default_rng(8).standard_normal(200)
        leading, coefficients = way(terms, 2.0 * terms[:, 17] - terms[:, 40] + noise)
        assert leading == 17
        assert coefficients[[17, 40]] == pytest.approx([2.0, -1.0], abs=0.15)

    def test_stepwise_regression_adds_nothing_that_does_not_pay(self, terms: np.ndarray) -> None:
        constant = np.ones(200)
        orthogonal = terms - np.outer(constant, terms.mean(axis=0))
        assert stepwise(orthogonal, constant) == (None, pytest.approx(np.zeros(60)))

    def test_they_are_tried_where_their_terms_are_defined(self) -> None:
        assert is_tried_on(case("abbe"))
        assert not is_tried_on(case("ellipticity"))


#: Four tests: effects so large that chance has no part in it, a stranger, and a quiet one.
LARGE = [
    case("directional-pitch", method=Method.PENDULUM, size=2.0),
    case("gear-mesh", method=Method.UNIDIRECTIONAL, scatter=Scatter.REALISTIC, size=2.0),
]
STRANGER = case("slope smooth in time", kind=Kind.STRANGER, size=2.0)
NOTHING = case("", kind=Kind.NOTHING, method=Method.UNIDIRECTIONAL)


@pytest.fixture(scope="module")
def fixed_part(tmp_path_factory: pytest.TempPathFactory) -> dict[str, records.Record]:
    file = tmp_path_factory.mktemp("fixed") / "results.jsonl"
    run([(each,) for each in (*LARGE, STRANGER, NOTHING)], judged, file, 1, math.inf)
    return {record["key"]: record for record in records.read(file)}


class TestRecords:
    @pytest.fixture
    def judged_once(self, tmp_path: Path, fixed_part: dict[str, records.Record]) -> Path:
        file = tmp_path / "results.jsonl"
        file.write_text(f"{json.dumps(fixed_part[NOTHING.key])}\n", "utf-8")
        return file

    def test_a_case_is_judged_once(self, judged_once: Path) -> None:
        assert run([(NOTHING,)], judged, judged_once, 1, math.inf) == 0

    def test_a_line_that_was_cut_off_is_taken_away(self, judged_once: Path) -> None:
        whole = judged_once.read_text("utf-8")
        judged_once.write_text(whole + '{"code": "', "utf-8")
        records.mend(judged_once)
        assert judged_once.read_text("utf-8") == whole

    def test_results_of_other_code_do_not_count(self, judged_once: Path) -> None:
        found = records.read(judged_once)
        assert records.of_state(found, records.state_of_code()) == found
        assert records.of_state(found, "another") == []

    def test_tables_are_made_of_whatever_results_there_are(self, judged_once: Path) -> None:
        text = report(records.read(judged_once), "state")
        assert "| clean | 1 |" in text
        assert "| clean, ρ = 1 | 0 | – |" in text


class TestShares:
    def test_the_interval_is_wilsons(self) -> None:
        # (p + z²/2n ± z√(p(1 − p)/n + z²/4n²)) / (1 + z²/n) for 8 of 10, z = 1.96
        assert Share(8, 10).interval == pytest.approx((0.4902, 0.9433), abs=1e-4)

    def test_none_of_none_is_no_share(self) -> None:
        assert str(Share(0, 0)) == "–"


class TestTargets:
    @staticmethod
    def lines(first: int, wrong: int) -> dict[str, str]:
        """Return what the table says of 20 tests, so many named right and wrong, the others not at all."""
        verdicts = ["missing"] * (first + wrong) + ["adequate"] * (20 - first - wrong)
        names = ["backlash"] * first + ["offset"] * wrong
        found = [
            {
                "outcome": "judged",
                "kind": "effect",
                "size": 1.0,
                "scatter": "clean",
                "verdict": verdict,
                "twins": ["backlash"],
                "candidates": [{"effect": name, "equals": []}] if name else [],
                "second": {"before": 1.0, "after": 0.21, "oracle": 0.2},
                "readings": 210,
                "seconds": 2.5,
            }
            for verdict, name in zip_longest(verdicts, names)
        ]
        rows = [line.strip("| ").split(" | ") for line in targets(found)]
        return {row[0]: row[-1] for row in rows}

    def test_what_is_reached_is_met(self) -> None:
        found = self.lines(first=20, wrong=0)
        assert found["ρ = 1, clean noise: first"] == "met"
        assert found["ρ = 1, clean noise: mean group"] == "met"
        assert found["error on a second test, ρ = 1, over that of the oracle, median"] == "met"

    def test_what_is_not_reached_is_missed(self) -> None:
        found = self.lines(first=18, wrong=2)
        assert found["ρ = 1, clean noise: first"] == "**missed**"
        assert found["ρ = 1, clean noise: wrong name"] == "**missed**"
        assert found["a diagnosis of some 210 readings, s of one core, median"] == "**missed**"

    def test_of_what_no_test_tells_nothing_is_said(self) -> None:
        assert not any("realistic" in what for what in self.lines(first=20, wrong=0))


class TestFixedPart:
    def test_large_effects_are_first(self, fixed_part: dict[str, records.Record]) -> None:
        found = {each.hidden[0]: fixed_part[each.key] for each in LARGE}
        others = {
            name: record["candidates"] for name, record in found.items() if not outcome(record).is_first
        }
        assert not others

    def test_with_the_effect_a_second_test_is_predicted_as_well_as_by_an_oracle(
        self, fixed_part: dict[str, records.Record]
    ) -> None:
        second = [fixed_part[each.key]["second"] for each in LARGE]
        before, after, oracle = (
            np.array([each[name] for each in second]) for name in ("before", "after", "oracle")
        )
        assert np.all(after < 0.5 * before)
        assert np.median(after / oracle) <= 1.05

    def test_where_nothing_is_hidden_there_is_no_alarm(self, fixed_part: dict[str, records.Record]) -> None:
        assert fixed_part[NOTHING.key]["verdict"] == "adequate"

    def test_a_large_stranger_is_left_without_a_name(self, fixed_part: dict[str, records.Record]) -> None:
        assert fixed_part[STRANGER.key]["verdict"] == "unexplained"


class TestExperiments:
    def test_a_tie_that_the_advised_test_decides_is_counted_as_right(self) -> None:
        tie = Case(Kind.EFFECT, ("reversal-relaxation",), Method.LINEAR, Scatter.REALISTIC, 1.0, 0)
        found = experiments.judged(tie)
        assert found["followed"]["decision"] == "right"
        (row,) = (line for line in of_experiments([found], "state").splitlines() if "| 1 | " in line)
        promised = 100 * found["decides"]
        assert f"| {promised:.0f} | 100.0 (20.7–100.0) |" in row

    def test_the_page_prints_what_the_records_say(self) -> None:
        found = records.read(ROOT / "benchmarks" / "measured" / "experiments.jsonl")
        state = found[-1]["code"]
        page = (ROOT / "docs" / "explanation" / "hidden-effects.md").read_text(encoding="utf-8")
        assert of_experiments(records.of_state(found, state), state) in page


class TestLearned:
    def test_each_test_is_diagnosed_without_and_with_earlier_tests(self) -> None:
        quiet = case("", kind=Kind.NOTHING, method=Method.UNIDIRECTIONAL, scatter=Scatter.REALISTIC, size=0.0)
        assert list(learned.chosen([quiet])) == [(quiet,)]
        found = learned.judged(quiet)
        assert found["without"]["verdict"] == found["with"]["verdict"] == "adequate"
        assert "| false alarms | ≤ 5 % | 1 | 0.0" in learned.report([found], "state")
