"""The import contracts hold for every room: one that is new stands in those that list the rooms."""

from __future__ import annotations

import tomllib
from pathlib import Path

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
