"""``zlmreport compensate``: a table for a control, what it will leave, and whether a second test holds it."""

from __future__ import annotations

from argparse import Namespace
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from zlmreport import pipeline
from zlmreport.cli.terminal import Colour, print_json, shown_path, table, wrapped
from zlmreport.compensation.confirmation import Confirmation, ConfirmationVerdict, confirm
from zlmreport.compensation.curve import CompensationTable, ErrorCurve, curve_of, table_of
from zlmreport.compensation.forecast import Forecast, forecast
from zlmreport.errors import InputError, Place
from zlmreport.files import Document, demand_free, write
from zlmreport.job.choices import controller_choice
from zlmreport.job.job import Job
from zlmreport.job.loading import load
from zlmreport.job.tree import Entry, Keys, Scalar, keys_of
from zlmreport.language import Language
from zlmreport.plugin.protocols import Controller
from zlmreport.plugins import Registry, find_plugins
from zlmreport.quantities.formatting import fixed_number, general_number

SCHEMA = "zlmreport/compensation/1"
CONFIRMATION_SCHEMA = "zlmreport/confirmation/1"
_COMMAND = Place("zlmreport compensate")
_UNCONFIRMED = "unconfirmed"
_SAID = {
    ConfirmationVerdict.HELD: "the second test holds the forecast",
    ConfirmationVerdict.WRONG_SIGN: "the table acts with the wrong sign: turn it",
    ConfirmationVerdict.HALF: "half of the table acts; look for a factor of two",
    ConfirmationVerdict.SHIFTED: "the table acts at other positions; look at its start",
    ConfirmationVerdict.OTHER: "the second test does not show this table; is it active?",
}


@dataclass(frozen=True, slots=True)
class _Made:
    """A table, with all that it was made from and into."""

    job: Job
    controller: Controller
    curve: ErrorCurve
    meant: CompensationTable
    decoded: CompensationTable
    files: dict[str, str]
    forecast: Forecast


def run(options: Namespace) -> int:
    """Write a table with its forecast, or hold a second test against one."""
    registry = find_plugins(files=options.plugin)
    if options.confirm:
        if len(options.jobs) != 2:
            raise InputError.at(_COMMAND, "--confirm takes two jobs: the test before, and the one after")
        return _confirm(options, registry)
    if len(options.jobs) != 1:
        raise InputError.at(_COMMAND, "one job makes a table; --confirm BEFORE.yaml AFTER.yaml takes two")
    made = _made(load(options.jobs[0], registry), registry, options)
    written: Sequence[Path] = ()
    if options.output:
        sheet = "".join(f"{line}\n" for line in _sheet(made))
        texts = {**made.files, "-compensation.txt": sheet}
        number = made.job.keys.certificate.number
        documents = [
            Document(options.output / f"{number}{end}", text.encode()) for end, text in texts.items()
        ]
        demand_free(document.path for document in documents)
        written = write(documents)
    if options.json:
        print_json(_values(made, written))
        return 0
    print(*_lines(made), sep="\n")
    print()
    for path in written:
        print(shown_path(path))
    if not options.output:
        print("the table and its sheet: state a folder, --output DIR")
    print("next: load the table, measure again, then zlmreport compensate --confirm BEFORE.yaml AFTER.yaml")
    return 0


def _made(job: Job, registry: Registry, options: Namespace) -> _Made:
    place = job.place_of("axis.compensation_table")
    if job.keys.axis.compensation_table is None:
        raise InputError.at(
            place,
            "axis.compensation_table is missing: which table was active during this test? Name its file, or "
            "state none; a new table on top of one that nobody knows corrects twice",
        )
    controller, own = _controller(job, registry, options)
    if controller.confidence != "verified" and not options.unconfirmed:
        raise InputError.at(
            _COMMAND,
            f"the format of {controller.identifier} is {controller.confidence}, and was never tried on the "
            "control; --unconfirmed writes it all the same: try it with care, one point first",
        )
    curve = curve_of(pipeline.read(job, registry), job.source.place)
    number = job.keys.certificate.number
    meant = table_of(
        curve,
        job.axis,
        number,
        _COMMAND,
        step=job.axis.position_unit.to_si(options.step) if options.step else None,
        is_equidistant=controller.is_equidistant,
    )
    files = dict(controller.files(meant, own))
    decoded = controller.read(files, meant, own)
    active = job.axis.compensation_table
    before = active and replace(
        meant,
        positions=_array(active.positions),
        forward=_array(active.values),
        reverse=_array(active.reverse or active.values),
    )
    return _Made(
        job, controller, curve, meant, decoded, files, forecast(curve, meant, decoded, before or None)
    )


def _array(values: Sequence[float]) -> Any:
    import numpy as np  # noqa: PLC0415 (a parser needs none)

    return np.array(values)


def _controller(job: Job, registry: Registry, options: Namespace) -> tuple[Controller, Any]:
    """Return the control that the command line names, or else the job, with its keys and those of --set."""
    stated = job.controller
    name = options.controller or (stated.identifier if stated else None)
    if name is None:
        known = ", ".join(each.identifier for each in registry.controllers)
        raise InputError.at(
            _COMMAND, f"which control? State --controller NAME, or compensation.controller: {known}"
        )
    base: Keys = stated.stated if stated and stated.identifier == name else keys_of(_COMMAND)
    entries = [Entry(key, _COMMAND, Scalar(_COMMAND, text)) for key, text in options.set]
    named = Entry("controller", _COMMAND, Scalar(_COMMAND, name))
    problems: list[Any] = []
    choice = controller_choice(
        keys_of(base.place, (*base.entries.values(), *entries, named)), registry, problems
    )
    if problems or choice is None:
        raise InputError(problems)
    return registry.controller(name), choice.options


