"""What was measured: symbols of ISO 230-1, units, and what a job refuses of it."""

import pytest

from zlmreport.measurement.error_symbol import find_letter_of, find_symbol_of_positioning
from zlmreport.measurement.measurand import is_for
from zlmreport.plugin import (
    ANGLE,
    POSITIONING,
    SQUARENESS,
    STRAIGHTNESS,
    Axis,
    AxisKind,
    Language,
    error_named,
    measurands_of,
)


@pytest.mark.parametrize(
    ("symbol", "measurand", "axis", "vdi"),
    [
        # the table of VDI/VDE 2617-3 beside ISO 230-1
        ("EXX", "positioning", "X", "xpx"),
        ("EYX", "straightness", "X", "xty"),
        ("EZX", "straightness", "X", "xtz"),
        ("EAX", "angle", "X", "xrx"),
        ("EBX", "angle", "X", "xry"),
        ("ECX", "angle", "X", "xrz"),
        ("C0Y", "squareness", "Y", "xwy"),
        ("B0Z", "squareness", "Z", "xwz"),
        ("A0Z", "squareness", "Z", "ywz"),
        ("eyx", "straightness", "X", "xty"),
        ("ECC", "positioning", "C", "cpc"),
    ],
)
def test_a_symbol_names_what_was_measured_of_which_axis(symbol, measurand, axis, vdi):
    found = error_named(symbol)
    assert (found.measurand.identifier, found.axis, found.vdi) == (measurand, axis, vdi)


def test_three_linear_axes_have_21_errors():
    letters, components, locations = "XYZ", 0, 0
    for axis in letters:
        components += sum(1 for letter in "XYZABC" if error_named(f"E{letter}{axis}"))
    locations = sum(1 for symbol in ("C0Y", "B0Z", "A0Z") if error_named(symbol).reference)
    assert components + locations == 21


@pytest.mark.parametrize("text", ["EYQ", "Y", "", "A0X", "C0X", "EXYZ", "straight"])
def test_what_is_no_error_is_refused_with_how_one_is_written(text):
    with pytest.raises(ValueError, match=r"is no error of ISO 230-1 that is measured: .*EYX"):
        error_named(text)


def test_a_name_that_begins_with_no_axis_has_no_symbol():
    assert (find_letter_of("X1"), find_letter_of("spindle"), find_letter_of("")) == ("X", "", "")
    assert (find_symbol_of_positioning("y-axis"), find_symbol_of_positioning("Table")) == ("EYY", "")


def test_units_follow_from_what_was_measured_and_not_from_the_axis():
    assert (Axis("X").deviation_unit.ascii, Axis("C", AxisKind.ROTARY).deviation_unit.ascii) == (
        "um",
        "arcsec",
    )
    tilted, straight = Axis("X", quantity=ANGLE), Axis("X", quantity=STRAIGHTNESS)
    assert (tilted.position_unit.ascii, tilted.deviation_unit.ascii) == ("mm", "arcsec")
    assert (straight.position_unit.ascii, straight.deviation_unit.ascii) == ("mm", "um")
    assert set(tilted.deviation_units) >= {"urad", "arcsec", "um/m"}
    assert "arcsec" not in straight.deviation_units


def test_only_positions_along_a_length_have_an_expansion():
    rotary = Axis("C", AxisKind.ROTARY)
    assert Axis("X").has_length
    assert not any(
        each.has_length for each in (rotary, Axis("X", quantity=STRAIGHTNESS), Axis("X", quantity=ANGLE))
    )
    assert rotary.measurand.is_position


def test_the_subject_of_a_document_says_what_was_measured():
    straight = Axis("X", quantity=STRAIGHTNESS, error="EYX")
    assert straight.subject.in_language(Language.ENGLISH) == "Straightness error EYX of axis X"
    assert straight.subject.in_language(Language.GERMAN) == "Geradheitsabweichung EYX der Achse X"
    assert Axis("X").subject.in_language(Language.ENGLISH) == "Positioning accuracy of axis X"
    said = straight.measurand.sign_of(straight.letter).in_language(Language.ENGLISH)
    assert said.endswith("positive in the positive direction of Y")
    assert "target" not in said


def test_a_plugin_that_says_nothing_is_for_positioning():
    assert measurands_of(object()) == (POSITIONING,)
    assert is_for(object(), POSITIONING)
    assert not is_for(object(), SQUARENESS)
