"""The job keys of a data source that is captured live."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field

from zlmreport.job.types import Finite, JobPath, LiveInstrumentKeys, Options, Positive


class CaptureOptions(Options):
    """The instrument, the journal, and when a reading is taken."""

    journal: JobPath = Field(
        description="Journal of the readings, relative to the file that names it; the command capture "
        "writes it.",
        examples=["x-axis.journal"],
    )
    instrument: LiveInstrumentKeys | None = Field(
        None,
        description="The live instrument, with its own keys. A journal that is finished needs none.",
        examples=[{"plugin": "umd1", "port": "/dev/ttyACM0"}],
    )
    datum: Literal["start", "instrument"] | Finite = Field(
        "start",
        description="Where the axis stands when capture begins, mm or degrees: the reading there is taken "
        "for this position. 'start' is the start of the path, before the first target; 'instrument' takes "
        "readings as they are, for a display whose zero is that of the axis.",
        examples=[0],
    )
    tolerance: Positive | None = Field(
        None,
        description="How far from a target a reading may be, mm or degrees, at most 0.4 of the smallest "
        "interval and a third of plan.overrun. Without it these, or 1 if that is less.",
        examples=[0.5],
    )
    stability: Positive = Field(
        1.0,
        description="Range of readings, largest - smallest, within which the axis stands still, micrometres "
        "(arc seconds).",
        examples=[2],
    )
    dwell: Annotated[float, Field(gt=0, le=600)] = Field(
        1.0,
        description="How long the axis must stand still, s; the reading is the mean over this time. The axis "
        "rests longer (measurement.dwell): twice as long and a second is good.",
    )
