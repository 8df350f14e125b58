"""The section on the uncertainty of measurement."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import pytest

from certificate.documents import COMPLETE, certificate, text_of
from zlmreport.certificate.document import Certificate, Explained, Graph, Notice, Section, Table
from zlmreport.language import Language

STATED = {
    "misalignment": 0.02,
    "environmental_variation": 0.6,
    "contributions": [{"name": "Dead path", "range": 0.3, "acts": "along-the-length"}],
}
WITH_BUDGET: Mapping[str, Any] = {**COMPLETE, "uncertainty": STATED}
IN_WORDS: Mapping[str, Any] = {
    **COMPLETE,
    "instrument": {**COMPLETE["instrument"], "expanded_uncertainty": "see its certificate"},
}


def section(document: Certificate) -> Section:
    (found,) = [each for each in document.sections if each.key == "uncertainty"]
    return found


def table(document: Certificate) -> Table:
    (found,) = [block for block in section(document).blocks if isinstance(block, Table)]
    return found


def test_the_budget_has_a_row_for_each_contribution_and_one_for_all(tmp_path: Path) -> None:
    rows = [row for group in table(certificate(tmp_path, WITH_BUDGET)).groups for row in group.rows]

    names = [row[1].name if isinstance(row[1], Explained) else row[1] for row in rows]
    assert names == [
        "Measuring instrument",
        "Misalignment of the measuring line",
        "Dead path",
        "Variation of the environment during the test",
        "Resolution of the readings",
        "A single reading at the end of the measured length",
    ]
    assert rows[-1][-1] == "100.0"


def test_shares_are_those_of_the_squares(tmp_path: Path) -> None:
    rows = [row for group in table(certificate(tmp_path, WITH_BUDGET)).groups for row in group.rows]

    # u = 1 µm (U = 2 µm), 5 nm/√3, 0.3 µm/√12, 0.6 µm/√12, 0.01 µm/√12.
    squares = [1.0, 0.005**2 / 3, 0.3**2 / 12, 0.6**2 / 12, 0.01**2 / 12]
    shares = [100 * each / sum(squares) for each in squares]
    assert [row[-1] for row in rows[:-1]] == [f"{each:.1f}" if each >= 0.1 else "< 0.1" for each in shares]
    assert [row[4] for row in rows] == ["1.0", "0.0029", "0.087", "0.17", "0.0029", "1.0"]


def test_contributions_are_grouped_by_the_readings_that_share_them(tmp_path: Path) -> None:
    assert [group.heading for group in table(certificate(tmp_path, WITH_BUDGET)).groups] == [
        "all readings, in proportion to the distance from the first target",
        "each reading by itself",
        "all contributions together",
    ]


def test_a_graph_shows_a_bar_for_each_contribution(tmp_path: Path) -> None:
    (graph,) = [
        block for block in section(certificate(tmp_path, WITH_BUDGET)).blocks if isinstance(block, Graph)
    ]

    bars = graph.figure.panels[0].bars
    assert [bar.y for bar in bars][:1] == pytest.approx([1.0])
    assert [bar.value.in_language(Language.GERMAN) for bar in bars] == [
        "1,0",
        "0,0029",
        "0,087",
        "0,17",
        "0,0029",
    ]
    alternative = graph.figure.alternative.in_language(Language.ENGLISH)
    assert "u3, Dead path: 0.087 µm." in alternative


def test_what_is_not_considered_is_named(tmp_path: Path) -> None:
    (notice,) = [
        block for block in section(certificate(tmp_path, WITH_BUDGET)).blocks if isinstance(block, Notice)
    ]

    assert notice.items == (
        "Temperature measurement, machine",
        "Temperature measurement, measuring device",
        "Expansion coefficient, machine",
        "Expansion coefficient, measuring device",
    )


def test_the_first_page_says_what_the_uncertainty_covers(tmp_path: Path) -> None:
    document = certificate(tmp_path, WITH_BUDGET)

    said = [block.text for block in document.cover if hasattr(block, "text")]
    assert any("coverage factor k" in text and "probability of about 95 %" in text for text in said)


def test_without_a_number_of_the_instrument_the_document_says_why_nothing_is_stated(tmp_path: Path) -> None:
    text = text_of(certificate(tmp_path, IN_WORDS))

    reason = "stated in words and not as a number"
    # On the first page and in the section.
    assert text.count("The uncertainty of the parameters is not evaluated: the uncertainty of") == 2
    assert reason in text
    assert "k = 2.00" not in text


def test_means_by_position_have_their_uncertainty(tmp_path: Path) -> None:
    document = certificate(tmp_path, WITH_BUDGET)
    (positions,) = [
        block
        for each in document.sections
        if each.key == "iso230-2-2014"
        for block in each.blocks
        if isinstance(block, Table) and block.dense
    ]

    headings = [getattr(column.heading, "notation", column.heading) for column in positions.columns]
    column = headings.index("U(x̄_{i}↑↓)")
    # At the datum only the readings' own part: 2·√(0.6² + 0.01²)/√(12·5) µm.
    assert positions.groups[0].rows[0][column] == "0.15"
    # At the end the instrument's 2 µm too.
    assert positions.groups[0].rows[-1][column] == "2.0"


def test_a_german_document_states_its_budget_in_german(tmp_path: Path) -> None:
    german = {**WITH_BUDGET, "certificate": {**COMPLETE["certificate"], "language": "de"}}

    text = text_of(certificate(tmp_path, german))

    assert "Fluchtungsabweichung der Messlinie" in text
    assert "Rechteck, ab null" in text
    assert "Erweiterungsfaktor k" in text


def adjusted(folder: Path, readings_before: str) -> Certificate:
    """Return the certificate of an axis that was adjusted, with other readings as found."""
    (folder / "left.csv").write_text("target,direction,run,deviation\n0,+,1,0.5\n10,+,1,1.5\n")
    (folder / "found.csv").write_text(f"target,direction,run,deviation\n{readings_before}")
    before, after = (
        {"date": "2026-11-18", "source": {"plugin": "laser-csv", "file": f"{name}.csv"}}
        for name in ("found", "left")
    )
    as_found = {"work": "adjustment", "adjustment": "Scale factor renewed.", "measurement": before}
    keys = {
        **WITH_BUDGET,
        "axis": {"name": "Y"},
        "as_found": as_found,
        "measurement": after,
        "evaluate": ["nmtba"],
    }
    return certificate(folder, keys)


def titles(document: Certificate) -> list[str]:
    return [each.title for each in document.sections if each.key.endswith("uncertainty")]


def test_two_measurements_by_the_same_set_up_have_one_budget(tmp_path: Path) -> None:
    document = adjusted(tmp_path, "0,+,1,0.9\n10,+,1,9.5\n")

    assert titles(document) == ["Uncertainty of measurement"]


def test_two_measurements_whose_budgets_differ_have_both(tmp_path: Path) -> None:
    # The first was made over a longer distance, over which a misalignment counts less.
    document = adjusted(tmp_path, "0,+,1,0.9\n20,+,1,9.5\n")

    assert titles(document) == [
        "Uncertainty of measurement (as left, after the adjustment)",
        "Uncertainty of measurement (as found, before the adjustment)",
    ]
