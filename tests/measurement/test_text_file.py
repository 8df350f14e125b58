"""Text files: what is read, and what is refused at once with its place."""

from __future__ import annotations

import hashlib
import os
from pathlib import Path

import pytest

from refusals import refused
from zlmreport.plugin import AccessError
from zlmreport.plugin.source import known_encoding, read_text


def written(folder: Path, content: bytes) -> Path:
    file = folder / "readings.csv"
    file.write_bytes(content)
    return file


def complaint(file: Path, encoding: str | None = None) -> str:
    """Return what is said of a file, the folder left out."""
    (problem,) = refused(read_text, file, encoding).problems
    return str(problem).removeprefix(f"{file.parent}/")


@pytest.mark.parametrize(
    "content",
    [b"a\nb\n", b"a\nb", b"a\r\nb\r\n", b"a\rb\r", b"\xef\xbb\xbfa\nb\n", b"a\nb\n\x1a"],
    ids=["lf", "no last newline", "cr lf", "cr", "byte order mark", "dos end of file"],
)
def test_every_usual_end_of_line_gives_the_same_lines(tmp_path: Path, content: bytes) -> None:
    assert read_text(written(tmp_path, content)).lines == ("a", "b")


def test_a_form_feed_or_line_separator_ends_no_line(tmp_path: Path) -> None:
    assert complaint(written(tmp_path, "a\nb\u2028c\n".encode())) == (
        "readings.csv:2:2: invisible character U+2028 (line separator); remove it"
    )


def test_the_digest_is_of_the_bytes_in_the_file(tmp_path: Path) -> None:
    content = b"\xef\xbb\xbfa\r\n"
    source = read_text(written(tmp_path, content)).source
    assert (source.name, source.sha256, source.size) == (
        "readings.csv",
        hashlib.sha256(content).hexdigest(),
        len(content),
    )


def test_a_stated_encoding_is_used(tmp_path: Path) -> None:
    assert read_text(written(tmp_path, "Prüfling\n".encode("cp1252")), "cp1252").lines == ("Prüfling",)
    assert read_text(written(tmp_path, "测量\n".encode("gbk")), "gbk").lines == ("测量",)
    assert read_text(written(tmp_path, "a\nb\n".encode("utf-16")), "utf-16").lines == ("a", "b")


def test_a_stated_utf_8_takes_a_byte_order_mark_too(tmp_path: Path) -> None:
    assert read_text(written(tmp_path, b"\xef\xbb\xbfa\n"), "UTF8").lines == ("a",)


def test_the_first_byte_that_cannot_be_decoded_is_named_by_line_and_column(tmp_path: Path) -> None:
    file = written(tmp_path, "a\r\nä§Größe\n".encode() + "Größe".encode("latin-1"))
    assert complaint(file) == (
        "readings.csv:3:3: byte 0xF6 is not UTF-8; save the file as UTF-8, or name its encoding in the job, "
        "as in 'encoding: cp1252'"
    )


@pytest.mark.parametrize(
    ("encoding", "found"),
    [("utf-16", "utf-16"), ("utf-16-le", "utf-16-le"), ("utf-16-be", "utf-16-be"), ("utf-32", "utf-32")],
)
def test_wide_characters_are_recognised_with_and_without_mark(
    tmp_path: Path, encoding: str, found: str
) -> None:
    file = written(tmp_path, "target,direction,run,deviation\n0,+,1,1.5\n".encode(encoding))
    name = found[:6].upper()
    assert complaint(file) == (
        f"readings.csv:1:1: is {name} text; save it as UTF-8, or say 'encoding: {found}' in the job"
    )


@pytest.mark.parametrize("content", [b"", b" \n\t\r\n"], ids=["no bytes", "blank lines"])
def test_an_empty_file_is_refused(tmp_path: Path, content: bytes) -> None:
    assert (
        complaint(written(tmp_path, content)) == "readings.csv: is empty; a measurement file holds readings"
    )


@pytest.mark.parametrize(
    ("beginning", "kind"),
    [
        (b"PK\x03\x04", "an archive"),
        (b"\xd0\xcf\x11\xe0", "a workbook of old Excel, .xls"),
        (b"%PDF-1.7", "a PDF document"),
        (b"\x1f\x8b", "a compressed file"),
    ],
)
def test_a_file_of_another_program_is_called_what_it_is(tmp_path: Path, beginning: bytes, kind: str) -> None:
    assert complaint(written(tmp_path, beginning + bytes(range(256)))) == (
        f"readings.csv: is {kind}, not text; export the readings as text (CSV, UTF-8)"
    )


def test_a_binary_file_is_refused_where_it_is_no_text(tmp_path: Path) -> None:
    assert complaint(written(tmp_path, b"a,b\n1,\0\0\xff\xfe")).startswith(
        "readings.csv:2:5: byte 0xFF is not UTF-8: "
    )
    assert complaint(written(tmp_path, b"a,b\n1,\0")).startswith(
        "readings.csv:2:3: control character U+0000; "
    )


