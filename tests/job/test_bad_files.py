"""Files that are no YAML, no text, or far too much: refused at the place where that shows."""

from __future__ import annotations

import codecs
import tracemalloc
from itertools import pairwise
from pathlib import Path

import pytest

from job.jobs import REGISTRY, SOUND, loaded, mistakes
from zlmreport.job.loading import load
from zlmreport.plugin import AccessError, InputError

NO_JOBS: dict[str, tuple[bytes, str, str]] = {
    "empty": (b"", "1:1", "is empty; a file of keys says first what it is"),
    "only comments": (b"# nothing yet\n", "1:1", "is empty"),
    "only a null": (b"~\n", "1:1", "is empty"),
    "list": (b"- a\n- b\n", "1:1", "is a list; a file of keys says first what it is"),
    "text": (b"hello\n", "1:1", "is a text; a file of keys says first what it is"),
    "UTF-16 with its mark": (
        codecs.BOM_UTF16_LE + "schema: x".encode("utf-16-le"),
        "1:1",
        "is UTF-16; save it",
    ),
    "UTF-16 without its mark": ("schema: x".encode("utf-16-be"), "1:1", "is UTF-16; save it as UTF-8"),
    "Latin-1": ("a: 1\nb: Prüf".encode("latin-1"), "2:6", "byte 0xFC is not UTF-8; save the file as UTF-8"),
    "picture": (b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR", "1:1", "byte 0x89 is not UTF-8"),
    "zeros": (bytes(100), "1:1", "control character U+0000"),
    "larger than 1 MiB": (b"#" * (1024 * 1024 + 1), "1:1", "is larger than 1 MiB"),
    "tab as indentation": (b"a:\n\tb: 1\n", "2:1", "a tab cannot indent; use spaces"),
    "indentation out of line": (
        b"a:\n  b: 1\n c: 2\n",
        "3:2",
        "does not fit the indentation of the lines above",
    ),
    "second colon": (
        b"a: b: c\n",
        "1:5",
        "a colon is not expected here; put a text that holds ': ' in quotes",
    ),
    "key without colon": (b"a: 1\nb\nc: 1\n", "3:1", "a key needs a colon and a space after it"),
    "value that begins with @": (
        b"a: @b\n",
        "1:4",
        "a value cannot begin with @; put it in quotes: '@\u2026'",
    ),
    "value that begins with %": (b"a: %b\n", "1:4", "a value cannot begin with %; put it in quotes"),
    "Windows path in double quotes": (
        b'a: "C:\\data"\n',
        "1:8",
        "\\d means nothing in double quotes; use single",
    ),
    "user folder in double quotes": (
        b'a: "C:\\Users"\n',
        "1:9",
        "unfinished \\x, \\u or \\U in double quotes",
    ),
    "character beyond Unicode": (b'a: "\\UFFFFFFFF"\n', "1:7", "is not YAML from here on"),
    "quote never closed": (
        b"a: 1\nb: 'c\nd: 1\n",
        "2:4",
        "the quotation mark that opens here is never closed",
    ),
    "text after a quote": (b"a: 'b' c\n", "1:8", "a text in quotes ends at its closing quotation mark"),
    "bracket never closed": (
        b"a: [1, 2\nb: 3\n",
        "2:2",
        "the bracket of line 1 is still open, and a comma or ]",
    ),
    "brace never closed": (b"a: {b: 1\n", "2:1", "the bracket of line 1 is still open, and a comma or }"),
    "list item in a line": (b"a: - b\n", "1:4", "a list item is not expected here"),
    "list among keys": (b"a: b\n- c\n", "2:1", "does not fit the indentation"),
    "value missing": (b"a: ]\n", "1:4", "a value is expected here"),
    "words after |": (b"a: | b\n  c\n", "1:6", "after | or > nothing may follow in the line"),
    "unknown directive's version": (b"%YAML 7.0\n---\na: 1\n", "1:1", "a job uses no directives"),
    "unnamed anchor": (b"a: & b\n", "1:5", "a value that begins with & or * belongs in quotes"),
    "tag that is not declared": (b"a: !b!c d\n", "1:4", "a job uses no tags"),
    "too deep": (b"a: " + b"[" * 100_000, "1:36", "is nested deeper than 32 levels"),
    "too many values": (b"a: [" + b"1," * 100_000, "1:39999", "comes to more than 20000 values here"),
}


@pytest.mark.parametrize(("content", "place", "core"), NO_JOBS.values(), ids=NO_JOBS)
def test_no_job_is_refused_where_that_shows(content: bytes, place: str, core: str, tmp_path: Path) -> None:
    found = mistakes(content, tmp_path)
    assert found[0].startswith(f"job.yaml:{place}: "), found
    assert core in found[0]


def test_bomb_of_aliases_is_refused_at_the_alias_that_makes_it_one(tmp_path: Path) -> None:
    names = "abcdefghij"
    lines = ["a: &a [x,x,x,x,x,x,x,x,x,x]"]
    for previous, name in pairwise(names):
        lines.append(f"{name}: &{name} [{','.join([f'*{previous}'] * 10)}]")
    found = mistakes("\n".join(lines), tmp_path)
    assert found == ["job.yaml:5:8: the file comes to more than 20000 values here; a job has about 50"]


def test_aliases_within_reason_are_read(tmp_path: Path) -> None:
    text = SOUND + "laboratory: &us {name: Ours, address: Here}\ncustomer: *us\n"
    keys = loaded(text, tmp_path).keys
    assert keys.customer is not None
    assert keys.customer.name == "Ours"


@pytest.mark.parametrize("mark", [b"", codecs.BOM_UTF8])
@pytest.mark.parametrize("ending", [b"\n", b"\r\n", b"\r"])
def test_every_line_ending_and_a_byte_order_mark_are_read_alike(
    mark: bytes, ending: bytes, tmp_path: Path
) -> None:
    content = mark + SOUND.replace("X", "\N{GREEK SMALL LETTER MU}").encode().replace(b"\n", ending)
    job = loaded(content, tmp_path)
    assert job.axis.name == "\N{GREEK SMALL LETTER MU}"
    assert job.place_of("axis.name").line == 7


def test_many_characters_that_nobody_sees_are_named_in_part(tmp_path: Path) -> None:
    found = mistakes(b"a: '" + b"\x01" * 5000 + b"'", tmp_path)
    assert len(found) == 11
    assert found[-1].endswith("and more of the kind; is this a text file?")


def test_job_that_is_not_there_cannot_be_read(tmp_path: Path) -> None:
    with pytest.raises(AccessError, match=r"none\.yaml: cannot be read: no such file") as caught:
        load(tmp_path / "none.yaml", REGISTRY)
    assert caught.value.exit_code == 3


def test_folder_in_place_of_a_job_cannot_be_read(tmp_path: Path) -> None:
    with pytest.raises(AccessError, match="cannot be read: it is a folder"):
        load(tmp_path, REGISTRY)


def test_gigabyte_is_refused_without_reading_it(tmp_path: Path) -> None:
    path = tmp_path / "job.yaml"
    with path.open("wb") as file:
        file.truncate(1024**3)
    tracemalloc.start()
    try:
        with pytest.raises(InputError, match="is larger than 1 MiB"):
            load(path, REGISTRY)
        assert tracemalloc.get_traced_memory()[1] < 16 * 1024**2
    finally:
        tracemalloc.stop()
