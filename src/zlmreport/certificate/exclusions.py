"""Readings that were set aside: which, what they were, and why."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from zlmreport.certificate.document import Notice
from zlmreport.language import Words

if TYPE_CHECKING:
    from zlmreport.job.keys import JobKeys
    from zlmreport.measurement.measurement_set import MeasurementSet
    from zlmreport.measurement.provenance import Exclusion
    from zlmreport.presenting.writer import Writer

_ONE = Words(
    en="{count} reading was set aside and did not enter the results",
    de="{count} Messwert wurde beiseite gelegt und ging nicht in die Ergebnisse ein",
)
_SEVERAL = Words(
    en="{count} readings were set aside and did not enter the results",
    de="{count} Messwerte wurden beiseite gelegt und gingen nicht in die Ergebnisse ein",
)
_READING = Words(
    en="target {target} {position_unit} {arrow}, run {run}, read {deviation} {unit}: {reason}",
    de="Sollposition {target} {position_unit} {arrow}, Durchlauf {run}, gelesen {deviation} {unit}: {reason}",
)
_STATED = Words(
    en="Set aside{mark}: target {target} {position_unit} {arrow}, run {run}: {reason}",
    de="Beiseite gelegt{mark}: Sollposition {target} {position_unit} {arrow}, Durchlauf {run}: {reason}",
)
_STATED_AS_FOUND = Words(
    en="Set aside as found{mark}: target {target} {position_unit} {arrow}, run {run}: {reason}",
    de="Beiseite gelegt, vorgefundener Zustand{mark}: Sollposition {target} {position_unit} {arrow}, "
    "Durchlauf {run}: {reason}",
)
_KEY = "measurement.excluded"
_ARROWS = {"+": "↑", "-": "↓"}
#: Readings that the first page names one by one.
_MOST_NAMED = 6
_MORE = Words(
    en="Set aside besides: {count} more, see the section on the readings",
    de="Außerdem beiseite gelegt: {count} weitere, siehe den Abschnitt über die Messwerte",
)


def notice(measurements: MeasurementSet, writer: Writer, key: str = _KEY) -> Iterator[Notice]:
    """Yield the notice that names every reading that was set aside, with its value and the reason.

    Parameters
    ----------
    measurements
        The readings.
    writer
        Of the document.
    key
        The job key that names them: marked if that was the customer's decision.
    """
    exclusions = measurements.provenance.exclusions
    if exclusions:
        heading = (_ONE if len(exclusions) == 1 else _SEVERAL).given(count=len(exclusions))
        marked = writer.say(heading) + writer.marks.after(key)
        yield Notice(marked, tuple(_item(each, writer) for each in exclusions))


def stated(keys: JobKeys, writer: Writer) -> tuple[str, ...]:
    """Return what the first page says of readings that were set aside: they depart from the method."""
    found = [(_STATED, _KEY, each) for each in keys.measurement.excluded]
    if keys.as_found:
        found += [(_STATED_AS_FOUND, f"as_found.{_KEY}", each) for each in keys.as_found.measurement.excluded]
    items = [
        writer.say(
            words.given(
                mark=writer.marks.after(key),
                target=each.target,
                position_unit=writer.position_unit.symbol,
                arrow=_ARROWS[each.direction],
                run=each.run,
                reason=each.reason,
            )
        )
        for words, key, each in found[:_MOST_NAMED]
    ]
    if len(found) > _MOST_NAMED:
        items.append(writer.say(_MORE.given(count=len(found) - _MOST_NAMED)))
    return tuple(items)


def _item(exclusion: Exclusion, writer: Writer) -> str:
    return writer.say(
        _READING.given(
            target=writer.position(exclusion.target_position),
            position_unit=writer.position_unit.symbol,
            arrow=exclusion.approach.arrow,
            run=exclusion.run,
            deviation=writer.deviation(exclusion.deviation),
            unit=writer.deviation_unit.symbol,
            reason=exclusion.reason,
        )
    )
