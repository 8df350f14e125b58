"""What a laboratory says in words of its own: whether it reads like a result that no reading gives."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from types import SimpleNamespace
from typing import Any, cast

import pytest

from verification.issued import JOB, LABORATORY, issue, lay_out
from zlmreport.plugin.extension import JobKeys
from zlmreport.verification.findings import (
    CheckedCertificate,
    QuotedText,
    VerificationOutcome,
    VerificationVerdict,
)
from zlmreport.verification.own_texts import quote_own_texts


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
    "a travel": _section("Travel 0.5 m at 20 °C, clamped with 20 Nm, 11.5 µm/(m·K)"),
    "a date": _section("Next test: 20.11.2027, page 4"),
}


@pytest.mark.parametrize("laboratory", RESULTS.values(), ids=RESULTS)
def test_a_result_in_the_laboratorys_own_words_is_not_decided(
    laboratory: str, tmp_path: Path, verified: Callable[[bytes], CheckedCertificate]
) -> None:
    found = verified(issue(lay_out(tmp_path, laboratory=laboratory), "pdf-typst"))
    assert found.outcome is VerificationOutcome.UNDECIDED
    assert found.undecided == ("document",)
    (stated,) = (each for each in found.document if each.verdict is VerificationVerdict.OPEN)
    assert "own word" in stated.detail.en


def test_a_result_in_the_name_of_the_axis_is_not_decided(
    tmp_path: Path, verified: Callable[[bytes], CheckedCertificate]
) -> None:
    job = JOB.replace("name: X", "name: 'X, P = 1.0 µm'")
    assert verified(issue(lay_out(tmp_path, job=job), "pdf-typst")).outcome is VerificationOutcome.UNDECIDED


@pytest.mark.parametrize("sections", WORDS.values(), ids=WORDS)
def test_words_that_state_no_result_hold(
    sections: str, tmp_path: Path, verified: Callable[[bytes], CheckedCertificate]
) -> None:
    assert verified(issue(lay_out(tmp_path, laboratory=_with(sections=sections)), "pdf-typst")).holds


#: Claims that nothing computes, in every spelling that a reader takes for one.
CLAIMS = [
    *("A = 1.0", "A: 1.0", "A is 1.0", "A 1.0", "А = 1,0", "A ≤ 1"),
    *("1 µm", "1 μm", "1 um", "1 µ m", "l,O µm", "lO µm", "1·10⁻³ mm", "1e-3 mm", "0,001 mm", "20 mm"),
    *("one micrometre", "half a micron", "zwei Mikrometer", "1\u200b,0 µm", "１．０ µm", "١ µm", "½ µm"),
    *("2 arcsec", "2 ″", "1e-6 m", "0.000001 m", "1 mil", "ein Hundertstel Millimeter", "3 мкм"),
    *("conforms", "does not conform", "Result: PASSED", "all tolerances are met", "✓", "bestanden"),
    *("within tolerance", "alle Grenzwerte eingehalten", "РАSSED", "conf\u00adorms", "i. O."),
]
NO_CLAIMS = [
    *("XL-80", "CM 500", "Conformal Optics", "Passau", "Compass GmbH", "Владимир", "日本製作所"),
    *("11.5 µm/(m·K)", "20 °C", "30 min", "2000 mm/min", "Travel 0.5 m", "Clamped with 20 Nm"),
    *("ISO 230-2:2014, clause 7.1", "C = 1.0", "see page 4", "a micrometer screw", "S/N 10l4"),
]


def _texts_of(title: str, *symbols: str) -> list[QuotedText]:
    """Return the words of the title of a certificate on which these parameters stand."""
    return [each for each in _all_texts_of(title, *symbols) if each.key == "certificate.title"]


def _all_texts_of(title: str, *symbols: str, said: str = "", file: str = "x-axis.csv") -> list[QuotedText]:
    """Return all words of a certificate, with what an operator said and the name of a file of readings."""
    remarks = (SimpleNamespace(values={"text": said}),) if said else ()
    parameters = [SimpleNamespace(quantity=SimpleNamespace(symbol=each)) for each in symbols]
    certificate = SimpleNamespace(
        evaluations=[
            SimpleNamespace(
                parameters=parameters,
                measurements=SimpleNamespace(provenance=SimpleNamespace(remarks=remarks)),
            )
        ],
        sources=(SimpleNamespace(file=SimpleNamespace(name=file)),),
    )
    keys = JobKeys.model_validate(
        {
            "schema": "zlmreport/job/1",
            "certificate": {"number": "X-1", "kind": "report", "title": title},
            "axis": {"name": "X"},
            "measurement": {"source": {"plugin": "laser-csv"}},
            "evaluate": ["nmtba"],
        }
    )
    job = SimpleNamespace(
        keys=keys,
        source=SimpleNamespace(options=None),
        standards=(),
        extensions=(),
        measurements={},
        tests={},
    )
    return [*quote_own_texts(cast("Any", certificate), cast("Any", job))]


@pytest.mark.parametrize("text", CLAIMS)
def test_a_claim_is_seen_in_every_spelling_that_a_reader_takes_for_one(text: str) -> None:
    (title,) = _texts_of(text, "A")
    assert title.claim


@pytest.mark.parametrize("text", NO_CLAIMS)
def test_words_that_claim_nothing_are_quoted_and_no_more(text: str) -> None:
    (title,) = _texts_of(text, "A")
    assert (title.text, title.claim) == (text, None)


@pytest.mark.parametrize(
    "text", ["Certificate PTB-5432", "page 1 of 1", "Seite 1 von 2", "Kalibrierschein Nr. 5"]
)
def test_a_number_of_another_document_where_that_of_this_one_stands_is_a_claim(text: str) -> None:
    assert _texts_of(text)[0].claim


def test_what_an_operator_said_is_quoted_and_a_name_of_a_file_only_where_it_says_something() -> None:
    quoted = {each.key: each for each in _all_texts_of("T", "A", said="the door was open")}
    assert quoted["readings"].text == "the door was open"
    assert quoted["readings"].claim is None
    assert "files" not in quoted
    claiming = {each.key: each for each in _all_texts_of("T", "A", file="A = 1.0.csv")}
    assert claiming["files"].claim
    odd = {each.key: each for each in _all_texts_of("T", "A", file="x\N{CYRILLIC SMALL LETTER A}xis.csv")}
    assert odd["files"].oddities


def test_the_letter_of_a_parameter_alone_reads_like_it() -> None:
    assert _texts_of("B = 1.0", "B_mean")[0].claim
    assert not _texts_of("C = 1.0", "B_mean")[0].claim


@pytest.mark.parametrize(
    ("text", "mark"),
    [
        ("Аcme", "'Аcme' mixes letters of Cyrillic, Latin"),
        ("АСМЕ", "'АСМЕ' is written in Cyrillic letters that look like 'ACME'"),
        ("S-1O4", "'1O4' has letters where digits belong"),
        ("S-١", "'١' has digits of another script: 1"),
    ],
)
def test_what_nobody_can_tell_by_looking_is_marked(text: str, mark: str) -> None:
    assert [each.en.format(**each.values) for each in _texts_of(text)[0].oddities] == [mark]


@pytest.mark.parametrize("text", ["Müller & Søn", "Владимир", "日本のABC", "Größe in µm", "Ångström"])
def test_names_of_all_countries_are_not_marked(text: str) -> None:
    assert _texts_of(text)[0].oddities == ()


def test_a_day_on_which_something_will_be_due_holds(
    tmp_path: Path, verified: Callable[[bytes], CheckedCertificate]
) -> None:
    laboratory = f"{LABORATORY}next_due: {{date: 2131-11-20, agreed: true}}\n"
    assert verified(issue(lay_out(tmp_path, laboratory=laboratory), "pdf-typst")).holds


@pytest.mark.parametrize("key", ["line: Y 200, 20 mm above the table", "remarks: 20 mm above the table"])
def test_a_length_may_stand_where_it_is_asked_for(
    key: str, tmp_path: Path, verified: Callable[[bytes], CheckedCertificate]
) -> None:
    name, text = key.split(": ", 1)
    job = JOB.replace("measurement: {", f"measurement: {{{name}: '{text}', ")
    found = verified(issue(lay_out(tmp_path, job=job), "pdf-typst"))
    assert found.outcome is (VerificationOutcome.HOLDS if name == "line" else VerificationOutcome.UNDECIDED)
