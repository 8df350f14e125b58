"""The data source ``step-gauge``."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field

from zlmreport.plugin import (
    MILLIMETRE,
    Finite,
    InputError,
    JobPath,
    MeasurementSet,
    Options,
    SourceContext,
    TextFile,
    Words,
    read_text,
)
from zlmreport_step_gauge import layouts
from zlmreport_step_gauge.deviations import deviations_of
from zlmreport_step_gauge.gauge import Side
from zlmreport_step_gauge.keys import MachineKeys
from zlmreport_step_gauge.measurements import Sign, Targets, measurement_set
from zlmreport_step_gauge.points import Points, Unnumbered, by_order, numbered
from zlmreport_step_gauge.probed import gridded
from zlmreport_step_gauge.set_up import GaugeSetUp

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


_SIDES = {"both": tuple(Side), "front": (Side.FRONT,), "back": (Side.BACK,)}


class StepGaugeSource:
    """Probed faces of a step gauge: as centres of the tip, or as distances."""

    identifier = "step-gauge"
    title = Words(en="Probed step gauge", de="Angetastetes Stufenendmaß")
    options: type[Options] = StepGaugeOptions

    def read(self, options: StepGaugeOptions, context: SourceContext) -> MeasurementSet:
        """Read the points and evaluate them against the gauge; raise `InputError` with every defect."""
        set_up = context.set_ups.get("step_gauge")
        if set_up is None:
            raise InputError.at(
                context.place,
                "this source needs the gauge; state step_gauge with its calibration, "
                "as in step_gauge: {calibration: gauge.yaml, initial_points: initial-points.csv}",
            )
        sides = _SIDES[options.side]
        found = _points(options, set_up, sides)
        probed = gridded(found.points, set_up.gauge, sides, place=found.place, problems=found.problems)
        deviations = deviations_of(
            probed, set_up, found.place, is_corrected=found.is_corrected or set_up.radius_is_corrected
        )
        return measurement_set(
            probed,
            deviations,
            set_up,
            context.axis,
            targets=Targets(options.targets),
            sign=Sign(options.sign),
            origin=MILLIMETRE.to_si(options.position_of_reference_face),
            source=self.identifier,
            files=(found.source,),
            place=found.place,
        )


def _points(options: StepGaugeOptions, set_up: GaugeSetUp, sides: tuple[Side, ...]) -> Points:
    layout = options.layout or _layout(read_text(options.file))
    direction = set_up.located.location.direction if set_up.located else None
    if layout == "table":
        return layouts.read_table(options.file, set_up.gauge, direction)
    if layout == "calypso":
        return layouts.read_calypso(options.file, options.faces)
    text, unnumbered = (layouts.read_log if layout == "ipp-dme" else layouts.read_sequence)(options.file)
    return _with_faces(text, unnumbered, set_up, sides)


def _with_faces(
    text: TextFile, unnumbered: list[Unnumbered], set_up: GaugeSetUp, sides: tuple[Side, ...]
) -> Points:
    """Return points with their faces: by where they lie, or without a location by their order."""
    if set_up.located and unnumbered:
        location = set_up.located.location
        radius = 0.0 if set_up.radius_is_corrected else set_up.tip_radius or 0.0
        points = numbered(unnumbered, set_up.gauge, location.begin, location.direction, radius)
    else:
        faces = [face for face in set_up.gauge.faces if face.side in sides]
        points = by_order(unnumbered, faces, text.place())
    return Points(tuple(points), text.source, text.place())


def _layout(text: TextFile) -> str:
    """Tell the layout by the first line that is no comment."""
    first = next((line for line in text.lines if line.strip() and not line.lstrip().startswith("#")), "")
    if layouts.is_calypso(first):
        return "calypso"
    if first.lstrip()[:5].isdecimal() and first.lstrip()[5:6].isspace() and first.split()[1][0] in "&%#!":
        return "ipp-dme"
    return "table" if any(letter.isalpha() for letter in first) else "sequence"
