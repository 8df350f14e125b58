"""Which quantity a job says was measured (positioning, straightness …), and whether other keys fit it."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, Any

from zlmreport.errors import InputError, Problem, did_you_mean, quoted
from zlmreport.job.evaluation_keys import UNCERTAIN_LENGTHS
from zlmreport.job.keys import JobKeys
from zlmreport.job.tree import Keys, Step, place_of
from zlmreport.measurement.axis import AxisKind
from zlmreport.measurement.error_symbol import ROTARY_AXES, ErrorSymbol, find_error_named, find_letter_of
from zlmreport.measurement.measurand import (
    CIRCLE,
    OF_SYMBOLS,
    POSITIONING,
    Coordinate,
    Measurand,
    is_for,
    list_identifiers,
    list_measurands_of,
)
from zlmreport.measurement.units import DEGREE, MILLIMETRE

if TYPE_CHECKING:
    from zlmreport.job.effect_choices import EffectChoice
    from zlmreport.plugin.protocols import Standard
    from zlmreport.plugin.registry import Registry

_ERROR = ("measurement", "error")


def find_stated_error(keys: JobKeys) -> ErrorSymbol | None:
    """Return the error that a job names by its symbol; None where it names none, or a measurand."""
    stated = keys.measurement.error
    if stated is None:
        return None
    try:
        return find_error_named(stated)
    except ValueError:
        return None


def find_measurand_of(keys: JobKeys, tree: Keys, registry: Registry, problems: list[Problem]) -> Measurand:
    """Return what was measured: as the job says, or else as its standards do.

    Mistakes are added to the problems: an error that is none, standards that are not for it, an axis that the
    symbol does not name.
    """
    standards = list(_list_standards(keys, tree, registry))
    stated = keys.measurement.error
    found = _find_stated(stated, keys, tree, standards, problems) if stated else None
    found = found or _find_of_standards(keys, tree, standards, problems)
    if found is None:
        return POSITIONING
    for index, standard in standards:
        if not is_for(standard, found):
            problems.append(
                Problem(
                    place_of(tree, ("evaluate", index)),
                    f"{standard.identifier} evaluates {list_identifiers(list_measurands_of(standard))}, "
                    f"and this job is on {_say_in_words(found, keys)}; "
                    f"{_say_what_would_fit(found, registry)}",
                )
            )
    return found


def _say_in_words(measurand: Measurand, keys: JobKeys) -> str:
    stated = keys.measurement.error
    if stated is None and keys.circle is not None:
        return f"a {measurand.identifier} (circle: …)"
    return f"{measurand.identifier} (measurement.error: {stated})" if stated else measurand.identifier


def _say_what_would_fit(measurand: Measurand, registry: Registry) -> str:
    fitting = [each.identifier for each in registry.standards if is_for(each, measurand)]
    return f"would fit: {', '.join(fitting)}" if fitting else "no installed standard evaluates that"


def _list_standards(keys: JobKeys, tree: Keys, registry: Registry) -> Iterator[tuple[int, Standard]]:
    """Yield the standards of a job that are installed; the others are refused elsewhere."""
    for index, each in enumerate(keys.evaluate):
        try:
            yield index, registry.standard(each.standard, place_of(tree, ("evaluate", index)))
        except InputError:
            continue


def _find_stated(
    stated: str,
    keys: JobKeys,
    tree: Keys,
    standards: Sequence[tuple[int, Standard]],
    problems: list[Problem],
) -> Measurand | None:
    """Return what `measurement.error` names: an error of ISO 230-1, or a measurand of the standards."""
    named = {each.identifier: each for _, standard in standards for each in list_measurands_of(standard)}
    place = place_of(tree, _ERROR)
    if stated in named and stated not in OF_SYMBOLS:
        return named[stated]
    if stated in OF_SYMBOLS:
        examples = {"positioning": "EXX", "straightness": "EYX", "angle": "EBX", "squareness": "C0Y"}
        said = f"measurement.error: name the error by its symbol, as {examples[stated]} for {stated}"
        problems.append(Problem(place, said))
        return None
    try:
        error = find_error_named(stated)
    except ValueError as error_of_symbol:
        problems.append(Problem(place, f"measurement.error: {error_of_symbol}"))
        return None
    name, letter = keys.axis.name, find_letter_of(keys.axis.name)
    if letter != error.axis:
        problems.append(
            Problem(
                place,
                f"measurement.error: {error.symbol} is an error of axis {error.axis}, and axis.name is "
                f"{quoted(name)}; the last letter of the error names the axis that moves",
            )
        )
    is_turning = error.measurand.coordinate is Coordinate.ANGLE
    if is_turning != (keys.axis.kind is AxisKind.ROTARY):
        kind = "rotary" if is_turning else "linear"
        problems.append(
            Problem(place, f"measurement.error: {error.symbol} belongs to a {kind} axis; axis.kind: {kind}")
        )
    return error.measurand


def _find_of_standards(
    keys: JobKeys,
    tree: Keys,
    standards: Sequence[tuple[int, Standard]],
    problems: list[Problem],
) -> Measurand | None:
    """Return what all standards of a job are for: positioning if all are, or the one that they share."""
    if keys.circle is not None:
        return CIRCLE
    if keys.measurement.error is not None or not standards:
        return None
    shared = [
        each
        for each in list_measurands_of(standards[0][1])
        if all(is_for(standard, each) for _, standard in standards)
    ]
    if any(each.identifier == POSITIONING.identifier for each in shared):
        return POSITIONING
    if len(shared) == 1:
        return shared[0]
    if shared:
        example = "EYX" if any(each.identifier in OF_SYMBOLS for each in shared) else shared[0].identifier
        problems.append(
            Problem(
                place_of(tree, ("measurement",)),
                f"{standards[0][1].identifier} evaluates {list_identifiers(shared)}; say what was measured: "
                f"measurement.error: {example}",
            )
        )
        return None
    first = standards[0][1]
    for index, standard in standards:
        if not {each.identifier for each in list_measurands_of(standard)} & {
            each.identifier for each in list_measurands_of(first)
        }:
            problems.append(
                Problem(
                    place_of(tree, ("evaluate", index)),
                    f"{standard.identifier} evaluates {list_identifiers(list_measurands_of(standard))}, and "
                    f"{first.identifier} {list_identifiers(list_measurands_of(first))}; "
                    "the standards of a job are for one quantity: "
                    "write a job for each, or name it by measurement.error",
                )
            )
    return None


#: Groups of keys that are for lengths along the axis only, and why.
_FOR_LENGTHS = {
    "corrections": "air, dead path and expansion change a length along the axis",
    "compensation": "a control corrects positions along the axis by it",
}


def find_quantity_contradictions(
    keys: JobKeys, measurand: Measurand
) -> Iterator[tuple[tuple[Step, ...], str]]:
    """Yield the keys of a job that do not go with what was measured, which is no positioning."""
    if (measurand.of_lines or measurand).coordinate is Coordinate.TIME:
        yield from _find_keys_of_lengths(keys)
    for key, reason in _FOR_LENGTHS.items():
        if getattr(keys, key) is not None:
            yield (key,), f"belongs to positioning: {reason}, and this job is on {measurand.identifier}"
    if keys.model is not None and keys.model.sessions:
        yield ("model", "sessions"), f"belongs to positioning, and this job is on {measurand.identifier}"


def _find_keys_of_lengths(keys: JobKeys) -> Iterator[tuple[tuple[Step, ...], str]]:
    """Yield the keys of an uncertainty that do not go with readings over time."""
    stated = keys.uncertainty
    if stated.environmental_variation is not None:
        yield (
            ("uncertainty", "environmental_variation"),
            "is what this job measures: the machine's environment over time; take it out",
        )
    for name in UNCERTAIN_LENGTHS:
        if getattr(stated, name) is not None:
            yield (
                ("uncertainty", name),
                (
                    "belongs to a length along an axis, and here nothing moved but with time; state what the "
                    "set-up itself did under uncertainty.contributions"
                ),
            )
    for index, each in enumerate(stated.contributions):
        if each.acts == "along-the-length":
            yield (
                ("uncertainty", "contributions", index, "acts"),
                "along-the-length does not fit: time is no length",
            )
    if stated.instrument_acts == "along-the-length":
        yield ("uncertainty", "instrument_acts"), "along-the-length does not fit: time is no length"


def find_tests_contradictions(keys: JobKeys, measurand: Measurand) -> Iterator[tuple[tuple[Step, ...], str]]:
    """Yield what does not go together of a job's source and its named tests."""
    measurement = keys.measurement
    if not measurement.tests and measurement.source is None:
        yield ("measurement", "source"), "missing; say where the readings come from, or name tests"
    if measurement.tests and measurement.source is not None:
        yield ("measurement", "source"), "each of the tests has a source of its own; take this one out"
    if measurand.joins_tests and not measurement.tests:
        stated = measurement.error or measurand.identifier
        yield (
            ("measurement", "tests"),
            f"{stated} follows from several measured lines; name them: {{x: {{error: …, source: …}}, …}}",
        )
    if measurement.tests:
        yield from _find_missing_lines(keys, measurand)
        if keys.as_found is not None:
            yield ("as_found",), "a job with several tests has no state as found; write a job for each state"
        yield from _find_mismatches_of_each_test(keys, measurand)


