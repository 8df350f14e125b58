"""Any place of the travel, measured or not, as the design of readings that could be taken there."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from zlmreport.measurement.approach import Approach
from zlmreport.model.design import Design
from zlmreport.quantities.arrays import FloatArray, read_only_floats, read_only_integers
from zlmreport.quantities.units import Unit

_ROUNDING = 1e-12


def at_positions(design: Design, positions: FloatArray, approach: Approach) -> Design:
    """Return the design of one approach to positions, all else being as it was in the mean of the test.

    Parameters
    ----------
    design
        The test.
    positions : (M,) array
        Within its travel, m or rad.
    approach
        A direction in which it was measured.
    """
    count = len(positions)
    of_approach = np.flatnonzero(design.direction == approach)
    order = of_approach[np.argsort(design.position[of_approach], kind="stable")]
    targets, first = np.unique(design.position[order], return_index=True)
    travelled = np.add.reduceat(design.since_reversal[order], first) / np.diff([*first, len(order)])
    return replace(
        design,
        position=read_only_floats(positions),
        direction=read_only_floats(np.full(count, float(approach))),
        run=read_only_integers(np.full(count, int(np.median(design.run)))),
        target=read_only_integers(np.arange(count)),
        time=read_only_floats(np.full(count, design.time.mean())),
        since_reversal=read_only_floats(np.interp(positions, targets, travelled)),
        conditions={
            name: read_only_floats(np.full(count, log.mean())) for name, log in design.conditions.items()
        },
    )


def outside(name: str, unit: Unit, positions: FloatArray, span: tuple[float, float]) -> list[str]:
    """Return a sentence on each position at which nothing may be said: a model knows nothing beyond its data.

    Parameters
    ----------
    name
        Of the axis.
    unit
        In which its positions are printed.
    positions : (M,) array
        m or rad.
    span
        First and last position that was measured, m or rad.
    """
    first, last = (unit.from_si(end) for end in span)
    # Positions come in decimal units: an end itself may be off by a rounding.
    slack = _ROUNDING * max(map(abs, span))
    return [
        f"{name} = {unit.from_si(position):g} {unit.symbol} lies outside of what was measured, "
        f"{first:g} to {last:g} {unit.symbol}"
        for position in positions.tolist()
        if not span[0] - slack <= position <= span[1] + slack
    ]
