"""What the page of a job and those of effects are told."""

from __future__ import annotations

import shutil
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from pathlib import Path
from threading import Event
from typing import Any
from unittest.mock import Mock

import numpy as np
import pytest
from starlette.testclient import TestClient

from installed import registry
from model.hidden_effect import example, example_diagnosis
from processes import PATIENCE, awaited
from replacing import replace_in
from testing.exemplary import ExemplaryStandard
from web.browsers import enter
from web.jobs import EXAMPLE
from zlmreport import pipeline
from zlmreport.document.subjects.fit import ParameterRow, write_in_a_sentence
from zlmreport.model.diagnosis.faults import DataFault, FaultKind
from zlmreport.model.diagnosis.residuals import Failure, ResidualTest
from zlmreport.model.diagnosis.study import Fitted, Study
from zlmreport.model.effects.design import place_at_positions
from zlmreport.model.fitting.estimate import Plausibility
from zlmreport.plugin import Approach, Language, same_in_all_languages as same
from zlmreport.plugin.effect import Effect
from zlmreport.plugin.standard import Arithmetic, PositionStatistics
from zlmreport.web.app import Workbench
from zlmreport.web.panels import collect_parameter
from zlmreport.web.view import collect_diagnosed


@pytest.fixture(scope="module")
def reader() -> Iterator[TestClient]:
    """Return a browser before the example, which nobody changes."""
    workbench = Workbench.of([EXAMPLE / "job.yaml"], registry())
    yield enter(workbench)
    workbench.end()


@pytest.fixture(scope="module")
def page(reader: TestClient) -> dict[str, Any]:
    """Return the example's job as the page is told of it."""
    job, results = (reader.get(f"/api/{each}?lang=en").json() for each in ("job", "results"))
    return {**job, **results}


@pytest.fixture
def study() -> Study:
    return example()


def test_deviation_is_model_and_residual(page: dict[str, Any], study: Study) -> None:
    readings = page["graphs"]["readings"]
    fitted = 1e6 * study.fit_whole().fit.fitted
    assert readings["deviation"] == pytest.approx(1e6 * study.measurements.deviation, abs=1e-6)
    assert np.subtract(readings["deviation"], readings["residual"]) == pytest.approx(fitted, abs=2e-6)


def test_residuals_can_be_laid_out_over_everything_that_was_logged(page: dict[str, Any]) -> None:
    assert [axis["key"] for axis in page["graphs"]["axes"]] == [
        "position",
        "time",
        "run",
        "direction",
        "axis_temperature",
        "screw_temperature",
        "air_temperature",
        "air_pressure",
        "relative_humidity",
    ]


def test_the_model_is_drawn_with_its_uncertainty_in_both_directions(page: dict[str, Any]) -> None:
    assert [curve["direction"] for curve in page["graphs"]["model"]] == [1, -1]
    for curve in page["graphs"]["model"]:
        assert np.all(np.less(curve["low"], curve["y"]))
        assert np.all(np.less(curve["y"], curve["high"]))


def test_a_part_of_the_model_is_drawn_as_finely_as_the_whole(browser: TestClient, study: Study) -> None:
    fitted = study.fit_whole().fit
    found = browser.get("/api/closer", params={"low": 200, "high": 201.5}).json()
    assert len(found["model"]) == len(Approach)
    for curve in found["model"]:
        x = np.array(curve["x"])
        assert (x[0], x[-1]) == (200, 201.5)
        assert len(x) >= 480
        at = place_at_positions(fitted.design, 1e-3 * x, Approach(curve["direction"]))
        assert curve["y"] == pytest.approx(1e6 * fitted.compute_value_at(at), abs=2e-6)


@pytest.mark.parametrize(
    "ends", [{"low": 3, "high": 3}, {"low": -9, "high": -8}, {"low": "a", "high": 2}, {}]
)
def test_a_part_that_there_is_not_is_said(browser: TestClient, ends: dict[str, Any]) -> None:
    assert browser.get("/api/closer", params=ends).status_code == 422


