"""The kit for effects of circles finds what is wrong with one."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np
import pytest

from zlmreport.plugin import MICROMETRE, Words
from zlmreport.plugin.circle_effect import (
    CircleDesign,
    CircleEffect,
    CircleTerm,
    Law,
    Parity,
    Searched,
    SearchedParameter,
)
from zlmreport.testing import CIRCLE_EFFECT_CHECKS, check_circle_effect


class ThreeLobes(CircleEffect):
    """cos3θ, alike in both senses: a spindle nose that is not round."""

    identifier = "three-lobes"
    title = Words(en="Three lobes", de="Dreibogen")
    equation = "a·cos 3θ"
    explains = Words(en="the bar's ball is not round", de="die Kugel des Stabs ist nicht rund")
    law = Law(Parity.EVEN)

    def terms(self, design: CircleDesign, _: Searched) -> Sequence[CircleTerm]:
        """Return a."""
        return [CircleTerm("a", MICROMETRE, np.cos(3 * design.angle), usual=2e-6)]


def test_a_sound_effect_passes_every_check() -> None:
    check_circle_effect(ThreeLobes())


class OddInTruth(ThreeLobes):
    def terms(self, design: CircleDesign, _: Searched) -> Sequence[CircleTerm]:
        return [CircleTerm("a", MICROMETRE, design.sense * np.cos(3 * design.angle))]


class GrowingInTruth(ThreeLobes):
    def terms(self, design: CircleDesign, _: Searched) -> Sequence[CircleTerm]:
        return [CircleTerm("a", MICROMETRE, design.feed * np.cos(3 * design.angle))]


class InMicrometres(ThreeLobes):
    def terms(self, design: CircleDesign, _: Searched) -> Sequence[CircleTerm]:
        return [CircleTerm("a", MICROMETRE, np.cos(3 * design.angle), usual=2.0)]


class Undefined(ThreeLobes):
    def terms(self, design: CircleDesign, _: Searched) -> Sequence[CircleTerm]:
        return [CircleTerm("a", MICROMETRE, np.full(design.count, np.nan))]


class Searching(ThreeLobes):
    searched = (SearchedParameter("lobes", MICROMETRE),)


class OfItsNeighbours(ThreeLobes):
    def terms(self, design: CircleDesign, _: Searched) -> Sequence[CircleTerm]:
        largest = np.abs(np.gradient(np.cos(3 * design.angle))).max()
        return [CircleTerm("a", MICROMETRE, largest * np.cos(3 * design.angle))]


class Wordless(ThreeLobes):
    explains = Words(en="", de="")


@pytest.mark.parametrize(
    ("effect", "said"),
    [
        (OddInTruth, "is not even in the two senses"),
        (GrowingInTruth, "does not grow with the feed to the power 0"),
        (InMicrometres, "SI units are expected"),
        (Undefined, "a column of a that is NaN"),
        (Searching, "a row of its grid of the shape"),
        (OfItsNeighbours, "changes when other readings are left out"),
        (Wordless, "explains says nothing"),
    ],
)
def test_what_is_wrong_is_said(effect: Callable[[], CircleEffect], said: str) -> None:
    with pytest.raises(AssertionError, match=said):
        check_circle_effect(effect())


def test_each_check_says_what_it_looks_for() -> None:
    assert all((check.__doc__ or "").startswith("Check that ") for check in CIRCLE_EFFECT_CHECKS)
