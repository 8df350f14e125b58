"""What a document says of several measured lines together."""

from pathlib import Path
from typing import Any

from document.certificate.documents import COMPLETE, certificate
from zlmreport.document.certificate.measured_lines import say_of_each
from zlmreport.plugin import Language, Words
from zlmreport.plugin.renderer import Certificate, Facts, Paragraph, Table

ANOTHER = {"name": "Another", "certificate": "C-9", "expanded_uncertainty": 2.0}
READINGS = "target,direction,run,deviation\n" + "".join(
    f"{at},{way},1,{at * 0.01}\n" for way in "+-" for at in range(0, 500, 100)
)


def of_two_lines(folder: Path, **second: Any) -> Certificate:
    """Return a report on the squareness of two straightness lines; `second`: of the second's job."""
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
    return certificate(folder, whole)


def budgets(folder: Path, **second: Any) -> list[str]:
    """Return the captions of the budgets of two straightness lines; `second`: of the second's job."""
    section = next(each for each in of_two_lines(folder, **second).sections if each.key == "uncertainty")
    captions = [each.caption for each in section.blocks if isinstance(each, Table)]
    return [each for each in captions if "budget" in each]


def test_a_budget_that_lines_share_is_printed_once_and_says_for_which(tmp_path: Path) -> None:
    (caption,) = budgets(tmp_path)
    assert caption.startswith("x, y: Uncertainty budget")


def test_budgets_that_differ_are_printed_each(tmp_path: Path) -> None:
    captions = budgets(tmp_path, instrument=ANOTHER)
    assert [each[:2] for each in captions] == ["x:", "y:"]


def test_a_square_of_which_nothing_is_stated_is_missing_in_u(tmp_path: Path) -> None:
    assert "square" in of_two_lines(tmp_path).budget.missing
    assert "square" not in of_two_lines(tmp_path, instrument=ANOTHER).budget.missing


def of_a_drift(folder: Path, *sensors: str) -> Certificate:
    """Return a report on a drift by sensors that one file has."""
    header = ",".join(["time (h)", *(f"{name} (µm)" for name in sensors)])
    rows = [",".join([str(hour), *[str(hour * 0.5)] * len(sensors)]) for hour in range(9)]
    (folder / "drift.csv").write_text("\n".join([header, *rows]) + "\n", encoding="utf-8")
    source = {"plugin": "channels-csv", "file": "drift.csv"}
    keys = {name: each for name, each in COMPLETE.items() if name != "axis"}
    return certificate(
        folder,
        {
            **keys,
            "certificate": {**COMPLETE["certificate"], "kind": "report"},
            "measurement": {"date": "2022-04-18", "source": source, "tests": {name: {} for name in sensors}},
            "evaluate": ["iso230-3"],
        },
    )


def test_lines_whose_readings_are_in_files_share_a_section_and_their_file_is_listed_once(
    tmp_path: Path,
) -> None:
    sections = {each.key: each for each in of_a_drift(tmp_path, "X", "Y", "Z").sections}
    (said,) = [each for key, each in sections.items() if key.endswith("-readings")]
    assert said.title == "X, Y, Z: Readings"
    assert next(each for each in said.blocks if isinstance(each, Paragraph)).text.startswith(
        "The 27 readings"
    )
    files = next(each for each in sections["origin"].blocks if isinstance(each, Table))
    assert files.groups[0].heading == "Readings of X, Y, Z, read by channels-csv"
    assert len(files.groups[0].rows) == 1


def test_what_is_said_of_all_lines_is_said_once_and_of_some_with_their_names() -> None:
    one, other, own = Words("one"), Words("other"), Words("own")
    lines = [("x", [one, other]), ("y", [one, other, own]), ("z", [one])]
    said = [each.in_language(Language.ENGLISH) for each in say_of_each(lines)]
    assert said == ["one", "x, y: other", "y: own"]


def test_what_is_said_of_one_line_has_its_name_and_of_no_line_none() -> None:
    said = [
        [each.in_language(Language.ENGLISH) for each in say_of_each([(name, [Words("one")])])]
        for name in ("x", "")
    ]
    assert said == [["x: one"], ["one"]]


def test_lines_without_results_of_their_own_share_a_section_that_tells_only_what_differs(
    tmp_path: Path,
) -> None:
    document = of_a_drift(tmp_path, "X", "Y", "Z")
    assert not [each for each in document.sections if each.key.endswith("-line")]
    lines = next(each for each in document.sections if each.key == "lines")
    assert lines.title == "Sensors"
    assert ("Record", "8 h, read at 9 moments") in [
        pair for each in lines.blocks if isinstance(each, Facts) for pair in each.pairs
    ]
    (table,) = [each for each in lines.blocks if isinstance(each, Table)]
    assert [each.heading for each in table.columns] == ["Sensor", "Measured"]
    assert [row[0] for row in table.groups[0].rows] == ["X", "Y", "Z"]


def test_a_line_with_results_of_its_own_has_a_section(tmp_path: Path) -> None:
    keys = [each.key for each in of_two_lines(tmp_path).sections]
    assert [each for each in keys if each.endswith("-line")] == ["x-line", "y-line"]
    assert "lines" not in keys
