"""The results of a DCC: by each standard its parameters, and the deviations by target position."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from xml.etree import ElementTree as ET

import numpy as np

from zlmreport.plugin import (
    CONDITION_NAMES,
    CONDITIONS,
    Approach,
    Evaluation,
    FloatArray,
    MeasurementSet,
    Unit,
    Words,
    named,
)
from zlmreport.plugin.extension import Job
from zlmreport.plugin.renderer import (
    CONFORMITY_STATEMENTS,
    Budget,
    Certificate,
    Decision,
    EvaluatedParameter,
    NoBudget,
    changes,
)
from zlmreport.plugin.standard import Conformity
from zlmreport_plugins.renderers.dcc.administrative import (
    AdministrativeWriter,
    make_equipment,
    make_influences,
    make_software,
    make_state,
)
from zlmreport_plugins.renderers.dcc.elements import (
    CONDITION,
    DEVIATION,
    DIRECTION,
    ONE,
    READINGS,
    RUN,
    SCALES,
    SECOND,
    TARGET,
    TEST,
    TEST_AS_FOUND,
    TIME,
    TRAITS,
    dcc,
    group,
    make_quantity,
    make_real,
    make_real_list,
    write_unit_of,
)

_RESULTS = Words("{subject} by {designation}")
_RESULTS_BY_METHOD = Words("{subject} by the method of {designation}")
_PARAMETERS = Words("Parameters of the axis")
_OF_NO_AXIS = Words("Parameters")
_POSITIONS = Words("Results by target position")
_CURVES = Words("Mean curves")
_MEAN = Words("Mean deviation, {of}")
_MEAN_OF_BOTH = Words("Mean deviation of both approaches")
_MEAN_OF_SENSES = Words("Mean deviation of both senses")
_DEVIATIONS = Words("Standard deviation, {of}")
_REVERSAL = Words("Reversal value")
_DIFFERENCE = Words("Difference of both senses")
_APPROACHES = (
    Words("positive approach"),
    Words("negative approach"),
)
_LIMIT = Words("Limit")
_ACCEPTED = Words("Acceptance limit")
_FINDINGS = {
    True: Words("Requirement of {designation} that is met"),
    False: Words("Requirement of {designation} that the test does not meet"),
    None: Words("Requirement of {designation} that is open"),
}
_RISK = Words("Risk that the statement is wrong")
_INTERVAL = Words(
    "Interval that holds, with 95 %, what another test of this axis by the same plan would find with the "
    "same set-up left in place; errors of the set-up are not in it"
)
_HIGHEST = Words("Upper end")
_BUDGET = Words("Uncertainty budget: standard uncertainties at the end of the measured length")
_BUDGET_OF_NO_LENGTH = Words("Uncertainty budget: standard uncertainties of a reading")
_COMBINED = Words("Combined standard uncertainty")
_CHANGES = Words(
    "Changes of the parameters: as left − as found; U is the sum of both U and holds whatever errors the "
    "two measurements share"
)
_READINGS = Words("Readings, in the order in which they were taken")
_DIRECTION = Words("Direction of approach")
_SENSE = Words("Sense of motion: 1 is {first}")
_RUN = Words("Number of the run")
_DEVIATION = Words("Deviation")
_TIME = Words("Time from the first reading")

_CONFORMITY = {
    Conformity.MET: "pass",
    Conformity.CONDITIONALLY_MET: "conditionalPass",
    Conformity.CONDITIONALLY_FAILED: "conditionalFail",
    Conformity.FAILED: "fail",
}


@dataclass(frozen=True)
class _Test:
    """A measurement of the axis, and as left the evaluations as found to compare it with."""

    state: ET.Element | None
    evaluations: Sequence[Evaluation]
    budget: Budget | NoBudget | None
    job: Job
    earlier: Sequence[Evaluation] = ()
    #: name and line: What one of several is called; of lines that are evaluated together, its readings.
    name: str = ""
    line: MeasurementSet | None = None
    identifier: str = TEST  #: Begins the identifier of its readings, if it has a name.


def make_measurement_results(certificate: Certificate, job: Job) -> ET.Element:
    """Return the results by every standard of the job: as found, where there are such, and as left.

    Of one document of several measurements those of each, one after the other.
    """
    parts = [(part, part.job or job, name) for name, part in certificate.parts.items()]
    return dcc(
        "measurementResults",
        *(
            each
            for part, of_part, name in parts or [(certificate, job, "")]
            for each in _make_results_of_measurement(part, of_part, name)
        ),
    )


def _make_results_of_measurement(certificate: Certificate, job: Job, name: str) -> Iterator[ET.Element]:
    """Yield the results of one measurement; `name` is what its document calls it."""
    writer, before = AdministrativeWriter(certificate.language), job.as_found
    work, found = (job.keys.as_found.work if job.keys.as_found else None), certificate.evaluations_as_found
    after = make_state("after", work, writer)
    tests = [_Test(after, certificate.evaluations, certificate.budget, job, found, name)]
    if before:
        state, budget = make_state("before", work, writer), certificate.budget_as_found
        tests.insert(0, _Test(state, found, budget, before, name=name, identifier=TEST_AS_FOUND))
    tests += (
        _Test(
            None,
            [of.evaluation for of in each.evaluated],
            each.budget,
            each.job,
            name="-".join(filter(None, (name, each.name))),
            line=each.measurements,
        )
        for each in certificate.tests
    )
    for test in tests:
        for index in range(len(test.evaluations)):
            yield _make_measurement_result(index, test, certificate, writer)
        if test.line and not test.evaluations and not test.job.keys.agreement.simplified:
            yield _make_readings_alone(test, test.line, certificate, writer)


def _make_readings_alone(
    test: _Test, line: MeasurementSet, certificate: Certificate, writer: AdministrativeWriter
) -> ET.Element:
    """Return a measured line that no standard evaluates but together with others."""
    return dcc(
        "measurementResult",
        writer.make_named("name", named(test.name, line.axis.subject)),
        _make_used_methods(certificate.evaluations, writer),  # what evaluates it together with others
        dcc("usedSoftware", make_software(certificate, writer)),
        group("measuringEquipments", make_equipment(test.job, writer)),
        group("influenceConditions", *make_influences(test.job, writer)),
        dcc("results", _make_result_of_readings(test, line, writer)),
        group("measurementMetaData", *_make_budget(test, writer)),
    )


def _make_result_of_readings(test: _Test, line: MeasurementSet, writer: AdministrativeWriter) -> ET.Element:
    identifier = {"id": f"{test.identifier}{test.name}"} if test.name else {}
    return _make_result(_READINGS, _make_readings(line, writer), writer, refType=READINGS, **identifier)


def _make_measurement_result(
    index: int, test: _Test, certificate: Certificate, writer: AdministrativeWriter
) -> ET.Element:
    """Return the results by one standard; the first of a test has its readings, too.

    Readings stay out where the customer agreed to a document without them; what is evaluated of several lines
    has none of its own.
    """
    evaluation, job = test.evaluations[index], test.job
    measurements = evaluation.measurements
    by = _RESULTS_BY_METHOD if evaluation.is_method else _RESULTS
    name = by.given(subject=measurements.axis.subject, designation=evaluation.designation)
    if test.name:
        name = named(test.name, name)
    parameters = (_make_parameter(each, evaluation, writer) for each in evaluation.parameters)
    is_continuous = measurements.axis.measurand.is_continuous
    based_on = {} if job.keys.agreement.simplified else _make_reference(test, measurements)
    results = [_make_result(_OF_NO_AXIS if is_continuous else _PARAMETERS, parameters, writer, **based_on)]
    if test.earlier:
        results.append(_make_result(_CHANGES, _make_changes(test.earlier[index], evaluation, writer), writer))
    if not measurements.tests:
        heading = _CURVES if is_continuous else _POSITIONS
        results.append(_make_result(heading, _make_positions(evaluation, writer), writer))
        if index == 0 and not job.keys.agreement.simplified:
            results.append(_make_result_of_readings(test, measurements, writer))
    return dcc(
        "measurementResult",
        writer.make_named("name", name),
        _make_used_methods([evaluation], writer),
        dcc("usedSoftware", make_software(certificate, writer)),
        group("measuringEquipments", make_equipment(job, writer)),
        group("influenceConditions", test.state, *make_influences(job, writer)),
        dcc("results", *results),
        group("measurementMetaData", *_make_budget(test, writer), *_make_findings(evaluation, writer)),
    )


def _make_used_methods(evaluations: Iterable[Evaluation], writer: AdministrativeWriter) -> ET.Element:
    return dcc(
        "usedMethods",
        *(
            dcc(
                "usedMethod",
                writer.make_named("name", each.title),
                dcc("reference" if each.is_method else "norm", each.designation),
            )
            for each in evaluations
        ),
    )


def _make_reference(test: _Test, measurements: MeasurementSet) -> dict[str, str]:
    """Return the reference from parameters to the readings of which they are, where these have names."""
    names = ["-".join(filter(None, (test.name, line))) for line in measurements.tests] or [test.name]
    return {"refId": " ".join(f"{test.identifier}{each}" for each in names)} if all(names) else {}


def _make_result(
    name: Words, of: Iterable[ET.Element], writer: AdministrativeWriter, **kind: str
) -> ET.Element:
    return dcc("result", writer.make_named("name", name), dcc("data", dcc("list", *of)), **kind)


def _make_parameter(
    parameter: EvaluatedParameter, evaluation: Evaluation, writer: AdministrativeWriter
) -> ET.Element:
    axis_unit = parameter.quantity.unit_or(evaluation.measurements.axis.deviation_unit)
    unit = write_unit_of(axis_unit)
    uncertainty = parameter.expanded_uncertainty
    return make_quantity(
        writer.make_named("name", parameter.quantity.name),
        make_real(
            axis_unit.from_si(parameter.value),
            unit,
            label=parameter.quantity.symbol,
            expanded_uncertainty=None if uncertainty is None else axis_unit.from_si(uncertainty),
            coverage_factor=parameter.coverage_factor,
        ),
        group(
            "measurementMetaData",
            _make_conformity(parameter, axis_unit, writer),
            _make_interval(parameter, axis_unit, writer),
        ),
    )


def _make_changes(
    before: Evaluation, after: Evaluation, writer: AdministrativeWriter
) -> Iterator[ET.Element]:
    """Yield by how much each parameter changed, with its U where both are known."""
    usual = after.measurements.axis.deviation_unit
    for each in changes(before, after):
        unit = each.either.quantity.unit_or(usual)
        if each.value is not None:
            uncertainty = each.expanded_uncertainty
            yield make_quantity(
                writer.make_named("name", each.either.quantity.name),
                make_real(
                    unit.from_si(each.value),
                    write_unit_of(unit),
                    label=each.either.quantity.symbol,
                    expanded_uncertainty=None if uncertainty is None else unit.from_si(uncertainty),
                    coverage_factor=each.coverage_factor,
                ),
            )


def _make_interval(
    parameter: EvaluatedParameter, axis_unit: Unit, writer: AdministrativeWriter
) -> ET.Element | None:
    """Return where another test of the axis would find a parameter; None where that is not known."""
    if parameter.axis_interval is None:
        return None
    return dcc(
        "metaData",
        dcc("declaration", writer.make_content(_INTERVAL)),
        dcc(
            "data",
            *(
                make_quantity(
                    writer.make_named("name", name),
                    make_real(axis_unit.from_si(end), write_unit_of(axis_unit)),
                )
                for name, end in zip((Words("Lower end"), _HIGHEST), parameter.axis_interval, strict=True)
            ),
        ),
    )


def _make_conformity(
    parameter: EvaluatedParameter, axis_unit: Unit, writer: AdministrativeWriter
) -> ET.Element | None:
    """Return what is stated of a parameter's limit, with the limits; None where it has none."""
    decision, limit = parameter.decision, parameter.limit
    if decision is None or limit is None:
        return None
    _, statement = CONFORMITY_STATEMENTS[decision.conformity]
    stated = _CONFORMITY.get(decision.conformity)
    return dcc(
        "metaData",
        dcc("declaration", writer.make_content(statement)),
        dcc("conformity", stated) if stated else None,
        dcc("data", *_make_limits(decision, limit, axis_unit, writer)),
        refType="basic_conformity",
    )


