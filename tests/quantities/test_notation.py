"""Quantities are set in italics, words, numbers, operators and constants upright (ISO 80000-1 and -2)."""

from __future__ import annotations

import pytest

from zlmreport.quantities.notation import plain, spans


@pytest.mark.parametrize(
    ("notation", "italic"),
    [
        ("A·sin(2π·P/Λ + φ)", ["A", "P", "Λ", "φ"]),
        ("Σ c_{k}·p", ["c", "p"]),
        ("x̄_{i}↑ + 2s_{i}↑", ["x̄", "i", "s", "i"]),
        ("P_{s max}", ["P"]),
        ("U(k = 2)", ["U", "k"]),
    ],
)
def test_only_quantities_and_running_indices_are_italic(notation: str, italic: list[str]) -> None:
    assert [span.text for span in spans(notation) if span.italic] == italic


@pytest.mark.parametrize("notation", ["A·sin(2π·P/p_{0} + φ)", "P_{s max}", "½·B·d"])
def test_nothing_is_lost_in_spans(notation: str) -> None:
    assert "".join(span.text for span in spans(notation)) == plain(notation)
