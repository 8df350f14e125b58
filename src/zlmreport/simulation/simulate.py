"""From a description to a test: the measurement set, and what it hides."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np

from zlmreport.language import Words
from zlmreport.measurement.measurement_set import CONDITIONS, MeasurementSet
from zlmreport.measurement.provenance import Provenance
from zlmreport.model.design import Design
from zlmreport.model.effect import Effect
from zlmreport.planning.methods import path, planned_design, visits
from zlmreport.quantities.arrays import FloatArray, read_only_floats, read_only_integers
from zlmreport.simulation.description import (
    Description,
    is_missing,
    logged_course,
    noise_of,
    rounded,
    true_course,
)

_REMARK = Words(
    en="Simulated readings, not measurements (seed {seed}).",
    de="Simulierte Messwerte, keine Messung (Startwert {seed}).",
)


@dataclass(frozen=True, slots=True)
class Simulation:
    """A simulated test.

    Attributes
    ----------
    measurements
        The readings as an instrument would have given them.
    design
        The test with its true conditions; it has every reading, the missing ones too.
    systematic : (N,) array
        The deviation that the effects make, without noise, m or rad.
    """

    measurements: MeasurementSet
    design: Design
    systematic: FloatArray


def simulate(description: Description) -> Simulation:
    """Return a test of the axis that is described.

    Raises
    ------
    ValueError
        If a searched parameter of an effect has no value.
    """
    design = design_of(description)
    systematic = deviation_by_all(description, design)
    return Simulation(observed(description, design, systematic), design, read_only_floats(systematic))


def design_of(description: Description) -> Design:
    """Return the test that is described with its true conditions; whatever its effects."""
    plan = description.plan
    listed = visits(path(plan.method, plan.targets.tolist(), plan.runs, plan.overrun))
    design = planned_design(description.axis, plan.targets, listed, plan.feed, plan.dwell)
    conditions = {
        name: read_only_floats(true_course(course, design.time))
        for name, course in description.conditions.items()
    }
    return replace(design, conditions=conditions)


def deviation_by_all(description: Description, design: Design) -> FloatArray:
    """Return the deviation that all effects of a description make, shape (N,), m or rad.

    Raises
    ------
    ValueError
        If a searched parameter of an effect has no value.
    """
    systematic = np.zeros(len(design.position))
    for each in description.effects:
        systematic += deviation_by(each.effect, design, each.fixed)
    return systematic


def deviation_by(effect: Effect, design: Design, values: Mapping[str, float]) -> FloatArray:
    """Return the deviation that an effect makes, shape (N,), m or rad.

    Parameters
    ----------
    effect
        The effect.
    design
        The test.
    values
        Its parameters by name, SI. Linear ones that are left out are 0; searched ones may be left out where
        the axis tells them (a stated pitch).

    Raises
    ------
    ValueError
        If a searched parameter has no value.
    """
    known = {**effect.expected(design.axis), **values}
    missing = [parameter.name for parameter in effect.searched if parameter.name not in known]
    if missing:
        raise ValueError(f"{effect.identifier} needs a value of {missing[0]}")
    theta = np.array([known[parameter.name] for parameter in effect.searched])
    gamma = np.array([values.get(parameter.name, 0.0) for parameter in effect.linear])
    return np.asarray(effect.columns(design, theta) @ gamma)


def observed(description: Description, design: Design, systematic: FloatArray) -> MeasurementSet:
    """Return what an instrument gives of deviations, with all noise of the description.

    Parameters
    ----------
    description
        With its noise, its logs and its seed.
    design
        Of `design_of`.
    systematic : (N,) array
        The deviation without noise, m or rad.
    """
    noise, seed = description.noise, description.seed
    shown = rounded(systematic + noise_of(noise, design, seed), noise.resolution)
    shown = np.where(is_missing(noise, len(shown), seed), np.nan, shown)
    return MeasurementSet(
        axis=description.axis,
        target_positions=read_only_floats(description.plan.targets),
        target=design.target,
        approach=read_only_integers(design.direction),
        run=design.run,
        deviation=read_only_floats(shown),
        time=design.time if description.time_is_logged else None,
        conditions=_logs(description, design),
        provenance=Provenance("simulation", remarks=(_REMARK.given(seed=seed),)),
    )


def _logs(description: Description, design: Design) -> dict[str, FloatArray]:
    return {
        name: read_only_floats(
            logged_course(course, design.conditions[name], description.seed, _number_of(name))
        )
        for name, course in description.conditions.items()
        if course.is_logged
    }


def _number_of(condition: str) -> int:
    """Return a number that belongs to a condition whatever others are there."""
    known = list(CONDITIONS)
    return known.index(condition) if condition in known else int.from_bytes(condition.encode(), "big")
