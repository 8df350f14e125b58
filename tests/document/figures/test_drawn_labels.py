"""What is written in a drawing: in the document's language, as the standard prints it, without collisions."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from document.figures.samples import ALL, ORDINARY, both_directions, collisions, drawn, each_direction, figure
from zlmreport.document.figures.figure import Bar
from zlmreport.document.figures.layout import write_axis_title
from zlmreport.plugin import Figure, Language, Words, same_in_all_languages
from zlmreport.plugin.page import FontFace, figure_size
from zlmreport.plugin.standard import Panel

by_name = pytest.mark.parametrize("sample", ALL.values(), ids=ALL.keys())


def _texts(language: Language, kind: str) -> list[str]:
    return [text.text for text in drawn(figure(both_directions()), language).texts_of(kind)]


def test_axis_titles_have_their_units_in_english() -> None:
    assert _texts(Language.ENGLISH, "title") == ["Target position in mm", "Deviation in µm"]


def test_axis_titles_have_their_units_in_german() -> None:
    assert _texts(Language.GERMAN, "title") == ["Sollposition in mm", "Abweichung in µm"]


def test_negative_numbers_have_a_minus_sign() -> None:
    assert "−4" in _texts(Language.ENGLISH, "tick y")


@pytest.mark.parametrize(("language", "number"), [(Language.ENGLISH, "0.0002"), (Language.GERMAN, "0,0002")])
def test_decimals_follow_the_sign_of_the_language(language: Language, number: str) -> None:
    canvas = drawn(ALL["a nanometre"], language)
    assert number in [text.text for text in canvas.texts_of("tick y")]


def test_positions_are_written_at_the_targets() -> None:
    assert _texts(Language.ENGLISH, "tick x") == ["0", "250", "500", "750", "1000"]


def test_very_many_targets_are_counted_in_round_steps() -> None:
    texts = [text.text for text in drawn(ORDINARY["200 targets"]).texts_of("tick x")]
    assert texts[:3] == ["0", "200", "400"]


def test_only_the_lowest_panel_writes_the_positions() -> None:
    canvas = drawn(figure(*each_direction()))
    assert [text.text for text in canvas.texts_of("tick x")] == ["0", "250", "500", "750", "1000"]


def test_panels_have_their_headings_in_the_language() -> None:
    canvas = drawn(figure(*each_direction()), Language.GERMAN)
    assert [text.text for text in canvas.texts_of("heading")] == ["Richtung ↑", "Richtung ↓"]


def test_a_legend_names_every_symbol_once() -> None:
    assert _texts(Language.ENGLISH, "legend") == [
        "x̄i↑",
        "x̄i↓",
        "x̄i",
        "x̄i↑ ± 2si↑",
        "x̄i↓ ± 2si↓",
        "single readings ↑ ↓",
    ]


def test_a_curve_without_a_symbol_is_not_in_the_legend() -> None:
    panel = both_directions()
    nameless = replace(panel.curves[0], notation="")
    canvas = drawn(figure(replace(panel, curves=(nameless,), bands=(), readings=())))
    assert canvas.texts_of("legend") == []


def test_the_readings_are_named_in_german() -> None:
    assert _texts(Language.GERMAN, "legend")[-1] == "Einzelmesswerte ↑ ↓"


def test_a_symbol_is_set_in_italics_and_subscript() -> None:
    label = drawn(figure(both_directions())).texts_of("legend")[0]
    assert [(run.text, run.face) for run in label.runs] == [
        ("x̄", FontFace.ITALIC),
        ("i", FontFace.ITALIC),
        ("↑", FontFace.REGULAR),
    ]
    letter, index, arrow = label.runs
    assert index.size < letter.size == arrow.size
    assert index.y > letter.y == arrow.y


def test_a_bar_named_by_a_symbol_has_it_as_a_table_has_it() -> None:
    named = Bar(same_in_all_languages("P_{s max}"), 80.0, same_in_all_languages("80.0"), is_symbol=True)
    words = Bar(same_in_all_languages("a word"), 60.0, same_in_all_languages("60.0"))
    symbol, plain = drawn(figure(Panel(bars=(named, words)))).texts_of("tick x")
    assert [(run.text, run.face) for run in symbol.runs] == [
        ("P", FontFace.ITALIC),
        ("s max", FontFace.REGULAR),
    ]
    assert [(run.text, run.face) for run in plain.runs] == [("a word", FontFace.REGULAR)]


def test_the_runs_of_a_symbol_follow_one_another_without_overlap() -> None:
    label = drawn(figure(both_directions())).texts_of("legend")[3]
    assert [run.x for run in label.runs] == sorted(run.x for run in label.runs)


def test_the_title_of_the_values_reads_upwards() -> None:
    _, y_title = drawn(figure(both_directions())).texts_of("title")
    assert y_title.angle == 90.0


def test_a_long_title_of_the_values_stays_inside_a_low_graph() -> None:
    long = replace(
        figure(both_directions()),
        y_title=same_in_all_languages("Slope of the residuals of a pass"),
        height=50,
    )
    _, y_title = drawn(long).texts_of("title")
    _, height = figure_size(long)
    assert 0 < y_title.box.bottom < y_title.box.top < height


def test_names_of_one_line_leave_no_second_line_free_below_them() -> None:
    def gap(*names: str) -> float:
        bars = tuple(Bar(same_in_all_languages(name), 80.0, same_in_all_languages("80.0")) for name in names)
        canvas = drawn(figure(Panel(bars=bars)))
        x_title, _ = canvas.texts_of("title")
        return x_title.box.bottom - max(each.box.top for each in canvas.texts_of("tick x"))

    assert gap("backlash", "offset") == pytest.approx(gap(*["spindle-temperature"] * 6), abs=1.0)


@by_name
@pytest.mark.parametrize("language", Language)
def test_labels_stay_inside_and_off_each_other_and_off_lines(sample: Figure, language: Language) -> None:
    assert not collisions(sample, language)


def test_no_extension_line_runs_through_the_label_of_a_bracket() -> None:
    canvas = drawn(figure(both_directions()))
    (extensions,) = canvas.of("extension")
    for text in canvas.texts_of("bracket"):
        for part in extensions.parts:
            if part[:, 0].min() < text.box.left < part[:, 0].max():
                assert not text.box.bottom < part[0, 1] < text.box.top, text


@by_name
def test_everything_drawn_is_finite_and_inside(sample: Figure) -> None:
    width, height = figure_size(sample)
    for outline in drawn(sample).outlines:
        assert np.isfinite(outline.points).all(), outline
        assert outline.points.min() >= 0, outline
        assert outline.points[:, 0].max() <= width, outline
        assert outline.points[:, 1].max() <= height, outline


def _beside_temperatures() -> Figure:
    """Return a figure whose second panel shows a temperature."""
    first, second = each_direction()
    return figure(first, replace(second, y_title=same_in_all_languages("Temperature"), y_unit="°C"))


def test_a_panel_of_another_quantity_has_its_own_title() -> None:
    titles = drawn(_beside_temperatures()).texts_of("title")
    assert [each.text for each in titles] == ["Target position in mm", "Deviation in µm", "Temperature in °C"]


@pytest.mark.parametrize("is_wide", [False, True])
def test_titles_of_several_quantities_do_not_meet(*, is_wide: bool) -> None:
    of = replace(_beside_temperatures(), is_wide=is_wide, height=120.0)
    first, second = (each.runs[0] for each in drawn(of).texts_of("title")[1:])
    assert abs(first.x - second.x) > 50 or abs(first.y - second.y) > 50


def test_an_axis_names_a_unit_that_is_but_a_small_sign() -> None:
    titles = [
        write_axis_title(same_in_all_languages("Deviation"), unit, Language.ENGLISH)
        for unit in ("″", "°", "µm")
    ]
    assert titles == ["Deviation in ″ (arcsec)", "Deviation in ° (deg)", "Deviation in µm"]


def test_an_axis_has_its_unit_in_the_words_of_its_language() -> None:
    titles = {
        each.value: write_axis_title(Words("Deviation"), "µm", each).removesuffix("µm") for each in Language
    }
    assert titles == {
        "en": "Deviation in ",
        "de": "Abweichung in ",
        "fr": "Écart en ",
        "it": "Scostamento in ",
        "es": "Desviación en ",
    }
