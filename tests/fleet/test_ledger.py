"""The ledger keeps one truth in SQLite and in PostgreSQL."""

from __future__ import annotations

import contextlib
import datetime as dt
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import pytest
from sqlalchemy import Connection, Executable, create_engine, insert, text
from sqlalchemy.schema import CreateTable

from fleet.fleets import FLEET, Fleet, without_processes
from fleet.servers import server
from zlmreport.fleet.basis import CertificateBasis, FileStamp, KnownFile
from zlmreport.fleet.database import FORMAT, FORMATS, METADATA, open_database
from zlmreport.fleet.issuing import What
from zlmreport.fleet.ledger import Issued, Ledger, Night, NumberTakenError
from zlmreport.fleet.records import (
    About,
    LedgerEntry,
    News,
    NewsKind,
    NightNotice,
    PastNight,
    RecordedParameter,
    State,
    Subject,
)
from zlmreport.plugin import AccessError, InputError, Language, Words

NIGHTS = ("2026-11-20T02:00:00+00:00", "2026-11-21T02:00:00+00:00")
BASIS = CertificateBasis(
    (KnownFile("job", "x.yaml", "a" * 64, FileStamp(10, 20, 30)),), {"zlmreport": "0.1.0 code"}, ("pdf",)
)
FILES = (KnownFile(".pdf", "m/X/CAL-1.pdf", "b" * 64, FileStamp(1, 2, 3)),)
ENTRY = LedgerEntry(
    job="x.yaml",
    number="CAL-1",
    machine="HMC 500 17",
    axis="X",
    measured="2026-11-18",
    night=NIGHTS[0],
    digest=BASIS.digest,
    state=State.MADE,
    files=("m/X/CAL-1.pdf",),
    parameters=(
        RecordedParameter("iso230-2:2014", "A", 12.25, "um", 1.5, 20.0, conforms=True),
        RecordedParameter("iso230-2:2014", "B_mean", -1.5, "um"),
    ),
)
FAILURE = LedgerEntry(job="y.yaml", night=NIGHTS[0], state=State.FAILED, message="y.yaml:3:1: is no job")


@pytest.fixture(scope="module")
def postgresql() -> Iterator[str]:
    """The URL of a database on a server of our own."""
    with server() as url:
        yield url


@pytest.fixture(params=["sqlite", "postgresql"])
def address(request: pytest.FixtureRequest, tmp_path: Path) -> Iterator[str]:
    """Yield the address of an empty ledger in either database."""
    if request.param == "sqlite":
        yield str(tmp_path / "ledger.db")
        return
    url = request.getfixturevalue("postgresql")
    yield url
    engine = create_engine(url)
    with engine.begin() as connection:
        connection.execute(text("DROP SCHEMA public CASCADE"))
        connection.execute(text("CREATE SCHEMA public"))
    engine.dispose()


@contextlib.contextmanager
def night(address: str, began: str = NIGHTS[0], fleet: str = "north") -> Iterator[tuple[Ledger, Night]]:
    with Ledger.open(address, fleet) as ledger, ledger.hold_night(began, "fleet.yaml") as at_work:
        yield ledger, at_work


_SET_BACK = Words("set back", de="zurückgestellt", fr="reculée", it="spostato indietro", es="atrasado")


def test_an_entry_comes_back_as_it_was_given(address: str) -> None:
    with night(address) as (ledger, at_work):
        at_work.issue(ENTRY, FILES, BASIS)
        at_work.add(FAILURE)
        assert list(ledger.list_entries()) == [ENTRY, FAILURE]


def test_each_entry_has_its_own_parameters(address: str) -> None:
    others = replace(ENTRY, number="CAL-2", parameters=ENTRY.parameters[::-1])
    with night(address) as (ledger, at_work):
        at_work.issue(ENTRY, FILES, BASIS)
        at_work.issue(others, FILES, BASIS)
        assert list(ledger.list_entries()) == [ENTRY, others]


def test_to_begin_is_a_sign_of_life(address: str) -> None:
    with night(address) as (ledger, _):
        last = ledger.find_last_night()
        assert last is not None
        assert last.beat == last.began


