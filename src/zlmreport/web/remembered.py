"""Diagnoses that were made, remembered by what they were made from: for undo, and for tomorrow.

They lie in the user's cache folder. A cache that cannot be read or written is not used; a diagnosis of
another version of this program, or of other effects, is not the answer to the same question.
"""

from __future__ import annotations

import contextlib
import hashlib
import json
import sys
from collections.abc import Iterable
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from zlmreport import version
from zlmreport.errors import AccessError
from zlmreport.files import Document, cache_folder, write
from zlmreport.model.effect import Effect

#: Diagnoses that are kept: some hundred kilobytes each.
_KEPT = 200


@dataclass(frozen=True, slots=True)
class Answers:
    """Diagnoses by the content of the files that they were made from."""

    folder: Path | None  #: Where they lie; None for memory alone.
    program: str  #: Names the program and the effects that make them.
    _known: dict[str, Any] = field(default_factory=dict)

    @classmethod
    def of_user(cls, effects: Iterable[Effect]) -> Answers:
        """Return those of a user, of this program with these effects."""
        folder = cache_folder()
        return cls(folder / "diagnoses" if folder else None, _program(effects))

    def recall(self, content: str) -> Any:
        """Return the diagnosis of a content; None if none was made."""
        name = self._name(content)
        if name not in self._known and self.folder:
            with contextlib.suppress(OSError, ValueError):
                self._known[name] = json.loads((self.folder / name).read_text(encoding="utf-8"))
        return self._known.get(name)

    def keep(self, content: str, diagnosis: Any) -> None:
        """Remember the diagnosis of a content; the oldest give way."""
        name = self._name(content)
        self._known[name] = diagnosis
        if self.folder is None:
            return
        with contextlib.suppress(AccessError, OSError):
            write([Document(self.folder / name, json.dumps(diagnosis).encode())])
            kept = sorted(self.folder.glob("*.json"), key=lambda each: each.stat().st_mtime_ns)
            for path in kept[:-_KEPT]:
                path.unlink()

    def _name(self, content: str) -> str:
        return f"{hashlib.sha256(f'{self.program} {content}'.encode()).hexdigest()}.json"


def _program(effects: Iterable[Effect]) -> str:
    """Return what tells this program and its effects, as they stand in their files, from any other."""
    package = Path(version.__file__).parent
    modules = (sys.modules.get(each.__class__.__module__) for each in effects)
    homes = {Path(found) for each in modules if (found := getattr(each, "__file__", None))}
    stats = [(str(path), path.stat()) for path in sorted({*package.rglob("*.py"), *homes})]
    return repr([(path, stat.st_mtime_ns, stat.st_size) for path, stat in stats])
