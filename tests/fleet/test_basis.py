"""What a certificate was made from, and how a change of it is noticed."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest

from zlmreport.fleet.basis import CertificateBasis, Disk, FileStamp, KnownFile, say_changes

CONTENT = b"readings"
BASIS = CertificateBasis(
    (KnownFile("job", "x.yaml", "a" * 64, FileStamp(1, 2, 3)), KnownFile("readings", "x.csv", "b" * 64)),
    {"zlmreport": "0.1.0 code", "acme": "1.0 code"},
    ("pdf", "json"),
    "d" * 64,
)


def test_a_basis_comes_back_from_what_the_ledger_keeps() -> None:
    assert CertificateBasis.from_json(BASIS.as_json()) == BASIS


@pytest.mark.parametrize(
    "other",
    [
        replace(BASIS, files=BASIS.files[:1]),
        replace(BASIS, files=(replace(BASIS.files[0], sha256="c" * 64), BASIS.files[1])),
        replace(BASIS, files=(replace(BASIS.files[0], path="y.yaml"), BASIS.files[1])),
        replace(BASIS, programs={"zlmreport": "0.2.0 code", "acme": "1.0 code"}),
        replace(BASIS, formats=("pdf",)),
        replace(BASIS, defaults=""),
    ],
)
def test_everything_that_a_certificate_depends_on_is_in_its_digest(other: CertificateBasis) -> None:
    assert other.digest != BASIS.digest


def test_how_a_file_looks_is_not_in_the_digest() -> None:
    files = (replace(BASIS.files[0], look=None), BASIS.files[1])
    assert replace(BASIS, files=files).digest == BASIS.digest


@pytest.mark.parametrize(("age", "settled"), [(1.0, False), (1.9, False), (2.1, True), (60.0, True)])
def test_a_file_just_written_may_change_without_looking_different(age: float, *, settled: bool) -> None:
    begun = 1000.0
    look = FileStamp(1, round((begun - age) * 1e9), 2)
    assert look.is_settled(begun) is settled


def test_a_file_that_looks_the_same_is_not_read(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    path = tmp_path / "x.csv"
    path.write_bytes(CONTENT)
    file = KnownFile("readings", "x.csv", "of something else", FileStamp.at(path))
    monkeypatch.setattr(Disk, "compute_digest", lambda *_: pytest.fail("the file is read"))
    assert Disk(tmp_path).still_has(file)


def test_a_file_without_a_look_is_read(tmp_path: Path) -> None:
    (tmp_path / "x.csv").write_bytes(CONTENT)
    digest = Disk(tmp_path).compute_digest("x.csv") or ""
    assert Disk(tmp_path).still_has(KnownFile("readings", "x.csv", digest))
    assert not Disk(tmp_path).still_has(KnownFile("readings", "x.csv", "of something else"))


def test_each_change_is_said(tmp_path: Path) -> None:
    (tmp_path / "x.csv").write_bytes(CONTENT)
    now = CertificateBasis((), {"zlmreport": "0.1.0 other code"}, ("pdf",), "")
    assert list(say_changes(BASIS, Disk(tmp_path), now)) == [
        "job x.yaml is gone",
        "readings x.csv changed",
        "the defaults of the fleet changed",
        "the code of zlmreport 0.1.0 changed",
        "acme is not installed any more",
        "formats changed from pdf, json to pdf",
    ]


def test_a_newer_release_is_said(tmp_path: Path) -> None:
    now = replace(BASIS, programs=dict(BASIS.programs) | {"acme": "1.1 code"}, formats=())
    said = list(say_changes(replace(BASIS, files=()), Disk(tmp_path), now))
    assert said == ["acme changed from 1.0 to 1.1"]


def test_a_file_that_cannot_be_read_has_no_digest(tmp_path: Path) -> None:
    assert Disk(tmp_path).compute_digest("none") is None