def test_standards_say_what_is_and_what_would_be(page: dict[str, Any]) -> None:
    (standard,) = page["standards"]
    accuracy = standard["rows"][0]
    assert (accuracy["value"], accuracy["by_model"]) == ("17.41", "7.98")


def test_a_standard_by_positions_is_forecast_by_the_positions_of_the_test(
    browser: TestClient, monkeypatch: pytest.MonkeyPatch
) -> None:
    class Sloping(ExemplaryStandard):
        def arithmetic(self, statistics: PositionStatistics, options: Any) -> Arithmetic:
            slope = (statistics.mean_positive[..., -1] - statistics.mean_positive[..., 0]) / np.ptp(
                statistics.positions
            )
            return replace(super().arithmetic(statistics, options), parameters={"E": slope, "R": slope})

    standard = Sloping()
    monkeypatch.setattr(pipeline, "choose_standards", lambda *_: [(standard, standard.options())])
    for row in browser.get("/api/results").json()["standards"][0]["rows"]:
        assert "–" not in {row["value"], row["by_table"], row["by_model"]}


@pytest.mark.parametrize(
    ("known", "notes"),
    [
        ({"uncertainty": "", "is_given": True}, ["given"]),
        ({"uncertainty": "", "at_bound": "max"}, ["held at max"]),
        (
            {"is_on_grid": True, "plausibility": Plausibility.IMPLAUSIBLE},
            ["grid", "outside the plausible range"],
        ),
        ({"expected": "5"}, ["expected 5 mm"]),
    ],
)
def test_a_parameter_has_the_notes_of_the_terminal(known: dict[str, Any], notes: list[str]) -> None:
    row = replace(ParameterRow("wave", "L", "L", "its length", "4.9", "0.3", "mm", 4.9), **known)
    assert collect_parameter(row, Language.ENGLISH)["notes"] == notes
    said = write_in_a_sentence(row, Language.ENGLISH)
    assert said.endswith(" ".join(f"({each})" for each in notes))


def test_the_page_is_told_of_in_german(reader: TestClient) -> None:
    german = reader.get("/api/job?lang=de").json()
    assert german["subject"] == "Achse X, Example Machine Works Example axis, EXAMPLE-X-7"
    floor = german["error"][1]
    assert (floor["name"], floor["value"]) == ("Grundrauschen", "0,480 µm")
    assert floor["meaning"].startswith("Die Streuung wiederholter Messwerte")


def test_no_word_is_there_for_nothing(reader: TestClient) -> None:
    folder = Path(__file__).parents[2] / "report_templates" / "zlmreport_templates" / "workbench"
    scripts = "\n".join(file.read_text(encoding="utf-8") for file in folder.glob("*.js"))
    words = reader.get("/api/texts").json()
    assert words
    assert [name for name in words if f"texts.{name}" not in scripts and f'"{name}"' not in scripts] == []


@pytest.mark.parametrize("effect", registry().effects, ids=lambda effect: effect.identifier)
def test_every_effect_has_a_sketch_of_one_unit(reader: TestClient, effect: Effect) -> None:
    sketch = reader.get(f"/api/effects/{effect.identifier}").json()["sketch"]
    assert np.mean(np.square(sketch["y"])) == pytest.approx(1.0, abs=1e-4)


def test_an_effect_has_its_page(browser: TestClient) -> None:
    found = browser.get("/api/effects/screw-pitch?lang=de").json()
    assert found["title"] == "Periodischer Steigungsfehler der Spindel"
    assert found["confusions"][0]["effect"] == "periodic"
    assert "keine Norm nennt sie" in found["rangesFrom"]
    assert browser.get("/api/effects/none-such").status_code == 422


