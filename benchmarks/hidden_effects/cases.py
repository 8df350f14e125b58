"""The cases: what is hidden, how the axis is tested, in which noise, how large; each in a draw of its own."""

from __future__ import annotations

import hashlib
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from enum import StrEnum
from itertools import product

import numpy as np

from hidden_effects.strangers import STRANGERS
from zlmreport.model.planning.methods import Method
from zlmreport_plugins.effects import zlmreport_effects

SIZES = (0.6, 1.0, 2.0)
SIZES_OF_PAIRS = (0.6, 1.0)
METHODS = tuple(Method)

#: Tests without a hidden effect in each draw, for each method and noise: a few draws make a thousand.
_NOTHING_HIDDEN = 32
_PAIRS = 6

#: Effects of which pairs are made: any linear axis can have them beside a cubic and backlash.
PAIRED = (
    "abbe",
    "air-index",
    "backlash-bow",
    "backlash-gradient",
    "compensation-shift",
    "compensation-sign",
    "datum-step",
    "datum-temperature",
    "dead-path",
    "directional-pitch",
    "encoder-interpolation",
    "first-run",
    "periodic",
    "reversal-relaxation",
    "scale-expansion",
    "scale-joint",
    "scale-kink",
    "screw-expansion",
    "screw-pitch",
    "thermal-drift",
    "thermal-growth",
    "time-periodic",
)


class Kind(StrEnum):
    """What a test hides."""

    EFFECT = "effect"
    PAIR = "pair"
    STRANGER = "stranger"
    NOTHING = "nothing"


class Scatter(StrEnum):
    """How the readings scatter."""

    CLEAN = "clean"
    REALISTIC = "realistic"


@dataclass(frozen=True, slots=True)
class Case:
    """One test, and what it hides.

    Attributes
    ----------
    kind
        What is hidden.
    hidden
        Its names: of an effect, a stranger, two effects, or nothing.
    method
        The positioning method.
    scatter
        How the readings scatter.
    size
        ρ: root mean square value of what is hidden, beyond what the job's model can imitate, over σ. Of each
        of a pair. 0 where nothing is hidden.
    draw
        Number of the draw: another design, axis, weather, value of every parameter, and noise.
    """

    kind: Kind
    hidden: tuple[str, ...]
    method: Method
    scatter: Scatter
    size: float
    draw: int

    @property
    def key(self) -> str:
        """Its name in the file of results."""
        hidden = "+".join(self.hidden)
        return f"{self.kind}/{hidden}/{self.method}/{self.scatter}/{self.size:g}/{self.draw}"

    def random(self) -> np.random.Generator:
        """Return the generator from which all of it is drawn: no other case has the same."""
        content = hashlib.sha256(self.key.encode())
        return np.random.default_rng(int.from_bytes(content.digest()[:16], "big"))


def cases(draws: int, first: int = 0) -> Iterator[Case]:
    """Yield all cases, draw by draw, those of a draw mixed: wherever one stops, every cell has its share."""
    for draw in range(first, first + draws):
        of_draw = [*_effects(draw), *_pairs(draw), *_strangers(draw), *_nothing(draw)]
        order = np.random.default_rng([draw, len(of_draw)]).permutation(len(of_draw))
        yield from (of_draw[place] for place in order)


def effects() -> tuple[str, ...]:
    """Return the identifiers of the effects that come with zlmreport, in their order."""
    return tuple(effect.identifier for effect in zlmreport_effects())


def _effects(draw: int) -> Iterator[Case]:
    for hidden, method, scatter, size in product(effects(), METHODS, Scatter, SIZES):
        yield Case(Kind.EFFECT, (hidden,), method, scatter, size, draw)


def _strangers(draw: int) -> Iterator[Case]:
    """Yield each stranger in one method, another one in each draw."""
    for (number, hidden), scatter, size in product(enumerate(STRANGERS), Scatter, SIZES):
        yield Case(Kind.STRANGER, (hidden,), _one_of(METHODS, number + draw), scatter, size, draw)


def _pairs(draw: int) -> Iterator[Case]:
    random = np.random.default_rng([draw, _PAIRS])
    for number in range(_PAIRS):
        first, second = random.choice(PAIRED, 2, replace=False).tolist()
        for scatter, size in product(Scatter, SIZES_OF_PAIRS):
            yield Case(Kind.PAIR, (first, second), Method.LINEAR, scatter, size, _PAIRS * draw + number)


def _nothing(draw: int) -> Iterator[Case]:
    for method, scatter, number in product(METHODS, Scatter, range(_NOTHING_HIDDEN)):
        yield Case(Kind.NOTHING, (), method, scatter, 0.0, _NOTHING_HIDDEN * draw + number)


def _one_of(methods: Sequence[Method], number: int) -> Method:
    return methods[number % len(methods)]
