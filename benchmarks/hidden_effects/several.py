"""Several causes at once, from an empty model: drawn axes, each built step by step as the advice says.

Two to four causes of the catalogue act together, each of 1.5 to 4 σ beyond a constant, on half of the axes a
stranger beside them; linear and rotary axes, three or five runs, σ from 0.05 to 3 µm. What is found is told
axis by axis: a cause counts as found if it stands in the model at the end. What is said is wrong where
neither a name nor one of those that are named as its equals has a cause of its own, or is a part of one by
its definition, as a slope is of a polynomial. Where a stranger changes the gap between the directions, lost
motion is the mean of that gap, and where it changes a slope, a scale error the mean of that.

A stranger counts as placed if it is larger where what is left without a name is told to lie than elsewhere.
Strangers that one or two installed effects describe as well are no strangers to an observer who knows all of
these: they stand in brackets.
"""

from __future__ import annotations

import argparse
import time
from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from hidden_effects.drawn_axes import drawn_linear_test, drawn_rotary_test
from hidden_effects.hidden import drawn_effect
from hidden_effects.ideal import kind_of, tells_stranger, told_apart
from hidden_effects.judge import INSTALLED
from hidden_effects.sizes import base_columns
from hidden_effects.strangers import NUMBERS_OF, OF_A_PLACE, OF_A_SLOPE, STRANGERS
from hidden_effects.trial import EFFECTS, OF_A_GAUGE, drawn_stranger, measured, sum_of
from hidden_effects.weather import wandering
from zlmreport.measurement.arrays import FloatArray
from zlmreport.measurement.units import MICROMETRE
from zlmreport.model.diagnosis.building import build
from zlmreport.model.diagnosis.contest import Told
from zlmreport.model.diagnosis.diagnosis import AxisDiagnosis, DiagnosisVerdict, diagnose
from zlmreport.model.diagnosis.remainder import Remainder, RemainderPart
from zlmreport.model.effects.axis_model import AxisModel, Term
from zlmreport.model.effects.design import Design
from zlmreport.model.fitting.observations import Observations, make_observations_of
from zlmreport.model.planning.methods import Method
from zlmreport.model.simulation.description import SimulatedNoise
from zlmreport.model.simulation.simulate import make_design_of

_SIGMAS = (0.05, 0.3, 0.8, 3.0)  # µm; on a rotary axis as many µm at a radius of one metre
_SIZES = (1.5, 4.0)  # in σ
_CAUSES, _RUNS, _TARGETS = (2, 3, 4), (3, 5), 21
_ROTARY_SHARE = 0.2
_SEED = 20_261_126
#: The constant is in the model, and a cosine error is a scale error.
_NOT_DRAWN = OF_A_GAUGE | {"offset", "cosine-error"}
#: What the mean of a gap between the directions and that of a slope are called, and from what on they are
#: seen, in squares of their uncertainty.
_MEAN_GAP, _MEAN_SLOPE, _SEEN = "backlash", "scale-error", 16.0
#: How much is most of a stranger, and the share of what was measured that one takes which lies everywhere.
_MOST, _HALF = 0.8, 0.5
#: Error over σ up to which nothing but noise is left.
DOWN_TO_NOISE = 1.15


@dataclass(frozen=True, slots=True)
class Drawn:
    """An axis with several causes."""

    causes: tuple[str, ...]
    told_apart: frozenset[str]  #: Those of them that an ideal observer tells from all else.
    stranger: str | None
    observed: Observations
    sigma: float  #: m or rad.
    #: (N,): What the stranger adds to each reading, m or rad: less its mean where that is at no place.
    beside: FloatArray | None = None
    is_stranger_told: bool = False  #: Whether an ideal observer tells it from each one or two effects.

    @property
    def in_stranger(self) -> tuple[str, ...]:
        """Effects that the stranger has by their definition."""
        if self.beside is None:
            return ()
        design = self.observed.design
        parts = [(_MEAN_GAP, design.direction)]
        if self.stranger in OF_A_SLOPE:
            parts.append((_MEAN_SLOPE, design.position))
        return tuple(name for name, along in parts if _is_seen(self.beside, along, self.sigma))


