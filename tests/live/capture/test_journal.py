"""What was taken is on the disk, whole, and is found there whatever happens."""

from __future__ import annotations

import os
from itertools import chain
from pathlib import Path

import pytest

from live.capture.moves import Axis, kinds, planned
from live.capture.recording import header, recorded, written
from processes import PYTHON, run
from zlmreport.live.capture.events import Ended, Interrupted, Resumed
from zlmreport.live.capture.journal import Journal, read_history, seal
from zlmreport.model.planning.methods import Method
from zlmreport.plugin import AccessError
from zlmreport.plugin.instrument import Fault


@pytest.fixture
def journal(tmp_path: Path) -> Path:
    """A capture that was left after two of six visits."""
    axis = Axis(error={0: 0.0012345678})
    return written(tmp_path / "x.journal", chain(axis.stand(), axis.go(0, 100)))


def test_everything_that_happened_is_read_as_it_was(tmp_path: Path) -> None:
    axis, path = Axis(), tmp_path / "x.journal"
    with Journal.begin(path, header()) as journal:
        events = recorded(
            chain(axis.stand(), axis.go(0), axis.go(200), axis.turn(150), axis.go(100)), journal
        )
        for event in (Interrupted("by hand"), Resumed(), Ended()):
            journal.append(event, 60.0)
            events.append(event)
    history = read_history(path)
    assert history.header == header()
    assert [entry.event for entry in history.entries] == [
        event for event in events if type(event).__name__ not in {"Moving", "Settling"}
    ]


def test_numbers_lose_no_digit(journal: Path) -> None:
    history = read_history(journal)
    assert history.entries[0].event.deviation == 0.0012345678e-3


def test_a_journal_goes_on_where_it_ended(journal: Path) -> None:
    axis = Axis(position=95.0, time=200.0)
    with Journal.resume(journal) as opened:
        assert opened.progress.taken == 2
        opened.append(Resumed(), 100.0)
        events = recorded(chain(axis.go(100, 200)), opened)
    assert kinds(events) == ["DatumHolds", "Moving", "Settling", "visit 3"]


@pytest.mark.parametrize("left", [0, 1, 40, 200])
def test_a_line_that_a_power_cut_tore_off_is_left_out_and_cut_away(journal: Path, left: int) -> None:
    whole = journal.read_bytes()
    *lines, last = whole.splitlines(keepends=True)
    sound = b"".join(lines)
    journal.write_bytes(sound + last[:left])
    history = read_history(journal)
    assert (history.progress.taken, history.file.size - history.sound) == (1, left)
    with Journal.resume(journal) as opened:
        opened.append(Resumed(), 100.0)
    assert journal.read_bytes().startswith(sound + b'{"elapsed"')
    assert read_history(journal).progress.must_check


def test_a_tail_of_zeros_that_a_file_system_leaves_is_torn_off_too(journal: Path) -> None:
    journal.write_bytes(journal.read_bytes() + bytes(512))
    history = read_history(journal)
    assert (history.progress.taken, history.file.size - history.sound) == (2, 512)


@pytest.mark.parametrize("line", [1, 2])
def test_a_changed_digit_in_the_middle_is_found_by_its_line(journal: Path, line: int) -> None:
    lines = journal.read_bytes().splitlines(keepends=True)
    assert len(lines) == 3
    lines[line - 1] = lines[line - 1].replace(b"0.0", b"0.1", 1)
    journal.write_bytes(b"".join(lines))
    with pytest.raises(AccessError) as raised:
        read_history(journal)
    assert raised.value.problems[0].place.line == line


def test_a_line_that_was_taken_out_is_found(journal: Path) -> None:
    first, second, third = journal.read_bytes().splitlines(keepends=True)
    assert second != third
    journal.write_bytes(first + third + third)
    with pytest.raises(AccessError, match="altered or damaged from this line on"):
        read_history(journal)


@pytest.mark.parametrize("content", [b"target,direction\n0,+\n", b"my notes", b'{"schema":"else"}\n'])
def test_a_file_of_somebody_else_is_neither_read_nor_written_over(tmp_path: Path, content: bytes) -> None:
    path = tmp_path / "notes.txt"
    path.write_bytes(content)
    with pytest.raises(AccessError, match="is no journal"):
        Journal.begin(path, header())
    assert path.read_bytes() == content


def test_a_capture_is_not_begun_over_another(journal: Path) -> None:
    before = journal.read_bytes()
    with pytest.raises(AccessError, match=r"holds a capture of CAL-7 .* 2 of 6 visits; go on with --resume"):
        Journal.begin(journal, header())
    assert journal.read_bytes() == before


