"""Refines searched parameters of a set's effects between the values of the grid."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import partial

import numpy as np

from zlmreport.measurement.arrays import FloatArray, IntArray
from zlmreport.model.diagnosis.contest import Contest
from zlmreport.model.diagnosis.effect_set import SetMember, make_member
from zlmreport.model.diagnosis.families import make_orthonormal
from zlmreport.model.diagnosis.forms import JUMPING, PHASES, SAW, UnnamedForm
from zlmreport.model.diagnosis.likelihood import Amplitudes
from zlmreport.model.effects.effect import Effect

#: Evidence by which another part of a grid must be better for a parameter to jump there, and of another form.
_JUMP, _CLEAR_GAIN = 2.0, 0.5
#: Values that are tried between two of a grid, in steps of it, in rounds, each about the best of the last.
_BETWEEN, _ROUNDS, _CLOSER = (0.2, 0.4, 0.6, 0.8), 3, 0.22
#: Share by which what is explained differs where it is the same but for rounding: between two targets a step
#: is the same wherever it is.
_EQUAL = 1e-9
#: Share of the gaps that a grid of jumps has, but for the outermost ones, where it has all.
_MOST_OF_GAPS = 2 / 3
#: Gaps from one phase of a saw that is tried to the next, beyond which it is not seen where it jumps.
_GAPS_IN_PHASE = 2


def jump_along_grids(
    contest: Contest, members: list[SetMember], amplitudes: Amplitudes
) -> tuple[list[SetMember], bool]:
    """Return members at better parts of their grids, beside each other, and whether any moved."""
    found, has_moved = list(members), False
    for number, member in enumerate(members):
        forms = [
            place
            for place, each in enumerate(contest.families)
            if each.identifier == member.identifier and each.is_named == member.family.is_named
        ]
        if len(forms) == 1 and len(member.family.thetas) == 1:
            continue
        rest = [each.columns for place, each in enumerate(found) if place != number]
        scan = contest.scan(amplitudes, rest, forms)
        best = min(forms, key=lambda place: float(scan.criterion[place]))
        own = next(place for place in forms if contest.families[place] is member.family)
        if not np.isfinite(scan.criterion[best]):
            continue
        # Where the member stands between the values of its grid it may be better than at the best of them.
        at_grid = contest.families[own].find_columns(int(scan.best[own]))
        on_grid, stands = (
            contest.compute_criterion(amplitudes, [*rest, each]) for each in (at_grid, member.columns)
        )
        refined = float(scan.criterion[own]) + min(0.0, stands - on_grid)
        is_other = scan.criterion[best] < refined - _CLEAR_GAIN
        chosen = best if is_other else own
        spread = float(scan.spread[chosen])
        if is_other or on_grid < stands - _JUMP:
            found[number] = make_member(contest.families[chosen], int(scan.best[chosen]), spread)
            has_moved = True
        else:
            found[number] = replace(member, spread=spread)
    return found, has_moved


def hides_jumps(member: SetMember) -> bool:
    """Return whether a member jumps at more places than its grid has: beside them it explains far less."""
    effect = member.effect
    if not isinstance(effect, UnnamedForm):
        return False
    if effect.form is SAW:
        return len(effect.along) > _GAPS_IN_PHASE * PHASES * effect.count_periods(member.theta)
    gaps = effect.list_gaps()
    return effect.form in JUMPING and len(np.unique(member.family.thetas)) < _MOST_OF_GAPS * len(gaps)


def refine_member(
    contest: Contest, members: Sequence[SetMember], number: int, amplitudes: Amplitudes
) -> SetMember:
    """Return a member with its searched parameters between those of the grid, one after another."""
    member = members[number]
    family, effect = member.family, member.effect
    places = [
        (column, np.unique(family.thetas[:, column]))
        for column, each in enumerate(effect.searched)
        if each.is_refined
    ]
    places = [(column, values) for column, values in places if len(values) > 1]
    if not places:
        return member
    rest = contest.reduce_set(
        amplitudes, [each.columns for place, each in enumerate(members) if place != number]
    )
    theta = member.theta.copy()
    most = float(
        contest.explain_blocks(rest, contest.columns.select_columns(member.columns)[:, np.newaxis])[0]
    )
    best: FloatArray | None = None
    steps = {}
    for column, values in places:
        reach = _find_steps_beside(values, float(theta[column]))
        steps[column] = float(np.min(np.abs(reach)))
        for beside in _list_rounds(effect, reach):
            between = beside(float(theta[column]))
            tried = np.repeat(theta[np.newaxis], len(between), axis=0)
            tried[:, column] = np.clip(between, values[0], values[-1])
            blocks, ranks, seen = make_orthonormal(
                contest.space, contest.design, effect, tried, contest.least_visible
            )
            if not len(seen):
                break
            explained = contest.explain_blocks(rest, blocks)
            leading = int(np.argmax(explained > (1.0 - _EQUAL) * explained.max()))
            if explained[leading] > (1.0 + _EQUAL) * most:
                most, theta = float(explained[leading]), tried[seen[leading]]
                best = blocks[:, leading, : ranks[leading]]
    columns = member.columns if best is None else contest.columns.add(best)
    moved = replace(member, theta=theta, columns=columns)
    tangents = _find_tangents(
        contest, [*members[:number], moved, *members[number + 1 :]], number, amplitudes, steps
    )
    return replace(moved, tangents=tangents)


def _list_rounds(effect: Effect, reach: FloatArray) -> list[Callable[[float], FloatArray]]:
    """Return for each round what gives the values that are tried about the best of the last.

    `reach`: How far the first goes, down and up.
    """
    if isinstance(effect, UnnamedForm) and effect.form in JUMPING:
        # Nothing changes within a gap of what was measured, and each may be narrow: all are tried.
        gaps = effect.list_gaps()
        return [lambda value: gaps[(gaps > value + reach[0]) & (gaps < value + reach[1])]]
    steps = np.outer(reach, _BETWEEN).ravel()
    return [partial(np.add, steps * _CLOSER**number) for number in range(_ROUNDS)]


def _find_steps_beside(values: FloatArray, value: float) -> FloatArray:
    """Return the steps of a grid down and up from the value of it that is next to another.

    Targets, and the gaps between them, may lie anything but evenly.
    """
    steps, near = np.diff(values), int(np.argmin(np.abs(values - value)))
    return np.array([-steps[max(near - 1, 0)], steps[min(near, len(steps) - 1)]])


def _find_tangents(
    contest: Contest,
    members: Sequence[SetMember],
    number: int,
    amplitudes: Amplitudes,
    steps: dict[int, float],
) -> IntArray | None:
    """Return the places of what small shifts of a member's searched parameters change."""
    member = members[number]
    reduced = contest.reduce_set(amplitudes, [each.columns for each in members])
    solved = reduced.set_root.T @ reduced.taken[len(reduced.root) :]
    first = sum(len(each.columns) for each in members[:number])
    own = contest.columns.select_columns(member.columns) @ solved[first : first + len(member.columns)]
    effect, design = member.effect, contest.design
    gamma = np.linalg.lstsq(contest.space.of(effect.columns(design, member.theta)), own, rcond=1e-9)[0]
    found = []
    for column, step in steps.items():
        shift = np.where(np.arange(len(member.theta)) == column, 0.3 * step, 0.0)
        change = effect.columns(design, member.theta + shift) - effect.columns(design, member.theta - shift)
        slope = contest.space.of((change @ gamma)[:, np.newaxis])
        length = float(np.linalg.norm(slope))
        if length > 0:
            found.append(slope / length)
    return contest.columns.add(np.concatenate(found, axis=1)) if found else None