def _find_mismatches_of_each_test(
    keys: JobKeys, measurand: Measurand
) -> Iterator[tuple[tuple[Step, ...], str]]:
    """Yield what does not go together within each of several measured lines."""
    for name, test in keys.measurement.tests.items():
        path: tuple[Step, ...] = ("measurement", "tests", name)
        if measurand.test_names and name not in measurand.test_names:
            near = did_you_mean(name, measurand.test_names)
            yield path, f"{quoted(name)} is none of the lines of {measurand.identifier}; {near}"
        if test.source is None:
            yield (*path, "source"), "missing; say where the readings of this test come from"
        if test.error is None:
            continue
        if measurand.of_lines and test.error == measurand.of_lines.identifier:
            continue
        try:
            error = find_error_named(test.error)
        except ValueError as mistake:
            yield (*path, "error"), str(mistake)
            continue
        if test.axis and find_letter_of(test.axis.name) != error.axis:
            yield (
                (*path, "error"),
                f"{error.symbol} is an error of axis {error.axis}, not of {quoted(test.axis.name)}",
            )


def _find_missing_lines(keys: JobKeys, measurand: Measurand) -> Iterator[tuple[tuple[Step, ...], str]]:
    """Yield which of the two lines of a squareness error is lacking, where its tests are straight lines."""
    error, tests = find_stated_error(keys), keys.measurement.tests
    if error is None or not error.lines or not measurand.joins_tests:
        return
    named = [(each.error or "").strip().upper() for each in tests.values()]
    lacking = [each for each in error.lines if each not in named]
    others = [each for each in named if each not in error.lines]
    if lacking and (len(named) == 1 or any(others)):
        pair = " and ".join(error.lines)
        yield (
            ("measurement", "tests"),
            f"{error.symbol} follows from {pair}; {' and '.join(lacking)} is not among the tests",
        )


def convert_places_to_si(at: Mapping[str, Any]) -> tuple[tuple[str, float], ...]:
    """Return where other axes stood, by their names, m or rad; the tool's offset is no place of an axis."""
    return tuple(
        (name, (DEGREE if name[:1].upper() in ROTARY_AXES else MILLIMETRE).to_si(value))
        for name, value in at.items()
        if not isinstance(value, tuple)
    )


def find_effect_contradictions(
    effects: Sequence[EffectChoice], measurand: Measurand, registry: Registry
) -> Iterator[tuple[tuple[Step, ...], str]]:
    """Yield the effects of a model that do not describe what was measured."""
    for index, choice in enumerate(effects):
        if choice.is_formula:
            continue
        effect = registry.effect(choice.identifier)
        if not is_for(effect, measurand):
            yield (
                ("model", "effects", index),
                (
                    f"{choice.identifier} acts on {list_identifiers(list_measurands_of(effect))}, "
                    f"not on {measurand.identifier}"
                ),
            )
