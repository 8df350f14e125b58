"""The first line of a journal: what is captured, with what, and how."""

from __future__ import annotations

import datetime as dt
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from zlmreport.capture.records import fields, finite
from zlmreport.capture.settings import Settings
from zlmreport.capture.visit_list import ListedVisit
from zlmreport.measurement.approach import Approach
from zlmreport.measurement.axis import AxisKind

SCHEMA = "zlmreport/journal/1"


@dataclass(frozen=True, slots=True)
class Header:
    """What a journal says of its capture.

    Attributes
    ----------
    number
        Of the certificate.
    job
        SHA-256 of the job file as it was when the capture began.
    axis, kind
        Name and kind of the axis.
    instrument
        The instrument's keys of the job.
    tool
        Program and version.
    started
        When the capture began; times of records are seconds from then.
    method
        The positioning method.
    settings
        When a reading is taken.
    datum
        Where the axis stands when the datum is taken, m or rad; None for the instrument's own zero.
    visits
        What is to be read, in order.
    """

    number: str
    job: str
    axis: str
    kind: AxisKind
    instrument: Mapping[str, Any]
    tool: str
    started: dt.datetime
    method: str
    settings: Settings
    datum: float | None
    visits: tuple[ListedVisit, ...]

    def to_record(self) -> dict[str, Any]:
        """Return the keys of the line, in SI."""
        return {
            "schema": SCHEMA,
            "tool": self.tool,
            "started": self.started.isoformat(timespec="milliseconds"),
            "certificate": self.number,
            "job": self.job,
            "axis": {"name": self.axis, "kind": str(self.kind)},
            "instrument": dict(self.instrument),
            "method": self.method,
            "settings": {name: getattr(self.settings, name) for name in fields(Settings)},
            "datum": self.datum,
            "visits": [
                [visit.target, visit.position, int(visit.approach), visit.run, visit.part, visit.travelled]
                for visit in self.visits
            ],
        }

    @classmethod
    def from_record(cls, record: Mapping[str, Any]) -> Header:
        """Return the header that a line holds; raise KeyError, TypeError or ValueError for any other."""
        if record["schema"] != SCHEMA:
            raise ValueError(f"schema {record['schema']!r} is not {SCHEMA}")
        datum = record["datum"]
        return cls(
            number=str(record["certificate"]),
            job=str(record["job"]),
            axis=str(record["axis"]["name"]),
            kind=AxisKind(record["axis"]["kind"]),
            instrument=dict(record["instrument"]),
            tool=str(record["tool"]),
            started=dt.datetime.fromisoformat(record["started"]),
            method=str(record["method"]),
            settings=Settings(**{name: finite(value) for name, value in record["settings"].items()}),
            datum=None if datum is None else finite(datum),
            visits=tuple(
                ListedVisit(
                    number,
                    int(target),
                    finite(position),
                    Approach(approach),
                    int(run),
                    int(part),
                    finite(travelled),
                )
                for number, (target, position, approach, run, part, travelled) in enumerate(
                    record["visits"], start=1
                )
            ),
        )
