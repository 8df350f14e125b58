"""What is wrong with text that is not YAML, said in the words of its writer and not of a parser."""

from __future__ import annotations

import re
from typing import Any

from yaml import MarkedYAMLError

from zlmreport.errors import Place, Problem

NOT_YAML = "is not YAML from here on; compare with the lines above"

_SINGLE_QUOTES = "use single quotes, which keep a backslash as it is"
#: A parser's complaint, and ours; {found} is what the pattern's group found, and {line} where it began.
_COMPLAINTS = (
    (r"found character '(\\t)' that", "a tab cannot indent; use spaces"),
    (r"found character '(.)' that", "a value cannot begin with {found}; put it in quotes: '{found}…'"),
    (
        r"mapping values are not allowed here",
        "a colon is not expected here; put a text that holds ': ' in quotes, or mend the indentation",
    ),
    (r"could not find expected ':'", "a key needs a colon and a space after it: 'key: value'"),
    (
        r"found unknown escape character '(.+)'",
        f"\\{{found}} means nothing in double quotes; {_SINGLE_QUOTES}",
    ),
    (r"expected escape sequence of", f"unfinished \\x, \\u or \\U in double quotes; {_SINGLE_QUOTES}"),
    (
        r"found unexpected (?:end of stream|document separator)",
        "the quotation mark that opens here is never closed",
    ),
    (
        r"expected ',' or '([\]}])'",
        "the bracket of line {line} is still open, and a comma or {found} is expected here",
    ),
    (r"entries are not allowed", "a list item is not expected here; mend the indentation"),
    (r"mapping keys are not allowed", "a key is not expected here; mend the indentation"),
    (
        r"expected <block end>, but found '<scalar>'",
        "is out of place: a text in quotes ends at its closing quotation mark",
    ),
    (
        r"expected <block end>",
        "does not fit the indentation of the lines above; keys of one group begin in one column",
    ),
    (r"expected the node content", "a value is expected here"),
    (
        r"indentation indicator|comment or a line break",
        "after | or > nothing may follow in the line; the text begins in the next one",
    ),
    (r"tag", "a job uses no tags (!…); put a text that begins with ! in quotes"),
    (r"directive|YAML document|document start", "a job uses no directives (%…); remove it"),
    (r"alphabetic or numeric", "a value that begins with & or * belongs in quotes"),
)


def complaint(error: MarkedYAMLError, file: str) -> Problem:
    """Return the problem that a parser's error stands for."""
    problem = str(error.problem)
    line = error.context_mark.line + 1 if error.context_mark else 0
    unclosed = error.context_mark if "found unexpected" in problem else None
    mark = unclosed or error.problem_mark
    for pattern, sentence in _COMPLAINTS:
        found = re.search(pattern, problem)
        if found:
            message = sentence.format(found=found[1] if found.groups() else "", line=line)
            return Problem(place(mark, file), message)
    return Problem(place(mark, file), NOT_YAML)


def place(mark: Any, file: str) -> Place:
    """Return the place of a parser's mark."""
    return Place(file, mark.line + 1, mark.column + 1) if mark else Place(file, 1, 1)
