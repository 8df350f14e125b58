"""A night that is killed loses, doubles and halves nothing."""

from __future__ import annotations

import os
import sys
from pathlib import Path

import pytest

from processes import PYTHON, run

KILLS = 12


@pytest.mark.long
@pytest.mark.early
def test_nights_killed_at_random_moments_are_made_good_by_the_next(tmp_path: Path) -> None:
    script = Path(__file__).with_name("kill_nights.py")
    path = os.pathsep.join(path for path in sys.path if path)
    environment = os.environ | {"PYTHONPATH": path}
    done = run(PYTHON, script, tmp_path, str(KILLS), "20261121", env=environment, check=True)
    *problems, last = done.stdout.splitlines()
    assert not problems
    assert int(last.split()[0]) >= KILLS // 2
