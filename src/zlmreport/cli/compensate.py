"""``zlmreport compensate``: a table for a control, what it will leave, and whether a second test holds it."""

from __future__ import annotations

import json
import os
from argparse import Namespace
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from zlmreport import pipeline
from zlmreport.cli.layout import lay_out_sections
from zlmreport.cli.terminal import lay_out_heading, print_json, say, show_path, wrap
from zlmreport.document.subjects.compensation import (
    Uncertainties,
    lay_out_confirmation,
    lay_out_forecast,
    make_compensation_sheet,
    say_adjustment,
)
from zlmreport.document.writer import Writer
from zlmreport.errors import NOT_MET, InputError, Place, quoted
from zlmreport.evaluation.uncertainty.budget import Budget
from zlmreport.files import Document, write_new
from zlmreport.job.choices import choose_controller_of
from zlmreport.job.job import Job
from zlmreport.job.loading import load
from zlmreport.job.tree import KeyEntry, Keys, Scalar, make_keys_of
from zlmreport.job.yaml_text import write_group
from zlmreport.language import Language
from zlmreport.measurement.axis import refuse_other_than_positions
from zlmreport.measurement.measurement_set import MeasurementSet
from zlmreport.model.compensation.basis import (
    FittedModel,
    TableBasis,
    apply_table,
    make_basis_of_means,
    make_basis_of_model,
)
from zlmreport.model.compensation.confirmation import ConfirmationVerdict, confirm
from zlmreport.model.compensation.curve import ErrorCurve, make_error_curve
from zlmreport.model.compensation.forecast import compute_figures
from zlmreport.model.compensation.making import Made, make
from zlmreport.plugin.protocols import Controller
from zlmreport.plugin.registry import Registry, find_plugins

SCHEMA = "zlmreport/compensation/1"
CONFIRMATION_SCHEMA = "zlmreport/confirmation/1"
_COMMAND = Place("zlmreport compensate")
_SHEET = "-compensation.pdf"
_STATED_AS_NONE = (
    "the job of the second test says that no table was active, and so would its certificate: name the file "
    "of the table as axis.compensation_table (--controller csv writes it)"
)


def run(options: Namespace) -> int:
    """Write a table with its forecast, or hold a second test against one."""
    registry = find_plugins(files=options.plugin)
    if options.confirm:
        if len(options.jobs) != 2:
            raise InputError.at(_COMMAND, "--confirm takes two jobs: the test before, and the one after")
        return _confirm(options, registry)
    if len(options.jobs) != 1:
        raise InputError.at(_COMMAND, "one job makes a table; --confirm BEFORE.yaml AFTER.yaml takes two")
    job = load(options.jobs[0], registry)
    made, measurements = _make_tables(job, registry, options)
    uncertainties = _find_uncertainties(job, measurements, made, registry)
    written: Sequence[Path] = ()
    if options.output:
        sheet = registry.renderer("pdf").render(
            make_compensation_sheet(job, measurements, made, uncertainties)
        )
        contents = {end: text.encode() for end, text in made.files.items()} | {_SHEET: sheet}
        number = job.keys.certificate.number
        documents = [Document(options.output / f"{number}{end}", each) for end, each in contents.items()]
        written = write_new(documents)
    if options.json:
        print_json(_collect_values(job, made, uncertainties, written))
        return 0
    section = lay_out_forecast(made, Writer.of(measurements, Language.ENGLISH), uncertainties)
    print(*_lay_out_heading(job, made), *lay_out_sections([section]), "", sep="\n")
    for path in written:
        print(show_path(path))
    if not options.output:
        print("the table and its sheet: state a folder, --output DIR")
    following = "load the table, measure again, then zlmreport compensate --confirm BEFORE.yaml AFTER.yaml"
    print(*wrap(f"next: {following}", ""), sep="\n")
    return 0


def _lay_out_heading(job: Job, made: Made) -> Iterator[str]:
    control = f"{say(made.controller.title)}, {made.controller.confidence}"
    return lay_out_heading(job.keys.certificate.number, f"axis {job.axis.name}: {control}")


