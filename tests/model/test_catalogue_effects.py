"""An entry of a catalogue is an effect: its forms, its searches, and what it demands of a test."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from model.axis_tests import AXIS, EFFECTS, linear_test
from zlmreport.cli import main
from zlmreport.job.formula import FormulaError
from zlmreport.job.formula_keys import FormulaKeys
from zlmreport.model.effects.catalogue import read_effects_in, read_effects_of_catalogue
from zlmreport.model.effects.formula import FormulaEffect
from zlmreport.plugin import AccessError, AxisKind, InputError, Language
from zlmreport.plugin.effect import Dimension
from zlmreport.testing import full_designs

_UM: dict[str, Any] = {"unit": "um", "range": [-20, 20]}
_DESIGN = linear_test(21, 3)


def _effect(formula: str, **more: Any) -> FormulaEffect:
    return FormulaEffect(FormulaKeys(**{"name": "own", "formula": formula, "parameters": {"a": _UM}, **more}))


def _why(effect: FormulaEffect, design: Any) -> str | None:
    reason = effect.untestable(design)
    return reason.in_language(Language.ENGLISH) if reason else None


def test_wave_is_a_sine_and_a_cosine_of_sizes_of_their_own() -> None:
    wave = _effect("a*D*wave(P/L)", parameters={"a": _UM, "L": {"unit": "mm", "range": [50, 500]}})
    assert [each.name for each in (*wave.linear, *wave.searched)] == ["sine", "cosine", "L"]
    assert [(each.smallest, each.largest) for each in wave.linear] == [(-20e-6, 20e-6)] * 2
    angle = 2 * np.pi * _DESIGN.position / 0.1
    expected = _DESIGN.direction[:, np.newaxis] * np.column_stack([np.sin(angle), np.cos(angle)])
    np.testing.assert_allclose(wave.columns(_DESIGN, np.array([0.1])), expected, atol=1e-12)


@pytest.mark.parametrize(
    "formula",
    [
        "D*wave(P/L)*a*a",
        "a*sin(wave(P/L))",
        "a*wave(P/L)*wave(P/L)",
        "a*L*wave(P/L)/P",
        "a*wave(P/L)+a*wave(2*P/L)",
    ],
)
def test_wave_that_has_not_one_size_is_refused(formula: str) -> None:
    with pytest.raises(FormulaError, match=r"one wave may stand in it|a size to be estimated"):
        _effect(formula, parameters={"a": _UM, "L": {"unit": "mm", "range": [50, 500]}})


def test_harmonics_are_forms_and_a_key() -> None:
    harmonics = {"usual": [1], "tried": [[1], [2], [1, 3]]}
    wave = _effect("a*wave(P/screw_pitch)", harmonics=harmonics)
    assert [len(each.linear) for each in wave.forms()] == [2, 2, 4]
    third = wave.with_settings(wave.options(harmonics=(3,)))
    assert [each.name for each in third.linear] == ["sine_3", "cosine_3"]
    angle = 6 * np.pi * _DESIGN.position / AXIS.screw_pitch
    np.testing.assert_allclose(third.columns(_DESIGN, np.empty(0))[:, 0], np.sin(angle), atol=1e-11)


def test_key_chooses_what_a_name_stands_for() -> None:
    key = {
        "name": "side",
        "description": "The side.",
        "choices": {"up": {"way": "step(D)"}, "down": {"way": "step(-D)"}},
    }
    effect = _effect("a*way", keys=[key])
    up, down = (each.columns(_DESIGN, np.empty(0))[:, 0] for each in effect.forms())
    np.testing.assert_array_equal(up, _DESIGN.direction > 0)
    np.testing.assert_array_equal(down, _DESIGN.direction < 0)
    assert effect.with_settings(effect.options(side="down")).settings == effect.forms()[1].settings


def test_values_that_alone_make_sense_are_all_that_is_tried() -> None:
    ratio = {"values": [1.5, 5, 6]}
    segment = {"unit": "mm", "range": [100, 500], "step": 20}
    of_values = _effect("a*wave(ratio*P/screw_pitch)", parameters={"a": _UM, "ratio": ratio})
    of_steps = _effect("a*floor(P/L)", parameters={"a": _UM, "L": segment})
    np.testing.assert_allclose(of_values.grid(_DESIGN)[:, 0], [1.5, 5, 6])
    np.testing.assert_allclose(of_steps.grid(_DESIGN)[:, 0], np.arange(100, 501, 20) * 1e-3)
    assert not of_values.searched[0].is_refined
    assert not of_steps.searched[0].is_refined


@pytest.mark.parametrize(("name", "is_refined"), [("gear-mesh", False), ("screw-pitch", True)])
def test_between_two_numbers_of_teeth_there_is_none(name: str, is_refined: bool) -> None:
    other = EFFECTS[name].forms()[-1]
    assert other.searched[0].is_refined is is_refined


def test_key_of_the_axis_that_states_a_parameter_ends_its_search() -> None:
    period = {"unit": "mm", "stated": "2*screw_pitch", "search": "wave-length"}
    effect = _effect("a*wave(P/period)", parameters={"a": _UM, "period": period})
    np.testing.assert_allclose(effect.grid(_DESIGN), [[2 * 0.01]])
    assert effect.expected(AXIS) == {"period": pytest.approx(0.02)}
    unstated = replace(_DESIGN, axis=replace(AXIS, screw_pitch=None))
    assert len(effect.grid(unstated)) > 20


@pytest.mark.parametrize(
    ("stated", "sentence"),
    [
        ("pitch", "^pitch is no key of the axis; there are screw_pitch"),
        ("screw_pitch/signal_period", "period is travel, and screw_pitch/signal_period is a number"),
    ],
)
def test_what_states_a_parameter_must_be_made_of_keys(stated: str, sentence: str) -> None:
    period = {"unit": "mm", "stated": stated}
    with pytest.raises(FormulaError, match=sentence):
        _effect("a*wave(P/period)", parameters={"a": _UM, "period": period})


@pytest.mark.parametrize(
    ("formula", "without", "sentence"),
    [
        (
            "a*sin(P/screw_pitch)",
            {"axis": replace(AXIS, screw_pitch=None)},
            "does not state axis.screw_pitch",
        ),
        (
            "a*compensation/P",
            {"axis": replace(AXIS, compensation_table=None)},
            "does not state axis.compensation_table",
        ),
        ("a*air_index", {"conditions": {}}, "no columns air_temperature, air_pressure were"),
        ("a*oil", {}, "no column oil was logged"),
        ("a*t/(100*t + t^2/t)", {"time": np.zeros(len(_DESIGN.time))}, "no time passes"),
        ("a*wave(P/turn)", {}, "for rotary axes only"),
    ],
)
def test_what_stands_in_the_formula_is_needed(formula: str, without: dict[str, Any], sentence: str) -> None:
    found = _why(_effect(formula), replace(_DESIGN, **without))
    assert found is not None
    assert sentence in found


def test_entry_of_a_linear_axis_is_in_angles_on_a_rotary_one() -> None:
    effect = _effect("a*D/2")
    rotary = full_designs()["a complete rotary test"]
    assert effect.untestable(rotary) is None
    assert effect.linear[0].dimension is Dimension.DEVIATION
    np.testing.assert_allclose(effect.columns(rotary, np.empty(0))[:, 0], rotary.direction / 2)


def test_entry_in_arc_seconds_is_for_rotary_axes() -> None:
    turn = _effect("a*wave(P/turn)", parameters={"a": {"unit": "arcsec", "range": [-100, 100]}})
    rotary = full_designs()["a complete rotary test"]
    assert turn.untestable(rotary) is None
    np.testing.assert_allclose(turn.columns(rotary, np.empty(0))[:, 0], np.sin(rotary.position), atol=1e-12)
    assert turn.linear[0].largest == pytest.approx(np.radians(100 / 3600))
    with pytest.raises(FormulaError, match="does not belong to a linear axis"):
        FormulaEffect(turn.keys, AxisKind.LINEAR)


_CATALOGUE = """schema: zlmreport/effects/1
effects:
  - {name: drum, formula: "a*D", parameters: {a: {unit: um, range: [-5, 5]}}}
