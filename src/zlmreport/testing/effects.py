"""What every effect must be, so that it can be fitted, searched, simulated and explained."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace
from typing import Any

import numpy as np

from zlmreport.errors import did_you_mean
from zlmreport.job.formula import FormulaError
from zlmreport.job.formula_parts import Formula
from zlmreport.job.types import list_keys_in
from zlmreport.language.formatting import write_plain
from zlmreport.measurement.arrays import FloatArray, read_only_floats
from zlmreport.measurement.axis import AxisKind
from zlmreport.model.effects.design import Design
from zlmreport.model.effects.effect import Confusion, Dimension, Effect, Parameter, Shape
from zlmreport.model.fitting.observations import select_readings
from zlmreport.plugin.kinds import EFFECT
from zlmreport.plugin.registry import find_plugins
from zlmreport.testing.expectations import (
    check,
    expect,
    expect_identifier,
    expect_named,
    expect_options,
    expect_words,
    guard_subject,
    is_same_value,
    list_checks_of,
    run_all,
)
from zlmreport.testing.measurements import full_designs, poor_designs

Designs = Mapping[str, Design]

#: m or rad: what no effect of a plausible size does to an axis; micrometres given as metres do.
_NO_DEVIATION = 0.01
#: Of what would be nothing without rounding, relative; and how many rows of a grid are tried together.
_ROUNDING, _ROWS_TRIED = 1e-9, 24
#: What columns of each shape must change with; a log goes with time, or tells faces apart.
_FOLLOWED = {
    Shape.POSITION: {"position"},
    Shape.DIRECTION: {"direction", "a log"},
    Shape.TIME: {"time", "a log"},
    Shape.RUN: {"run"},
}


@check
def is_described(effect: Effect, *_more: Any) -> None:
    """Check that it has a name that can be typed, and says in every language what it is and looks like."""
    expect_named(effect, EFFECT)
    expect(write_plain(effect.equation).strip(), f"{effect.identifier}: equation must be what is printed")
    expect(isinstance(effect.shape, Shape), f"{effect.identifier}: shape must be a Shape")
    expect_words(effect.look, f"{effect.identifier}: look")
    if effect.physics is not None:
        expect_words(effect.physics, f"{effect.identifier}: physics")


@check
def says_what_to_do(effect: Effect, *_more: Any) -> None:
    """Check that it says in every language what to do about it, and what a compensation can do."""
    expect_words(effect.remedy, f"{effect.identifier}: remedy")


@check
def names_what_it_is_taken_for(effect: Effect, _designs: Designs, beside: Iterable[str] = ()) -> None:
    """Check that each confusion names another effect, once, and the measurement that tells them apart."""
    known = {effect.identifier, *beside, *find_plugins().list_identifiers(EFFECT)}
    for confusion in effect.confusions:
        where = f"{effect.identifier}: confusions"
        expect(isinstance(confusion, Confusion), f"{where} must hold Confusion(effect, told_apart_by)")
        expect_identifier(confusion.effect, where)
        expect(confusion.effect != effect.identifier, f"{where}: an effect is not taken for itself")
        expect(
            confusion.effect in known,
            f"{where}: no effect is called {confusion.effect!r}; "
            f"{did_you_mean(confusion.effect, sorted(known))} "
            "(effects of the same plugin that are not installed: check_effect(…, beside=[…]))",
        )
        expect_words(confusion.told_apart_by, f"{where}: {confusion.effect}")
    named = Counter(confusion.effect for confusion in effect.confusions)
    twice = [name for name, times in named.items() if times > 1]
    expect(not twice, f"{effect.identifier}: confusions name {', '.join(twice)} twice")


@check
def parameters_are_described(effect: Effect, *_more: Any) -> None:
    """Check that parameters have unique ASCII names, units and descriptions, and ranges that are some."""
    for form in effect.forms():
        parameters = (*form.linear, *form.searched)
        expect(form.linear, f"{effect.identifier}: linear is empty; an effect has a size at least")
        names = Counter(parameter.name for parameter in parameters)
        expect(max(names.values()) == 1, f"{effect.identifier}: names of parameters must be unique: {names}")
        for parameter in parameters:
            _expect_parameter(parameter, f"{effect.identifier}: parameter {parameter.name!r}")


@check
def keys_are_described(effect: Effect, *_more: Any) -> None:
    """Check that its own job keys are described, and none is called like a parameter."""
    expect_options(effect, EFFECT)
    expect(
        isinstance(effect.settings, effect.options),
        f"{effect.identifier}: settings must be the options of this form, {effect.options.__name__}(…)",
    )
    names = {parameter.name for parameter in (*effect.linear, *effect.searched)}
    clashes = sorted(names & list_keys_in(effect.options).keys())
    expect(not clashes, f"{effect.identifier}: {', '.join(clashes)} is a key and a parameter")


@check
def settings_make_the_form(effect: Effect, *_more: Any) -> None:
    """Check that each form can be asked for by its settings, and that all forms have one name."""
    for form in (effect, *effect.forms()):
        where = f"{effect.identifier}: form {form.settings!r}"
        made = effect.with_settings(form.settings)
        expect(form.identifier == effect.identifier, f"{where} is called {form.identifier!r}")
        expect(made.settings == form.settings, f"{where}: with_settings makes {made.settings!r}")
        expect(
            [each.name for each in made.linear] == [each.name for each in form.linear],
            f"{where}: with_settings makes other parameters",
        )


@check
def says_what_it_lacks(effect: Effect, designs: Designs, *_more: Any) -> None:
    """Check that `untestable` answers on any test, and that there is a test on which nothing is lacking."""
    testable = False
    for kind, design in {**designs, **poor_designs()}.items():
        where = f"{effect.identifier}: untestable on {kind}"
        try:
            reason = effect.untestable(design)
        except Exception as error:
            message = f"{where} raised {error!r}; return Words that say what is lacking"
            raise AssertionError(message) from error
        if reason is not None:
            expect_words(reason, where)
        testable = testable or reason is None
    expect(testable, f"{effect.identifier} can be tested on none of: {', '.join(designs)} (give one)")


@check
def cannot_be_tested_where_it_is_not_seen(effect: Effect, *_more: Any) -> None:
    """Check that `untestable` answers on a test on which no readings could tell its parameters apart.

    Beside a constant, which every model has: a lost motion that is met from one direction is an offset, and
    a length of segments is not known from two targets. On a single target it need not be told from that.
    """
    for form in effect.forms():
        complete = [each for each in full_designs().values() if form.untestable(each) is None]
        has_constant = any(
            _count_independent(form, each, beside_constant=True) <= len(form.linear) for each in complete
        )
        for kind, design in poor_designs().items():
            if form.untestable(design) is not None:
                continue
            beside = not has_constant and len(design.target_positions) > 1
            found = _count_independent(form, design, beside_constant=beside)
            wanted = len(form.linear) + beside + (len(form.grid(design)) > 1)
            expect(
                found >= wanted,
                f"{effect.identifier}: on {kind} no readings could tell its parameters apart"
                f"{' from a constant' if beside else ''}, and untestable does not say so; return Words that "
                "say what is lacking (needs_both_directions, needs_targets … of zlmreport.plugin.effect)",
            )


def _count_independent(form: Effect, design: Design, *, beside_constant: bool) -> int:
    """Return how many courses of deviations its columns make over a test, for all that is searched."""
    columns = [form.columns(design, theta) for theta in _spread(form.grid(design))]
    if beside_constant:
        columns.append(np.ones((len(design.position), 1)))
    matrix = np.hstack(columns)
    if not np.isfinite(matrix).all():
        return int(matrix.shape[1])  # another check says so
    lengths = np.linalg.norm(matrix, axis=0)
    matrix = matrix[:, lengths > 0] / lengths[lengths > 0]
    return int(np.linalg.matrix_rank(matrix, tol=_ROUNDING * max(matrix.shape))) if matrix.size else 0


def _spread(grid: FloatArray) -> FloatArray:
    """Return some rows of a grid, evenly from the first on."""
    return grid[:: max(1, len(grid) // _ROWS_TRIED)]


@check
def shape_is_what_it_follows(effect: Effect, designs: Designs, *_more: Any) -> None:
    """Check that the columns change along what the shape says: position, direction, time (a log), run."""
    for form in effect.forms():
        followed = _find_followed(form, designs)
        shape, wanted = form.shape, _FOLLOWED[form.shape]
        found = ", ".join(sorted(followed)) or "nothing"
        expect(
            followed & wanted or (shape is Shape.POSITION and not followed),
            f"{effect.identifier}: shape is {shape.name}, and its columns follow {found}",
        )
        expect(
            shape is not Shape.POSITION or not followed & {"time", "a log", "run"},
            f"{effect.identifier}: shape is {shape.name}, and its columns follow {found}, too; an effect "
            "that comes with time is Shape.TIME, one that differs by runs Shape.RUN",
        )


def _find_followed(form: Effect, designs: Designs) -> set[str]:
    """Return along what columns change: what must be altered of a test to alter them."""
    found: set[str] = set()
    for design in designs.values():
        if form.untestable(design) is None:
            for theta in _select_some(form.grid(design)):
                columns = form.columns(design, theta)
                for name, altered in _alter_test(design).items():
                    other = form.columns(altered, theta)
                    if not np.allclose(other, columns, rtol=1e-9, atol=1e-12):
                        found.add(name)
    return found


def _alter_test(design: Design) -> Mapping[str, Design]:
    """Return the same test but for one thing each."""
    shift = 0.05 * design.length * (1 + design.target % 3)
    logs = {name: read_only_floats(1.0 - log) for name, log in design.conditions.items()}
    return {
        "position": replace(design, position=read_only_floats(design.position + shift)),
        "direction": replace(
            design,
            direction=read_only_floats(-design.direction),
            since_reversal=read_only_floats(1.7 * design.since_reversal + 0.01),
        ),
        "run": replace(design, run=design.run.max() + 1 - design.run),
        "time": replace(design, time=read_only_floats(1.3 * design.time + 7.0)),
        "a log": replace(design, conditions=logs, rates={}),
    }


@check
def grid_stays_in_range(effect: Effect, designs: Designs, *_more: Any) -> None:
    """Check that the search begins within the range of each parameter, on one test of those at least.

    On others it may begin outside: a test of a minute knows nothing of time constants of hours.
    """
    for form in effect.forms():
        for number, parameter in enumerate(form.searched):
            columns = [
                form.grid(design)[:, number] for design in designs.values() if form.untestable(design) is None
            ]
            low = -np.inf if parameter.smallest is None else parameter.smallest
            high = np.inf if parameter.largest is None else parameter.largest
            slack = _ROUNDING * max(abs(each) for each in (low, high, 1.0) if np.isfinite(each))
            expect(
                any(np.all((each >= low - slack) & (each <= high + slack)) for each in columns)
                or not columns,
                f"{effect.identifier}: the grid of {parameter.name!r} leaves its range of {low:.6g} to "
                f"{high:.6g} (SI) on every test: it begins at {[float(each.min()) for each in columns][:1]} "
                f"and ends at {[float(each.max()) for each in columns][:1]}",
            )


@check
def grid_is_one(effect: Effect, designs: Designs, *_more: Any) -> None:
    """Check that the grid has a finite row for each start, and a column for each searched parameter."""
    for form, _, design in _list_tested(effect, designs):
        guard_subject(form, EFFECT).grid(design)


@check
def columns_are_readings_by_parameters(effect: Effect, designs: Designs, *_more: Any) -> None:
    """Check the columns' shape, that they are finite, and that the same question has the same answer."""
    for form, kind, design in _list_tested(effect, designs):
        guarded = guard_subject(form, EFFECT)
        for theta in _select_some(form.grid(design)):
            expect(
                is_same_value(guarded.columns(design, theta), guarded.columns(design, theta)),
                f"{effect.identifier}: columns on {kind} for θ = {theta}: the second answer differs from the "
                "first",
            )


