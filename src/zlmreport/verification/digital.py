"""An attached digital calibration certificate against the rules and the schema that PTB publishes for it."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from pathlib import Path

from zlmreport.errors import AccessError, InputError, Place
from zlmreport.verification.carrier import Carried
from zlmreport.verification.findings import Finding, Verdict

_NAMESPACE = b"https://ptb.de/dcc"
_SCHEMA = "dcc.xsd"
_EXTRA = "checking a digital certificate needs the extra dcc: pip install 'zlmreport[dcc]'"
_MOST_DEFECTS = 3


def digital_findings(carried: Mapping[str, Carried], schema: Path) -> Iterator[Finding]:
    """Yield what PTB's rules and PTB's schema say of the attached digital certificates.

    Parameters
    ----------
    carried
        The attachments by their names.
    schema
        A folder with PTB's ``dcc.xsd`` and what it imports.

    Raises
    ------
    AccessError
        If the folder holds no schema.
    InputError
        If the optional libraries that check are not installed.
    """
    place = Place(str(schema))
    if not (schema / _SCHEMA).is_file():
        message = f"holds no {_SCHEMA}: name the folder of PTB's schema, such as v3.3.0"
        raise AccessError.at(place, message)
    digital = {name: each.content for name, each in carried.items() if _NAMESPACE in each.content[:1000]}
    if not digital:
        yield Finding("digital certificate", Verdict.OPEN, "none is attached: output.formats names no dcc")
    try:
        for name, content in digital.items():
            yield _finding(name, "PTB's rules", _broken_rules(content))
            yield _finding(name, "PTB's schema", _defects(content, schema / _SCHEMA))
    except ImportError as error:
        raise InputError.at(place, _EXTRA) from error


def _broken_rules(content: bytes) -> list[str]:
    from dcclib.validation.schematron import SchematronValidator  # noqa: PLC0415 - an optional extra

    # The library refuses a text that declares its encoding: the declaration is its first line.
    text = content.decode().partition("?>")[2].lstrip()
    found = SchematronValidator.for_dcc().validate_str(text)
    reports = [each.text for each in found.successful_reports if each.role == "error"]
    return [*(each.text for each in found.failed_assertions), *reports]


def _defects(content: bytes, schema: Path) -> list[str]:
    from lxml import etree  # noqa: PLC0415 - comes with the extra

    parser = etree.XMLParser(resolve_entities=False, no_network=True)
    rules = etree.XMLSchema(etree.parse(str(schema), parser))
    rules.validate(etree.fromstring(content, parser))
    return [f"line {each.line}: {each.message}" for each in rules.error_log]


def _finding(name: str, by: str, broken: list[str]) -> Finding:
    if not broken:
        return Finding(name, Verdict.HOLDS, f"valid by {by}")
    shown = "; ".join(" ".join(each.split()) for each in broken[:_MOST_DEFECTS])
    return Finding(name, Verdict.DIFFERS, f"not valid by {by}: {shown}")
