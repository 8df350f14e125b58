"""``zlmreport machine``: a whole machine, from what its axes predict to what it lacks and to its tables."""

from __future__ import annotations

from argparse import Namespace
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any

from zlmreport.cli.layout import lay_out_sections
from zlmreport.cli.terminal import lay_out_changes, lay_out_heading, print_json, show_path
from zlmreport.document.blocks import Section
from zlmreport.errors import NOT_MET, InputError, Place, Problem
from zlmreport.files import Document, write, write_new
from zlmreport.language import Language
from zlmreport.machines.comparison import compare_circles, compare_tests
from zlmreport.machines.cross_confirmation import CrossVerdict, confirm
from zlmreport.machines.cross_making import CrossWanted, make_cross, make_table_documents, make_trial
from zlmreport.machines.cross_report import (
    CONFIRMATION_SCHEMA,
    SCHEMA,
    collect_confirmation,
    collect_cross,
)
from zlmreport.machines.diagnosis import MachineDiagnosis, diagnose
from zlmreport.machines.diagnosis_report import build_values, change_values, collect_diagnosis
from zlmreport.machines.document import make_machine_document
from zlmreport.machines.editing import edit_effects, list_effects_with, list_effects_without
from zlmreport.machines.planning import plan_next_run, plan_values
from zlmreport.machines.reading import MachineFile, read_machine
from zlmreport.machines.report import collect_errors, collect_prediction
from zlmreport.machines.study import find_noise_of_both
from zlmreport.machines.subjects import findings, tests
from zlmreport.machines.subjects.axes import lay_out_errors, lay_out_space
from zlmreport.machines.subjects.cross_tables import lay_out_confirmation, lay_out_cross, lay_out_trial
from zlmreport.machines.subjects.findings import lay_out_plan
from zlmreport.machines.subjects.saying import Sayer
from zlmreport.measurement.units import MILLIMETRE
from zlmreport.model.effects.circle_effect import CircleEffect
from zlmreport.pipeline import name_files
from zlmreport.plugin.protocols import Renderer, needs_job
from zlmreport.plugin.registry import Registry, find_plugins
from zlmreport.verification.carrier import find_results_in

_SAY = Sayer(Language.ENGLISH)


def run(options: Namespace) -> int:
    """Do what the action says with a machine."""
    registry = find_plugins(files=options.plugin)
    machine = read_machine(options.job, registry, find_results_in)
    lines, values = _ACTIONS[options.action](machine, registry, options)
    if options.json:
        print_json(values)
    else:
        print(*lines, sep="\n")
    return find_exit_code(values)


def _lay_out(machine: MachineFile, sections: Iterable[Section | None], *more: str) -> Iterable[str]:
    chain = machine.machine.chain.letters
    yield from lay_out_heading(machine.number, f"chain {chain} (workpiece to tool)")
    yield from lay_out_sections(each for each in sections if each)
    yield from more


def _predict(machine: MachineFile, registry: Registry, _: Namespace) -> tuple[Iterable[str], Any]:
    compared = compare_tests(machine, registry)
    sections = [
        lay_out_errors(machine.machine, _SAY, is_full=False),
        lay_out_space(machine.machine, _SAY),
        *(tests.lay_out_test(each, _SAY) for each in compared),
    ]
    return _lay_out(machine, sections), collect_prediction(machine.machine, compared)


def _check(machine: MachineFile, _registry: Registry, _: Namespace) -> tuple[Iterable[str], Any]:
    named = list(machine.test_names)
    values = {
        "schema": "zlmreport/machine-check/1",
        "machine": machine.number,
        "chain": machine.machine.chain.letters,
        "errors": collect_errors(machine.machine),
        "tests": named,
        "effects": list(machine.effect_names),
        "problems": [],
    }
    sections = [lay_out_errors(machine.machine, _SAY, is_full=False)]
    return _lay_out(machine, sections, "", f"tests: {', '.join(named) or 'none'}"), values


