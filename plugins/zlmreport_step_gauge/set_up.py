"""What a job states of its step gauge, read and in SI: expansion, radius, location."""

from __future__ import annotations

from dataclasses import dataclass

from zlmreport.plugin import (
    CELSIUS,
    MICROMETRE,
    MICROMETRE_PER_METRE_KELVIN,
    MILLIMETRE,
    InputError,
    Place,
    above_reference_temperature,
)
from zlmreport.plugin.extension import Job
from zlmreport.plugin.source import SourceFile
from zlmreport_step_gauge.calibration import CalibratedGauge, cut_section, read_calibration
from zlmreport_step_gauge.gauge import StepGauge
from zlmreport_step_gauge.initial_points import read_initial_points
from zlmreport_step_gauge.keys import StepGaugeKeys
from zlmreport_step_gauge.location import Located, locate


@dataclass(frozen=True, slots=True)
class Expansion:
    """The expansion of the gauge or of the machine's scale, α·ΔT."""

    coefficient: float  #: α, 1/K.
    difference: float  #: ΔT, its temperature above that at which its lengths hold, K.

    @property
    def factor(self) -> float:
        """By what a length grows: 1 + α·ΔT."""
        return 1 + self.coefficient * self.difference


@dataclass(frozen=True, slots=True)
class StatedRadius:
    """An effective radius that was calibrated elsewhere, and its standard uncertainty, m."""

    radius: float
    uncertainty: float


@dataclass(frozen=True, slots=True)
class GaugeSetUp:
    """The gauge, where it lies, and what is known of the probe and of the temperatures."""

    gauge: StepGauge  #: The section that is used.
    located: Located | None  #: Where it lies; None where the job names no initial points.
    tip_radius: float | None  #: Nominal, m; None where it is not stated.
    radius_is_corrected: bool  #: Whether coordinates are those of the surface.
    effective_radius: StatedRadius | None  #: As stated; None where it is to be determined from the gauge.
    probing_uncertainty: float  #: Standard uncertainty of a single touch, m.
    #: gauge_expansion and scale_expansion: What is compensated here; None where nothing is.
    gauge_expansion: Expansion | None
    scale_expansion: Expansion | None
    files: tuple[SourceFile, ...]  #: That all this was read from.
    place: Place  #: Where the job describes it.


def make_gauge_set_up(job: Job, keys: StepGaugeKeys) -> GaugeSetUp:
    """Return the set-up that a job describes.

    Raises `AccessError` if a file cannot be read; `InputError` with every defect of these files, and with
    what a compensation needs and the job does not state.
    """
    calibrated = read_calibration(keys.calibration)
    named = next((key for key in ("last_block", "first_block") if getattr(keys, key)), "calibration")
    gauge = cut_section(
        calibrated.gauge, keys.first_block, keys.last_block, job.place_of(f"step_gauge.{named}")
    )
    located, files = _locate(keys, gauge, calibrated, job)
    stated = None
    if keys.effective_radius is not None:
        stated = StatedRadius(
            MILLIMETRE.to_si(keys.effective_radius), MICROMETRE.to_si(keys.effective_radius_uncertainty)
        )
    return GaugeSetUp(
        gauge=gauge,
        located=located,
        tip_radius=None if keys.tip_radius is None else MILLIMETRE.to_si(keys.tip_radius),
        radius_is_corrected=keys.radius_correction,
        effective_radius=stated,
        probing_uncertainty=MICROMETRE.to_si(keys.probing_uncertainty),
        gauge_expansion=_make_expansion_of_gauge(keys, gauge, job),
        scale_expansion=_make_expansion_of_scale(keys, job),
        files=files,
        place=job.place_of("step_gauge"),
    )


def _locate(
    keys: StepGaugeKeys, gauge: StepGauge, calibrated: CalibratedGauge, job: Job
) -> tuple[Located | None, tuple[SourceFile, ...]]:
    if keys.initial_points is None:
        return None, (calibrated.file,)
    if keys.tip_radius is None and not keys.radius_correction:
        raise InputError.at(
            job.place_of("step_gauge"),
            "step_gauge.tip_radius is missing: the initial points are centres of the tip (or else state "
            "radius_correction: true)",
        )
    points = read_initial_points(keys.initial_points)
    radius = 0.0 if keys.radius_correction else MILLIMETRE.to_si(keys.tip_radius or 0.0)
    located = locate(points, gauge, radius, MICROMETRE.to_si(keys.initial_points_uncertainty))
    return located, (calibrated.file, *([points.source] if points.source else []))


def _make_expansion_of_gauge(keys: StepGaugeKeys, gauge: StepGauge, job: Job) -> Expansion | None:
    if keys.compensate == "nothing" or keys.gauge_temperature is None:
        return None
    coefficient = gauge.expansion_coefficient
    instrument = job.keys.instrument
    if coefficient is None and instrument and instrument.expansion_coefficient is not None:
        coefficient = instrument.expansion_coefficient * MICROMETRE_PER_METRE_KELVIN
    if coefficient is None:
        raise InputError.at(
            job.place_of("step_gauge.compensate"),
            f"the expansion of the gauge needs its coefficient, and {gauge.place.file} does not state it; "
            "add instrument.expansion_coefficient",
        )
    return Expansion(coefficient, CELSIUS.to_si(keys.gauge_temperature) - gauge.reference_temperature)


def _make_expansion_of_scale(keys: StepGaugeKeys, job: Job) -> Expansion | None:
    if keys.compensate != "gauge-and-scale":
        return None
    environment = job.keys.environment
    temperature = environment.axis_temperature if environment else None
    coefficient = environment.expansion_coefficient if environment else None
    if not isinstance(temperature, float) or not isinstance(coefficient, float):
        raise InputError.at(
            job.place_of("step_gauge.compensate"),
            "the expansion of the scale needs numbers in environment.axis_temperature and "
            "environment.expansion_coefficient",
        )
    return Expansion(
        coefficient * MICROMETRE_PER_METRE_KELVIN, above_reference_temperature(CELSIUS.to_si(temperature))
    )


def round_to_two_digits(value: float) -> float:
    """Return an uncertainty, a scatter or a small angle with the digits that are said of it."""
    return float(f"{value:.2g}")
