"""The measurement set: readings in the order of time; of each condition what is usual, what is refused."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from types import MappingProxyType

import numpy as np

from zlmreport.language import Words
from zlmreport.measurement.approach import Approach
from zlmreport.measurement.arrays import FloatArray, IntArray, count_decimals_of
from zlmreport.measurement.axis import Axis
from zlmreport.measurement.provenance import Provenance
from zlmreport.measurement.units import (
    CELSIUS,
    HECTOPASCAL,
    PERCENT,
    PRESSURE_UNITS,
    RATIO_UNITS,
    TEMPERATURE_UNITS,
    Scale,
)


@dataclass(frozen=True, slots=True)
class ConditionKind:
    """A kind of condition."""

    units: Mapping[str, Scale]  #: The units that files may give it in, by their spellings.
    unit: Scale  #: The one that is meant where a file names none, and in which messages speak.
    #: lowest and highest: In that unit: beyond, the value is a mistake and not the condition of a
    #: measurement.
    lowest: float
    highest: float
    #: In that unit, the lowest and the highest that is usual where machines are measured.
    usual: tuple[float, float]

    def find_likely_unit(self, value: float) -> tuple[Scale, float] | None:
        """Return the unit in which an unusual value would be a usual one, and that one to three digits."""
        low, high = self.usual
        if low <= value <= high:
            return None
        others = ((each, self.unit.from_si(each.to_si(value))) for each in self.units.values())
        return next(((unit, float(f"{other:.3g}")) for unit, other in others if low <= other <= high), None)


#: Decimals in which deviations may be given, in their unit.
_MOST_DECIMALS = 3
#: Differences that must all be multiples of a step, and how many sizes they must have at least: of one that
#: is a multiple by chance, with a probability of a half at most, twenty in a row are none.
_FEWEST_DIFFERENCES, _FEWEST_SIZES = 20, 2

#: What the conditions are called on pages.
CONDITION_NAMES: Mapping[str, Words] = MappingProxyType(
    {
        "axis_temperature": Words("Temperature of the machine's scale"),
        "screw_temperature": Words("Temperature of the screw"),
        "air_temperature": Words("Air temperature"),
        "material_temperature": Words("Material temperature"),
        "air_pressure": Words("Air pressure"),
        "relative_humidity": Words("Relative humidity"),
    }
)

#: What the refractive index of air follows from.
STATE_OF_AIR = ("air_temperature", "air_pressure", "relative_humidity")

_TEMPERATURE = ConditionKind(TEMPERATURE_UNITS, CELSIUS, -50.0, 150.0, (0.0, 45.0))
#: On the highest mountain it is some 330 hPa: below, a barometer fell silent.
_PRESSURE = ConditionKind(PRESSURE_UNITS, HECTOPASCAL, 300.0, 1200.0, (600.0, 1100.0))
_HUMIDITY = ConditionKind(RATIO_UNITS, PERCENT, 0.0, 100.0, (2.0, 100.0))

#: By name; `axis_temperature` is that of the machine's scale.
CONDITIONS: Mapping[str, ConditionKind] = MappingProxyType(
    {
        "axis_temperature": _TEMPERATURE,
        "screw_temperature": _TEMPERATURE,
        "air_temperature": _TEMPERATURE,
        "material_temperature": _TEMPERATURE,
        "air_pressure": _PRESSURE,
        "relative_humidity": _HUMIDITY,
    }
)


@dataclass(frozen=True, slots=True)
class MissingReading:
    """A reading that the test should have and has not."""

    target_position: float  #: m or rad.
    approach: Approach  #: Direction of approach.
    run: int  #: Number of the run, from 1.


@dataclass(frozen=True, slots=True)
class Compensated:
    """What an instrument has corrected before it displayed a reading."""

    #: The coefficient by which it took the expansion of the material to 20 °C, 1/K; None if it did not.
    material: float | None = None
    air: bool | None = None  #: Whether it knew the refractive index of the air; None where nobody says.


@dataclass(frozen=True, slots=True)
class MeasurementSet:
    """Readings in the order in which they were taken; nobody alters them.

    A correction makes a new set and says so in its provenance. Build one with
    `zlmreport.measurement.collect.collect`, which checks what a reader has read.

    Attributes
    ----------
    axis
        The axis under test.
    target_positions : (m,) array
        P_i, rising, m or rad.
    target : (N,) integer array
        For each reading, the index of its target position.
    approach : (N,) integer array
        For each reading, +1 or −1: the `Approach`.
    run : (N,) integer array
        For each reading, the number of its run, from 1.
    deviation : (N,) array
        x = actual − target, m or rad; NaN where the reading is named but missing.
    time : (N,) array or None
        Seconds from the first reading that has a time, NaN for readings that have none; None where the
        source does not tell.
    conditions : mapping of name to (N,) array
        What was logged beside each reading, SI (K, Pa, 1) where the contract names the column, as found
        otherwise; NaN where not logged.
    provenance
        Where the readings come from.
    one_sided_targets
        Whether each target can be reached in one direction only, as faces that a probe touches: the other
        direction is then no reading that is missing.
    reversal_is_relative
        Whether the readings of the two directions were brought together by means of themselves, as by a
        probe's radius that the readings themselves tell: reversal values are then relative to their mean.
    datum
        Position at which the instrument was set to zero, m or rad; None where the source does not tell.
    is_indication
        Whether the deviations are errors of indication, indicated − calibrated position: x with the opposite
        sign, as a test with an artefact states it.
    compensated
        What the instrument has corrected already; None where the source does not tell.
    artefact_is_reversed
        Whether the straightness of the artefact was taken out of the readings, by measuring the line with it
        turned over, too.
    tests
        Several measured lines that are evaluated together, by their names; the set then has no readings of
        its own. Build one with `join_lines`.
    """

    axis: Axis
    target_positions: FloatArray
    target: IntArray
    approach: IntArray
    run: IntArray
    deviation: FloatArray
    time: FloatArray | None = None
    conditions: Mapping[str, FloatArray] = field(default_factory=dict)
    provenance: Provenance = field(default_factory=lambda: Provenance(source="unknown"))
    one_sided_targets: bool = False
    reversal_is_relative: bool = False
    is_indication: bool = False
    datum: float | None = None
    compensated: Compensated | None = None
    artefact_is_reversed: bool = False
    tests: Mapping[str, MeasurementSet] = field(default_factory=dict)

    @property
    def lines(self) -> tuple[MeasurementSet, ...]:
        """What has readings: each of several measured lines, or the set itself."""
        return tuple(self.tests.values()) or (self,)

    @property
    def zero(self) -> float:
        """Where the instrument was set to zero, m or rad: at its datum, or else at the first target."""
        return float(self.target_positions[0]) if self.datum is None else self.datum

    @property
    def approaches(self) -> tuple[Approach, ...]:
        """The directions that were measured, the positive one first."""
        return tuple(approach for approach in Approach if np.any(self.approach == approach))

    @property
    def is_bidirectional(self) -> bool:
        """Whether targets were approached from both directions."""
        return len(self.approaches) == len(Approach)

    @property
    def runs(self) -> IntArray:
        """Return the numbers of the runs, rising, shape (n,)."""
        return np.unique(self.run)

    def deviations(self) -> FloatArray:
        """Return the deviations as standards take them: shape (approach, position, run), NaN where missing.

        The approach axis always has two places, `Approach.index`; a direction that was not measured is
        all NaN. Runs stand in the order of their numbers.
        """
        return self.arranged(self.deviation)

    def arranged(self, values: FloatArray) -> FloatArray:
        """Return one value for each reading, shape (N,), as `deviations` arranges the readings."""
        runs = self.runs
        grid = np.full((len(Approach), len(self.target_positions), len(runs)), np.nan)
        direction = np.where(self.approach == Approach.POSITIVE, 0, 1)
        grid[direction, self.target, np.searchsorted(runs, self.run)] = values
        return grid

    def missing(self) -> tuple[MissingReading, ...]:
        """Return what is missing from a full test of every target in every run of each measured direction."""
        grid = self.deviations()
        found = []
        for approach in self.approaches:
            of_approach = grid[approach.index]
            runs_taken = np.unique(self.run[self.approach == approach])
            reachable = np.unique(self.target[self.approach == approach])
            for position, column in np.argwhere(np.isnan(of_approach)):
                if self.one_sided_targets and position not in reachable:
                    continue
                if self.runs[column] in runs_taken:
                    found.append(
                        MissingReading(
                            float(self.target_positions[position]), approach, int(self.runs[column])
                        )
                    )
        return tuple(found)


def join_lines(axis: Axis, tests: Mapping[str, MeasurementSet]) -> MeasurementSet:
    """Return several measured lines as one set, for what follows from them together.

    `axis`: What follows, and of which axis.
    """
    none, whole = np.empty(0), np.empty(0, dtype=np.int64)
    for array in (none, whole):
        array.setflags(write=False)
    sources = dict.fromkeys(each.provenance.source for each in tests.values())
    files = dict.fromkeys(file for each in tests.values() for file in each.provenance.files)
    return MeasurementSet(
        axis=axis,
        target_positions=none,
        target=whole,
        approach=whole,
        run=whole,
        deviation=none,
        provenance=Provenance(source=", ".join(sources), files=tuple(files)),
        tests=dict(tests),
    )


def find_last_digit(measurements: MeasurementSet) -> float:
    """Return the step of the last digit of the readings, 0.001 at least, in the unit of deviations."""
    readings = measurements.axis.deviation_unit.from_si(measurements.deviation)
    return float(10.0 ** -count_decimals_of(readings, _MOST_DECIMALS))


def find_step(measurements: MeasurementSet) -> float:
    """Return the step in which the readings were given, in the unit of deviations.

    It is that of their last digit, or a coarser one where all of them differ by multiples of more, as those
    of a display with steps of 10 µm. Of positions that were read so the deviations keep it at each target
    alone.
    """
    digit = find_last_digit(measurements)
    there = np.isfinite(measurements.deviation)
    readings = measurements.axis.deviation_unit.from_si(measurements.deviation[there])
    given = np.round(readings / digit).astype(np.int64)
    return digit * _find_common_step(given, measurements.target[there])


def _find_common_step(given: IntArray, target: IntArray) -> int:
    """Return the largest number of which all readings at a target differ by multiples; 1 where chance may do.

    `given`: Readings in steps of their last digit; `target`: the target of each.
    """
    if not given.size:
        return 1
    first = np.zeros(int(target.max()) + 1, dtype=np.int64)
    first[target[::-1]] = given[::-1]
    for differences in (given - first[target], given - given[0]):
        sizes = np.abs(differences[differences != 0])
        if sizes.size >= _FEWEST_DIFFERENCES and len(np.unique(sizes)) >= _FEWEST_SIZES:
            return int(np.gcd.reduce(sizes))
    return 1
