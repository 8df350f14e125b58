"""Errors as users read them: file:line:column, value, what would be right, “did you mean”; exit codes."""

from __future__ import annotations

import difflib
import re
import traceback
import unicodedata
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

#: Exit codes of what was done, and is not as it should be; those of errors stand with their classes.
NOT_MET = 1  #: A stated limit or a forecast is not met; what a certificate says does not hold.
INCOMPLETE = 4  #: Of a fleet: jobs failed, or something is not there that should be.
UNDECIDED = 5  #: Something of a certificate could not be compared.

#: Letters of a foreign text that a message shows.
_LONGEST_QUOTE = 60


@dataclass(frozen=True, slots=True, order=True)
class Place:
    """A place in a file: lines and columns count from 1; 0 where there is none to name."""

    file: str
    line: int = 0
    column: int = 0

    @classmethod
    def of_next(cls, text: str, file: str) -> Place:
        """Return the place of the character that follows a text from the beginning of a file."""
        lines = split_lines(text)
        return cls(file, len(lines), len(lines[-1]) + 1)

    def __str__(self) -> str:
        """Return ``file:line:column``, as editors and compilers write it."""
        if not self.line:
            return self.file
        return f"{self.file}:{self.line}:{self.column or 1}"


#: The place of a problem of which nobody knows yet for which job the work was done.
NOWHERE = Place("zlmreport")


@dataclass(frozen=True, slots=True, order=True)
class Problem:
    """One mistake: its place, and a sentence that says what is wrong and what would be right."""

    place: Place
    message: str

    def __str__(self) -> str:
        """Return the line that the user reads."""
        return f"{self.place}: {self.message}"


class ZlmreportError(Exception):
    """Anything that ends the work with a message instead of a traceback.

    Parameters
    ----------
    problems
        Everything that was found, so that the user mends it in one go.
    """

    exit_code = 2

    def __init__(self, problems: Iterable[Problem]) -> None:
        self.problems: tuple[Problem, ...] = tuple(problems)
        super().__init__("\n".join(write_problems(self.problems)))

    def __reduce__(self) -> tuple[type[ZlmreportError], tuple[tuple[Problem, ...]]]:
        """Let the error reach another process as it is."""
        return type(self), (self.problems,)

    @classmethod
    def at(cls, place: Place, message: str) -> ZlmreportError:
        """Return the error for a single problem."""
        return cls([Problem(place, message)])

    def of_job(self, job: Path) -> ZlmreportError:
        """Return the same with the job as the place of what has none of its own."""
        if all(problem.place != NOWHERE for problem in self.problems):
            return self
        place = Place(str(job))
        return type(self)(
            Problem(place, each.message) if each.place == NOWHERE else each for each in self.problems
        )


class InputError(ZlmreportError):
    """The job, its data or the command line is wrong (exit code 2)."""


class AccessError(ZlmreportError):
    """A file or a device could not be read or written (exit code 3)."""

    exit_code = 3


class PluginError(InputError):
    """A plugin did what it must not, while it was at work for a job (exit code 2)."""


def as_problems(job: Path, error: Exception) -> ZlmreportError:
    """Return whatever ended the work on a job as an error with a message.

    `error`: What was raised: a mistake of the user, a file that cannot be used, a library that is not there,
        or a mistake of the program's own, named with the line of it that a report needs.
    """
    if isinstance(error, ZlmreportError):
        return error.of_job(job)
    if isinstance(error, OSError):
        if error.filename and error.strerror:
            message = f"cannot be read or written: {error.strerror[:1].lower()}{error.strerror[1:]}"
            return AccessError.at(Place(str(error.filename)), message)
        return AccessError.at(Place(str(job)), " ".join(str(error).split()))
    frame = traceback.extract_tb(error.__traceback__)[-1]
    where = f"{Path(frame.filename).name}, line {frame.lineno}"
    message = " ".join(f"{type(error).__name__}: {error}".split())[:300]
    return InputError.at(
        Place(str(job)),
        f"{message} ({where}); this is a mistake of zlmreport or of a plugin: please report it with the job",
    )


