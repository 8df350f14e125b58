"""Facts of a circular test: which circle was run, in which senses, where each began, how it was read."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np

from zlmreport.document.certificate.circumstances import Fact, write_with_unit
from zlmreport.language import Words, join_parts
from zlmreport.measurement import units

if TYPE_CHECKING:
    from zlmreport.document.writer import Writer
    from zlmreport.job.circle_keys import CircleKeys
    from zlmreport.measurement.measurement_set import MeasurementSet

#: What a document says of the circle in a line.
_IN_WORDS = Words("plane {plane}, radius {radius} mm, feed {feed} mm/min")
_CALIBRATED = Words("calibrated")
_CALIBRATED_BY = Words("calibrated, certificate {certificate}")
_SENSES = Words("{first} and {second}, {turns} each")
_UNLIKE = Words("{first}, {turns}; {second}, {others}")
_ONE_SENSE = Words("{first} only, {turns}")
_ANGLES = Words("{count}, from {first} to {last} from +{from_axis} towards +{to_axis}")
_AVERAGED = Words("{count}, averages of {readings} readings")


def describe_circle(keys: CircleKeys, writer: Writer) -> str:
    """Write which circle was run, in a line."""
    radius, feed = map(writer.number, (keys.radius, keys.feed))
    return writer.say(_IN_WORDS.given(plane=keys.plane, radius=radius, feed=feed))


def list_circle_facts(keys: CircleKeys, writer: Writer) -> Iterator[Fact]:
    """Yield which circle was run, and where in the machine."""
    stated = "centre" in keys.model_fields_set
    place = " / ".join(map(writer.number, keys.centre)) if stated else None
    by = _CALIBRATED_BY.given(certificate=keys.certificate) if keys.certificate else _CALIBRATED
    length = writer.say(by if keys.calibrated_length else Words("not calibrated: nothing is said of radii"))
    yield Fact(Words("Plane"), keys.plane, ("circle.plane",))
    yield Fact(Words("Nominal radius"), write_with_unit(keys.radius, "mm", writer), ("circle.radius",))
    yield Fact(Words("Feed along the path"), write_with_unit(keys.feed, "mm/min", writer), ("circle.feed",))
    yield Fact(Words("Centre at X / Y / Z"), place and f"{place} mm", ("circle.centre",))
    yield Fact(Words("Length of the instrument"), length, ("circle.calibrated_length", "circle.certificate"))


def list_path_facts(measurements: MeasurementSet, writer: Writer, within: str) -> Iterator[Fact]:
    """Yield in which senses a circle was run, where each began, and at how many angles it was read."""
    source = (f"{within}.source",)
    senses = [measurements.axis.measurand.senses[each.index] for each in measurements.approaches]
    turns = [
        len(np.unique(measurements.run[measurements.approach == each])) for each in measurements.approaches
    ]
    words = _ONE_SENSE if len(senses) == 1 else _SENSES if len(set(turns)) == 1 else _UNLIKE
    said = words.given(
        first=senses[0], second=senses[-1], turns=_turns_in_words(turns[0]), others=_turns_in_words(turns[-1])
    )
    yield Fact(Words("Senses and turns"), writer.say(said), source)
    begins = []
    for approach, sense in zip(measurements.approaches, senses, strict=True):
        first = int(measurements.target[np.flatnonzero(measurements.approach == approach)[0]])
        angle = units.with_unit(writer.position(float(measurements.target_positions[first])), "°")
        begins.append(writer.say(Words("{sense} at {angle}").given(sense=sense, angle=angle)))
    yield Fact(Words("Evaluated from"), join_parts(begins, writer.language), source)
    yield Fact(Words("Angles"), writer.say(_write_angles(measurements, writer)), source)


def _turns_in_words(number: int) -> Words:
    return Words("{number} turn", plural="{number} turns").given(number=number)


def _write_angles(measurements: MeasurementSet, writer: Writer) -> Words:
    targets, averaging = measurements.target_positions, measurements.provenance.averaging
    first, second = measurements.axis.circle.axes if measurements.axis.circle else ("1", "2")
    count: str | Words = str(len(targets))
    if averaging:
        count = _AVERAGED.given(count=len(targets), readings=averaging.readings)
    return _ANGLES.given(
        count=count,
        first=writer.position(float(targets[0])),
        last=units.with_unit(writer.position(float(targets[-1])), "°"),
        from_axis=first,
        to_axis=second,
    )
