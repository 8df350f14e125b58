"""What ``import zlmreport as z`` offers: users' units, checks as of a job, the numbers of a certificate."""

from __future__ import annotations

import doctest
import html
import json
import os
import pickle
import subprocess
import sys
from collections.abc import Callable
from dataclasses import replace
from importlib import import_module
from pathlib import Path
from types import SimpleNamespace
from typing import Any, Literal

import matplotlib as mpl
import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
import polars as pl
import pytest

import zlmreport as z
from environments import ROOT
from zlmreport.verification.findings import VerificationVerdict

JOB = ROOT / "configs" / "linear-axis" / "certificate.yaml"
TARGETS = [0.0, 100.0, 250.0]
UP = [[0.0, 1.2, 2.1], [0.1, 1.0, 2.3]]
DOWN = [[-1.0, 0.4, 1.0], [-1.1, 0.2, 0.9]]


def data() -> z.Readings:
    return z.test(TARGETS, UP, DOWN)


def simulated(**keys: object) -> z.Readings:
    return z.simulate(
        axis={"name": "X", "travel": [0, 1000]},
        targets={"count": 21},
        noise={"reading": 0.3},
        effects=[{"backlash": {"lost_motion": 4}}],
        **keys,
    )


def test_every_name_of_the_face_is_there() -> None:
    assert [name for name in z.__all__ if not hasattr(z, name)] == []


def test_the_face_loads_nothing_before_it_is_used() -> None:
    program = "import sys, zlmreport; print(*sorted(m for m in sys.modules if m.startswith('zlmreport')))"
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True)
    assert done.stdout.split() == ["zlmreport", "zlmreport.version"]


@pytest.mark.parametrize("first", ["zlmreport.document.certificate.document", "zlmreport.notebook.documents"])
def test_the_function_certificate_is_there_beside_the_room_of_its_name(first: str) -> None:
    import_module(first)
    assert z.certificate(JOB).number == "EXAMPLE-2026-0001"


@pytest.mark.parametrize("module", ["results", "models", "plans"])
def test_the_examples_in_the_documentation_are_true(module: str) -> None:
    assert doctest.testmod(import_module(f"zlmreport.notebook.{module}")).failed == 0


def test_arrays_come_back_as_they_were_given() -> None:
    assert data().targets.tolist() == TARGETS
    np.testing.assert_allclose(data().up, UP, atol=1e-12)
    np.testing.assert_allclose(data().down, DOWN, atol=1e-12)


def test_targets_may_come_in_any_order() -> None:
    turned = z.test(TARGETS[::-1], np.array(UP)[:, ::-1], np.array(DOWN)[:, ::-1])
    np.testing.assert_allclose(turned.up, UP, atol=1e-12)


def test_a_reading_that_is_not_a_number_is_missing() -> None:
    found = z.test(TARGETS, [[0.0, np.nan, 2.0], [0.0, 1.0, 2.0]], DOWN)
    assert np.isnan(found.up[0, 1])
    assert "1 missing" in repr(found)


def test_arrays_that_do_not_fit_together_are_refused_with_the_shape_that_would() -> None:
    with pytest.raises(z.InputError, match=r"up has the shape \(1, 2\); \(runs, 3\) is expected"):
        z.test(TARGETS, [[0.0, 1.0]])


def test_a_rotary_axis_is_read_in_degrees_and_arc_seconds() -> None:
    found = z.test([0, 90, 180], UP, axis={"name": "C", "kind": "rotary"})
    assert found.unit == "arcsec"
    assert found.targets.tolist() == pytest.approx([0, 90, 180])


def test_a_job_gives_the_numbers_of_its_certificate(tmp_path: Path) -> None:
    path = z.certificate(JOB).save(tmp_path / "x.json")
    stated = json.loads(path.read_bytes())["evaluations"][0]["parameters"]
    result = z.evaluate(z.read(JOB), "iso230-2:2014")
    assert {each.symbol: each.value for each in result} == {each["symbol"]: each["value"] for each in stated}


