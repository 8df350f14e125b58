"""A table of ZEISS Calypso that nobody described is a probed step gauge, whose calibration is asked for."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from installed import registry
from replacing import replace_in
from zlmreport.cli import main
from zlmreport.looking import look_at
from zlmreport.plugin import InputError

_HEADER = "planid\tpartnb\tid\tactual\tnominal\tdeviation\tunit"
_ROWS = [
    (part, face, 10.0 * (face - 1), 0.0001 * face * part * (face > 1))
    for part in (1, 2)
    for face in range(1, 5)
]


def _table(*rows: str) -> str:
    lines = [
        f"GAUGE\t{part}\tF{face:02}\t{nominal + error:.5f}\t{nominal:.5f}\t{error:.5f}\tmm"
        for part, face, nominal, error in _ROWS
    ]
    return "\n".join([_HEADER, *lines, *rows, "END", ""])


def test_it_is_read_by_its_own_source_from_the_nominal_lengths(tmp_path: Path) -> None:
    path = tmp_path / "GAUGE_1_chr.txt"
    path.write_text(_table(), encoding="utf-8")
    looked = look_at(path, registry())
    assert (looked.source.identifier, looked.standard) == ("step-gauge", "step-gauge")
    assert any("Which gauge was probed?" in each for each in looked.proposal.asks)
    assert list(looked.write_groups()) == ["step_gauge: {calibration: gauge.yaml}"]
    by_run = [looked.read.deviation[looked.read.run == run] * 1e6 for run in (1, 2)]
    np.testing.assert_allclose(by_run, [[0, 0.2, 0.3, 0.4], [0, 0.4, 0.6, 0.8]], atol=1e-9)


def test_the_job_that_is_written_asks_for_the_gauge_alone(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("GAUGE_1_chr.txt").write_text(_table(), encoding="utf-8")
    assert main(["init", "--from", "GAUGE_1_chr.txt", "."]) == 0
    assert main(["check", "job.yaml"]) == 3
    assert capsys.readouterr().err.strip() == "gauge.yaml: cannot be read: no such file or directory"
    Path("gauge.csv").write_text(
        "face,side,nominal_mm,calibrated_mm,U_k2_um\n"
        + "".join(f"{n},{('back', 'front')[n % 2]},{10 * n - 10},{10 * n - 10},0.2\n" for n in range(1, 5)),
        encoding="utf-8",
    )
    job = Path("job.yaml")
    replace_in(job, ("gauge.yaml", "gauge.csv"))
    assert main(["check", "job.yaml"]) == 0, capsys.readouterr().err


def test_what_is_wrong_in_it_is_told_and_no_other_source_tried(tmp_path: Path) -> None:
    path = tmp_path / "GAUGE_1_chr.txt"
    path.write_text(_table("GAUGE\t3\tF01\tlost\t0\t0\tmm"), encoding="utf-8")
    with pytest.raises(InputError, match=r"GAUGE_1_chr\.txt:10:13: 'lost' stands where a number belongs"):
        look_at(path, registry())
