"""Sums and roots target by target are those of the whole matrices, however many readings each target has."""

from __future__ import annotations

import numpy as np
import pytest

from zlmreport.measurement.arrays import FloatArray
from zlmreport.model.fitting.by_target import FactorsByTarget, RootByTarget

#: Five targets with one to four readings, in an order of chance.
_TARGET = np.random.default_rng(1).permutation(np.repeat(np.arange(5), [3, 1, 4, 3, 2]))


def _make_factors() -> list[FloatArray]:
    membership = (_TARGET[:, np.newaxis] == np.arange(5)).astype(np.float64)
    return [membership, membership * np.random.default_rng(2).choice([-0.7, 1.2], (len(_TARGET), 1))]


def test_columns_are_summed_over_the_readings_of_each_target() -> None:
    factors, columns = _make_factors(), np.random.default_rng(3).normal(size=(len(_TARGET), 4))
    sums = FactorsByTarget(factors, len(_TARGET)).sum_by_target(columns)
    assert sums == pytest.approx(np.stack([each.T @ columns for each in factors], axis=1), abs=1e-14)


def test_sizes_of_each_target_are_spread_over_its_readings() -> None:
    factors, sizes = _make_factors(), np.random.default_rng(3).normal(size=(5, 2, 4))
    spread = FactorsByTarget(factors, len(_TARGET)).spread(sizes)
    whole = sum(each @ sizes[:, number] for number, each in enumerate(factors))
    assert spread == pytest.approx(whole, abs=1e-14)


def test_the_root_makes_readings_of_a_target_independent() -> None:
    factors, ratios = _make_factors(), np.array([0.3, 2.0])
    root = RootByTarget(FactorsByTarget(factors, len(_TARGET)), ratios)(np.eye(len(_TARGET)))
    shared = sum(ratio * each @ each.T for ratio, each in zip(ratios, factors, strict=True))
    assert root @ (np.eye(len(_TARGET)) + shared) @ root.T == pytest.approx(np.eye(len(_TARGET)), abs=1e-13)