def did_you_mean(name: str, known: Sequence[str]) -> str:
    """Return the tail of a message on an unknown name: the nearest known one, and all of them.

    Of a standard that is named without its edition the last one is the nearest.

    >>> did_you_mean("iso230-2:2O14", ["iso230-2:2014", "nmtba"])
    "did you mean 'iso230-2:2014'? (known: iso230-2:2014, nmtba)"
    """
    if not known:
        return "there is none to choose from"
    listed = ", ".join(sorted(known))
    nearest = find_nearest(name, known)
    return f"did you mean {nearest!r}? (known: {listed})" if nearest else f"known: {listed}"


def find_nearest(name: str, known: Iterable[str]) -> str | None:
    """Return the known name that is most like one that is not; None where none is like it.

    >>> find_nearest("amplitud", ["P", "amplitude"]), find_nearest("oil", ["P", "amplitude"])
    ('amplitude', None)
    """
    by_letters = {each.casefold(): each for each in known}
    editions = sorted(each for each in by_letters if each.startswith(f"{name.casefold()}:"))
    nearest = editions[-1:] or difflib.get_close_matches(name.casefold(), by_letters, n=1)
    return by_letters[nearest[0]] if nearest else None


#: The list of known names at the end of a message (`did_you_mean`).
_KNOWN = re.compile(r" \(known: [^()]+\)$|; known: .+$")


def write_problems(problems: Iterable[Problem]) -> Iterator[str]:
    """Yield what the user reads of each problem; a list of known names stands in the first that has it.

    >>> [*write_problems([Problem(NOWHERE, "no 'x'; known: a, b"), Problem(NOWHERE, "no 'y'; known: a, b")])]
    ["zlmreport: no 'x'; known: a, b", "zlmreport: no 'y'"]
    """
    said: set[str] = set()
    for each in problems:
        known = _KNOWN.search(each.message)
        names = known[0].strip(" ();").removeprefix("known: ") if known else ""
        is_said = known is not None and names in said
        yield f"{each.place}: {each.message[: known.start()] if known and is_said else each.message}"
        said.add(names)


def count_in_words(number: int, thing: str) -> str:
    """Return a number of things.

    >>> count_in_words(1, "value"), count_in_words(100000, "character")
    ('1 value', '100,000 characters')
    """
    return f"{number:,} {thing}{'' if number == 1 else 's'}"


def split_lines(text: str) -> list[str]:
    """Split where editors do: `str.splitlines` knows more line ends than they."""
    return text.replace("\r\n", "\n").replace("\r", "\n").split("\n")


def describe_character(character: str) -> str:
    r"""Say which character that nobody sees stands in a text.

    >>> describe_character("\x07"), describe_character("\u202e")
    ('control character U+0007', 'invisible character U+202E (right-to-left override)')
    """
    code = f"U+{ord(character):04X}"
    name = unicodedata.name(character, "").lower()
    return f"invisible character {code} ({name})" if name else f"control character {code}"


def list_names(names: Iterable[str], last: str = "and") -> str:
    """Return names in a row: commas between them, and a word before the last; nothing where there is none.

    >>> list_names(["X"]), list_names(["X", "Y"], "or"), list_names(["X", "Y", "Z"])
    ('X', 'X or Y', 'X, Y and Z')
    """
    *others, final = [*names] or [""]
    return f"{', '.join(others)} {last} {final}" if others else final


def quoted(text: str) -> str:
    """Return what a file or a user says as a message shows it: in quotation marks, on one line, not too long.

    >>> quoted("12,5"), quoted("x" * 61)[-19:]
    ("'12,5'", "x'… (61 characters)")
    """
    if len(text) <= _LONGEST_QUOTE:
        return repr(text)
    return f"{text[:_LONGEST_QUOTE]!r}… ({len(text):,} characters)"
