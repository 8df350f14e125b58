"""Forged certificates: every way that was thought of to show what the attached readings do not give.

Each takes the bytes of a certificate and returns those of a forged one. None of them may hold.
"""

from __future__ import annotations

import json
import re
import zlib
from collections.abc import Callable, Iterable
from functools import partial
from hashlib import md5
from io import BytesIO

import pikepdf
from fontTools.pens.ttGlyphPen import TTGlyphPen
from fontTools.ttLib import TTFont, newTable
from fontTools.ttLib.tables.DefaultTable import DefaultTable
from fontTools.ttLib.tables.ttProgram import Program
from pikepdf import Array, Dictionary, Name, Pdf, Stream, String
from pypdf import PdfReader, PdfWriter
from pypdf.generic import FloatObject, NameObject

from verification.altering import (
    Change,
    Forgery,
    annotate,
    codes,
    descendant,
    draw,
    every_font,
    fonts,
    form,
    glyph,
    page_of,
    rewritten,
    script,
    with_program,
)

FORGERIES: list[Forgery] = []
#: A white box, and a one in it that is drawn and not written.
BOX = b"q 1 1 1 rg 100 600 200 100 re f 0 0 0 RG 2 w 150 620 m 150 680 l S Q"

_Maker = Callable[[bytes], bytes]
_Finder = Callable[[Pdf], Iterable[Dictionary]]
_ChangeOfOne = Callable[[Pdf, Dictionary], None]
_ChangeOfProgram = Callable[[TTFont, Dictionary], None]


def forge_bytes(name: str, seen: str) -> Callable[[_Maker], _Maker]:
    """Add a forgery that is made of the bytes of a certificate."""

    def add(make: _Maker) -> _Maker:
        FORGERIES.append(Forgery(name, seen, make))
        return make

    return add


def forge(name: str, seen: str) -> Callable[[Change], Change]:
    """Add a forgery that is made of the objects of a certificate."""

    def add(change: Change) -> Change:
        FORGERIES.append(Forgery(name, seen, lambda pdf: rewritten(pdf, change)))
        return change

    return add


def _forge_each(found: _Finder, name: str, seen: str) -> Callable[[_ChangeOfOne], _ChangeOfOne]:
    def add(change: _ChangeOfOne) -> _ChangeOfOne:
        @forge(name, seen)
        def _(pdf: Pdf) -> None:
            for each in found(pdf):
                change(pdf, each)

        return change

    return add


def list_pages(pdf: Pdf) -> list[Dictionary]:
    return [page.obj for page in pdf.pages]


#: Adds a forgery that changes each page; each font of the pages that has digits.
forge_pages, forge_fonts = partial(_forge_each, list_pages), partial(_forge_each, every_font)


def forge_contents(name: str, seen: str, change: Callable[[bytes], bytes]) -> None:
    """Add a forgery that changes what is drawn on each page."""

    @forge_pages(name, seen)
    def _(pdf: Pdf, page: Dictionary) -> None:
        page.Contents = pdf.make_stream(change(page.Contents.read_bytes()))


def forge_programs(name: str, seen: str) -> Callable[[_ChangeOfProgram], _ChangeOfProgram]:
    """Add a forgery that changes the program of each font."""

    def add(change: _ChangeOfProgram) -> _ChangeOfProgram:
        forge_fonts(name, seen)(lambda _, font: with_program(font, lambda program: change(program, font)))
        return change

    return add


def _set_entries(found: _Finder, name: str, seen: str, **entries: object) -> None:
    @partial(_forge_each, found)(name, seen)
    def _(_: Pdf, each: Dictionary) -> None:
        for key, value in entries.items():
            each[f"/{key}"] = Array(value) if isinstance(value, tuple) else value


# Fonts


def _swapped(font: Dictionary) -> dict[int, int]:
    own = codes(font)
    return {own["1"]: own["9"], own["9"]: own["1"]}


@forge_fonts("glyph map", "each 1 as a 9 and each 9 as a 1")
def _(pdf: Pdf, font: Dictionary) -> None:
    swapped = _swapped(font)
    table = b"".join(swapped.get(code, code).to_bytes(2, "big") for code in range(1000))
    descendant(font).CIDToGIDMap = pdf.make_stream(table)


@forge_fonts("encoding by a CMap", "each 1 as a 9 and each 9 as a 1")
def _(pdf: Pdf, font: Dictionary) -> None:
    swapped = _swapped(font)
    rows = "".join(f"<{code:04x}> {swapped.get(code, code)}\n" for code in range(100))
    table = (
        "/CIDInit /ProcSet findresource begin 12 dict begin begincmap /CMapName /Swap def\n"
        "/CMapType 1 def\n"
        f"1 begincodespacerange <0000> <ffff> endcodespacerange\n100 begincidchar\n{rows}endcidchar\n"
        "endcmap end end"
    )
    system = Dictionary(Registry=String("Adobe"), Ordering=String("Identity"), Supplement=0)
    font.Encoding = Stream(pdf, table.encode(), Type=Name.CMap, CMapName=Name.Swap, CIDSystemInfo=system)


@forge_fonts("vertical encoding", "numbers whose digits stand below one another")
def _(_: Pdf, font: Dictionary) -> None:
    font.Encoding = Name("/Identity-V")


@forge_fonts("widths", "digits that are drawn over one another")
def _(_: Pdf, font: Dictionary) -> None:
    descendant(font).W = Array([0, Array([0] * 1000)])


@forge_fonts("default width", "digits that stand apart")
def _(_: Pdf, font: Dictionary) -> None:
    descendant(font).DW = 3000
    descendant(font).W = Array([])


