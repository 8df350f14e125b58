"""When a reading was taken: the same however late it is read."""

from __future__ import annotations

from itertools import pairwise
from random import Random

import pytest

from zlmreport.live.emulation.emulator import MovingAxis
from zlmreport.live.ports.clock import ArrivalClock
from zlmreport.plugin.instrument import LiveReading, SampleClock, Scene
from zlmreport_plugins.instruments.umd import Setup, UmdDecoder
from zlmreport_plugins.instruments.umd.lines import MODELS, UmdEmulator, UmdModel

_LENGTH = 316e-9


def test_samples_are_as_far_apart_as_their_numbers_say() -> None:
    clock = SampleClock()
    times = [clock.time(number, 500.0, late) for number, late in ((7, 100.0), (8, 103.0), (507, 103.0))]
    assert times == pytest.approx([100.0, 100.002, 101.0])


def test_after_a_restart_the_clock_does_not_go_back() -> None:
    clock = SampleClock()
    clock.time(5000, 500.0, 100.0)
    before = clock.time(5500, 500.0, 100.2)
    clock.restart()
    assert clock.time(1, 500.0, 100.3) >= before


@pytest.mark.parametrize("model", MODELS, ids=lambda model: model.identifier)
@pytest.mark.parametrize("seed", range(3))
def test_a_busy_computer_changes_neither_the_values_nor_the_times_of_a_display(
    model: UmdModel, seed: int
) -> None:
    def read(looks: list[float]) -> list[LiveReading]:
        display = UmdEmulator(model, Scene(MovingAxis((0.0, 0.01), dwell=0.5)), _LENGTH)
        decoder = UmdDecoder(model, Setup(0, _LENGTH, ("air_temperature", "axis_temperature")))
        return [reading for look in looks for reading in decoder.feed(display.unasked(look), 1000 + look)]

    random = Random(seed)
    prompt = [0.002 * look for look in range(1, 6001)]
    late = [*sorted(random.sample(prompt[:-1], 8)), prompt[-1]]
    on_time, delayed = read(prompt), read(late)
    assert [reading.value for reading in delayed] == [reading.value for reading in on_time]
    shift = delayed[0].time - on_time[0].time
    for one, other in zip(on_time, delayed, strict=True):
        assert other.time - one.time == pytest.approx(shift, abs=1e-9)


def _lumps(clock: ArrivalClock, counts: list[int], period: float = 0.1) -> list[LiveReading]:
    """Return readings that arrive in lumps; a lump is late by the time that its lines took."""
    now, stamped = 50.0, []
    for count in counts:
        now += count * period
        readings = [LiveReading(0.0, now) for _ in range(count)]
        stamped += clock.stamp(readings, now, now - 0.002)
    return stamped


def test_lines_that_arrive_together_were_sent_one_after_the_other() -> None:
    times = [reading.time for reading in _lumps(ArrivalClock(), [1] * 20 + [9, 1, 1, 30, 1])]
    assert [later - earlier for earlier, later in pairwise(times)] == pytest.approx([0.1] * (len(times) - 1))


def test_lines_that_were_lost_in_a_lump_leave_their_gap() -> None:
    clock = ArrivalClock()
    last = _lumps(clock, [1] * 20)[-1].time
    now = last + 3.0
    stamped = clock.stamp([LiveReading(0.0, now)] * 10, now, last)
    assert stamped[0].time == pytest.approx(last + 2.1)
    assert stamped[-1].time == now


def test_a_line_may_have_arrived_since_the_line_was_empty() -> None:
    clock = ArrivalClock()
    clock.stamp([LiveReading(0.0, 50.0)], 50.0, 50.0)
    (reading,) = clock.stamp([LiveReading(0.0, 50.1)], 50.1, 50.03)
    assert reading.within == pytest.approx(0.07)
