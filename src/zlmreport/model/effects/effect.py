"""The interface of an effect: parameters with ranges, and the needs that effects have in common.

Each of the functions that begin with ``needs`` says in words what is missing, or returns None. An effect
joins its needs by ``or``, the first that is not met answers::

    def untestable(self, design: Design) -> Words | None:
        return needs_linear_axis(design) or needs_logged(design, "axis_temperature")
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from enum import Enum
from typing import Any, Protocol, runtime_checkable

import numpy as np

from zlmreport.job.types import Options
from zlmreport.language import Words
from zlmreport.measurement.arrays import FloatArray
from zlmreport.measurement.axis import Axis, AxisKind
from zlmreport.measurement.units import ARCSECOND, DEGREE, MICROMETRE, MILLIMETRE, Unit
from zlmreport.model.effects.design import Design

_NO_COLUMN = Words("no column {column} was logged beside the readings")
_NO_COLUMNS = Words("no columns {columns} were logged beside the readings")
_NO_KEY = Words("the job does not state {key}")
_ONE_DIRECTION = Words("the targets were approached from one direction only")
_NOT_LINEAR = Words("for linear axes only")
_NOT_ROTARY = Words("for rotary axes only")
_FEW_TARGETS = Words("at least {least} target positions are needed; there are {found}")
_FEW_RUNS = Words("at least {least} runs are needed; there are {found}")
_NO_TIME = Words("no time passes between the first reading and the last")
_FEW_MOMENTS = Words("the readings were taken at too few different times")
_LEAST_MOMENTS = 4
_NO_PAUSE = Words("there is no long pause between the readings")
#: A pause is so many times as long as the usual time between readings, and such a share of the test at least.
_PAUSE_OF_GAPS, _PAUSE_OF_TEST, _MOST_PAUSES = 10.0, 0.05, 3
_SHORT_TRAVEL = Words("the measured travel is shorter than one period ({key})")


#: What an effect says of its plausible ranges that names no source.
CHOSEN_RANGES = Words("chosen wide by its author, to catch what no machine does; no standard states them")


class Dimension(Enum):
    """What kind of quantity a parameter is; its printed unit follows from it and the kind of axis."""

    DEVIATION = "deviation"
    SLOPE = "deviation per position"
    POSITION = "position along the axis"
    TIME = "time"
    DEVIATION_PER_KELVIN = "deviation per kelvin"
    EXPANSION = "deviation per position and kelvin"
    LENGTH = "length across the axis"
    ANGLE = "phase"
    RATIO = "ratio"


_LINEAR = {
    Dimension.DEVIATION: MICROMETRE,
    Dimension.SLOPE: Unit("µm/m", "um/m", 1e6),
    Dimension.POSITION: MILLIMETRE,
    Dimension.TIME: Unit("s", "s", 1.0),
    Dimension.DEVIATION_PER_KELVIN: Unit("µm/K", "um/K", 1e6),
    Dimension.EXPANSION: Unit("µm/(m·K)", "um/(m K)", 1e6),
    Dimension.LENGTH: MILLIMETRE,
    Dimension.ANGLE: DEGREE,
    Dimension.RATIO: Unit("", "1", 1.0),
}
_ROTARY = _LINEAR | {
    Dimension.DEVIATION: ARCSECOND,
    Dimension.SLOPE: Unit("″/°", "arcsec/deg", ARCSECOND.per_si / DEGREE.per_si),
    Dimension.POSITION: DEGREE,
    Dimension.DEVIATION_PER_KELVIN: Unit("″/K", "arcsec/K", ARCSECOND.per_si),
    Dimension.EXPANSION: Unit("″/(°·K)", "arcsec/(deg K)", ARCSECOND.per_si / DEGREE.per_si),
}
_READINGS = Unit("readings", "readings", 1.0)


def find_unit_on(design: Design, dimension: Dimension) -> Unit:
    """Return the unit in which a parameter is printed of a test, which may count readings, not seconds."""
    if dimension is Dimension.TIME and design.time_is_counted:
        return _READINGS
    return find_unit_of(dimension, design.axis.kind)


def find_unit_of(dimension: Dimension, kind: AxisKind) -> Unit:
    """Return the unit in which a parameter is read and printed on a kind of axis."""
    return (_LINEAR if kind is AxisKind.LINEAR else _ROTARY)[dimension]


@dataclass(frozen=True, slots=True)
class NamedValue:
    """Values of a parameter that have a name: an air that was corrected twice."""

    #: low and high: From where to where, SI.
    low: float
    high: float
    says: Words  #: What happened then.


@dataclass(frozen=True, slots=True)
class Parameter:
    """A parameter of an effect.

    Attributes
    ----------
    name
        ASCII, as jobs and results files name it: ``lost_motion``.
    notation
        As printed: ``B``.
    dimension
        What kind of quantity it is.
    description
        In words.
    smallest, largest
        The range beyond which a value is asked for, SI; it is never clipped. None where nothing is known. The
        range of a time is in seconds and says nothing where time is counted.
    is_refined
        Of a searched parameter, whether the search goes on between the values of the grid: not where only
        these make sense (a number of teeth), or where nothing changes between them (the gap of a joint).
    is_counted
        Of a searched parameter, whether it is a whole number: of teeth, or that of a run.
    usual, usual_on_rotary
        Smallest and largest value that machines have, SI, on a linear and on a rotary axis; None where the
        range says it, and where both have as many metres as radians.
    question, question_below
        What is asked of a value far beyond the usual, and of one that is too small where that is another
        question; ``{value}`` and ``{times}`` stand in it (`ask_of`).
    named
        Values that have a name of their own.
    instead_of
        The key of the axis in whose place it has another value; None of others.
    """

    name: str
    notation: str
    dimension: Dimension
    description: Words
    smallest: float | None = None
    largest: float | None = None
    is_refined: bool = True
    is_counted: bool = False
    usual: tuple[float, float] | None = None
    usual_on_rotary: tuple[float, float] | None = None
    question: Words | None = None
    question_below: Words | None = None
    named: tuple[NamedValue, ...] = ()
    instead_of: str | None = None


class Shape(Enum):
    """Along what an effect changes; effects of like shape are each other's likeliest mistakes."""

    POSITION = "position"
    DIRECTION = "direction"
    TIME = "time"
    RUN = "run"


