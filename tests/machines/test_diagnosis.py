from dataclasses import replace

import numpy as np
import pytest

from machines.simulated import (
    MICRO,
    Scatter,
    added,
    bare_machine,
    circle,
    lagging,
    nothing,
    out_of_square,
    straight_curve,
    unequal_scales,
    with_deviation,
    with_lost_motion,
    with_play,
)
from zlmreport.machines.choosing import study_circles
from zlmreport.machines.contest import make_nameless_curves
from zlmreport.machines.diagnosis import diagnose
from zlmreport.machines.diagnosis_report import build_values, collect_diagnosis
from zlmreport.model.diagnosis.diagnosis import DiagnosisVerdict
from zlmreport.plugin.registry import find_plugins

REGISTRY = find_plugins()
CATALOGUE = REGISTRY.circle_effects
BASE = ("centre-offset", "radius")


def diagnosed(*circles, effects=BASE, machine=None):
    chosen = [REGISTRY.circle_effect(name) for name in effects]
    return diagnose(study_circles(machine or bare_machine(), circles, chosen), CATALOGUE)


CAUSES = {
    "squareness": (out_of_square(12 * MICRO), "C0Y", 12 * MICRO),
    "scale-mismatch": (unequal_scales(9 * MICRO, -6 * MICRO), "X-Y", 15 * MICRO),
    "servo-mismatch": (lagging(0.0, 0.3e-3), "T_X-T_Y", -0.3e-3),
    "circle-backlash": (with_lost_motion(5 * MICRO, 0.0), "X", 5 * MICRO),
    "over-compensation": (with_lost_motion(0.0, -5 * MICRO), "Y", -5 * MICRO),
    "lateral-play": (with_play(0.0, 4 * MICRO), "Y", 4 * MICRO),
}


@pytest.mark.long
@pytest.mark.parametrize(
    ("name", "plane"),
    [*((name, "XY") for name in CAUSES), *(("squareness", plane) for plane in ("YZ", "ZX")),
     *(("circle-backlash", plane) for plane in ("YZ", "ZX"))],
)  # fmt: skip
def test_a_hidden_cause_is_named_and_measured(name, plane):
    move, parameter, value = CAUSES[name]
    found = diagnosed(circle(move, seed=3, plane=plane))
    assert found.verdict is DiagnosisVerdict.MISSING
    assert found.found == (name,)
    axes = dict(zip("XYZ", plane + "?", strict=True))
    square = {"XY": ("C0Y", 1), "YZ": ("A0Z", 1), "ZX": ("B0Z", -1)}[plane]
    estimates = {each.name: each for each in found.complete.estimates if each.effect == name}
    if parameter == "C0Y":
        parameter, value = square[0], value * square[1]
    elif "-" in parameter:
        prefix, first, second = (
            ("T_", axes["X"], axes["Y"]) if "T_" in parameter else ("", axes["X"], axes["Y"])
        )
        value = value if first < second else -value
        first, second = sorted((first, second))
        parameter = f"{prefix}{first}-{prefix}{second}"
    else:
        parameter = axes[parameter]
    own = estimates[parameter]
    assert own.value == pytest.approx(value, abs=1.6 * own.expanded_uncertainty)
    assert own.expanded_uncertainty < 0.5 * abs(value)


@pytest.mark.long
def test_a_healthy_machine_raises_few_alarms():
    alarms = sum(
        diagnosed(circle(nothing, seed=seed)).verdict is not DiagnosisVerdict.ADEQUATE for seed in range(8)
    )
    assert alarms <= 2


def test_two_causes_are_found_beside_each_other():
    both = added(lagging(0.0, 0.4e-3), unequal_scales(20 * MICRO, 0.0))
    found = diagnosed(circle(both, seed=2, repeats=2))
    assert set(found.found) == {"servo-mismatch", "scale-mismatch"}
    assert found.remainder is None


def test_in_one_sense_squareness_and_servo_mismatch_are_one_thing():
    found = diagnosed(circle(out_of_square(20 * MICRO), seed=2, senses=(1,)))
    values = collect_diagnosis(found, (), ())
    assert found.verdict is DiagnosisVerdict.MISSING
    assert found.found == ()
    first = values["candidates"][0]
    assert {first["effect"], *first["indistinguishable_from"]} >= {"squareness", "servo-mismatch"}
    assert "other sense" in first["discriminate_by"]
    assert "cannot tell them apart" in values["statement"]


