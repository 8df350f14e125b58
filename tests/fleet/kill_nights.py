"""Kills nights at random moments, spends one more, and holds ledger and disk against each other.

``python kill_nights.py FOLDER KILLS SEED`` prints what was found wrong, a line each, and at the end how many
nights were killed while they wrote. It forks, so it is a process of its own.
"""

from __future__ import annotations

import hashlib
import os
import random
import shutil
import signal
import sys
import time
from collections import Counter
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest

from fleet.fleets import FLEET, Fleet, without_processes
from zlmreport import files
from zlmreport.fleet import issuing
from zlmreport.fleet.issuing import What
from zlmreport.fleet.ledger import Ledger, Night
from zlmreport.fleet.records import State

ISSUED_BEFORE = ("a", "b", "c", "d")
CHANGED = ("a", "b")
GONE = ("c",)
NEW = ("e", "f")
OTHER_READINGS = "2 2 3 -1 -2 -3"
SUFFIXES = (".txt", ".md")


def prepared(folder: Path) -> Fleet:
    """Return a fleet before a night in which certificates, drafts and a restoration are due."""
    fleet = Fleet.of(folder, *ISSUED_BEFORE)
    fleet.write(
        "fleet.yaml",
        FLEET.replace('{serial}/{axis}"}', '{serial}/{axis}", formats: [exemplary, exemplary-sheet]}'),
    )
    fleet.spend()
    for stem in CHANGED:
        fleet.readings(stem, OTHER_READINGS)
    for stem in GONE:
        fleet.certificate(stem).unlink()
    for stem in NEW:
        fleet.job(stem)
    return fleet


def wrong(fleet: Fleet, expected: dict[str, str]) -> Iterator[str]:
    """Yield what is lost, doubled or half-written after the last night."""
    found = {
        path.name: path.read_bytes() for path in (fleet.folder / "certificates").rglob("*") if path.is_file()
    }
    digests = {name: hashlib.sha256(content).hexdigest() for name, content in found.items()}
    if digests != expected:
        yield f"files differ: {sorted(set(digests.items()) ^ set(expected.items()))}"
    made = Counter(each.number for each in fleet.entries() if each.state is State.MADE)
    with Ledger.open(fleet.file.ledger, fleet.file.name) as ledger:
        certificates = ledger.list_certificates()
    for issued in certificates.values():
        for file in issued.files:
            if digests.get(Path(file.path).name) != file.sha256:
                yield f"{file.path} is not what the ledger says"
    for stem in (*ISSUED_BEFORE, *NEW):
        number = f"CAL-{stem.upper()}"
        if number not in certificates:
            yield f"{number} is lost"
        if made[number] > (2 if stem in GONE else 1):
            yield f"{number} was issued {made[number]} times"
    if any(what is not What.UNCHANGED for what in fleet.spend().what.values()):
        yield "the night after the last finds something due"


def killed(fleet: Fleet, kill: Callable[[], None], moment: float | None) -> bool:
    """Spend a night in a process of its own that is killed; return whether it was, before its end."""
    child = os.fork()
    if not child:
        kill()
        fleet.spend()
        os._exit(0)
    if moment is not None:
        time.sleep(moment)
        os.kill(child, signal.SIGKILL)
    _, status = os.waitpid(child, 0)
    return os.WIFSIGNALED(status)


def counting(patch: pytest.MonkeyPatch, last: int) -> Callable[[], int]:
    """Let the process kill itself at one of the steps that change disk or ledger; return their counter."""
    steps = 0

    def step(function: Callable[..., Any]) -> Callable[..., Any]:
        def counted(*arguments: Any, **keywords: Any) -> Any:
            nonlocal steps
            steps += 1
            if steps == last:
                os.kill(os.getpid(), signal.SIGKILL)
            return function(*arguments, **keywords)

        return counted

    for owner, name in (
        (files, "push_folder"),
        (issuing.Laid, "name_files"),
        (Night, "issue"),
        (Night, "add"),
        (Night, "end"),
        (Path, "replace"),
        (Path, "unlink"),
        (os, "fsync"),
    ):
        patch.setattr(owner, name, step(getattr(owner, name)))
    return lambda: steps


def main(folder: Path, kills: int, seed: int) -> None:
    """Kill nights, and print what is wrong."""
    chance = random.Random(seed)
    patch = pytest.MonkeyPatch()
    without_processes(patch)
    before = folder / "before"
    fleet = prepared(before)
    whole = Fleet(shutil.copytree(before, folder / "whole"))
    with pytest.MonkeyPatch.context() as counter:
        steps = counting(counter, 0)
        begun = time.monotonic()
        whole.spend()
        lasting, most = time.monotonic() - begun, steps()
    expected = {
        path.name: hashlib.sha256(path.read_bytes()).hexdigest()
        for path in (whole.folder / "certificates").rglob("*")
        if path.is_file()
    }
    ended = 0
    for number in range(kills):
        if number % 2:
            fleet = Fleet(shutil.copytree(before, folder / str(number)))
            for _ in range(chance.randint(1, 3)):
                last = chance.randint(1, most)
                ended += killed(fleet, lambda last=last: counting(patch, last) and None, None)
        else:
            fleet = Fleet(shutil.copytree(before, folder / str(number)))
            ended += killed(fleet, lambda: None, chance.uniform(0, lasting))
        fleet.spend()
        for problem in wrong(fleet, expected):
            sys.stdout.write(f"round {number}: {problem}\n")
        shutil.rmtree(fleet.folder)
    sys.stdout.write(f"{ended} nights were killed\n")


if __name__ == "__main__":
    main(Path(sys.argv[1]), int(sys.argv[2]), int(sys.argv[3]))
