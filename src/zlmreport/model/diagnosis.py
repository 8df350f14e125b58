"""What a diagnosis says: how well the model describes the readings, where it fails, and what it lacks."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum

from zlmreport.language import Words
from zlmreport.model.candidates import NotTestable
from zlmreport.model.effect import Effect
from zlmreport.model.estimate import Estimate
from zlmreport.model.failures.failure import Failure
from zlmreport.model.fit import Fit
from zlmreport.model.visibility import Visibility
from zlmreport.quantities.arrays import IntArray


class Verdict(StrEnum):
    """What a diagnosis comes to.

    `ADEQUATE`: nothing is left that the noise does not explain. `MISSING`: the first candidate, or one of its
    equals, explains the rest, alone or with effects that are found after it. `UNEXPLAINED`: something is left
    that no installed effect explains.
    """

    ADEQUATE = "adequate"
    MISSING = "missing"
    UNEXPLAINED = "unexplained"


@dataclass(frozen=True, slots=True)
class ErrorNumbers:
    """How far readings and model are apart.

    Attributes
    ----------
    rms
        √(RSS/(N − q)), m or rad.
    noise_rms
        The noise floor σ_f, m or rad; None without repeats.
    chi2_per_dof
        RSS/((N − q)·σ_f²); None without a noise floor.
    cross_validated_rms
        Of runs predicted from the others, m or rad; None with a single run.
    """

    rms: float
    noise_rms: float | None
    chi2_per_dof: float | None
    cross_validated_rms: float | None


@dataclass(frozen=True, slots=True)
class Candidate:
    """An effect that the model may lack.

    Attributes
    ----------
    effect
        In the form that fits best.
    p_value
        Chance of so high a likelihood ratio without the effect, its own search allowed for.
    p_value_is_extrapolated
        Whether it lies beyond what was simulated.
    probability
        Among all contestants, rivals and no effect.
    evidence
        2·ln of the Bayes factor against the model as it is.
    error
        After adding it.
    estimates
        Its own parameters after adding it.
    share
        Of what the noise leaves unexplained, explained by it: 0 to 1; None without a noise floor.
    explains
        The same in words.
    equals
        Effects that the readings cannot tell from it.
    discriminate_by
        The measurement that would tell them; None where there is nothing to tell apart.
    """

    effect: Effect
    p_value: float
    p_value_is_extrapolated: bool
    probability: float
    evidence: float
    error: ErrorNumbers
    estimates: tuple[Estimate, ...]
    share: float | None
    explains: Words
    equals: tuple[str, ...]
    discriminate_by: Words | None

    @property
    def identifier(self) -> str:
        """As jobs name it."""
        return self.effect.identifier


@dataclass(frozen=True, slots=True)
class Unnamed:
    """What is left without a name.

    Attributes
    ----------
    shape
        Along what it changes.
    where
        Where its largest part lies.
    size
        Its root mean square value, m or rad.
    """

    shape: Words
    where: Words
    size: float


@dataclass(frozen=True, slots=True)
class Diagnosis:
    """A model held against the readings of a test.

    Attributes
    ----------
    fit
        The model as it is.
    error
        How far it is from the readings.
    verdict
        What the diagnosis comes to.
    p_value
        Chance of such a contest where nothing is missing.
    tests
        All tests of the residuals.
    failures
        Those that they did not pass, and flagged readings.
    candidates
        Effects that may be missing, best first; none where the model is adequate.
    further
        Effects that are missing beside the first candidate, in the order in which they are found after it.
    unnamed
        What is left without a name; None unless the verdict is `UNEXPLAINED`.
    not_testable
        Effects that the test cannot show, and what they need.
    not_excluded
        Those among them that would look like the first candidate.
    visibility
        How much of each effect this plan can see.
    outliers : (k,) integer array
        Readings set aside, by their places in the measurement set.
    remarks
        What was assumed, and what was left out.
    """

    fit: Fit
    error: ErrorNumbers
    verdict: Verdict
    p_value: float
    tests: tuple[Failure, ...]
    failures: tuple[Failure, ...]
    candidates: tuple[Candidate, ...]
    further: tuple[str, ...]
    unnamed: Unnamed | None
    not_testable: tuple[NotTestable, ...]
    not_excluded: tuple[str, ...]
    visibility: tuple[Visibility, ...]
    outliers: IntArray
    remarks: tuple[Words, ...]
