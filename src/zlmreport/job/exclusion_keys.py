"""The keys of readings that are set aside: which, and why."""

from __future__ import annotations

from typing import Annotated, Any, Literal

from pydantic import BeforeValidator, Field

from zlmreport.job.part import JobPart
from zlmreport.job.types import Finite, Text

_SPELLINGS = {"up": "+", "↑": "+", "1": "+", "down": "-", "↓": "-", "-1": "-", "−": "-"}


def _sign(value: Any) -> Any:
    return _SPELLINGS.get(str(value).strip().lower(), value)


class ExclusionKeys(JobPart):
    """A reading that is set aside, as if it had not been taken; the document names it with the reason."""

    target: Finite = Field(description="Its target position, mm or degrees.", examples=[213.4])
    direction: Annotated[Literal["+", "-"], BeforeValidator(_sign)] = Field(
        description="Direction of approach: + or -, in quotes.", examples=["+"]
    )
    run: int = Field(ge=1, description="Number of its run, from 1.", examples=[3])
    reason: Text = Field(
        description="Why, as the document states it.", examples=["Air hose touched the reflector."]
    )
