"""What a page draws, from the operators of its content alone."""

from __future__ import annotations

import pytest
from pypdf import PdfWriter
from pypdf.generic import DecodedStreamObject, DictionaryObject, NameObject

from zlmreport.verification.marks import DrawnMark, ForeignError, list_marks

IMAGE = DictionaryObject({NameObject("/Subtype"): NameObject("/Image")})


def drawn(content: str) -> list[DrawnMark]:
    """Return what a page draws that has a picture /P, a form /F and a graphics state /G."""
    writer = PdfWriter()
    page = writer.add_blank_page(100, 100)
    stream = DecodedStreamObject()
    stream.set_data(content.encode())
    page[NameObject("/Contents")] = stream
    resources = {
        "/XObject": DictionaryObject({NameObject("/P"): IMAGE, NameObject("/F"): DictionaryObject()}),
        "/ExtGState": DictionaryObject({NameObject("/G"): DictionaryObject()}),
    }
    page[NameObject("/Resources")] = DictionaryObject({NameObject(k): v for k, v in resources.items()})
    return list_marks(page, lambda each: "image" if each == IMAGE else "other", {})


def test_a_line_is_its_points_its_width_and_its_colour() -> None:
    (line,) = drawn("2 w 1 0 0 RG 10 20 m 30 40 l S")
    assert line == DrawnMark(
        ("S", "ml", ((), ("rgb", (1.0, 0.0, 0.0))), "", ()), (2.0, 0.0, 0.0, 2.0), (10.0, 20.0, 30.0, 40.0)
    )


def test_a_curve_is_its_points_and_what_bends_it() -> None:
    (curve,) = drawn("1 2 m 3 4 5 6 7 8 c S")
    assert (curve.what[1], curve.place) == ("mc", (1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0))


def test_an_area_has_no_width_and_its_own_colour() -> None:
    (area,) = drawn("2 w 0.5 g 1 0 0 RG 10 20 30 40 re f")
    assert area.what[0] == "f"
    assert area.what[2] == (("grey", (0.5,)), ())
    assert area.scale == ()


@pytest.mark.parametrize(("other", "is_same"), [("0.50001", True), ("0.5002", False)])
def test_colours_are_the_same_to_four_decimals(other: str, *, is_same: bool) -> None:
    assert (drawn("0.5 g 1 1 9 9 re f") == drawn(f"{other} g 1 1 9 9 re f")) is is_same


def test_a_transformation_moves_and_turns_what_is_drawn_after_it_and_is_taken_back() -> None:
    found = drawn("q 0 2 -2 0 5 7 cm 10 20 m 30 40 l S Q 10 20 m 30 40 l S")
    assert [each.place for each in found] == [
        (),
        (5.0 - 40, 7.0 + 20, 5.0 - 80, 7.0 + 60),
        (),
        (10.0, 20.0, 30.0, 40.0),
    ]


def test_a_path_that_bounds_what_follows_is_a_mark_and_ends() -> None:
    assert drawn("1 2 m 3 4 l W n") == [DrawnMark(("clip", "W", "ml"), (), (1.0, 2.0, 3.0, 4.0))]


def test_a_picture_is_its_pixels_its_corners_and_how_much_shows_through() -> None:
    assert drawn("q 3 0 0 4 10 20 cm /P Do Q")[1] == DrawnMark(
        ("picture", "image", ""), (), (10.0, 20.0, 13.0, 20.0, 10.0, 24.0)
    )
    assert drawn("/G gs /P Do")[0].what == ("picture", "image", "other")


@pytest.mark.parametrize("content", ["/F Do", "/Other Do", "/S sh", "Q", "BI ID x EI"])
def test_what_no_certificate_draws_by_is_refused(content: str) -> None:
    with pytest.raises(ForeignError):
        drawn(content)


def test_the_same_elsewhere_is_the_same_mark_and_another_shape_is_none() -> None:
    here, there, larger = (
        DrawnMark(("S",), (1.0,), place) for place in ((0, 0, 9, 9), (5, 5, 14, 14), (0, 0, 9, 12))
    )
    assert here.is_as(there)
    assert not here.is_where(there)
    assert not here.is_as(larger)
    assert not here.is_as(DrawnMark(("S",), (1.1,), here.place))
    assert not here.is_as(DrawnMark(("f",), (1.0,), here.place))