@forge_fonts("vertical widths", "digits that are shifted")
def _(_: Pdf, font: Dictionary) -> None:
    descendant(font).DW2 = Array([0, 500])


@forge_fonts("text of glyphs", "as before; who copies or hears a 1 gets a 9")
def _(pdf: Pdf, font: Dictionary) -> None:
    old = font.ToUnicode.read_bytes()
    one = re.escape(b"<%04x>" % codes(font)["1"])
    new = re.sub(one + rb"(\s*)<0031>", one + rb"\1<0039>", old, flags=re.IGNORECASE)
    font.ToUnicode = pdf.make_stream(new)


@forge_fonts("other characters of glyphs", "as before; who copies a 1 gets 19")
def _(pdf: Pdf, font: Dictionary) -> None:
    own = codes(font)
    more = b"1 beginbfchar\n<%04x> <00310039>\nendbfchar\nendcmap" % own["1"]
    font.ToUnicode = pdf.make_stream(font.ToUnicode.read_bytes().replace(b"endcmap", more))


@forge_programs("outlines", "each 1 as a 9 and each 9 as a 1")
def _(program: TTFont, font: Dictionary) -> None:
    table, (one, nine) = program["glyf"], (glyph(program, font, each) for each in "19")
    table[one], table[nine] = table[nine], table[one]


@forge("outlines of one font", "each 1 of the headings as a 9")
def _(pdf: Pdf) -> None:
    font = list(every_font(pdf))[-1]

    def swap(program: TTFont) -> None:
        program["glyf"][glyph(program, font, "1")] = program["glyf"][glyph(program, font, "9")]

    with_program(font, swap)


@forge_fonts("outline of the decimal point", "numbers without a decimal point: 726 for 7.26")
def _(_: Pdf, font: Dictionary) -> None:
    def empty(program: TTFont) -> None:
        program["glyf"][glyph(program, font, ".")] = TTGlyphPen(None).glyph()

    if "." in codes(font):
        with_program(font, empty)


@forge_programs("units of the outlines", "letters and digits of half the size")
def _(program: TTFont, _: Dictionary) -> None:
    program["head"].unitsPerEm = 2000


@forge_fonts("side bearings", "digits that are moved out of their places")
def _(_: Pdf, font: Dictionary) -> None:
    def move(program: TTFont) -> None:
        name = glyph(program, font, ".")
        width, _ = program["hmtx"][name]
        program["hmtx"][name] = (width, -700)

    if "." in codes(font):
        with_program(font, move)


@forge_programs(
    "program of a glyph", "what the instructions make of a 1, where outlines are fitted to pixels"
)
def _(program: TTFont, font: Dictionary) -> None:
    each = program["glyf"][glyph(program, font, "1")]
    each.expand(program["glyf"])
    each.program = Program()
    each.program.fromAssembly(["PUSHB[ ]", "0", "MDAP[1]"])


@forge_programs("program of a font", "what the instructions make of every glyph")
def _(program: TTFont, _: Dictionary) -> None:
    program["prep"] = newTable("prep")
    program["prep"].program = Program()
    program["prep"].program.fromAssembly(["PUSHB[ ]", "1", "POP[ ]"])


@forge_programs("pictures of glyphs", "other digits, where a viewer prefers bitmaps or SVG to outlines")
def _(program: TTFont, _: Dictionary) -> None:
    program["SVG "] = DefaultTable("SVG ")
    program["SVG "].data = bytes(10)


@forge_fonts("second program", "other glyphs, where a viewer prefers FontFile3")
def _(pdf: Pdf, font: Dictionary) -> None:
    holder = descendant(font).FontDescriptor
    holder.FontFile3 = Stream(pdf, holder.FontFile2.read_bytes(), Subtype=Name.OpenType)


@forge_fonts("no program", "a font of the reader's machine in which the codes mean other characters")
def _(_: Pdf, font: Dictionary) -> None:
    del descendant(font).FontDescriptor.FontFile2


@forge_fonts("no program, other name", "the characters of another collection")
def _(_: Pdf, font: Dictionary) -> None:
    del descendant(font).FontDescriptor.FontFile2
    descendant(font).CIDSystemInfo.Ordering = String("Japan1")


@forge_pages("font of drawings", "a 9 that is drawn by the font for each 1")
def _(pdf: Pdf, page: Dictionary) -> None:
    for name, font in list(page.Resources.Font.items()):
        drawn = pdf.make_stream(b"500 0 0 0 500 700 d1 0 0 500 700 re f")
        page.Resources.Font[name] = pdf.make_indirect(
            Dictionary(
                Type=Name.Font,
                Subtype=Name.Type3,
                FontBBox=Array([0, 0, 1000, 1000]),
                FontMatrix=Array([0.001, 0, 0, 0.001, 0, 0]),
                CharProcs=Dictionary(a=drawn),
                Encoding=Dictionary(Differences=Array([0, *[Name.a] * 256])),
                FirstChar=0,
                LastChar=255,
                Widths=Array([500] * 256),
                ToUnicode=font.ToUnicode,
            )
        )


@forge("fonts exchanged", "letters and digits of the codes of another font")
def _(pdf: Pdf) -> None:
    seen = set()
    for page in pdf.pages:
        table = page.obj.Resources.Font
        if table.objgen in seen or page.obj.Resources.objgen in seen:
            continue
        seen |= {table.objgen, page.obj.Resources.objgen} - {(0, 0)}
        names = list(table.keys())
        values = [table[name] for name in names]
        for name, value in zip(names, values[1:] + values[:1], strict=True):
            table[name] = value


