"""A seeded adversary: spoiled files and requests, and what must hold whatever they are.

Every command ends with an exit code from 0 to 5 and without a traceback or a warning of a library, within
bounds of time and memory, and leaves nothing behind when it refuses. What breaks that is shrunk to the fewest
edits, and shown with the seed that makes it again. The same seed gives the same inputs.
"""

from __future__ import annotations

import argparse
import os
import shutil
import sys
import tempfile
import time
from collections import Counter
from collections.abc import Sequence
from pathlib import Path

sys.dont_write_bytecode = True  # of plugins in the folders that are watched
os.environ["OPENBLAS_NUM_THREADS"] = "1"  # before any library is loaded: threads do not outlive a fork
sys.path.insert(0, str(Path(__file__).parents[1]))  # for its neighbours, as pytest has them

from attack.adversary import Input, answers, inputs, shown, shrunk, warm_up
from attack.faces import attacked as attacked_faces, certificate
from attack.targets import Target, targets

#: What finds files that two readers show differently; it is no target among the others, for its corpus grows.
FACES = "faces"
#: Inputs of a process.
_BATCH = 200
#: A file system in memory, where there is one: half of an input is files made and removed.
_MEMORY = Path("/dev/shm")


def attacked(seed: int, wanted: int, until: float, only: str) -> int:
    """Attack until the time or the number is over, tell what was found, and return the number of findings."""
    done: Counter[str] = Counter()
    found: set[str] = set()
    with tempfile.TemporaryDirectory(prefix="zlmreport-attack-") as folder:
        known = [each for each in targets(Path(folder)) if only in each.name]
        warm_up(known)
        drawn = inputs(seed, known)
        while sum(done.values()) < wanted and time.monotonic() < until:
            batch = [next(drawn) for _ in range(min(_BATCH, wanted - sum(done.values())))]
            for each, complained in answers(batch, known):
                done[known[each.target].name] += 1
                first = f"{known[each.target].name}: {complained[:80]}"
                if complained and first not in found:
                    found.add(first)
                    print(f"\n{complained}\n{_least(each, known)}", flush=True)
    print(f"{sum(done.values())} inputs, seed {seed}: {len(found)} findings ({dict(done)})")
    return len(found)


def faced(seed: int, wanted: int, until: float) -> int:
    """Look for files of two faces until the time or the number is over; return the number of findings."""
    done = held = found = 0
    issued = [certificate(printed, layout="sheet") for printed in ("pdf", "pdf-typst")]
    drawn = [attacked_faces(each, seed + number, wanted) for number, each in enumerate(issued)]
    while done < wanted and time.monotonic() < until:
        seeds, holds, told = next(drawn[done % len(drawn)])
        done, held, found = done + 1, held + holds, found + bool(told)
        if told:
            print(f"\n{'; '.join(told)}: edits {seeds} of {('pdf', 'pdf-typst')[(done - 1) % 2]}", flush=True)
    print(f"{done} files of a certificate taken apart, seed {seed}: {held} hold, {found} findings")
    return found


def _least(each: Input, known: Sequence[Target]) -> str:
    """Return what shows an input again, with the fewest edits."""
    least, complained = shrunk(each, known)
    return (
        f"{known[least.target].name}, edits {least.seeds}, attack {least.attack}: "
        f"{complained or 'not again'}\n{shown(least, known)}"
    )


def _options(arguments: Sequence[str]) -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog="./run attack", description=__doc__)
    parser.add_argument("--minutes", type=float, default=5.0, help="how long; 5 without it")
    parser.add_argument("--inputs", type=int, default=sys.maxsize, help="how many at most")
    parser.add_argument("--seed", type=int, default=1, help="of all inputs; 1 without it")
    parser.add_argument(
        "--only", default="", help=f"targets whose name holds this; {FACES}: a certificate, byte by byte"
    )
    return parser.parse_args(arguments)


if __name__ == "__main__":
    chosen = _options(sys.argv[1:])
    tempfile.tempdir = str(_MEMORY) if os.access(_MEMORY, os.W_OK) else None
    os.environ["XDG_CACHE_HOME"] = tempfile.mkdtemp(prefix="zlmreport-attack-cache-")
    try:
        ends = time.monotonic() + 60 * chosen.minutes
        if chosen.only == FACES:
            sys.exit(1 if faced(chosen.seed, chosen.inputs, ends) else 0)
        sys.exit(1 if attacked(chosen.seed, chosen.inputs, ends, chosen.only) else 0)
    finally:
        shutil.rmtree(os.environ["XDG_CACHE_HOME"], ignore_errors=True)
