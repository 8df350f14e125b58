"""People are told each event once, whatever becomes of the nights."""

from __future__ import annotations

import datetime as dt
import re
import threading
from collections import Counter
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest
from pydantic import Field

from fleet.exposition import parse
from fleet.fleets import FLEET, Fleet, Witness, without_processes
from fleet.histories import entry, history, parameter
from refusals import refused
from zlmreport.fleet import news, night
from zlmreport.fleet.ledger import Ledger
from zlmreport.fleet.news import find_news_of, write_digest
from zlmreport.fleet.night import MissingError
from zlmreport.fleet.plan import PlannedJob
from zlmreport.fleet.printing import Names, write_change
from zlmreport.fleet.records import About, LedgerEntry, NightNotice, PastNight, State
from zlmreport.fleet.state import Rules, describe_state
from zlmreport.plugin import (
    AccessError,
    DecimalSign,
    Language,
    Options,
    Place,
    Words,
    hookimpl,
    same_in_all_languages as same,
)
from zlmreport.plugin.notifier import Message, Occasion
from zlmreport.plugin.registry import Plugin, collect, find_plugins

NOTIFY = "notify: [{plugin: post, to: Ada}]\n"


class PostOptions(Options):
    to: str = Field(description="Who gets the letter.")


class Post:
    """Takes the news, or refuses it."""

    identifier = "post"
    title = Words(en="Letters", de="Briefe")
    options: type[Options] = PostOptions

    def __init__(self) -> None:
        self.messages: list[Message] = []
        self.is_shut = False

    def receiver(self, options: Any) -> str:
        return str(options.to)

    def tell(self, message: Message, _options: Any) -> None:
        if self.is_shut:
            raise AccessError.at(Place("post"), "the counter is shut")
        self.messages.append(message)

    @property
    def letters(self) -> list[tuple[str, str]]:
        return [(each.title, each.text) for each in self.messages]

    @property
    def lines(self) -> Counter[str]:
        """Return how often each line was told."""
        return Counter(
            line for _, text in self.letters for line in text.splitlines() if line.startswith("- ")
        )


def post_office(monkeypatch: pytest.MonkeyPatch) -> Post:
    """Let the only way to tell people be a post."""
    post = Post()

    @hookimpl
    def zlmreport_notifiers() -> Any:
        return [post]

    offered = [
        (Plugin("post", "post", "post", "1.0"), SimpleNamespace(zlmreport_notifiers=zlmreport_notifiers))
    ]
    monkeypatch.setattr(news, "find_plugins", lambda **_: collect(offered))
    return post


@pytest.fixture
def post(monkeypatch: pytest.MonkeyPatch) -> Post:
    return post_office(monkeypatch)


@pytest.fixture
def fleet(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, post: Post) -> Fleet:  # noqa: ARG001
    without_processes(monkeypatch)
    on_a_day(1, monkeypatch)
    fleet = Fleet.of(tmp_path, "x", "y")
    fleet.write("fleet.yaml", FLEET + NOTIFY)
    return fleet