@forge_pages("a standard font", "Helvetica, in which the codes mean other characters")
def _(_: Pdf, page: Dictionary) -> None:
    for name in list(page.Resources.Font.keys()):
        page.Resources.Font[name] = Dictionary(Type=Name.Font, Subtype=Name.Type1, BaseFont=Name.Helvetica)


@forge_fonts("bold by a flag", "strokes that are drawn thicker")
def _(_: Pdf, font: Dictionary) -> None:
    descendant(font).FontDescriptor.Flags = 1 << 18 | 4


# Boxes and rotations


_on_pages = partial(_set_entries, list_pages)
_CORNER = (0, 400, 595, 842)
_on_pages("crop box", "the upper half of each page alone", CropBox=_CORNER)
_on_pages("media box", "the upper half of each page alone", MediaBox=_CORNER)
_on_pages("trim box", "the upper half of each page alone, when it is printed", TrimBox=_CORNER)
_on_pages("art box", "the upper half of each page alone, where it is placed", ArtBox=_CORNER)
_on_pages("rotation", "pages upside down", Rotate=180)
_on_pages("unit", "pages of twice the size, and graphs off their scale", UserUnit=2)
_on_pages(
    "transparency group", "colours that are mixed otherwise", Group=Dictionary(S=Name.Transparency, K=True)
)
_on_pages("time of a page", "a page that turns by itself after a second", Dur=1)
_on_pages("presentation", "pages that fade", Trans=Dictionary(S=Name.Fade))
_on_pages("thumbnail", "a small picture of another page", Thumb=Dictionary())
_on_pages("page's private data", "another page, in the program that knows the data", PieceInfo=Dictionary())

_on_tree = partial(_set_entries, lambda pdf: [pdf.Root.Pages])
_on_tree("inherited crop box", "the upper half of each page alone", CropBox=_CORNER)
_on_tree("inherited rotation", "pages upside down", Rotate=180)


@forge("inherited media box", "the upper half of each page alone")
def _(pdf: Pdf) -> None:
    for page in pdf.pages:
        del page.obj.MediaBox
    pdf.Root.Pages.MediaBox = Array(_CORNER)


@forge("inherited resources", "each 1 as a 9 and each 9 as a 1")
def _(pdf: Pdf) -> None:
    resources = page_of(pdf).Resources
    for page in pdf.pages:
        del page.obj.Resources
    pdf.Root.Pages.Resources = resources
    for font in resources.Font.values():
        descendant(font).CIDToGIDMap = pdf.make_stream(bytes(2000))


@forge("box of a node of the page tree", "the upper half of one page alone")
def _(pdf: Pdf) -> None:
    first = pdf.Root.Pages.Kids[0]
    node = Dictionary(
        Type=Name.Pages, Kids=Array([first]), Count=1, Parent=pdf.Root.Pages, CropBox=Array(_CORNER)
    )
    node = pdf.make_indirect(node)
    first.Parent = node
    pdf.Root.Pages.Kids[0] = node


# Over what is printed


@forge("white box", "a drawn 1 in a white box instead of numbers, on one page")
def _(pdf: Pdf) -> None:
    draw(pdf, page_of(pdf, 2), BOX)


@forge("white box and strokes on every page", "a drawn 1 in a white box instead of numbers")
def _(pdf: Pdf) -> None:
    for page in pdf.pages:
        draw(pdf, page.obj, b"0 0 m 0 0 l S")
    draw(pdf, page_of(pdf, 2), BOX)


@forge_pages("white box on every page", "a drawn 1 in a white box on every page")
def _(pdf: Pdf, page: Dictionary) -> None:
    draw(pdf, page, BOX)


@forge_pages("second content", "a drawn 1 in a white box on every page")
def _(pdf: Pdf, page: Dictionary) -> None:
    page.Contents = Array([page.Contents, pdf.make_stream(b"\nQ Q " + BOX)])


forge_contents(
    "content below",
    "a coloured page, and numbers that cannot be read on it",
    lambda old: b"q 0.09 0.13 0.17 rg 0 0 600 850 re f Q\n" + old,
)


@forge_pages("words over words", "another number, written over the first")
def _(pdf: Pdf, page: Dictionary) -> None:
    for name, font in page.Resources.Font.items():
        if font in fonts(page):
            code = codes(font)["9"]
            draw(pdf, page, b"BT %s 40 Tf 150 620 Td <%04x> Tj ET" % (name.encode(), code))
            break


@forge_pages("form", "a drawn 1 in a white box")
def _(pdf: Pdf, page: Dictionary) -> None:
    objects = page.Resources.get("/XObject", Dictionary())
    objects["/Over"] = form(pdf, BOX)
    page.Resources.XObject = objects
    draw(pdf, page, b"/Over Do")


@forge("picture", "a white picture instead of numbers")
def _(pdf: Pdf) -> None:
    picture = Stream(
        pdf,
        b"\xff",
        Type=Name.XObject,
        Subtype=Name.Image,
        Width=1,
        Height=1,
        BitsPerComponent=8,
        ColorSpace=Name.DeviceGray,
    )
    for page in pdf.pages:
        objects = page.obj.Resources.get("/XObject", Dictionary())
        objects["/Over"] = picture
        page.obj.Resources.XObject = objects
        draw(pdf, page.obj, b"q 200 0 0 100 100 600 cm /Over Do Q")


@forge_pages("inline picture", "a white picture instead of numbers")
def _(pdf: Pdf, page: Dictionary) -> None:
    inline = b"BI /W 1 /H 1 /BPC 8 /CS /G ID \xff\nEI"
    draw(pdf, page, b"q 200 0 0 100 100 600 cm " + inline + b" Q")


