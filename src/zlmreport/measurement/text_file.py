"""Opens text files of measurements: encoding, largest size, longest line; refuses what is no text."""

from __future__ import annotations

import codecs
import difflib
import math
import re
import unicodedata
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path

from zlmreport.errors import AccessError, InputError, Place, Problem, describe_character, quoted, split_lines
from zlmreport.files import make_unreadable, read
from zlmreport.language.formatting import MINUS, DecimalSign
from zlmreport.measurement.provenance import SourceFile
from zlmreport.measurement.workbook import SEPARATOR, is_workbook, read_filled_sheets, read_sheet_lines

#: Of a measurement file, in bytes.
LARGEST = 64 * 1024 * 1024
_LARGEST_UNPACKED = 4 * LARGEST
#: A test of an axis has some hundred readings; continuous logs have more, and are no tests.
MOST_LINES = 250_000
LONGEST_LINE = 100_000

#: The first bytes of files that people take for tables.
_NO_TEXT = {
    b"\x1f\x8b": "a compressed file",
    b"PK\x03\x04": "an archive",
    b"\xd0\xcf\x11\xe0": "a workbook of old Excel, .xls",
    b"%PDF": "a PDF document",
}
#: Byte order marks; the longer one first where one begins like another.
_MARKS = {
    codecs.BOM_UTF32_LE: "utf-32",
    codecs.BOM_UTF32_BE: "utf-32",
    codecs.BOM_UTF16_LE: "utf-16",
    codecs.BOM_UTF16_BE: "utf-16",
}
#: µm, µ in brackets and °C as DOS wrote them.
_OF_DOS = (b"\xe6m", b"[\xe6", b"(\xe6", b"\xf8C", b"[\xf8", b"(\xf8")
#: Two characters in GB 2312 in a row; four letters with accents are none of any word.
_TWO_CHINESE = re.compile(rb"[\xb0-\xf7][\xa1-\xfe][\xb0-\xf7][\xa1-\xfe]")
#: Control characters, overrides of the writing direction, and separators that split lines where an editor
#: does not: with them a text reads otherwise than it is stored.
_UNSEEN = re.compile(
    "[\x00-\x08\x0b\x0c\x0e-\x1f\x7f-\x9f\u202a-\u202e\u2066-\u2069\u2028\u2029\ufeff\ud800-\udfff]"
)
#: A line below a header or a table, as in Markdown, that has nothing but strokes.
_RULE = re.compile(r"[\s|+:=-]*(?:---|===)[\s|+:=-]*")
#: Closes text files of DOS.
_END_OF_FILE = "\x1a"


#: What may part the cells of a table; the first of them that a header has does.
_DELIMITERS = ("\t", ";", ",")


@dataclass(frozen=True, slots=True)
class TextCell:
    """A cell of a table: its text without the blanks around, and its place."""

    text: str
    place: Place


@dataclass(frozen=True, slots=True)
class TextFile:
    """A text file that was read.

    Attributes
    ----------
    name
        The file as the job names it, for places in messages.
    lines
        Its lines without their ends; the first line of the file is ``lines[0]``.
    source
        Its name, digest and bytes, for the provenance.
    of_cells
        Whether the lines are the rows of a workbook, apart by tabs.
    """

    name: str
    lines: tuple[str, ...]
    source: SourceFile
    of_cells: bool = False

    def place(self, line: int = 0, column: int = 0) -> Place:
        """Return a place in this file, both from 1: line and character, in a workbook row and column."""
        if self.of_cells and column:
            column = self.lines[line - 1].count(SEPARATOR, 0, column - 1) + 1
        return Place(self.name, line, column)

    def numbered(self, first: int = 1, last: int | None = None) -> list[tuple[int, str]]:
        """Return lines with their numbers, from 1; without empty ones, rules, and those with ``#``."""
        lines = enumerate(self.lines[first - 1 : last], first)
        return [(number, line) for number, line in lines if not _is_passed_over(line.strip())]

    def rows(self) -> list[list[TextCell]]:
        """Return the cells of a table, the header first: tab, semicolon or comma parts them, as in that."""
        lines = self.numbered()
        delimiter = next((each for each in _DELIMITERS if lines and each in lines[0][1]), ",")
        return [list(self._split_cells(number, line, delimiter)) for number, line in lines]

    def _split_cells(self, number: int, line: str, delimiter: str) -> Iterator[TextCell]:
        start = 0
        for part in line.split(delimiter):
            lead = len(part) - len(part.lstrip())
            yield TextCell(part.strip(), self.place(number, start + lead + 1))
            start += len(part) + 1