def test_readings_of_a_run_that_is_to_be_taken_again_are_not_written_over(tmp_path: Path) -> None:
    axis, path = Axis(), tmp_path / "x.journal"
    lost = axis.stand(1.5, faults=Fault.BEAM_LOST, value=float("nan"))
    written(path, chain(axis.stand(), axis.go(0), lost))
    assert read_history(path).progress.taken == 0
    with pytest.raises(AccessError, match="go on with --resume"):
        Journal.begin(path, header())


def test_a_journal_without_a_reading_gives_way_to_a_new_capture(tmp_path: Path) -> None:
    path = written(tmp_path / "x.journal", Axis().stand())
    with Journal.begin(path, header(number="CAL-8")):
        pass
    assert read_history(path).header.number == "CAL-8"


def test_a_first_line_that_was_torn_off_gives_way_to_a_new_capture(journal: Path) -> None:
    journal.write_bytes(journal.read_bytes()[:30])
    assert read_history(journal) is None
    with Journal.begin(journal, header()):
        pass
    assert read_history(journal).progress.taken == 0


def test_only_one_capture_writes_a_journal(journal: Path) -> None:
    with Journal.resume(journal), pytest.raises(AccessError, match="is being written by another capture"):
        Journal.resume(journal)


def test_a_journal_is_free_again_when_its_capture_was_killed(journal: Path) -> None:
    program = f"""if True:
        import os, pathlib
        from zlmreport.live.capture.journal import Journal
        journal = Journal.resume(pathlib.Path({str(journal)!r}))
        os.kill(os.getpid(), 9)
    """
    run(PYTHON, "-c", program)
    with Journal.resume(journal) as opened:
        assert opened.progress.taken == 2


def test_every_record_is_pushed_to_the_disk(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    pushed = []
    push = os.fsync
    monkeypatch.setattr(os, "fsync", lambda handle: (pushed.append(os.fstat(handle).st_size), push(handle)))
    path, sizes = tmp_path / "x.journal", []
    with Journal.begin(path, header()) as journal:
        for event in (Resumed(), Ended()):
            journal.append(event, 1.0)
            sizes.append(path.stat().st_size)
    assert set(sizes) <= set(pushed)


def test_a_full_disk_is_told(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def full(_handle: int, _data: bytes) -> int:
        raise OSError(28, "No space left on device")

    with Journal.begin(tmp_path / "x.journal", header()) as journal:
        monkeypatch.setattr(os, "write", full)
        with pytest.raises(AccessError, match="no space left on device; what happened last is not in it"):
            journal.append(Resumed(), 1.0)


def test_time_does_not_go_back_when_a_clock_does(tmp_path: Path) -> None:
    with Journal.begin(tmp_path / "x.journal", header()) as journal:
        journal.append(Resumed(), 50.0)
        journal.append(Resumed(), 10.0)
    assert [entry.elapsed for entry in read_history(tmp_path / "x.journal").entries] == [50.0, 50.0]


def test_a_journal_that_is_not_there_says_how_to_begin(tmp_path: Path) -> None:
    with pytest.raises(AccessError, match="nothing was captured yet"):
        Journal.resume(tmp_path / "x.journal")
    assert not (tmp_path / "x.journal").exists()


def test_a_folder_is_no_journal(tmp_path: Path) -> None:
    with pytest.raises(AccessError, match="it is a folder"):
        read_history(tmp_path)


def test_a_record_of_another_version_is_refused(tmp_path: Path) -> None:
    first, before = seal(header().to_record(), "")
    second, _ = seal({"elapsed": 1.0, "record": "of the future"}, before)
    path = tmp_path / "x.journal"
    path.write_bytes(first + second)
    with pytest.raises(AccessError) as raised:
        read_history(path)
    assert raised.value.problems[0].place.line == 2


def test_a_resumed_pendulum_knows_its_way(tmp_path: Path) -> None:
    plan, axis = planned(Method.PENDULUM, runs=2), Axis()
    path = written(tmp_path / "x.journal", chain(axis.stand(), axis.go(0), axis.turn(5), axis.go(0)), plan)
    axis = Axis(position=5.0, time=400.0)
    with Journal.resume(path) as journal:
        journal.append(Resumed(), 200.0)
        events = recorded(chain(axis.go(0), axis.turn(-5), axis.go(0)), journal)
    assert kinds(events)[-1] == "visit 3"