def on_a_day(day: int, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(night, "read_clock", lambda: f"2026-12-{day:02}T02:00:00+00:00")


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


def test_that_nobody_was_reached_stands_in_the_ledger_until_somebody_is(fleet: Fleet, post: Post) -> None:
    post.is_shut = True
    fleet.readings("x", "1 2")
    noticed = []
    for is_shut in (True, True, False, False):
        post.is_shut = is_shut
        fleet.spend()
        noticed.append([each.about for each in last_of(fleet).notices])
    assert noticed == [[About.UNTOLD], [About.UNTOLD], [], []]
    assert len(post.letters) == 1


def last_of(fleet: Fleet) -> PastNight:
    with Ledger.open(fleet.file.ledger, "Hall North") as ledger:
        last = ledger.find_last_night()
    assert last is not None
    return last


def test_a_new_way_is_told_what_is_still_so_and_no_history(fleet: Fleet, post: Post) -> None:
    fleet.job("z", readings="1 2")
    for readings in ("1 2", "1 2 3 -1 -2 -3"):
        fleet.readings("x", readings)
        fleet.spend()
    post.messages.clear()
    fleet.write("fleet.yaml", FLEET + NOTIFY.replace("Ada", "Grace"))
    fleet.spend()
    ((_, text),) = post.letters
    assert "jobs/z" in text
    assert "jobs/x" not in text


def test_a_message_that_begins_with_its_job_names_it_once() -> None:
    failed = entry(dt.date(2026, 8, 1), job="z.yaml", state=State.FAILED, message="z.yaml: was stopped")
    (told,) = find_news_of(
        describe_state("Hall North", [failed], ["z.yaml"], None), Language.ENGLISH, Names(())
    )
    assert told.text == "z.yaml: was stopped"


def test_a_folder_that_is_gone_is_told_though_nothing_is_done(fleet: Fleet, post: Post) -> None:
    fleet.spend()
    (fleet.folder / "certificates").rename(fleet.folder / "elsewhere")
    for _ in range(2):
        with pytest.raises(MissingError):
            fleet.spend()
    assert [title for title, _ in post.letters] == ["Hall North: 1 notice"]


def test_a_wrong_way_is_refused_before_the_night(fleet: Fleet) -> None:
    fleet.write("fleet.yaml", FLEET + "notify:\n- {plugin: pots, to: x}\n- {plugin: post, too: x}\n")
    assert [(each.place.line, each.message.partition(";")[0]) for each in refused(fleet.spend).problems] == [
        (7, "no plugin provides notifier 'pots'"),
        (8, "notify.to is missing: who gets the letter"),
        (8, "unknown key 'too' in notify"),
    ]
    assert not fleet.files()


def test_a_certificate_and_a_failure_are_told_as_they_happen_and_a_failure_once(
    fleet: Fleet, post: Post
) -> None:
    fleet.write("fleet.yaml", FLEET + NOTIFY.replace("Ada", "Ada, tells: [certificate, failure]"))
    fleet.readings("x", "1 2")
    for _ in range(2):
        fleet.spend()
    failed, issued = sorted(post.messages, key=lambda each: each.occasion)[::-1]
    assert (failed.occasion, failed.title) == (Occasion.FAILURE, "Hall North: jobs/x.yaml failed")
    assert "jobs/x.txt" in failed.text
    assert (issued.occasion, issued.title) == (Occasion.CERTIFICATE, "Hall North: CAL-Y was issued")
    assert issued.files == (fleet.certificate("y"),)


def test_who_gets_a_certificate_is_told_what_its_readings_leave_doubtful(fleet: Fleet, post: Post) -> None:
    fleet.write("fleet.yaml", FLEET + NOTIFY.replace("Ada", "Ada, tells: [certificate]"))
    fleet.readings("y", "0.001 0.002 0.003 0.004 0.005 0.006")
    (doubt,) = fleet.spend().of("y").doubts
    said = doubt.in_language(Language.ENGLISH)
    assert said.startswith("All deviations together span 0.005 µm over 200 mm; if the file has mm")
    (issued,) = (each for each in post.messages if "CAL-Y" in each.title)
    assert said in issued.text.splitlines()


def test_a_way_that_is_shut_is_tried_once_a_night(fleet: Fleet, post: Post) -> None:
    fleet.write("fleet.yaml", FLEET + NOTIFY.replace("Ada", "Ada, tells: [certificate, digest]"))
    post.is_shut = True
    assert [each.about for each in fleet.spend().notices] == [About.UNTOLD]


def test_a_way_that_hangs_does_not_stop_the_night(
    fleet: Fleet, post: Post, monkeypatch: pytest.MonkeyPatch
) -> None:
    released = threading.Event()
    monkeypatch.setattr(news, "PATIENCE", 0.05)
    monkeypatch.setattr(post, "tell", lambda *_: released.wait(10))
    fleet.readings("x", "1 2")
    (notice,) = fleet.spend().notices
    released.set()
    assert notice.english == "the news was not sent by post Ada: it was not taken within 0.05 s"


#: The symbols and signs of the standards that are installed.
NAMES = Names(find_plugins().standards)
#: A parameter that rises from year to year.
RISING = (5.0, 6.0, 7.1, 8.0, 9.1, 10.0, 11.1)


def _write_morning(language: Language, hall: str, clock: str, further: Sequence[LedgerEntry] = ()) -> Message:
    """Return the message of a morning on which all is new: a clock, a limit, a step, a trend, terms."""
    entries = [*history([6.0, 6.2, 5.9, 6.1, 6.0, 6.1, 16.4]), *history(RISING, axis="Y"), *further]
    entries.append(entry(dt.date(2026, 8, 1), parameter(21.53, conforms=False), axis="Z", job="z.yaml"))
    last = PastNight(dt.datetime(2027, 9, 1, tzinfo=dt.UTC), None, (NightNotice(About.CLOCK, same(clock)),))
    state = describe_state(hall, entries, [], last, Rules(365))
    keys = SimpleNamespace(name=hall, keys=SimpleNamespace(language=language))
    return write_digest(keys, tuple(find_news_of(state, language, NAMES)))  # type: ignore[arg-type]


def test_news_is_in_the_language_of_the_fleet() -> None:
    message = _write_morning(Language.GERMAN, "Halle Nord", "die Uhr steht auf …")
    assert message.title == (
        "Halle Nord: 1 Hinweis, 1 Grenzwert nicht eingehalten, 1 verändert, 1 mit Drift, 3 überfällig"
    )
    machine = "Example Works MT 500, serial 1"
    for line in (
        "Zum ganzen Lauf\n- Uhr: die Uhr steht auf …",
        f"- {machine}, Z: A = 21,5 ± 1,0 µm, Grenzwert 20 µm",
        f"- {machine}, X: A + 10,4 µm seit 2026-07-15",
        f"- {machine}, Y: A + 4,1 µm im Jahr, Grenzwert erreicht 2028-",
        f"- {machine}, Z: gemessen am 2026-08-01, war bis 2027-08-01 erneut zu messen",
    ):
        assert line in message.text


def _tell(*entries: LedgerEntry) -> Message:
    state = describe_state("Hall North", entries, ["q.yaml", "r.yaml"], None)
    keys = SimpleNamespace(name="Hall North", keys=SimpleNamespace(language=Language.ENGLISH))
    return write_digest(keys, tuple(find_news_of(state, Language.ENGLISH, NAMES)))  # type: ignore[arg-type]


def test_a_value_that_exceeds_its_limit_is_told_to_the_digits_that_show_it() -> None:
    stated = parameter(20.04, symbol="A_fwd", expanded_uncertainty=0.02, conforms=False)
    told = _tell(entry(dt.date(2026, 8, 1), stated))
    assert "X: A↑ = 20.040 ± 0.020 µm, limit 20 µm" in told.text


def test_a_change_has_the_sign_that_the_standard_prints_and_is_never_zero() -> None:
    of_1988 = [
        replace(
            each,
            axis="Y",
            parameters=(replace(each.parameters[0], standard="iso230-2:1988", symbol="B_mean", limit=None),),
        )
        for each in history([0.01, 0.01, 0.01, 0.01, 0.01, 0.01, 7.01])
    ]
    assert "Y: B̄ − 7.0 µm since 2026-07-15" in _tell(*of_1988).text
    assert write_change(0.034, "um", DecimalSign.POINT) == "+ 0.03 µm"


def test_a_title_counts_in_words_of_their_number() -> None:
    drafts = [
        entry(dt.date(2026, 8, 1), job=f"{name}.yaml", number=name, state=State.DRAFT, message="differs")
        for name in "qr"
    ]
    assert _tell(*drafts).title == "Hall North: 2 drafts"


def test_a_night_gives_signs_of_life_in_a_file(fleet: Fleet) -> None:
    seen: list[str] = []

    class Curious(Witness):
        def note_plan(self, jobs: Sequence[PlannedJob]) -> None:
            Witness.note_plan(self, jobs)
            seen.append(fleet.file.heartbeat.read_text())

    night.spend_night(fleet.file, night.Order(), Curious())
    seen.append(fleet.file.heartbeat.read_text())
    began = dt.datetime(2026, 12, 1, 2, tzinfo=dt.UTC).timestamp()
    for text, is_at_work in zip(seen, (1.0, 0.0), strict=True):
        samples = {name: sum(family.samples.values()) for name, family in parse(text).items()}
        assert samples == {
            "zlmreport_fleet_heartbeat_timestamp_seconds": began,
            "zlmreport_fleet_at_work": is_at_work,
        }


def test_in_french_a_space_stands_before_colons_and_semicolons_of_the_news() -> None:
    two_parameters = [
        replace(each, parameters=(*each.parameters, replace(each.parameters[0], symbol="E")))
        for each in history(RISING, axis="B")
    ]
    message = _write_morning(Language.FRENCH, "Atelier", "l’horloge …", two_parameters)
    text = f"{message.title}\n{message.text}"
    assert re.findall(r".*\S[:;?!](?=\s).*", text) == []
    assert text.startswith("Atelier\N{NO-BREAK SPACE}: 1 ")
    assert "Horloge\N{NO-BREAK SPACE}: l’horloge …" in text
    assert "\N{NO-BREAK SPACE}; E + " in text
