"""Results in a file of lines, one a case, appended as they come: a stopped benchmark is resumed from it."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Iterable
from pathlib import Path
from typing import Any, TypeAlias

import zlmreport
import zlmreport_plugins

Record: TypeAlias = dict[str, Any]

#: What the outcome of a case depends on; how it is tabulated does not count.
_CODE = (
    Path(__file__).parent,
    Path(zlmreport.__file__).parent / "model",
    Path(zlmreport_plugins.__path__[0]) / "effects",
)


def state_of_code() -> str:
    """Return a fingerprint of all code on which results depend: those of another state do not count."""
    content = hashlib.sha256()
    for folder in _CODE:
        for file in sorted(folder.rglob("*.py")):
            if file.parent.name != "tables":
                content.update(file.name.encode() + file.read_bytes())
    return content.hexdigest()[:12]


def read(file: Path) -> list[Record]:
    """Return the results in a file, of whatever state of the code; none if there is no file."""
    if not file.exists():
        return []
    lines = file.read_text(encoding="utf-8").splitlines(keepends=True)
    return [json.loads(line) for line in lines if line.endswith("\n")]


def of_state(records: Iterable[Record], state: str) -> list[Record]:
    """Return the results of one state of the code."""
    return [record for record in records if record["code"] == state]


def mend(file: Path) -> None:
    """Take away a last line that was not written to its end."""
    if file.exists():
        whole = file.read_bytes()
        if not whole.endswith(b"\n"):
            file.write_bytes(whole[: whole.rfind(b"\n") + 1])


def line_of(record: Record, state: str) -> str:
    """Return a result as a line."""
    return json.dumps({"code": state, **record}, ensure_ascii=False) + "\n"