def _make_limits(
    decision: Decision, limit: float, axis_unit: Unit, writer: AdministrativeWriter
) -> Iterator[ET.Element]:
    unit = write_unit_of(axis_unit)
    yield make_quantity(writer.make_named("name", _LIMIT), make_real(axis_unit.from_si(limit), unit))
    accepted = decision.acceptance_limit
    if accepted is not None:
        yield make_quantity(
            writer.make_named("name", _ACCEPTED), make_real(axis_unit.from_si(accepted), unit)
        )
    if decision.risk is not None:
        yield make_quantity(writer.make_named("name", _RISK), make_real(decision.risk, ONE))


def _make_positions(evaluation: Evaluation, writer: AdministrativeWriter) -> Iterator[ET.Element]:
    """Yield the columns by target position that the test defines."""
    axis = evaluation.measurements.axis
    targets = axis.position_unit.from_si(evaluation.measurements.target_positions).tolist()
    yield make_quantity(
        writer.make_named("name", axis.measurand.target),
        make_real_list(targets, write_unit_of(axis.position_unit)),
        kind="basic_nominalValue",
    )
    unit, uncertain = axis.deviation_unit, evaluation.mean_uncertainty
    for name, values, uncertainty in _list_columns(evaluation):
        if np.any(np.isfinite(values)):
            yield make_quantity(
                writer.make_named("name", name),
                make_real_list(
                    unit.from_si(values).tolist(),
                    write_unit_of(unit),
                    expanded_uncertainty=() if uncertainty is None else unit.from_si(uncertainty).tolist(),
                    coverage_factor=uncertain.coverage_factor if uncertain else 0.0,
                ),
            )


