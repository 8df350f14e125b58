"""What every part of a file of keys is."""

from __future__ import annotations

from pydantic import BaseModel, ConfigDict


class JobPart(BaseModel):
    """A part of a job: frozen, and closed to keys that it does not know."""

    model_config = ConfigDict(extra="forbid", frozen=True)
