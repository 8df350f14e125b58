"""Whether a second test shows what the forecast of a table says, for axes that are known.

An axis is drawn and tested; a table is made of the test, written for LinuxCNC and read as the control reads
it; the same axis is tested again with that table, and its E, M, B and A are held against the forecast.
"""

from __future__ import annotations

import argparse
from collections import Counter
from dataclasses import dataclass, field, replace

import numpy as np

from zlmreport.errors import Place
from zlmreport.measurement.arrays import read_only_floats
from zlmreport.measurement.axis import Axis
from zlmreport.measurement.measurement_set import MeasurementSet
from zlmreport.model.compensation.basis import (
    FittedModel,
    apply_table,
    make_basis_of_means,
    make_basis_of_model,
)
from zlmreport.model.compensation.confirmation import ConfirmationVerdict, confirm
from zlmreport.model.compensation.curve import make_error_curve
from zlmreport.model.compensation.forecast import compute_figures
from zlmreport.model.compensation.making import Made, make
from zlmreport.model.effects.axis_model import AxisModel, Term
from zlmreport.model.fitting.fit import fit
from zlmreport.model.fitting.observations import make_observations_of
from zlmreport.model.planning.plan import AxisPlan
from zlmreport.model.simulation.description import Description, SimulatedNoise
from zlmreport.model.simulation.simulate import simulate
from zlmreport.plugin.registry import Registry, find_plugins

_PLACE = Place("loop")
_UM = 1e-6
#: What a table is made from.
SOURCES = ("means", "model")


@dataclass
class Loops:
    """What came of loops.

    Attributes
    ----------
    count
        How many there were.
    held
        By symbol, how often the second test lay within the forecast.
    confirmed
        How often it was told to hold the first.
    shares
        E after over E before.
    """

    count: int = 0
    held: Counter[str] = field(default_factory=Counter)
    confirmed: int = 0
    shares: list[float] = field(default_factory=list)


def drawn_axis(random: np.random.Generator, registry: Registry) -> Description:
    """Return an axis: its screw, its play, what no smooth effect describes, and how it scatters."""
    length = float(random.uniform(0.3, 2.0))
    targets = np.linspace(0.0, length, int(random.integers(9, 22)))
    targets[1:-1] += random.uniform(-0.3, 0.3, len(targets) - 2) * length / len(targets)
    values = {
        "offset": {"offset": random.normal(0, 5) * _UM},
        "scale-error": {"slope": random.normal(0, 20) * _UM},
        "backlash": {"lost_motion": random.normal(0, 6) * _UM},
    }
    terms = []
    for name, given in values.items():
        effect = registry.effect(name)
        terms.append(Term(effect, {effect.linear[0].name: next(iter(given.values()))}))
    if random.random() < 0.5:
        bow = registry.effect("polynomial")
        names = [each.name for each in bow.linear]
        terms.append(Term(bow, {name: random.normal(0, 6) * _UM for name in names[1:]} | {names[0]: 0.0}))
        terms = [each for each in terms if each.effect.identifier not in bow.contains]
    noise = SimulatedNoise(
        reading=float(np.exp(random.uniform(np.log(0.05), np.log(2.0)))) * _UM,
        position=float(random.choice([0.0, 0.5, 2.0])) * _UM,
        run=float(random.choice([0.0, 0.5])) * _UM,
    )
    plan = AxisPlan(read_only_floats(targets), runs=int(random.choice([3, 5, 5, 8])))
    return Description(Axis("X"), plan, int(random.integers(1 << 30)), tuple(terms), noise=noise)


def table_from(source: str, before: MeasurementSet, terms: tuple[Term, ...], registry: Registry) -> Made:
    """Return the table of a test, by its means or by its model."""
    control = registry.controller("linuxcnc")
    curve = make_error_curve(before, _PLACE)
    if source == "means":
        basis = make_basis_of_means(curve, before)
    else:
        observed = make_observations_of(before)
        model = AxisModel(tuple(Term(each.effect) for each in terms))
        fitted = fit(model, observed.design, observed.deviation)
        basis = make_basis_of_model(curve, FittedModel(before, observed, fitted))
    return make(basis, before.axis, "LOOP", _PLACE, control, control.options())


def loops(source: str, count: int, seed: int = 1) -> Loops:
    """Close a loop on each of so many axes."""
    random, registry, found = np.random.default_rng(seed), find_plugins(), Loops()
    for _ in range(count):
        axis = drawn_axis(random, registry)
        made = table_from(source, simulate(axis).measurements, axis.effects, registry)
        second = again(axis, int(random.integers(1 << 30)))
        second = apply_table(second, made.decoded.at(second.target_positions))
        curve = make_error_curve(second, _PLACE)
        shown = compute_figures(np.stack([curve.forward, curve.reverse]), curve).in_unit(1.0)
        found.count += 1
        for symbol, value in shown.items():
            expected = made.forecast.second_test[symbol]
            found.held[symbol] += expected.low <= value <= expected.high
        verdict = confirm(made.basis, curve, second.axis, made.decoded, _PLACE).verdict
        found.confirmed += verdict is ConfirmationVerdict.HELD
        found.shares.append(shown["E"] / made.forecast.before.systematic)
    return found


def again(axis: Description, seed: int) -> MeasurementSet:
    """Return another test of the same axis: what is fixed in position stays, what scatters is drawn anew."""
    fixed = simulate(replace(axis, noise=SimulatedNoise(position=axis.noise.position))).measurements
    bare = simulate(replace(axis, noise=SimulatedNoise())).measurements
    other = simulate(replace(axis, seed=seed, noise=replace(axis.noise, position=0.0))).measurements
    return replace(other, deviation=read_only_floats(other.deviation + fixed.deviation - bare.deviation))


def main(arguments: list[str] | None = None) -> None:
    """Print a row for each source of tables."""
    parser = argparse.ArgumentParser(prog="./run benchmark closed-loops", description=__doc__)
    parser.add_argument("--loops", type=int, default=500, help="axes (%(default)s)")
    count = parser.parse_args(arguments).loops
    print("| table from | E within | M within | B within | A within | confirmed | E after, median |")
    print("|---|--:|--:|--:|--:|--:|--:|")
    for source in SOURCES:
        found = loops(source, count)
        within = " | ".join(f"{100 * found.held[symbol] / found.count:.1f} %" for symbol in "EMBA")
        confirmed = f"{100 * found.confirmed / found.count:.1f} %"
        print(f"| {source} | {within} | {confirmed} | {100 * np.median(found.shares):.1f} % |", flush=True)
