"""What is stated of a value and its limit."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum


class Conformity(Enum):
    """The statement."""

    MET = "pass"
    CONDITIONALLY_MET = "conditional-pass"
    CONDITIONALLY_FAILED = "conditional-fail"
    FAILED = "fail"
    UNDECIDED = "undecided"

    @property
    def conforms(self) -> bool | None:
        """Whether the limit counts as kept; None where nothing is decided."""
        if self is Conformity.UNDECIDED:
            return None
        return self in (Conformity.MET, Conformity.CONDITIONALLY_MET)


@dataclass(frozen=True, slots=True)
class Decision:
    """What a decision rule says of one value.

    Attributes
    ----------
    conformity
        The statement.
    acceptance_limit
        TL − w, m or rad: up to it the limit is kept. Negative where no value could keep it; None where the
        rule needs an uncertainty that was not evaluated.
    rejection_limit
        m or rad: beyond it the limit is exceeded. None as above.
    risk
        Probability that the statement is wrong: that the true value lies beyond the limit although the
        statement says that it keeps it, or the other way round, for a normally distributed value
        (JCGM 106:2012, clause 7). None where nothing is stated, or no uncertainty was evaluated.
    """

    conformity: Conformity
    acceptance_limit: float | None
    rejection_limit: float | None
    risk: float | None
