"""The job keys of the data source ``step-gauge``."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field

from zlmreport.job.machine_keys import MachineKeys
from zlmreport.job.types import Finite, JobPath, Options

FaceNumber = Annotated[int, Field(ge=1)]


class StepGaugeOptions(Options):
    """Where the probed points are, and what of them is evaluated; the gauge itself stands in `step_gauge`."""

    file: JobPath = Field(description="The file of points, relative to the file that names it.")
    machine: MachineKeys | None = Field(
        None,
        description="The machine that probes the gauge live by I++ DME, for `zlmreport capture`, which "
        "writes the file of points.",
        examples=[{"host": "192.168.1.20", "tool": "RefTool"}],
    )
    layout: Literal["table", "sequence", "calypso", "ipp-dme"] | None = Field(
        None,
        description="table: face, cycle, x, y, z, i, j, k; sequence: x y z, cycle after cycle; calypso: a "
        "_chr.txt of ZEISS Calypso; ipp-dme: the log of an I++ DME run. Without it, it is told by the file.",
    )
    targets: Literal["faces", "blocks"] = Field(
        "faces",
        description="What is a target position: each face where it is, read in one direction; or each block, "
        "its front face read in the positive and its back face in the negative direction.",
    )
    side: Literal["both", "front", "back"] = Field(
        "both", description="Which faces are evaluated: front faces alone make a test in one direction."
    )
    sign: Literal["indicated-calibrated", "calibrated-indicated"] = Field(
        "indicated-calibrated",
        description="What a deviation is: by how much the machine reads too much (its error of indication, "
        "Eq. 2 and 3), or by how much the axis stands too far (actual - target, as ISO 230-2 and tables of "
        "compensation have it), which is the opposite.",
    )
    position_of_reference_face: Finite = Field(
        0.0, description="Where on the axis the reference face of the gauge lies, mm.", examples=[40]
    )
    faces: dict[str, FaceNumber] = Field(
        default_factory=dict,
        description="Calypso: number of the face by the id of the characteristic. Without it the digits at "
        "the end of the id are the number.",
        examples=[{"Step_A": 1, "Step_B": 2}],
    )
