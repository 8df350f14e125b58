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
from collections.abc import Callable, Iterator, Sequence
from dataclasses import asdict, dataclass, field, replace
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).parents[1] / "tests"))

from machines.simulated import (
    Path as Course,
    bare_machine,
    circle,
    lagging,
    nothing,
    out_of_square,
    unequal_scales,
    with_lost_motion,
    with_play,
)
from zlmreport.machines.choosing import study_circles
from zlmreport.machines.course import CircularTest
from zlmreport.machines.diagnosis import diagnose
from zlmreport.machines.residual import centre, compute_root_mean_square
from zlmreport.plugin.registry import find_plugins

NOISE = 0.7e-6  # m, root mean square of what scatters
#: What the model has before anything is looked for: where the bar stands, and how long it is.
BASE = ("centre-offset", "radius")
Move = Callable[[Course], tuple[np.ndarray, np.ndarray]]


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
    #: Of the parameter that was hidden: (estimate − truth)/U; None where it was not named.
    miss: float | None = None

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


def _spike(path: Course, axis: int, width: float, slow: float) -> np.ndarray:
    """Return a bump of another shape than the catalogue's: a half sine, then a slow return."""
    angle = np.arctan2(path.v, path.u)
    since = (path.sense * (angle - axis * np.pi / 2)) % np.pi
    rise = np.sin(np.pi * np.minimum(since / width, 1.0) / 2)
    return np.asarray(
        np.where(since < width, rise, np.exp(-((np.maximum(since - width, 0.0) / slow) ** 1.5)))
    )


