"""Keys of a job on evaluation: standards, limits, decision rule, uncertainty, model, plan, programs."""

from collections.abc import Iterator, Mapping
from typing import Annotated, Any, Literal, Self, TypeAlias

from pydantic import BaseModel, ConfigDict, Field, model_validator

from zlmreport.errors import list_names, quoted
from zlmreport.job.circle_keys import CirclePlanKeys
from zlmreport.job.types import Finite, JobPart, JobPath, NotNegative, Positive, Text, optional
from zlmreport.measurement.axis import AxisKind
from zlmreport.measurement.measurand import POSITIONING

#: Of every uncertainty that a job states as expanded.
STATED_COVERAGE_FACTOR = 2.0
#: `zlmreport.evaluation.uncertainty.budget.Acts`, by its values.
ActsName: TypeAlias = Literal[
    "along-the-length",
    "between-directions",
    "with-the-reading",
    "at-the-datum",
    "at-each-position",
    "round-the-circle",
    "off-centre",
    "at-each-approach",
    "in-time",
    "at-each-reading",
]
#: The usual contributors, by the names that `uncertainty` has for them; the instrument has its own keys.
ContributorName: TypeAlias = Literal[
    "instrument",
    "misalignment",
    "machine_temperature",
    "device_temperature",
    "expansion_coefficient",
    "device_expansion_coefficient",
    "air_temperature",
    "air_pressure",
    "relative_humidity",
    "calibrated_length",
    "centring",
    "square",
    "foot_spacing",
    "environmental_variation",
    "resolution",
]


class ContributionKeys(JobPart):
    """A contribution that has no key of its own; its size is stated in one of three ways."""

    name: Text = Field(description="What it comes from.", examples=["Dead path"])
    expanded_uncertainty: NotNegative | None = optional(
        "U with k = 2, micrometres (arc seconds); with-the-reading: % of the reading."
    )
    standard_uncertainty: NotNegative | None = optional(
        "Or u, micrometres (arc seconds); likewise.", example=0.2
    )
    range: NotNegative | None = optional(
        "Or the full range of the values that it may have, micrometres (arc seconds); likewise."
    )
    acts: ActsName = Field(
        description="Which readings share it: all in proportion to their distance from the first target, all "
        "of the negative direction, all in proportion to what was read, all alike, those of a target, those "
        "of an angle and nearly those beside it on a circle, those of a circle off its centre, those of a "
        "target in one direction, those that are near in time (a drift of that range), or none.",
        examples=["at-each-reading"],
    )
    distribution: Literal["normal", "rectangular", "triangular", "one-sided"] | None = optional(
        "How its values are distributed; one-sided: rectangular from zero. Without it "
        "rectangular for a range, else normal."
    )
    certificate: Text | None = optional(
        "Calibration certificate of the artefact that it comes from: a straightedge, a mirror."
    )


class UncertaintyKeys(JobPart):
    """The uncertainty of the measuring set-up, beside that of the instrument.

    A range is full: from the smallest value that is possible to the largest.
    """

    misalignment: NotNegative | None = optional(
        "Of the measuring line from the axis over the measured length, mm.", example=0.5
    )
    machine_temperature: NotNegative | None = optional(
        "Range of error of the machine's measured temperature, K.", example=0.4
    )
    device_temperature: NotNegative | None = optional(
        "Range of error of the measuring device's measured temperature, K.", example=0.2
    )
    expansion_coefficient: NotNegative | None = optional(
        "Range of error of the machine's expansion coefficient, micrometres/(m K).", example=2
    )
    device_expansion_coefficient: NotNegative | None = optional(
        "Range of error of the measuring device's expansion coefficient, micrometres/(m K).", example=1
    )
    air_temperature: NotNegative | None = optional(
        "Range of error of the measured air temperature, K, where corrections.air is made.", example=0.4
    )
    air_pressure: NotNegative | None = optional("Likewise of the air pressure, hPa.", example=1)
    relative_humidity: NotNegative | None = optional("Likewise of the relative humidity, %.", example=10)
    calibrated_length: NotNegative | None = optional(
        "Of a circular test: expanded uncertainty (k = 2) of the instrument's calibrated length, "
        "micrometres.",
        example=0.8,
    )
    centring: NotNegative | None = optional(
        "Of a circular test: range of error of the centre, micrometres. Without it, of a full "
        "turn, what the centre that the readings tell leaves.",
        example=2,
    )
    environmental_variation: NotNegative | None = optional(
        "Range of the readings of the axis at rest over the time of the test, micrometres (arc seconds).",
        example=0.6,
    )
    resolution: NotNegative | None = optional(
        "Smallest step of the readings, micrometres (arc seconds). Without it that of their last "
        "digit, 0.001 at least; nothing if they are corrected.",
        example=0.1,
    )
    instrument_acts: ActsName | None = optional(
        "Which readings share the constant part of the instrument's error. Without it "
        "at-each-position, and no parameter that compares positions has a smaller U than the instrument."
    )
    negligible: dict[ContributorName, Text] = Field(
        {},
        description="Contributors that are negligible, each with the reason; what is neither stated nor "
        "negligible is missing, and U is then incomplete.",
        examples=[{"device_temperature": "laser, no length of its own"}],
    )
    contributions: list[ContributionKeys] = Field(
        [],
        max_length=100,
        description="Anything else.",
        examples=[[{"name": "Dead path", "range": 0.3, "acts": "at-each-reading"}]],
    )


