"""Refuses a style sheet or templates of a laboratory's own of which WeasyPrint ignores something."""

from __future__ import annotations

import logging
import re
from collections.abc import Iterator
from contextlib import contextmanager

from weasyprint import LOGGER

from zlmreport.plugin import InputError, Place, Problem
from zlmreport.plugin.renderer import Look

_AT = re.compile(r" at (\d+):(\d+)")
_SELECTOR = re.compile(r"Invalid or unsupported selector, '(.*)'", re.DOTALL)
_REMEDY = "mend it, or put what is for screens alone into @media screen"


@contextmanager
def refuse_ignored_rules(look: Look, style: str) -> Iterator[None]:
    """Refuse a style sheet of which WeasyPrint warns while it is parsed: each warning at its line.

    `style`: What is parsed: the style sheet at its end.
    """
    with _listen() as told:
        yield
    sheet, problems = look.style_sheet, []
    if sheet is None:
        return
    lines_before = style.removesuffix(sheet.text).count("\n")
    for warning in told:
        selector, at = _SELECTOR.fullmatch(warning), _AT.search(warning)
        if selector and selector[1] in sheet.text:
            place = Place.of_next(sheet.text[: sheet.text.index(selector[1])], sheet.path)
        else:
            place = Place(sheet.path, int(at[1]) - lines_before, int(at[2])) if at else Place(sheet.path)
        said = _AT.sub("", warning).rstrip(".")
        problems.append(Problem(place, f"this style sheet does not work: {said}; {_REMEDY}"))
    if problems:
        raise InputError(dict.fromkeys(problems))


@contextmanager
def refuse_unfit_look(look: Look) -> Iterator[None]:
    """Refuse templates and a style sheet of a laboratory's own of which no pages can be made as they say."""
    if not look.templates:
        yield
        return
    with _listen() as told:
        try:
            yield
        except (ArithmeticError, AssertionError, LookupError, RecursionError, TypeError) as error:
            message = (
                f"no page can be set by these templates and their style sheet ({type(error).__name__} in "
                "WeasyPrint); is there room for text on a page, with its size and its margins?"
            )
            raise InputError.at(look.place, message) from error
    if told:
        raise InputError.at(look.place, f"these templates do not work: {'; '.join(dict.fromkeys(told))}")


@contextmanager
def _listen() -> Iterator[list[str]]:
    """Collect what WeasyPrint warns of."""
    told: list[str] = []
    listener = logging.Handler(logging.WARNING)
    listener.emit = lambda record: told.append(record.getMessage())  # type: ignore[method-assign]
    LOGGER.addHandler(listener)
    try:
        yield told
    finally:
        LOGGER.removeHandler(listener)
