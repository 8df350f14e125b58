"""Whether readings have long tails: told from places that scatter more, and from chance."""

from __future__ import annotations

import numpy as np
import pytest

from zlmreport.evaluation.uncertainty.long_tails import find_long_tails


def residuals(seed: int, kind: str) -> np.ndarray:
    """Return the residuals of 22 places in 5 runs, µm."""
    generator = np.random.default_rng(seed)
    readings = generator.standard_normal((22, 5))
    if kind == "tails":
        readings = generator.standard_t(3, (22, 5))
    elif kind == "places":
        readings *= np.exp(np.linspace(-1, 1, 22))[:, np.newaxis]
    return np.asarray(readings - readings.mean(axis=1, keepdims=True))


def probability(kind: str) -> float:
    """Return the mean probability of long tails over some tests."""
    found = [find_long_tails(residuals(seed, kind)) for seed in range(12)]
    return float(np.mean([each.probability if each else 0.0 for each in found]))


def test_long_tails_are_seen_and_neither_chance_nor_places_are_taken_for_them() -> None:
    assert probability("tails") > 0.7
    assert probability("normal") < 0.2
    assert probability("places") < 0.2


def test_the_scale_goes_with_the_readings() -> None:
    one, thousand = (find_long_tails(factor * residuals(1, "tails")) for factor in (1.0, 1000.0))

    assert thousand.probability == pytest.approx(one.probability)
    assert thousand.scale == pytest.approx(1000 * one.scale)


def test_the_axes_that_are_drawn_are_the_likely_ones() -> None:
    tails = find_long_tails(residuals(1, "tails"))

    freedom, scale = tails.draw(2000, np.random.default_rng(1))

    assert set(freedom) <= set(tails.freedom)
    assert np.median(scale) == pytest.approx(1.0, rel=0.4)


def test_what_is_missing_is_left_out() -> None:
    gaps = residuals(1, "tails")
    gaps[2, 1] = np.nan

    assert find_long_tails(gaps) is not None


def test_readings_that_do_not_scatter_and_pairs_of_runs_tell_nothing() -> None:
    assert find_long_tails(np.zeros((22, 5))) is None
    assert find_long_tails(residuals(1, "tails")[:, :2]) is None
