"""What each installed standard says of itself: names, symbols, formulas, requirements, notes."""

from __future__ import annotations

import math
from collections.abc import Iterator

from markdown import code, symbol, table

from zlmreport.evaluation.evaluation import Basis, QuantityGroup
from zlmreport.job.standards import list_adoptions_of
from zlmreport.language import Language
from zlmreport.measurement.axis import Axis, AxisKind
from zlmreport.plugin.kinds import STANDARD
from zlmreport.plugin.protocols import Standard
from zlmreport.plugin.registry import find_plugins
from zlmreport.testing import simulated_test
from zlmreport.testing.measurements import good_tests, is_of_circles, names_of_lines

_EN, _DE = Language.ENGLISH, Language.GERMAN
_GROUPS = {
    QuantityGroup.SYSTEMATIC: "systematic",
    QuantityGroup.RANDOM: "random",
    QuantityGroup.COMPOSITE: "composite",
}
_BASES = {Basis.PUBLISHED: "published", Basis.APPLIED: "applied *"}
_LINEAR = Axis("X", travel=(0.0, 1.0), screw_pitch=0.01, signal_period=20e-6, scale_element=0.5)
#: Tests of the kinds for which a standard may ask different things.
_TESTS = {
    "linear": simulated_test(11, axis=_LINEAR, length=1000.0),
    "linear above 2000 mm": simulated_test(13, 1, axis=Axis("X", travel=(0.0, 3.0)), length=3000.0),
    "rotary": simulated_test(13, axis=Axis("C", AxisKind.ROTARY, travel=(0.0, 2 * math.pi)), length=360.0),
    "rotary above 360°": simulated_test(
        17, 1, axis=Axis("C", AxisKind.ROTARY, travel=(0.0, 4 * math.pi)), length=720.0
    ),
}


def text() -> str:
    """Return a section for each installed standard of this project."""
    registry = find_plugins()
    own = [
        standard
        for standard in registry.standards
        if registry.find_origin(STANDARD, standard.identifier).distribution == "zlmreport"
    ]
    return "\n\n".join(part for standard in own for part in _section(standard))


def _section(standard: Standard) -> Iterator[str]:
    yield f"### {standard.designation}"
    title = standard.title
    names = " or ".join(code(each) for each in (standard.identifier, *list_adoptions_of(standard)))
    yield f"In jobs: {names}. {title.in_language(_EN)} ({title.in_language(_DE)})."
    yield table(
        ("Result", "Printed", "English", "German", "Kind", "Formula"),
        (
            (
                code(quantity.symbol),
                symbol(quantity.notation),
                quantity.name.in_language(_EN),
                quantity.name.in_language(_DE),
                _GROUPS[quantity.group],
                symbol(quantity.formula),
            )
            for quantity in standard.quantities
        ),
    )
    opposite = [quantity for quantity in standard.quantities if quantity.printed_sign < 0]
    if opposite:
        yield (
            "Printed with the sign opposite to the results file: "
            f"{', '.join(symbol(quantity.notation) for quantity in opposite)}."
        )
    if standard.position_quantities:
        yield "By position, beside means, standard deviations and reversal:"
        yield table(
            ("Result", "Printed", "English", "German"),
            (
                (
                    code(quantity.symbol),
                    symbol(quantity.notation),
                    quantity.name.in_language(_EN),
                    quantity.name.in_language(_DE),
                )
                for quantity in standard.position_quantities
            ),
        )
    yield "Requirements on the test:"
    yield table(("Requirement", "Asked of a test that is", "Basis"), _requirements(standard))
    yield "Notes on the certificate:"
    yield "\n".join(f"- {note.in_language(_EN)}" for note in standard.notes)


def _requirements(standard: Standard) -> Iterator[tuple[str, str, str]]:
    """Yield every requirement that one of the tests meets with, once."""
    kinds: dict[tuple[str, Basis], list[str]] = {}
    tests = good_tests(standard) if is_of_circles(standard) or names_of_lines(standard) else _TESTS
    for kind, measurements in tests.items():
        for finding in standard.requirements(measurements, standard.options()):
            asked = finding.requirement.in_language(_EN), finding.basis
            kinds.setdefault(asked, []).append(kind)
    for (requirement, basis), found in kinds.items():
        yield requirement, "any" if len(found) == len(tests) else ", ".join(found), _BASES[basis]
