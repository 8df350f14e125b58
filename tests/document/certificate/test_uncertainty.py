"""The section on the uncertainty of measurement."""

from __future__ import annotations

import math
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import pytest

from document.certificate.documents import COMPLETE, ROOT, certificate, having, text_of
from refusals import messages
from zlmreport.plugin import InputError, Language
from zlmreport.plugin.renderer import Certificate, Explained, Graph, Notice, Section, Table

STATED = {
    "misalignment": 0.02,
    "environmental_variation": 0.6,
    "contributions": [{"name": "Dead path", "range": 0.3, "acts": "along-the-length"}],
}
REPORT = {**COMPLETE["certificate"], "kind": "report"}
WITH_BUDGET: Mapping[str, Any] = {**COMPLETE, "certificate": REPORT, "uncertainty": STATED}
IN_WORDS: Mapping[str, Any] = {
    **COMPLETE,
    "certificate": REPORT,
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
        "Misalignment of the measuring line",
        "Dead path",
        "Measuring instrument",
        "Variation of the environment during the test",
        "Resolution of the readings",
        "A single reading at the end of the measured length",
    ]
    assert rows[-1][-1] == "100.0"


def test_shares_are_those_of_the_squares(tmp_path: Path) -> None:
    rows = [row for group in table(certificate(tmp_path, WITH_BUDGET)).groups for row in group.rows]

    # 5 nm/√3, 0.3 µm/√12, u = 1 µm (U = 2 µm), 0.6 µm/√12, 0.01 µm/√12.
    squares = [0.005**2 / 3, 0.3**2 / 12, 1.0, 0.6**2 / 12, 0.01**2 / 12]
    shares = [100 * each / sum(squares) for each in squares]
    assert [row[-1] for row in rows[:-1]] == [f"{each:.1f}" if each >= 0.1 else "< 0.1" for each in shares]
    assert [row[4] for row in rows] == ["0.0029", "0.087", "1.0", "0.17", "0.0029", "1.0"]


def test_contributions_are_grouped_by_the_readings_that_share_them(tmp_path: Path) -> None:
    assert [group.heading for group in table(certificate(tmp_path, WITH_BUDGET)).groups] == [
        "all readings, in proportion to the distance from the first target",
        "all readings of a target alike",
        "readings that are near in time; of the kind of drift that disturbs a parameter most",
        "each reading by itself",
        "all contributions together",
    ]


def test_a_graph_shows_a_bar_for_each_contribution(tmp_path: Path) -> None:
    full = certificate(tmp_path, having("certificate.layout", "full", WITH_BUDGET))
    (graph,) = [block for block in section(full).blocks if isinstance(block, Graph)]

    bars = graph.figure.panels[0].bars
    assert [bar.value.in_language(Language.GERMAN) for bar in bars] == [
        "0,0029",
        "0,087",
        "1,0",
        "0,17",
        "0,0029",
    ]
    alternative = graph.figure.alternative.in_language(Language.ENGLISH)
    assert "u2, Dead path: 0.087 µm." in alternative


def test_the_first_page_of_a_report_names_what_is_not_considered_beside_u(tmp_path: Path) -> None:
    document = certificate(tmp_path, WITH_BUDGET)

    headings = [block.heading for block in document.cover if isinstance(block, Notice)]
    assert (
        "U incomplete: Temperature measurement, machine; Temperature measurement, measuring device; "
        "Expansion coefficient, machine; Expansion coefficient, measuring device not considered"
    ) in headings
    assert not any("about 95 %" in getattr(block, "text", "") for block in document.cover)


def test_a_certificate_is_refused_with_each_contributor_and_how_to_state_it(tmp_path: Path) -> None:
    told = messages(certificate, tmp_path, {**WITH_BUDGET, "certificate": COMPLETE["certificate"]})
    assert [message.split(":")[0].rpartition(" ")[2] for message in told] == [
        "uncertainty.machine_temperature",
        "uncertainty.device_temperature",
        "uncertainty.expansion_coefficient",
        "uncertainty.device_expansion_coefficient",
    ]
    assert all("uncertainty.negligible: {" in message for message in told)


def test_a_certificate_of_a_length_at_an_unknown_temperature_is_refused(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="needs the temperature of the measured length"):
        certificate(tmp_path, {**COMPLETE, "environment": {"axis_temperature": "about 31"}})


