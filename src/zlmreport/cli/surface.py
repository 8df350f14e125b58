"""``zlmreport surface``: the deviation over a plane of two axes, from lines that were measured in it."""

from __future__ import annotations

from argparse import Namespace
from collections.abc import Iterator, Sequence
from itertools import product
from pathlib import Path

import numpy as np

from zlmreport import pipeline
from zlmreport.cli.jobs import load_all
from zlmreport.cli.layout import write_in_a_line
from zlmreport.cli.terminal import Colour, lay_out_table, print_json, say, wrap
from zlmreport.document.subjects.fit import list_error_facts, write_polynomial
from zlmreport.errors import InputError, Place, Problem
from zlmreport.job.job import Job
from zlmreport.language import Language
from zlmreport.language.formatting import round_pair, write_general_number, write_stated_number
from zlmreport.measurement.units import with_unit
from zlmreport.model.effects import wording
from zlmreport.model.effects.model_error import ModelError
from zlmreport.model.plane.plane import Plane, collect_plane, fit_plane
from zlmreport.model.plane.surface import Surface
from zlmreport.plugin.registry import Registry, find_plugins

#: Points of a table where none are asked for: along the axis, and across it.
_ALONG, _ACROSS = 5, 3

Points = Sequence[tuple[float, float]]


def run(options: Namespace) -> int:
    """Fit the plane that the jobs measure, and say the deviation at points of it."""
    registry = find_plugins(files=options.plugin)
    jobs = _load_jobs(options.jobs, registry)
    plane = fit_plane([(job, pipeline.read(job, registry)) for job in jobs])
    unit = plane.axis.position_unit
    points = [(unit.to_si(along), unit.to_si(across)) for along, across in options.at] or _lay_grid(plane)
    try:
        if options.json:
            print_json(collect_plane(plane, points))
        else:
            print(*_tell_lines(plane, points), sep="\n")
    except ModelError as error:
        raise InputError(Problem(Place("--at"), sentence) for sentence in error.sentences) from error
    return 0


def _load_jobs(paths: Sequence[Path], registry: Registry) -> list[Job]:
    """Return all jobs, or every mistake in them."""
    results = load_all(paths, registry)
    errors = [result.error for result in results if result.error]
    if errors:
        worst = max(errors, key=lambda error: error.exit_code)
        raise type(worst)(problem for error in errors for problem in error.problems)
    return [result.job for result in results if result.job]


def _lay_grid(plane: Plane) -> Points:
    spans = [(each.along, each.across) for each in plane.surfaces]
    along, across = zip(*spans, strict=True)
    return [
        (float(p), float(r)) for p, r in product(_space_evenly(along, _ALONG), _space_evenly(across, _ACROSS))
    ]


def _space_evenly(spans: Sequence[tuple[float, float]], count: int) -> Sequence[float]:
    """Return places over what all of the spans have in common."""
    first, last = max(first for first, _ in spans), min(last for _, last in spans)
    places: list[float] = np.linspace(first, last, count).tolist()
    return places


def _tell_lines(plane: Plane, points: Points) -> Iterator[str]:
    unit = plane.axis.position_unit
    where = ", ".join(write_stated_number(unit.from_si(line.across)) for line in plane.lines)
    yield Colour.BOLD.set(f"{plane.axis.name} over the plane of {plane.axis.name} and {plane.second}")
    yield from wrap(f"{len(plane.lines)} lines, at {plane.second} = {where} {unit.symbol}")
    yield f"  Δ in {plane.axis.deviation_unit.symbol}, positions in {unit.symbol}"
    for line in plane.lines:
        design = line.observed.design
        aside = "; ".join(say(wording.reading_at(design, reading)) for reading in line.list_aside().tolist())
        if aside:
            at = f"{plane.second} = {write_stated_number(unit.from_si(line.across))} {unit.symbol}"
            yield from wrap(f"set aside, for it stands off from its repeats, at {at}: {aside}")
    for surface in plane.surfaces:
        yield ""
        error = list_error_facts(surface.error, plane.axis, Language.ENGLISH)
        yield from wrap(f"{surface.approach.arrow} {write_in_a_line(error)}", "")
        yield from wrap(_write_equation(surface))
        yield from wrap(_tell_interaction(surface))
        if surface.missed:
            missed = say(wording.deviation(plane.axis, surface.missed))
            yield from wrap(
                f"the polynomial {Colour.YELLOW.set('misses')} {missed} of what the lines show, root mean "
                "square: ± below is its own uncertainty, and the axis may be off by more"
            )
    yield ""
    yield from _lay_out_table(plane, points)
    yield ""
    yield from wrap(
        f"± is the expanded uncertainty for 95 %. What depends on {plane.second} alone holds only if the "
        "instrument kept its zero from line to line."
    )


def _write_equation(surface: Surface) -> str:
    """Return the polynomial in printed units, as it may be given to a control."""
    axis = surface.fit.design.axis
    found = surface.compute_coefficients().in_units(axis.position_unit, axis.deviation_unit)
    powers = [
        (axis.name if along else surface.readings.second, along or across) for along, across in found.powers
    ]
    return f"Δ = {write_polynomial(found.values.tolist(), powers)}"


def _tell_interaction(surface: Surface) -> str:
    axis, found = surface.fit.design.axis, surface.interaction
    unit = axis.deviation_unit
    value, half = round_pair(unit.from_si(found.value), unit.from_si(found.expanded_uncertainty))
    where = f"{axis.name}·{surface.readings.second}, not in equation (13)"
    text = f"{where}: {with_unit(f'{value} ± {half}', unit.symbol)} at the corners"
    if abs(found.value) <= found.expanded_uncertainty:
        return f"{text}; not needed"
    return f"{text}; {Colour.YELLOW.set('the lines differ in slope')}, and the polynomial misses it"


def _lay_out_table(plane: Plane, points: Points) -> Iterator[str]:
    unit, position = plane.axis.deviation_unit, plane.axis.position_unit
    heads = [f"{surface.approach.arrow} {unit.symbol}" for surface in plane.surfaces]
    columns = []
    for surface in plane.surfaces:
        found = surface.predict(points)
        columns.append(
            [
                " ± ".join(round_pair(value, half))
                for value, half in zip(
                    unit.from_si(found.deviation).tolist(),
                    unit.from_si(found.expanded_uncertainty).tolist(),
                    strict=True,
                )
            ]
        )
    rows = [(f"{plane.axis.name} {position.symbol}", f"{plane.second} {position.symbol}", *heads)]
    for (along, across), *cells in zip(points, *columns, strict=True):
        rows.append(
            (
                write_general_number(position.from_si(along)),
                write_general_number(position.from_si(across)),
                *cells,
            )
        )
    yield from lay_out_table(rows, right=range(len(rows[0])), indent="  ")
