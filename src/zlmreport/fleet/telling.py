"""Telling people: news by mail, or by whatever apprise reaches; secrets come from the environment."""

from __future__ import annotations

import os
import smtplib
from collections.abc import Mapping
from email.message import EmailMessage

from zlmreport.job.notify import NotifyKeys

#: For which a server may be silent, s.
_PATIENCE = 30


class NotToldError(Exception):
    """Nobody took the news; why, in words."""


def tell(keys: NotifyKeys, title: str, text: str, environment: Mapping[str, str] = os.environ) -> None:
    """Send news.

    Parameters
    ----------
    keys
        To whom, and how.
    title, text
        The news.
    environment
        With the secrets.

    Raises
    ------
    NotToldError
        If nobody took it, or a secret is missing.
    """
    try:
        if keys.plugin == "mail":
            _mail(keys, title, text, environment)
        else:
            _apprise(keys, title, text, environment)
    except (OSError, smtplib.SMTPException, ImportError) as error:
        raise NotToldError(str(error) or type(error).__name__) from error


def _mail(keys: NotifyKeys, title: str, text: str, environment: Mapping[str, str]) -> None:
    message = EmailMessage()
    message["Subject"], message["From"], message["To"] = title, keys.sender, ", ".join(keys.receivers)
    message.set_content(text)
    opened = smtplib.SMTP_SSL if keys.security == "tls" else smtplib.SMTP
    with opened(keys.server, keys.port, timeout=_PATIENCE) as server:
        if keys.security == "starttls":
            server.starttls()
        if keys.user:
            server.login(keys.user, _secret(keys, environment))
        server.send_message(message)


def _apprise(keys: NotifyKeys, title: str, text: str, environment: Mapping[str, str]) -> None:
    from apprise import Apprise  # noqa: PLC0415 - an extra

    teller = Apprise()
    if not teller.add(_secret(keys, environment)):
        raise NotToldError(f"the environment variable {keys.secret} holds no address that apprise knows")
    if not teller.notify(body=text, title=title):
        raise NotToldError(f"nobody took it at the address in {keys.secret}")


def _secret(keys: NotifyKeys, environment: Mapping[str, str]) -> str:
    if keys.secret not in environment:
        raise NotToldError(f"the environment variable {keys.secret} is not set")
    return environment[keys.secret]
