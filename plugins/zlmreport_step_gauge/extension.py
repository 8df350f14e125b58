"""The extension ``step_gauge``: its facts and graph in the certificate, and all that it offers."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

import numpy as np

from zlmreport.plugin import (
    CELSIUS,
    MICROMETRE,
    MICRORADIAN,
    MILLIMETRE,
    AxisKind,
    Figure,
    MeasurementSet,
    Words,
    fixed_number,
    hookimpl,
    read_only_floats,
)
from zlmreport.plugin.extension import Contribution, Extension, ExtensionPlan, Job, JobKeys, KeyStep, LiveRun
from zlmreport.plugin.renderer import Described, Fact, Graph, Writer
from zlmreport.plugin.source import DataSource
from zlmreport.plugin.standard import Band, Curve, Panel, Role, Standard
from zlmreport_step_gauge.calibration import FORMAT, name_gauge_as_instrument
from zlmreport_step_gauge.gauge import Side, StepGauge
from zlmreport_step_gauge.keys import StepGaugeKeys, find_contradictions
from zlmreport_step_gauge.location import Located
from zlmreport_step_gauge.machines.live import EMULATE, make_live_run
from zlmreport_step_gauge.machines.run import find_live_probing
from zlmreport_step_gauge.paths.foretold import foretell
from zlmreport_step_gauge.paths.path import ProbingPath
from zlmreport_step_gauge.set_up import GaugeSetUp, make_gauge_set_up, round_to_two_digits
from zlmreport_step_gauge.source import StepGaugeSource
from zlmreport_step_gauge.standard import StepGaugeEvaluation
from zlmreport_step_gauge.uncertainty import list_gauge_contributions

#: Heads what a certificate says of a gauge.
TITLE = Words("Step gauge")
_SECTION = Words("blocks {first} to {last}")
_APART = Words(
    "The step gauge is stated at {gauge} °C, and the air at {air} °C: they lie {difference} K apart"
)
#: Kelvins by which a gauge that lay on the machine for an hour hardly differs from the air.
_ALIKE = 5.0


def describe(set_up: GaugeSetUp, writer: Writer) -> Described:
    """Return which section of the gauge was used, where it lay, and the graph of its calibration."""
    facts = tuple(_list_facts(set_up, writer))
    return Described(TITLE, facts, (Graph(draw_gauge_calibration(set_up.gauge)),))


def _list_facts(set_up: GaugeSetUp, writer: Writer) -> Iterator[Fact]:
    numbers = set_up.gauge.blocks
    yield Fact(
        Words("Section used"),
        writer.say(_SECTION.given(first=numbers[0], last=numbers[-1])),
        ("step_gauge.first_block", "step_gauge.last_block"),
    )
    if set_up.located:
        yield from _list_location_facts(set_up.located, writer)


def _list_location_facts(located: Located, writer: Writer) -> Iterator[Fact]:
    key = ("step_gauge.initial_points",)
    location = located.location
    yield Fact(Words("Begins at C1"), _write_point(location.begin, writer), key)
    yield Fact(Words("Ends at C2"), _write_point(location.end, writer), key)
    yield Fact(
        Words("Direction C1C2"),
        f"u = {writer.number(round_to_two_digits(MICRORADIAN.from_si(location.direction_uncertainty)))} µrad",
        key,
    )


def _write_point(coordinates: tuple[float, float, float], writer: Writer) -> str:
    """Write coordinates to a micrometre: x / y / z."""
    sign = writer.language.decimal_sign
    return " / ".join(fixed_number(MILLIMETRE.from_si(each), 3, sign) for each in coordinates) + " mm"


_TITLE = Words(
    "Calibration of the step gauge: calibrated minus nominal distance of the faces of the blocks {first} "
    "to {last} from the reference face, with U (k = 2)"
)
_SENTENCE = Words("Graph over the nominal distance, {low} mm to {high} mm. {front} {back}")
_RANGE = Words("{side} from {low} µm to {high} µm.")
_SIDES = {
    Side.FRONT: Words("Front faces"),
    Side.BACK: Words("Back faces"),
}
_X_TITLE = Words("Nominal distance from the reference face")
_Y_TITLE = Words("Calibrated − nominal")
_LOOKS = {
    Side.FRONT: ("S↑", "S↑ ± U", Role.MEAN_POSITIVE, Role.LIMIT_POSITIVE),
    Side.BACK: ("S↓", "S↓ ± U", Role.MEAN_NEGATIVE, Role.LIMIT_NEGATIVE),
}


def draw_gauge_calibration(gauge: StepGauge) -> Figure:
    """Return the graph of a gauge, or of a section of it: front faces, touched in ↑, and back faces, in ↓."""
    curves, bands = zip(*(_draw_side(gauge, side) for side in Side), strict=True)
    nominal = [MILLIMETRE.from_si(face.nominal) for face in gauge.faces]
    front, back = (_write_range(curve, side) for curve, side in zip(curves, Side, strict=True))
    return Figure(
        key="gauge-calibration",
        title=_TITLE.given(first=gauge.blocks[0], last=gauge.blocks[-1]),
        alternative=_SENTENCE.given(low=nominal[0], high=nominal[-1], front=front, back=back),
        x_title=_X_TITLE,
        y_title=_Y_TITLE,
        x_unit=MILLIMETRE.symbol,
        y_unit=MICROMETRE.symbol,
        panels=(Panel(curves=curves, bands=bands),),
    )


def _draw_side(gauge: StepGauge, side: Side) -> tuple[Curve, Band]:
    faces = [face for face in gauge.faces if face.side is side]
    x = read_only_floats([MILLIMETRE.from_si(face.nominal) for face in faces])
    y = np.array([MICROMETRE.from_si(face.distance - face.nominal) for face in faces])
    expanded = np.array([MICROMETRE.from_si(face.expanded_uncertainty) for face in faces])
    symbol, limits, mean, limit = _LOOKS[side]
    return (
        Curve(symbol, mean, x, read_only_floats(y)),
        Band(limits, limit, x, read_only_floats(y - expanded), read_only_floats(y + expanded)),
    )


def _write_range(curve: Curve, side: Side) -> Words:
    return _RANGE.given(
        side=_SIDES[side],
        low=float(round(float(curve.y.min()), 3)),
        high=float(round(float(curve.y.max()), 3)),
    )


def _find_air_temperature(job: Job, measurements: MeasurementSet) -> float | None:
    """Return the temperature of the air, °C: as stated, or else the mean of its log; None without either."""
    stated = job.keys.environment.air_temperature if job.keys.environment else None
    if isinstance(stated, float):
        return stated
    logged = measurements.conditions.get("air_temperature")
    if logged is None or np.isnan(logged).all():
        return None
    return float(round(CELSIUS.from_si(float(np.nanmean(logged))), 2))


class StepGaugeExtension(Extension):
    """A calibrated step gauge instead of a laser."""

    identifier = "step_gauge"
    title = TITLE
    description = "A calibrated step gauge instead of a laser: the gauge, where it lies, how it is probed."
    example = {"calibration": "gauge.yaml", "initial_points": "initial-points.csv", "tip_radius": 2}  # noqa: RUF012 - read only
    options = StepGaugeKeys
    programs = ("path", "programs")
    takes = ProbingPath
    formats = (FORMAT,)
    commands = (EMULATE,)

    def contradictions(
        self, keys: JobKeys, options: StepGaugeKeys
    ) -> Iterable[tuple[tuple[KeyStep, ...], str]]:
        """Yield what no single key shows to be wrong."""
        if keys.axis.kind is AxisKind.ROTARY:
            yield (
                ("step_gauge",),
                "a step gauge has lengths, and the axis is rotary (axis.kind); take one out",
            )
        for key, message in find_contradictions(options):
            yield ("step_gauge", key), message

    def completed(self, keys: JobKeys, options: StepGaugeKeys) -> JobKeys:
        """Return the keys of a job whose step gauge is its measuring instrument, unless it names another."""
        return name_gauge_as_instrument(keys, options.calibration)

    def set_up(self, job: Job, options: StepGaugeKeys) -> GaugeSetUp:
        """Return the gauge, where it lies, and what is known of the probe and of the temperatures."""
        return make_gauge_set_up(job, options)

    def contributions(
        self, job: Job, options: StepGaugeKeys, measurements: MeasurementSet
    ) -> tuple[Contribution, ...]:
        """Return what the gauge contributes to the uncertainty, instead of an instrument."""
        stated_as_range = job.keys.uncertainty.device_expansion_coefficient is not None
        return list_gauge_contributions(
            make_gauge_set_up(job, options), measurements, expansion_is_stated=stated_as_range
        )

    def doubts(self, job: Job, options: StepGaugeKeys, measurements: MeasurementSet) -> Iterator[Words]:
        """Yield that the gauge is far from the temperature of the air."""
        air = _find_air_temperature(job, measurements)
        gauge = options.gauge_temperature
        if gauge is not None and air is not None and abs(gauge - air) > _ALIKE:
            difference = float(f"{abs(gauge - air):.3g}")
            yield _APART.given(gauge=gauge, air=air, difference=difference)

    def described(self, job: Job, options: StepGaugeKeys, writer: Writer) -> Described:
        """Return which section of the gauge was used, where it lay, and the graph of its calibration."""
        return describe(make_gauge_set_up(job, options), writer)

    def plan(self, job: Job, options: StepGaugeKeys) -> ExtensionPlan:
        """Return the plan of the path over the gauge."""
        return foretell(job, options)

    def live(self, job: Job, options: StepGaugeKeys) -> LiveRun | None:
        """Return the run of the machine that the data source names."""
        probing = find_live_probing(job, options)
        return make_live_run(probing) if probing else None


@hookimpl
def zlmreport_extensions() -> Iterable[Extension]:
    """Return the group of job keys `step_gauge`."""
    return [StepGaugeExtension()]


@hookimpl
def zlmreport_sources() -> Iterable[DataSource]:
    """Return the reader of probed faces."""
    return [StepGaugeSource()]


@hookimpl
def zlmreport_standards() -> Iterable[Standard]:
    """Return the evaluation by Pahk and Kim."""
    return [StepGaugeEvaluation()]
