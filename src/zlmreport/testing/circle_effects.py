"""What every effect of circles must be, so that it can be fitted, searched, told apart and explained."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping
from dataclasses import replace
from typing import Any

import numpy as np

from zlmreport.measurement.arrays import BoolArray, FloatArray
from zlmreport.measurement.circle import PLANES, NominalCircle
from zlmreport.model.effects.circle_design import CircleDesign, CircleTest, find_axes_of
from zlmreport.model.effects.circle_effect import (
    CircleEffect,
    CircleTerm,
    Estimate,
    Law,
    Parity,
    Searched,
    SearchedParameter,
)
from zlmreport.plugin.kinds import CIRCLE_EFFECT
from zlmreport.testing.expectations import (
    check,
    expect,
    expect_named,
    expect_words,
    guard_subject,
    list_checks_of,
    run_all,
)

#: m: what no effect of a usual size makes of a radius; micrometres given as metres do.
_NO_DEVIATION = 0.01
_FEED, _RADIUS, _OF_A_TURN = 1.0 / 60.0, 0.15, 72

Designs = Mapping[str, CircleDesign]


def make_circle_designs() -> Designs:
    """Return circles on which an effect may be tried: one plane, two feeds and radii, three planes."""
    return {
        "one plane": make_circle_design(),
        "two feeds and radii": make_circle_design(runs=((1.0, 1.0), (4.0, 1.0), (1.0, 2.0))),
        "three planes": make_circle_design(planes=tuple(PLANES)),
    }


def make_circle_design(
    planes: tuple[str, ...] = ("XY",), runs: tuple[tuple[float, float], ...] = ((1.0, 1.0),)
) -> CircleDesign:
    """Return a turn in each sense for each plane and run.

    `runs`: By how much feed and radius are larger than 1 m/min and 150 mm.
    """
    tests = [(plane, *run) for plane in planes for run in runs]
    # Not on the reversals themselves, where nobody knows which way an axis moves.
    way = (np.arange(_OF_A_TURN) + 0.37) * 2.0 * np.pi / _OF_A_TURN
    parts: dict[str, list[FloatArray]] = {}
    for index, (plane, faster, larger) in enumerate(tests):
        for sense in (1.0, -1.0):
            speed = faster * _FEED / (larger * _RADIUS)
            one = np.ones(_OF_A_TURN)
            turn = 2 * index + (sense < 0)
            columns = {
                "test": index * one,
                "turn": turn * one,
                "angle": way if sense > 0 else way[::-1],
                "sense": sense * one,
                "travelled": way - way[0],
                "time": turn * 100.0 + (way - way[0]) / speed,
                "radius": larger * _RADIUS * one,
                "feed": faster * _FEED * one,
                "first": find_axes_of(plane)[0] * one,
                "second": find_axes_of(plane)[1] * one,
            }
            for name, values in columns.items():
                parts.setdefault(name, []).append(values)
    joined = {name: np.concatenate(each) for name, each in parts.items()}
    whole = {name: joined.pop(name).astype(np.int64) for name in ("test", "turn", "first", "second")}
    named = tuple(
        CircleTest(
            f"circle-{index}", NominalCircle(plane, larger * _RADIUS, faster * _FEED, (0.25, 0.2, 0.1))
        )
        for index, (plane, faster, larger) in enumerate(tests)
    )
    columns_of: dict[str, Any] = {**joined, **whole}
    return CircleDesign(named, **columns_of)


@check
def is_described(effect: CircleEffect, _: Designs) -> None:
    """Check that it has a name that can be typed, and says in every language what it is and why it is."""
    expect_named(effect, CIRCLE_EFFECT)
    expect_words(effect.explains, f"{effect.identifier}: explains")
    expect(effect.equation.strip(), f"{effect.identifier}: equation must be what is printed")
    is_law = isinstance(effect.law, Law) and isinstance(effect.law.parity, Parity)
    expect(is_law, f"{effect.identifier}: law must be Law(Parity.…, feed=…, radius=…)")
    for each in effect.searched:
        expect(
            isinstance(each, SearchedParameter),
            f"{effect.identifier}: searched must hold SearchedParameter(name, unit), not {each!r}",
        )
        if each.title is not None:
            expect_words(each.title, f"{effect.identifier}: title of {each.name}")


@check
def has_columns(effect: CircleEffect, designs: Designs) -> None:
    """Check that its terms are columns of numbers, with names, units and ranges that are some."""
    for name, design in designs.items():
        for searched in _make_grid(effect, design):
            where = f"{effect.identifier} on {name}, searched {searched}"
            terms = guard_subject(effect, CIRCLE_EFFECT).terms(design, searched)
            expect(terms, f"{where}: has no terms; an effect has a size at least")
            twice = [each for each, times in Counter(term.name for term in terms).items() if times > 1]
            expect(not twice, f"{where}: two terms are called {twice[:1]}")
            for term in terms:
                _expect_term(term, f"{where}: {term.name}")


def _expect_term(term: CircleTerm, where: str) -> None:
    if term.title is not None:
        expect_words(term.title, f"{where}: title")
    expect(term.low < term.high, f"{where}: low must be below high")
    if term.usual:
        largest = abs(term.usual) * float(np.abs(term.column).max())
        expect(largest < _NO_DEVIATION, f"{where}: a usual size moves {largest:g} m; SI units are expected")
        within = term.low <= term.usual <= term.high or term.low <= -term.usual <= term.high
        expect(within, f"{where}: a usual size lies outside low and high")


@check
def keeps_its_parity(effect: CircleEffect, _: Designs) -> None:
    """Check that it is alike, or opposite, in the two senses, if it says so."""
    wanted = {Parity.EVEN: 1.0, Parity.ODD: -1.0}.get(effect.law.parity)
    if wanted is None:
        return
    design = make_circle_design()
    forward, back = design.sense > 0, design.sense < 0
    for searched in _make_grid(effect, design):
        for group, column in _group_columns(effect, design, searched).items():
            there, here = _put_in_order(design, column, forward), _put_in_order(design, column, back)
            expect(
                np.allclose(here, wanted * there, atol=1e-9 * np.abs(column).max()),
                f"{effect.identifier}: {group} is not {effect.law.parity.value} in the two senses",
            )


def _put_in_order(design: CircleDesign, column: FloatArray, own: BoolArray) -> FloatArray:
    chosen = np.flatnonzero(own)
    return np.asarray(column[chosen][np.argsort(design.angle[chosen])])


@check
def keeps_its_law(effect: CircleEffect, _: Designs) -> None:
    """Check that it grows with feed and radius as it says."""
    plain = make_circle_design()
    for what, power, run in (
        ("feed", effect.law.feed, (2.0, 1.0)), ("radius", effect.law.radius, (1.0, 2.0)),
    ):  # fmt: skip
        if power is None or effect.law.parity is Parity.IN_TIME:
            continue
        other = make_circle_design(runs=(run,))
        for searched in _make_grid(effect, plain):
            before, after = (list(_group_columns(effect, each, searched).values()) for each in (plain, other))
            expect(
                all(np.allclose(b, 2.0**power * a) for a, b in zip(before, after, strict=True)),
                f"{effect.identifier}: does not grow with the {what} to the power {power:g}",
            )


def _group_columns(effect: CircleEffect, design: CircleDesign, searched: Searched) -> dict[str, FloatArray]:
    found: dict[str, FloatArray] = {}
    for term in effect.terms(design, searched):
        group = term.group or term.name
        found[group] = found.get(group, np.zeros(design.count)) + term.column
    return found


@check
def knows_each_reading_by_itself(effect: CircleEffect, designs: Designs) -> None:
    """Check that a row of its columns does not change with the other readings of its turn."""
    for name, design in designs.items():
        kept = np.arange(design.count) % 2 == 0
        fewer = replace(
            design,
            **{each: getattr(design, each)[kept] for each in design.__dataclass_fields__ if each != "tests"},
        )
        for searched in _make_grid(effect, design)[:3]:
            whole = {term.name: term.column[kept] for term in effect.terms(design, searched)}
            for term in effect.terms(fewer, searched):
                shift = term.column - whole.get(term.name, term.column)
                # What drifts is reckoned from the mean of its readings: the mean is the base's.
                is_alike = np.allclose(shift, shift.mean(), atol=0.02 * float(np.ptp(term.column) or 1.0))
                expect(
                    is_alike or effect.law.parity is Parity.IN_TIME,
                    f"{effect.identifier} on {name}: {term.name} changes when other readings are left out",
                )


@check
def says_what_it_found(effect: CircleEffect, designs: Designs) -> None:
    """Check that what it says of estimates can be read in every language."""
    for design in designs.values():
        for searched in _make_grid(effect, design)[:1]:
            for way in (-1.0, 1.0):
                estimates = [
                    Estimate(term.name, term.unit, way * (term.usual or 1e-6), 0.3 * (term.usual or 1e-6))
                    for term in effect.terms(design, searched)
                ]
                for sentence in (*effect.findings(estimates), *effect.absence(estimates)):
                    expect_words(sentence, f"{effect.identifier}: what it says")


def _make_grid(effect: CircleEffect, design: CircleDesign) -> tuple[Searched, ...]:
    grid: tuple[Searched, ...] = guard_subject(effect, CIRCLE_EFFECT).grid(design)
    return grid


CIRCLE_EFFECT_CHECKS = list_checks_of(__name__)


def check_circle_effect(effect: CircleEffect) -> None:
    """Run every check on an effect of circles; raise one `AssertionError` with all that fails."""
    run_all(CIRCLE_EFFECT, CIRCLE_EFFECT_CHECKS, effect, make_circle_designs())
