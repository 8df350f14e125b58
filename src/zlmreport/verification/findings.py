"""What a verification found, statement by statement."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from enum import StrEnum


class Verdict(StrEnum):
    """What was found of a statement; one that could not be compared is not one that holds."""

    HOLDS = "holds"
    DIFFERS = "differs"
    OPEN = "not compared"


def is_number(value: object) -> bool:
    """Whether a value of a results file is a number; true and false are none."""
    return isinstance(value, int | float) and not isinstance(value, bool)


@dataclass(frozen=True, slots=True)
class Finding:
    """A statement and its verdict.

    Attributes
    ----------
    subject
        What it is about: ``page 3``, ``y-axis.csv``.
    verdict
        Whether it holds.
    detail
        Why not, or by what.
    """

    subject: str
    verdict: Verdict
    detail: str = ""


@dataclass(frozen=True, slots=True)
class Value:
    """A value of the results file beside the one that is computed again.

    Attributes
    ----------
    path
        Where it stands: ``("evaluations", "iso230-2:2014", "parameters", "A", "value")``.
    stated, recomputed
        In the units of the results file; None where one of them is absent.
    verdict
        Whether they agree.
    """

    path: tuple[str, ...]
    stated: object
    recomputed: object
    verdict: Verdict

    @property
    def is_number(self) -> bool:
        """Whether it is a number on either side."""
        return is_number(self.stated) or is_number(self.recomputed)


@dataclass(frozen=True, slots=True)
class Identity:
    """What a certificate says of itself in its results file."""

    number: str = ""
    title: str = ""
    issued: str = ""
    generator: str = ""


@dataclass(frozen=True, slots=True)
class Verification:
    """All that was found of a certificate.

    Attributes
    ----------
    identity
        Of the certificate.
    signature
        Of the file; open if it is not signed.
    files
        The attached files against what the certificate states of them.
    values
        Every value of the results file against the readings, evaluated again.
    pages
        Each page against the page as it is printed again.
    document
        What else the file holds: metadata, bookmarks, structure with the alternative texts.
    remarks
        What limits the comparison.
    """

    identity: Identity
    signature: Finding
    files: tuple[Finding, ...] = ()
    values: tuple[Value, ...] = ()
    pages: tuple[Finding, ...] = ()
    document: tuple[Finding, ...] = ()
    remarks: tuple[str, ...] = field(default=())

    @property
    def holds(self) -> bool:
        """Whether nothing differs."""
        return all(verdict is not Verdict.DIFFERS for verdict in self._verdicts())

    @property
    def differences(self) -> int:
        """How many statements differ."""
        return sum(verdict is Verdict.DIFFERS for verdict in self._verdicts())

    def _verdicts(self) -> Iterator[Verdict]:
        yield self.signature.verdict
        yield from (finding.verdict for finding in (*self.files, *self.pages, *self.document))
        yield from (value.verdict for value in self.values)
