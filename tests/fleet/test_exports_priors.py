"""What the tests of a fleet teach, and where it is written."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest

from environments import ROOT
from fleet.fleets import Fleet, Here
from replacing import replaced
from zlmreport.cli import main
from zlmreport.fleet import night
from zlmreport.fleet.exports import make_priors
from zlmreport.fleet.issuing import What
from zlmreport.fleet.ledger import Taught
from zlmreport.fleet.records import About, Subject

_CONFIG = ROOT / "configs/second-test"
_FLEET = """\
schema: zlmreport/fleet/1
name: Hall North
jobs: jobs/*.yaml
output: {formats: [csv]}
ledger: ledger.db
priors: knowledge
"""
_LESSON = {
    "kind": "linear",
    "sizes": {"backlash": 2.0},
    "levels": {"run": [0.0, 0.05, 0.25]},
    "likelihoods": [0.2, 1.0, 0.1],
}
_FIRST = "Example-Machine-Works-Example-axis.linear.2026-11-17.yaml"


def _job(fleet: Fleet, name: str, number: int, *changes: tuple[str, str]) -> None:
    text = (_CONFIG / "cool.yaml").read_text(encoding="utf-8")
    model = ("    - backlash\n", "    - backlash\n    - scale-expansion\n")
    own = (model, ("file: cool", f"file: ../{name}"), ("0016", f"{number:04}"))
    fleet.write(f"jobs/{number}.yaml", replaced(text, *own, *changes))


@pytest.fixture
def fleet(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Fleet:
    """Two tests of a type of machine, and the folder of their readings beside them."""
    monkeypatch.setattr(night, "make_executor", lambda *_: Here())
    for name in ("cool", "warm"):
        shutil.copy(_CONFIG / f"{name}.csv", tmp_path)
    fleet = Fleet(tmp_path)
    fleet.write("fleet.yaml", _FLEET)
    _job(fleet, "cool", 1)
    _job(fleet, "cool", 2)  # another certificate of the same readings teaches nothing more
    return fleet


@pytest.mark.long
def test_a_night_writes_once_what_its_tests_teach_and_the_next_tests_build_on_it(fleet: Fleet) -> None:
    folder = fleet.folder / "knowledge"
    first = fleet.spend()
    assert [path.name for path in first.priors] == [_FIRST]
    learned = fleet.folder / "learned.yaml"
    assert main(["model", "learn", str(fleet.folder / "jobs"), "-o", str(learned)]) == 0
    content = (folder / _FIRST).read_text(encoding="utf-8")
    assert content.splitlines()[1:] == learned.read_text(encoding="utf-8").splitlines()[1:]
    assert fleet.spend().priors == []

    named = f"\nmodel:\n  priors: ../knowledge/{_FIRST}"
    _job(fleet, "warm", 3, ("2026-11-17", "2026-11-21"), ("\nmodel:", named))
    third = fleet.spend()
    assert third.what == {"1": What.UNCHANGED, "2": What.UNCHANGED, "3": What.ISSUED}
    assert [path.name for path in third.priors] == [_FIRST.replace("11-17", "11-21")]
    assert (folder / _FIRST).read_text(encoding="utf-8") == content
    assert "tests: 2\n" in third.priors[0].read_text(encoding="utf-8")


@pytest.mark.long
def test_a_folder_that_cannot_be_written_is_told_and_stops_nothing(fleet: Fleet) -> None:
    fleet.write("knowledge", "a file is in the way")
    witness = fleet.spend()
    assert set(witness.what.values()) == {What.ISSUED}
    assert [notice.about for notice in witness.notices] == [About.PRIORS]
    (fleet.folder / "knowledge").unlink()
    assert [path.name for path in fleet.spend().priors] == [_FIRST]


def test_each_type_of_machine_has_priors_of_its_own_and_the_same_ledger_gives_the_same_bytes(
    tmp_path: Path,
) -> None:
    rotary, straight = {**_LESSON, "kind": "rotary"}, {**_LESSON, "measurand": "straightness"}
    taught = [
        Taught(Subject(type=name, measured=day), frozenset({day + name}), lesson)
        for day, name, lesson in (
            ("2026-01-01", "Works A", _LESSON),
            ("2026-01-02", "Works B", _LESSON),
            ("2026-01-03", "Works A", _LESSON),
            ("2026-01-04", "Works A", rotary),
            ("2026-01-05", "", _LESSON),
            ("2026-01-06", "Works A", straight),
        )
    ]
    found = list(make_priors(taught, tmp_path))
    assert [each.path.name for each in found] == [
        "Works-A.linear.2026-01-03.yaml",
        "Works-A.linear.straightness.2026-01-06.yaml",
        "Works-A.rotary.2026-01-04.yaml",
        "Works-B.linear.2026-01-02.yaml",
    ]
    assert list(make_priors(taught, tmp_path)) == found
    assert b"tests: 2\n" in found[0].content
    assert b"backlash: {rms: 2, tests: 2}" in found[0].content
