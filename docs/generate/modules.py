"""Every module in a line, room by room: the first sentence that each file says of itself."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator, Mapping
from functools import cache
from pathlib import Path

from markdown import code, table

_ROOT = Path(__file__).parents[2]
_CORE = _ROOT / "src" / "zlmreport"
_TYPESETTING = _CORE / "document" / "typesetting"
_ROOM = re.compile(r"^\| `(\w+/|\w+\.py)` \|", re.MULTILINE)
_BESIDE = "Beside the rooms"
_FOLDERS = (
    "plugins/zlmreport_plugins",
    "plugins/zlmreport_step_gauge",
    "plugins/zlmreport-house-standard",
    "report_templates/zlmreport_templates",
    "docs/generate",
    "benchmarks",
)
_DOCSTRING = re.compile(r'"""(.+?)(?:"""|\n)')
_HASHES = re.compile(r"((?:# .+\n)+)")
_SLASHES = re.compile(r'(?:"use strict";\n)?((?:// .+\n)+)')
#: Where a file says what it is, by the end of its name: a docstring, a comment at its head, a description.
_SAID: Mapping[str, re.Pattern[str]] = {
    ".css": re.compile(r"/\* (.+?) ?\*/", re.DOTALL),
    ".html": re.compile(r"\{# (.+?) #\}"),
    ".js": _SLASHES,
    ".po": _HASHES,
    ".py": _DOCSTRING,
    ".py.txt": _DOCSTRING,
    ".schema.json": re.compile(r'.*?"description": "(.+?)"', re.DOTALL),
    ".typ": _SLASHES,
    ".yaml": _HASHES,
    ".yaml.txt": _HASHES,
}
_MARK = re.compile(r"^(?:#|//) ", re.MULTILINE)
_SENTENCE = re.compile(r".+?\.(?= |$)")


def text() -> str:
    """Return a table of files for each room, for what stands beside the rooms, and for each other folder."""
    rooms = _ROOM.findall((_ROOT / "docs" / "architecture.md").read_text(encoding="utf-8"))
    sections: dict[str, list[tuple[str, str]]] = {title: [] for title in (*rooms, _BESIDE, *_FOLDERS)}
    for name, sentence in _list_files(_CORE, _CORE):
        first, slash, _ = name.partition("/")
        sections.get(f"{first}{slash}", sections[_BESIDE]).append((code(name), sentence))
    for folder in _FOLDERS:
        sections[folder] = [(code(name), said) for name, said in _list_files(_ROOT / folder, _ROOT / folder)]
    return "\n\n".join(
        f"## {title if title == _BESIDE else code(title)}\n\n{table(('Module', 'What is in it'), rows)}"
        for title, rows in sections.items()
    )


def _list_files(folder: Path, root: Path) -> Iterator[tuple[str, str]]:
    """Yield the path below a root, and the sentence, of each file of a folder that says what it is.

    A package whose `__init__.py` defines nothing goes by the name of its folder.
    """
    for path in sorted(folder.rglob("*")):
        sentence = _find_sentence(path)
        if sentence:
            below = path.relative_to(root)
            names_folder = path.name == "__init__.py" and below.parts[:-1] and not _defines(path)
            yield f"{below.parent.as_posix()}/" if names_folder else below.as_posix(), sentence


def _find_sentence(path: Path) -> str:
    """Return the first sentence that a file says of itself; empty where it says none."""
    pattern = next((pattern for end, pattern in _SAID.items() if path.name.endswith(end)), None)
    if pattern is None:
        return ""
    match = pattern.match(path.read_text(encoding="utf-8"))
    if match is None:
        return _list_templates().get(path.name, "")
    if pattern is _DOCSTRING:
        return _in_markdown(match[1])
    said = " ".join(_MARK.sub("", match[1]).split())
    return _in_markdown((_SENTENCE.match(said) or [said])[0])


def _defines(module: Path) -> bool:
    """Return whether a module defines a function or a class."""
    body = ast.parse(module.read_text(encoding="utf-8")).body
    return any(isinstance(node, ast.FunctionDef | ast.ClassDef) for node in body)


@cache
def _list_templates() -> Mapping[str, str]:
    """Return what each template is: the first line on the class of what it is given."""
    return {
        node.value.value: (ast.get_docstring(each) or "").partition("\n")[0]
        for module in sorted(_TYPESETTING.glob("*.py"))
        for each in ast.parse(module.read_text(encoding="utf-8")).body
        if isinstance(each, ast.ClassDef)
        for node in each.body
        if isinstance(node, ast.Assign)
        and ast.unparse(node.targets[0]) == "template"
        and isinstance(node.value, ast.Constant)
    }


def _in_markdown(said: str) -> str:
    return said.replace("``", "`")