@forge("shading", "a white area instead of numbers")
def _(pdf: Pdf) -> None:
    white = Dictionary(FunctionType=2, Domain=Array([0, 1]), C0=Array([1]), C1=Array([1]), N=1)
    for page in pdf.pages:
        page.obj.Resources.Shading = Dictionary(
            Over=Dictionary(
                ShadingType=2,
                ColorSpace=Name.DeviceGray,
                Coords=Array([0, 0, 1, 0]),
                Extend=Array([True, True]),
                Function=white,
            )
        )
        draw(pdf, page.obj, b"q 100 600 200 100 re W n /Over sh Q")


@forge("pattern", "an area of tiles instead of numbers")
def _(pdf: Pdf) -> None:
    tile = Stream(
        pdf,
        b"1 g 0 0 5 5 re f",
        PatternType=1,
        PaintType=1,
        TilingType=1,
        BBox=Array([0, 0, 5, 5]),
        XStep=5,
        YStep=5,
        Resources=Dictionary(),
    )
    for page in pdf.pages:
        page.obj.Resources.Pattern = Dictionary(Over=tile)
        draw(pdf, page.obj, b"/Pattern cs /Over scn 100 600 200 100 re f")


forge_contents(
    "curve moved",
    "a graph 3 points lower, on every page that has one",
    lambda old: re.sub(rb"([\d.]+) l\n", lambda y: b"%f l\n" % (float(y[1]) - 3), old),
)
forge_contents(
    "line by line off",
    "a page whose last drawing is missing",
    lambda old: old[: old.rindex(b"BT")] + b"Q Q Q Q Q Q Q Q",
)
forge_contents("clip", "numbers that are cut off", lambda old: b"0 400 600 450 re W n\n" + old)
forge_contents("magnified", "pages moved and magnified", lambda old: b"1.2 0 0 1.2 0 -100 cm\n" + old)
forge_contents(
    "invisible text",
    "pages without words, and a drawn 1",
    lambda old: b"3 Tr\n%s\n%s" % (old.replace(b" 0 Tr", b" 3 Tr").replace(b"0 Tr/", b"3 Tr/"), BOX),
)
forge_contents(
    "white text",
    "pages without words",
    lambda old: re.sub(rb"[\d.]+ [\d.]+ [\d.]+ (rg|scn)", rb"1 1 1 \1", old),
)
forge_contents(
    "lines of no width",
    "graphs without curves",
    lambda old: re.sub(rb"\n[\d.]+ w\n| [\d.]+ w ", b"\n99 w\n", old),
)


@forge_pages("digits exchanged", "each 1 as a 9, in words too, on every page")
def _(pdf: Pdf, page: Dictionary) -> None:
    content = page.Contents.read_bytes()
    for font in fonts(page):
        own = codes(font)
        content = content.replace(b"<%04x>" % own["1"], b"<%04x>" % own["9"])
    page.Contents = pdf.make_stream(content.replace(b"(\000\001", b"(\000\002"))


forge_contents(
    "digits moved",
    "the words as they were, and one digit at another number",
    lambda old: re.sub(rb"1 0 0 -1 ([\d.]+) ([\d.]+) (cm|Tm)", rb"1 0 0 -1 \2 \1 \3", old),
)
# States, colours and layers


def _list_resources(kind: str, pdf: Pdf) -> list[Dictionary]:
    """Return states of the pages, or their pictures and forms."""
    return [each for page in list_pages(pdf) for each in page.Resources.get(kind, Dictionary()).values()]


_list_states = partial(_list_resources, "/ExtGState")
_in_states = partial(_set_entries, _list_states)
_in_states("transparent fills", "pages without words", ca=0)
_in_states("transparent strokes", "graphs without curves", CA=0)
_in_states("blend mode", "what is drawn in white, and nothing in black", BM=Name.Difference)
_in_states("transfer function", "black as white, on paper", TR=Name.Identity)
_in_states("overprint", "colours that cover otherwise, on paper", OP=True, op=True)
_in_states("line width of a state", "curves as broad as bars", LW=40)
_in_states("dash of a state", "curves in pieces", D=Array([Array([1, 50]), 0]))


@forge("soft mask", "pages without words")
def _(pdf: Pdf) -> None:
    mask = form(pdf, b"", Group=Dictionary(S=Name.Transparency, CS=Name.DeviceGray))
    for state in _list_states(pdf):
        state.SMask = Dictionary(S=Name.Luminosity, G=mask)


@forge("colour space", "black as white")
def _(pdf: Pdf) -> None:
    tint = Dictionary(FunctionType=2, Domain=Array([0, 1]), C0=Array([1, 1, 1]), C1=Array([1, 1, 1]), N=1)
    for page in pdf.pages:
        spaces = page.obj.Resources.ColorSpace
        for key in list(spaces.keys()):
            spaces[key] = Array([Name.Separation, Name.None_, Name.DeviceRGB, tint])


@forge("colour profile", "other colours")
def _(pdf: Pdf) -> None:
    profiles = {  # that all pages share, reversed once and not back again
        space[1].objgen: space[1]
        for page in pdf.pages
        for space in page.obj.Resources.ColorSpace.values()
        if isinstance(space, Array) and str(space[0]) == "/ICCBased"
    }
    for profile in profiles.values():
        profile.write(bytes(reversed(profile.read_bytes())))


@forge_pages("default colour space", "black as white")
def _(_: Pdf, page: Dictionary) -> None:
    page.Resources.ColorSpace.DefaultRGB = Array(
        [Name.CalRGB, Dictionary(WhitePoint=Array([0.95, 1, 1.09]), Gamma=Array([0.01, 0.01, 0.01]))]
    )


