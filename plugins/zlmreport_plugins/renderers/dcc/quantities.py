"""Values with unit and uncertainty as D-SI 2.2.1 writes them.

Numbers stand with all digits of the double, as in the results file: rounding is for pages.
"""

from __future__ import annotations

from collections.abc import Sequence
from xml.etree import ElementTree as ET

from zlmreport.plugin import COVERAGE_PROBABILITY, Unit
from zlmreport_plugins.renderers.dcc.xml import dcc, si

MICROMETRE_PER_METRE_KELVIN = r"\micro\metre\metre\tothe{-1}\kelvin\tothe{-1}"
DEGREE_CELSIUS = r"\degreecelsius"
HECTOPASCAL = r"\hecto\pascal"
PERCENT = r"\percent"

#: Units of the axis as D-SI writes them, by what the results file calls them.
_UNITS = {
    "mm": r"\milli\metre",
    "um": r"\micro\metre",
    "deg": r"\degree",
    "arcsec": r"\arcsecond",
}


def unit_of(unit: Unit) -> str:
    """Return a unit of the axis as D-SI writes it."""
    return _UNITS[unit.ascii]


def real(
    value: float,
    unit: str,
    *,
    label: str = "",
    expanded_uncertainty: float | None = None,
    coverage_factor: float | None = None,
) -> ET.Element:
    """Return one value, with its expanded uncertainty if it has one."""
    uncertainty = None
    if expanded_uncertainty is not None and coverage_factor is not None:
        uncertainty = si(
            "measurementUncertaintyUnivariate",
            si(
                "expandedMU",
                si("valueExpandedMU", number(expanded_uncertainty)),
                si("coverageFactor", number(coverage_factor)),
                si("coverageProbability", number(COVERAGE_PROBABILITY)),
            ),
        )
    return si(
        "real",
        si("label", label) if label else None,
        si("value", number(value)),
        si("unit", unit),
        uncertainty,
    )


def real_list(
    values: Sequence[float],
    unit: str,
    *,
    expanded_uncertainty: Sequence[float] = (),
    coverage_factor: float = 0.0,
) -> ET.Element:
    """Return a list of values, with their expanded uncertainties if they have any.

    NaN is written where there is no value.
    """
    uncertainty = None
    if expanded_uncertainty:
        uncertainty = si(
            "measurementUncertaintyUnivariateXMLList",
            si(
                "expandedMUXMLList",
                si("valueExpandedMUXMLList", _list(expanded_uncertainty)),
                si("coverageFactorXMLList", number(coverage_factor)),
                si("coverageProbabilityXMLList", number(COVERAGE_PROBABILITY)),
            ),
        )
    return si("realListXMLList", si("valueXMLList", _list(values)), si("unitXMLList", unit), uncertainty)


def _list(values: Sequence[float]) -> str:
    return " ".join(map(number, values))


def quantity(name: ET.Element, value: ET.Element, *further: ET.Element | None, kind: str = "") -> ET.Element:
    """Return a quantity with its name and value; `kind` is its refType."""
    return dcc("quantity", name, value, *further, **({"refType": kind} if kind else {}))


def number(value: float) -> str:
    """Write a number in the shortest way that gives the same double again."""
    return "NaN" if value != value else repr(float(value))  # noqa: PLR0124 - NaN is what differs from itself
