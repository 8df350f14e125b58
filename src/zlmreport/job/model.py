"""The keys of a job file, with what they mean; `zlmreport schema` publishes this page.

Units are those of the contract with users (mm, °, µm, ″, °C, hPa); `zlmreport.job.interpret` turns them
into the SI values of the core.
"""

from __future__ import annotations

from typing import Annotated, Any, Literal

from pydantic import AfterValidator, BaseModel, ConfigDict, Field, model_validator

from zlmreport.job.correction_keys import CorrectionKeys
from zlmreport.job.document_keys import (
    Agreement,
    Amends,
    Dates,
    External,
    Location,
    NextDue,
    OpinionKeys,
    Person,
)
from zlmreport.job.exclusion_keys import ExclusionKeys
from zlmreport.job.options import JobPath
from zlmreport.job.part import JobPart
from zlmreport.job.plan_keys import PlanKeys
from zlmreport.job.step_gauge_keys import StepGaugeKeys
from zlmreport.job.types import Date, Finite, InWords, Lines, Positive, Text, file_stem
from zlmreport.job.uncertainty_keys import UncertaintyKeys
from zlmreport.language import Language
from zlmreport.measurement.axis import AxisKind

#: Unique identification of a document, that also names its files.
Number = Annotated[
    Text, AfterValidator(file_stem), Field(json_schema_extra={"pattern": r"^[A-Za-z0-9][A-Za-z0-9._-]*$"})
]


class CertificateKeys(JobPart):
    """The document."""

    number: Number = Field(
        description="Unique identification of the document; also the stem of the output files.",
        examples=["CAL-2026-0117"],
    )
    kind: Literal["certificate", "report"] = Field(
        "certificate",
        description="A calibration certificate after ISO/IEC 17025:2017 clause 7.8, or a measuring report.",
    )
    title: Text | None = Field(None, description="Title on the cover, instead of the usual one.")
    issued: Date | None = Field(None, description="Date of issue.", examples=["2026-11-20"])
    language: Language = Field(Language.ENGLISH, description="Language of the document.")
    authorised_by: Person | None = Field(None, description="Who authorises the document.")
    amends: Amends | None = Field(
        None,
        description="The earlier document that this one amends or replaces.",
        examples=[{"number": "CAL-2026-0117", "reason": "The serial number of the machine was wrong."}],
    )
    paper: Literal["A4", "Letter"] = Field("A4", description="Paper size.")
    readings_on_graphs: bool = Field(
        default=True, description="Whether the graphs show all single readings behind the means."
    )


class Laboratory(JobPart):
    """Who issues the document."""

    name: Text = Field(description="Name of the laboratory.", examples=["Calibration Laboratory North"])
    address: Lines | None = Field(
        None,
        description="Postal address; commas or line breaks part its lines.",
        examples=["Gaugeway 1, 12345 Sampletown"],
    )
    country: Annotated[str, Field(pattern=r"^[A-Z]{2}$")] | None = Field(
        None,
        description="Country by its two letters (ISO 3166-1), for the digital calibration certificate.",
        examples=["DE"],
    )
    accreditation: Text | None = Field(None, description="Accreditation body and number.")
    logo: JobPath | None = Field(
        None, description="PNG or JPEG file beside the file that names it.", examples=["logo.png"]
    )


class Customer(JobPart):
    """For whom the work was done."""

    name: Text = Field(description="Name of the customer.", examples=["Precision Parts Ltd"])
    address: Lines | None = Field(
        None,
        description="Postal address; commas or line breaks part its lines.",
        examples=["Millway 2, 12345 Sampletown"],
    )


class Machine(JobPart):
    """The machine under test."""

    manufacturer: Text | None = Field(None, description="Who built it.")
    model: Text | None = Field(None, description="Type designation.")
    serial: Text | None = Field(None, description="Serial number or other identification.")
    kind: Literal["machine tool", "coordinate measuring machine"] = Field(
        "machine tool", description="What the results mean is said for a part made, or measured, on it."
    )
    location: Text | None = Field(None, description="Where it stands.")
    condition: Text | None = Field(None, description="Condition in which it was found.")


