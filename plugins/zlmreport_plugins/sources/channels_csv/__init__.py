"""Data source ``channels-csv``: channels over time as loggers write; conditions between their times.

One channel becomes a measurement set: that which has the name of the test. The target positions are times, s
from the first reading of the file; there is one run, in the positive sense, as time goes on. Temperatures and
the state of the air become conditions of its readings. A channel whose name or unit says that it is another
temperature is a condition too, in °C, by a name that ends in ``_temperature``.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from pathlib import Path

import numpy as np

from zlmreport.plugin import (
    CELSIUS,
    CONDITIONS,
    DISPLACEMENT,
    LENGTH_UNITS,
    MICROMETRE,
    Approach,
    Axis,
    Coordinate,
    FloatArray,
    InputError,
    MeasurementSet,
    Options,
    Place,
    Problem,
    Words,
    did_you_mean,
    hookimpl,
    quoted,
)
from zlmreport.plugin.source import (
    DataSource,
    Provenance,
    Reading,
    SourceContext,
    SourceProposal,
    cap_problems,
    collect_readings,
)
from zlmreport.plugin.table import folded, heading_of
from zlmreport_plugins.sources.channels_csv.options import DATE, TIME, VALUE, ChannelsCsvOptions
from zlmreport_plugins.sources.channels_csv.proposals import SENSOR, find_channels_called, find_columns_called
from zlmreport_plugins.sources.channels_csv.tracks import (
    Channel,
    Channels,
    ChannelTrack,
    add_dates,
    average_channel,
    choose_interval_for,
    find_unit_of,
    read_channels_of,
)

#: What a condition that is no known one ends in, if it is a temperature.
_TEMPERATURE = "_temperature"
_TEMPERATURES = CONDITIONS["air_temperature"]
#: A drift over hours that is smaller than this in what nobody called a unit, m, was read in a larger one.
_HARDLY = 5e-7
#: Channels of a file that a message names.
_MOST_NAMED = 20
_FROM = Words("Channel “{channel}” ({unit}); times are counted from the first reading of the file.")
_FROM_MOMENT = Words("Channel “{channel}” ({unit}); times are counted from {moment}.")
_LATER = Words(
    "Channel “{channel}” ({unit}); the first reading of the file was taken {seconds} s after the test began."
)
_BESIDE = Words(
    "Conditions were logged at other times than channel “{channel}”: {names} at its readings are linear "
    "between those that were logged."
)
_AVERAGED = Words(
    "{readings} readings were averaged over intervals of {interval} s. What the averages leave out has a "
    "root mean square of {left} µm."
)


class ChannelsCsv:
    """Tables of channels over time."""

    identifier = "channels-csv"
    title = Words("Table of channels over time (CSV)")
    options: type[Options] = ChannelsCsvOptions
    suffixes = ()

    def proposals(self, file: Path) -> Iterable[SourceProposal]:
        """Return the keys by which a file may be read, if it has sensors over time and nothing else."""
        called = find_columns_called(file)
        if called is None:
            return []
        context = SourceContext(Axis("X", quantity=DISPLACEMENT), Place(str(file)))
        try:
            called = find_channels_called(
                called, _read_channels(ChannelsCsvOptions(file=file, **called.keys), context)
            )
            channels = _read_channels(ChannelsCsvOptions(file=file, **called.keys), context)
        except InputError:
            return []
        names = {folded(each): name for name, each in called.keys.get("channels", {}).items()}
        sensors, others = [], []
        for key, each in channels.of.items():
            name = folded(names.get(key, key))
            if SENSOR.fullmatch(name):
                sensors.append(name.upper())
            elif name not in CONDITIONS and _name_condition(key, each) is None:
                others.append(name)
        if not sensors or others:
            return []
        tests = tuple(sorted(sensors))
        asks = (*called.asks, *_list_asked(tests))
        return [SourceProposal(called.keys, asks, quantity=DISPLACEMENT, tests=tests)]

    def read(self, options: ChannelsCsvOptions, context: SourceContext) -> MeasurementSet:
        """Read one channel and the conditions beside it; raise `InputError` with every defect."""
        axis = context.axis
        if axis.measurand.coordinate is not Coordinate.TIME:
            raise InputError.at(
                context.place,
                "channels-csv reads displacements over time, and this job is on "
                f"{axis.measurand.identifier}; name its channels as tests: measurement.tests: "
                "{X1: {source: …}, …}, and evaluate a standard of drift",
            )
        channels = _read_channels(options, context)
        own = _find_channel_of(axis.name, channels, options)
        stated = options.units.get(VALUE)
        unit = find_unit_of(own, stated, LENGTH_UNITS, MICROMETRE)
        track = channels.read_track(own, unit, LENGTH_UNITS)
        conditions = dict(_list_conditions(channels, options))
        table = channels.table
        problems = list(dict.fromkeys([*table.problems, *channels.cells.problems]))
        if not problems and stated is None and own.unit is None:
            problems = list(_ask_about_larger_unit(track, own))
        if problems:
            raise InputError(cap_problems(problems))
        remarks = [_say_counted_from(options).given(channel=own.name, unit=unit.symbol)]
        averaging = None
        interval = options.interval or choose_interval_for(channels.most_readings, channels.lasts)
        if interval and track.time.size:
            track, averaging = average_channel(track, interval)
            remarks.append(
                _AVERAGED.given(
                    readings=averaging.readings,
                    interval=float(f"{interval:.6g}"),
                    left=float(f"{MICROMETRE.from_si(averaging.left_out):.2g}"),
                )
            )
        elsewhere = [name for name, each in conditions.items() if not np.isin(track.time, each.time).all()]
        if elsewhere and not interval:
            remarks.append(_BESIDE.given(channel=own.name, names=", ".join(elsewhere)))
        beside = {name: _interpolate_at(track.time, each) for name, each in conditions.items()}
        readings = [
            Reading(
                place,
                float(time),
                Approach.POSITIVE,
                1,
                float(value),
                float(time),
                {name: float(values[index]) for name, values in beside.items()},
            )
            for index, (place, time, value) in enumerate(
                zip(track.places, track.time, track.value, strict=True)
            )
        ]
        provenance = Provenance(self.identifier, (table.source.source,), tuple(remarks), averaging=averaging)
        return collect_readings(readings, axis, provenance, place=table.source.place())


def _say_counted_from(options: ChannelsCsvOptions) -> Words:
    """Return from when on times are counted, of a channel."""
    if options.counted_from is not None:
        return _FROM_MOMENT.given(moment=options.counted_from)
    return _LATER.given(seconds=options.later_by) if options.later_by else _FROM


def _read_channels(options: ChannelsCsvOptions, context: SourceContext) -> Channels:
    table = add_dates(options.read_table(lambda name: _is_column_name(name, options)), options)
    # The decimal sign is that of all numbers: which columns have any is known only with it.
    numbers = [
        index
        for index, name in enumerate(table.header.cells)
        if folded(heading_of(name).name) not in {TIME, DATE}
    ]
    return read_channels_of(options.cells_of(table, numbers), options, context)


def _is_column_name(text: str, options: ChannelsCsvOptions) -> bool:
    """Whether a header is a name that this source or the job knows."""
    named = heading_of(text)
    name = folded(named.name)
    is_known = options.names_column(text) or name in CONDITIONS or bool(SENSOR.fullmatch(name))
    return is_known or any(named.is_called(each) for each in options.channels.values())


def _find_channel_of(name: str, channels: Channels, options: ChannelsCsvOptions) -> Channel:
    """Return the channel of a test; raise `InputError` with the nearest name if there is none."""
    called = options.channels.get(name, name)
    found = channels.find(called)
    if found is not None:
        return found
    names = [each.name for each in channels.of.values()]
    raise InputError.at(
        channels.table.source.place(),
        f"there is no channel {quoted(called)}; {did_you_mean(called, names)}; name it in the job, as in "
        f"'channels: {{{name}: …}}' (the file has {', '.join(map(quoted, names[:_MOST_NAMED]))})",
    )


def _list_conditions(channels: Channels, options: ChannelsCsvOptions) -> Iterator[tuple[str, ChannelTrack]]:
    """Yield the conditions that were logged, SI where they are known by name, and else in °C."""
    renamed: dict[str, str] = {}
    for name in options.channels:
        if name in CONDITIONS or name.endswith(_TEMPERATURE):
            renamed[folded(_find_channel_of(name, channels, options).name)] = name
    for key, channel in channels.of.items():
        called = renamed.get(key) or _name_condition(key, channel)
        if called is None:
            continue
        kind = CONDITIONS.get(called, _TEMPERATURES)
        track = channels.read_track(channel, find_unit_of(channel, None, kind.units, kind.unit), kind.units)
        yield called, track if called in CONDITIONS else _convert_to_celsius(track, channels, channel)


def _name_condition(key: str, channel: Channel) -> str | None:
    """Return the name of the condition that a channel is; None for a displacement."""
    if key in CONDITIONS or key.endswith(_TEMPERATURE):
        return key
    is_temperature = (channel.unit or "").casefold() in _TEMPERATURES.units
    return f"{key}{_TEMPERATURE}" if is_temperature else None


def _convert_to_celsius(track: ChannelTrack, channels: Channels, channel: Channel) -> ChannelTrack:
    """Return a temperature as conditions without a name of their own are kept: as found, in °C."""
    celsius = np.asarray(CELSIUS.from_si(track.value))
    for index in np.flatnonzero((celsius < _TEMPERATURES.lowest) | (celsius > _TEMPERATURES.highest))[:1]:
        channels.cells.problems.append(
            Problem(
                track.places[index],
                f"channel {quoted(channel.name)} is not between {_TEMPERATURES.lowest:g} and "
                f"{_TEMPERATURES.highest:g} °C here; is its unit right?",
            )
        )
    return ChannelTrack(track.time, celsius, track.places)


def _ask_about_larger_unit(track: ChannelTrack, channel: Channel) -> Iterator[Problem]:
    """Ask where a machine would hardly have moved: the readings are millimetres then."""
    there = track.value[np.isfinite(track.value)]
    if there.size < 2:
        return
    span = float(np.ptp(there))
    if 0 < span < _HARDLY:
        in_file = MICROMETRE.from_si(span)
        yield Problem(
            channel.place,
            f"the readings of channel {quoted(channel.name)} span {in_file:.3g}: as micrometres that is "
            "hardly a drift; are they millimetres? Say 'units: {value: mm}' in the job, or "
            "'units: {value: um}' if they are not",
        )


def _interpolate_at(time: FloatArray, condition: ChannelTrack) -> FloatArray:
    """Return a condition at some times, linear between those at which it was logged; NaN beyond them."""
    there = np.isfinite(condition.value)
    if not there.any():
        return np.full(time.shape, np.nan)
    return np.interp(time, condition.time[there], condition.value[there], left=np.nan, right=np.nan)


def _list_asked(tests: tuple[str, ...]) -> Iterator[str]:
    """Yield what a file of channels leaves open."""
    yield "Over which hours is the drift stated? Say 'hours' beside the standard; without it all are taken."
    for letter in "XYZ":
        if {f"{letter}1", f"{letter}2"} <= set(tests):
            yield (
                f"How far are {letter}1 and {letter}2 apart (mm)? Say 'distance: {{{letter}: …}}' beside the "
                "standard; their tilt follows from it."
            )


@hookimpl
def zlmreport_sources() -> Iterable[DataSource]:
    """Return the reader of channels."""
    return [ChannelsCsv()]
