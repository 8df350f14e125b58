"""A short digest of readings and results, by which paper, file and digital certificate are held together.

It stands on the first page, in the results file and in the digital certificate, and `zlmreport verify` says
it first. It is sixteen letters and digits in groups of four, without those that are taken for one another (I,
L, O, U), so that it can be read aloud.

What it is of is a text of lines, UTF-8, each ended by a line feed: what the certificate is called, each
reading in the order in which it was taken, each result. The first 80 bits of its SHA-256 are written in base
32 by Crockford's alphabet. Numbers have six decimals in the units of the results file: a processor that
rounds the last bit otherwise changes nothing.
"""

from __future__ import annotations

import hashlib
import math
from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

from zlmreport.language import Words
from zlmreport.measurement.units import Unit

if TYPE_CHECKING:
    from zlmreport.evaluation.evaluation import EvaluatedParameter, Evaluation
    from zlmreport.measurement.measurement_set import MeasurementSet

#: What it is called where it stands.
DIGEST = Words("Digest of results")
_ALPHABET = "0123456789ABCDEFGHJKMNPQRSTVWXYZ"
_BITS, _BITS_OF_LETTER, _GROUP = 80, 5, 4
_DECIMALS = 6
_ABSENT = "-"


def digest_of(number: str, evaluations: Sequence[Evaluation]) -> str:
    """Return the digest, such as ``4T2X-K7QM-9RDA-3H8C``.

    `number`: Of the certificate.
    `evaluations`: Of the axis as left, then those as found.
    """
    text = "".join(f"{line}\n" for line in _list_lines(number, evaluations))
    value = int.from_bytes(hashlib.sha256(text.encode("utf-8", "backslashreplace")).digest()[: _BITS // 8])
    letters = [
        _ALPHABET[value >> shift & (1 << _BITS_OF_LETTER) - 1]
        for shift in range(_BITS - _BITS_OF_LETTER, -1, -_BITS_OF_LETTER)
    ]
    return "-".join("".join(letters[start : start + _GROUP]) for start in range(0, len(letters), _GROUP))


def _list_lines(number: str, evaluations: Sequence[Evaluation]) -> Iterator[str]:
    yield f"certificate {number}"
    known: list[MeasurementSet] = []
    for evaluation in evaluations:
        measurements = evaluation.measurements
        if not any(each is measurements for each in known):
            known.append(measurements)
            yield from _list_readings(measurements)
            for name, each in measurements.tests.items():
                yield f"test {name}"
                yield from _list_readings(each)
        yield f"standard {evaluation.standard}"
        unit = measurements.axis.deviation_unit
        yield from (
            _write_result(parameter, parameter.quantity.unit_or(unit)) for parameter in evaluation.parameters
        )


def _list_readings(measurements: MeasurementSet) -> Iterator[str]:
    axis = measurements.axis
    yield f"axis {axis.name}"
    for index, approach, run, deviation in zip(
        measurements.target.tolist(),
        measurements.approach.tolist(),
        measurements.run.tolist(),
        measurements.deviation.tolist(),
        strict=True,
    ):
        target = _write_value(float(measurements.target_positions[index]), axis.position_unit)
        yield f"reading {target} {approach:+d} {run} {_write_value(deviation, axis.deviation_unit)}"


def _write_result(parameter: EvaluatedParameter, unit: Unit) -> str:
    numbers = parameter.value, parameter.expanded_uncertainty, parameter.limit
    decision = parameter.decision.conformity.value if parameter.decision else _ABSENT
    written = " ".join(_write_value(each, unit) for each in numbers)
    return f"result {parameter.quantity.symbol} {written} {unit.ascii} {decision}"


def _write_value(value: float | None, unit: Unit) -> str:
    if value is None or math.isnan(value):
        return _ABSENT
    # Half of the last place would be written as a zero with a sign or without one.
    return f"{round(unit.from_si(value), _DECIMALS) + 0.0:.{_DECIMALS}f}"