@forge("layer", "pages without words: they stand on a layer that is off")
def _(pdf: Pdf) -> None:
    group = pdf.make_indirect(Dictionary(Type=Name.OCG, Name=String("numbers")))
    pdf.Root.OCProperties = Dictionary(OCGs=Array([group]), D=Dictionary(OFF=Array([group]), Order=Array([])))
    for page in pdf.pages:
        page.obj.Resources.Properties = Dictionary(off=group)
        old = page.obj.Contents.read_bytes()
        page.obj.Contents = pdf.make_stream(b"/OC /off BDC\n" + old + b"\nEMC")


@forge("layer of a picture", "a page without its logo")
def _(pdf: Pdf) -> None:
    group = pdf.make_indirect(Dictionary(Type=Name.OCG, Name=String("logo")))
    pdf.Root.OCProperties = Dictionary(OCGs=Array([group]), D=Dictionary(OFF=Array([group])))
    for picture in _list_pictures(pdf):
        picture.OC = group


_list_pictures = partial(_list_resources, "/XObject")


@_forge_each(_list_pictures, "another logo", "the logo of another laboratory")
def _(_: Pdf, picture: Stream) -> None:
    picture.write(bytes(len(picture.read_bytes())))


_on_pictures = partial(_set_entries, _list_pictures)
_on_pictures("decoding of a picture", "a logo in other colours", Decode=(1, 0) * 3)
_on_pictures("alternate of a picture", "another logo, on paper", Alternates=())
_on_pictures("mask of a picture", "no logo", Mask=(0, 255) * 3)


# Annotations, forms and actions


def _annotation(name: str, seen: str, subtype: str, make: Callable[[Pdf], dict[str, object]]) -> None:
    @forge(name, seen)
    def _(pdf: Pdf) -> None:
        annotate(pdf, page_of(pdf, 2), Subtype=Name(f"/{subtype}"), **make(pdf))


def _appearance(pdf: Pdf) -> Dictionary:
    return Dictionary(N=form(pdf, BOX))


_annotation(
    "free text",
    "another number in a box",
    "FreeText",
    lambda pdf: {"Contents": String("1.2"), "DA": String("/F 12 Tf"), "AP": _appearance(pdf)},
)
_annotation("stamp", "a drawn 1 in a white box", "Stamp", lambda pdf: {"AP": _appearance(pdf)})
_annotation("square", "a white box", "Square", lambda _: {"IC": Array([1, 1, 1]), "C": Array([1, 1, 1])})
_annotation("ink", "strokes by hand", "Ink", lambda _: {"InkList": Array([Array([150, 620, 150, 680])])})
_annotation("note", "a note: 'read 9 for 1'", "Text", lambda _: {"Contents": String("read 9 for 1")})
_annotation(
    "redaction", "a black bar", "Redact", lambda pdf: {"AP": _appearance(pdf), "OverlayText": String("9")}
)
_annotation(
    "text field",
    "another number in a field",
    "Widget",
    lambda pdf: {"FT": Name.Tx, "T": String("A"), "V": String("1.2"), "AP": _appearance(pdf)},
)
_annotation(
    "link without",
    "a page of another server",
    "Link",
    lambda _: {"A": Dictionary(S=Name.URI, URI="http://a")},
)
_annotation("launch", "a program that starts", "Link", lambda _: {"A": Dictionary(S=Name.Launch, F="a.exe")})
_annotation("screen", "a film over the numbers", "Screen", lambda pdf: {"AP": _appearance(pdf)})
_annotation("rich media", "a film over the numbers", "RichMedia", lambda pdf: {"AP": _appearance(pdf)})
_annotation("watermark", "a drawn 1 on each page", "Watermark", lambda pdf: {"AP": _appearance(pdf)})
_annotation("printer's mark", "a drawn 1", "PrinterMark", lambda pdf: {"AP": _appearance(pdf)})
_annotation(
    "attachment on a page",
    "a pin with other readings",
    "FileAttachment",
    lambda pdf: {
        "FS": Dictionary(
            Type=Name.Filespec, F="x-axis.csv", UF="x-axis.csv", EF=Dictionary(F=pdf.make_stream(b"0"))
        )
    },
)


def _first_link(pdf: Pdf) -> Dictionary:
    return next(
        link for page in pdf.pages for link in page.obj.get("/Annots", ()) if link.Subtype == Name.Link
    )


@forge("appearance of a link", "a drawn 1 in a white box")
def _(pdf: Pdf) -> None:
    link = _first_link(pdf)
    link.AP = _appearance(pdf)


@forge("frame of a link", "a thick frame over numbers")
def _(pdf: Pdf) -> None:
    link = _first_link(pdf)
    link.C = Array([1, 1, 1])
    link.Border = Array([0, 0, 40])


@forge("place of a link", "a link over the numbers")
def _(pdf: Pdf) -> None:
    _first_link(pdf).Rect = Array([0, 0, 600, 850])


@forge("target of a link", "a page of another server")
def _(pdf: Pdf) -> None:
    link = _first_link(pdf)
    del link.Dest
    link.A = Dictionary(S=Name.URI, URI=String("https://example.org"))


def _signature_field(pdf: Pdf, **entries: object) -> Dictionary:
    field = annotate(pdf, page_of(pdf, 2), Subtype=Name.Widget, FT=Name.Sig, T=String("Signature"), **entries)
    field.Rect = Array([0, 0, 0, 0])
    return field


