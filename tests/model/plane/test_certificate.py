"""The certificate of a line says where in the plane it lies."""

from __future__ import annotations

from pathlib import Path

import pytest

from document.certificate.documents import certificate, having, text_of


@pytest.mark.parametrize(
    ("language", "fact"),
    [("en", "Position of the second axis: Z = 120.5 mm"), ("de", "Stellung der zweiten Achse: Z = 120,5 mm")],
)
def test_the_second_axis_stands_among_the_conditions(tmp_path: Path, language: str, fact: str) -> None:
    keys = having("measurement.plane", {"axis": "Z", "at": 120.5})
    keys = having("certificate.language", language, keys)
    assert fact in text_of(certificate(tmp_path, keys))


def test_a_line_that_is_none_of_a_plane_says_nothing_of_it(tmp_path: Path) -> None:
    assert "second axis" not in text_of(certificate(tmp_path))