#: Keys of an uncertainty that speak of lengths along an axis and their expansion.
UNCERTAIN_LENGTHS = (
    "misalignment",
    "machine_temperature",
    "device_temperature",
    "expansion_coefficient",
    "device_expansion_coefficient",
)
#: Keys that speak of a circle, and those of axes that none has.
_OF_CIRCLES = ("calibrated_length", "centring")
#: Ways to share an error that only a circle has, and the one that it has not.
_ACTS_OF_CIRCLES = ("round-the-circle", "off-centre")
_ACTS_OF_LENGTHS = ("along-the-length",)
_IN_PER_CENT = "with-the-reading"
_A_SCALE = (
    f"{_IN_PER_CENT} is stated in % of the reading: name it under uncertainty.contributions, as "
    f"{{name: Scale of the instrument, acts: {_IN_PER_CENT}, expanded_uncertainty: …}}"
)
_OF_LINEAR_AXES = (
    "belongs to a linear axis; take it out (with null, where another file states it), or state contributions "
    "of this axis"
)
_SIZES = ("expanded_uncertainty", "standard_uncertainty", "range")


def _find_keys_not_of(kind: AxisKind, *, is_circle: bool) -> Iterator[tuple[tuple[str, ...], str]]:
    """Yield keys that speak of something else than was measured, and what to do with them."""
    if kind is AxisKind.ROTARY:
        yield UNCERTAIN_LENGTHS, _OF_LINEAR_AXES
    if is_circle:
        yield ("misalignment",), "belongs to a line along an axis, and this job is on a circle; take it out"
    else:
        yield _OF_CIRCLES, "belongs to a circular test (circle: …); take it out"


def _find_foreign_acts(
    keys: UncertaintyKeys, *, is_circle: bool
) -> Iterator[tuple[tuple[str | int, ...], str]]:
    """Yield ways to share an error that what was measured does not have."""
    foreign = _ACTS_OF_LENGTHS if is_circle else _ACTS_OF_CIRCLES
    what = "a circle has no length along an axis" if is_circle else "this job is on no circle"
    if keys.instrument_acts == _IN_PER_CENT:
        yield ("instrument_acts",), _A_SCALE
    if keys.instrument_acts in foreign:
        yield ("instrument_acts",), f"{keys.instrument_acts} does not fit: {what}"
    for index, each in enumerate(keys.contributions):
        if each.acts in foreign:
            yield ("contributions", index, "acts"), f"{each.acts} does not fit: {what}"


def find_uncertainty_contradictions(
    keys: UncertaintyKeys, kind: AxisKind, *, is_circle: bool
) -> Iterator[tuple[tuple[str | int, ...], str]]:
    """Yield what no single key shows to be wrong: the path of a key, and a sentence."""
    for names, why in _find_keys_not_of(kind, is_circle=is_circle):
        for name in names:
            if getattr(keys, name) is not None:
                yield (name,), why
    yield from _find_foreign_acts(keys, is_circle=is_circle)
    for name in keys.negligible:
        if getattr(keys, name, None) is not None:
            yield ("negligible", name), f"is stated as uncertainty.{name} too; take one of them out"
    for index, each in enumerate(keys.contributions):
        stated = [size for size in _SIZES if getattr(each, size) is not None]
        if len(stated) != 1:
            found = list_names(stated) or "none"
            yield ("contributions", index), f"state one of {', '.join(_SIZES)} (found: {found})"
        elif stated == ["range"] and each.distribution == "normal":
            yield (
                ("contributions", index, "distribution"),
                "a normal distribution has no range; state standard_uncertainty or expanded_uncertainty",
            )


