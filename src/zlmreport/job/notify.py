"""Who is told the news of a fleet, and how: keys of the fleet file."""

from __future__ import annotations

from typing import Literal

from pydantic import Field, model_validator

from zlmreport.job.types import JobPart, Text


class NotifyKeys(JobPart):
    """One way to tell people; passwords and addresses with secrets come from the environment."""

    plugin: Literal["mail", "apprise"] = Field(
        description="A mail, or any of the services that apprise knows, where it is installed."
    )
    to: list[Text] | Text | None = Field(
        None, description="Who gets the mail.", examples=["calibration@example.com"]
    )
    sender: Text = Field("zlmreport@localhost", description="Who the mail is from.")
    server: Text = Field("localhost", description="The SMTP server.")
    port: int = Field(25, ge=1, le=65535, description="Its port.")
    security: Literal["none", "starttls", "tls"] = Field("none", description="How the line to it is secured.")
    user: Text | None = Field(None, description="Name at the server, where it asks for one.")
    secret: Text = Field(
        "ZLMREPORT_NOTIFY",
        description="The environment variable with the password of a mail, or the address of apprise.",
    )

    @property
    def receivers(self) -> tuple[str, ...]:
        """Who gets the mail, one by one."""
        return (self.to,) if isinstance(self.to, str) else tuple(self.to or ())

    @property
    def way(self) -> str:
        """What tells this way from others."""
        return f"{self.plugin} {', '.join(self.receivers) or self.secret}"

    @model_validator(mode="after")
    def _whole(self) -> NotifyKeys:
        """Refuse a mail to nobody, and a password in the open."""
        if self.plugin == "mail" and not self.receivers:
            raise ValueError("a mail needs somebody who gets it, such as to: calibration@example.com")
        if self.user and self.security == "none":
            raise ValueError("a password is not sent in the open; write security: starttls, or tls")
        return self
