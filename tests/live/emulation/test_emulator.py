"""The axis before an emulated instrument."""

from __future__ import annotations

import statistics

import pytest

from zlmreport.live.emulation.emulator import MovingAxis
from zlmreport.live.emulation.troubles import Planned, Troubles
from zlmreport.plugin.instrument import Trouble

#: 2 s at 0, 1 s to 0.1 m, 2 s there, 1 s back; over and over.
AXIS = MovingAxis((0.0, 0.1), feed=0.1, dwell=2.0)


@pytest.mark.parametrize(
    ("time", "position"),
    [(0.0, 0.0), (2.0, 0.0), (2.5, 0.05), (3.0, 0.1), (5.0, 0.1), (5.25, 0.075), (6.0, 0.0), (8.5, 0.05)],
)
def test_it_rests_and_moves_in_turn(time: float, position: float) -> None:
    assert AXIS.position(time) == pytest.approx(position, abs=1e-12)


def test_an_axis_with_one_position_stays() -> None:
    assert {MovingAxis((0.3,)).position(time) for time in (0.0, 1.0, 1e6)} == {0.3}


def test_drift_moves_everything() -> None:
    assert MovingAxis((0.3,), drift=1e-6).position(100.0) == pytest.approx(0.3001)


def test_noise_has_its_standard_deviation_and_is_the_same_for_a_seed() -> None:
    shaken = [MovingAxis(noise=1e-6, seed=7).position(number / 100) for number in range(2000)]
    again = [MovingAxis(noise=1e-6, seed=7).position(number / 100) for number in range(2000)]
    assert shaken == again
    # the standard deviation of a sample of 2000 is known to 1/√(2·2000) = 1.6 %
    assert statistics.stdev(shaken) == pytest.approx(1e-6, rel=0.08)


def test_a_fault_lasts_its_time() -> None:
    troubles = Troubles([Planned(Trouble.LOST_BEAM, 10.0)])
    lasts = [troubles.has(Trouble.LOST_BEAM, time) for time in (9.9, 10.0, 10.4, 10.5)]
    assert lasts == [False, True, True, False]
    assert not troubles.has(Trouble.ERROR, 10.0)


def test_a_fault_begins_once() -> None:
    troubles = Troubles([Planned(Trouble.ERROR, 10.0)])
    begins = [troubles.begins(Trouble.ERROR, *span) for span in ((9.0, 9.9), (9.0, 10.0), (10.0, 99.0))]
    assert begins == [False, True, False]


def test_nobody_plugs_in_again() -> None:
    assert Troubles([Planned(Trouble.UNPLUGGED, 1.0)]).has(Trouble.UNPLUGGED, 1e9)
