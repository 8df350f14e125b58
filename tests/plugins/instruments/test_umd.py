"""µMD displays: their lines as documented, and what is believed of a line that is damaged."""

from __future__ import annotations

import math
from random import Random

import numpy as np
import pytest

from installed import registry
from plugins.instruments.exchanges import DATA, lines
from zlmreport.live.emulation.emulator import MovingAxis
from zlmreport.live.emulation.troubles import Planned, Troubles
from zlmreport.plugin.instrument import Fault, LiveReading, Scene, Trouble, WrongDeviceError, index_change
from zlmreport_plugins.instruments.umd import Setup, UmdDecoder, compute_cycle_length
from zlmreport_plugins.instruments.umd.lines import MODELS, AxisCounts, UmdEmulator, UmdFrame, find_frame_in

UMD = {model.identifier: model for model in MODELS}
#: λ/2 in standard air, m.
HALF_WAVE = 632.991372e-9 / 1.000271 / 2
SETUP = Setup(0, HALF_WAVE, ("air_temperature", "temperature_2"))
#: Readings are formed once the low-speed channel has come round twice.
TWO_TURNS = {"umd0": 512, "umd1": 64, "umd2": 64}
#: What a display resolves, in cycles.
RESOLVES = {"umd0": 1 / 4, "umd1": 1 / 256, "umd2": 1 / 2 / 65536}


def _decoded(model: str, data: bytes, setup: Setup = SETUP) -> list[LiveReading]:
    return UmdDecoder(UMD[model], setup).feed(data, 1.0)


def _sent(
    model: str, seconds: float, axis: MovingAxis | None = None, troubles: Troubles | None = None
) -> bytes:
    emulator = UmdEmulator(UMD[model], Scene(axis or MovingAxis(), troubles or Troubles()), HALF_WAVE)
    return emulator.unasked(seconds)


def _spoilt(data: bytes, line: int, old: bytes, new: bytes) -> bytes:
    """Return lines of which one is changed."""
    split = data.splitlines(keepends=True)
    assert old in split[line]
    split[line] = split[line].replace(old, new, 1)
    return b"".join(split)


def test_a_line_of_one_axis_is_read_field_by_field() -> None:
    assert find_frame_in(b"3932 3530 10173 402 45 49 0 0") == UmdFrame(
        3932, (AxisCounts(3530, 10173, 402, 45),), 49, 0, 0
    )


def test_a_line_of_three_axes_is_read_field_by_field() -> None:
    frame = find_frame_in(b"2400 2401 10 1 5 7 8 100000 2402 20 2 6 2403 -30 -3 -4")
    assert frame == UmdFrame(
        2400,
        (AxisCounts(2401, 10, 1, 5), AxisCounts(2402, 20, 2, 6), AxisCounts(2403, -30, -3, -4)),
        7,
        8,
        100000,
    )


@pytest.mark.parametrize(
    "line",
    [
        b"!3932 3530 10173 402 45 49 0 0",
        b"Minimalist Homodyne Test:",
        b"3932 3530 10173 402 45 49 0",
        b"3932 3530 10173 402 45 49 0 0 0",
        b"3932 3530 10173 402 4\xb55 49 0 0",
        b"3932  3530 10173 402 45 49 0 0",
        b"",
    ],
)
def test_what_is_no_line_is_left_out(line: bytes) -> None:
    assert find_frame_in(line) is None


@pytest.mark.parametrize("model", ["umd0", "umd1", "umd2"])
def test_recorded_lines_are_all_understood(model: str) -> None:
    decoder = UmdDecoder(UMD[model], SETUP)
    decoder.feed((DATA / f"{model}_sample.txt").read_bytes(), 1.0)
    assert decoder.understood == len(lines(f"{model}_sample.txt")) == 64


def test_recorded_displacements_of_a_umd1_are_half_waves_and_256ths_of_them() -> None:
    said = (DATA / "umd1_sample.txt").read_bytes()
    told_before = b"".join(b"3932 3932 0 0 0 %d %d %d\r\n" % row for row in _preface())
    last = _decoded("umd1", told_before + said)[-1]
    assert last.value == pytest.approx((16576 - 87 / 256) * HALF_WAVE, rel=1e-12)
    assert last.faults == Fault(0)


