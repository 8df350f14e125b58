"""The version rises when results or pages change, once between two releases."""

from __future__ import annotations

import datetime as dt
from pathlib import Path

import pytest

from release import rule
from release.rule import broken, fingerprint, released
from verification.conftest import by_typst, issued
from verification.issued import with_page_content, with_results
from zlmreport import __version__

__all__ = ["by_typst", "issued"]  # fixtures
RELEASES = {"0.9.0": {"results": "a"}, "0.10.0": {"results": "b", "texts de": "c"}}


@pytest.mark.long
def test_what_this_release_gives_is_what_it_gave_or_its_version_has_risen(
    issued: bytes, by_typst: bytes
) -> None:
    present = fingerprint({"pdf": issued, "pdf-typst": by_typst})
    assert present.keys() == released()[max(released(), key=rule._order)].keys()
    assert broken(__version__, present, released()) == ""


@pytest.mark.parametrize(
    ("version", "results", "complaint"),
    [
        ("0.10.0", "b", ""),
        ("0.10.0", "d", "version 0.10.0, and release 0.10.0: results changed since it was released"),
        ("0.11.0", "d", ""),
        ("0.11.0", "b", ""),
        ("0.9.9", "b", "version 0.9.9, and release 0.10.0: it is lower"),
    ],
)
def test_a_change_asks_for_another_version(version: str, results: str, complaint: str) -> None:
    said = broken(version, {"results": results, "texts de": "c"}, RELEASES)
    assert said == (f"{complaint}. Raise the version: ./run release raise" if complaint else "")


@pytest.mark.long
def test_a_fingerprint_tells_another_result_and_another_word_from_another_rounding(issued: bytes) -> None:
    def result(value: float) -> dict[str, str]:
        changed = with_results(
            issued, lambda tree: tree["evaluations"][0]["parameters"][0].update(value=value)
        )
        return fingerprint({"pdf": changed})

    def differing(one: dict[str, str], other: dict[str, str]) -> set[str]:
        return {key for key in one if one[key] != other[key]}

    usual = result(7.25)
    assert differing(usual, result(7.25 + 1e-12)) == set()
    assert differing(usual, result(7.26)) == {"results"}
    blank = fingerprint({"pdf": with_page_content(issued, 2, lambda _: b"")})
    assert differing(fingerprint({"pdf": issued}), blank) == {"pages pdf"}


def test_a_release_is_recorded_and_the_next_one_begun(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    for name, text in {
        "RELEASES": "0.9.0: {results: a}\n",
        "_VERSION": '__version__ = "0.10.0"\nRELEASED = dt.date(2026, 1, 9)\n',
        "_CHANGES": "# Changelog\n\n## Unreleased (0.10.0)\n\n- A line.\n\n## 0.9.0\n",
    }.items():
        file = tmp_path / name
        file.write_text(text, encoding="utf-8")
        monkeypatch.setattr(rule, name, file)
    monkeypatch.setattr(rule, "__version__", "0.10.0")
    assert "not released yet" in rule.raise_version()
    rule.record({"results": "b"}, dt.date(2026, 12, 4))
    assert released() == {"0.9.0": {"results": "a"}, "0.10.0": {"results": "b"}}
    assert "## 0.10.0\n\n- A line." in (tmp_path / "_CHANGES").read_text(encoding="utf-8")
    rule.raise_version()
    assert (tmp_path / "_VERSION").read_text(encoding="utf-8") == (
        '__version__ = "0.11.0"\nRELEASED = dt.date(2026, 12, 4)\n'
    )
    text = (tmp_path / "_CHANGES").read_text(encoding="utf-8")
    assert text.startswith("# Changelog\n\n## Unreleased (0.11.0)\n\n## 0.10.0\n")
