"""The calibration of a step gauge as a graph: how far each face lies from its nominal place."""

from __future__ import annotations

import numpy as np

from zlmreport.figures.figure import Band, Curve, Figure, Panel, Role
from zlmreport.language import Words
from zlmreport.quantities.arrays import read_only_floats
from zlmreport.quantities.units import MICROMETRE, MILLIMETRE
from zlmreport.step_gauge.gauge import Side, StepGauge

_TITLE = Words(
    en="Calibration of the step gauge: calibrated minus nominal distance of the faces of the blocks {first} "
    "to {last} from the reference face, with U (k = 2)",
    de="Kalibrierung des Stufenendmaßes: kalibrierter minus Nennabstand der Flächen der Blöcke {first} bis "
    "{last} von der Bezugsfläche, mit U (k = 2)",
)
_SENTENCE = Words(
    en="Graph over the nominal distance, {low} mm to {high} mm. {front} {back}",
    de="Diagramm über dem Nennabstand, {low} mm bis {high} mm. {front} {back}",
)
_RANGE = Words(en="{side} from {low} µm to {high} µm.", de="{side} von {low} µm bis {high} µm.")
_SIDES = {
    Side.FRONT: Words(en="Front faces", de="Vorderflächen"),
    Side.BACK: Words(en="Back faces", de="Rückflächen"),
}
_X_TITLE = Words(en="Nominal distance from the reference face", de="Nennabstand von der Bezugsfläche")
_Y_TITLE = Words(en="Calibrated − nominal", de="Kalibriert − Nennwert")
_LOOKS = {
    Side.FRONT: ("S↑", "S↑ ± U", Role.MEAN_POSITIVE, Role.LIMIT_POSITIVE),
    Side.BACK: ("S↓", "S↓ ± U", Role.MEAN_NEGATIVE, Role.LIMIT_NEGATIVE),
}


def gauge_calibration(gauge: StepGauge) -> Figure:
    """Return the graph of a gauge, or of a section of it: front faces, touched in ↑, and back faces, in ↓."""
    curves, bands = zip(*(_of_side(gauge, side) for side in Side), strict=True)
    nominal = [MILLIMETRE.from_si(face.nominal) for face in gauge.faces]
    front, back = (_range(curve, side) for curve, side in zip(curves, Side, strict=True))
    return Figure(
        key="gauge-calibration",
        title=_TITLE.given(first=gauge.blocks[0], last=gauge.blocks[-1]),
        alternative=_SENTENCE.given(low=nominal[0], high=nominal[-1], front=front, back=back),
        x_title=_X_TITLE,
        y_title=_Y_TITLE,
        x_unit=MILLIMETRE.symbol,
        y_unit=MICROMETRE.symbol,
        panels=(Panel(curves=curves, bands=bands),),
    )


def _of_side(gauge: StepGauge, side: Side) -> tuple[Curve, Band]:
    faces = [face for face in gauge.faces if face.side is side]
    x = read_only_floats([MILLIMETRE.from_si(face.nominal) for face in faces])
    y = np.array([MICROMETRE.from_si(face.distance - face.nominal) for face in faces])
    expanded = np.array([MICROMETRE.from_si(face.expanded_uncertainty) for face in faces])
    symbol, limits, mean, limit = _LOOKS[side]
    return (
        Curve(symbol, mean, x, read_only_floats(y)),
        Band(limits, limit, x, read_only_floats(y - expanded), read_only_floats(y + expanded)),
    )


def _range(curve: Curve, side: Side) -> Words:
    return _RANGE.given(
        side=_SIDES[side],
        low=float(round(float(curve.y.min()), 3)),
        high=float(round(float(curve.y.max()), 3)),
    )