def _list_columns(evaluation: Evaluation) -> Iterator[tuple[Words, FloatArray, FloatArray | None]]:
    """Yield each column's name, its values by target position, m or rad, and their U where that is known."""
    statistics, uncertain = evaluation.statistics, evaluation.mean_uncertainty
    measurand = evaluation.measurements.axis.measurand
    ways = measurand.senses if measurand.is_continuous else _APPROACHES
    for approach in Approach:
        of_approach = uncertain.by_approach[approach.index] if uncertain else None
        yield _MEAN.given(of=ways[approach.index]), statistics.mean[approach.index], of_approach
    of_both = uncertain.bidirectional if uncertain else None
    both = _MEAN_OF_SENSES if measurand.is_continuous else _MEAN_OF_BOTH
    yield both, statistics.mean_bidirectional, of_both
    for way, values in zip(ways, (statistics.s_positive, statistics.s_negative), strict=True):
        yield _DEVIATIONS.given(of=way), values, None
    yield _DIFFERENCE if measurand.is_continuous else _REVERSAL, statistics.reversal_value, None
    for column in evaluation.columns:
        yield column.quantity.name, column.values, None


def _make_findings(evaluation: Evaluation, writer: AdministrativeWriter) -> Iterator[ET.Element]:
    """Yield the requirements of the standard: met, not met, open."""
    for finding in evaluation.findings:
        yield dcc(
            "metaData",
            writer.make_named("name", _FINDINGS[finding.met].given(designation=evaluation.designation)),
            dcc("declaration", writer.make_content(named(finding.requirement, finding.found))),
        )


