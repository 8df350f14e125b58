"""The page on architecture has every room, and every module that reads a clock."""

from __future__ import annotations

import ast
import re
import tomllib
from pathlib import Path

from documents.pages import ROOT

_ROOT = Path(__file__).parents[2]
#: The door has the boundary; a kit asks it what it would say of a plugin.
_KNOWS_THE_BOUNDARY = {"plugin", "testing"}


def test_every_room_gets_objects_of_plugins_from_the_registry() -> None:
    settings = tomllib.loads((_ROOT / "pyproject.toml").read_text(encoding="utf-8"))
    (contract,) = (
        each
        for each in settings["tool"]["importlinter"]["contracts"]
        if each["name"] == "Objects of plugins come from the registry, behind the boundary"
    )
    held = {name.split(".")[1] for name in contract["source_modules"] if name.startswith("zlmreport.")}
    house = _ROOT / "src" / "zlmreport"
    rooms = {each.stem for each in house.iterdir() if each.suffix == ".py" or (each / "__init__.py").exists()}
    assert rooms - held - {"__init__"} <= _KNOWS_THE_BOUNDARY


#: What reads a clock, as it is called.
_READ = {
    *("monotonic", "time", "now", "today", "utcnow", "perf_counter", "process_time", "time_ns"),
    "clock_gettime",
}
_OF = {"time", "dt", "datetime", "date"}


def _reads_a_clock(module: Path) -> bool:
    for node in ast.walk(ast.parse(module.read_bytes())):
        # called, or handed on to who calls it
        if isinstance(node, ast.Attribute) and node.attr in _READ:
            holder = ast.unparse(node.value).split(".")
            if holder[0] in _OF and holder[-1] in _OF:
                return True
    return False


def test_who_reads_a_clock_is_listed_and_nobody_else() -> None:
    modules = [*ROOT.glob("src/**/*.py"), *ROOT.glob("plugins/zlmreport_*/**/*.py")]
    reading = {path.relative_to(ROOT).as_posix() for path in modules if _reads_a_clock(path)}
    page = (ROOT / "docs/architecture.md").read_text(encoding="utf-8")
    listed = set(re.findall(r"`((?:src|plugins)/\S+\.py)`", page.partition("## Who reads a clock")[2]))
    assert reading == listed