class AxisKeys(JobPart):
    """The axis under test."""

    name: Text = Field(description="As on the machine.", examples=["X"])
    kind: AxisKind = Field(AxisKind.LINEAR, description="linear (mm) or rotary (degrees).")
    travel: tuple[Finite, Finite] | None = Field(
        None, description="First and last position of the travel, mm or degrees.", examples=[[0, 1000]]
    )
    screw_pitch: Positive | None = Field(
        None, description="Pitch of the screw or gear, mm or degrees.", examples=[10]
    )
    signal_period: Positive | None = Field(
        None, description="Period of the scale's signal, mm or degrees.", examples=[0.02]
    )
    scale_element: Positive | None = Field(
        None, description="Length of one element of a scale made of several, mm or degrees."
    )
    compensation_table: JobPath | None = Field(
        None,
        description="CSV file of the control's compensation table: columns position and deviation "
        "(actual - target), mm and micrometres (degrees and arc seconds).",
        examples=["x-compensation.csv"],
    )
    angular_errors: JobPath | None = Field(
        None,
        description="CSV file of the axis's pitch or yaw: columns position and angle, mm and microradians.",
        examples=["x-pitch.csv"],
    )
    abbe_offset: Finite | None = Field(
        None, description="Distance of the measuring line from the scale, mm.", examples=[200]
    )


class SourceKeys(BaseModel):
    """Where the readings come from; the plugin's own keys follow `plugin`."""

    model_config = ConfigDict(extra="allow", frozen=True)

    plugin: Text = Field(description="Identifier of an installed data source.", examples=["laser-csv"])


class LineOfPlane(JobPart):
    """Where the measuring line lies in a plane of two axes."""

    axis: Text = Field(description="Name of the second axis.", examples=["Y"])
    at: Finite = Field(description="Its position while the line was measured, mm.", examples=[200])


class Measurement(JobPart):
    """How the readings were taken."""

    source: SourceKeys = Field(
        description="Where the readings come from.", examples=[{"plugin": "laser-csv", "file": "x-axis.csv"}]
    )
    date: Date | None = Field(
        None, description="Date of the measurement, or of its first day.", examples=["2026-11-18"]
    )
    end: Date | None = Field(
        None, description="Its last day, if it took more than one.", examples=["2026-11-19"]
    )
    method: Literal["linear", "unidirectional", "pendulum", "quasi-pilgrim"] | None = Field(
        None, description="Positioning method."
    )
    feed: Positive | None = Field(None, description="Feed, mm/min or degrees/min.", examples=[2000])
    dwell: Positive | None = Field(None, description="Time at rest at each target, s.", examples=[5])
    warm_up: Lines | None = Field(None, description="Warm-up before the test, in words.")
    compensation: Lines | None = Field(None, description="State of the machine's compensation, in words.")
    line: Lines | None = Field(None, description="Place of the measuring line, positions of other axes.")
    plane: LineOfPlane | None = Field(
        None, description="The measuring line as one of several over a plane, for `zlmreport surface`."
    )
    deviations_from_method: Lines | None = Field(
        None,
        description="Additions to, deviations and exclusions from the method.",
        examples=["Three runs instead of five, for want of time."],
    )
    excluded: list[ExclusionKeys] = Field(
        default_factory=list,
        description="Readings that are set aside, each with its reason.",
        examples=[
            [{"target": 213.4, "direction": "+", "run": 3, "reason": "Air hose touched the reflector."}]
        ],
    )
    operator: Text | None = Field(None, description="Who measured.")
    remarks: Lines | None = Field(None, description="Anything else that a reader should know.")


