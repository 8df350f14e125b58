"""What a PDF says of itself in its metadata beyond what WeasyPrint writes.

WeasyPrint claims one kind of conformance a file; these claim PDF/UA-1 beside PDF/A-3a.
"""

from __future__ import annotations

from typing import Any
from xml.sax.saxutils import escape

from zlmreport.plugin import Certificate

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
