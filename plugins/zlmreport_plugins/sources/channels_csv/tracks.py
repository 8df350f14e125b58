"""Reads the channels of a table with their times, in either layout, and averages what was read often.

Long: a row is one reading of one channel. Wide: a row is one moment, and each channel has a column.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field, replace

import numpy as np

from zlmreport.plugin import FloatArray, InputError, Place, Problem, ReadingScale, Unit, quoted, unit_named
from zlmreport.plugin.source import Averaging, SourceContext
from zlmreport.plugin.table import (
    Cells,
    ReadTime,
    TextColumn,
    TextRow,
    TextTable,
    column_with_unit,
    find_heading,
    folded,
    heading_of,
    missing_column,
    moment,
    read_headings,
    time_reader,
)
from zlmreport_plugins.sources.channels_csv.options import (
    CHANNEL,
    DATE,
    TIME,
    TIMES,
    VALUE,
    ChannelsCsvOptions,
)

#: A time of day without a date stands for a moment before.
_ANY_YEAR = 1950


@dataclass(frozen=True, slots=True)
class Moment:
    """Where a reading of a channel stands, and when it was taken."""

    row: TextRow
    index: int  #: Of the column that holds the reading.
    time: float  #: s, from any fixed moment.


@dataclass(frozen=True, slots=True)
class Channel:
    """Where the readings of one channel stand."""

    name: str  #: As the file writes it, without its unit.
    unit: str | None  #: What the file says of its unit; None where it says nothing.
    place: Place  #: Where it is named first.
    moments: list[Moment] = field(default_factory=list)


@dataclass(frozen=True, slots=True)
class ChannelTrack:
    """Readings of one channel in the order of time."""

    time: FloatArray  #: (N,): s from the beginning of the test, rising.
    value: FloatArray  #: (N,): In its unit's SI; NaN where missing.
    places: tuple[Place, ...]  #: Where each stands.


@dataclass(frozen=True, slots=True)
class Channels:
    """The channels of a table by their folded names, and its time."""

    cells: Cells
    time: TextColumn
    of: Mapping[str, Channel]
    counted_from: float | None = None  #: s on the clock of the times; None for the first reading of the file.
    later_by: float = 0.0  #: How much later than the test that reading was, s.

    @property
    def table(self) -> TextTable:
        """The table that they stand in."""
        return self.cells.table

    def find(self, name: str) -> Channel | None:
        """Return a channel by its name, with or without its unit; None if there is none."""
        return self.of.get(folded(heading_of(name).name)) or self.of.get(folded(name))

    @property
    def _first(self) -> float:
        """The first time of all channels, s."""
        return min((each.time for channel in self.of.values() for each in channel.moments), default=0.0)

    @property
    def begins(self) -> float:
        """When the test began, s on the clock of the times."""
        return self._first - self.later_by if self.counted_from is None else self.counted_from

    @property
    def lasts(self) -> float:
        """From the first time of all channels to the last, s."""
        last = max((each.time for channel in self.of.values() for each in channel.moments), default=0.0)
        return last - self._first

    @property
    def most_readings(self) -> int:
        """How often the channel was read that was read most often."""
        return max((len(channel.moments) for channel in self.of.values()), default=0)

    def read_track(
        self, channel: Channel, unit: Unit | ReadingScale, known: Mapping[str, Unit | ReadingScale]
    ) -> ChannelTrack:
        """Return the readings of a channel; what is wrong with one is noted."""
        begins = self.begins
        times: list[float] = []
        values: list[float] = []
        places: list[Place] = []
        for each in channel.moments:
            column = TextColumn(each.index, channel.name, channel.name, unit, known)
            value = self.cells.number(each.row, column)
            if value is None:
                continue
            time = each.time - begins
            if times and time <= times[-1]:
                said = _say_out_of_order(channel, places[-1], is_same=time == times[-1])
                self.cells.note(each.row, self.time, said)
                continue
            times.append(time)
            values.append(value)
            places.append(self.table.place(each.row, each.index))
        return ChannelTrack(np.array(times), np.array(values, dtype=np.float64), tuple(places))


def _say_out_of_order(channel: Channel, before: Place, *, is_same: bool) -> str:
    if is_same:
        return f"channel {quoted(channel.name)} has a reading of this time in line {before.line} already"
    return (
        f"the time is before that of the reading of channel {quoted(channel.name)} in line {before.line}; "
        "readings stand in the order in which they were taken"
    )


def add_dates(table: TextTable, options: ChannelsCsvOptions) -> TextTable:
    """Return a table whose times have their dates before them, where these stand in a column of their own."""
    among = read_headings(table, options)
    time, date = (find_heading(name, among, table, options) for name in (TIME, DATE))
    if time is None or date is None:
        return table

    def dated(row: TextRow) -> TextRow:
        cells = list(row.cells)
        if cells[date.index] and cells[time.index]:
            cells[time.index] = f"{cells[date.index]} {cells[time.index]}"
        return replace(row, cells=tuple(cells))

    return replace(table, rows=tuple(map(dated, table.rows)))


def read_channels_of(cells: Cells, options: ChannelsCsvOptions, context: SourceContext) -> Channels:
    """Return the channels of a table; raise `InputError` if it has no time, or no channel."""
    table = cells.table
    among = read_headings(table, options)
    heading = find_heading(TIME, among, table, options)
    if heading is None:
        raise InputError([missing_column(TIME, among, table, options)])
    time = column_with_unit(TIME, heading, options, TIMES, context.place, table)
    beginning = _find_counted_from(options, table, time, context.place), options.later_by or 0.0
    named, value, date = (find_heading(name, among, table, options) for name in (CHANNEL, VALUE, DATE))
    if named is not None and value is None:
        raise InputError([missing_column(VALUE, among, table, options)])
    if named is not None and value is not None:
        return Channels(cells, time, _from_rows(cells, time, named.index, value.index), *beginning)
    time_of = time_reader(cells, time)
    timed = [
        (row, moment) for row in table.rows if (moment := _read_moment(cells, time, row, time_of)) is not None
    ]
    columns = (each for each in among if each.index not in {heading.index, date and date.index})
    found = {
        folded(each.name): Channel(
            each.name,
            each.bracket,
            table.place(table.header, each.index),
            [Moment(row, each.index, moment) for row, moment in timed],
        )
        for each in columns
    }
    return Channels(cells, time, found, *beginning)


def _find_counted_from(
    options: ChannelsCsvOptions, table: TextTable, time: TextColumn, place: Place
) -> float | None:
    """Return the stated moment, s from the first time of a table; None without one."""
    if options.counted_from is None:
        return None
    first = next((row.cells[time.index] for row in table.rows if row.cells[time.index]), "")
    stated, found = moment(options.counted_from), moment(first)
    try:
        if stated is not None and found is not None and (stated.year < _ANY_YEAR) == (found.year < _ANY_YEAR):
            return (stated - found).total_seconds()
    except TypeError:  # one of them says its time zone
        pass
    raise InputError.at(
        place,
        f"counted_from: {quoted(options.counted_from)} is no moment like the times of the file, "
        f"{quoted(first)}; write it as they are, or say 'later_by: 90' (s)",
    )


def _read_moment(cells: Cells, column: TextColumn, row: TextRow, time_of: ReadTime) -> float | None:
    """Return the time of a row, s; None if there is none, which is noted."""
    time = time_of(row)
    if time is not None and math.isnan(time):
        cells.note(row, column, "there is no time; only a reading may be missing")
        return None
    return time


def _from_rows(cells: Cells, time: TextColumn, named: int, value: int) -> dict[str, Channel]:
    """Return the channels of a long table, which names one in each row.

    Each has a reader of times of its own: where one channel stands below the other, a clock begins anew.
    """
    found: dict[str, Channel] = {}
    readers: dict[str, ReadTime] = {}
    column = TextColumn(named, CHANNEL, CHANNEL, None)
    for row in cells.table.rows:
        text = row.cells[named]
        if not text:
            cells.note(row, column, "there is no channel; only a reading may be missing")
            continue
        heading = heading_of(text)
        channel = found.setdefault(
            folded(heading.name), Channel(heading.name, heading.bracket, cells.table.place(row, named))
        )
        if heading.bracket != channel.unit:
            cells.note(
                row,
                column,
                f"channel {quoted(channel.name)} is in {heading.bracket or 'no unit'} here, and in "
                f"{channel.unit or 'no unit'} in line {channel.place.line}",
            )
            continue
        time_of = readers.setdefault(channel.name, time_reader(cells, time))
        moment = _read_moment(cells, time, row, time_of)
        if moment is not None:
            channel.moments.append(Moment(row, value, moment))
    return found


def find_unit_of(
    channel: Channel, stated: str | None, known: Mapping[str, Unit | ReadingScale], usual: Unit | ReadingScale
) -> Unit | ReadingScale:
    """Return the unit of a channel: the job's, else the file's, else the usual one.

    Raises `InputError` if the file's is none of its quantity.
    """
    spelling = stated or channel.unit
    if spelling is None:
        return usual
    try:
        return unit_named(spelling, known)
    except ValueError as error:
        raise InputError([Problem(channel.place, f"channel {quoted(channel.name)}: {error}")]) from error


#: Readings of a channel that are kept as they are.
MOST_KEPT = 1440
#: Intervals, s, of which the shortest is taken that leaves no more averages than that.
_INTERVALS = (1, 2, 5, 10, 15, 20, 30, 60, 120, 300, 600, 900, 1800, 3600)


def choose_interval_for(readings: int, duration: float) -> float | None:
    """Return over which intervals readings of a channel are averaged, s; None if they are kept.

    `readings`: Of the channel that was read most often.
    `duration`: From the first reading of all channels to the last, s.
    """
    if readings <= MOST_KEPT:
        return None
    enough = (float(each) for each in _INTERVALS if duration / each <= MOST_KEPT)
    return next(enough, duration / MOST_KEPT)


def average_channel(track: ChannelTrack, interval: float) -> tuple[ChannelTrack, Averaging]:
    """Return the averages of a channel at the middles of intervals, and what they leave out.

    An interval in which there is no reading has none; one in which all are missing has one that is missing.
    """
    slot = np.floor(track.time / interval + 1e-9).astype(np.int64)
    slots, first, which = np.unique(slot, return_index=True, return_inverse=True)
    there = np.isfinite(track.value)
    total = np.bincount(which, weights=np.where(there, track.value, 0.0), minlength=len(slots))
    count = np.bincount(which[there], minlength=len(slots))
    mean = np.full(len(slots), np.nan)
    np.divide(total, count, out=mean, where=count > 0)
    left = (track.value - mean[which])[there]
    left_out = float(np.sqrt(np.mean(left**2))) if left.size else 0.0
    places = tuple(track.places[index] for index in first.tolist())
    return ChannelTrack(np.asarray((slots + 0.5) * interval, dtype=np.float64), mean, places), Averaging(
        len(track.time), left_out
    )