def _preface() -> list[tuple[int, int, int]]:
    """Return sequence, code and data of the two turns before those that were recorded."""
    says = {1: (10, 5704), 2: (8, 61035)}
    return [(sequence, *says.get(sequence % 32, (0, 0))) for sequence in range(-64, 0)]


@pytest.mark.parametrize(
    ("optics", "fold"), [("retroreflector", 1), ("plane mirror", 2), ("double plane mirror", 4)]
)
def test_optics_divide_the_half_wave_in_standard_air(optics: str, fold: int) -> None:
    # Refractive index of air at 20 °C, 1013.25 hPa, 50 %: 1.000 271 37 (Edlén, Birch and Downs)
    length = compute_cycle_length(registry().instrument("umd1").options(port="COM3", optics=optics))
    assert length == pytest.approx(632.991372e-9 / 1.00027137 / 2 / fold, rel=2e-8)


@pytest.mark.parametrize("model", ["umd0", "umd1", "umd2"])
def test_an_axis_that_creeps_is_read_within_the_resolution(model: str) -> None:
    axis = MovingAxis(drift=1e-6)
    readings = _decoded(model, _sent(model, 4.0, axis))
    values = [reading.value for reading in readings]
    # the readings end with the last sample
    rate = {"umd0": 244.14, "umd1": 610.35, "umd2": 1000.0}[model]
    last = int(4.0 * rate)
    expected = [axis.position(number / rate) for number in range(last - len(values) + 1, last + 1)]
    worst = max(abs(value - true) for value, true in zip(values, expected, strict=True))
    assert all(reading.faults == Fault(0) for reading in readings)
    assert worst <= RESOLVES[model] * HALF_WAVE
    assert len(values) == last - TWO_TURNS[model] + 1