"""


def test_effects_of_a_file_beside_a_module(tmp_path: Path) -> None:
    (tmp_path / "own.yaml").write_text(_CATALOGUE, encoding="utf-8")
    (effect,) = read_effects_of_catalogue(str(tmp_path / "module.py"), "own.yaml")
    assert effect.identifier == "drum"


def test_file_that_is_not_there_is_told(tmp_path: Path) -> None:
    with pytest.raises(AccessError, match=r"own\.yaml: there is no such catalogue of effects"):
        read_effects_in(tmp_path / "own.yaml")


def test_file_that_changed_is_read_anew(tmp_path: Path) -> None:
    path = tmp_path / "own.yaml"
    path.write_text(_CATALOGUE, encoding="utf-8")
    assert read_effects_in(path)[0].identifier == "drum"
    path.write_text(_CATALOGUE.replace("drum", "horn"), encoding="utf-8")
    assert read_effects_in(path)[0].identifier == "horn"


def test_catalogue_is_a_plugin_file(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = tmp_path / "own.yaml"
    path.write_text(_CATALOGUE, encoding="utf-8")
    assert main(["plugins", "--plugin", str(path)]) == 0
    (line,) = [line for line in capsys.readouterr().out.splitlines() if line.strip().startswith("drum")]
    assert line.split()[-1].endswith("own.yaml")


def test_mistake_in_a_plugin_file_is_told_at_its_line(tmp_path: Path) -> None:
    path = tmp_path / "own.yaml"
    path.write_text(_CATALOGUE.replace("a*D", "b*D"), encoding="utf-8")
    with pytest.raises(
        InputError, match=r"own\.yaml:3:27: effects\.drum\.formula: the parameter a does not stand"
    ):
        read_effects_in(path)
