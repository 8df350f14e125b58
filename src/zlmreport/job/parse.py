"""Reads YAML with the place of each value; limits of size, hidden characters, messages on broken YAML.

Events are read one by one, so that what is too deep or too large is refused where it becomes so, before
it costs anything. No value is interpreted: YAML would take a serial number 00123 for 83, and ``no`` for
false.
"""

from __future__ import annotations

import codecs
import contextlib
import re
import unicodedata
from collections.abc import Callable, Iterator
from pathlib import Path
from types import MappingProxyType
from typing import Any

import yaml
from yaml import MarkedYAMLError

from zlmreport.errors import InputError, Place, Problem, describe_character, quoted
from zlmreport.job.tree import Items, KeyEntry, Keys, Node, Scalar

#: How the name of a YAML file ends, in small letters.
SUFFIXES = (".yaml", ".yml")
#: Of a job file, in bytes.
LARGEST = 1024 * 1024
#: Characters of one file that are complained of one by one.
_MOST_NAMED = 10

#: What nobody sees, so that two texts that differ in it look the same: Unicode's
#: Default_Ignorable_Code_Point, marks of annotations, and the blank of Braille.
_UNSEEN = (
    "\xad\u034f\u061c\u115f\u1160\u17b4\u17b5\u180b-\u180f\u200b-\u200f\u202a-\u202e\u2060-\u206f\u2800\u3164"
    "\ufe00-\ufe0f\ufeff\uffa0\ufff0-\ufffb\U0001bca0-\U0001bca3\U0001d173-\U0001d17a\U000e0000-\U000e0fff"
)
#: Control characters and lone surrogates, for which there is nothing to print; overrides and isolates of
#: the writing direction, with which a text reads otherwise than it is stored; separators that split lines
#: where an editor does not; and byte order marks in the middle, which nobody typed.
_HIDDEN = re.compile(f"[\x00-\x08\x0b\x0c\x0e-\x1f\x7f-\x9f\ud800-\udfff\u2028\u2029{_UNSEEN}]")
_INVISIBLE = re.compile(f"[{_UNSEEN}]")
_JOINERS = frozenset("\u200c\u200d")
#: Combining class of the sign that takes a vowel away, in scripts of India.
_VIRAMA = 9
_UTF16 = (codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE)

#: A job needs five levels, and some hundred values.
DEEPEST = 32
MOST_VALUES = 20_000

#: libyaml reads what is right five times as fast, and lets these pass where YAML forbids them.
_QUICK: Any = yaml.CSafeLoader if yaml.__with_libyaml__ else yaml.SafeLoader
_LET_PASS = frozenset("\t?")

_ADVICE = (
    "a file of keys says first what it is, as in 'schema: zlmreport/job/1' "
    "('zlmreport init DIR' writes a job to begin with)"
)


def is_named_as_yaml(path: Path) -> bool:
    """Whether a file is called as jobs and other files of keys are: in small letters or capitals.

    >>> is_named_as_yaml(Path("x-axis.YAML")), is_named_as_yaml(Path("x-axis.csv"))
    (True, False)
    """
    return path.suffix.casefold() in SUFFIXES


def decode(content: bytes, file: str) -> str:
    """Return the text of a job file.

    Raises `InputError` if it is not UTF-8, or holds characters that cannot be seen.
    """
    if len(content) > LARGEST:
        raise InputError.at(
            Place(file, 1, 1),
            "is larger than 1 MiB; a file of keys names the files that hold readings",
        )
    if content.startswith(_UTF16) or content[:2].count(0) == 1:
        raise InputError.at(Place(file, 1, 1), "is UTF-16; save it as UTF-8")
    content = content.removeprefix(codecs.BOM_UTF8)
    try:
        text = content.decode("utf-8")
    except UnicodeDecodeError as error:
        before = content[: error.start].decode("utf-8")
        raise InputError.at(
            Place.of_next(before, file),
            f"byte 0x{content[error.start]:02X} is not UTF-8; save the file as UTF-8",
        ) from error
    problems: list[Problem] = []
    for found in _find_hidden(text):
        place = Place.of_next(text[: found.start()], file)
        if len(problems) == _MOST_NAMED:
            problems.append(Problem(place, "and more of the kind; is this a text file?"))
            break
        problems.append(Problem(place, f"{describe_character(found[0])}; remove it"))
    if problems:
        raise InputError(problems)
    return text


