"""What a standard asks of a test, and what the test offers."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum

from zlmreport.language import Words


class Basis(Enum):
    """How sure it is that a rule stands in the standard's text as given here.

    Only what is PUBLISHED may be printed as the standard's word; the rest is printed as the rule that
    the laboratory applied.
    """

    PUBLISHED = "published"
    APPLIED = "applied"


@dataclass(frozen=True, slots=True)
class Finding:
    """One requirement held against the test.

    Attributes
    ----------
    requirement
        What is asked.
    found
        What the test has.
    met
        True, False, or None where the job does not tell.
    basis
        Where the requirement is known from.
    """

    requirement: Words
    found: Words
    met: bool | None
    basis: Basis = Basis.APPLIED
