"""An axis that was adjusted: both measurements, evaluated alike, side by side."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from document.certificate.documents import COMPLETE, FEW_TRIALS, certificate, lines_of, text_of, without
from zlmreport.evaluation.uncertainty.monte_carlo import TRIALS
from zlmreport.plugin import Language
from zlmreport.plugin.renderer import Graph, Table

HEAD = "target,direction,run,deviation\n"
AS_LEFT = (
    HEAD + "0,+,1,0.5\n10,+,1,1.0\n10,-,1,0.5\n0,-,1,0.0\n0,+,2,0.7\n10,+,2,1.2\n10,-,2,0.7\n0,-,2,0.2\n"
)
AS_FOUND = AS_LEFT.replace("10,+,1,1.0", "10,+,1,9.0").replace("10,+,2,1.2", "10,+,2,9.2")


@pytest.fixture
def adjusted(tmp_path: Path):
    """Compose the certificate of an axis that was adjusted, with other readings as found or other keys."""
    (tmp_path / "left.csv").write_text(AS_LEFT)

    def compose(as_found: str = AS_FOUND, work: str = "adjustment", trials: int = FEW_TRIALS, **keys: object):
        (tmp_path / "found.csv").write_text(as_found)
        before = {
            "work": work,
            "adjustment": "Scale factor renewed.",
            "measurement": {"date": "2022-04-07", "source": {"plugin": "laser-csv", "file": "found.csv"}},
        }
        complete = {
            **COMPLETE,
            "axis": {"name": "Y"},
            "as_found": before,
            "measurement": {"date": "2022-04-08", "source": {"plugin": "laser-csv", "file": "left.csv"}},
            "evaluate": [{"standard": "iso230-2:2014", "tolerances": {"B": 5}}, "nmtba"],
            **keys,
        }
        return certificate(tmp_path, complete, trials)

    return compose


def section(document, key):
    (found,) = (each for each in document.sections if each.key == key)
    return found


def lines(document, key):
    return [line.strip() for block in section(document, key).blocks for line in lines_of(block)]


def test_results_and_readings_of_both_measurements_stand_in_the_document(adjusted):
    keys = [each.key for each in adjusted().sections]
    assert [key for key in keys if key not in {"definitions", "uncertainty", "origin"}] == [
        "as-found-as-left",
        "iso230-2-2014",
        "nmtba",
        "as-found-iso230-2-2014",
        "as-found-nmtba",
        "readings",
        "as-found-readings",
    ]


def test_each_section_of_results_says_to_which_measurement_it_belongs(adjusted):
    document = adjusted()
    assert section(document, "nmtba").title.endswith("(as left, after the adjustment)")
    assert section(document, "as-found-nmtba").title.endswith("(as found, before the adjustment)")
    assert section(document, "as-found-readings").title == "Readings (as found, before the adjustment)"


def test_each_graph_as_found_says_so(adjusted):
    keys = {"evaluate": [{"standard": "iso230-2:2014", "tolerances": {"A": 5, "B": 5}}]}
    document = adjusted(certificate={**COMPLETE["certificate"], "layout": "full"}, **keys)
    blocks = section(document, "as-found-iso230-2-2014").blocks
    figures = [each.figure for each in blocks if isinstance(each, Graph)]
    assert "as-found-conformity" in [each.key for each in figures]
    titles = [each.title.in_language(Language.ENGLISH) for each in figures]
    assert all(each.endswith("(as found, before the adjustment)") for each in titles)


def test_the_first_page_shows_the_axis_as_left_and_says_so(adjusted):
    document = adjusted(trials=TRIALS)
    cover = [line for block in document.cover for line in lines_of(block)]
    assert any("Reversal error | 0.500 | 0.055 | 1.97 | 5 | conforms" in line for line in cover)
    assert any("The results above are those after the adjustment" in line for line in cover)


def test_both_measurements_are_evaluated_by_every_standard(adjusted):
    document = adjusted()
    standards = [each.standard for each in document.evaluations]
    assert [each.standard for each in document.evaluations_as_found] == standards
    assert document.evaluations[0].value("B") == pytest.approx(0.5e-6)
    assert document.evaluations_as_found[0].value("B") == pytest.approx(8.5e-6)


def test_a_change_is_the_value_as_left_less_the_value_as_found(adjusted):
    rows = lines(adjusted(trials=TRIALS), "as-found-as-left")
    # U of the change: the sum of 0.0573 and 0.0547, both of them unrounded
    assert "B | Reversal error | 8.500 | 0.057 | 0.500 | 0.055 | −8.00 | 0.11" in rows


def test_both_measurements_are_held_against_the_limits(adjusted):
    assert "B | 5 | does not conform | conforms" in lines(adjusted(), "as-found-as-left")


def test_without_limits_there_is_no_table_of_them(adjusted):
    tables = [
        block.caption
        for block in section(adjusted(evaluate=["nmtba"]), "as-found-as-left").blocks
        if isinstance(block, Table)
    ]
    assert len(tables) == 1


def test_uncertainties_stand_beside_both_values_where_they_are_known(adjusted):
    document = adjusted(instrument=COMPLETE["instrument"])
    head = next(line for line in lines(document, "as-found-as-left") if line.startswith("Symbol |"))
    assert head == "Symbol | Parameter | As found µm | U µm | As left µm | U µm | Change µm | U µm"


def test_the_graph_shows_the_means_before_above_those_after(adjusted):
    (graph,) = (block for block in section(adjusted(), "as-found-as-left").blocks if isinstance(block, Graph))
    before, after = graph.figure.panels
    np.testing.assert_allclose(before.curves[0].y, [0.6, 9.1])
    np.testing.assert_allclose(after.curves[0].y, [0.6, 1.1])
    assert graph.figure.spans_are_alike


def test_it_is_said_what_was_adjusted_and_when_the_axis_was_measured_before(adjusted):
    rows = lines(adjusted(), "as-found-as-left")
    assert "Adjusted: Scale factor renewed." in rows
    assert "Date: 2022-04-07" in rows


def test_a_repair_is_called_a_repair(adjusted):
    document = adjusted(work="repair")
    assert section(document, "nmtba").title.endswith("(as left, after the repair)")
    assert "Repaired: Scale factor renewed." in lines(document, "as-found-as-left")


@pytest.mark.parametrize(
    ("as_found", "difference"),
    [
        (AS_FOUND.replace("10,", "11,"), "Other target positions"),
        (
            "\n".join(line for line in AS_FOUND.splitlines() if ",-," not in line),
            "Other directions of approach",
        ),
        (
            "\n".join(line for line in AS_FOUND.splitlines() if ",2," not in line),
            "Other number of runs: 1 before, 2 after",
        ),
    ],
)
def test_measurements_that_are_not_alike_are_compared_with_a_warning(adjusted, as_found, difference):
    assert f"- {difference}" in lines(adjusted(as_found), "as-found-as-left")


def test_measurements_that_are_alike_are_compared_without_one(adjusted):
    assert not any(line.startswith("!") for line in lines(adjusted(), "as-found-as-left"))


def test_a_parameter_of_one_measurement_only_has_no_change(adjusted):
    single = "\n".join(line for line in AS_FOUND.splitlines() if ",2," not in line)
    rows = lines(adjusted(single), "as-found-as-left")
    assert any(row.startswith("A | ") and row.split(" | ")[2] == "–" and row.endswith("| –") for row in rows)


def test_the_files_of_both_measurements_are_listed_apart(adjusted):
    rows = [line.split(" | ")[0] for line in lines(adjusted(), "origin")]
    at = rows.index("[Readings, read by laser-csv]")
    assert rows[at : at + 4] == [
        "[Readings, read by laser-csv]",
        "left.csv",
        "[Readings as found, read by laser-csv]",
        "found.csv",
    ]


def test_what_is_remarked_of_both_files_is_said_once(adjusted):
    rows = lines(adjusted(), "origin")
    assert sum("“target”" in row for row in rows) == 1


def test_an_axis_that_was_not_adjusted_has_one_measurement(tmp_path):
    document = certificate(tmp_path)
    assert document.evaluations_as_found == ()
    assert "as found" not in text_of(document)


def test_parameters_in_another_unit_have_it_beside_their_numbers(tmp_path: Path):
    """The slope of a straightness is in µm/m, and its errors are in µm."""
    for name, slope in (("found", 0.02), ("left", 0.005)):
        readings = (
            f"{x},+,{run},{slope * x + x % 20 / 10 + run / 10}" for run in (1, 2) for x in (0, 10, 20, 30)
        )
        (tmp_path / f"{name}.csv").write_text(HEAD + "\n".join(readings) + "\n")
    found, left = (
        {"date": "2022-04-07", "error": "EYX", "source": {"plugin": "laser-csv", "file": f"{name}.csv"}}
        for name in ("found", "left")
    )
    keys = {
        **without("uncertainty", "instrument.expanded_uncertainty"),
        "certificate": {"number": "R-1", "kind": "report"},
        "axis": {"name": "X"},
        "as_found": {"adjustment": "Guide scraped.", "measurement": found},
        "measurement": left,
        "evaluate": [{"standard": "iso230-1:2012", "tolerances": {"EYX": 5}}],
    }
    document = certificate(tmp_path, keys)
    changes, limits = (
        block for block in section(document, "as-found-as-left").blocks if isinstance(block, Table)
    )
    (slope,) = (line for line in lines_of(changes) if "Slope" in line)
    assert "µm/m" in slope
    assert not any(column.unit for column in changes.columns)
    assert [column.unit for column in limits.columns] == ["", "µm", "", ""]
