"""Products of columns under irregular shares: those of the whole covariance, with however many targets."""

from __future__ import annotations

import tracemalloc

import numpy as np
import pytest

from zlmreport.model.diagnosis.columns import Columns
from zlmreport.model.fitting.contrasts import Contrasts, SingleReadings, make_contrasts_of
from zlmreport.plugin import FloatArray

_RATIOS = [(0.0, 0.0), (0.25, 0.0), (0.0, 5.0), (0.03, 1e3)]


def _make_table(targets: int, kept: FloatArray | None) -> tuple[Contrasts, list[FloatArray], Columns]:
    """Return four readings at each target in an order of chance; the model is an offset and a slope."""
    random, readings = np.random.default_rng(7), 4 * targets
    target = random.permutation(np.repeat(np.arange(targets), 4))
    direction = random.choice([-1.0, 1.0], readings)
    membership = (target[:, np.newaxis] == np.arange(targets)).astype(np.float64)
    irregular = [membership, membership * direction[:, np.newaxis]]
    single = SingleReadings(random.uniform(0.5, 2.0, readings), kept)
    space = make_contrasts_of(np.column_stack([np.ones(readings), target]), (), single)
    return space, irregular, Columns(space, irregular)


@pytest.mark.parametrize("ratios", _RATIOS)
@pytest.mark.parametrize("kept", [None, np.linspace(0.0, 0.8, 47)])
def test_products_under_irregular_shares_are_those_of_the_whole_covariance(
    ratios: tuple[float, ...], kept: FloatArray | None
) -> None:
    space, irregular, columns = _make_table(12, kept)
    contrasts = space.of(np.random.default_rng(8).normal(size=(48, 5)))
    places = columns.add(contrasts)
    columns.keep(2)
    factor = np.concatenate(
        [space.of(np.sqrt(ratio) * each) for ratio, each in zip(ratios, irregular, strict=True)], axis=1
    )
    covariance = np.eye(48) + factor @ factor.T
    expected = contrasts.T @ np.linalg.solve(covariance, contrasts)
    assert columns.multiply(ratios, places, places) == pytest.approx(expected, rel=1e-9, abs=1e-9)
    assert columns.multiply_with_kept(ratios, places, places) == pytest.approx(expected, rel=1e-9, abs=1e-9)
    assert columns.multiply_with(ratios, places, columns.hold(contrasts)) == pytest.approx(
        expected, rel=1e-9, abs=1e-9
    )
    assert columns.log_determinant(ratios) == pytest.approx(np.linalg.slogdet(covariance)[1], rel=1e-9)


def test_many_targets_are_eliminated_one_by_one() -> None:
    targets = 1000
    space, _, columns = _make_table(targets, None)
    places = columns.add(space.of(np.random.default_rng(8).normal(size=(4 * targets, 3))))
    columns.keep(1)
    tracemalloc.start()
    columns.multiply((0.25, 5.0), places, places)
    _, most = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    assert most < np.empty((targets, targets)).nbytes / 4  # no matrix of all targets with each other
