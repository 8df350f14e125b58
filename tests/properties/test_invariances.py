"""What holds for every test of every axis, whatever its readings."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, strategies as st
from hypothesis.extra.numpy import array_shapes, arrays

from plugins.standards.installed import STANDARDS
from zlmreport.plugin import FloatArray
from zlmreport.plugin.standard import position_statistics

ISO = [identifier for identifier in STANDARDS if identifier.startswith("iso230-2")]
SINCE_1997 = ISO[1:]
VDI = ["vdi-dgq-3441", "vdi-vde-2617"]
#: Of the largest reading; the arithmetic rounds some tens of times.
ROUNDING = 1e-13
NANOMETRE = 1e-9

#: Parameters with a sign, which follow a change of sign of the readings.
SIGNED = {"B_mean", "O"}


def readings(shape: st.SearchStrategy[tuple[int, ...]]) -> st.SearchStrategy[FloatArray]:
    """Return deviations of up to 0.1 mm in steps of a nanometre, m."""
    steps = arrays(np.int64, shape, elements=st.integers(-100_000, 100_000))
    return steps.map(lambda whole: whole * NANOMETRE)


def shapes() -> st.SearchStrategy[tuple[int, ...]]:
    """Return shapes (approach, position, run): two directions, 2 to 8 positions, 2 to 6 runs.

    At a single position the ranges over positions are not defined.
    """
    return st.tuples(st.just(2), st.integers(2, 8), st.integers(2, 6))


def parameters(identifier: str, grid: FloatArray) -> dict[str, float]:
    standard = STANDARDS[identifier]
    found = standard.arithmetic(position_statistics(grid), standard.options()).parameters
    return {symbol: float(value) for symbol, value in found.items()}


def slack(grid: FloatArray) -> float:
    return ROUNDING * float(np.abs(grid).max(initial=NANOMETRE))


def exchanged(symbol: str) -> str:
    return {"fwd": symbol[:-3] + "bwd", "bwd": symbol[:-3] + "fwd"}.get(symbol[-3:], symbol)


@pytest.mark.parametrize("identifier", STANDARDS)
@given(grid=readings(shapes()), offset=st.integers(-1_000_000, 1_000_000))
def test_an_offset_of_all_readings_changes_no_parameter_but_the_offset(
    identifier: str, grid: FloatArray, offset: int
) -> None:
    before = parameters(identifier, grid)
    after = parameters(identifier, grid + offset * NANOMETRE)
    if "O" in before:
        before["O"] -= offset * NANOMETRE

    assert after == pytest.approx(before, abs=slack(grid) + ROUNDING * abs(offset) * NANOMETRE)


@given(grid=readings(shapes()), offset=st.integers(-1_000_000, 1_000_000))
def test_an_offset_of_all_readings_moves_every_mean_and_no_scatter(grid: FloatArray, offset: int) -> None:
    before = position_statistics(grid)
    after = position_statistics(grid + offset * NANOMETRE)
    rounding = slack(grid) + ROUNDING * abs(offset) * NANOMETRE

    assert np.allclose(after.mean, before.mean + offset * NANOMETRE, rtol=0, atol=rounding)
    assert np.allclose(after.standard_deviation, before.standard_deviation, rtol=0, atol=rounding)


@pytest.mark.parametrize("identifier", ISO)
@given(grid=readings(shapes()))
def test_exchanged_direction_labels_turn_the_reversal_and_exchange_the_directions(
    identifier: str, grid: FloatArray
) -> None:
    before = parameters(identifier, grid)
    after = parameters(identifier, grid[::-1])
    expected = {exchanged(symbol): value for symbol, value in before.items()}
    expected["B_mean"] = -before["B_mean"]

    assert after == pytest.approx(expected, abs=slack(grid))


@given(grid=readings(shapes()))
def test_exchanged_direction_labels_turn_the_sign_of_every_reversal_value(grid: FloatArray) -> None:
    before, after = position_statistics(grid), position_statistics(grid[::-1])

    assert np.array_equal(after.reversal_value, -before.reversal_value)


@pytest.mark.parametrize("identifier", [*VDI, "nmtba"])
@given(grid=readings(shapes()))
def test_vdi_and_nmtba_do_not_tell_the_directions_apart(identifier: str, grid: FloatArray) -> None:
    assert parameters(identifier, grid[::-1]) == pytest.approx(parameters(identifier, grid), abs=slack(grid))


@given(grid=readings(shapes()))
def test_a_mirrored_axis_keeps_every_reversal_value(grid: FloatArray) -> None:
    before, after = position_statistics(grid), position_statistics(mirrored(grid))

    assert np.array_equal(after.reversal_value, before.reversal_value[::-1])


@pytest.mark.parametrize("identifier", STANDARDS)
@given(grid=readings(shapes()))
def test_a_mirrored_axis_exchanges_directions_and_turns_the_offset_only(
    identifier: str, grid: FloatArray
) -> None:
    before = parameters(identifier, grid)
    expected = {exchanged(symbol): value for symbol, value in before.items()}
    if "O" in expected:
        expected["O"] = -expected["O"]

    assert parameters(identifier, mirrored(grid)) == pytest.approx(expected, abs=slack(grid))


def mirrored(grid: FloatArray) -> FloatArray:
    """Return the test as seen on an axis that counts the other way: what went up goes down."""
    return -grid[::-1, ::-1]


@pytest.mark.parametrize("identifier", STANDARDS)
@given(grid=readings(shapes()), factor=st.floats(-100, 100))
def test_parameters_scale_with_the_readings(identifier: str, grid: FloatArray, factor: float) -> None:
    before = parameters(identifier, grid)
    after = parameters(identifier, factor * grid)
    expected = {
        symbol: (factor if symbol in SIGNED else abs(factor)) * value for symbol, value in before.items()
    }

    assert after == pytest.approx(expected, abs=max(1.0, abs(factor)) * slack(grid))


@pytest.mark.parametrize("identifier", STANDARDS)
@given(grid=readings(shapes()), order=st.permutations(range(6)))
def test_the_order_of_the_runs_changes_nothing(identifier: str, grid: FloatArray, order: list[int]) -> None:
    permuted = grid[..., [run for run in order if run < grid.shape[-1]]]

    assert parameters(identifier, permuted) == pytest.approx(parameters(identifier, grid), abs=slack(grid))


@pytest.mark.parametrize("identifier", SINCE_1997)
@given(grid=readings(shapes()))
def test_accuracy_holds_the_systematic_part_and_the_repeatability_and_both_hold_the_reversal(
    identifier: str, grid: FloatArray
) -> None:
    found, rounding = parameters(identifier, grid), slack(grid)

    assert found["A"] >= found["E"] - rounding
    assert found["E"] >= found["M"] - rounding
    assert found["A"] >= found["R"] - rounding
    assert found["R"] >= found["B"] - rounding
    assert found["E"] >= found["B"] - rounding


@given(grid=readings(shapes()))
def test_limits_at_three_standard_deviations_hold_those_at_two(grid: FloatArray) -> None:
    wide, narrow = parameters("iso230-2:1988", grid), parameters("iso230-2:1997", grid)

    assert all(wide[symbol] >= narrow[symbol] - slack(grid) for symbol in wide)


@pytest.mark.parametrize("identifier", VDI)
@given(grid=readings(shapes()))
def test_vdi_position_deviation_and_largest_reversal_are_those_of_iso(
    identifier: str, grid: FloatArray
) -> None:
    vdi, iso = parameters(identifier, grid), parameters("iso230-2:2014", grid)

    assert vdi["Pa"] == pytest.approx(iso["M"], abs=slack(grid))
    assert vdi["U_max"] == pytest.approx(iso["B"], abs=slack(grid))
    assert vdi["U_mean"] >= abs(iso["B_mean"]) - slack(grid)


@given(grid=readings(shapes()))
def test_the_nmtba_offset_centres_the_band_on_zero(grid: FloatArray) -> None:
    offset = parameters("nmtba", grid)["O"]

    assert parameters("nmtba", grid + offset)["O"] == pytest.approx(0, abs=2 * slack(grid))


@pytest.mark.parametrize("identifier", STANDARDS)
@given(
    stack=readings(array_shapes(min_dims=1, max_dims=2, max_side=3).map(lambda batch: (*batch, 2, 4, 3))),
    gaps=st.lists(st.integers(0, 2**31), max_size=12),
)
def test_a_stack_of_tests_gives_what_each_gives_alone(
    identifier: str, stack: FloatArray, gaps: list[int]
) -> None:
    for gap in gaps:
        stack.flat[gap % stack.size] = np.nan
    standard = STANDARDS[identifier]
    together = standard.arithmetic(position_statistics(stack), standard.options())
    for place in np.ndindex(stack.shape[:-3]):
        alone = standard.arithmetic(position_statistics(stack[place]), standard.options())
        rounding = ROUNDING * np.nanmax(np.abs(stack), initial=NANOMETRE)
        for symbol, value in alone.parameters.items():
            assert np.allclose(
                together.parameters[symbol][place], value, rtol=0, atol=rounding, equal_nan=True
            )
        for symbol, value in alone.positions.items():
            assert np.allclose(
                together.positions[symbol][place], value, rtol=0, atol=rounding, equal_nan=True
            )
