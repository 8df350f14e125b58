"""Who may not see single readings is not handed them as values either."""

from __future__ import annotations

from pathlib import Path

import pytest

from installed import registry
from model.hidden_effect import job, written
from zlmreport import pipeline


@pytest.mark.long
def test_graphs_without_readings_have_no_values_of_them(tmp_path: Path) -> None:
    kept = job(written(tmp_path))
    assert pipeline.compose(kept, registry()).linked is not None
    path = written(tmp_path, ("certificate:\n", "certificate:\n  readings_on_graphs: false\n"))
    assert pipeline.compose(job(path), registry()).linked is None
