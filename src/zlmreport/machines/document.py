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
    arrange_attachments,
    attach_sources,
    list_sources_of_several,
)
from zlmreport.document.certificate.build import GENERATOR, make_letterhead
from zlmreport.document.certificate.document import Certificate, PageWords
from zlmreport.document.certificate.own_look import read_logo
from zlmreport.document.certificate.results_file import MACHINE_RESULTS
from zlmreport.document.certificate.statements import write_person
from zlmreport.language import Words, named
from zlmreport.machines.comparison import ComparedTest, compare_circles, compare_tests
from zlmreport.machines.course import CircularTest
from zlmreport.machines.diagnosis import MachineDiagnosis, diagnose
from zlmreport.machines.diagnosis_report import collect_diagnosis
from zlmreport.machines.reading import MachineFile
from zlmreport.machines.report import collect_prediction
from zlmreport.machines.subjects import findings, tests
from zlmreport.machines.subjects.axes import lay_out_errors, lay_out_space, say_known
from zlmreport.machines.subjects.cross_tables import lay_out_promised, say_promised
from zlmreport.machines.subjects.saying import Sayer
from zlmreport.measurement.axis import Axis
from zlmreport.measurement.measurement_set import MeasurementSet
from zlmreport.plugin.registry import Registry

#: Tests whose graphs a sheet has room for.
_ON_A_SHEET = 1


@dataclass(frozen=True, slots=True)
class MachineDocument:
    """A document on a machine, and its results for programs."""

    certificate: Certificate
    results: bytes


@dataclass(frozen=True, slots=True)
class _Material:
    """What a document is made of."""

    machine: MachineFile
    diagnosis: MachineDiagnosis | None
    by_axes: tuple[ComparedTest, ...]  #: The tests beside what the axes predict.
    by_model: tuple[ComparedTest, ...]  #: The circles beside the effects of the model, too.
    complete: tuple[ComparedTest, ...]  #: The same with all that was found.


def make_machine_document(
    machine: MachineFile, registry: Registry, generator: str = GENERATOR
) -> MachineDocument:
    """Return the document on a machine."""
    stated, laboratory = machine.file.keys.certificate, machine.file.keys.laboratory
    logo = (
        read_logo(laboratory.logo, machine.file.place_of("laboratory", "logo"))
        if laboratory and laboratory.logo
        else None
    )
    files = (*machine.sources, *([logo.file] if logo else []))
    made_from = list_sources_of_several(files, machine.file.tree, machine.number)
    material = _gather_material(machine, registry)
    results = _write_results(material, made_from, generator)
    say = Sayer(stated.language)
    is_sheet = stated.layout == "sheet"
    cover = tuple(_lay_out_sheet(material, registry, say) if is_sheet else _cover(material, say))
    title = say(_TITLE)
    name = machine.file.keys.machine.type or machine.number
    attached = [
        Attachment(f"{machine.number}.json", results, "application/json", Relationship.DATA, say(_RESULTS)),
        *attach_sources(made_from, stated.language),
    ]
    return MachineDocument(
        Certificate(
            number=machine.number,
            title=title,
            subtitle=name,
            language=stated.language,
            issued=stated.issued,
            paper=stated.paper,
            letterhead=make_letterhead(laboratory, logo),
            cover=cover,
            sections=() if is_sheet else tuple(_lay_out_sections(material, registry, say)),
            page_words=PageWords.in_language(stated.language, f"{title} {machine.number}"),
            description=say(named(title, name)),
            measurements=_make_empty_measurement(),
            evaluations=(),
            generator=generator,
            keywords=(machine.machine.chain.letters,),
            sources=made_from,
            attachments=arrange_attachments(attached, machine.number),
            is_compact=is_sheet,
        ),
        results,
    )  # fmt: skip


def _gather_material(machine: MachineFile, registry: Registry) -> _Material:
    compared = compare_tests(machine, registry)
    if not machine.measured:
        return _Material(machine, None, compared, (), ())
    diagnosis = diagnose(machine.make_study(), machine.catalogue)
    by_model, complete = (
        compare_circles(machine, registry, study) for study in (diagnosis.study, diagnosis.complete)
    )
    return _Material(machine, diagnosis, compared, by_model, complete)


def _make_empty_measurement() -> MeasurementSet:
    """Return no readings: those of a machine stand in the results of its own."""
    none, integers = np.zeros(0), np.zeros(0, dtype=np.int64)
    return MeasurementSet(Axis("X"), none, integers, integers, integers, none)