def _diagnose(machine: MachineFile, registry: Registry, _: Namespace) -> tuple[Iterable[str], Any]:
    found = diagnose(machine.make_study(), machine.catalogue)
    before, after = (compare_circles(machine, registry, study) for study in (found.study, found.complete))
    sections = findings.lay_out_diagnosis(found, before, _SAY)
    path = show_path(machine.path)
    further = ["", f"next: zlmreport machine add {path} {found.found[0]}"] if found.found else []
    if found.is_tied:
        further = ["", f"next: zlmreport machine plan {path}"]
    return _lay_out(machine, sections, *further), collect_diagnosis(found, before, after)


def _plan(machine: MachineFile, _registry: Registry, _: Namespace) -> tuple[Iterable[str], Any]:
    found = plan_next_run(diagnose(machine.make_study(), machine.catalogue), machine.catalogue)
    return _lay_out(machine, [lay_out_plan(found, _SAY)]), plan_values(found)


def _write_certificate(
    machine: MachineFile, registry: Registry, options: Namespace
) -> tuple[Iterable[str], Any]:
    """Write the document on a machine, and its results for programs."""
    document = make_machine_document(machine, registry)
    output, certificate = machine.file.keys.output, document.certificate
    folder = options.output or output.directory or machine.path.parent
    place = Place("--format") if options.format else machine.file.place_of("output", "formats")
    stated = options.format.split(",") if options.format else output.formats
    renderers = [registry.renderer(each.strip(), place) for each in stated if each.strip()]
    _refuse_formats_of_jobs(renderers, place)
    documents = [
        Document(folder / name, document.results if each.identifier == "json" else each.render(certificate))
        for name, each in zip(name_files(certificate.number, renderers), renderers, strict=True)
    ]
    write(documents)
    shown, files = zip(*((show_path(each.path), str(each.path)) for each in documents), strict=True)
    return shown, {"schema": "zlmreport/machine-document/1", "number": certificate.number, "files": files}


def _refuse_formats_of_jobs(renderers: Iterable[Renderer], place: Place) -> None:
    """Raise `InputError` with the formats that write what a job measured: this document is of none."""
    refused = [
        Problem(
            place,
            f"{each.identifier} states what a job measured, and a document on a machine is of none; take it "
            "out of its formats: json has the numbers of a machine",
        )
        for each in renderers
        if needs_job(each)
    ]
    if refused:
        raise InputError(refused)


def _build(machine: MachineFile, _registry: Registry, options: Namespace) -> tuple[Iterable[str], Any]:
    """Add effect after effect, and write them into the machine file."""
    found = diagnose(machine.make_study(), machine.catalogue)
    if found.found and not options.dry_run:
        edit_effects(machine, (*machine.effect_names, *found.found))
    sections = [
        findings.lay_out_verdict_after_build(found, _SAY),
        findings.lay_out_steps(found, _SAY),
        findings.lay_out_model(found.complete, _SAY),
    ]
    path = show_path(machine.path)
    changes = lay_out_changes(path, [f"+ {each}" for each in found.found], is_tried=options.dry_run)
    following = _find_next_after_build(found, is_tried=options.dry_run)
    further = ["", *changes, f"next: zlmreport machine {following} {path}"]
    return _lay_out(machine, sections, *further), build_values(found)


def _find_next_after_build(found: MachineDiagnosis, *, is_tried: bool) -> str:
    if found.found and is_tried:
        return "build"
    if found.is_tied:
        return "plan"
    return "diagnose" if found.remainder else "certificate"


def _compensate(machine: MachineFile, registry: Registry, options: Namespace) -> tuple[Iterable[str], Any]:
    """Write tables across axes with their forecast, or hold circles that were run with them against it."""
    sections, files, values = compensate(machine, registry, options)
    further = [f"written: {', '.join(map(show_path, files))}"] if files else ["--output DIR writes it"]
    if not options.trial:
        further.append("next: load it, run the circles again, then the same with --confirm CIRCLE.yaml")
    return _lay_out(machine, sections, *([] if options.confirm else ["", *further])), values


