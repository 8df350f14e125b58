"""What is said of a fitted model: its error, its parameters and its polynomials, in both languages."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from model.axis_tests import EFFECTS, linear_test, model_of, noise
from model.hidden_effect import LAST, example_history, study, written
from zlmreport.document.blocks import write_cell_text
from zlmreport.document.subjects.fit import (
    fit_sections,
    lay_out_parameters,
    list_choices,
    make_parameter_rows,
    write_in_a_sentence,
    write_polynomial,
)
from zlmreport.model.fitting.fit import fit
from zlmreport.plugin import Language
from zlmreport.plugin.renderer import Paragraph, Table

ENGLISH, GERMAN = Language.ENGLISH, Language.GERMAN


def _cells(table: Table, key: str) -> list[str]:
    (number,) = [number for number, column in enumerate(table.columns) if column.key == key]
    return [write_cell_text(row[number]) for group in table.groups for row in group.rows]


def test_sections_are_the_same_in_both_languages(tmp_path: Path) -> None:
    effects = f"    - offset\n    - scale-error\n{LAST}"
    fitted = study(written(tmp_path, (effects, "    - polynomial: {order: 3}\n"))).fit_whole()
    english, german = (fit_sections(fitted, each) for each in (ENGLISH, GERMAN))
    keys = ["error", "model", "polynomials"]
    assert [each.key for each in english] == [each.key for each in german] == keys
    assert not {each.title for each in english} & {each.title for each in german}
    curves = [each.text for each in german[-1].blocks if isinstance(each, Paragraph) and "Δ" in each.text]
    assert [text[:4] for text in curves] == ["Δ↑ =", "Δ↓ =", "Δ un"]
    assert all("." not in text for text in curves)


def test_a_table_of_parameters_without_a_column_keeps_the_others() -> None:
    whole = lay_out_parameters(example_history()[-1].fit, ENGLISH)
    narrow = whole.without("symbol", "value")
    assert [each.key for each in narrow.columns] == [
        each.key for each in whole.columns if each.key not in {"symbol", "value"}
    ]
    for key in ("name", "parameter", "uncertainty", "unit"):
        assert _cells(narrow, key) == _cells(whole, key)


def test_each_parameter_has_its_value_and_its_uncertainty() -> None:
    fit = example_history()[-1].fit
    table = lay_out_parameters(fit, ENGLISH)
    rows = make_parameter_rows(fit, ENGLISH)
    assert _cells(table, "name") == [each.name for each in rows]
    assert _cells(table, "value") == [each.value for each in rows]
    assert _cells(table, "uncertainty") == [each.uncertainty for each in rows]


@pytest.mark.parametrize(
    ("stated", "english", "german"),
    [
        ("lost_motion: -3", "lost_motion −3 µm (given)", "lost_motion −3 µm (vorgegeben)"),
        ("lost_motion: {min: -3}", "lost_motion −3 µm (held at min)", "lost_motion −3 µm (gehalten bei min)"),
    ],
    ids=["given", "held"],
)
def test_a_value_without_uncertainty_says_how_it_is_known(
    tmp_path: Path, stated: str, english: str, german: str
) -> None:
    fit = study(written(tmp_path, (LAST, f"    - backlash: {{{stated}}}\n"))).fit_whole().fit
    for language, expected in ((ENGLISH, english), (GERMAN, german)):
        (row,) = [each for each in make_parameter_rows(fit, language) if each.effect == "backlash"]
        assert write_in_a_sentence(row, language) == expected


def test_a_value_of_which_the_readings_say_nothing_is_not_written() -> None:
    row = replace(make_parameter_rows(example_history()[-1].fit, ENGLISH)[0], uncertainty="∞")
    assert write_in_a_sentence(row, ENGLISH) == f"{row.name} not determined by these readings"


def test_a_sign_of_seconds_touches_the_value_and_follows_both_numbers_of_a_pair() -> None:
    (row,) = [
        each for each in make_parameter_rows(example_history()[-1].fit, ENGLISH) if each.effect == "backlash"
    ]
    said = write_in_a_sentence(replace(row, unit="″"), ENGLISH)
    assert said.startswith(f"lost_motion ({row.value} ± {row.uncertainty})″")
    assert write_in_a_sentence(row, ENGLISH).startswith(f"lost_motion {row.value} ± {row.uncertainty} µm")


def test_a_polynomial_has_the_decimal_sign_of_its_language() -> None:
    powers = [("X", 0), ("X", 1)]
    assert write_polynomial([-0.5, 2e-5], powers, GERMAN) == "−0,5 + 2e−5·X"


def test_the_number_of_a_run_is_a_whole_number() -> None:
    design = linear_test(11, 4)
    displaced = fit(model_of("offset", "run-displaced"), design, 5e-6 * (design.run == 2) + noise(design))
    (row,) = (each for each in make_parameter_rows(displaced, GERMAN) if each.name == "which")
    assert (row.value, row.uncertainty, row.number) == ("2", "0", 2.0)


def test_an_effect_that_acts_otherwise_than_usual_says_how() -> None:
    usual, in_the_reversal, *_ = EFFECTS["worn-zone"].forms()
    assert (list_choices(usual), list_choices(in_the_reversal)) == ((), ("acts_on: reversal",))
    design = linear_test()
    near = np.exp(-(((design.position - 0.5) / 0.1) ** 2))
    fitted = fit(model_of("offset", in_the_reversal), design, 4e-6 * design.direction * near + noise(design))
    headings = [each.heading for each in lay_out_parameters(fitted, ENGLISH).groups]
    assert headings == ["offset: Zero offset", "worn-zone (acts_on: reversal): Worn zone of the screw"]