@dataclass(frozen=True, slots=True)
class Confusion:
    """Another effect that looks alike in the residuals, and the measurement that would tell them apart."""

    effect: str
    told_apart_by: Words


@runtime_checkable
class Effect(Protocol):
    """A cause of deviations: x = Σ γ_k · column_k(design; θ).

    The same object serves fit, search, simulation, visibility of a plan, and documentation. Subclass it: then
    only what differs from the simplest effect need be said (no θ, no keys, no condition). One more attribute,
    ``measurands``, says on what it acts; an effect that lacks it acts on positions.

    Attributes
    ----------
    identifier
        As jobs name it: ``backlash``.
    title
        In words.
    equation
        In notation.
    linear
        The parameters γ, one for each column, in the order of the columns.
    searched
        The parameters θ on which the columns depend nonlinearly; empty for most effects.
    shape
        Along what it changes.
    physics
        What happens: how the cause becomes a deviation. None where nothing says it.
    look
        What it looks like in the residuals.
    remedy
        What the cause usually is, what a service engineer does, and what a compensation can and cannot do;
        None of a formula that says nothing of it.
    confusions
        What it is taken for, nearest first.
    ranges_from
        Where the plausible ranges of its parameters come from.
    contains
        Effects whose columns are always among its own: they cannot stand beside it in a model.
    options
        Its job keys beside the names of its parameters; plain `Options` for none. A key chooses between
        forms of the effect that differ in kind (the order of a polynomial), a parameter is a quantity.
    settings
        The values of these keys in this form of the effect.
    several
        Whether it may stand in a model more than once (`repeated`).
    common
        Whether hardly a machine is without it.
    takes, denies
        Keys of the axis (``screw_pitch``) whose stated values this form takes, and those in the place of
        which it has others: no effect that takes a key stands beside one that denies it.
    source
        How its form is known: a publication, what it is derived from, or experience. None where nothing says
        it.
    """

    identifier: str
    title: Words
    equation: str
    linear: tuple[Parameter, ...]
    searched: tuple[Parameter, ...] = ()
    shape: Shape
    physics: Words | None = None
    look: Words
    remedy: Words | None = None
    confusions: tuple[Confusion, ...] = ()
    ranges_from: Words = CHOSEN_RANGES
    contains: tuple[str, ...] = ()
    options: type[Options] = Options
    settings: Options = Options()
    several: bool = False
    common: bool = False
    takes: frozenset[str] = frozenset()
    denies: frozenset[str] = frozenset()
    source: Words | None = None

    def with_settings(self, settings: Any) -> Effect:  # noqa: ARG002 - this one has no keys
        """Return the form of the effect that its job keys ask for."""
        return self

    def forms(self) -> tuple[Effect, ...]:
        """Return the forms in which a comparison tries the effect; of most effects there is one."""
        return (self,)

    def further_forms(self) -> tuple[Effect, ...]:
        """Return forms of it that are tried where a plainer one stands in the model already."""
        return ()

    def untestable(self, design: Design) -> Words | None:  # noqa: ARG002 - this one needs nothing
        """Return why the effect cannot be tested on this design (what it needs), or None if it can."""
        return None

    def grid(self, design: Design) -> FloatArray:  # noqa: ARG002 - this one has no θ
        """Return the values of θ that the search begins with, shape (g, len(searched)); (1, 0) without θ.

        A single row means that θ is known beforehand (a pitch that the job states): it need not be searched.
        """
        return np.empty((1, 0))

    def columns(self, design: Design, theta: FloatArray) -> FloatArray:
        """Return the columns for one θ, shape (N, len(linear)), SI deviation for unit γ.

        A row depends on its own reading, on the axis and on `Design.span`, never on other readings: so the
        model answers between the targets and on another day.
        """

    def repeated(self, number: int) -> Effect:  # noqa: ARG002 - this one stands in a model once
        """Return the effect as it stands in a model for the second time, or the third: ``scale-joint-2``."""
        return self

    def forbids(self, design: Design, values: Mapping[str, float]) -> Words | None:  # noqa: ARG002 - nothing
        """Return why physics and the log of a test forbid values of parameters, SI; None if they do not."""
        return None

    def expected(self, axis: Axis) -> dict[str, float]:  # noqa: ARG002 - of this one nothing is known
        """Return values of parameters that follow from the job (a stated Abbe offset), SI; mostly empty."""
        return {}