def test_binary_that_decodes_by_the_stated_encoding_is_refused_as_well(tmp_path: Path) -> None:
    assert complaint(written(tmp_path, b"ab\x81\x01"), "latin-1").startswith(
        "readings.csv:1:3: control character U+0081; "
    )


def test_an_override_of_the_writing_direction_is_refused(tmp_path: Path) -> None:
    assert complaint(written(tmp_path, "a,\u202e1\n".encode())) == (
        "readings.csv:1:3: invisible character U+202E (right-to-left override); remove it"
    )


def test_a_file_of_a_gigabyte_is_refused(tmp_path: Path) -> None:
    file = written(tmp_path, b"target,direction,run,deviation\n")
    os.truncate(file, 10**9)
    assert complaint(file) == (
        "readings.csv: is longer than 64 MiB: name a file that holds the readings of one test only"
    )


def test_a_continuous_log_is_refused_where_it_becomes_one(tmp_path: Path) -> None:
    assert complaint(written(tmp_path, b"1\n" * 250_001)).startswith(
        "readings.csv:250001:1: the file goes on for 250001 lines"
    )
    assert len(read_text(written(tmp_path, b"1\n" * 250_000)).lines) == 250_000


def test_an_endless_line_is_refused(tmp_path: Path) -> None:
    assert complaint(written(tmp_path, b"a\n" + b"1" * 100_001)).startswith(
        "readings.csv:2:100001: the line has 100001 characters"
    )


def refusal(file: Path) -> str:
    with pytest.raises(AccessError) as caught:
        read_text(file)
    return str(caught.value).removeprefix(f"{file.parent}/")


def test_a_file_that_is_not_there_is_answered_with_the_nearest_one_that_is(tmp_path: Path) -> None:
    (tmp_path / "x-axis.csv").touch()
    assert refusal(tmp_path / "x-achse.csv") == (
        "x-achse.csv: cannot be read: there is no such file; did you mean 'x-axis.csv'?"
    )


@pytest.mark.parametrize(
    ("name", "advice"),
    [
        ("X-AXIS.CSV", "; did you mean 'x-axis.csv'?"),
        ("runs\\x.csv", "; write its folders with /"),
        ("C:\\data\\x-axis.csv", "; did you mean 'x-axis.csv'?"),
        ("link.csv", ": it is a link to gone.csv, which is not there"),
    ],
)
def test_a_name_that_is_nearly_right_is_answered_with_what_would_be(
    tmp_path: Path, name: str, advice: str
) -> None:
    (tmp_path / "x-axis.csv").touch()
    (tmp_path / "link.csv").symlink_to("gone.csv")
    (tmp_path / "runs").mkdir()
    (tmp_path / "runs" / "x.csv").touch()
    assert refusal(tmp_path / name) == f"{name}: cannot be read: there is no such file{advice}"


def test_a_folder_that_is_not_there_is_named(tmp_path: Path) -> None:
    assert refusal(tmp_path / "runs" / "x.csv") == (
        f"x.csv: cannot be read: there is no such file, and no folder {tmp_path / 'runs'}"
    )


def test_a_folder_is_no_file(tmp_path: Path) -> None:
    (tmp_path / "runs").mkdir()
    assert refusal(tmp_path / "runs") == "runs: cannot be read: it is a folder; name the file in it"


def test_a_pipe_is_not_waited_for(tmp_path: Path) -> None:
    os.mkfifo(tmp_path / "pipe")
    assert refusal(tmp_path / "pipe") == "pipe: cannot be read: it is no file but a device or a pipe"


@pytest.mark.skipif(not Path("/proc/self/mem").exists(), reason="needs a file that fails while it is read")
def test_a_failure_while_reading_is_passed_on() -> None:
    assert refusal(Path("/proc/self/mem")) == "mem: cannot be read: input/output error"


def test_what_the_system_refuses_is_passed_on_in_its_words(tmp_path: Path) -> None:
    (tmp_path / "loop").symlink_to("loop")
    assert "cannot be read: too many levels of symbolic links" in refusal(tmp_path / "loop")
    assert "embedded null" in refusal(tmp_path / "a\0b")


@pytest.mark.parametrize("name", ["utf-8", "UTF-16", "cp1252", "gbk", "latin-1"])
def test_an_encoding_is_known_by_any_of_its_names(name: str) -> None:
    assert known_encoding(name) == name


@pytest.mark.parametrize("name", ["utf-80", "hex", "rot13", "idna", "undefined", "", "a\0b"])
def test_what_is_no_encoding_of_text_is_refused(name: str) -> None:
    with pytest.raises(ValueError, match="is no encoding of text; for example"):
        known_encoding(name)
