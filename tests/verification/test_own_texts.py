"""What a laboratory says in words of its own: whether it reads like a result that no reading gives."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from types import SimpleNamespace
from typing import Any, cast

import pytest

from verification.issued import JOB, LABORATORY, issue, lay_out
from zlmreport.verification.findings import Outcome, Verdict, Verification
from zlmreport.verification.own_texts import stated_results


def _with(**keys: str) -> str:
    stated = ", ".join(f"{name}: {value}" for name, value in keys.items())
    return LABORATORY.replace("kind: report", f"kind: report, {stated}")


def _section(text: str) -> str:
    return f"[results, {{title: Summary, text: '{text}'}}]"


RESULTS = {
    "a value of a parameter": _with(sections=_section("P = 1.0")),
    "a value without a sign": _with(sections=_section("Limits are kept: P 1.0")),
    "a value with its direction": _with(sections=_section("Ps_max: 2")),
    "an amount in micrometres": _with(sections=_section("good to 1 µm")),
    "the same with the other micro sign": _with(sections=_section("good to 1 μm")),
    "an amount in millimetres": _with(sections=_section("good to 0,001 mm")),
    "a value in a header": _with(style="{header: 'P = 1.0'}"),
    "a value in a footer": _with(style="{footer: 'P = 1.0'}"),
    "a value in the title": _with(title="'Report: P = 1.0'"),
    "a value by a placeholder": _with(style="{footer: 'P = {laboratory.address}'}").replace(
        "Example Street 1", "1.0"
    ),
}
WORDS = {
    "a clause": _section("Procedure QM 4.12, ISO 230-2:2014, clause 7.1"),
    "a travel": _section("Travel 0.5 m, in steps of 20 mm, at 20 °C"),
    "a date": _section("Next test: 20.11.2027, page 4"),
}


@pytest.mark.parametrize("laboratory", RESULTS.values(), ids=RESULTS)
def test_a_result_in_the_laboratorys_own_words_is_not_decided(
    laboratory: str, tmp_path: Path, verified: Callable[[bytes], Verification]
) -> None:
    found = verified(issue(lay_out(tmp_path, laboratory=laboratory), "pdf-typst"))
    assert found.outcome is Outcome.UNDECIDED
    assert found.undecided == ("document",)
    (stated,) = (each for each in found.document if each.verdict is Verdict.OPEN)
    assert "own word" in stated.detail.en


def test_a_result_in_the_name_of_the_axis_is_not_decided(
    tmp_path: Path, verified: Callable[[bytes], Verification]
) -> None:
    job = JOB.replace("name: X", "name: 'X, P = 1.0 µm'")
    assert verified(issue(lay_out(tmp_path, job=job), "pdf-typst")).outcome is Outcome.UNDECIDED


@pytest.mark.parametrize("sections", WORDS.values(), ids=WORDS)
def test_words_that_state_no_result_hold(
    sections: str, tmp_path: Path, verified: Callable[[bytes], Verification]
) -> None:
    assert verified(issue(lay_out(tmp_path, laboratory=_with(sections=sections)), "pdf-typst")).holds


def _of(title: str, *symbols: str) -> list[str]:
    """Return the keys of texts that read like a result, of a certificate that states these parameters."""
    parameters = [SimpleNamespace(quantity=SimpleNamespace(symbol=each)) for each in symbols]
    words = SimpleNamespace(head=title, foot="")
    certificate = SimpleNamespace(
        evaluations=[SimpleNamespace(parameters=parameters)], page_words=words, sections=()
    )
    keys = SimpleNamespace(certificate=SimpleNamespace(title=title))
    job = SimpleNamespace(axis=SimpleNamespace(name="X"), keys=keys)
    return [each.subject for each in stated_results(cast("Any", certificate), cast("Any", job))]


def test_a_result_is_told_by_the_key_of_its_text() -> None:
    assert _of("A = 1.0", "A") == ["certificate.title", "certificate.style.header"]


def test_the_letter_of_a_parameter_alone_reads_like_it() -> None:
    assert _of("B = 1.0", "B_mean")
    assert not _of("C = 1.0", "B_mean")
