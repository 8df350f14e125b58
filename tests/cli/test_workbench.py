"""The command of the workbench, up to where a browser takes over."""

from __future__ import annotations

import gc
import socket
import sys
import warnings
from pathlib import Path

import pytest

from zlmreport.cli import main
from zlmreport.cli.arguments import parse

EXAMPLE = Path(__file__).parents[2] / "configs" / "hidden-effect" / "job.yaml"


@pytest.mark.parametrize("package", ["starlette", "uvicorn"])
def test_an_extra_that_is_missing_is_said_with_how_to_install_it(
    package: str, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    for name in [name for name in sys.modules if name.partition(".")[0] == package]:
        monkeypatch.delitem(sys.modules, name)
    for name in ("app", "guard", "serve"):
        monkeypatch.delitem(sys.modules, f"zlmreport.web.{name}", raising=False)
    monkeypatch.setitem(sys.modules, package, None)
    assert main(["workbench", str(EXAMPLE)]) == 3
    assert f"{package} is not installed" in (message := capsys.readouterr().err)
    assert "pip install 'zlmreport[workbench]'" in message


def test_a_port_that_is_taken_is_said(capsys: pytest.CaptureFixture[str]) -> None:
    pytest.importorskip("uvicorn", reason="the workbench's extra is not installed")
    with socket.create_server(("127.0.0.1", 0)) as taken:
        port = taken.getsockname()[1]
        assert main(["workbench", str(EXAMPLE), "--no-browser", "--port", str(port)]) == 3
    assert f"port {port} cannot be used: address already in use" in capsys.readouterr().err


def test_a_workbench_that_cannot_begin_leaves_nothing_behind() -> None:
    pytest.importorskip("uvicorn", reason="the workbench's extra is not installed")
    gc.collect()
    with warnings.catch_warnings(record=True) as left, socket.create_server(("127.0.0.1", 0)) as taken:
        warnings.simplefilter("always", ResourceWarning)
        main(["workbench", str(EXAMPLE), "--no-browser", "--port", str(taken.getsockname()[1])])
        gc.collect()
    assert [str(each.message) for each in left] == []


def test_a_job_that_is_wrong_is_said_before_any_page_opens(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    pytest.importorskip("uvicorn", reason="the workbench's extra is not installed")
    job = tmp_path / "job.yaml"
    job.write_text("schema: zlmreport/job/1\n", encoding="utf-8")
    assert main(["workbench", str(job), "--no-browser"]) == 2
    assert "job.yaml:1:1" in capsys.readouterr().err


def test_a_browser_is_opened_unless_that_is_not_wanted() -> None:
    assert not parse(["workbench", "x.yaml"])[1].no_browser
    assert parse(["workbench", "x.yaml", "--no-browser", "--port", "8420"])[1].port == 8420


def test_a_file_of_readings_opens_with_a_job_that_is_written_beside_it(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    pytest.importorskip("uvicorn", reason="the workbench's extra is not installed")
    readings = tmp_path / "x-axis.csv"
    readings.write_bytes((EXAMPLE.parent / "x-axis.csv").read_bytes())
    with socket.create_server(("127.0.0.1", 0)) as taken:  # so that it ends by itself
        port = str(taken.getsockname()[1])
        assert main(["workbench", str(readings), "--no-browser", "--port", port]) == 3
        job = tmp_path / "x-axis.yaml"
        assert f"{job}: written for {readings}" in capsys.readouterr().out
        job.write_text(job.read_text(encoding="utf-8") + "# mine\n", encoding="utf-8")
        main(["workbench", str(readings), "--no-browser", "--port", port])
    assert job.read_text(encoding="utf-8").endswith("# mine\n")


def test_a_file_that_holds_no_readings_is_refused_and_no_job_is_left(tmp_path: Path) -> None:
    pytest.importorskip("uvicorn", reason="the workbench's extra is not installed")
    letter = tmp_path / "letter.txt"
    letter.write_text("Dear customer,\n", encoding="utf-8")
    assert main(["workbench", str(letter), "--no-browser"]) == 2
    assert [each.name for each in tmp_path.iterdir()] == ["letter.txt"]
