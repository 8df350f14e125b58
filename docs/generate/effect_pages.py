"""What each installed effect says of itself: equation, parameters, needs, look, and what it is taken for."""

from __future__ import annotations

import inspect
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace

import numpy as np
from markdown import code, symbol, table

from zlmreport.job.types import list_keys_in
from zlmreport.language import Language, Words
from zlmreport.measurement.axis import AxisKind
from zlmreport.measurement.units import Unit, write_behind
from zlmreport.model.effects.design import Design
from zlmreport.model.effects.effect import Effect, Parameter, Shape, find_unit_of
from zlmreport.model.effects.sizes import find_usual_range
from zlmreport.model.fitting.observations import select_readings
from zlmreport.plugin.kinds import EFFECT
from zlmreport.plugin.registry import find_plugins
from zlmreport.testing import full_designs

_EN, _DE = Language.ENGLISH, Language.GERMAN
_HEADINGS = {
    Shape.POSITION: "Along the position",
    Shape.DIRECTION: "Between the directions",
    Shape.TIME: "In time and with temperature",
    Shape.RUN: "From run to run",
}
_MICROMETRE = 1e-6


def text() -> str:
    """Return a section for each effect that comes with this project, ordered by what it changes along."""
    registry = find_plugins()
    own = [
        effect
        for effect in registry.effects
        if registry.find_origin(EFFECT, effect.identifier).distribution == "zlmreport"
    ]
    return "\n\n".join(part for shape in Shape for part in _group(shape, own))


def _group(shape: Shape, effects: Sequence[Effect]) -> Iterator[str]:
    listed = [effect for effect in effects if effect.shape is shape]
    yield f"## {_HEADINGS[shape]}"
    yield table(
        ("Effect", "What it is", "Equation"),
        ((_link(each.identifier), each.title.in_language(_EN), symbol(each.equation)) for each in listed),
    )
    for effect in listed:
        yield from _section(effect)


def _section(effect: Effect) -> Iterator[str]:
    yield f"### {code(effect.identifier)}"
    yield f"{effect.title.in_language(_EN)} ({effect.title.in_language(_DE)})."
    yield symbol(effect.equation)
    yield _doc(effect)
    yield f"**Look.** {effect.look.in_language(_EN)}"
    if effect.remedy:
        yield f"**Remedy.** {effect.remedy.in_language(_EN)}"
    yield table(("Parameter", "Printed", "Meaning", "Usual", "Range", "Found"), _parameters(effect))
    if any((each.smallest, each.largest) != (None, None) for each in _all(effect)):
        yield f"Ranges: {effect.ranges_from.in_language(_EN)}."
    sizes = list(dict.fromkeys(_sizes(effect)))
    if sizes:
        yield "\n".join(f"- {each}" for each in sizes)
    if effect.source:
        yield f"**Known.** {effect.source.in_language(_EN)}."
    if effect.several:
        yield f"A model may hold several: the second is {code(f'{effect.identifier}-2')}."
    keys = list_keys_in(effect.options)
    if keys:
        yield "Its key in a job:"
        yield "\n".join(f"- {code(name)}: {field.description}" for name, field in keys.items())
        yield f"A contest tries {_joined(code(_settings(form)) for form in effect.forms())}."
    if effect.contains:
        yield f"It contains {_joined(map(_link, effect.contains))}, which cannot stand beside it in a model."
    lacking = _lacking(effect)
    if lacking:
        yield "**What a diagnosis says where it cannot be tried**"
        yield "\n".join(f"- {reason}" for reason in lacking)
    if effect.confusions:
        yield "**What it is taken for, and what tells them apart**"
        yield "\n".join(
            f"- {_link(each.effect)}: {each.told_apart_by.in_language(_EN)}" for each in effect.confusions
        )


def _doc(effect: Effect) -> str:
    """Return what happens, or what the code says of it."""
    return effect.physics.in_language(_EN) if effect.physics else inspect.getdoc(effect.__class__) or ""


def _all(effect: Effect) -> Iterator[Parameter]:
    """Yield the parameters of an effect, those that only some of its forms have behind."""
    found: dict[str, Parameter] = {}
    for form in (effect, *effect.forms()):
        for each in (*form.linear, *form.searched):
            found.setdefault(each.name, each)
    yield from found.values()


def _parameters(effect: Effect) -> Iterator[tuple[str, ...]]:
    linear = {each.name for form in effect.forms() for each in form.linear}
    for parameter in _all(effect):
        found = "linear" if parameter.name in linear else _how_found(effect)
        yield (*_described(effect, parameter), found)


def _described(effect: Effect, parameter: Parameter) -> tuple[str, ...]:
    usual = "; ".join(
        dict.fromkeys(_range(parameter, kind, *find_usual_range(parameter, kind)) for kind in _kinds(effect))
        if parameter.usual
        else ()
    )
    ranges = dict.fromkeys(
        _range(parameter, kind, parameter.smallest, parameter.largest) for kind in _kinds(effect)
    )
    return (
        code(parameter.name),
        symbol(parameter.notation),
        parameter.description.in_language(_EN),
        usual,
        "; ".join(ranges),
    )


