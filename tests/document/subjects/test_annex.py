"""The annex on the error model, as text: every sentence that a customer reads."""

from __future__ import annotations

import os
import re
from dataclasses import replace
from functools import cache
from pathlib import Path

import pytest

from document.certificate.documents import lines_of
from installed import registry
from model.hidden_effect import CONFIG, LAST, job, written
from model.test_statements import LEFT
from zlmreport import pipeline
from zlmreport.document.subjects.annex import Modelled
from zlmreport.job.evaluation_keys import PriorsKeys
from zlmreport.model.diagnosis.diagnosis import AxisDiagnosis, DiagnosisVerdict
from zlmreport.model.diagnosis.residuals import Failure, ResidualTest
from zlmreport.plugin import Language, same_in_all_languages
from zlmreport.plugin.extension import Job
from zlmreport.plugin.renderer import Certificate, Facts, Graph, Section, Writer

GOLDEN = Path(__file__).with_name("golden")
#: Numbers are held by the tests of what computes them.
_NUMBER = re.compile(r"\d+([.,]\d+)?")


@cache
def modelled(path: Path = CONFIG / "job.yaml") -> Modelled:
    """Return the error model of a job, studied."""
    loaded = job(path)
    return pipeline.fit_model(loaded, pipeline.read(loaded, registry()), registry())


def section(of: Modelled, language: Language = Language.ENGLISH) -> Section:
    loaded = job(CONFIG / "job.yaml")
    return of.lay_out_section(Writer.of(pipeline.read(loaded, registry()), language))


def text(of: Modelled, language: Language = Language.ENGLISH) -> str:
    annex = section(of, language)
    return (
        "\n".join([f"# {annex.title}", *(line for block in annex.blocks for line in lines_of(block))]) + "\n"
    )


def with_diagnosis(**changes: object) -> Modelled:
    """Return the example with parts of its diagnosis replaced."""
    diagnosis: AxisDiagnosis = replace(modelled().diagnosis, **changes)
    return replace(modelled(), diagnosis=diagnosis)


def figures(of: Modelled) -> list[str]:
    return [block.figure.key for block in section(of).blocks if isinstance(block, Graph)]


def failure(test: ResidualTest, where: str = "somewhere") -> Failure:
    condition = where if test is ResidualTest.CONDITION else ""
    return Failure(
        test,
        0.001,
        same_in_all_languages(where),
        same_in_all_languages("the residual does something"),
        condition=condition,
    )


def composed(loaded: Job) -> Certificate:
    return pipeline.compose(loaded, registry())


def test_annex_that_expects_what_earlier_tests_say_rests_on_them_too() -> None:
    priors = PriorsKeys(schema="zlmreport/priors/1", kind="linear", tests=4, noise={}, effects={})
    study = replace(modelled().study, job=replace(modelled().study.job, priors=priors))
    assert "readings of this document alone" in text(modelled())
    said = text(replace(modelled(), study=study))
    assert "readings of this document alone" not in said
    assert "on what earlier tests say of scatter and of the sizes of effects" in said


@pytest.mark.parametrize("language", [Language.ENGLISH, Language.GERMAN])
def test_the_text_of_the_annex_is_what_was_read_and_approved(language: Language) -> None:
    """Set ZLMREPORT_APPROVE=1 to take the present text as approved, and read the difference."""
    wording = _NUMBER.sub("#", text(modelled(), language))
    approved = GOLDEN / f"model-annex.{language}.txt"
    if os.environ.get("ZLMREPORT_APPROVE"):
        approved.write_text(wording, encoding="utf-8")
    assert wording == approved.read_text(encoding="utf-8")


def test_the_annex_is_marked_as_an_opinion_before_anything_else() -> None:
    head = text(modelled()).splitlines()[:2]
    assert "opinion and interpretation" in head[0]
    assert (
        head[1] == "! Opinion and interpretation (ISO/IEC 17025:2017, 7.8.7), not a result of the measurement"
    )


@pytest.mark.long
def test_the_annex_stands_after_all_results(tmp_path: Path) -> None:
    document = composed(job(written(tmp_path)))
    assert [each.key for each in document.sections][-1] == "model"


