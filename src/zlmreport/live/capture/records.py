"""The records of a journal: its header, and how each event is written and read."""

from __future__ import annotations

import dataclasses
import datetime as dt
import math
import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from types import MappingProxyType
from typing import Any, TypeAlias, get_args

from zlmreport.live.capture.events import Event, Mean, Moving, Recorded, Settling
from zlmreport.live.capture.visits import ListedVisit, Settings
from zlmreport.measurement.approach import Approach
from zlmreport.measurement.axis import AxisKind

Record: TypeAlias = dict[str, Any]

#: Events of the moment: shown, and not kept.
MOMENTARY = (Moving, Settling)

#: Records whose names are not those of their events, as journals have them since the first.
_OTHER_NAMES = {"datum-taken": "datum", "recorded": "reading", "commented": "comment"}


def _name_kind(kind: type) -> str:
    """Return the name of an event's records: ``moved-before-datum`` of `MovedBeforeDatum`."""
    name = re.sub("(?<=[a-z])(?=[A-Z])", "-", kind.__name__).lower()
    return _OTHER_NAMES.get(name, name)


_NAMES: Mapping[type, str] = {kind: _name_kind(kind) for kind in get_args(Event) if kind not in MOMENTARY}
_KINDS: Mapping[str, type] = {name: kind for kind, name in _NAMES.items()}
#: Fields that a record leaves out where they say nothing, with what they are then.
_UNSTATED: Mapping[str, Any] = {
    "late": 0.0,
    "position": None,
    "mean": None,
    "expected": None,
    "factor": None,
    "drift": None,
}


def to_record(event: Event) -> Record:
    """Return the keys of an event: visits by their numbers, the mean's values beside the others, SI."""
    record: Record = {"record": _NAMES[type(event)]}
    for name in _list_fields(type(event)):
        value = getattr(event, name)
        if isinstance(value, Mean):
            record |= {each: _make_plain(getattr(value, each)) for each in _list_fields(Mean)}
        elif name in _UNSTATED and value == _UNSTATED[name]:
            continue
        else:
            record[name] = _make_plain(value)
    if isinstance(event, Recorded):
        record["deviation"] = event.deviation
    return record


def from_record(record: Mapping[str, Any], visits: Sequence[ListedVisit]) -> Event:
    """Return the event of a record; raise KeyError, TypeError, ValueError or IndexError for any other."""
    kind = _KINDS[record["record"]]
    unstated = {name for name in _UNSTATED if ("value" if name == "mean" else name) not in record}
    stated = (name for name in _list_fields(kind) if name not in unstated)
    event: Event = kind(**{name: _READERS[name](record, visits) for name in stated})
    return event


def _list_fields(kind: type) -> tuple[str, ...]:
    return tuple(each.name for each in dataclasses.fields(kind))


def require_finite(value: Any) -> float:
    """Return a number; raise TypeError or ValueError for anything else."""
    if isinstance(value, bool) or not isinstance(value, int | float):
        raise TypeError(f"{value!r} is no number")
    if not math.isfinite(value):
        raise ValueError(f"{value!r} is not finite")
    return float(value)


def _make_plain(value: Any) -> Any:
    if isinstance(value, ListedVisit):
        return value.number
    if isinstance(value, tuple):
        return [_make_plain(each) for each in value]
    if isinstance(value, Mapping):
        return {name: each for name, each in value.items() if math.isfinite(each)}
    return int(value) if isinstance(value, Approach) else value


def _visit(number: Any, visits: Sequence[ListedVisit]) -> ListedVisit | None:
    if number is None:
        return None
    if number not in range(1, len(visits) + 1):
        raise ValueError(f"there is no visit {number!r}")
    return visits[int(number) - 1]


def _read_mean(record: Mapping[str, Any]) -> Mean:
    conditions = {str(name): require_finite(value) for name, value in dict(record["conditions"]).items()}
    return Mean(
        value=require_finite(record["value"]),
        range=require_finite(record["range"]),
        count=int(record["count"]),
        skipped=int(record["skipped"]),
        time=require_finite(record["time"]),
        duration=require_finite(record["duration"]),
        conditions=MappingProxyType(conditions),
    )


_Reader: TypeAlias = Callable[[Mapping[str, Any], Sequence[ListedVisit]], Any]


def _read_number(name: str) -> _Reader:
    return lambda record, _visits: require_finite(record[name])


def _read_list_of(name: str) -> _Reader:
    return lambda record, visits: _visit(record[name], visits)


_READERS: Mapping[str, _Reader] = {
    **{name: _read_list_of(name) for name in ("visit", "first", "last")},
    "candidates": lambda record, visits: tuple(
        (_visit(number, visits), require_finite(odds)) for number, odds in record["candidates"]
    ),
    "void": lambda record, visits: tuple(_visit(number, visits) for number in record["void"]),
    "mean": lambda record, _visits: _read_mean(record),
    "approach": lambda record, _visits: None if record["approach"] is None else Approach(record["approach"]),
    "holds": lambda record, _visits: bool(record["holds"]),
    "target": lambda record, _visits: int(record["target"]),
    "attempt": lambda record, _visits: int(record["attempt"]),
    "message": lambda record, _visits: str(record["message"]),
    "reason": lambda record, _visits: str(record["reason"]),
    "text": lambda record, _visits: str(record["text"]),
    **{
        name: _read_number(name)
        for name in (
            *("position", "difference", "seconds", "silence", "spacing", "largest", "late", "expected"),
            *("factor", "drift", "share"),
        )
    },
}


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
            "settings": {name: getattr(self.settings, name) for name in _list_fields(Settings)},
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
            settings=Settings(**{name: require_finite(value) for name, value in record["settings"].items()}),
            datum=None if datum is None else require_finite(datum),
            visits=tuple(
                ListedVisit(
                    number,
                    int(target),
                    require_finite(position),
                    Approach(approach),
                    int(run),
                    int(part),
                    require_finite(travelled),
                )
                for number, (target, position, approach, run, part, travelled) in enumerate(
                    record["visits"], start=1
                )
            ),
        )
