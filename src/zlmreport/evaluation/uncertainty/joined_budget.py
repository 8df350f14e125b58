"""The budget of what follows from several measured lines, such as squareness: those of the lines joined."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace

from zlmreport.evaluation.uncertainty.budget import Acts, Budget, Contribution, NoBudget
from zlmreport.language import named


def join_budgets(
    budgets: Mapping[str, Budget | NoBudget],
    brought: Iterable[Mapping[str, Sequence[Contribution]]] = (),
    demanded: Iterable[str] = (),
    negligible: Iterable[tuple[str, str]] = (),
) -> Budget | NoBudget:
    """Return the budget of an evaluation of several lines; none where one of them has none.

    Parameters
    ----------
    budgets
        Of each line, by its name.
    brought
        What standards know of the errors of a line beside that, as that of the artefact that joins two lines.
    demanded
        Contributors that the evaluation asks for, by their keys.
    negligible
        Contributors that the laboratory declares negligible, by their keys, each with its reason.
    """
    tests: dict[str, Budget] = {}
    lacking = tuple(dict.fromkeys(each for of in budgets.values() for each in of.missing))
    declared = dict(pair for of in budgets.values() for pair in of.negligible) | dict(negligible)
    longer = None if any(of.uncorrected_expansion is None for of in budgets.values()) else 0.0
    more = [each for of in brought for each in of.items()]
    considered = {each.contributor for _, of in more for each in of} | declared.keys()
    missing = (*lacking, *(each for each in demanded if each not in considered))
    for name, of in budgets.items():
        if isinstance(of, NoBudget):
            return NoBudget(named(name, of.reason), missing, tuple(declared.items()), longer)
        own = (*of.contributions, *(each for test, found in more if test == name for each in found))
        ordered = tuple(each for acts in Acts for each in own if each.acts is acts)
        tests[name] = replace(of, contributions=ordered)
    return Budget((), missing, tuple(declared.items()), uncorrected_expansion=longer, tests=tests)
