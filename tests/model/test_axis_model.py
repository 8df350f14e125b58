"""What a model may be, and what is said where it may not."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from model.axis_tests import EFFECTS, USUAL, known, linear_test, model_of
from testing.exemplary_effect import ExemplaryEffect, ExemplaryOptions
from zlmreport.job.effect_choices import EffectChoice
from zlmreport.model.effects.axis_model import AxisModel, Term, choose_terms, refuse_collisions
from zlmreport.model.effects.model_error import ModelError
from zlmreport.model.fitting.fit import fit
from zlmreport.model.fitting.observations import select_readings
from zlmreport.plugin import AxisKind, Place
from zlmreport.plugin.effect import Effect

DESIGN = linear_test(targets=7, runs=3)
READINGS = known(DESIGN)


def _refusal(model: AxisModel) -> tuple[str, ...]:
    with pytest.raises(ModelError) as refused:
        fit(model, DESIGN, READINGS)
    return refused.value.sentences


def test_an_effect_stands_in_a_model_once() -> None:
    assert _refusal(model_of("offset", "backlash", "offset")) == (
        "offset stands in the model 2 times; once is enough",
    )


def test_what_an_effect_contains_does_not_stand_beside_it() -> None:
    (sentence,) = _refusal(model_of("offset", "polynomial"))
    assert sentence == "polynomial contains offset, and no readings part the two; remove offset"


def test_a_value_is_given_for_a_parameter_that_there_is() -> None:
    (sentence,) = _refusal(AxisModel((Term(EFFECTS["backlash"], {"lostmotion": 1e-6}),)))
    assert sentence.startswith("backlash has no parameter 'lostmotion'; did you mean 'lost_motion'?")


def test_an_effect_that_the_test_cannot_show_is_refused_with_what_it_needs() -> None:
    design = replace(DESIGN, conditions={})
    with pytest.raises(ModelError) as refused:
        fit(model_of("offset", "scale-expansion"), design, READINGS)
    (sentence,) = refused.value.sentences
    assert sentence == (
        "scale-expansion cannot be fitted to these readings: "
        "no column axis_temperature was logged beside the readings"
    )


def test_effects_of_the_same_columns_are_named() -> None:
    (sentence,) = _refusal(model_of("offset", "scale-error", "cosine-error", "backlash"))
    assert sentence == "these readings cannot tell scale-error and cosine-error apart; remove one of them"


@pytest.mark.parametrize("first", [0.0, 0.003, 1e-7])
def test_a_wave_of_which_the_targets_see_one_phase_is_refused_and_not_fitted_with_rounding(
    first: float,
) -> None:
    """At whole and half pitches the sine is rounding: it was fitted with thousands of metres."""
    design = linear_test(places=first + 0.025 * np.arange(21))
    screw = EFFECTS["screw-pitch"]
    wave = screw.with_settings(screw.options(harmonics=[1]))
    with pytest.raises(ModelError) as refused:
        fit(model_of("offset", "backlash", wave), design, np.zeros(len(design.position)))
    (sentence,) = refused.value.sentences
    assert sentence == "these readings do not determine all parameters of screw-pitch; remove it"


def test_all_mistakes_are_said_at_once() -> None:
    twice = Term(EFFECTS["polynomial"])
    model = AxisModel((Term(EFFECTS["offset"], {"level": 0.0}), twice, twice))
    assert len(_refusal(model)) == 4


def test_more_parameters_than_readings_are_refused() -> None:
    few = select_readings(DESIGN, np.arange(2))
    with pytest.raises(ModelError, match="3 parameters to estimate and the test 2 readings; measure more"):
        fit(model_of("offset", "scale-error", "datum-temperature"), few, READINGS[:2])
    with pytest.raises(ModelError, match="1 parameter to estimate and the test 1 reading; measure more"):
        fit(model_of("offset"), select_readings(DESIGN, np.arange(1)), READINGS[:1])


def test_an_effect_without_influence_is_named() -> None:
    one_target = select_readings(DESIGN, np.flatnonzero(DESIGN.target == 3))
    still = replace(one_target, position=np.zeros(len(one_target.position)))
    with pytest.raises(ModelError, match="scale-error has no influence on any of these readings"):
        fit(model_of("offset", "scale-error"), still, READINGS[: len(still.position)])


def _polynomial(order: int) -> Effect:
    usual = EFFECTS["polynomial"]
    return usual.with_settings(usual.options(order=order))


def test_adding_a_polynomial_takes_out_what_it_contains() -> None:
    model = model_of("offset", "scale-error", "backlash").with_effect(_polynomial(4))
    assert model.identifiers == ("backlash", "polynomial")


def test_adding_a_higher_order_takes_the_place_of_the_lower() -> None:
    (term,) = (
        term for term in USUAL.with_effect(_polynomial(5)).terms if term.effect.identifier == "polynomial"
    )
    assert len(term.effect.linear) == 6


def _chosen(kind: AxisKind, settings: ExemplaryOptions | None = None, **values: float) -> Term:
    choice = EffectChoice("exemplary-wave", settings or ExemplaryOptions(), values, Place("job.yaml"))
    (chosen,) = choose_terms([choice], lambda _: ExemplaryEffect(), kind)
    return chosen


def test_values_become_metres_on_a_linear_axis() -> None:
    assert _chosen(AxisKind.LINEAR, height=3, wavelength=250).fixed == {"height": 3e-6, "wavelength": 0.25}


def test_values_become_radians_on_a_rotary_axis() -> None:
    values = _chosen(AxisKind.ROTARY, height=3, wavelength=90).fixed
    assert values["height"] == pytest.approx(3 * math.pi / 180 / 3600, rel=1e-14)
    assert values["wavelength"] == pytest.approx(math.pi / 2, rel=1e-14)


def test_effect_is_in_the_form_of_its_settings() -> None:
    chosen = _chosen(AxisKind.LINEAR, ExemplaryOptions(rectified=True))
    assert chosen.effect.settings == ExemplaryOptions(rectified=True)
    assert chosen.fixed == {}


@pytest.mark.parametrize("value", [np.inf, np.nan, 1e200])
def test_columns_that_are_not_finite_are_refused_by_the_name_of_their_effect(value: float) -> None:
    columns = [np.ones((3, 1)), np.array([[0.0], [1.0], [value]])]
    with pytest.raises(ModelError, match=r"^scale-error has no finite value at these readings"):
        refuse_collisions(model_of("offset", "scale-error"), columns)
