"""The built-in notifiers do what the kit asks, against servers on this machine."""

from __future__ import annotations

import email
import email.policy
import json
import socket
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from http.server import BaseHTTPRequestHandler, HTTPServer

import pytest

from installed import registry
from processes import PATIENCE
from zlmreport.plugin import AccessError
from zlmreport.plugin.kinds import NOTIFIER
from zlmreport.plugin.protocols import Notifier
from zlmreport.testing import NOTIFIER_CHECKS, NotifierTrial
from zlmreport.testing.notifiers import SAMPLE

APPRISE, MAIL = (registry().find(NOTIFIER, each) for each in ("apprise", "mail"))
SECRET = "swordfish"
pytestmark = pytest.mark.filterwarnings("ignore:'imghdr':DeprecationWarning")  # which apprise imports


def closed_port() -> int:
    with socket.create_server(("127.0.0.1", 0)) as server:
        return int(server.getsockname()[1])


@contextmanager
def post_office() -> Iterator[tuple[int, list[str]]]:
    """Yield the port of a server that takes mails, and the mails that it took."""
    taken: list[str] = []
    with socket.create_server(("127.0.0.1", 0)) as server:
        server.settimeout(PATIENCE)

        def serve() -> None:
            while True:
                try:
                    connection, _ = server.accept()
                except OSError:
                    return
                _take(connection, taken)

        thread = threading.Thread(target=serve, daemon=True)
        thread.start()
        yield server.getsockname()[1], taken
        server.shutdown(socket.SHUT_RDWR)
        thread.join(10)


def _take(connection: socket.socket, taken: list[str]) -> None:
    """Speak as much SMTP as a mail needs (RFC 5321); what is said to be taken is there by then."""
    content: list[bytes] = []
    with connection, connection.makefile("rb") as lines:
        connection.sendall(b"220 ready\r\n")
        is_content = False
        for line in lines:
            if is_content and line != b".\r\n":
                content.append(line.removeprefix(b".") if line.startswith(b"..") else line)
                continue
            if is_content and (mail := _as_read(content)):
                taken.append(mail)
            word = line[:4].upper()
            is_content = word == b"DATA"
            connection.sendall({b"DATA": b"354 go on\r\n", b"QUIT": b"221 bye\r\n"}.get(word, b"250 yes\r\n"))
            if word == b"QUIT":
                break


def _as_read(content: list[bytes]) -> str:
    """Return a mail as Ada sees it; nothing of what is for somebody else."""
    mail = email.message_from_bytes(b"".join(content), policy=email.policy.default)
    if "ada@" not in str(mail["To"]):
        return ""
    body = mail.get_body()
    assert body is not None
    return f"{mail['Subject']}\n{body.get_content()}"


@contextmanager
def mail_trial(_: pytest.MonkeyPatch) -> Iterator[tuple[Notifier, NotifierTrial]]:
    keys = {"to": "ada@example.com", "server": "127.0.0.1"}
    with post_office() as (port, taken):
        to_nobody = {**keys, "port": closed_port()}
        to_another = {**keys, "to": "bob@example.com", "port": port}
        yield (
            MAIL,
            NotifierTrial({**keys, "port": port}, lambda: "".join(taken), to_nobody, to_another=to_another),
        )


@contextmanager
def apprise_trial(monkeypatch: pytest.MonkeyPatch) -> Iterator[tuple[Notifier, NotifierTrial]]:
    taken: list[str] = []

    class Chat(BaseHTTPRequestHandler):
        def do_POST(self) -> None:
            sent = json.loads(self.rfile.read(int(self.headers["Content-Length"])))
            if "other" not in self.path:
                taken.append(f"{sent['title']}\n{sent['message']}\n")
            self.send_response(200)
            self.end_headers()

        def log_message(self, *_: object) -> None:
            pass

    with HTTPServer(("127.0.0.1", 0), Chat) as server:
        threading.Thread(target=server.serve_forever, daemon=True).start()
        monkeypatch.setenv("CHAT", f"json://me:{SECRET}@127.0.0.1:{server.server_port}")
        monkeypatch.setenv("OTHER", f"json://me:{SECRET}@127.0.0.1:{server.server_port}/other")
        monkeypatch.setenv("NOBODY", f"json://me:{SECRET}@127.0.0.1:{closed_port()}")
        yield (
            APPRISE,
            NotifierTrial(
                {"secret": "CHAT"},
                lambda: "".join(taken),
                {"secret": "NOBODY"},
                (SECRET,),
                {"secret": "OTHER"},
            ),
        )
        server.shutdown()


@pytest.mark.parametrize("trial", [mail_trial, apprise_trial])
@pytest.mark.parametrize("check", NOTIFIER_CHECKS)
def test_conforms(
    check: Callable[..., None], trial: Callable[..., object], monkeypatch: pytest.MonkeyPatch
) -> None:
    with trial(monkeypatch) as (notifier, where):  # type: ignore[attr-defined]
        check(notifier, where)


def test_both_are_found() -> None:
    assert registry().list_identifiers(NOTIFIER) == ("apprise", "mail")


def test_a_secret_that_is_not_there_is_named() -> None:
    for notifier, keys in (
        (APPRISE, {"secret": "NOT_SET"}),
        (MAIL, {"to": "ada", "server": "127.0.0.1", "user": "me", "secret": "NOT_SET", "security": "tls"}),
    ):
        with pytest.raises(AccessError):
            notifier.tell(SAMPLE, notifier.options.model_validate(keys))


def test_an_address_that_apprise_does_not_know_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("CHAT", f"semaphore://{SECRET}")
    with pytest.raises(AccessError, match="CHAT holds no address that it knows") as raised:
        APPRISE.tell(SAMPLE, APPRISE.options.model_validate({"secret": "CHAT"}))
    assert SECRET not in str(raised.value)


def test_a_password_in_the_open_is_refused() -> None:
    with pytest.raises(ValueError, match="a password is not sent in the open"):
        MAIL.options.model_validate({"to": "ada", "user": "me"})