def _is_passed_over(line: str) -> bool:
    return not line or line[0] == "#" or (line[0] in "|+:-=" and _RULE.fullmatch(line) is not None)


def read_text(
    path: Path, encoding: str | None = None, sheet: str | None = None, *, keeps_long_lines: bool = False
) -> TextFile:
    """Read a text file of measurements; a workbook is read as the lines of one sheet.

    Parameters
    ----------
    path
        The file.
    encoding
        As the job states it; None for UTF-8, with or without byte order mark.
    sheet
        Of a workbook: the name of the sheet; None for the only one that holds something.
    keeps_long_lines
        Whether lines that are too long are kept, for who tells them beside what else is wrong
        (`find_long_lines`).

    Raises
    ------
    AccessError
        If there is no such file, or it cannot be read.
    InputError
        If it is empty, too large, binary, or in another encoding, or has no such sheet; with the place, and
        with what would be right.
    """
    file = Place(str(path))
    content = _read_content(path, file)
    if not content.strip():
        raise InputError.at(file, "is empty; a measurement file holds readings")
    if is_workbook(content):
        rows = read_sheet_lines(content, file, _LARGEST_UNPACKED, sheet)
        return TextFile(file.file, tuple(rows), SourceFile.of(path, content), of_cells=True)
    if sheet is not None:
        raise InputError.at(file, "is no workbook, and the job names a sheet of it; remove 'sheet'")
    for beginning, kind in _NO_TEXT.items():
        if content.startswith(beginning):
            raise InputError.at(file, f"is {kind}, not text; export the readings as text (CSV, UTF-8)")
    text = _decode(content, file, encoding).rstrip(_END_OF_FILE)
    unseen = _UNSEEN.search(text)
    if unseen:
        is_named = unicodedata.name(unseen[0], "") != ""
        raise InputError.at(
            Place.of_next(text[: unseen.start()], file.file),
            f"{describe_character(unseen[0])}; "
            f"{'remove it' if is_named else 'is this a text file, and in the encoding that the job states?'}",
        )
    lines = split_lines(text)
    if not lines[-1]:
        lines.pop()
    _refuse_continuous_logs(lines, file)
    read = TextFile(file.file, tuple(lines), SourceFile.of(path, content))
    if not keeps_long_lines and (problems := [*find_long_lines(read)]):
        raise InputError(problems)
    return read


def find_long_lines(text: TextFile) -> Iterator[Problem]:
    """Yield the lines that are too long to be those of readings; rows of a workbook have no such limit."""
    for number, line in enumerate(() if text.of_cells else text.lines, 1):
        if len(line) > LONGEST_LINE:
            message = f"the line has {len(line)} characters; is this a file of readings?"
            yield Problem(text.place(number, LONGEST_LINE + 1), message)


def list_sheets_of(path: Path) -> tuple[str, ...]:
    """Return the names of the sheets of a workbook that hold something; none of any other file.

    Raises `AccessError` if it cannot be read, `InputError` if it is a damaged workbook.
    """
    file = Place(str(path))
    content = _read_content(path, file)
    return tuple(read_filled_sheets(content, file, _LARGEST_UNPACKED)) if is_workbook(content) else ()


def list_likely_encodings(path: Path) -> tuple[str | None, ...]:
    """Return the encodings that a file of text may have, the likeliest first; None for UTF-8.

    Raises `AccessError` if it cannot be read.
    """
    content = _read_content(path, Place(str(path)))
    wide = _find_wide_encoding(content)
    if wide:
        return (wide,)
    of_dos = any(sign in content for sign in _OF_DOS)
    of_europe = ("cp850", "cp1252") if of_dos else ("cp1252", "cp850")
    return (None, "gbk", *of_europe) if _is_perhaps_chinese(content) else (None, *of_europe)


