"""Statements of conformity on the page."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import Any

import pytest

from document.certificate.documents import COMPLETE, certificate, lines_of
from zlmreport.document.certificate import conformity
from zlmreport.document.writer import write_with_uncertainty
from zlmreport.job.evaluation_keys import DecisionRuleKeys
from zlmreport.plugin import MICROMETRE_PER_METRE, Evaluation, Language
from zlmreport.plugin.renderer import Graph, Table, Writer
from zlmreport.plugin.standard import decided, decision_rule


@pytest.fixture(scope="module")
def evaluation(tmp_path_factory) -> Evaluation:
    """A and E of a real axis, with limits; U = 3 µm and k = 2 put in by hand."""
    found = certificate(tmp_path_factory.mktemp("job")).evaluations[0]
    parameters = tuple(
        replace(each, expanded_uncertainty=3e-6, coverage_factor=2.0) for each in found.parameters
    )
    return replace(found, parameters=parameters)


def rows(evaluation: Evaluation, rule: str, language: Language = Language.ENGLISH) -> list[str]:
    writer = Writer.of(evaluation.measurements, language)
    _, table = conformity.lay_out_conformity(decided(evaluation, decision_rule(rule)), writer)
    assert isinstance(table, Table)
    return [line.strip() for line in lines_of(table)[2:]]


def paragraph(evaluation: Evaluation, keys: Mapping[str, Any], language: Language = Language.ENGLISH) -> str:
    writer = Writer.of(evaluation.measurements, language)
    (found,) = conformity.say_rule(DecisionRuleKeys.model_validate(keys), [evaluation], writer)
    return found.text


def test_a_guarded_limit_is_printed_with_the_limit_up_to_which_it_is_accepted(evaluation):
    first = rows(evaluation, "guard-band")[0].split(" | ")

    assert first[0] == "A"
    assert (first[2], first[3]) == ("150", "147.0")  # one decimal: that of U = 3.0 µm


def test_an_amount_has_the_digits_that_it_has_in_the_table_of_results(evaluation):
    writer = Writer.of(evaluation.measurements, Language.ENGLISH)
    found = evaluation.parameter("A")
    assert found is not None

    assert rows(evaluation, "guard-band")[0].split(" | ")[1] == write_with_uncertainty(found, writer)[0]


@pytest.mark.parametrize(
    ("rule", "limit", "printed"),
    [
        ("guard-band", 128.69, ("125.71", "125.69", "does not conform")),  # U = 3.0 µm: both are 125.7 µm
        ("simple", 125.7124, ("125.713", "125.7124", "does not conform")),
        ("simple", 125.7, ("125.71", "125.7", "does not conform")),
        ("simple", 125.72, ("125.7", "125.72", "conforms")),
    ],
)
def test_an_amount_that_is_not_accepted_is_not_printed_as_what_is(evaluation, rule, limit, printed):
    parameters = [
        replace(each, limit=limit * 1e-6) if each.quantity.symbol == "A" else each
        for each in evaluation.parameters
    ]
    cells = rows(replace(evaluation, parameters=tuple(parameters)), rule)[0].split(" | ")
    assert (cells[1], cells[3]) == printed[:2]
    assert cells[4].endswith(printed[2])


def test_an_acceptance_limit_is_explained_where_one_is_drawn(evaluation):
    writer = Writer.of(evaluation.measurements, Language.ENGLISH)
    captions = {}
    for rule in ("simple", "guard-band"):
        graph, _ = conformity.lay_out_conformity(decided(evaluation, decision_rule(rule)), writer)
        assert isinstance(graph, Graph)
        captions[rule] = graph.figure.title.in_language(Language.ENGLISH)

    assert "acceptance limit" in captions["guard-band"]
    assert "acceptance limit" not in captions["simple"]


def test_simple_acceptance_accepts_up_to_the_limit(evaluation):
    assert rows(evaluation, "simple")[0].split(" | ")[2:4] == ["150", "150"]


def test_what_is_stated_is_written_with_its_risk(evaluation):
    tight = tuple(
        replace(each, limit=each.value + 1e-6) if each.quantity.symbol == "A" else each
        for each in evaluation.parameters
    )
    of_a = rows(replace(evaluation, parameters=tight), "non-binary")[0].split(" | ")

    # 1 µm below the limit with u = 1.5 µm: beyond it with the probability of 0.667 standard deviations.
    assert of_a[4:] == ["conforms, conditionally", "25.2"]


def test_a_risk_that_rounds_to_nothing_is_small_and_not_none(evaluation):
    wide = tuple(replace(each, limit=1e-3 if each.limit else None) for each in evaluation.parameters)

    assert rows(replace(evaluation, parameters=wide), "guard-band")[0].endswith("| conforms | < 0.1")


def test_an_evaluation_without_limits_states_nothing(evaluation):
    bare = replace(evaluation, parameters=tuple(replace(each, limit=None) for each in evaluation.parameters))
    writer = Writer.of(evaluation.measurements, Language.ENGLISH)

    assert list(conformity.lay_out_conformity(bare, writer)) == []
    assert list(conformity.say_rule(DecisionRuleKeys(), [bare], writer)) == []


@pytest.mark.parametrize(
    ("keys", "sentence"),
    [
        ({"rule": "simple"}, "reaches 50 %"),
        ({"rule": "guard-band"}, "guard band w = U."),
        ({"rule": "guard-band"}, "wrong acceptance is at most 2.3 %"),
        ({"rule": "guard-band", "guard_band_factor": 0.5}, "guard band w = 0.5·U."),
        ({"rule": "guard-band", "guard_band_factor": 0.5}, "wrong acceptance is at most 15.9 %"),
        ({"rule": "iso14253-1"}, "at most 5 %"),
        ({"rule": "non-binary"}, "wrong statement is at most 2.3 %"),
    ],
)
def test_the_rule_is_stated_with_its_risk(evaluation, keys, sentence):
    assert sentence in paragraph(evaluation, keys)


def test_the_rule_is_stated_in_german(evaluation):
    said = paragraph(evaluation, {"rule": "guard-band", "guard_band_factor": 0.5}, Language.GERMAN)

    assert "Schutzabstand w = 0,5·U" in said
    assert "höchstens 15,9 %" in said


def test_a_rule_without_the_uncertainty_that_it_needs_says_so(evaluation):
    bare = tuple(replace(each, expanded_uncertainty=None) for each in evaluation.parameters)

    assert "not decided" in paragraph(replace(evaluation, parameters=bare), {"rule": "guard-band"})


def test_the_graph_shows_amount_uncertainty_and_acceptance_in_percent_of_the_limit(evaluation):
    writer = Writer.of(evaluation.measurements, Language.ENGLISH)
    graph, _ = conformity.lay_out_conformity(decided(evaluation, decision_rule("guard-band")), writer)
    assert isinstance(graph, Graph)
    bar = graph.figure.panels[0].bars[0]
    value = evaluation.value("A")
    assert value is not None

    assert bar.y == pytest.approx(100 * value / 150e-6, rel=1e-12)
    assert bar.uncertainty == pytest.approx(100 * 3 / 150, rel=1e-12)
    assert bar.accepted == pytest.approx(100 * 147 / 150, rel=1e-12)
    assert graph.figure.panels[0].levels[0].y == 100.0


def test_without_any_uncertainty_there_is_a_graph_and_no_table_of_risks(evaluation):
    bare = tuple(replace(each, expanded_uncertainty=None) for each in evaluation.parameters)
    writer = Writer.of(evaluation.measurements, Language.ENGLISH)
    (graph,) = conformity.lay_out_conformity(replace(evaluation, parameters=bare), writer)

    assert isinstance(graph, Graph)
    assert "±" not in graph.figure.title.in_language(Language.ENGLISH)


def test_the_graph_is_told_to_those_who_cannot_see_it(evaluation):
    writer = Writer.of(evaluation.measurements, Language.ENGLISH)
    graph, _ = conformity.lay_out_conformity(decided(evaluation, decision_rule("guard-band")), writer)
    assert isinstance(graph, Graph)

    told = graph.figure.alternative.in_language(Language.ENGLISH)
    assert "of its limit ± 2.0 %, accepted up to 98.0 %." in told


def test_the_job_states_the_rule_by_its_name_or_with_its_factor(tmp_path):
    keys = {**COMPLETE, "decision_rule": {"rule": "guard-band", "guard_band_factor": 0.5}}
    document = certificate(tmp_path, keys)

    assert any("0.5·U" in line for block in document.cover for line in lines_of(block))


def test_where_nothing_is_accepted_the_word_has_no_unit(evaluation):
    """A guard band that is wider than its limit, of a parameter whose unit stands beside its number."""
    parameters = tuple(
        replace(each, quantity=replace(each.quantity, unit=MICROMETRE_PER_METRE), expanded_uncertainty=200e-6)
        for each in evaluation.parameters
    )
    first = rows(replace(evaluation, parameters=parameters), "guard-band")[0].split(" | ")
    assert first[2:4] == ["150 µm/m", "none"]