@pytest.mark.long
def test_a_diagnosis_is_made_beside_and_says_how_long_it_has_been_under_way(browser: TestClient) -> None:
    found = browser.get("/api/diagnosis").json()
    assert found.keys() == {"seconds", "share"}
    diagnosis = awaited(lambda: browser.get("/api/diagnosis").json().get("diagnosis"))
    assert diagnosis["verdict"] == "missing"
    assert diagnosis["candidates"][0]["argument"] == "screw-pitch"
    first, second, _ = diagnosis["failures"]
    readings = browser.get("/api/job").json()["graphs"]
    places = [readings["readings"]["place"].index(each) for each in first["readings"]]
    assert {round(readings["axes"][0]["values"][each], 1) for each in places} == {213.4}
    assert second["axis"] == "position"


@pytest.mark.long
def test_a_diagnosis_is_stopped_and_begun_anew(browser: TestClient) -> None:
    assert "seconds" in browser.get("/api/diagnosis").json()
    assert browser.post("/api/diagnosis/stop", json={}).is_success
    assert browser.get("/api/diagnosis").json() == {"stopped": True}
    assert "seconds" in browser.get("/api/diagnosis").json()
    found = awaited(lambda: "diagnosis" in browser.get("/api/diagnosis").json())
    assert found


@pytest.mark.long
def test_a_diagnosis_that_was_made_is_there_at_once_also_for_a_copy_and_after_a_restart(
    workbench: Workbench, browser: TestClient, tmp_path: Path
) -> None:
    awaited(lambda: browser.get("/api/diagnosis").json().get("diagnosis"))
    copy = tmp_path / "copy"
    copy.mkdir()
    for name in ("job.yaml", "x-axis.csv"):
        shutil.copy(workbench.bench.path.with_name(name), copy)
    again = Workbench.of([copy / "job.yaml"], registry())
    assert again.diagnoses.find(again.bench.load().content).keys() == {"diagnosis"}
    (copy / "x-axis.csv").write_text((copy / "x-axis.csv").read_text("utf-8") + "# later\n", "utf-8")
    assert again.diagnoses.find(again.bench.load().content).keys() == {"seconds", "share"}
    again.end()


def test_a_click_waits_for_no_fit_of_a_step_and_each_is_made_once(
    workbench: Workbench, monkeypatch: pytest.MonkeyPatch
) -> None:
    bench, begun, go_on, made = workbench.bench, Event(), Event(), []
    fitted, loaded = Study.fit_whole, bench.load()

    def slow(study: Study) -> Fitted:
        begun.set()
        assert go_on.wait(PATIENCE)
        made.append(len(study.model.terms))
        return fitted(study)

    monkeypatch.setattr(Study, "fit_whole", slow)
    with ThreadPoolExecutor(3) as others:
        try:
            falls = [others.submit(bench.fit_history, loaded) for _ in range(2)]
            assert begun.wait(PATIENCE)
            assert others.submit(bench.try_job, loaded.job).result(PATIENCE).basis == loaded.basis
        finally:
            go_on.set()
        assert falls[0].result() == falls[1].result()
    assert sorted(made) == [0, 1, 2, 3]


def test_a_fit_that_fails_is_tried_again(workbench: Workbench, monkeypatch: pytest.MonkeyPatch) -> None:
    bench, loaded = workbench.bench, workbench.bench.load()
    with monkeypatch.context() as patch:
        patch.setattr(Study, "fit_whole", Mock(side_effect=MemoryError))
        with pytest.raises(MemoryError):
            bench.fit_whole(loaded)
    assert bench.fit_whole(loaded).fit.fitted.size


@pytest.mark.parametrize("step", ["3", "screw-pitch"])
def test_a_step_is_shown_before_and_after(browser: TestClient, step: str) -> None:
    found = browser.get("/api/step", params={"of": step}).json()
    before, after = (np.std(found[name]["residual"]) for name in ("before", "after"))
    assert after < before


def test_a_step_that_there_is_not_is_said(browser: TestClient) -> None:
    assert (
        "no plugin provides effect '99'"
        in browser.get("/api/step", params={"of": "99"}).json()["problems"][0]
    )