def test_a_result_that_is_looked_at_in_two_ways_is_one() -> None:
    bare, limited = (z.evaluate(data(), "iso230-2:2014", tolerances=each) for each in (None, {"A": 9}))
    assert [each.value for each in bare] == [each.value for each in limited]
    assert bare.to_dict()["parameters"][0]["value"] == bare["A"].value


@pytest.mark.parametrize(("limit", "conforms"), [(9, True), (1, False)])
def test_a_limit_is_decided(limit: float, *, conforms: bool) -> None:
    assert z.evaluate(data(), "iso230-2:2014", tolerances={"A": limit})["A"].conforms is conforms


def test_a_parameter_that_the_test_does_not_define_is_answered_with_those_it_does() -> None:
    result = z.evaluate(z.test(TARGETS, UP), "iso230-2:2014")
    with pytest.raises(KeyError, match="gives no 'B' for this test"):
        result["B"]


@pytest.mark.parametrize(
    ("keys", "message"),
    [
        ({"standard": "iso230-2:2O14"}, "did you mean 'iso230-2:2014'"),
        ({"standard": "nmtba", "tolerances": {"Q": 1}}, "'Q' is no parameter of nmtba"),
        ({"standard": "nmtba", "tolerances": {"P": -1}}, "is not a number greater than 0"),
        ({"standard": "nmtba", "tolerances": {"P": "wide"}}, "tolerances.P: 'wide' is not a number"),
        ({"standard": "nmtba", "decision_rule": "hope"}, "'hope' is unknown"),
        ({"standard": "nmtba", "toleranzen": 1}, "unknown key 'toleranzen'"),
    ],
)
def test_what_is_asked_is_checked_as_in_a_job(keys: dict[str, object], message: str) -> None:
    with pytest.raises(z.InputError, match=message):
        z.evaluate(data(), **keys)


@pytest.mark.parametrize(
    "framed",
    [
        lambda each: each.to_frame("pandas"),
        lambda each: each.to_frame("polars"),
        lambda each: each.to_frame("polars").to_dict(as_series=False),
    ],
    ids=["pandas", "polars", "dict"],
)
def test_a_frame_goes_out_and_comes_in(framed: Callable[[z.Readings], Any]) -> None:
    found = z.read(framed(z.read(JOB)), axis="Y")
    again, stated = (z.evaluate(each, "nmtba") for each in (found, z.read(JOB)))
    assert [each.value for each in again] == pytest.approx([each.value for each in stated])


@pytest.mark.parametrize("library", ["pandas", "polars"])
def test_a_frame_is_of_the_library_that_is_asked_for(library: Literal["pandas", "polars"]) -> None:
    frame = data().to_frame(library)
    assert type(frame).__module__.partition(".")[0] == library
    assert (len(frame), list(frame.columns)) == (12, ["target", "direction", "run", "deviation"])


@pytest.mark.parametrize("frame", [pd.DataFrame, pl.DataFrame, pl.LazyFrame], ids=lambda each: each.__name__)
def test_tables_are_of_the_library_that_the_readings_came_from(frame: Any) -> None:
    found = z.read(frame({"target": [0, 5, 9], "direction": ["+"] * 3, "deviation": [0.5, 1, 2]}))
    library = frame.__module__.partition(".")[0]
    tables = (found.to_frame(), z.evaluate(found, "nmtba").positions, z.fit(found, ["offset"]).at([1]))
    assert {type(each).__module__.partition(".")[0] for each in tables} == {library}


