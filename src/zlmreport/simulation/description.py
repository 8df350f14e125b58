"""What is simulated: an axis, a plan, effects, conditions and noise; all in SI."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from zlmreport.measurement.axis import Axis
from zlmreport.model.axis_model import Term
from zlmreport.planning.methods import Method
from zlmreport.quantities.arrays import FloatArray


@dataclass(frozen=True, slots=True)
class Plan:
    """How the axis is tested.

    Attributes
    ----------
    targets : (m,) array
        Target positions, rising, m or rad.
    method
        The positioning method.
    runs
        How often each target is read in each direction.
    overrun
        How far beyond a target the axis turns round, m or rad.
    feed
        m/s or rad/s.
    dwell
        Time at rest before each reading, s.
    """

    targets: FloatArray
    method: Method = Method.LINEAR
    runs: int = 5
    overrun: float = 5e-3
    feed: float = 2 / 60
    dwell: float = 5.0


@dataclass(frozen=True, slots=True)
class Course:
    """How a condition changes during the test, and how it is logged.

    Attributes
    ----------
    start
        At the first reading, SI.
    end
        At the last reading where there is no time constant, else what it tends to; None: it stays.
    time_constant
        Of the way from start to end, s; None for a straight way.
    swing
        Amplitude of a sine that is added.
    swing_period
        Its period, s.
    sensor_noise
        Standard deviation of what is logged.
    resolution
        Of what is logged; 0 for none.
    is_logged
        Whether the condition is logged at all; it acts in any case.
    """

    start: float
    end: float | None = None
    time_constant: float | None = None
    swing: float = 0.0
    swing_period: float = 900.0
    sensor_noise: float = 0.0
    resolution: float = 0.0
    is_logged: bool = True


@dataclass(frozen=True, slots=True)
class Noise:
    """Everything random about the readings, m or rad, as standard deviations.

    Attributes
    ----------
    reading
        σ of a single reading.
    unequal
        By which share of itself σ differs from target to target, at most.
    position
        Fixed in position: geometry that no smooth effect describes.
    position_and_direction
        Fixed in position, of opposite sign in the two directions.
    run
        Every run a little displaced.
    drift, drift_time
        Slow random drift, and the time over which it forgets itself, s.
    outlier_share, outlier_size
        The probability that a reading is off, and by how much, up or down.
    missing_share
        The probability that a reading is missing.
    resolution
        Of the instrument; 0 for none.
    """

    reading: float = 0.0
    unequal: float = 0.0
    position: float = 0.0
    position_and_direction: float = 0.0
    run: float = 0.0
    drift: float = 0.0
    drift_time: float = 600.0
    outlier_share: float = 0.0
    outlier_size: float = 0.0
    missing_share: float = 0.0
    resolution: float = 0.0


@dataclass(frozen=True, slots=True)
class Description:
    """A test that is to be simulated.

    Attributes
    ----------
    axis
        The axis, with its tables.
    plan
        How it is tested.
    seed
        Of everything random: the same description gives the same test. Each random part has a stream of
        its own, so that changing one leaves the others as they are.
    effects
        What makes the axis err, each with the values of its parameters; linear ones that are left out are 0.
    conditions
        By name.
    noise
        Everything random about the readings.
    time_is_logged
        Whether the readings carry times.
    """

    axis: Axis
    plan: Plan
    seed: int
    effects: tuple[Term, ...] = ()
    conditions: Mapping[str, Course] = field(default_factory=dict)
    noise: Noise = field(default_factory=Noise)
    time_is_logged: bool = True
