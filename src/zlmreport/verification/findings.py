"""What a verification found: verdict, statements, compared values, quoted texts."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from enum import StrEnum

from zlmreport.language import Language, Words


class VerificationVerdict(StrEnum):
    """What was found of a statement; one that could not be compared is not one that holds."""

    HOLDS = "holds"
    DIFFERS = "differs"
    OPEN = "not compared"


class VerificationOutcome(StrEnum):
    """What a verification comes to."""

    HOLDS = "holds"
    DOES_NOT_HOLD = "does-not-hold"
    UNDECIDED = "undecided"


def is_number(value: object) -> bool:
    """Whether a value of a results file is a number; true and false are none."""
    return isinstance(value, int | float) and not isinstance(value, bool)


@dataclass(frozen=True, slots=True)
class CheckedStatement:
    """A statement and its verdict."""

    subject: str  #: What it is about: ``page 3``, ``y-axis.csv``.
    verdict: VerificationVerdict  #: Whether it holds.
    detail: Words | str = ""  #: Why not, or by what.

    @classmethod
    def of(cls, subject: str, difference: str) -> CheckedStatement:
        """Return that a statement holds, or how it differs."""
        return cls(
            subject, VerificationVerdict.DIFFERS if difference else VerificationVerdict.HOLDS, difference
        )


def name_first_of(told: Sequence[str], most: int) -> str:
    """Return the first of what is told in a row, and how much more there is."""
    more = len(told) - most
    return "; ".join(told[:most]) + (f"; and {more} more" if more > 0 else "")


@dataclass(frozen=True, slots=True)
class ComparedValue:
    """A value of the results file beside the one that is computed again."""

    #: Where it stands: ``("evaluations", "iso230-2:2014", "parameters", "A", "value")``.
    path: tuple[str, ...]
    #: stated and recomputed: In the units of the results file; None where one of them is absent.
    stated: object
    recomputed: object
    verdict: VerificationVerdict  #: Whether they agree.

    @property
    def is_number(self) -> bool:
        """Whether it is a number on either side."""
        return is_number(self.stated) or is_number(self.recomputed)


@dataclass(frozen=True, slots=True)
class QuotedText:
    """A text that somebody else wrote, and that is printed as it stands.

    `key` is where the job states it, or what it comes from; `oddities` are what nobody can tell by looking;
    `claim` says what it claims that nothing computes, None for nothing.
    """

    key: str
    text: str
    oddities: tuple[Words, ...] = ()
    claim: Words | None = None


@dataclass(frozen=True, slots=True)
class Identity:
    """What a certificate says of itself in its results file."""

    number: str = ""
    title: str = ""
    issued: str = ""
    generator: str = ""
    language: Language = Language.ENGLISH
    digest: str = ""  #: Of its readings and results, computed again.


@dataclass(frozen=True, slots=True)
class CheckedCertificate:
    """All that was found of a certificate."""

    identity: Identity  #: Of the certificate.
    signature: CheckedStatement  #: Of the file; open if it is not signed.
    files: tuple[
        CheckedStatement, ...
    ] = ()  #: The attached files against what the certificate states of them.
    values: tuple[
        ComparedValue, ...
    ] = ()  #: Every value of the results file against the readings, evaluated again.
    pages: tuple[CheckedStatement, ...] = ()  #: Each page against the page as it is printed again.
    #: What else the file holds: metadata, bookmarks, structure with the alternative texts.
    document: tuple[CheckedStatement, ...] = ()
    own_words: tuple[QuotedText, ...] = ()  #: Words that somebody else wrote, and that nothing computes.
    remarks: tuple[Words, ...] = field(default=())  #: What limits the comparison.
    is_signed: bool = False  #: Whether there is a signature, be it intact or not.
    is_trusted: bool = False  #: Whether it is intact, and made with a certificate that is trusted.
    #: Whether a time stamp that is trusted says when it was made; the signer's own clock is none.
    is_time_trusted: bool = False

    @property
    def outcome(self) -> VerificationOutcome:
        """Whether all holds; what could not be compared leaves it undecided."""
        if self.differences:
            return VerificationOutcome.DOES_NOT_HOLD
        return VerificationOutcome.UNDECIDED if self.undecided else VerificationOutcome.HOLDS

    @property
    def holds(self) -> bool:
        """Whether everything was compared, and nothing differs."""
        return self.outcome is VerificationOutcome.HOLDS

    @property
    def undecided(self) -> tuple[str, ...]:
        """The parts in which something could not be compared, such as ``("values", "pages")``."""
        return tuple(
            name for name, verdicts in self._list_parts().items() if VerificationVerdict.OPEN in verdicts
        )

    @property
    def differences(self) -> int:
        """How many statements differ."""
        return sum(verdicts.count(VerificationVerdict.DIFFERS) for verdicts in self._list_parts().values())

    def _list_parts(self) -> dict[str, list[VerificationVerdict]]:
        """Return the verdicts of each part; that nobody signed leaves nothing of it open."""
        is_unsigned = self.signature.verdict is VerificationVerdict.OPEN and not self.is_signed
        findings = {"files": self.files, "pages": self.pages, "document": self.document}
        return {
            "signature": [] if is_unsigned else [self.signature.verdict],
            "values": [value.verdict for value in self.values],
            **{name: [each.verdict for each in found] for name, found in findings.items()},
        }
