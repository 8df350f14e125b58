"""What remains unexplained: how large, where, of what shape, and a formula to begin with.

It is what forms without a name and random curves explain at the readings, on the average of all that these
allow. The form that follows it best is proposed as a formula that a job can try and keep: a start, no cause.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, fields, replace

import numpy as np

from zlmreport.job.formula_keys import FormulaKeys
from zlmreport.language import Language, Words
from zlmreport.measurement.arrays import FloatArray, make_orthonormal_basis
from zlmreport.measurement.units import Unit
from zlmreport.model.diagnosis.believing import TOLD_APART
from zlmreport.model.diagnosis.effect_set import (
    EffectSet,
    SetMember,
    find_installed_name,
    has_nameless,
    list_names,
)
from zlmreport.model.diagnosis.forms import CARRIERS, FADING, IN_TIME, LOCAL, UnnamedForm
from zlmreport.model.diagnosis.nameless import SLOW_DRIFT
from zlmreport.model.diagnosis.random_curves import Along, Course
from zlmreport.model.diagnosis.residual_tests import examine_time_order
from zlmreport.model.diagnosis.residuals import find_residuals_of
from zlmreport.model.diagnosis.set_members import renumber
from zlmreport.model.diagnosis.sets import SetSearch
from zlmreport.model.diagnosis.single_run import SingleRun
from zlmreport.model.effects import wording
from zlmreport.model.effects.design import Design
from zlmreport.model.effects.effect import Dimension, Effect, find_unit_on
from zlmreport.model.fitting.fit import Fit

#: Evidence that what has no name must have, prior odds counted.
_WORTH_SAYING = 2.5
#: Share of what is left that a form must follow to be proposed; of what is irregular, to be that form.
_FOLLOWS, _IS_THAT = 0.5, 0.9
#: Strength of a combination of columns, of the largest, below which they depend on each other.
_DEPENDENT = 1e-9
#: Of the squares of what is left, how much its place holds; and of what was measured, a stretch that is all.
_MOST, _ALL = 0.8, 0.75
#: Of the largest part of what is left, what another must have to be told.
_WORTH_A_WORD = 0.3
#: Effects that may be what is left: more of them describe any curve.
_MOST_NAMES = 2
#: Of forms, by their carrier; along the axis otherwise.
_COURSES = {"D": Course.REVERSAL, "time": Course.TIME, "lever": Course.SLOPE}
_ABOUT = Words("around {place}")
_BETWEEN = Words("{first} to {last}")
_MOST_AT = Words("most at {place}")
_IRREGULAR = Words("more than the repeats scatter, but neither smooth nor of a form")
#: Chance of an order of repeats in time below which something moves, and the order of the curve that it is
#: drawn as.
_ORDERED, _DRIFTS = 0.005, 3
_RUN = Words("most in run {run}")


@dataclass(frozen=True, slots=True)
class NamesInstead:
    """Installed effects that may be what is left without a name."""

    effects: tuple[Effect, ...]  #: All of them together.
    odds: float  #: Of these against something without a name; at least 1 to 20.


@dataclass(frozen=True, slots=True, kw_only=True)
class RemainderPart:
    """One thing that is left without a name.

    `low` and `high` are in SI: m or rad, of a course in time s (or readings, where time is counted).
    """

    rms: float  #: Root mean square value at the readings, m or rad.
    where: Words  #: The place: "around 420 mm".
    low: float  #: Where it begins: a form by its extent, else the shortest stretch with most of it.
    high: float  #: Where it ends.
    unit: Unit  #: In which both are printed: mm, °, s or readings.
    shape: Words  #: "a bump, 60 mm wide", "smooth along the axis".
    size: float  #: Its largest value, with its sign, m or rad.
    peak: float  #: Where that is, in SI as `low` and `high`.
    course: Course  #: With what it changes.


@dataclass(frozen=True, slots=True, kw_only=True)
class Remainder(RemainderPart):
    """All that is left without a name, at the place and of the shape of its largest part."""

    share: float  #: Of the squares of what the job's model leaves, 0 to 1.
    #: The form that follows it, as an effect of a job: keys of an item of `model.effects`, ranges around what
    #: was found; None where no form does.
    formula: FormulaKeys | None
    further: tuple[RemainderPart, ...] = ()  #: Other parts that are not much smaller, the largest first.
    instead: NamesInstead | None = None  #: What may stand in its place; None where nothing is near.


@dataclass(frozen=True, slots=True)
class _Share:
    """What one thing without a name explains."""

    values: FloatArray  #: (N,), m or rad.
    course: Course
    shape: Words
    member: SetMember | None  #: The form; None of a random curve.

    @property
    def rms(self) -> float:
        return float(np.sqrt(np.mean(self.values**2)))


def find_remainder_of(search: SetSearch, found: EffectSet, fitted: Fit) -> Remainder | None:
    """Return what a set leaves beside noise; None if that is nothing worth saying.

    `fitted`: The job's model beside which the set stands.
    """
    if not has_nameless(search.contest, found):
        return None
    bare = search.as_noise(found.named)
    if bare.score - found.score < _WORTH_SAYING:
        return None
    design = search.contest.design
    shares = _unite_alike(_list_shares(search, found), _remove_what_is_beside(fitted, found))
    whole: FloatArray = np.sum([each.values for each in shares], axis=0)
    squares = float(np.sum(fitted.residual**2))
    main, *further = [_describe_part(each, design) for each in shares]
    form = shares[0].member or _choose_following(search, bare, whole, main.course, found.score)
    return Remainder(
        rms=float(np.linalg.norm(whole)) / len(whole) ** 0.5,
        share=min(1.0, float(np.sum(whole**2)) / squares) if squares else 0.0,
        where=main.where,
        low=main.low,
        high=main.high,
        unit=main.unit,
        shape=main.shape,
        size=float(whole[int(np.argmax(np.abs(whole)))]),
        peak=main.peak,
        formula=_propose_formula(form, design) if form else None,
        course=main.course,
        further=tuple(each for each in further if each.rms > _WORTH_A_WORD * main.rms),
        instead=_find_names_instead(search, found),
    )


def _unite_alike(shares: Iterable[_Share], beside: Callable[[FloatArray], FloatArray]) -> list[_Share]:
    """Return shares, the largest first; curves of one shape and other lengths are one.

    `beside`: What leaves of a curve that which has no name.
    """
    united: dict[tuple[Course, str], _Share] = {}
    for each in shares:
        key = each.course, each.shape.in_language(Language.ENGLISH)
        known = united.get(key)
        values = beside(each.values)
        united[key] = replace(each, values=values if known is None else known.values + values)
    return sorted(united.values(), key=lambda each: -each.rms)


def _describe_part(share: _Share, design: Design) -> RemainderPart:
    where, low, high, unit = _place(share, design)
    largest = int(np.argmax(np.abs(share.values)))
    places = design.position if share.course.along is Along.PLACE else design.time
    return RemainderPart(
        rms=share.rms,
        where=where,
        low=low,
        high=high,
        unit=unit,
        shape=share.shape,
        size=float(share.values[largest]),
        peak=float(places[largest]),
        course=share.course,
    )


def _find_names_instead(search: SetSearch, found: EffectSet) -> NamesInstead | None:
    """Return the few effects that may be what a set leaves, where they are not told from it."""
    instead = search.seen.find_names_instead(found, _MOST_NAMES, TOLD_APART)
    if instead is None:
        return None
    (alone, lacking), own = instead, list_names(found.named)
    named = renumber(search.contest, alone).named
    further = tuple(each.effect for each in named if find_installed_name(each.effect) not in own)
    return NamesInstead(further, float(np.exp(-0.5 * lacking)))


def _remove_what_is_beside(fitted: Fit, found: EffectSet) -> Callable[[FloatArray], FloatArray]:
    """Return what leaves of a curve only that which neither the model nor a set can do as well."""
    design = fitted.design
    columns = [each.effect.columns(design, each.theta) for each in found.named]
    known = make_orthonormal_basis(np.concatenate([fitted.compute_base(), *columns], axis=1), _DEPENDENT)
    return lambda curve: np.asarray(curve - known @ (known.T @ curve), dtype=np.float64)


def make_remainder_of_run(fitted: Fit, found: SingleRun) -> Remainder:
    """Return what one run has that no other has."""
    design, squares = fitted.design, float(np.sum(fitted.residual**2))
    own, largest = design.time[design.cycle == found.run], int(np.argmax(np.abs(found.values)))
    return Remainder(
        rms=float(np.linalg.norm(found.values)) / len(found.values) ** 0.5,
        share=min(1.0, float(np.sum(found.values**2)) / squares),
        where=found.say_where(design),
        low=float(own.min()),
        high=float(own.max()),
        unit=_choose_unit(design, is_time=True),
        shape=found.shape,
        size=float(found.values[largest]),
        peak=float(design.time[largest]),
        formula=None,
        course=Course.RUNS,
    )


def find_irregular_remainder(fitted: Fit, noise: float, of: Fit) -> Remainder:
    """Return what is left where neither a form nor a smooth curve follows it: how large, and where most.

    What moves with time lies at no target, and is more than noise though it may pass for it.

    `noise`: What repeats scatter, m or rad; `of`: The job's model, of whose error the share is told.
    """
    design, squares = fitted.design, fitted.residual**2
    rms = max(float(np.mean(squares)) - noise**2, 0.0) ** 0.5
    share = min(1.0, rms**2 / float(np.mean(of.residual**2)))
    if _moves_with_time(fitted):
        curve = np.polynomial.Polynomial.fit(design.time, fitted.residual, _DRIFTS)(design.time)
        part = _describe_part(_Share(curve, Course.TIME, SLOW_DRIFT, None), design)
    else:
        by_target = np.bincount(design.target, weights=squares) / np.maximum(np.bincount(design.target), 1)
        widest = float(design.position[int(np.argmax(by_target[design.target]))])
        first, last = design.span
        part = RemainderPart(
            rms=rms,
            where=_MOST_AT.given(place=wording.position(design.axis, widest)),
            low=first,
            high=last,
            unit=design.axis.position_unit,
            shape=_IRREGULAR,
            size=float(fitted.residual[int(np.argmax(squares))]),
            peak=widest,
            course=Course.TARGET,
        )
    parts = {each.name: getattr(part, each.name) for each in fields(part)}
    return Remainder(**{**parts, "rms": rms}, share=share, formula=None)


def _moves_with_time(fitted: Fit) -> bool:
    """Return whether repeats follow each other as no chance orders them, over the test as a whole."""
    order = examine_time_order(find_residuals_of(fitted, fitted.noise))
    return order is not None and order.p_value < _ORDERED


def _list_shares(search: SetSearch, found: EffectSet) -> Iterator[_Share]:
    """Yield what each thing without a name explains, on the average over what the readings allow."""
    contest = search.contest
    space, values = contest.space, contest.columns.select_columns
    of_set = np.concatenate([np.empty((len(space.scale), 0)), *map(values, found.columns)], axis=1)
    factors = [space.of(each) for each in contest.list_factors(found.amplitudes)]
    together = np.concatenate([np.empty((len(space.scale), 0)), *factors], axis=1)
    inner = np.linalg.cholesky(np.eye(together.shape[1]) + together.T @ together)
    root = np.linalg.solve(inner, together.T)

    def weighed(columns: FloatArray) -> FloatArray:
        return np.asarray(columns - root.T @ (root @ columns))

    contrast = space.of(contest.deviation)
    solved = np.linalg.lstsq(of_set.T @ weighed(of_set), of_set.T @ weighed(contrast), rcond=1e-12)[0]
    left = weighed(contrast - of_set @ solved)
    first = 0
    for member in found.members:
        own = slice(first, first + len(member.columns))
        first = own.stop
        if not member.family.is_named:
            form = member.effect
            assert isinstance(form, UnnamedForm)  # noqa: S101 - no other effect has no name
            course = _COURSES.get(form.carrier, Course.PLACE)
            shape = _describe_shape(member, contest.design)
            yield _Share(space.single.undo_whitening(of_set[:, own] @ solved[own]), course, shape, member)
    active = [(part, level) for part, level in zip(contest.parts, found.amplitudes, strict=True) if level]
    for (part, level), factor in zip(active, factors, strict=True):
        if level >= part.noise_levels:
            explained = space.single.undo_whitening(factor @ (factor.T @ left))
            yield _Share(explained, part.course, part.shape, None)


def _choose_following(
    search: SetSearch, bare: EffectSet, whole: FloatArray, course: Course, score: float
) -> SetMember | None:
    """Return the form that is a start for what is left; None if none is.

    A form is a start for what is smooth. What is irregular no form follows, unless it could be that form.

    `score`: Of the set beside which it is left.
    """
    found = _find_following(search, bare, whole)
    if found is None or (course.is_irregular and not _may_be_irregular(found, score)):
        return None
    return found.member


@dataclass(frozen=True, slots=True)
class _Following:
    """A form beside a set, and how much of what is left it follows."""

    member: SetMember
    score: float  #: Of the set with it.
    share: float  #: Of the squares of what is left.


def _find_following(search: SetSearch, bare: EffectSet, whole: FloatArray) -> _Following | None:
    """Return the form that follows a curve best; None if none follows most of it."""
    contest, with_form = search.contest, search.find_best_with_form(bare)
    if with_form is None:
        return None
    form = with_form.members[-1]
    columns = form.effect.columns(contest.design, form.theta)
    columns = contest.space.single.undo_whitening(contest.space.of(columns))
    gamma = np.linalg.lstsq(columns, whole, rcond=1e-9)[0]
    share = 1.0 - float(np.sum((whole - columns @ gamma) ** 2) / np.sum(whole**2))
    return _Following(form, with_form.score, share) if share > _FOLLOWS else None


def _may_be_irregular(found: _Following, score: float) -> bool:
    """Return whether what is irregular from position to position may be a form: nothing in time is."""
    form = found.member.effect
    is_along_axis = isinstance(form, UnnamedForm) and form.carrier not in IN_TIME
    return is_along_axis and found.share > _IS_THAT and found.score <= score + TOLD_APART


def _propose_formula(form: SetMember, design: Design) -> FormulaKeys:
    assert isinstance(form.effect, UnnamedForm)  # noqa: S101 - no other effect has no name
    return form.effect.propose_formula(form.theta, design)


def _describe_shape(member: SetMember, design: Design) -> Words:
    """Return a form in words."""
    form = member.effect
    assert isinstance(form, UnnamedForm)  # noqa: S101 - no other effect has no name
    say, named = _make_sayer(design, is_time=form.carrier in IN_TIME), form.list_values(member.theta)
    words = form.form.shape.given(
        **{word: say(named[name]) for word, name in (("width", "w"), ("period", "L")) if name in named}
    )
    return CARRIERS[form.carrier].given(shape=words)


def _make_sayer(design: Design, *, is_time: bool) -> Callable[[float], Words]:
    if is_time:
        return lambda value: wording.span_of_time(design, value)
    return lambda value: wording.length(design.axis, value)


def _choose_unit(design: Design, *, is_time: bool) -> Unit:
    """Return the unit of places on an axis, or that of times: readings where these are counted."""
    dimension = Dimension.TIME if is_time else Dimension.POSITION
    return find_unit_on(design, dimension)


def _place(share: _Share, design: Design) -> tuple[Words, float, float, Unit]:
    """Return where something lies: in words, from where to where, and in which unit."""
    is_time, whole = share.course.along is not Along.PLACE, share.values
    say, unit = _make_sayer(design, is_time=is_time), _choose_unit(design, is_time=is_time)
    form = share.member.effect if share.member else None
    if isinstance(form, UnnamedForm) and share.member and form.form is not FADING:
        low, high = form.find_extent(share.member.theta)
        place = form.list_values(share.member.theta).get("c", low)
        is_local = form.form in LOCAL
        words = _ABOUT.given(place=say(place)) if is_local else _BETWEEN.given(first=say(low), last=say(high))
        return words, low, high, unit
    if share.course.along is Along.RUN:
        runs = np.unique(design.cycle)
        sizes = [float(np.mean(whole[design.cycle == run] ** 2)) for run in runs]
        run = int(runs[int(np.argmax(sizes))])
        own = design.time[design.cycle == run]
        return _RUN.given(run=run), float(own.min()), float(own.max()), unit
    labels = design.time if is_time else design.position
    along, group = np.unique(labels, return_inverse=True)
    squares = np.bincount(group, weights=whole**2) / np.bincount(group)
    if is_time:
        squares = _average_over_passes(squares, len(design.target_positions))
    low, high = _find_shortest_stretch(along, squares)
    if high - low > _ALL * (along[-1] - along[0]):
        low, high = float(along[0]), float(along[-1])
        return _BETWEEN.given(first=say(low), last=say(high)), low, high, unit
    return _ABOUT.given(place=say(float(along[int(np.argmax(squares))]))), low, high, unit


def _average_over_passes(squares: FloatArray, targets: int) -> FloatArray:
    """Return squares, averaged over as many readings as there are targets about each.

    What changes in time and acts by a lever, or in the reversal, is nothing at some targets: over a pass
    along the axis that averages out.
    """
    window = np.ones(min(targets, len(squares)))
    return np.asarray(
        np.convolve(squares, window, "same") / np.convolve(np.ones(len(squares)), window, "same")
    )


def _find_shortest_stretch(along: FloatArray, squares: FloatArray) -> tuple[float, float]:
    """Return the ends of the shortest stretch that holds most of some squares.

    A wave along the whole axis lies in all of it, not at its largest crest.
    """
    before = np.concatenate([[0.0], np.cumsum(squares)])
    last = np.searchsorted(before[1:], before[:-1] + _MOST * before[-1])
    firsts = np.flatnonzero(last < len(along))
    first = int(firsts[np.argmin(along[last[firsts]] - along[firsts])])
    return float(along[first]), float(along[int(last[first])])
