"""Each check of a standard passes the exemplary one, and finds the sin it is there for."""

from __future__ import annotations

import itertools
from collections.abc import Callable, Iterable, Iterator
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from pydantic import Field

from refusals import failure
from testing.exemplary import ExemplaryOptions, ExemplaryStandard
from testing.sinning import make_sinner, make_tests
from zlmreport.plugin import Evaluation, Figure, Options, Words, same_in_all_languages as same
from zlmreport.plugin.standard import (
    Arithmetic,
    Arrow,
    Finding,
    Level,
    PositionQuantity,
    PositionStatistics,
    Role,
    largest_over_positions as largest,
)
from zlmreport.testing import (
    STANDARD_CHECKS,
    WorkedExample,
    arithmetic,
    bidirectional_test,
    check_standard,
    standards,
)
from zlmreport.testing.examples import every_key_matters, gives_the_worked_values
from zlmreport.testing.standards import (
    brackets_are_as_long_as_their_parameter,
    brackets_span_what_is_drawn,
    curves_have_a_value_at_each_position,
    figures_are_worded,
    figures_of_any_test,
    marks_have_finite_ends,
    marks_stand_at_targets,
)

E, R = ExemplaryStandard.quantities
(WIDTH,) = ExemplaryStandard.position_quantities
GERMAN_ONLY = Words(en=" ", de="Bedeutung")
UNFILLED = Words(en="{value} and {other}", de="{value} und {other}").given(value=1)

EXEMPLARY = ExemplaryStandard()
COUNTER = itertools.count()


class UndescribedOptions(Options):
    factor: float = 2.0


class GreedyOptions(Options):
    tolerances: float = Field(2.0, description="Taken.")


def requiring(finding: Any) -> Callable[..., Iterable[Any]]:
    return lambda *_: [finding]


def refusing(_self: object, measurements: Any, _options: object) -> Iterator[Finding]:
    yield Finding(same("Spacing"), same(str(measurements.target_positions[1])), met=None)


def fickle_requirement(*_: object) -> Iterator[Finding]:
    yield Finding(same("Asked"), same(f"{next(COUNTER)} times"), met=True)


def with_values(change: Callable[[PositionStatistics, dict[str, Any]], object]) -> Callable[..., Arithmetic]:
    """Return an arithmetic whose parameters a function has changed in place."""

    def changed(_self: object, statistics: PositionStatistics, options: Any) -> Arithmetic:
        result = EXEMPLARY.arithmetic(statistics, options)
        parameters = dict(result.parameters)
        change(statistics, parameters)
        return Arithmetic(parameters, result.positions)

    return changed


def with_e(formula: Callable[[PositionStatistics], Any]) -> Callable[..., Arithmetic]:
    """Return an arithmetic with another formula for E."""
    return with_values(lambda statistics, values: values.update(E=formula(statistics)))


def with_figure(change: Callable[[Figure], Figure]) -> Callable[..., Iterable[Figure]]:
    def changed(_self: object, evaluation: Evaluation, options: Any) -> Iterable[Figure]:
        return [change(figure) for figure in EXEMPLARY.figures(evaluation, options)]

    return changed


def with_panel(**changes: Callable[[Any], Any]) -> Callable[..., Iterable[Figure]]:
    """Return figures whose panel has been changed field by field."""

    def change(figure: Figure) -> Figure:
        (panel,) = figure.panels
        fields = {name: function(panel) for name, function in changes.items()}
        return replace(figure, panels=(replace(panel, **fields),))

    return with_figure(change)


def with_bracket(**ends: Any) -> Callable[..., Iterable[Figure]]:
    return with_panel(brackets=lambda panel: (replace(panel.brackets[0], **ends),))


def no_figures_of_one_target(_self: object, evaluation: Evaluation, options: Any) -> Iterable[Figure]:
    evaluation.measurements.target_positions[1]
    return EXEMPLARY.figures(evaluation, options)


