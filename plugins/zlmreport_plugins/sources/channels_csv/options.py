"""The keys of a table of channels over time in a job."""

from __future__ import annotations

from types import MappingProxyType

from pydantic import Field, field_validator

from zlmreport.plugin import CONDITIONS, LENGTH_UNITS, SECOND, TIME_UNITS, Positive, TextLine, did_you_mean
from zlmreport.plugin.table import TableOptions

TIME, CHANNEL, VALUE = "time", "channel", "value"
COLUMN_NAMES: tuple[str, ...] = (TIME, CHANNEL, VALUE)
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
    interval: Positive | None = Field(
        None,
        description="Readings are averaged over intervals of so many seconds. Without it they are kept as "
        "they are, up to 1440 of a channel; of more, averages are taken.",
        examples=[60],
    )

    @field_validator("channels")
    @classmethod
    def _conditions_are_known(cls, channels: dict[str, str]) -> dict[str, str]:
        """Refuse what is meant for a condition and is none: it would be lost without a word."""
        for name in channels:
            near = did_you_mean(name, list(CONDITIONS))
            if name not in CONDITIONS and "_" in name and not name.endswith("_temperature"):
                raise ValueError(f"{name!r} is no condition; {near}; others end in _temperature")
        return channels