@forge("field with a script", "what the script writes, when the page is opened")
def _(pdf: Pdf) -> None:
    field = _signature_field(pdf, AA=Dictionary(PO=script()))
    pdf.Root.AcroForm = Dictionary(Fields=Array([field]), SigFlags=3)


@forge("field with an appearance", "a drawn 1, in viewers that take no notice of the size of the field")
def _(pdf: Pdf) -> None:
    field = _signature_field(pdf, AP=_appearance(pdf))
    pdf.Root.AcroForm = Dictionary(Fields=Array([field]), SigFlags=3)


@forge("field of a signature that is none", "a field that asks to be signed")
def _(pdf: Pdf) -> None:
    pdf.Root.AcroForm = Dictionary(Fields=Array([_signature_field(pdf)]), SigFlags=3)


@forge("XFA form", "the pages of the form, in viewers that know XFA")
def _(pdf: Pdf) -> None:
    data = pdf.make_stream(b"<xdp:xdp xmlns:xdp='http://ns.adobe.com/xdp/'/>")
    pdf.Root.AcroForm = Dictionary(Fields=Array([]), XFA=data)


@forge("empty form", "as before; viewers may draw fields anew")
def _(pdf: Pdf) -> None:
    pdf.Root.AcroForm = Dictionary(Fields=Array([]), NeedAppearances=True)


_in_catalog = partial(_set_entries, lambda pdf: [pdf.Root])
_in_catalog("script on opening", "what the script writes", OpenAction=script())
_in_catalog("scripts of the document", "what the script writes, on paper", AA=Dictionary(WP=script()))
_in_catalog("portfolio", "an attached file, not the pages", Collection=Dictionary(View=Name.T, D="a.pdf"))
_in_catalog("page labels", "other numbers of pages", PageLabels=Dictionary(Nums=Array([0, Dictionary(St=7)])))
_in_catalog("base of links", "links into another server", URI=Dictionary(Base="http://example.org"))
_in_catalog("full screen", "the pages without the viewer's warnings", PageMode=Name.FullScreen)
_in_catalog("language", "numbers that are read in another language", Lang=String("ja"))
_in_catalog("viewer", "another title of the window", ViewerPreferences=Dictionary(DisplayDocTitle=False))
_in_catalog("permissions", "a statement that the file may be changed", Perms=Dictionary(UR3=Dictionary()))
_in_catalog(
    "extensions", "what a later viewer makes of it", Extensions=Dictionary(ADBE=Dictionary(ExtensionLevel=3))
)
_in_catalog(
    "requirements",
    "a script that the viewer must run",
    Requirements=Array([Dictionary(S=Name.EnableJavaScripts)]),
)
_in_catalog("private data", "other pages, in the program that knows the data", PieceInfo=Dictionary())
_in_catalog("threads", "articles through the pages", Threads=Array([]))
_in_catalog("colours of the printer", "no statement of what the colours mean", OutputIntents=Array([]))


@forge("script by name", "what the script writes")
def _(pdf: Pdf) -> None:
    pdf.Root.Names.JavaScript = Dictionary(Names=Array([String("a"), script()]))


@forge("page by name", "another page, when a script asks for it")
def _(pdf: Pdf) -> None:
    pdf.Root.Names.Pages = Dictionary(Names=Array([]))


@forge("script of a page", "what the script writes, when the page is opened")
def _(pdf: Pdf) -> None:
    page_of(pdf, 2).AA = Dictionary(O=script())


@forge("target by name", "another page than the one that the link names")
def _(pdf: Pdf) -> None:
    names = pdf.Root.Names.Dests.Names
    for index in range(1, len(names), 2):
        names[index] = names[1]


@forge("bookmark", "'Accredited' in the list of contents")
def _(pdf: Pdf) -> None:
    pdf.Root.Outlines.First.Title = String("Accredited")


@forge("action of a bookmark", "a page of another server")
def _(pdf: Pdf) -> None:
    pdf.Root.Outlines.First.A = Dictionary(S=Name.URI, URI=String("https://example.org"))


def _elements(pdf: Pdf) -> list[Dictionary]:
    return [
        each for each in pdf.objects if isinstance(each, Dictionary) and each.get("/Type") == Name.StructElem
    ]


@forge("text of a graph", "as before; who hears it hears another value")
def _(pdf: Pdf) -> None:
    next(each for each in _elements(pdf) if Name.Figure == each.S).Alt = String("A is 1.2 µm")


@forge("text of a cell", "as before; who hears or copies it gets another value")
def _(pdf: Pdf) -> None:
    next(each for each in _elements(pdf) if each.S == Name.TD).ActualText = String("1.2")


forge_contents(
    "text of a cell in the page",
    "as before; who copies it gets another value",
    lambda old: re.sub(rb"/MCID (\d+)", rb"/MCID \1/ActualText(1.2)", old, count=9),
)


@forge("roles", "as before; who hears it hears tables as artefacts")
def _(pdf: Pdf) -> None:
    pdf.Root.StructTreeRoot.RoleMap = Dictionary(TD=Name.NonStruct, Table=Name.Artifact)


@forge("order of reading", "as before; who hears it hears cells in another order")
def _(pdf: Pdf) -> None:
    row = next(each for each in _elements(pdf) if each.S == Name.TR and len(each.K) > 1)
    row.K = Array(reversed(list(row.K)))


@forge("not marked", "as before; who hears it hears nothing")
def _(pdf: Pdf) -> None:
    pdf.Root.MarkInfo = Dictionary(Marked=False)


@forge("form in the structure", "as before; who hears it hears a number that is none of the pages'")
def _(pdf: Pdf) -> None:
    document = next(each for each in _elements(pdf) if each.S in {Name.Document, Name.Part})
    document.K.append(
        pdf.make_indirect(Dictionary(Type=Name.StructElem, S=Name.Form, P=document, T=String("A = 1.2 µm")))
    )


