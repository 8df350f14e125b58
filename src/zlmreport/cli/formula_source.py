"""An effect that a job writes as a formula, as the Python source of a plugin that gives the same values."""

from __future__ import annotations

import json
import keyword
from collections.abc import Iterable, Iterator, Mapping

import numpy as np

from zlmreport.language import Language, Words
from zlmreport.measurement.axis import AxisKind
from zlmreport.measurement.measurement_set import CONDITIONS
from zlmreport.model.effect import Parameter
from zlmreport.model.formula import FormulaEffect
from zlmreport.quantities.formula import Name, Number, Tree

_REMEDY = Words(
    en="Its cause is not known yet: find it, and write here what a service engineer does.",
    de="Die Ursache ist noch nicht bekannt: sie suchen und hier angeben, was im Service zu tun ist.",
)
_READINGS = {
    "P": "design.position",
    "D": "design.direction",
    "t": "design.time",
    "run": "design.run.astype(np.float64)",
}
_SIGNS = {"+": 1, "-": 1, "*": 2, "/": 2}
_FUNCTIONS = {"atan": "arctan", "min": "minimum", "max": "maximum", "^": "power"}
_TAKEN = {"self", "design", "theta", "np", "columns", "each"}


def tokens_of(effect: FormulaEffect, kind: AxisKind) -> dict[str, str]:
    """Return what the skeleton of a formula is filled with.

    `effect`: The formula; it has no variable v.
    `kind`: Of the axis that it is meant for.
    """
    formula, searched = effect.formula, _with_range(effect)
    variables = {name: _variable(name) for name in (*formula.names, *effect.keys.parameters)}
    logged = ", ".join(map(_quoted, formula.columns))
    needs = [f"needs_{kind.value}_axis(design)", *([f"needs_logged(design, {logged})"] if logged else [])]
    imports = {"Design", "Dimension", "Effect", "FloatArray", "Parameter", "Shape", "Words", "hookimpl"}
    imports |= {each.partition("(")[0] for each in needs} | ({"search_grid"} if searched else set())
    trees = formula.multiplied.values()
    return {
        "imports": _indented(f"{name}," for name in sorted(imports, key=_as_linters_sort)),
        "title": _words(effect.title),
        "equation": _quoted(effect.equation),
        "linear": _tuple(map(_parameter, effect.linear)),
        "searched": _tuple(map(_parameter, searched)),
        "shape": effect.shape.name,
        "look": _words(effect.look),
        "remedy": _words(effect.remedy or _REMEDY),
        "needs": " or ".join(needs),
        "grid": "search_grid(design, self.searched)" if searched else "np.empty((1, 0))",
        "readings": _indented(_assignments(effect, variables), 8),
        "columns": _indented((f"{_python(tree, variables)}," for tree in trees), 16),
    }


def in_job(effect: FormulaEffect) -> str:
    """Return how a job names the plugin instead of the formula, with what it states of parameters."""
    left = {parameter.name for parameter in (*effect.linear, *_with_range(effect))}
    stated = [
        f"{name}: {each.value!r}" if each.equals is None else f"{name}: {{equals: {each.equals}}}"
        for name, each in effect.keys.parameters.items()
        if name in left and (each.value is not None or each.equals is not None)
    ]
    return f"{effect.identifier}: {{{', '.join(stated)}}}" if stated else effect.identifier


def _with_range(effect: FormulaEffect) -> tuple[Parameter, ...]:
    """Return the parameters that are searched; one of which only the value is stated is a number."""
    return tuple(each for each in effect.searched if each.smallest is not None)


def _assignments(effect: FormulaEffect, variables: Mapping[str, str]) -> Iterator[str]:
    """Yield the lines that give the names of a formula their values."""
    places = {parameter.name: place for place, parameter in enumerate(_with_range(effect))}
    for name in effect.formula.names:
        if name in _READINGS:
            yield f"{variables[name]} = {_READINGS[name]}"
        elif name in places:
            yield f"{variables[name]} = theta[{places[name]}]"
        elif name in effect.formula.searched:
            yield f"{variables[name]} = {effect.formula.stated[name]!r}"
        elif name in effect.formula.columns:
            log, kind = f"design.conditions[{_quoted(name)}]", CONDITIONS.get(name)
            if kind is not None:
                zero, size = kind.unit.zero, kind.unit.si
                log = f"({log} - {zero!r}) / {size!r}"
            yield f"{variables[name]} = {log}"


def _python(tree: Tree, variables: Mapping[str, str], level: int = 0) -> str:
    """Return a formula as an expression of numpy; in brackets where it binds less than what is around it."""
    if isinstance(tree, Number):
        return "np.pi" if tree.value == np.pi else repr(tree.value)
    if isinstance(tree, Name):
        return variables[tree.text]
    operation, arguments = tree.operation, tree.arguments
    if operation in _SIGNS:
        own = _SIGNS[operation]
        left, right = _python(arguments[0], variables, own), _python(arguments[1], variables, own + 1)
        found = f"{left} {operation} {right}"
        return f"({found})" if own < level else found
    listed = ", ".join(_python(each, variables) for each in arguments)
    if operation == "step":
        return f"np.heaviside({listed}, 1.0)"
    return f"np.{_FUNCTIONS.get(operation, operation)}({listed})"


def _parameter(parameter: Parameter) -> str:
    parts = (
        _quoted(parameter.name),
        _quoted(parameter.notation),
        f"Dimension.{parameter.dimension.name}",
        _words(parameter.description, 12),
        *(repr(each) for each in (parameter.smallest, parameter.largest) if each is not None),
    )
    return "Parameter(\n" + _indented((f"{part}," for part in parts), 12) + "\n        ),"


def _words(words: Words, indent: int = 4) -> str:
    """Return words in both languages, one a line."""
    space = " " * indent
    lines = (
        f"{space}    {language.value}={_quoted(words.in_language(language))},\n" for language in Language
    )
    return f"Words(\n{''.join(lines)}{space})"


def _tuple(items: Iterable[str]) -> str:
    listed = _indented(items, 8)
    return f"(\n{listed}\n    )" if listed else "()"


def _indented(lines: Iterable[str], indent: int = 4) -> str:
    return "\n".join(" " * indent + line for line in lines)


def _quoted(text: str) -> str:
    return json.dumps(text, ensure_ascii=False)


def _variable(name: str) -> str:
    return f"{name}_" if keyword.iskeyword(name) or name in _TAKEN else name


def _as_linters_sort(name: str) -> tuple[bool, str]:
    return name[0].islower(), name
