"""What is in the files that users download."""

from __future__ import annotations

import ast
import json
import pkgutil
import re
import sys
import tarfile
import tomllib
import zipfile
from collections.abc import Iterable, Iterator
from importlib.metadata import PackageNotFoundError, distribution, packages_distributions, requires
from itertools import chain
from pathlib import Path
from typing import Any

import pytest

import zlmreport_plugins.controllers.on_paper
import zlmreport_plugins.effects
import zlmreport_plugins.instruments
import zlmreport_plugins.renderers
import zlmreport_plugins.sources
import zlmreport_plugins.standards
from environments import HOUSE_STANDARD, ROOT, Distribution

#: Packages of the project's own wheel.
OWN = {"zlmreport", "zlmreport_plugins", "zlmreport_step_gauge", "zlmreport_templates"}
#: Imported inside functions, where the user is told what to install: for tests of PDF renderers.
OPTIONAL = {"pypdf"}


@pytest.fixture(scope="module")
def metadata() -> dict[str, Any]:
    return tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]


@pytest.fixture(scope="module")
def in_wheel(zlmreport_distribution: Distribution) -> set[str]:
    with zipfile.ZipFile(zlmreport_distribution.wheel) as wheel:
        return set(wheel.namelist())


@pytest.fixture(scope="module")
def in_sdist(zlmreport_distribution: Distribution) -> set[str]:
    with tarfile.open(zlmreport_distribution.sdist) as sdist:
        return {name.partition("/")[2] for name in sdist.getnames()}


def files(folder: Path, *suffixes: str) -> Iterator[str]:
    """Yield the files under a folder, as a wheel names them."""
    for path in folder.rglob("*"):
        name = path.relative_to(folder.parent)
        made_by_tools = any(part == "__pycache__" or part.startswith(".") for part in name.parts)
        if path.is_file() and not made_by_tools and (not suffixes or path.suffix in suffixes):
            yield name.as_posix()


@pytest.mark.parametrize(
    "package",
    ["src/zlmreport", "plugins/zlmreport_plugins", "report_templates/zlmreport_templates"],
)
def test_the_wheel_holds_every_file_of_its_packages(package: str, in_wheel: set[str]) -> None:
    assert set(files(ROOT / package)) <= in_wheel


@pytest.mark.parametrize(
    "suffix", [".html", ".css", ".woff2", ".txt"], ids=["templates", "styles", "fonts", "fonts' licence"]
)
def test_the_wheel_holds_what_pages_are_made_of(suffix: str, in_wheel: set[str]) -> None:
    assert [name for name in in_wheel if name.startswith("zlmreport_templates/") and name.endswith(suffix)]


def test_the_wheel_tells_type_checkers_that_it_is_typed(in_wheel: set[str]) -> None:
    assert {"zlmreport/py.typed", "zlmreport_plugins/py.typed"} <= in_wheel


def test_the_wheel_holds_nothing_else_but_a_manual_page(in_wheel: set[str]) -> None:
    manual = {name for name in in_wheel if name.endswith(".data/data/share/man/man1/zlmreport.1")}
    assert len(manual) == 1
    roots = {name.partition("/")[0] for name in in_wheel - manual}
    others = {root for root in roots if not root.endswith(".dist-info")}
    assert others == {"zlmreport", "zlmreport_plugins", "zlmreport_step_gauge", "zlmreport_templates"}


def test_the_wheel_holds_a_bill_of_what_it_runs_on(
    zlmreport_distribution: Distribution, metadata: dict[str, Any]
) -> None:
    with zipfile.ZipFile(zlmreport_distribution.wheel) as wheel:
        (name,) = (each for each in wheel.namelist() if ".dist-info/sboms/" in each)
        bill = json.loads(wheel.read(name))
    assert (bill["bomFormat"], bill["specVersion"], bill["version"]) == ("CycloneDX", "1.7", 1)
    own = bill["metadata"]["component"]
    assert zlmreport_distribution.wheel.name.startswith(f"{own['name']}-{own['version']}-")
    assert {each["name"] for each in bill["components"]} == names_of(metadata["dependencies"])
    assert bill["dependencies"] == [
        {"ref": own["bom-ref"], "dependsOn": [each["bom-ref"] for each in bill["components"]]}
    ]


def test_the_bill_states_ranges_and_invents_no_version(metadata: dict[str, Any]) -> None:
    bill = json.loads((ROOT / "docs/reference/zlmreport.cdx.json").read_text(encoding="utf-8"))
    for component, requirement in zip(bill["components"], metadata["dependencies"], strict=True):
        assert component["type"] == "library"
        assert component["isExternal"] is True  # without it no range may stand there
        assert "version" not in component
        assert component["purl"] == f"pkg:pypi/{component['name']}"
        least = re.search(r"[\d.]+\d", requirement)
        assert least
        assert component["versionRange"].startswith(f"vers:pypi/>={least[0]}")
        assert component["licenses"]


