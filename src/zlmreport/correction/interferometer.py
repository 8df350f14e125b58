"""What an interferometer that did not know its air has displayed, and what it should have.

The instrument counts half wavelengths. From its datum on it has counted n·(Dp + D) − n₀·Dp in vacuum
units: n is the index of the air now, n₀ that when it was set to zero, Dp the dead path, D the displacement.
It displayed the count over the index nₐ that it assumed. Solved for D:

    D = (nₐ/n)·(displayed displacement) − Dp·(n − n₀)/n.
"""

from __future__ import annotations

from zlmreport.quantities.arrays import FloatArray


def displacement_in_air(displayed: FloatArray, index: FloatArray, assumed_index: float) -> FloatArray:
    """Return the displacement by the true wavelength, D·nₐ/n.

    Parameters
    ----------
    displayed : (N,) array
        Displacement from the datum as the instrument displayed it, m.
    index : (N,) array
        n at each reading.
    assumed_index
        nₐ.
    """
    return displayed * (assumed_index / index)


def dead_path_error(index: FloatArray, index_at_datum: float, dead_path: float) -> FloatArray:
    """Return how far the air along the dead path has moved the datum, Dp·(n − n₀)/n, m.

    Parameters
    ----------
    index : (N,) array
        n at each reading.
    index_at_datum
        n₀, when the instrument was set to zero.
    dead_path
        Dp, m.
    """
    return dead_path * (index - index_at_datum) / index