@pytest.mark.parametrize("senses", [(1,), (1, -1)])
def test_what_tied_effects_do_is_no_noise(senses):
    """With one sense nothing is added, but the noise is what either of the effects would leave."""
    found = diagnosed(circle(out_of_square(60 * MICRO), seed=2, senses=senses, count=120, noise=0.2 * MICRO))
    values = collect_diagnosis(found, (), ())
    assert found.is_tied == (senses == (1,))
    assert values["error"]["noise_rms"] == pytest.approx(0.2, rel=0.35)
    assert values["error"]["noise_rms"] == pytest.approx(values["candidates"][0]["rms_after"], rel=0.35)


@pytest.mark.parametrize("seed", range(2))
def test_five_lobes_are_nobodys(seed):
    plain = circle(nothing, seed=seed)
    found = diagnosed(with_deviation(plain, 1.5 * MICRO * np.cos(5 * plain.angle + seed)))
    assert found.verdict is DiagnosisVerdict.UNEXPLAINED
    assert found.found == ()
    assert found.remainder is not None


def test_the_uncertainty_of_what_is_in_the_model_holds_a_curve_that_has_no_name():
    """A bump stands beside a squareness in the model."""
    seen = circle(out_of_square(12 * MICRO), seed=4)
    bump = np.exp(-0.5 * ((seen.angle % (2 * np.pi) - 0.8) / 0.35) ** 2)
    effects = [REGISTRY.circle_effect(name) for name in (*BASE, "squareness")]
    study = study_circles(bare_machine(), [with_deviation(seen, 3 * MICRO * bump)], effects)
    found = diagnose(study, [REGISTRY.circle_effect(name) for name in ("scale-mismatch", "servo-mismatch")])
    assert (found.verdict, found.found) == (DiagnosisVerdict.UNEXPLAINED, ())
    bare, held = (each.list_estimates_of("squareness")[0] for each in (study, found.complete))
    assert held.expanded_uncertainty > 1.3 * bare.expanded_uncertainty
    assert found.study is found.complete


def test_beside_curves_without_a_name_parameters_lie_within_their_uncertainty():
    """The curves are drawn as they are taken to be: of 40 values some 38 lie within."""
    random = np.random.default_rng(5)
    effects = [REGISTRY.circle_effect(name) for name in (*BASE, "squareness")]
    plain = study_circles(bare_machine(), [circle(nothing, seed=4, count=90, noise=0.3 * MICRO)], effects)
    curve = 2.0 * make_nameless_curves(plain.design)[0].columns
    misses = {False: [], True: []}
    for _ in range(40):
        drawn = 0.3 * MICRO * curve @ random.standard_normal(curve.shape[1])
        study = replace(plain, deviation=plain.deviation + drawn)
        for is_held, each in ((False, study), (True, replace(study, unnamed=0.3 * MICRO * curve))):
            own = each.list_estimates_of("squareness")[0]
            misses[is_held].append(abs(own.value) / own.expanded_uncertainty)
    assert np.mean(np.array(misses[True]) <= 1) >= 0.9
    assert np.mean(np.array(misses[False]) <= 1) < 0.8


@pytest.mark.parametrize("length", [10.0, 20.0])
def test_the_correlation_length_of_irregular_geometry_is_found(length):
    sizes = Scatter(0.76, 0.0, 0.65, geometry_length=length)
    seen = circle(nothing, seed=2, repeats=2, scatter=sizes)
    effects = [REGISTRY.circle_effect(name) for name in BASE]
    found = study_circles(bare_machine(), [seen], effects).noise
    assert np.degrees(found.likeliest.length) == pytest.approx(length)


@pytest.mark.parametrize("decay", [11.0, 19.0])
def test_an_oscillation_between_two_values_of_the_grid_is_named(decay):
    """What is many times the noise shows decay and length to a part of a step of the grid."""
    plain = circle(nothing, seed=6)
    since = np.degrees((plain.sense * plain.angle) % np.pi)
    wave = np.exp(-since / decay) * np.sin(2 * np.pi * since / 12.2)
    found = diagnosed(with_deviation(plain, 6 * MICRO * wave))
    assert found.found == ("stick-slip",)
    values = {each.name: each for each in found.complete.estimates if each.effect == "stick-slip"}
    for name, true in (("decay", np.radians(decay)), ("length", np.radians(12.2))):
        assert abs(values[name].value - true) < 1.5 * values[name].expanded_uncertainty


def test_the_axes_uncertainty_is_no_missing_effect():
    """Scales known to ± 40 µm/m cannot show that they differ by 15 µm/m."""
    curves = [straight_curve("EXX", 0.5), straight_curve("EYY", 0.5)]
    unsure = [
        type(each)(each.name, each.nodes, each.values, 20e-6 * each.nodes[:, np.newaxis], each.line, "x")
        for each in curves
    ]
    seen = circle(unequal_scales(9 * MICRO, -6 * MICRO), seed=3)
    assert diagnosed(seen, machine=bare_machine(curves)).found == ("scale-mismatch",)
    assert diagnosed(seen, machine=bare_machine(unsure)).verdict is DiagnosisVerdict.ADEQUATE


