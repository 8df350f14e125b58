"""The group of job keys `step_gauge`, and what a job with it gets by it."""

from __future__ import annotations

from collections.abc import Iterable

from zlmreport.plugin import (
    AxisKind,
    Contribution,
    DataSource,
    Described,
    Extension,
    ExtensionPlan,
    Job,
    JobKeys,
    KeyStep,
    LiveRun,
    MeasurementSet,
    Standard,
    Writer,
    hookimpl,
)
from zlmreport_step_gauge.calibration import FORMAT, with_gauge_as_instrument
from zlmreport_step_gauge.certificate import TITLE, described
from zlmreport_step_gauge.keys import StepGaugeKeys, contradictions
from zlmreport_step_gauge.machines.live import EMULATE, live_run
from zlmreport_step_gauge.machines.run import live_probing
from zlmreport_step_gauge.paths.foretold import foretold
from zlmreport_step_gauge.paths.path import ProbingPath
from zlmreport_step_gauge.set_up import GaugeSetUp, gauge_set_up
from zlmreport_step_gauge.source import StepGaugeSource
from zlmreport_step_gauge.standard import StepGaugeEvaluation
from zlmreport_step_gauge.uncertainty import gauge_contributions


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
        for key, message in contradictions(options):
            yield ("step_gauge", key), message

    def completed(self, keys: JobKeys, options: StepGaugeKeys) -> JobKeys:
        """Return the keys of a job whose step gauge is its measuring instrument, unless it names another."""
        return with_gauge_as_instrument(keys, options.calibration)

    def set_up(self, job: Job, options: StepGaugeKeys) -> GaugeSetUp:
        """Return the gauge, where it lies, and what is known of the probe and of the temperatures."""
        return gauge_set_up(job, options)

    def contributions(
        self, job: Job, options: StepGaugeKeys, measurements: MeasurementSet
    ) -> tuple[Contribution, ...]:
        """Return what the gauge contributes to the uncertainty, instead of an instrument."""
        stated_as_range = job.keys.uncertainty.device_expansion_coefficient is not None
        return gauge_contributions(
            gauge_set_up(job, options), measurements, expansion_is_stated=stated_as_range
        )

    def described(self, job: Job, options: StepGaugeKeys, writer: Writer) -> Described:
        """Return which section of the gauge was used, where it lay, and the graph of its calibration."""
        return described(gauge_set_up(job, options), writer)

    def plan(self, job: Job, options: StepGaugeKeys) -> ExtensionPlan:
        """Return the plan of the path over the gauge."""
        return foretold(job, options)

    def live(self, job: Job, options: StepGaugeKeys) -> LiveRun | None:
        """Return the run of the machine that the data source names."""
        probing = live_probing(job, options)
        return live_run(probing) if probing else None


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
