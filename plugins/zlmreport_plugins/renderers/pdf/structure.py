"""Mends a tagged PDF as WeasyPrint 70 leaves it: its structure (headings, cells, links), its metadata.

WeasyPrint claims one kind of conformance a file; `identify` claims PDF/UA-1 beside PDF/A-3a. All works on
the objects of a pydyf PDF before it is written.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator, Mapping
from itertools import pairwise
from typing import Any, TypeAlias
from xml.sax.saxutils import escape

import pydyf

from zlmreport.plugin.renderer import Certificate

#: An element of the structure, or any other dictionary of a PDF.
Element: TypeAlias = Any

_POINTS_PER_PIXEL = 72 / 96


def mend(pdf: Any, link_texts: Mapping[str, str]) -> None:
    """Mend the structure of a PDF in place.

    `pdf`: A pydyf PDF, complete but for its trailer.
    """
    root = _dereference(pdf, pdf.catalog["StructTreeRoot"])
    elements = list(_walk_elements(pdf, root))
    _take_page_margins_out(pdf, root, {root.reference, *(element.reference for element in elements)})
    for element in elements:
        if element["S"] == "/Table":
            _name_headings(pdf, element)
        elif element["S"] == "/Figure":
            _place(pdf, element)
    for annotation in _list_annotations(pdf):
        target = annotation["Contents"].string
        annotation["Contents"] = pydyf.String(link_texts.get(target, target))


def settle(pdf: Any) -> None:
    """Write each object once: pydyf asks each for its bytes twice, and compresses every stream anew."""
    pdf.objects[:] = [each if each.free == "f" else _Settled(each) for each in pdf.objects]


class _Settled(pydyf.Object):  # type: ignore[misc]
    """An object that changes no more."""

    data = b""
    compressible = False

    def __init__(self, settled: Element) -> None:
        super().__init__()
        self.number, self.generation = settled.number, settled.generation
        self.data, self.compressible = settled.data, settled.compressible


def _take_page_margins_out(pdf: Any, root: Element, reachable: set[bytes]) -> None:
    """Mark what stands in page margins as an artifact.

    It is tagged as if it were text of the document, but by elements that no reader ever reaches.
    """
    places = _dereference(pdf, root["ParentTree"])["Nums"]
    of_pages = dict(zip(places[::2], places[1::2], strict=True))
    for number, reference in enumerate(pdf.page_references):
        elements = of_pages[number]
        marginal = {place for place, element in enumerate(elements) if element not in reachable}
        for place in marginal:
            elements[place] = "null"
        page = _dereference(pdf, reference)
        operators = _dereference(pdf, page["Contents"]).stream
        for index, (_, operand) in enumerate(pairwise(operators)):
            if isinstance(operand, pydyf.Dictionary) and operand.get("MCID") in marginal:
                operators[index : index + 2] = "/Artifact", pydyf.Dictionary({"Type": "/Pagination"})
    for element in pdf.objects:
        is_element = isinstance(element, pydyf.Dictionary) and element.get("Type") == "/StructElem"
        if is_element and element.reference not in reachable:
            element.clear()


def _name_headings(pdf: Any, table: Element) -> None:
    """Tell which cells each heading of a table heads: a column, a row, or the rows of its group.

    A group of rows is a body of its own, whose first row is its heading; no cell spans two rows.
    """
    columns: dict[int, list[Any]] = defaultdict(list)
    for part in _list_children(pdf, table):
        heads_of_group: list[Any] = []
        for row in _list_children(pdf, part) if part["S"] in {"/THead", "/TBody"} else ():
            if row["S"] != "/TR":  # a body without rows holds a body of its own
                continue
            cells = list(_place_cells(pdf, row))
            headings = [cell for cell, _ in cells if cell["S"] == "/TH"]
            heads_columns = len(headings) == len(cells)
            for cell, places in cells:
                if cell["S"] == "/TH":
                    cell["A"]["Scope"] = "/Column" if heads_columns else "/Row"
                    if part["S"] == "/THead":
                        for place in places:
                            columns[place].append(cell["ID"])
                    elif heads_columns:
                        heads_of_group.append(cell["ID"])
                else:
                    of_columns = [name for place in places for name in columns[place]]
                    of_row = [heading["ID"] for heading in headings]
                    cell["A"]["Headers"] = pydyf.Array([*of_columns, *heads_of_group, *of_row])


def _place_cells(pdf: Any, row: Element) -> Iterator[tuple[Element, range]]:
    """Yield the cells of a row with the columns that each takes."""
    start = 0
    for cell in _list_children(pdf, row):
        places = range(start, start + cell["A"].get("ColSpan", 1))
        yield cell, places
        start = places.stop


def _place(pdf: Any, figure: Element) -> None:
    """State where a figure lies on its page in points from below, not in CSS pixels from above."""
    height = _dereference(pdf, figure["Pg"])["MediaBox"][3]
    left, top, right, bottom = (_POINTS_PER_PIXEL * length for length in figure["A"]["BBox"])
    figure["A"]["BBox"] = pydyf.Array([left, height - bottom, right, height - top])


def _list_annotations(pdf: Any) -> Iterator[Element]:
    for reference in pdf.page_references:
        for annotation in _dereference(pdf, reference).get("Annots", ()):
            yield _dereference(pdf, annotation)


def _walk_elements(pdf: Any, root: Element) -> Iterator[Element]:
    """Yield all elements below one, in reading order."""
    for child in _list_children(pdf, root):
        yield child
        yield from _walk_elements(pdf, child)


def _list_children(pdf: Any, element: Element) -> Iterator[Element]:
    for child in element["K"]:
        if isinstance(child, bytes):  # and no number of a stretch of the page
            found = _dereference(pdf, child)
            if "S" in found:
                yield found


def _dereference(pdf: Any, reference: bytes) -> Element:
    return pdf.objects[int(reference.split()[0])]


# PDF/A wants every name that it does not know itself described in the file.
_DESCRIPTIONS = """\
<rdf:Description rdf:about="" xmlns:pdfuaid="http://www.aiim.org/pdfua/ns/id/">
<pdfuaid:part>1</pdfuaid:part>
</rdf:Description>
<rdf:Description rdf:about=""
 xmlns:pdfaExtension="http://www.aiim.org/pdfa/ns/extension/"
 xmlns:pdfaSchema="http://www.aiim.org/pdfa/ns/schema#"
 xmlns:pdfaProperty="http://www.aiim.org/pdfa/ns/property#">