def _make_tables(job: Job, registry: Registry, options: Namespace) -> tuple[Made, MeasurementSet]:
    refuse_other_than_positions(
        job.axis,
        job.place_of("measurement.error"),
        "a control's table moves the axis along itself, and takes away nothing else",
    )
    place = job.place_of("axis.compensation_table")
    if job.keys.axis.compensation_table is None:
        raise InputError.at(
            place,
            "axis.compensation_table is missing: which table was active during this test? Name its file, or "
            "state none; a new table on top of one that nobody knows corrects twice",
        )
    controller, own = _choose_controller(job, registry, options)
    if controller.confidence != "verified" and not options.unconfirmed:
        raise InputError.at(
            _COMMAND,
            f"the format of {controller.identifier} is {controller.confidence}, and was never tried on the "
            "control; --unconfirmed writes it all the same: try it with care, one point first",
        )
    measurements = pipeline.read(job, registry)
    curve = make_error_curve(measurements, job.source.place)
    basis = _choose_basis(job, curve, measurements, registry, options)
    budget = pipeline.make_budget_of_job(job, measurements, registry)
    made = make(
        basis,
        job.axis,
        job.keys.certificate.number,
        _COMMAND,
        controller,
        own,
        step=job.axis.position_unit.to_si(options.step) if options.step is not None else None,
        budget=budget if isinstance(budget, Budget) else None,
    )
    return made, measurements


def _choose_basis(
    job: Job, curve: ErrorCurve, measurements: MeasurementSet, registry: Registry, options: Namespace
) -> TableBasis:
    """Return what is known of the axis: its means, or its model where that is asked for."""
    is_of_model = options.source == "model"
    if is_of_model and not job.effects:
        raise InputError.at(
            job.place_of("model.effects"), "--from model needs an error model; state model.effects"
        )
    fitted = None
    if job.effects:
        from zlmreport.model.diagnosis.study import Study  # noqa: PLC0415 - only for a job with a model

        study = Study.of(job, measurements, registry.effects, pipeline.read_sessions(job, registry))
        fitted = FittedModel(measurements, study.observed, study.fit_whole().fit)
    if is_of_model and fitted:
        return make_basis_of_model(curve, fitted)
    return make_basis_of_means(curve, measurements, fitted)


def _choose_controller(job: Job, registry: Registry, options: Namespace) -> tuple[Controller, Any]:
    """Return the control that the command line names, or else the job, with its keys and those of --set."""
    stated = job.controller
    name = options.controller or (stated.identifier if stated else None)
    if name is None:
        known = ", ".join(each.identifier for each in registry.controllers)
        raise InputError.at(
            _COMMAND, f"which control? State --controller NAME, or compensation.controller: {known}"
        )
    base: Keys = stated.stated if stated and stated.identifier == name else make_keys_of(_COMMAND)
    entries = [KeyEntry(key, _COMMAND, Scalar(_COMMAND, text)) for key, text in options.set]
    named = KeyEntry("controller", _COMMAND, Scalar(_COMMAND, name))
    problems: list[Any] = []
    choice = choose_controller_of(
        make_keys_of(base.place, (*base.entries.values(), *entries, named)), registry, problems
    )
    if problems or choice is None:
        raise InputError(problems)
    return registry.controller(name), choice.options


def _confirm(options: Namespace, registry: Registry) -> int:
    before, after = (load(path, registry) for path in options.jobs)
    of_table, machine = (each.keys.machine for each in (before, after))
    if machine.is_other_than(of_table):
        serials = (quoted(each.serial or "") for each in (machine, of_table))
        said = "it is a test of machine {}, and the table is of machine {}".format(*serials)
        raise InputError.at(after.place_of("machine.serial"), said)
    made, measurements = _make_tables(before, registry, options)
    curve = make_error_curve(pipeline.read(after, registry), after.source.place)
    play, place = made.forecast.play, after.source.place
    found = confirm(made.basis, curve, after.axis, made.decoded, place, made.active, play)
    shown = compute_figures(np.stack([curve.forward, curve.reverse]), curve)
    written: Sequence[Path] = ()
    if options.output and after.keys.as_found is None:
        document = _make_job_of_both(before, after, made, options.jobs[1], options.output)
        written = write_new([document])
    unit = before.axis.deviation_unit
    factor = unit.from_si(1.0)
    if options.json:
        expected = made.forecast.choose_second_test(has_backlash=found.has_backlash)
        print_json(
            {
                "schema": CONFIRMATION_SCHEMA,
                "verdict": found.verdict.promised.value,
                "acts": found.verdict.value,
                "ratio": found.ratio,
                "applied": found.applied,
                "applied_uncertainty": found.expanded_uncertainty if found.is_seen else None,
                "backlash": found.has_backlash,
                "shift": before.axis.position_unit.from_si(found.shift),
                "rest": {"as_made": found.left * factor, "as_it_acts": found.rest * factor},
                "unit": unit.ascii,
                "before": made.forecast.before.in_unit(factor),
                "forecast": {name: each.in_unit(factor) for name, each in expected.items()},
                "after": shown.in_unit(factor),
                "files": [str(path) for path in written],
            }
        )
    else:
        writer = Writer.of(measurements, Language.ENGLISH)
        print(
            *_lay_out_heading(before, made),
            *lay_out_sections([lay_out_confirmation(found, made, shown, writer)]),
            "",
            sep="\n",
        )
        if after.keys.axis.compensation_table == "none":
            print(*wrap(_STATED_AS_NONE, ""), sep="\n")
        both = written[0] if written else options.jobs[1] if after.keys.as_found else None
        # A command stands on a line by itself: it is copied whole.
        how = f"\n  zlmreport {show_path(both)}" if both else " --output DIR writes the job"
        print(f"the certificate of both tests, as found and as left:{how}")
    return 0 if found.verdict is ConfirmationVerdict.HELD else NOT_MET


