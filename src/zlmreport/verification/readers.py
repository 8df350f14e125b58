"""Compares what other PDF readers see (pypdf, PDFium, qpdf, poppler, MuPDF): pages and attachments.

Which objects a file holds is said twice: by its table, and by the objects themselves. Some viewers believe
the one and some the other, and each puts a damaged file together in its own way. So every reader is asked
twice: for the file as it is, and for the file without the numbers that lead to its tables, which it then has
to find by itself. What is seen must be the same each time.

pypdf, PDFium (the engine of Chromium) and qpdf come with the program. Poppler and MuPDF are programs of the
system, and are asked where they are installed: they are called, and nothing of them is linked.
"""

from __future__ import annotations

import re
import shutil
import subprocess
import tempfile
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from hashlib import sha256
from io import BytesIO
from pathlib import Path
from typing import Any

from zlmreport.errors import count_in_words
from zlmreport.verification.carrier import Carrier, silence_pypdf
from zlmreport.verification.findings import CheckedStatement, VerificationVerdict, name_first_of

_LEADS = re.compile(rb"(startxref\s+)(\d+)")
#: Of a program of the system, in seconds and in bytes of what it prints.
_PATIENCE, _MOST_PRINTED = 60, 64 << 20
#: What the finding is called.
SUBJECT = "what other readers see"
_MOST_TOLD = 4


@dataclass(frozen=True, slots=True)
class Seen:
    """What a reader sees: a digest of each page, and of each attachment; None where it shows none."""

    pages: tuple[str, ...]
    files: tuple[str, ...] | None


@dataclass(frozen=True, slots=True)
class Reader:
    """A reader: its name, and how it is asked.

    `command` is the program of the system that it needs; empty if it comes with this one. `draws` says
    whether what it sees of a page is what is drawn, and not how the file is built.
    """

    name: str
    see: Callable[[bytes], Seen]
    command: str = ""
    draws: bool = True

    @property
    def is_here(self) -> bool:
        """Whether it can be asked on this machine."""
        return not self.command or shutil.which(self.command) is not None


def compare(carrier: Carrier, again: bytes, *, is_drawn_alike: bool) -> CheckedStatement:
    """Return whether all readers see one and the same document.

    `again`: The document printed again.
    `is_drawn_alike`: Whether it is drawn by the same strokes, so that a reader must see the same pages in it.
    """
    try:
        told = list(
            find_differences(carrier.content, digest_attachments_of(carrier), len(carrier.reader.pages))
        )
        if is_drawn_alike and not told:
            told += list(_from_again(carrier.content, again))
    except subprocess.TimeoutExpired as late:  # a file without end, or a busy computer: nobody can tell
        detail = f"{late.cmd[0]} did not end within {late.timeout:g} s; verify it once more"
        return CheckedStatement(SUBJECT, VerificationVerdict.OPEN, detail)
    return CheckedStatement.of(SUBJECT, name_first_of(told, _MOST_TOLD))


def digest_attachments_of(carrier: Carrier) -> tuple[str, ...]:
    """Return the digests of the attachments that were taken out and are compared."""
    return _compute_digests(each.content for each in carrier.carried.values())


def name_absent() -> tuple[str, ...]:
    """Return the names of readers that are not installed here."""
    return tuple(each.name for each in READERS if not each.is_here)


def find_differences(content: bytes, files: Sequence[str], pages: int) -> Iterator[str]:
    """Yield what a reader sees otherwise than is compared, or otherwise where it has to mend the file.

    `files`: Digests of the attachments that are compared.
    `pages`: How many pages are.
    """
    unled = remove_leads(content)
    for reader in READERS:
        if not reader.is_here:
            continue
        seen = read_as_seen_by(reader, content)
        if seen is None:
            yield f"{reader.name} cannot open it"
            continue
        if len(seen.pages) != pages:
            yield f"{reader.name} sees {count_in_words(len(seen.pages), 'page')}, and {pages} are compared"
        if seen.files is not None and seen.files != tuple(files):
            yield f"{reader.name} takes out other attachments than are compared"
        # Where a reader cannot mend it, nothing is seen: that is no other face.
        mended = read_as_seen_by(reader, unled)
        if mended is not None and mended.pages != seen.pages:
            yield f"{reader.name} sees other pages where it puts the file together anew"
        if mended is not None and set(mended.files or ()) - set(files):  # some are lost on the way
            yield f"{reader.name} takes out other attachments where it puts the file together anew"


def _from_again(content: bytes, again: bytes) -> Iterator[str]:
    for reader in READERS:
        if reader.is_here and reader.draws:
            one, other = read_as_seen_by(reader, content), read_as_seen_by(reader, again)
            if one is None or other is None or one.pages != other.pages:
                yield f"{reader.name} sees other pages than are printed again"


