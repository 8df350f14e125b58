"""The door of live instruments, and of emulated ones: ports, dialogues, readings."""

from __future__ import annotations

from zlmreport.live.capture.events import (
    BeamHeld,
    Closed as DatumClosed,
    Commented as OperatorCommented,
    DatumHolds,
    DatumMoved,
    DatumTaken,
    Ended as CaptureEnded,
    Presumed as VisitPresumed,
    Recorded as ReadingRecorded,
    Resumed as CaptureResumed,
    Retake as OperatorRetake,
    ScaleChanged,
    Skipped as OperatorSkipped,
    ZeroLost,
)
from zlmreport.live.capture.journal import (
    History as JournalHistory,
    JournalEntry,
    read_history as read_journal,
)
from zlmreport.live.capture.of_job import (
    CaptureOptions,
)
from zlmreport.live.capture.records import (
    Header as JournalHeader,
)
from zlmreport.live.emulation.emulator import (
    Emulator,
    Scene,
)
from zlmreport.live.emulation.troubles import (
    Trouble,
)
from zlmreport.live.ports.clock import (
    SampleClock,
)
from zlmreport.live.ports.dialogue import (
    Lines as WholeLines,
    Patience,
    WrongDeviceError,
    ask as ask_instrument,
    ask_at_rate as readings_at_rate,
    make_unreadable as unreadable_reading,
    stream as streamed_readings,
)
from zlmreport.live.ports.port import (
    Framing,
    LiveConnection,
    PolledOptions,
    Port,
    PortOptions,
)
from zlmreport.live.ports.reading import (
    NO_CONDITIONS,
    NO_FAULT,
    Fault,
    LiveReading,
)
from zlmreport.measurement.refractive_index import (
    STANDARD_HUMIDITY,
    STANDARD_PRESSURE,
    index_change,
    refractive_index,
)
from zlmreport.plugin.protocols import (
    Connection,
    Instrument,
)

__all__ = [
    "NO_CONDITIONS",
    "NO_FAULT",
    "STANDARD_HUMIDITY",
    "STANDARD_PRESSURE",
    "BeamHeld",
    "CaptureEnded",
    "CaptureOptions",
    "CaptureResumed",
    "Connection",
    "DatumClosed",
    "DatumHolds",
    "DatumMoved",
    "DatumTaken",
    "Emulator",
    "Fault",
    "Framing",
    "Instrument",
    "JournalEntry",
    "JournalHeader",
    "JournalHistory",
    "LiveConnection",
    "LiveReading",
    "OperatorCommented",
    "OperatorRetake",
    "OperatorSkipped",
    "Patience",
    "PolledOptions",
    "Port",
    "PortOptions",
    "ReadingRecorded",
    "SampleClock",
    "ScaleChanged",
    "Scene",
    "Trouble",
    "VisitPresumed",
    "WholeLines",
    "WrongDeviceError",
    "ZeroLost",
    "ask_instrument",
    "index_change",
    "read_journal",
    "readings_at_rate",
    "refractive_index",
    "streamed_readings",
    "unreadable_reading",
]