def test_what_a_certificate_was_made_from_comes_back(address: str) -> None:
    with night(address) as (ledger, at_work):
        at_work.issue(ENTRY, FILES, BASIS)
        standing = ledger.list_standings()["x.yaml"]
        assert (standing.basis, standing.files, standing.night) == (BASIS, FILES, NIGHTS[0])


def test_the_latest_entry_of_each_job_is_found(address: str) -> None:
    with night(address) as (_, at_work):
        at_work.issue(ENTRY, FILES, BASIS)
        at_work.add(FAILURE)
    with night(address, NIGHTS[1]) as (ledger, at_work):
        draft = replace(ENTRY, night=NIGHTS[1], state=State.DRAFT)
        at_work.add(draft, FILES, BASIS)
        assert {job: each.state for job, each in ledger.list_standings().items()} == {
            ENTRY.job: State.DRAFT,
            FAILURE.job: State.FAILED,
        }
        assert list(ledger.list_certificates()) == [ENTRY.number]


def test_a_certificate_confirmed_keeps_its_first_entry(address: str) -> None:
    with night(address) as (_, at_work):
        at_work.issue(ENTRY, FILES, BASIS)
    with night(address, NIGHTS[1]) as (ledger, at_work):
        at_work.issue(replace(ENTRY, night=NIGHTS[1]), FILES, BASIS)
        assert ledger.list_certificates()["CAL-1"].night == NIGHTS[0]
        assert len(list(ledger.list_entries())) == 2
        assert len(ledger.list_certificates()) == 1


def test_a_number_is_given_once_whatever_fleet_asks(address: str) -> None:
    with night(address) as (_, at_work):
        at_work.issue(ENTRY, FILES, BASIS)
    with night(address, fleet="south") as (ledger, at_work):
        with pytest.raises(NumberTakenError):
            at_work.issue(ENTRY, FILES, BASIS)
        assert not list(ledger.list_entries())
        assert ledger.list_certificates()["CAL-1"].fleet == "north"


@pytest.mark.parametrize("fleet", ["north", "south"])
def test_a_number_given_meanwhile_is_refused_in_other_letters_too(address: str, fleet: str) -> None:
    """Where case is ignored, the files of both would be the same."""
    with night(address) as (_, at_work):
        at_work.issue(ENTRY, FILES, BASIS)
    with night(address, NIGHTS[1], fleet) as (ledger, at_work):
        with pytest.raises(
            NumberTakenError, match="number cal-1 differs in case alone from CAL-1, which was"
        ):
            at_work.issue(replace(ENTRY, number="cal-1", job="z.yaml"), FILES, BASIS)
        assert list(ledger.list_certificates()) == ["CAL-1"]


def test_fleets_see_their_own_jobs_only(address: str) -> None:
    with night(address) as (_, at_work):
        at_work.issue(ENTRY, FILES, BASIS)
    with Ledger.open(address, "south") as ledger:
        assert not list(ledger.list_entries())


def test_a_night_that_did_not_end_is_noticed_by_the_next(address: str) -> None:
    with night(address) as (_, at_work):
        assert not at_work.was_interrupted
    with night(address, NIGHTS[1]) as (_, at_work):
        assert at_work.was_interrupted
        at_work.end(NIGHTS[1])
    with night(address, NIGHTS[1]) as (_, at_work):
        assert not at_work.was_interrupted


def test_a_second_night_is_excluded_while_the_first_is_at_work(address: str) -> None:
    with (
        night(address),
        Ledger.open(address, "south") as second,
        pytest.raises(AccessError, match="another night is at work on this ledger"),
    ):
        second.hold_night(NIGHTS[0], "fleet.yaml").__enter__()
    with night(address, fleet="south") as (_, at_work):
        assert at_work.fleet == "south"


def test_a_reader_is_let_in_during_a_night(address: str) -> None:
    with night(address) as (_, at_work):
        at_work.issue(ENTRY, FILES, BASIS)
        with Ledger.open(address, "north", create=False) as reader:
            assert list(reader.list_entries()) == [ENTRY]


