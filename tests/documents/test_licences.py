"""The list of licences holds what is installed, under the licences that the packages state themselves."""

from __future__ import annotations

import re
import tomllib
from collections.abc import Iterable
from importlib.metadata import PackageNotFoundError, distribution

import pytest
from packaging.requirements import Requirement

from documents.pages import DOCS, ROOT

_PAGE = (DOCS / "reference" / "licences.md").read_text(encoding="utf-8")
_ROW = re.compile(r"^\| ([a-z0-9-]+) \| ([^|]+) \|", re.MULTILINE)
_LISTED = {
    section: dict(_ROW.findall(text))
    for section, text in re.findall(r"^## (.+)\n([^#]+)", _PAGE, re.MULTILINE)
}
_RUNTIME = _LISTED["What a user installs"]
_EXTRAS = _LISTED["What an extra installs besides"]
_DEVELOPMENT = _LISTED["What developers install besides"]
_PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))

#: Words that tell a family of licences in free metadata, and in our table.
_FAMILIES = {
    "Apache": r"apache",
    "BSD": r"\b0?bsd\b",
    "GPL": r"(?<!l)gpl|gnu general public",
    "LGPL": r"lgpl|lesser general public",
    "MIT": r"\bmit\b",
    "MPL": r"\bmpl\b|mozilla public",
    "PSF": r"\bpsf\b|python software foundation",
    "Zlib": r"\bzlib\b",
    "CC0": r"\bcc0\b",
}


def _families(text: str) -> set[str]:
    return {family for family, words in _FAMILIES.items() if re.search(words, text, re.IGNORECASE)}


def _stated(name: str) -> str:
    """Return what a package states of its licence: an expression, else classifiers, else a short text."""
    metadata = distribution(name).metadata
    expression = metadata.get("License-Expression")
    classifiers = [value for value in metadata.get_all("Classifier") or [] if value.startswith("License ::")]
    return expression or " ".join(classifiers) or metadata.get("License", "").partition("\n")[0]


def _canonical(name: str) -> str:
    return re.sub(r"[-_.]+", "-", name).lower()


def _needed(requirements: Iterable[str]) -> set[str]:
    """Return the installed packages that requirements come to, with all that they require in turn."""
    found: set[str] = set()
    waiting = [(Requirement(text), "") for text in requirements]
    done: set[tuple[str, str]] = set()
    while waiting:
        requirement, extra = waiting.pop()
        if requirement.marker and not requirement.marker.evaluate({"extra": extra}):
            continue
        name = _canonical(requirement.name)
        for wanted in ("", *requirement.extras):
            if (name, wanted) not in done:
                done.add((name, wanted))
                try:
                    further = distribution(name).requires or []
                except PackageNotFoundError:
                    continue
                found.add(name)
                waiting.extend((Requirement(text), wanted) for text in further)
    return found


_NEEDED = _needed(_PROJECT["project"]["dependencies"])
_NEEDED_BY_EXTRAS = (
    _needed(each for extra in _PROJECT["project"]["optional-dependencies"].values() for each in extra)
    - _NEEDED
)
_TOOLS = [
    *_PROJECT["build-system"]["requires"],
    *(each for group in _PROJECT["dependency-groups"].values() for each in group),
]
_NEEDED_BY_DEVELOPERS = _needed(_TOOLS) - _NEEDED


@pytest.mark.parametrize("requirement", _PROJECT["project"]["dependencies"])
def test_a_dependency_is_listed(requirement: str) -> None:
    assert _canonical(Requirement(requirement).name) in _RUNTIME


@pytest.mark.parametrize("requirement", _TOOLS)
def test_a_tool_is_listed(requirement: str) -> None:
    assert _canonical(Requirement(requirement).name) in {**_RUNTIME, **_EXTRAS, **_DEVELOPMENT}


@pytest.mark.parametrize("name", sorted(_NEEDED))
def test_what_a_user_installs_is_under_the_licence_that_is_listed(name: str) -> None:
    if name in _RUNTIME:
        assert _families(_stated(name)) == _families(_RUNTIME[name])
    else:  # a later release of a dependency needs it: it must not bring another kind of licence
        assert _families(_stated(name)) & {"Apache", "BSD", "MIT", "PSF"}


@pytest.mark.parametrize("extra", _PROJECT["project"]["optional-dependencies"].values())
def test_what_an_extra_asks_for_is_listed(extra: list[str]) -> None:
    assert {_canonical(Requirement(each).name) for each in extra} <= set(_EXTRAS)


@pytest.mark.parametrize("name", sorted(_NEEDED_BY_EXTRAS & set(_EXTRAS)))
def test_what_an_extra_installs_is_under_the_licence_that_is_listed(name: str) -> None:
    if _stated(name):  # saxonche states none in its metadata
        assert _families(_stated(name)) == _families(_EXTRAS[name])


@pytest.mark.parametrize("name", sorted(_NEEDED_BY_DEVELOPERS & set(_DEVELOPMENT)))
def test_what_developers_install_is_under_the_licence_that_is_listed(name: str) -> None:
    # axe-playwright-python states none in its metadata; libcst, in the line that is read, one of three.
    assert _families(_stated(name)) <= _families(_DEVELOPMENT[name])


def test_the_list_is_in_order_and_names_nothing_twice() -> None:
    assert list(_RUNTIME) == sorted(_RUNTIME)
    assert list(_EXTRAS) == sorted(_EXTRAS)
    assert list(_DEVELOPMENT) == sorted(_DEVELOPMENT)
    assert len({*_RUNTIME, *_EXTRAS, *_DEVELOPMENT}) == len(_RUNTIME) + len(_EXTRAS) + len(_DEVELOPMENT)


def test_the_project_is_under_the_licence_that_is_stated() -> None:
    assert _PROJECT["project"]["license"] == "MIT"
    assert (ROOT / "LICENSE").read_text(encoding="utf-8").startswith("MIT License")


def test_the_licence_of_the_fonts_stands_beside_them() -> None:
    text = (ROOT / "report_templates/zlmreport_templates/fonts/OFL.txt").read_text(encoding="utf-8")
    assert "SIL OPEN FONT LICENSE Version 1.1" in text
    assert "SIL Open Font License 1.1" in _PAGE
