"""The error model of an axis as a sum of effects: terms, links between parameters, identifiers."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from itertools import count

import numpy as np

from zlmreport.errors import InputError, count_in_words, did_you_mean
from zlmreport.job.effect_choices import EffectChoice, number_effect
from zlmreport.job.formula import FormulaError
from zlmreport.job.formula_keys import FormulaKeys
from zlmreport.language import Language
from zlmreport.measurement.arrays import BoolArray, FloatArray
from zlmreport.measurement.axis import AxisKind
from zlmreport.model.effects.design import Design
from zlmreport.model.effects.effect import Dimension, Effect, Parameter, find_unit_of
from zlmreport.model.effects.formula import FormulaEffect
from zlmreport.model.effects.model_error import ModelError

#: A combination of columns this much shorter than its longest member is zero but for rounding.
_ROUNDING = 1e-10
_TAKES_PART = 0.05
#: Condition of sine and cosine of a wave from which on they are one column but for rounded targets.
_ONE_PHASE = 1e3
#: Its square is a double.
_LARGEST = 1e150


@dataclass(frozen=True, slots=True)
class Term:
    """An effect in a model."""

    effect: Effect  #: The effect, in the form that the job asks for.
    #: Values of parameters that are given, or held at a bound, and not estimated, SI, by name.
    fixed: Mapping[str, float] = field(default_factory=dict)
    #: Between which parameters are estimated, SI, by name.
    bounds: Mapping[str, tuple[float, float]] = field(default_factory=dict)
    #: Parameters that equal one of another effect: its identifier and the name of its parameter, by name.
    links: Mapping[str, tuple[str, str]] = field(default_factory=dict)

    @property
    def parameters(self) -> tuple[Parameter, ...]:
        """Its parameters, the linear ones first."""
        return (*self.effect.linear, *self.effect.searched)

    @property
    def is_solved(self) -> BoolArray:
        """Which of its columns have a coefficient that is estimated for itself, shape (k,)."""
        return np.array([self._is_free(each) for each in self.effect.linear], dtype=np.bool_)

    def make_grid(self, design: Design) -> FloatArray:
        """Return the values of θ that its search begins with, given values put in their places."""
        grid = np.array(self.effect.grid(design), dtype=np.float64)
        for column, parameter in enumerate(self.effect.searched):
            if parameter.name in self.fixed:
                grid[:, column] = self.fixed[parameter.name]
            elif parameter.name in self.bounds and len(grid) > 1:
                low, high = self.bounds[parameter.name]
                ends = np.repeat(grid[:1], 2, axis=0)
                ends[:, column] = low, high
                grid = np.concatenate([grid, ends[np.isfinite(ends[:, column])]])
                grid[:, column] = np.clip(grid[:, column], low, high)
        return np.unique(grid, axis=0)

    def find_bound(self, parameter: Parameter) -> str:
        """Return the bound at which a parameter is held, ``min`` or ``max``; empty where it is at none."""
        if parameter.name not in self.fixed or parameter.name not in self.bounds:
            return ""
        return "min" if self.fixed[parameter.name] == self.bounds[parameter.name][0] else "max"

    def _is_free(self, parameter: Parameter) -> bool:
        return parameter.name not in self.fixed and parameter.name not in self.links

    def is_searched(self, design: Design) -> BoolArray:
        """Which values of θ are estimated, shape (s,): what is alike in all rows of a grid is known."""
        is_known = np.ptp(self.effect.grid(design), axis=0) == 0
        free = [self._is_free(each) for each in self.effect.searched]
        return np.asarray(np.array(free, dtype=np.bool_) & ~is_known)

    def compute_columns(self, design: Design, theta: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return the columns whose coefficients are estimated, and the deviation that is given."""
        columns = self.effect.columns(design, theta)
        solved = self.is_solved
        given = np.array([self.fixed.get(each.name, 0.0) for each in self.effect.linear])
        return columns[:, solved], columns[:, ~solved] @ given[~solved]

    def compute_some_columns(self, design: Design) -> FloatArray:
        """Return its columns at the first θ of its search where they are finite; at the last if nowhere."""
        for theta in self.make_grid(design):
            columns, _ = self.compute_columns(design, theta)
            if _are_finite(columns):
                break
        return columns


