"""What people read of a diagnosis: verdict, where the model fails, what may be missing, what is hidden."""

from __future__ import annotations

import json
from collections.abc import Iterator

from zlmreport.cli.model_lines import (
    error_line,
    estimate_text,
    heading,
    parameter_lines,
    said,
    wrapped,
)
from zlmreport.cli.terminal import Colour, table
from zlmreport.job.job import Job
from zlmreport.model import wording
from zlmreport.model.diagnosis import Candidate, Diagnosis, Verdict
from zlmreport.model.effect import Effect
from zlmreport.model.report import listed, serious_candidates, verdict_statement
from zlmreport.quantities.formatting import fixed_number

_COLOURS = {
    Verdict.ADEQUATE: Colour.GREEN,
    Verdict.MISSING: Colour.YELLOW,
    Verdict.UNEXPLAINED: Colour.RED,
}
#: Share of an effect that a plan sees, below which it hides it.
_HIDDEN = 0.1
#: Nobody knows the tails of real scatter better: below, a smaller chance is no stronger evidence.
_LEAST_P = 1e-6
_SMALL_P = 1e-3


def diagnosis_lines(diagnosis: Diagnosis, job: Job, path: str) -> Iterator[str]:
    """Yield the lines on a diagnosis; `path` is the job as the user types it."""
    fit = diagnosis.fit
    yield heading(job, fit.model.identifiers)
    yield ""
    for line in wrapped(said(verdict_statement(diagnosis))):
        yield _COLOURS[diagnosis.verdict].of(line)
    yield f"  {error_line(diagnosis.error, fit.design)}"
    if fit.model.terms:
        yield from ("", Colour.BOLD.of("model"))
        yield from parameter_lines(fit)
    yield from _failures(diagnosis)
    yield from _candidates(diagnosis)
    yield from _hidden(diagnosis)
    yield ""
    if diagnosis.candidates and diagnosis.verdict is Verdict.MISSING:
        yield f"next: zlmreport model add {path} {_argument(diagnosis.candidates[0].effect)}"
    else:
        yield f"next: zlmreport {path}"


def _failures(diagnosis: Diagnosis) -> Iterator[str]:
    if not diagnosis.failures:
        return
    yield from ("", Colour.BOLD.of("where it fails"))
    for failure in diagnosis.failures:
        text = f"{said(failure.statement)} ({said(failure.where)}; {_p(failure.p_value)})"
        yield from wrapped(text)


def _candidates(diagnosis: Diagnosis) -> Iterator[str]:
    if not diagnosis.candidates:
        return
    yield from ("", Colour.BOLD.of("what may be missing"))
    unit = diagnosis.fit.design.axis.deviation_unit
    rows = [("", "", "probability", f"rms {unit.symbol}", "left out", "")]
    for number, each in enumerate(diagnosis.candidates, start=1):
        left_out = each.error.cross_validated_rms
        rows.append(
            (
                str(number),
                each.identifier,
                _percent(each.probability),
                said(wording.significant(unit.from_si(each.error.rms))),
                "–" if left_out is None else said(wording.significant(unit.from_si(left_out))),
                _p(each.p_value, is_extrapolated=each.p_value_is_extrapolated),
            )
        )
    lines = list(table(rows, right=(2, 3, 4), indent="  "))
    yield lines[0]
    for line, each in zip(lines[1:], diagnosis.candidates, strict=True):
        yield line
        if each in serious_candidates(diagnosis):
            yield from _details(each, diagnosis)


def _details(candidate: Candidate, diagnosis: Diagnosis) -> Iterator[str]:
    design = diagnosis.fit.design
    parameters = ", ".join(estimate_text(each, design) for each in candidate.estimates)
    yield from wrapped(parameters, "     ")
    yield from wrapped(said(candidate.explains), "     ")
    if candidate.equals:
        names = said(listed(candidate.equals))
        yield from wrapped(f"not to be told from {names} by these readings", "     ")
    if candidate.discriminate_by:
        yield from wrapped(f"to tell: {said(candidate.discriminate_by)}", "     ")
    if diagnosis.not_excluded and candidate is diagnosis.candidates[0]:
        yield from wrapped(
            f"not excluded, for they could not be tried: {', '.join(diagnosis.not_excluded)}", "     "
        )


def _hidden(diagnosis: Diagnosis) -> Iterator[str]:
    """Yield what this test cannot see, and what it could not try and why."""
    hidden = [each for each in diagnosis.visibility if each.share < _HIDDEN]
    if not hidden and not diagnosis.not_testable:
        return
    yield from ("", Colour.BOLD.of("what this test cannot see"))
    for each in hidden:
        text = f"{each.effect}: {_percent(each.share)} of it is visible beside this model"
        if each.smallest_rms < float("inf"):
            text += (
                f"; found from {said(wording.deviation(diagnosis.fit.design.axis, each.smallest_rms))} rms on"
            )
        yield from wrapped(text)
    by_reason: dict[str, list[str]] = {}
    for one in diagnosis.not_testable:
        by_reason.setdefault(said(one.reason), []).append(one.effect)
    for reason, effects in by_reason.items():
        yield from wrapped(f"{', '.join(effects)}: {reason}")


def _argument(effect: Effect) -> str:
    """Return an effect as an argument of the command line, with its keys unless they are the usual ones."""
    settings = effect.settings.model_dump(mode="json", exclude_defaults=True)
    if not settings:
        return effect.identifier
    return f"'{effect.identifier}: {json.dumps(settings)}'"


def _p(value: float, *, is_extrapolated: bool = False) -> str:
    """Write a chance with as many digits as it is known to: one if no simulated test comes near it."""
    equals, digits, remark = ("≈", 0, " (extrapolated)") if is_extrapolated else ("=", 1, "")
    if value < _LEAST_P:
        return f"p < {_power(_LEAST_P, 0)}{remark}"
    return f"p {equals} {_power(value, digits) if value < _SMALL_P else f'{value:.3f}'}{remark}"


def _power(value: float, digits: int) -> str:
    mantissa, exponent = f"{value:.{digits}e}".split("e")
    return f"{mantissa}e{int(exponent)}"


def _percent(share: float) -> str:
    if 0 < share < 0.005:
        return "< 1 %"
    return f"{fixed_number(100 * share, 0)} %"
