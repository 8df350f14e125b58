"""The standards that a job evaluates by: their own keys, their tolerances, the files that they name."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from zlmreport.errors import InputError, Place, Problem, did_you_mean, quoted
from zlmreport.files import demand
from zlmreport.job.choices import group_naming
from zlmreport.job.contradictions import validate
from zlmreport.job.evaluation_keys import StandardKeys
from zlmreport.job.job import StandardChoice
from zlmreport.job.parse import LARGEST
from zlmreport.job.tree import Items, Keys, Scalar, find_at
from zlmreport.job.types import list_values
from zlmreport.language.formatting import write_plain
from zlmreport.measurement.axis import Axis
from zlmreport.measurement.error_symbol import evaluate_for_error
from zlmreport.measurement.provenance import SourceFile

if TYPE_CHECKING:
    from zlmreport.plugin.protocols import Standard
    from zlmreport.plugin.registry import Registry

#: Keys of `evaluate` that every standard has.
_OF_EVERY_STANDARD = tuple(StandardKeys.model_fields)


def list_adoptions_of(standard: Standard) -> tuple[str, ...]:
    """Return the names under which other bodies publish a standard's text; none for most."""
    return getattr(standard, "adoptions", ())


def choose_standards(
    tree: Keys, registry: Registry, problems: list[Problem], error: str = ""
) -> Iterator[StandardChoice]:
    """Yield the standards that a job's `evaluate` lists, with their own keys and no tolerances yet.

    `error`: What the job says was measured: some parameters bear its symbol.

    Mistakes are added to the problems: tolerances for what is no parameter among them.
    """
    evaluate = find_at(tree, ("evaluate",))
    first_named: dict[str, Place] = {}
    for item in evaluate.items if isinstance(evaluate, Items) else ():
        keys = group_naming("standard", item)
        named = keys.entries.get("standard")
        if named is None or not isinstance(named.value, Scalar) or named.value.is_nothing:
            continue
        identifier, place = named.value.text, named.value.place
        try:
            standard = evaluate_for_error(registry.standard(identifier, place), error)
        except InputError as unknown:
            problems.extend(unknown.problems)
            continue
        if standard.identifier in first_named:
            first = first_named[standard.identifier].line
            problems.append(
                Problem(place, f"{standard.identifier} stands in line {first} already; remove one of them")
            )
        first_named.setdefault(standard.identifier, place)
        problems.extend(_find_unknown_tolerances(keys, standard))
        own = replace(keys.without(*_OF_EVERY_STANDARD), place=place)
        options = validate(standard.options, own, problems, within="evaluate", also_known=_OF_EVERY_STANDARD)
        if options:
            adoption = "" if identifier == standard.identifier else identifier
            yield StandardChoice(standard.identifier, options, place, {}, adoption=adoption)


def _find_unknown_tolerances(keys: Keys, standard: Standard) -> Iterator[Problem]:
    """Yield tolerances for what is no parameter of the standard, or cannot have one."""
    tolerances = find_at(keys, ("tolerances",))
    limitable = [quantity.symbol for quantity in standard.quantities if quantity.can_be_limited]
    symbols = {quantity.symbol for quantity in standard.quantities}
    printed = {
        write_plain(each.notation): each.symbol for each in standard.quantities if each.symbol in limitable
    }
    before = ""
    for symbol, entry in tolerances.entries.items() if isinstance(tolerances, Keys) else ():
        spelt = symbol.replace("↑", "_fwd").replace("↓", "_bwd")
        if symbol.isdecimal():
            yield Problem(entry.place, f"a comma parts keys; write a decimal point: {before}.{symbol}")
            continue
        before = f"{symbol}: {entry.value.text}" if isinstance(entry.value, Scalar) else symbol
        written = printed.get(symbol, spelt)
        if written != symbol and written in limitable:
            yield Problem(entry.place, f"{quoted(symbol)} is written {written} in a job")
            continue
        if symbol not in symbols:
            message = f"{quoted(symbol)} is no parameter of {standard.identifier}; "
        elif symbol not in limitable:
            message = f"{symbol} of {standard.identifier} takes no tolerance; "
        else:
            continue
        yield Problem(entry.place, message + did_you_mean(symbol, limitable))


def convert_tolerances_to_si(
    tolerances: Mapping[str, float], standard: Standard, axis: Axis
) -> dict[str, float]:
    """Return tolerances, given in the unit of what was measured or in a parameter's own, in SI."""
    own = {each.symbol: each.unit for each in standard.quantities if each.unit is not None}
    return {symbol: own.get(symbol, axis.deviation_unit).to_si(limit) for symbol, limit in tolerances.items()}


def list_files_named(standards: Iterable[StandardChoice]) -> Iterator[SourceFile]:
    """Yield the files that keys of standards name; a certificate carries them as it does its readings."""
    for choice in standards:
        for _, path in list_values(choice.options):
            if isinstance(path, Path):
                yield SourceFile.of(path, demand(path, LARGEST, choice.place))