@pytest.mark.parametrize(
    "folder", ["tests", "configs", "docs", "benchmarks", "plugins/zlmreport-house-standard"]
)
def test_the_sources_hold_what_a_packager_runs_and_reads(folder: str, in_sdist: set[str]) -> None:
    inside = files(ROOT / folder, ".py", ".md", ".yaml", ".csv")
    present = {f"{folder}/{name.partition('/')[2]}" for name in inside}
    assert present
    assert present <= in_sdist


def test_every_built_in_plugin_is_declared_by_entry_points(metadata: dict[str, Any]) -> None:
    kinds = [
        zlmreport_plugins.controllers,
        zlmreport_plugins.effects,
        zlmreport_plugins.instruments,
        zlmreport_plugins.renderers,
        zlmreport_plugins.sources,
        zlmreport_plugins.standards,
    ]
    present = {
        f"{kind.__name__}.{module.name}" for kind in kinds for module in pkgutil.iter_modules(kind.__path__)
    }
    present |= {f"zlmreport_step_gauge.{name}" for name in ("extension", "effects", "paths.programs")}
    # apart from the values that they are tables of: who writes these needs no XML
    present.add("zlmreport_plugins.renderers.json_results.tables")
    catalogues = Path(zlmreport_plugins.effects.__file__).parent.glob("*.yaml")
    present |= {
        f"zlmreport_plugins.effects:{each.stem}" for each in catalogues if each.stem != "measurements"
    }
    # a module for each maker, beside what they share
    untried = zlmreport_plugins.controllers.on_paper
    present.remove(untried.__name__)
    present |= {
        f"{untried.__name__}.{module.name}"
        for module in pkgutil.iter_modules(untried.__path__)
        if module.name not in {"formats", "counted_rows"}
    }
    # one plugin each: their pages share phrases and are declared together
    present |= {f"zlmreport_plugins.{name}" for name in ("circle_effects", "notifiers", "part_programs")}
    declared = {module for group in metadata["entry-points"].values() for module in group.values()}
    assert present == declared, (
        f"not declared in pyproject.toml: {sorted(present - declared)}; "
        f"declared, but not there: {sorted(declared - present)}"
    )


def test_the_installed_entry_points_are_those_of_this_tree(metadata: dict[str, Any]) -> None:
    installed = {
        group: {each.name: each.value for each in distribution("zlmreport").entry_points.select(group=group)}
        for group in metadata["entry-points"]
    }
    assert installed == metadata["entry-points"], "entry points are metadata: install again"


@pytest.mark.long
@pytest.mark.parametrize(
    ("project", "roots"),
    [(ROOT, ["src", "plugins/zlmreport_plugins", "plugins/zlmreport_step_gauge"]), (HOUSE_STANDARD, ["src"])],
    ids=["zlmreport", "house standard"],
)
def test_every_library_that_is_imported_comes_with_the_dependencies(project: Path, roots: list[str]) -> None:
    declared = tomllib.loads((project / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    extras = chain(*declared.get("optional-dependencies", {}).values())
    lacking = undeclared([project / root for root in roots], [*declared["dependencies"], *extras]) - OPTIONAL
    assert not lacking, f"imported, but no dependency in {project.name}'s pyproject.toml: {lacking}"


def test_every_library_that_development_imports_comes_with_the_group_test() -> None:
    declared = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))
    available = declared["project"]["dependencies"] + declared["dependency-groups"]["test"]
    folders = [ROOT / folder for folder in ("tests", "benchmarks", "docs/generate")]
    lacking = undeclared(folders, available) - {"mkdocs"}  # of the group docs: one hook needs it
    lacking -= {"sklearn"}  # one of the other ways that a benchmark compares with, where it is installed
    lacking -= {"hal", "linuxcnc"}  # of the control itself, whose own Python runs what imports them
    assert not lacking, f"imported, but not in the dependency group 'test': {lacking}"


def brought_by(name: str) -> list[str]:
    """Return what a library requires; nothing of one of an extra that is not installed here."""
    try:
        return requires(name) or []
    except PackageNotFoundError:
        return []


def undeclared(roots: list[Path], requirements: list[str]) -> set[str]:
    """Return the libraries imported that neither are requirements nor come with one."""
    declared = names_of(requirements)
    installed = declared.union(*(names_of(brought_by(each)) for each in declared))
    own = {path.stem for root in roots for path in root.iterdir()} | OWN
    distributions = packages_distributions()
    return {
        name
        for name in imported(roots) - own - sys.stdlib_module_names
        if installed.isdisjoint(names_of(distributions.get(name, [name])))
    }


def names_of(requirements: Iterable[str]) -> set[str]:
    """Return the names in requirements without an extra, in one spelling."""
    named = (re.match(r"[\w.-]+", each) for each in requirements if "extra ==" not in each)
    return {re.sub(r"[-_.]+", "-", each[0]).lower() for each in named if each}


def imported(roots: Iterable[Path]) -> set[str]:
    """Return the top-level names of all absolute imports."""
    names = set()
    for path in (path for root in roots for path in root.rglob("*.py")):
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if isinstance(node, ast.Import):
                names |= {alias.name.partition(".")[0] for alias in node.names}
            elif isinstance(node, ast.ImportFrom) and node.module and not node.level:
                names.add(node.module.partition(".")[0])
    return names