@dataclass(frozen=True, slots=True)
class AxisModel:
    """The sum of effects that describes an axis."""

    terms: tuple[Term, ...]  #: The effects, in the order of the job.

    @property
    def identifiers(self) -> tuple[str, ...]:
        """The identifiers of its effects."""
        return tuple(term.effect.identifier for term in self.terms)

    def with_effect(self, effect: Effect) -> AxisModel:
        """Return the model with one more effect; what that contains, or takes the place of, goes out."""
        replaced = {effect.identifier, *effect.contains}
        kept = tuple(term for term in self.terms if term.effect.identifier not in replaced)
        return AxisModel((*kept, Term(effect)))

    def take_next_of(self, effect: Effect) -> Effect:
        """Return an effect, or the next of it where it stands in the model already and may be several."""
        if not effect.several:
            return effect
        numbers = (
            number for number in count(1) if number_effect(effect.identifier, number) not in self.identifiers
        )
        return effect.repeated(next(numbers))

    def without(self, *identifiers: str) -> AxisModel:
        """Return the model without some effects."""
        return AxisModel(tuple(term for term in self.terms if term.effect.identifier not in identifiers))

    def link(self, thetas: Sequence[FloatArray]) -> tuple[FloatArray, ...]:
        """Return θ of all terms with those that equal another in their places."""
        found = [np.array(theta) for theta in thetas]
        for index, column, other, place in self._list_links(lambda effect: effect.searched):
            found[index][column] = thetas[other][place]
        return tuple(found)

    @property
    def linked_terms(self) -> tuple[tuple[int, ...], ...]:
        """The places of its terms, those together of which a parameter equals one of another."""
        groups = [{place} for place in range(len(self.terms))]
        for index, term in enumerate(self.terms):
            for name, _ in term.links.values():
                joined = [each for each in groups if each & {index, self.identifiers.index(name)}]
                groups = [each for each in groups if each not in joined] + [set().union(*joined)]
        return tuple(tuple(sorted(each)) for each in sorted(groups, key=min))

    def compute_columns(
        self, design: Design, thetas: Sequence[FloatArray]
    ) -> list[tuple[FloatArray, FloatArray]]:
        """Return of each term the columns that are solved, and the deviation that is given.

        A column whose coefficient equals another is added to that.
        """
        own = [term.compute_columns(design, theta) for term, theta in zip(self.terms, thetas, strict=True)]
        return self.add_linked(design, thetas, own)

    def add_linked(
        self, design: Design, thetas: Sequence[FloatArray], own: Sequence[tuple[FloatArray, FloatArray]]
    ) -> list[tuple[FloatArray, FloatArray]]:
        """Return what `compute_columns` does, from the columns of each term by itself."""
        found = list(own)
        for index, column, other, place in self._list_links(lambda effect: effect.linear):
            linked = self.terms[index].effect.columns(design, thetas[index])[:, column]
            target, (solved, given) = self.terms[other], found[other]
            if target.is_solved[place]:
                solved = solved.copy()
                solved[:, int(np.count_nonzero(target.is_solved[:place]))] += linked
            else:
                given = given + linked * target.fixed[target.effect.linear[place].name]
            found[other] = solved, given
        return found

    def collect_coefficients(self, solved: FloatArray) -> tuple[FloatArray, ...]:
        """Return γ of every term from those that were solved, side by side; given and linked ones besides."""
        found: list[FloatArray] = []
        first = 0
        for term in self.terms:
            gamma = np.array([term.fixed.get(each.name, 0.0) for each in term.effect.linear])
            count = int(np.count_nonzero(term.is_solved))
            gamma[term.is_solved] = solved[first : first + count]
            first += count
            found.append(gamma)
        for index, column, other, place in self._list_links(lambda effect: effect.linear):
            found[index][column] = found[other][place]
        return tuple(found)

    def find_followers(self, term: int, column: int) -> tuple[int, ...]:
        """Return the terms of which a searched parameter equals that of a term in a column."""
        searched = self._list_links(lambda effect: effect.searched)
        return tuple(index for index, _, other, place in searched if (other, place) == (term, column))

    def _list_links(
        self, parameters: Callable[[Effect], tuple[Parameter, ...]]
    ) -> Iterator[tuple[int, int, int, int]]:
        """Yield each linked parameter by its term and its place, and that which it equals by both."""
        for index, term in enumerate(self.terms):
            names = [each.name for each in parameters(term.effect)] if term.links else []
            for column, name in enumerate(names):
                if name in term.links:
                    other = self.identifiers.index(term.links[name][0])
                    own = [each.name for each in parameters(self.terms[other].effect)]
                    yield index, column, other, own.index(term.links[name][1])

    def check(self, design: Design) -> None:
        """Refuse a model that makes no sense on a design.

        Raises `ModelError` with every mistake: an effect twice or beside one that contains it, a value given
        for a parameter that there is not, an effect that the test cannot show, too few readings.
        """
        sentences = [*self._list_clashes(), *self._list_unknown_parameters(), *self._list_wrong_links()]
        sentences += self._list_untestable(design)
        if not sentences:
            estimated = sum(
                int(np.count_nonzero(term.is_solved) + np.count_nonzero(term.is_searched(design)))
                for term in self.terms
            )
            if len(design.position) <= estimated:
                sentences.append(
                    f"the model has {count_in_words(estimated, 'parameter')} to estimate and the test "
                    f"{count_in_words(len(design.position), 'reading')}; measure more, or take effects out"
                )
        if sentences:
            raise ModelError(sentences)

    def _list_clashes(self) -> Iterator[str]:
        names = self.identifiers
        for name in dict.fromkeys(names):
            if names.count(name) > 1:
                yield f"{name} stands in the model {names.count(name)} times; once is enough"
        for term in self.terms:
            for contained in term.effect.contains:
                if contained in names:
                    name = term.effect.identifier
                    yield f"{name} contains {contained}, and no readings part the two; remove {contained}"

    def _list_unknown_parameters(self) -> Iterator[str]:
        for term in self.terms:
            known = [parameter.name for parameter in term.parameters]
            for name in term.fixed:
                if name not in known:
                    advice = did_you_mean(name, known)
                    yield f"{term.effect.identifier} has no parameter {name!r}; {advice}"

    def _list_wrong_links(self) -> Iterator[str]:
        by_identifier = {term.effect.identifier: term for term in self.terms}
        for term in self.terms:
            for name, (other, parameter) in term.links.items():
                said = f"{term.effect.identifier} cannot have {name} equal to {other}.{parameter}"
                if other not in by_identifier or other == term.effect.identifier:
                    yield f"{said}: {other} is no other effect of the model"
                    continue
                target = by_identifier[other].effect
                known = _list_kinds(target)
                own, found = _list_kinds(term.effect).get(name), known.get(parameter)
                if found is None:
                    yield f"{said}: {other} has no such parameter; {did_you_mean(parameter, list(known))}"
                elif found != own:
                    yield f"{said}: the two are different quantities, or only one is searched"
                elif parameter in by_identifier[other].links:
                    yield f"{said}, which equals another itself; link both to that"

    def _list_untestable(self, design: Design) -> Iterator[str]:
        for term in self.terms:
            why = term.effect.untestable(design)
            if why is not None:
                yield (
                    f"{term.effect.identifier} cannot be fitted to these readings: "
                    f"{why.in_language(Language.ENGLISH)}"
                )