TEST = bidirectional_test([0, 100], [[1.0, 3.0], [5.0, 7.0]], [[-11.0, -9.0], [-7.0, -5.0]])
ALIKE = bidirectional_test([0, 100], [[1.0, 3.0], [5.0, 7.0]], [[1.0, 3.0], [5.0, 7.0]])
WITHOUT_SCATTER = bidirectional_test([0, 100], [[1.0], [5.0]], [[-11.0], [-7.0]])
EXAMPLE = WorkedExample(TEST, {"E": 4.0, "R": 5.656854})
EXAMPLES = [EXAMPLE]


def _of(*, factor: float = 2.0, reversal: float = 0.0) -> Callable[..., Arithmetic]:
    """Return formulas with another factor, or another term."""

    def arithmetic(_self: Any, statistics: PositionStatistics, _options: Any) -> Arithmetic:
        found = EXEMPLARY.arithmetic(statistics, ExemplaryOptions(factor=factor))
        added = reversal * largest(np.abs(statistics.mean_positive - statistics.mean_negative))
        return replace(found, parameters={**found.parameters, "R": found.parameters["R"] + added})

    return arithmetic


SINS = [
    (gives_the_worked_values, {"arithmetic": _of(factor=3.0)}, "R is 8.48528 µm; the example has 5.65685"),
    (gives_the_worked_values, {"arithmetic": _of(factor=1.0)}, "R is 2.82843 µm; the example has 5.65685"),
    (gives_the_worked_values, {"arithmetic": _of(reversal=1.0)}, "a term that was left out"),
    (
        every_key_matters,
        {"arithmetic": _of()},
        "job key 'factor' is ignored: 5.0 or 3.0 or 1.0 or 1.0 gives what 2.0 gives",
    ),
    (standards.is_named, {"identifier": "EX 1"}, "lower-case ASCII"),
    (standards.is_named, {"designation": " "}, "designation"),
    (standards.is_named, {"title": GERMAN_ONLY}, "title says nothing in 'en'"),
    (standards.is_named, {"title": "A norm"}, "title must be Words"),
    (standards.is_named, {"position_index": "k"}, "position_index 'k' must be 'i' or 'j'"),
    (standards.is_named, {"notes": (UNFILLED,)}, "note 1 cannot be written in 'en'"),
    (standards.options_are_described, {"options": dict}, "must be a subclass"),
    (standards.options_are_described, {"options": UndescribedOptions}, "'factor' needs a description"),
    (standards.options_are_described, {"options": GreedyOptions}, "tolerances belong to the core"),
    (standards.symbols_are_unique, {"quantities": ()}, "reports no parameter"),
    (standards.symbols_are_unique, {"quantities": (E, E)}, "'E' is there 2 times"),
    (standards.symbols_are_unique, {"quantities": (replace(E, symbol="Ē"),)}, "must be ASCII"),
    (standards.symbols_are_unique, {"position_quantities": (WIDTH, WIDTH)}, "'width' is there 2 times"),
    (
        standards.symbols_are_unique,
        {"position_quantities": (PositionQuantity("mean", "m", same("mean")),)},
        "'mean' is a column of every table",
    ),
    (standards.quantities_are_worded, {"quantities": (replace(E, notation=""),)}, "E: notation"),
    (
        standards.quantities_are_worded,
        {"quantities": (replace(E, name=GERMAN_ONLY),)},
        "E: name says nothing",
    ),
    (standards.quantities_are_worded, {"quantities": (replace(E, meaning=GERMAN_ONLY),)}, "E: meaning says"),
    (standards.quantities_are_worded, {"quantities": (replace(E, formula=" "),)}, "E: formula"),
    (standards.quantities_are_worded, {"quantities": (replace(E, group="random"),)}, "E: group"),
    (
        standards.requirements_never_refuse,
        {"requirements": refusing},
        "(on a single reading); a test that falls short",
    ),
    (standards.requirements_never_refuse, {"requirements": requiring("five")}, "each must be Finding"),
    (
        standards.requirements_never_refuse,
        {"requirements": requiring(Finding(same("a"), same("b"), "yes"))},  # type: ignore[arg-type]
        "not True, False or None",
    ),
    (
        standards.requirements_never_refuse,
        {"requirements": requiring(Finding(same("a"), GERMAN_ONLY, met=None))},
        "found says nothing in 'en'",
    ),
    (standards.requirements_never_refuse, {"requirements": fickle_requirement}, "the second answer differs"),
    (
        arithmetic.gives_every_quantity,
        {"arithmetic": with_values(lambda _, values: values.pop("E"))},
        "gives no E",
    ),
    (
        arithmetic.gives_every_quantity,
        {"arithmetic": with_values(lambda _, values: values.update(X=values["E"]))},
        "gives X, which is not declared",
    ),
    (
        arithmetic.gives_every_quantity,
        {"arithmetic": with_e(lambda s: np.ptp(s.mean_positive))},
        "E of the shape ()",
    ),
    (
        arithmetic.stack_equals_loop,
        {
            "arithmetic": with_e(
                lambda s: np.fmax.reduce(s.mean_positive, axis=-1) - np.nanmin(s.mean_positive)
            )
        },
        "E of test",
    ),
    (
        arithmetic.order_of_runs_is_irrelevant,
        {"arithmetic": with_e(lambda s: s.deviations[..., 0, 0, 0])},
        "E depends on the order of the runs",
    ),
    (
        arithmetic.scales_with_the_readings,
        {"arithmetic": with_values(lambda _, values: values.update(R=values["R"] ** 2))},
        "R does not double",
    ),
    (
        arithmetic.moves_no_more_than_an_offset,
        {"arithmetic": with_e(lambda s: np.sum(s.mean_positive, axis=-1))},
        "E moves by 7e-05 m",
    ),
    (
        arithmetic.no_part_exceeds_its_whole,
        {"quantities": (E, replace(R, never_below=("E",)))},
        "R is said to be never below E, and was by",
    ),
    (
        arithmetic.no_part_exceeds_its_whole,
        {"quantities": (replace(E, never_below=("A",)), R)},
        "E is said to be never below A, which is no parameter",
    ),
    (
        arithmetic.one_missing_reading_takes_nothing_away,
        {"arithmetic": with_e(lambda s: np.ptp(s.deviations, axis=(-3, -2, -1)))},
        "E is nan when one of 5 readings",
    ),
    (
        arithmetic.undefined_is_nan,
        {"arithmetic": with_values(lambda _, values: values.update(R=np.nan_to_num(values["R"])))},
        "R is exactly zero",
    ),
    (
        arithmetic.undefined_is_nan,
        {"arithmetic": with_e(lambda s: np.fmax.reduce(s.mean_positive, axis=-1, initial=-np.inf))},
        "E is infinite",
    ),
    (
        arithmetic.undefined_is_nan,
        {"arithmetic": with_e(lambda s: np.nanmax(s.mean_positive, axis=-1))},
        "All-NaN",
    ),
    (
        arithmetic.nothing_gives_nothing,
        {"arithmetic": with_values(lambda _, values: values.update(R=np.nan_to_num(values["R"])))},
        "R of a test without readings is 0.0",
    ),
    (
        arithmetic.gives_every_quantity,
        {"arithmetic": with_e(lambda s: s.mean_positive[..., 0] * 1j)},
        "E that is complex",
    ),
    (
        arithmetic.defines_what_it_declares,
        {"arithmetic": with_values(lambda _, values: values.update(R=np.nan * values["R"]))},
        "R is NaN in every test, complete ones too",
    ),
    *(
        (
            arithmetic.values_are_lengths_that_readings_have,
            {
                "arithmetic": with_values(
                    lambda _, values, factor=factor: values.update(R=factor * values["R"])
                )
            },
            sentence,
        )
        for factor, sentence in (
            (1e6, "values are metres (radians), not micrometres"),
            (1e9, "values are metres (radians), not micrometres"),
            (1e3, "values are metres (radians), not micrometres"),
            (1e-3, "values are metres (radians)"),
            (-1.0, "is no negative length"),
        )
    ),
    (
        arithmetic.directions_are_not_swapped,
        {
            "quantities": (E, replace(R, symbol="R_fwd")),
            "arithmetic": lambda _, statistics, options: Arithmetic(
                {
                    "E": EXEMPLARY.arithmetic(statistics, options).parameters["E"],
                    "R_fwd": largest(statistics.s_negative),
                },
                {"width": statistics.s_positive},
            ),
        },
        "R_fwd follows the readings of the other direction",
    ),
    (
        arithmetic.alters_no_input,
        {"arithmetic": with_e(lambda s: np.abs(s.mean_positive, out=s.mean_positive))},
        "read-only",
    ),
    (
        arithmetic.gives_the_same_again,
        {"arithmetic": with_e(lambda s: s.mean_positive[..., 0] + next(COUNTER))},
        "other values the second time",
    ),
    (figures_of_any_test, {"figures": lambda *_: ()}, "a complete linear test: there is none"),
    (figures_of_any_test, {"figures": no_figures_of_one_target}, "a single reading raised IndexError"),
    (
        figures_of_any_test,
        {"figures": lambda _, *given: [*EXEMPLARY.figures(*given), *EXEMPLARY.figures(*given)]},
        "key 'means' is there 2 times",
    ),
    (
        figures_of_any_test,
        {"figures": with_figure(lambda figure: replace(figure, title=same(f"Figure {next(COUNTER)}")))},
        "the second time they differ",
    ),
    (
        figures_are_worded,
        {"figures": with_figure(lambda figure: replace(figure, key="The means"))},
        "'The means' must be lower-case",
    ),
    (
        figures_are_worded,
        {"figures": with_figure(lambda figure: replace(figure, x_title=GERMAN_ONLY))},
        "x_title says nothing in 'en'",
    ),
    (
        figures_are_worded,
        {"figures": with_figure(lambda figure: replace(figure, y_unit="furlong"))},
        "unit 'furlong' is none of",
    ),
    (
        figures_are_worded,
        {"figures": with_figure(lambda figure: replace(figure, alternative=same("A rising curve")))},
        "names no value",
    ),
    (
        figures_are_worded,
        {"figures": with_figure(lambda figure: replace(figure, alternative=Words("From {low} to {high}")))},
        "alternative has places without a value; say Words(…).given(low=…, high=…)",
    ),
    (
        marks_stand_at_targets,
        {"figures": with_panel(curves=lambda panel: (replace(panel.curves[0], x=panel.curves[0].x / 1e3),))},
        "; that is SI: a graph has its own unit, mm (from_si)",
    ),
    (
        marks_stand_at_targets,
        {"figures": with_panel(curves=lambda panel: (replace(panel.curves[0], x=panel.curves[0].x + 1),))},
        "curve x̄i↑ stands at positions that are no targets",
    ),
    (
        marks_stand_at_targets,
        {"figures": with_panel(arrows=lambda _: (Arrow("B", 0.123, 0.0, 1.0),))},
        "arrow B stands at 0.123",
    ),
    (
        marks_stand_at_targets,
        {"figures": with_bracket(high_at=0.123)},
        "high_at of bracket E is 0.123",
    ),
    (
        curves_have_a_value_at_each_position,
        {"figures": with_panel(curves=lambda panel: (replace(panel.curves[0], y=panel.curves[0].y[:-1]),))},
        "curve x̄i↑ needs a finite value, or NaN, at each position",
    ),
    (
        curves_have_a_value_at_each_position,
        {
            "figures": with_panel(
                curves=lambda panel: (replace(panel.curves[0], y=panel.curves[0].y * np.inf),)
            )
        },
        "curve x̄i↑ needs a finite value",
    ),
    (
        curves_have_a_value_at_each_position,
        {
            "figures": with_panel(
                bands=lambda panel: (replace(panel.bands[0], lower=panel.bands[0].upper + 1),)
            )
        },
        "lower limit above its upper limit",
    ),
    (marks_have_finite_ends, {"figures": with_bracket(low=np.nan)}, "E spans nan to"),
    (marks_have_finite_ends, {"figures": with_bracket(low=1e9)}, "the lower one first"),
    (
        marks_have_finite_ends,
        {"figures": with_panel(levels=lambda _: (Level("0", Role.TOLERANCE, np.nan),))},
        "level 0 is at nan",
    ),
    (
        brackets_span_what_is_drawn,
        {"figures": with_bracket(low=-123.0)},
        "low end of bracket E is -123.0; nothing is drawn there",
    ),
    (
        brackets_are_as_long_as_their_parameter,
        {"figures": with_bracket(low=-123.0)},
        "but the results table has",
    ),
]