def test_a_job_without_a_model_has_no_annex(tmp_path: Path) -> None:
    effects = f"model:\n  effects:\n    - offset\n    - scale-error\n{LAST}"
    document = composed(job(written(tmp_path, (effects, ""))))
    assert "model" not in [each.key for each in document.sections]
    assert document.diagnosis is None


def test_the_plugins_of_the_effects_are_named(tmp_path: Path) -> None:
    assert "backlash" in composed(job(written(tmp_path))).plugins


def test_an_adequate_model_shows_no_candidates() -> None:
    shown = text(with_diagnosis(verdict=DiagnosisVerdict.ADEQUATE, candidates=(), failures=()))
    assert "may lack" not in shown
    assert "No test of the residuals fails" in shown


def test_the_graphs_that_every_annex_has() -> None:
    assert figures(with_diagnosis(failures=()))[:3] == ["model", "estimate", "fall"]


def test_a_last_bar_shows_the_error_with_what_the_model_lacks() -> None:
    missing = modelled().diagnosis.candidates[0]
    (fall,) = (
        block.figure
        for block in section(modelled()).blocks
        if isinstance(block, Graph) and block.figure.key == "fall"
    )
    *_, last = fall.panels[0].bars
    assert last.label.in_language(Language.ENGLISH) == f"with {missing.identifier}"
    assert last.y == pytest.approx(1e6 * missing.error.rms)


def test_what_has_no_name_stands_behind_the_verdict_under_its_title() -> None:
    unexplained = with_diagnosis(
        verdict=DiagnosisVerdict.UNEXPLAINED, together=(), candidates=(), remainder=LEFT
    )
    blocks = section(unexplained).blocks
    headings = [each.heading for each in blocks if isinstance(each, Facts)]
    assert headings[:2] == ["Error of the model", "What is left without a name"]
    shown = text(unexplained)
    assert shown.index("a bump") < shown.index("Where the model fails")


def test_where_nothing_has_a_name_no_bar_shows_what_is_lacking() -> None:
    (fall,) = (
        block.figure
        for block in section(with_diagnosis(verdict=DiagnosisVerdict.UNEXPLAINED)).blocks
        if isinstance(block, Graph) and block.figure.key == "fall"
    )
    assert fall.panels[0].bars[-1].label.in_language(Language.ENGLISH) == "+ backlash"


def test_a_remedy_is_only_of_what_the_verdict_names() -> None:
    assert "What to do" in text(modelled())
    assert "What to do" not in text(with_diagnosis(verdict=DiagnosisVerdict.UNEXPLAINED))


@pytest.mark.parametrize(
    ("failed", "graphs"),
    [
        (failure(ResidualTest.RUNS), ["residuals-run"]),
        (failure(ResidualTest.TIME_ORDER), ["residuals-time", "slopes-time"]),
        (failure(ResidualTest.PERIOD_IN_TIME), ["residuals-time", "slopes-time"]),
        (failure(ResidualTest.CONDITION, "air_pressure"), ["residuals-air-pressure"]),
    ],
)
def test_a_test_that_fails_brings_the_graph_that_shows_it(failed: Failure, graphs: list[str]) -> None:
    assert figures(with_diagnosis(failures=(failed,))) == ["model", "estimate", "fall", *graphs]


@pytest.mark.long
def test_an_effect_that_no_table_takes_away_is_named(tmp_path: Path) -> None:
    warm = modelled(written(tmp_path, (LAST, f"{LAST}    - thermal-drift\n")))
    assert "thermal-drift: not fixed in position" in text(warm)
    assert "not fixed in position" not in text(modelled())


def test_of_what_no_control_corrects_it_is_said_how_the_error_falls_and_nothing_more() -> None:
    """A straightness has an error model, and no standard says what a compensation would leave of it."""
    lines = text(replace(modelled(), forecasts=())).splitlines()
    assert any(line.strip() == "How the error falls" for line in lines)
    assert any(
        line.strip().startswith("Effect | ") and line.strip().endswith("| Runs left out µm") for line in lines
    )
    assert not [line for line in lines if "after compensation" in line]