def _list_kinds(effect: Effect) -> dict[str, tuple[Dimension, bool]]:
    """Return of each parameter what quantity it is, and whether it is searched."""
    return {
        each.name: (each.dimension, each in effect.searched) for each in (*effect.linear, *effect.searched)
    }


def _are_finite(columns: FloatArray) -> bool:
    """Whether the columns of an effect are finite, and their squares: what is fitted is a sum of squares."""
    return bool(np.all(np.abs(columns) < _LARGEST))


def refuse_collisions(model: AxisModel, columns: Sequence[FloatArray]) -> None:
    """Raise `ModelError` if columns of a model depend on each other, with the effects of each dependence."""
    if not columns:
        return
    names = model.identifiers
    endless = [name for name, own in zip(names, columns, strict=True) if not _are_finite(own)]
    if endless:
        said = "has no finite value at these readings; change the ranges of its parameters"
        raise ModelError([f"{name} {said}" for name in endless])
    owner = np.repeat(np.arange(len(columns)), [each.shape[1] for each in columns])
    together = np.concatenate(columns, axis=1)
    lengths = np.linalg.norm(together, axis=0)
    silent = [names[index] for index in dict.fromkeys(owner[lengths == 0].tolist())]
    if silent:
        raise ModelError([f"{name} has no influence on any of these readings; remove it" for name in silent])
    _, singular, right = np.linalg.svd(together / lengths, full_matrices=len(together) < len(lengths))
    singular = np.concatenate([singular, np.zeros(len(lengths) - len(singular))])
    sentences = [
        f"these readings do not determine all parameters of {term.effect.identifier}; remove it"
        for term, own in zip(model.terms, columns, strict=True)
        if _sees_one_phase(term, own)
    ]
    for direction in right[singular <= _ROUNDING * singular.max(initial=0.0)]:
        part = np.abs(direction) > _TAKES_PART * np.abs(direction).max()
        taking = [names[index] for index in dict.fromkeys(owner[part].tolist())]
        if len(taking) == 1:
            sentences.append(f"these readings do not determine all parameters of {taking[0]}; remove it")
        else:
            listed = ", ".join(taking[:-1]) + f" and {taking[-1]}"
            sentences.append(f"these readings cannot tell {listed} apart; remove one of them")
    if sentences:
        raise ModelError(list(dict.fromkeys(sentences)))


