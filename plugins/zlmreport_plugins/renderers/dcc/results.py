"""The results of a DCC: by each standard its parameters, and the deviations by target position."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from xml.etree import ElementTree as ET

import numpy as np

from zlmreport.plugin import (
    CONFORMITY_STATEMENTS,
    Approach,
    Certificate,
    Conformity,
    Decision,
    EvaluatedParameter,
    Evaluation,
    FloatArray,
    Job,
    Words,
)
from zlmreport_plugins.renderers.dcc.administrative import Writer, equipment, influences, software, state
from zlmreport_plugins.renderers.dcc.elements import dcc, group, quantity, real, real_list, unit_of

_RESULTS = Words(
    en="Positioning accuracy of axis {axis} by {designation}",
    de="Positioniergenauigkeit der Achse {axis} nach {designation}",
)
_PARAMETERS = Words(en="Parameters of the axis", de="Kenngrößen der Achse")
_POSITIONS = Words(en="Results by target position", de="Ergebnisse nach Sollposition")
_TARGET = Words(en="Target position", de="Sollposition")
_COLUMNS = {
    "mean_fwd": Words(
        en="Mean deviation, positive approach", de="Mittlere Abweichung, positive Anfahrrichtung"
    ),
    "mean_bwd": Words(
        en="Mean deviation, negative approach", de="Mittlere Abweichung, negative Anfahrrichtung"
    ),
    "mean": Words(en="Mean deviation of both approaches", de="Mittlere Abweichung beider Anfahrrichtungen"),
    "s_fwd": Words(
        en="Standard deviation, positive approach", de="Standardabweichung, positive Anfahrrichtung"
    ),
    "s_bwd": Words(
        en="Standard deviation, negative approach", de="Standardabweichung, negative Anfahrrichtung"
    ),
    "reversal": Words(en="Reversal value", de="Umkehrspanne"),
}
_LIMIT = Words(en="Limit", de="Grenzwert")
_ACCEPTED = Words(en="Acceptance limit", de="Annahmegrenze")
_SHORTFALL = Words(en="{requirement}: {found}", de="{requirement}: {found}")
_SHORTFALLS = Words(
    en="Requirement of {designation} that the test does not meet",
    de="Anforderung von {designation}, die die Messung nicht erfüllt",
)

_CONFORMITY = {
    Conformity.MET: "pass",
    Conformity.CONDITIONALLY_MET: "conditionalPass",
    Conformity.CONDITIONALLY_FAILED: "conditionalFail",
    Conformity.FAILED: "fail",
}


def measurement_results(certificate: Certificate, job: Job) -> ET.Element:
    """Return the results by every standard of the job: as found, where there are such, and as left."""
    writer = Writer(certificate.language)
    found = job.as_found
    work = job.keys.as_found.work if job.keys.as_found else None
    before = (
        [
            _measurement_result(each, certificate, found, state("before", work, writer), writer)
            for each in certificate.evaluations_as_found
        ]
        if found
        else []
    )
    after = [
        _measurement_result(each, certificate, job, state("after", work, writer), writer)
        for each in certificate.evaluations
    ]
    return dcc("measurementResults", *before, *after)


def _measurement_result(
    evaluation: Evaluation, certificate: Certificate, job: Job, condition: ET.Element | None, writer: Writer
) -> ET.Element:
    name = _RESULTS.given(axis=job.axis.name, designation=evaluation.designation)
    return dcc(
        "measurementResult",
        writer.named("name", name),
        dcc(
            "usedMethods",
            dcc("usedMethod", writer.named("name", evaluation.title), dcc("norm", evaluation.designation)),
        ),
        dcc("usedSoftware", software(certificate, writer)),
        group("measuringEquipments", equipment(job, writer)),
        group("influenceConditions", condition, *influences(job, writer)),
        dcc(
            "results",
            dcc(
                "result",
                writer.named("name", _PARAMETERS),
                dcc(
                    "data",
                    dcc("list", *(_parameter(each, evaluation, writer) for each in evaluation.parameters)),
                ),
            ),
            dcc(
                "result",
                writer.named("name", _POSITIONS),
                dcc("data", dcc("list", *_positions(evaluation, writer))),
            ),
        ),
        group("measurementMetaData", *_shortfalls(evaluation, writer)),
    )


def _parameter(parameter: EvaluatedParameter, evaluation: Evaluation, writer: Writer) -> ET.Element:
    axis_unit = evaluation.measurements.axis.deviation_unit
    unit = unit_of(axis_unit)
    uncertainty = parameter.expanded_uncertainty
    return quantity(
        writer.named("name", parameter.quantity.name),
        real(
            axis_unit.from_si(parameter.value),
            unit,
            label=parameter.quantity.symbol,
            expanded_uncertainty=None if uncertainty is None else axis_unit.from_si(uncertainty),
            coverage_factor=parameter.coverage_factor,
        ),
        _conformity(parameter, evaluation, writer),
    )


def _conformity(parameter: EvaluatedParameter, evaluation: Evaluation, writer: Writer) -> ET.Element | None:
    """Return what is stated of a parameter's limit, with the limits; None where it has none."""
    decision, limit = parameter.decision, parameter.limit
    if decision is None or limit is None:
        return None
    _, statement = CONFORMITY_STATEMENTS[decision.conformity]
    stated = _CONFORMITY.get(decision.conformity)
    return dcc(
        "measurementMetaData",
        dcc(
            "metaData",
            dcc("declaration", writer.content(statement)),
            dcc("conformity", stated) if stated else None,
            dcc("data", *_limits(decision, limit, evaluation, writer)),
            refType="basic_conformity",
        ),
    )


