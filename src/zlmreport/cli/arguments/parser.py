"""The parser of every command; options that hold positions, settings or ports; and its messages."""

from __future__ import annotations

import argparse
import math
import re
import textwrap
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path
from typing import Any, NoReturn

from zlmreport.errors import InputError, Place, did_you_mean, quoted

JSON_HELP = "print a machine-readable summary (zlmreport/summary/1) instead of tables"
#: Of a port, or of a count.
WHOLE_NUMBER = re.compile("[0-9]{1,9}")


#: Letters of a line of prose, however wide the terminal.
_LONGEST_LINE = 100
#: What begins a row of a list: a word, and at least two blanks behind it.
_LISTED = re.compile(r" +\S+(?: \S+)*? {2,}(?=\S)")
_COMMAND = re.compile(r" +zlmreport ")
#: An option before its value, and the blank that keeps them in a line.
_OPTION, _HELD = re.compile(r"( -\S+) (?=[^- ])"), "\N{NO-BREAK SPACE}"
#: By what a shell takes the next line for the same command.
_GOES_ON = " \\"


class HelpFormatter(argparse.HelpFormatter):
    """Sets paragraphs, lists and commands of a help in lines that the terminal has."""

    def _fill_text(self, text: str, width: int, indent: str) -> str:
        """Return a description, or what stands at the end of a help."""
        room = min(width, _LONGEST_LINE) - len(indent)
        lines = (line for part in _join_paragraphs(text.strip()) for line in _wrap_part(part, room))
        return "\n".join(indent + line for line in lines)


def _join_paragraphs(text: str) -> Iterator[str]:
    """Yield paragraphs, each in one line, and every line that is empty or indented as it is."""
    paragraph: list[str] = []
    for line in text.splitlines():
        if line and not line.startswith(" "):
            paragraph.append(line)
            continue
        if paragraph:
            yield " ".join(paragraph)
        paragraph = []
        yield line
    if paragraph:
        yield " ".join(paragraph)


def _wrap_part(part: str, room: int) -> list[str]:
    """Return a paragraph, a row of a list or a command in lines of so many letters."""
    if _COMMAND.match(part):
        held = _OPTION.sub(rf"\1{_HELD}", part)
        lines = [line.replace(_HELD, " ") for line in _wrap(held, room - len(_GOES_ON), "      ")]
        return [*(f"{line}{_GOES_ON}" for line in lines[:-1]), lines[-1]]
    listed = _LISTED.match(part)
    return _wrap(part, room, " " * (listed.end() if listed else len(part) - len(part.lstrip()))) or [""]


def _wrap(text: str, room: int, further: str) -> list[str]:
    return textwrap.wrap(
        text, room, subsequent_indent=further, break_long_words=False, break_on_hyphens=False
    )


class CommandParser(argparse.ArgumentParser):
    """A parser whose errors are problems like all others, and name the nearest option."""

    def __init__(self, command: str, description: str, epilog: str = "") -> None:
        super().__init__(
            f"zlmreport {command}".rstrip(),
            description=description,
            epilog=epilog,
            formatter_class=HelpFormatter,
            allow_abbrev=False,
        )
        self._known = ["--help"]
        self.add_repeated(
            "--plugin", "FILE", Path, "a plugin in a file of its own, beside the installed ones"
        )
        self.add_argument(
            "--confine",
            metavar="DIR",
            type=_take_folder,
            help="read and write nothing outside of this folder, whatever jobs and links in it name",
        )

    def add_argument(self, *names: Any, **settings: Any) -> argparse.Action:
        """Add an argument, and remember its long names."""
        action = super().add_argument(*names, **settings)
        if hasattr(self, "_known"):
            self._known.extend(name for name in names if name.startswith("--"))
        return action

    def add_flag(self, name: str, meaning: str) -> None:
        """Add an option that is there or is not."""
        self.add_argument(name, action="store_true", help=meaning)

    def add_repeated(self, name: str, metavar: str, read: Callable[[str], Any], meaning: str) -> None:
        """Add an option that may be given several times; without it, its values are an empty list."""
        meaning = f"{meaning}; may be given several times"
        self.add_argument(name, metavar=metavar, type=read, action="append", default=[], help=meaning)

    def add_output(self, metavar: str, meaning: str) -> None:
        """Add the option that says where to write."""
        self.add_argument("-o", "--output", metavar=metavar, type=Path, help=meaning)

    def parse_strictly(self, arguments: Sequence[str]) -> argparse.Namespace:
        """Return the options; raise `InputError` for one that there is not, with the nearest."""
        options, unknown = self.parse_known_args(arguments)
        if unknown:
            name = unknown[0].partition("=")[0]
            meant = next((each for each in self._known if len(name) == 2 and each[1:3] == name), "")
            if meant:
                self.error(f"unknown option {name!r}; did you mean {meant!r}?")
            if name.startswith("-"):
                self.error(f"unknown option {name!r}; {did_you_mean(name, self._known)}")
            self.error(f"{name!r} is one argument too many")
        return options

    def error(self, message: str) -> NoReturn:
        """Raise what argparse complains of as a problem of the command line."""
        raise InputError.at(Place(self.prog), f"{message} (see {self.prog} --help)")


def add_jobs(parser: CommandParser) -> None:
    """Let a command take one job file or several."""
    parser.add_argument("jobs", metavar="JOB.yaml", nargs="+", type=Path, help="job files")


def _take_folder(text: str) -> Path:
    path = Path(text)
    if not path.is_dir():
        raise argparse.ArgumentTypeError(f"{quoted(text)} is no folder")
    return path


def read_setting(text: str) -> tuple[str, str]:
    """Read a key and its value."""
    key, sign, value = text.partition("=")
    if not (key and sign and value):
        raise argparse.ArgumentTypeError(f"{quoted(text)} sets nothing; write KEY=VALUE, such as type=1")
    return key, value


def read_course(text: str) -> tuple[float, ...]:
    """Read positions, parted by commas."""
    return tuple(read_position(part) for part in text.split(","))


def read_port(text: str) -> int:
    """Read the number of a TCP port."""
    if WHOLE_NUMBER.fullmatch(text) and int(text) < 65_536:
        return int(text)
    raise argparse.ArgumentTypeError(
        f"{quoted(text)} is no TCP port; write a number up to 65535, such as 9090"
    )


def read_position(text: str) -> float:
    """Read a position."""
    return _read_finite(text, "position; write a number, such as 250")


def read_number(text: str) -> float:
    """Read a distance or a time."""
    return _read_finite(text, "number; write one, such as 5")


def _read_finite(text: str, wanted: str) -> float:
    try:
        number = float(text)
    except ValueError:
        number = math.nan
    if not math.isfinite(number):
        raise argparse.ArgumentTypeError(f"{quoted(text)} is no {wanted}")
    return number


def read_point(text: str) -> tuple[float, float]:
    """Read two positions, parted by a comma."""
    along, _, across = text.partition(",")
    try:
        point = float(along), float(across)
    except ValueError:
        point = math.nan, math.nan
    if not all(map(math.isfinite, point)):
        raise argparse.ArgumentTypeError(
            f"{quoted(text)} is no point; write two positions in mm, such as 250,130"
        )
    return point
