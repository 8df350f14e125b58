"""Every benchmark runs, on the smallest sizes: what the figures are worth is for whoever reads them."""

from __future__ import annotations

import json
import math
from importlib import import_module
from pathlib import Path
from subprocess import CompletedProcess

import pytest
from weasyprint import HTML

import processes

BENCHMARKS = Path(__file__).parents[2] / "benchmarks"


def run(*arguments: str | Path) -> CompletedProcess[str]:
    return processes.run(processes.PYTHON, BENCHMARKS, *arguments)


@pytest.mark.parametrize("name", ["warm", "cold", "evaluation", "typst", "capture", "memory"])
def test_a_benchmark_measures_on_the_smallest_sizes(name: str, tmp_path: Path) -> None:
    file = tmp_path / "results.json"
    done = run(name, "--rounds", "1", "--tests", "20", "--certificates", "2", "--json", file)
    assert done.returncode == 0, done.stderr
    lines = json.loads(file.read_text("utf-8"))["results"][name]
    assert all(math.isfinite(line["value"]) for line in lines)
    assert all(line["name"] in done.stdout for line in lines)


def test_a_benchmark_that_there_is_not_is_refused_with_those_there_are() -> None:
    done = run("speed")
    assert done.returncode == 2
    assert "'speed' is none of warm, cold, evaluation, typst" in done.stderr


def test_a_pdf_that_lacks_a_number_of_the_document_is_not_compared(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.syspath_prepend(BENCHMARKS)
    alike = import_module("alike")
    pdf = HTML(string="<p>12.34 and −5.6").write_pdf()
    assert alike.pages_of_same_document({"text": "12.34, −5.6"}, pdf) == (1,)
    with pytest.raises(ValueError, match=r"12\.35"):
        alike.pages_of_same_document({"text": "12.35, −5.6"}, pdf)


def test_documents_of_very_different_length_are_not_compared(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.syspath_prepend(BENCHMARKS)
    alike = import_module("alike")
    short = HTML(string="<p>page").write_pdf()
    long = HTML(string="<p style='break-after: page'>page" * 3).write_pdf()
    with pytest.raises(ValueError, match="different numbers of pages"):
        alike.pages_of_same_document({}, short, long)


def test_the_coverage_of_stated_uncertainties_is_counted_for_each_budget() -> None:
    done = run("coverage", "--trials", "2", "--simulated", "50", "nmtba")
    assert done.returncode == 0, done.stderr
    heading, _, *rows = done.stdout.strip().splitlines()
    assert heading == "| nmtba | P | Pa | Ps_max | Ps_mean | O |"
    shares = [float(cell) for row in rows for cell in row.split("|")[2:-1]]
    assert len(shares) == 5 * 5
    assert set(shares) <= {0.0, 50.0, 100.0}
