"""A small standard, a source and a renderer that do everything right; the tests of the kit make them sin."""

from __future__ import annotations

import html
import json
from collections.abc import Iterable, Iterator
from dataclasses import fields, is_dataclass, replace
from typing import Any

import numpy as np
from pydantic import Field

from zlmreport.plugin import (
    AccessError,
    Evaluation,
    Figure,
    InputError,
    JobPath,
    MeasurementSet,
    Options,
    Place,
    Words,
    same_in_all_languages as same,
)
from zlmreport.plugin.protocols import SourceContext
from zlmreport.plugin.renderer import Certificate, Graph
from zlmreport.plugin.source import Provenance, SourceFile
from zlmreport.plugin.standard import (
    Arithmetic,
    Band,
    Bracket,
    Curve,
    Finding,
    Panel,
    PositionQuantity,
    PositionStatistics,
    Quantity,
    QuantityGroup,
    Role,
    largest_over_positions as largest,
    smallest_over_positions as smallest,
)
from zlmreport.testing import bidirectional_test


class ExemplaryOptions(Options):
    factor: float = Field(2.0, gt=0, description="Coverage factor.")


class ExemplaryStandard:
    identifier = "exemplary:1"
    designation = "EX 1"
    title = Words(en="An exemplary standard", de="Eine vorbildliche Norm")
    position_index = "i"
    options: Any = ExemplaryOptions
    quantities: Any = (
        Quantity(
            "E", "E", same("range"), QuantityGroup.SYSTEMATIC, "max(x̄_{i}↑) − min(x̄_{i}↑)", same("meaning")
        ),
        Quantity("R", "R", same("scatter"), QuantityGroup.RANDOM, "max(2k·s_{i}↑)", same("meaning")),
    )
    position_quantities: Any = (PositionQuantity("width", "2k·s_{i}↑", same("width")),)
    notes: Any = (Words(en="A note", de="Eine Bemerkung"),)

    def requirements(self, measurements: MeasurementSet, _options: Any) -> Iterable[Finding]:
        number = len(measurements.target_positions)
        yield Finding(same("At least 5 positions"), same(f"{number} positions"), number >= 5)

    def arithmetic(self, statistics: PositionStatistics, options: Any) -> Arithmetic:
        width = 2 * options.factor * statistics.s_positive
        mean = statistics.mean_positive
        return Arithmetic({"E": largest(mean) - smallest(mean), "R": largest(width)}, {"width": width})

    def figures(self, evaluation: Evaluation, _options: Any) -> Iterable[Figure]:
        axis = evaluation.measurements.axis
        x = axis.position_unit.from_si(evaluation.measurements.target_positions)
        mean = axis.deviation_unit.from_si(evaluation.statistics.mean_positive)
        spread = axis.deviation_unit.from_si(evaluation.statistics.s_positive)
        if np.all(np.isnan(mean)):
            return
        low, high = int(np.nanargmin(mean)), int(np.nanargmax(mean))
        yield Figure(
            key="means",
            title=same("Means"),
            alternative=same(f"Means from {mean[low]} to {mean[high]}"),
            x_title=same("Position"),
            y_title=same("Deviation"),
            x_unit=axis.position_unit.symbol,
            y_unit=axis.deviation_unit.symbol,
            panels=(
                Panel(
                    curves=(Curve("x̄_{i}↑", Role.MEAN_POSITIVE, x, mean),),
                    bands=(Band("x̄_{i}↑ ± s_{i}↑", Role.LIMIT_POSITIVE, x, mean - spread, mean + spread),),
                    brackets=(
                        Bracket("E", float(mean[low]), float(mean[high]), float(x[low]), float(x[high])),
                    ),
                ),
            ),
        )


class ExemplarySourceOptions(Options):
    file: JobPath = Field(description="Deviations at 0, 100 and 200 mm, µm, upwards and downwards.")


class ExemplarySource:
    identifier = "exemplary-text"
    title = Words(en="Six numbers in a line", de="Sechs Zahlen in einer Zeile")
    options: Any = ExemplarySourceOptions

    def read(self, options: Any, context: SourceContext) -> MeasurementSet:
        place = Place(str(options.file))
        try:
            content = options.file.read_bytes()
        except OSError as error:
            raise AccessError.at(place, "cannot be read") from error
        try:
            values = [float(word) for word in content.decode("ascii").split()]
        except ValueError as error:
            raise InputError.at(place, "must hold numbers") from error
        if len(values) != 6:
            raise InputError.at(place, f"must hold 6 numbers, not {len(values)}")
        test = bidirectional_test(
            [0, 100, 200],
            [[value] for value in values[:3]],
            [[value] for value in values[3:]],
            axis=context.axis,
        )
        file = SourceFile.of(options.file, content)
        return replace(test, provenance=Provenance(self.identifier, (file,), (self.title,)))


class ExemplaryRenderer:
    identifier = "exemplary"
    title = Words(en="Words in JSON", de="Wörter in JSON")
    suffix = ".json"

    def render(self, certificate: Certificate) -> bytes:
        words = [certificate.number, certificate.title, certificate.subtitle]
        values = [parameter.value for each in certificate.evaluations for parameter in each.parameters]
        return json.dumps([*words, *values], ensure_ascii=False).encode()


class ExemplaryPage(ExemplaryRenderer):
    suffix = ".html"

    def render(self, certificate: Certificate) -> bytes:
        parts = (certificate.title, certificate.subtitle, certificate.letterhead, certificate.cover)
        words = [html.escape(each) for each in _words((*parts, certificate.sections))]
        return f"<p>{certificate.number}</p><p>{'</p><p>'.join(words)}</p>".encode()


def _words(value: Any) -> Iterator[str]:
    """Yield every text below a part of a certificate, but for graphs."""
    if isinstance(value, str):
        yield value
    elif isinstance(value, tuple):
        for each in value:
            yield from _words(each)
    elif is_dataclass(value) and not isinstance(value, Graph):
        for each in fields(value):
            yield from _words(getattr(value, each.name))
