"""What people read of how the error fell: with each effect of a model, and by a change of it."""

from __future__ import annotations

import sys
from collections.abc import Iterator, Sequence

from zlmreport.certificate.forecast import Forecast
from zlmreport.cli.model_lines import error_line, estimate_text, heading, number, wrapped
from zlmreport.cli.model_session import Change, Session
from zlmreport.cli.terminal import Colour, shown_path, table
from zlmreport.job.job import Job
from zlmreport.model.fit import Fit
from zlmreport.model.study import Fitted, moves_with_time
from zlmreport.quantities.notation import plain

_BAR_WIDTH = 28
_EIGHTHS = " ▏▎▍▌▋▊▉█"


def history_lines(history: Sequence[Fitted], forecasts: Sequence[Forecast], job: Job) -> Iterator[str]:
    """Yield how the error fell, effect by effect."""
    yield heading(job, history[-1].fit.model.identifiers)
    yield ""
    yield from fall_lines(history, forecasts)


def change_lines(session: Session, change: Change) -> Iterator[str]:
    """Yield what became of the job, and how the error changed."""
    path, after = session.shown_path, change.history[-1]
    if change.edit.inherited_from:
        origin = shown_path(session.path.parent / change.edit.inherited_from)
        yield f"{path} had its effects from {origin}; now they stand in {path} itself"
    done = [f"− {name}" for name in change.removed] + ([f"+ {change.added}"] if change.added else [])
    yield f"{path}: {', '.join(done)}"
    yield ""
    design = after.fit.design
    rows = [
        ("before", error_line(change.before.error, change.before.fit.design)),
        ("after", error_line(after.error, design)),
    ]
    yield from table(rows, indent="  ")
    yield ""
    if change.added:
        own = [each for each in after.fit.estimates if each.effect == change.added]
        yield from wrapped(f"{change.added}: {', '.join(estimate_text(each, design) for each in own)}")
        if not _stands_out(change.added, after.fit):
            yield f"  {Colour.YELLOW.of('nothing')} of it exceeds its uncertainty: it may not be there"
        yield ""
    yield from fall_lines(change.history, change.forecasts)
    yield ""
    yield f"next: zlmreport model diagnose {path}"


def fall_lines(history: Sequence[Fitted], forecasts: Sequence[Forecast]) -> Iterator[str]:
    """Yield the fall chart: a bar for each effect, down to the noise floor, and what standards would say."""
    whole = history[-1]
    unit = whole.fit.design.axis.deviation_unit
    largest = max(each.error.rms for each in history)
    forecast = forecasts[0]
    symbols = [plain(quantity.notation) for quantity in forecast.quantities]
    rows = [("", "", f"rms {unit.symbol}", "left out", *symbols)]
    names = ["without model", *(f"+ {name}" for name in whole.fit.model.identifiers)]
    for name, each, values in zip(names, history, forecast.by_step.tolist(), strict=True):
        rows.append(
            (
                name,
                bar(each.error.rms / largest if largest else 0.0),
                number(unit.from_si(each.error.rms)),
                _number_or_nothing(each.error.cross_validated_rms, whole),
                *(number(unit.from_si(value)) for value in values),
            )
        )
    floor = whole.error.noise_rms
    if floor is not None:
        blank = ("",) * (1 + len(symbols))
        share = floor / largest if largest else 0.0
        rows.append(("noise floor", bar(share), number(unit.from_si(floor)), *blank))
    yield from table(rows, right=range(2, 4 + len(symbols)), indent="  ")
    what = f"{', '.join(symbols)}: {forecast.designation}"
    yield f"  {what}, predicted if the control corrects all effects so far"
    moving = moves_with_time(whole.fit)
    if moving:
        yield f"  no table of positions takes away {', '.join(moving)}: not fixed in position"


def bar(share: float) -> str:
    """Return a bar of a length between 0 and 1."""
    eighths = round(share * 8 * _BAR_WIDTH)
    if not _can_print(_EIGHTHS):
        return "#" * max(1, round(eighths / 8)) if eighths else ""
    return (_EIGHTHS[-1] * (eighths // 8) + _EIGHTHS[eighths % 8]).rstrip()


def _can_print(text: str) -> bool:
    try:
        text.encode(sys.stdout.encoding or "ascii")
    except UnicodeEncodeError:
        return False
    return True


def _stands_out(identifier: str, fit: Fit) -> bool:
    """Return whether any size of an effect exceeds its uncertainty: its place or period says nothing."""
    (effect,) = (term.effect for term in fit.model.terms if term.effect.identifier == identifier)
    sizes = [each for each in fit.estimates if each.effect == identifier and each.parameter in effect.linear]
    return any(each.is_given or abs(each.value) > each.expanded_uncertainty for each in sizes)


def _number_or_nothing(value: float | None, fitted: Fitted) -> str:
    return "–" if value is None else number(fitted.fit.design.axis.deviation_unit.from_si(value))
