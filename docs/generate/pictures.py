"""Makes the pictures of the documentation from real output: ``python docs/generate/pictures.py``.

Needs ``pdftoppm`` (Debian, Ubuntu: apt-get install poppler-utils) and ``zlmreport`` beside this Python.
"""

from __future__ import annotations

import subprocess
import sys
import tempfile
from pathlib import Path

from PIL import Image
from pypdf import PdfReader

_ROOT = Path(__file__).parents[2]
_PICTURES = _ROOT / "docs" / "images"
_ZLMREPORT = Path(sys.executable).with_name("zlmreport")
_DOTS_PER_INCH = 110
_COLOURS = 128


def make(name: str, pdf: Path, page: int) -> None:
    """Make a picture of a page."""
    with tempfile.TemporaryDirectory() as folder:
        stem = Path(folder, "page")
        only = ["-f", str(page), "-l", str(page), "-singlefile"]
        command = ["pdftoppm", "-r", str(_DOTS_PER_INCH), *only, "-png", pdf, stem]
        subprocess.run(command, check=True)  # noqa: S603 - of our own files
        with Image.open(stem.with_suffix(".png")) as picture:
            picture.convert("RGB").quantize(_COLOURS, Image.Quantize.MAXCOVERAGE).save(
                _PICTURES / f"{name}.png", optimize=True
            )


def page_with(pdf: Path, text: str, after: int = 0) -> int:
    """Return the number of the first page after another that has a text."""
    pages = PdfReader(pdf).pages
    return next(
        number for number, page in enumerate(pages, 1) if number > after and text in page.extract_text()
    )


def certificate(job: Path, folder: Path) -> Path:
    """Return the PDF of a job."""
    subprocess.run([_ZLMREPORT, job, "--output", folder, "--format", "pdf", "--quiet"], check=True)  # noqa: S603 - of our own files
    (pdf,) = folder.glob("*.pdf")
    return pdf


def main() -> None:
    """Make all pictures."""
    _PICTURES.mkdir(exist_ok=True)
    with tempfile.TemporaryDirectory() as folder:
        example = certificate(_ROOT / "configs" / "linear-axis" / "certificate.yaml", Path(folder, "example"))
        make("certificate-cover", example, 1)
        make("certificate-results", example, page_with(example, "Results by ISO 230-2:2014", after=1))
        make("certificate-graphs", example, page_with(example, "Figure 2"))
        first = Path(folder, "first")
        subprocess.run([_ZLMREPORT, "init", first], check=True, stdout=subprocess.DEVNULL)  # noqa: S603 - of our own files
        job = first / "job.yaml"
        make("tutorial-cover", certificate(job, first / "en"), 1)
        text = job.read_text(encoding="utf-8")
        job.write_text(text.replace("language: en ", "language: de "), encoding="utf-8")
        german = certificate(job, first / "de")
        make("tutorial-german", german, page_with(german, "Ergebnisse nach ISO 230-2:2014", after=1))


if __name__ == "__main__":
    main()
