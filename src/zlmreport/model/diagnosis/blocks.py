"""Linear algebra of blocks of columns: what each explains of the readings.

A block may hold columns that depend on each other, or on what stands beside them; these count once, or not at
all.
"""

from __future__ import annotations

import numpy as np

from zlmreport.measurement.arrays import FloatArray

#: Square of the share of a block's length below which a set imitates it.
IMITATED = 1e-6
#: Columns of a set whose product is smaller, of the largest, depend on the others.
_DEPENDENT = 1e-9
#: Square of the length of a column, of one in a block, that is rounding: the model imitates it.
_ZERO = 1e-14
#: A value that stands for none where all are nothing.
_NOTHING = 1e-60


def find_root_of(gram: FloatArray) -> FloatArray:
    """Return S with S·G·Sᵀ the unit matrix, for a Gram matrix whose columns may depend on each other."""
    if not len(gram):
        return np.empty((0, 0))
    squares = np.diagonal(gram)
    # A column of zeros has no length: divided by one, the rounding of a vector would outgrow all the others.
    seen = squares > _ZERO
    lengths = np.sqrt(np.where(seen, squares, 1.0))
    values, vectors = np.linalg.eigh(np.where(np.outer(seen, seen), gram, 0.0) / np.outer(lengths, lengths))
    kept = values > _DEPENDENT * max(float(values[-1]), _NOTHING)
    return np.asarray((vectors[:, kept] / np.sqrt(values[kept])).T * (seen / lengths))


def take_from(gram: FloatArray, coordinates: FloatArray) -> FloatArray:
    """Return products of the columns of blocks among themselves, (g, k, k), less what a set takes away.

    `coordinates`, (p, g·k): The columns in the coordinates of the set.
    """
    inner = coordinates.reshape(len(coordinates), *gram.shape[:2]).transpose(1, 2, 0)
    return np.asarray(gram - inner @ inner.transpose(0, 2, 1))


def solve_blocks(gram: FloatArray, products: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return bᵀG⁻¹b and the rank of G for each of many blocks: gram (g, k, k), products (g, k, B)."""
    if gram.shape[1] == 1:
        seen = gram[:, 0, 0] > IMITATED
        inverse = np.where(seen, 1.0 / np.where(seen, gram[:, 0, 0], 1.0), 0.0)
        return products[:, 0] ** 2 * inverse[:, np.newaxis], seen.astype(np.float64)
    values, vectors = np.linalg.eigh(gram)
    seen = values > IMITATED
    inverse = np.where(seen, 1.0 / np.where(seen, values, 1.0), 0.0)
    turned = vectors.transpose(0, 2, 1) @ products
    return np.einsum("gk,gkb->gb", inverse, turned**2), seen.sum(axis=1).astype(np.float64)


def average_likelihoods(criteria: FloatArray, axis: int | None) -> FloatArray:
    """Return −2·ln of the sum of likelihoods along an axis, or over all."""
    least = criteria.min(axis=axis, keepdims=True)
    summed = np.exp(-0.5 * (criteria - least)).sum(axis=axis)
    return np.asarray(np.squeeze(least, axis) - 2.0 * np.log(summed))