@dataclass(frozen=True, slots=True)
class Outcome:
    """What came of building a model of it."""

    drawn: Drawn
    built: tuple[str, ...]  #: Effects of the model at the end, but for the constant.
    equals: Mapping[str, frozenset[str]]  #: Effects that the build names as equals of each that it added.
    left: float  #: Error at the end, over σ.
    remainder: bool  #: Whether something is told to be left without a name.
    is_placed: bool  #: Whether the stranger is larger where it is told to lie than elsewhere.
    is_unexplained: bool  #: Whether a diagnosis on the way said that no installed effect explains the rest.
    is_nameless: bool  #: Whether one of these named no effect either that may be it, at what odds.
    seconds: float  #: CPU of the dearest diagnosis.

    @property
    def found(self) -> tuple[str, ...]:
        """Causes that stand in the model."""
        return tuple(each for each in self.drawn.causes if each in self.built)

    @property
    def told(self) -> tuple[str, ...]:
        """Those found among the causes that an ideal observer tells from all else."""
        return tuple(each for each in self.found if each in self.drawn.told_apart)

    @property
    def as_equals(self) -> tuple[str, ...]:
        """Causes that stand in the model, or were named as equals of what stands there."""
        named = {name for each in self.built for name in (each, *self.equals.get(each, ()))}
        return tuple(each for each in self.drawn.causes if each in named)

    @property
    def others(self) -> tuple[str, ...]:
        """Names that no cause has."""
        return tuple(each for each in self.built if each not in self.drawn.causes)

    @property
    def wrong(self) -> tuple[str, ...]:
        """Those where what is said is wrong: no cause that has no name yet is said, or has them as a part."""
        own = (*self.drawn.causes, *self.drawn.in_stranger)
        unnamed = [each for each in own if each not in self.built]
        found = []
        for each in self.others:
            said = {each, *self.equals.get(each, ())}
            own = next((other for other in unnamed if said & {other, *EFFECTS[other].contains}), None)
            if own is not None:
                unnamed.remove(own)
            elif each not in self.drawn.in_stranger:
                found.append(each)
        return tuple(found)


def _is_seen(deviation: FloatArray, along: FloatArray, sigma: float) -> bool:
    """Return whether the share of a deviation that is proportional to something is seen beside noise."""
    lever = along - along.mean()
    squares = float(lever @ lever)
    return squares > 0.0 and float(lever @ deviation) ** 2 > _SEEN * sigma**2 * squares


def drawn_axis(number: int, *, with_stranger: bool, targets: int = _TARGETS) -> Drawn:
    """Return an axis; the same number gives the same.

    `targets`: How many; others than as a rule lie anywhere, as a pitch has no room for many.
    """
    random = np.random.default_rng([_SEED, number, with_stranger])
    is_rotary = random.random() < _ROTARY_SHARE
    method = (Method.LINEAR, Method.PENDULUM)[int(random.integers(2))]
    draw = drawn_rotary_test if is_rotary else drawn_linear_test
    description = draw(random, method, _TARGETS, int(random.choice(_RUNS)))
    if targets != _TARGETS:
        anywhere = np.sort(random.uniform(*description.axis.travel, targets))
        description = replace(description, plan=replace(description.plan, targets=anywhere))
    sigma = float(MICROMETRE.to_si(_SIGMAS[number % len(_SIGMAS)]))
    description = replace(description, noise=SimulatedNoise(reading=sigma))
    design = wandering(make_design_of(description), random)
    base = base_columns([EFFECTS["offset"]], design)
    causes: list[Term] = []
    for name in random.permutation(sorted(EFFECTS.keys() - _NOT_DRAWN)).tolist():
        size = sigma * float(random.uniform(*_SIZES))
        term = drawn_effect(EFFECTS[name], design, base, size, random)
        if term is not None:
            causes.append(term)
        if len(causes) == _CAUSES[number % len(_CAUSES)]:
            break
    deviation, stranger, beside = sum_of(causes, design), None, None
    if with_stranger:
        rms = sigma * float(random.uniform(*_SIZES))
        for name in random.permutation(sorted(STRANGERS)).tolist():
            drawn = drawn_stranger(STRANGERS[name], design, base, rms, random)
            if drawn is not None:
                stranger, deviation = name, deviation + drawn[1]
                beside = drawn[1] - (0.0 if name in OF_A_PLACE else drawn[1].mean())
                break
    readings = measured(description, design, np.zeros(len(deviation)), deviation).measurements
    observed = make_observations_of(readings, overrun=description.plan.overrun)
    return Drawn(
        tuple(sorted(each.effect.identifier for each in causes)),
        frozenset(_told_apart(causes, stranger, design, sigma)),
        stranger,
        observed,
        sigma,
        beside,
        beside is not None and _tells_stranger(stranger, beside, causes, design, sigma),
    )


