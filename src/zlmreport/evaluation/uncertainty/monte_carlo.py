"""U of every parameter by Monte Carlo (JCGM 101:2008): how many trials, and the least U that is stated.

Each trial adds errors, drawn from the budget, to the readings, and evaluates the test again by the
standard's own arithmetic. So a standard needs no formula of its own for its uncertainties, whoever wrote it.
"""

from __future__ import annotations

import hashlib
import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from types import MappingProxyType

import numpy as np

from zlmreport.evaluation.evaluation import Arithmetic, Evaluation, Least
from zlmreport.evaluation.statistics import (
    PositionStatistics,
    compute_statistics_of,
    join_statistics,
    position_statistics,
)
from zlmreport.evaluation.uncertainty.budget import (
    COVERAGE_FACTOR,
    COVERAGE_PROBABILITY,
    Acts,
    Budget,
    compute_effect_along,
    find_full_range,
)
from zlmreport.evaluation.uncertainty.drift import (
    Drift,
    choose_drift_kinds,
    compute_reading_times,
    sample_drifts,
)
from zlmreport.evaluation.uncertainty.flatter_axes import make_flatter_axes
from zlmreport.evaluation.uncertainty.instrument_curves import (
    CurveForm,
    is_of_the_instrument,
    list_forms,
    sample_waves,
)
from zlmreport.evaluation.uncertainty.round_the_circle import smooth_curves
from zlmreport.evaluation.uncertainty.rounding import find_hiding_resolution, sample_rounding
from zlmreport.evaluation.uncertainty.sampling import draw_singly, sample_singly, sample_stratified
from zlmreport.measurement.approach import Approach
from zlmreport.measurement.arrays import FloatArray, read_only_floats
from zlmreport.measurement.measurement_set import MeasurementSet

#: U then scatters by 1 % at most from one sequence of random numbers to another, which the second digit
#: hardly shows.
TRIALS = 20_000

#: Readings that are simulated at once: few enough for a processor's cache.
_AT_ONCE = 262_144
#: A standard uncertainty below this part of the budget's is the rounding of doubles: it is none.
_NOTHING = 1e-9
#: Digits of U and k that are kept: far more than are known, and so few that no rounding of another
#: processor shows.
_DIGITS = 6
#: Of the errors by which a parameter is asked whether it compares positions, m or rad, at the least.
_BEND = 1e-6
#: Each of the flatter axes is asked by so many fewer simulated tests: only where U ends depends on them.
_FLATTER_SHARE = 4

StandardArithmetic = Callable[[PositionStatistics], Arithmetic]


@dataclass(frozen=True, slots=True)
class Expanded:
    """Expanded uncertainty of a parameter."""

    uncertainty: float  #: U = k·u + |known error|, m or rad.
    coverage_factor: float  #: k.
    least: Least | None = None  #: What U was raised to, where the simulation gave less; else None.
    #: What the parameter would change by if the known errors were taken out of the readings, m or rad.
    known_error: float = 0.0


@dataclass(frozen=True, slots=True)
class _Ways:
    """How errors go of which a job states the size only."""

    drift: Drift | None  #: Of what drifts; None where nothing does.
    form: CurveForm = CurveForm.AT_EACH_POSITION  #: Of the instrument's error at each position.


