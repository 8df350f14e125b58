"""The top level of the keys of a job file: its groups in order, with what they mean.

Units are those of the contract with users (mm, °, µm, ″, °C, hPa); `zlmreport.job.loading` turns them
into the SI values of the core.
"""

from typing import Literal

from pydantic import Field

from zlmreport.job.circle_keys import CircleKeys
from zlmreport.job.document_keys import (
    Agreement,
    CertificateKeys,
    Customer,
    Dates,
    External,
    Laboratory,
    Location,
    NextDue,
    OpinionKeys,
    Output,
)
from zlmreport.job.evaluation_keys import (
    AxisModelKeys,
    CaptureKeys,
    ControllerKeys,
    DecisionRuleKeys,
    PlanKeys,
    StandardKeys,
    UncertaintyKeys,
)
from zlmreport.job.measurement_keys import (
    AsFound,
    AxisKeys,
    CorrectionKeys,
    Environment,
    InstrumentKeys,
    MachineUnderTest,
    Measurement,
)
from zlmreport.job.types import JobPart, JobPath, Lines, Text, optional


class OfFleet(JobPart):
    """What a fleet is told of this job alone."""

    interval: int | None = optional("Days after which the axis is to be measured again.", example=180, ge=1)


class JobKeys(JobPart):
    """A job file: from the measurements of one axis to a certificate."""

    schema_: Literal["zlmreport/job/1"] = Field(
        alias="schema", description="Version of this format.", examples=["zlmreport/job/1"]
    )
    extends: list[Text] | Text | None = optional(
        "Files whose keys this one builds on; paths are relative to this file.", example="../laboratory.yaml"
    )
    certificate: CertificateKeys = Field(
        description="The document.", examples=[{"number": "CAL-2026-0117", "issued": "2026-11-20"}]
    )
    laboratory: Laboratory | None = optional("Who issues the document.")
    customer: Customer | None = optional("For whom the work was done.")
    machine: MachineUnderTest = Field(default_factory=MachineUnderTest, description="The machine under test.")
    axis: AxisKeys = Field(description="The axis under test.", examples=[{"name": "X", "kind": "linear"}])
    circle: CircleKeys | None = optional(
        "The circle of a circular test, which stands instead of an axis.",
        example={"plane": "XY", "radius": 150, "feed": 1000, "calibrated_length": True},
    )
    location: Location | Lines | None = optional(
        "Where the work was done, in words or as a kind of place. Without it "
        "machine.location; a certificate states one of them.",
        example="Hall 3, Millway 2, 12345 Sampletown",
    )
    dates: Dates = Field(
        default_factory=Dates,
        description="Dates beside those of the measurement and the document.",
        examples=[{"received": "2026-11-16"}],
    )
    procedure: Lines | None = optional(
        "The laboratory's own procedure, its issue included.", example="QP 17, issue 4"
    )
    sampling: Lines | None = optional(
        "Sampling plan and method, if what was measured is a sample.",
        example="One axis of three, drawn by lot; QP 18, issue 2",
    )
    measurement: Measurement = Field(
        description="How the readings were taken.",
        examples=[{"source": {"plugin": "laser-csv", "file": "x-axis.csv"}}],
    )
    as_found: AsFound | None = optional(
        "The axis before it was adjusted or repaired, compared with measurement."
    )
    instrument: InstrumentKeys | None = optional("The measuring instrument.")
    environment: Environment | None = optional("Conditions during the measurement.")
    corrections: CorrectionKeys | None = optional(
        "What the readings are corrected for; without it they are taken as they are.",
        example={"air": {"assumed": "standard air"}, "material": {"expansion_coefficient": 11.5}},
    )
    fleet: OfFleet = Field(
        default_factory=OfFleet,
        description="What a fleet is told of this job alone; no certificate depends on it.",
        examples=[{"interval": 180}],
    )
    measurements: list[JobPath] = Field(
        [],
        description="Jobs of which one document is made, instead of axis, measurement and evaluate: what "
        "this job says of laboratory, customer, machine and certificate holds for all of them.",
        examples=[["x.yaml", "circle.yaml"]],
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
        [],
        description="Keys of this job whose values the customer supplied: marked wherever they are printed.",
        examples=[["environment.expansion_coefficient"]],
    )
    external: list[External] = Field(
        [],
        description="Results that external providers supplied.",
        examples=[[{"results": "Temperatures of the machine's scale", "provider": "Thermometry Ltd"}]],
    )
    opinions: list[OpinionKeys] = Field(
        [],
        description="Opinions and interpretations, in a section of their own.",
        examples=[[{"statement": "Play in the nut.", "basis": "The reversal value is alike everywhere."}]],
    )
    next_due: NextDue | None = optional(
        "When the next calibration is due; only if agreed with the customer.",
        example={"date": "2027-11-18", "agreed": True},
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
    model: AxisModelKeys | None = optional("The error model of the axis.")
    plan: PlanKeys = Field(
        default_factory=PlanKeys,
        description="The test before it is done, for `zlmreport plan`.",
        examples=[{"targets": {"count": 21}, "repeatability": 0.5}],
    )
    capture: CaptureKeys = Field(
        default_factory=CaptureKeys,
        description="What `zlmreport capture` takes for a reading.",
        examples=[{"settle": 2}],
    )
    compensation: ControllerKeys | None = optional(
        "The control for which `zlmreport compensate` writes a table.",
        example={"controller": "linuxcnc", "type": 0},
    )
    output: Output = Field(default_factory=Output, description="What is written, and where.")