def _confirm(options: Namespace, registry: Registry) -> int:
    before, after = (load(path, registry) for path in options.jobs)
    made = _made(before, registry, options)
    found = confirm(
        made.curve,
        curve_of(pipeline.read(after, registry), after.source.place),
        made.decoded,
        after.source.place,
    )
    if options.json:
        print_json(
            {
                "schema": CONFIRMATION_SCHEMA,
                "verdict": found.verdict.value,
                "ratio": found.ratio,
                "applied": found.applied,
                "shift": before.axis.position_unit.from_si(found.shift),
            }
        )
    else:
        print(*_confirmation_lines(before, found), sep="\n")
    return 0 if found.verdict is ConfirmationVerdict.HELD else 1


def _confirmation_lines(job: Job, found: Confirmation) -> Iterator[str]:
    is_held = found.verdict is ConfirmationVerdict.HELD
    yield f"{(Colour.BOLD if is_held else Colour.RED).of(found.verdict.value)}  {_SAID[found.verdict]}"
    yield from wrapped(f"E after is {fixed_number(100 * found.ratio, 1)} % of E before")
    yield from wrapped(f"{fixed_number(100 * found.applied, 0)} % of the table shows in the second test")
    if found.shift:
        unit = job.axis.position_unit
        yield from wrapped(f"shifted by {general_number(round(unit.from_si(found.shift), 3))} {unit.symbol}")


def _values(made: _Made, written: Sequence[Path]) -> dict[str, Any]:
    unit, position = made.job.axis.deviation_unit, made.job.axis.position_unit
    factor = unit.from_si(1.0)
    number = made.job.keys.certificate.number
    files = [str(path) for path in written] or [f"{number}{end}" for end in made.files]
    return {
        "schema": SCHEMA,
        "certificate": {"number": number},
        "controller": made.controller.identifier,
        "confidence": made.controller.confidence,
        "files": files,
        "rows": len(made.meant.positions),
        "unit": unit.ascii,
        "forecast": {
            "before": made.forecast.before.in_unit(factor),
            "after": made.forecast.after.in_unit(factor),
            "between_grid_points": {
                "largest": made.forecast.between * factor,
                "at": position.from_si(made.forecast.between_at),
            },
            "rounding": made.forecast.rounding * factor,
        },
    }


def _lines(made: _Made) -> Iterator[str]:
    unit, position = made.job.axis.deviation_unit, made.job.axis.position_unit
    number = made.job.keys.certificate.number
    title = made.controller.title.in_language(Language.ENGLISH)
    yield f"{Colour.BOLD.of(number)}  axis {made.job.axis.name}: {title}, {made.controller.confidence}"
    yield ""
    before, after = (each.in_unit(unit.from_si(1.0)) for each in (made.forecast.before, made.forecast.after))
    rows = [
        (symbol, fixed_number(before[symbol], 2), fixed_number(after[symbol], 2), unit.symbol)
        for symbol in before
    ]
    yield from table([("", "before", "after", ""), *rows], indent="  ")
    yield ""
    between, at = unit.from_si(made.forecast.between), position.from_si(made.forecast.between_at)
    rounding = unit.from_si(made.forecast.rounding)
    yield from wrapped(
        f"between its {len(made.meant.positions)} rows up to {fixed_number(between, 2)} {unit.symbol} "
        "are left, "
        f"at {general_number(round(at, 3))} {position.symbol}; rounding takes {fixed_number(rounding, 3)} "
        f"{unit.symbol}"
    )
    yield from wrapped("a forecast is no measurement: the axis with its table needs a test of its own")


def _sheet(made: _Made) -> Iterator[str]:
    """Yield what who loads the table must have in hand: signs, one worked row, steps, and the check."""
    job, unit, position = made.job, made.job.axis.deviation_unit, made.job.axis.position_unit
    machine, active = job.keys.machine, job.keys.axis.compensation_table
    yield from (line.replace("\x1b[1m", "").replace("\x1b[0m", "") for line in _lines(made))
    yield ""
    yield f"machine: {machine.model or '–'}, serial {machine.serial or '–'}; axis {job.axis.name}"
    yield f"measured: {job.keys.measurement.date or '–'}"
    yield f"active during the test: {active.name if isinstance(active, Path) else 'no table'}"
    middle = len(made.meant.positions) // 2
    at, up, down = (
        float(each[middle]) for each in (made.meant.positions, made.meant.forward, made.meant.reverse)
    )
    yield (
        f"worked row: at {position.from_si(at):.6g} {position.symbol} the axis stood {unit.from_si(up):+.3f} "
        f"{unit.symbol} too far moving forward, {unit.from_si(down):+.3f} {unit.symbol} moving back "
        "(actual − target)"
    )
    for note in made.controller.notes:
        yield note.in_language(Language.ENGLISH)
    yield (
        "check: load the table and measure this point again; the deviation must vanish. If it doubles, the "
        "sign is wrong: take the table out. A backlash parameter of the control must not correct the same "
        "play again."
    )