def _sees_one_phase(term: Term, columns: FloatArray) -> bool:
    """Return whether sine and cosine of a wave go together: all targets lie at whole and half periods of one.

    `columns`, (N, k): Those of the term whose coefficients are solved.
    """
    solved = zip(term.effect.linear, term.is_solved, strict=True)
    places = {each.name: place for place, each in enumerate(each for each, is_free in solved if is_free)}
    waves = [
        columns[:, [place, places[cosine]]]
        for name, place in places.items()
        if name.startswith("sine") and (cosine := name.replace("sine", "cosine", 1)) in places
    ]
    return any(np.linalg.cond(each) > _ONE_PHASE for each in waves)


def choose_effect(choice: EffectChoice, find: Callable[[str], Effect], kind: AxisKind) -> Effect:
    """Return an effect that a file names or writes as a formula, in the form that it asks for.

    Raises `InputError` if a formula is not meant for an axis of this kind.
    """
    if not isinstance(choice.settings, FormulaKeys):
        return find(choice.installed).repeated(choice.number).with_settings(choice.settings)
    try:
        return FormulaEffect(choice.settings, kind)
    except FormulaError as error:
        raise InputError.at(choice.place, f"{'.'.join((choice.identifier, *error.key))}: {error}") from error


def choose_terms(
    choices: Iterable[EffectChoice], find: Callable[[str], Effect], kind: AxisKind
) -> tuple[Term, ...]:
    """Return the effects that a file names, in the forms that it asks for."""
    return tuple(_make_term(choice, find, kind) for choice in choices)


def _make_term(choice: EffectChoice, find: Callable[[str], Effect], kind: AxisKind) -> Term:
    effect = choose_effect(choice, find, kind)
    units = {each.name: find_unit_of(each.dimension, kind) for each in (*effect.linear, *effect.searched)}
    bounds, links = {}, {}
    for name, limits in choice.limits.items():
        if limits.equals is not None:
            other, _, parameter = limits.equals.partition(".")
            links[name] = other, parameter
        else:
            low = -np.inf if limits.min is None else limits.min / units[name].per_si
            high = np.inf if limits.max is None else limits.max / units[name].per_si
            bounds[name] = low, high
    fixed = {name: value / units[name].per_si for name, value in choice.values.items()}
    return Term(effect, fixed, bounds, links)