def _radial(path: Course, values: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    radius = np.hypot(path.u, path.v)
    return values * path.u / radius, values * path.v / radius


def _cause(name: str, draw: np.random.Generator) -> Move:
    """Return a cause of unit size, its shape drawn."""
    side = int(draw.integers(2))
    sign = float(draw.choice([-1.0, 1.0]))
    both = draw.uniform(0.3, 1.0, 2) if draw.integers(2) else np.eye(2)[side]
    width = float(np.radians(draw.uniform(2.5, 15.0)))

    def spikes(path: Course) -> tuple[np.ndarray, np.ndarray]:
        return _radial(path, sum(both[a] * _spike(path, a, width, 0.4 * width) for a in (0, 1)))

    pitch, phase = float(draw.uniform(8e-3, 60e-3)), float(draw.uniform(0, 2 * np.pi))

    def cyclic(path: Course) -> tuple[np.ndarray, np.ndarray]:
        coordinate = (path.u, path.v)[side]
        wave = np.sin(2 * np.pi * coordinate / pitch + phase)
        return (wave, 0 * wave) if side == 0 else (0 * wave, wave)

    power = int(draw.integers(2, 5))

    def bow(path: Course) -> tuple[np.ndarray, np.ndarray]:
        bent = sign * ((path.u, path.v)[side] / 0.15) ** power
        return (0 * bent, bent) if side == 0 else (bent, 0 * bent)

    order, turned = float(draw.uniform(12, 60)), draw.uniform(0, 2 * np.pi, 2)

    def vibration(path: Course) -> tuple[np.ndarray, np.ndarray]:
        angle = np.arctan2(path.v, path.u)
        travelled = (path.sense * angle) % (2 * np.pi)
        return _radial(path, np.sin(order * travelled + np.where(path.sense > 0, turned[0], turned[1])))

    decay, length = np.radians(draw.uniform(10, 28)), np.radians(draw.uniform(8, 24))

    def stick_slip(path: Course) -> tuple[np.ndarray, np.ndarray]:
        angle = np.arctan2(path.v, path.u)
        since = (path.sense * (angle - side * np.pi / 2)) % np.pi
        return _radial(path, np.exp(-since / decay) * np.sin(2 * np.pi * since / length))

    lobes, where = int(draw.integers(5, 9)), float(draw.uniform(0, 2 * np.pi))

    def stranger(path: Course) -> tuple[np.ndarray, np.ndarray]:
        angle = np.arctan2(path.v, path.u)
        near = np.exp(-0.5 * ((angle - where + np.pi) % (2 * np.pi) - np.pi) ** 2 / 0.35**2)
        shapes = (np.cos(lobes * angle + where), near, path.sense * near)
        return _radial(path, shapes[int(where * 1000) % 3])

    causes: dict[str, Move] = {
        "nothing": nothing,
        "stranger": stranger,
        "squareness": out_of_square(sign),
        "scale-mismatch": unequal_scales(sign, 0.0),
        "servo-mismatch": lagging(max(sign, 0.0), max(-sign, 0.0)),
        "circle-backlash": with_lost_motion(*both.tolist()),
        "over-compensation": with_lost_motion(*(-both).tolist()),
        "lateral-play": with_play(*(sign * both).tolist()),
        "reversal-spikes": spikes,
        "cyclic-error": cyclic,
        "bow": bow,
        "vibration": vibration,
        "stick-slip": stick_slip,
    }
    return causes[name]


CAUSES = (
    "squareness", "scale-mismatch", "servo-mismatch", "circle-backlash", "over-compensation", "lateral-play",
    "reversal-spikes", "cyclic-error", "bow", "vibration", "stick-slip",
)  # fmt: skip
PAIRS = (
    ("servo-mismatch", "scale-mismatch"), ("squareness", "circle-backlash"),
    ("circle-backlash", "servo-mismatch"),
    ("reversal-spikes", "squareness"), ("cyclic-error", "lateral-play"),
)  # fmt: skip
#: Parameter by which a hidden value is judged, and what a move of size one makes it, SI.
JUDGED = {"squareness": "C0Y", "scale-mismatch": "X-Y", "servo-mismatch": "T_X-T_Y"}


def _sized(
    name: str, rho: float, seed: int, senses: tuple[int, ...]
) -> tuple[np.ndarray, float, CircularTest]:
    """Return a cause's deviations of a root mean square of ρ·noise, its size, and a circle without it."""
    draw = np.random.default_rng([seed, len(name)])
    plain = circle(nothing, seed=seed, senses=senses, noise=NOISE, first=float(draw.uniform(0, 0.05)))
    if name == "nothing":
        return 0 * plain.deviation, 0.0, plain
    move = _cause(name, draw)
    first = float(np.random.default_rng([seed, len(name)]).uniform(0, 0.05))
    only = circle(move, seed=seed, senses=senses, noise=0.0, first=first)
    none = circle(nothing, seed=seed, senses=senses, noise=0.0, first=first)
    shape = only.deviation - none.deviation
    size = rho * NOISE / compute_root_mean_square(centre(plain, shape))
    return size * shape, size, plain


def run(case: Case) -> Case:
    """Diagnose one case."""
    senses = (1,) if case.plan == "one sense" else (1, -1)
    total, plain, sizes = 0.0, None, {}
    for part in case.cause.split(" + "):
        made, sizes[part], plain = _sized(part, case.rho, case.seed, senses)
        total = total + made
    assert plain is not None
    seen = replace(plain, deviation=plain.deviation + total)
    if case.plan == "start 2° off":
        seen = replace(seen, angle=seen.angle + np.where(seen.sense > 0, 1.0, -1.0) * np.radians(2.0))
    registry = find_plugins()
    base = [registry.circle_effect(name) for name in BASE]
    found = diagnose(study_circles(bare_machine(), [seen], base), registry.circle_effects)
    case.verdict, case.named = found.verdict.value, list(found.found)
    if found.candidates:
        case.first = found.candidates[0].effect.identifier
        case.equals = list(found.candidates[0].indistinguishable_from)
    if case.cause in JUDGED and case.cause in case.named:
        draw = np.random.default_rng([case.seed, len(case.cause)])
        draw.integers(2)
        sign = _sign_of(case.cause, case.seed)
        truth = sign * sizes[case.cause]
        own = next(each for each in found.complete.estimates if each.term.name == JUDGED[case.cause])
        assert own.expanded_uncertainty is not None
        case.miss = (own.value - truth) / own.expanded_uncertainty
    return case


def _sign_of(name: str, seed: int) -> float:
    draw = np.random.default_rng([seed, len(name)])
    draw.uniform(0, 0.05)
    draw.integers(2)
    return float(draw.choice([-1.0, 1.0]))


def cases(count: int) -> Iterator[Case]:
    """Yield all cases: `count` of each cell."""
    for seed in range(count):
        for rho in (0.25, 0.5, 1.0, 2.0):
            for cause in CAUSES:
                yield Case("both senses", cause, rho, seed)
        yield from (Case("both senses", "nothing", 0.0, 10_000 + 20 * seed + each) for each in range(10))
        yield from (Case("both senses", "stranger", 1.0, 5000 + 20 * seed + each) for each in range(4))
        yield from (Case("one sense", cause, 1.0, seed) for cause in CAUSES)
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
    misses = [abs(case.miss) for case in done if case.miss is not None and case.plan == "both senses"]
    inside = sum(miss <= 1 for miss in misses)
    held = f"\nWithin U: {inside} of {len(misses)}" if misses else ""
    return "\n".join([head, "|---" * (4 + len(outcomes)) + "|", *rows]) + held


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
