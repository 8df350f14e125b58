"""Makes the pictures of the documentation from real output: ``python docs/generate/pictures.py``.

Those of the workbench are made by the tests that use it, which this calls last. Needs ``pdftoppm`` and
``chromium`` (Debian, Ubuntu: apt-get install poppler-utils chromium), and ``zlmreport`` and its tests beside
this Python.
"""

from __future__ import annotations

import os
import shutil
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
_COLOURS = 256


def make(name: str, pdf: Path, page: int) -> None:
    """Make a picture of a page."""
    with tempfile.TemporaryDirectory() as folder:
        stem = Path(folder, "page")
        only = ["-f", str(page), "-l", str(page), "-singlefile"]
        command = ["pdftoppm", "-r", str(_DOTS_PER_INCH), *only, "-png", pdf, stem]
        subprocess.run(command, check=True)  # noqa: S603 - of our own files
        _keep(name, stem.with_suffix(".png"))


def make_of_screen(name: str, page: Path, width: int, height: int) -> None:
    """Make a picture of a page of HTML, as a browser's window of this size shows it."""
    with tempfile.TemporaryDirectory() as folder:
        shot = Path(folder, "page.png")
        quiet = ["--headless", "--no-sandbox", "--disable-gpu", "--disable-background-networking"]
        window = [f"--user-data-dir={folder}/browser", "--hide-scrollbars", f"--window-size={width},{height}"]
        command = ["chromium", *quiet, *window, f"--screenshot={shot}", page.as_uri()]
        subprocess.run(command, check=True, stderr=subprocess.DEVNULL)  # noqa: S603 - of our own files
        _keep(name, shot)


def _keep(name: str, shot: Path) -> None:
    with Image.open(shot) as picture:
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


def overview(folder: Path) -> Path:
    """Return the overview of the example fleet, after its night; one of its jobs fails on purpose."""
    shutil.copytree(_ROOT / "configs", folder / "configs")
    # In the folder itself: the page shows paths as they were given.
    for words in (["fleet"], ["fleet", "report"]):
        command = [_ZLMREPORT, *words, "configs/fleet/fleet.yaml"]
        subprocess.run(command, cwd=folder, check=words != ["fleet"], stdout=subprocess.DEVNULL)  # noqa: S603 - of our own files
    return folder / "out" / "fleet" / "fleet.html"


def workbench() -> None:
    """Make the pictures of the workbench: the tests take them on their way."""
    command = [sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider", "tests/browser"]
    subprocess.run(command, cwd=_ROOT, check=True, env={**os.environ, "ZLMREPORT_PICTURES": "1"})  # noqa: S603 - of our own files


def main() -> None:
    """Make all pictures."""
    _PICTURES.mkdir(exist_ok=True)
    with tempfile.TemporaryDirectory() as folder:
        example = certificate(_ROOT / "configs" / "linear-axis" / "certificate.yaml", Path(folder, "example"))
        shutil.copyfile(example, _ROOT / "docs" / "sample-certificate.pdf")
        make("certificate-cover", example, 1)
        make("certificate-results", example, page_with(example, "Results by ISO 230-2:2014", after=1))
        make("certificate-graphs", example, page_with(example, "Results by VDI/DGQ 3441", after=1))
        first = Path(folder, "first")
        subprocess.run([_ZLMREPORT, "init", first], check=True, stdout=subprocess.DEVNULL)  # noqa: S603 - of our own files
        job = first / "job.yaml"
        make("tutorial-cover", certificate(job, first / "en"), 1)
        text = job.read_text(encoding="utf-8")
        job.write_text(text.replace("language: en ", "language: de "), encoding="utf-8")
        german = certificate(job, first / "de")
        make("tutorial-german", german, page_with(german, "Ergebnisse nach ISO 230-2:2014", after=1))
        make_of_screen("fleet-overview", overview(Path(folder, "fleet")), 1180, 1380)
    workbench()


if __name__ == "__main__":
    main()
