"""Elements of the two vocabularies of a DCC: its own, and that of quantities (D-SI)."""

from __future__ import annotations

import re
from typing import TypeAlias
from xml.etree import ElementTree as ET

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

SCHEMA_LOCATION = {f"{{{_INSTANCE}}}schemaLocation": f"{DCC} {DCC}/v3.3.0/dcc.xsd"}


def dcc(name: str, *content: Content, **attributes: str) -> ET.Element:
    """Return an element of the DCC with a text, or with elements inside."""
    return _filled(ET.Element(f"{{{DCC}}}{name}", attributes), content)


def si(name: str, *content: Content) -> ET.Element:
    """Return an element of D-SI with a text, or with elements inside."""
    return _filled(ET.Element(f"{{{SI}}}{name}"), content)


def group(name: str, *content: Content) -> ET.Element | None:
    """Return an element of the DCC that holds others; None where there are none."""
    held = [each for each in content if each is not None]
    return dcc(name, *held) if held else None


def text_of_xml(text: str) -> str:
    """Return a text as XML can hold it: on one line, and U+FFFD for what XML has no way to write."""
    return " ".join(_IMPOSSIBLE.sub("\N{REPLACEMENT CHARACTER}", text).split())


def written(root: ET.Element) -> bytes:
    """Return a document, indented, UTF-8."""
    ET.indent(root)
    content: bytes = ET.tostring(root, encoding="UTF-8", xml_declaration=True)
    return content + b"\n"


def _filled(element: ET.Element, content: tuple[Content, ...]) -> ET.Element:
    for each in content:
        if isinstance(each, str):
            element.text = text_of_xml(each)
        elif each is not None:
            element.append(each)
    return element
