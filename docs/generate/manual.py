"""The manual page ``zlmreport(1)``, from the same parts of the parsers as the page of the commands."""

from __future__ import annotations

import argparse
import re
from collections.abc import Iterator

from command_texts import arguments_of

from zlmreport.cli import arguments


def text() -> str:
    """Return the manual page as groff reads it."""
    main, *commands = arguments.make_parsers()
    return "\n".join(
        (
            '.TH ZLMREPORT 1 "" zlmreport',
            ".SH NAME",
            r"zlmreport \- calibration certificates for machine axes",
            ".SH SYNOPSIS",
            r".B zlmreport",
            r"[\fIOPTION\fR ...] \fIJOB.yaml\fR ...",
            ".br",
            r".B zlmreport",
            r"\fICOMMAND\fR [\fIOPTION\fR ...] ...",
            ".SH DESCRIPTION",
            *_section(main),
            ".SH COMMANDS",
            *(line for parser in commands for line in (f".SS {_plain(parser.prog)}", *_section(parser))),
            ".SH EXIT STATUS",
            "0 done; 1 a stated limit is not met, if that is asked for, or a verification did not hold;",
            "2 the job, its data or the command line is wrong;",
            "3 a file or device could not be read or written;",
            "4 a fleet run with failed jobs; 5 a verification could not be decided.",
            "",
        )
    )


def _section(parser: argparse.ArgumentParser) -> Iterator[str]:
    yield _unfilled(parser.description)
    for name, meaning in arguments_of(parser):
        yield f".TP\n.B {_plain(name)}\n{_plain(meaning)}"
    if parser.epilog:
        yield ".PP\n" + _unfilled(parser.epilog)


def _unfilled(words: str | None) -> str:
    """Return text whose lines stand as they are."""
    return f".nf\n{_plain((words or '').strip())}\n.fi"


def _plain(words: str) -> str:
    """Return text that groff sets as it is: backslashes, hyphens, and dots and quotes that begin a line."""
    return re.sub(r"^(?=[.'])", r"\\&", words.replace("\\", r"\e").replace("-", r"\-"), flags=re.MULTILINE)