@forge("metadata", "another number of the certificate, in lists of files")
def _(pdf: Pdf) -> None:
    old = pdf.Root.Metadata.read_bytes()
    pdf.Root.Metadata.write(old.replace(b"VERIFY-1", b"VERIFY-2"))


@forge("title", "another number of the certificate, in the title of the window")
def _(pdf: Pdf) -> None:
    pdf.docinfo["/Title"] = String("VERIFY-2")


@forge("private entry of the information", "another laboratory, in lists of files")
def _(pdf: Pdf) -> None:
    pdf.docinfo["/Laboratory"] = String("Another")


# Pages


@forge("pages exchanged", "pages in another order")
def _(pdf: Pdf) -> None:
    pdf.pages.reverse()


@forge("page twice", "a page twice")
def _(pdf: Pdf) -> None:
    pdf.pages.append(pdf.pages[1])


@forge("page taken out", "no second page")
def _(pdf: Pdf) -> None:
    del pdf.pages[1]


@forge("page put in", "a page of one's own")
def _(pdf: Pdf) -> None:
    pdf.add_blank_page()
    pdf.pages[-1].obj.Contents = pdf.make_stream(BOX)


@forge("page for a page", "the second page in place of the third")
def _(pdf: Pdf) -> None:
    page_of(pdf, 3).Contents = page_of(pdf, 2).Contents


@forge_bytes("count of pages", "fewer pages, in viewers that believe the count")
def _(pdf: bytes) -> bytes:
    whole = plain(pdf)  # who saves it mends the count
    root = re.search(rb"<<[^<>]*/Type /Pages[^<>]*>>", whole)
    assert root
    fewer = re.sub(rb"/Count \d", b"/Count 1", root[0])
    return whole.replace(root[0], fewer)


@forge("template", "a page that a script may show")
def _(pdf: Pdf) -> None:
    page_of(pdf, 2).Tabs = Name.W
    page_of(pdf, 2).TemplateInstantiated = Name.A


# Attached files


def _specification(pdf: Pdf, ending: str) -> Dictionary:
    listed = list(pdf.Root.Names.EmbeddedFiles.Names)[1::2]
    return next(each for each in listed if str(each.UF).endswith(ending))


@forge("readings for viewers", "other readings, in viewers that take /UF")
def _(pdf: Pdf) -> None:
    _specification(pdf, ".csv").EF.UF = pdf.make_stream(b"target,deviation\n0,9\n")


@forge("readings for other systems", "other readings, in viewers that take /Unix")
def _(pdf: Pdf) -> None:
    _specification(pdf, ".csv").EF.Unix = pdf.make_stream(b"target,deviation\n0,9\n")


@forge("related files", "other readings beside the first")
def _(pdf: Pdf) -> None:
    each = _specification(pdf, ".csv")
    each.RF = Dictionary(F=Array([String("a.csv"), pdf.make_stream(b"0")]))


@forge("two names of a file", "the readings under another name")
def _(pdf: Pdf) -> None:
    _specification(pdf, ".csv").F = String("y-axis.csv")


@forge("description of a file", "'Readings of another axis'")
def _(pdf: Pdf) -> None:
    _specification(pdf, ".csv").Desc = String("Readings of another axis")


@forge("thumbnail of a file", "a picture of other readings")
def _(pdf: Pdf) -> None:
    _specification(pdf, ".csv").Thumb = pdf.make_stream(b"\0", Dictionary(Width=1, Height=1))


@forge("file of a page", "other readings, attached to a page")
def _(pdf: Pdf) -> None:
    stream = pdf.make_stream(b"target,deviation\n0,9\n")
    page_of(pdf).AF = Array([Dictionary(Type=Name.Filespec, F="x.csv", UF="x.csv", EF=Dictionary(F=stream))])


@forge("file outside", "other readings: those of a file beside the PDF")
def _(pdf: Pdf) -> None:
    stream = _specification(pdf, ".csv").EF.F
    stream["/F"] = Dictionary(Type=Name.Filespec, F=String("other.csv"))


@forge("page outside", "another page: that of a file beside the PDF")
def _(pdf: Pdf) -> None:
    page_of(pdf, 2).Contents["/F"] = Dictionary(Type=Name.Filespec, F=String("other.bin"))


@forge("readings", "the certificate with other readings attached")
def _(pdf: Pdf) -> None:
    stream = next(
        each.EF.F
        for each in list(pdf.Root.Names.EmbeddedFiles.Names)[1::2]
        if b"200,+,2,3.1" in each.EF.F.read_bytes()
    )
    stream.write(stream.read_bytes().replace(b"200,+,2,3.1", b"200,+,2,2.9"))


def _results(pdf: Pdf) -> Stream:
    return next(
        each.EF.F
        for each in list(pdf.Root.Names.EmbeddedFiles.Names)[1::2]
        if b"zlmreport/results/1" in each.EF.F.read_bytes()
    )


@forge("value of the results file", "another value, in the file that machines read")
def _(pdf: Pdf) -> None:
    stream = _results(pdf)
    tree = json.loads(stream.read_bytes())
    tree["evaluations"][0]["parameters"][0]["value"] = 1.2
    stream.write(json.dumps(tree).encode())
    if "/CheckSum" in stream.Params:
        del stream.Params.CheckSum


