"""A report as it was issued, and ways to alter it."""

from __future__ import annotations

import json
import re
from collections.abc import Callable
from hashlib import md5, sha256
from io import BytesIO
from pathlib import Path
from typing import Any

from PIL import Image
from pypdf import PdfReader, PdfWriter
from pypdf.generic import ByteStringObject, EncodedStreamObject, NameObject, NumberObject

from installed import registry
from zlmreport import pipeline
from zlmreport.job.loading import load

NUMBER = "VERIFY-1"
LABORATORY = f"""\
laboratory: {{name: Example Laboratory, address: Example Street 1, logo: pictures/logo.png}}
certificate: {{number: {NUMBER}, kind: report, issued: 2026-11-20}}
"""
JOB = """\
schema: zlmreport/job/1
extends: ../laboratory.yaml
axis: {name: X, travel: [0, 200], compensation_table: tables/compensation.csv}
measurement: {source: {plugin: laser-csv, file: x-axis.csv}}
instrument: {name: Interferometer, expanded_uncertainty: 0.5, compensates: {air: true}}
evaluate:
  - {standard: nmtba, tolerances: {P: 20}}
output: {directory: out, formats: [pdf]}
"""
READINGS = """\
target,direction,run,deviation
0,+,1,0.2
100,+,1,1.3
200,+,1,2.9
200,-,1,1.8
100,-,1,0.1
0,-,1,-1.1
0,+,2,0.4
100,+,2,1.1
200,+,2,3.1
200,-,2,1.6
100,-,2,0.3
0,-,2,-0.9
"""
COMPENSATION = "position,deviation\n0,0\n200,1.5\n"

#: The parts of a report that its attachments are made from, by their paths from its folder.
FILES = {
    "laboratory.yaml": LABORATORY,
    "jobs/job.yaml": JOB,
    "jobs/x-axis.csv": READINGS,
    "jobs/tables/compensation.csv": COMPENSATION,
}


def lay_out(folder: Path, **changed: str) -> Path:
    """Write the files of a job and return the job's path; `changed` stand for files of these stems."""
    for name, text in FILES.items():
        path = folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(changed.get(path.stem.replace("-", "_"), text), encoding="utf-8")
    (folder / "pictures").mkdir(exist_ok=True)
    Image.new("RGB", (30, 10), "navy").save(folder / "pictures" / "logo.png")
    return folder / "jobs" / "job.yaml"


def issue(job: Path, printed: str = "pdf") -> bytes:
    """Return the PDF of a job."""
    outcome = pipeline.run(load(job, registry(), formats=(printed,)), registry())
    return outcome.documents[0].content


def altered(pdf: bytes, change: Callable[[PdfWriter], None]) -> bytes:
    """Return a PDF as another program saves it, after a change."""
    writer = PdfWriter(clone_from=PdfReader(BytesIO(pdf)))
    change(writer)
    saved = BytesIO()
    writer.write(saved)
    return saved.getvalue()


def specification(writer: PdfWriter, name: str) -> Any:
    """Return the entry of an attachment."""
    listed = writer.root_object["/Names"]["/EmbeddedFiles"]["/Names"]
    entries = (each.get_object() for each in listed[1::2])
    return next(entry for entry in entries if name in {entry.get("/UF"), entry.get("/F")})


def content_of(pdf: bytes, name: str) -> bytes:
    """Return the content of an attachment."""
    (content,) = PdfReader(BytesIO(pdf)).attachments[name]
    return content


def with_attachment(pdf: bytes, name: str, content: bytes) -> bytes:
    """Return a PDF in which an attachment has another content, with the checksum and size that go with it."""

    def change(writer: PdfWriter) -> None:
        entry = specification(writer, name)
        old = entry["/EF"]["/F"]
        new = EncodedStreamObject()
        new.update({key: value for key, value in old.items() if key not in {"/Filter", "/Length"}})
        new._data = content
        new["/Params"][NameObject("/CheckSum")] = ByteStringObject(
            md5(content, usedforsecurity=False).digest()
        )
        new["/Params"][NameObject("/Size")] = NumberObject(len(content))
        writer._replace_object(entry["/EF"].raw_get("/F"), new)

    return altered(pdf, change)


def with_results(pdf: bytes, change: Callable[[dict[str, Any]], None]) -> bytes:
    """Return a PDF with a change in its results file."""
    results = json.loads(content_of(pdf, f"{NUMBER}.json"))
    change(results)
    return with_attachment(pdf, f"{NUMBER}.json", json.dumps(results, indent=2).encode())


def with_source(pdf: bytes, name: str, content: bytes) -> bytes:
    """Return a PDF with another source, whose digest its results file states."""

    def state(results: dict[str, Any]) -> None:
        provenance = results["provenance"]
        for file in (*provenance["files"], *provenance["sources"]):
            if file["name"] == name:
                file.update(sha256=sha256(content).hexdigest(), size=len(content))

    return with_results(with_attachment(pdf, name, content), state)


def with_page_content(pdf: bytes, number: int, change: Callable[[bytes], bytes]) -> bytes:
    """Return a PDF with a change in what is drawn on a page, counted from 1."""

    def redraw(writer: PdfWriter) -> None:
        stream = writer.pages[number - 1]["/Contents"].get_object()
        stream.set_data(change(stream.get_data()))

    return altered(pdf, redraw)


def page_with(pdf: bytes, text: str) -> int:
    """Return the number of the first page that has a text, from 1."""
    pages = PdfReader(BytesIO(pdf)).pages
    return next(number for number, page in enumerate(pages, 1) if text in page.extract_text())


def with_digit(pdf: bytes, number: str, other: str) -> bytes:
    """Return a PDF in which the first number of this spelling is printed with another digit in its place."""
    page = page_with(pdf, number)
    fonts = PdfReader(BytesIO(pdf)).pages[page - 1]["/Resources"]["/Font"]
    codes = {name: _codes(fonts[name]) for name in fonts}

    def change(content: bytes) -> bytes:
        for shown in re.finditer(rb"(/[A-Z]+) [\d.]+ Tf\n\[(.*?)\] TJ", content):
            by_code = codes[shown[1].decode()]
            places = list(re.finditer(rb"<([0-9a-f]{4})>", shown[2]))
            if "".join(by_code.get(place[1], "") for place in places) == number:
                index = next(i for i in range(len(number)) if number[i] != other[i])
                glyph = next(code for code, letter in by_code.items() if letter == other[index])
                start = shown.start(2) + places[index].start(1)
                return content[:start] + glyph + content[start + 4 :]
        raise AssertionError(f"{number} is not shown")

    return with_page_content(pdf, page, change)


def _codes(font: Any) -> dict[bytes, str]:
    table = font["/ToUnicode"].get_data()
    return {
        code: bytes.fromhex(text.decode()).decode("utf-16-be")
        for code, text in re.findall(rb"<([0-9a-f]{4})> <([0-9a-f]+)>", table)
    }
