"""A diagnosis and a fitted model read the same wherever they are shown; doors only lay the rows out."""

from __future__ import annotations

from dataclasses import replace

from model.hidden_effect import example_diagnosis, example_history
from zlmreport.document.subjects.diagnosis import (
    DiagnosisRows,
    lay_out_diagnosis,
    lay_out_unseen,
    list_hidden,
    list_not_tested,
    make_failure_row,
)
from zlmreport.document.subjects.fit import list_error_facts, make_parameter_rows, make_wave_rows
from zlmreport.model.diagnosis.report import write_verdict_statement
from zlmreport.model.diagnosis.residuals import Failure, ResidualTest
from zlmreport.plugin import STRAIGHTNESS, Language, Words
from zlmreport.plugin.renderer import Paragraph

ENGLISH, GERMAN = Language.ENGLISH, Language.GERMAN


def test_rows_say_the_verdict_and_name_the_candidates_best_first() -> None:
    diagnosis = example_diagnosis()
    rows = DiagnosisRows.of(diagnosis, ENGLISH, {"screw-pitch": Words(en="Pitch", de="Steigung")})
    assert rows.statement == write_verdict_statement(diagnosis).in_language(ENGLISH)
    assert [row.effect for row in rows.candidates] == [each.identifier for each in diagnosis.candidates]
    assert (rows.candidates[0].title, rows.candidates[0].probability) == ("Pitch", "100")
    assert rows.candidates[0].is_serious


def test_remedies_of_positions_are_not_left_to_be_taken_for_those_of_a_straightness() -> None:
    positions = example_diagnosis()
    design = positions.fit.design
    across = replace(design, axis=replace(design.axis, error="EYX", quantity=STRAIGHTNESS))
    for diagnosis, times in (
        (positions, 0),
        (replace(positions, fit=replace(positions.fit, design=across)), 1),
    ):
        (remedy,) = [each for each in lay_out_diagnosis(diagnosis, ENGLISH, {}) if each.key == "remedy"]
        said = [each.text for each in remedy.blocks if isinstance(each, Paragraph)]
        assert len(said) == times
        assert all(
            "no backlash value and no pitch table of this axis removes either" in each for each in said
        )


def test_what_is_extrapolated_says_so_in_the_language_asked_for() -> None:
    for language, word in ((ENGLISH, "(extrapolated)"), (GERMAN, "(extrapoliert)")):
        rows = DiagnosisRows.of(example_diagnosis(), language)
        assert all(row.p.endswith(word) == row.candidate.p_value_is_extrapolated for row in rows.candidates)


def test_effects_that_could_not_be_tried_are_listed_reason_by_reason() -> None:
    diagnosis = example_diagnosis()
    rows = list_not_tested(diagnosis, ENGLISH)
    reasons = [row.reason for row in rows]
    assert len(reasons) == len(set(reasons))
    assert sum(len(row.effects) for row in rows) == len(diagnosis.not_testable)


def test_only_what_the_plan_hides_is_called_hidden() -> None:
    diagnosis = example_diagnosis()
    assert [row.effects for row in list_hidden(diagnosis, ENGLISH)] == [
        (each.effect,) for each in diagnosis.visibility if each.is_hidden
    ]


def test_a_second_joint_beside_the_one_in_the_model_has_the_title_of_the_first() -> None:
    diagnosis = example_diagnosis()
    seen = replace(diagnosis.visibility[0], effect="scale-joint-2")
    title = Words(en="Step at a joint of the scale", de="Sprung")
    (*_, table) = lay_out_unseen(replace(diagnosis, visibility=(seen,)), ENGLISH, {"scale-joint": title})
    assert table.blocks[0].groups[0].rows[0][:2] == ("scale-joint-2", title.en)  # type: ignore[union-attr]


def test_a_condition_that_the_residuals_follow_is_named_in_words() -> None:
    where = Words(en="air_pressure", de="air_pressure")
    failure = Failure(ResidualTest.CONDITION, 0.001, where, where, condition="air_pressure")
    assert make_failure_row(failure, GERMAN).where == "Luftdruck"


def test_error_numbers_have_three_digits_and_their_unit() -> None:
    whole = example_history()[-1]
    error = replace(whole.error, rms=12.345e-6, noise_rms=None)
    pairs = list_error_facts(error, whole.fit.design.axis, GERMAN).pairs
    assert pairs[0] == ("Quadratischer Mittelwert der Abweichungen", "12,3 µm")
    assert "Grundrauschen" not in dict(pairs)


def test_the_number_of_a_parameter_is_the_value_that_is_printed() -> None:
    for row in make_parameter_rows(example_history()[-1].fit, GERMAN):
        assert row.number == float(row.value.replace(",", ".").replace("\N{MINUS SIGN}", "-"))


def test_a_model_without_waves_has_no_rows_of_waves() -> None:
    assert make_wave_rows(example_history()[-1].fit, ENGLISH) == ()
