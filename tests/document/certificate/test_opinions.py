"""Opinions stand apart from results, marked, with their basis and the person who states them."""

from document.certificate.documents import COMPLETE, certificate, lines_of

OPINIONS = [
    {"statement": "There is play in the nut.", "basis": "The reversal value is alike everywhere."},
    {"statement": "It will grow.", "basis": "Three years.", "by": {"name": "B. Other", "function": "Fitter"}},
]


def test_opinions_stand_in_a_section_of_their_own_after_all_results(tmp_path):
    keys = [section.key for section in certificate(tmp_path, {**COMPLETE, "opinions": OPINIONS}).sections]
    assert keys[-1] == "opinions"


def test_an_opinion_is_marked_and_has_its_basis_and_its_author(tmp_path):
    document = certificate(tmp_path, {**COMPLETE, "opinions": OPINIONS})
    lines = [line for block in document.sections[-1].blocks for line in lines_of(block)]
    assert lines[0] == (
        "! Opinion and interpretation (ISO/IEC 17025:2017, 7.8.7), not a result of the measurement"
    )
    assert lines[-2:] == [
        "  There is play in the nut. | The reversal value is alike everywhere. | A. Person, Head",
        "  It will grow. | Three years. | B. Other, Fitter",
    ]


def test_a_certificate_without_opinions_has_no_section_for_them(tmp_path):
    assert "opinions" not in [section.key for section in certificate(tmp_path, COMPLETE).sections]


def test_opinions_are_not_on_the_first_page(tmp_path):
    document = certificate(tmp_path, {**COMPLETE, "opinions": OPINIONS})
    assert not any("play" in line for block in document.cover for line in lines_of(block))