def _write_results(material: _Material, made_from: tuple[Source, ...], generator: str) -> bytes:
    machine, diagnosis = material.machine, material.diagnosis
    stated = machine.file.keys.certificate
    values: dict[str, Any] = {
        "schema": MACHINE_RESULTS,
        "certificate": {
            "number": machine.number,
            "title": _TITLE.in_language(stated.language),
            "language": stated.language.value,
            "issued": stated.issued.isoformat() if stated.issued else "",
        },
        "prediction": collect_prediction(machine.machine, material.by_axes),
        "diagnosis": collect_diagnosis(diagnosis, material.by_model, material.complete, stated.language)
        if diagnosis
        else None,
        "provenance": {
            "generator": generator,
            "plugins": {},
            "sources": [
                {
                    "role": each.role.value,
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
    yield _list_facts(material.machine, say)
    yield from _lay_out_first(material, say)
    diagnosis = material.diagnosis
    absence = findings.lay_out_absence(diagnosis, say) if diagnosis else None
    if absence:
        yield from absence.blocks


def _lay_out_sheet(material: _Material, registry: Registry, say: Sayer) -> Iterator[Block]:
    """Yield all that fits on a page: the verdict and the circles first."""
    yield from _lay_out_first(material, say)
    circles = [each for each in material.complete or material.by_axes if isinstance(each.test, CircularTest)]
    yield from (Graph(tests.draw_circle(each)) for each in circles[:_ON_A_SHEET])
    yield _list_facts(material.machine, say)
    promised = say_promised(material.machine, registry, say)
    if promised:
        yield promised
    yield from lay_out_errors(material.machine.machine, say, is_full=False).blocks[1:]


def _lay_out_first(material: _Material, say: Sayer) -> Iterator[Block]:
    diagnosis = material.diagnosis
    if diagnosis:
        yield from findings.lay_out_verdict(diagnosis, say).blocks
        lines = [each for each in material.by_axes if not isinstance(each.test, CircularTest)]
        noise = diagnosis.noise_of_readings
        yield tests.lay_out_sizes((*material.complete, *lines), say, noise, with_numbers=True)
    elif material.by_axes:
        yield tests.lay_out_sizes(material.by_axes, say)


def _lay_out_sections(material: _Material, registry: Registry, say: Sayer) -> Iterator[Section]:
    machine, diagnosis = material.machine.machine, material.diagnosis
    yield lay_out_errors(machine, say, is_full=True)
    yield lay_out_space(machine, say)
    promised = lay_out_promised(material.machine, registry, say)
    if promised:
        yield promised
    if diagnosis:
        yield findings.lay_out_model(diagnosis.complete, say)
        candidates = findings.lay_out_candidates(diagnosis, say)
        if candidates:
            yield candidates
        steps = findings.lay_out_steps(diagnosis, say)
        if steps:
            yield steps
    yield from _lay_out_tests(material.by_axes, material.complete, say)


def _lay_out_tests(
    by_axes: Sequence[ComparedTest], complete: Sequence[ComparedTest], say: Sayer
) -> Iterator[Section]:
    """Yield a section for each test, a circle beside the model's effects, too."""
    with_effects = {each.name: each for each in complete}
    for each in by_axes:
        yield tests.lay_out_test(with_effects.get(each.name, each), say)


def _list_facts(machine: MachineFile, say: Sayer) -> Facts:
    keys, stated = machine.file.keys, machine.file.keys.certificate
    pairs = [
        (say(_NUMBER), machine.number),
        (say(_CUSTOMER), keys.customer.name if keys.customer else ""),
        (say(_MACHINE), keys.machine.type),
        (say(_SERIAL), keys.machine.serial or ""),
        (say(Words("Axes, from workpiece to tool")), machine.machine.chain.letters),
        (say(_TOOL), f"{', '.join(map(say.write_stated, keys.tool))} mm"),
        (say(_KNOWN), say(say_known(machine.machine))),
        (say(_ISSUED), stated.issued.isoformat() if stated.issued else ""),
        (say(Words("Authorised by")), write_person(stated.authorised_by) if stated.authorised_by else ""),
    ]
    return Facts(tuple((name, value) for name, value in pairs if value))


_TITLE = Words("Report on a Machine")
_RESULTS = Words("Results for programs")
_NUMBER, _CUSTOMER = Words("Number"), Words("Customer")
_MACHINE, _SERIAL = Words("Machine"), Words("Serial number")
_TOOL = Words("Tool offset")
_KNOWN = Words("Known errors")
_ISSUED = Words("Date of issue")