def test_the_phase_of_a_umd2_has_8_bits_where_its_flag_says_so() -> None:
    sixteen = _sent("umd2", 0.2, MovingAxis(drift=1e-6))
    eight = b"".join(
        b" ".join([*fields[:4], b"%d" % (int(fields[4]) // 256), *fields[5:]]) + b"\r\n"
        for fields in (line.split(b" ") for line in sixteen.replace(b"112 4", b"112 6").splitlines())
    )
    expected = [reading.value for reading in _decoded("umd2", sixteen)]
    found = [reading.value for reading in _decoded("umd2", eight)]
    assert found == pytest.approx(expected, abs=HALF_WAVE / 2 / 256)


def test_nothing_is_read_before_rate_and_counting_are_known() -> None:
    silent = b"".join(
        b" ".join([*line.split(b" ")[:6], b"0 0"]) + b"\r\n" for line in _sent("umd2", 0.4).splitlines()
    )
    assert _decoded("umd2", silent) == []


def test_a_umd1_in_place_of_a_umd2_is_noticed() -> None:
    with pytest.raises(WrongDeviceError, match=r"no µMD2.*\(code 20\).*named umd1"):
        _decoded("umd2", _sent("umd1", 2.0))


def test_a_umd2_in_place_of_a_umd1_is_noticed() -> None:
    with pytest.raises(WrongDeviceError, match=r"no µMD1.*name umd2"):
        _decoded("umd1", _sent("umd2", 2.0))


def test_an_axis_that_is_not_sent_is_noticed() -> None:
    with pytest.raises(WrongDeviceError, match="sends 1 axis, and axis 2 is wanted"):
        _decoded("umd1", _sent("umd1", 2.0), Setup(1, HALF_WAVE, ("", "")))


def test_sensors_are_read_in_si_and_absent_ones_left_out() -> None:
    data = _sent("umd1", 0.3).replace(b" 4 2000\r", b" 4 -1\r").replace(b" 6 500\r", b" 6 455\r")
    (conditions,) = {id(each.conditions): each.conditions for each in _decoded("umd1", data)}.values()
    assert dict(conditions) == {
        "air_temperature": pytest.approx(293.15),
        "air_pressure": 101325.0,
        "relative_humidity": pytest.approx(0.455),
    }


def test_a_temperature_that_jumps_for_one_line_is_not_believed() -> None:
    data = _sent("umd1", 0.3)
    number = next(i for i, line in enumerate(data.splitlines()) if b" 3 2000" in line and i > 100)
    readings = _decoded("umd1", _spoilt(data, number, b" 3 2000", b" 3 2900"))
    assert {round(each.conditions["air_temperature"], 6) for each in readings} == {293.15}


@pytest.mark.parametrize("model", ["umd1", "umd2"])
def test_a_broken_beam_is_told_and_loses_the_zero(model: str) -> None:
    troubles = Troubles([Planned(Trouble.LOST_BEAM, 0.5)])
    broken = [each for each in _decoded(model, _sent(model, 0.9, None, troubles)) if each.faults]
    assert {each.faults for each in broken} == {Fault.BEAM_LOST}
    assert all(each.loses_zero and "beam is broken" in each.message for each in broken)


def test_after_a_broken_beam_the_display_counts_on_from_elsewhere() -> None:
    troubles = Troubles([Planned(Trouble.LOST_BEAM, 0.5)])
    last = _decoded("umd1", _sent("umd1", 1.5, None, troubles))[-1]
    assert last.faults == Fault(0)
    assert abs(last.value) > 0.1  # half a second of a reference of 2.4 MHz, at 316 nm a cycle: 0.38 m


def test_an_axis_that_is_too_fast_is_told() -> None:
    # 2.4 MHz less 0.1 MHz, at 316 nm a cycle: 0.728 m/s
    fast = MovingAxis((0.0, 10.0), feed=0.75, dwell=0.2)
    faults = {each.faults for each in _decoded("umd1", _sent("umd1", 0.5, fast))}
    assert faults == {Fault(0), Fault.TOO_FAST}


def test_an_axis_that_is_just_not_too_fast_is_read() -> None:
    fast = MovingAxis((0.0, 10.0), feed=0.70, dwell=0.2)
    assert {each.faults for each in _decoded("umd1", _sent("umd1", 0.5, fast))} == {Fault(0)}


def test_a_phase_without_an_edge_voids_the_reading_and_keeps_the_zero() -> None:
    troubles = Troubles([Planned(Trouble.ERROR, 0.5)])
    void = [each for each in _decoded("umd1", _sent("umd1", 0.9, None, troubles)) if each.faults]
    assert {(each.faults, each.loses_zero) for each in void} == {(Fault.DEVICE_ERROR, False)}


def test_zero_cycles_are_no_fault_of_a_homodyne_display() -> None:
    readings = _decoded("umd0", _sent("umd0", 3.0))
    assert readings
    assert {each.faults for each in readings} == {Fault(0)}


def test_skipped_samples_are_counted() -> None:
    troubles = Troubles([Planned(Trouble.SKIPPED, 0.5)])
    readings = _decoded("umd2", _sent("umd2", 0.8, None, troubles))
    # 50 samples in 0.05 s; the two after the gap have too few before them to be held against
    assert [each.skipped for each in readings if each.skipped] == [50]
    assert [each.faults for each in readings if each.faults] == 2 * [Fault.UNREADABLE]


def test_a_line_that_came_twice_is_one_reading() -> None:
    data = _sent("umd1", 0.2).splitlines(keepends=True)
    assert _decoded("umd1", b"".join([*data[:90], data[89], *data[90:]])) == _decoded("umd1", b"".join(data))


def test_a_display_that_begins_anew_has_another_zero() -> None:
    readings = _decoded("umd1", 2 * _sent("umd1", 0.2))
    assert [each.faults for each in readings if each.faults] == [
        Fault.UNREADABLE,
        Fault.UNREADABLE,
        Fault.RESTARTED,
    ]
    assert [each for each in readings if each.loses_zero]


@pytest.mark.parametrize("axis", [2, 3])
def test_further_axes_are_read_from_their_own_fields(axis: int) -> None:
    resting, moving = b"%s 0 0 0", b"%s %s %s %s"
    lines_of_three = b""
    for line in _sent("umd2", 0.3, MovingAxis(drift=1e-3)).splitlines():
        reference, *counts, sequence, code, data = line.split(b" ")
        rests = resting % reference
        moves = moving % tuple(counts)
        further = (moves, rests) if axis == 2 else (rests, moves)
        lines_of_three += b" ".join([reference, rests, sequence, code, data, *further]) + b"\r\n"
    alone = _decoded("umd2", _sent("umd2", 0.3, MovingAxis(drift=1e-3)))
    found = _decoded("umd2", lines_of_three, Setup(axis - 1, HALF_WAVE, SETUP.temperatures))
    assert [each.value for each in found] == [each.value for each in alone]
    assert {each.faults for each in found} == {Fault(0)}
    assert found[-1].value > 0


def test_the_sign_turns_the_readings_round() -> None:
    assert registry().instrument("umd1").options(port="COM3", sign="-", scale=0.5).factor == -0.5


@pytest.mark.parametrize(("model", "counts", "seconds"), [("umd1", 1, 85.0), ("umd2", 3, 52.0)])
def test_ten_thousand_damaged_lines_bring_no_wrong_reading(model: str, counts: int, seconds: float) -> None:
    """A digit of the phase, and as many counts as interpolation may move, are all that can go unnoticed."""
    random = Random(20261118)
    clean = _sent(model, seconds).splitlines(keepends=True)
    damaged = bytearray()
    faults = 0
    for number, line in enumerate(clean):
        if number < 200 or random.random() > 0.2 or faults == 10_000:
            damaged += line
            continue
        faults += 1
        damaged += _damage(line, random)
    assert faults == 10_000
    readings = _decoded(model, bytes(damaged))
    usable = [each.value for each in readings if each.is_usable]
    assert len(usable) > len(clean) / 3
    assert max(map(abs, usable)) <= counts * HALF_WAVE
    assert not [each for each in readings if each.faults & Fault.RESTARTED]


def _damage(line: bytes, random: Random) -> bytes:
    """Return a line that was dropped, doubled, cut off, or has another character in it."""
    kind = random.randrange(4)
    place = random.randrange(len(line) - 2)
    if kind == 0:
        return b""
    if kind == 1:
        return line + line
    if kind == 2:
        return line[:place]
    return line[:place] + b"%d" % random.randrange(10) + line[place + 1 :]


def test_a_reading_that_is_not_understood_has_no_value() -> None:
    data = _sent("umd1", 0.2)
    number = len(data.splitlines()) - 2
    readings = _decoded("umd1", _spoilt(data, number, b" 0 0 0 ", b" 7 0 0 "))
    assert [math.isnan(each.value) for each in readings[-3:]] == [False, True, True]


def test_the_sensors_of_an_emulated_display_measure_what_the_scene_says() -> None:
    room = {
        "air_temperature": 295.65,
        "axis_temperature": 297.15,
        "air_pressure": 98_000.0,
        "relative_humidity": 0.3,
    }
    scene = Scene(conditions=lambda _: room)
    last = _decoded("umd1", UmdEmulator(UMD["umd1"], scene, HALF_WAVE).unasked(1.0))[-1]
    expected = {**room, "temperature_2": room["axis_temperature"]}
    del expected["axis_temperature"]
    assert dict(last.conditions) == pytest.approx(expected)


def test_an_emulated_display_counts_the_waves_in_the_air_that_there_is() -> None:
    thin = {"air_pressure": 90_000.0}
    scene = Scene(MovingAxis((0.0, 1.0), feed=0.5, dwell=1.0), conditions=lambda _: thin)
    readings = _decoded("umd1", UmdEmulator(UMD["umd1"], scene, HALF_WAVE).unasked(3.9))
    change = index_change(np.array(293.15), np.array(90_000.0), np.array(0.5))
    # a step of the display at each end
    assert readings[-1].value == pytest.approx(1 + float(change), abs=2 * HALF_WAVE / 256)
