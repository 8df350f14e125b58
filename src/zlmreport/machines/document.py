"""The document on a machine: its 21 errors, the map, tests predicted and measured, effects, the verdict.

It carries its machine file with all that it names, and its results for programs; so it is verified like any
other: made again from what it carries, and compared.
"""

from __future__ import annotations

import json
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from zlmreport.document.blocks import Block, Facts, Graph, Section
from zlmreport.document.certificate.attachments import (
    Attachment,
    Relationship,
    Source,
    arranged,
    source_attachments,
    sources_of,
)
from zlmreport.document.certificate.build import GENERATOR, letterhead_of
from zlmreport.document.certificate.document import Certificate, PageWords
from zlmreport.document.certificate.own_look import read_logo
from zlmreport.document.certificate.statements import in_a_line
from zlmreport.language import Words
from zlmreport.machines.comparison import ComparedTest, compare_circles, compare_line
from zlmreport.machines.course import CircularTest
from zlmreport.machines.diagnosis import MachineDiagnosis, diagnose
from zlmreport.machines.diagnosis_report import diagnosis_values
from zlmreport.machines.prediction import prediction_values
from zlmreport.machines.reading import MachineFile
from zlmreport.machines.subjects import findings, tests
from zlmreport.machines.subjects.axes import error_section, known_in_words, space_section
from zlmreport.machines.subjects.saying import Sayer
from zlmreport.measurement.axis import Axis
from zlmreport.measurement.measurement_set import MeasurementSet
from zlmreport.plugin.registry import Registry

SCHEMA = "zlmreport/machine-results/1"
#: Tests whose graphs a sheet has room for.
_ON_A_SHEET = 1


@dataclass(frozen=True, slots=True)
class MachineDocument:
    """A document on a machine, and its results for programs."""

    certificate: Certificate
    results: bytes


@dataclass(frozen=True, slots=True)
class _Material:
    """What a document is made of.

    Attributes
    ----------
    by_axes
        The tests beside what the axes predict.
    by_model
        The circles beside the effects of the model, too.
    complete
        The same with all that was found.
    """

    machine: MachineFile
    diagnosis: MachineDiagnosis | None
    by_axes: tuple[ComparedTest, ...]
    by_model: tuple[ComparedTest, ...]
    complete: tuple[ComparedTest, ...]


def machine_document(machine: MachineFile, registry: Registry, generator: str = GENERATOR) -> MachineDocument:
    """Return the document on a machine."""
    stated, laboratory = machine.file.keys.certificate, machine.file.keys.laboratory
    logo = (
        read_logo(laboratory.logo, machine.file.place_of("laboratory", "logo"))
        if laboratory and laboratory.logo
        else None
    )
    made_from = sources_of((*machine.sources, *([logo.file] if logo else [])), machine.number)
    material = _material(machine, registry)
    results = _results(material, made_from, generator)
    say = Sayer(stated.language)
    is_sheet = stated.layout == "sheet"
    cover = tuple(_sheet(material, say) if is_sheet else _cover(material, say))
    title = say(_TITLE)
    name = machine.file.keys.machine.type or machine.number
    attached = [
        Attachment(f"{machine.number}.json", results, "application/json", Relationship.DATA, say(_RESULTS)),
        *source_attachments(made_from, stated.language),
    ]
    return MachineDocument(
        Certificate(
            number=machine.number,
            title=title,
            subtitle=name,
            language=stated.language,
            issued=stated.issued,
            paper=stated.paper,
            letterhead=letterhead_of(laboratory, logo),
            cover=cover,
            sections=() if is_sheet else tuple(_sections(material, say)),
            page_words=PageWords(
                number=f"{title} {machine.number}", page=say(_PAGE), of=say(_OF), end=say(_END),
                figure=say(_FIGURE), table=say(_TABLE),
            ),
            description=f"{title}: {name}",
            measurements=_nothing_measured(),
            evaluations=(),
            generator=generator,
            keywords=(machine.machine.chain.letters,),
            sources=made_from,
            attachments=arranged(attached, machine.number),
            is_compact=is_sheet,
        ),
        results,
    )  # fmt: skip


def _material(machine: MachineFile, registry: Registry) -> _Material:
    circles = compare_circles(machine.machine, machine.measured, registry)
    lines = tuple(compare_line(machine.machine, each) for each in machine.lines)
    if not machine.measured:
        return _Material(machine, None, lines, (), ())
    diagnosis = diagnose(machine.study(), machine.catalogue)
    by_model, complete = (
        compare_circles(machine.machine, machine.measured, registry, study)
        for study in (diagnosis.study, diagnosis.complete)
    )
    return _Material(machine, diagnosis, (*circles, *lines), by_model, complete)


def _nothing_measured() -> MeasurementSet:
    """Return no readings: those of a machine stand in the results of its own."""
    none, integers = np.zeros(0), np.zeros(0, dtype=np.int64)
    return MeasurementSet(Axis("X"), none, integers, integers, integers, none)


