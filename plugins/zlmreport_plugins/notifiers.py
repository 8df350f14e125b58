"""Sends news of a fleet, worded by `fleet/news.py`: mail by SMTP (server, sender, password), or apprise.

A password, or an address that holds one, comes from the environment and is in no file and no message.
"""

from __future__ import annotations

import datetime as dt
import os
import smtplib
import ssl
from collections.abc import Iterable
from email.message import EmailMessage
from typing import Any, Literal

from pydantic import Field, model_validator

from zlmreport.plugin import AccessError, Options, Place, TextLine, Words, hookimpl
from zlmreport.plugin.notifier import Message, Notifier

#: For which a server may be silent, s.
_PATIENCE = 30


class MailOptions(Options):
    """The keys of ``mail``."""

    to: list[TextLine] | TextLine = Field(
        description="Who gets the mail.", examples=["calibration@example.com"]
    )
    sender: TextLine = Field("zlmreport@localhost", description="Who the mail is from.")
    server: TextLine = Field("localhost", description="The SMTP server.")
    port: int = Field(25, ge=1, le=65535, description="Its port.")
    security: Literal["none", "starttls", "tls"] = Field(
        "none", description="How the line to it is secured; its certificate must be one that is trusted here."
    )
    user: TextLine | None = Field(None, description="Name at the server, where it asks for one.")
    secret: TextLine = Field(
        "ZLMREPORT_NOTIFY",
        description="The environment variable with the password.",
        examples=["MAIL_PASSWORD"],
    )

    @model_validator(mode="after")
    def _refuse_open_password(self) -> MailOptions:
        if self.user and self.security == "none":
            raise ValueError("a password is not sent in the open; write security: starttls, or tls")
        return self


class Mail:
    """A mail by SMTP (RFC 5321)."""

    identifier = "mail"
    title = Words("Mail")
    options: type[Options] = MailOptions

    def receiver(self, options: MailOptions) -> str:
        """Return the addresses."""
        return options.to if isinstance(options.to, str) else ", ".join(options.to)

    def tell(self, message: Message, options: MailOptions) -> None:
        """Hand the mail to the server."""
        mail = EmailMessage()
        mail["Subject"], mail["From"], mail["To"] = message.title, options.sender, self.receiver(options)
        mail["Date"] = dt.datetime.now(dt.UTC)
        mail.set_content(message.text)
        try:
            with _open_line(options) as server:
                if options.security == "starttls":
                    server.starttls(context=ssl.create_default_context())
                if options.user:
                    server.login(options.user, _read_secret(options.secret))
                server.send_message(mail)
        except (OSError, smtplib.SMTPException) as error:
            where = Place(f"mail by {options.server}")
            said = error.strerror if isinstance(error, OSError) else None
            raise AccessError.at(where, said or str(error) or type(error).__name__) from error


def _open_line(options: MailOptions) -> smtplib.SMTP:
    """Return the line to the server; without a context the library takes any server's certificate."""
    if options.security == "tls":
        return smtplib.SMTP_SSL(
            options.server, options.port, timeout=_PATIENCE, context=ssl.create_default_context()
        )
    return smtplib.SMTP(options.server, options.port, timeout=_PATIENCE)


class AppriseOptions(Options):
    """The keys of ``apprise``."""

    secret: TextLine = Field(
        "ZLMREPORT_NOTIFY",
        description="The environment variable with the address, as apprise writes it.",
        examples=["CHAT"],
    )


class Apprise:
    """Any of the services that apprise knows, by the address that it has for each."""

    identifier = "apprise"
    title = Words("Any service that apprise knows")
    options: type[Options] = AppriseOptions

    def receiver(self, options: AppriseOptions) -> str:
        """Return the name of the variable: an address holds passwords."""
        return options.secret

    def tell(self, message: Message, options: AppriseOptions) -> None:
        """Hand the message to apprise."""
        where = Place("apprise")
        try:
            from apprise import Apprise as Sender  # noqa: PLC0415 - an extra
        except ImportError as error:
            raise AccessError.at(where, "is not installed: pip install 'zlmreport[notify]'") from error
        sender = Sender()
        if not sender.add(_read_secret(options.secret)):
            raise AccessError.at(where, f"{options.secret} holds no address that it knows")
        if not sender.notify(body=message.text, title=message.title):
            raise AccessError.at(where, f"nobody took it at the address in {options.secret}")


def _read_secret(variable: str) -> str:
    if not os.environ.get(variable):
        raise AccessError.at(Place("environment"), f"the variable {variable} is not set")
    return os.environ[variable]


@hookimpl
def zlmreport_notifiers() -> Iterable[Notifier]:
    """Return the notifiers of this plugin."""
    found: list[Any] = [Mail(), Apprise()]
    return found
