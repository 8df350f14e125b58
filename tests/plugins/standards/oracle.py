"""The formulas of the seven standards once more: plain Python, one reading after the other.

Written from the formulas as printed and not from the program: lists, loops and `math.fsum`, nothing in
common with the code under test. A test is a pair of directions; a direction is a list of targets; a target
is the list of its readings there are. None stands for what is not defined.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field

Readings = Sequence[float]
Direction = Sequence[Readings]
Value = float | None


@dataclass
class Results:
    parameters: dict[str, Value] = field(default_factory=dict)
    positions: dict[str, list[Value]] = field(default_factory=dict)


def evaluated_plainly(standard: str, up: Direction, down: Direction) -> Results:
    """Evaluate a test by the standard of that identifier."""
    if standard.startswith("iso230-2"):
        return iso(up, down, 3 if standard.endswith("1988") else 2, since_1997=not standard.endswith("1988"))
    if standard.startswith("vdi"):
        return vdi(up, down, 3 if standard == "vdi-dgq-3441" else 2)
    return nmtba(up, down)


def iso(up: Direction, down: Direction, k: int, *, since_1997: bool) -> Results:
    targets = range(len(up))
    both = any(up) and any(down)
    x_up, x_down = [mean(readings) for readings in up], [mean(readings) for readings in down]
    s_up, s_down = [deviation(readings) for readings in up], [deviation(readings) for readings in down]
    reversal = [less(x_up[i], x_down[i]) for i in targets]
    r_up = [None if s is None else 2 * k * s for s in s_up]
    r_down = [None if s is None else 2 * k * s for s in s_down]
    r: list[Value] = []
    for i in targets:
        if s_up[i] is None or s_down[i] is None:
            r.append(None)
            continue
        across = k * s_up[i] + k * s_down[i] + abs(reversal[i])
        r.append(max(across, 2 * k * s_up[i], 2 * k * s_down[i]))
    high_up = [None if s_up[i] is None else x_up[i] + k * s_up[i] for i in targets]
    low_up = [None if s_up[i] is None else x_up[i] - k * s_up[i] for i in targets]
    high_down = [None if s_down[i] is None else x_down[i] + k * s_down[i] for i in targets]
    low_down = [None if s_down[i] is None else x_down[i] - k * s_down[i] for i in targets]
    half_sums = [None if b is None else (x_up[i] + x_down[i]) / 2 for i, b in enumerate(reversal)]
    limits_of_both = there(high_up) and there(high_down)
    parameters = {
        "A": less(top(high_up + high_down), bottom(low_up + low_down)) if limits_of_both else None,
        "A_fwd": less(top(high_up), bottom(low_up)),
        "A_bwd": less(top(high_down), bottom(low_down)),
        "R": top(r),
        "R_fwd": top(r_up),
        "R_bwd": top(r_down),
        "B": top([None if b is None else abs(b) for b in reversal]),
        "B_mean": mean(there(reversal)),
    }
    if since_1997:
        parameters |= {
            "E": less(top(x_up + x_down), bottom(x_up + x_down)) if both else None,
            "E_fwd": less(top(x_up), bottom(x_up)),
            "E_bwd": less(top(x_down), bottom(x_down)),
            "M": less(top(half_sums), bottom(half_sums)),
        }
    return Results(parameters, {"R_fwd": r_up, "R_bwd": r_down, "R": r})


def vdi(up: Direction, down: Direction, k: int) -> Results:
    single = None if any(up) and any(down) else (up if any(up) else down)
    x: list[Value] = []
    spread: list[Value] = []
    span: list[Value] = []
    half: list[Value] = []
    for j in range(len(up)):
        if single is not None:
            s = deviation(single[j])
            x.append(mean(single[j]))
            span.append(None)
            spread.append(None if s is None else k * (s + s))
            half.append(None if s is None else spread[j] / 2)
            continue
        x_up, x_down = mean(up[j]), mean(down[j])
        s_up, s_down = deviation(up[j]), deviation(down[j])
        missing = x_up is None or x_down is None
        x.append(None if missing else (x_up + x_down) / 2)
        span.append(None if missing else abs(x_up - x_down))
        spread.append(None if s_up is None or s_down is None else k * (s_up + s_down))
        half.append(None if spread[j] is None else (span[j] + spread[j]) / 2)
    high = [None if h is None else x[j] + h for j, h in enumerate(half)]
    low = [None if h is None else x[j] - h for j, h in enumerate(half)]
    return Results(
        {
            "P": less(top(high), bottom(low)),
            "Pa": less(top(x), bottom(x)),
            "Ps_max": top(spread),
            "Ps_mean": mean(there(spread)),
            "U_max": top(span),
            "U_mean": mean(there(span)),
        },
        {"U": span, "Ps": spread},
    )


def nmtba(up: Direction, down: Direction) -> Results:
    both = any(up) and any(down)
    x: list[Value] = []
    spread: list[Value] = []
    for j in range(len(up)):
        pooled = [*up[j], *down[j]]
        if both and not (up[j] and down[j]):
            pooled = []
        x.append(mean(pooled))
        s = deviation(pooled)
        spread.append(None if s is None else 6 * s)
    high = [None if p is None else x[j] + p / 2 for j, p in enumerate(spread)]
    low = [None if p is None else x[j] - p / 2 for j, p in enumerate(spread)]
    return Results(
        {
            "P": less(top(high), bottom(low)),
            "Pa": less(top(x), bottom(x)),
            "Ps_max": top(spread),
            "Ps_mean": mean(there(spread)),
            "O": -(top(high) + bottom(low)) / 2 if there(high) else None,
        },
        {"X": x, "Ps": spread},
    )


def mean(values: Readings) -> Value:
    return math.fsum(values) / len(values) if values else None


def deviation(readings: Readings) -> Value:
    if len(readings) < 2:
        return None
    middle = mean(readings)
    return math.sqrt(math.fsum((x - middle) ** 2 for x in readings) / (len(readings) - 1))


def there(values: Iterable[Value]) -> list[float]:
    return [value for value in values if value is not None]


def top(values: Iterable[Value]) -> Value:
    return max(there(values), default=None)


def bottom(values: Iterable[Value]) -> Value:
    return min(there(values), default=None)


def less(minuend: Value, subtrahend: Value) -> Value:
    return None if minuend is None or subtrahend is None else minuend - subtrahend
