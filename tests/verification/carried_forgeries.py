"""Forged certificates whose attachments, structure or names say something else; the pages are as issued."""

from __future__ import annotations

import re

import pikepdf
from pikepdf import Array, Name, Pdf, String

from verification.altering import page_of
from verification.forgeries import forge


def _listed(pdf: Pdf) -> Array:
    listed: Array = pdf.Root.Names.EmbeddedFiles.Names
    return listed


def _attached(pdf: Pdf, name: str = "x-axis.csv") -> pikepdf.Dictionary:
    listed = list(_listed(pdf))
    found: pikepdf.Dictionary = next(each for each in listed[1::2] if str(each.UF) == name)
    return found


@forge("names exchanged in the list", "the readings under the name of the job")
def _(pdf: Pdf) -> None:
    listed = _listed(pdf)
    names = [str(each) for each in list(listed)[::2]]
    for place, name in enumerate(names[1:] + names[:1]):
        listed[2 * place] = String(name)


@forge("path as a name in the list", "a file that is saved outside of the folder, as an accreditation")
def _(pdf: Pdf) -> None:
    _listed(pdf)[0] = String("../../accreditation-certificate.pdf")


@forge("listed twice", "one file more")
def _(pdf: Pdf) -> None:
    listed = _listed(pdf)
    listed.extend([String("z-more.csv"), listed[1]])


@forge("listed twice under one name", "one file more")
def _(pdf: Pdf) -> None:
    listed = _listed(pdf)
    listed.extend([listed[0], listed[1]])


@forge("in no list of names", "a file less, in viewers that take out what is listed")
def _(pdf: Pdf) -> None:
    listed = _listed(pdf)
    del listed[:2]


@forge("associated with nothing", "a file less, in viewers that take out what is associated")
def _(pdf: Pdf) -> None:
    associated = pdf.Root.AF
    del associated[0]


@forge("associated twice", "one file more")
def _(pdf: Pdf) -> None:
    pdf.Root.AF.append(pdf.Root.AF[0])


@forge("other dates of files", "readings of another year")
def _(pdf: Pdf) -> None:
    parameters = _attached(pdf).EF.F.Params
    for key in ("/ModDate", "/CreationDate"):
        if key in parameters:
            parameters[key] = String("D:20310101000000Z")


@forge("other size of a file", "a file of another size, in lists")
def _(pdf: Pdf) -> None:
    _attached(pdf).EF.F.Params.Size = 7


@forge("more said of a file", "a thumbnail or a note, in viewers that show it")
def _(pdf: Pdf) -> None:
    _attached(pdf).Volatile = True


@forge("name of the program", "a statement, among the properties of the file")
def _(pdf: Pdf) -> None:
    pdf.docinfo["/Producer"] = String("Accredited by the DAkkS; A = 0.5 um, conforms")


@forge("program and statement", "a statement, among the properties of the file")
def _(pdf: Pdf) -> None:
    pdf.docinfo["/Producer"] = String("pypdf 7.1, conforms")


@forge("order of reading on a page", "other words first, to who has the page read aloud")
def _(pdf: Pdf) -> None:
    page = page_of(pdf, 1)
    content = page.Contents.read_bytes()
    places = [int(each) for each in re.findall(rb"/MCID (\d+)", content)]
    first, second = places[3], places[4]
    swapped = {first: second, second: first}

    def other(found: re.Match[bytes]) -> bytes:
        number = int(found[1])
        return b"/MCID %d" % swapped.get(number, number)

    page.Contents = pdf.make_stream(re.sub(rb"/MCID (\d+)", other, content))


@forge("elements of places", "other words, to who asks what stands at a place")
def _(pdf: Pdf) -> None:
    numbers = pdf.Root.StructTreeRoot.ParentTree.Nums
    for each in list(numbers)[1::2]:
        if isinstance(each, Array) and len(each) > 5:
            each[3], each[4] = each[4], each[3]
            return


@forge("places of another page", "the words of another page, to who has the page read aloud")
def _(pdf: Pdf) -> None:
    first, second = page_of(pdf, 1), page_of(pdf, 2)
    first.StructParents, second.StructParents = int(second.StructParents), int(first.StructParents)


@forge("results in the metadata of a page", "A = 0.5 um, to programs that read metadata")
def _(pdf: Pdf) -> None:
    packet = b'<x:xmpmeta xmlns:x="adobe:ns:meta/"><A>0.5 um</A></x:xmpmeta>'
    page_of(pdf, 1).Metadata = pdf.make_stream(packet, Type=Name.Metadata, Subtype=Name.XML)