test_exemplary_passes, test_a_check_finds_its_sin, test_every_check_has_a_sin = make_tests(
    STANDARD_CHECKS,
    ExemplaryStandard,
    SINS,
    lambda *_: (ExemplaryOptions(), EXAMPLES),
)


def test_an_incomplete_protocol_is_named_member_by_member() -> None:
    with pytest.raises(AssertionError, match="has no designation, title, position_index, options"):
        check_standard(type("Stub", (), {"identifier": "stub:1"})())


def test_all_failures_are_reported_at_once_with_the_standard_s_name() -> None:
    lines = failure(
        check_standard,
        make_sinner(ExemplaryStandard, {"designation": "", "figures": lambda *_: ()}),
        examples=EXAMPLES,
    ).splitlines()
    assert [line.split(": ")[:2] for line in lines] == [
        ["is_named", "exemplary:1"],
        ["figures_of_any_test", "exemplary:1"],
    ]


def test_job_keys_are_validated_as_a_job_file_would_give_them() -> None:
    values = {"E": 4.0, "R": 8.485281}
    check_standard(ExemplaryStandard(), {"factor": 3}, examples=[replace(EXAMPLE, values=values)])


@pytest.mark.parametrize(
    ("examples", "sentence"),
    [
        ([], "give a worked example: check_standard"),
        ([replace(EXAMPLE, values={"E": 4.0})], "they state no value, other than zero, of R"),
        ([replace(EXAMPLE, values={"E": 4.0, "R": 0.0})], "of R"),
        ([replace(EXAMPLE, measurements=ALIKE)], "a reversal must be wider than the readings scatter"),
        ([replace(EXAMPLE, measurements=WITHOUT_SCATTER)], "readings must scatter"),
        ([EXAMPLE, replace(EXAMPLE, values={"Q": 1.0})], "Q is no parameter of it; it has E, R"),
        ([EXAMPLE, replace(EXAMPLE, measurements=WITHOUT_SCATTER)], "R is not defined"),
    ],
)
def test_examples_that_tell_nothing_do_not_pass(examples: list[WorkedExample], sentence: str) -> None:
    with pytest.raises(AssertionError, match=sentence):
        gives_the_worked_values(EXEMPLARY, ExemplaryOptions(), examples)


class _Worded(ExemplaryOptions):
    word: str = Field("", description="No type tells another value of it.")


def test_the_author_states_another_value_where_the_type_tells_none() -> None:
    standard = make_sinner(ExemplaryStandard, {"options": _Worded})
    with pytest.raises(AssertionError, match="job key 'word': the kit finds no other value for it"):
        every_key_matters(standard, _Worded(), EXAMPLES)
    with pytest.raises(AssertionError, match="job key 'word' is ignored: 'x' gives what '' gives"):
        every_key_matters(standard, _Worded(), EXAMPLES, {"word": "x"})
