"""The regression of mean deviations on position, along one axis and in a plane of two.

M. Halaj, E. Kureková, R. Palenčár and T. Loebl, The positional deviation in two axes: a cubic over the means
of the targets (2), or a sum of two cubics over the plane of two axes (13), with the covariance of the means
(9), (10). The error model of this program fits single readings instead (`zlmreport.model.fit`); this is the
paper as it stands, for comparison with it, and for measurements in a plane.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from zlmreport.model.axis_model import ModelError
from zlmreport.model.fit import Prediction
from zlmreport.model.instrument import InstrumentError
from zlmreport.model.search import solve
from zlmreport.quantities.arrays import FloatArray

_COVERAGE_FACTOR = 2.0


@dataclass(frozen=True, slots=True)
class Regression:
    """A fitted polynomial of one or two positions, without interactions.

    Attributes
    ----------
    order
        Highest power of each position.
    coefficients : (1 + order·axes,) array
        a, then b, c, d, … of the first axis, then those of the second; SI: m, 1, m⁻¹, m⁻², …
    covariance : square array
        Of the coefficients: the variances of the means are taken as known.
    residual : (M,) array
        Means less polynomial, m.
    """

    order: int
    coefficients: FloatArray
    covariance: FloatArray
    residual: FloatArray

    def predict(self, *positions: FloatArray) -> Prediction:
        """Return the deviation at any point of the measured travel or plane, with k = 2.

        Parameters
        ----------
        positions
            An array for each axis, of one shape, m.
        """
        columns = _columns(positions, self.order)
        variance = np.einsum("np,pq,nq->n", columns, self.covariance, columns)
        return Prediction(
            columns @ self.coefficients, np.sqrt(variance), np.full(len(columns), _COVERAGE_FACTOR)
        )


def regress(
    positions: tuple[FloatArray, ...],
    mean_deviation: FloatArray,
    standard_uncertainty: FloatArray,
    instrument: InstrumentError,
    order: int = 3,
) -> Regression:
    """Fit the paper's polynomial to mean deviations.

    Parameters
    ----------
    positions
        One array for the axis P, equation (2); two for the plane P, R, equation (13); each (M,), m.
    mean_deviation : (M,) array
        Means of the readings, of one direction of approach, m.
    standard_uncertainty : (M,) array
        u(P_i) of each mean, equation (10), m.
    instrument
        u(δ), common to all; a share proportional to position counts along the first axis.
    order
        Highest power.

    Raises
    ------
    ModelError
        If there are too few points, or they do not determine all coefficients.
    """
    columns = _columns(positions, order)
    points, unknowns = columns.shape
    if points < unknowns:
        raise ModelError(
            [f"{points} points do not determine {unknowns} coefficients; measure more, or lower the order"]
        )
    weighted = columns / standard_uncertainty[:, np.newaxis]
    lengths = np.linalg.norm(weighted, axis=0)
    if np.linalg.matrix_rank(weighted / np.where(lengths > 0, lengths, 1.0)) < unknowns:
        raise ModelError(
            ["the points do not determine all coefficients; spread them over the plane, or lower the order"]
        )
    # The instrument's error is common to all points and changes no estimate; it adds to the covariance.
    coefficients = solve(weighted, mean_deviation / standard_uncertainty)
    root = np.linalg.pinv(weighted / lengths) / lengths[:, np.newaxis]
    systematic = root @ (instrument.factor(positions[0]) / standard_uncertainty[:, np.newaxis])
    return Regression(
        order,
        coefficients,
        root @ root.T + systematic @ systematic.T,
        mean_deviation - columns @ coefficients,
    )


def _columns(positions: tuple[FloatArray, ...], order: int) -> FloatArray:
    powers = [np.vander(np.asarray(each), order + 1, increasing=True)[:, 1:] for each in positions]
    return np.concatenate([np.ones((len(positions[0]), 1)), *powers], axis=1)
