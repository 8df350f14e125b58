"""One contribution to the uncertainty of the set-up: how large it is, and which readings share it."""

from __future__ import annotations

import math
from dataclasses import dataclass
from enum import Enum

from zlmreport.language import Words


class Acts(Enum):
    """Which readings of a test share one error.

    Of a scale error all: zero at the datum, where the instrument is zeroed, and in proportion to the
    distance from it. Of an error that parts the directions (the radius of a probe that touches one face in
    each of them) all of the negative direction: the datum lies in the positive one. Of an error of the datum
    all, and alike. Of an error of position (the faces of a polygon, the nonlinearity of a sensor)
    all readings of one target position; of a face that is touched from one side only all
    readings of one target position in one direction. Of a drift those that are near in time
    (`zlmreport.uncertainty.drift`). Of a fluctuation none: each reading has its own.
    """

    ALONG_THE_LENGTH = "along-the-length"
    BETWEEN_DIRECTIONS = "between-directions"
    AT_THE_DATUM = "at-the-datum"
    AT_EACH_POSITION = "at-each-position"
    AT_EACH_APPROACH = "at-each-approach"
    IN_TIME = "in-time"
    AT_EACH_READING = "at-each-reading"


class Distribution(Enum):
    """How the error is distributed over the values that it may have.

    ONE_SIDED is rectangular from zero to the whole range: a cosine error, that makes every length too
    short and none too long. KNOWN is no distribution: an error of known size that nobody corrected, such as
    the expansion of a warm machine (JCGM 100, F.2.4.5).
    """

    NORMAL = "normal"
    RECTANGULAR = "rectangular"
    TRIANGULAR = "triangular"
    ONE_SIDED = "one-sided"
    KNOWN = "known"

    @property
    def range_over_standard_uncertainty(self) -> float:
        """The full range of the possible values in units of their root mean square (JCGM 100, 4.3.7, 4.3.9).

        A normal distribution has no ends: it is infinite.
        """
        return _RANGES[self]


_RANGES = {
    Distribution.NORMAL: math.inf,
    Distribution.RECTANGULAR: math.sqrt(12.0),
    Distribution.TRIANGULAR: math.sqrt(24.0),
    Distribution.ONE_SIDED: math.sqrt(3.0),
    Distribution.KNOWN: 1.0,
}


@dataclass(frozen=True, slots=True)
class Contribution:
    """A contribution to the uncertainty of the readings.

    Attributes
    ----------
    name
        What it comes from.
    standard_uncertainty
        u at full effect, m or rad: the root mean square of the error of a single reading, of one that acts
        along the length at the end of the measured length. About zero, for no reading is corrected for it:
        of a one-sided error it holds the mean too.
    acts
        Which readings share one error.
    distribution
        Of the error.
    stated
        The figure from which u was formed, as it is printed: ``U = 0.3 µm (k = 2)``.
    source
        Where that figure comes from.
    contributor
        Which usual contributor it is, by its key under ``uncertainty`` or ``instrument``; None for others.
    sign
        +1 or −1, of a known error: that of what would have to be added to the readings.
    """

    name: Words
    standard_uncertainty: float
    acts: Acts
    distribution: Distribution
    stated: Words
    source: Words
    contributor: str | None = None
    sign: int = 1
