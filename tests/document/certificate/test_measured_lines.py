"""What a document says of several measured lines together."""

from pathlib import Path
from typing import Any

from document.certificate.documents import COMPLETE, certificate
from zlmreport.document.blocks import Table
from zlmreport.document.certificate.measured_lines import say_of_each
from zlmreport.language import Language, same

READINGS = "target,direction,run,deviation\n" + "".join(
    f"{at},{way},1,{at * 0.01}\n" for way in "+-" for at in range(0, 500, 100)
)


def budgets(folder: Path, **second: Any) -> list[str]:
    """Return the captions of the budgets of two straightness lines; `second`: of the second's job."""
    (folder / "line.csv").write_text(READINGS, encoding="utf-8")
    source = {"plugin": "laser-csv", "file": "line.csv"}
    tests = {"x": {"error": "EYX", "source": source}, "y": {"error": "EXY", "source": source, **second}}
    keys = {name: each for name, each in COMPLETE.items() if name != "axis"}
    whole = {
        **keys,
        "certificate": {**COMPLETE["certificate"], "kind": "report"},
        "measurement": {"date": "2022-04-18", "error": "C0Y", "tests": tests},
        "square": {"expanded_uncertainty": 0.5} if second else {},
        "evaluate": ["iso230-1:2012"],
    }
    document = certificate(folder, whole)
    section = next(each for each in document.sections if each.key == "uncertainty")
    captions = [each.caption for each in section.blocks if isinstance(each, Table)]
    return [each for each in captions if "budget" in each]


def test_a_budget_that_lines_share_is_printed_once_and_says_for_which(tmp_path: Path) -> None:
    (caption,) = budgets(tmp_path)
    assert caption.startswith("x, y: Uncertainty budget")


def test_budgets_that_differ_are_printed_each(tmp_path: Path) -> None:
    other = {"name": "Another", "certificate": "C-9", "expanded_uncertainty": 2.0}
    captions = budgets(tmp_path, instrument=other)
    assert [each[:2] for each in captions] == ["x:", "y:"]


def test_what_holds_of_every_line_is_said_once() -> None:
    shared, own = same("The instrument is old"), same("One run mirrors the others")
    said = [
        each.in_language(Language.ENGLISH) for each in say_of_each([("x", [shared, own]), ("y", [shared])])
    ]
    assert said == ["The instrument is old", "x: One run mirrors the others"]


def test_what_a_single_line_shows_has_no_name() -> None:
    said = list(say_of_each([("", [same("The instrument is old")])]))
    assert [each.in_language(Language.ENGLISH) for each in said] == ["The instrument is old"]
