"""The data source ``step-gauge``."""

from __future__ import annotations

from zlmreport.errors import InputError
from zlmreport.job.types import Options
from zlmreport.language import Words
from zlmreport.measurement.measurement_set import MeasurementSet
from zlmreport.measurement.text_file import TextFile, read_text
from zlmreport.plugin.protocols import SourceContext
from zlmreport.quantities.units import MILLIMETRE
from zlmreport.step_gauge.deviations import deviations_of
from zlmreport.step_gauge.gauge import Side
from zlmreport.step_gauge.measurements import Sign, Targets, measurement_set
from zlmreport.step_gauge.probed import gridded
from zlmreport.step_gauge.set_up import GaugeSetUp
from zlmreport_plugins.sources.step_gauge import calypso, ipp_dme, sequence, table
from zlmreport_plugins.sources.step_gauge.options import StepGaugeOptions
from zlmreport_plugins.sources.step_gauge.points import Points, Unnumbered, by_order, numbered

_SIDES = {"both": tuple(Side), "front": (Side.FRONT,), "back": (Side.BACK,)}


class StepGaugeSource:
    """Probed faces of a step gauge: as centres of the tip, or as distances."""

    identifier = "step-gauge"
    title = Words(en="Probed step gauge", de="Angetastetes Stufenendmaß")
    options: type[Options] = StepGaugeOptions

    def read(self, options: StepGaugeOptions, context: SourceContext) -> MeasurementSet:
        """Read the points and evaluate them against the gauge; raise `InputError` with every defect."""
        set_up = context.step_gauge
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
        return table.read(options.file, set_up.gauge, direction)
    if layout == "calypso":
        return calypso.read(options.file, options.faces)
    text, unnumbered = (ipp_dme if layout == "ipp-dme" else sequence).read(options.file)
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
    if calypso.is_calypso(first):
        return "calypso"
    if first.lstrip()[:5].isdecimal() and first.lstrip()[5:6].isspace() and first.split()[1][0] in "&%#!":
        return "ipp-dme"
    return "table" if any(letter.isalpha() for letter in first) else "sequence"
