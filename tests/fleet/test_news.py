"""People are told each event once, whatever becomes of the nights."""

from __future__ import annotations

import random
import shutil
import socket
import threading
from collections import Counter
from collections.abc import Iterable
from dataclasses import dataclass, field
from pathlib import Path

import pytest

from fleet.fleets import FLEET, Fleet, Witness, without_processes
from zlmreport.errors import InputError
from zlmreport.fleet import issuing, night
from zlmreport.fleet.issuing import Happened, What
from zlmreport.fleet.ledger import Ledger
from zlmreport.fleet.night import MissingError
from zlmreport.fleet.records import About
from zlmreport.fleet.telling import NotToldError, tell
from zlmreport.job.fleet import load_fleet
from zlmreport.job.notify import NotifyKeys

NOTIFY = "notify: [{plugin: mail, to: [a@example.com, b@example.com]}]\n"


class Post:
    """Takes the news, or refuses it."""

    def __init__(self) -> None:
        self.letters: list[tuple[str, str]] = []
        self.is_shut = False

    def __call__(self, _keys: NotifyKeys, title: str, text: str) -> None:
        if self.is_shut:
            raise NotToldError("the server is shut")
        self.letters.append((title, text))

    @property
    def lines(self) -> Counter[str]:
        """Return how often each line was told."""
        return Counter(
            line for _, text in self.letters for line in text.splitlines() if line.startswith("- ")
        )


@pytest.fixture
def post(monkeypatch: pytest.MonkeyPatch) -> Post:
    post = Post()
    monkeypatch.setattr(night, "tell", post)
    return post


@pytest.fixture
def fleet(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, post: Post) -> Fleet:  # noqa: ARG001
    without_processes(monkeypatch)
    on_a_day(1, monkeypatch)
    fleet = Fleet.of(tmp_path, "x", "y")
    fleet.write("fleet.yaml", FLEET + NOTIFY)
    return fleet