def _make_job_of_both(before: Job, after: Job, made: Made, path: Path, folder: Path) -> Document:
    """Return the job of the axis as found, before its table, and as left."""

    def write(value: object) -> str:
        return str(value) if not isinstance(value, Path) else os.path.relpath(value, folder)

    source = before.source.options.model_dump(exclude_unset=True, exclude={"instrument"})
    stated = before.keys.measurement.model_dump(
        exclude_unset=True, by_alias=True, exclude={"source", "tests"}
    )
    measurement = {**stated, "source": {"plugin": before.source.identifier, **source}}
    found: dict[str, Any] = {
        "adjustment": say(say_adjustment(made), after.keys.certificate.language),
        "measurement": measurement,
    }
    if before.keys.environment is not None:
        found["environment"] = before.keys.environment.model_dump(mode="json", exclude_unset=True)
    keys = {"extends": write(path.resolve()), "as_found": json.loads(json.dumps(found, default=write))}
    lines = ["# The axis as found and as left, before and after its compensation table.", *write_group(keys)]
    text = "".join(f"{line}\n" for line in lines)
    return Document(folder / f"{after.keys.certificate.number}-as-left.yaml", text.encode())


def _find_uncertainties(
    job: Job, measurements: MeasurementSet, made: Made, registry: Registry
) -> tuple[dict[str, float], dict[str, float]]:
    """Return U before and with the table, by the first of the job's standards that has these parameters."""
    if not made.forecast.has_set_up:  # no budget, no U
        return {}, {}
    curve, unit = made.basis.curve, job.axis.deviation_unit
    taken = np.stack([curve.forward, curve.reverse]) - made.forecast.left

    def of(readings: MeasurementSet) -> dict[str, float]:
        for each in pipeline.evaluate_all(job, readings, registry):
            found = {
                parameter.quantity.symbol: unit.from_si(parameter.expanded_uncertainty)
                for parameter in each.evaluation.parameters
                if parameter.quantity.symbol in {"E", "M", "B", "A"} and parameter.expanded_uncertainty
            }
            if "E" in found:
                return found
        return {}

    return of(measurements), of(apply_table(measurements, taken))


def _collect_values(
    job: Job, made: Made, uncertainties: Uncertainties, written: Sequence[Path]
) -> dict[str, Any]:
    unit, position = job.axis.deviation_unit, job.axis.position_unit
    factor = unit.from_si(1.0)
    number, forecast = job.keys.certificate.number, made.forecast
    files = [str(path) for path in written] or [f"{number}{end}" for end in made.files]
    grid = made.grid
    return {
        "schema": SCHEMA,
        "certificate": {"number": number},
        "controller": made.controller.identifier,
        "confidence": made.controller.confidence,
        "files": files,
        "rows": len(grid.rows),
        "grid": {
            "reason": grid.reason.value,
            "positions": position.from_si(grid.rows).tolist(),
            "added": grid.added * factor,
            "allowed": grid.allowed * factor,
        },
        "assumed": [say(each) for each in made.assumed],
        "unit": unit.ascii,
        "left_out": [name for name, _ in made.left_out],
        "forecast": {
            "before": forecast.before.in_unit(factor),
            "after": forecast.after.in_unit(factor),
            "expanded_uncertainty": dict(zip(("before", "after"), uncertainties, strict=True)),
            "second_test": {name: each.in_unit(factor) for name, each in forecast.second_test.items()},
            "between_grid_points": {
                "largest": forecast.between * factor,
                "at": position.from_si(forecast.between_at),
            },
            "left_out": forecast.left_out * factor,
            "rounding": forecast.rounding * factor,
        },
    }
