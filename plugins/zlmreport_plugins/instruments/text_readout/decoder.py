"""The lines of a readout to readings."""

from __future__ import annotations

import re

from zlmreport.plugin import POSITION_UNITS, Fault, LiveReading, WholeLines, unit_named
from zlmreport_plugins.instruments.text_readout.options import TextReadoutOptions


class TextDecoder:
    """Understands one readout.

    Attributes
    ----------
    understood
        How many lines were readings, or said that there is none.
    """

    def __init__(self, options: TextReadoutOptions) -> None:
        self.understood = 0
        self._options = options
        self._pattern = re.compile(options.pattern)
        self._no_reading = [re.compile(each) for each in options.no_reading]
        self._unit = unit_named(options.unit, POSITION_UNITS)
        self._lines = WholeLines()

    def feed(self, data: bytes, now: float) -> list[LiveReading]:
        """Return the readings of the lines that these bytes complete."""
        return [self.reading(line, now) for line in self._lines.feed(data)]

    def reading(self, line: bytes, now: float) -> LiveReading:
        """Return what one line says."""
        text = line.decode("utf-8", "replace").strip()
        if any(pattern.search(text) for pattern in self._no_reading):
            self.understood += 1
            return LiveReading(
                float("nan"),
                now,
                Fault.DEVICE_ERROR | Fault.BEAM_LOST,
                message=f"the readout says {text[:40]!r}: clear it there, then begin the run again",
            )
        value = self._value(text)
        if value is None:
            return LiveReading(
                float("nan"),
                now,
                Fault.UNREADABLE,
                message=f"{text[:40]!r} is no reading by the pattern",
            )
        self.understood += 1
        return LiveReading(value * self._options.factor, now)

    def _value(self, text: str) -> float | None:
        """Return the value in a line, SI; None if it is no reading."""
        found = self._pattern.fullmatch(text)
        if found is None or found["value"] is None:
            return None
        groups = found.groupdict()
        try:
            number = float("".join(groups["value"].split()).replace(",", "."))
            unit = unit_named(groups["unit"], POSITION_UNITS) if groups.get("unit") else self._unit
        except ValueError:
            return None
        return unit.to_si(number)
