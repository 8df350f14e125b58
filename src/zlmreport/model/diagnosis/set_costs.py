"""The price of a set of effects: prior odds, coefficients, searched parameters, unusual values.

Spike and slab (T. J. Mitchell and J. J. Beauchamp, J. Amer. Statist. Assoc. 83 (1988) 1023): the coefficients
of an effect are averaged over, so that each costs the more the better the readings determine it.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from zlmreport.measurement.arrays import FloatArray
from zlmreport.model.diagnosis.contest import Contest
from zlmreport.model.diagnosis.effect_set import SetMember
from zlmreport.model.diagnosis.fixed_numbers import FixedNumbers
from zlmreport.model.diagnosis.likelihood import Amplitudes
from zlmreport.model.effects.design import Design
from zlmreport.model.effects.effect import Dimension, Effect, Parameter
from zlmreport.model.effects.sizes import compute_times_usual, find_usual_range, name_of

#: What a value costs on the side where none is usual, odds of 20 to 1, and one that physics forbids.
UNUSUAL, FORBIDDEN = 6.0, 1e3
#: Standard uncertainties beyond which nothing is in doubt; of a searched value, taken as a share of it.
_DOUBT, _SHARE_OF_SEARCHED = 2.0, 0.25
#: Times the usual beyond which a value of the wrong sign costs no more.
_FARTHEST = 1e3
#: Of the longest column of an effect, one that is as short is imitated by the model.
_SEEN = 1e-6
#: Of the largest variance of coefficients, one that is as small is that of none.
_DEPENDENT = 1e-9


class SetCosts:
    """What the effects of sets cost in a contest."""

    def __init__(self, contest: Contest) -> None:
        self._contest = contest
        self._numbers = FixedNumbers(contest.design, contest.base)
        self._turns: dict[int, FloatArray] = {}  # of members, by the place of their first column

    def compute(self, members: Sequence[SetMember], amplitudes: Amplitudes) -> float:
        """Return what the members cost: prior odds, coefficients, searched parameters, unusual values."""
        if not members:
            return 0.0
        if self._numbers.are_too_many(members):
            return FORBIDDEN
        contest = self._contest
        reduced = contest.reduce_set(amplitudes, [each.columns for each in members])
        variance = reduced.squares / contest.space.degrees
        solved = reduced.set_root.T @ reduced.taken[len(reduced.root) :] * np.sqrt(contest.squares)
        inverse = reduced.set_root.T @ reduced.set_root
        cost, first = 0.0, 0
        for each in members:
            own = slice(first, first + len(each.columns))
            first = own.stop
            square = contest.expected.find_square(each.identifier)
            cost += each.family.price + each.spread
            root = _find_root_of_inverse(variance * inverse[own, own])
            for explained, rank in self._by_size(each, solved[own], root):
                cost += contest.weigh_block(explained, rank, square)
            if each.family.is_named:
                cost += self._weigh_unusual(each, solved[own], variance * inverse[own, own])
        return cost

    def _by_size(
        self, member: SetMember, solved: FloatArray, root: FloatArray
    ) -> Iterator[tuple[float, int]]:
        """Yield what a member explains beside the others of a set, in σ², and with how many columns.

        All its coefficients are of one size, but for an effect that contains others: a polynomial is a
        constant, a slope and a bend, and a steep slope makes no bend larger. Of these each explains what
        those before it leave.

        `root`: R, RᵀR the information on its coefficients.
        """
        values = root @ solved
        if not member.effect.contains:
            yield float(values @ values), member.rank
            return
        contrasts = self._contest.space.of(member.effect.columns(self._contest.design, member.theta))
        powers = root @ (self._contest.columns.select_columns(member.columns).T @ contrasts)
        lengths = np.linalg.norm(powers, axis=0)
        powers = powers[:, lengths > _SEEN * lengths.max(initial=0.0)]
        parts = np.linalg.qr(powers)[0].T @ values
        yield from ((float(each) ** 2, 1) for each in parts[: member.rank])

    def _weigh_unusual(self, member: SetMember, solved: FloatArray, covariance: FloatArray) -> float:
        """Return what it costs that values lie beyond what is usual."""
        effect, design = member.effect, self._contest.design
        cost = sum(
            weigh_size(effect, design, each, value, _SHARE_OF_SEARCHED * abs(value))
            for each, value in zip(effect.searched, member.theta.tolist(), strict=True)
            if not (each.dimension is Dimension.TIME and design.time_is_counted)
        )
        turn = self._turn(member)
        gamma, spread = turn @ solved, np.sqrt(np.maximum(np.diagonal(turn @ covariance @ turn.T), 0.0))
        return cost + sum(
            weigh_size(effect, design, each, float(value), float(own))
            for each, value, own in zip(effect.linear, gamma, spread, strict=True)
        )

    def _turn(self, member: SetMember) -> FloatArray:
        """Return what turns coefficients of a member's columns, which are orthonormal, into parameters."""
        place = int(member.columns[0])
        if place not in self._turns:
            contrasts = self._contest.space.of(member.effect.columns(self._contest.design, member.theta))
            values = self._contest.columns.select_columns(member.columns)
            turn = np.linalg.lstsq(contrasts, values, rcond=1e-9)[0]
            self._turns[place] = np.asarray(turn, dtype=np.float64)
        return self._turns[place]


def _find_root_of_inverse(covariance: FloatArray) -> FloatArray:
    """Return R with RᵀR the inverse of a covariance; directions in which nothing is determined are zero."""
    values, vectors = np.linalg.eigh(covariance)
    is_seen = values > _DEPENDENT * values[-1]
    return np.asarray((vectors / np.sqrt(np.where(is_seen, values, np.inf))).T)


def weigh_size(
    effect: Effect, design: Design, parameter: Parameter, value: float, uncertainty: float
) -> float:
    """Return what the size of a parameter costs, as far as it is beyond doubt; physics alone forbids one.

    Beyond what is usual every decade is as likely as the next: twenty times as much, or as little, has odds
    of 20 to 1. A value that has a name of its own, such as that of a correction made twice, costs nothing.
    """
    reach = _DOUBT * uncertainty
    if all(effect.forbids(design, {parameter.name: value + each}) for each in (-reach, 0.0, reach)):
        return FORBIDDEN
    low, high = find_usual_range(parameter, design.axis.kind)
    sure = min(max(value, min(low, value + reach)), max(high, value - reach))
    times = compute_times_usual(parameter, sure, design.axis.kind)
    if times == 1.0 or name_of(parameter, value) is not None:
        return 0.0
    if np.isfinite(times):
        least = -np.inf if parameter.smallest is None else parameter.smallest
        most = np.inf if parameter.largest is None else parameter.largest
        is_far = not least <= sure <= most
        return 2.0 * abs(float(np.log(times))) + (UNUSUAL if is_far else 0.0)
    return UNUSUAL + 2.0 * float(np.log1p(abs(sure) / max(abs(low), abs(high), abs(sure) / _FARTHEST)))