def _sizes(effect: Effect) -> Iterator[str]:
    """Yield the names that values have, what is asked of others, and what physics excludes."""
    kind = _kinds(effect)[0]
    for each in _all(effect):
        unit = find_unit_of(each.dimension, kind)
        for named in each.named:
            ends = _write_span(_number(named.low * unit.per_si), _number(named.high * unit.per_si), unit)
            said = named.says.in_language(_EN)
            yield f"{code(each.name)} of {ends}: {said}."
        for question in (each.question, each.question_below):
            if question:
                yield f"Asked: “{question.given(value='…', times='…').in_language(_EN)}”"
    keys = getattr(effect, "keys", None)
    for name, each in keys.parameters.items() if keys else ():
        if each.possible:
            yield f"{code(name)} is limited: {each.possible.because.in_language(_EN)}."


def _range(parameter: Parameter, kind: AxisKind, smallest: float | None, largest: float | None) -> str:
    unit = find_unit_of(parameter.dimension, kind)
    low, high = (None if bound is None else _number(bound * unit.per_si) for bound in (smallest, largest))
    if low is None and high is None:
        return f"any, {unit.symbol}" if unit.symbol else "any"
    if low and high:
        return _write_span(low, high, unit)
    behind = write_behind(unit.symbol).rstrip()
    return f"from {low}{behind}" if low else f"up to {high}{behind}"


def _write_span(low: str, high: str, unit: Unit) -> str:
    """Write from where to where: ``−3 to 3 µm``, ``−5″ to 5″``."""
    behind = write_behind(unit.symbol).rstrip()
    return f"{low}{'' if behind.startswith(' ') else behind} to {high}{behind}"


def _number(value: float) -> str:
    """Write a bound to three digits: those of a plausible range are round."""
    return f"{float(f'{value:.3g}'):g}".replace("-", "−") if abs(value) < 1e4 else f"{value:.0f}"


def _how_found(effect: Effect) -> str:
    """Say whether a searched parameter is known from the job."""
    stated = any(len(effect.grid(design)) == 1 for design in _full(effect))
    unstated = any(
        len(effect.grid(design)) > 1
        for full in _full(effect)
        for design in (full, *_without_keys(full))
        if effect.untestable(design) is None
    )
    if stated:
        return "stated in the job, else searched" if unstated else "stated in the job"
    return "searched"


def _kinds(effect: Effect) -> list[AxisKind]:
    kinds = {design.axis.kind for design in _full(effect)}
    return [kind for kind in AxisKind if kind in kinds]


def _full(effect: Effect) -> list[Design]:
    return [design for design in full_designs().values() if effect.untestable(design) is None]


def _lacking(effect: Effect) -> list[str]:
    """Return why it cannot be tried on tests that lack one thing each, in the words of a diagnosis."""
    reasons: dict[str, None] = {}
    for design in full_designs().values():
        _note(effect.untestable(design), reasons)
    for full in _full(effect):
        for poorer in _poorer(full):
            _note(effect.untestable(poorer), reasons)
    return list(reasons)


def _note(reason: Words | None, reasons: dict[str, None]) -> None:
    if reason is not None:
        # What stands behind a semicolon is what the test at hand has instead.
        reasons.setdefault(reason.in_language(_EN).partition(";")[0])


def _poorer(full: Design) -> Iterator[Design]:
    """Yield a complete test without one thing that it has."""
    for name in full.conditions:
        yield replace(full, conditions={key: log for key, log in full.conditions.items() if key != name})
    yield from _without_keys(full)
    for kept in (
        full.direction > 0,
        full.run == full.run[0],
        full.target == full.target[0],
    ):
        yield select_readings(full, np.flatnonzero(kept))
    yield replace(full, time=np.zeros_like(full.time))
    first = float(full.position.min())
    yield replace(full, span=(first, first + _MICROMETRE))


def _without_keys(full: Design) -> Iterator[Design]:
    """Yield a complete test without one thing that the job states of the axis."""
    axis = full.axis
    for poorer in (
        replace(axis, screw_pitch=None),
        replace(axis, signal_period=None),
        replace(axis, scale_element=None),
        replace(axis, pole_pitch=None),
        replace(axis, compensation_table=None),
        replace(axis, angular_errors=None),
        replace(axis, abbe_offset=None),
    ):
        yield replace(full, axis=poorer)


def _settings(effect: Effect) -> str:
    settings = effect.settings
    return ", ".join(f"{name}: {_listed(getattr(settings, name))}" for name in list_keys_in(effect.options))


def _listed(value: object) -> str:
    return f"[{', '.join(map(str, value))}]" if isinstance(value, tuple) else str(value)


def _link(identifier: str) -> str:
    return f"[{code(identifier)}](#{identifier})"


def _joined(items: Iterable[str]) -> str:
    *others, last = items
    return f"{', '.join(others)} and {last}" if others else last