def test_a_report_on_a_warm_machine_states_its_expansion_on_the_first_page(tmp_path: Path) -> None:
    warm = {"axis_temperature": 31, "expansion_coefficient": 11.5}

    report = having("certificate.kind", "report", {**COMPLETE, "environment": warm})
    text = text_of(certificate(tmp_path, report))

    # 11.5 µm/(m·K) · 11 K · 40 mm
    assert "The measured length was 5.06 µm longer than at 20 °C" in text


def test_a_rule_that_uses_u_decides_nothing_from_an_incomplete_one(tmp_path: Path) -> None:
    guarded = certificate(tmp_path, {**WITH_BUDGET, "decision_rule": "guard-band"})
    simple = certificate(tmp_path, {**WITH_BUDGET, "decision_rule": "simple"})

    assert [each.conforms for each in guarded.evaluations[0].parameters if each.limit] == [None, None]
    assert [each.conforms for each in simple.evaluations[0].parameters if each.limit] == [True, False]


def test_what_is_declared_negligible_stands_there_with_its_reason(tmp_path: Path) -> None:
    (notice,) = [
        block for block in section(certificate(tmp_path, COMPLETE)).blocks if isinstance(block, Notice)
    ]

    assert "Misalignment of the measuring line: 40 mm at 20 °C" in notice.items


def test_the_first_page_says_what_the_uncertainty_covers(tmp_path: Path) -> None:
    document = certificate(tmp_path, COMPLETE)

    said = [block.text for block in document.cover if hasattr(block, "text")]
    assert any(
        "expanded uncertainty of this test" in text and "probability of about 95 %" in text for text in said
    )


def test_without_a_number_of_the_instrument_the_document_says_why_nothing_is_stated(tmp_path: Path) -> None:
    text = text_of(certificate(tmp_path, IN_WORDS))

    reason = "stated in words and not as a number"
    # On the first page and in the section.
    assert text.count("The uncertainty of the parameters is not evaluated: the uncertainty of") == 2
    assert reason in text
    assert "k = 2.00" not in text


def test_means_by_position_have_their_uncertainty(tmp_path: Path) -> None:
    document = certificate(tmp_path, WITH_BUDGET)
    *_, positions = [
        block
        for each in document.sections
        if each.key == "iso230-2-2014"
        for block in each.blocks
        if isinstance(block, Table) and block.dense
    ]

    headings = [getattr(column.heading, "notation", column.heading) for column in positions.columns]
    column = headings.index("U(x̄_{i}↑↓)")
    # The instrument's 2 µm act at each position; a drift of 0.6 µm in all adds 2·0.6 µm at the most.
    most = math.hypot(2.0, 2 * 0.6)
    assert all(2.0 <= float(row[column]) <= most for row in positions.groups[0].rows)


def test_a_german_document_states_its_budget_in_german(tmp_path: Path) -> None:
    german = {**WITH_BUDGET, "certificate": {**REPORT, "language": "de"}}

    text = text_of(certificate(tmp_path, german))

    assert "Fluchtungsabweichung der Messlinie" in text
    assert "Rechteck, ab null" in text
    assert "U unvollständig" in text


def adjusted(folder: Path, readings_before: str) -> Certificate:
    """Return the certificate of an axis that was adjusted, with other readings as found."""
    (folder / "left.csv").write_text("target,direction,run,deviation\n0,+,1,0.5\n10,+,1,1.5\n")
    (folder / "found.csv").write_text(f"target,direction,run,deviation\n{readings_before}")
    before, after = (
        {"date": "2022-04-08", "source": {"plugin": "laser-csv", "file": f"{name}.csv"}}
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


def test_of_a_plate_no_axis_is_spoken_of(tmp_path: Path) -> None:
    keys = {"extends": str(ROOT / "configs" / "flatness" / "certificate.yaml"), "schema": "zlmreport/job/1"}
    document = certificate(tmp_path, keys)
    said = text_of(document)
    assert "The interval of another test holds" in said
    assert "The scatter from run to run is not in U" in said
    assert "Another test, 95\N{NO-BREAK SPACE}%" in said.replace("95 %", "95\N{NO-BREAK SPACE}%")
    assert "Axis, 95" not in said
    assert "of the axis itself" not in said