def _add(machine: MachineFile, registry: Registry, options: Namespace) -> tuple[Iterable[str], Any]:
    """Write an effect into the machine file, and say how the error changed."""
    effects = list_effects_with(machine, options.effect, registry, Place("zlmreport machine add"))
    return _change_effects(machine, registry, effects)


def _remove(machine: MachineFile, registry: Registry, options: Namespace) -> tuple[Iterable[str], Any]:
    """Take an effect out of the machine file, and say how the error changed."""
    return _change_effects(machine, registry, list_effects_without(machine, options.effect))


def _change_effects(
    machine: MachineFile, registry: Registry, effects: Sequence[CircleEffect]
) -> tuple[Iterable[str], Any]:
    before, after = machine.make_study(), machine.make_study(effects)
    compared = [compare_circles(machine, registry, study) for study in (before, after)]
    edit_effects(machine, tuple(each.identifier for each in effects))
    _, noise = find_noise_of_both(before, after)
    sections = [
        findings.lay_out_change(before, after, _SAY),
        *(
            Section("sizes", title, (tests.lay_out_sizes(each, _SAY, noise),))
            for title, each in zip(("Tests before", "Tests after"), compared, strict=True)
        ),
        findings.lay_out_model(after, _SAY),
    ]
    return _lay_out(machine, sections), change_values(before, after, (compared[0], compared[1]))


_ACTIONS = {
    "predict": _predict,
    "check": _check,
    "diagnose": _diagnose,
    "build": _build,
    "plan": _plan,
    "certificate": _write_certificate,
    "compensate": _compensate,
    "add": _add,
    "remove": _remove,
}


_COMMAND = Place("zlmreport machine compensate")


def compensate(
    machine: MachineFile, registry: Registry, options: Namespace
) -> tuple[Sequence[Section], Sequence[Path], dict[str, Any]]:
    """Return what is said of the tables, the files that were written, and the values.

    Raises `InputError` if the control takes no such tables, or its sign is neither known nor stated.
    """
    if options.step is not None and options.step <= 0:
        raise InputError.at(_COMMAND, f"--step {options.step:g}: rows are more than 0 mm apart, such as 25")
    step = None if options.step is None else MILLIMETRE.to_si(options.step)
    wanted = CrossWanted(options.controller, options.moves, step, _COMMAND, is_command=True)
    if options.trial:
        control, table, files = make_trial(machine, registry, wanted)
        written = _write_tables(files, machine, options, "-trial")
        values = {"schema": SCHEMA, "controller": control.identifier, "trial": True}
        return [lay_out_trial(table, _SAY)], written, {**values, "files": list(map(str, written))}
    made = make_cross(machine, registry, wanted)
    if options.confirm:
        found = confirm(machine, made, options.confirm, registry, _COMMAND)
        return [lay_out_confirmation(found, _SAY)], (), collect_confirmation(found)
    written = _write_tables(made.files, machine, options, "")
    return lay_out_cross(made, _SAY), written, {**collect_cross(made), "files": list(map(str, written))}


def find_exit_code(values: Mapping[str, Any]) -> int:
    """Return 1 for tables that circles do not confirm, by the values of an action; 0 for all else."""
    is_confirmation = values.get("schema") == CONFIRMATION_SCHEMA
    return NOT_MET if is_confirmation and values["verdict"] != CrossVerdict.HELD.value else 0


def _write_tables(files: Any, machine: MachineFile, options: Namespace, mark: str) -> Sequence[Path]:
    if options.output is None:
        return ()
    documents = make_table_documents(files, options.output, f"{machine.number}{mark}")
    return write_new(documents)