@pytest.mark.parametrize("name", ["x-axis.csv", "job.yaml"])
def test_the_page_goes_on_when_a_file_that_vanished_is_back(
    job: Path, browser: TestClient, name: str
) -> None:
    path = job.with_name(name)
    whole = browser.get("/api/job").json()
    path.rename(path.with_suffix(".away"))
    broken = browser.get("/api/job")
    assert broken.status_code == 422
    path.with_suffix(".away").rename(path)
    assert browser.get("/api/stamp").json()["stamp"] != broken.json()["stamp"]
    assert browser.get("/api/job").json() == whole


def test_the_page_goes_on_when_a_file_that_the_job_names_anew_appears(job: Path, browser: TestClient) -> None:
    replace_in(job, ("x-axis.csv", "later.csv"))
    broken = browser.get("/api/job").json()
    assert "later.csv" in broken["problems"][0]
    shutil.copy(job.with_name("x-axis.csv"), job.with_name("later.csv"))
    assert browser.get("/api/stamp").json()["stamp"] != broken["stamp"]
    assert browser.get("/api/job").status_code == 200


def test_a_job_that_has_become_wrong_is_said_with_its_place(job: Path, browser: TestClient) -> None:
    replace_in(job, ("backlash", "backlsh"))
    answer = browser.get("/api/job")
    assert answer.status_code == 422
    assert "did you mean 'backlash'?" in answer.json()["problems"][0]


def test_any_file_behind_the_job_changes_the_stamp(job: Path, browser: TestClient) -> None:
    before = browser.get("/api/job").json()["stamp"]
    readings = job.with_name("x-axis.csv")
    readings.write_text(readings.read_text(encoding="utf-8") + "# later\n", encoding="utf-8")
    assert browser.get("/api/stamp").json()["stamp"] != before


def test_the_language_is_that_of_the_address_then_of_the_browser_then_of_the_job(browser: TestClient) -> None:
    assert 'lang="de"' in browser.get("/?lang=de", headers={"Accept-Language": "en"}).text
    assert 'lang="de"' in browser.get("/", headers={"Accept-Language": "pl, de;q=0.8, en"}).text
    assert 'lang="en"' in browser.get("/", headers={"Accept-Language": "pl"}).text


def test_a_condition_that_the_residuals_follow_is_named_and_is_their_axis(study: Study) -> None:
    """The name is that of pages, the axis that of the logged column."""
    diagnosis = example_diagnosis()
    name = "screw_temperature"
    follows = Failure(ResidualTest.CONDITION, 1e-9, same(name), same("they follow"), condition=name)
    found = collect_diagnosed(
        replace(diagnosis, failures=(follows,)), study, registry().effects, Language.ENGLISH
    )
    (failure,) = found["failures"]
    assert failure["axis"] == "screw_temperature"
    assert failure["where"] == "Temperature of the screw"
    assert failure["readings"] == []


def test_readings_that_were_set_aside_by_the_diagnosis_are_pointed_at(study: Study) -> None:
    diagnosis = example_diagnosis()
    off = Failure(ResidualTest.OUTLIERS, 1e-9, same("here"), same("it stands off"))
    flagged = replace(diagnosis, failures=(off,), outliers=np.array([7, 9]))
    found = collect_diagnosed(flagged, study, registry().effects, Language.ENGLISH)
    assert found["failures"][0]["readings"] == [7, 9]


def test_a_fault_of_the_data_names_the_readings_of_its_run(study: Study) -> None:
    fault = DataFault(
        FaultKind.SWAPPED_DIRECTION, 3, 1.0, same("run 3 looks swapped"), same("correct the file")
    )
    diagnosis = replace(example_diagnosis(), faults=(fault,))
    (found,) = collect_diagnosed(diagnosis, study, registry().effects, Language.ENGLISH)["faults"]
    assert (found["statement"], found["remedy"]) == ("run 3 looks swapped", "correct the file")
    runs = study.measurements.run[found["readings"]]
    assert len(runs) == 2 * 21
    assert set(runs.tolist()) == {3}