class Instrument(JobPart):
    """The measuring instrument: the link to the national standard."""

    name: Text = Field(description="Type designation.", examples=["Laser interferometer LM 10"])
    manufacturer: Text | None = Field(None, description="Who built it.")
    serial: Text | None = Field(None, description="Serial number.")
    certificate: Text | None = Field(None, description="Its calibration certificate.")
    calibrated: Date | None = Field(None, description="Date of that calibration.", examples=["2026-03-01"])
    expanded_uncertainty: Positive | InWords | None = Field(
        None,
        description="Its expanded uncertainty (k = 2), micrometres (arc seconds), or in words.",
        examples=[0.3],
    )
    expanded_uncertainty_per_metre: Positive | None = Field(
        None,
        description="What the expanded uncertainty gains with each metre of measured length, micrometres/m.",
        examples=[0.5],
    )
    expansion_coefficient: Finite | None = Field(
        None, description="Of a device whose own expansion counts, micrometres/(m K).", examples=[8.0]
    )


class Environment(JobPart):
    """Conditions during the measurement that the readings do not carry themselves."""

    air_temperature: Finite | InWords | None = Field(None, description="°C", examples=[20.1])
    material_temperature: Finite | InWords | None = Field(None, description="°C", examples=[20.3])
    axis_temperature: Finite | InWords | None = Field(
        None, description="Of the machine's scale, °C", examples=[20.4]
    )
    air_pressure: Positive | InWords | None = Field(None, description="hPa", examples=[1013])
    relative_humidity: Finite | InWords | None = Field(None, description="%", examples=[45])
    expansion_coefficient: Finite | InWords | None = Field(
        None, description="Used for correction, µm/(m·K)", examples=[11.5]
    )
    remarks: Lines | None = Field(None, description="Anything else: oil shower, sunlight, vibration.")


class AsFound(JobPart):
    """The axis before it was adjusted or repaired; `measurement` is then the axis as left."""

    measurement: Measurement = Field(
        description="How the readings before were taken; what is not said here was as in measurement.",
        examples=[{"date": "2026-11-17", "source": {"plugin": "laser-csv", "file": "x-as-found.csv"}}],
    )
    work: Literal["adjustment", "repair"] = Field(
        "adjustment", description="What was done between the two measurements."
    )
    adjustment: Lines | None = Field(
        None,
        description="What was adjusted or repaired, in words.",
        examples=["Backlash compensation of the control set from 0 to 4 µm."],
    )
    environment: Environment | None = Field(
        None, description="Conditions during the measurement before; without it those of environment."
    )


class StandardKeys(BaseModel):
    """A standard to evaluate by; the plugin's own keys may follow."""

    model_config = ConfigDict(extra="allow", frozen=True)

    standard: Text = Field(description="Identifier of an installed standard, edition included.")
    tolerances: dict[str, Positive] = Field(
        default_factory=dict,
        description="Limits by the symbols of the results file, micrometres (arc seconds).",
        examples=[{"A": 20}],
    )

    @model_validator(mode="before")
    @classmethod
    def _bare_identifier(cls, value: Any) -> Any:
        """Take a bare identifier for the standard without further keys."""
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
        """Take a bare identifier for the rule without further keys."""
        return {"rule": value} if isinstance(value, str | int | float) else value


class Model(JobPart):
    """The error model of the axis."""

    effects: list[str | dict[str, dict[str, Any] | None]] = Field(
        default_factory=list,
        description="Effects in the model; a mapping fixes parameters.",
        examples=[["offset", "scale-error", "backlash"]],
    )


class Output(JobPart):
    """What is written, and where."""

    directory: JobPath | None = Field(
        None, description="Folder of the output files; the job's own folder without it.", examples=["out"]
    )
    formats: list[Text] = Field(
        default_factory=lambda: ["pdf", "json"],
        min_length=1,
        description="Identifiers of installed renderers.",
        examples=[["pdf", "json"]],
    )


