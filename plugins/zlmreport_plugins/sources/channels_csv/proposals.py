"""Guesses which column of a logger's file is which channel, by English and German names."""

from __future__ import annotations

import re
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from zlmreport.plugin import CONDITIONS, InputError
from zlmreport.plugin.table import folded, heading_of, read_headings
from zlmreport_plugins.logged_columns import LOGGED, SOME_TEMPERATURE
from zlmreport_plugins.sources.channels_csv.options import CHANNEL, DATE, TIME, VALUE, ChannelsCsvOptions
from zlmreport_plugins.sources.channels_csv.tracks import Channels

#: How sensors are called: by the direction in which they read, and a number where there are two.
SENSOR = re.compile(r"[xyz][12]?")
_WORDS = re.compile(r"[^\W_]+")
_CALLED = {
    **{name: TIME for name, column in LOGGED.items() if column == TIME},
    **dict.fromkeys(("datum", "tag", "day"), DATE),
    **dict.fromkeys(("kanal", "messstelle", "sensor", "fühler", "signal", "kanalname"), CHANNEL),
    **dict.fromkeys(("wert", "messwert", "reading", "anzeige"), VALUE),
}
_WHOSE = (
    "Is {name!r} the temperature of the air? 'air_temperature' is a guess; that of the machine's scale is "
    "'axis_temperature', of what is measured 'material_temperature'."
)


@dataclass(frozen=True, slots=True)
class Called:
    """What a file calls its columns and channels, where that is not what a job calls them."""

    keys: dict[str, Any]  #: Of a job.
    asks: tuple[str, ...] = ()  #: What is guessed.


def find_columns_called(file: Path) -> Called | None:
    """Return the keys for the columns of time, date, channel and value; None where no time can be told."""
    options = ChannelsCsvOptions(file=file)
    try:
        table = options.read_table(_is_known)
        headings = read_headings(table, options)
    except InputError:
        return None
    found: dict[str, str] = {}
    for heading in headings:
        name = folded(heading.name)
        column = name if name in options.column_names else _CALLED.get(name)
        if column is not None:
            if column in found:
                return None
            found[column] = heading.name
    if TIME not in found and DATE in found:
        found[TIME] = found.pop(DATE)  # a day with its time in one column
    if TIME not in found:
        return None
    columns = {column: name for column, name in found.items() if folded(name) != column}
    return Called({"columns": columns} if columns else {})


def find_channels_called(called: Called, channels: Channels) -> Called:
    """Return the keys with those for the channels of sensors, and of the state of air and machine."""
    found: dict[str, str] = {}
    asks: list[str] = []
    for key, channel in channels.of.items():
        name = _find_sensor_in(key) or _find_condition_called(key, asks, channel.name)
        if name is None or folded(name) == key:
            continue
        if name in found:
            return called  # two of one name: which is which, the file does not tell
        found[name] = channel.name
    keys = {**called.keys, **({"channels": found} if found else {})}
    return replace(called, keys=keys, asks=(*called.asks, *asks))


def _find_condition_called(key: str, asks: list[str], name: str) -> str | None:
    if key in CONDITIONS:
        return key
    if key in SOME_TEMPERATURE:
        asks.append(_WHOSE.format(name=name))
        return "air_temperature"
    meant = LOGGED.get(key)
    return meant if meant in CONDITIONS else None


def _find_sensor_in(key: str) -> str | None:
    """Return the sensor that a channel is called by, X1: alone, or as one word of its name."""
    words = [word for word in _WORDS.findall(key) if SENSOR.fullmatch(word)]
    return words[0].upper() if len(words) == 1 else None


def _is_known(text: str) -> bool:
    name = folded(heading_of(text).name)
    names = {*_CALLED, *LOGGED, *SOME_TEMPERATURE, *ChannelsCsvOptions.column_names, *CONDITIONS}
    return name in names or bool(SENSOR.fullmatch(name))