@dataclass(frozen=True, slots=True)
class _Draws:
    """What simulated tests are drawn by, and where."""

    generator: np.random.Generator
    #: Of each measured line: where its tests, their errors and those of one contribution stand, (3, trial,
    #: approach, position, run). The system hands out new memory page by page, so this is made once for all.
    rooms: tuple[FloatArray, ...]

    @classmethod
    def of(cls, measurements: MeasurementSet, trials: int) -> _Draws:
        """Return the draws of a test: the same test gives the same ones."""
        readings = [each.deviations() for each in measurements.lines]
        at_once = max(1, _AT_ONCE // sum(each.size for each in readings))
        rooms = tuple(np.empty((3, max(1, min(at_once, trials)), *each.shape)) for each in readings)
        return cls(np.random.Generator(np.random.PCG64(make_seed_of(measurements))), rooms)


def propagate(
    budget: Budget, evaluations: Sequence[tuple[Evaluation, StandardArithmetic]], trials: int
) -> tuple[Mapping[str, Expanded], ...]:
    """Return the expanded uncertainty of each parameter by its symbol, for each evaluation of one test.

    `evaluations`: Of one test, one at least, each with the arithmetic that takes it from statistics to
        parameters.
    `trials`: Simulated tests; kinds of drift share them.

    U is half the width of the interval y ± U, about the value that the standard gives for the readings, which
    holds 95.45 % of the simulated values; u is the root mean square of their distances from y. A range or a
    largest value grows when errors are added to the readings, so that its simulated values lie more above y
    than below: U and u both count that in. Where something drifts, U is the largest of those of the kinds of
    drift, and of the forms which the error of the instrument at each position may have
    (`zlmreport.evaluation.uncertainty.instrument_curves`). Where the instrument errs as much as the axis, U
    reaches to the farthest of the flatter axes of which the readings may be a test, among 95.45 % of those
    simulated of it
    (J. Neyman, Phil. Trans. R. Soc. A 236, 1937). It is never less than the budget's bounds. Known errors are
    taken out of the readings first, errors are drawn about what is left, and U has in it whole what the
    parameter changes by (JCGM 100, F.2.4.5).
    """
    evaluations, known = _remove_known_errors(budget, evaluations)
    measurements = evaluations[0][0].measurements
    if not any(np.isfinite(each.deviation).any() for each in measurements.lines):
        return tuple({} for _ in evaluations)
    least = _NOTHING * max(each.standard_uncertainty for each in budget.lines)
    found: list[dict[str, Expanded]] = [{} for _ in evaluations]
    drifts = any(each.acting(Acts.IN_TIME) for each in budget.lines)
    kinds: Sequence[Drift | None] = choose_drift_kinds(measurements) if drifts else (None,)
    asked = [_Ways(kind, form) for form in list_forms(budget, measurements) for kind in kinds]
    each_of = trials // len(asked)
    draws = _Draws.of(measurements, each_of)
    for ways in asked:
        distances = _measure_distances(budget, evaluations, ways, each_of, draws)
        for so_far, (evaluation, _), values in zip(found, evaluations, distances, strict=True):
            symbols = (each.quantity.symbol for each in evaluation.parameters)
            for symbol, expanded in zip(symbols, _expand(np.abs(values), least), strict=True):
                if symbol not in so_far or expanded.uncertainty > so_far[symbol].uncertainty:
                    so_far[symbol] = expanded
    flatter = [_evaluate_readings(each, evaluations) for each in make_flatter_axes(measurements, budget)]
    for kind in kinds if flatter else ():
        fewer = max(1, each_of // _FLATTER_SHARE)
        reached = _find_reached(budget, evaluations, flatter, _Ways(kind), fewer, draws)
        found = [
            {symbol: _raise_to_reach(each, far[symbol]) for symbol, each in so_far.items()}
            for so_far, far in zip(found, reached, strict=True)
        ]
    return tuple(
        {
            symbol: _add_known_changes(
                _raise_to_bounds(each, budget, of_positions.get(symbol)), changes.get(symbol, 0.0)
            )
            for symbol, each in so_far.items()
        }
        for so_far, of_positions, changes in zip(
            found, _find_comparing_parameters(evaluations), known, strict=True
        )
    )


def _find_reached(  # noqa: PLR0913, PLR0917 - what a simulation of a test is made of
    budget: Budget,
    evaluations: Sequence[tuple[Evaluation, StandardArithmetic]],
    flatter: Sequence[Sequence[tuple[Evaluation, StandardArithmetic]]],
    ways: _Ways,
    trials: int,
    draws: _Draws,
) -> list[dict[str, float]]:
    """Return how far the farthest axis lies of which the readings may be a test, by symbol.

    `flatter`: The evaluations of each axis, the flattest last; between two of them is interpolated.
    """
    away, allowed = [], []
    for axis in flatter:
        distances = _measure_distances(budget, axis, ways, trials, draws)
        allowed.append([_find_half_widths(np.abs(each)) for each in distances])
        away.append(
            [
                np.abs(_list_values_of(read) - _list_values_of(flat))
                for (read, _), (flat, _) in zip(evaluations, axis, strict=True)
            ]
        )
    return [
        {
            each.quantity.symbol: _find_farthest(far, most)
            for each, far, most in zip(
                evaluation.parameters,
                np.stack([one[number] for one in away], axis=1).tolist(),
                np.stack([one[number] for one in allowed], axis=1).tolist(),
                strict=True,
            )
        }
        for number, (evaluation, _) in enumerate(evaluations)
    ]


def _list_values_of(evaluation: Evaluation) -> FloatArray:
    """Return the values of all parameters, m or rad."""
    return np.array([each.value for each in evaluation.parameters])


def _find_farthest(away: Sequence[float], allowed: Sequence[float]) -> float:
    """Return the distance of the farthest of axes that become flatter, as far as it is allowed."""
    farthest = 0.0
    for number, (far, most) in enumerate(zip(away, allowed, strict=True)):
        if far <= most:
            farthest = max(farthest, far)
        elif number and away[number - 1] <= allowed[number - 1]:
            spare, lacking = allowed[number - 1] - away[number - 1], far - most
            between = away[number - 1] + (far - away[number - 1]) * spare / (spare + lacking)
            farthest = max(farthest, between)
    return farthest


def _raise_to_reach(expanded: Expanded, distance: float) -> Expanded:
    """Return U that reaches so far at least; u stays, and k grows."""
    if distance <= expanded.uncertainty or not expanded.uncertainty:
        return expanded
    factor = expanded.coverage_factor * distance / expanded.uncertainty
    return Expanded(shorten(distance), shorten(factor), Least.FLATTER_AXIS)


def _evaluate_readings(
    measurements: MeasurementSet, evaluations: Sequence[tuple[Evaluation, StandardArithmetic]]
) -> Sequence[tuple[Evaluation, StandardArithmetic]]:
    """Return the evaluations with the values that other readings of the same test give."""
    statistics = compute_statistics_of(measurements)
    found = []
    for evaluation, arithmetic in evaluations:
        values = arithmetic(statistics).parameters
        parameters = tuple(
            replace(each, value=float(values[each.quantity.symbol])) for each in evaluation.parameters
        )
        found.append((replace(evaluation, measurements=measurements, parameters=parameters), arithmetic))
    return found


def _remove_known_errors(
    budget: Budget, evaluations: Sequence[tuple[Evaluation, StandardArithmetic]]
) -> tuple[Sequence[tuple[Evaluation, StandardArithmetic]], Sequence[Mapping[str, float]]]:
    """Return the evaluations of the test without its known errors, and what each parameter changes by."""
    if not any(each.known_errors for each in budget.lines):
        return evaluations, [{} for _ in evaluations]
    corrected = _evaluate_readings(_correct_readings(evaluations[0][0].measurements, budget), evaluations)
    changes = [
        {
            was.quantity.symbol: shorten(now.value - was.value)
            for was, now in zip(before.parameters, after.parameters, strict=True)
        }
        for (before, _), (after, _) in zip(evaluations, corrected, strict=True)
    ]
    return corrected, changes


def _correct_readings(measurements: MeasurementSet, budget: Budget) -> MeasurementSet:
    """Return readings without the known errors of their budget."""
    if measurements.tests:
        tests = {
            name: _correct_readings(each, budget.tests[name]) for name, each in measurements.tests.items()
        }
        return replace(measurements, tests=tests)
    if budget.correction is None:
        return measurements
    return replace(measurements, deviation=read_only_floats(measurements.deviation + budget.correction))


def _add_known_changes(expanded: Expanded, known_error: float) -> Expanded:
    """Add to U, whole, what a parameter changes by if known errors are taken out of the readings."""
    if not known_error:
        return expanded
    return replace(
        expanded, uncertainty=shorten(expanded.uncertainty + abs(known_error)), known_error=known_error
    )


def _measure_distances(
    budget: Budget,
    evaluations: Sequence[tuple[Evaluation, StandardArithmetic]],
    ways: _Ways,
    trials: int,
    draws: _Draws,
) -> list[FloatArray]:
    """Return y* − y in simulated tests, for each evaluation: (parameter, trial)."""
    distances = [np.empty((len(evaluation.parameters), trials)) for evaluation, _ in evaluations]
    done = 0
    for statistics, shown, count in _simulate_statistics(
        budget, evaluations[0][0].measurements, ways, trials, draws
    ):
        chunk = slice(done, done + count)
        done = chunk.stop
        for (evaluation, arithmetic), found in zip(evaluations, distances, strict=True):
            parameters = arithmetic(statistics).parameters
            stated = arithmetic(shown).parameters if shown else {}
            for each, of_one in zip(evaluation.parameters, found, strict=True):
                symbol = each.quantity.symbol
                of_one[chunk] = parameters[symbol] - stated.get(symbol, each.value)
    return distances


def _simulate_statistics(
    budget: Budget, measurements: MeasurementSet, ways: _Ways, trials: int, draws: _Draws
) -> Iterator[tuple[PositionStatistics, PositionStatistics | None, int]]:
    """Yield the statistics of simulated tests, so many at a time, those of what was shown, and how many.

    Of several measured lines each has errors of its own, drawn from its own budget.
    """
    generator = draws.generator
    if not measurements.tests:
        positions = measurements.target_positions
        alone = _simulate_tests(budget, measurements, ways, trials, generator, draws.rooms[0])
        for tests, shown in alone:
            of_shown = None if shown is None else position_statistics(shown, positions)
            yield position_statistics(tests, positions), of_shown, len(tests)
        return
    lines = measurements.tests
    of_lines = _sample_errors_of_lines(budget, trials, generator)
    for together in zip(
        *(
            _simulate_tests(budget.tests[name], each, ways, trials, generator, room, of_lines)
            for (name, each), room in zip(lines.items(), draws.rooms, strict=True)
        ),
        strict=True,
    ):
        of_each = {
            name: position_statistics(tests, lines[name].target_positions)
            for name, (tests, _) in zip(lines, together, strict=True)
        }
        count = len(together[0][0])
        are_shown = {
            name: position_statistics(
                np.repeat(line.deviations()[np.newaxis], count, axis=0) if shown is None else shown,
                line.target_positions,
            )
            for (name, line), (_, shown) in zip(lines.items(), together, strict=True)
            if any(shown is not None for _, shown in together)
        }
        yield join_statistics(of_each), join_statistics(are_shown) if are_shown else None, count


def _simulate_tests(  # noqa: PLR0913, PLR0917 - what a simulation of a test is made of
    budget: Budget,
    measurements: MeasurementSet,
    ways: _Ways,
    trials: int,
    generator: np.random.Generator,
    room: FloatArray,
    of_lines: Mapping[str, FloatArray] = MappingProxyType({}),
) -> Iterator[tuple[FloatArray, FloatArray | None]]:
    """Yield simulated tests, so many at a time: shape (trial, approach, position, run), m or rad.

    With each the readings that were shown of them without any other error; None where these are the readings
    of the test itself. The tests last until the next ones are asked for, which stand in the same room.

    `of_lines`: Errors, in units of u, that this line shares with others, by their names.
    """
    readings = measurements.deviations()
    along = sample_stratified(budget.steady(Acts.ALONG_THE_LENGTH), trials, generator)
    parting = sample_stratified(budget.acting(Acts.BETWEEN_DIRECTIONS), trials, generator)
    alike = sample_stratified(budget.steady(Acts.AT_THE_DATUM), trials, generator)
    changing = [
        (
            each.standard_uncertainty * of_lines[each.shared_as]
            if each.shared_as in of_lines
            else sample_stratified((each,), trials, generator),
            measurements.arranged(each.effect),
        )
        for each in budget.changing
        if each.effect is not None
    ]
    drifting = budget.acting(Acts.IN_TIME)
    hiding = find_hiding_resolution(budget, readings)
    independent = [each for each in budget.acting(Acts.AT_EACH_READING) if each is not hiding]
    times = compute_reading_times(measurements)
    effect = compute_effect_along(measurements.target_positions)
    parted = np.array([float(approach is Approach.NEGATIVE) for approach in Approach])
    at_once = room.shape[1]
    for first in range(0, trials, at_once):
        count = min(at_once, trials - first)
        tests, own, of_one = room[:, :count]
        errors = along[first : first + count, np.newaxis] * effect
        at_positions = budget.acting(Acts.AT_EACH_POSITION)
        formed = [each for each in at_positions if ways.form.half_waves and is_of_the_instrument(each)]
        own_of_positions = [each for each in at_positions if each not in formed]
        errors += sample_singly(own_of_positions, errors.shape, generator)
        for each in formed:
            errors += each.standard_uncertainty * sample_waves(ways.form, effect, count, generator)
        for each in (*budget.acting(Acts.ROUND_THE_CIRCLE), *budget.acting(Acts.OFF_CENTRE)):
            curves = smooth_curves(each.acts, measurements.target_positions, count, generator)
            errors += each.standard_uncertainty * curves
        draw_singly(independent, own, of_one, generator)
        rounded = sample_rounding(hiding, readings, count, generator) if hiding else None
        if ways.drift:
            for each in drifting:
                drifts = sample_drifts(ways.drift, times, count, generator)
                drifts *= find_full_range(each)
                own += drifts
        trial = slice(first, first + count)
        common = alike[trial, np.newaxis] + np.multiply.outer(parting[trial], parted)
        shared = errors[:, np.newaxis, :] + common[..., np.newaxis]
        shared += sample_singly(budget.acting(Acts.AT_EACH_APPROACH), shared.shape, generator)
        np.add(rounded.before if rounded else readings, shared[..., np.newaxis], out=tests)
        tests += own
        for draws, effects in changing:
            tests += np.multiply.outer(draws[trial], effects)
        yield tests, rounded.shown if rounded else None


def _sample_errors_of_lines(
    budget: Budget, trials: int, generator: np.random.Generator
) -> dict[str, FloatArray]:
    """Return the errors that several lines share, in units of u, by their names."""
    shared = {each.shared_as: each for line in budget.lines for each in line.contributions if each.shared_as}
    return {
        name: sample_stratified((replace(each, standard_uncertainty=1.0),), trials, generator)
        for name, each in shared.items()
    }


def _find_comparing_parameters(
    evaluations: Sequence[tuple[Evaluation, StandardArithmetic]],
) -> list[dict[str, bool]]:
    """Return which parameters an error of position can enter: asked of the standard by large errors.

    One that is no deviation of what was measured, as a slope, is not among them: the bounds of U are no
    bounds of it.
    """
    measurements = evaluations[0][0].measurements
    if measurements.tests:
        return [{} for _ in evaluations]
    readings = measurements.deviations()
    bend = float(np.nanmax(readings) - np.nanmin(readings) + _BEND) * np.arange(readings.shape[1]) ** 2
    bent = np.stack([readings + side * bend[:, np.newaxis] for side in (-1.0, 1.0)])
    statistics = position_statistics(bent, measurements.target_positions)
    return [
        {
            each.quantity.symbol: bool(
                np.any(np.abs(parameters[each.quantity.symbol] - each.value) > _NOTHING * bend[-1])
            )
            for each in evaluation.parameters
            if each.quantity.unit is None
        }
        for evaluation, arithmetic in evaluations
        for parameters in (arithmetic(statistics).parameters,)
    ]


def make_seed_of(measurements: MeasurementSet) -> int:
    """Return a seed that is the readings' own: the same test gives the same uncertainties."""
    digest = hashlib.sha256()
    for name, each in measurements.tests.items():
        digest.update(f"{name} {make_seed_of(each)};".encode())
    readings = measurements.deviations()
    for values in (measurements.target_positions, np.where(np.isnan(readings), np.inf, readings)):
        digest.update(np.ascontiguousarray(values, dtype="<f8").tobytes())
    return int.from_bytes(digest.digest())


def _expand(distances: FloatArray, least: float) -> list[Expanded]:
    """Return the expanded uncertainty of each parameter by its distances, shape (parameter, trial)."""
    standard = np.sqrt(np.mean(distances**2, axis=-1))
    return [
        Expanded(shorten(half), shorten(half / one)) if one > least else Expanded(0.0, COVERAGE_FACTOR)
        for half, one in zip(_find_half_widths(distances).tolist(), standard.tolist(), strict=True)
    ]


def _find_half_widths(distances: FloatArray) -> FloatArray:
    """Return the half widths that hold 95.45 % of the distances, shape (parameter, trial)."""
    rank = math.ceil(COVERAGE_PROBABILITY * distances.shape[-1]) - 1
    return np.asarray(np.partition(distances, rank, axis=-1)[:, rank])


def _raise_to_bounds(expanded: Expanded, budget: Budget, compares_positions: bool | None) -> Expanded:  # noqa: FBT001 - private
    """Raise U to what it must at least be; the bounds are stated with k = 2.

    `compares_positions`: Whether the parameter does; None for one to which no bound applies.
    """
    if compares_positions is None:
        return expanded
    for bound, least in (
        (budget.of_the_instrument if compares_positions else 0.0, Least.INSTRUMENT),
        (budget.least, Least.LABORATORY),
    ):
        if expanded.uncertainty < bound:
            expanded = Expanded(shorten(bound), COVERAGE_FACTOR, least)
    return expanded


def shorten(value: float) -> float:
    """Return a value with the digits that are kept."""
    return float(f"{value:.{_DIGITS}g}")