class StandardKeys(BaseModel):
    """A standard to evaluate by; the plugin's own keys may follow."""

    model_config = ConfigDict(defer_build=True, extra="allow", frozen=True)

    standard: Text = Field(description="Identifier of an installed standard, edition included.")
    tolerances: dict[str, Positive] = Field(
        {},
        description="Limits by the symbols of the results file, micrometres (arc seconds).",
        examples=[{"A": 20}],
    )
    specification: Text | None = optional(
        "Where these limits stand: the document that they are the specification of.",
        example="Acceptance protocol 4711, section 3",
    )

    @model_validator(mode="before")
    @classmethod
    def _bare_identifier(cls, value: Any) -> Any:
        if isinstance(value, Mapping) and len(value) == 1 and not value.keys() & cls.model_fields.keys():
            ((name, its),) = value.items()
            meant = f"{name}, …" if isinstance(its, Mapping | list) or its is None else f"'{name}:{its}'"
            raise ValueError(f"{quoted(name)} is no key of a standard; write {{standard: {meant}}}")
        return {"standard": value} if isinstance(value, str | int | float) else value


class DecisionRuleKeys(JobPart):
    """How a value is held against its limit."""

    rule: Literal["simple", "guard-band", "iso14253-1", "non-binary"] = Field(
        "simple", description="The rule.", examples=["guard-band"]
    )
    guard_band_factor: Positive = Field(
        1.0,
        description="Of guard-band: width of the guard band over the expanded uncertainty U.",
        examples=[0.5],
    )

    @model_validator(mode="before")
    @classmethod
    def _bare_rule(cls, value: Any) -> Any:
        return {"rule": value} if isinstance(value, str | int | float) else value


class AxisModelKeys(JobPart):
    """The error model of the axis."""

    effects: list[str | dict[str, Any]] = Field(
        [],
        description="Effects in the model; a mapping fixes parameters, bounds or links them ({min, max} or "
        "{equals: other-effect.parameter}), or writes an effect as a formula.",
        examples=[["offset", "scale-error", "backlash"]],
    )
    candidates: list[dict[str, Any]] = Field(
        [], description="Effects written as formulas, which a diagnosis tries beside the installed ones."
    )
    sessions: list[JobPath] = Field(
        [],
        description="Jobs of further tests of the same axis, on other days or at other temperatures: the "
        "model is held against all of them, each with its own zero. They are not evaluated.",
        examples=[["second-test.yaml"]],
    )
    priors: JobPath | None = optional(
        "What earlier tests of the axis say of noise and of sizes of effects: a file that "
        "`zlmreport model learn` wrote.",
        example="priors.yaml",
    )


#: `zlmreport.model.fitting.noise.NoiseSource`, by its values.
SourceName: TypeAlias = Literal["position", "position_and_direction", "run", "time"]


class NoiseKeys(JobPart):
    """How probable each ratio of a shared variance to that of a single reading is."""

    ratios: list[NotNegative] = Field(min_length=1, description="Ratios of variances.")
    probabilities: list[NotNegative] = Field(min_length=1, description="Of each of them.")

    @model_validator(mode="after")
    def _of_each_ratio(self) -> Self:
        if len(self.ratios) != len(self.probabilities) or not sum(self.probabilities) > 0:
            raise ValueError("each ratio has a probability, and these are not all 0")
        return self


class SizeKeys(JobPart):
    """How large an effect was."""

    rms: NotNegative = Field(description="Root mean square size, micrometres or arc seconds.")
    tests: int = Field(ge=1, description="In so many tests.")


class PriorsKeys(JobPart):
    """A file of priors: what earlier tests say."""

    schema_: Literal["zlmreport/priors/1"] = Field(alias="schema", description="Version of this format.")
    kind: AxisKind = Field(description="Of the axes.")
    measurand: Text = Field(
        POSITIONING.identifier, description="What the tests measured.", examples=["straightness"]
    )
    tests: int = Field(ge=1, description="How many tests taught it.")
    noise: dict[SourceName, NoiseKeys] = Field(description="By source of shared scatter.")
    effects: dict[str, SizeKeys] = Field(description="By effect.")


