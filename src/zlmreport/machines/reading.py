"""From a machine file to a machine: its errors, and the tests that it is held against."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from zlmreport import pipeline
from zlmreport.errors import AccessError, InputError, Place, Problem
from zlmreport.files import demand
from zlmreport.job.extends import MACHINE
from zlmreport.job.keys_file import KeysFile, read_keys_file
from zlmreport.job.loading import load
from zlmreport.job.tree import Items, Keys, find_at
from zlmreport.machines.axis_errors import (
    LARGEST,
    Opened,
    make_curve_of_certificate,
    make_curve_of_job,
    read_bounds_of,
    read_curves_of_statement,
)
from zlmreport.machines.choosing import study_circles
from zlmreport.machines.course import CircularTest, StraightTest
from zlmreport.machines.curve import AxisErrorCurve, remove_alignment
from zlmreport.machines.keys import MachineFileKeys, StatedKeys
from zlmreport.machines.kinematics import SQUARENESS, Chain, find_square_slope
from zlmreport.machines.machine import MachineModel, list_missing_errors
from zlmreport.machines.measured_tests import MeasuredCircle, read_tests
from zlmreport.machines.square_lines import move_squares
from zlmreport.machines.study import CircleStudy
from zlmreport.measurement.provenance import SourceFile
from zlmreport.model.effects.circle_effect import CircleEffect
from zlmreport.plugin.registry import Registry

_CERTIFICATES = (".pdf", ".json")


@dataclass(frozen=True, slots=True)
class MachineFile:
    """A machine file that was read, with all that it names."""

    path: Path
    file: KeysFile[MachineFileKeys]
    machine: MachineModel
    measured: tuple[MeasuredCircle, ...]  #: The circles, each with its job.
    lines: tuple[StraightTest, ...]
    sources: tuple[SourceFile, ...]
    #: Of its model: those that it states, before them where each bar stands and how long it is.
    effects: tuple[CircleEffect, ...]
    catalogue: tuple[CircleEffect, ...]  #: All that are installed.

    @property
    def circles(self) -> tuple[CircularTest, ...]:
        """The circles alone."""
        return tuple(each.circle for each in self.measured)

    @property
    def effect_names(self) -> tuple[str, ...]:
        """The effects of its model, by name."""
        return tuple(each.identifier for each in self.effects)

    def make_study(self, effects: Iterable[CircleEffect] | None = None) -> CircleStudy:
        """Return the study of its circles with the effects of its model, or with others.

        Raises `InputError` if it names no circle.
        """
        if not self.circles:
            raise InputError.at(
                self.file.place_of("tests"), "no circle is among the tests; a diagnosis needs one at least"
            )
        return study_circles(self.machine, self.circles, self.effects if effects is None else effects)

    @property
    def test_names(self) -> tuple[str, ...]:
        """The names of its tests."""
        return (*(each.name for each in self.circles), *(each.name for each in self.lines))

    @property
    def number(self) -> str:
        """The number of its document."""
        return self.file.keys.certificate.number or self.path.stem


def read_machine(path: Path, registry: Registry, opened: Opened = lambda _: None) -> MachineFile:
    """Read a machine file and all that it names.

    Raises `InputError` with every mistake of the file itself; `AccessError` if a file cannot be read.
    """
    file = read_keys_file(path, MachineFileKeys, MACHINE)
    problems: list[Problem] = []
    chain = _read_chain(file, problems)
    curves, sources = _read_curves(file, registry, opened, problems)
    bounds_node = find_at(file.tree, ("bounds",))
    bounds = read_bounds_of(file.keys.bounds, bounds_node, problems) if isinstance(bounds_node, Keys) else {}
    effects = _choose_effects(file, registry, problems)
    circles: list[MeasuredCircle] = []
    lines: list[StraightTest] = []
    names: set[str] = set()
    for index, test in enumerate(file.keys.tests):
        try:
            found, read = read_tests(test, registry)
        except InputError as error:
            problems += error.problems
            continue
        except AccessError as error:
            problems.append(Problem(file.place_of("tests", index), str(error)))
            continue
        sources += read
        if test.stem in names:
            problems.append(
                Problem(
                    file.place_of("tests", index), f"a test is called {test.stem} already; name each once"
                )
            )
        else:
            circles += [each for each in found if isinstance(each, MeasuredCircle)]
            lines += [each for each in found if isinstance(each, StraightTest)]
        names.add(test.stem)
    if problems or chain is None:
        raise InputError(sorted(set(problems)))
    tool = file.keys.tool
    aligned = (remove_alignment(each, _find_zero(each, curves)) for each in curves.values())
    known, moved = move_squares(aligned, chain)
    machine = MachineModel(
        chain,
        (tool[0] / 1e3, tool[1] / 1e3, tool[2] / 1e3),
        known,
        list_missing_errors(curves, bounds),
        moved,
    )
    return MachineFile(
        path, file, machine, tuple(circles), tuple(lines), (file.file, *file.extended, *sources),
        (*_list_of_every_bar(effects, [each.circle for each in circles], registry), *effects),
        registry.circle_effects,
    )  # fmt: skip


def _find_zero(curve: AxisErrorCurve, curves: Mapping[str, AxisErrorCurve]) -> float | None:
    """Return where on the axis of an angle the squareness error about the same direction was measured, m.

    Where nobody says it, where the straightness errors of its axes were; None where nobody says that either.
    """
    square = next((name for name in SQUARENESS if name in curves and name[0] == curve.name[1]), None)
    if square is None:
        return None
    leaning, along, _ = find_square_slope(square)
    lines = (
        curves[name].line for name in (square, f"E{leaning}{along}", f"E{along}{leaning}") if name in curves
    )
    return next((each.others[curve.axis] for each in lines if curve.axis in each.others), None)


def _list_of_every_bar(
    stated: Sequence[CircleEffect], circles: Sequence[CircularTest], registry: Registry
) -> Iterator[CircleEffect]:
    """Yield the effects that belong into every model of circles, and are not stated."""
    for each in registry.circle_effects:
        if circles and each not in stated and is_always_there(each, circles):
            yield each


def is_always_there(effect: CircleEffect, circles: Sequence[CircularTest]) -> bool:
    """Tell whether an effect belongs into every model of some circles, stated or not."""
    is_calibrated = all(each.nominal.is_calibrated for each in circles)
    return effect.is_base and not (effect.is_length_of_bar and is_calibrated)


def _choose_effects(
    file: KeysFile[MachineFileKeys], registry: Registry, problems: list[Problem]
) -> tuple[CircleEffect, ...]:
    """Return the effects of the model; one that there is not, or that stands there twice, is a problem."""
    found: dict[str, CircleEffect] = {}
    for index, name in enumerate(file.keys.model.effects):
        place = file.place_of("model", "effects", index)
        if name in found:
            problems.append(Problem(place, f"{name} stands in the model already; remove one of them"))
            continue
        try:
            found[name] = registry.circle_effect(name, place)
        except InputError as error:
            problems += error.problems
    return tuple(found.values())


def _read_chain(file: KeysFile[MachineFileKeys], problems: list[Problem]) -> Chain | None:
    try:
        return Chain(file.keys.chain)
    except ValueError as error:
        problems.append(Problem(file.place_of("chain"), f"chain: {error}"))
        return None


def _read_curves(
    file: KeysFile[MachineFileKeys], registry: Registry, opened: Opened, problems: list[Problem]
) -> tuple[dict[str, AxisErrorCurve], list[SourceFile]]:
    """Return the errors that the file names, by name, and the files that they came from."""
    found: dict[str, AxisErrorCurve] = {}
    sources: list[SourceFile] = []
    node = find_at(file.tree, ("errors",))
    items = node.items if isinstance(node, Items) else (node,) if node else ()
    for item, stated in zip(items, file.keys.errors, strict=True):
        place = item.place
        try:
            if isinstance(stated, StatedKeys):
                curves = read_curves_of_statement(stated, item, problems) if isinstance(item, Keys) else []
            else:
                curve, read = _read_curve_of_file(stated, place, registry, opened)
                curves, sources = [curve], sources + read
        except InputError as error:
            problems += error.problems
            continue
        except AccessError as error:
            problems.append(Problem(place, str(error)))
            continue
        for each in curves:
            if each.name in found:
                first = found[each.name].source or "a stated value"
                problems.append(Problem(place, f"{each.name} was named already, by {first}; name it once"))
            found.setdefault(each.name, each)
    return found, sources


def _read_curve_of_file(
    path: Path, place: Place, registry: Registry, opened: Opened
) -> tuple[AxisErrorCurve, list[SourceFile]]:
    if path.suffix.casefold() in _CERTIFICATES:
        return make_curve_of_certificate(path, place, opened), [SourceFile.of(path, demand(path, LARGEST))]
    job = load(path, registry)
    measurements = pipeline.read(job, registry)
    files = [*job.files, *measurements.provenance.files]
    return make_curve_of_job(job, measurements, registry), files
