"""XML of a DCC: values with unit and uncertainty as D-SI 2.2.1 writes them.

Numbers stand with all digits of the double, as in the results file: rounding is for pages.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from typing import TypeAlias
from xml.etree import ElementTree as ET

from zlmreport.plugin import Unit
from zlmreport.plugin.renderer import COVERAGE_PROBABILITY

MICROMETRE_PER_METRE_KELVIN = r"\micro\metre\metre\tothe{-1}\kelvin\tothe{-1}"
DEGREE_CELSIUS = r"\degreecelsius"
HECTOPASCAL = r"\hecto\pascal"
PERCENT = r"\percent"
SECOND = r"\second"
ONE = r"\one"

#: Units of conditions as D-SI writes them, by their symbols.
SCALES = {"°C": DEGREE_CELSIUS, "hPa": HECTOPASCAL, "%": PERCENT}

#: Units of the axis as D-SI writes them, by what the results file calls them.
_UNITS = {
    "mm": r"\milli\metre",
    "um": r"\micro\metre",
    "deg": r"\degree",
    "arcsec": r"\arcsecond",
    "um/m": r"\micro\metre\metre\tothe{-1}",
    "h": r"\hour",
}


#: Kinds (refType) of the readings and their columns; behind CONDITION stands the name of a known one.
READINGS = "zlmreport_readings"
TARGET = "zlmreport_target"
DIRECTION = "zlmreport_direction"
RUN = "zlmreport_run"
DEVIATION = "zlmreport_deviation"
TIME = "zlmreport_time"
CONDITION = "zlmreport_condition_"
#: Begins the identifier of the readings of one of several measured lines; its name follows.
TEST = "zlmreport_test_"
#: The same of its readings as found: an identifier stands once in a document.
TEST_AS_FOUND = "zlmreport_testAsFound_"
#: Kinds beside DEVIATION, and what each says of the measurement set.
TRAITS = {
    "zlmreport_indication": "is_indication",
    "zlmreport_oneSidedTargets": "one_sided_targets",
    "zlmreport_relativeReversal": "reversal_is_relative",
    "zlmreport_reversedArtefact": "artefact_is_reversed",
}


def write_unit_of(unit: Unit) -> str:
    """Return a unit of the axis as D-SI writes it."""
    return _UNITS[unit.ascii]


def make_real(
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
        uncertainty = _make_uncertainty(number(expanded_uncertainty), coverage_factor)
    return si(
        "real",
        si("label", label) if label else None,
        si("value", number(value)),
        si("unit", unit),
        uncertainty,
    )


def make_real_list(
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
        uncertainty = _make_uncertainty(_list(expanded_uncertainty), coverage_factor, "XMLList")
    return si("realListXMLList", si("valueXMLList", _list(values)), si("unitXMLList", unit), uncertainty)


def _make_uncertainty(values: str, coverage_factor: float, of: str = "") -> ET.Element:
    expanded = si(
        f"expandedMU{of}",
        si(f"valueExpandedMU{of}", values),
        si(f"coverageFactor{of}", number(coverage_factor)),
        si(f"coverageProbability{of}", number(COVERAGE_PROBABILITY)),
    )
    return si(f"measurementUncertaintyUnivariate{of}", expanded)


def _list(values: Sequence[float]) -> str:
    return " ".join(map(number, values))


def make_quantity(
    name: ET.Element, value: ET.Element, *further: ET.Element | None, kind: str = ""
) -> ET.Element:
    """Return a quantity with its name and value; `kind` is its refType."""
    return dcc("quantity", name, value, *further, **({"refType": kind} if kind else {}))


def number(value: float) -> str:
    """Write a number in the shortest way that gives the same double again."""
    return "NaN" if value != value else repr(float(value))  # noqa: PLR0124 - NaN is what differs from itself


DCC = "https://ptb.de/dcc"
SI = "https://ptb.de/si"
_INSTANCE = "http://www.w3.org/2001/XMLSchema-instance"

#: What may stand inside an element: None is left out.
Content: TypeAlias = ET.Element | str | None

#: What XML 1.0 has no way to write, not even escaped.
_IMPOSSIBLE = re.compile("[^\t\n\r\u0020-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]")

ET.register_namespace("dcc", DCC)
ET.register_namespace("si", SI)
ET.register_namespace("xsi", _INSTANCE)

#: Of the schema of the DCC.
VERSION = "3.3.0"
SCHEMA_LOCATION = {f"{{{_INSTANCE}}}schemaLocation": f"{DCC} {DCC}/v{VERSION}/dcc.xsd"}


def dcc(name: str, *content: Content, **attributes: str) -> ET.Element:
    """Return an element of the DCC with a text, or with elements inside."""
    return _fill_element(ET.Element(f"{{{DCC}}}{name}", attributes), content)


def si(name: str, *content: Content) -> ET.Element:
    """Return an element of D-SI with a text, or with elements inside."""
    return _fill_element(ET.Element(f"{{{SI}}}{name}"), content)


def group(name: str, *content: Content) -> ET.Element | None:
    """Return an element of the DCC that holds others; None where there are none."""
    held = [each for each in content if each is not None]
    return dcc(name, *held) if held else None


def _clean_for_xml(text: str) -> str:
    """Return a text as XML can hold it: on one line, and U+FFFD for what XML has no way to write."""
    return " ".join(_IMPOSSIBLE.sub("\N{REPLACEMENT CHARACTER}", text).split())


def write_document(root: ET.Element) -> bytes:
    """Return a document, indented, UTF-8."""
    ET.indent(root)
    content: bytes = ET.tostring(root, encoding="UTF-8", xml_declaration=True)
    return content + b"\n"


def _fill_element(element: ET.Element, content: tuple[Content, ...]) -> ET.Element:
    for each in content:
        if isinstance(each, str):
            element.text = _clean_for_xml(each)
        elif each is not None:
            element.append(each)
    return element
