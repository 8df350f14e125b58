"""The keys of a table of channels over time in a job."""

from __future__ import annotations

from types import MappingProxyType
from typing import Self

from pydantic import Field, field_validator, model_validator

from zlmreport.plugin import (
    CONDITIONS,
    LENGTH_UNITS,
    SECOND,
    TIME_UNITS,
    Finite,
    Positive,
    TextLine,
    did_you_mean,
    quoted,
)
from zlmreport.plugin.table import TableOptions, moment

TIME, DATE, CHANNEL, VALUE = "time", "date", "channel", "value"
COLUMN_NAMES: tuple[str, ...] = (TIME, DATE, CHANNEL, VALUE)
#: What times may be in, and what they are in where nobody says.
TIMES = (TIME_UNITS, SECOND)


class ChannelsCsvOptions(TableOptions):
    """Where the table of channels is, and what it does not say itself."""

    column_names = COLUMN_NAMES
    column_units = MappingProxyType({TIME: TIME_UNITS, VALUE: LENGTH_UNITS})
    header_example = "time,channel,value"

    channels: dict[str, TextLine] = Field(
        {},
        description="The file's own names of channels, by the names of tests, X1, and of conditions, "
        "air_temperature; without it they have these names in the file.",
        examples=[{"X1": "Probe 1", "air_temperature": "Hall"}],
    )
    counted_from: TextLine | None = Field(
        None,
        description="The moment from which times are counted, written as the file writes its own: several "
        "loggers that knew the time of day have one beginning with it. Without it the first reading of the "
        "file.",
        examples=["2026-11-18 08:00"],
    )
    later_by: Finite | None = Field(
        None,
        description="How much later than the test the logger of this file was started, s, where it did not "
        "know the time of day; negative if it was earlier.",
        examples=[90],
    )
    interval: Positive | None = Field(
        None,
        description="Readings are averaged over intervals of so many seconds. Without it they are kept as "
        "they are, up to 1440 of a channel; of more, averages are taken.",
        examples=[60],
    )

    @model_validator(mode="after")
    def _beginning_is_stated_once(self) -> Self:
        if self.counted_from is not None and self.later_by is not None:
            raise ValueError("'counted_from' and 'later_by' both say when the test began; remove one of them")
        if self.counted_from is not None and moment(self.counted_from) is None:
            raise ValueError(
                f"counted_from: {quoted(self.counted_from)} is no moment; 2026-11-18 08:00 is one"
            )
        return self

    @field_validator("channels")
    @classmethod
    def _conditions_are_known(cls, channels: dict[str, str]) -> dict[str, str]:
        """Refuse what is meant for a condition and is none: it would be lost without a word."""
        for name in channels:
            near = did_you_mean(name, list(CONDITIONS))
            if name not in CONDITIONS and "_" in name and not name.endswith("_temperature"):
                raise ValueError(f"{name!r} is no condition; {near}; others end in _temperature")
        return channels