def test_nights_of_a_fleet_are_kept(address: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    without_processes(monkeypatch)
    fleet = Fleet.of(tmp_path, "x", "y")
    fleet.write("fleet.yaml", FLEET.replace("ledger.db", address))
    fleet.spend()
    fleet.readings("x", "2 2 3 -1 -2 -3")
    fleet.spend()
    assert fleet.spend().what == {"x": What.UNCHANGED, "y": What.UNCHANGED}
    assert [each.state for each in fleet.entries()] == [State.MADE, State.MADE, State.DRAFT]


def test_a_ledger_of_another_format_is_refused(address: str) -> None:
    Ledger.open(address, "north").__exit__(None, None, None)
    engine = create_engine(address if "://" in address else f"sqlite:///{address}")
    with engine.begin() as connection:
        connection.execute(text(f"UPDATE ledger_format SET format = {FORMAT + 1}"))
    engine.dispose()
    said = f"is a ledger of format {FORMAT + 1}, and this program writes format {FORMAT}"
    with pytest.raises(InputError, match=said):
        Ledger.open(address, "north")


def test_a_file_that_is_no_database_is_named(tmp_path: Path) -> None:
    path = tmp_path / "ledger.db"
    path.write_text("no database, but a text of some length", encoding="utf-8")
    with pytest.raises(AccessError, match=f"{path}: the ledger cannot be used: file is not a database"):
        Ledger.open(str(path), "north")


@pytest.mark.parametrize(
    ("change", "said"),
    [
        ("UPDATE entries SET state = 'done'", "'done' is not a valid State"),
        ("UPDATE entries SET files = '[[1]'", "Expecting ',' delimiter"),
        ("UPDATE entries SET files = '[[1]]'", "from_json|argument|unpack|values"),
        ("UPDATE entries SET measured = '18.11.2026'", "Invalid isoformat string: '18.11.2026'"),
        ("UPDATE nights SET began = 'yesterday'", "Invalid isoformat string: 'yesterday'"),
        ('UPDATE nights SET notices = \'[["weather", "rain"]]\'', "'weather' is not a valid About"),
    ],
)
def test_what_somebody_wrote_into_a_ledger_by_hand_is_told(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, change: str, said: str
) -> None:
    without_processes(monkeypatch)
    fleet = Fleet.of(tmp_path, "x", "y")
    fleet.spend()
    with create_engine(f"sqlite:///{tmp_path / 'ledger.db'}").begin() as connection:
        connection.execute(text(change))
    with pytest.raises(AccessError, match=f"the ledger holds what no night wrote: .*({said})") as told:
        fleet.spend()
    assert "make it again (zlmreport fleet rebuild)" in str(told.value)


def test_a_database_of_another_kind_is_refused() -> None:
    with pytest.raises(InputError, match="a ledger is in SQLite or PostgreSQL, not in mysql"):
        Ledger.open("mysql://server/fleet", "north")


def test_a_server_that_is_not_there_is_named_without_the_password() -> None:
    with pytest.raises(AccessError) as raised:
        Ledger.open("postgresql+psycopg://user:secret@localhost:1/fleet", "north")
    assert "the ledger cannot be used" in str(raised.value)
    assert "secret" not in str(raised.value)


#: What each format added.
ADDED = {
    2: ("nights beat", "entries seconds", "entries interval"),
    3: ("nights notices", "entries instrument"),
    4: ("entries type",),
    5: ("entries lesson",),
    6: ("nights untried",),
    7: ("entries doubts",),
}


@pytest.mark.parametrize("older", [1, 2, 4])
def test_a_ledger_of_an_older_format_is_brought_up_to_date(older: int, address: str) -> None:
    with night(address) as (_, at_work):
        at_work.issue(ENTRY, FILES, BASIS)
    engine = create_engine(address if "://" in address else f"sqlite:///{address}")
    with engine.begin() as connection:
        for column in (each for added in range(older + 1, FORMAT + 1) for each in ADDED[added]):
            connection.execute(text(f"ALTER TABLE {column.replace(' ', ' DROP COLUMN ')}"))
        connection.execute(text(f"UPDATE ledger_format SET format = {older}"))
    engine.dispose()
    with night(address, NIGHTS[1]) as (ledger, at_work):
        assert list(ledger.list_entries()) == [ENTRY]
        at_work.beat(NIGHTS[1])
        at_work.notice([NightNotice(About.CLOCK, _SET_BACK)])
        at_work.leave(["x.yaml"])
        at_work.issue(replace(ENTRY, number="CAL-2"), FILES, BASIS, {"kind": "linear"})
        assert [each.lesson for each in ledger.list_lessons()] == [{"kind": "linear"}]
        last = ledger.find_last_night()
        assert last is not None
        assert last.notices == (NightNotice(About.CLOCK, _SET_BACK),)
        assert last.untried == ("x.yaml",)


def test_what_is_doubtful_is_kept_in_every_language(address: str) -> None:
    doubt = Words("Run {run} mirrors the others: the sign of its deviations seems to be turned").given(run=3)
    with night(address) as (ledger, at_work):
        at_work.issue(replace(ENTRY, doubts=(doubt,)), FILES, BASIS)
        ((kept,),) = (each.doubts for each in ledger.list_entries())
    assert [kept.in_language(each) for each in Language] == [doubt.in_language(each) for each in Language]


def test_a_copy_of_a_ledger_says_the_same(address: str, tmp_path: Path) -> None:
    copy = tmp_path / "copy.db"
    with night(address) as (ledger, at_work):
        at_work.issue(ENTRY, FILES, BASIS)
        ledger.write_backup(copy)
    with Ledger.open(str(copy), "north") as copied:
        assert list(copied.list_entries()) == [ENTRY]
        assert copied.list_certificates()["CAL-1"].files == FILES


@pytest.fixture
def north(tmp_path: Path) -> Iterator[tuple[Ledger, Night]]:
    """A ledger at night, after a certificate of the fleet south."""
    path = str(tmp_path / "ledger.db")
    with night(path, fleet="south") as (_, at_work):
        at_work.issue(replace(ENTRY, number="S-1", seconds=99.0), FILES, BASIS, {"of": "south"})
        at_work.report([OVERDUE])
    with night(path) as opened:
        yield opened


FAILED = News(NewsKind.FAILED, "y.yaml", "y.yaml cannot be read")
OVERDUE = News(NewsKind.OVERDUE, "x.yaml", "x.yaml is due")


def test_what_the_latest_certificate_of_a_job_states_is_found(north: tuple[Ledger, Night]) -> None:
    """Neither what another job states, nor a draft that came later."""
    _, at_work = north
    at_work.issue(replace(ENTRY, parameters=()), FILES, BASIS)
    at_work.issue(ENTRY, FILES, BASIS)
    at_work.issue(replace(ENTRY, job="z.yaml", number="CAL-9", parameters=ENTRY.parameters[1:]), FILES, BASIS)
    at_work.add(replace(ENTRY, state=State.DRAFT, parameters=()))
    assert at_work.find_stated_parameters("x.yaml") == ENTRY.parameters
    assert at_work.find_stated_parameters("y.yaml") == ()


def test_news_is_told_once_by_each_way_and_only_the_own(north: tuple[Ledger, Night]) -> None:
    _, at_work = north
    at_work.report([FAILED, OVERDUE])
    assert at_work.list_untold("mail", was_tried=True) == (FAILED, OVERDUE)
    at_work.tell("mail")
    assert (at_work.list_untold("mail", was_tried=True), at_work.list_untold("page", was_tried=True)) == (
        (),
        (FAILED, OVERDUE),
    )
    at_work.tell("mail")  # again: nothing changes
    at_work.tell("page")
    assert at_work.list_untold("page", was_tried=True) == ()


def test_what_is_told_is_told_to_nobody_else(north: tuple[Ledger, Night]) -> None:
    ledger, at_work = north
    at_work.report([FAILED])
    at_work.tell("mail")
    assert at_work.list_untold("mail", was_tried=True) == ()
    with Ledger.open(f"{ledger._database.engine.url.database}", "south") as south:
        assert replace(at_work, fleet="south", database=south._database).list_untold(
            "mail", was_tried=True
        ) == (OVERDUE,)


def test_a_condition_that_ended_is_news_when_it_comes_back_and_an_event_never(
    north: tuple[Ledger, Night],
) -> None:
    _, at_work = north
    for news in ([FAILED, OVERDUE], [FAILED], [], [FAILED, OVERDUE]):
        at_work.report(news)
    assert at_work.list_untold("mail", was_tried=True) == (FAILED, OVERDUE, FAILED)


def test_a_condition_that_was_not_looked_at_goes_on(north: tuple[Ledger, Night]) -> None:
    _, at_work = north
    for news in ([FAILED], [], [FAILED]):
        at_work.report(news, is_all=False)
    assert at_work.list_untold("mail", was_tried=True) == (FAILED,)


def test_the_longest_time_of_each_job_is_known(north: tuple[Ledger, Night]) -> None:
    ledger, at_work = north
    for seconds in (2.0, 3.0, None, 1.0):
        at_work.add(replace(ENTRY, seconds=seconds, state=State.DRAFT))
    at_work.add(FAILURE)
    assert ledger.list_longest_times() == {"x.yaml": 3.0}


def test_of_each_test_the_latest_certificate_teaches_in_the_order_of_measurement(
    north: tuple[Ledger, Night],
) -> None:
    ledger, at_work = north
    readings = KnownFile("readings", "x.csv", "c" * 64)
    basis = replace(BASIS, files=(*BASIS.files, readings))
    for number, measured, lesson in (
        ("CAL-3", "2026-11-19", {"a": 3}),
        ("CAL-1", "2026-11-18", {"a": 1}),
        ("CAL-1", "2026-11-18", {"a": 2}),
        ("CAL-4", "2026-11-20", None),
    ):
        at_work.issue(replace(ENTRY, number=number, measured=measured), FILES, basis, lesson)
    taught = list(ledger.list_lessons())
    assert [(each.subject.number, each.lesson) for each in taught] == [
        ("CAL-1", {"a": 2}),
        ("CAL-3", {"a": 3}),
    ]
    assert {each.readings for each in taught} == {frozenset({readings.sha256})}


def test_the_last_night_is_that_of_the_fleet_with_what_became_of_it(north: tuple[Ledger, Night]) -> None:
    ledger, at_work = north
    said = NightNotice(About.CLOCK, _SET_BACK)
    at_work.notice([said])
    at_work.beat(NIGHTS[1])
    for entry in (FAILURE, FAILURE, replace(ENTRY, state=State.DRAFT)):
        at_work.add(entry)
    began, later = map(dt.datetime.fromisoformat, NIGHTS)
    at_work_still = PastNight(began, None, (said,), {State.FAILED: 2, State.DRAFT: 1}, later)
    assert ledger.find_last_night() == at_work_still
    at_work.end(NIGHTS[1])
    assert ledger.find_last_night() == replace(at_work_still, ended=later)


def test_before_its_first_night_a_fleet_has_none(tmp_path: Path) -> None:
    with Ledger.open(str(tmp_path / "ledger.db"), "north") as ledger:
        assert ledger.find_last_night() is None


def test_a_standing_is_all_that_was_noted_of_the_last_entry(north: tuple[Ledger, Night]) -> None:
    ledger, at_work = north
    at_work.add(replace(FAILURE, machine="HMC 500 17", axis="X", interval=365, digest="d"))
    standing = ledger.list_standings()["y.yaml"]
    assert (standing.state, standing.message, standing.digest) == (State.FAILED, FAILURE.message, "d")
    assert (standing.files, standing.basis) == ((), None)
    assert standing.subject == Subject(machine="HMC 500 17", axis="X", interval=365)


def test_a_certificate_is_known_by_its_number_with_where_it_belongs(north: tuple[Ledger, Night]) -> None:
    ledger, at_work = north
    at_work.issue(ENTRY, FILES, BASIS)
    assert ledger.list_certificates() == {
        "S-1": Issued("south", "x.yaml", NIGHTS[0], FILES),
        "CAL-1": Issued("north", "x.yaml", NIGHTS[0], FILES),
    }


@pytest.mark.parametrize("last", [CreateTable(FORMATS), insert(FORMATS).values(format=FORMAT)])
def test_a_ledger_that_another_night_makes_at_the_same_moment_is_used(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, last: Executable
) -> None:
    address, usual = str(tmp_path / "ledger.db"), METADATA.create_all

    def create_all(connection: Connection) -> None:
        monkeypatch.setattr(METADATA, "create_all", usual)
        open_database(address, create=True).engine.dispose()
        connection.execute(last)

    monkeypatch.setattr(METADATA, "create_all", create_all)
    with Ledger.open(address, "Hall North") as ledger, ledger.hold_night(NIGHTS[0], "fleet.yaml"):
        assert ledger.find_last_night() is not None
