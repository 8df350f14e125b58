"""A parameter over the years: the calibrations of one axis that state it, in the order of measurement."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable
from dataclasses import dataclass
from datetime import date

from zlmreport.fleet.records import Entry, RecordedParameter, State


@dataclass(frozen=True, slots=True)
class Calibration:
    """One point of a series.

    Attributes
    ----------
    measured
        Date of the measurement.
    entry
        The certificate.
    parameter
        What it states.
    """

    measured: date
    entry: Entry
    parameter: RecordedParameter


@dataclass(frozen=True, slots=True)
class Series:
    """A parameter of one axis by one standard over time.

    Attributes
    ----------
    machine, axis
        As in the ledger.
    standard, symbol, unit
        As in the results file.
    calibrations
        In the order of measurement; at least one.
    """

    machine: str
    axis: str
    standard: str
    symbol: str
    unit: str
    calibrations: tuple[Calibration, ...]

    @property
    def latest(self) -> RecordedParameter:
        """What the latest certificate states."""
        return self.calibrations[-1].parameter


def standing(entries: Iterable[Entry]) -> tuple[Entry, ...]:
    """Return the certificates that stand, in the order of measurement.

    A job that was made again, and one that amends, replaces what it said of the same measurement before.
    Drafts are not issued and failures state nothing.

    Parameters
    ----------
    entries
        Of the ledger, in any order.
    """
    standing: dict[tuple[str, str], Entry] = {}
    for entry in sorted(entries, key=lambda entry: entry.night):
        if entry.state is State.MADE and entry.measured:
            standing[entry.job, entry.measured] = entry
    return tuple(sorted(standing.values(), key=lambda entry: (entry.measured, entry.night, entry.number)))


def series_of(certificates: Iterable[Entry]) -> tuple[Series, ...]:
    """Return every parameter of every axis over time, machine by machine.

    Parameters
    ----------
    certificates
        Those that stand, in the order of measurement.
    """
    found: defaultdict[tuple[str, str, str, str, str], list[Calibration]] = defaultdict(list)
    for entry in certificates:
        measured = date.fromisoformat(entry.measured)
        for parameter in entry.parameters:
            key = entry.machine, entry.axis, parameter.standard, parameter.symbol, parameter.unit
            found[key].append(Calibration(measured, entry, parameter))
    # The order within an axis is that of its certificates, and so that of its standards.
    return tuple(
        Series(*key, tuple(calibrations))
        for key, calibrations in sorted(found.items(), key=lambda item: item[0][:2])
    )
