"""Bounds of parameters, and links between them, beside what they come to by hand."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from model.axis_tests import EFFECTS, PITCH, linear_test, noise
from model.hidden_effect import LAST, study, written
from refusals import refused
from zlmreport.document.subjects.fit import lay_out_parameters
from zlmreport.job.formula_keys import FormulaKeys
from zlmreport.model.effects.axis_model import AxisModel, Term
from zlmreport.model.effects.formula import FormulaEffect
from zlmreport.model.fitting.fit import fit
from zlmreport.plugin import AxisKind, Language
from zlmreport.plugin.effect import report_model

SLOPE = "    - scale-error\n"


def _model(folder: Path, *changes: tuple[str, str]) -> AxisModel:
    return study(written(folder, *changes)).model


def _refused(folder: Path, *changes: tuple[str, str]) -> str:
    found = refused(lambda: study(written(folder, *changes)).fit_whole())
    return " ".join(str(each) for each in found.problems)


def test_bounds_of_a_job_are_in_si(tmp_path: Path) -> None:
    term = _model(tmp_path, (LAST, "    - backlash: {lost_motion: {min: -5, max: 2}}\n")).terms[-1]
    assert term.bounds["lost_motion"] == (pytest.approx(-5e-6), pytest.approx(2e-6))
    assert not term.fixed


def test_an_estimate_within_its_bounds_is_as_without(tmp_path: Path) -> None:
    free = study(written(tmp_path)).fit_whole().fit
    bounded = study(written(tmp_path, (SLOPE, "    - scale-error: {slope: {min: -1000, max: 1000}}\n")))
    np.testing.assert_allclose(bounded.fit_whole().fit.fitted, free.fitted, rtol=1e-12)


def test_an_estimate_beyond_its_bound_is_held_there(tmp_path: Path) -> None:
    bounded = study(written(tmp_path, (LAST, "    - backlash: {lost_motion: {min: -3}}\n")))
    within = bounded.fit_whole().fit
    given = study(written(tmp_path, (LAST, "    - backlash: {lost_motion: -3}\n"))).fit_whole().fit
    np.testing.assert_allclose(within.fitted, given.fitted, rtol=1e-12)
    (estimate,) = [each for each in within.estimates if each.effect == "backlash"]
    assert (estimate.value, estimate.at_bound, estimate.is_given) == (pytest.approx(-3e-6), "min", False)
    reported = report_model(within)["parameters"][-1]
    assert (reported["given"], reported["at_bound"]) == (False, "min")
    assert "held at min" in str(lay_out_parameters(within, Language.ENGLISH))


def test_a_searched_parameter_stays_within_its_bounds() -> None:
    design = linear_test()
    deviation = 5e-6 * np.sin(2 * np.pi * design.position / 0.2) + noise(design)
    free = fit(AxisModel((Term(EFFECTS["periodic"]),)), design, deviation)
    bounded = fit(AxisModel((Term(EFFECTS["periodic"], bounds={"period": (0.21, 0.3)}),)), design, deviation)
    assert free.estimates[-1].value == pytest.approx(0.2, rel=1e-2)
    assert bounded.estimates[-1].value == pytest.approx(0.21, rel=1e-9)


def test_coefficients_that_are_equal_have_one_column() -> None:
    design = linear_test()
    deviation = noise(design) + 3e-6
    linked = Term(EFFECTS["backlash"], links={"lost_motion": ("offset", "offset")})
    found = fit(AxisModel((Term(EFFECTS["offset"]), linked)), design, deviation)
    backlash = EFFECTS["backlash"].columns(design, np.empty(0))[:, 0]
    together = 1.0 + backlash
    # noise of this test: the fit weighs readings; so its own noise parts are left out of the comparison
    offset, lost_motion = found.estimates
    assert lost_motion.value == offset.value
    assert lost_motion.equals == "offset.offset"
    np.testing.assert_allclose(found.fitted, offset.value * together, rtol=1e-12)
    assert found.degrees == len(deviation) - 1


def _wave(name: str, formula: str, **parameters: dict[str, object]) -> FormulaEffect:
    keys = FormulaKeys.model_validate({"name": name, "formula": formula, "parameters": parameters})
    return FormulaEffect(keys, AxisKind.LINEAR)


def test_two_waves_of_one_period_are_the_wave_that_has_both() -> None:
    design = linear_test()
    length = {"unit": "mm", "range": [150, 260]}
    size = {"unit": "um"}
    one = _wave("one", "a*sin(2*pi*P/L)", a=size, L=length)
    two = _wave("two", "b*D*sin(2*pi*P/L)", b=size, L=length)
    both = _wave("both", "a*sin(2*pi*P/L) + b*D*sin(2*pi*P/L)", a=size, b=size, L=length)
    wave = np.sin(2 * np.pi * design.position / 0.2)
    deviation = 5e-6 * wave + 2e-6 * design.direction * wave + noise(design)
    linked = fit(AxisModel((Term(one), Term(two, links={"L": ("one", "L")}))), design, deviation)
    alone = fit(AxisModel((Term(both),)), design, deviation)
    by_name = {(each.effect, each.parameter.name): each for each in linked.estimates}
    length_found = by_name["one", "L"]
    assert by_name["two", "L"].value == length_found.value
    assert length_found.value == pytest.approx(alone.estimates[-1].value, rel=1e-7)
    assert length_found.standard_uncertainty == pytest.approx(
        alone.estimates[-1].standard_uncertainty, rel=1e-3
    )
    assert linked.degrees == alone.degrees
    np.testing.assert_allclose(linked.fitted, alone.fitted, atol=1e-12)
    assert length_found.value > PITCH


@pytest.mark.parametrize(
    ("limits", "message"),
    [
        ("{min: 3, max: 1}", "min must be less than max"),
        ("{min: 3, equals: offset.offset}", "either min or max"),
        ("{least: 3}", "least"),
        ("{equals: nothing}", "equals"),
        ("{equals: abbe.height}", "abbe is no other effect of the model"),
        ("{equals: offset.offzet}", "did you mean 'offset'"),
        ("{equals: scale-error.slope}", "different quantities"),
        ("{equals: backlash.lost_motion}", "no other effect"),
    ],
)
def test_limits_that_make_no_sense_are_refused_where_they_stand(
    tmp_path: Path, limits: str, message: str
) -> None:
    said = _refused(tmp_path, (LAST, f"    - backlash: {{lost_motion: {limits}}}\n"))
    assert message in said
    assert "job.yaml:26:" in said or "job.yaml:25:" in said


def test_a_parameter_that_equals_another_itself_is_none_to_be_linked_to(tmp_path: Path) -> None:
    linked = ("    - offset\n", "    - offset: {offset: {equals: backlash.lost_motion}}\n")
    said = _refused(tmp_path, linked, (LAST, "    - backlash: {lost_motion: {equals: offset.offset}}\n"))
    assert (
        "offset cannot have offset equal to backlash.lost_motion, which equals another itself; link" in said
    )