def remove_leads(content: bytes) -> bytes:
    """Return a file in which no number leads to a table: who opens it has to put it together anew."""
    return _LEADS.sub(lambda found: found[1] + b"0" * len(found[2]), content)


def read_as_seen_by(reader: Reader, content: bytes) -> Seen | None:
    """Return what a reader sees; None if it cannot open the file, or sees no page.

    Raises `subprocess.TimeoutExpired` if it does not end.
    """
    with silence_pypdf():
        try:
            seen = reader.see(content)
        except subprocess.TimeoutExpired:
            raise
        except Exception:  # noqa: BLE001 - a foreign file may break its reader in any way
            return None
    return seen if seen.pages else None


def _compute_digests(contents: Iterable[bytes]) -> tuple[str, ...]:
    """Return the digests of contents: where data end is a guess for who mends a file, by an end of a line."""
    return tuple(sorted(sha256(each.rstrip(b"\r\n")).hexdigest() for each in contents))


def _compute_digest(*parts: object) -> str:
    return sha256(repr(parts).encode("utf-8", "backslashreplace")).hexdigest()


def _read_by_pypdf(content: bytes) -> Seen:
    from pypdf import PdfReader  # noqa: PLC0415 - slow to load

    reader = PdfReader(BytesIO(content))
    pages = [_compute_digest(page.mediabox, _read_drawn(page)) for page in reader.pages]
    files = _compute_digests(each for contents in reader.attachments.values() for each in contents)
    return Seen(tuple(pages), files)


def _read_drawn(page: Any) -> bytes:
    contents = page.get_contents()
    return contents.get_data() if contents is not None else b""


def _read_by_pdfium(content: bytes) -> Seen:
    import pypdfium2  # noqa: PLC0415 - slow to load

    with pypdfium2.PdfDocument(content) as document:
        pages = []
        for page in document:
            pixels = page.render().to_numpy()  # a dot a point, as it comes: both are of one engine
            text = page.get_textpage().get_text_bounded()
            pages.append(_compute_digest(page.get_size(), text, sha256(pixels.tobytes()).hexdigest()))
        attached = (document.get_attachment(number) for number in range(document.count_attachments()))
        return Seen(tuple(pages), _compute_digests(bytes(each.get_data()) for each in attached))


def _read_by_qpdf(content: bytes) -> Seen:
    import pikepdf  # noqa: PLC0415 - slow to load

    with pikepdf.open(BytesIO(content)) as opened:
        # Written anew in one order, whatever order it was in: all that leads to a page is in it.
        written = BytesIO()
        opened.save(
            written,
            static_id=True,
            fix_metadata_version=False,
            object_stream_mode=pikepdf.ObjectStreamMode.disable,
            stream_decode_level=pikepdf.StreamDecodeLevel.none,
        )
        whole = sha256(written.getvalue()).hexdigest()
        pages = tuple(_compute_digest(number, whole) for number in range(len(opened.pages)))
        files = _compute_digests(each.get_file().read_bytes() for each in opened.attachments.values())
        return Seen(pages, files)


def _read_by_poppler(content: bytes) -> Seen:
    with tempfile.TemporaryDirectory(prefix="zlmreport-readers-") as folder:
        path, files = Path(folder, "file.pdf"), Path(folder, "files")
        path.write_bytes(content)
        files.mkdir()
        pages = _split_pages(_run_program("pdftotext", "-q", "-raw", str(path), "-"))
        _run_program("pdfdetach", "-saveall", "-o", str(files), str(path))
        return Seen(pages, _compute_digests(each.read_bytes() for each in files.iterdir()))


def _read_by_mupdf(content: bytes) -> Seen:
    with tempfile.TemporaryDirectory(prefix="zlmreport-readers-") as folder:
        path = Path(folder, "file.pdf")
        path.write_bytes(content)
        return Seen(_split_pages(_run_program("mutool", "draw", "-q", "-F", "text", str(path))), None)


def _split_pages(text: bytes) -> tuple[str, ...]:
    *pages, _ = text.split(b"\f")
    return tuple(_compute_digest(each.split()) for each in pages)


def _run_program(*command: str) -> bytes:
    """Return what a program of the system prints; what it has to complain of is not for the terminal."""
    done = subprocess.run(  # noqa: S603 - no text of the file is on its command line
        command, capture_output=True, check=False, timeout=_PATIENCE, stdin=subprocess.DEVNULL
    )
    return done.stdout[:_MOST_PRINTED]


READERS: Sequence[Reader] = (
    Reader("pypdf", _read_by_pypdf),
    Reader("PDFium", _read_by_pdfium),
    Reader("qpdf", _read_by_qpdf, draws=False),
    Reader("Poppler", _read_by_poppler, "pdftotext"),
    Reader("MuPDF", _read_by_mupdf, "mutool"),
)
