"""Links lead somewhere, pictures are there, and the map knows every page."""

from __future__ import annotations

import re
import tomllib
from pathlib import Path

import pytest

import zlmreport
from documents.pages import DOCS, ROOT, anchors, links, name, pages

_LARGEST_PICTURE = 250_000
_MACHINE_PATH = re.compile(r"(?<![\w.~-])/(?:work|home|root|tmp|Users|mnt|srv)/|[A-Z]:\\\\")


def _inside(page: Path) -> list[tuple[str, Path, str]]:
    """Return the links of a page into the project: as written, the file, the anchor."""
    found = []
    for link in links(page):
        if not re.match(r"[a-z]+:", link):
            path, _, anchor = link.partition("#")
            found.append((link, (page.parent / path).resolve() if path else page, anchor))
    return found


@pytest.mark.parametrize("page", pages(), ids=name)
def test_links_lead_to_files_and_headings(page: Path) -> None:
    broken = [
        link
        for link, target, anchor in _inside(page)
        if not target.exists() or (anchor and anchor not in anchors(target))
    ]
    assert not broken


@pytest.mark.parametrize("page", pages(), ids=name)
def test_links_stay_inside_the_project(page: Path) -> None:
    assert [link for link, target, _ in _inside(page) if not target.is_relative_to(ROOT)] == []


@pytest.mark.parametrize("page", pages(), ids=name)
def test_no_page_knows_a_machine(page: Path) -> None:
    assert _MACHINE_PATH.findall(page.read_text(encoding="utf-8")) == []


@pytest.mark.parametrize("page", pages(), ids=name)
def test_a_page_begins_with_its_only_title(page: Path) -> None:
    text = re.sub(r"```.*?```", "", page.read_text(encoding="utf-8"), flags=re.DOTALL)
    titles = re.findall(r"^# .+$", text, re.MULTILINE)
    assert len(titles) == 1
    assert page == ROOT / "README.md" or text.startswith(titles[0])


def test_the_map_leads_to_every_page() -> None:
    mapped = {target for _, target, _ in _inside(DOCS / "README.md")}
    assert set(DOCS.rglob("*.md")) - mapped - {DOCS / "README.md"} == set()


def test_pictures_are_shown_and_small() -> None:
    suffixes = {".png", ".svg"}
    shown = {target for page in pages() for _, target, _ in _inside(page) if target.suffix in suffixes}
    assert shown == set(DOCS.glob("images/*"))
    assert all(picture.stat().st_size < _LARGEST_PICTURE for picture in shown)


def test_the_changelog_speaks_of_this_version() -> None:
    assert re.search(
        rf"^## .*{re.escape(zlmreport.__version__)}", (ROOT / "CHANGELOG.md").read_text(), re.MULTILINE
    )


def test_the_page_on_the_architecture_has_every_room_in_the_order_of_the_floors() -> None:
    rooms = re.findall(
        r"^\| `(\w+)(?:/|\.py)` \|", (DOCS / "architecture.md").read_text("utf-8"), re.MULTILINE
    )
    house = Path(zlmreport.__file__).parent
    there = {path.parent.name for path in house.glob("*/__init__.py")} | {
        path.stem for path in house.glob("*.py")
    }
    assert set(rooms) == there - {"__init__", "__main__", "version"}
    contracts = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))["tool"]["importlinter"][
        "contracts"
    ]
    floors = [set(floor.split(" | ")) for floor in contracts[0]["layers"]]
    floor_of = [next(number for number, floor in enumerate(floors) if room in floor) for room in rooms]
    assert floor_of == sorted(floor_of)


def test_every_place_that_the_page_on_the_architecture_sends_to_is_there() -> None:
    text = (DOCS / "architecture.md").read_text("utf-8")
    rows = re.findall(
        r"^\| .* \|$", text.partition("## Where to look")[2].partition("\n## ")[0], re.MULTILINE
    )[2:]
    places = [re.findall(r"`([^`]+/[^`]*)`", row.rpartition(" | ")[2]) for row in rows]
    assert len(rows) >= 20
    assert all(places)
    assert not [place for each in places for place in each if not (ROOT / place).exists()]


def test_every_module_that_the_page_on_the_architecture_names_beside_a_place_is_there() -> None:
    text = (DOCS / "architecture.md").read_text("utf-8")
    rows = text.partition("## Where to look")[2].partition("\n## ")[0].splitlines()
    named = 0
    for row in rows:
        places = [ROOT / each for each in re.findall(r"`([^`]+/[^`]*)`", row)]
        folders = [each if each.is_dir() else each.parent for each in places]
        for module in re.findall(r"`(\w+\.(?:py|js|css|yaml))`", row):
            named += 1
            assert any(next(each.rglob(module), None) for each in folders), f"{module} in: {row}"
    assert named > 100


def test_the_page_of_modules_has_every_module() -> None:
    page = (DOCS / "reference" / "modules.md").read_text("utf-8")
    names = re.findall(r"^\| `([^`]+)` \|", page, re.MULTILINE)
    listed = {f"{name}__init__.py" if name.endswith("/") else name for name in names}
    folders = [
        ROOT / name for name in ("src/zlmreport", "plugins/zlmreport_plugins", "plugins/zlmreport_step_gauge")
    ]
    modules = {path.relative_to(folder).as_posix() for folder in folders for path in folder.rglob("*.py")}
    assert modules - listed == set()
