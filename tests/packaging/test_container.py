"""The recipes of container images: what they copy, install and run is there."""

from __future__ import annotations

import re
import shlex
import tomllib
from fnmatch import fnmatch
from pathlib import Path
from typing import Any

import pytest

from environments import ROOT
from zlmreport.cli.arguments import parse

RECIPES = (ROOT / "Containerfile", ROOT / "configs" / "fleet" / "Containerfile")
PROJECT: dict[str, Any] = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))


def instructions(recipe: Path) -> list[tuple[str, str]]:
    """Return the instructions of a recipe, each with its arguments; lines that go on are one."""
    text = re.sub(r"^#.*\n", "", recipe.read_text(encoding="utf-8"), flags=re.MULTILINE)
    lines = [line for line in text.replace("\\\n", " ").splitlines() if line.strip()]
    return [(name, arguments) for name, _, arguments in (line.partition(" ") for line in lines)]


def base(recipe: Path) -> str:
    """Return the image on which a recipe builds."""
    found = instructions(recipe)
    stated = [value.partition("=")[2] for name, value in found if name == "ARG" and value.startswith("BASE=")]
    return stated[0] if stated else next(value for name, value in found if name == "FROM")


@pytest.mark.parametrize("recipe", RECIPES, ids=str)
def test_its_python_is_one_that_the_program_runs_on(recipe: Path) -> None:
    version = re.search(r"python:(\d+)\.(\d+)-", base(recipe))
    least = re.fullmatch(r">=(\d+)\.(\d+)", PROJECT["project"]["requires-python"])
    assert version
    assert least
    assert tuple(map(int, version.groups())) >= tuple(map(int, least.groups()))
    assert f"Programming Language :: Python :: {version[1]}.{version[2]}" in PROJECT["project"]["classifiers"]


def test_the_recipes_and_the_page_on_them_name_one_base() -> None:
    (name,) = {base(recipe) for recipe in RECIPES}
    page = (ROOT / "docs" / "how-to" / "run-in-a-container.md").read_text(encoding="utf-8")
    assert name.rpartition("/")[2] in page


@pytest.mark.parametrize("recipe", RECIPES, ids=str)
def test_it_installs_extras_and_libraries_that_there_are(recipe: Path) -> None:
    text = recipe.read_text(encoding="utf-8")
    stated = re.search(r"EXTRAS=([\w,]+)|/src\[([\w,]+)\]", text)
    assert stated
    extras = set((stated[1] or stated[2]).split(","))
    assert extras <= PROJECT["project"]["optional-dependencies"].keys()
    libraries = set(re.findall(r"\blibpango[\w.-]+", text))
    assert libraries == set(re.findall(r'"(libpango[\w.-]+-0)"', (ROOT / "run").read_text(encoding="utf-8")))


@pytest.mark.parametrize("recipe", RECIPES, ids=str)
def test_what_it_runs_is_a_command_of_the_program(recipe: Path) -> None:
    found = dict(instructions(recipe))
    (command,) = shlex.split(found["ENTRYPOINT"].strip("[]").replace(",", " "))
    assert Path(command).name in PROJECT["project"]["scripts"]
    words = shlex.split(found.get("CMD", '["job.yaml"]').strip("[]").replace(",", " "))
    parse(words)


def test_what_is_copied_is_all_that_the_package_is_built_of() -> None:
    rules = [line for line in (ROOT / ".dockerignore").read_text("utf-8").splitlines() if line[:1] != "#"]
    kept = [rule[1:] for rule in rules if rule.startswith("!")]
    assert [rule for rule in kept if not (ROOT / rule).exists()] == []
    project, built = PROJECT["project"], PROJECT["tool"]["hatch"]["build"]["targets"]["wheel"]
    needed = ["pyproject.toml", project["readme"], *project["license-files"], *built["packages"]]
    needed += [*built["shared-data"], *built["sbom-files"]]
    lacking = [
        each
        for each in needed
        if not any(fnmatch(each, rule) or Path(each).is_relative_to(rule) for rule in kept)
    ]
    assert lacking == []