def list_invisible(text: str) -> list[str]:
    """Return the characters of a text that nobody sees, whatever they do."""
    return _INVISIBLE.findall(text)


def _find_hidden(text: str) -> Iterator[re.Match[str]]:
    """Return the characters of a text that cannot be printed or seen."""
    return (found for found in _HIDDEN.finditer(text) if not _is_joining(text, found.start()))


def _is_joining(text: str, place: int) -> bool:
    """Whether a joiner is where a script needs one: it changes letters that everybody sees (RFC 5892, A)."""
    if text[place] not in _JOINERS or not 0 < place < len(text) - 1:
        return False
    before, behind = text[place - 1], text[place + 1]
    is_between_letters = all(unicodedata.bidirectional(each) == "AL" for each in (before, behind))
    return unicodedata.combining(before) == _VIRAMA or is_between_letters


def parse(content: bytes, file: str, *, strictly: bool = True) -> Keys:
    """Return the keys of a job file.

    `strictly`: Whether a tab or a question mark at a place where YAML forbids it is refused; a catalogue of
        effects, which asks many questions, is read five times as fast if not.

    Raises `InputError` with every mistake that does not hide the rest of the file.
    """
    text = decode(content, file)
    if not strictly or _LET_PASS.isdisjoint(text):
        reader = _Reader(_QUICK(text), file)
        with contextlib.suppress(
            yaml.YAMLError, ValueError, OverflowError, InputError
        ):  # which are told below
            root = reader.read_document()
            if isinstance(root, Keys) and not reader.problems:
                return Keys(Place(file, 1, 1), root.entries)
    reader = _Reader(yaml.SafeLoader(text), file)
    try:
        root = reader.read_document()
    except yaml.MarkedYAMLError as error:
        raise InputError([*reader.problems, _make_complaint(error, file)]) from error
    except (ValueError, OverflowError) as error:  # of an escape or a version beyond all bounds
        raise InputError([*reader.problems, reader.find_stuck()]) from error
    if not isinstance(root, Keys):
        reader.problems.append(Problem(Place(file, 1, 1), _say_no_keys(root)))
    if reader.problems or not isinstance(root, Keys):
        raise InputError(reader.problems)
    return Keys(Place(file, 1, 1), root.entries)


def _say_no_keys(root: Node | None) -> str:
    if root is None or (isinstance(root, Scalar) and root.is_nothing):
        return f"is empty; {_ADVICE}"
    found = "a list" if isinstance(root, Items) else "a text"
    return f"is {found}; {_ADVICE}"