def is_against(effect: Effect, other: Effect) -> bool:
    """Return whether one of two effects takes a value that the job states, and the other denies it."""
    return bool(effect.takes & other.denies or effect.denies & other.takes)


def needs_logged(design: Design, *columns: str) -> Words | None:
    """Demand logged conditions, by their names."""
    missing = [column for column in columns if column not in design.conditions]
    if len(missing) > 1:
        return _NO_COLUMNS.given(columns=", ".join(missing))
    return _NO_COLUMN.given(column=missing[0]) if missing else None


def needs_stated(value: object, key: str) -> Words | None:
    """Demand that the job states something, by its value and its key."""
    return _NO_KEY.given(key=key) if value is None else None


def needs_both_directions(design: Design) -> Words | None:
    """Demand targets that are approached from both directions."""
    return None if design.is_bidirectional else _ONE_DIRECTION


def needs_linear_axis(design: Design) -> Words | None:
    """Demand an axis along which positions are lengths."""
    return None if design.axis.kind is AxisKind.LINEAR else _NOT_LINEAR


def needs_rotary_axis(design: Design) -> Words | None:
    """Demand an axis along which positions are angles."""
    return None if design.axis.kind is AxisKind.ROTARY else _NOT_ROTARY


def is_of_another_axis(reason: Words) -> bool:
    """Whether a need that is not met is that for another kind of axis: no measurement would meet it."""
    return reason in (_NOT_LINEAR, _NOT_ROTARY)


def needs_targets(design: Design, least: int) -> Words | None:
    """Demand a number of target positions."""
    found = len(design.target_positions)
    return None if found >= least else _FEW_TARGETS.given(least=least, found=found)


def needs_runs(design: Design, least: int) -> Words | None:
    """Demand a number of runs."""
    found = len(np.unique(design.run))
    return None if found >= least else _FEW_RUNS.given(least=least, found=found)


def needs_passing_time(design: Design) -> Words | None:
    """Demand readings that were not all taken at once."""
    return None if design.duration > 0 else _NO_TIME


def needs_pause(design: Design) -> Words | None:
    """Demand a pause between readings that is long against the time between others."""
    return None if len(list_moments_after_pauses(design)) else _NO_PAUSE


def list_moments_after_pauses(design: Design) -> FloatArray:
    """Return the moments of the first readings after the three longest pauses, the longest first, s."""
    moments = np.unique(design.time)
    gaps = np.diff(moments)
    if not len(gaps):
        return np.empty(0)
    least = max(_PAUSE_OF_GAPS * float(np.median(gaps)), _PAUSE_OF_TEST * design.duration)
    longest = np.argsort(-gaps, kind="stable")[:_MOST_PAUSES]
    return np.asarray(moments[1:][longest[gaps[longest] > least]], dtype=np.float64)


def needs_moments(design: Design) -> Words | None:
    """Demand readings at so many different times that a moment lies between some of them."""
    few = len(np.unique(design.time)) < _LEAST_MOMENTS
    return (needs_passing_time(design) or _FEW_MOMENTS) if few else None


def needs_whole_period(design: Design, period: float | None, key: str) -> Words | None:
    """Demand a period that the job states under a key, and a travel that is not shorter."""
    if period is None:
        return needs_stated(period, key)
    return None if design.length >= period else _SHORT_TRAVEL.given(key=key)
