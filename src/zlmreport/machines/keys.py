"""The keys of a machine file, and of what a circular test says of itself."""

from __future__ import annotations

from typing import Annotated, Any, Literal

from pydantic import BaseModel, BeforeValidator, ConfigDict, Field

from zlmreport.job.document_keys import Customer, Laboratory, Number, Output, Person
from zlmreport.job.measurement_keys import MachineUnderTest as MachineNames
from zlmreport.job.types import Date, Finite, JobPart, JobPath, NotNegative, Positive, Text, optional
from zlmreport.language import Language

Place3 = tuple[Finite, Finite, Finite]


class ErrorLineKeys(JobPart):
    """Where the others stood while an error was measured."""

    X: Finite | None = optional("Position of X, mm.", example=250)
    Y: Finite | None = optional("Position of Y, mm.", example=150)
    Z: Finite | None = optional("Position of Z, mm.", example=80)
    tool: Place3 | None = optional("The tool's offset in X, Y and Z, mm.", example=[0, 0, 120])


class StatedKeys(BaseModel):
    """An error that is stated instead of measured: its name with a value, or a curve of values."""

    model_config = ConfigDict(extra="allow", frozen=True)

    expanded_uncertainty: Positive = Field(
        description="Of each value, k = 2: µm, of angles and squareness arc seconds.", examples=[0.6]
    )
    at: ErrorLineKeys = Field(default_factory=ErrorLineKeys, description="Where the others stood.")
    source: Text | None = optional("Where it comes from, in words.", example="granite square")


def _take_as_list(value: Any) -> Any:
    return value if isinstance(value, list) else [value]


class ModelKeys(JobPart):
    """Effects of the drives and the structure, beside what the axes predict."""

    effects: list[Text] = Field(
        [],
        description="Names of effects. Where the bar stands and, unless it is calibrated, how long it is "
        "(centre-offset, radius) belong into every model, stated or not.",
        examples=[["servo-mismatch"]],
    )


class DocumentKeys(JobPart):
    """The document on a machine."""

    number: Number | None = optional("Its number; the file's stem without it.", example="CAL-2026-0117-M")
    kind: Literal["report"] = Field(
        "report",
        description="A report: most of what it says is predicted and not measured. A calibration certificate "
        "is that of a measurement.",
    )
    issued: Date | None = optional("Date of issue.", example="2026-11-20")
    language: Language = Field(Language.ENGLISH, description="Its language.")
    authorised_by: Person | None = optional("Who authorises the document.")
    layout: Literal["sheet", "standard"] = Field(
        "standard", description="sheet: all that fits on a page; standard: with the map and every circle."
    )
    paper: Literal["A4", "Letter"] = Field("A4", description="Paper size.")


class MachineFileKeys(JobPart):
    """A machine file: its chain, the errors of its axes, and the tests that it is held against."""

    schema_: Literal["zlmreport/machine/1"] = Field(
        alias="schema", description="Version of this format.", examples=["zlmreport/machine/1"]
    )
    extends: list[Text] | Text | None = optional(
        "Files whose keys this one builds on; paths are relative to this file."
    )
    machine: MachineNames = Field(default_factory=MachineNames, description="Which machine it is.")
    chain: Text = Field(
        description="The axes from workpiece to tool, F for the bed: XYFZ is a table in X on a saddle in Y, "
        "with the column in Z.",
        examples=["XYFZ"],
    )
    tool: Place3 = Field(
        (0.0, 0.0, 0.0),
        description="The tool's offset from the point to which all axis errors refer, X, Y and Z, mm.",
        examples=[[0, 0, 120]],
    )
    errors: Annotated[list[JobPath | StatedKeys], BeforeValidator(_take_as_list)] = Field(
        [],
        description="What is known of the 21 errors: jobs that measured them, certificates of this program "
        "(PDF, JSON), or stated values such as {C0Y: 2.5, expanded_uncertainty: 0.6} (arc seconds).",
        examples=[["x-positioning.yaml", {"C0Y": 2.5, "expanded_uncertainty": 0.6}]],
    )
    bounds: dict[str, NotNegative] = Field(
        {},
        description="How large errors may be that nobody measured: µm over the travel, of angles and "
        "squareness arc seconds. Without it this program assumes some and says so.",
        examples=[{"EAX": 5}],
    )
    tests: Annotated[list[JobPath], BeforeValidator(_take_as_list)] = Field(
        [],
        description="Jobs of tests of the whole machine: circles, diagonals, lines in other places.",
        examples=[["circle-xy.yaml"]],
    )
    model: ModelKeys = Field(default_factory=ModelKeys, description="Effects beside what the axes predict.")
    certificate: DocumentKeys = Field(
        default_factory=DocumentKeys, description="Its document, for `zlmreport machine certificate`."
    )
    laboratory: Laboratory | None = optional("Who issues the document.")
    customer: Customer | None = optional("For whom the work was done.")
    output: Output = Field(default_factory=Output, description="What the document is written as, and where.")
