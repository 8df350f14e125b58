"""The generated parts of the pages are what the code says today."""

from __future__ import annotations

import difflib
import re
import shutil
from pathlib import Path

import pytest

from documents.pages import DOCS, name, pages
from processes import PYTHON, run

_PART = re.compile(r"<!-- generated: ([a-z0-9-]+) -->")
_END = re.compile(r"<!-- end: ([a-z0-9-]+) -->")
_GENERATED = [page for page in pages() if _PART.search(page.read_text(encoding="utf-8"))]


@pytest.fixture(scope="module")
def regenerated(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return a copy of the documentation in which the generated parts are written anew."""
    folder = tmp_path_factory.mktemp("regenerated") / "docs"
    shutil.copytree(DOCS, folder, ignore=shutil.ignore_patterns("__pycache__", "*.png"))
    done = run(PYTHON, DOCS / "generate", folder)
    assert done.returncode == 0, done.stderr
    return folder


@pytest.mark.parametrize("page", _GENERATED, ids=name)
def test_a_page_is_up_to_date(page: Path, regenerated: Path) -> None:
    stands = page.read_text(encoding="utf-8").splitlines()
    should = (regenerated / page.relative_to(DOCS)).read_text(encoding="utf-8").splitlines()
    difference = "\n".join(
        difflib.unified_diff(stands, should, "as it stands", "as it should be", lineterm="", n=0)
    )
    assert not difference, f"{name(page)}: run 'python docs/generate'\n{difference}"


@pytest.mark.parametrize("picture", sorted(DOCS.glob("images/*.svg")), ids=lambda picture: picture.stem)
def test_a_picture_shows_what_is_generated(picture: Path, regenerated: Path) -> None:
    """Compare what is drawn and not where: places may differ in a last digit."""
    both = picture, regenerated / "images" / picture.name
    stands, should = (path.read_text(encoding="utf-8") for path in both)
    for drawn in (r'aria-label="[^"]*"', r">([^<>]+)</tspan>", r'class="reading"'):
        assert re.findall(drawn, stands) == re.findall(drawn, should)


@pytest.mark.parametrize("page", _GENERATED, ids=name)
def test_every_generated_part_has_an_end(page: Path) -> None:
    text = page.read_text(encoding="utf-8")
    assert _PART.findall(text) == _END.findall(text)


def test_every_part_that_can_be_generated_stands_in_a_page() -> None:
    source = (DOCS / "generate" / "__main__.py").read_text(encoding="utf-8")
    known = set(re.findall(r'^    "([a-z0-9-]+)": ', source, re.MULTILINE))
    assert known == {part for page in _GENERATED for part in _PART.findall(page.read_text(encoding="utf-8"))}


@pytest.mark.parametrize("file", ["job.schema.json", "zlmreport.1", "zlmreport.cdx.json"])
def test_a_generated_file_is_up_to_date(file: str, regenerated: Path) -> None:
    stands, should = (folder / "reference" / file for folder in (DOCS, regenerated))
    assert stands.read_text(encoding="utf-8") == should.read_text(encoding="utf-8")