def on_a_day(day: int, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(night, "_now", lambda: f"2026-12-{day:02}T02:00:00+00:00")


def test_a_calm_night_tells_nobody_anything(fleet: Fleet, post: Post) -> None:
    fleet.spend()
    assert post.letters == []


def test_a_failure_is_told_once_and_again_when_it_comes_back(fleet: Fleet, post: Post) -> None:
    for readings in ("1 2", "1 2", "1 2 3 -1 -2 -3", "1 2"):
        fleet.readings("x", readings)
        fleet.spend()
    assert [title for title, _ in post.letters] == ["Hall North: 1 failed"] * 2
    assert "jobs/x.yaml: " in post.letters[0][1]


def test_what_could_not_be_told_is_told_by_the_next_night(fleet: Fleet, post: Post) -> None:
    post.is_shut = True
    fleet.readings("x", "1 2")
    assert [each.about for each in fleet.spend().notices] == [About.UNTOLD]
    post.is_shut = False
    fleet.spend()
    assert [title for title, _ in post.letters] == ["Hall North: 1 failed"]


def test_a_folder_that_is_gone_is_told_though_nothing_is_done(fleet: Fleet, post: Post) -> None:
    fleet.spend()
    (fleet.folder / "certificates").rename(fleet.folder / "elsewhere")
    for _ in range(2):
        with pytest.raises(MissingError):
            fleet.spend()
    assert [title for title, _ in post.letters] == ["Hall North: 1 the whole night"]


def test_a_mail_without_a_receiver_and_a_password_in_the_open_are_refused(fleet: Fleet) -> None:
    fleet.write(
        "fleet.yaml", FLEET + "notify: [{plugin: mail}, {plugin: mail, to: a@example.com, user: me}]\n"
    )
    with pytest.raises(InputError) as raised:
        load_fleet(fleet.folder / "fleet.yaml")
    assert "a mail needs somebody who gets it" in str(raised.value)
    assert "a password is not sent in the open" in str(raised.value)


def test_a_mail_reaches_a_server() -> None:
    taken: list[str] = []
    with socket.create_server(("127.0.0.1", 0)) as server:
        thread = threading.Thread(target=_serve, args=(server, taken), daemon=True)
        thread.start()
        keys = NotifyKeys(plugin="mail", to="a@example.com", server="127.0.0.1", port=server.getsockname()[1])
        tell(keys, "Hall North: 1 failed", "- x: µm\n")
        thread.join(timeout=10)
    text = "\n".join(taken)
    assert "RCPT TO:<a@example.com>" in text.replace("rcpt", "RCPT").replace("to:", "TO:", 1)
    assert "Subject: Hall North: 1 failed" in text


def _serve(server: socket.socket, taken: list[str]) -> None:
    """Speak as much SMTP as a mail needs (RFC 5321)."""
    connection, _ = server.accept()
    with connection, connection.makefile("rb") as lines:
        connection.sendall(b"220 ready\r\n")
        is_content = False
        for line in lines:
            taken.append(line.decode().rstrip())
            if is_content and taken[-1] != ".":
                continue
            word = taken[-1][:4].upper()
            is_content = word == "DATA"
            answer = {"DATA": b"354 go on\r\n", "QUIT": b"221 bye\r\n"}.get(word, b"250 yes\r\n")
            connection.sendall(answer)
            if word == "QUIT":
                return


def test_nobody_there_and_no_secret_are_named() -> None:
    with socket.create_server(("127.0.0.1", 0)) as server:
        port = server.getsockname()[1]
    with pytest.raises(NotToldError, match="refused"):
        tell(NotifyKeys(plugin="mail", to="a@example.com", server="127.0.0.1", port=port), "", "")
    keys = NotifyKeys(plugin="mail", to="a", server="127.0.0.1", port=port, user="me", security="tls")
    with pytest.raises(NotToldError):
        tell(keys, "", "", {})


AXES = 6
#: What goes wrong, by day.
TROUBLES = {5: "kill", 8: "mount", 11: "clock", 14: "lost", 16: "found", 19: "kill", 22: "disk"}
#: Of which every one is told once; a night that was killed is made good, and a full disk fails each new job.
TOLD = {"folder": 1, "clock": 1, "lost": 1, "step": 1, "drift": 1, "disk": AXES}


class KilledError(Exception):
    """A night ends anywhere."""


class Deadly(Witness):
    """Kills a night at its first job."""

    def happened(self, happened: Happened) -> None:
        Witness.happened(self, happened)
        if happened.what is not What.UNCHANGED:
            raise KilledError


@dataclass(slots=True)
class Month:
    """A fleet with its tests and what goes wrong."""

    fleet: Fleet
    rng: random.Random
    measured: list[int] = field(default_factory=lambda: [0] * AXES)

    def measure(self, axes: Iterable[int]) -> None:
        """Write the job of a test; axis 4 steps by half its limit, axis 5 drifts."""
        for axis in axes:
            self.measured[axis] += 1
            number = self.measured[axis]
            value = 6 + self.rng.uniform(-0.3, 0.3)
            value += 10 if axis == 4 and number >= 7 else 1.2 * number if axis == 5 else 0
            changes = (("name: X", f"name: A{axis}"), ("2026-11-18", f"2025-{number:02}-15"))
            self.fleet.job(f"a{axis}t{number}", *changes, readings=f"0 1 {min(value, 19.5):.3f} 0 1 2")

    def spend(self, trouble: str, monkeypatch: pytest.MonkeyPatch) -> None:
        """Spend a night with what goes wrong in it."""
        folder = self.fleet.folder
        if trouble == "mount":
            (folder / "certificates").rename(folder / "elsewhere")
            with pytest.raises(MissingError):
                self.fleet.spend()
            (folder / "elsewhere").rename(folder / "certificates")
        elif trouble == "lost":
            shutil.move(folder / "jobs/a2t1.yaml", folder / "lost.yaml")
        elif trouble == "found":
            shutil.move(folder / "lost.yaml", folder / "jobs/a2t1.yaml")
        elif trouble == "clock":
            on_a_day(2, monkeypatch)
        elif trouble == "disk":
            monkeypatch.setattr(issuing, "laid", full)
        if trouble == "kill":
            self.measure([0, 1])
            with pytest.raises(KilledError):
                night.spend(self.fleet.file, night.Order(), Deadly())
        else:
            self.fleet.spend()


@pytest.mark.parametrize("seed", [1, 2])
def test_a_month_of_nights_ends_with_every_document_right_and_every_event_told_once(
    seed: int, fleet: Fleet, post: Post, monkeypatch: pytest.MonkeyPatch
) -> None:
    for stem in "xy":
        (fleet.folder / f"jobs/{stem}.yaml").unlink()
    month = Month(fleet, random.Random(seed))
    written: dict[str, bytes] = {}
    for day in range(1, 31):
        on_a_day(day, monkeypatch)
        month.measure(range(AXES) if day % 3 == 1 else ())
        with monkeypatch.context() as patched:
            month.spend(TROUBLES.get(day, ""), patched)
        for path in (fleet.folder / "certificates").rglob("*.txt"):
            content = path.read_bytes()
            assert written.setdefault(path.name, content) == content
    numbers = {f"CAL-A{axis}T{one}" for axis in range(AXES) for one in range(1, month.measured[axis] + 1)}
    assert fleet.files() == {f"{number}.txt" for number in numbers}
    with Ledger.open(fleet.file.ledger, "Hall North") as ledger:
        assert set(ledger.certificates()) == numbers
    assert set(post.lines.values()) == {1}
    assert Counter(map(kind_of, post.lines)) == TOLD


def full(*_: object) -> None:
    raise OSError(28, "No space left on device")


def kind_of(line: str) -> str:
    words = {
        "the folder is empty": "folder",
        "the clock stands": "clock",
        "the job is gone": "lost",
        "No space": "disk",
        " a year": "drift",
        " since ": "step",
    }
    return next((kind for word, kind in words.items() if word in line), line)