def _results(material: _Material, made_from: tuple[Source, ...], generator: str) -> bytes:
    machine, diagnosis = material.machine, material.diagnosis
    stated = machine.file.keys.certificate
    values: dict[str, Any] = {
        "schema": SCHEMA,
        "certificate": {
            "number": machine.number,
            "title": _TITLE.in_language(stated.language),
            "language": stated.language.value,
            "issued": stated.issued.isoformat() if stated.issued else "",
        },
        "prediction": prediction_values(machine.machine, material.by_axes),
        "diagnosis": diagnosis_values(diagnosis, material.by_model, material.complete, stated.language)
        if diagnosis
        else None,
        "provenance": {
            "generator": generator,
            "plugins": {},
            "sources": [
                {
                    "role": each.role.key,
                    "name": each.name,
                    "path": each.path,
                    "sha256": each.file.sha256,
                    "size": each.file.size,
                }
                for each in made_from
            ],
        },
    }
    return (json.dumps(values, ensure_ascii=False, indent=1, allow_nan=False) + "\n").encode()


def _cover(material: _Material, say: Sayer) -> Iterator[Block]:
    """Yield the first page: what it is about, the verdict, all tests, what was not found."""
    yield _facts(material.machine, say)
    yield from _said_first(material, say)
    diagnosis = material.diagnosis
    absence = findings.absence_section(diagnosis, say) if diagnosis else None
    if absence:
        yield from absence.blocks


def _sheet(material: _Material, say: Sayer) -> Iterator[Block]:
    """Yield all that fits on a page."""
    yield _facts(material.machine, say)
    yield from _said_first(material, say)
    circles = [each for each in material.complete or material.by_axes if isinstance(each.test, CircularTest)]
    yield from (Graph(tests.circle_figure(each)) for each in circles[:_ON_A_SHEET])
    yield from error_section(material.machine.machine, say, is_full=True).blocks[1:]


def _said_first(material: _Material, say: Sayer) -> Iterator[Block]:
    diagnosis = material.diagnosis
    if diagnosis:
        yield from findings.verdict_section(diagnosis, say).blocks
        lines = [each for each in material.by_axes if not isinstance(each.test, CircularTest)]
        noise = diagnosis.complete.noise.rms
        yield tests.sizes_table((*material.complete, *lines), say, noise, with_numbers=True)
    elif material.by_axes:
        yield tests.sizes_table(material.by_axes, say)


def _sections(material: _Material, say: Sayer) -> Iterator[Section]:
    machine, diagnosis = material.machine.machine, material.diagnosis
    yield error_section(machine, say, is_full=True)
    yield space_section(machine, say)
    if diagnosis:
        yield findings.model_section(diagnosis.complete, say)
        candidates = findings.candidate_section(diagnosis, say)
        if candidates:
            yield candidates
        steps = findings.step_section(diagnosis, say)
        if steps:
            yield steps
    yield from _test_sections(material.by_axes, material.complete, say)


def _test_sections(
    by_axes: Sequence[ComparedTest], complete: Sequence[ComparedTest], say: Sayer
) -> Iterator[Section]:
    """Yield a section for each test, a circle beside the model's effects, too."""
    with_effects = {each.name: each for each in complete}
    for each in by_axes:
        yield tests.test_section(with_effects.get(each.name, each), say)


def _facts(machine: MachineFile, say: Sayer) -> Facts:
    keys, stated = machine.file.keys, machine.file.keys.certificate
    pairs = [
        (say(_NUMBER), machine.number),
        (say(_CUSTOMER), keys.customer.name if keys.customer else ""),
        (say(_MACHINE), keys.machine.type),
        (say(_SERIAL), keys.machine.serial or ""),
        (say(_CHAIN), machine.machine.chain.letters),
        (say(_TOOL), f"{', '.join(map(say.general, keys.tool))} mm"),
        (say(_KNOWN), say(known_in_words(machine.machine))),
        (say(_ISSUED), stated.issued.isoformat() if stated.issued else ""),
        (say(_AUTHORISED), in_a_line(stated.authorised_by) if stated.authorised_by else ""),
    ]
    return Facts(tuple((name, value) for name, value in pairs if value))


_TITLE = Words("Report on a Machine")
_RESULTS = Words("Results for programs")
_PAGE, _OF = Words("page"), Words("of")
_END = Words("End of document")
_FIGURE, _TABLE = Words("Figure"), Words("Table")
_NUMBER, _CUSTOMER = Words("Number"), Words("Customer")
_MACHINE, _SERIAL = Words("Machine"), Words("Serial number")
_CHAIN = Words("Axes, from workpiece to tool")
_TOOL = Words("Tool offset")
_KNOWN = Words("Known errors")
_ISSUED = Words("Date of issue")
_AUTHORISED = Words("Authorised by")
