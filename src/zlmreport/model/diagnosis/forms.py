"""Nameless shapes tried as formulas: bump, saw, wave, kink, step, plateau, bow, fading.

Bump, saw, wave, kink, step, bow, fading and a late beginning are laid along the axis or in time, for both
directions alike, opposite, or in one of them. They stand for causes that nobody has installed: in a contest
they are rivals without a name, and what is left beside a model is proposed as one of them.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import product

import numpy as np

from zlmreport.job.formula import find_names_in, parse_formula
from zlmreport.job.formula_keys import FormulaKeys, FormulaParameter
from zlmreport.language import Words
from zlmreport.measurement.arrays import FloatArray
from zlmreport.measurement.axis import AxisKind
from zlmreport.model.effects.design import Design
from zlmreport.model.effects.formula import FormulaEffect

#: Widths of bumps, shares of the travel or the duration.
_WIDTHS = (0.04, 0.08, 0.15, 0.3, 0.5)
#: Periods within travel or duration.
_FEWEST, _PER_PERIOD = 1.25, 4
#: Phases of a saw that are tried.
PHASES = 8
_MOST_PERIODS, _PLACES = 12.0, 24
#: Of the places in time, the first at which a late beginning may lie: what begins with the test warms up,
#: and that has a name.
_LATE = 3
#: Periods of a saw at least: one that jumps once is a joint beside a slope, and these have names.
_FEWEST_OF_SAW = 2.0
#: Of the travel, the longest stretch that is displaced as a whole: the ends of a longer one are two joints.
_LONGEST = 1 / 3
#: Steps between targets in a period, or in a width, that at least must tell it.
_LEAST_IN_PERIOD, _LEAST_IN_WIDTH = 2.0, 1.5
_DIGITS, _OF_STATED = 3, 6


@dataclass(frozen=True, slots=True)
class Form:
    """A form along one coordinate `{x}`, position or time; `{a}` and `{b}` are its sizes, with a carrier."""

    name: str
    text: str
    searched: tuple[str, ...]  #: Of c, a place, e, an end, w, a width, and L, a period: what is searched.
    shape: Words  #: With places for width, period and the carrier.
    is_slope: bool = False  #: Whether its size is one per position.

    @property
    def numbers(self) -> int:
        """How many numbers decide it."""
        return len(self.searched) + ("{a}" in self.text) + ("{b}" in self.text)


BUMP = Form(
    "bump",
    "{a}*exp(-4*log(2)*(({x} - c)/w)^2)",
    ("c", "w"),
    Words("a bump, {width} wide"),
)
SAW = Form(
    "saw",
    "{a}*atan(tan(pi*({x} - c)/L))/pi",
    ("c", "L"),
    Words("a saw with a period of {period}"),
)
WAVE = Form(
    "wave",
    "{a}*sin(2*pi*{x}/L) + {b}*cos(2*pi*{x}/L)",
    ("L",),
    Words("a wave with a period of {period}"),
)
KINK = Form(
    "kink",
    "{a}*max(0, {x} - c)",
    ("c",),
    Words("a change of slope at one place"),
    is_slope=True,
)
STEP = Form("step", "{a}*step({x} - c)", ("c",), Words("a step"))
# By its ends, not its middle and length: it is searched one value after another, and each end has its gap.
PLATEAU = Form(
    "plateau",
    "{a}*step({x} - c)*step(e - {x})",
    ("c", "e"),
    Words("a stretch displaced as a whole, {width} long"),
)
BOW = Form("bow", "{a}*(1 - (({x} - c)/w)^2)", (), Words("a bow"))
FADING = Form(
    "fading",
    "{a}*exp(-abs({x} - c)/w)",
    ("w",),
    Words("fading from one end within {width}"),
)
LATE = Form(
    "late",
    "{a}*(1 - exp(-max(0, {x} - c)/w))",
    ("c", "w"),
    Words("a beginning that takes {width}"),
)
_ALONG_AXIS = (BUMP, PLATEAU, SAW, WAVE, KINK, STEP, BOW, FADING)
_IN_TIME = (BUMP, WAVE, STEP, LATE)
#: Numbers of a line: what it leaves of as many targets as a form has numbers, any form describes.
_OF_A_LINE = 2
#: Whose phase makes a carrier of one direction no other form.
_DIRECTIONS = {"D": "D*", "up": "step(D)*", "down": "step(-D)*"}
#: What a carrier makes of the words of a form.
CARRIERS = {
    "": Words("{shape}, alike in both directions"),
    "D": Words("{shape} in the reversal"),
    "up": Words("{shape}, upwards only"),
    "down": Words("{shape}, downwards only"),
    "time": Words("{shape} in time, at all positions alike"),
    "lever": Words("{shape} in time, in proportion to the position"),
}
IN_TIME = frozenset({"time", "lever"})
#: Forms that begin or bend at one place.
LOCAL = (BUMP, PLATEAU, STEP, KINK, LATE)
#: Forms that jump at each place that is searched.
JUMPING = (STEP, PLATEAU)
_SEARCHED = frozenset("cewL")


class UnnamedForm(FormulaEffect):
    """A form with a carrier on a design.

    `along`, (n,): The places or moments along which it is laid, rising, SI. `starts`, (g, s): Values of its
    searched parameters that are tried, SI, in their order.
    """

    def __init__(self, form: Form, carrier: str, design: Design, starts: FloatArray, end: float) -> None:
        """Lay a form along a design.

        `starts`, (g, k): Values of what the form searches, in its order.
        `end`: Of a fading one, where it begins.
        """
        self.form, self.carrier = form, carrier
        self.along = np.unique(design.time) if carrier in IN_TIME else design.target_positions
        first, last = float(self.along[0]), float(self.along[-1])
        middle, extent = (first + last) / 2, last - first
        stated = {"c": middle if form is BOW else end, "w": extent / 2}
        ranges = {name: (first, last) if name in "ce" else (extent / 8, extent / 4) for name in form.searched}
        super().__init__(_make_keys((form, carrier), design.axis.kind, stated, ranges), design.axis.kind)
        named = dict(zip(form.searched, starts.T, strict=True))
        constant = np.ones(len(starts))
        self.starts = np.column_stack(
            [np.empty((len(starts), 0))]
            + [
                named.get(each.name, constant * self.formula.given.get(each.name, 0.0))
                for each in self.searched
            ]
        )

    def grid(self, design: Design) -> FloatArray:  # noqa: ARG002 - that of its own design
        """Return the values that are tried."""
        return self.starts

    def list_values(self, theta: FloatArray) -> dict[str, float]:
        """Return where it is, how wide and with which period, as far as that is searched: c, w and L."""
        named = self._name_searched_values(theta)
        if "e" in named:
            first, last = named.pop("c"), named.pop("e")
            return {"c": (first + last) / 2, "w": last - first}
        return named

    def _name_searched_values(self, theta: FloatArray) -> dict[str, float]:
        return {
            each.name: value
            for each, value in zip(self.searched, theta.tolist(), strict=True)
            if each.name in self.form.searched
        }

    def propose_formula(self, theta: FloatArray, design: Design) -> FormulaKeys:
        """Return its formula with ranges around the values that were found, named after its place."""
        named = self.list_values(theta)
        scale = 1.0 if self.carrier in IN_TIME else design.axis.position_unit.per_si
        width = named.get("w", named.get("L", float(np.ptp(self.along)) / 4))
        ranges = {
            name: self._reach_around(value, width) if name in "ce" else (value / 1.5, value * 1.5)
            for name, value in self._name_searched_values(theta).items()
        }
        marked = named.get("c") if self.form in LOCAL else named.get("L", named.get("w"))
        return _make_keys(
            (self.form, self.carrier),
            design.axis.kind,
            self.formula.given,
            ranges,
            None if marked is None else marked * scale,
        )

    def _reach_around(self, place: float, width: float) -> tuple[float, float]:
        """Return where a place is looked for: beyond the readings only a bump has its middle."""
        low, high = place - width / 2, place + width / 2
        if self.form not in LOCAL or self.form is BUMP:
            return low, high
        return max(low, float(self.along[0])), min(high, float(self.along[-1]))

    def count_periods(self, theta: FloatArray) -> float:
        """Return how many periods what was measured has."""
        return float(np.ptp(self.along)) / self.list_values(theta)["L"]

    def list_gaps(self) -> FloatArray:
        """Return the middles between neighbours along it, rising, SI: a jump is the same between two."""
        return np.asarray((self.along[:-1] + self.along[1:]) / 2)

    def find_extent(self, theta: FloatArray) -> tuple[float, float]:
        """Return where it begins and ends, within what was measured, SI."""
        first, last = float(self.along[0]), float(self.along[-1])
        named = self.list_values(theta)
        if self.form in (BUMP, PLATEAU):
            half = named["w"] / 2
            return max(first, named["c"] - half), min(last, named["c"] + half)
        if self.form in LOCAL:
            return min(max(first, named["c"]), last), last
        return first, last


def list_unnamed_forms(design: Design) -> Iterator[UnnamedForm]:
    """Yield every form with every carrier that a design can tell."""
    carriers = ("", *_DIRECTIONS) if design.is_bidirectional else ("",)
    for form in _ALONG_AXIS:
        starts = _choose_starts(form, design.target_positions)
        for carrier in carriers if len(starts) else ():
            # A periodic form in one direction is the sum of the like and the opposite: these are enough.
            if not ({"L"} & {*form.searched} and carrier in {"up", "down"}):
                yield from _lay_forms(form, carrier, design, starts)
    moments = np.unique(design.time)
    if design.duration > 0 and not design.session.any():
        for form in _IN_TIME:
            starts = _choose_starts(form, moments)
            for carrier in sorted(IN_TIME) if len(starts) else ():
                yield from _lay_forms(form, carrier, design, starts)


def _lay_forms(form: Form, carrier: str, design: Design, starts: FloatArray) -> Iterator[UnnamedForm]:
    """Yield a form; a fading one from either end."""
    ends = design.target_positions[[0, -1]] if form is FADING else design.target_positions[:1]
    for end in ends.tolist():
        yield UnnamedForm(form, carrier, design, starts, end)


def _choose_starts(form: Form, along: FloatArray) -> FloatArray:
    """Return values that are tried along a coordinate, SI, shape (g, s)."""
    first, last = float(along[0]), float(along[-1])
    extent, count = last - first, len(along)
    if count - _OF_A_LINE <= form.numbers:
        return np.empty((0, len(form.searched)))
    inner = np.linspace(first, last, _PLACES)
    gaps = ((along[1:-2] + along[2:-1]) / 2)[:: max(1, count // (2 * _PLACES))]
    widths = [share * extent for share in _WIDTHS if share * (count - 1) >= _LEAST_IN_WIDTH]
    # Of targets at equal steps a wave that is shorter than two of them looks like one that is longer.
    most = min(_MOST_PERIODS, (count - 1) / _LEAST_IN_PERIOD)
    periods = extent / np.arange(_FEWEST, most + 1e-9, 1 / _PER_PERIOD)
    phases = np.arange(PHASES) / PHASES
    rows: Sequence[tuple[float, ...]]
    match form.searched:
        case ("c", "w"):
            rows = list(product(inner[_LATE if form is LATE else 0 :].tolist(), widths))
        case ("c", "e"):
            return _list_stretches(along)
        case ("c", "L"):
            # The jump of a saw needs targets on either side, in more than one period.
            listed = [each for each in periods[: len(periods) // 2] if extent >= _FEWEST_OF_SAW * each]
            rows = [(first + phase * each, each) for each in listed for phase in phases]
        case ("c",):
            rows = [(each,) for each in (gaps if form is STEP else inner[2:-2]).tolist()]
        case ("w",):
            rows = [(each,) for each in widths]
        case ("L",):
            rows = [(each,) for each in periods.tolist()]
        case _:
            rows = [()]
    return np.array(rows, dtype=np.float64).reshape(len(rows), len(form.searched))


def _list_stretches(along: FloatArray) -> FloatArray:
    """Return the ends of the stretches between two gaps of targets, up to a third of the travel."""
    gaps = (along[:-1] + along[1:]) / 2
    gaps = gaps[:: max(1, len(gaps) // _PLACES)]
    first, last = np.triu_indices(len(gaps), k=1)
    lengths = gaps[last] - gaps[first]
    fewest = _LEAST_IN_WIDTH * float(np.ptp(along)) / (len(along) - 1)
    is_tried = (lengths >= fewest) & (lengths <= _LONGEST * np.ptp(along))
    return np.column_stack([gaps[first], gaps[last]])[is_tried]


def _make_keys(
    laid: tuple[Form, str],
    kind: AxisKind,
    stated: Mapping[str, float],
    ranges: Mapping[str, tuple[float, float]],
    marked: float | None = None,
) -> FormulaKeys:
    """Return a form as the keys of a formula.

    `laid`: The form, and its carrier.
    `stated`, `ranges`: Of its parameters, SI; those without a range are stated.
    `marked`: The number that stands in its name.
    """
    form, carrier = laid
    is_linear, is_time = kind is AxisKind.LINEAR, carrier in IN_TIME
    slope = "um/m" if is_linear else "arcsec/deg"
    size = slope if form.is_slope or carrier == "lever" else "um" if is_linear else "arcsec"
    unit, per_si = ("mm", 1e3) if is_linear else ("deg", 180.0 / np.pi)
    if is_time:
        unit, per_si = "s", 1.0
    before = "P*" if carrier == "lever" else _DIRECTIONS.get(carrier, "")
    text = form.text.format(
        x="t" if is_time else "P", a=f"a*{before}".rstrip("*"), b=f"b*{before}".rstrip("*")
    )
    used = [name for name in find_names_in(parse_formula(text)) if name in _SEARCHED]
    parameters = {name: FormulaParameter(unit=size) for name in ("a", "b") if f"{name}*" in text}
    for name in used:
        if name in ranges:
            low, high = (_round_to(end * per_si) for end in ranges[name])
            parameters[name] = FormulaParameter(unit=unit, range=(low, high))
        else:
            parameters[name] = FormulaParameter(unit=unit, value=_round_to(stated[name] * per_si, _OF_STATED))
    words = [form.name, *([carrier.lower()] if carrier else [])]
    if marked is not None:
        words += [f"{abs(marked):.0f}", unit]
    return FormulaKeys(name="-".join(words), formula=text, parameters=parameters)


def _round_to(value: float, digits: int = _DIGITS) -> float:
    return float(f"{value:.{digits}g}")
