"""The language of formulas: functions, constants, units; parsed and computed, never executed.

A formula is a text of numbers, names, the four operations, powers and a few functions. It becomes a tree of
frozen values, of which each name and each operation is known: nothing in it can call anything else.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import reduce
from types import MappingProxyType
from typing import NamedTuple, TypeAlias

import numpy as np

from zlmreport.errors import did_you_mean
from zlmreport.measurement.arrays import FloatArray

_LONGEST, _DEEPEST = 500, 40
_NUMBER = r"(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][-+]?[0-9]+)?"
_TOKEN = re.compile(rf"\s*(?:({_NUMBER})|([^\W\d]\w*)|(\*\*|[-+*/^(),]))")

CONSTANTS = MappingProxyType({"pi": np.pi})
_PURE: Mapping[str, Callable[[FloatArray], FloatArray]] = {
    "sin": np.sin,
    "cos": np.cos,
    "tan": np.tan,
    "atan": np.arctan,
    "exp": np.exp,
    "log": np.log,
    "tanh": np.tanh,
    "floor": np.floor,
}
_OF_ANY: Mapping[str, Callable[[FloatArray], FloatArray]] = {
    "sign": np.sign,
    "step": lambda values: np.heaviside(values, 1.0),
}
_LIKE_ITS_OWN: Mapping[str, Callable[..., FloatArray]] = {
    "abs": np.abs,
    "min": np.minimum,
    "max": np.maximum,
}
_ARGUMENTS = {"min": 2, "max": 2}
#: Stands for the sine and the cosine of whole turns, each of a size of its own: see `write_out_waves`.
WAVE = "wave"
#: Stands for what a logged column changes by in a second: see `name_rates`.
RATE = "rate"
FUNCTIONS = (*_PURE, *_OF_ANY, *_LIKE_ITS_OWN, "sqrt", WAVE, RATE)
_OPERATIONS: Mapping[str, Callable[..., FloatArray]] = {
    "+": np.add,
    "-": np.subtract,
    "*": np.multiply,
    "/": np.divide,
    "^": np.power,
    "sqrt": np.sqrt,
    **_PURE,
    **_OF_ANY,
    **_LIKE_ITS_OWN,
}


class FormulaError(ValueError):
    """What is wrong with a formula, fit to stand behind the place where it is written.

    `key`: Where that is in its effect, step by step; the formula itself without it.
    """

    def __init__(self, message: str, *key: str) -> None:
        super().__init__(message)
        self.key = key or ("formula",)


class Extent(NamedTuple):
    """What a value is made of: powers of travel (length or angle), time and temperature."""

    travel: Fraction = Fraction(0)
    time: Fraction = Fraction(0)
    temperature: Fraction = Fraction(0)

    def __str__(self) -> str:
        parts = [
            name if power == 1 else f"{name}^{power}"
            for name, power in zip(self._fields, self, strict=True)
            if power
        ]
        return "·".join(parts) or "a number"

    def combine(self, other: Extent, sign: int) -> Extent:
        """Return the extent of a product, or with −1 of a quotient."""
        return Extent(*(mine + sign * its for mine, its in zip(self, other, strict=True)))

    def raise_to(self, power: Fraction) -> Extent:
        """Return the extent of a power."""
        return Extent(*(each * power for each in self))


NUMBER = Extent()
TRAVEL, TIME, TEMPERATURE = Extent(Fraction(1)), Extent(time=Fraction(1)), Extent(temperature=Fraction(1))


@dataclass(frozen=True, slots=True)
class Number:
    """A number, as it is written."""

    value: float


@dataclass(frozen=True, slots=True)
class FormulaName:
    """A parameter, a variable of the readings, or a logged column."""

    text: str


@dataclass(frozen=True, slots=True)
class Call:
    """An operation, or a function, with its arguments."""

    operation: str
    arguments: tuple[Tree, ...]


Tree: TypeAlias = Number | FormulaName | Call


class UnitOf(NamedTuple):
    """The unit of a name: what it is made of, and how many of the unit make one in SI."""

    extent: Extent
    per_si: float = 1.0


def parse_formula(text: str) -> Tree:
    """Return a formula as a tree.

    Raises `FormulaError` if it is none.
    """
    if len(text) > _LONGEST:
        raise FormulaError(f"a formula has at most {_LONGEST} characters; this one has {len(text)}")
    tokens = list(_split_tokens(text))
    tree, rest = _parse_sum(tokens, 0, 0)
    if rest < len(tokens):
        raise FormulaError(f"{tokens[rest]!r} cannot stand there; an operation is missing before it")
    return tree


def _split_tokens(text: str) -> Iterator[str]:
    place, text = 0, text.rstrip()
    while place < len(text):
        found = _TOKEN.match(text, place)
        if found is None:
            raise FormulaError(f"{text[place:].lstrip()[:1]!r} means nothing in a formula")
        place = found.end()
        yield found.group().strip().replace("**", "^")


def _parse_sum(tokens: list[str], place: int, depth: int) -> tuple[Tree, int]:
    left, place = _parse_product(tokens, place, depth)
    while place < len(tokens) and tokens[place] in "+-":
        right, after = _parse_product(tokens, place + 1, depth)
        left, place = Call(tokens[place], (left, right)), after
    return left, place


def _parse_product(tokens: list[str], place: int, depth: int) -> tuple[Tree, int]:
    left, place = _parse_signed(tokens, place, depth)
    while place < len(tokens) and tokens[place] in "*/":
        right, after = _parse_signed(tokens, place + 1, depth)
        left, place = Call(tokens[place], (left, right)), after
    return left, place


def _parse_signed(tokens: list[str], place: int, depth: int) -> tuple[Tree, int]:
    if depth > _DEEPEST:
        raise FormulaError(f"it is nested deeper than {_DEEPEST} levels")
    if place < len(tokens) and tokens[place] in "+-":
        value, after = _parse_signed(tokens, place + 1, depth + 1)
        return (Call("*", (Number(-1.0), value)) if tokens[place] == "-" else value), after
    base, place = _parse_atom(tokens, place, depth + 1)
    if place < len(tokens) and tokens[place] == "^":
        power, place = _parse_signed(tokens, place + 1, depth + 1)
        return Call("^", (base, power)), place
    return base, place


def _parse_atom(tokens: list[str], place: int, depth: int) -> tuple[Tree, int]:
    if place == len(tokens):
        raise FormulaError("it ends where a number, a name or a bracket is expected")
    found = tokens[place]
    if found[0] in "0123456789.":
        return Number(float(found)), place + 1
    if found == "(":
        inner, place = _parse_sum(tokens, place + 1, depth + 1)
        return inner, _require_closed(tokens, place)
    if not (found[0].isalpha() or found[0] == "_"):
        raise FormulaError(f"{found!r} cannot stand there; a number, a name or a bracket is expected")
    if place + 1 < len(tokens) and tokens[place + 1] == "(":
        return _parse_function(tokens, place, depth)
    return (Number(CONSTANTS[found]) if found in CONSTANTS else FormulaName(found)), place + 1


def _parse_function(tokens: list[str], place: int, depth: int) -> tuple[Tree, int]:
    name, place = tokens[place], place + 1
    if name not in FUNCTIONS:
        raise FormulaError(f"there is no function {name!r}; {did_you_mean(name, FUNCTIONS)}")
    arguments: list[Tree] = []
    while not arguments or (place < len(tokens) and tokens[place] == ","):
        argument, place = _parse_sum(tokens, place + 1, depth + 1)
        arguments.append(argument)
    wanted = _ARGUMENTS.get(name, 1)
    if len(arguments) != wanted:
        raise FormulaError(f"{name} takes {wanted} argument{'s' * (wanted > 1)}, not {len(arguments)}")
    return Call(name, tuple(arguments)), _require_closed(tokens, place)


def _require_closed(tokens: list[str], place: int) -> int:
    if place == len(tokens) or tokens[place] != ")":
        raise FormulaError("a bracket is not closed")
    return place + 1


def find_names_in(tree: Tree) -> tuple[str, ...]:
    """Return the names in a formula, each once, in their order."""
    if isinstance(tree, FormulaName):
        return (tree.text,)
    if isinstance(tree, Number):
        return ()
    return tuple(dict.fromkeys(name for each in tree.arguments for name in find_names_in(each)))


def find_calls_in(tree: Tree, operations: Collection[str]) -> Iterator[Call]:
    """Yield the calls of some operations in a formula, those of their arguments included."""
    if isinstance(tree, Call):
        if tree.operation in operations:
            yield tree
        for each in tree.arguments:
            yield from find_calls_in(each, operations)


def convert_formula_to_si(tree: Tree, units: Mapping[str, UnitOf]) -> tuple[Tree, Extent]:
    """Return a formula for values in SI, and what its value is made of.

    A bare number beside a name, as in ``axis_temperature - 20`` or ``P - 300``, is in the unit of the name.

    Raises `FormulaError` if quantities are added that cannot be, or a function takes none of its kind.
    """
    if isinstance(tree, Number):
        return tree, NUMBER
    if isinstance(tree, FormulaName):
        return tree, units[tree.text].extent
    inner = [convert_formula_to_si(each, units) for each in tree.arguments]
    trees, extents = tuple(each for each, _ in inner), [each for _, each in inner]
    operation = tree.operation
    if operation in {"+", "-", "min", "max"}:
        return _derive_alike(operation, trees, extents, units)
    return Call(operation, trees), _derive_extent(operation, trees, extents)


def _derive_extent(operation: str, trees: tuple[Tree, ...], extents: list[Extent]) -> Extent:
    """Return what the value of any other operation is made of."""
    if operation in {"*", "/"}:
        return extents[0].combine(extents[1], 1 if operation == "*" else -1)
    if operation in {"^", "sqrt"}:
        return _derive_raised(operation, trees, extents)
    if operation in _PURE and extents[0] != NUMBER:
        raise FormulaError(f"{operation} takes a number, not {extents[0]}; divide by a parameter of it")
    return extents[0] if operation in _LIKE_ITS_OWN else NUMBER


def _derive_raised(operation: str, trees: tuple[Tree, ...], extents: list[Extent]) -> Extent:
    if operation == "sqrt":
        return extents[0].raise_to(Fraction(1, 2))
    if extents[1] != NUMBER:
        raise FormulaError(f"a power is a number, not {extents[1]}")
    if extents[0] == NUMBER:
        return NUMBER
    power = _find_constant(trees[1])
    if power is None or not math.isfinite(power):
        raise FormulaError(f"a power of {extents[0]} must be written as a number")
    return extents[0].raise_to(Fraction(power).limit_denominator(64))


def _derive_alike(
    operation: str, trees: tuple[Tree, ...], extents: list[Extent], units: Mapping[str, UnitOf]
) -> tuple[Tree, Extent]:
    if extents[0] == extents[1]:
        return Call(operation, trees), extents[0]
    for bare, other in ((0, 1), (1, 0)):
        value = _find_constant(trees[bare])
        if value is None:
            continue
        named = trees[other]
        scale = units[named.text].per_si if isinstance(named, FormulaName) else 1.0
        if value == 0 or isinstance(named, FormulaName) or extents[other] in {TIME, TEMPERATURE}:
            pair = [trees[0], trees[1]]
            pair[bare] = Number(value / scale)
            return Call(operation, tuple(pair)), extents[other]
    raise FormulaError(
        f"{extents[0]} and {extents[1]} cannot be joined by {operation}; write a number as a parameter"
    )


def _find_constant(tree: Tree) -> float | None:
    return None if find_names_in(tree) else float(compute(tree, {}))


def compute(tree: Tree, values: Mapping[str, FloatArray | float]) -> FloatArray:
    """Return the value of a formula, an infinity or NaN where it has none."""
    if isinstance(tree, Number):
        return np.asarray(tree.value)
    if isinstance(tree, FormulaName):
        return np.asarray(values[tree.text], dtype=np.float64)
    with np.errstate(all="ignore"):
        return np.asarray(_compute_value(tree, values), dtype=np.float64)


def _compute_value(tree: Tree, values: Mapping[str, FloatArray | float]) -> FloatArray | float:
    if isinstance(tree, Number):
        return tree.value
    if isinstance(tree, FormulaName):
        return values[tree.text]
    return _OPERATIONS[tree.operation](*[_compute_value(each, values) for each in tree.arguments])


def substitute(tree: Tree, meanings: Mapping[str, Tree]) -> Tree:
    """Return a formula with what some of its names stand for in their places."""
    if isinstance(tree, FormulaName):
        return meanings.get(tree.text, tree)
    if isinstance(tree, Number):
        return tree
    return Call(tree.operation, tuple(substitute(each, meanings) for each in tree.arguments))


def simplify(tree: Tree) -> Tree:
    """Return a formula without sums with nothing, products with one, and what is multiplied with nothing."""
    if not isinstance(tree, Call):
        return tree
    arguments = tuple(map(simplify, tree.arguments))
    operation, nothing, one = tree.operation, Number(0.0), Number(1.0)
    if operation in {"*", "/"} and (arguments[0] == nothing or (operation == "*" and nothing in arguments)):
        return nothing
    neutral = {"*": one, "/": one, "+": nothing, "-": nothing}.get(operation)
    if len(arguments) > 1 and arguments[1] == neutral:
        return arguments[0]
    if operation in {"*", "+"} and arguments[0] == neutral:
        return arguments[1]
    return Call(operation, arguments)


def name_rates(tree: Tree) -> Tree:
    """Return a formula with the rate of each logged column as a name: ``rate(oil)``.

    Raises `FormulaError` if something else than a name has a rate.
    """
    if not isinstance(tree, Call):
        return tree
    if tree.operation != RATE:
        return Call(tree.operation, tuple(map(name_rates, tree.arguments)))
    (column,) = tree.arguments
    if not isinstance(column, FormulaName):
        raise FormulaError("a rate is that of a logged column, as in rate(axis_temperature)")
    return FormulaName(f"{RATE}({column.text})")


def find_column_of(name: str) -> str | None:
    """Return the column whose rate a name stands for; None of any other name.

    >>> find_column_of("rate(oil)"), find_column_of("oil")
    ('oil', None)
    """
    return name[len(RATE) + 1 : -1] if name.startswith(f"{RATE}(") else None


def write_out_waves(
    tree: Tree, orders: Sequence[int], parameters: Collection[str]
) -> tuple[Tree, dict[str, tuple[str, ...]]]:
    """Return a formula with each wave written out, and the parameters that took the place of its size.

    ``a*wave(x)`` is sine·sin(2πx) + cosine·cos(2πx), and so on for each harmonic: ``sine_2`` and ``cosine_2``
    of the second. So sizes are solved where amplitude and phase would have to be searched.

    Raises `FormulaError` if a wave is no factor of a term, or has not one parameter as its size.
    """
    if not any(find_calls_in(tree, {WAVE})):
        return tree, {}
    terms: list[tuple[Tree, ...]] = []
    parts: dict[str, tuple[str, ...]] = {}
    for term in split_terms_of(tree):
        waves = [each for each in term if isinstance(each, Call) and each.operation == WAVE]
        others = [each for each in term if each not in waves]
        if not waves and not any(call for each in others for call in find_calls_in(each, {WAVE})):
            terms.append(term)
            continue
        sizes = [each for each in others if isinstance(each, FormulaName) and each.text in parameters]
        if len(waves) != 1 or len(sizes) != 1 or parts:
            raise FormulaError("one wave may stand in it, beside one parameter as its size: a*wave(P/L)")
        others.remove(sizes[0])
        (turns,) = waves[0].arguments
        parts[sizes[0].text] = tuple(
            name if order == 1 else f"{name}_{order}" for order in orders for name in ("sine", "cosine")
        )
        for name in parts[sizes[0].text]:
            kind, _, order = name.partition("_")
            angle = Call("*", (Number(2 * np.pi * int(order or 1)), turns))
            terms.append((FormulaName(name), Call("sin" if kind == "sine" else "cos", (angle,)), *others))
    return _join_trees("+", [_join_trees("*", term) for term in terms]), parts


def _join_trees(operation: str, parts: Sequence[Tree]) -> Tree:
    return reduce(lambda one, other: Call(operation, (one, other)), parts)


def split_terms_of(tree: Tree) -> tuple[tuple[Tree, ...], ...]:
    """Return the products of which a formula is the sum, each by its factors."""
    if not isinstance(tree, Call) or tree.operation not in {"+", "-", "*", "/"}:
        return ((tree,),)
    one, other = tree.arguments
    if tree.operation == "/":
        return tuple((*term, Call("/", (Number(1.0), other))) for term in split_terms_of(one))
    if tree.operation == "*":
        return tuple((*mine, *its) for mine in split_terms_of(one) for its in split_terms_of(other))
    sign = (Number(-1.0),) if tree.operation == "-" else ()
    return (*split_terms_of(one), *((*sign, *term) for term in split_terms_of(other)))