def _is_perhaps_chinese(content: bytes) -> bool:
    """Return whether all that is not ASCII is of the usual Chinese characters (GB 2312), and makes words."""
    try:
        content.decode("gb2312")
    except UnicodeDecodeError:
        return False
    return _TWO_CHINESE.search(content) is not None


def require_known_encoding(name: str) -> str:
    """Return the name of an encoding of text; raise ValueError if there is none of that name."""
    try:
        b"\xff".decode(name, "replace")
    except (LookupError, ValueError) as error:
        raise ValueError(
            f"{quoted(name)} is no encoding of text; for example utf-8, utf-16, cp1252 or gbk"
        ) from error
    return name


def _read_content(path: Path, file: Place) -> bytes:
    try:
        content = read(path, LARGEST)
    except FileNotFoundError as error:
        raise AccessError.at(file, f"cannot be read: there is no such file{_find_nearest(path)}") from error
    except OSError as error:
        raise make_unreadable(path, error) from error
    if len(content) > LARGEST:
        raise InputError.at(
            file, "is longer than 64 MiB: name a file that holds the readings of one test only"
        )
    return content


def _find_nearest(path: Path) -> str:
    of_windows = Path(path.as_posix().replace("\\", "/"))
    if of_windows != path and of_windows.is_file():
        return "; write its folders with /"
    try:
        beside = {entry.name.casefold(): entry.name for entry in path.parent.iterdir() if entry.is_file()}
    except OSError:
        return f", and no folder {path.parent}"
    if path.is_symlink():
        return f": it is a link to {path.readlink()}, which is not there"
    nearest = difflib.get_close_matches(of_windows.name.casefold(), beside, n=1)
    return f"; did you mean {quoted(beside[nearest[0]])}?" if nearest else ""


def _decode(content: bytes, file: Place, encoding: str | None) -> str:
    """Return text; refuse that of two or four bytes a character, where the job does not say so."""
    if encoding is None:
        encoding = "utf-8"
        if wide := _find_wide_encoding(content):
            raise InputError.at(
                Place(file.file, 1, 1),
                f"is {wide[:6].upper()} text; save it as UTF-8, or say 'encoding: {wide}' in the job",
            )
    if codecs.lookup(encoding).name == "utf-8":
        content = content.removeprefix(codecs.BOM_UTF8)
    try:
        return content.decode(encoding)
    except UnicodeDecodeError as error:
        place = Place.of_next(content[: error.start].decode(encoding, "replace"), file.file)
        wrong = f"byte 0x{content[error.start]:02X} is not {encoding.upper()}"
        if b"\0" in content:
            raise InputError.at(
                place, f"{wrong}: this is no text file; export the readings as text"
            ) from error
        likely = "gbk" if _is_perhaps_chinese(content) else "cp1252"
        raise InputError.at(
            place,
            f"{wrong}; save the file as UTF-8, or name its encoding in the job, as in 'encoding: {likely}'",
        ) from error


def _find_wide_encoding(content: bytes) -> str | None:
    """Return the encoding of text of two or four bytes a character; None of any other content."""
    for mark, name in _MARKS.items():
        if content.startswith(mark):
            return name
    sample = content[:4096]
    first, second = sample[::2], sample[1::2]
    if second and first.count(0) == 0 and second.count(0) > 0.6 * len(second):
        return "utf-16-le"
    return "utf-16-be" if second and second.count(0) == 0 and first.count(0) > 0.6 * len(first) else None


def _refuse_continuous_logs(lines: list[str], file: Place) -> None:
    if len(lines) > MOST_LINES:
        raise InputError.at(
            Place(file.file, MOST_LINES + 1, 1),
            f"the file goes on for {len(lines)} lines, and measurement files are read up to {MOST_LINES}; "
            "is it a continuous log?",
        )


#: Characters of a number; 20 digits occur.
_LONGEST = 64
#: What a message answers to a word that stands for a missing reading.
_EMPTY_CELL = "a missing reading is an empty cell"

