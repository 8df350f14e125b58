"""What every check of an answer is made of: refuses what is not of a kind, of a shape, or no number."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np

from zlmreport.language import Language, Words
from zlmreport.plugin.boundary import Guarded, Unacceptable

if TYPE_CHECKING:
    from zlmreport.measurement.arrays import FloatArray

#: Takes the guarded object, its answer and what was asked; returns what is handed on.
Accept: TypeAlias = Callable[..., Any]

_DOUBLE = np.dtype(np.float64)


def require_real(values: Any, shape: tuple[int, ...], what: str) -> FloatArray:
    """Return numbers as doubles; refuse what is none, complex, infinite, or of another shape."""
    # First the usual answers, in a hurry: one value, or an array in which nothing is amiss.
    if type(values) is np.float64 and not shape and not math.isinf(values):
        return values  # type: ignore[return-value]
    is_as_expected = type(values) is np.ndarray and values.dtype is _DOUBLE and values.shape == shape
    if is_as_expected and math.isfinite(np.add.reduce(values, None)):
        return values  # type: ignore[no-any-return]
    array = require_numbers(values, what)
    if array.shape != shape:
        raise Unacceptable(f"gives {what} of the shape {array.shape}; {shape} is expected")
    if np.isinf(array).any():
        raise Unacceptable(f"gives {what} that is infinite; NaN stands for what is not defined")
    return array


def require_numbers(values: Any, what: str) -> FloatArray:
    """Return numbers as doubles; refuse what is none, or complex."""
    try:
        array = np.asarray(values)
    except ValueError as error:
        raise Unacceptable(f"gives {what} that is no array: {error}") from None
    if array.dtype.kind not in "iuf":
        named = "complex" if array.dtype.kind == "c" else f"{type(values).__name__} and no number"
        raise Unacceptable(f"gives {what} that is {named}; a real number is expected")
    return array if array.dtype == _DOUBLE else array.astype(np.float64)


def require_finite(values: Any, shape: tuple[int, ...], what: str) -> FloatArray:
    """Return numbers as doubles, as `require_real`; refuse NaN too."""
    array = require_real(values, shape, what)
    if not math.isfinite(np.add.reduce(array, None)) and np.isnan(array).any():
        raise Unacceptable(f"gives {what} that is NaN; a number is expected")
    return array


def require_kind(kind: type, answer: Any) -> Any:
    """Return an answer that is of a kind; refuse any other."""
    if not isinstance(answer, kind):
        raise Unacceptable(f"returns {name_answer(answer)}; {kind.__name__} is expected")
    return answer


def require_sayable(answer: Any, what: str) -> Words:
    """Return words that can be said in every language; refuse others, and such as lack a value."""
    words: Words = require_kind(Words, answer)
    if names := words.list_unfilled():
        missing, given = (", ".join(form.format(each) for each in names) for form in ("{{{}}}", "{}=…"))
        message = f"no value for {missing}; say Words(…).given({given})"
        raise Unacceptable(f"returns words with empty places, {what}: {message}")
    for language in Language:
        try:
            words.in_language(language)
        except (KeyError, IndexError, ValueError) as error:
            wrong = f"no value for {{{error.args[0]}}}" if isinstance(error, KeyError) else str(error)
            message = f"returns words that cannot be said in {language.value}, {what}: {wrong}"
            raise Unacceptable(message) from None
    return words


def name_answer(answer: object) -> str:
    """Return what messages call an answer that is of another kind."""
    return "nothing" if answer is None else f"an object of type {type(answer).__name__}"


def require_all_of(kind: type, answer: Any) -> tuple[Any, ...]:
    """Return everything of an iterable; refuse one with something else in it."""
    if not isinstance(answer, Iterable) or isinstance(answer, str | bytes):
        raise Unacceptable(f"returns {name_answer(answer)}; several {kind.__name__} are expected")
    found = tuple(answer)
    for each in found:
        if not isinstance(each, kind):
            raise Unacceptable(f"returns {name_answer(each)} among others; each must be {kind.__name__}")
    return found


def accept_all_of(kind: type) -> Accept:
    """Return what takes several answers of a kind, all of them now: a generator would run elsewhere."""

    def accept(_plugin: Guarded, answer: Any, *_: Any, **__: Any) -> tuple[Any, ...]:
        return require_all_of(kind, answer)

    return accept


def accept_one_or_none(kind: type) -> Accept:
    """Return what takes an answer of a kind, or None, and refuses any other."""

    def accept(_plugin: Guarded, answer: Any, *_: Any, **__: Any) -> Any:
        return answer if answer is None else require_kind(kind, answer)

    return accept
