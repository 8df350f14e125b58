"""The graph of a periodic effect folded on one of its periods."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from zlmreport.document.subjects.linked import collect_drawn_values
from zlmreport.language import Language, Words
from zlmreport.language.formatting import write_general_number
from zlmreport.measurement.approach import Approach
from zlmreport.measurement.arrays import FloatArray
from zlmreport.model.diagnosis.study import correct_by_model
from zlmreport.model.effects.design import Design, place_at_positions
from zlmreport.model.fitting.curve import find_waves_along
from zlmreport.model.fitting.fit import Fit
from zlmreport.web.bench import Bench, Loaded

#: A wave is drawn at so many places.
_PLACES = 240
#: The shortest wave of an effect is one of the harmonics of its period: tried up to this one.
_HARMONICS = 6
#: What repeats after a period differs by no more than this share of its size.
_SAME = 1e-6
#: Fewer periods in the travel are seen as well without being laid over each other.
_LEAST_PERIODS = 2.0
_WITHIN = Words("Position within {period} {unit}")
_PART = Words("Deviation less the other effects")


@dataclass(frozen=True, slots=True)
class _Wave:
    """An effect of a model that repeats along the axis."""

    fit: Fit
    place: int  #: Of the effect among those of the model.

    def compute(self, design: Design) -> FloatArray:
        """Return what the effect makes of readings, m or rad, shape (N,)."""
        effect, solution = self.fit.model.terms[self.place].effect, self.fit.solution
        columns = effect.columns(design, solution.thetas[self.place])
        return np.asarray(columns @ solution.coefficients[self.place], dtype=np.float64)

    def compute_along(self, positions: FloatArray, approach: Approach) -> FloatArray:
        """Return what the effect makes of readings at positions in one direction, m or rad, shape (M,)."""
        return self.compute(place_at_positions(self.fit.design, positions, approach))

    def find_period(self) -> float | None:
        """Return after which length the effect repeats, m or rad; None if it does not."""
        design = self.fit.design
        shortest = find_waves_along(self.fit)[self.fit.model.identifiers[self.place]]
        first, last = design.span
        if not np.isfinite(shortest) or shortest <= 0:
            return None
        approach = Approach.POSITIVE if np.any(design.direction > 0) else Approach.NEGATIVE
        for length in (count * shortest for count in range(1, _HARMONICS + 1)):
            if _LEAST_PERIODS * length > last - first:
                return None
            here = np.linspace(first, last - length, _PLACES)
            now, later = self.compute_along(here, approach), self.compute_along(here + length, approach)
            if np.max(np.abs(now - later)) <= _SAME * np.max(np.abs(now)):
                return float(length)
        return None


def fold(bench: Bench, loaded: Loaded, named: str, language: Language) -> dict[str, Any] | None:
    """Return the readings and the wave of an effect on one period; None where it does not repeat.

    What the other effects of the model explain is taken away from the readings. In the units of the page.

    `named`: An effect of the model; or one that it may lack, as a job names it.

    Raises `InputError` if there is no such effect, or it cannot be fitted.
    """
    present = bench.fit_whole(loaded)
    fitted = present if named in present.fit.model.identifiers else bench.fit_with_effect(loaded, named)
    fit = fitted.fit.of_the_job
    # An effect that is added is the last of its model.
    place = fit.model.identifiers.index(named) if fitted is present else len(fit.model.terms) - 1
    wave = _Wave(fit, place)
    period = wave.find_period()
    if period is None:
        return None
    study, axis = loaded.study, loaded.job.axis
    observed = study.observed
    left = correct_by_model(study.measurements, observed, fitted.fit).deviation[observed.reading]
    unit, along = axis.deviation_unit, axis.position_unit
    first = fit.design.span[0]
    start = np.ceil(first / period) * period
    within = np.linspace(0.0, period, _PLACES)
    directions = [each for each in Approach if np.any(observed.design.direction == each)]
    length = write_general_number(along.from_si(period), language.decimal_sign, 4)
    title = _WITHIN.given(period=length, unit=along.symbol)
    return {
        "x": collect_drawn_values(along.from_si(observed.design.position % period)),
        "y": collect_drawn_values(unit.from_si(left + wave.compute(observed.design))),
        "direction": np.where(observed.design.direction > 0, 1, -1).tolist(),
        "curves": [
            {
                "direction": int(approach),
                "x": collect_drawn_values(along.from_si(within)),
                "y": collect_drawn_values(unit.from_si(wave.compute_along(start + within, approach))),
            }
            for approach in directions
        ],
        "range": collect_drawn_values(along.from_si(np.array([0.0, period]))),
        "xTitle": title.in_language(language),
        "yTitle": f"{_PART.in_language(language)} ({unit.symbol})",
    }
