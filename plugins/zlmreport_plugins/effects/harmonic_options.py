"""The job key of effects whose period is known: which harmonics of it are in the model."""

from __future__ import annotations

from typing import Annotated

from pydantic import AfterValidator, Field

from zlmreport.plugin import Options

#: In which a contest tries such an effect.
COMBINATIONS = ((1,), (2,), (1, 2))


def _distinct(harmonics: tuple[int, ...]) -> tuple[int, ...]:
    if len(set(harmonics)) < len(harmonics):
        raise ValueError("a harmonic stands there twice; each is named once, as in [1, 2]")
    return harmonics


class HarmonicOptions(Options):
    """The harmonics of a known period."""

    harmonics: Annotated[tuple[Annotated[int, Field(ge=1, le=4)], ...], AfterValidator(_distinct)] = Field(
        (1, 2), min_length=1, description="Harmonics of the period, 1 to 4: 1 is once a period."
    )
