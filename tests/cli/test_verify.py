"""``zlmreport verify``."""

from __future__ import annotations

import json
import re
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import pytest

from installed import registry
from verification.issued import LABORATORY, READINGS, issue, lay_out, with_attachment, with_results
from zlmreport import __version__
from zlmreport.cli import main
from zlmreport.verification.findings import CheckedCertificate, QuotedText
from zlmreport.verification.verify import verify

Run = Callable[..., tuple[int, str, str]]
OwnLines = Callable[[list[tuple[str, str]]], list[str]]
DIGEST = re.compile(r"[0-9A-HJKMNP-TV-Z]{4}(-[0-9A-HJKMNP-TV-Z]{4}){3}")


@pytest.fixture(scope="session")
def report(tmp_path_factory: pytest.TempPathFactory) -> bytes:
    return issue(lay_out(tmp_path_factory.mktemp("report")))


@pytest.fixture
def run(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> Run:
    """Verify the bytes of a PDF: the exit code, and what is printed on both outputs."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("NO_COLOR", "1")

    def verify(pdf: bytes, *options: str) -> tuple[int, str, str]:
        Path("report.pdf").write_bytes(pdf)
        code = main(["verify", "report.pdf", *options])
        return (code, *capsys.readouterr())

    return verify


def with_value(pdf: bytes, value: float) -> bytes:
    return with_results(pdf, lambda results: results["evaluations"][0]["parameters"][0].update(value=value))


def test_a_certificate_that_holds_is_told_with_what_that_rests_on(report: bytes, run: Run) -> None:
    code, output, messages = run(report)
    assert (code, messages) == (0, "")
    head, identity, _, *others = output.splitlines()
    assert head.startswith("report.pdf  holds: consistent, origin unknown  ")
    assert DIGEST.fullmatch(head.split()[-1])
    assert identity == f"  Measuring Report VERIFY-1, issued 2026-11-20, made by zlmreport {__version__}"
    assert others[0] == "  signature  not signed: nothing tells who made the file"
    assert others[1] == "  files      6 of 6 attached files as the certificate states"
    assert others[3] == "  pages      3 of 3 pages as printed again"
    assert "  P        7.2563      7.2563  holds" in others


@pytest.mark.long
def test_a_french_certificate_is_told_with_the_spaces_of_french(run: Run, tmp_path: Path) -> None:
    french = LABORATORY.replace("kind: report", "kind: report, language: fr")
    head = run(issue(lay_out(tmp_path, laboratory=french)))[1].splitlines()[0]
    assert head.startswith("report.pdf  confirmé : cohérent, origine inconnue  ")


@pytest.mark.long
def test_a_german_certificate_is_told_in_german(run: Run, tmp_path: Path) -> None:
    german = LABORATORY.replace("kind: report", "kind: report, language: de")
    pdf = issue(lay_out(tmp_path / "de", laboratory=german))
    code, output, _ = run(pdf)
    head, identity, _, *others = output.splitlines()
    assert code == 0
    assert head.startswith("report.pdf  bestätigt: in sich stimmig, Herkunft unbekannt  ")
    assert identity.endswith(f", ausgestellt 2026-11-20, hergestellt von zlmreport {__version__}")
    assert others[0] == "  Signatur  nicht signiert: nichts sagt, wer die Datei hergestellt hat"
    assert others[1] == "  Dateien   6 von 6 angehängten Dateien wie im Schein angegeben"
    assert "  nmtba    angegeben  berechnet  µm" in others
    _, output, _ = run(with_value(pdf, 7.25))
    assert output.startswith("report.pdf  nicht bestätigt: 1 Abweichung\n")
    assert run(pdf, "--json")[1].count('"verdict": "holds"') > 1


@pytest.mark.long
def test_a_certificate_that_does_not_hold_ends_with_1_and_says_what_differs(report: bytes, run: Run) -> None:
    code, output, messages = run(with_value(report, 7.25))
    assert (code, messages) == (1, "")
    assert output.startswith("report.pdf  does not hold: 1 difference\n")
    assert "  P          7.25      7.2563  differs\n" in output


@pytest.mark.long
def test_as_many_digits_are_shown_as_tell_two_numbers_apart(report: bytes, run: Run) -> None:
    _, output, _ = run(with_value(report, 7.2563142))
    assert ["P", "7.2563142", "7.2563143", "differs"] in [line.split() for line in output.splitlines()]


@pytest.mark.long
def test_each_place_that_an_altered_reading_changes_is_told(report: bytes, run: Run) -> None:
    readings = READINGS.replace("200,+,2,3.1", "200,+,2,8.1").encode()
    code, output, _ = run(with_attachment(report, "x-axis.csv", readings))
    assert code == 1
    assert "differs  x-axis.csv: is not the file that the results come from" in output
    assert "differs  nmtba 200.0 mean_fwd: 3 is stated, and 5.5 recomputed" in output


@pytest.mark.long
def test_a_verdict_is_told_as_the_results_file_has_it(report: bytes, run: Run) -> None:
    _, output, _ = run(
        with_results(report, lambda found: found["evaluations"][0]["parameters"][0].update(conforms=1))
    )
    assert "conforms: 1 is stated, and true recomputed" in output


def test_machines_read_every_finding(report: bytes, run: Run) -> None:
    code, output, _ = run(with_value(report, 7.25), "--json")
    found = json.loads(output)
    assert (code, found["exit_code"], found["holds"], found["differences"]) == (1, 1, False, 1)
    assert found["schema"] == "zlmreport/verification/1"
    assert found["certificate"]["number"] == "VERIFY-1"
    assert [each for each in found["values"] if each["verdict"] == "differs"] == [
        {
            "path": "evaluations/nmtba/parameters/P/value",
            "stated": 7.25,
            "recomputed": pytest.approx(7.2563, abs=1e-4),
            "verdict": "differs",
        }
    ]
    assert {each["verdict"] for key in ("files", "pages", "document") for each in found[key]} == {"holds"}


def test_what_is_no_certificate_ends_with_2(run: Run) -> None:
    code, output, messages = run(b"%PDF-1.7\nnothing")
    assert (code, output) == (2, "")
    assert messages.startswith("report.pdf: is damaged")
    assert messages.count("\n") == 1


def test_a_file_that_cannot_be_read_ends_with_3(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["verify", "none.pdf"]) == 3
    assert capsys.readouterr().err == "none.pdf: cannot be read: no such file or directory\n"


def test_without_a_file_the_command_says_what_it_takes(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["verify"]) == 2
    assert "FILE.pdf" in capsys.readouterr().err


@pytest.mark.long
def test_what_a_foreign_file_says_of_itself_does_not_steer_the_terminal(report: bytes, run: Run) -> None:
    def change(results: dict) -> None:
        results["certificate"]["title"] = "\x1b[2J\u202eReport"

    _, output, _ = run(with_results(report, change))
    assert "\x1b" not in output
    assert "\u202e" not in output
    assert r"\x1b[2J\u202eReport" in output


@pytest.fixture(scope="module")
def checked(report: bytes, tmp_path_factory: pytest.TempPathFactory) -> CheckedCertificate:
    path = tmp_path_factory.mktemp("checked") / "report.pdf"
    path.write_bytes(report)
    return verify(path, registry())


@pytest.fixture
def own_lines(checked: CheckedCertificate, run: Run, monkeypatch: pytest.MonkeyPatch) -> OwnLines:
    """Return what is told of a certificate with such words that somebody wrote."""

    def told(texts: list[tuple[str, str]]) -> list[str]:
        found = replace(checked, own_words=tuple(QuotedText(*each) for each in texts))
        monkeypatch.setattr("zlmreport.cli.verify.verify", lambda *_, **__: found)
        return run(b"")[1].partition("no reading gives them:\n")[2].splitlines()

    return told


def test_a_text_that_every_measurement_repeats_is_told_once_with_its_places(own_lines: OwnLines) -> None:
    lines = ("", "EXX.", "EYY.", "EZZ.", "EYX.", "diagonals.", "diagonals.PPP.")
    texts = [(f"{name}customer.name", "A Customer") for name in lines]

    assert own_lines(texts) == ["  customer.name (also in EXX, EYY, EZZ and 3 more): 'A Customer'"]


def test_keys_that_differ_are_told_beside_each_other(own_lines: OwnLines) -> None:
    told = own_lines(
        [("EXX.axis.name", "X"), ("EYX.axis.name", "X"), ("machine.model", "X"), ("axis.name", "Y")]
    )

    assert told == ["  axis.name (in EXX, EYX), machine.model: 'X'", "  axis.name: 'Y'"]


def test_no_measurement_stands_alone_behind_and_one_more(own_lines: OwnLines) -> None:
    texts = [(f"{name}.axis.name", "X") for name in ("EXX", "EYX", "EZX", "EBX")]

    assert own_lines(texts) == ["  axis.name (in EXX, EYX, EZX, EBX): 'X'"]
