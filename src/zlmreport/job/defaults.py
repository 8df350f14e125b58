"""Keys that many jobs build on without naming them, such as those of a fleet.

A certificate carries what it was made from, and whoever evaluates it again has no fleet. So it carries two
files more: one with the defaults, and as its job one that extends the defaults and the job file.
"""

from __future__ import annotations

import json
import os
import re
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from zlmreport.job.tree import Items, Keys, Node, Scalar
from zlmreport.measurement.provenance import SourceFile

_PLAIN_KEY = re.compile(r"[A-Za-z_][A-Za-z0-9_-]*")


@dataclass(frozen=True, slots=True)
class Defaults:
    """Default keys of jobs.

    Attributes
    ----------
    keys
        With their places in the file that states them.
    path
        That file: relative paths among the keys are relative to its folder.
    """

    keys: Keys
    path: Path

    def as_files(self, job: Path) -> tuple[SourceFile, SourceFile]:
        """Return two files that nobody wrote: a job that extends a job file and the defaults, and these."""
        folder = os.path.relpath(self.path.parent.absolute(), job.parent.absolute())
        shared = Path(folder) / f"{self.path.stem}.defaults.yaml"
        whole = job.with_name(f"{self.path.stem}.{job.name}")
        extended = json.dumps([shared.as_posix(), job.name], ensure_ascii=False)
        return (
            SourceFile.of(whole, f"extends: {extended}\n".encode()),
            SourceFile.of(job.parent / shared, self.as_yaml().encode()),
        )

    def as_yaml(self) -> str:
        """Return the keys as a file of their own."""
        return "".join(f"{line}\n" for line in _lines(self.keys, ""))


def _lines(node: Keys | Items, indent: str) -> Iterator[str]:
    """Yield a group or a list, a value a line."""
    if isinstance(node, Items):
        labelled: list[tuple[str, Node]] = [("-", item) for item in node.items]
    else:
        labelled = [(f"{_key(entry.key)}:", entry.value) for entry in node.entries.values()]
    for label, value in labelled:
        if isinstance(value, Scalar):
            yield f"{indent}{label} {_scalar(value)}".rstrip()
        elif list(_lines(value, "")):
            yield f"{indent}{label}"
            yield from _lines(value, f"{indent}  ")
        else:
            yield f"{indent}{label} {'[]' if isinstance(value, Items) else '{}'}"


def _key(key: str) -> str:
    return key if _PLAIN_KEY.fullmatch(key) else json.dumps(key, ensure_ascii=False)


def _scalar(value: Scalar) -> str:
    """Write a value as it was written: whether it stands in quotes tells a number from a text."""
    is_plain = value.plain and "\n" not in value.text
    return value.text if is_plain else json.dumps(value.text, ensure_ascii=False)