def _limits(decision: Decision, limit: float, evaluation: Evaluation, writer: Writer) -> Iterator[ET.Element]:
    axis_unit = evaluation.measurements.axis.deviation_unit
    unit = unit_of(axis_unit)
    yield quantity(writer.named("name", _LIMIT), real(axis_unit.from_si(limit), unit))
    accepted = decision.acceptance_limit
    if accepted is not None:
        yield quantity(writer.named("name", _ACCEPTED), real(axis_unit.from_si(accepted), unit))


def _positions(evaluation: Evaluation, writer: Writer) -> Iterator[ET.Element]:
    """Yield the columns by target position that the test defines."""
    axis = evaluation.measurements.axis
    targets = axis.position_unit.from_si(evaluation.measurements.target_positions).tolist()
    yield quantity(
        writer.named("name", _TARGET),
        real_list(targets, unit_of(axis.position_unit)),
        kind="basic_nominalValue",
    )
    unit = axis.deviation_unit
    for column in _columns(evaluation):
        if np.any(np.isfinite(column.values)):
            uncertainty = column.uncertainty
            yield quantity(
                writer.named("name", column.name),
                real_list(
                    unit.from_si(column.values).tolist(),
                    unit_of(unit),
                    expanded_uncertainty=() if uncertainty is None else unit.from_si(uncertainty).tolist(),
                    coverage_factor=column.coverage_factor,
                ),
            )


@dataclass(frozen=True, slots=True)
class _Column:
    """A value at each target position, m or rad, and its expanded uncertainty where that is known."""

    name: Words
    values: FloatArray
    uncertainty: FloatArray | None = None
    coverage_factor: float = 0.0


def _columns(evaluation: Evaluation) -> Iterator[_Column]:
    statistics, uncertain = evaluation.statistics, evaluation.mean_uncertainty
    factor = uncertain.coverage_factor if uncertain else 0.0
    for key, approach in (("mean_fwd", Approach.POSITIVE), ("mean_bwd", Approach.NEGATIVE)):
        of_approach = uncertain.by_approach[approach.index] if uncertain else None
        yield _Column(_COLUMNS[key], statistics.mean[approach.index], of_approach, factor)
    of_both = uncertain.bidirectional if uncertain else None
    yield _Column(_COLUMNS["mean"], statistics.mean_bidirectional, of_both, factor)
    yield _Column(_COLUMNS["s_fwd"], statistics.s_positive)
    yield _Column(_COLUMNS["s_bwd"], statistics.s_negative)
    yield _Column(_COLUMNS["reversal"], statistics.reversal_value)
    for column in evaluation.columns:
        yield _Column(column.quantity.name, column.values)


def _shortfalls(evaluation: Evaluation, writer: Writer) -> Iterator[ET.Element]:
    """Yield the requirements of the standard that the test does not meet."""
    for finding in evaluation.findings:
        if finding.met is False:
            found = _SHORTFALL.given(requirement=finding.requirement, found=finding.found)
            yield dcc(
                "metaData",
                writer.named("name", _SHORTFALLS.given(designation=evaluation.designation)),
                dcc("declaration", writer.content(found)),
            )
