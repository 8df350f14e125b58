"""A complete test by each method with each instrument: the certificate says what the axis really did."""

from __future__ import annotations

from itertools import cycle
from pathlib import Path

import pytest

from live.capture.calibration import BENCHES, Bench, calibration
from zlmreport.live.capture.events import Closed, Finished, Recorded
from zlmreport.model.planning.methods import Method
from zlmreport.plugin.instrument import DatumTaken

#: By how much a parameter changes at most if each deviation changes by 1: a standard deviation of n = 5 by
#: √(5/4), so the accuracy, from a mean and two standard deviations to another, by 2·(1 + 2·√(5/4)).
MOST = 2 * (1 + 2 * (5 / 4) ** 0.5)


#: Every instrument and every method, not each with each.
PAIRS = [*zip(BENCHES.values(), cycle(Method))]


@pytest.mark.long
@pytest.mark.parametrize(("bench", "method"), PAIRS, ids=lambda part: getattr(part, "instrument", part))
def test_the_numbers_are_those_of_the_axis(bench: Bench, method: Method, tmp_path: Path) -> None:
    done = calibration(tmp_path, bench, method)
    planned = 105 if method is Method.UNIDIRECTIONAL else 210
    assert [type(event) for event in done.events] == [DatumTaken, *[Recorded] * planned, Closed, Finished]
    # half a step of the display at the target, and half a step at the datum
    assert max(map(abs, done.errors().values())) <= bench.resolution
    expected = done.true_parameters()
    assert done.parameters == pytest.approx(expected, abs=MOST * bench.resolution, rel=1e-9)