def _told_apart(
    causes: Sequence[Term], stranger: str | None, design: Design, sigma: float
) -> tuple[str, ...]:
    beside = base_columns([EFFECTS["offset"]], design)
    if stranger is not None:
        kind = kind_of(STRANGERS[stranger], design, np.random.default_rng(_SEED))
        beside = np.column_stack([beside, kind])
    return told_apart(causes, design, sigma, INSTALLED, beside)


def _tells_stranger(
    name: str, beside: FloatArray, causes: Sequence[Term], design: Design, sigma: float
) -> bool:
    kind = kind_of(STRANGERS[name], design, np.random.default_rng(_SEED))
    parameters = NUMBERS_OF.get(name, kind.shape[1])
    base = base_columns([EFFECTS["offset"]], design)
    return tells_stranger(
        beside, parameters, causes=causes, design=design, sigma=sigma, effects=INSTALLED, base=base
    )


def followed(drawn: Drawn) -> Outcome:
    """Return what comes of following the advice from an empty model."""
    seconds: list[float] = []
    unexplained: list[AxisDiagnosis] = []

    def diagnosing(model: AxisModel, may_go: frozenset[str], told: Told) -> AxisDiagnosis:
        started = time.process_time()
        found = diagnose(model, drawn.observed, INSTALLED, may_go=may_go, told=told)
        seconds.append(time.process_time() - started)
        if found.verdict is DiagnosisVerdict.UNEXPLAINED:
            unexplained.append(found)
        return found

    built = build(AxisModel((Term(EFFECTS["offset"]),)), diagnosing)
    names = tuple(each for each in built.model.identifiers if each != "offset")
    equals = {each.identifier: frozenset(each.equals) for each in built.steps if not each.is_removed}
    left, remainder = built.last.error.rms / drawn.sigma, built.last.remainder
    is_placed = remainder is not None and is_where_told(remainder, drawn)
    is_nameless = any(each.remainder is None or each.remainder.instead is None for each in unexplained)
    return Outcome(
        drawn,
        names,
        equals,
        left,
        remainder is not None,
        is_placed,
        is_unexplained=bool(unexplained),
        is_nameless=is_nameless,
        seconds=max(seconds),
    )


def is_where_told(remainder: Remainder, drawn: Drawn) -> bool:
    """Return whether the stranger is where one of the parts of a remainder is told to be."""
    return any(_is_where_part_is(each, drawn) for each in (remainder, *remainder.further))


def _is_where_part_is(part: RemainderPart, drawn: Drawn) -> bool:
    """Return whether the stranger is larger between the ends of a part, or in its run, than elsewhere.

    Of one that is told to lie in all that was measured, whether more than half of that is needed to hold most
    of it.
    """
    if drawn.beside is None:
        return False
    design = drawn.observed.design
    where = design.time if part.unit.symbol == "s" else design.position
    is_inside = (part.low <= where) & (where <= part.high)
    if "run" in part.where.values:
        is_inside = design.cycle == part.where.values["run"]  # of pendulum runs each lasts all the time
    inside, outside = drawn.beside[is_inside] ** 2, drawn.beside[~is_inside] ** 2
    if len(outside) == 0:
        return _find_least_share(where, inside) > _HALF
    return len(inside) > 0 and float(inside.mean()) > float(outside.mean())


def _find_least_share(where: FloatArray, squares: FloatArray) -> float:
    """Return the share of what was measured that is needed to hold most of some squares."""
    order = np.argsort(where, kind="stable")
    along, held = where[order], np.cumsum(squares[order])
    before = np.concatenate([[0.0], held[:-1]])
    last = np.searchsorted(held, before + _MOST * held[-1])
    is_held = last < len(along)
    return float(np.min(along[last[is_held]] - along[is_held]) / np.ptp(along))


def report(outcomes: Sequence[Outcome]) -> str:
    """Return the single cases as a table, and their sums below."""
    return "\n".join((*_table(outcomes), "", _sums(outcomes)))


