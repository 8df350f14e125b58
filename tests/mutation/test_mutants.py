"""Mutants say one thing else than the source, and leave alone what does nothing when the program runs."""

from __future__ import annotations

from pathlib import Path

import pytest

from mutation.mutants import mutants


@pytest.mark.parametrize(
    ("says", "else_"),
    [
        ("a < b", ["a >= b", "a <= b"]),
        ("a == b", ["a != b"]),
        ("a + b", ["a - b"]),
        ("a and b", ["a or b"]),
        ("c if a else b", ["c if not a else b"]),
        ("f(2)", ["f(3)"]),
        ("f(True)", ["f(False)"]),
        ("'text'", []),
    ],
)
def test_each_mutant_says_one_thing_else(says: str, else_: list[str], tmp_path: Path) -> None:
    module = tmp_path / "module.py"
    module.write_text(f"x = {says}\n", encoding="utf-8")
    assert [each.source for each in mutants(module)] == [f"x = {each}" for each in else_]


def test_annotations_and_decorators_stay(tmp_path: Path) -> None:
    module = tmp_path / "module.py"
    module.write_text("@d(1)\ndef f(a: L[2]) -> L[3]:\n    return a\n", encoding="utf-8")
    (only,) = mutants(module)
    assert only.source.endswith("return None")
