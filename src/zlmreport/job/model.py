"""The keys of a job file, with what they mean; `zlmreport schema` publishes this page.

Units are those of the contract with users (mm, °, µm, ″, °C, hPa); `zlmreport.job.interpret` turns them
into the SI values of the core.
"""

from __future__ import annotations

import datetime as dt
from typing import Annotated, Any, Literal

from pydantic import BaseModel, ConfigDict, Field, StringConstraints

from zlmreport.job.options import JobPath
from zlmreport.language import Language
from zlmreport.measurement.axis import AxisKind

#: A line of text as it is printed; long enough for any name, short enough for a page.
Text = Annotated[str, StringConstraints(min_length=1, max_length=500, strip_whitespace=True)]
Positive = Annotated[float, Field(gt=0, allow_inf_nan=False)]
Finite = Annotated[float, Field(allow_inf_nan=False)]
Number = Annotated[
    str, StringConstraints(pattern=r"^[A-Za-z0-9][A-Za-z0-9._-]*$", min_length=1, max_length=100)
]


class JobPart(BaseModel):
    """A part of a job: frozen, and closed to keys that it does not know."""

    model_config = ConfigDict(extra="forbid", frozen=True)


class Person(JobPart):
    """Somebody who answers for the certificate."""

    name: Text = Field(description="The person's name.")
    function: Text | None = Field(None, description="The person's function in the laboratory.")


class CertificateKeys(JobPart):
    """The document."""

    number: Number = Field(
        description="Unique identification of the document; also the stem of the output files."
    )
    kind: Literal["certificate", "report"] = Field(
        "certificate",
        description="A calibration certificate after ISO/IEC 17025:2017 clause 7.8, or a measuring report.",
    )
    title: Text | None = Field(None, description="Title on the cover, instead of the usual one.")
    issued: dt.date | None = Field(None, description="Date of issue.")
    language: Language = Field(Language.ENGLISH, description="Language of the document.")
    authorised_by: Person | None = Field(None, description="Who authorises the document.")
    paper: Literal["A4", "Letter"] = Field("A4", description="Paper size.")
    readings_on_graphs: bool = Field(
        default=True, description="Whether the graphs show all single readings behind the means."
    )


class Laboratory(JobPart):
    """Who issues the document."""

    name: Text = Field(description="Name of the laboratory.")
    address: Text | None = Field(None, description="Postal address; commas or line breaks part its lines.")
    accreditation: Text | None = Field(None, description="Accreditation body and number.")
    logo: JobPath | None = Field(None, description="PNG, JPEG or SVG file beside the file that names it.")


class Customer(JobPart):
    """For whom the work was done."""

    name: Text = Field(description="Name of the customer.")
    address: Text | None = Field(None, description="Postal address; commas or line breaks part its lines.")


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

    name: Text = Field(description="As on the machine: X.")
    kind: AxisKind = Field(AxisKind.LINEAR, description="linear (mm) or rotary (degrees).")
    travel: tuple[Finite, Finite] | None = Field(
        None, description="First and last position of the travel, mm or degrees."
    )
    screw_pitch: Positive | None = Field(None, description="Pitch of the screw or gear, mm or degrees.")
    signal_period: Positive | None = Field(None, description="Period of the scale's signal, mm or degrees.")
    scale_element: Positive | None = Field(
        None, description="Length of one element of a scale made of several, mm or degrees."
    )


class SourceKeys(BaseModel):
    """Where the readings come from; the plugin's own keys follow `plugin`."""

    model_config = ConfigDict(extra="allow", frozen=True)

    plugin: Text = Field(description="Identifier of an installed data source.")


class Measurement(JobPart):
    """How the readings were taken."""

    source: SourceKeys
    date: dt.date | None = Field(None, description="Date of the measurement.")
    method: Literal["linear", "unidirectional", "pendulum", "quasi-pilgrim"] | None = Field(
        None, description="Positioning method."
    )
    feed: Positive | None = Field(None, description="Feed, mm/min or degrees/min.")
    dwell: Positive | None = Field(None, description="Time at rest at each target, s.")
    warm_up: Text | None = Field(None, description="Warm-up before the test, in words.")
    compensation: Text | None = Field(None, description="State of the machine's compensation, in words.")
    line: Text | None = Field(None, description="Place of the measuring line, positions of other axes.")
    operator: Text | None = Field(None, description="Who measured.")
    remarks: Text | None = Field(None, description="Anything else that a reader should know.")


class Instrument(JobPart):
    """The measuring instrument: the link to the national standard."""

    name: Text = Field(description="Type designation.")
    manufacturer: Text | None = Field(None, description="Who built it.")
    serial: Text | None = Field(None, description="Serial number.")
    certificate: Text | None = Field(None, description="Its calibration certificate.")
    calibrated: dt.date | None = Field(None, description="Date of that calibration.")
    expanded_uncertainty: Positive | Text | None = Field(
        None,
        description="Its expanded uncertainty (k = 2), micrometres (arc seconds), or in words.",
    )


class Environment(JobPart):
    """Conditions during the measurement that the readings do not carry themselves."""

    air_temperature: Text | Finite | None = Field(None, description="°C")
    material_temperature: Text | Finite | None = Field(None, description="°C")
    axis_temperature: Text | Finite | None = Field(None, description="Of the machine's scale, °C")
    air_pressure: Text | Positive | None = Field(None, description="hPa")
    relative_humidity: Text | Finite | None = Field(None, description="%")
    expansion_coefficient: Text | Finite | None = Field(None, description="Used for correction, µm/(m·K)")
    remarks: Text | None = Field(None, description="Anything else: oil shower, sunlight, vibration.")


class StandardKeys(BaseModel):
    """A standard to evaluate by; the plugin's own keys may follow."""

    model_config = ConfigDict(extra="allow", frozen=True)

    standard: Text = Field(description="Identifier of an installed standard, edition included.")
    tolerances: dict[str, Positive] = Field(
        default_factory=dict,
        description="Limits by the symbols of the results file, micrometres (arc seconds).",
    )


class Model(JobPart):
    """The error model of the axis."""

    effects: list[str | dict[str, dict[str, Any] | None]] = Field(
        default_factory=list, description="Effects in the model; a mapping fixes parameters."
    )


class Output(JobPart):
    """What is written, and where."""

    directory: JobPath | None = Field(None, description="Folder of the output files.")
    formats: list[Text] = Field(
        default_factory=lambda: ["pdf", "json"],
        min_length=1,
        description="Identifiers of installed renderers.",
    )


class JobKeys(JobPart):
    """A job file: from the measurements of one axis to a certificate."""

    schema_: Literal["zlmreport/job/1"] = Field(alias="schema", description="Version of this format.")
    extends: list[Text] | Text | None = Field(
        None, description="Files whose keys this one builds on; paths are relative to this file."
    )
    certificate: CertificateKeys
    laboratory: Laboratory | None = None
    customer: Customer | None = None
    machine: Machine = Field(default_factory=Machine)
    axis: AxisKeys
    measurement: Measurement
    instrument: Instrument | None = None
    environment: Environment | None = None
    evaluate: list[StandardKeys] = Field(
        min_length=1, description="Standards to evaluate by; a bare identifier stands for {standard: …}."
    )
    decision_rule: Literal["simple", "guard-band", "iso14253-1", "non-binary"] = Field(
        "simple", description="How a value is held against its limit."
    )
    model: Model | None = None
    output: Output = Field(default_factory=Output)