<pdfaExtension:schemas><rdf:Bag><rdf:li rdf:parseType="Resource">
<pdfaSchema:schema>PDF/UA identification</pdfaSchema:schema>
<pdfaSchema:namespaceURI>http://www.aiim.org/pdfua/ns/id/</pdfaSchema:namespaceURI>
<pdfaSchema:prefix>pdfuaid</pdfaSchema:prefix>
<pdfaSchema:property><rdf:Seq><rdf:li rdf:parseType="Resource">
<pdfaProperty:name>part</pdfaProperty:name>
<pdfaProperty:valueType>Integer</pdfaProperty:valueType>
<pdfaProperty:category>internal</pdfaProperty:category>
<pdfaProperty:description>Part of ISO 14289 that the file conforms to</pdfaProperty:description>
</rdf:li></rdf:Seq></pdfaSchema:property>
</rdf:li></rdf:Bag></pdfaExtension:schemas>
</rdf:Description>
<rdf:Description rdf:about="" xmlns:dc="http://purl.org/dc/elements/1.1/">
<dc:format>application/pdf</dc:format>
<dc:identifier>{number}</dc:identifier>
<dc:language><rdf:Bag><rdf:li>{language}</rdf:li></rdf:Bag></dc:language>
</rdf:Description>
"""
_END = b"</rdf:RDF>"


def identify(pdf: Any, certificate: Certificate) -> None:
    """Add the claim of PDF/UA-1, and the certificate's number and language, to the metadata of a pydyf PDF.

    The metadata stay uncompressed, so that a program that knows nothing of PDF finds them.
    """
    metadata = pdf.objects[int(pdf.catalog["Metadata"].split()[0])]
    (packet,) = metadata.stream
    description = _DESCRIPTIONS.format(number=escape(certificate.number), language=certificate.language.value)
    metadata.stream = [packet.replace(_END, description.encode() + _END)]
    metadata.compress = False
