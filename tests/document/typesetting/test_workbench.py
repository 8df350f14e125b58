"""The files of a page are a list; what a page loads is on it."""

from __future__ import annotations

import re

import pytest

from zlmreport.document.typesetting.resources import find_page_file, read_page_files

_IMPORT = re.compile(r'from "\./([\w.]+)"')
_URL = re.compile(r"url\(([^)]+)\)")


def test_everything_that_a_page_loads_is_there() -> None:
    named = {"workbench.js", "tokens.css", "workbench.css", "graphs.css", "faces.css", "icon.svg"}
    for name, file in read_page_files().items():
        if name.endswith((".js", ".css")):
            named.update((_IMPORT if name.endswith(".js") else _URL).findall(file.content.decode()))
    assert named == set(read_page_files())


@pytest.mark.parametrize("name", ["", ".", "..", "../templates/document.html", "/etc/passwd", "__init__.py"])
def test_nothing_else_is_handed_out(name: str) -> None:
    assert find_page_file(name) is None


def test_scripts_turn_no_text_into_markup_or_program() -> None:
    scripts = "".join(
        file.content.decode() for name, file in read_page_files().items() if name.endswith(".js")
    )
    for word in (
        "innerHTML",
        "outerHTML",
        "insertAdjacentHTML",
        "document.write",
        "eval(",
        "new Function",
        ".style",
    ):
        assert word not in scripts


def test_every_media_type_is_one_that_browsers_take() -> None:
    assert {file.media_type for file in read_page_files().values()} == {
        "text/css",
        "text/javascript",
        "image/svg+xml",
        "font/woff2",
    }
