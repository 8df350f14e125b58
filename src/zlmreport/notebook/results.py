"""``evaluate`` for notebooks: parameters, findings and graphs of a standard."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from functools import cache, cached_property
from math import isnan
from typing import TYPE_CHECKING, Any, NamedTuple, Self

import numpy as np

from zlmreport.document.figures.figure import Figure
from zlmreport.errors import InputError, Place, Problem
from zlmreport.evaluation.decision import make_decision_rule, with_decisions
from zlmreport.evaluation.evaluate import evaluate as evaluate_by
from zlmreport.evaluation.evaluation import Arithmetic, EvaluatedParameter, Evaluation
from zlmreport.evaluation.report import collect_position_columns, report_evaluation, report_parameter
from zlmreport.evaluation.statistics import position_statistics
from zlmreport.job.evaluation_keys import DecisionRuleKeys, StandardKeys
from zlmreport.job.standards import choose_standards, convert_tolerances_to_si
from zlmreport.language import Language
from zlmreport.measurement.arrays import read_only_floats
from zlmreport.notebook.frames import Library, as_html, frame_of
from zlmreport.notebook.readings import Readings, checked, readings_of, registry, tree_of
from zlmreport.plugin.protocols import Standard

if TYPE_CHECKING:
    from matplotlib.axes import Axes

_NAME = "evaluate"


class Value(NamedTuple):
    """A parameter of the axis.

    Attributes
    ----------
    symbol, name
        As the results file and the standard call it: ``A``, ``E_fwd``.
    value
        µm or ″, unrounded.
    unit
        ``um`` or ``arcsec``.
    expanded_uncertainty, coverage_factor
        U = k·u and k; None where no budget was evaluated, as it is for a job.
    limit
        The tolerance that was given; None without one.
    statement
        What the decision rule says: ``pass``, ``fail`` and so on; None without a limit.
    conforms
        Whether the limit counts as kept; None without one, or where nothing is decided.
    """

    symbol: str
    name: str
    value: float
    unit: str
    expanded_uncertainty: float | None = None
    coverage_factor: float | None = None
    limit: float | None = None
    statement: str | None = None
    conforms: bool | None = None

    def __float__(self) -> float:
        """Return the value, µm or ″."""
        return self.value


class Result:
    """A test evaluated by a standard: ``result["A"].value``, ``result.positions``, ``result.plot()``."""

    def __init__(
        self, data: Readings, standard: Standard, options: Any, limits: Mapping[str, float], rule: str
    ) -> None:
        self.data = data
        self._standard = standard
        self._options = options
        self._limits = limits
        self._rule = rule

    @classmethod
    def of(cls, evaluation: Evaluation, standard: Standard, options: Any) -> Self:
        """Return an evaluation that was made already, with its uncertainties and decisions."""
        result = cls(Readings(evaluation.measurements), standard, options, {}, "simple")
        result.__dict__["evaluation"] = evaluation
        return result

    def __getstate__(self) -> dict[str, Any]:
        """Return what a copy in another process needs: plugins stay here, and go by their names."""
        kept = {name: value for name, value in self.__dict__.items() if name not in {"_standard", "_figures"}}
        return {**kept, "_standard": self._standard.identifier}

    def __setstate__(self, state: Mapping[str, Any]) -> None:
        """Take over what another process has of it."""
        self.__dict__.update(state)
        self._standard = registry().standard(state["_standard"])

    @cached_property
    def evaluation(self) -> Evaluation:
        """The same in SI, with findings, for those who go further down; no part of the stable interface."""
        bare = evaluate_by(self._standard, self.data.measurements, self._options, self._limits)
        return with_decisions(bare, make_decision_rule(self._rule))

    @cached_property
    def arithmetic(self) -> Arithmetic:
        """What the formulas of the standard give, in SI; no part of the stable interface."""
        return self._standard.arithmetic(
            position_statistics(self.data.grid, self.data.measurements.target_positions), self._options
        )

    @property
    def standard(self) -> str:
        """Identifier of the standard, edition included."""
        return self._standard.identifier

    def __getitem__(self, symbol: str) -> Value:
        """Return a parameter by its symbol.

        Raises
        ------
        KeyError
            If the standard has no such parameter, or this test does not define it; with those there are.
        """
        for each in self.parameters:
            if each.symbol == symbol:
                return each
        known = ", ".join(each.symbol for each in self.parameters)
        raise KeyError(f"{self.standard} gives no {symbol!r} for this test (it gives: {known})")

    def __contains__(self, symbol: object) -> bool:
        """Tell whether this test has a parameter of that symbol."""
        return any(symbol in (each, each.symbol) for each in self.parameters)

    def __iter__(self) -> Iterator[Value]:
        """Yield the parameters in the order of the standard."""
        return iter(self.parameters)

    @cached_property
    def parameters(self) -> tuple[Value, ...]:
        """The parameters that this test defines, in the order of the standard."""
        if self._limits or "evaluation" in self.__dict__:
            return tuple(map(self._make_value, self.evaluation.parameters))
        found, unit = self.arithmetic.parameters, self.data.measurements.axis.deviation_unit
        return tuple(
            Value(
                each.symbol,
                each.name.in_language(Language.ENGLISH),
                each.unit_or(unit).from_si(float(found[each.symbol])),
                each.unit_or(unit).ascii,
            )
            for each in self._standard.quantities
            if not isnan(found[each.symbol])
        )

    def _make_value(self, parameter: EvaluatedParameter) -> Value:
        unit = self.data.measurements.axis.deviation_unit
        found = report_parameter(parameter, unit, Language.ENGLISH)
        statement = found.get("decision", {}).get("statement")
        told: dict[str, Any] = {name: found.get(name) for name in Value._fields if name != "statement"}
        return Value(**told, statement=statement)

    @property
    def positions(self) -> Any:
        """A frame with a row for each target: ``target`` (mm or °), ``mean_fwd``, ``reversal`` … (µm or ″).

        Columns of the results file; NaN where the test does not define a value.
        """
        return self.to_frame()

    def to_frame(self, library: Library | None = None) -> Any:
        """Return `positions` as a frame of a library: ``pandas``, ``polars`` or ``pyarrow``.

        Without its name of that from which the readings came, that is in use, or that is installed.
        """
        unit = self.data.measurements.axis.deviation_unit
        columns = {
            symbol: read_only_floats(unit.from_si(values))
            for symbol, values in collect_position_columns(self.evaluation).items()
            if not np.all(np.isnan(values))
        }
        return frame_of({"target": self.data.targets, **columns}, library or self.data.library)

    def to_dict(self) -> dict[str, Any]:
        """Return the evaluation as the results file has it, with its findings."""
        return report_evaluation(self.evaluation)

    @property
    def findings(self) -> tuple[str, ...]:
        """What the standard asks of a test and this test does not meet, in sentences."""
        return tuple(
            f"{each.requirement.in_language(Language.ENGLISH)}: {each.found.in_language(Language.ENGLISH)}"
            for each in self.evaluation.findings
            if each.met is False
        )

    @property
    def graphs(self) -> tuple[str, ...]:
        """The keys of the graphs that the standard prescribes, the first of which `plot` draws."""
        return tuple(each.key for each in self._figures)

    @cached_property
    def _figures(self) -> tuple[Figure, ...]:
        return tuple(self._standard.figures(self.evaluation, self._options))

    def plot(self, ax: Axes | None = None, graph: str = "") -> Axes:
        """Draw a prescribed graph on axes of matplotlib, and return them.

        Parameters
        ----------
        ax
            Axes to draw on; a figure of its own is made without them.
        graph
            One of `graphs`; the first without it. Of a graph with several panels the first one is returned.
        """
        known = {figure.key: figure for figure in self._figures}
        if graph and graph not in known:
            raise KeyError(f"{self.standard} has no graph {graph!r} (it has: {', '.join(known)})")
        return draw_on(known[graph] if graph else self._figures[0], ax)[0]

    def plots(self) -> dict[str, list[Axes]]:
        """Draw all graphs that the standard prescribes, each in a figure of its own.

        Returns the axes of their panels by the keys of `graphs`.
        """
        return {figure.key: draw_on(figure, None) for figure in self._figures}

    def __repr__(self) -> str:
        """Return the parameters in one line."""
        values = ", ".join(f"{each.symbol} = {each.value:.4g} {each.unit}" for each in self.parameters)
        return f"<{self.standard}: {values}>"

    def _repr_html_(self) -> str:
        columns: dict[str, list[Any]] = {
            "Parameter": [each.name for each in self],
            "Symbol": [each.symbol for each in self],
            "Value": [each.value for each in self],
            "Unit": [each.unit for each in self],
            "U": [each.expanded_uncertainty for each in self],
            "Limit": [each.limit for each in self],
            "Statement": [each.statement for each in self],
        }
        told = {name: column for name, column in columns.items() if any(cell is not None for cell in column)}
        return as_html(tuple(told), zip(*told.values(), strict=True), self._standard.designation)


def evaluate(
    data: Readings,
    standard: str,
    *,
    tolerances: Mapping[str, float] | None = None,
    decision_rule: str = "simple",
    **keys: Any,
) -> Result:
    """Evaluate readings by a standard.

    Parameters
    ----------
    data
        The readings.
    standard
        Identifier of an installed standard, edition included: ``iso230-2:2014``.
    tolerances
        Limits by the symbols of the results file, µm or ″.
    decision_rule
        ``simple``, ``guard-band`` …; without the uncertainty budget of a job only the first decides.
    **keys
        The standard's own keys as in a job.

    Raises
    ------
    InputError
        If no plugin provides the standard, or it has no such keys or parameters.

    Examples
    --------
    >>> import zlmreport as z
    >>> up, down = [[0, 1.2, 2.1], [0.1, 1.0, 2.3]], [[-1, 0.4, 1.0], [-1.1, 0.2, 0.9]]
    >>> data = z.test([0, 50, 100], up, down)
    >>> result = z.evaluate(data, "iso230-2:2014", tolerances={"A": 8})
    >>> round(result["B"].value, 3), result["A"].conforms
    (1.25, True)
    """
    data = readings_of(data, _NAME)
    if not isinstance(tolerances, Mapping | None):
        raise InputError.at(Place(_NAME), "tolerances are limits by symbols, such as {'A': 20}")
    stated = tuple((tolerances or {}).items())
    chosen, options = _standard(standard, stated, tuple(sorted(keys.items(), key=str)))
    limits = {symbol: float(limit) for symbol, limit in stated}
    if decision_rule != "simple":
        checked(DecisionRuleKeys, {"rule": decision_rule}, _NAME)
    result = Result(
        data,
        chosen,
        options,
        convert_tolerances_to_si(limits, chosen, data.measurements.axis),
        decision_rule,
    )
    _ = result.arithmetic  # what cannot be evaluated fails here, and not when it is looked at
    return result


def _standard(
    identifier: str, limits: tuple[tuple[str, float], ...], keys: tuple[tuple[str, Any], ...]
) -> tuple[Standard, Any]:
    try:
        return _find_known_standard(identifier, limits, keys)
    except TypeError:  # a key whose value has no hash
        return _find_known_standard.__wrapped__(identifier, limits, keys)


@cache
def _find_known_standard(
    identifier: str, limits: tuple[tuple[str, float], ...], keys: tuple[tuple[str, Any], ...]
) -> tuple[Standard, Any]:
    """Return a standard with its keys checked; asked for again, the same."""
    asked = {"standard": identifier, "tolerances": dict(limits), **dict(keys)}
    checked(StandardKeys, asked, _NAME)
    problems: list[Problem] = []
    found = list(choose_standards(tree_of({"evaluate": [asked]}, _NAME), registry(), problems))
    if problems:
        raise InputError(Problem(Place(_NAME), each.message) for each in problems)
    return registry().standard(identifier), found[0].options


def draw_on(figure: Figure, ax: Axes | None) -> list[Axes]:
    """Return axes with the panels of a figure on them: those given, or axes of a new figure of matplotlib."""
    from zlmreport.document.figures import on_axes  # noqa: PLC0415 - it brings matplotlib

    axes = on_axes.make_axes(figure) if ax is None else [ax]
    on_axes.put(figure, axes)
    return axes
