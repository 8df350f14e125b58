"""Hidden effects of simulated machines: how often a diagnosis names the right one, and how wide of it.

    ./run benchmark machines [--cases N] [--results FILE.jsonl]

Each case is a ballbar of two turns, one in each sense (or of one sense), with correlated noise; the hidden
effect lies off every grid of the search, with a root mean square of ρ times that of the noise. A line for
each case is appended to the results, so that each can be looked at.
"""

from __future__ import annotations

import argparse
import json
import sys
from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import asdict, dataclass, field, replace
from pathlib import Path
from zlib import crc32

import numpy as np

sys.path.insert(0, str(Path(__file__).parents[1] / "tests"))

from machine_causes import CAUSES, PAIRS, Cause, drawn_cause
from machines.simulated import Scatter, bare_machine, circle, nothing
from zlmreport.machines.choosing import study_circles
from zlmreport.machines.course import CircularTest
from zlmreport.machines.diagnosis import diagnose
from zlmreport.machines.residual import centre, compute_root_mean_square
from zlmreport.plugin.registry import Registry, find_plugins

NOISE = 0.7e-6  # m, root mean square of what scatters
#: What the model has before anything is looked for: where the bar stands, and how long it is.
BASE = ("centre-offset", "radius")


@dataclass
class Case:
    """A case and what came of it."""

    plan: str
    cause: str
    rho: float
    seed: int
    verdict: str = ""
    named: list[str] = field(default_factory=list)
    first: str = ""
    equals: list[str] = field(default_factory=list)
    #: Of each parameter that was hidden, (estimate − truth)/U, whether it was named or not.
    misses: dict[str, float] = field(default_factory=dict)

    @property
    def outcome(self) -> str:
        """How it is counted."""
        if self.cause == "nothing":
            return "alarm" if self.verdict != "adequate" else "right"
        if self.cause == "stranger":
            return (
                "wrong name" if self.named else ("nameless" if self.verdict == "unexplained" else "nothing")
            )
        wanted = set(self.cause.split(" + "))
        if self.named and set(self.named) <= wanted:
            return "right" if set(self.named) == wanted else "in part"
        if self.named or self.equals:
            is_tie = wanted & {self.first, *self.equals} and not self.named
            return "tied" if is_tie else "wrong name" if self.named else "wrong tie"
        return "nothing" if self.verdict == "adequate" else "nameless"

    def draw(self, what: str) -> np.random.Generator:
        """Return the random numbers of something in this case alone: no two cases share any."""
        return np.random.default_rng(
            [self.seed, crc32(f"{self.plan} {self.cause} {self.rho} {what}".encode())]
        )


def _scatter(case: Case) -> Scatter:
    """Return what scatters: as the noise of a diagnosis takes it to be, or of other sizes and lengths."""
    if case.plan != "other noise":
        return Scatter()
    draw = case.draw("scatter")
    sizes = np.array([1.0, draw.uniform(0.0, 1.2), draw.uniform(0.0, 0.7)])
    sizes /= np.linalg.norm(sizes)
    return Scatter(*sizes.tolist(), float(draw.uniform(2.5, 12.0)), float(draw.uniform(7.0, 20.0)))


def simulated(case: Case) -> tuple[CircularTest, dict[str, float]]:
    """Return the circle of a case, and what was hidden by the parameter that it is, SI."""
    senses = (1,) if case.plan == "one sense" else (1, -1)
    first = float(case.draw("first").uniform(0, 0.05))
    how = {"senses": senses, "first": first}
    noise = int(case.draw("noise").integers(1 << 62))
    plain = circle(nothing, seed=noise, noise=NOISE, scatter=_scatter(case), **how)
    none = circle(nothing, noise=0.0, **how)
    total, truth = plain.deviation, {}
    for part in case.cause.split(" + ") if case.cause != "nothing" else ():
        cause: Cause = drawn_cause(part, case.draw(part))
        shape = circle(cause.move, noise=0.0, **how).deviation - none.deviation
        size = case.rho * NOISE / compute_root_mean_square(centre(plain, shape))
        total = total + size * shape
        truth |= {name: size * value for name, value in cause.truth.items()}
    seen = replace(plain, deviation=total)
    if case.plan == "start 2° off":
        seen = replace(seen, angle=seen.angle + np.where(seen.sense > 0, 1.0, -1.0) * np.radians(2.0))
    return seen, truth


