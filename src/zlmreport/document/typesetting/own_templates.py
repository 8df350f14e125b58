"""Templates of a laboratory's own: what is wrong in one is told at its line, and none works for ever."""

from __future__ import annotations

import re
import sys
import traceback
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from types import FrameType
from typing import Any
from xml.etree import ElementTree as ET

from jinja2 import (
    Environment,
    StrictUndefined,
    TemplateError,
    TemplateNotFound,
    TemplateSyntaxError,
    UndefinedError,
)
from jinja2.exceptions import SecurityError
from jinja2.sandbox import ImmutableSandboxedEnvironment
from jinja2.utils import missing

from zlmreport.document.certificate.document import STYLE_SHEET, OwnTemplate
from zlmreport.document.certificate.own_look import TEMPLATES
from zlmreport.errors import InputError, Place, did_you_mean

#: Lines of a template's code that are run for one block: a table of ten thousand readings takes a tenth.
MOST_STEPS = 5_000_000
#: Letters of a text, items of a list or bits of a number that a product or a power may have.
_LARGEST = 1_000_000


class LackingValue(StrictUndefined):
    """A value that a template asks for and that is not there; it is told what there is."""

    @property
    def _undefined_message(self) -> str:
        if self._undefined_hint or self._undefined_obj is missing:
            return super()._undefined_message
        name, holder = str(self._undefined_name), self._undefined_obj
        known = [each for each in dir(holder) if not each.startswith("_")]
        return f"{name!r} is nothing that this value has; {did_you_mean(name, known)}"


class BoundedEnvironment(ImmutableSandboxedEnvironment):
    """A sandbox in which a product or a power fills no memory."""

    intercepted_binops = frozenset({"*", "**"})

    def call_binop(self, context: Any, operator: str, left: Any, right: Any) -> Any:
        """Return a product or a power, unless it is far too large."""
        if operator == "**" and isinstance(left, int) and isinstance(right, int):
            size = left.bit_length() * max(right, 0)
        else:
            size = max(_measure_product(left, right), _measure_product(right, left))
        if size > _LARGEST:
            raise SecurityError(f"the result of {operator} is too large")
        return super().call_binop(context, operator, left, right)


def _measure_product(repeated: object, times: object) -> int:
    return len(repeated) * times if isinstance(repeated, Sequence) and isinstance(times, int) else 0


def render_own(
    template: OwnTemplate, own: Sequence[OwnTemplate], environment: Environment, values: Mapping[str, Any]
) -> str:
    """Return what a template of a laboratory's own writes.

    `own`: All of them: one may include another.

    Raises `InputError` at its line if it does not work, or does not come to an end.
    """
    paths = frozenset(each.path for each in own)
    try:
        with _count_steps(paths):
            return environment.get_template(template.name).render(values)
    except (TemplateError, ArithmeticError, RecursionError, TypeError, ValueError, MemoryError) as error:
        place = _find_place(error, paths) or Place(template.path)
        raise InputError.at(place, f"this template does not work: {_say_wrong(error, values)}") from error


@contextmanager
def _count_steps(paths: frozenset[str]) -> Iterator[None]:
    """Count the lines that templates run, and end one that would go on for ever."""
    steps, before = 0, sys.gettrace()

    def count(frame: FrameType, event: str, _: object) -> Callable[..., Any] | None:
        nonlocal steps
        if frame.f_code.co_filename not in paths:
            return None
        steps += event == "line"
        if steps > MOST_STEPS:
            raise SecurityError(f"it has not come to its end after {MOST_STEPS} steps")
        return count

    sys.settrace(count)
    try:
        yield
    finally:
        sys.settrace(before)


def _find_place(error: BaseException, paths: frozenset[str]) -> Place | None:
    """Return the line of a template of the laboratory's own in which something went wrong."""
    if isinstance(error, TemplateSyntaxError) and error.filename in paths:
        return Place(error.filename, error.lineno)
    lines = [
        (frame.f_code.co_filename, line)
        for frame, line in traceback.walk_tb(error.__traceback__)
        if frame.f_code.co_filename in paths
    ]
    return Place(*lines[-1]) if lines else None


def _say_wrong(error: BaseException, values: Mapping[str, Any]) -> str:
    if isinstance(error, TemplateNotFound):
        blocks = [each for each in TEMPLATES if each != STYLE_SHEET]
        known = (*blocks, *(f"usual/{each}" for each in blocks))
        return f"there is no template {str(error)!r}; {did_you_mean(str(error), known)}"
    name = re.fullmatch(r"'(\w+)' is undefined", str(error))
    if isinstance(error, UndefinedError) and name:
        return f"{name[1]!r} is not given here; {did_you_mean(name[1], [*values])}"
    if isinstance(error, RecursionError):
        return "it uses itself without end"
    return str(error) or type(error).__name__


def demand_xhtml(template: OwnTemplate, written: str) -> None:
    """Refuse what a template writes if it is no XHTML."""
    try:
        ET.fromstring(f"<block>\n{written}\n</block>")  # noqa: S314 - the job's own
    except ET.ParseError as error:
        what, lines, row = str(error).partition(":")[0], written.split("\n"), error.position[0] - 2
        wrong = (
            f"{what} in {lines[row].strip()[:80]}" if row in range(len(lines)) else "an element is not closed"
        )
        message = f"this template does not work: what it writes is no XHTML: {wrong}"
        raise InputError.at(Place(template.path), message) from error
