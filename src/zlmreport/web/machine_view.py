"""All that the page of a machine shows, as values for a browser."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from typing import Any

from zlmreport.document.blocks import Section
from zlmreport.document.subjects.fit import OUTSIDE
from zlmreport.document.subjects.forecast import EFFECT
from zlmreport.document.writer import NOTHING
from zlmreport.errors import InputError
from zlmreport.language import Language, Words
from zlmreport.language.formatting import round_pair
from zlmreport.machines.comparison import ComparedTest, compare_tests
from zlmreport.machines.course import CircularTest
from zlmreport.machines.editing import list_effects_with
from zlmreport.machines.reading import is_always_there
from zlmreport.machines.study import CircleStudy, EstimatedTerm
from zlmreport.machines.subjects.axes import lay_out_errors, lay_out_space
from zlmreport.machines.subjects.cross_tables import lay_out_promised
from zlmreport.machines.subjects.saying import Sayer
from zlmreport.machines.subjects.tests import (
    describe_stretch,
    lay_out_sizes,
    lay_out_test,
    make_failure_notice,
)
from zlmreport.measurement.units import MICROMETRE
from zlmreport.model.effects.circle_effect import CircleEffect
from zlmreport.web.bench import PLACE
from zlmreport.web.blocks import collect_blocks, list_all_sections
from zlmreport.web.machine_bench import LoadedMachine, MachineBench, find_fall_of
from zlmreport.web.machine_graphs import collect_graph, collect_model, collect_residuals, find_readings_of
from zlmreport.web.machine_tables import list_offered_tables
from zlmreport.web.naming import Naming
from zlmreport.web.panels import split_symbol
from zlmreport.web.view import list_steps

_MOST_FAILURES = 3


def name_effects(effects: Iterable[CircleEffect], language: Language) -> Naming:
    """Return what a page calls effects on circles."""
    return Naming(language, {each.identifier: each.title.in_language(language) for each in effects}, {})


@dataclass(frozen=True, slots=True)
class MachineView:
    """Writes the page of a machine in one language."""

    bench: MachineBench
    loaded: LoadedMachine
    language: Language

    @property
    def say(self) -> Sayer:
        """Writes words and numbers."""
        return Sayer(self.language)

    @property
    def names(self) -> Naming:
        """What effects are called."""
        return name_effects(self.loaded.machine.catalogue, self.language)

    @property
    def study(self) -> CircleStudy | None:
        """The circles with the effects of the model; None where there is no circle."""
        return self.bench.make_study(self.loaded) if self.loaded.machine.circles else None

    def list_page(self) -> dict[str, Any]:
        """Return what is shown at once: tests with their graphs, effects, what was done."""
        loaded, machine, names = self.loaded, self.loaded.machine, self.names
        study = self.study
        compared = compare_tests(machine, self.bench.registry, study)
        keys = machine.file.keys
        return {
            "stamp": loaded.stamp,
            "digest": loaded.digest,
            "number": machine.number,
            "subject": self.say(
                _SUBJECT.given(
                    machine=" ".join(filter(None, (keys.machine.type, keys.machine.serial or ""))),
                    chain=machine.machine.chain.letters,
                )
            ).lstrip(", "),
            "file": self.bench.path.name,
            "tests": [collect_graph(each, self.language) for each in compared],
            "failures": list(self._list_failures(compared)),
            "error": list(self._list_error(study)),
            "effects": [self._list_effect(each.effect, study) for each in study.effects] if study else [],
            "others": [
                {
                    "effect": each.identifier,
                    "name": names.name_in(each.identifier),
                    "title": self.say(each.title),
                }
                for each in machine.catalogue
                if each.identifier not in machine.effect_names
            ],
            "offered": {
                "formats": [
                    {"format": each.identifier, "chosen": each.identifier in keys.output.formats}
                    for each in self.bench.renderers
                ],
                "tables": list_offered_tables(self.bench, loaded, self.language),
            },
            "asked": [],
            **list_steps(self.bench.path, loaded.digest, names),
        }

    def list_results(self) -> dict[str, Any]:
        """Return what takes longer: the fall of the error, each test in numbers, errors and work space."""
        machine, names, study = self.loaded.machine, self.names, self.study
        compared = compare_tests(machine, self.bench.registry, study)
        sizes = lay_out_sizes(compared, self.say)
        return {
            "stamp": self.loaded.stamp,
            "fall": self._list_fall() if study else None,
            "sizes": collect_blocks([sizes], names)[0],
            "tests": {each.name: self._list_test(each) for each in compared},
            "sections": list_all_sections(
                [
                    lay_out_space(machine.machine, self.say),
                    lay_out_promised(machine, self.bench.registry, self.say),
                    lay_out_errors(machine.machine, self.say, is_full=True),
                ],
                names,
            ),
        }

    def compare_before_and_after(self, wanted: str, test: str) -> dict[str, Any]:
        """Return what the graphs of a test draw before and after a step of the model.

        `wanted`: The number of a row of the fall, from 1; or an effect that is not in the model.

        Raises `InputError` if there is no such effect or test.
        """
        machine = self.loaded.machine
        circle = next((each for each in machine.measured if each.circle.name == test), None)
        if circle is None:
            raise InputError.at(PLACE, f"there is no circle {test[:60]!r}")
        drawn = (compare_tests(machine, self.bench.registry, each) for each in self._study_around(wanted))
        return {
            "stamp": self.loaded.stamp,
            **{
                name: {"model": collect_model(own), "residual": collect_residuals(own)}
                for name, compared in zip(("before", "after"), drawn, strict=True)
                for own in compared
                if own.name == test
            },
        }

    def _study_around(self, wanted: str) -> tuple[CircleStudy, CircleStudy]:
        """Return the studies before and after a step."""
        machine, bench = self.loaded.machine, self.bench
        base = tuple(each for each in machine.effects if each.is_base)
        further = tuple(each for each in machine.effects if not each.is_base)
        if wanted.isdecimal() and 1 < int(wanted) < len(further) + 2:
            count = int(wanted) - 1
            parts = (base + further[: count - 1], base + further[:count])
        else:
            parts = (machine.effects, list_effects_with(machine, wanted, bench.registry, PLACE))
        before, after = (bench.make_study(self.loaded, each) for each in parts)
        return before, after

    def _list_failures(self, compared: Sequence[ComparedTest]) -> Iterator[dict[str, Any]]:
        for each in compared:
            for stretch in each.fails[:_MOST_FAILURES]:
                said = describe_stretch(stretch, is_circle=isinstance(each.test, CircularTest))
                yield {
                    "test": each.name,
                    "statement": self.say(said),
                    "where": each.name if len(compared) > 1 else "",
                    "p": "",
                    "axis": "position",
                    "readings": find_readings_of(stretch, each),
                }

    def _list_test(self, found: ComparedTest) -> list[dict[str, Any]]:
        """Return a test in numbers, but for where it fails, which the page says elsewhere."""
        section: Section = lay_out_test(found, self.say)
        elsewhere = make_failure_notice([found], self.say)
        return collect_blocks((each for each in section.blocks if each != elsewhere), self.names)

    def _list_error(self, study: CircleStudy | None) -> Iterator[dict[str, str]]:
        if study is None:
            return
        written = f"{self.say.write_micrometres(study.rms)} {MICROMETRE.symbol}"
        yield {"name": self.say(_ERROR), "value": written, "meaning": self.say(_ERROR_IS)}

    def _list_effect(self, effect: CircleEffect, study: CircleStudy) -> dict[str, Any]:
        return {
            "effect": effect.identifier,
            "name": self.names.name_in(effect.identifier),
            "title": self.say(effect.title),
            "equation": split_symbol(effect.equation),
            "stays": is_always_there(effect, self.loaded.machine.circles),
            "parameters": [
                collect_parameter(each, self.language) for each in study.list_estimates_of(effect.identifier)
            ],
        }

    def _list_fall(self) -> dict[str, Any]:
        rows = find_fall_of(self.bench, self.loaded)
        largest = max(each.rms for each in rows) or 1.0
        names = self.names
        called = [self.say(_MEASURED), self.say(_BY_AXES), *(names.name_in(each.effect) for each in rows[2:])]
        return {
            "heads": [
                {"text": self.say(EFFECT), "meaning": ""},
                {"text": f"{self.say(_ERROR)} ({MICROMETRE.symbol})", "meaning": self.say(_ERROR_IS)},
            ],
            "rows": [
                {
                    "effect": each.effect,
                    "name": name,
                    "label": f"+ {name}" if each.effect else name,
                    "share": each.rms / largest,
                    "cells": [self.say.write_micrometres(each.rms)],
                }
                for name, each in zip(called, rows, strict=True)
            ],
            "largest": MICROMETRE.from_si(largest),
            "floor": None,
        }


def collect_parameter(term: EstimatedTerm, language: Language) -> dict[str, Any]:
    """Return a parameter as a page shows it."""
    say, u = Sayer(language), term.expanded_uncertainty
    value, uncertainty = say.write_general(term.unit.from_si(term.value)), ""
    if u is not None:
        pair = round_pair(term.unit.from_si(term.value), term.unit.from_si(u), language.decimal_sign)
        value, uncertainty = pair
    return {
        "name": term.name,
        "symbol": [{"text": say(term.title), "italic": False, "subscript": False}],
        "description": "",
        "value": value,
        "number": term.unit.from_si(term.value),
        "uncertainty": "" if uncertainty == NOTHING else uncertainty,
        "unit": term.unit.symbol,
        "given": False,
        "plausibility": "plausible" if term.is_possible else "implausible",
        "notes": [] if term.is_possible else [say(OUTSIDE)],
    }


_SUBJECT = Words("{machine}, axes {chain}")
_MEASURED = Words("as measured")
_BY_AXES = Words("less what the axes predict")
_ERROR = Words("Error of all circles")
_ERROR_IS = Words(
    "Root mean square of what axes and effects leave of all circles together, without where the bar "
    "stands and how long it is."
)
