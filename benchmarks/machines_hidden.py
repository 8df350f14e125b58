"""Hidden effects of simulated machines: how often a diagnosis names the right one, and how wide of it.

    ./run benchmark machines [--cases N] [--results FILE.jsonl]

Each case is a ballbar of two turns, one in each sense (or of one sense), with correlated noise; the hidden
effect lies off every grid of the search, with a root mean square of ρ times that of the noise. A line for
each case is appended to the results, so that each can be looked at.

Where the hidden effect is not the only one named, the case is diagnosed once more by an ideal observer: one
whose catalogue has the hidden shape itself besides. Where even that is not named first, nobody can tell.
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

from machine_causes import CAUSES, MEASURED, PAIRS, Cause, drawn_cause
from machines.simulated import Scatter, bare_machine, circle, nothing
from zlmreport.machines.choosing import study_circles
from zlmreport.machines.course import CircularTest
from zlmreport.machines.diagnosis import diagnose
from zlmreport.machines.residual import centre, compute_root_mean_square
from zlmreport.machines.study import CircleStudy
from zlmreport.plugin import Words
from zlmreport.plugin.circle_effect import (
    ONE,
    CircleDesign,
    CircleEffect,
    CircleTerm,
    Law,
    Parity,
    Searched,
)
from zlmreport.plugin.registry import find_plugins

NOISE = 0.7e-6  # m, root mean square of what scatters
#: A plan in which the model has the hidden effect already, and a stranger stands beside it.
_BESIDE = "beside a stranger"
#: Plans that can tell the effects apart.
_TOLD = ("both senses", "other noise")
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
    #: What an ideal observer names first; asked only where an effect was not named by itself.
    ideal: str | None = None

    @property
    def outcome(self) -> str:
        """How it is counted."""
        if self.cause == "nothing":
            return "alarm" if self.verdict != "adequate" else "right"
        if _kind(self) == "stranger":
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
    seen, truth, _ = _simulate(case)
    return seen, truth


def _simulate(case: Case) -> tuple[CircularTest, dict[str, float], np.ndarray]:
    """Return the same, and what was hidden alone, at each reading, m."""
    senses = (1,) if case.plan == "one sense" else (1, -1)
    first = float(case.draw("first").uniform(0, 0.05))
    how = {"senses": senses, "first": first}
    noise = int(case.draw("noise").integers(1 << 62))
    plain = circle(nothing, seed=noise, noise=NOISE, scatter=_scatter(case), **how)
    none = circle(nothing, noise=0.0, **how)
    hidden, truth = np.zeros(len(plain.deviation)), {}
    strangers = ("stranger",) if case.plan == _BESIDE else ()
    for part in (*case.cause.split(" + "), *strangers) if case.cause != "nothing" else ():
        cause: Cause = drawn_cause(part, case.draw(part))
        shape = circle(cause.move, noise=0.0, **how).deviation - none.deviation
        size = case.rho * NOISE / compute_root_mean_square(centre(plain, shape))
        hidden = hidden + size * shape
        truth |= {name: size * value for name, value in cause.truth.items()}
    seen = replace(plain, deviation=plain.deviation + hidden)
    if case.plan == "start 2° off":
        seen = replace(seen, angle=seen.angle + np.where(seen.sense > 0, 1.0, -1.0) * np.radians(2.0))
    return seen, truth, hidden


@dataclass
class _Truth(CircleEffect):
    """What was hidden itself, as one column."""

    circle: CircularTest
    hidden: np.ndarray

    identifier = "truth"
    title = equation = explains = Words("what was hidden")
    law = Law(Parity.IN_TIME, None, None)

    def terms(self, design: CircleDesign, _: Searched) -> list[CircleTerm]:
        """Return the hidden curve at the readings of a design: those of the circle, or some of them."""
        places = zip(self.circle.sense.tolist(), np.round(self.circle.angle, 9).tolist(), strict=True)
        known = dict(zip(places, self.hidden.tolist(), strict=True))
        wanted = zip(design.sense.tolist(), np.round(design.angle, 9).tolist(), strict=True)
        return [CircleTerm("size", ONE, np.array([known[place] for place in wanted]))]


def run(case: Case) -> Case:
    """Diagnose one case."""
    seen, truth, hidden = _simulate(case)
    registry = find_plugins()
    known = (*BASE, case.cause) if case.plan == _BESIDE else BASE
    study = study_circles(bare_machine(), [seen], [registry.circle_effect(name) for name in known])
    found = diagnose(study, registry.circle_effects)
    case.verdict, case.named = found.verdict.value, list(found.found)
    if found.candidates:
        case.first = found.candidates[0].effect.identifier
        case.equals = list(found.candidates[0].indistinguishable_from)
    if _kind(case) == "single" and case.plan in _TOLD and case.outcome != "right":
        told = diagnose(study, [*registry.circle_effects, _Truth(seen, hidden)]).found
        case.ideal = told[0] if told else ""
    if case.plan == _BESIDE:
        case.misses = _misses(found.complete, truth)
    elif truth and case.plan != "one sense":
        names = (*BASE, *case.cause.split(" + "))
        effects = [registry.circle_effect(name) for name in names]
        case.misses = _misses(study_circles(bare_machine(), [seen], effects), truth)
    return case


def _misses(study: CircleStudy, truth: dict[str, float]) -> dict[str, float]:
    """Return (estimate − truth)/U of what was hidden, its effects being in the model."""
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
        yield from (Case(_BESIDE, cause, 1.0, seed) for cause in MEASURED)
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
    return "\n".join(
        [head, "|---" * (4 + len(outcomes)) + "|", *rows, "", *_count_first(done), "", *_within(done)]
    )


def _count_first(done: list[Case]) -> list[str]:
    """Return how often a single hidden effect was named first, of all and of those that can be told."""
    found = []
    for plan in _TOLD:
        own = [case for case in done if case.plan == plan and case.rho >= 1 and _kind(case) == "single"]
        if own:
            first = sum(case.named[:1] == [case.cause] for case in own)
            wrong = sum(case.outcome == "wrong name" for case in own)
            told = sum(case.named[:1] == [case.cause] or case.ideal == _Truth.identifier for case in own)
            found.append(
                f"{plan}, ρ >= 1: first in {first} of {len(own)}, of {told} that an ideal observer can tell; "
                f"wrong names in {wrong}"
            )
    return found


def _within(done: list[Case]) -> list[str]:
    """Return how many of the hidden values lie within U, a line for each cause."""
    found = []
    for plan in sorted({case.plan for case in done if case.misses}):
        for cause in ("", *MEASURED):
            own = [case for case in done if case.plan == plan and cause in {"", case.cause}]
            misses = [abs(miss) for case in own for miss in case.misses.values()]
            within = f"{sum(miss <= 1 for miss in misses)} of {len(misses)} within U"
            found.append(f"{plan}, {cause or 'all'}: {within}")
    return found


def _kind(case: Case) -> str:
    if case.plan == _BESIDE:
        return "stranger"
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
