"""The job keys that every live instrument has."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import BeforeValidator, Field

from zlmreport.job.types import Options


def _port_is_named(value: object) -> object:
    if not value:
        raise ValueError("the name of a port is expected: /dev/ttyUSB0, COM3, socket://192.168.1.20:9090")
    return value


class PortOptions(Options):
    """Where an instrument is, and which way its readings count."""

    port: Annotated[str, BeforeValidator(_port_is_named)] = Field(
        description="Port, as pyserial names it: /dev/ttyUSB0, COM3, socket://192.168.1.20:9090."
    )
    sign: Literal["+", "-"] = Field(
        "+", description="'-' where the instrument counts down while the axis moves up."
    )
    scale: Annotated[float, Field(gt=0, allow_inf_nan=False)] = Field(
        1.0, description="Factor on every reading: 0.5 for optics that double the path."
    )
    timeout: Annotated[float, Field(gt=0, le=60)] = Field(
        2.0, description="How long the instrument may be silent, s, before it counts as gone."
    )

    @property
    def factor(self) -> float:
        """Scale and sign in one number."""
        return -self.scale if self.sign == "-" else self.scale


class PolledOptions(PortOptions):
    """The same of an instrument that answers questions."""

    rate: Annotated[float, Field(gt=0, le=1000)] = Field(
        10.0, description="How often the instrument is asked, 1/s; less often where it is slower."
    )