def run(case: Case) -> Case:
    """Diagnose one case."""
    seen, truth = simulated(case)
    registry = find_plugins()
    base = [registry.circle_effect(name) for name in BASE]
    found = diagnose(study_circles(bare_machine(), [seen], base), registry.circle_effects)
    case.verdict, case.named = found.verdict.value, list(found.found)
    if found.candidates:
        case.first = found.candidates[0].effect.identifier
        case.equals = list(found.candidates[0].indistinguishable_from)
    if truth and case.plan != "one sense":
        case.misses = _misses(case, seen, truth, registry)
    return case


def _misses(case: Case, seen: CircularTest, truth: dict[str, float], registry: Registry) -> dict[str, float]:
    """Return (estimate − truth)/U of what was hidden, its effects being in the model."""
    names = (*BASE, *case.cause.split(" + "))
    study = study_circles(bare_machine(), [seen], [registry.circle_effect(name) for name in names])
    found = {}
    for each in study.estimates:
        hidden = truth.get(each.name.rstrip("+−"))  # a lost motion of each end has both ends' truth
        if hidden is not None and each.expanded_uncertainty:
            found[each.name] = (each.value - hidden) / each.expanded_uncertainty
    return found


def cases(count: int) -> Iterator[Case]:
    """Yield all cases: `count` of each cell at ρ of 1 and 2, as many times that as a rate needs of others."""
    for seed in range(count):
        for rho in (1.0, 2.0, *((0.25, 0.5) if seed % 3 == 0 else ())):
            for cause in CAUSES:
                yield Case("both senses", cause, rho, seed)
        for plan in ("both senses", "other noise"):
            yield from (Case(plan, "nothing", 0.0, 10 * seed + each) for each in range(10))
        yield from (Case("both senses", "stranger", 1.0, 6 * seed + each) for each in range(6))
        yield from (Case("one sense", cause, 1.0, seed) for cause in CAUSES)
        if seed % 2 == 0:
            yield from (Case("other noise", cause, 1.0, seed) for cause in CAUSES)
            yield from (Case("start 2° off", cause, 2.0, seed) for cause in ("squareness", "scale-mismatch"))
            yield from (Case("both senses", " + ".join(pair), 1.5, seed) for pair in PAIRS)


def table(done: list[Case]) -> str:
    """Return how cases came out, a row for each cell."""
    rows = []
    outcomes = ("right", "in part", "tied", "wrong name", "wrong tie", "nameless", "nothing", "alarm")
    for plan, rho in sorted({(case.plan, case.rho) for case in done}):
        for kind in ("single", "pair", "nothing", "stranger"):
            own = [case for case in done if (case.plan, case.rho) == (plan, rho) and _kind(case) == kind]
            if own:
                counts = Counter(case.outcome for case in own)
                cells = " | ".join(str(counts[each] or "") for each in outcomes)
                rows.append(f"| {plan} | {kind} | {rho:g} | {len(own)} | {cells} |")
    head = "| plan | hidden | ρ | cases | " + " | ".join(outcomes) + " |"
    return "\n".join([head, "|---" * (4 + len(outcomes)) + "|", *rows, "", *_within(done)])


def _within(done: list[Case]) -> list[str]:
    """Return how many of the hidden values lie within U, a line for each cause."""
    found = []
    for cause in CAUSES:
        misses = [abs(miss) for case in done if case.cause == cause for miss in case.misses.values()]
        if misses:
            found.append(f"{cause}: {sum(miss <= 1 for miss in misses)} of {len(misses)} within U")
    return found


def _kind(case: Case) -> str:
    if case.cause in {"nothing", "stranger"}:
        return case.cause
    return "pair" if " + " in case.cause else "single"


def main(arguments: Sequence[str]) -> None:
    """Diagnose what is not among the results yet, and print the table of all."""
    parser = argparse.ArgumentParser(prog="./run benchmark machines", description=__doc__.splitlines()[0])
    parser.add_argument("--cases", type=int, default=2, help="of each cell (%(default)s)")
    parser.add_argument(
        "--results",
        type=Path,
        metavar="FILE",
        help="a line for each case; those that it has are not repeated",
    )
    options = parser.parse_args(arguments)
    results: Path | None = options.results
    done = []
    if results and results.exists():
        done = [Case(**json.loads(line)) for line in results.read_text(encoding="utf-8").splitlines()]
    known = {(case.plan, case.cause, case.rho, case.seed) for case in done}
    for case in cases(options.cases):
        if (case.plan, case.cause, case.rho, case.seed) in known:
            continue
        done.append(run(case))
        if results:
            with results.open("a", encoding="utf-8") as file:
                file.write(json.dumps(asdict(done[-1])) + "\n")
    print(table(done))
