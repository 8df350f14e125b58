"""The graph of an axis before and after it was adjusted."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from document.typesetting import samples
from zlmreport.document.figures.layout import lay_out
from zlmreport.document.figures.prescribed import draw_comparison
from zlmreport.plugin import Approach, Evaluation, Figure, Language, Words, read_only_floats
from zlmreport.plugin.standard import Role

NAMES = (Words("as found", "vorher"), Words("as left", "nachher"))


def evaluated(factor: float) -> Evaluation:
    """Evaluate the sample readings, so many times as large."""
    readings = samples.measurements()
    return samples.evaluation(replace(readings, deviation=read_only_floats(factor * readings.deviation)))


@pytest.fixture
def graph() -> Figure:
    return draw_comparison(evaluated(3.0), evaluated(1.0), NAMES)


def test_each_measurement_has_a_panel_of_its_means_in_both_directions(graph: Figure) -> None:
    assert [panel.heading for panel in graph.panels] == list(NAMES)
    for panel, factor in zip(graph.panels, (3.0, 1.0), strict=True):
        mean = 1e6 * evaluated(factor).statistics.mean
        assert [curve.role for curve in panel.curves] == [Role.MEAN_POSITIVE, Role.MEAN_NEGATIVE]
        np.testing.assert_allclose([curve.y for curve in panel.curves], mean, rtol=1e-12)


def test_the_words_for_those_who_cannot_see_it_have_the_ranges_of_both(graph: Figure) -> None:
    text = graph.alternative.in_language(Language.ENGLISH)
    assert text.count("as found, ") == text.count("as left, ") == 2


def test_a_test_in_one_direction_has_one_curve() -> None:
    evaluation = samples.evaluation(samples.measurements(approaches=(Approach.POSITIVE,)))
    graph = draw_comparison(evaluation, evaluation, NAMES)
    assert [len(panel.curves) for panel in graph.panels] == [1, 1]


@pytest.mark.parametrize("language", Language)
def test_a_micrometre_is_as_long_before_as_after(graph: Figure, language: Language) -> None:
    before, after = lay_out(graph, language).panels
    assert before.frame.y_factor == pytest.approx(after.frame.y_factor)