def test_of_libraries_that_are_there_the_one_in_use_is_taken(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delitem(sys.modules, "pandas")
    assert isinstance(data().to_frame(), pl.DataFrame)


def test_without_a_library_of_frames_a_table_is_a_structured_array(monkeypatch: pytest.MonkeyPatch) -> None:
    fitted = z.fit(simulated(), ["offset", "backlash"])
    for library in ("pandas", "polars", "pyarrow"):
        monkeypatch.delitem(sys.modules, library, raising=False)
    nothing_else = SimpleNamespace(find_spec=lambda *_: None)
    monkeypatch.setattr(sys, "meta_path", [nothing_else])
    table = fitted.at([10, 500])
    assert isinstance(table, np.ndarray)
    assert len(table) == 2
    assert table.dtype.names == ("position", "up", "U_up", "down", "U_down")
    assert table["position"].tolist() == pytest.approx([10, 500])


def test_a_library_that_is_not_there_is_named() -> None:
    with pytest.raises(z.InputError, match="did you mean 'pandas'"):
        data().to_frame("panda")  # type: ignore[arg-type]  # what somebody mistyped


def test_a_row_of_a_table_is_a_position() -> None:
    assert len(z.fit(simulated(), ["offset", "backlash"]).at([10, 500, 900])) == 3


def test_positions_of_a_frame_are_actual_positions() -> None:
    found = z.read({"target": [0, 1], "direction": [1, 1], "position": [0.001, 1.0]})
    np.testing.assert_allclose(found.up, [[1.0, 0.0]], atol=1e-9)


def test_conditions_of_a_frame_are_kept_in_their_units() -> None:
    readings = {"target": [0, 1], "direction": ["up", "up"], "deviation": [0, 1]}
    found = z.read({**readings, "air_temperature": [21, 22]})
    assert found.to_frame()["air_temperature"].tolist() == pytest.approx([21, 22])
    assert found.measurements.conditions["air_temperature"][0] == pytest.approx(294.15)


@pytest.mark.parametrize(
    ("columns", "message"),
    [
        ({"target": [0]}, "no column direction, deviation or position"),
        ({"target": [0], "direction": ["x"], "deviation": [0]}, "columns:1:1: 'x' is no direction"),
        ({"target": ["a"], "direction": ["+"], "deviation": [0]}, "columns: target is no array of numbers"),
        ({"target": [0], "direction": ["+"], "deviation": [0], "oil": ["warm"]}, "oil is no array of numb"),
        (
            {"target": [0, 1], "direction": ["+"], "deviation": [0, 1], "run": [1, 1, 1]},
            "columns: target has 2 rows, and not as many: direction 1, run 3",
        ),
    ],
)
def test_a_frame_that_lacks_something_is_refused(columns: dict[str, list[object]], message: str) -> None:
    with pytest.raises(z.InputError, match=message):
        z.read(columns)


@pytest.mark.parametrize(
    ("axis", "name"), [(None, "X"), ("Y", "Y"), ({"screw_pitch": 10}, "X"), ({"kind": "rotary"}, "C")]
)
def test_an_axis_needs_no_name(axis: Any, name: str) -> None:
    assert z.test(TARGETS, UP, DOWN, axis=axis).measurements.axis.name == name


def test_keys_of_the_axis_stand_instead_of_those_of_a_job(tmp_path: Path) -> None:
    axis = z.read(small_job(tmp_path), axis={"screw_pitch": 2.5}).measurements.axis
    assert (axis.name, axis.screw_pitch) == ("X", 0.0025)
    with pytest.raises(z.InputError, match="the readings of the job are of a linear axis"):
        z.read(small_job(tmp_path), axis={"kind": "rotary"})


@pytest.mark.parametrize("source", [None, 3, [1, 2]])
def test_what_is_neither_a_file_nor_columns_is_refused(source: Any) -> None:
    with pytest.raises(z.InputError, match="no path of a file, and no frame"):
        z.read(source)


@pytest.mark.parametrize(
    "work",
    [
        lambda given: z.evaluate(given, "nmtba"),
        lambda given: z.fit(given, ["offset"]),
        lambda given: z.compensate(given, "csv", active="none"),
    ],
)
def test_what_is_no_readings_is_told_how_to_become_some(work: Callable[[Any], object]) -> None:
    with pytest.raises(z.InputError, match=r"a list holds no readings of an axis; z\.test"):
        work([1, 2])


def test_arrays_of_other_things_than_numbers_are_refused() -> None:
    with pytest.raises(z.InputError, match="up is no array of numbers"):
        z.test([0, 1], [["a", "b"]])


@pytest.mark.parametrize("side", [UP, DOWN])
def test_a_single_run_one_way_is_compensated(side: list[list[float]]) -> None:
    made = z.compensate(z.test(TARGETS, side[:1]), "linuxcnc", active="none")
    assert made.after["E"] == pytest.approx(0, abs=1e-6)
    assert "<table" in made._repr_html_()


def test_results_models_and_compensations_can_be_pickled(tmp_path: Path) -> None:
    found = data()
    stated = z.certificate(small_job(tmp_path)).results[0]
    model = z.fit(found, ["offset", "backlash"])
    for each in (
        *(found, z.evaluate(found, "iso230-2:2014", tolerances={"A": 9}), z.evaluate(found, "nmtba"), stated),
        *(model, model.diagnose(), model.build(), z.compensate(found, "csv", active="none")),
    ):
        again = pickle.loads(pickle.dumps(each))
        assert repr(again) == repr(each)
        assert again._repr_html_() == each._repr_html_() if hasattr(each, "_repr_html_") else True
    assert not pickle.loads(pickle.dumps(found)).measurements.deviation.flags.writeable


def test_what_is_installed_is_listed_by_its_names() -> None:
    standards, effects = z.standards(), z.effects()
    assert standards["nmtba"].symbols == ("P", "Pa", "Ps_max", "Ps_mean", "O")
    assert effects["backlash"].parameters == {"lost_motion": "um"}
    assert "order" in effects["polynomial"].keys


def test_a_plan_of_keys_is_that_of_a_job(tmp_path: Path) -> None:
    keys = {"axis": {"name": "X", "travel": [0, 100]}, "plan": {"targets": {"count": 6}}}
    job = tmp_path / "job.yaml"
    source = {"source": {"plugin": "laser-csv", "file": "not-there.csv"}}
    rest = {"schema": "zlmreport/job/1", "certificate": {"number": "plan", "kind": "report"}}
    job.write_text(json.dumps({**rest, **keys, "measurement": source, "evaluate": ["iso230-2:2014"]}))
    of_keys, of_job = z.plan(**keys), z.plan(job)
    assert of_keys.to_dict() == of_job.to_dict()
    assert of_keys.targets.tolist() == of_keys.to_frame()["target"][:6].to_list()
    assert of_keys.minutes > 0
    assert of_keys.hidden["drive-period"] == "the job does not state axis.screw_pitch"


def test_a_plan_asks_only_for_effects_of_what_is_measured() -> None:
    planned = z.plan(
        axis={"name": "Y", "travel": [0, 400]}, measurement={"error": "EXY"}, evaluate=["iso230-1:2012"]
    )
    seen = {each["effect"] for each in planned.to_dict()["visibility"]}
    assert "backlash-gradient" in seen
    assert not seen & {"compensation-sign", "dead-path", "air-index"}


def test_a_plan_that_makes_no_sense_is_refused() -> None:
    with pytest.raises(z.InputError, match="axis"):
        z.plan(axis={"name": "X", "travel": [0, "far"]})


def test_a_diagnosis_says_what_a_pitch_that_nobody_stated_would_decide() -> None:
    asks = z.fit(simulated(), ["offset"]).diagnose().asks
    assert any(each.startswith("Screw pitch (mm)") and "screw-pitch" in each for each in asks)


def test_a_file_that_nobody_reads_by_its_suffix_needs_a_data_source() -> None:
    with pytest.raises(z.InputError, match="name the data source"):
        z.read("x.unknown")


def test_a_file_of_measurements_is_read_by_its_suffix(tmp_path: Path) -> None:
    path = tmp_path / "x.csv"
    path.write_text("Soll,direction,deviation\n0,+,1\n5,+,2\n", encoding="utf-8")
    assert z.read(path, columns={"target": "Soll"}).up.tolist() == [[1.0, 2.0]]


def test_the_same_seed_gives_the_same_readings() -> None:
    one, same, other = simulated(), simulated(seed=1), simulated(seed=2)
    assert np.array_equal(one.up, same.up)
    assert not np.array_equal(one.up, other.up)


def test_keys_stand_instead_of_those_of_a_simulation_file(tmp_path: Path) -> None:
    path = tmp_path / "spec.yaml"
    path.write_text(
        "schema: zlmreport/simulation/1\nseed: 1\naxis: {name: X, travel: [0, 10]}\ntargets: {count: 5}\n",
        encoding="utf-8",
    )
    assert len(z.simulate(path).up) == 5
    assert len(z.simulate(path, runs=2).up) == 2


def test_a_model_says_its_numbers_in_users_units() -> None:
    model = z.fit(simulated(), ["offset", "backlash"])
    lost_motion = model["backlash.lost_motion"]
    assert (lost_motion.value, lost_motion.unit) == (pytest.approx(4, abs=0.2), "um")
    assert model.rms == pytest.approx(0.3, rel=0.2)
    table = model.at([10, 500])
    assert (table["up"] - table["down"]).tolist() == pytest.approx([lost_motion.value] * 2)


def test_the_covariance_is_that_of_the_parameters() -> None:
    model = z.fit(simulated(), ["offset", "backlash", {"scale-error": {"slope": 0}}])
    estimated = [each for each in model.parameters if not each.given]
    deviations = np.sqrt(np.diag(model.covariance))
    expected = [each.expanded_uncertainty / each.coverage_factor for each in estimated]
    assert deviations.tolist() == pytest.approx(expected)


def test_residuals_are_readings_less_model() -> None:
    found = simulated()
    model = z.fit(found, ["offset", "backlash"])
    together = model.residuals["residual"] + model.fitted["deviation"]
    assert np.sort(together).tolist() == pytest.approx(np.sort(found.to_frame()["deviation"]).tolist())


def test_what_is_missing_is_found_and_added() -> None:
    model = z.fit(simulated(seed=2), ["offset"])
    diagnosis = model.diagnose()
    assert (diagnosis.verdict, diagnosis.candidates[0].effect) == ("missing", "backlash")
    whole = model.add(diagnosis.candidates[0])
    assert whole.diagnose().verdict == "adequate"
    assert whole.remove("backlash").effects == model.effects


def test_nothing_is_said_beyond_what_was_measured() -> None:
    with pytest.raises(z.InputError, match="lies outside of what was measured"):
        z.fit(simulated(), ["offset"]).at([2000])


@pytest.mark.parametrize("positions", [["x"], [], [[1.0, 2.0]]])
def test_a_model_is_asked_at_positions_that_are_numbers(positions: Any) -> None:
    with pytest.raises(z.InputError, match=r"^at: positions are"):
        z.fit(data(), ["offset"]).at(positions)


@pytest.mark.parametrize("effects", ["offset", {"offset": {}}])
def test_a_single_effect_is_told_to_be_a_list(effects: Any) -> None:
    with pytest.raises(z.InputError, match=r"effects are a list; for a single one write \["):
        z.fit(data(), effects)


def test_an_unknown_effect_is_answered_with_the_nearest() -> None:
    with pytest.raises(z.InputError, match="did you mean 'backlash'"):
        z.fit(data(), ["backlsh"])


def test_graphs_are_drawn_on_axes() -> None:
    from matplotlib.figure import Figure

    mpl.use("Agg")
    ax = Figure().subplots()
    result = z.evaluate(data(), "iso230-2:2014")
    assert result.plot(ax) is ax
    assert ax.get_xlabel() == "Target position in mm"
    assert z.fit(simulated(), ["offset"]).plot().get_ylabel() == "Deviation in µm"


def test_all_graphs_that_a_standard_prescribes_are_drawn() -> None:
    mpl.use("Agg")
    result = z.evaluate(data(), "iso230-2:2014")
    drawn = result.plots()
    assert tuple(drawn) == result.graphs
    assert all(axes.get_xlabel() or axes.get_ylabel() for panels in drawn.values() for axes in panels)
    plt.close("all")


def test_all_graphs_of_a_model_are_drawn() -> None:
    mpl.use("Agg")
    drawn = z.fit(simulated(), ["offset"]).plots()
    assert tuple(drawn) == ("model", "estimate", "residuals-run", "residuals-time")
    assert all(axes.get_ylabel() for panels in drawn.values() for axes in panels)
    plt.close("all")


def test_a_graph_that_there_is_not_is_answered_with_those_there_are() -> None:
    with pytest.raises(KeyError, match="has no graph 'x'"):
        z.evaluate(data(), "iso230-2:2014").plot(graph="x")


def test_each_result_shows_itself_in_a_notebook() -> None:
    model = z.fit(simulated(), ["offset"])
    result = z.evaluate(data(), "nmtba", tolerances={"P": 9})
    for each in (data(), result, model, model.diagnose(), model.residuals):
        page = each._repr_html_()
        assert "<table" in page
        assert "nan" not in page


def test_a_diagnosis_says_in_a_notebook_what_it_says_elsewhere() -> None:
    diagnosis = z.fit(simulated(), ["offset"]).diagnose()
    page = diagnosis._repr_html_()
    assert f"<h4>Verdict</h4><p>{html.escape(diagnosis.statement)}</p>" in page
    for each in (*diagnosis.failures, *(candidate.explains for candidate in diagnosis.candidates[:1])):
        assert html.escape(each) in page


def test_texts_in_a_table_are_no_markup() -> None:
    found = z.read({"target": [0], "direction": ["+"], "deviation": [1], "<b>": [2]})
    assert "&lt;b&gt;" in found._repr_html_()


def small_job(folder: Path) -> Path:
    job = folder / "job.yaml"
    job.write_text(
        "schema: zlmreport/job/1\ncertificate: {number: R-1, kind: report}\naxis: {name: X}\n"
        "measurement: {source: {plugin: laser-csv, file: x.csv}}\nevaluate: [nmtba]\n"
        "output: {formats: [json, html]}\n",
        encoding="utf-8",
    )
    (folder / "x.csv").write_text("target,direction,deviation\n0,+,1\n5,+,2\n", encoding="utf-8")
    return job


def test_a_folder_gets_all_formats_of_the_job(tmp_path: Path) -> None:
    z.certificate(small_job(tmp_path)).save(tmp_path / "out")
    assert sorted(path.name for path in (tmp_path / "out").iterdir()) == ["R-1.html", "R-1.json"]


def test_a_folder_that_is_there_may_have_a_dot_in_its_name(tmp_path: Path) -> None:
    (folder := tmp_path / "certificates.2026").mkdir()
    z.certificate(small_job(tmp_path)).save(folder)
    assert sorted(path.name for path in folder.iterdir()) == ["R-1.html", "R-1.json"]


def test_a_format_that_nobody_writes_is_refused(tmp_path: Path) -> None:
    with pytest.raises(z.InputError, match=r"no renderer writes \.docx files"):
        z.certificate(JOB).save(tmp_path / "x.docx")


def test_a_certificate_is_verified(tmp_path: Path) -> None:
    found = z.verify(z.certificate(small_job(tmp_path)).save(tmp_path / "x.pdf"))
    assert found.holds
    assert found.number == "R-1"
    assert found.differences == ()
    assert repr(found) == "<Verification of R-1: holds>"
    open_page = replace(found._found.pages[0], verdict=VerificationVerdict.OPEN)
    undecided = type(found)(found.file, replace(found._found, pages=(open_page,)))
    assert not undecided
    assert repr(undecided) == "<Verification of R-1: not decided>"
    assert "R-1: not decided" in undecided._repr_html_()


def test_a_tolerance_of_a_printed_symbol_is_answered_with_its_spelling() -> None:
    with pytest.raises(z.InputError, match="'A↑' is written A_fwd in a job"):
        z.evaluate(data(), "iso230-2:2014", tolerances={"A↑": 5})


def test_compensation_takes_away_the_means() -> None:
    made = z.compensate(data(), "csv", active="none")
    assert (made.controller, made.confidence) == ("csv", "verified")
    assert made.table["position"].tolist() == TARGETS
    np.testing.assert_allclose(made.table["forward"], np.mean(UP, axis=0), atol=1e-9)
    np.testing.assert_allclose(made.table["reverse"], np.mean(DOWN, axis=0), atol=1e-9)
    assert made.before["E"] == pytest.approx(z.evaluate(data(), "iso230-2:2014")["E"].value)
    assert made.after["E"] < 0.02 * made.before["E"]
    assert made.between < 2.0
    assert "E" in made._repr_html_()
    assert repr(made).startswith("<compensation for csv (verified): E 3.25 → ")


def test_files_of_a_compensation_are_those_of_the_command(tmp_path: Path) -> None:
    made = z.compensate(data(), "linuxcnc", active="none", number="X17", type=0)
    assert made.save(tmp_path / "tables") == tmp_path / "tables"
    (file,) = (tmp_path / "tables").iterdir()
    assert (file.name, file.read_text(encoding="ascii")) == ("X17.comp", made.files["X17.comp"])
    with pytest.raises(z.ZlmreportError):
        made.save(tmp_path / "tables")


@pytest.mark.parametrize(
    ("controller", "keys", "sentence"),
    [
        ("linuxnc", {"active": "none"}, "did you mean 'linuxcnc'?"),
        ("fanuc", {"active": "none"}, "unconfirmed=True writes it all the same"),
        ("linuxcnc", {"active": "none", "typ": 0}, "did you mean 'type'?"),
        ("csv", {"active": "of the axis"}, "the axis of these readings has no table"),
    ],
)
def test_compensation_that_would_be_wrong_is_refused(
    controller: str, keys: dict[str, object], sentence: str
) -> None:
    with pytest.raises(z.InputError) as caught:
        z.compensate(data(), controller, **keys)  # type: ignore[arg-type]  # of every kind of mistake
    assert sentence in str(caught.value)


@pytest.mark.parametrize(("first", "threads"), [("", "1"), ("import numpy; ", "None"), ("", "3")])
def test_small_matrices_have_one_thread_unless_somebody_else_decides(first: str, threads: str) -> None:
    code = f"{first}import os, zlmreport; zlmreport.InputError; print(os.environ.get('OPENBLAS_NUM_THREADS'))"
    own = {name: each for name, each in os.environ.items() if name != "OPENBLAS_NUM_THREADS"}
    stated = {"OPENBLAS_NUM_THREADS": threads} if threads == "3" else {}
    said = subprocess.run(
        [sys.executable, "-c", code], env=own | stated, capture_output=True, text=True, check=True
    )
    assert said.stdout.strip() == threads


def test_the_plan_of_a_circle_is_refused_with_the_command_that_plans_it() -> None:
    with pytest.raises(z.InputError, match="a path and no targets; zlmreport plan prints it"):
        z.plan(ROOT / "configs" / "circle" / "certificate.yaml")


def test_several_lines_are_no_readings_of_one_and_it_is_told_who_evaluates_them() -> None:
    square = ROOT / "configs" / "machine" / "xy-squareness.yaml"
    said = r"several lines \(x, y\), and readings are of one; z\.certificate\(job\)\.results has"
    with pytest.raises(z.InputError, match=said):
        z.read(square)
    certificate = z.certificate(square)
    assert repr(certificate.data) == "<Readings of several lines: x, y>"
    with pytest.raises(z.InputError, match=said):
        z.evaluate(certificate.data, "iso230-1:2012")


def test_a_symbol_or_a_parameter_that_is_there_is_in_its_result_or_model() -> None:
    data = z.test([0, 100, 200], [[0, 1, 2], [0, 1, 3]], [[-1, 0, 1], [-1, 0, 2]])
    result, model = z.evaluate(data, "nmtba"), z.fit(data, ["offset", "scale-error"])
    assert ["P" in result, result["P"] in result, "Q" in result] == [True, True, False]
    assert ["offset.offset" in model, "offset" in model] == [True, False]
    assert [each.name for each in model] == ["offset", "slope"]


def test_arrays_that_are_none_are_no_readings() -> None:
    with pytest.raises(z.InputError, match="holds no readings; up is an array of them"):
        z.test([0, 1], None)  # type: ignore[arg-type]