def _make_budget(test: _Test, writer: AdministrativeWriter) -> Iterator[ET.Element]:
    """Yield the contributions to the uncertainty of a test; what they leave out is among the statements."""
    budget = test.budget
    if not isinstance(budget, Budget) or budget.tests:  # each line has its own
        return
    unit, has_length = test.job.axis.deviation_unit, test.job.axis.has_length
    contributions = (
        make_quantity(
            writer.make_named("name", each.name),
            dcc("description", writer.make_content(each.stated), writer.make_content(each.source)),
            make_real(unit.from_si(each.standard_uncertainty), write_unit_of(unit)),
        )
        for each in budget.contributions
    )
    combined = make_real(unit.from_si(budget.standard_uncertainty), write_unit_of(unit))
    yield dcc(
        "metaData",
        writer.make_named("name", _BUDGET if has_length else _BUDGET_OF_NO_LENGTH),
        dcc("data", *contributions, make_quantity(writer.make_named("name", _COMBINED), combined)),
    )


def _make_readings(measurements: MeasurementSet, writer: AdministrativeWriter) -> Iterator[ET.Element]:
    """Yield the readings as columns; direction is 1 and −1, and NaN stands for what is missing.

    Of a test with an artefact, kinds beside that of the deviation say how it is to be understood.
    """
    axis = measurements.axis
    targets = axis.position_unit.from_si(measurements.target_positions[measurements.target])

    def column(name: Words | str, values: Iterable[float], unit: str, kind: str) -> ET.Element:
        return make_quantity(writer.make_named("name", name), make_real_list(tuple(values), unit), kind=kind)

    yield column(axis.measurand.target, targets, write_unit_of(axis.position_unit), TARGET)
    sense = _SENSE.given(first=axis.measurand.senses[0])
    yield column(sense if axis.measurand.is_continuous else _DIRECTION, measurements.approach, ONE, DIRECTION)
    yield column(_RUN, measurements.run, ONE, RUN)
    deviation = axis.deviation_unit.from_si(measurements.deviation)
    kinds = [DEVIATION, *(kind for kind, attribute in TRAITS.items() if getattr(measurements, attribute))]
    yield column(_DEVIATION, deviation, write_unit_of(axis.deviation_unit), " ".join(kinds))
    if measurements.time is not None:
        yield column(_TIME, measurements.time, SECOND, TIME)
    for key, values in measurements.conditions.items():
        if key in CONDITIONS:
            scale = CONDITIONS[key].unit
            yield column(CONDITION_NAMES[key], scale.from_si(values), SCALES[scale.symbol], CONDITION + key)
        else:
            yield column(key, values, ONE, CONDITION)
