"""Whatever a plugin does, one message names it, other jobs go on, and the exit code is never 0."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator, Mapping
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace
from typing import Any, Self

import numpy as np
import pytest

from cli.commands import Shop, use
from cli.conftest import shop as shop  # noqa: PLC0414 - the fixture
from fleet.fleets import VERSIONS, Fleet, Page, without_processes
from job.jobs import SOUND, loaded
from offers import offering
from testing.exemplary import ExemplaryRenderer, ExemplarySource, ExemplaryStandard
from testing.exemplary_effect import ExemplaryEffect
from testing.exemplary_program import ExemplaryProgram
from zlmreport.fleet import making, night
from zlmreport.fleet.issuing import What
from zlmreport.measurement.units import MILLIMETRE
from zlmreport.plugin import Axis, Figure, InputError, Language, MeasurementSet, Place, Words
from zlmreport.plugin.boundary import PluginError, guard
from zlmreport.plugin.kinds import CONTROLLER, EFFECT, EXTENSION, INSTRUMENT, PART_PROGRAM, SOURCE, STANDARD
from zlmreport.plugin.protocols import SourceContext
from zlmreport.plugin.registry import Plugin, Registry, collect
from zlmreport.plugin.standard import (
    Arithmetic,
    Bracket,
    Curve,
    Finding,
    Panel,
    Role,
    evaluate,
    position_statistics,
)
from zlmreport.testing import full_designs, sample_cross_tables, sample_motion, simulated_test

OTHER = Plugin("house", "house_module", "house-plugins", "2.0")


class OtherStandard(ExemplaryStandard):
    """The standard of another plugin, to be made to sin."""

    identifier = "house:1"


def _with(**members: Any) -> ExemplaryStandard:
    return type("Sinful", (OtherStandard,), members)()


def _answering(**parameters: Any) -> Callable[..., Arithmetic]:
    """Return formulas of which some answers are others."""

    def arithmetic(_self: Any, statistics: Any, options: Any) -> Arithmetic:
        sound = ExemplaryStandard().arithmetic(statistics, options)
        found: dict[str, Any] = {**sound.parameters, **parameters}
        return replace(sound, parameters={name: value for name, value in found.items() if value is not ...})

    return arithmetic


def _raising(error: BaseException) -> Callable[..., Any]:
    def method(*_: Any, **__: Any) -> Any:
        raise error

    return method


def _altering(_self: Any, statistics: Any, _options: Any) -> Any:
    statistics.mean[...] = 0.0


def _exits_late(_self: Any, *_: Any) -> Iterator[Any]:
    yield from ()
    sys.exit()


def _curve(y: np.ndarray) -> Curve:
    return Curve("x", Role.MEAN_POSITIVE, np.zeros(3), y)


def _figure(**members: Any) -> Figure:
    sound = Figure("means", *(Words("Means"),) * 4, x_unit="mm", y_unit="µm", panels=())
    return replace(sound, **members)


SINS: Mapping[str, tuple[Mapping[str, Any], str]] = {
    "exit": ({"arithmetic": _raising(SystemExit(0))}, "arithmetic raised SystemExit: 0 (test_boundary.py"),
    "exit of a generator": ({"requirements": _exits_late}, "requirements raised SystemExit (test_boundary"),
    "exception": ({"arithmetic": _raising(KeyError("x"))}, "arithmetic raised KeyError: 'x' (test_bound"),
    "file": ({"figures": _raising(FileNotFoundError(2, "no", "x"))}, "figures raised FileNotFoundError"),
    "base exception": ({"figures": _raising(BaseException("odd"))}, "figures raised BaseException: odd"),
    "nothing": ({"arithmetic": lambda *_: None}, "arithmetic returns nothing; Arithmetic is expected"),
    "no mapping": ({"arithmetic": lambda *_: Arithmetic([1.0])}, "an object of type list; Mapping is"),  # type: ignore[arg-type]
    "shape": ({"arithmetic": _answering(E=np.zeros(3))}, "gives E of the shape (3,); () is expected"),
    "infinite": ({"arithmetic": _answering(E=np.inf)}, "gives E that is infinite"),
    "complex": ({"arithmetic": _answering(E=1j)}, "gives E that is complex; a real number is expected"),
    "text": ({"arithmetic": _answering(E="5")}, "gives E that is str and no number"),
    "none": ({"arithmetic": _answering(E=None)}, "gives E that is NoneType and no number"),
    "unknown symbol": ({"arithmetic": _answering(F=1.0)}, "gives F, which is not declared (see quantities)"),
    "missing symbol": ({"arithmetic": _answering(E=...)}, "gives no E (see quantities)"),
    "duplicate symbol": (
        {"quantities": (*ExemplaryStandard.quantities, ExemplaryStandard.quantities[0])},
        "gives E twice (see quantities)",
    ),
    "altered input": ({"arithmetic": _altering}, "arithmetic raised ValueError: assignment destination is"),
    "finding": ({"requirements": lambda *_: ["fine"]}, "an object of type str among others; each must be F"),
    "findings": ({"requirements": lambda *_: None}, "requirements returns nothing; several Finding are"),
    "figure": ({"figures": lambda *_: "means"}, "figures returns an object of type str; several Figure"),
    "figure without a value in one language": (
        {"figures": lambda *_: [_figure(alternative=Words("{n} µm", de="{m} µm", values={"n": 1}))]},
        "figures returns words that cannot be said in de, alternative of figure 'means': no value for {m}",
    ),
    "figure without any value": (
        {"figures": lambda *_: [_figure(alternative=Words("Means from {low} to {high}"))]},
        "figures returns words with empty places, alternative of figure 'means': no value for {low}, {high}",
    ),
    "figure with a unit of a results file": (
        {"figures": lambda *_: [_figure(y_unit="um")]},
        "figures returns 'um' as y_unit of figure 'means'; what is printed is expected, 'µm'",
    ),
    "panel with a unit of a results file": (
        {"figures": lambda *_: [_figure(panels=(Panel(y_title=Words("Slope"), y_unit="urad"),))]},
        "figures returns 'urad' as y_unit of a panel of figure 'means'; what is printed is expected, 'µrad'",
    ),
    "figure with a unit as an object": (
        {"figures": lambda *_: [_figure(x_unit=MILLIMETRE)]},
        "figures returns an object of type Unit as x_unit of figure 'means'; what is printed is expected",
    ),
    "curve": (
        {"figures": lambda *_: [_figure(panels=(Panel(curves=(_curve(np.zeros(2)),)),))]},
        "figures gives y of curve 'x' of figure 'means' of the shape (2,); (3,) is expected",
    ),
    "bracket": (
        {"figures": lambda *_: [_figure(panels=(Panel(brackets=(Bracket("A", 0, np.nan, 0, 0),)),))]},
        "figures gives high of Bracket 'A' of figure 'means' that is NaN; a number is expected",
    ),
    "finding without a value": (
        {"requirements": lambda *_: [Finding(Words("Five runs"), Words("{n} runs").given(m=1), met=True)]},
        "requirements returns words that cannot be said in en, what was found: no value for {n}",
    ),
}


@pytest.mark.parametrize("sin", SINS)
def test_sin_of_a_standard_is_one_message_and_other_jobs_go_on(
    sin: str, shop: Shop, monkeypatch: pytest.MonkeyPatch
) -> None:
    members, sentence = SINS[sin]
    sinful = (OTHER, offering([_with(**members)]))
    sound = offering([ExemplaryStandard()], [ExemplarySource()], [ExemplaryRenderer()])
    use(monkeypatch, collect([sinful, (Plugin("sound", "s"), sound)]))
    shop.job(("exemplary:1", "house:1"), ("{E: 20}", "{R: 20}"), name="sinful.yaml")
    shop.job(name="sound.yaml", number="CAL-2")
    run = shop.run("sinful.yaml", "sound.yaml")
    assert run.code == 2
    assert shop.files() == ["CAL-2.json"]
    (line,) = run.messages.splitlines()
    assert line.startswith("sinful.yaml: standard 'house:1' of plugin house (house-plugins 2.0): "), line
    assert sentence in line


def test_plugin_that_exits_fails_its_job_of_a_fleet_and_no_other(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    sinful = (OTHER, offering([_with(arithmetic=_raising(SystemExit(0)))]))
    sound = offering([ExemplaryStandard()], [ExemplarySource()], [Page()])
    without_processes(monkeypatch)
    monkeypatch.setattr(
        making,
        "find_plugins_once",
        lambda _: collect([sinful, (Plugin("sound", "s", "exemplary-plugins", "1.2"), sound)]),
    )
    versions = {**VERSIONS, "house-plugins": "2.0 code"}
    monkeypatch.setattr(making, "find_versions_once", lambda _: versions)
    monkeypatch.setattr(night, "find_program_versions", lambda **_: versions)
    fleet = Fleet.of(tmp_path, "a", "b")
    fleet.job("b", ("exemplary:1", "house:1"), ("{E: 20}", "{R: 20}"))
    witness = fleet.spend()
    assert witness.what == {"a": What.ISSUED, "b": What.FAILED}
    assert "standard 'house:1' of plugin house (house-plugins 2.0): arithmetic raised SystemExit: 0" in str(
        witness.of("b").problems
    )


@pytest.mark.parametrize(
    ("content", "sentence"),
    [
        (None, "render returns nothing; bytes is expected"),
        ("text", "render returns an object of type str; bytes is expected"),
        (b"", "render returns an empty file"),
    ],
)
def test_file_that_is_none_is_not_written(
    content: Any, sentence: str, shop: Shop, monkeypatch: pytest.MonkeyPatch
) -> None:
    class Sinful(ExemplaryRenderer):
        def render(self, certificate: Any) -> bytes:  # noqa: ARG002
            return content  # type: ignore[no-any-return]

    use(monkeypatch, collect([(OTHER, offering([ExemplaryStandard()], [ExemplarySource()], [Sinful()]))]))
    shop.job()
    run = shop.run("job.yaml")
    assert (run.code, shop.files()) == (2, [])
    assert run.messages == (f"job.yaml: format 'exemplary' of plugin house (house-plugins 2.0): {sentence}\n")


def _changed(**changes: Any) -> Callable[[MeasurementSet], MeasurementSet]:
    return lambda sound: replace(sound, **{name: make(sound) for name, make in changes.items()})


@pytest.mark.parametrize(
    ("change", "sentence"),
    [
        (lambda _: None, "read returns nothing; MeasurementSet is expected"),
        (_changed(axis=lambda _: Axis("Q")), "reads the axis"),
        (_changed(target_positions=lambda s: s.target_positions[::-1]), "target positions that do not rise"),
        (_changed(target_positions=lambda s: s.target_positions * np.nan), "target positions that is NaN"),
        (_changed(deviation=lambda s: s.deviation + np.inf), "a deviation that is infinite"),
        (_changed(deviation=lambda s: s.deviation + 1j), "a deviation that is complex"),
        (_changed(target=lambda s: s.target[1:]), "target of the shape (5,); (6,) is expected"),
        (_changed(target=lambda s: s.target + 1), "target that is no index of the target positions"),
        (_changed(approach=lambda s: 0 * s.approach), "approach that is neither 1 nor -1"),
        (_changed(run=lambda s: s.run - 1), "run below 1"),
        (_changed(run=lambda s: s.run * 1.0), "run that is not of whole numbers"),
        (_changed(approach=lambda s: s.approach**2), "two readings of the same target, direction and run"),
        (_changed(time=lambda _: np.zeros(2)), "time of the shape (2,)"),
        (_changed(conditions=lambda _: {"air": np.full(6, np.inf)}), "air that is infinite"),
        (_changed(datum=lambda _: np.nan), "datum that is NaN"),
        (_changed(provenance=lambda s: replace(s.provenance, source="x")), "names 'x' as the source"),
    ],
)
def test_readings_that_are_not_whole_are_refused(
    change: Callable[[Any], Any], sentence: str, shop: Shop, monkeypatch: pytest.MonkeyPatch
) -> None:
    class Sinful(ExemplarySource):
        def read(self, options: Any, context: SourceContext) -> MeasurementSet:
            made: MeasurementSet = change(super().read(options, context))
            return made

    use(monkeypatch, collect([(OTHER, offering([ExemplaryStandard()], [Sinful()], [ExemplaryRenderer()]))]))
    shop.job()
    run = shop.run("job.yaml")
    assert (run.code, shop.files()) == (2, [])
    assert run.messages.startswith("job.yaml: data source 'exemplary-text' of plugin house (house-plugins ")
    assert sentence in run.messages


def test_readings_are_handed_on_read_only(tmp_path: Any) -> None:
    class Open(ExemplarySource):
        def read(self, options: Any, context: SourceContext) -> MeasurementSet:
            return replace(super().read(options, context), deviation=np.zeros(6))

    source = collect([(OTHER, offering(sources=[Open()]))]).source("exemplary-text")
    (tmp_path / "six.txt").write_text("1 2 3 4 5 6", encoding="utf-8")
    job = loaded(SOUND, tmp_path)
    read = source.read(job.source.options, SourceContext(job.axis, Place("x")))
    assert not read.deviation.flags.writeable


DESIGN = next(iter(full_designs().values()))


@pytest.mark.parametrize(
    ("members", "ask", "sentence"),
    [
        ({"columns": lambda *_: np.zeros((2, 1))}, "columns", "columns gives columns of the shape (2, 1)"),
        (
            {"columns": lambda _, design, __: design.position[:, None] * np.nan},
            "columns",
            "columns gives columns that is NaN",
        ),
        ({"columns": _raising(SystemExit(3))}, "columns", "columns raised SystemExit: 3"),
        ({"grid": lambda *_: np.zeros((0, 1))}, "grid", "grid gives an empty grid"),
        ({"grid": lambda *_: np.zeros((2, 2))}, "grid", "grid gives a grid of the shape (2, 2)"),
        ({"forms": lambda _: ()}, "forms", "forms returns no form; there is one at least"),
        ({"forms": lambda _: [1]}, "forms", "an object of type int among others; each must be Effect"),
        ({"untestable": lambda *_: "no"}, "untestable", "untestable returns an object of type str; Words"),
        ({"expected": lambda *_: {"depth": 1.0}}, "expected", "gives 'depth', which is none of its param"),
        ({"expected": lambda *_: {"height": np.nan}}, "expected", "gives height that is NaN"),
    ],
)
def test_sin_of_an_effect_is_told(members: Any, ask: str, sentence: str) -> None:
    effect = collect([(OTHER, offering(effects=[type("Sinful", (ExemplaryEffect,), members)()]))]).effects[0]
    asked: Mapping[str, tuple[Any, ...]] = {
        "columns": (DESIGN, np.array([1.0])),
        "grid": (DESIGN,),
        "untestable": (DESIGN,),
        "expected": (DESIGN.axis,),
    }
    with pytest.raises(PluginError) as caught:
        getattr(effect, ask)(*asked.get(ask, ()))
    message = caught.value.problems[0].message
    assert message.startswith("effect 'exemplary-wave' of plugin house (house-plugins 2.0): ")
    assert sentence in message


def test_form_of_an_effect_is_behind_the_boundary_too() -> None:
    class Sinful(ExemplaryEffect):
        columns = _raising(SystemExit())

    effect = collect([(OTHER, offering(effects=[Sinful()]))]).effects[0]
    for form in (effect, *effect.forms(), effect.with_settings(effect.options(rectified=True))):
        with pytest.raises(PluginError, match="columns raised SystemExit"):
            form.columns(DESIGN, np.array([1.0]))


def test_design_that_an_effect_is_handed_cannot_be_altered() -> None:
    with pytest.raises(ValueError, match="read-only"):
        replace(DESIGN, position=np.zeros(4)).position[0] = 1.0


@pytest.mark.parametrize("text", [None, "", "G1 Xä\n"])
def test_program_that_no_control_reads_is_refused(text: Any) -> None:
    class Sinful(ExemplaryProgram):
        def write(self, _motion: Any, _options: Any) -> str:
            return text  # type: ignore[no-any-return]

    program = guard(PART_PROGRAM, Sinful(), "plugin house")
    with pytest.raises(PluginError, match="part program 'exemplary-steps' of plugin house: write returns"):
        program.write(sample_motion(), None)


@pytest.mark.parametrize("files", [None, {}, {".comp": ""}, {".comp": b"x"}, {"/../x": "y"}, {5: "y"}])
def test_tables_that_are_no_files_are_refused(files: Any) -> None:
    controller = guard(
        CONTROLLER, SimpleNamespace(identifier="house", files=lambda *_: files), "plugin house"
    )
    with pytest.raises(PluginError, match="controller 'house' of plugin house: files returns"):
        controller.files(None, None)


@pytest.mark.parametrize("files", [None, {".comp": ""}, {"/../x": "y"}])
def test_tables_across_axes_that_are_no_files_are_refused(files: Any) -> None:
    offered = SimpleNamespace(identifier="house", cross_files=lambda *_: files)
    with pytest.raises(PluginError, match="controller 'house' of plugin house: cross_files returns"):
        guard(CONTROLLER, offered, "plugin house").cross_files((), 1)


def test_tables_across_axes_may_be_none_that_a_control_takes() -> None:
    offered = SimpleNamespace(identifier="house", cross_files=lambda *_: {})
    assert guard(CONTROLLER, offered, "plugin house").cross_files((), 1) == {}


@pytest.mark.parametrize(
    ("change", "sentence"),
    [
        (lambda _: None, "read_cross returns nothing among others"),
        (lambda table: replace(table, values=table.values * np.nan), "read_cross gives values that is NaN"),
    ],
)
def test_tables_across_axes_that_are_read_without_a_value_are_refused(
    change: Callable[[Any], Any], sentence: str
) -> None:
    read = [change(each) for each in sample_cross_tables()]
    offered = SimpleNamespace(identifier="house", read_cross=lambda *_: read)
    with pytest.raises(PluginError, match=f"controller 'house' of plugin house: {sentence}"):
        guard(CONTROLLER, offered, "plugin house").read_cross({}, (), 1)


@pytest.mark.parametrize(
    ("method", "answer"),
    [
        *(("contributions", [1]), ("described", "x"), ("contradictions", None), ("completed", None)),
        *(("plan", 1), ("doubts", None), ("doubts", ["no words"])),
    ],
)
def test_answers_of_an_extension_are_looked_at(method: str, answer: Any) -> None:
    offered = SimpleNamespace(identifier="house", **{method: lambda *_: answer})
    with pytest.raises(PluginError, match=f"extension 'house' of plugin house: {method} returns"):
        getattr(guard(EXTENSION, offered, "plugin house"), method)()


def test_doubt_of_an_extension_that_exits_while_it_is_listed_is_told() -> None:
    offered = SimpleNamespace(identifier="house", doubts=_exits_late)
    with pytest.raises(PluginError, match="extension 'house' of plugin house: doubts raised SystemExit"):
        guard(EXTENSION, offered, "plugin house").doubts(None)


def test_command_of_an_extension_that_exits_is_told() -> None:
    from zlmreport.plugin.extension import Command

    command = Command("trace", "", "", (), _raising(SystemExit(0)))
    extension = guard(EXTENSION, SimpleNamespace(identifier="house", commands=(command,)), "plugin house")
    with pytest.raises(PluginError, match="command trace raised SystemExit: 0"):
        extension.commands[0].run({}, None)


def test_instrument_is_looked_after_while_it_is_read() -> None:
    class Line:
        can_zero = False

        def __enter__(self) -> Self:
            return self

        def __exit__(self, *_: object) -> None:
            raise KeyError("port")

        def readings(self) -> Iterator[int]:
            yield 1
            sys.exit(0)

        def zero(self) -> None:
            raise InputError.at(Place("COM1"), "cannot")

    offered = SimpleNamespace(identifier="dial", open=lambda _: Line())
    instrument = guard(INSTRUMENT, offered, "plugin house")
    connection = instrument.open(None)
    readings = connection.readings()
    assert next(readings) == 1
    with pytest.raises(PluginError, match="instrument 'dial' of plugin house: readings raised SystemE"):
        next(readings)
    with pytest.raises(InputError, match="COM1: cannot"):  # what a plugin tells the user goes through
        connection.zero()
    with pytest.raises(PluginError, match="open raised KeyError: 'port'"), connection:
        pass


def test_instrument_that_opens_nothing_is_told() -> None:
    instrument = guard(INSTRUMENT, SimpleNamespace(identifier="dial", open=lambda _: None), "plugin house")
    with pytest.raises(PluginError, match="open returns nothing without __enter__, __exit__, readings, zero"):
        instrument.open(None)


def test_file_that_a_source_cannot_open_is_the_users() -> None:
    source = guard(
        SOURCE, SimpleNamespace(identifier="x", read=_raising(FileNotFoundError(2, "no", "a.csv"))), "plugin"
    )
    with pytest.raises(FileNotFoundError):
        source.read(None, None)


def test_user_who_stops_and_memory_that_ends_are_no_fault_of_a_plugin() -> None:
    for error in (KeyboardInterrupt(), MemoryError()):
        standard = guard(STANDARD, _with(arithmetic=_raising(error)), "plugin house")
        with pytest.raises(type(error)):
            standard.arithmetic(None, None)


@pytest.mark.parametrize(
    ("factor", "sentence"),
    [(1e6, "not plausible, no reading deviates by more than"), (-1.0, "R cannot be negative")],
)
def test_value_that_no_readings_can_give_is_marked(factor: float, sentence: str) -> None:
    def arithmetic(_self: Any, statistics: Any, options: Any) -> Arithmetic:
        sound = ExemplaryStandard().arithmetic(statistics, options)
        return replace(sound, parameters={**sound.parameters, "R": factor * sound.parameters["R"]})

    sinful, measurements = _with(arithmetic=arithmetic), simulated_test()
    findings = evaluate(sinful, measurements, sinful.options(), {}).findings
    assert [each.met for each in findings] == [True, False]
    assert sentence in findings[-1].found.in_language(Language.ENGLISH)
    sound = evaluate(ExemplaryStandard(), measurements, sinful.options(), {}).findings
    assert len(sound) == 1


def _twice(identifier: str) -> Registry:
    class Same(OtherStandard):
        pass

    class SameEffect(ExemplaryEffect):
        pass

    Same.identifier = identifier
    return collect(
        [
            (OTHER, offering([Same()], effects=[SameEffect()])),
            (
                Plugin("sound", "s"),
                offering(
                    [ExemplaryStandard(), OtherStandard()],
                    [ExemplarySource()],
                    [ExemplaryRenderer()],
                    [ExemplaryEffect()],
                ),
            ),
        ]
    )


def test_duplicate_stops_only_the_jobs_that_use_it(shop: Shop, monkeypatch: pytest.MonkeyPatch) -> None:
    use(monkeypatch, _twice("house:1"))
    shop.job(("exemplary:1", "house:1"), ("{E: 20}", "{R: 20}"), name="double.yaml")
    shop.job(name="sound.yaml", number="CAL-2")
    run = shop.run("double.yaml", "sound.yaml")
    assert run.code == 2
    assert "two plugins provide standard 'house:1'" in run.messages
    assert shop.files() == ["CAL-2.json"]
    assert shop.run("plugins").code == 0
    assert shop.run("schema").code == 0


def test_duplicate_effect_is_named_as_one_that_cannot_be_tested() -> None:
    (effect,) = _twice("house:2").effects
    reason = effect.untestable(DESIGN)
    assert reason is not None
    assert reason.in_language(Language.GERMAN) == "zwei Plug-ins stellen ihn bereit"
    assert list(effect.forms()) == [effect]


def test_guarded_object_is_equal_to_the_object() -> None:
    standard = ExemplaryStandard()
    one, other = (guard(STANDARD, standard, "plugin") for _ in range(2))
    assert one == other == standard
    assert len({one, other}) == 1
    assert repr(one) == repr(standard)
    assert one.__class__ is ExemplaryStandard
    assert not hasattr(one, "no_such_member")
    statistics = position_statistics(simulated_test().deviations())
    assert one.arithmetic(statistics, options=standard.options()).parameters["E"] > 0
    assert EFFECT.hook == "zlmreport_effects"
