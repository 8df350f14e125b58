"""Mutation of the code: do the tests notice when a line says something else?

Each mutant is one change in one module. It stands in a copy of the package that is found before the working
tree, and the narrow tests of its room run on it. A mutant that fails no test survives, and is shown. The same
seed draws the same mutants of the same source.
"""

from __future__ import annotations

import argparse
import os
import random
import shutil
import subprocess
import sys
import tempfile
import time
from collections.abc import Sequence
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[1]))  # for its neighbours, as pytest has them

from mutation.mutants import Mutant, mutants

_ROOT = Path(__file__).parents[2]
_PACKAGE = _ROOT / "src" / "zlmreport"
#: What is mutated, and the tests that have to notice.
_ROOMS = {
    "decision": (["evaluation/decision.py"], ["tests/evaluation"]),
    "evaluation": (
        ["evaluation/*.py"],
        [
            "tests/evaluation",
            "tests/certificate/test_likely_units.py",
            "tests/plugins/renderers/test_json_results.py",
            "tests/plugins/standards",
        ],
    ),
    "uncertainty": (["uncertainty/*.py"], ["tests/uncertainty"]),
    "place": (["capture/place.py"], ["tests/capture/test_place.py", "tests/capture/test_follower.py"]),
    "ledger": (["fleet/ledger.py"], ["tests/fleet/test_ledger.py"]),
    "verification": (["verification/*.py"], ["tests/verification"]),
}


def mutated(room: str, seed: int, wanted: int) -> tuple[int, int]:
    """Try mutants of a room, show those that survive, and return how many were tried and how many killed."""
    patterns, tests = _ROOMS[room]
    known = [
        mutant
        for pattern in patterns
        for path in sorted(_PACKAGE.glob(pattern))
        if room != "evaluation" or path.name != "decision.py"  # a room of its own
        for mutant in mutants(path)
    ]
    drawn = random.Random(f"{seed} {room}").sample(known, min(wanted, len(known)))
    killed = 0
    with tempfile.TemporaryDirectory(prefix="zlmreport-mutation-") as folder:
        copy = Path(folder) / "zlmreport"
        shutil.copytree(_PACKAGE, copy, ignore=shutil.ignore_patterns("__pycache__"))
        start = time.monotonic()
        if not _hold(copy, tests, None):
            sys.exit(f"{room}: the tests fail on the code as it stands")
        limit = 10 + 3 * (time.monotonic() - start)
        for mutant in drawn:
            survived = _survives(mutant, copy, tests, limit)
            killed += not survived
            if survived:
                print(f"{room}: survived: {mutant}", flush=True)
    print(f"{room}: {killed} of {len(drawn)} killed, drawn from {len(known)}, seed {seed}", flush=True)
    return len(drawn), killed


def _survives(mutant: Mutant, copy: Path, tests: Sequence[str], limit: float) -> bool:
    module = copy / mutant.path.relative_to(_PACKAGE)
    first = _ROOT / "tests" / mutant.path.relative_to(_PACKAGE).parent / f"test_{mutant.path.stem}.py"
    module.write_text(mutant.source, encoding="utf-8")
    try:
        return _hold(copy, [str(first)] * first.exists() + [*tests], limit)
    finally:
        shutil.copy(mutant.path, module)


def _hold(copy: Path, tests: Sequence[str], limit: float | None) -> bool:
    """Return whether all tests pass on a copy of the package within a time in seconds."""
    for compiled in copy.rglob("__pycache__"):  # two mutants of a second can have the same size
        shutil.rmtree(compiled)
    command = [sys.executable, "-m", "pytest", "-x", "-q", "-p", "no:cacheprovider", *dict.fromkeys(tests)]
    variables = {**os.environ, "PYTHONPATH": str(copy.parent)}
    pytest = subprocess.Popen(
        [*command, "--basetemp", str(copy.parent / "made")],
        cwd=_ROOT,
        env=variables,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
        start_new_session=True,
    )
    try:
        return pytest.wait(limit) == 0
    except subprocess.TimeoutExpired:
        os.killpg(pytest.pid, 9)  # with what the tests started
        pytest.wait()
        return False


def _options(arguments: Sequence[str]) -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog="./run mutation", description=__doc__)
    parser.add_argument("--mutants", type=int, default=20, help="of each room; 20 without it")
    parser.add_argument("--seed", type=int, default=1, help="of the draw; 1 without it")
    parser.add_argument("--only", choices=_ROOMS, action="append", help="a room; all without it")
    return parser.parse_args(arguments)


if __name__ == "__main__":
    given = _options(sys.argv[1:])
    counts = [mutated(room, given.seed, given.mutants) for room in given.only or _ROOMS]
    print(f"{sum(killed for _, killed in counts)} of {sum(tried for tried, _ in counts)} killed")
