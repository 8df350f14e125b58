"""The picture of the house: its rooms floor by floor, and which room uses which, read from the imports."""

from __future__ import annotations

import ast
from collections.abc import Iterator, Mapping
from functools import cache
from html import escape
from pathlib import Path

_SOURCE = Path(__file__).parents[2] / "src" / "zlmreport"
_PACKAGE = "zlmreport"
#: No rooms: what starts the program, and data.
_LEFT_OUT = frozenset({"__init__", "__main__", "version", "skeletons", "starter"})
_WIDTH, _HEIGHT, _LINE, _BETWEEN, _APART, _EDGE = 150, 34, 13, 34, 14, 8
_NAME, _INSIDE = 15, 11
_Box = tuple[float, float, float]  # left, top and height
_LETTER = 0.56  # em: a mean advance, for lines that end in time


def pictures() -> dict[str, str]:
    """Return the picture by the name of its file."""
    return {"rooms.svg": _picture(_uses(), _rooms())}


def _rooms() -> dict[str, tuple[str, ...]]:
    """Return the rooms, each with the rooms inside."""
    found: dict[str, tuple[str, ...]] = {}
    for path in sorted(_SOURCE.iterdir()):
        if path.stem in _LEFT_OUT or path.name.startswith("__"):
            continue
        if path.suffix == ".py":
            found[path.name] = ()
        elif (path / "__init__.py").exists():
            inside = (each.name for each in sorted(path.iterdir()) if (each / "__init__.py").exists())
            found[f"{path.name}/"] = tuple(inside)
    return found


def _uses() -> dict[str, frozenset[str]]:
    """Return for each room those whose modules its own import, itself left out."""
    rooms = _rooms()
    by_stem = {room.removesuffix("/").removesuffix(".py"): room for room in rooms}
    uses: dict[str, set[str]] = {room: set() for room in rooms}
    for path in _SOURCE.rglob("*.py"):
        own = by_stem.get(path.relative_to(_SOURCE).parts[0].removesuffix(".py"))
        if own:
            uses[own] |= {by_stem[each] for each in _imported(path) if each in by_stem} - {own}
    return {room: frozenset(used) for room, used in uses.items()}


def _imported(path: Path) -> Iterator[str]:
    """Yield the first names below the package of what a module imports, but for types alone."""
    tree = ast.parse(path.read_text(encoding="utf-8"))
    blocks = (each for each in ast.walk(tree) if isinstance(each, ast.If))
    of_types = {inner for each in blocks if ast.unparse(each.test) == "TYPE_CHECKING" for inner in each.body}
    for node in ast.walk(tree):
        if node in of_types or not isinstance(node, ast.ImportFrom) or not node.module:
            continue
        if node.module.split(".")[0] == _PACKAGE:
            below = node.module.split(".")[1:]
            yield from below[:1] or (each.name for each in node.names)


def _picture(uses: Mapping[str, frozenset[str]], rooms: Mapping[str, tuple[str, ...]]) -> str:
    @cache
    def floor(room: str) -> int:
        return 1 + max(map(floor, uses[room]), default=-1)

    @cache
    def below(room: str) -> frozenset[str]:
        return uses[room].union(*map(below, uses[room]))

    #: What is used through others is no line of its own.
    direct = {room: used.difference(*map(below, used)) for room, used in uses.items()}
    floors = [
        [room for room in rooms if floor(room) == number] for number in range(max(map(floor, rooms)) + 1)
    ]
    lines = {room: list(_wrapped(inside)) for room, inside in rooms.items()}
    widest = max(map(len, floors))
    width = widest * (_WIDTH + _APART) + _APART
    at: dict[str, _Box] = {}
    y = float(_EDGE)
    for each in reversed(floors):
        left = (width - len(each) * (_WIDTH + _APART) + _APART) / 2
        for number, room in enumerate(each):
            at[room] = (left + number * (_WIDTH + _APART), y, _HEIGHT + _LINE * len(lines[room]))
        y += max(at[room][2] for room in each) + _BETWEEN
    drawn = [
        *(line for room in rooms for used in sorted(direct[room]) for line in _line(at[room], at[used])),
        *(line for room in rooms for line in _box(room, lines[room], at[room])),
    ]
    said = "; ".join(f"{room} uses {', '.join(sorted(direct[room]))}" for room in rooms if direct[room])
    head = (
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {y - _BETWEEN + _EDGE:g}" '
        f'role="img" aria-label="{escape(said)}" font-family="sans-serif" text-anchor="middle">'
    )
    return "\n".join((head, *drawn, "</svg>\n"))


def _wrapped(names: tuple[str, ...]) -> Iterator[str]:
    """Yield names in lines that a box has room for."""
    line = ""
    for name in names:
        longer = f"{line} · {name}" if line else name
        if line and len(longer) * _LETTER * _INSIDE > _WIDTH:
            yield line
            longer = name
        line = longer
    if line:
        yield line


def _line(upper: _Box, lower: _Box) -> Iterator[str]:
    x1, y1 = upper[0] + _WIDTH / 2, upper[1] + upper[2]
    x2, y2 = lower[0] + _WIDTH / 2, lower[1]
    curve = f"M{x1:g} {y1:g}C{x1:g} {y1 + _BETWEEN:g} {x2:g} {y2 - _BETWEEN:g} {x2:g} {y2:g}"
    yield f'<path d="{curve}" fill="none" stroke="#7a8c96"/>'


def _box(room: str, inside: list[str], at: _Box) -> Iterator[str]:
    x, y, height = at
    size = f'width="{_WIDTH}" height="{height:g}" rx="5"'
    yield f'<rect x="{x:g}" y="{y:g}" {size} fill="#eef3f5" stroke="#0d4a63"/>'
    yield _text(room, x + _WIDTH / 2, y + 22, f'font-size="{_NAME}" fill="#0d4a63"')
    for number, line in enumerate(inside):
        down = _HEIGHT + 4 + _LINE * number
        yield _text(line, x + _WIDTH / 2, y + down, f'font-size="{_INSIDE}" fill="#333"')


def _text(text: str, x: float, y: float, look: str) -> str:
    return f'<text x="{x:g}" y="{y:g}" {look}><tspan>{escape(text)}</tspan></text>'