@check
def rows_stand_alone(effect: Effect, designs: Designs, *_more: Any) -> None:
    """Check that a row depends on its own reading, the axis and the span, and on no other reading."""
    for form, kind, design in _list_tested(effect, designs):
        for theta in _select_some(form.grid(design)):
            columns = form.columns(design, theta)
            for which, kept in _cut_parts(design).items():
                alone = form.columns(select_readings(design, kept), theta)
                expect(
                    np.allclose(alone, columns[kept], rtol=1e-12, atol=0.0),
                    f"{effect.identifier}: columns on {kind} change when other readings are left out "
                    f"({which} stay); normalise by Design.span, not by the readings",
                )


def _cut_parts(design: Design) -> Mapping[str, Any]:
    """Return the numbers of some of a test's readings, of which the lowest, the first, the last are not."""
    every = np.arange(len(design.position))
    parts = {
        "every second": every[::2],
        "the others of them": every[1::2],
        "those above the lowest target": every[design.position > design.position.min()],
        "those below the highest target": every[design.position < design.position.max()],
        "the later half": every[len(every) // 2 :],
        "the earlier half": every[: len(every) // 2],
        "those moving upwards": every[design.direction > 0],
    }
    return {which: kept for which, kept in parts.items() if len(kept)}


@check
def plausible_sizes_are_metres(effect: Effect, designs: Designs, *_more: Any) -> None:
    """Check that the largest plausible parameters make deviations in metres (radians), not micrometres."""
    for form, kind, design in _list_tested(effect, designs):
        bounds = [_find_largest(parameter) for parameter in form.linear]
        for theta in _select_some(form.grid(design)):
            reach = np.abs(form.columns(design, theta)) * np.array(bounds)
            expect(
                np.all(reach < _NO_DEVIATION),
                f"{effect.identifier}: on {kind} a plausible size makes a deviation of {reach.max():.3g} "
                f"{'m' if design.axis.kind is AxisKind.LINEAR else 'rad'}; columns and ranges are SI",
            )


@check
def is_seen_somewhere(effect: Effect, designs: Designs, *_more: Any) -> None:
    """Check that on some test the columns are neither zero nor alike."""
    for form, _, design in _list_tested(effect, designs):
        for theta in _select_some(form.grid(design)):
            columns = form.columns(design, theta)
            if not np.isfinite(columns).all():
                return  # another check says so
            lengths = np.linalg.norm(columns, axis=0)
            if np.all(lengths > 0) and np.linalg.matrix_rank(columns / lengths) == len(form.linear):
                return
    expect(condition=False, sentence=f"{effect.identifier}: its columns are zero, or alike, on every test")


@check
def every_parameter_matters(effect: Effect, designs: Designs, *_more: Any) -> None:
    """Check that another value of each searched parameter makes other columns on some test."""
    for form in effect.forms():
        for number, parameter in enumerate(form.searched):
            expect(
                any(
                    _is_changing_with(tested, design, number)
                    for tested, _, design in _list_tested(effect, designs)
                    if tested is form or tested.settings == form.settings
                ),
                f"{effect.identifier}: parameter {parameter.name!r} changes no column on any test",
            )


def _is_changing_with(form: Effect, design: Design, number: int) -> bool:
    for theta in _select_some(form.grid(design)):
        other = np.array(theta)
        other[number] = 1.25 * theta[number] if theta[number] else 1.0
        if not np.array_equal(form.columns(design, read_only_floats(other)), form.columns(design, theta)):
            return True
    return False


@check
def formula_determines_its_parameters(effect: Effect, *_more: Any) -> None:
    """Check, where it is written as a formula, that readings can tell all its parameters apart."""
    for form in effect.forms():
        formula = getattr(form, "formula", None)
        if isinstance(formula, Formula):
            try:
                formula.refuse_undetermined()
            except FormulaError as error:
                expect(condition=False, sentence=f"{effect.identifier}: {error}")


@check
def expected_values_are_of_parameters(effect: Effect, designs: Designs, *_more: Any) -> None:
    """Check that values which follow from the axis are finite, and those of its parameters."""
    for design in designs.values():
        guard_subject(effect, EFFECT).expected(design.axis)


def _expect_parameter(parameter: Parameter, where: str) -> None:
    expect(isinstance(parameter, Parameter), f"{where} must be a Parameter")
    expect(parameter.name.isascii() and parameter.name.isidentifier(), f"{where} must be an ASCII name")
    expect(write_plain(parameter.notation).strip(), f"{where}: notation must be what is printed")
    expect(isinstance(parameter.dimension, Dimension), f"{where}: dimension must be a Dimension")
    expect_words(parameter.description, f"{where}: description")
    if parameter.smallest is not None and parameter.largest is not None:
        expect(parameter.smallest < parameter.largest, f"{where}: smallest must be less than largest")


def _find_largest(parameter: Parameter) -> float:
    bounds = [abs(bound) for bound in (parameter.smallest, parameter.largest) if bound is not None]
    return max(bounds, default=0.0)


def _list_tested(effect: Effect, designs: Designs) -> Iterator[tuple[Effect, str, Design]]:
    """Yield each form of the effect with every test on which it can be tested."""
    for form in effect.forms():
        for kind, design in {**designs, **poor_designs()}.items():
            if form.untestable(design) is None:
                yield form, kind, design


def _select_some(grid: FloatArray) -> FloatArray:
    """Return the first, the middle and the last row, which no effect may alter."""
    return read_only_floats(grid[np.unique([0, len(grid) // 2, len(grid) - 1])])


#: Every check of an effect, each called with it, designs on which it may be tested, and effects beside it.
EFFECT_CHECKS = list_checks_of(__name__)


def check_effect(effect: Effect, designs: Designs | None = None, *, beside: Iterable[str] = ()) -> None:
    """Run every check on an effect.

    Parameters
    ----------
    effect
        The object that the plugin's hook returns.
    designs
        Tests on which it can be tested, by what they are: for an effect that needs a log of its own. The
        kit's complete tests have all logs and keys that are known by name.
    beside
        Identifiers of further effects of the plugin, which its confusions may name before it is installed.

    Raises
    ------
    AssertionError
        With a line for every check that fails.
    """
    tried = {**full_designs(), **(designs or {})}
    run_all(EFFECT, EFFECT_CHECKS, effect, tried, tuple(beside))