def test_two_feeds_tell_cross_talk_from_squareness():
    def bending(path):
        acceleration = -(path.du**2 + path.dv**2) * path.u / (path.u**2 + path.v**2)
        return 0 * path.u, -2e-5 * acceleration

    slow = circle(bending, seed=1, feed=2 / 60, name="slow")
    fast = circle(bending, seed=2, feed=16 / 60, name="fast")
    found = diagnosed(slow, fast)
    assert found.found[:1] == ("dynamic-cross-talk",)


def test_the_steps_of_a_build_fall():
    both = added(lagging(0.0, 0.4e-3), unequal_scales(20 * MICRO, 0.0))
    values = build_values(diagnosed(circle(both, seed=2, repeats=2)))
    assert values["schema"] == "zlmreport/build/1"
    assert all(step["rms_after"] < step["rms_before"] for step in values["steps"])
    assert values["verdict"] == "adequate"


@pytest.mark.long
def test_the_lags_of_three_planes_at_two_feeds_are_found_together():
    lags = {"X": 0.0, "Y": 0.3e-3, "Z": 0.1e-3}
    circles = [
        circle(
            lagging(lags[plane[0]], lags[plane[1]]),
            seed=index,
            plane=plane,
            feed=feed / 60,
            name=f"{plane}{feed}",
        )
        for index, (plane, feed) in enumerate((p, f) for p in ("XY", "YZ", "ZX") for f in (1, 4))
    ]
    found = diagnosed(*circles)
    assert found.found == ("servo-mismatch",)
    apart = {each.name: each.value for each in found.complete.estimates if "T_" in each.name}
    assert apart == pytest.approx({"T_X-T_Y": -0.3e-3, "T_Y-T_Z": 0.2e-3}, abs=0.03e-3)


@pytest.mark.long
def test_lags_that_do_not_close_over_three_planes_are_nobodys():
    """In each plane the second axis lags behind the first: no three drives can do that."""
    circles = [
        circle(lagging(0.0, 0.3e-3), seed=index, plane=plane, name=plane)
        for index, plane in enumerate(("XY", "YZ", "ZX"))
    ]
    found = diagnosed(*circles)
    assert found.verdict is DiagnosisVerdict.UNEXPLAINED
    assert found.found == ()


def test_few_readings_and_part_of_a_circle_are_diagnosed_too():
    few = diagnosed(circle(out_of_square(60 * MICRO), seed=3, count=24))
    assert few.found == ("squareness",)
    whole = circle(out_of_square(30 * MICRO), seed=3, plane="ZX")
    angle = np.degrees(whole.angle) % 360
    kept = (angle < 200) | (angle > 340)
    assert diagnosed(whole.keep(kept)).found == ("squareness",)


def test_a_model_without_anything_begins_with_where_the_bar_stands():
    found = diagnosed(circle(lagging(0.0, 0.3e-3), seed=1), effects=())
    assert set(found.found) == {"radius", "centre-offset", "servo-mismatch"}


def test_what_physics_forbids_has_no_part_of_the_probability():
    """At one feed cross-talk has the curve of squareness, with values that no machine has."""
    found = diagnosed(circle(out_of_square(30e-6), noise=0.4e-6))
    by_name = {each.effect.identifier: each for each in found.candidates}
    assert (by_name["dynamic-cross-talk"].is_plausible, by_name["dynamic-cross-talk"].probability) == (
        False,
        0,
    )
    assert by_name["squareness"].probability > 0.95
    assert sum(each.probability for each in found.candidates) <= 1.0 + 1e-9


@pytest.mark.parametrize("size", [0.0, 1e-9, 12e-6, 1.0])
def test_the_evidence_of_what_is_exactly_explained_is_finite(size):
    """Readings without any scatter, all of them zero or just what an effect makes."""
    plain = circle(nothing, count=60, noise=0.0)
    shape = -size * np.sin(plain.angle) * np.cos(plain.angle)
    found = diagnosed(replace(plain, deviation=shape), effects=("radius",))
    assert all(np.isfinite(each.evidence) for each in found.candidates)
    assert np.isfinite(found.noise)
    assert all(np.isfinite(each.probability) for each in found.candidates)
    assert (found.verdict is DiagnosisVerdict.ADEQUATE) == (size == 0.0)
    if size == 12e-6:
        assert "squareness" in {
            found.candidates[0].effect.identifier,
            *found.candidates[0].indistinguishable_from,
        }