class JobKeys(JobPart):
    """A job file: from the measurements of one axis to a certificate."""

    schema_: Literal["zlmreport/job/1"] = Field(
        alias="schema", description="Version of this format.", examples=["zlmreport/job/1"]
    )
    extends: list[Text] | Text | None = Field(
        None,
        description="Files whose keys this one builds on; paths are relative to this file.",
        examples=["../laboratory.yaml"],
    )
    certificate: CertificateKeys = Field(
        description="The document.", examples=[{"number": "CAL-2026-0117", "issued": "2026-11-20"}]
    )
    laboratory: Laboratory | None = Field(None, description="Who issues the document.")
    customer: Customer | None = Field(None, description="For whom the work was done.")
    machine: Machine = Field(default_factory=Machine, description="The machine under test.")
    axis: AxisKeys = Field(description="The axis under test.", examples=[{"name": "X", "kind": "linear"}])
    location: Location | Lines | None = Field(
        None,
        description="Where the work was done, in words or as a kind of place. Without it machine.location, "
        "or else the customer's address.",
        examples=["Hall 3, Millway 2, 12345 Sampletown"],
    )
    dates: Dates = Field(
        default_factory=Dates,
        description="Dates beside those of the measurement and the document.",
        examples=[{"received": "2026-11-16"}],
    )
    procedure: Lines | None = Field(
        None, description="The laboratory's own procedure, its issue included.", examples=["QP 17, issue 4"]
    )
    sampling: Lines | None = Field(
        None,
        description="Sampling plan and method, if what was measured is a sample.",
        examples=["One axis of three, drawn by lot; QP 18, issue 2"],
    )
    measurement: Measurement = Field(
        description="How the readings were taken.",
        examples=[{"source": {"plugin": "laser-csv", "file": "x-axis.csv"}}],
    )
    as_found: AsFound | None = Field(
        None, description="The axis before it was adjusted or repaired, compared with measurement."
    )
    instrument: Instrument | None = Field(None, description="The measuring instrument.")
    environment: Environment | None = Field(None, description="Conditions during the measurement.")
    step_gauge: StepGaugeKeys | None = Field(
        None,
        description="A calibrated step gauge instead of a laser: the gauge, where it lies, how it is probed.",
        examples=[{"calibration": "gauge.yaml", "initial_points": "initial-points.csv", "tip_radius": 2}],
    )
    corrections: CorrectionKeys | None = Field(
        None,
        description="What the readings are corrected for; without it they are taken as they are.",
        examples=[{"air": {"assumed": "standard air"}, "material": {"expansion_coefficient": 11.5}}],
    )
    evaluate: list[StandardKeys] = Field(
        min_length=1,
        description="Standards to evaluate by; a bare identifier stands for {standard: …}.",
        examples=[["iso230-2:2014"]],
    )
    decision_rule: DecisionRuleKeys = Field(
        default_factory=DecisionRuleKeys,
        description="How a value is held against its limit; a bare name stands for {rule: …}.",
        examples=["guard-band"],
    )
    provided_by_customer: list[Text] = Field(
        default_factory=list,
        description="Keys of this job whose values the customer supplied: marked wherever they are printed.",
        examples=[["environment.expansion_coefficient"]],
    )
    external: list[External] = Field(
        default_factory=list,
        description="Results that external providers supplied.",
        examples=[[{"results": "Temperatures of the machine's scale", "provider": "Thermometry Ltd"}]],
    )
    opinions: list[OpinionKeys] = Field(
        default_factory=list,
        description="Opinions and interpretations, in a section of their own.",
        examples=[[{"statement": "Play in the nut.", "basis": "The reversal value is alike everywhere."}]],
    )
    next_due: NextDue | None = Field(
        None,
        description="When the next calibration is due; only if agreed with the customer.",
        examples=[{"date": "2027-11-18", "agreed": True}],
    )
    agreement: Agreement = Field(
        default_factory=Agreement,
        description="What was agreed with the customer about the document.",
        examples=[{"simplified": True, "reference": "Order 4711"}],
    )
    uncertainty: UncertaintyKeys = Field(
        default_factory=UncertaintyKeys,
        description="The uncertainty of the measuring set-up, beside that of the instrument.",
        examples=[{"misalignment": 0.5, "environmental_variation": 0.6}],
    )
    model: Model | None = Field(None, description="The error model of the axis.")
    plan: PlanKeys = Field(
        default_factory=PlanKeys,
        description="The test before it is done, for `zlmreport plan`.",
        examples=[{"targets": {"count": 21}, "repeatability": 0.5}],
    )
    output: Output = Field(default_factory=Output, description="What is written, and where.")