def _table(outcomes: Sequence[Outcome]) -> Iterator[str]:
    yield "| σ in µm | causes | stranger | found | wrong | left in σ | without a name | where it is |"
    yield "|---|---|---|---|---|---|---|---|"
    for each in outcomes:
        of = each.drawn
        place = "–" if of.stranger is None else "yes" if each.is_placed else "no"
        stranger = of.stranger or "–"
        if of.stranger and not of.is_stranger_told:
            stranger = f"({stranger})"
        yield (
            f"| {MICROMETRE.from_si(of.sigma):.2g} | {_marked(of)} | {stranger} | "
            f"{len(each.found)} of {len(of.causes)} | {_list_others(each)} | {each.left:.2f} | "
            f"{'yes' if each.remainder else 'no'} | {place} |"
        )


def _list_others(outcome: Outcome) -> str:
    """Return the names that no cause has, those in brackets with which what is said is right."""
    names = [each if each in outcome.wrong else f"({each})" for each in outcome.others]
    return ", ".join(names) or "–"


def _marked(drawn: Drawn) -> str:
    """Return the causes, those in brackets that an ideal observer does not tell from all else."""
    return ", ".join(each if each in drawn.told_apart else f"({each})" for each in drawn.causes)


def _sums(outcomes: Sequence[Outcome]) -> str:
    def summed(of: Callable[[Outcome], Collection[str]]) -> int:
        return sum(len(of(each)) for each in outcomes)

    whole = sum(len(each.found) == len(each.drawn.causes) for each in outcomes)
    down = sum(each.left <= DOWN_TO_NOISE for each in outcomes)
    named = sum(each.remainder for each in outcomes)
    strangers = sum(each.drawn.stranger is not None for each in outcomes)
    unexplained = sum(each.is_unexplained for each in outcomes)
    nameless = sum(each.is_nameless for each in outcomes)
    placed = sum(each.is_placed for each in outcomes)
    seconds = np.median([each.seconds for each in outcomes])
    others, wrong = summed(lambda each: each.others), summed(lambda each: each.wrong)
    return (
        f"{len(outcomes)} axes: {summed(lambda each: each.found)} of "
        f"{summed(lambda each: each.drawn.causes)} causes found, other names: {others}, of them wrong: "
        f"{wrong}, the whole set in {whole}, down to {DOWN_TO_NOISE} σ in {down}, something left without a "
        f"name in {named}, where the stranger is in {placed} of {strangers}; told on the way that nothing "
        f"installed explains what is left in {unexplained}, in {nameless} of them without a name that may be "
        f"it; the dearest diagnosis of an axis takes {seconds:.1f} s of CPU in the median.\n"
        f"Of the causes that an ideal observer tells from all else {summed(lambda each: each.told)} of "
        f"{summed(lambda each: each.drawn.told_apart)} are found; {summed(lambda each: each.as_equals)} of "
        f"all stand in the model or are named as equals of what stands there."
        f"{_sum_up_strangers([each for each in outcomes if each.drawn.is_stranger_told])}"
    )


def _sum_up_strangers(outcomes: Sequence[Outcome]) -> str:
    """Return what is said of strangers that an ideal observer tells from one or two installed effects."""
    if not outcomes:
        return ""
    return (
        f"\n{len(outcomes)} strangers are told by that observer from each one or two installed effects: "
        f"beside these {sum(len(each.wrong) for each in outcomes)} names are wrong, something is left "
        f"without a name in {sum(each.remainder for each in outcomes)}, where the stranger is in "
        f"{sum(each.is_placed for each in outcomes)}."
    )


def main(arguments: Sequence[str]) -> None:
    """Draw axes, build their models, and print what came of it."""
    parser = argparse.ArgumentParser(
        prog="./run benchmark several", description="Build models of axes with several causes, from nothing."
    )
    parser.add_argument("--axes", type=int, default=40, help="how many (%(default)s)")
    parser.add_argument("--first", type=int, default=1000, help="number of the first (%(default)s)")
    parser.add_argument("--stranger", action="store_true", help="with a shape outside the catalogue beside")
    parser.add_argument("--targets", type=int, default=_TARGETS, help="of each test (%(default)s)")
    asked = parser.parse_args(arguments)
    numbers = range(asked.first, asked.first + asked.axes)
    drawn = (drawn_axis(each, with_stranger=asked.stranger, targets=asked.targets) for each in numbers)
    print(report([followed(each) for each in drawn]))
