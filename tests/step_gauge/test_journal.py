"""What was probed is on the disk, and a journal that broke off is taken up where it is sound."""

from __future__ import annotations

from pathlib import Path

import pytest

from step_gauge.emulated import small_path
from zlmreport.plugin import AccessError, InputError
from zlmreport_step_gauge.machines.run import PointJournal

PATH = small_path().path
FIRST, SECOND, *_ = PATH.probings


def taken(result: Path) -> Path:
    """Return a journal that holds the first point."""
    with PointJournal(result, PATH) as journal:
        journal.take(FIRST, FIRST.away(2e-3), {})
    return journal.part


def test_a_point_is_on_the_disk_as_soon_as_it_is_taken(tmp_path: Path) -> None:
    with PointJournal(tmp_path / "raw.csv", PATH) as journal:
        journal.take(FIRST, (0.1, -0.2, 1e-12), {})
        last = journal.part.read_text("ascii").splitlines()[-1]
    assert last == "1,1,100.00000,-200.00000,0.00000,0.0000000,-1.0000000,0.0000000"


def test_what_else_the_machine_reports_stands_in_a_remark(tmp_path: Path) -> None:
    with PointJournal(tmp_path / "raw.csv", PATH) as journal:
        journal.take(FIRST, FIRST.away(2e-3), {"Temperature": 20.125})
    assert journal.part.read_text("ascii").endswith("\n# face 1, cycle 1: Temperature 20.125\n")
    with PointJournal(tmp_path / "raw.csv", PATH) as again:
        assert again.done == {(1, 1)}


def test_a_row_that_was_torn_off_is_cut_away(tmp_path: Path) -> None:
    part = taken(tmp_path / "raw.csv")
    sound = part.read_bytes()
    part.write_bytes(sound + b"3,1,300.0")
    with PointJournal(tmp_path / "raw.csv", PATH) as journal:
        assert journal.done == {(1, 1)}
        journal.take(SECOND, SECOND.away(2e-3), {})
    assert part.read_bytes().startswith(sound + b"3,1,300.00000,")


def test_a_head_that_was_torn_off_is_written_anew(tmp_path: Path) -> None:
    part = taken(tmp_path / "raw.csv")
    head = part.read_bytes()[:60]
    part.write_bytes(head)
    with PointJournal(tmp_path / "raw.csv", PATH) as journal:
        assert journal.done == set()
    assert part.read_text("ascii").splitlines()[2] == "face,cycle,x,y,z,i,j,k"


def test_a_file_that_is_no_journal_is_left_alone(tmp_path: Path) -> None:
    part = tmp_path / "raw.csv.part"
    part.write_text("mine\n", encoding="ascii")
    with pytest.raises(InputError, match="holds points of another path"):
        PointJournal(tmp_path / "raw.csv", PATH)
    assert part.read_text("ascii") == "mine\n"


@pytest.mark.parametrize("row", ["face three", "3", "3;1;300.0;0;0;0;-1;0", "²,1,0,0,0,0,-1,0"])
def test_a_row_that_somebody_changed_is_refused_with_its_line(row: str, tmp_path: Path) -> None:
    part = taken(tmp_path / "raw.csv")
    changed = part.read_text("ascii") + f"{row}\n"
    part.write_text(changed, encoding="utf-8")
    with pytest.raises(InputError, match=r"raw.csv.part:5:1: is no row of face,cycle,x,y,z,i,j,k: .*; take"):
        PointJournal(tmp_path / "raw.csv", PATH)
    assert part.read_text("utf-8") == changed


def test_a_finished_journal_has_the_name_of_the_result(tmp_path: Path) -> None:
    with PointJournal(tmp_path / "new" / "raw.csv", PATH) as journal:
        assert journal.finish() == tmp_path / "new" / "raw.csv"
    assert [path.name for path in (tmp_path / "new").iterdir()] == ["raw.csv"]


def test_a_folder_that_cannot_be_made_is_said(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("", encoding="ascii")
    with pytest.raises(AccessError, match="cannot be written"):
        PointJournal(tmp_path / "file" / "raw.csv", PATH)


def test_two_runs_do_not_write_one_journal(tmp_path: Path) -> None:
    with (
        PointJournal(tmp_path / "raw.csv", PATH),
        pytest.raises(AccessError, match="being written by another run"),
    ):
        PointJournal(tmp_path / "raw.csv", PATH)
