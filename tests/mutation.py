"""Do the tests notice when a line says something else? mutmut changes one place, and runs the tests of it.

A draw of mutants of each room is tried; the same seed draws the same ones of the same source. `mutmut show`
shows one by its name.
"""

from __future__ import annotations

import argparse
import json
import random
import subprocess
import sys
from pathlib import Path

_ROOT = Path(__file__).parents[1]
_ROOMS = {
    "decision": "zlmreport.evaluation.decision.",
    "evaluation": "zlmreport.evaluation.",
    "uncertainty": "zlmreport.evaluation.uncertainty.",
    "place": "zlmreport.live.capture.place.",
    "ledger": "zlmreport.fleet.ledger.",
    "verification": "zlmreport.verification.",
}
#: How tests end that noticed: failed, or broken. That they take too long shows on a busy computer, too.
_KILLED = {1, 3}


def _mutmut(*names: str) -> None:
    subprocess.run([sys.executable, "-m", "mutmut", "run", *names], cwd=_ROOT, check=False)


def _known() -> dict[str, int | None]:
    """Return how the tests ended on each mutant; None for one that was not tried."""
    found: dict[str, int | None] = {}
    for path in (_ROOT / "mutants").rglob("*.meta"):
        found |= json.loads(path.read_text(encoding="utf-8"))["exit_code_by_key"]
    return found


def _drawn(room: str, seed: int, wanted: int) -> list[str]:
    others = [each for each in _ROOMS.values() if each.startswith(_ROOMS[room]) and each != _ROOMS[room]]
    names = [
        each
        for each in sorted(_known())
        if each.startswith(_ROOMS[room]) and not each.startswith(tuple(others))
    ]
    return random.Random(f"{seed} {room}").sample(names, min(wanted, len(names)))


if __name__ == "__main__":
    parser = argparse.ArgumentParser(prog="./run mutation", description=__doc__)
    parser.add_argument("--mutants", type=int, default=60, help="of each room; 60 without it")
    parser.add_argument("--seed", type=int, default=1, help="of the draw; 1 without it")
    parser.add_argument("--only", choices=_ROOMS, action="append", help="a room; all without it")
    given = parser.parse_args()
    _mutmut("none of that name")  # it makes all, and finds which tests run which function
    tried = {room: _drawn(room, given.seed, given.mutants) for room in given.only or _ROOMS}
    _mutmut(*(name for names in tried.values() for name in names))
    ended = _known()
    for room, names in tried.items():
        survived = [name for name in names if ended[name] not in _KILLED]
        print(*survived, sep="\n")
        print(f"{room}: {len(names) - len(survived)} of {len(names)} killed, seed {given.seed}")
