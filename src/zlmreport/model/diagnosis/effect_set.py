"""A set of effects in the contest, with the nameless curves beside it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import TypeAlias

from zlmreport.job.effect_choices import number_effect, part_number
from zlmreport.measurement.arrays import FloatArray, IntArray
from zlmreport.model.diagnosis.families import Family
from zlmreport.model.diagnosis.likelihood import DIGITS_OF_SCORE, Amplitudes, Likelihood
from zlmreport.model.diagnosis.random_curves import Along
from zlmreport.model.effects.effect import Effect, is_against

#: By what members of a contest are told apart: family, columns, what the search cost, tangents.
MemberKey: TypeAlias = tuple[int, bytes, float, bytes]


@dataclass(frozen=True, slots=True)
class SetMember:
    """An effect of a set, at values of its searched parameters."""

    family: Family
    theta: FloatArray  #: (s,): Its searched parameters.
    columns: IntArray  #: (k,) integer: Places of its columns, those that are zero left out.
    spread: float = 0.0  #: What it costs that θ had to be found.
    tangents: IntArray | None = None  #: Place of what a shift of θ would change.

    @property
    def key(self) -> MemberKey:
        """By what it is told from other members."""
        tangents = b"" if self.tangents is None else self.tangents.tobytes()
        return id(self.family), self.columns.tobytes(), self.spread, tangents

    @property
    def rank(self) -> int:
        """How many columns it has."""
        return len(self.columns)

    @property
    def identifier(self) -> str:
        """As jobs name the effect."""
        return self.family.identifier

    @property
    def effect(self) -> Effect:
        """The effect, in its form."""
        return self.family.effect


@dataclass(frozen=True, slots=True)
class EffectSet:
    """Effects together, with the amplitudes of what has no name beside them."""

    members: tuple[SetMember, ...]
    amplitudes: Amplitudes
    score: float  #: −2·ln of its evidence, but for a constant of the test.

    @property
    def named(self) -> tuple[SetMember, ...]:
        """Those that are installed effects."""
        return tuple(each for each in self.members if each.family.is_named)

    @property
    def unnamed(self) -> tuple[SetMember, ...]:
        """Forms without a name."""
        return tuple(each for each in self.members if not each.family.is_named)

    @property
    def columns(self) -> list[IntArray]:
        """The columns of its members."""
        return [each.columns for each in self.members]

    @property
    def columns_with_tangents(self) -> list[IntArray]:
        """The same, and what shifts of their searched parameters would change."""
        return [*self.columns, *(each.tangents for each in self.members if each.tangents is not None)]

    def without(self, number: int) -> EffectSet:
        """Return the set without one of its members, all else and its score as they are."""
        return replace(self, members=(*self.members[:number], *self.members[number + 1 :]))


def make_member(family: Family, block: int, spread: float) -> SetMember:
    """Return a family at the values of one of its blocks.

    `spread`: What it costs that these had to be found.
    """
    return SetMember(family, family.thetas[block], family.find_columns(block), spread)


def find_installed_name(effect: Effect) -> str:
    """Return the name of an effect by which it is installed, whichever time it stands in a model."""
    return part_number(effect.identifier)[0] if effect.several else effect.identifier


def find_one_before(effect: Effect) -> str:
    """Return the name of the one before an effect that is there again; empty for the first."""
    name, number = part_number(effect.identifier) if effect.several else (effect.identifier, 1)
    return number_effect(name, number - 1) if number > 1 else ""


def list_names(members: Sequence[SetMember]) -> frozenset[str]:
    """Return the names by which some members are installed."""
    return frozenset(find_installed_name(each.effect) for each in members)


def list_unnamed(found: EffectSet) -> frozenset[str]:
    """Return the forms without a name that are in a set."""
    return frozenset(each.identifier for each in found.unnamed)


def list_loud(likelihood: Likelihood, found: EffectSet) -> list[int]:
    """Return the parts without a name that are more than noise in a set."""
    quiet = likelihood.as_noise(found.amplitudes)
    return [number for number, level in enumerate(found.amplitudes) if level != quiet[number]]


def count_nameless(likelihood: Likelihood, found: EffectSet) -> int:
    """Return how many forms and curves without a name are in a set, beyond what noise may be."""
    return len(found.unnamed) + len(list_loud(likelihood, found))


def has_nameless(likelihood: Likelihood, found: EffectSet) -> bool:
    """Return whether anything without a name is in a set, beyond what noise may be."""
    return count_nameless(likelihood, found) > 0


def is_only_from_run_to_run(likelihood: Likelihood, found: EffectSet) -> bool:
    """Return whether all that is in a set without a name is another from run to run."""
    loud = [likelihood.parts[number].course.along for number in list_loud(likelihood, found)]
    return not found.unnamed and set(loud) == {Along.RUN}


def find_score(found: EffectSet) -> float:
    """Return the score of a set: what a search makes small, to where rounding begins."""
    return round(found.score, DIGITS_OF_SCORE)


def compute_fit(likelihood: Likelihood, found: EffectSet) -> float:
    """Return the score of a set but for what its effects cost."""
    return likelihood.compute_criterion(found.amplitudes, found.columns)


def list_beside(members: Sequence[SetMember], effect: Effect) -> tuple[SetMember, ...]:
    """Return the members that can stand beside an effect.

    None that it contains or takes the place of, and none that takes what the job states where it denies that.
    """
    replaced = {effect.identifier, *effect.contains}
    return tuple(
        each
        for each in members
        if each.identifier not in replaced
        and effect.identifier not in each.effect.contains
        and not is_against(effect, each.effect)
    )
