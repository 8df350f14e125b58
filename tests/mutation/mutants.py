"""Mutants of a module: each says one thing else than the source."""

from __future__ import annotations

import ast
import copy
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

_TURNED: dict[type[ast.cmpop], type[ast.cmpop]] = {
    ast.Lt: ast.GtE,
    ast.GtE: ast.Lt,
    ast.Gt: ast.LtE,
    ast.LtE: ast.Gt,
    ast.Eq: ast.NotEq,
    ast.NotEq: ast.Eq,
    ast.In: ast.NotIn,
    ast.NotIn: ast.In,
    ast.Is: ast.IsNot,
    ast.IsNot: ast.Is,
}
_MOVED: dict[type[ast.cmpop], type[ast.cmpop]] = {
    ast.Lt: ast.LtE,
    ast.LtE: ast.Lt,
    ast.Gt: ast.GtE,
    ast.GtE: ast.Gt,
}


@dataclass(frozen=True)
class Mutant:
    """A changed module."""

    path: Path
    line: int
    before: str
    after: str
    source: str

    def __str__(self) -> str:
        return f"{self.path.name}:{self.line}: {self.before}  →  {self.after}"


def mutants(path: Path) -> Iterator[Mutant]:
    """Yield every mutant of a module, in the order of its source."""
    tree = ast.parse(path.read_text(encoding="utf-8"))
    for parent, field, place, node in _nodes(tree):
        for changed in _changes(node):
            _put(parent, field, place, changed)
            yield Mutant(path, node.lineno, _said(node), _said(changed), ast.unparse(tree))
            _put(parent, field, place, node)


def _nodes(parent: ast.AST) -> Iterator[tuple[ast.AST, str, int | None, ast.expr | ast.stmt]]:
    """Yield what can be changed, with where it hangs; nothing of decorators and annotations."""
    for field, value in ast.iter_fields(parent):
        if field in {"decorator_list", "annotation", "returns", "type_params"}:
            continue
        for place, node in enumerate(value if isinstance(value, list) else [value]):
            if isinstance(node, ast.expr | ast.stmt):
                yield parent, field, place if isinstance(value, list) else None, node
            if isinstance(node, ast.AST):
                yield from _nodes(node)


def _put(parent: ast.AST, field: str, place: int | None, node: ast.AST) -> None:
    if place is None:
        setattr(parent, field, node)
    else:
        getattr(parent, field)[place] = node


def _changes(node: ast.AST) -> Iterator[ast.AST]:
    for fields in _other_fields(node):
        changed = copy.copy(node)
        for name, value in fields.items():
            setattr(changed, name, value)
        yield changed


def _other_fields(node: ast.AST) -> Iterator[dict[str, object]]:  # noqa: C901  # a table of kinds
    match node:
        case ast.Compare(ops=[operator, *rest]):
            for change in (_TURNED, _MOVED):
                if type(operator) in change:
                    yield {"ops": [change[type(operator)](), *rest]}
        case ast.BinOp(op=ast.Add()):
            yield {"op": ast.Sub()}
        case ast.BinOp(op=ast.Sub()):
            yield {"op": ast.Add()}
        case ast.BoolOp(op=operator):
            yield {"op": ast.Or() if isinstance(operator, ast.And) else ast.And()}
        case ast.Constant(value=bool(value)):
            yield {"value": not value}
        case ast.Constant(value=int() | float() as value):
            yield {"value": value + 1}
        case ast.If(test=test) | ast.While(test=test) | ast.IfExp(test=test):
            yield {"test": ast.UnaryOp(ast.Not(), test)}
        case ast.Return(value=ast.expr() as value) if ast.unparse(value) != "None":
            yield {"value": ast.Constant(None)}


def _said(node: ast.AST) -> str:
    """Return the first line of a node as it is written, without what is long."""
    return ast.unparse(node).partition("\n")[0][:100]