class _Reader:
    """Reads one document; `problems` holds the mistakes that need not end the reading."""

    def __init__(self, parser: Any, file: str) -> None:
        self.problems: list[Problem] = []
        self._parser = parser
        #: Returns the next event; which kinds may come, the parser's grammar says, and no type.
        self._take_next: Callable[[], Any] = parser.get_event
        self._file = file
        self._values = 0
        self._anchors: dict[str, tuple[Node, int] | None] = {}

    def read_document(self) -> Node | None:
        """Return the document's value; None if there is no document."""
        root = None
        documents = 0
        while self._parser.check_event():
            event = self._take_next()
            if isinstance(event, yaml.DocumentStartEvent):
                documents += 1
                if documents > 1:
                    self._refuse(event, "a second document begins here; a job is one: remove the line ---")
                    break
                root = self._read_node(self._take_next(), 0)
        return root

    def find_stuck(self) -> Problem:
        """Return the problem of a character that the parser cannot get past."""
        return Problem(_find_place_of(self._parser.get_mark(), self._file), _NOT_YAML)

    def _read_node(self, event: Any, depth: int) -> Node:
        if isinstance(event, yaml.AliasEvent):
            return self._find_aliased(event)
        if depth > DEEPEST:
            raise self._make_error(event, f"is nested deeper than {DEEPEST} levels")
        self._count(event, 1)
        if event.tag is not None:
            self._refuse(event, f"a job uses no tags (here {event.tag}); put a text in quotes instead")
        before = self._values
        if event.anchor:
            self._anchors[event.anchor] = None
        node: Node
        if isinstance(event, yaml.MappingStartEvent):
            node = self._read_keys(event, depth)
        elif isinstance(event, yaml.SequenceStartEvent):
            node = self._read_items(event, depth)
        else:
            node = self._read_scalar(event)
        if event.anchor:
            self._anchors[event.anchor] = (node, self._values - before + 1)
        return node

    def _read_scalar(self, event: yaml.ScalarEvent) -> Scalar:
        for unseen in _find_hidden(event.value):
            self._refuse(event, f"{describe_character(unseen[0])} in a text; remove it")
            break
        return Scalar(_find_place_of(event.start_mark, self._file), event.value, plain=not event.style)

    def _read_items(self, start: yaml.Event, depth: int) -> Items:
        items = []
        while not isinstance(event := self._take_next(), yaml.SequenceEndEvent):
            items.append(self._read_node(event, depth + 1))
        return Items(_find_place_of(start.start_mark, self._file), tuple(items))

    def _read_keys(self, start: yaml.Event, depth: int) -> Keys:
        entries: dict[str, KeyEntry] = {}
        while not isinstance(event := self._take_next(), yaml.MappingEndEvent):
            key = self._read_node(event, depth + 1)
            value = self._read_node(self._take_next(), depth + 1)
            if not isinstance(key, Scalar):
                self._refuse(event, "a key is a plain word, not a group or a list")
            elif key.text == "<<":
                self._refuse(event, "'<<' is not used in a job; shared keys come from a file by 'extends'")
            elif key.text in entries:
                first = entries[key.text].place.line
                self._refuse(event, f"{quoted(key.text)} stands in line {first} already; remove one of them")
            else:
                if isinstance(value, Scalar) and value.plain and not value.text:
                    value = Scalar(key.place, "")
                entries[key.text] = KeyEntry(key.text, key.place, value)
        return Keys(_find_place_of(start.start_mark, self._file), MappingProxyType(entries))

    def _find_aliased(self, event: yaml.AliasEvent) -> Node:
        if event.anchor not in self._anchors:
            raise self._make_error(
                event, f"*{event.anchor} names nothing that stands above it; put a text in quotes"
            )
        anchored = self._anchors[event.anchor]
        if anchored is None:
            raise self._make_error(event, f"*{event.anchor} stands inside the value that it names")
        node, size = anchored
        self._count(event, size)
        return node

    def _count(self, event: yaml.Event, values: int) -> None:
        self._values += values
        if self._values > MOST_VALUES:
            raise self._make_error(
                event, f"the file comes to more than {MOST_VALUES} values here; a job has about 50"
            )

    def _refuse(self, event: yaml.Event, message: str) -> None:
        self.problems.append(Problem(_find_place_of(event.start_mark, self._file), message))

    def _make_error(self, event: yaml.Event, message: str) -> InputError:
        return InputError([*self.problems, Problem(_find_place_of(event.start_mark, self._file), message)])


_NOT_YAML = "is not YAML from here on; compare with the lines above"

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


def _make_complaint(error: MarkedYAMLError, file: str) -> Problem:
    problem = str(error.problem)
    line = error.context_mark.line + 1 if error.context_mark else 0
    unclosed = error.context_mark if "found unexpected" in problem else None
    mark = unclosed or error.problem_mark
    for pattern, sentence in _COMPLAINTS:
        found = re.search(pattern, problem)
        if found:
            message = sentence.format(found=found[1] if found.groups() else "", line=line)
            return Problem(_find_place_of(mark, file), message)
    return Problem(_find_place_of(mark, file), _NOT_YAML)


def _find_place_of(mark: Any, file: str) -> Place:
    return Place(file, mark.line + 1, mark.column + 1) if mark else Place(file, 1, 1)
