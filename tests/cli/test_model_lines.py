"""What a diagnosis asks for next on a terminal."""

from __future__ import annotations

from dataclasses import replace

from installed import registry
from model.axis_tests import model_of, noise
from model.hidden_effect import example, example_diagnosis
from zlmreport.cli.model_lines import find_next_step, tell_diagnosis
from zlmreport.measurement.units import MILLIMETRE
from zlmreport.model.diagnosis.diagnosis import AxisDiagnosis, DiagnosisVerdict
from zlmreport.model.diagnosis.faults import DataFault, FaultKind
from zlmreport.model.diagnosis.random_curves import Course
from zlmreport.model.diagnosis.remainder import Remainder
from zlmreport.model.fitting.fit import fit
from zlmreport.plugin import Language, same_in_all_languages as same


def test_data_that_look_wrong_are_corrected_before_anything_else() -> None:
    swapped = DataFault(FaultKind.SWAPPED_DIRECTION, 3, 1.0, same("run 3"), same("correct it"))
    found = replace(example_diagnosis(), verdict=DiagnosisVerdict.UNEXPLAINED, together=(), faults=(swapped,))
    assert find_next_step(found, "job.yaml") == "correct the data, then zlmreport model diagnose job.yaml"
    assert find_next_step(replace(found, faults=()), "job.yaml") == "zlmreport job.yaml"


def test_unit_that_looks_wrong_is_stated_before_an_effect_is_added() -> None:
    unit = DataFault(FaultKind.WRONG_UNIT, None, 1.0, same("as if in mm"), same("state source.units"))
    found = replace(example_diagnosis(), faults=(unit,))
    assert found.verdict is DiagnosisVerdict.MISSING
    assert find_next_step(found, "job.yaml") == "state the unit, then zlmreport model diagnose job.yaml"


def test_given_value_that_the_readings_contradict_is_mended_before_anything_else() -> None:
    wrong = (same("backlash: −4 µm fits, the job says 4 µm."),)
    found = replace(
        example_diagnosis(), verdict=DiagnosisVerdict.UNEXPLAINED, together=(), contradicted=wrong
    )
    assert find_next_step(found, "job.yaml").startswith("free or mend the given value in model.effects, then")


def test_effect_of_an_adequate_model_that_may_not_be_there_is_told_with_how_to_take_it_out() -> None:
    found = example_diagnosis()
    design = found.fit.design
    fitted = fit(model_of("offset", "backlash", "first-run"), design, 3e-6 * design.direction + noise(design))
    adequate = replace(found, fit=fitted, together=(), verdict=DiagnosisVerdict.ADEQUATE, candidates=())
    lines = " ".join(" ".join(tell_diagnosis(adequate, example(), "job.yaml", None, ())).split())
    assert "first-run: nothing of it exceeds its uncertainty, it may not be there" in lines
    assert "zlmreport model remove job.yaml first-run" in lines
    assert "remove job.yaml backlash" not in lines


def test_fault_that_the_verdict_states_is_not_said_a_second_time() -> None:
    unit = DataFault(FaultKind.WRONG_UNIT, None, 1.0, same("as if in mm"), same("state source.units"))
    stuck = DataFault(FaultKind.STUCK_SENSOR, None, 0.5, same("the log stands still"), same("read it again"))
    lines = "\n".join(
        tell_diagnosis(replace(example_diagnosis(), faults=(unit, stuck)), example(), "job.yaml", None, ())
    )
    assert lines.count("as if in mm") == 1
    assert lines.count("the log stands still. Remedy: read it again.") == 1


def test_what_no_test_of_such_an_axis_could_see_is_not_counted() -> None:
    found = example_diagnosis()
    of_rotary = [
        each
        for each in found.not_testable
        if each.reason.in_language(Language.ENGLISH) == "for rotary axes only"
    ]
    assert of_rotary
    only = replace(found, not_testable=tuple(of_rotary), visibility=())
    assert "cannot see or try" not in "\n".join(tell_diagnosis(only, example(), "job.yaml", None, ()))


def irregular() -> AxisDiagnosis:
    """Return a diagnosis that leaves something irregular along the axis."""
    place = same("around 213 mm")
    left = Remainder(
        rms=1.5e-6, where=place, low=0.1, high=0.3, unit=MILLIMETRE, shape=same("irregular"), size=3e-6,
        peak=0.213, course=Course.IRREGULAR, share=0.9, formula=None,
    )  # fmt: skip
    return replace(example_diagnosis(), remainder=left)


def test_what_is_irregular_asks_for_the_lengths_that_nobody_stated() -> None:
    found, effects = irregular(), registry().effects
    text = " ".join(" ".join(tell_diagnosis(found, example(), "job.yaml", None, effects)).split())
    assert (
        "state: axis.signal_period or axis.scale_element (mm), whichever the axis has; without it these "
        "cannot be tried: encoder-interpolation and scale-elements next:" in text
    )
    smooth = replace(found, remainder=replace(found.remainder, course=Course.PLACE))
    for other in (smooth, example_diagnosis()):
        assert "state:" not in "".join(tell_diagnosis(other, example(), "job.yaml", None, effects))


def test_what_is_left_is_told_with_its_largest_value_and_its_sign() -> None:
    down = replace(irregular(), remainder=replace(irregular().remainder, size=-3.24e-6))
    text = " ".join(" ".join(tell_diagnosis(down, example(), "job.yaml", None, ())).split())
    assert "Root mean square 1.5 µm Largest value −3.2 µm Share of what the model leaves 90 %" in text


def test_what_could_not_be_tried_is_said_to_be_like_the_first_candidate() -> None:
    found = replace(example_diagnosis(), not_excluded=("abbe", "probe-radius"))
    text = " ".join(" ".join(tell_diagnosis(found, example(), "job.yaml", None, ())).split())
    first = found.candidates[0].identifier
    assert f"Not excluded in place of {first}, for this test could not try them: abbe, probe-radius." in text