class PlannedTargetKeys(JobPart):
    """The target positions: a number of them at random fractions of a period, or a list."""

    count: int | None = optional(
        "Number of targets over the travel. Without it as many as the standards ask, at least 11 "
        "and no more than 100 mm or 30 degrees apart.",
        example=21,
        ge=2,
        le=2000,
    )
    fractions_of: NotNegative | None = optional(
        "Period of whose random fractions the targets lie, mm or degrees; 0 for even targets. "
        "Without it axis.screw_pitch, or else a quarter of the interval.",
        example=10,
    )
    positions: list[Finite] | None = optional(
        "Instead: all targets, rising, mm or degrees.", min_length=2, max_length=2000
    )


class ProgramKeys(BaseModel):
    """A part program; the plugin's own keys may follow."""

    model_config = ConfigDict(defer_build=True, extra="allow", frozen=True)

    program: Text = Field(description="Identifier of an installed writer of part programs.")

    @model_validator(mode="before")
    @classmethod
    def _bare_identifier(cls, value: Any) -> Any:
        return {"program": value} if isinstance(value, str | int | float) else value


class ControllerKeys(BaseModel):
    """A control that takes compensation tables; the plugin's own keys may follow."""

    model_config = ConfigDict(defer_build=True, extra="allow", frozen=True)

    controller: Text = Field(description="Identifier of an installed controller.", examples=["linuxcnc"])


class PauseKeys(JobPart):
    """A rest half-way through the test in which a temperature changes."""

    minutes: Positive = Field(description="How long.")
    change: Finite = Field(description="By how much the temperature changes meanwhile, K.")
    of: Literal["axis_temperature", "screw_temperature", "air_temperature"] = Field(
        "axis_temperature",
        description="Which one: the whole machine's; the screw's, while the axis runs to and fro; or the "
        "air's. What it takes along with it is estimated.",
    )


class CaptureKeys(JobPart):
    """What `zlmreport capture` takes for a reading."""

    settle: Annotated[float, Field(gt=0, le=600)] | None = optional(
        "How long the axis must stand still at least, s. The reading of a visit is the last "
        "standstill of so long before the axis leaves. Without it `dwell` of the data source.",
        example=2,
    )


class PlanKeys(JobPart):
    """The test before it is done, for `zlmreport plan`."""

    targets: PlannedTargetKeys = Field(
        default_factory=PlannedTargetKeys, description="The target positions.", examples=[{"count": 21}]
    )
    runs: int | None = optional(
        "Readings of each target in each direction. Without it what the standards ask, mostly 5.",
        ge=1,
        le=1000,
    )
    overrun: Finite | None = optional(
        "How far beyond a target the axis turns round, mm or degrees, at least 0.001. Without it "
        "5, or a fiftieth of a short travel; the error model takes it so of the readings, too.",
        ge=0.001,
    )
    seed: int | None = optional(
        "Of the random fractions: the same seed gives the same targets. Without it, it follows "
        "from certificate.number.",
        ge=0,
    )
    repeatability: Positive = Field(
        1.0, description="Standard deviation of a single reading that is expected, micrometres (arc seconds)."
    )
    temperature_change: Positive = Field(
        1.0, description="By how much temperatures are expected to rise during the test, K."
    )
    pause: PauseKeys | None = optional(
        "A rest half-way, between two runs where the method goes run by run.",
        example={"minutes": 60, "change": 3},
    )
    circle: CirclePlanKeys | None = optional(
        "Of a circular test: its path.", example={"arc": 90, "feeds": [500, 2000]}
    )
    programs: list[ProgramKeys] = Field(
        [],
        description="Part programs that are written beside the plan; a bare identifier stands for "
        "{program: …}.",
        examples=[["linuxcnc"]],
    )


def find_wrong_positions(targets: PlannedTargetKeys, positions: list[float]) -> Iterator[str]:
    """Yield what no single key of the targets shows to be wrong about their positions."""
    if targets.count is not None or targets.fractions_of is not None:
        yield "either positions, or a count of targets with fractions_of; take one of them out"
    if sorted(set(positions)) != positions:
        yield "target positions rise, and none is there twice"
