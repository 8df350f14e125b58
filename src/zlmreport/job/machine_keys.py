"""The keys of a coordinate measuring machine that is led over the network, by I++ DME."""

from __future__ import annotations

from pydantic import Field

from zlmreport.job.types import JobPart, Positive, Text

#: The TCP port of I++ DME.
STANDARD_PORT = 1294
#: Names that a server knows its tools by: they stand between quotes.
TOOL = r"^[A-Za-z0-9 ._-]{1,64}$"


class MachineKeys(JobPart):
    """A coordinate measuring machine on the network, for `zlmreport capture`."""

    host: Text = Field(description="Name or address of its server.", examples=["192.168.1.20"])
    port: int = Field(STANDARD_PORT, ge=1, le=65535, description="TCP port of its server.")
    tool: str | None = Field(
        None,
        pattern=TOOL,
        description="Name of the tool that the machine is to take. Without it, the one that it has.",
        examples=["RefTool"],
    )
    timeout: Positive = Field(120.0, description="How long a single command of the machine may take, s.")