_PLAIN = {
    sign: re.compile(rf"[+-]?([0-9]+{re.escape(sign)}?[0-9]*|{re.escape(sign)}[0-9]+)([eE][+-]?[0-9]+)?")
    for sign in DecimalSign
}
_GROUPED = re.compile(r"[+-]?[0-9]{1,3}([.,'’ \u00a0\u202f])[0-9]{3}(\1[0-9]{3})*([.,][0-9]*)?")
_DIGITS = r"(\d+(?:[.,]\d+)?)"
#: Numbers as people and ledgers write them: the form, what it is like, and which number is meant.
_ALMOST: tuple[tuple[re.Pattern[str], str, Callable[[re.Match[str]], float]], ...] = (
    (
        re.compile(rf"([+-])\s+{_DIGITS}"),
        "has a blank behind its sign",
        lambda match: _read_signed(*match.groups()),
    ),
    (
        re.compile(rf"{_DIGITS}\s*([+-])"),
        "has its sign behind it",
        lambda match: _read_signed(match[2], match[1]),
    ),
    (
        re.compile(rf"\({_DIGITS}\)"),
        "stands in brackets, as a negative number does",
        lambda match: _read_signed("-", match[1]),
    ),
    (
        re.compile(r"([+-]?)(?:(\d{1,4})[ -])?(\d{1,2})/(2|4|8|16|32|64)\s*(?:\"|″|in|inch)?"),
        "is a fraction",
        lambda match: (
            _read_signed(match[1], match[2] or "0") + _read_signed(match[1], match[3]) / int(match[4])
        ),
    ),
)
_INFINITE = re.compile(r"[+-]?(inf|infinity|∞|1\.#inf)", re.IGNORECASE)
_NO_NUMBER = frozenset({"nan", "-nan", "na", "n/a", "#n/a", "null", "none", "-", "--", "---", "?"})


def parse_number(text: str, sign: DecimalSign = DecimalSign.POINT) -> float:
    """Return the number that a text writes.

    Parameters
    ----------
    text
        Digits, one decimal sign at most, an exponent if need be; ``-.0033`` and ``-1e-05`` are numbers.
    sign
        The decimal sign of the file.

    Raises
    ------
    ValueError
        With a sentence on what is wrong and what would be right: no number, an infinite number, thousands
        separators, the other decimal sign.
    """
    written = text.replace(MINUS, "-")
    if len(written) <= _LONGEST and _PLAIN[sign].fullmatch(written):
        value = float(written.replace(sign, "."))
        if math.isinf(value):
            raise ValueError(f"{quoted(text)} is too large to be a reading")
        return value
    raise ValueError(_say_wrong(text, written, sign))


def _read_signed(sign: str, digits: str) -> float:
    return (-1 if sign == "-" else 1) * float(digits.replace(",", "."))


def _say_wrong(text: str, written: str, sign: DecimalSign) -> str:
    shown = quoted(text)
    if len(written) > _LONGEST:
        return f"{shown} is too long to be a number"
    if written.casefold() in _NO_NUMBER:
        return f"{shown} is no number; {_EMPTY_CELL}"
    if _INFINITE.fullmatch(written):
        return f"{shown} is infinite, and no reading is; {_EMPTY_CELL}"
    other = DecimalSign.COMMA if sign is DecimalSign.POINT else DecimalSign.POINT
    if _PLAIN[other].fullmatch(written):
        right = quoted(text.replace(other, sign))
        return f"{shown} is no number with a decimal {sign.name.lower()}; write {right} if that is meant"
    if _GROUPED.fullmatch(written):
        return f"{shown} has thousands separators; write the digits without them"
    return f"{shown} {_say_almost(written, sign) or 'stands where a number belongs'}"


def _say_almost(written: str, sign: DecimalSign) -> str:
    """Say what a number is like that people read and programs do not; empty of anything else."""
    for form, what, number in _ALMOST:
        if match := form.fullmatch(written):
            right = f"{number(match):.9g}".replace(".", sign)
            return f"{what}; write {quoted(right)} if that is meant"
    return ""
