"""No module needs for its import what only some systems have: certificates are made on Windows too."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from environments import ROOT

ONLY_ON_POSIX = {"fcntl", "grp", "pty", "pwd", "resource", "syslog", "termios", "tty"}
FOLDERS = ("src", "plugins", "report_templates")


def _imported_at_once(tree: ast.AST) -> Iterator[str]:
    """Yield the names of modules that an import of this one imports."""
    for node in ast.iter_child_nodes(tree):
        if isinstance(node, ast.Import):
            yield from (each.name for each in node.names)
        elif isinstance(node, ast.ImportFrom):
            yield node.module or ""
        elif not isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef):
            yield from _imported_at_once(node)


def test_what_only_some_systems_have_is_imported_where_it_is_used() -> None:
    paths = [path for folder in FOLDERS for path in (ROOT / folder).rglob("*.py")]
    assert len(paths) > 300
    found = {
        path.relative_to(ROOT).as_posix(): names
        for path in paths
        if (names := ONLY_ON_POSIX & set(_imported_at_once(ast.parse(path.read_text(encoding="utf-8")))))
    }
    assert found == {}


def test_an_import_at_the_top_would_be_found() -> None:
    for text in ("import fcntl", "if True:\n    from termios import TCSANOW", "class A:\n    import tty"):
        assert ONLY_ON_POSIX & set(_imported_at_once(ast.parse(text)))
    assert not set(_imported_at_once(ast.parse("def f():\n    import fcntl")))
