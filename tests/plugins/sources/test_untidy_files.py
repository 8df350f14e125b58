"""Files as they come are read as they are: what is proposed reads them, and the same readings come of all."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st

from installed import registry
from plugins.sources import untidy_files
from plugins.sources.untidy_files import FILES, Untidy, german, rows, text
from replacing import replace_in
from zlmreport.cli import main
from zlmreport.looking import look_at
from zlmreport.plugin import InputError

REGISTRY = registry()


@pytest.fixture(params=FILES, ids=[each.__name__.lstrip("_") for each in FILES])
def untidy(request: pytest.FixtureRequest) -> Untidy:
    make: Callable[[], Untidy] = request.param
    return make()


def test_a_file_is_read_as_it_is(untidy: Untidy, tmp_path: Path) -> None:
    path = tmp_path / untidy.name
    path.write_bytes(untidy.content)
    looked = look_at(path, REGISTRY)
    axis = looked.read.axis
    np.testing.assert_allclose(
        axis.deviation_unit.from_si(looked.read.deviations()), untidy.grid, rtol=0, atol=1e-5
    )
    assert (looked.proposal.axis, axis.kind.value) == (untidy.axis, untidy.kind)
    assert dict(looked.proposal.keys) == untidy.keys


def test_the_job_that_is_written_reads_it(
    untidy: Untidy, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    Path(untidy.name).write_bytes(untidy.content)
    assert main(["init", "--from", untidy.name, "job"]) == 0
    assert main(["check", "job/job.yaml"]) == 0, capsys.readouterr().err
    name = untidy.axis or "X"
    assert f"axis: {{name: {name}, kind: {untidy.kind}," in Path("job", "job.yaml").read_text("utf-8")


def test_the_sheet_that_is_named_is_looked_at(tmp_path: Path) -> None:
    path = tmp_path / "two.xlsx"
    head = ["target", "1+", "1-"]
    path.write_bytes(
        untidy_files.workbook(Before=[head, [0, 1, 2], [9, 1, 2]], After=[head, [0, 3, 4], [9, 3, 4]])
    )
    assert [question for question in look_at(path, REGISTRY).proposal.asks if "Before" in question] == [
        "Is 'Before' the right sheet? 'After' holds a table, too."
    ]
    after = look_at(path, REGISTRY, "After")
    assert after.proposal.keys["sheet"] == "After"
    np.testing.assert_allclose(after.read.deviations()[:, 0, 0], [3e-6, 4e-6])


def test_deviations_beside_positions_tell_their_sign(tmp_path: Path) -> None:
    path = tmp_path / "both.csv"
    path.write_text("Soll;Ist;Richtung;Lauf;Abw. (µm)\n0;0,002;+;1;2\n9;9,003;+;1;3\n", encoding="utf-8")
    proposal = look_at(path, REGISTRY).proposal
    assert "sign" not in proposal.keys
    assert not [question for question in proposal.asks if "nominal" in question]


@pytest.mark.parametrize(
    ("line", "unit"), [("Abweichungen in mm", "mm"), ("Values [nm]", "nm"), ("Einheit: µm", "µm")]
)
def test_a_unit_that_stands_above_the_table_is_taken(line: str, unit: str, tmp_path: Path) -> None:
    path = tmp_path / "above.csv"
    path.write_text(f"{line}\ntarget;1+;1-\n0;0,001;0,002\n9;0,001;0,002\n", encoding="utf-8")
    assert look_at(path, REGISTRY).proposal.keys["units"] == {"deviation": unit}


def test_readings_back_under_a_name_of_their_own_are_asked_for(tmp_path: Path) -> None:
    path = tmp_path / "back.csv"
    path.write_text("Soll;hin (µm);gegen (µm);T (°C)\n0;1,2;0,3;20,1\n9;1,8;1,1;20,2\n", encoding="utf-8")
    (asked,) = (each for each in look_at(path, REGISTRY).proposal.asks if "other direction" in each)
    assert "'gegen (µm)'" in asked
    replace_in(path, ("gegen", "her"))
    looked = look_at(path, REGISTRY)
    assert looked.proposal.keys["columns"]["1-"] == "her"
    assert not [each for each in looked.proposal.asks if "other direction" in each]


def test_values_too_small_for_micrometres_are_taken_for_millimetres_and_asked(tmp_path: Path) -> None:
    path = tmp_path / "small.csv"
    path.write_text("target,1+,1-\n0,0.0012,0.0003\n50,0.0018,0.0011\n", encoding="utf-8")
    proposal = look_at(path, REGISTRY).proposal
    assert proposal.keys["units"] == {"deviation": "mm"}
    assert [question for question in proposal.asks if "rarely in µm" in question]


def test_a_whole_turn_of_an_unnamed_axis_is_asked(tmp_path: Path) -> None:
    path = tmp_path / "turn.csv"
    path.write_text("target,1+,1-\n0,1,2\n180,3,4\n360,5,6\n", encoding="utf-8")
    assert [question for question in look_at(path, REGISTRY).proposal.asks if "kind: rotary" in question]


def test_rows_below_the_table_that_are_not_read_are_asked_about(tmp_path: Path) -> None:
    path = tmp_path / "two.csv"
    table = "target;1+;1-\n0;1;2\n9;1;2\n"
    path.write_text(f"X axis\n{table}\nY axis\n{table}", encoding="utf-8")
    assert [question for question in look_at(path, REGISTRY).proposal.asks if "below" in question] == [
        "Do the 2 rows of numbers below the table, from line 8 on, belong to the test? They are not read."
    ]


def test_tables_of_runs_are_asked_whether_they_are_of_one_test(tmp_path: Path) -> None:
    path = tmp_path / "runs.csv"
    table = "target;direction;deviation (um)\n0;+;1\n9;+;2\n"
    path.write_text(f"{table}{table}", encoding="utf-8")
    asked = look_at(path, REGISTRY).proposal.asks
    assert [question for question in asked if "one below the other" in question]
    assert not [question for question in asked if "They are not read" in question]


def test_a_table_of_several_axes_is_refused_with_their_names(tmp_path: Path) -> None:
    path = tmp_path / "axes.csv"
    path.write_text(
        "Axis,target,direction,run,deviation\nX,0,+,1,1\nX,9,+,1,2\nY,0,+,1,1\n", encoding="utf-8"
    )
    with pytest.raises(InputError, match=r"readings of several axes, as its column 'Axis' says \(X and Y\)"):
        look_at(path, REGISTRY)


def test_a_misspelt_direction_is_told_at_its_place(tmp_path: Path) -> None:
    path = tmp_path / "misspelt.csv"
    path.write_text(
        "target,direction,run,deviation\n0,forward,1,1\n9,forward,1,2\n9,reverse,1,2\n0,revers,1,1\n",
        encoding="utf-8",
    )
    with pytest.raises(InputError, match=r"misspelt.csv:5:3: 'revers' is no direction; did you mean 'rev"):
        look_at(path, REGISTRY)


def test_of_a_wide_encoding_it_is_told_what_the_table_lacks(tmp_path: Path) -> None:
    path = tmp_path / "wide.txt"
    path.write_bytes("Pos\tG1\tH1\n0\t1\t2\n".encode("utf-16"))
    with pytest.raises(InputError, match="no column 'target'"):
        look_at(path, REGISTRY)


def test_means_below_a_table_are_no_rows_to_ask_about(tmp_path: Path) -> None:
    path = tmp_path / "means.csv"
    path.write_text("target,1+,1-\n0,1,2\n9,1,2\nMean,1,2\nStd. dev.,0.1,0.2\n", encoding="utf-8")
    assert not [
        question for question in look_at(path, REGISTRY).proposal.asks if "rows of numbers" in question
    ]


def test_minus_signs_between_bars_are_directions(tmp_path: Path) -> None:
    path = tmp_path / "bars.md"
    rows_ = "".join(f"| {target} | - | 3 | {target / 100} |\n" for target in (0.0, 100.0, 200.0))
    path.write_text(f"| Target mm | Dir | Run | Error µm |\n|---|---|---|---|\n{rows_}", encoding="utf-8")
    read = look_at(path, REGISTRY).read
    assert {*read.approach.tolist()} == {-1}
    np.testing.assert_allclose(read.deviation, [0.0, 1e-6, 2e-6])


#: What tables of the same readings differ in.
NAMES = {
    "de": ("Sollposition", "Abweichung", "Richtung", "Messlauf", ("vor", "zurück")),
    "en": ("Nominal position", "Deviation", "Direction", "Cycle", ("fwd", "bwd")),
}
HEADS = {
    "none": [],
    "text": ["Report of a test", "", "Machine: 4711"],
    "cells": ["Serial{d}12", "Temperature{d}20"],
}
FEET = {"none": [], "mean": ["Mittelwert{d}1{d}1{d}1"], "name": ["", "Operator: A. Miller"]}


@given(data=st.data())
@settings(max_examples=40)
def test_tables_that_differ_in_all_that_does_not_matter_are_read_alike(
    tmp_path_factory: pytest.TempPathFactory, data: st.DataObject
) -> None:
    *names, senses = NAMES[data.draw(st.sampled_from(sorted(NAMES)))]
    delimiter = data.draw(st.sampled_from([";", "\t"]))
    units = data.draw(st.sampled_from(["{} [{}]", "{} / {}", "a row"]))
    marks = ["mm", "µm", "", ""]
    header = [
        units.format(name, mark) if mark and units != "a row" else name
        for name, mark in zip(names, marks, strict=True)
    ]
    table = [
        [german(target, 3), german(value, 2), senses[sense < 0], str(run)]
        for target, sense, run, value in rows()
    ]
    order = data.draw(st.permutations(range(4)))
    lines = [
        [each[index] for index in order] for each in (header, *([marks] if units == "a row" else []), *table)
    ]
    content = [
        *(line.format(d=delimiter) for line in HEADS[data.draw(st.sampled_from(sorted(HEADS)))]),
        *(delimiter.join(line) for line in lines),
        *(line.format(d=delimiter) for line in FEET[data.draw(st.sampled_from(sorted(FEET)))]),
    ]
    has_comma = data.draw(st.booleans())
    written = text(
        *(content if has_comma else [line.replace(",", ".") for line in content]),
        encoding=data.draw(st.sampled_from(["utf-8", "utf-8-sig", "cp1252", "utf-16"])),
    )
    path = tmp_path_factory.mktemp("alike") / "table.txt"
    path.write_bytes(written)
    grid = look_at(path, REGISTRY).read.deviations()
    np.testing.assert_allclose(grid * 1e6, untidy_files.GRID, rtol=0, atol=1e-6)


def test_columns_of_several_axes_are_refused_with_their_names(tmp_path: Path) -> None:
    path = tmp_path / "pairs.csv"
    path.write_text("Position X,Error X,Position Y,Error Y\n0,1,0,2\n9,1,9,2\n", encoding="utf-8")
    sentence = (
        r"several axes side by side \('Position X' and 'Position Y'\); a test is of one: name its columns"
    )
    with pytest.raises(InputError, match=sentence):
        look_at(path, REGISTRY)


def test_a_defective_test_file_of_a_laser_is_told_as_that(tmp_path: Path) -> None:
    """The table of its targets was read as readings."""
    path = tmp_path / "x.rtl"
    path.write_text("HEADER::\n\nTARGET DATA::\nTargets :\n0,5  1,5\nFlags: 0\n", encoding="utf-8")
    with pytest.raises(InputError, match="has no section DEVIATIONS"):
        look_at(path, REGISTRY)


def test_a_table_beside_another_with_the_same_targets_is_asked_whether_it_goes_down(tmp_path: Path) -> None:
    path = tmp_path / "beside.csv"
    path.write_text("Target,Run 1,,Target,Run 1\n0,1,,0,2\n9,3,,9,4\n", encoding="utf-8")
    looked = look_at(path, REGISTRY)
    assert [question for question in looked.proposal.asks if "second column of targets" in question]
    np.testing.assert_allclose(looked.read.deviations()[:, :, 0] * 1e6, [[1, 3], [2, 4]])


def test_a_table_beside_another_with_its_targets_in_another_order_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "beside.csv"
    path.write_text("Target,Run 1,,Target,Run 1\n0,1,,9,4\n9,3,,0,2\n", encoding="utf-8")
    with pytest.raises(InputError, match=r"beside.csv:1:1: two tables stand side by side, and a row"):
        look_at(path, REGISTRY)


def test_a_deviation_that_contradicts_the_position_beside_it_is_asked_about(tmp_path: Path) -> None:
    path = tmp_path / "both.csv"
    rows = [(0, "0.002", 2), (5, "5.003", 3), (9, "9.004", 44), (12, "12.001", 1)]
    path.write_text(
        "target,actual,direction,run,deviation (um)\n"
        + "".join(f"{target},{actual},+,1,{value}\n" for target, actual, value in rows),
        encoding="utf-8",
    )
    asked = [question for question in look_at(path, REGISTRY).proposal.asks if "in line 4 right?" in question]
    assert len(asked) == 1