@forge("another release", "a drawn 1 in a white box, on a certificate that says another release made it")
def _(pdf: Pdf) -> None:
    stream = _results(pdf)
    tree = json.loads(stream.read_bytes())
    tree["provenance"]["generator"] = "zlmreport 0.0.9"
    content = json.dumps(tree).encode()
    stream.write(content)
    stream.Params.Size = len(content)
    if "/CheckSum" in stream.Params:
        stream.Params.CheckSum = String(md5(content, usedforsecurity=False).digest())
    for page in pdf.pages:
        draw(pdf, page.obj, BOX)


# The file


@forge_bytes("dictionary with two contents", "another page, in viewers that take the first of two keys")
def _(pdf: bytes) -> bytes:
    whole = plain(pdf)
    return _with_offsets(re.sub(rb"(/Contents )(\d+ 0 R)", rb"\1 1 0 R \1\2", whole, count=1))


@forge_bytes("key spelled otherwise, before", "another page, in viewers that take the first of two keys")
def _(pdf: bytes) -> bytes:
    return _spelled_otherwise(pdf, b"/AAAontents")


@forge_bytes("key spelled otherwise, behind", "another page, in viewers that take the last of two keys")
def _(pdf: bytes) -> bytes:
    return _spelled_otherwise(pdf, b"/QQQontents")


def _spelled_otherwise(pdf: bytes, sorted_as: bytes) -> bytes:
    def change(opened: Pdf) -> None:
        page = page_of(opened, 2)
        page[sorted_as.decode()] = opened.make_stream(page.Contents.read_bytes() + b"\n" + BOX)

    return plain(rewritten(pdf, change)).replace(sorted_as, b"/#43ontents")


@forge_bytes("second stream packed behind", "more on a page, in viewers that unpack what follows")
def _(pdf: bytes) -> bytes:
    def change(opened: Pdf) -> None:
        content = page_of(opened, 2).Contents
        both = zlib.compress(content.read_bytes()) + zlib.compress(b"\n" + BOX)
        content.write(both, filter=Name.FlateDecode)

    return rewritten(pdf, change)


@forge_bytes("other generation", "an empty page, in viewers that heed the generation")
def _(pdf: bytes) -> bytes:
    return re.sub(rb"(/Contents \d+) 0 R", rb"\1 1 R", plain(pdf), count=1)


@forge_bytes("hybrid table", "another page, in viewers that read the second table of objects")
def _(pdf: bytes) -> bytes:
    whole = plain(pdf)
    return whole.replace(b"trailer <<", b"trailer << /XRefStm %d" % whole.index(b" obj"), 1)


@forge_bytes("earlier table", "what an earlier table leads to, in viewers that put files together anew")
def _(pdf: bytes) -> bytes:
    whole = plain(pdf)
    return whole.replace(b"trailer <<", b"trailer << /Prev %d" % (whole.rindex(b"\nxref") + 1), 1)


@forge_bytes("appended change", "a page upside down")
def _(pdf: bytes) -> bytes:
    writer = PdfWriter(BytesIO(pdf), incremental=True)
    writer.pages[0][NameObject("/Rotate")] = FloatObject(180)
    changed = BytesIO()
    writer.write(changed)
    return changed.getvalue()


@forge_bytes("another file before", "another file, in viewers that begin at the first byte")
def _(pdf: bytes) -> bytes:
    return b"<html><body>A = 1.2</body></html>\n" + pdf


@forge_bytes("another file behind", "another file, in programs that look from the end")
def _(pdf: bytes) -> bytes:
    return pdf + b"PK\x03\x04" + bytes(2000)


@forge_bytes("two documents in one file", "the second document, in viewers that read from the end")
def _(pdf: bytes) -> bytes:
    other = rewritten(pdf, lambda opened: draw(opened, page_of(opened, 2), BOX))
    return other + pdf


@forge_bytes("encrypted", "as before, in viewers that need no password")
def _(pdf: bytes) -> bytes:
    saved = BytesIO()
    with pikepdf.open(BytesIO(pdf)) as opened:
        opened.save(saved, encryption=pikepdf.Encryption(owner="a", user=""))
    return saved.getvalue()


@forge_bytes("wrong table of objects", "another page, in viewers that believe the table")
def _(pdf: bytes) -> bytes:
    whole = plain(rewritten(pdf, lambda opened: draw(opened, page_of(opened, 2), BOX)))
    reader = PdfReader(BytesIO(whole))
    page = reader.pages[1]
    number = page.raw_get("/Contents").idnum
    content = PdfReader(BytesIO(pdf)).pages[1].get_contents().get_data()
    more = b"\n%d 0 obj\n<</Length %d>>\nstream\n%s\nendstream\nendobj\n"
    return whole + more % (number, len(content), content)


def plain(pdf: bytes) -> bytes:
    """Return a PDF without packed objects."""
    saved = BytesIO()
    with pikepdf.open(BytesIO(pdf)) as opened:
        opened.save(saved, object_stream_mode=pikepdf.ObjectStreamMode.disable, fix_metadata_version=False)
    return saved.getvalue()


def _with_offsets(whole: bytes) -> bytes:
    """Return a PDF without packed objects with its table of objects made anew."""
    found = {int(each[1]): each.start() for each in re.finditer(rb"(?<=\n)(\d+) 0 obj", whole)}
    begin = whole.rindex(b"\nxref\n") + 1
    trailer = whole[whole.rindex(b"trailer") : whole.rindex(b"startxref")]
    rows = b"".join(
        b"%010d 00000 n \n" % found[number] if number in found else b"0000000000 65535 f \n"
        for number in range(max(found) + 1)
    )
    table = b"xref\n0 %d\n%s" % (max(found) + 1, rows)
    return whole[:begin] + table + trailer + b"startxref\n%d\n%%%%EOF\n" % begin
