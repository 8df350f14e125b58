"""The machine-readable summary."""

from __future__ import annotations

import io
import json
import sys

import pytest

from cli.commands import Shop
from zlmreport import __version__
from zlmreport.cli.terminal import print_json


def test_done_job(shop: Shop) -> None:
    shop.job()
    run = shop.run("job.yaml", "--json")
    summary = run.summary
    (job,) = summary.pop("jobs")
    assert summary == {"schema": "zlmreport/summary/1", "zlmreport": __version__, "exit_code": 0}
    (evaluation,) = job.pop("evaluations")
    assert job == {
        "job": "job.yaml",
        "number": "CAL-1",
        "kind": "report",
        "status": "done",
        "conforms": True,
        "files": ["out/CAL-1.json"],
        "missing_readings": [],
        "doubts": [],
        "evidence": [],
        "problems": [],
    }
    assert evaluation["standard"] == "exemplary:1"
    (parameter,) = evaluation["parameters"]
    value = parameter.pop("value")
    assert value == pytest.approx(2, rel=1e-12)
    assert parameter == {
        "symbol": "E",
        "name": "range",
        "unit": "um",
        "expanded_uncertainty": None,
        "coverage_factor": None,
        "limit": pytest.approx(20, rel=1e-12),
        "conforms": True,
    }


def test_failed_job_has_its_problems_with_their_places(shop: Shop) -> None:
    shop.job(("kind: report", "kind: rapport"))
    run = shop.run("job.yaml", "--json")
    assert run.code == run.summary["exit_code"] == 2
    (job,) = run.summary["jobs"]
    assert (job["status"], job["number"], job["files"], job["conforms"]) == ("failed", None, [], None)
    (problem,) = job["problems"]
    assert (problem["file"], problem["line"], problem["column"]) == ("job.yaml", 4, 9)
    assert problem["message"].startswith("certificate.kind: 'rapport' is unknown")
    assert run.messages.startswith("job.yaml:4:9: ")


def test_place_without_a_line_has_none(shop: Shop) -> None:
    (job,) = shop.run("none.yaml", "--json").summary["jobs"]
    assert job["problems"] == [
        {
            "file": "none.yaml",
            "line": None,
            "column": None,
            "message": "cannot be read: no such file or directory",
        }
    ]


def test_every_job_is_there_in_the_order_of_the_command_line(shop: Shop) -> None:
    shop.job(name="b.yaml", number="B")
    shop.job(name="a.yaml", number="A")
    summary = shop.run("b.yaml", "none.yaml", "a.yaml", "--json", "--quiet").summary
    assert [job["job"] for job in summary["jobs"]] == ["b.yaml", "none.yaml", "a.yaml"]
    assert summary["exit_code"] == 3


def test_exceeded_limit_does_not_conform(shop: Shop) -> None:
    shop.job(("{E: 20}", "{E: 1, R: 5}"))
    summary = shop.run("job.yaml", "--json", "--fail-on-nonconformity").summary
    assert summary["exit_code"] == 1
    assert summary["jobs"][0]["conforms"] is False


def test_without_limits_conformity_is_open(shop: Shop) -> None:
    shop.job(("{E: 20}", "{}"))
    assert shop.run("job.yaml", "--json").summary["jobs"][0]["conforms"] is None


def test_missing_readings_are_listed(shop: Shop) -> None:
    shop.job()
    shop.write("six.txt", "1 2 3 -1 nan -3")
    (job,) = shop.run("job.yaml", "--json").summary["jobs"]
    assert job["missing_readings"] == [{"target": 100.0, "unit": "mm", "direction": "-", "run": 1}]


@pytest.mark.parametrize(
    ("encoding", "printed"), [("utf-8", '"µ"'), ("ascii", '"\\u00b5"'), ("cp437", '"\\u00b5"')]
)
def test_letters_stand_as_they_are_only_where_all_can_stand(
    encoding: str, printed: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    stream = io.TextIOWrapper(io.BytesIO(), encoding=encoding)
    monkeypatch.setattr(sys, "stdout", stream)
    print_json("µ")
    stream.flush()
    assert stream.buffer.getvalue().decode(encoding).strip() == printed  # type: ignore[attr-defined]
    assert json.loads(printed) == "µ"
