"""A password is handed to no server that cannot prove its name."""

from __future__ import annotations

import datetime as dt
import socket
import ssl
import threading
from collections.abc import Iterator
from email.message import EmailMessage
from pathlib import Path
from typing import Self

import pytest
from cryptography.hazmat.primitives.serialization import Encoding, NoEncryption, PrivateFormat

from document.signing.keys import certificate_of, elliptic
from installed import registry
from processes import PATIENCE
from zlmreport.plugin import AccessError
from zlmreport.plugin.kinds import NOTIFIER
from zlmreport.plugin.notifier import Message, Occasion


@pytest.fixture
def port_of_a_stranger(tmp_path: Path) -> Iterator[int]:
    """Return the port of a server with a certificate that nobody vouches for; it takes one line."""
    file = tmp_path / "stranger.pem"
    key = elliptic().private_bytes(Encoding.PEM, PrivateFormat.PKCS8, NoEncryption())
    file.write_bytes(key + certificate_of(elliptic()).public_bytes(Encoding.PEM))
    context = ssl.SSLContext(ssl.PROTOCOL_TLS_SERVER)
    context.load_cert_chain(file)
    said: list[bytes] = []

    def serve() -> None:
        line, _ = listener.accept()
        line.settimeout(PATIENCE)
        try:
            with context.wrap_socket(line, server_side=True) as secured:
                secured.sendall(b"220 mail\r\n")
                said.append(secured.recv(1000))
        except OSError:
            line.close()

    with socket.create_server(("127.0.0.1", 0)) as listener:
        listener.settimeout(PATIENCE)
        thread = threading.Thread(target=serve, daemon=True)
        thread.start()
        yield listener.getsockname()[1]
        thread.join(PATIENCE)
    assert said == []


def test_a_server_with_a_certificate_of_its_own_gets_nothing(
    port_of_a_stranger: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("ZLMREPORT_NOTIFY", "password")
    mail = registry().find(NOTIFIER, "mail")
    options = mail.options.model_validate(
        {"to": "a@b.c", "server": "127.0.0.1", "port": port_of_a_stranger, "security": "tls", "user": "fleet"}
    )
    with pytest.raises(AccessError, match="certificate verify failed"):
        mail.tell(Message(Occasion.DIGEST, "Hall North: 1 failed", "x\n"), options)


def test_a_mail_has_the_moment_in_which_it_was_sent(monkeypatch: pytest.MonkeyPatch) -> None:
    sent: list[EmailMessage] = []

    class Server:
        def __enter__(self) -> Self:
            return self

        def __exit__(self, *_: object) -> None: ...

        def send_message(self, mail: EmailMessage) -> None:
            sent.append(mail)

    monkeypatch.setattr("zlmreport_plugins.notifiers._open_line", lambda _: Server())
    before = dt.datetime.now(dt.UTC).replace(microsecond=0)
    mail = registry().find(NOTIFIER, "mail")
    mail.tell(
        Message(Occasion.DIGEST, "Hall North: 1 failed", "x\n"), mail.options.model_validate({"to": "a@b.c"})
    )
    assert before <= sent[0]["Date"].datetime <= dt.datetime.now(dt.UTC)


def test_a_server_that_is_not_there_is_told_in_words() -> None:
    with socket.create_server(("127.0.0.1", 0)) as listener:
        port = listener.getsockname()[1]
    mail = registry().find(NOTIFIER, "mail")
    options = mail.options.model_validate({"to": "a@b.c", "server": "127.0.0.1", "port": port})
    with pytest.raises(AccessError, match=r"^mail by 127\.0\.0\.1: Connection refused$"):
        mail.tell(Message(Occasion.DIGEST, "Hall North: 1 failed", "x\n"), options)
